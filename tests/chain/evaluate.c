/* Evaluates a trained model file through the C interface: one jammed state under contraction, no strain, and expansion. */

#include "msdd.h"

#include <math.h>
#include <stdio.h>

static int failures = 0;

static void check(int good, const char *what)
{
    if (!good) {
        failures++;
    }
    printf("%s  %s\n", good ? "ok    " : "FAILED", what);
}

int main(int argc, char **argv)
{
    enum { cells = 3, most = 64 };
    const double porosity[cells] = {0.14, 0.14, 0.14};
    const double fabric[cells] = {0.02, 0.02, 0.02};
    const double strain[cells] = {-0.01, 0.0, 0.02};
    double before[most][cells], after[most][cells];
    double kxx[cells], kyy[cells], sxx[cells], syy[cells], solid[cells];
    double *state[most], *next[most];
    const double *given[most];
    const msdd_material material = {sizeof material, 100.0, 1e7, 5e-3};
    msdd_initial initial = {0};
    msdd_batch batch = {0};
    msdd_surrogate *model = NULL;
    int c, k;

    if (argc != 2 || msdd_surrogate_load(argv[1], &model) != MSDD_OK) {
        fprintf(stderr, "evaluate: %s\n", argc == 2 ? msdd_last_error() : "usage: evaluate MODEL");
        return 1;
    }
    for (k = 0; k < most; k++) {
        given[k] = state[k] = before[k];
        next[k] = after[k];
    }
    initial.struct_size = sizeof initial;
    initial.cells = batch.cells = cells;
    initial.porosity = porosity;
    initial.fabric_index = fabric;
    batch.struct_size = sizeof batch;
    batch.state = given;
    batch.next_state = next;
    batch.thermal_strain = strain;
    batch.conductivity_xx = kxx;
    batch.conductivity_yy = kyy;
    batch.stress_xx = sxx;
    batch.stress_yy = syy;
    if (msdd_surrogate_initial_state(model, &material, &initial, state) != MSDD_OK ||
        msdd_surrogate_advance(model, &material, &batch) != MSDD_OK ||
        msdd_surrogate_solid_fraction(model, cells, porosity, solid) != MSDD_OK) {
        fprintf(stderr, "evaluate: %s\n", msdd_last_error());
        return 1;
    }
    for (c = 0; c < cells; c++) {
        printf("strain %+.3f: porosity %.5f fabric %+.5f K %.2f %.2f W/(m K) stress %.0f %.0f Pa solid %.4f\n",
               strain[c], after[0][c], after[1][c], kxx[c], kyy[c], sxx[c], syy[c], solid[c]);
        check(isfinite(after[0][c] + after[1][c] + sxx[c] + syy[c]), "finite");
        check(kxx[c] > 0 && kxx[c] < 100 && kyy[c] > 0 && kyy[c] < 100, "conductivity between 0 and that of the grains");
        check(solid[c] > 0.8 && solid[c] < 1.0, "solid fraction of a jammed packing");
    }
    check(after[0][1] == 0.14 && after[1][1] == 0.02, "zero strain changes nothing");
    check(after[0][0] > 0.14 && after[0][2] < 0.14, "porosity rises in contraction, falls in expansion");
    check(kxx[0] < kxx[2] && kyy[0] < kyy[2], "conductivity grows with strain");
    check(sxx[0] < sxx[2] && syy[0] < syy[2], "stress grows with strain");
    check(batch.clamped_cells == 0, "inside the trained range");
    msdd_surrogate_free(model);
    return failures ? 1 : 0;
}
