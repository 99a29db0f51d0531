/* MSDD: names of version 4 of the C interface, as wrappers of version 5. msdd.h includes this file, for one release.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef MSDD_V4_H
#define MSDD_V4_H

#ifndef MSDD_H
#error "include msdd.h"
#endif

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct msdd_model msdd_surrogate;
typedef struct msdd_model msdd_spheres;

typedef struct msdd_material {
    size_t struct_size;
    double thermal_conductivity, young_modulus, mean_radius;
} msdd_material;

typedef struct msdd_batch {
    size_t struct_size, cells;
    const double *const *state;
    const double *thermal_strain, *total_thermal_strain, *strain_xx, *strain_yy, *strain_xy, *rotation;
    double *const *next_state;
    double *conductivity_xx, *conductivity_yy, *conductivity_xy, *stress_xx, *stress_yy, *stress_xy;
    double *const *tangent;
    uint8_t *clamped;
    double *const *outside;
    double *spread;
    size_t clamped_cells;
} msdd_batch;

typedef struct msdd_initial {
    size_t struct_size, cells;
    const double *porosity, *fabric_index, *fabric_xy, *stress_xx, *stress_yy, *stress_xy;
    const double *conductivity_xx, *conductivity_yy, *conductivity_xy;
} msdd_initial;

typedef struct msdd_sphere_material {
    size_t struct_size;
    double diameter, young_modulus, poisson_ratio, conductivity, roughness, hardness;
    const char *gas;
    double gas_pressure, accommodation, emissivity, size_spread;
} msdd_sphere_material;

typedef struct msdd_sphere_batch {
    size_t struct_size, cells;
    const double *const *state;
    const double *thermal_strain;
    const double *const *strain;
    const double *const *rotation;
    const double *temperature, *solid_conductivity, *emissivity;
    double *const *next_state;
    double *const *stress;
    double *const *tangent;
    double *const *conductivity;
    double *gas_conductivity, *radiation_conductivity, *solid_fraction;
    uint8_t *outside;
    size_t outside_cells;
} msdd_sphere_batch;

/* Contiguous columns as those of version 5; NULL for a table that is not given. No model has more than 64 state columns. */
#define MSDD_V4_COLUMNS 65

static inline msdd_input msdd_v4_input(const double *values)
{
    msdd_input column;
    column.values = values;
    column.stride = 1;
    return column;
}

static inline msdd_output msdd_v4_output(double *values)
{
    msdd_output column;
    column.values = values;
    column.stride = 1;
    return column;
}

static inline const msdd_input *msdd_v4_inputs(msdd_input *table, const double *const *columns, size_t count)
{
    size_t k;
    for (k = 0; columns != NULL && k < count; ++k)
    {
        table[k] = msdd_v4_input(columns[k]);
    }
    return columns != NULL ? table : NULL;
}

static inline const msdd_output *msdd_v4_outputs(msdd_output *table, double *const *columns, size_t count)
{
    size_t k;
    for (k = 0; columns != NULL && k < count; ++k)
    {
        table[k] = msdd_v4_output(columns[k]);
    }
    return columns != NULL ? table : NULL;
}

/* A struct_size that the function of version 5 accepts if that of version 4 is right, and refuses else. */
#define MSDD_V4_SIZE(given, old, now) ((given)->struct_size == sizeof(old) ? sizeof(now) : (given)->struct_size)

static inline msdd_grains msdd_v4_discs(const msdd_material *material)
{
    msdd_grains grains;
    memset(&grains, 0, sizeof grains);
    grains.struct_size = MSDD_V4_SIZE(material, msdd_material, msdd_grains);
    grains.conductivity = material->thermal_conductivity;
    grains.young_modulus = material->young_modulus;
    grains.radius = material->mean_radius;
    return grains;
}

static inline msdd_grains msdd_v4_grains(const msdd_sphere_material *material)
{
    msdd_grains grains;
    memset(&grains, 0, sizeof grains);
    grains.struct_size = MSDD_V4_SIZE(material, msdd_sphere_material, msdd_grains);
    grains.conductivity = material->conductivity;
    grains.young_modulus = material->young_modulus;
    grains.radius = 0.5 * material->diameter;
    grains.poisson_ratio = material->poisson_ratio;
    grains.roughness = material->roughness;
    grains.hardness = material->hardness;
    grains.gas = material->gas;
    grains.gas_pressure = material->gas_pressure;
    grains.accommodation = material->accommodation;
    grains.emissivity = material->emissivity;
    grains.size_spread = material->size_spread;
    return grains;
}

static inline int32_t msdd_surrogate_load(const char *source, msdd_surrogate **out) { return msdd_model_load(source, out); }

static inline int32_t msdd_surrogate_with_conductivity(const msdd_surrogate *surrogate, const char *kind, msdd_surrogate **out)
{
    return msdd_model_with_conductivity(surrogate, kind, out);
}

static inline const char *msdd_surrogate_hash(const msdd_surrogate *surrogate) { return msdd_model_hash(surrogate); }
static inline const char *msdd_surrogate_describe(const msdd_surrogate *surrogate) { return msdd_model_describe(surrogate); }
static inline size_t msdd_surrogate_state_size(const msdd_surrogate *surrogate) { return msdd_model_state_size(surrogate); }
static inline const char *msdd_surrogate_state_name(const msdd_surrogate *surrogate, size_t column)
{
    return msdd_model_state_name(surrogate, column);
}
static inline int32_t msdd_surrogate_has_tangent(const msdd_surrogate *surrogate) { return msdd_model_has_tangent(surrogate); }

static inline int32_t msdd_surrogate_wall_friction(const msdd_surrogate *surrogate, const msdd_material *material, double *limit,
                                                   double *slip)
{
    msdd_grains grains;
    if (material == NULL)
    {
        return msdd_model_wall_friction(surrogate, NULL, limit, slip);
    }
    grains = msdd_v4_discs(material);
    return msdd_model_wall_friction(surrogate, &grains, limit, slip);
}

static inline int32_t msdd_surrogate_initial_state(const msdd_surrogate *surrogate, const msdd_material *material,
                                                   const msdd_initial *initial, double *const *state)
{
    msdd_output columns[MSDD_V4_COLUMNS];
    msdd_input stress[3], conductivity[3];
    msdd_start start;
    msdd_grains grains;
    if (material == NULL || initial == NULL)
    {
        return msdd_model_initial_state(surrogate, NULL, NULL, NULL);
    }
    grains = msdd_v4_discs(material);
    memset(&start, 0, sizeof start);
    start.struct_size = MSDD_V4_SIZE(initial, msdd_initial, msdd_start);
    start.cells = initial->cells;
    start.components = 3;
    start.porosity = msdd_v4_input(initial->porosity);
    start.fabric_index = msdd_v4_input(initial->fabric_index);
    start.fabric_xy = msdd_v4_input(initial->fabric_xy);
    stress[0] = msdd_v4_input(initial->stress_xx);
    stress[1] = msdd_v4_input(initial->stress_yy);
    stress[2] = msdd_v4_input(initial->stress_xy);
    start.stress = stress;
    conductivity[0] = msdd_v4_input(initial->conductivity_xx);
    conductivity[1] = msdd_v4_input(initial->conductivity_yy);
    conductivity[2] = msdd_v4_input(initial->conductivity_xy);
    start.conductivity = conductivity;
    return msdd_model_initial_state(surrogate, &grains, &start,
                                    msdd_v4_outputs(columns, state, msdd_model_state_size(surrogate)));
}

static inline int32_t msdd_surrogate_advance(const msdd_surrogate *surrogate, const msdd_material *material, msdd_batch *batch)
{
    msdd_input state[MSDD_V4_COLUMNS], strain[3], rotation;
    msdd_output next_state[MSDD_V4_COLUMNS], distance[MSDD_V4_COLUMNS], tangent[9], stress[3], conductivity[3];
    const size_t size = msdd_model_state_size(surrogate);
    msdd_step step;
    msdd_grains grains;
    int32_t status;
    if (material == NULL || batch == NULL)
    {
        return msdd_model_advance(surrogate, NULL, NULL);
    }
    grains = msdd_v4_discs(material);
    memset(&step, 0, sizeof step);
    step.struct_size = MSDD_V4_SIZE(batch, msdd_batch, msdd_step);
    step.cells = batch->cells;
    step.components = 3;
    step.state = msdd_v4_inputs(state, batch->state, size);
    step.thermal_strain = msdd_v4_input(batch->thermal_strain);
    step.total_thermal_strain = msdd_v4_input(batch->total_thermal_strain);
    strain[0] = msdd_v4_input(batch->strain_xx);
    strain[1] = msdd_v4_input(batch->strain_yy);
    strain[2] = msdd_v4_input(batch->strain_xy);
    step.strain = strain;
    rotation = msdd_v4_input(batch->rotation);
    step.rotation = &rotation;
    step.next_state = msdd_v4_outputs(next_state, batch->next_state, size);
    conductivity[0] = msdd_v4_output(batch->conductivity_xx);
    conductivity[1] = msdd_v4_output(batch->conductivity_yy);
    conductivity[2] = msdd_v4_output(batch->conductivity_xy);
    step.conductivity = conductivity;
    stress[0] = msdd_v4_output(batch->stress_xx);
    stress[1] = msdd_v4_output(batch->stress_yy);
    stress[2] = msdd_v4_output(batch->stress_xy);
    step.stress = stress;
    step.tangent = msdd_v4_outputs(tangent, batch->tangent, 9);
    step.outside = batch->clamped;
    step.distance = msdd_v4_outputs(distance, batch->outside, size + 1);
    step.spread = msdd_v4_output(batch->spread);
    status = msdd_model_advance(surrogate, &grains, &step);
    if (status == MSDD_OK)
    {
        batch->clamped_cells = step.outside_cells;
    }
    return status;
}

static inline int32_t msdd_surrogate_solid_fraction(const msdd_surrogate *surrogate, size_t cells, const double *porosity,
                                                    double *solid_fraction)
{
    return msdd_model_solid_fraction(surrogate, cells, porosity, solid_fraction);
}

static inline void msdd_surrogate_free(msdd_surrogate *surrogate) { msdd_model_free(surrogate); }

/* A file of another kind of model is loaded, too; the functions below then refuse it by its components. */
static inline int32_t msdd_spheres_load(const char *source, msdd_spheres **out)
{
    const char *const builtin = "builtin";
    size_t k = 0;
    while (source != NULL && builtin[k] != '\0' && source[k] == builtin[k])
    {
        ++k;
    }
    return msdd_model_load(source == NULL || (builtin[k] == '\0' && source[k] == '\0') ? "builtin:spheres" : source, out);
}

static inline const char *msdd_spheres_hash(const msdd_spheres *spheres) { return msdd_model_hash(spheres); }
static inline const char *msdd_spheres_describe(const msdd_spheres *spheres) { return msdd_model_describe(spheres); }
static inline size_t msdd_spheres_state_size(const msdd_spheres *spheres) { return msdd_model_state_size(spheres); }
static inline const char *msdd_spheres_state_name(const msdd_spheres *spheres, size_t column)
{
    return msdd_model_state_name(spheres, column);
}

static inline int32_t msdd_spheres_initial_state(const msdd_spheres *spheres, const msdd_sphere_material *material, size_t cells,
                                                 const double *solid_fraction, const double *const *stress,
                                                 const double *coordination, const double *mobilised,
                                                 const double *const *fabric, double *const *state)
{
    msdd_output columns[MSDD_V4_COLUMNS];
    msdd_input stresses[6], normals[6];
    msdd_start start;
    msdd_grains grains;
    if (material == NULL)
    {
        return msdd_model_initial_state(spheres, NULL, NULL, NULL);
    }
    grains = msdd_v4_grains(material);
    memset(&start, 0, sizeof start);
    start.struct_size = sizeof(msdd_start);
    start.cells = cells;
    start.components = 6;
    start.solid_fraction = msdd_v4_input(solid_fraction);
    start.stress = msdd_v4_inputs(stresses, stress, 6);
    start.fabric = msdd_v4_inputs(normals, fabric, 6);
    start.coordination = msdd_v4_input(coordination);
    start.mobilised = msdd_v4_input(mobilised);
    return msdd_model_initial_state(spheres, &grains, &start,
                                    msdd_v4_outputs(columns, state, msdd_model_state_size(spheres)));
}

static inline int32_t msdd_spheres_advance(const msdd_spheres *spheres, const msdd_sphere_material *material,
                                           msdd_sphere_batch *batch)
{
    msdd_input state[MSDD_V4_COLUMNS], strain[6], rotation[3];
    msdd_output next_state[MSDD_V4_COLUMNS], tangent[36], stress[6], conductivity[6];
    const size_t size = msdd_model_state_size(spheres);
    msdd_step step;
    msdd_grains grains;
    int32_t status;
    if (material == NULL || batch == NULL)
    {
        return msdd_model_advance(spheres, NULL, NULL);
    }
    grains = msdd_v4_grains(material);
    memset(&step, 0, sizeof step);
    step.struct_size = MSDD_V4_SIZE(batch, msdd_sphere_batch, msdd_step);
    step.cells = batch->cells;
    step.components = 6;
    step.state = msdd_v4_inputs(state, batch->state, size);
    step.thermal_strain = msdd_v4_input(batch->thermal_strain);
    step.strain = msdd_v4_inputs(strain, batch->strain, 6);
    step.rotation = msdd_v4_inputs(rotation, batch->rotation, 3);
    step.temperature = msdd_v4_input(batch->temperature);
    step.solid_conductivity = msdd_v4_input(batch->solid_conductivity);
    step.emissivity = msdd_v4_input(batch->emissivity);
    step.next_state = msdd_v4_outputs(next_state, batch->next_state, size);
    step.stress = msdd_v4_outputs(stress, batch->stress, 6);
    step.tangent = msdd_v4_outputs(tangent, batch->tangent, 36);
    step.conductivity = msdd_v4_outputs(conductivity, batch->conductivity, 6);
    step.gas_conductivity = msdd_v4_output(batch->gas_conductivity);
    step.radiation_conductivity = msdd_v4_output(batch->radiation_conductivity);
    step.solid_fraction = msdd_v4_output(batch->solid_fraction);
    step.outside = batch->outside;
    status = msdd_model_advance(spheres, &grains, &step);
    if (status == MSDD_OK)
    {
        batch->outside_cells = step.outside_cells;
    }
    return status;
}

static inline void msdd_spheres_free(msdd_spheres *spheres) { msdd_model_free(spheres); }

static inline int32_t msdd_spheres_wall_resistance(const msdd_sphere_material *material, const msdd_sphere_wall *wall,
                                                   size_t faces, const double *stress, const double *temperature,
                                                   const double *conductivity, double *resistance)
{
    msdd_grains grains;
    if (material == NULL)
    {
        return msdd_wall_resistance(NULL, wall, faces, stress, temperature, conductivity, resistance);
    }
    grains = msdd_v4_grains(material);
    return msdd_wall_resistance(&grains, wall, faces, stress, temperature, conductivity, resistance);
}

#ifdef __cplusplus
}
#endif

#endif
