/* Asks the law of spheres what the checks of spheres that move compare the solver with. The material is that of these checks.
 *
 *   spheres FRACTION XX YY ZZ XY XZ YZ   starts from this solid fraction and stress [Pa, compression positive], and reads steps from
 *                        the standard input, one line each: growth of the radii, strain of the cell xx yy zz xy xz yz (shears twice
 *                        the tensor's), turn about x y z. Prints for each line the stress after all steps so far, the conductivity, and
 *                        the solid fraction */

#include "msdd.h"

#include <stdio.h>
#include <stdlib.h>

enum { components = 6, turns = 3, most = 64 };

static const msdd_sphere_material material = {
    sizeof material, 2e-3, 5e9, 0.25, 40.0, 0.0, 1.0, "air", 1.013e5, 0.9, 0.0, 0.0
};

static int step(const msdd_spheres *law, double *const *state)
{
    double thermal, strain[components], turn[turns], stress[components], conductivity[components], solid;
    const double *strains[components], *angles[turns];
    double *stresses[components], *conductivities[components];
    msdd_sphere_batch batch = {0};
    int k;

    if (scanf("%lf", &thermal) != 1) {
        return 0;
    }
    for (k = 0; k < components; k++) {
        if (scanf("%lf", strain + k) != 1) {
            return 0;
        }
        strains[k] = strain + k;
        stresses[k] = stress + k;
        conductivities[k] = conductivity + k;
    }
    for (k = 0; k < turns; k++) {
        if (scanf("%lf", turn + k) != 1) {
            return 0;
        }
        angles[k] = turn + k;
    }
    batch.struct_size = sizeof batch;
    batch.cells = 1;
    batch.state = (const double *const *)state;
    batch.next_state = state;
    batch.thermal_strain = &thermal;
    batch.strain = strains;
    batch.rotation = angles;
    batch.stress = stresses;
    batch.conductivity = conductivities;
    batch.solid_fraction = &solid;
    if (msdd_spheres_advance(law, &material, &batch) != MSDD_OK) {
        fprintf(stderr, "spheres: %s\n", msdd_last_error());
        exit(1);
    }
    for (k = 0; k < components; k++) {
        printf("%.17g ", stress[k]);
    }
    for (k = 0; k < components; k++) {
        printf("%.17g ", conductivity[k]);
    }
    printf("%.17g\n", solid);
    return 1;
}

int main(int argc, char **argv)
{
    double columns[most], start[components], fraction;
    double *state[most];
    const double *stress[components];
    msdd_spheres *law = NULL;
    int k;

    if (argc != 2 + components || msdd_spheres_load("builtin", &law) != MSDD_OK || msdd_spheres_state_size(law) > most) {
        fprintf(stderr, "spheres: %d numbers are given, 7 are needed; %s\n", argc - 1, msdd_last_error());
        return 1;
    }
    fraction = strtod(argv[1], NULL);
    for (k = 0; k < components; k++) {
        start[k] = strtod(argv[2 + k], NULL);
        stress[k] = start + k;
    }
    for (k = 0; k < most; k++) {
        state[k] = columns + k;
    }
    if (msdd_spheres_initial_state(law, &material, 1, &fraction, stress, NULL, NULL, NULL, state) != MSDD_OK) {
        fprintf(stderr, "spheres: %s\n", msdd_last_error());
        return 1;
    }
    while (step(law, state)) {
    }
    msdd_spheres_free(law);
    return 0;
}
