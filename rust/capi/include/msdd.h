/* MSDD: representative volume elements (RVEs) of granular media, and surrogate models of them.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef MSDD_H
#define MSDD_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Conventions:
 *  - Every function that can fail returns an int32_t status: MSDD_OK (0) or one of enum msdd_status.
 *    The text of the last failure on the calling thread is in msdd_last_error().
 *  - Outputs are written only on success.
 *  - Handles are opaque pointers. A model never changes, so any number of threads may use the same one at the same
 *    time. An RVE changes, so only one thread at a time may use it.
 *  - Every struct starts with struct_size. Set it to sizeof the struct, and every member that you do not use to 0.
 *  - A cell is a point of the heat problem with its own state, for example a cell of a finite volume mesh.
 *  - A column is an array with one value per cell; in msdd_input and msdd_output with a stride, else contiguous.
 *  - SI units; strains have no unit. Strain: extension positive. Stress: compression positive.
 *  - No function prints or handles signals, and none starts threads unless their number is one of its arguments.
 *  - Floating-point exceptions must be masked while a function runs (the IEEE default). A program that traps them
 *    (OpenFOAM does) masks them around each call; the C++ wrapper msdd.hpp does it for you.
 */

/** Version of this interface. Compare with msdd_abi_version() before anything else is called. */
#define MSDD_ABI_VERSION 5u

enum msdd_status {
    MSDD_OK = 0,
    /** A null pointer, a wrong struct_size, or a parameter outside its allowed range. */
    MSDD_INVALID_ARGUMENT = 1,
    /** A file could not be read or written. */
    MSDD_IO = 2,
    /** A model file was read but is damaged, of another schema, or inconsistent. */
    MSDD_MODEL = 3,
    /** An input column holds NaN or infinity; the text names column and index. */
    MSDD_NON_FINITE = 4,
    /** An RVE could not be packed or strained (the simulation diverged, the grains found no room, or the target was not
     *  reached), or a text is not a valid state, specification or plan. */
    MSDD_RVE = 5,
    /** The progress call-back asked to stop. The packings finished until then are kept. */
    MSDD_CANCELLED = 6,
    /** A file is not a plug-in, or the plug-in has another interface version, failed, or returned a value that no packing
     *  of grains can have. */
    MSDD_PLUGIN = 7,
    /** A bug in this library (a caught Rust panic). */
    MSDD_INTERNAL = 255
};

/** Version of the interface the library was built with; equals MSDD_ABI_VERSION when header and library agree. */
uint32_t msdd_abi_version(void);

/** Version of the library, for example "0.1.0". Static storage. */
const char *msdd_version(void);

/** Text of the last failure on this thread, "" if none. Valid until the next msdd call on this thread. */
const char *msdd_last_error(void);

/** Frees a text that a function of this header returned through a char **; NULL is allowed. */
void msdd_text_free(char *text);

/* ------------------------------------------------------------------------------------------------------- models */

/** A loaded model of discs, of spheres, or of a plug-in: opaque, immutable. */
typedef struct msdd_model msdd_model;

/** A column that is read: the value of cell i is values[i * stride]. A contiguous array has the stride 1, a component in an array
 *  of symmetric tensors 6. A stride of 0 is refused. */
typedef struct msdd_input {
    const double *values; /**< NULL: not given */
    size_t stride;        /**< in doubles */
} msdd_input;

/** A column that is written, at a stride like those of msdd_input. */
typedef struct msdd_output {
    double *values; /**< NULL: not wanted */
    size_t stride;  /**< in doubles */
} msdd_output;

/** Grains, and the gas between them. Models of discs use the first three numbers alone: then the others, and the gas, may be 0. */
typedef struct msdd_grains {
    size_t struct_size;   /**< sizeof(msdd_grains) */
    double conductivity;  /**< thermal, of the grains, k [W/(m K)], 1e-12 to 1e12 */
    double young_modulus; /**< E of the grains [Pa], 1e-9 to 1e15 */
    double radius;        /**< mean radius in the initial state [m], 1e-12 to 1e6; of unequal spheres half of the Sauter mean
                               diameter, sum d^3/sum d^2; of spheres 5e-10 to 500 */
    double poisson_ratio; /**< -0.99 to 0.5 */
    double roughness;     /**< height of the asperities (root mean square) over their slope [m], 0 to 1; 0: smooth */
    double hardness;      /**< of the rough surface [Pa], 1 to 1e15; not used when smooth */
    const char *gas;      /**< "air", "nitrogen", "helium", "argon" or "vacuum"; NULL = "vacuum" */
    double gas_pressure;  /**< [Pa], 1e-3 to 1e9; not used in a vacuum */
    double accommodation; /**< of the gas at the spheres, 0.01 to 1; not used in a vacuum */
    double emissivity;    /**< of the spheres, opaque, grey and diffuse, 0 to 1; 0: without radiation */
    double size_spread;   /**< standard deviation of the diameters over their mean, both weighted by surface, 0 to 0.25; 0: equal
                               spheres */
} msdd_grains;

/** Inputs and outputs of one step of a batch of cells: steps 1 and 2 of Algorithm 1 of the paper.
 *
 *  `components`, 3 or 6, is the number of components of stress and strain (msdd_model_components): in the plane xx, yy, xy; in space
 *  xx, yy, zz, xy, xz, yz. Tables of tensors have as many columns. Shears of strains are twice those of the tensor,
 *  du_x/dy + du_y/dx and so on.
 *
 *  The state of a cell is what the model carries from step to step: msdd_model_state_size columns without unit, named by
 *  msdd_model_state_name. Outputs do not overlap each other. An output may be exactly the column of an input, as in a step in
 *  place, and otherwise does not overlap inputs; columns may interleave. An input that a model does not use is ignored, an output
 *  that it does not compute is refused.
 *
 *  Discs accept any finite state. Its first two columns are porosity (the overlap of two grains counted once) and fabric_index
 *  (F_xx - F_yy, the difference of the diagonal components of the fabric tensor). An input outside of the trained range, also one
 *  that no packing has, such as a porosity of 2, is reported in `outside` and `distance`. Networks are evaluated at the nearest end
 *  of that range, the incremental model as far as its parameters make sense.
 *  Spheres refuse states outside of: jamming_fraction 0.3 to 0.8, elastic_compression -0.9 to 0.5, strength 0.01 to 8, mobilised 0
 *  to 1, coordination 0 to 12, stress ratios -2 to 2. Each state that is answered lies inside. */
typedef struct msdd_step {
    size_t struct_size;              /**< sizeof(msdd_step) */
    size_t cells;                    /**< length of every column */
    size_t components;               /**< that of the model */
    /* in; a column or table that is not given is 0 unless said otherwise */
    const msdd_input *state;         /**< state columns before the step; needed */
    msdd_input thermal_strain;       /**< radial strain of the grains in this step, relative to the current radius; of spheres
                                          above -0.2, to 0.2 */
    msdd_input total_thermal_strain; /**< of discs: alpha (T - T0), this step included; above -1, to 10 */
    const msdd_input *strain;        /**< strain of the cell in this step, above -0.2, to 0.2; only for a model with a tangent */
    const msdd_input *rotation;      /**< angle by which the cell turns, half of the curl of the displacement [rad], above -0.2, to
                                          0.2: in the plane one column, counter-clockwise positive, in space three columns */
    msdd_input temperature;          /**< of spheres, of the gas [K], 0 to 1e5; NULL = 293.15. Beyond the temperatures at which the
                                          gas is known the nearest of them is taken */
    msdd_input solid_conductivity;   /**< of the spheres in this cell [W/(m K)], 1e-12 to 1e12; NULL = that of the material */
    msdd_input emissivity;           /**< of the spheres in this cell, 0 to 1; NULL = that of the material */
    /* out; any table and any column in it may be NULL when not wanted */
    const msdd_output *next_state;   /**< state columns after the step */
    const msdd_output *stress;       /**< after the step [Pa] */
    const msdd_output *tangent;      /**< components^2 columns [Pa], row by row: -d sigma_i/d strain_j at the end of the step. Only
                                          for a model that has a tangent. It is the derivative of exactly the stress that is
                                          answered, and where grains slide it is not symmetric */
    const msdd_output *conductivity; /**< after the step [W/(m K)]; of spheres by contacts, gas and radiation together */
    msdd_output gas_conductivity;    /**< of spheres: the part by the gas [W/(m K)], its mean over directions: there is more of it
                                          where contacts point */
    msdd_output radiation_conductivity; /**< of spheres: the part by radiation, equal in all directions [W/(m K)] */
    msdd_output solid_fraction;      /**< of spheres: their volume over the volume [-] */
    msdd_output spread;              /**< relative standard deviation of K between RVEs of equal state; NaN if the model does not
                                          give it. Takes longer than all other outputs together */
    const msdd_output *distance;     /**< of discs: state_size + 1 columns, the last for thermal_strain: distance of the input from
                                          the trained range, in the input's own unit, negative below and positive above; 0 inside */
    uint8_t *outside;                /**< contiguous. Of discs 1 where an input lies outside the trained range, else 0. Of spheres
                                          what is outside, as a sum: 1 the jamming fraction, 2 the pressure, 4 the stress ratio
                                          after the step; 8 the gas: its number, or where it is so thin that its molecules fly from
                                          grain to grain, or colder or hotter than its properties are known */
    size_t outside_cells;            /**< number of these cells. Of spheres, where stress or tangent are wanted, but neither
                                          conductivities nor `outside`, the gas is not looked at */
} msdd_step;

/** What is known of the cells at the start. A value outside its range is refused, with column and index in the message: an initial
 *  state that no packing has is a mistake, whereas a state may leave the trained range in the course of a calculation. For a
 *  quantity that is not given, that of usual packings is used. */
typedef struct msdd_start {
    size_t struct_size;             /**< sizeof(msdd_start) */
    size_t cells;                   /**< length of every column */
    size_t components;              /**< as in msdd_step */
    msdd_input porosity;            /**< of discs, needed: overlaps counted once, 0 to 1 */
    msdd_input fabric_index;        /**< of discs, needed: F_xx - F_yy, -1 to 1 */
    msdd_input fabric_xy;           /**< of discs: F_xy, -1 to 1; NULL = 0 */
    msdd_input solid_fraction;      /**< of spheres, needed: volume of the spheres over the volume, 0.3 to 0.8 */
    const msdd_input *stress;       /**< [Pa], -1e30 to 1e30. Of spheres needed; a pressure of 0 or less is that of spheres that
                                         just do not touch. Of discs xx and yy both or none; a shear that is not given is 0 */
    const msdd_input *conductivity; /**< of discs [W/(m K)], xx and yy above 0, to 1e30, both or none. A packing that conducts better
                                         than others of its state keeps doing so */
    const msdd_input *fabric;       /**< of spheres: mean of n n over the contacts, with the normals n, -1 to 1 */
    msdd_input coordination;        /**< of spheres: contacts per sphere, all spheres counted, 0 to 12; NULL: as in periodic boxes
                                         (beds that were poured under gravity have 0.4 contacts a sphere more) */
    msdd_input mobilised;           /**< of spheres: the mobilised part of the friction, 0 to 1; NULL: 0.85, as in beds that were
                                         poured */
} msdd_start;

/** Loads a model. `source`: NULL or "builtin" for the default model of discs compiled into the library ("builtin:increment";
 *  "builtin:paper" is the network of the paper), "builtin:spheres" for the model of spheres; "plugin:" and the path of a shared
 *  library that defines msdd_plugin_v2_table, see the end of this header; else the path of a model file, which contains data and
 *  no code. The model of spheres holds for spheres of any size and material with a friction of about 0.3, whose diameters are equal
 *  or differ a little (size_spread of msdd_grains). On success *out owns the model; free it with msdd_model_free.
 *  Loading a plug-in runs its code, with all rights of this process: pass no `source` that a stranger chose. */
int32_t msdd_model_load(const char *source, msdd_model **out);

/** Makes a copy of a model that computes another kind of conductivity: "affine" (Eq. 9 of the paper, an upper bound) or
 *  "network" (the resistor network of the contacts solved). msdd_model_describe lists the kinds that the model was
 *  trained for as "conductivities"; any other fails with MSDD_INVALID_ARGUMENT. The state columns are
 *  those of the original. On success *out owns the new handle; either handle may be freed first. */
int32_t msdd_model_with_conductivity(const msdd_model *model, const char *kind, msdd_model **out);

/** SHA-256 of the bytes of the model file or plug-in, 64 hexadecimal digits. Owned by the model. NULL for a null handle. */
const char *msdd_model_hash(const msdd_model *model);

/** Description of the model as one JSON object: of discs and plug-ins kind, name, state columns, conductivities, trained_range,
 *  provenance; of spheres the model file. Owned by the model. NULL for a null handle. */
const char *msdd_model_describe(const msdd_model *model);

/** Number of state columns, at least 2; 0 for a null handle. */
size_t msdd_model_state_size(const msdd_model *model);

/** Name of a state column, counted from 0, for example "porosity". Owned by the model. NULL beyond the last column. */
const char *msdd_model_state_name(const msdd_model *model, size_t column);

/** Number of components of stress and strain: 3 for a model of the plane (discs, plug-ins), 6 in space; 0 for a null handle. */
size_t msdd_model_components(const msdd_model *model);

/** 1 when the model has a mechanical tangent, else 0. */
int32_t msdd_model_has_tangent(const msdd_model *model);

/** Parameters of the friction coefficient that a wall mobilises after the slip s [m] of the grains along it,
 *  limit s/(s + slip): fitted to simulated boxes with slipping walls in the model's database. `limit` [-] and `slip` [m]
 *  may be NULL. Fails with MSDD_INVALID_ARGUMENT when the model has no such fit. */
int32_t msdd_model_wall_friction(const msdd_model *model, const msdd_grains *material, double *limit, double *slip);

/** Computes the initial state of cells. `state`: state_size columns. */
int32_t msdd_model_initial_state(const msdd_model *model, const msdd_grains *material, const msdd_start *start,
                                 const msdd_output *state);

/** Takes every cell of the batch through one step. Cells are independent: the result of a cell does not depend on the
 *  other cells of the batch. Zero strain leaves the state as it is, bit for bit.
 *  Spheres that conduct less than 20 times as well as the gas conduct by another law than better ones, those up to 60 times by a
 *  mixture of both; spheres that conduct less than the gas are refused. */
int32_t msdd_model_advance(const msdd_model *model, const msdd_grains *material, msdd_step *step);

/** Solid fraction (sum of the grains' areas or volumes over that of the region [-], overlaps counted twice) of an initial state with
 *  the given porosity (overlaps counted once; 0 to 1, else refused): of discs by a fit to the database, of spheres 1 - porosity.
 *  The bulk density that conserves mass is rho * solid_fraction, with rho the density of the grains. */
int32_t msdd_model_solid_fraction(const msdd_model *model, size_t cells, const double *porosity, double *solid_fraction);

/** Frees a model; NULL is allowed. */
void msdd_model_free(msdd_model *model);

/** The surface of a wall next to a bed of spheres. */
typedef struct msdd_sphere_wall {
    size_t struct_size;   /**< sizeof(msdd_sphere_wall) */
    double conductivity;  /**< of the wall [W/(m K)], 1e-12 to 1e12 */
    double young_modulus; /**< of the wall [Pa], 1e-9 to 1e15 */
    double poisson_ratio; /**< of the wall, -0.99 to 0.5 */
    double roughness;     /**< of sphere and wall together: height of the asperities (root mean square) over their slope [m], 0 to 1;
                               0: smooth */
    double hardness;      /**< of the softer of both surfaces [Pa], 1 to 1e15; not used when smooth */
    double spheres;       /**< spheres at the wall on the square of a diameter, 0.01 to 1.16 */
    double emissivity;    /**< of the wall, 0 to 1; it exchanges radiation with spheres whose emissivity is above 0 */
} msdd_sphere_wall;

/** What a wall adds to the resistance of a bed of spheres that has one conductivity up to its surface [m2 K/W], for each of `faces`
 *  faces: 0 at least and 1e9 at most. `stress`: normal to the wall [Pa], compression positive; of 0 or less: gas alone conducts.
 *  `temperature`: of the gas [K], 0 to 1e5. `conductivity`: of the bed across the wall [W/(m K)], 0 and above: where
 *  nothing conducts the resistance is 1e9. */
int32_t msdd_wall_resistance(const msdd_grains *material, const msdd_sphere_wall *wall, size_t faces, const double *stress,
                             const double *temperature, const double *conductivity, double *resistance);

/* ---------------------------------------------------------------------------------------------------------- RVEs */

/** A box of grains, simulated by DEM. */
typedef struct msdd_rve msdd_rve;

/** Averages over an RVE's averaging region. */
typedef struct msdd_averages {
    size_t struct_size;             /**< sizeof(msdd_averages) */
    double porosity;                /**< overlaps counted once [-] */
    double porosity_sum_of_areas;   /**< 1 - sum of grain areas / area of the box [-] */
    double fabric_index;            /**< F_xx - F_yy [-], Eq. 8 */
    double fabric_conductivity;     /**< (K_xx - K_yy)/(K_xx + K_yy), affine [-] */
    double conductivity_xx;         /**< K_xx/k, affine [-], Eq. 9 */
    double conductivity_yy;
    double conductivity_xy;
    double conductivity_network_xx; /**< K_xx/k, resistor network solved [-] */
    double conductivity_network_yy;
    double conductivity_network_xy;
    double stress_xx;               /**< [Pa], Eq. 10 */
    double stress_yy;
    double stress_xy;
    double stress_yx;
    double pressure;                /**< (stress_xx + stress_yy)/2 [Pa] */
    double coordination;            /**< mean number of contacts of a grain, over the grains that have any [-] */
    double mean_radius;             /**< current [m] */
    uint64_t rattlers;              /**< grains without contact */
    uint64_t contacts;              /**< between grains, in the region */
} msdd_averages;

/** How a strain of an RVE ended. */
enum msdd_outcome {
    MSDD_SETTLED = 0,  /**< equilibrium: the forces on the grains balance */
    MSDD_CAPPED = 1,   /**< the largest number of time steps was reached before equilibrium */
    MSDD_UNJAMMED = 2  /**< the packing carries no load any more */
};

/** Packs an RVE. `specification` is a JSON object. Any of its keys, and any key of "material", may be left out and then
 *  has its default: "discs" 500, "seed" 1, "porosity" 0.12,
 *  "compression" "isotropic" (or "horizontal", "intermediate", "sheared"), "boundary" "walls" (or "periodic"), "radius_min" 3e-3,
 *  "radius_max" 7e-3 [m], "relaxation" "damped" (or "fire"), "material" {"density" 3000 [kg/m3], "young_modulus" 1e7 [Pa],
 *  "stiffness_ratio" 0.8, "friction_angle" 0.5 [rad], "wall_stiffness_factor" 1, "damping" 0.1}. NULL means "{}".
 *  The same specification always gives the same RVE, bit for bit. On success *out owns the RVE; free it with
 *  msdd_rve_free. */
int32_t msdd_rve_pack(const char *specification, msdd_rve **out);

/** Reads an RVE from the JSON text of a state file. */
int32_t msdd_rve_from_json(const char *text, msdd_rve **out);

/** Writes the RVE as the JSON text of a state file. An RVE read from this text behaves like the original, bit for bit.
 *  Free the text with msdd_text_free. */
int32_t msdd_rve_to_json(const msdd_rve *rve, char **out);

/** Copies an RVE. On success *out owns the copy; free it with msdd_rve_free. */
int32_t msdd_rve_clone(const msdd_rve *rve, msdd_rve **out);

/** Strains an RVE relative to its present state and then lets the grains move to equilibrium. `thermal` is the strain of
 *  the radii, `xx` and `yy` are those of the box along x and y, and `xy` shears a periodic box (displacement of its top
 *  along x over its height); each from -0.2 to 0.2. *outcome (may be NULL) is one of enum msdd_outcome. After a failure the
 *  RVE is as before. */
int32_t msdd_rve_strain(msdd_rve *rve, double thermal, double xx, double yy, double xy, int32_t *outcome);

/** Averages over the box without a margin of 0.8 mean radii at each wall, or over the whole of a periodic box. */
int32_t msdd_rve_homogenise(const msdd_rve *rve, msdd_averages *averages);

/** Frees an RVE; NULL is allowed. */
void msdd_rve_free(msdd_rve *rve);

/* ------------------------------------------------------------------------------------------------------ databases */

/** A function that is called after every finished packing, on the thread that called msdd_database_generate, with the
 *  numbers of packings that are done, wanted and failed. Any return value but 0 stops the generation. `user` is the pointer
 *  that was given there. The function must not throw or leave by longjmp. */
typedef int32_t (*msdd_progress)(void *user, uint64_t done, uint64_t total, uint64_t failed);

/** Generates the database of a plan (the text of a TOML file as in cases/database) in the file `path`, or continues one
 *  that was begun there, on `threads` threads (0 is taken as 1). `progress` may be NULL. */
int32_t msdd_database_generate(const char *plan, const char *path, uint32_t threads, msdd_progress progress,
                               void *user);

/** Writes a database as the CSV file `csv`, and next to it a description of its columns and its provenance. *rows (may be
 *  NULL) is set to the number of rows. If the name ends in .gz, the file is compressed. */
int32_t msdd_database_export_csv(const char *database, const char *csv, uint64_t *rows);

/* ------------------------------------------------------------------------------------------------------- training */

/** Trains a model, as `msdd train` does. `request` is a JSON object; all keys but the first may be left out:
 *
 *  "database"  list of databases, or of CSV files exported from them; for spheres also folders of beds of DEM
 *  "model"     "constant", "paper", "increment" (the default) or "spheres"
 *  "name"      of the model; by default its kind
 *  "seed"      of the split into training and held-out packings, 1
 *  "restarts", "epochs", "patience"   as the options of `msdd train`
 *  "fix"       object: parameters of the law of spheres that keep their values, for example {"lode": 0.45}
 *  "threads"   0 (the default): one per core; the result does not depend on it
 *
 *  *model receives the text of the model file; msdd_text_free frees it. */
int32_t msdd_train(const char *request, char **model);

/* ------------------------------------------------------------------------------------------------------- plug-ins */

/* A plug-in is a shared library with a surrogate model made by somebody else. It includes this header, needs nothing of
 * libmsdd, and defines one function, msdd_plugin_v2_table. Worked example: rust/capi/examples/effective_medium.c.
 *
 *  - Loading a plug-in runs its code in this process and with all its rights: load none that you would not run.
 *  - No SI units: a plug-in computes K/k and reduced stresses sigma l/(E r), with l = 1 m and r the current mean radius,
 *    compression positive. Only the library knows the material, and it converts. Strain: extension positive.
 *  - The functions of a plug-in return 0, or any other number for a failure, and may be called from several threads at
 *    once. Inputs are finite, and are copies that are valid only during the call. Columns are never NULL, except where
 *    this header says so. Outputs do not overlap inputs.
 *  - Cells are independent of each other. Zero strain leaves the state as it is, bit for bit. The same inputs give the
 *    same outputs, whatever was called before.
 *  - A plug-in is never unloaded. It must not throw, print, or leave by longjmp.
 *
 * The library checks the following in every call. If a check fails, the call returns MSDD_PLUGIN, its message names the
 * plug-in, column and cell, and nothing is written:
 *  - every output is finite; K/k is from 1e-30 to 1e30 in every direction, stresses from 0 (no tension in any direction)
 *    to 1e30, spreads are not negative, solid fractions are above 0 and at most 2;
 *  - porosity after a step is from 0 to 1 and fabric_index from -1 to 1, unless the cell's value before the step was
 *    already outside; an initial state has the porosity and fabric_index that were given;
 *  - the components of the tangent are from -1e30 to 1e30;
 *  - a strain of 0 keeps the state, unless the plug-in says in `outside` that the cell is outside of its range.
 * The library makes the first calls of initial_state and advance twice, and checks that both give the same bits.
 * It does not check whether results depend on other cells or, in later calls, on the number of calls; whether two strains
 * one after the other give the same state as their sum; whether the tangent is the derivative of the stress; or
 * what else the code does.
 *
 * Version 1 (msdd_plugin_v1_table: functions `tangent` and `deform`, no shear) is refused with a message that says so. */

#define MSDD_PLUGIN_VERSION 2u

/** What is known of cells at the start, and columns for their state. */
typedef struct msdd_plugin_start {
    size_t struct_size;                /**< sizeof(msdd_plugin_start) */
    size_t cells;                      /**< length of every column */
    const double *porosity;            /**< overlaps counted once */
    const double *fabric_index;        /**< F_xx - F_yy */
    const double *fabric_xy;           /**< F_xy; NULL = 0 */
    const double *stress_xx;           /**< reduced, compression positive; NULL = not known; all or none */
    const double *stress_yy;
    const double *stress_xy;
    const double *conductivity_xx;     /**< K_xx/k; NULL = not known; all or none */
    const double *conductivity_yy;
    const double *conductivity_xy;
    double *const *state;              /**< out: state_size columns; the first two are the given porosity and
                                            fabric_index, which a plug-in may not change */
} msdd_plugin_start;

/** A step. */
typedef struct msdd_plugin_step {
    size_t struct_size;           /**< sizeof(msdd_plugin_step) */
    size_t cells;                 /**< length of every column */
    const double *const *state;   /**< state_size columns before the step */
    const double *thermal_strain; /**< radial strain of the grains, relative to the current radius; above -1 */
    const double *strain_xx;      /**< strain of the cell, as in msdd_step; NULL = none of the four, always so for a plug-in
                                       without tangent */
    const double *strain_yy;
    const double *strain_xy;
    const double *rotation;
    double *const *next_state;    /**< out: state columns after the step */
    double *conductivity_xx;      /**< out: K_xx/k after the step, > 0 */
    double *conductivity_yy;
    double *conductivity_xy;      /**< out: 0 before the call, so a plug-in without it need not write it */
    double *stress_xx;            /**< out: reduced, after the step */
    double *stress_yy;
    double *stress_xy;            /**< out: 0 before the call */
    double *const *tangent;       /**< out: nine columns as in msdd_step, reduced; NULL = not wanted */
    double *const *outside;       /**< out: state_size + 1 columns, as `distance` in msdd_step; all 0 before the call, so a plug-in
                                       without limits need not write them */
} msdd_plugin_step;

/** Name, state columns and functions of a plug-in. The table and the texts that it points to have to stay valid as long as
 *  the process runs. */
typedef struct msdd_plugin_v2 {
    size_t struct_size;             /**< sizeof(msdd_plugin_v2) */
    uint32_t version;               /**< MSDD_PLUGIN_VERSION */
    uint32_t network_conductivity;  /**< kind of K: 1: resistor network solved; 0: affine, Eq. 9 of the paper */
    uint32_t has_tangent;           /**< 1: advance takes strains of the cell and computes the tangent; 0: it does neither */
    uint32_t reserved;              /**< 0 */
    const char *name;               /**< UTF-8 */
    size_t state_size;              /**< 2 to 64 */
    const char *const *state_names; /**< state_size texts; the first two are "porosity" and "fabric_index". A name is a
                                         letter, then letters, digits and underscores, at most 64 characters in all. No two
                                         may differ only in underscores or capitals, because msddFoam writes
                                         reduced_pressure as the field reducedPressure; it refuses the names of its own
                                         fields */
    /** Initial state of cells. */
    int32_t (*initial_state)(const msdd_plugin_start *start);
    /** One step of all cells. */
    int32_t (*advance)(const msdd_plugin_step *step);
    /** Solid fraction, overlaps counted twice, of an initial state with the given porosity; above 0 and at most 2.
     *  NULL = not known. */
    int32_t (*solid_fraction)(size_t cells, const double *porosity, double *solid_fraction);
    /** Relative standard deviation of K between RVEs of equal state, not negative; NULL = not known. */
    int32_t (*spread)(size_t cells, const double *const *state, double *spread);
    /** Text of the last failure on the calling thread, UTF-8; the library copies it at once. NULL = no such function. */
    const char *(*last_error)(void);
    double wall_friction_limit;     /**< as in msdd_model_wall_friction; 0 = not known */
    double wall_friction_slip;      /**< [mean radii], > 0 */
} msdd_plugin_v2;

#if defined(__GNUC__)
#define MSDD_PLUGIN_EXPORT __attribute__((visibility("default")))
#else
#define MSDD_PLUGIN_EXPORT
#endif

/** Returns the plug-in's table. A plug-in defines this function; libmsdd does not. */
MSDD_PLUGIN_EXPORT const msdd_plugin_v2 *msdd_plugin_v2_table(void);

/* --------------------------------------------------------------------------------------------- what was compared */

/** Least and largest value of a quantity in the scenes and beds by which a default model was compared with DEM.
 *  Beyond them nothing is known of its error. `hash`: SHA-256 of the model (msdd_model_hash). `quantity`:
 *  - "reduced_pressure": p over young_modulus x mean_radius / (1 m) of discs, over E/(2 - 2 nu^2) of spheres; the least is of means
 *    over a bed;
 *  - "thermal_strain": growth of the radii since the start;
 *  - "temperature" [K] and "conductivity_ratio", conductivity of the grains over that of the gas: of spheres alone;
 *  - "heat_source": heat from inside [W/m3];
 *  - "grains_across": least distance between opposite walls over the mean diameter.
 *  MSDD_INVALID_ARGUMENT if the model was not compared, or the model has no such quantity. */
int32_t msdd_compared(const char *hash, const char *quantity, double *least, double *most);

/** Conductivity [W/(m K)] of a gas ("air", "nitrogen", "helium", "argon"; "vacuum" or NULL: 0) at a temperature [K], 1 to 1e5, and
 *  usual pressures. Beyond the temperatures at which it is known, that of the nearest. */
int32_t msdd_gas_conductivity(const char *gas, double temperature, double *conductivity);

/** Properties of a gas ("air", "nitrogen", "helium", "argon") that flows, at a temperature [K], 1 to 1e5, and usual pressures. Beyond
 *  the temperatures at which it is known, those of the nearest. `properties` receives six numbers: viscosity [Pa s], conductivity
 *  [W/(m K)], heat capacity at constant pressure [J/(kg K)], molar mass [kg/mol], and the least and largest temperature [K] at which
 *  the gas is known. */
int32_t msdd_gas_properties(const char *gas, double temperature, double *properties);

#ifdef __cplusplus
}
#endif

/* What programs that were written for version 4 of this interface call: for one release. Compile with -DMSDD_WITHOUT_V4 to be
 * told where you still use them. */
#ifndef MSDD_WITHOUT_V4
#include "msdd_v4.h"
#endif

#endif
