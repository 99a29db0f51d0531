/* Asks the default model what the checks of the mechanics compare the solver with. The grains are those of the case small.
 *
 *   law                  prints the names of the columns of the state, as the solver names their fields
 *   law STATE [STATE..]  reads strains from the standard input, one line each: thermal, xx, yy, xy (twice the shear strain),
 *                        turn. Prints for each line the stress xx, yy, xy [Pa, compression positive] that a cell of this state
 *                        has after it, and the tangent there, row by row [Pa] */

#include "msdd.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>

enum { strains = 5, stresses = 3, tangents = 9, most = 64 };

static void print_names(const msdd_surrogate *model)
{
    const char *name;
    size_t k;
    for (k = 0; (name = msdd_surrogate_state_name(model, k)) != NULL; k++) {
        for (; *name; name++) {
            if (*name != '_') {
                putchar(*name);
            } else if (*++name) {
                putchar(toupper((unsigned char)*name));
            }
        }
        putchar('\n');
    }
}

static int answer(const msdd_surrogate *model, const double *state, const double *strain)
{
    const msdd_material material = {sizeof material, 100.0, 1e7, 5e-3};
    const double *given[most];
    double stress[stresses], tangent[tangents], *derivatives[tangents];
    msdd_batch batch = {0};
    int k;

    for (k = 0; k < most; k++) {
        given[k] = state + k;
    }
    for (k = 0; k < tangents; k++) {
        derivatives[k] = tangent + k;
    }
    batch.struct_size = sizeof batch;
    batch.cells = 1;
    batch.state = given;
    batch.thermal_strain = strain;
    batch.strain_xx = strain + 1;
    batch.strain_yy = strain + 2;
    batch.strain_xy = strain + 3;
    batch.rotation = strain + 4;
    batch.stress_xx = stress;
    batch.stress_yy = stress + 1;
    batch.stress_xy = stress + 2;
    batch.tangent = derivatives;
    if (msdd_surrogate_advance(model, &material, &batch) != MSDD_OK) {
        fprintf(stderr, "law: %s\n", msdd_last_error());
        return 0;
    }
    for (k = 0; k < stresses; k++) {
        printf("%.17g ", stress[k]);
    }
    for (k = 0; k < tangents; k++) {
        printf(k + 1 < tangents ? "%.17g " : "%.17g\n", tangent[k]);
    }
    return 1;
}

int main(int argc, char **argv)
{
    double state[most] = {0}, strain[strains];
    msdd_surrogate *model = NULL;
    int k, good = 1;

    if (msdd_surrogate_load("builtin", &model) != MSDD_OK) {
        fprintf(stderr, "law: %s\n", msdd_last_error());
        return 1;
    }
    if (argc == 1) {
        print_names(model);
    } else if ((size_t)argc - 1 != msdd_surrogate_state_size(model) || argc - 1 > most) {
        fprintf(stderr, "law: %d columns are given, the state has %zu\n", argc - 1, msdd_surrogate_state_size(model));
        good = 0;
    } else {
        for (k = 0; k < argc - 1; k++) {
            state[k] = strtod(argv[k + 1], NULL);
        }
        while (good && scanf("%lf %lf %lf %lf %lf", strain, strain + 1, strain + 2, strain + 3, strain + 4) == strains) {
            good = answer(model, state, strain);
        }
    }
    msdd_surrogate_free(model);
    return good ? 0 : 1;
}
