// advance.c in C++11 with msdd.hpp: handles free themselves, failures are exceptions, and floating-point traps may be on.
#include "msdd.hpp"

#include <cstdio>
#include <vector>

int main(int argc, char** argv)
try
{
    const msdd::Surrogate model(argc > 1 ? argv[1] : "builtin");
    const msdd_material grains = msdd::material(100, 1e7, 5e-3);
    const double porosity = 0.125, fabricIndex = 0.05, strain = 0.01;
    double kxx, kyy, sxx, syy;
    std::vector<double> values(model.stateSize());
    std::vector<double*> state;
    for (double& value : values) { state.push_back(&value); }

    msdd_initial initial = msdd::initial(1);
    initial.porosity = &porosity;
    initial.fabric_index = &fabricIndex;
    model.initialState(grains, initial, state.data());

    msdd_batch batch = msdd::batch(1);
    batch.state = batch.next_state = state.data();
    batch.thermal_strain = batch.total_thermal_strain = &strain;
    batch.conductivity_xx = &kxx;
    batch.conductivity_yy = &kyy;
    batch.stress_xx = &sxx;
    batch.stress_yy = &syy;
    model.advance(grains, batch);
    std::printf("porosity %.5f, K %.3f %.3f W/(m K), pressure %.1f Pa\n", values[0], kxx, kyy, (sxx + syy)/2);
}
catch (const msdd::Error& error)
{
    std::fprintf(stderr, "advance: %s\n", error.what());
    return 1;
}
