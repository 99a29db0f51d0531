/* One cell in C: loads a model (the built-in one, or the one named by the argument), warms the grains and prints. */
#include "msdd.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    enum { most = 64 };
    double porosity = 0.125, fabric_index = 0.05, strain = 0.01, kxx, kyy, sxx, syy, values[most], *state[most];
    const double *before[most];
    const msdd_material material = {sizeof material, 100, 1e7, 5e-3}; /* k [W/(m K)], E [Pa], mean radius [m] */
    msdd_surrogate *model = NULL;
    msdd_initial initial = {.struct_size = sizeof initial, .cells = 1, .porosity = &porosity, .fabric_index = &fabric_index};
    msdd_batch batch = {.struct_size = sizeof batch, .cells = 1, .state = before, .next_state = state,
                        .thermal_strain = &strain, .total_thermal_strain = &strain, .conductivity_xx = &kxx,
                        .conductivity_yy = &kyy, .stress_xx = &sxx, .stress_yy = &syy};

    for (int k = 0; k < most; k++) before[k] = state[k] = &values[k];
    if (msdd_abi_version() != MSDD_ABI_VERSION || msdd_surrogate_load(argc > 1 ? argv[1] : NULL, &model) ||
        msdd_surrogate_initial_state(model, &material, &initial, state) ||
        msdd_surrogate_advance(model, &material, &batch)) {
        fprintf(stderr, "advance: %s\n", msdd_last_error());
        return 1;
    }
    printf("porosity %.5f, K %.3f %.3f W/(m K), pressure %.1f Pa\n", values[0], kxx, kyy, (sxx + syy) / 2);
    msdd_surrogate_free(model);
    return 0;
}
