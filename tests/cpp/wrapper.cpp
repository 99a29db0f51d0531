// Tests msdd.hpp in a program that traps floating-point exceptions, as OpenFOAM does.

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

/// Status and message of the Error that an action throws; status 0 if it throws none.
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

/// Cells in the initial state of a model, with columns for all inputs and outputs.
struct Cells
{
    std::vector<Column> state, next;
    Column strain, totalStrain, kxx, kyy, sxx, syy;
    std::vector<std::uint8_t> clamped;

    Cells(const msdd::Model& model, std::size_t n, double fabricIndex = 0.05)
    : state(model.stateSize(), Column(n, -7)), next(state), strain(n, 1e-3), totalStrain(n, 0.01),
      kxx(n, -7), kyy(n, -7), sxx(n, -7), syy(n, -7), clamped(n, 9)
    {
        const Column porosity(n, 0.125), fabric(n, fabricIndex);
        msdd_start start = msdd::start(n, 3);
        start.porosity = msdd::input(porosity.data());
        start.fabric_index = msdd::input(fabric.data());
        model.initialState(msdd::grains(100, 1e7, 5e-3), start, outputs(state).data());
    }

    static std::vector<msdd_output> outputs(std::vector<Column>& columns)
    {
        std::vector<msdd_output> result;
        for (Column& column : columns) { result.push_back(msdd::output(column.data())); }
        return result;
    }

    std::vector<const Column*> outputs() const
    {
        std::vector<const Column*> result = {&kxx, &kyy, &sxx, &syy};
        for (const Column& column : next) { result.push_back(&column); }
        return result;
    }

    std::size_t advance(const msdd::Model& model, double youngModulus = 1e7, std::size_t shorter = 0)
    {
        std::vector<msdd_input> before;
        for (const Column& column : state) { before.push_back(msdd::input(column.data())); }
        const std::vector<msdd_output> after = outputs(next);
        const msdd_output conductivity[] = {msdd::output(kxx.data()), msdd::output(kyy.data()), msdd::output(nullptr)};
        const msdd_output stress[] = {msdd::output(sxx.data()), msdd::output(syy.data()), msdd::output(nullptr)};
        msdd_step step = msdd::step(strain.size(), 3);
        step.struct_size -= shorter;
        step.state = before.data();
        step.next_state = after.data();
        step.thermal_strain = msdd::input(strain.data());
        step.total_thermal_strain = msdd::input(totalStrain.data());
        step.conductivity = conductivity;
        step.stress = stress;
        step.outside = clamped.data();
        const msdd_grains grains = msdd::grains(100, youngModulus, 5e-3);
        std::feclearexcept(FE_ALL_EXCEPT);
        model.advance(grains, step);
        // Without the guard at least the flag of an inexact result would be set here.
        EXPECT(std::fetestexcept(FE_ALL_EXCEPT) == 0);
        return step.outside_cells;
    }
};

/// Whether an invalid operation would kill this process now; tried in a forked copy.
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
        // Without the guard this division would end the process; its flag must not be set after the guard's end either.
        volatile double zero = 0;
        volatile double result = zero / zero;
        static_cast<void>(result);
        EXPECT(std::fetestexcept(FE_INVALID) != 0);
    }
    EXPECT(std::fetestexcept(FE_INVALID) == 0);
    EXPECT(fegetexcept() == traps);
    EXPECT(invalidTraps());
}

void farOutsideIsClamped(const msdd::Model& model)
{
    const double huge = std::numeric_limits<double>::max();
    Cells cells(model, 9);
    cells.state[0][1] = huge;
    cells.state[0][2] = -huge;
    cells.state[1][3] = huge;
    cells.strain[4] = -huge;
    cells.state[0][5] = cells.state[1][5] = cells.strain[5] = 1e200;
    EXPECT(cells.advance(model) == 5);
    for (std::size_t i = 0; i < 9; ++i)
    {
        EXPECT(cells.clamped[i] == (i >= 1 && i <= 5 ? 1 : 0));
        EXPECT(cells.kxx[i] >= 0 && cells.kyy[i] >= 0 && cells.sxx[i] >= 0 && cells.syy[i] >= 0);
        EXPECT(cells.kxx[i] < 1e6 && cells.kyy[i] < 1e6 && cells.sxx[i] < 1e9 && cells.syy[i] < 1e9);
    }
}

void zeroStrainChangesNothing(const msdd::Model& model)
{
    Cells cells(model, 5);
    cells.strain.assign(5, 0.0);
    cells.advance(model);
    EXPECT(cells.next == cells.state);
}

void tendenciesAreGranular(const msdd::Model& model)
{
    Cells cells(model, 3), turned(model, 1, -0.05);
    cells.strain = {0.01, -0.01, 0.0};
    turned.strain = {0.01};
    cells.advance(model);
    turned.advance(model);
    EXPECT(cells.next[0][0] < 0.125 && cells.next[0][1] > 0.125);
    EXPECT(cells.kxx[0] > cells.kxx[2] && cells.kxx[2] > cells.kxx[1]);
    EXPECT(cells.sxx[0] > cells.sxx[2] && cells.sxx[2] > cells.sxx[1]);
    EXPECT(cells.kxx[0] > cells.kyy[0] && turned.kyy[0] > turned.kxx[0]);
    EXPECT(turned.kyy[0] > 0.9 * cells.kxx[0] && turned.kyy[0] < 1.1 * cells.kxx[0]);
}

void answersDoNotDependOnTheBatch(const msdd::Model& model)
{
    const std::size_t n = 29;
    Cells all(model, n);
    for (std::size_t i = 0; i < n; ++i)
    {
        all.state[0][i] += 1e-3 * double(i);
        all.state[1][i] -= 3e-3 * double(i);
        all.strain[i] -= 1e-4 * double(i);
    }
    all.advance(model);
    for (std::size_t size = 1; size <= n; size += 6)
    {
        Cells part(model, size);
        const std::size_t first = n - size;
        for (std::size_t i = 0; i < size; ++i)
        {
            for (std::size_t k = 0; k < part.state.size(); ++k) { part.state[k][i] = all.state[k][first + i]; }
            part.strain[i] = all.strain[first + i];
        }
        part.advance(model);
        for (std::size_t o = 0; o < part.outputs().size(); ++o)
        {
            const double* expected = all.outputs()[o]->data() + first;
            EXPECT(std::memcmp(part.outputs()[o]->data(), expected, size * sizeof(double)) == 0);
        }
    }
}

void badInputThrowsAndWritesNothing(const msdd::Model& model)
{
    Cells cells(model, 6);
    cells.state[1][4] = std::numeric_limits<double>::quiet_NaN();
    std::pair<int, std::string> error = thrown([&] { cells.advance(model); });
    EXPECT(error.first == MSDD_NON_FINITE && has(error.second, "fabric_index[4]"));
    for (const Column* column : cells.outputs())
    {
        EXPECT(*column == Column(6, -7.0));
    }
    EXPECT(cells.clamped == std::vector<std::uint8_t>(6, 9));

    Cells good(model, 1);
    error = thrown([&] { good.advance(model, 1e7, 8); });
    EXPECT(error.first == MSDD_INVALID_ARGUMENT && has(error.second, "struct_size"));
    error = thrown([&] { good.advance(model, -1e7); });
    EXPECT(error.first == MSDD_INVALID_ARGUMENT && has(error.second, "young_modulus = -10000000"));
}

void rveSwellsUnderTraps()
{
    msdd::Rve rve = msdd::Rve::pack("{\"discs\": 40, \"porosity\": 0.13}");
    msdd::Rve twin = msdd::Rve::fromJson(rve.clone().toJson());
    const msdd_averages before = rve.homogenise();
    EXPECT(rve.strain(0.01) == MSDD_SETTLED && twin.strain(0.01) == MSDD_SETTLED);
    EXPECT(rve.homogenise().pressure > before.pressure);
    EXPECT(rve.homogenise().pressure == twin.homogenise().pressure);
    const std::pair<int, std::string> error = thrown([&] { rve.strain(0, 0, 0, 0.01); });
    EXPECT(error.first == MSDD_INVALID_ARGUMENT && has(error.second, "xy"));
}

/// The affine conductivity must be above that of the resistor network; the state must be the same.
void conductivityIsChosen(const msdd::Model& model)
{
    const msdd::Model affine = model.withConductivity("affine");
    const msdd::Model network = affine.withConductivity("network");
    Cells upper(affine, 3), lower(network, 3);
    upper.advance(affine);
    lower.advance(network);
    EXPECT(upper.kxx[1] > lower.kxx[1] && upper.kyy[1] > lower.kyy[1] && upper.next == lower.next);
    EXPECT(has(affine.describe(), "\"conductivity\":\"affine\"") && affine.hash() == network.hash());
    const std::pair<int, std::string> error = thrown([&] { model.withConductivity("exact"); });
    EXPECT(error.first == MSDD_INVALID_ARGUMENT && has(error.second, "kind = exact, allowed: "));
}

/// Whether the call-back returns false or throws, the next run must continue with the packings that are missing.
void databaseIsMadeInSeveralGoes(const std::string& path)
{
    const std::string plan =
        "radius_min = 3e-3\nradius_max = 7e-3\nseed = 5\n[[thermal]]\ndiscs = 40\nporosities = [0.13]\n"
        "compressions = [\"isotropic\"]\nrepeats = 3\nstops = [0.001]\n";
    const msdd::Database database(path);
    std::uint64_t most = 0;
    const std::pair<int, std::string> error = thrown
    (
        [&]
        {
            database.generate(plan, 1, [&](std::uint64_t done, std::uint64_t total, std::uint64_t failed)
            {
                EXPECT(total == 3 && failed == 0);
                most = done;
                return done < 1;
            });
        }
    );
    EXPECT(error.first == MSDD_CANCELLED && most == 1);
    bool passed = false;
    try
    {
        database.generate(plan, 1, [](std::uint64_t done, std::uint64_t, std::uint64_t) -> bool
        {
            if (done == 2) { throw std::out_of_range("mine"); }
            return true;
        });
    }
    catch (const std::out_of_range& mine)
    {
        passed = has(mine.what(), "mine");
    }
    EXPECT(passed);
    database.generate(plan, 2);
    EXPECT(database.exportCsv(path + ".csv") == 9);
    EXPECT(fegetexcept() == traps);
    EXPECT(thrown([&] { database.generate("seed = 1"); }).first == MSDD_RVE);
    EXPECT(thrown([] { msdd::Database("/no/such/folder/a.msdd").exportCsv("/no/such/folder/a.csv"); }).first == MSDD_IO);
}

void loadingFailsWithTheReason()
{
    std::pair<int, std::string> error = thrown([] { msdd::Model("/no/such/model.json"); });
    EXPECT(error.first == MSDD_IO && has(error.second, "/no/such/model.json"));
    error = thrown([] { msdd::Model{__FILE__}; });
    EXPECT(error.first == MSDD_MODEL && has(error.second, "damaged"));
}

void handlesMove()
{
    static_assert(!std::is_copy_constructible<msdd::Model>::value, "handles are not copied");
    msdd::Model first;
    const std::string hash = first.hash();
    EXPECT(hash.size() == 64 && has(first.describe(), hash.c_str()));
    msdd::Model second(std::move(first));
    EXPECT(second.hash() == hash);
    const double porosity[2] = {0.1, 0.125};
    double solid[2] = {0, 0};
    second.solidFraction(2, porosity, solid);
    EXPECT(solid[0] > solid[1] && solid[1] > 0.875 && solid[0] < 1);
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3)
    {
        std::fprintf(stderr, "usage: wrapper FOLDER PLUGIN\n");
        return 2;
    }
    feenableexcept(traps);
    guardMasksAndRestores();
    loadingFailsWithTheReason();
    handlesMove();
    const msdd::Model builtin;
    const std::string plugin = std::string("plugin:") + argv[2];
    for (const char* name : {"builtin", "builtin:paper", plugin.c_str()})
    {
        const msdd::Model model(name);
        farOutsideIsClamped(model);
        zeroStrainChangesNothing(model);
        tendenciesAreGranular(model);
        answersDoNotDependOnTheBatch(model);
    }
    conductivityIsChosen(builtin);
    badInputThrowsAndWritesNothing(builtin);
    rveSwellsUnderTraps();
    databaseIsMadeInSeveralGoes(std::string(argv[1]) + "/a.msdd");
    EXPECT(fegetexcept() == traps);
    EXPECT(invalidTraps());
    std::printf("wrapper.cpp: %s\n", failures ? "FAILED" : "ok");
    return failures != 0;
}
