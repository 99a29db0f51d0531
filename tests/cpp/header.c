/* msdd.h as a C program sees it: compiles as C99, loads, evaluates one cell, reports errors, frees. */
#include "msdd.h"

#include <stdio.h>
#include <string.h>

static int failures = 0;

#define EXPECT(condition)                                                          \
    do {                                                                           \
        if (!(condition)) {                                                        \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
            ++failures;                                                            \
        }                                                                          \
    } while (0)

int main(void)
{
    const double porosity = 0.125, fabric_index = 0.05, strain = 1e-3;
    double conductivity = -1, stress = -1, solid = -1;
    msdd_surrogate *surrogate = NULL;
    msdd_material material = {sizeof(msdd_material), 100, 1e7, 5e-3};
    msdd_batch batch;

    EXPECT(msdd_abi_version() == MSDD_ABI_VERSION);
    EXPECT(strlen(msdd_version()) >= 5);
    EXPECT(strcmp(msdd_last_error(), "") == 0);

    EXPECT(msdd_surrogate_load("/no/such/model.json", &surrogate) == MSDD_IO);
    EXPECT(surrogate == NULL && strstr(msdd_last_error(), "/no/such/model.json") != NULL);
    EXPECT(msdd_surrogate_load(NULL, &surrogate) == MSDD_OK);
    EXPECT(strlen(msdd_surrogate_hash(surrogate)) == 64);
    EXPECT(msdd_surrogate_describe(surrogate)[0] == '{');

    memset(&batch, 0, sizeof batch);
    batch.struct_size = sizeof batch;
    batch.cells = 1;
    batch.porosity = &porosity;
    batch.fabric_index = &fabric_index;
    batch.thermal_strain = &strain;
    batch.conductivity_xx = &conductivity;
    batch.stress_yy = &stress;
    EXPECT(msdd_surrogate_evaluate(surrogate, &material, &batch) == MSDD_OK);
    EXPECT(conductivity > 5 && conductivity < 100);
    EXPECT(stress >= 0 && stress < 1e5);

    EXPECT(msdd_surrogate_solid_fraction(surrogate, 1, &porosity, &solid) == MSDD_OK);
    EXPECT(solid > 1 - porosity && solid < 1);

    batch.struct_size = 1;
    EXPECT(msdd_surrogate_evaluate(surrogate, &material, &batch) == MSDD_INVALID_ARGUMENT);
    EXPECT(strstr(msdd_last_error(), "struct_size = 1") != NULL);
    EXPECT(msdd_surrogate_evaluate(NULL, &material, &batch) == MSDD_INVALID_ARGUMENT);
    EXPECT(msdd_surrogate_hash(NULL) == NULL);

    msdd_surrogate_free(surrogate);
    msdd_surrogate_free(NULL);
    printf("header.c: %s\n", failures ? "FAILED" : "ok");
    return failures != 0;
}
