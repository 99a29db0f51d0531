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
#include <vector>

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
    void operator()(msdd_model* model) const noexcept
    {
        const MaskedTraps masked;
        msdd_model_free(model);
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

/** A struct of the interface with its struct_size filled in and everything else 0 or NULL; set the members by name. */
template<class Struct> Struct sized() noexcept
{
    Struct result = Struct();
    result.struct_size = sizeof(Struct);
    return result;
}

/** Grains of a model of discs. Spheres need more members.
 *  @param conductivity k of the grains [W/(m K)]
 *  @param youngModulus E of the grains [Pa]
 *  @param radius mean grain radius in the initial state [m] */
inline msdd_grains grains(double conductivity, double youngModulus, double radius) noexcept
{
    msdd_grains result = sized<msdd_grains>();
    result.conductivity = conductivity;
    result.young_modulus = youngModulus;
    result.radius = radius;
    return result;
}

/** A step of this number of cells without columns. @param components 3 or 6, see Model::components */
inline msdd_step step(std::size_t cells, std::size_t components) noexcept
{
    msdd_step result = sized<msdd_step>();
    result.cells = cells;
    result.components = components;
    return result;
}

/** Initial data of this number of cells without columns. @param components 3 or 6, see Model::components */
inline msdd_start start(std::size_t cells, std::size_t components) noexcept
{
    msdd_start result = sized<msdd_start>();
    result.cells = cells;
    result.components = components;
    return result;
}

/** A column that is read, or NULL. @param stride distance of the values of neighbouring cells, in doubles */
inline msdd_input input(const double* values, std::size_t stride = 1) noexcept
{
    return msdd_input{values, stride};
}

/** A column that is written, or NULL. @param stride distance of the values of neighbouring cells, in doubles */
inline msdd_output output(double* values, std::size_t stride = 1) noexcept
{
    return msdd_output{values, stride};
}

/** A table of contiguous columns; empty for a table that is NULL. */
inline std::vector<msdd_input> inputs(const double* const* columns, std::size_t count)
{
    std::vector<msdd_input> table;
    for (std::size_t k = 0; columns && k < count; ++k)
    {
        table.push_back(input(columns[k]));
    }
    return table;
}

/** A table of contiguous columns; empty for a table that is NULL. */
inline std::vector<msdd_output> outputs(double* const* columns, std::size_t count)
{
    std::vector<msdd_output> table;
    for (std::size_t k = 0; columns && k < count; ++k)
    {
        table.push_back(output(columns[k]));
    }
    return table;
}

/** The table as the interface takes it: NULL if it is empty. */
template<class Column> const Column* table(const std::vector<Column>& columns) noexcept
{
    return columns.empty() ? nullptr : columns.data();
}

/** Version of the library, for example "0.1.0". */
inline std::string version()
{
    const detail::MaskedTraps masked;
    return msdd_version();
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

/** A model of discs, of spheres or of a plug-in: immutable, movable, not copyable. */
class Model
{
public:
    /** Loads a model: "builtin", "builtin:paper", "builtin:spheres", "plugin:" and the path of a plug-in, or the path of a model
     *  file. Throws Error. */
    explicit Model(const std::string& source = "builtin")
    {
        const detail::MaskedTraps masked;
        detail::checkVersion();
        msdd_model* handle = nullptr;
        detail::check(msdd_model_load(source.c_str(), &handle));
        handle_.reset(handle);
    }

    /** The same model with another kind of conductivity, "affine" (Eq. 9) or "network" (resistor network of the
     *  contacts); describe lists the kinds that it was trained for. Throws Error for any other. */
    Model withConductivity(const std::string& kind) const
    {
        const detail::MaskedTraps masked;
        msdd_model* handle = nullptr;
        detail::check(msdd_model_with_conductivity(handle_.get(), kind.c_str(), &handle));
        return Model(handle);
    }

    /** Number of state columns; 0 for an object that was moved from. */
    std::size_t stateSize() const
    {
        const detail::MaskedTraps masked;
        return msdd_model_state_size(handle_.get());
    }

    /** Name of a state column, counted from 0, for example "porosity"; empty beyond the last. */
    std::string stateName(std::size_t column) const
    {
        const detail::MaskedTraps masked;
        return text(msdd_model_state_name(handle_.get(), column));
    }

    /** Components of stress and strain: 3 in the plane, 6 in space. */
    std::size_t components() const
    {
        const detail::MaskedTraps masked;
        return msdd_model_components(handle_.get());
    }

    /** Fills the state columns of cells at the start. Throws Error. */
    void initialState(const msdd_grains& grains, const msdd_start& start, const msdd_output* state) const
    {
        const detail::MaskedTraps masked;
        detail::check(msdd_model_initial_state(handle_.get(), &grains, &start, state));
    }

    /** Steps 1 and 2 of the paper's Algorithm 1 for every cell of the batch; fills its outputs. Throws Error, and then
     *  has written nothing. */
    void advance(const msdd_grains& grains, msdd_step& step) const
    {
        const detail::MaskedTraps masked;
        detail::check(msdd_model_advance(handle_.get(), &grains, &step));
    }

    /** Whether the model has a mechanical tangent. */
    bool hasTangent() const
    {
        const detail::MaskedTraps masked;
        return msdd_model_has_tangent(handle_.get()) != 0;
    }

    /** Constants of the friction coefficient mobilised at a wall after the slip s [m], which is limit s/(s + slip).
     *  Returns false and sets nothing when the model has none. */
    bool wallFriction(const msdd_grains& grains, double& limit, double& slip) const
    {
        const detail::MaskedTraps masked;
        return msdd_model_wall_friction(handle_.get(), &grains, &limit, &slip) == MSDD_OK;
    }

    /** Solid fractions [-] of initial states with the given porosities, see msdd_model_solid_fraction. Throws Error. */
    void solidFraction(std::size_t cells, const double* porosity, double* solidFraction) const
    {
        const detail::MaskedTraps masked;
        detail::check(msdd_model_solid_fraction(handle_.get(), cells, porosity, solidFraction));
    }

    /** SHA-256 of the model file, 64 hexadecimal digits; empty for an object that was moved from. */
    std::string hash() const
    {
        const detail::MaskedTraps masked;
        return text(msdd_model_hash(handle_.get()));
    }

    /** Description as one JSON object, see msdd_model_describe; empty for an object that was moved from. */
    std::string describe() const
    {
        const detail::MaskedTraps masked;
        return text(msdd_model_describe(handle_.get()));
    }

private:
    explicit Model(msdd_model* handle) : handle_(handle) {}

    static std::string text(const char* pointer) { return pointer ? pointer : ""; }

    std::unique_ptr<msdd_model, detail::Free> handle_;
};

/** What a wall adds to the resistance of a bed of spheres [m2 K/W], from the stress normal to it [Pa, compression positive], the
 *  temperature of the gas [K] and the conductivity of the bed across it [W/(m K)] at each face. Throws Error. */
inline void wallResistance
(
    const msdd_grains& grains,
    const msdd_sphere_wall& wall,
    std::size_t faces,
    const double* stress,
    const double* temperature,
    const double* conductivity,
    double* resistance
)
{
    const detail::MaskedTraps masked;
    detail::check(msdd_wall_resistance(&grains, &wall, faces, stress, temperature, conductivity, resistance));
}

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

/** Trains a model and returns the text of its file; the request is a JSON object, see msdd_train. Throws Error. */
inline std::string train(const std::string& request)
{
    const detail::MaskedTraps masked;
    detail::checkVersion();
    char* text = nullptr;
    detail::check(msdd_train(request.c_str(), &text));
    const std::unique_ptr<char, detail::Free> owner(text);
    return text;
}

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
