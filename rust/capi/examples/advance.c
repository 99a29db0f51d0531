/* One cell in C: loads a model (the built-in one, or the one named by the argument), warms the grains and prints. */
#include "msdd.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    enum { most = 64 };
    double porosity = 0.125, fabric_index = 0.05, strain = 0.01, k[3], s[3], values[most];
    const msdd_grains material = {.struct_size = sizeof material, .conductivity = 100, .young_modulus = 1e7, .radius = 5e-3};
    msdd_model *model = NULL;
    msdd_input before[most];
    msdd_output state[most], conductivity[] = {{&k[0], 1}, {&k[1], 1}, {&k[2], 1}}, stress[] = {{&s[0], 1}, {&s[1], 1}, {&s[2], 1}};
    msdd_start start = {.struct_size = sizeof start, .cells = 1, .components = 3, .porosity = {&porosity, 1},
                        .fabric_index = {&fabric_index, 1}};
    msdd_step step = {.struct_size = sizeof step, .cells = 1, .components = 3, .state = before, .next_state = state,
                      .thermal_strain = {&strain, 1}, .total_thermal_strain = {&strain, 1}, .conductivity = conductivity,
                      .stress = stress};

    for (int i = 0; i < most; i++) {
        state[i] = (msdd_output){&values[i], 1};
        before[i] = (msdd_input){&values[i], 1};
    }
    if (msdd_abi_version() != MSDD_ABI_VERSION || msdd_model_load(argc > 1 ? argv[1] : NULL, &model) ||
        msdd_model_initial_state(model, &material, &start, state) || msdd_model_advance(model, &material, &step)) {
        fprintf(stderr, "advance: %s\n", msdd_last_error());
        return 1;
    }
    printf("porosity %.5f, K %.3f %.3f W/(m K), pressure %.1f Pa\n", values[0], k[0], k[1], (s[0] + s[1]) / 2);
    msdd_model_free(model);
    return 0;
}
