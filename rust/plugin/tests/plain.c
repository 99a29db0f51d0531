/* A simple plug-in for tests. Macros given to the compiler introduce the faults that a plug-in may have. */
#include "msdd.h"

#include <string.h>

/* Number of calls of advance and initial_state. */
static double calls;

static int32_t initial_state(const msdd_plugin_start *start)
{
    calls++;
    memcpy(start->state[0], start->porosity, start->cells * sizeof(double));
    memcpy(start->state[1], start->fabric_index, start->cells * sizeof(double));
#ifdef CHANGES_THE_START
    start->state[1][start->cells - 1] = 0.5;
#endif
#ifdef STARTS
    STARTS;
#endif
    return 0;
}

static const char *text(void) { return "the table of isotherms is empty"; }

static int32_t advance(const msdd_plugin_step *step)
{
    size_t i, k;
    calls++;
    for (i = 0; i < step->cells; i++) {
        /* Volume and shear strain of the cell. */
        const double grown = step->strain_xx ? step->strain_xx[i] + step->strain_yy[i] : 0;
        const double sheared = step->strain_xy ? step->strain_xy[i] : 0;
        step->next_state[0][i] = step->state[0][i] - step->thermal_strain[i] + 0.5 * grown;
        step->next_state[1][i] = step->state[1][i] + (step->rotation ? step->rotation[i] : 0);
        step->conductivity_xx[i] = step->conductivity_yy[i] = 0.3;
        step->stress_xx[i] = 0.05 - grown;
#ifndef LEAVES_STRESS
        step->stress_yy[i] = 0.05 - grown;
#endif
        if (sheared != 0) {
            step->stress_xy[i] = -0.5 * sheared;
        }
        for (k = 0; step->tangent && k < 9; k++) {
            step->tangent[k][i] = k == 8 ? 0.5 : k == 0 || k == 1 || k == 3 || k == 4 ? 1 : 0;
        }
    }
#ifdef FAILS
    return FAILS;
#endif
#ifdef ANSWERS
    ANSWERS;
#endif
    return 0;
}

#ifndef SOLID
#define SOLID 0.9
#endif
#ifndef SPREAD
#define SPREAD 0.1
#endif
static int32_t solid_fraction(size_t cells, const double *porosity, double *result)
{
    while (cells-- > 0) {
        result[cells] = porosity[cells] > 0.13 ? SOLID : 0.9;
    }
    return 0;
}

static int32_t spread(size_t cells, const double *const *state, double *result)
{
    while (cells-- > 0) {
        result[cells] = state[0][cells] > 0.13 ? SPREAD : 0.1;
    }
    return 0;
}

#ifdef OLD
/* What a plug-in of version 1 defines. */
const void *msdd_plugin_v1_table(void);
const void *msdd_plugin_v1_table(void) { return "a table of version 1"; }
#endif

const msdd_plugin_v2 *msdd_plugin_v2_table(void)
{
    static const char *const names[] = {
#ifdef NAMES
        NAMES
#else
        "porosity", "fabric_index"
#endif
    };
    static msdd_plugin_v2 table;
    table.struct_size = sizeof table;
    table.version = MSDD_PLUGIN_VERSION;
    table.name = "plain";
    table.state_size = sizeof names / sizeof names[0];
    table.state_names = names;
    table.initial_state = initial_state;
    table.advance = advance;
    table.last_error = text;
#ifdef HAS_ALL
    table.has_tangent = 1;
    table.solid_fraction = solid_fraction;
    table.spread = spread;
#endif
    (void)solid_fraction, (void)spread;
#ifdef CHANGE
    CHANGE;
#endif
    return
#ifdef RETURNS
        RETURNS;
#else
        &table;
#endif
}
