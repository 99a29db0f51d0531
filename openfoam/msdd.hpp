/** C++11 interface to the C library msdd.h: handles that free themselves, exceptions instead of status codes, and
 *  floating-point traps masked during every call. Header-only; needs msdd.h on the include path and libmsdd.a
 *  (-lpthread -ldl -lm).
 *
 *  SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef MSDD_HPP
#define MSDD_HPP

#include "msdd.h"

#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace msdd
{

/** Failure of a library call. */
class Error : public std::runtime_error
{
public:
    Error(std::int32_t status, const std::string& message) : std::runtime_error(message), status_(status) {}

    /** One of enum msdd_status. */
    std::int32_t status() const noexcept { return status_; }

private:
    std::int32_t status_;
};

namespace detail
{

/** Masks floating-point traps during its lifetime; its destructor restores the traps and flags. Rust assumes the IEEE
 *  default environment, while OpenFOAM traps division by zero, invalid operations and overflow, so that a harmless
 *  exception inside the library would end the run. */
class MaskedTraps
{
public:
    MaskedTraps() noexcept { std::feholdexcept(&saved_); }
    ~MaskedTraps() { std::fesetenv(&saved_); }
    MaskedTraps(const MaskedTraps&) = delete;
    MaskedTraps& operator=(const MaskedTraps&) = delete;

private:
    std::fenv_t saved_;
};

/** Throws Error with the message of the last call on this thread unless the status is MSDD_OK. */
inline void check(std::int32_t status)
{
    if (status != MSDD_OK)
    {
        throw Error(status, msdd_last_error());
    }
}

/** Throws Error when library and header have different versions of the interface. */
inline void checkVersion()
{
    const std::uint32_t found = msdd_abi_version();
    if (found != MSDD_ABI_VERSION)
    {
        throw Error
        (
            MSDD_INVALID_ARGUMENT,
            "libmsdd has interface version " + std::to_string(found) + ", msdd.h has "
          + std::to_string(MSDD_ABI_VERSION) + ": rebuild both from the same source"
        );
    }
}

/** Deleter of the handles and texts that the library hands out. */
struct Free
{
    void operator()(msdd_surrogate* surrogate) const noexcept
    {
        const MaskedTraps masked;
        msdd_surrogate_free(surrogate);
    }
    void operator()(msdd_spheres* spheres) const noexcept
    {
        const MaskedTraps masked;
        msdd_spheres_free(spheres);
    }
    void operator()(msdd_rve* rve) const noexcept
    {
        const MaskedTraps masked;
        msdd_rve_free(rve);
    }
    void operator()(char* text) const noexcept
    {
        const MaskedTraps masked;
        msdd_text_free(text);
    }
};

} // namespace detail

/** A material with its struct_size filled in.
 *  @param thermalConductivity k of the grains [W/(m K)]
 *  @param youngModulus E of the grains [Pa]
 *  @param meanRadius mean grain radius in the initial state [m] */
inline msdd_material material(double thermalConductivity, double youngModulus, double meanRadius) noexcept
{
    msdd_material result = msdd_material();
    result.struct_size = sizeof(msdd_material);
    result.thermal_conductivity = thermalConductivity;
    result.young_modulus = youngModulus;
    result.mean_radius = meanRadius;
    return result;
}

/** A batch for this number of cells, with its struct_size filled in and all columns NULL; set the columns by name. */
inline msdd_batch batch(std::size_t cells) noexcept
{
    msdd_batch result = msdd_batch();
    result.struct_size = sizeof(msdd_batch);
    result.cells = cells;
    return result;
}

/** Version of the library, for example "0.1.0". */
inline std::string version()
{
    const detail::MaskedTraps masked;
    return msdd_version();
}

/** Initial data of this number of cells, with its struct_size filled in and all columns NULL; set the columns by name.
 */
inline msdd_initial initial(std::size_t cells) noexcept
{
    msdd_initial result = msdd_initial();
    result.struct_size = sizeof(msdd_initial);
    result.cells = cells;
    return result;
}

/** Least and largest value of a quantity by which the model with this hash was compared with DEM, see msdd_compared.
 *  Returns false and sets nothing if it was not. */
inline bool compared(const std::string& hash, const std::string& quantity, double& least, double& most)
{
    const detail::MaskedTraps masked;
    return msdd_compared(hash.c_str(), quantity.c_str(), &least, &most) == MSDD_OK;
}

/** Conductivity of a gas [W/(m K)] at a temperature [K], see msdd_gas_conductivity. Throws Error. */
inline double gasConductivity(const std::string& gas, double temperature)
{
    const detail::MaskedTraps masked;
    double conductivity = 0;
    detail::check(msdd_gas_conductivity(gas.c_str(), temperature, &conductivity));
    return conductivity;
}

/** Properties of a gas that flows, see msdd_gas_properties. */
struct GasProperties
{
    double viscosity, conductivity, heatCapacity, molarMass, coldest, hottest;
};

/** Those at a temperature [K]. Throws Error. */
inline GasProperties gasProperties(const std::string& gas, double temperature)
{
    const detail::MaskedTraps masked;
    double found[6] = {};
    detail::check(msdd_gas_properties(gas.c_str(), temperature, found));
    return GasProperties{found[0], found[1], found[2], found[3], found[4], found[5]};
}

/** A surrogate model: immutable, movable, not copyable. */
class Surrogate
{
public:
    /** Loads a model: "builtin", "builtin:paper", "plugin:" and the path of a plug-in, or the path of a model file.
     *  Throws Error. */
    explicit Surrogate(const std::string& source = "builtin")
    {
        const detail::MaskedTraps masked;
        detail::checkVersion();
        msdd_surrogate* handle = nullptr;
        detail::check(msdd_surrogate_load(source.c_str(), &handle));
        handle_.reset(handle);
    }

    /** The same model with another kind of conductivity, "affine" (Eq. 9) or "network" (resistor network of the
     *  contacts); describe lists the kinds that it was trained for. Throws Error for any other. */
    Surrogate withConductivity(const std::string& kind) const
    {
        const detail::MaskedTraps masked;
        msdd_surrogate* handle = nullptr;
        detail::check(msdd_surrogate_with_conductivity(handle_.get(), kind.c_str(), &handle));
        return Surrogate(handle);
    }

    /** Number of state columns; 0 for an object that was moved from. */
    std::size_t stateSize() const
    {
        const detail::MaskedTraps masked;
        return msdd_surrogate_state_size(handle_.get());
    }

    /** Name of a state column, counted from 0, for example "porosity"; empty beyond the last. */
    std::string stateName(std::size_t column) const
    {
        const detail::MaskedTraps masked;
        return text(msdd_surrogate_state_name(handle_.get(), column));
    }

    /** Fills the state columns of cells at the start. Throws Error. */
    void initialState(const msdd_material& material, const msdd_initial& initial, double* const* state) const
    {
        const detail::MaskedTraps masked;
        detail::check(msdd_surrogate_initial_state(handle_.get(), &material, &initial, state));
    }

    /** Steps 1 and 2 of the paper's Algorithm 1 for every cell of the batch; fills its outputs. Throws Error, and then
     *  has written nothing. */
    void advance(const msdd_material& material, msdd_batch& batch) const
    {
        const detail::MaskedTraps masked;
        detail::check(msdd_surrogate_advance(handle_.get(), &material, &batch));
    }

    /** Whether the model has a mechanical tangent. */
    bool hasTangent() const
    {
        const detail::MaskedTraps masked;
        return msdd_surrogate_has_tangent(handle_.get()) != 0;
    }

    /** Constants of the friction coefficient mobilised at a wall after the slip s [m], which is limit s/(s + slip).
     *  Returns false and sets nothing when the model has none. */
    bool wallFriction(const msdd_material& material, double& limit, double& slip) const
    {
        const detail::MaskedTraps masked;
        return msdd_surrogate_wall_friction(handle_.get(), &material, &limit, &slip) == MSDD_OK;
    }

    /** Solid fractions (sum of grain areas over area, overlaps counted twice) [-] of initial states with the given
     *  porosities. Throws Error. */
    void solidFraction(std::size_t cells, const double* porosity, double* solidFraction) const
    {
        const detail::MaskedTraps masked;
        detail::check(msdd_surrogate_solid_fraction(handle_.get(), cells, porosity, solidFraction));
    }

    /** SHA-256 of the model file, 64 hexadecimal digits; empty for an object that was moved from. */
    std::string hash() const
    {
        const detail::MaskedTraps masked;
        return text(msdd_surrogate_hash(handle_.get()));
    }

    /** Description as one JSON object, see msdd_surrogate_describe; empty for an object that was moved from. */
    std::string describe() const
    {
        const detail::MaskedTraps masked;
        return text(msdd_surrogate_describe(handle_.get()));
    }

private:
    explicit Surrogate(msdd_surrogate* handle) : handle_(handle) {}

    static std::string text(const char* pointer) { return pointer ? pointer : ""; }

    std::unique_ptr<msdd_surrogate, detail::Free> handle_;
};

/** The law of packings of spheres: immutable, movable, not copyable. */
class Spheres
{
public:
    /** Loads a law: "builtin" or the path of a model file. Throws Error. */
    explicit Spheres(const std::string& source = "builtin")
    {
        const detail::MaskedTraps masked;
        detail::checkVersion();
        msdd_spheres* handle = nullptr;
        detail::check(msdd_spheres_load(source.c_str(), &handle));
        handle_.reset(handle);
    }

    /** Number of state columns; 0 for an object that was moved from. */
    std::size_t stateSize() const
    {
        const detail::MaskedTraps masked;
        return msdd_spheres_state_size(handle_.get());
    }

    /** Name of a state column, counted from 0; empty beyond the last. */
    std::string stateName(std::size_t column) const
    {
        const detail::MaskedTraps masked;
        return text(msdd_spheres_state_name(handle_.get(), column));
    }

    /** Fills the state columns of packings with these solid fractions and stresses (six columns [Pa], compression positive), and
     *  contacts per sphere, mobilised part of the friction, and fabric (six columns) or null. Throws Error. */
    void initialState
    (
        const msdd_sphere_material& material,
        std::size_t cells,
        const double* solidFraction,
        const double* const* stress,
        const double* coordination,
        const double* mobilised,
        const double* const* fabric,
        double* const* state
    ) const
    {
        const detail::MaskedTraps masked;
        detail::check
        (
            msdd_spheres_initial_state
            (
                handle_.get(), &material, cells, solidFraction, stress, coordination, mobilised,
                fabric, state
            )
        );
    }

    /** One step of every cell of the batch; fills its outputs. Throws Error, and then has written nothing. */
    void advance(const msdd_sphere_material& material, msdd_sphere_batch& batch) const
    {
        const detail::MaskedTraps masked;
        detail::check(msdd_spheres_advance(handle_.get(), &material, &batch));
    }

    /** What a wall adds to the resistance of a bed [m2 K/W], from the stress normal to it [Pa, compression positive], the temperature
     *  of the gas [K] and the conductivity of the bed across it [W/(m K)] at each face. Throws Error. */
    static void wallResistance
    (
        const msdd_sphere_material& material,
        const msdd_sphere_wall& wall,
        std::size_t faces,
        const double* stress,
        const double* temperature,
        const double* conductivity,
        double* resistance
    )
    {
        const detail::MaskedTraps masked;
        detail::check
        (
            msdd_spheres_wall_resistance(&material, &wall, faces, stress, temperature, conductivity, resistance)
        );
    }

    /** SHA-256 of the model file, 64 hexadecimal digits; empty for an object that was moved from. */
    std::string hash() const
    {
        const detail::MaskedTraps masked;
        return text(msdd_spheres_hash(handle_.get()));
    }

private:
    static std::string text(const char* pointer) { return pointer ? pointer : ""; }

    std::unique_ptr<msdd_spheres, detail::Free> handle_;
};

/** A box of grains, simulated by DEM. It can be moved, and copied by clone() alone. Only one thread at a time
 *  may use it. */
class Rve
{
public:
    /** Packs a box from a specification, a JSON object; see msdd_rve_pack. Throws Error. */
    static Rve pack(const std::string& specification = "{}")
    {
        const detail::MaskedTraps masked;
        detail::checkVersion();
        msdd_rve* handle = nullptr;
        detail::check(msdd_rve_pack(specification.c_str(), &handle));
        return Rve(handle);
    }

    /** Reads the text of a state file. Throws Error. */
    static Rve fromJson(const std::string& text)
    {
        const detail::MaskedTraps masked;
        detail::checkVersion();
        msdd_rve* handle = nullptr;
        detail::check(msdd_rve_from_json(text.c_str(), &handle));
        return Rve(handle);
    }

    /** Text of a state file. Throws Error. */
    std::string toJson() const
    {
        const detail::MaskedTraps masked;
        char* text = nullptr;
        detail::check(msdd_rve_to_json(handle_.get(), &text));
        const std::unique_ptr<char, detail::Free> owner(text);
        return text;
    }

    /** A copy. Throws Error. */
    Rve clone() const
    {
        const detail::MaskedTraps masked;
        msdd_rve* handle = nullptr;
        detail::check(msdd_rve_clone(handle_.get(), &handle));
        return Rve(handle);
    }

    /** Strains the box relative to its present state and lets the grains move to equilibrium, see msdd_rve_strain; returns
     *  one of enum msdd_outcome. Throws Error, and then the box is as before. */
    std::int32_t strain(double thermal, double xx = 0, double yy = 0, double xy = 0)
    {
        const detail::MaskedTraps masked;
        std::int32_t outcome = MSDD_SETTLED;
        detail::check(msdd_rve_strain(handle_.get(), thermal, xx, yy, xy, &outcome));
        return outcome;
    }

    /** Averages over the averaging region, see msdd_rve_homogenise. Throws Error. */
    msdd_averages homogenise() const
    {
        const detail::MaskedTraps masked;
        msdd_averages result = msdd_averages();
        result.struct_size = sizeof(msdd_averages);
        detail::check(msdd_rve_homogenise(handle_.get(), &result));
        return result;
    }

private:
    explicit Rve(msdd_rve* handle) : handle_(handle) {}

    std::unique_ptr<msdd_rve, detail::Free> handle_;
};

/** A database: the file of results of RVEs simulated by a plan, from which models are trained. */
class Database
{
public:
    /** Called after every finished packing with the numbers done, total and failed; returning false stops the
     *  generation. May throw. Floating-point traps are masked while it runs. */
    typedef std::function<bool(std::uint64_t, std::uint64_t, std::uint64_t)> Progress;

    /** The database in the file `path`, which need not exist yet. */
    explicit Database(const std::string& path) : path_(path) {}

    const std::string& path() const noexcept { return path_; }

    /** Computes the packings of a plan (the text of a TOML file) that the file does not hold yet, on this number of
     *  threads. Throws Error, with the status MSDD_CANCELLED when `progress` stopped it, and what `progress` throws;
     *  finished packings are kept. */
    void generate(const std::string& plan, std::uint32_t threads = 1, Progress progress = Progress()) const
    {
        const detail::MaskedTraps masked;
        detail::checkVersion();
        Listener listener = {progress, std::exception_ptr()};
        const std::int32_t status = msdd_database_generate
        (
            plan.c_str(), path_.c_str(), threads, progress ? &Listener::hear : nullptr, &listener
        );
        if (listener.thrown)
        {
            std::rethrow_exception(listener.thrown);
        }
        detail::check(status);
    }

    /** Writes a CSV file, compressed if its name ends in .gz; returns the number of rows. Throws Error. */
    std::uint64_t exportCsv(const std::string& csv) const
    {
        const detail::MaskedTraps masked;
        detail::checkVersion();
        std::uint64_t rows = 0;
        detail::check(msdd_database_export_csv(path_.c_str(), csv.c_str(), &rows));
        return rows;
    }

private:
    struct Listener
    {
        Progress progress;
        std::exception_ptr thrown;

        /** An exception must not pass through the library: it is stored, and generate throws it again. */
        static std::int32_t hear(void* user, std::uint64_t done, std::uint64_t total, std::uint64_t failed)
        {
            Listener& self = *static_cast<Listener*>(user);
            try
            {
                return self.progress(done, total, failed) ? 0 : 1;
            }
            catch (...)
            {
                self.thrown = std::current_exception();
                return 1;
            }
        }
    };

    std::string path_;
};

} // namespace msdd

#endif
