/* A tiny database in C: generated from a plan, stopped and resumed, written as CSV. Then a packing of the same kind is
 * strained by simulation, and its pressure is compared with that of the built-in model.  Usage: database FOLDER */
#include "msdd.h"

#include <stdio.h>
#include <stdlib.h>

static const char *const plan = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 5\n"
                                "[[thermal]]\ndiscs = 60\nporosities = [0.12, 0.14]\n"
                                "compressions = [\"isotropic\"]\nrepeats = 2\nstops = [0.005, 0.01]\n";

static int32_t progress(void *user, uint64_t done, uint64_t total, uint64_t failed)
{
    printf("%u of %u packings, %u failed\n", (unsigned)done, (unsigned)total, (unsigned)failed);
    return *(int *)user && done == 2; /* enough for now */
}

static void check(int32_t status)
{
    if (status != MSDD_OK) {
        fprintf(stderr, "database: %s\n", msdd_last_error());
        exit(1);
    }
}

int main(int argc, char **argv)
{
    enum { most = 64 };
    char path[4096], csv[4096];
    int stop = 1, k;
    uint64_t rows;
    msdd_rve *rve;
    msdd_surrogate *model;
    msdd_averages before = {.struct_size = sizeof before}, after = {.struct_size = sizeof after};
    double strain = 0.01, pressure[2], values[most], *state[most];
    const double *given[most];
    const msdd_material material = {sizeof material, 100, 1e7, 5e-3};

    if (argc != 2) return 2;
    snprintf(path, sizeof path, "%s/example", argv[1]);
    snprintf(csv, sizeof csv, "%s/example.csv", argv[1]);
    if (msdd_database_generate(plan, path, 1, progress, &stop) != MSDD_CANCELLED) return 1;
    stop = 0;
    check(msdd_database_generate(plan, path, 2, progress, &stop));
    check(msdd_database_export_csv(path, csv, &rows));
    printf("%u rows\n", (unsigned)rows);

    check(msdd_rve_pack("{\"discs\": 500, \"porosity\": 0.12}", &rve));
    check(msdd_rve_homogenise(rve, &before));
    check(msdd_rve_strain(rve, strain, 0, 0, 0, NULL));
    check(msdd_rve_homogenise(rve, &after));
    msdd_rve_free(rve);

    for (k = 0; k < most; k++) given[k] = state[k] = &values[k];
    msdd_initial initial = {.struct_size = sizeof initial, .cells = 1, .porosity = &before.porosity,
                            .fabric_index = &before.fabric_index, .stress_xx = &before.stress_xx,
                            .stress_yy = &before.stress_yy, .stress_xy = &before.stress_xy};
    msdd_batch batch = {.struct_size = sizeof batch, .cells = 1, .state = given, .next_state = state,
                        .thermal_strain = &strain, .total_thermal_strain = &strain, .stress_xx = &pressure[0],
                        .stress_yy = &pressure[1]};
    check(msdd_surrogate_load(NULL, &model));
    check(msdd_surrogate_initial_state(model, &material, &initial, state));
    check(msdd_surrogate_advance(model, &material, &batch));
    msdd_surrogate_free(model);
    pressure[0] = (pressure[0] + pressure[1]) / 2;
    printf("pressure before %.0f Pa; after a strain of 1 %%: simulated %.0f Pa, model %.0f Pa\n", before.pressure,
           after.pressure, pressure[0]);
    return !(pressure[0] > 0.95 * after.pressure && pressure[0] < 1.05 * after.pressure);
}
