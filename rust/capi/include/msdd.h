/* MSDD: surrogate models of granular representative volume elements (RVEs).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Conventions
 *  - Every function that can fail returns an int32_t status: MSDD_OK (0) or one of enum msdd_status.
 *    The text of the last failure on the calling thread is in msdd_last_error().
 *  - Outputs are written only on success.
 *  - Handles are opaque and immutable once loaded: any number of threads may read one at a time.
 *  - Structs that may grow start with struct_size; set it to sizeof the struct.
 *  - SI units. Compression is positive. Nothing here prints, starts threads or installs handlers.
 *  - Floating-point exceptions must be masked while a function runs (the IEEE default). A program that traps them
 *    (OpenFOAM does) masks them around each call; the C++ wrapper msdd.hpp does it for you.
 */
#ifndef MSDD_H
#define MSDD_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Version of this interface. Compare with msdd_abi_version() before anything else is called. */
#define MSDD_ABI_VERSION 1u

enum msdd_status {
    MSDD_OK = 0,
    /** A null pointer, a wrong struct_size, or a parameter outside its allowed range. */
    MSDD_INVALID_ARGUMENT = 1,
    /** A file could not be read. */
    MSDD_IO = 2,
    /** A model file was read but is damaged, of another schema, or inconsistent. */
    MSDD_MODEL = 3,
    /** An input column holds NaN or infinity; the text names column and index. */
    MSDD_NON_FINITE = 4,
    /** A bug on our side (a caught panic). */
    MSDD_INTERNAL = 255
};

/** A loaded surrogate model: opaque, immutable. */
typedef struct msdd_surrogate msdd_surrogate;

/** Scales that turn the model's dimensionless answers into SI. */
typedef struct msdd_material {
    size_t struct_size;          /**< sizeof(msdd_material) */
    double thermal_conductivity; /**< k of the grains [W/(m K)], > 0 */
    double young_modulus;        /**< E of the grains [Pa], > 0 */
    double mean_radius;          /**< mean grain radius in the initial state, r [m], > 0 */
} msdd_material;

/** One batch of cells: columns of length `cells`, each contiguous. Algorithm 1, steps 1 and 2, of the paper. */
typedef struct msdd_batch {
    size_t struct_size;                 /**< sizeof(msdd_batch) */
    size_t cells;                       /**< length of every column */
    /* in */
    const double *porosity;             /**< eta^n [-], overlaps counted once */
    const double *fabric_index;         /**< f^n = F_xx - F_yy [-] */
    const double *thermal_strain;       /**< epsilon^n [-]: radial strain of this increment, relative to the current radius */
    const double *total_thermal_strain; /**< alpha (T^n - T^0) [-], this increment included; NULL = 0 everywhere */
    /* out; any of them may be NULL when not wanted */
    double *delta_porosity;             /**< eta^{n+1} - eta^n [-] */
    double *delta_fabric_index;         /**< f^{n+1} - f^n [-] */
    double *conductivity_xx;            /**< K_xx^{n+1} [W/(m K)] */
    double *conductivity_yy;            /**< K_yy^{n+1} [W/(m K)] */
    double *stress_xx;                  /**< sigma_xx^{n+1} [Pa], compression positive */
    double *stress_yy;                  /**< sigma_yy^{n+1} [Pa], compression positive */
    uint8_t *clamped;                   /**< 1 where an input lay outside the trained range and was clamped to it, else 0 */
    size_t clamped_cells;               /**< out: number of such cells in this batch */
} msdd_batch;

/** Version of the interface the library was built with; equals MSDD_ABI_VERSION when header and library agree. */
uint32_t msdd_abi_version(void);

/** Version of the library, for example "0.1.0". Static storage. */
const char *msdd_version(void);

/** Text of the last failure on this thread, "" if none. Valid until the next msdd call on this thread. */
const char *msdd_last_error(void);

/** Loads a model. `source`: NULL or "builtin" for the model compiled into the library, else a path of a model file.
 *  On success *out owns the model; free it with msdd_surrogate_free. */
int32_t msdd_surrogate_load(const char *source, msdd_surrogate **out);

/** SHA-256 of the model file's bytes, 64 hexadecimal digits. Owned by the model. NULL for a null handle. */
const char *msdd_surrogate_hash(const msdd_surrogate *surrogate);

/** Description of the model (name, trained range, material, provenance) as one JSON object. Owned by the model.
 *  NULL for a null handle. */
const char *msdd_surrogate_describe(const msdd_surrogate *surrogate);

/** Evaluates the model for every cell of the batch. Cells are independent: a cell's answer does not depend on the
 *  batch it is in. */
int32_t msdd_surrogate_evaluate(const msdd_surrogate *surrogate, const msdd_material *material, msdd_batch *batch);

/** Solid fraction with overlaps counted twice (sum of grain areas over area [-]) of an initial state with the given
 *  porosity (overlaps once): a fit to the database. The bulk density that conserves mass is rho * solid_fraction. */
int32_t msdd_surrogate_solid_fraction(const msdd_surrogate *surrogate, size_t cells, const double *porosity,
                                      double *solid_fraction);

/** Frees a model; NULL is allowed. */
void msdd_surrogate_free(msdd_surrogate *surrogate);

#ifdef __cplusplus
}
#endif

#endif
