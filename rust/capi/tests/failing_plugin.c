/* A plug-in for tests that gives an invalid result in cell 5, and fails for large strains. */
#include "msdd.h"

static int32_t initial_state(const msdd_plugin_start *start)
{
    size_t i;
    for (i = 0; i < start->cells; i++) {
        start->state[0][i] = start->porosity[i];
        start->state[1][i] = start->fabric_index[i];
    }
    return 0;
}

static const char *last_error(void) { return "hotter than the table"; }

static int32_t advance(const msdd_plugin_step *step)
{
    size_t i;
    for (i = 0; i < step->cells; i++) {
        if (step->thermal_strain[i] > 0.1) {
            return 4;
        }
        step->next_state[0][i] = step->state[0][i];
        step->next_state[1][i] = step->state[1][i];
        step->conductivity_xx[i] = i == 5 ? -0.3 : 0.3;
        step->conductivity_yy[i] = 0.3;
        step->stress_xx[i] = step->stress_yy[i] = 0.05;
    }
    return 0;
}

const msdd_plugin_v2 *msdd_plugin_v2_table(void)
{
    static const char *const names[] = {"porosity", "fabric_index"};
    static const msdd_plugin_v2 table = {
        .struct_size = sizeof(msdd_plugin_v2),
        .version = MSDD_PLUGIN_VERSION,
        .name = "failing",
        .state_size = 2,
        .state_names = names,
        .initial_state = initial_state,
        .advance = advance,
        .last_error = last_error,
    };
    return &table;
}
