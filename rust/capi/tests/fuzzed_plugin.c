/* A plug-in with a valid table and valid results, except for the values that are replaced by invalid ones at random; the
 * random numbers depend on the number of calls. See fuzz/columns.rs. */
#include "msdd.h"

#include <math.h>
#include <string.h>

static uint64_t counter;

/* SplitMix64 of the number of calls. */
static uint64_t number(void)
{
    uint64_t z = counter += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static size_t below(size_t end) { return (size_t)(number() % end); }

static double value(void)
{
    static const double values[] = {0, -0.0, 1, -1, 2, 0.5, 0.12, 1e-300, 1e300, -1e300, 1e-31, 1e31, 7, -23};
    const size_t k = below(sizeof values / sizeof values[0] + 2);
    return k < sizeof values / sizeof values[0] ? values[k] : k % 2 ? NAN : INFINITY;
}

/* Replaces one value of a column by an invalid one, in one of `rarely` calls on average. */
static void broken(double *column, size_t cells, size_t rarely)
{
    if (below(rarely) == 0) {
        column[below(cells)] = value();
    }
}

static size_t state_size;

static int32_t initial_state(const msdd_plugin_start *start)
{
    return start->cells > 0;
}

static int32_t advance(const msdd_plugin_step *step)
{
    size_t i, k;
    for (k = 0; k < state_size; k++) {
        memcpy(step->next_state[k], step->state[k], step->cells * sizeof(double));
        broken(step->next_state[k], step->cells, 60);
        broken((double *)step->state[k], step->cells, 8);
        broken(step->outside[k], step->cells, 60);
    }
    for (i = 0; i < step->cells; i++) {
        step->conductivity_xx[i] = step->conductivity_yy[i] = 0.3;
        step->stress_xx[i] = step->stress_yy[i] = 0.05;
    }
    for (k = 0; step->tangent && k < 9; k++) {
        for (i = 0; i < step->cells; i++) {
            step->tangent[k][i] = k % 4 == 0;
        }
        broken(step->tangent[k], step->cells, 60);
    }
    if (step->strain_xx) {
        for (i = 0; i < step->cells; i++) {
            step->next_state[0][i] += step->strain_xx[i] + step->strain_yy[i];
        }
        broken((double *)step->rotation, step->cells, 8);
    }
    broken(step->conductivity_xx, step->cells, 30);
    broken(step->conductivity_xy, step->cells, 30);
    broken(step->stress_yy, step->cells, 30);
    broken(step->stress_xy, step->cells, 30);
    return below(40) == 0;
}

static int32_t spread(size_t cells, const double *const *state, double *result)
{
    memcpy(result, state[0], cells * sizeof(double));
    broken(result, cells, 10);
    return 0;
}

static const char *last_error(void)
{
    return below(2) ? "\xff is no UTF-8" : NULL;
}

const msdd_plugin_v2 *msdd_plugin_v2_table(void)
{
    static const char *const words[] = {"porosity", "fabric_index", "a", "b2", "c_", "porosity_", "../x", "", "\xff",
                                        "FabricIndex", "d d", "e", "f", "g", "h", "i", "j", NULL};
    static const char *names[80];
    static msdd_plugin_v2 table;
    const size_t count = sizeof words / sizeof words[0];
    size_t k;
    memset(&table, 0, sizeof table);
    state_size = below(3) ? 2 : below(5) ? 3 + below(3) : below(80);
    names[0] = words[0];
    names[1] = words[1];
    for (k = 2; k < sizeof names / sizeof names[0]; k++) {
        names[k] = words[below(4) ? 11 + (k - 2) % 6 : below(count)];
    }
    if (below(20) == 0) {
        names[below(2)] = words[below(count)];
    }
    table.struct_size = below(30) ? sizeof table : below(200);
    table.version = below(30) ? MSDD_PLUGIN_VERSION : (uint32_t)number();
    table.network_conductivity = below(30) ? (uint32_t)below(2) : (uint32_t)number();
    table.name = below(30) ? "fuzzed" : words[below(count)];
    table.state_size = state_size;
    table.state_names = below(30) ? names : NULL;
    table.initial_state = below(30) ? initial_state : NULL;
    table.advance = below(30) ? advance : NULL;
    table.has_tangent = below(30) ? (uint32_t)below(2) : (uint32_t)number();
    table.spread = below(2) ? spread : NULL;
    table.last_error = below(2) ? last_error : NULL;
    table.wall_friction_limit = below(5) ? 0 : value();
    table.wall_friction_slip = value();
    return below(30) ? &table : NULL;
}
