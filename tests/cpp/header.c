/* Tests msdd.h in a C99 program: loads a model, advances one cell, packs an RVE, provokes errors, frees everything. */
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

static void surrogates(void)
{
    enum { most = 64 };
    const double porosity = 0.125, fabric_index = 0.05, strain = 1e-3;
    double columns[most], conductivity = -1, stress = -1, solid = -1;
    double *state[most];
    const double *before[most];
    msdd_surrogate *surrogate = NULL;
    msdd_material material = {sizeof(msdd_material), 100, 1e7, 5e-3};
    msdd_initial initial;
    msdd_batch batch;
    size_t size, k;

    EXPECT(msdd_surrogate_load("/no/such/model.json", &surrogate) == MSDD_IO);
    EXPECT(surrogate == NULL && strstr(msdd_last_error(), "/no/such/model.json") != NULL);
    EXPECT(msdd_surrogate_load(NULL, &surrogate) == MSDD_OK);
    EXPECT(strlen(msdd_surrogate_hash(surrogate)) == 64);
    EXPECT(msdd_surrogate_describe(surrogate)[0] == '{');
    size = msdd_surrogate_state_size(surrogate);
    EXPECT(size >= 2 && size <= most);
    EXPECT(strcmp(msdd_surrogate_state_name(surrogate, 0), "porosity") == 0);
    EXPECT(msdd_surrogate_state_name(surrogate, size) == NULL);
    for (k = 0; k < most; k++) {
        before[k] = state[k] = &columns[k];
    }

    memset(&initial, 0, sizeof initial);
    initial.struct_size = sizeof initial;
    initial.cells = 1;
    initial.porosity = &porosity;
    initial.fabric_index = &fabric_index;
    EXPECT(msdd_surrogate_initial_state(surrogate, &material, &initial, state) == MSDD_OK);
    EXPECT(columns[0] == porosity && columns[1] == fabric_index);

    memset(&batch, 0, sizeof batch);
    batch.struct_size = sizeof batch;
    batch.cells = 1;
    batch.state = before;
    batch.next_state = state;
    batch.thermal_strain = &strain;
    batch.conductivity_xx = &conductivity;
    batch.stress_yy = &stress;
    EXPECT(msdd_surrogate_advance(surrogate, &material, &batch) == MSDD_OK);
    EXPECT(columns[0] < porosity && conductivity > 5 && conductivity < 100);
    EXPECT(stress >= 0 && stress < 1e5);

    EXPECT(msdd_surrogate_solid_fraction(surrogate, 1, &porosity, &solid) == MSDD_OK);
    EXPECT(solid > 1 - porosity && solid < 1);

    batch.struct_size = 1;
    EXPECT(msdd_surrogate_advance(surrogate, &material, &batch) == MSDD_INVALID_ARGUMENT);
    EXPECT(strstr(msdd_last_error(), "struct_size = 1") != NULL);
    EXPECT(msdd_surrogate_advance(NULL, &material, &batch) == MSDD_INVALID_ARGUMENT);
    EXPECT(msdd_surrogate_hash(NULL) == NULL);

    msdd_surrogate_free(surrogate);
    msdd_surrogate_free(NULL);
}

static void rves(void)
{
    msdd_rve *rve = NULL, *copy = NULL;
    msdd_averages before, after;
    char *text = NULL;
    int32_t outcome = -1;

    EXPECT(msdd_rve_pack("{\"discs\": 40, \"shape\": 1}", &rve) == MSDD_INVALID_ARGUMENT && rve == NULL);
    EXPECT(msdd_rve_pack("{\"discs\": 40, \"porosity\": 0.13}", &rve) == MSDD_OK);
    before.struct_size = after.struct_size = sizeof before;
    EXPECT(msdd_rve_homogenise(rve, &before) == MSDD_OK);
    EXPECT(msdd_rve_to_json(rve, &text) == MSDD_OK);
    EXPECT(msdd_rve_from_json(text, &copy) == MSDD_OK);
    msdd_text_free(text);
    EXPECT(msdd_rve_strain(copy, 0.01, 0, 0, 0, &outcome) == MSDD_OK && outcome == MSDD_SETTLED);
    EXPECT(msdd_rve_homogenise(copy, &after) == MSDD_OK);
    EXPECT(after.pressure > before.pressure && after.porosity < before.porosity);
    msdd_rve_free(copy);
    msdd_rve_free(rve);
    msdd_rve_free(NULL);
}

int main(void)
{
    EXPECT(msdd_abi_version() == MSDD_ABI_VERSION);
    EXPECT(strlen(msdd_version()) >= 5);
    EXPECT(strcmp(msdd_last_error(), "") == 0);
    surrogates();
    rves();
    printf("header.c: %s\n", failures ? "FAILED" : "ok");
    return failures != 0;
}
