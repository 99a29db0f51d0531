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
    size_t i;
    calls++;
    for (i = 0; i < step->cells; i++) {
        step->next_state[0][i] = step->state[0][i] - step->thermal_strain[i];
        step->next_state[1][i] = step->state[1][i];
        step->conductivity_xx[i] = step->conductivity_yy[i] = 0.3;
        step->stress_xx[i] = 0.05;
#ifndef LEAVES_STRESS
        step->stress_yy[i] = 0.05;
#endif
    }
#ifdef FAILS
    return FAILS;
#endif
#ifdef ANSWERS
    ANSWERS;
#endif
    return 0;
}

#ifndef TANGENT
#define TANGENT NULL
#endif
#ifndef DEFORM
#define DEFORM NULL
#endif
#ifndef C12
#define C12 0.5
#endif
static int32_t tangent(const msdd_plugin_tangent *wanted)
{
    size_t i;
    for (i = 0; i < wanted->cells; i++) {
        wanted->c11[i] = wanted->c22[i] = 1;
        wanted->c12[i] = C12;
        wanted->porosity_rate[i] = wanted->fabric_index_rate[i] = 0.5;
    }
#ifdef STIFFENS
    STIFFENS;
#endif
    return 0;
}

static int32_t deform(size_t cells, const double *const *state, const double *xx, const double *yy, double *const *next)
{
    size_t i;
    for (i = 0; i < cells; i++) {
        next[0][i] = state[0][i] + 0.5 * (xx[i] + yy[i]);
        next[1][i] = state[1][i] + 0.5 * (xx[i] - yy[i]);
    }
#ifdef DEFORMS
    DEFORMS;
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

const msdd_plugin_v1 *msdd_plugin_v1_table(void)
{
    static const char *const names[] = {
#ifdef NAMES
        NAMES
#else
        "porosity", "fabric_index"
#endif
    };
    static msdd_plugin_v1 table;
    table.struct_size = sizeof table;
    table.version = MSDD_PLUGIN_VERSION;
    table.name = "plain";
    table.state_size = sizeof names / sizeof names[0];
    table.state_names = names;
    table.initial_state = initial_state;
    table.advance = advance;
    table.tangent = TANGENT;
    table.deform = DEFORM;
    table.last_error = text;
#ifdef HAS_ALL
    table.solid_fraction = solid_fraction;
    table.spread = spread;
#endif
    (void)tangent, (void)deform, (void)solid_fraction, (void)spread;
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
