/* A plug-in with a surrogate that needs no training: an effective medium of equal discs whose centres do not move.
 *
 *   cc -std=c99 -O2 -shared -fPIC -Irust/capi/include rust/capi/examples/effective_medium.c -lm -o effective_medium.so
 *   then load "plugin:effective_medium.so"
 *
 * State: porosity e (overlaps counted once) and fabric index f. Per disc of radius r there are Z contacts of overlap
 * 2 r x, so that two centres are 2 r (1 - x) apart and a contact's chord spans the angle 2 t, cos t = 1 - x.
 *
 *   overlap        x = B (E_J - e), 0 beyond unjamming at E_J                                                      [1]
 *   coordination   Z = Z_0 + Z_1 sqrt(x): contacts appear with the root of the compression (O'Hern et al., Phys.
 *                  Rev. E 68, 011306, 2003); rattlers count as discs                                               [1]
 *   solid fraction s = (1 - e)/(1 - Z (t - sin t cos t)/pi): overlaps counted twice; each contact cuts a circular segment
 *                  off the disc
 *   conductivity   K/k = s Z sin t cos t/pi: Eq. 9 of Rangel et al. with conductance k chord/distance, all directions
 *                  alike
 *   pressure       p l/(E r) = s Z x cos t/pi: Love's stress with the force E r 2 r x of equal discs (s_n = E r)
 *   porosity       de/de_thermal = -2 s (1 - Z t/pi): the part of the perimeter without contacts moves outwards
 *   anisotropy     K_xx, K_yy = K (1 +- C_K f), sigma_xx, sigma_yy = p (1 +- C_S f), df/de_thermal = -C_F f            [1]
 *
 * [1] Fitted. B, E_J, Z_0, Z_1: least squares over K and p of 14 666 states in equilibrium (thermal ramps of
 * cases/database/full.csv.gz, reduced pressure above 0.004); C_K, C_S: over the same states; C_F: between the growth of f
 * in ramps of -5 and of +5 %. Over these states the error (root mean square) is 10 % of K, 0.010 of p, and 0.006, 0.002,
 * 0.001, 0.002 of the porosity after strains of -5, -2, 2, 5 %. Use it as a baseline that trained models have to beat, or
 * as a start for a law of your own. */
#include "msdd.h"

#include <math.h>

static const double B = 0.576, E_J = 0.209, Z_0 = 0.424, Z_1 = 14.68;
static const double C_K = 2.46, C_S = 4.88, C_F = 22;
static const double PI = 3.14159265358979323846;

/* Ranges of the states of the fit; a state outside is evaluated at the nearest end. */
static const double POROSITY_MIN = 0.03, POROSITY_MAX = 0.20, FABRIC = 0.15, STRAIN = 0.10;
/* Sine of the friction angle that the grains mobilise at most: limits both anisotropies. */
static const double RATIO_LIMIT = 0.5;
/* K/k without contacts: above zero, because the heat equation cannot be solved with a conductivity of zero. */
static const double FLOOR = 1e-4;
/* Largest strain of a sub-step of the midpoint rule, which is of second order. */
static const double SUBSTEP = 0.005;

static double clamp(double value, double low, double high) { return fmin(fmax(value, low), high); }
static double outside(double value, double low, double high) { return value - clamp(value, low, high); }

/** Contacts of the packing at a porosity, see the laws above. */
typedef struct contacts {
    double x, t, coordination, solid_fraction;
} contacts;

static contacts contacts_at(double porosity)
{
    contacts c;
    const double e = clamp(porosity, POROSITY_MIN, POROSITY_MAX);
    c.x = fmax(B * (E_J - e), 0.0);
    c.t = acos(1 - c.x);
    c.coordination = Z_0 + Z_1 * sqrt(c.x);
    c.solid_fraction = (1 - e) / (1 - c.coordination * (c.t - sin(c.t) * cos(c.t)) / PI);
    return c;
}

static double porosity_rate(double porosity)
{
    const contacts c = contacts_at(porosity);
    return -2 * c.solid_fraction * (1 - c.coordination * c.t / PI);
}

/** Porosity after a thermal strain, by the midpoint rule in the logarithm of the radius. Zero strain: no sub-step. */
static double strained(double porosity, double strain)
{
    const int steps = (int)ceil(fabs(strain) / SUBSTEP);
    const double h = steps ? log1p(strain) / steps : 0;
    int k;
    for (k = 0; k < steps; k++) {
        porosity += h * porosity_rate(porosity + 0.5 * h * porosity_rate(porosity));
    }
    return clamp(porosity, 0.0, 1.0);
}

static int32_t advance(const msdd_plugin_step *step)
{
    size_t i;
    for (i = 0; i < step->cells; i++) {
        const double e = step->state[0][i], f = step->state[1][i], strain = step->thermal_strain[i];
        const double used = clamp(strain, -STRAIN, STRAIN);
        const double next = used == 0 ? e : strained(e, used);
        const double next_f = used == 0 ? f : clamp(f * exp(-C_F * used), -1, 1);
        const contacts c = contacts_at(next);
        const double mean = c.solid_fraction * c.coordination * cos(c.t) / PI;
        const double conductivity = FLOOR + mean * sin(c.t), pressure = mean * c.x;
        const double a_k = clamp(C_K * next_f, -RATIO_LIMIT, RATIO_LIMIT);
        const double a_s = clamp(C_S * next_f, -RATIO_LIMIT, RATIO_LIMIT);
        step->next_state[0][i] = next;
        step->next_state[1][i] = next_f;
        step->conductivity_xx[i] = conductivity * (1 + a_k);
        step->conductivity_yy[i] = conductivity * (1 - a_k);
        step->stress_xx[i] = pressure * (1 + a_s);
        step->stress_yy[i] = pressure * (1 - a_s);
        step->outside[0][i] = outside(e, POROSITY_MIN, POROSITY_MAX);
        step->outside[1][i] = outside(f, -FABRIC, FABRIC);
        step->outside[2][i] = outside(strain, -STRAIN, STRAIN);
    }
    return 0;
}

/* Porosity and fabric index determine stress and conductivity, so the other initial values are not used. */
static int32_t initial_state(const msdd_plugin_start *start)
{
    size_t i;
    for (i = 0; i < start->cells; i++) {
        start->state[0][i] = start->porosity[i];
        start->state[1][i] = start->fabric_index[i];
    }
    return 0;
}

static int32_t solid_fraction(size_t cells, const double *porosity, double *result)
{
    size_t i;
    for (i = 0; i < cells; i++) {
        result[i] = contacts_at(porosity[i]).solid_fraction;
    }
    return 0;
}

const msdd_plugin_v2 *msdd_plugin_v2_table(void)
{
    static const char *const names[] = {"porosity", "fabric_index"};
    static const msdd_plugin_v2 table = {
        .struct_size = sizeof(msdd_plugin_v2),
        .version = MSDD_PLUGIN_VERSION,
        .name = "effective medium of discs",
        .state_size = 2,
        .state_names = names,
        .initial_state = initial_state,
        .advance = advance,
        .solid_fraction = solid_fraction,
    };
    return &table;
}
