/* A plain plug-in, and by macros what may be wrong with one. */
#include "msdd.h"

#include <string.h>

static int32_t initial_state(const msdd_plugin_start *start)
{
    memcpy(start->state[0], start->porosity, start->cells * sizeof(double));
    memcpy(start->state[1], start->fabric_index, start->cells * sizeof(double));
#ifdef CHANGES_THE_START
    start->state[1][start->cells - 1] = 0.5;
#endif
    return 0;
}

static const char *text(void) { return "the table of isotherms is empty"; }

static int32_t advance(const msdd_plugin_step *step)
{
    size_t i;
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
static int32_t tangent(const msdd_plugin_tangent *wanted) { return wanted->cells > 0 ? 7 : 0; }

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
    table.last_error = text;
    (void)tangent;
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
