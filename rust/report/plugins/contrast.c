/* A plug-in for tests that describes no real material: the conductivity falls by a factor of ten for every 0.01 of porosity
 * above 0.10, so that two halves of a box can have any ratio of conductivities. Isotropic, without stress; the state does not
 * change. */
#include "msdd.h"

#include <math.h>

static int32_t advance(const msdd_plugin_step *step)
{
    size_t i;
    for (i = 0; i < step->cells; i++) {
        const double conductivity = pow(10.0, -100.0 * (step->state[0][i] - 0.10));
        step->next_state[0][i] = step->state[0][i];
        step->next_state[1][i] = step->state[1][i];
        step->conductivity_xx[i] = conductivity;
        step->conductivity_yy[i] = conductivity;
        step->stress_xx[i] = 0;
        step->stress_yy[i] = 0;
        step->outside[0][i] = 0;
        step->outside[1][i] = 0;
        step->outside[2][i] = 0;
    }
    return 0;
}

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
        result[i] = 1 - porosity[i];
    }
    return 0;
}

const msdd_plugin_v2 *msdd_plugin_v2_table(void)
{
    static const char *const names[] = {"porosity", "fabric_index"};
    static const msdd_plugin_v2 table = {
        .struct_size = sizeof(msdd_plugin_v2),
        .version = MSDD_PLUGIN_VERSION,
        .name = "conductivity contrast",
        .state_size = 2,
        .state_names = names,
        .initial_state = initial_state,
        .advance = advance,
        .solid_fraction = solid_fraction,
    };
    return &table;
}
