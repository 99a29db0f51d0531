// msdd.hpp in a program that traps floating-point exceptions, as OpenFOAM does.

#include "msdd.hpp"

#include <cfenv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

const int traps = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;

int failures = 0;

#define EXPECT(condition)                                                               \
    do                                                                                  \
    {                                                                                   \
        if (!(condition))                                                               \
        {                                                                               \
            std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
            ++failures;                                                                 \
        }                                                                               \
    } while (false)

/// Status and text of the Error that an action throws; status 0 when it throws none.
template<class Action> std::pair<int, std::string> thrown(const Action& action)
{
    try
    {
        action();
    }
    catch (const msdd::Error& error)
    {
        return std::make_pair(static_cast<int>(error.status()), std::string(error.what()));
    }
    return std::make_pair(0, std::string());
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

typedef std::vector<double> Column;

/// Cells with columns for all inputs and outputs.
struct Cells
{
    Column porosity, fabricIndex, strain, totalStrain;
    Column deltaPorosity, deltaFabricIndex, kxx, kyy, sxx, syy;
    std::vector<std::uint8_t> clamped;

    explicit Cells(std::size_t n)
    : porosity(n, 0.125), fabricIndex(n, 0.05), strain(n, 1e-3), totalStrain(n, 0.01),
      deltaPorosity(n, -7), deltaFabricIndex(n, -7), kxx(n, -7), kyy(n, -7), sxx(n, -7), syy(n, -7), clamped(n, 9)
    {}

    std::vector<const Column*> outputs() const
    {
        return {&deltaPorosity, &deltaFabricIndex, &kxx, &kyy, &sxx, &syy};
    }

    msdd_batch batch()
    {
        msdd_batch result = msdd::batch(porosity.size());
        result.porosity = porosity.data();
        result.fabric_index = fabricIndex.data();
        result.thermal_strain = strain.data();
        result.total_thermal_strain = totalStrain.data();
        result.delta_porosity = deltaPorosity.data();
        result.delta_fabric_index = deltaFabricIndex.data();
        result.conductivity_xx = kxx.data();
        result.conductivity_yy = kyy.data();
        result.stress_xx = sxx.data();
        result.stress_yy = syy.data();
        result.clamped = clamped.data();
        return result;
    }

    std::size_t evaluate(const msdd::Surrogate& surrogate)
    {
        msdd_batch columns = batch();
        surrogate.evaluate(msdd::material(100, 1e7, 5e-3), columns);
        return columns.clamped_cells;
    }
};

/// Whether an invalid operation would kill this process now: a forked copy tries.
bool invalidTraps()
{
    const pid_t child = fork();
    if (child == 0)
    {
        volatile double zero = 0;
        volatile double result = zero / zero;
        static_cast<void>(result);
        _exit(0);
    }
    int status = 0;
    EXPECT(child > 0 && waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGFPE;
}

void guardMasksAndRestores()
{
    EXPECT(invalidTraps());
    {
        const msdd::detail::MaskedTraps masked;
        EXPECT(!invalidTraps());
        // Raised here, it would end the process without the guard; nor may it show up after the guard's end.
        volatile double zero = 0;
        volatile double result = zero / zero;
        static_cast<void>(result);
        EXPECT(std::fetestexcept(FE_INVALID) != 0);
    }
    EXPECT(std::fetestexcept(FE_INVALID) == 0);
    EXPECT(fegetexcept() == traps);
    EXPECT(invalidTraps());
}

void farOutsideIsClamped(const msdd::Surrogate& surrogate)
{
    const double huge = std::numeric_limits<double>::max();
    Cells cells(9);
    cells.porosity[1] = huge;
    cells.porosity[2] = -huge;
    cells.fabricIndex[3] = huge;
    cells.strain[4] = -huge;
    cells.porosity[5] = cells.fabricIndex[5] = cells.strain[5] = 1e200;
    EXPECT(cells.evaluate(surrogate) == 5);
    for (std::size_t i = 0; i < 9; ++i)
    {
        EXPECT(cells.clamped[i] == (i >= 1 && i <= 5 ? 1 : 0));
        for (const Column* column : cells.outputs())
        {
            EXPECT((*column)[i] > -1e6 && (*column)[i] < 1e6);
        }
        EXPECT(cells.kxx[i] >= 0 && cells.kyy[i] >= 0 && cells.sxx[i] >= 0 && cells.syy[i] >= 0);
    }
}

void zeroStrainChangesNothing(const msdd::Surrogate& surrogate)
{
    Cells cells(5);
    cells.strain.assign(5, 0.0);
    cells.evaluate(surrogate);
    for (std::size_t i = 0; i < 5; ++i)
    {
        EXPECT(cells.deltaPorosity[i] == 0 && cells.deltaFabricIndex[i] == 0);
    }
}

void tendenciesAreGranular(const msdd::Surrogate& surrogate)
{
    Cells cells(4); // expanding, contracting, loose, turned by 90 degrees
    cells.strain = {0.01, -0.01, 0.0, 0.01};
    cells.porosity[2] = 0.17;
    cells.fabricIndex[3] = -cells.fabricIndex[0];
    cells.evaluate(surrogate);
    EXPECT(cells.deltaPorosity[0] < 0 && cells.deltaPorosity[1] > 0);
    EXPECT(cells.kxx[0] > cells.kxx[1] && cells.kxx[1] > cells.kxx[2]);
    EXPECT(cells.sxx[0] > cells.sxx[1] && cells.sxx[1] > cells.sxx[2]);
    EXPECT(cells.kxx[0] > cells.kyy[0] && cells.kyy[3] > cells.kxx[3]);
    EXPECT(cells.kyy[3] > 0.9 * cells.kxx[0] && cells.kyy[3] < 1.1 * cells.kxx[0]);
}

void answersDoNotDependOnTheBatch(const msdd::Surrogate& surrogate)
{
    const std::size_t n = 29;
    Cells all(n);
    for (std::size_t i = 0; i < n; ++i)
    {
        all.porosity[i] += 1e-3 * double(i);
        all.fabricIndex[i] -= 3e-3 * double(i);
        all.strain[i] -= 1e-4 * double(i);
    }
    all.evaluate(surrogate);
    for (std::size_t size = 1; size <= n; size += 6)
    {
        Cells part(size);
        const std::size_t first = n - size;
        for (std::size_t i = 0; i < size; ++i)
        {
            part.porosity[i] = all.porosity[first + i];
            part.fabricIndex[i] = all.fabricIndex[first + i];
            part.strain[i] = all.strain[first + i];
        }
        part.evaluate(surrogate);
        for (std::size_t o = 0; o < 6; ++o)
        {
            const double* expected = all.outputs()[o]->data() + first;
            EXPECT(std::memcmp(part.outputs()[o]->data(), expected, size * sizeof(double)) == 0);
        }
    }
}

void badInputThrowsAndWritesNothing(const msdd::Surrogate& surrogate)
{
    Cells cells(6);
    cells.fabricIndex[4] = std::numeric_limits<double>::quiet_NaN();
    std::pair<int, std::string> error = thrown([&] { cells.evaluate(surrogate); });
    EXPECT(error.first == MSDD_NON_FINITE && has(error.second, "fabric_index[4]"));
    for (const Column* column : cells.outputs())
    {
        EXPECT(*column == Column(6, -7.0));
    }
    EXPECT(cells.clamped == std::vector<std::uint8_t>(6, 9));

    msdd_batch short_ = Cells(1).batch();
    short_.struct_size -= 8;
    error = thrown([&] { surrogate.evaluate(msdd::material(100, 1e7, 5e-3), short_); });
    EXPECT(error.first == MSDD_INVALID_ARGUMENT && has(error.second, "struct_size"));

    Cells good(1);
    msdd_batch columns = good.batch();
    error = thrown([&] { surrogate.evaluate(msdd::material(100, -1e7, 5e-3), columns); });
    EXPECT(error.first == MSDD_INVALID_ARGUMENT && has(error.second, "young_modulus = -10000000"));
}

void loadingFailsWithTheReason()
{
    std::pair<int, std::string> error = thrown([] { msdd::Surrogate("/no/such/model.json"); });
    EXPECT(error.first == MSDD_IO && has(error.second, "/no/such/model.json"));
    error = thrown([] { msdd::Surrogate{__FILE__}; });
    EXPECT(error.first == MSDD_MODEL && has(error.second, "damaged"));
}

void handlesMove()
{
    static_assert(!std::is_copy_constructible<msdd::Surrogate>::value, "handles are not copied");
    msdd::Surrogate first;
    const std::string hash = first.hash();
    EXPECT(hash.size() == 64 && has(first.describe(), hash.c_str()));
    msdd::Surrogate second(std::move(first));
    EXPECT(second.hash() == hash);
    const double porosity[2] = {0.1, 0.125};
    double solid[2] = {0, 0};
    second.solidFraction(2, porosity, solid);
    EXPECT(solid[0] > solid[1] && solid[1] > 0.875 && solid[0] < 1);
}

} // namespace

int main()
{
    feenableexcept(traps);
    guardMasksAndRestores();
    loadingFailsWithTheReason();
    handlesMove();
    const msdd::Surrogate surrogate;
    farOutsideIsClamped(surrogate);
    zeroStrainChangesNothing(surrogate);
    tendenciesAreGranular(surrogate);
    answersDoNotDependOnTheBatch(surrogate);
    badInputThrowsAndWritesNothing(surrogate);
    EXPECT(fegetexcept() == traps);
    EXPECT(invalidTraps());
    std::printf("wrapper.cpp: %s\n", failures ? "FAILED" : "ok");
    return failures != 0;
}
