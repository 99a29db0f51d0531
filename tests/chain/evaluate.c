/* Evaluates a trained model file through the C interface: a jammed state, contracted, as it is, and expanded. */

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
    enum { cells = 3 };
    const double porosity[cells] = {0.14, 0.14, 0.14};
    const double fabric[cells] = {0.02, 0.02, 0.02};
    const double strain[cells] = {-0.01, 0.0, 0.02};
    double de[cells], df[cells], kxx[cells], kyy[cells], sxx[cells], syy[cells], solid[cells];
    const msdd_material material = {sizeof material, 100.0, 1e7, 5e-3};
    msdd_batch batch = {0};
    msdd_surrogate *model = NULL;
    int c;

    if (argc != 2 || msdd_surrogate_load(argv[1], &model) != MSDD_OK) {
        fprintf(stderr, "evaluate: %s\n", argc == 2 ? msdd_last_error() : "usage: evaluate MODEL");
        return 1;
    }
    batch.struct_size = sizeof batch;
    batch.cells = cells;
    batch.porosity = porosity;
    batch.fabric_index = fabric;
    batch.thermal_strain = strain;
    batch.delta_porosity = de;
    batch.delta_fabric_index = df;
    batch.conductivity_xx = kxx;
    batch.conductivity_yy = kyy;
    batch.stress_xx = sxx;
    batch.stress_yy = syy;
    if (msdd_surrogate_evaluate(model, &material, &batch) != MSDD_OK ||
        msdd_surrogate_solid_fraction(model, cells, porosity, solid) != MSDD_OK) {
        fprintf(stderr, "evaluate: %s\n", msdd_last_error());
        return 1;
    }
    for (c = 0; c < cells; c++) {
        printf("strain %+.3f: d(porosity) %+.5f d(fabric) %+.5f K %.2f %.2f W/(m K) stress %.0f %.0f Pa solid %.4f\n",
               strain[c], de[c], df[c], kxx[c], kyy[c], sxx[c], syy[c], solid[c]);
        check(isfinite(de[c] + df[c] + sxx[c] + syy[c]), "finite");
        check(kxx[c] > 0 && kxx[c] < 100 && kyy[c] > 0 && kyy[c] < 100, "conductivity between 0 and that of the grains");
        check(solid[c] > 0.8 && solid[c] < 1.0, "solid fraction of a jammed packing");
    }
    check(de[1] == 0.0 && df[1] == 0.0, "zero strain changes nothing");
    check(de[0] > 0 && de[2] < 0, "porosity rises in contraction, falls in expansion");
    check(kxx[0] < kxx[2] && kyy[0] < kyy[2], "conductivity grows with strain");
    check(sxx[0] < sxx[2] && syy[0] < syy[2], "stress grows with strain");
    check(batch.clamped_cells == 0, "inside the trained range");
    msdd_surrogate_free(model);
    return failures ? 1 : 0;
}
