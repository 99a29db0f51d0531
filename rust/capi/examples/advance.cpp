// advance.c in C++11 with msdd.hpp: handles free themselves, failures are exceptions, and floating-point traps may be on.
#include "msdd.hpp"

#include <cstdio>
#include <vector>

int main(int argc, char** argv)
try
{
    const msdd::Model model(argc > 1 ? argv[1] : "builtin");
    const msdd_grains grains = msdd::grains(100, 1e7, 5e-3);
    const double porosity = 0.125, fabricIndex = 0.05, strain = 0.01;
    std::vector<double> values(model.stateSize());
    std::vector<double*> columns;
    for (double& value : values) { columns.push_back(&value); }
    const std::vector<msdd_output> state = msdd::outputs(columns.data(), columns.size());
    const std::vector<msdd_input> before = msdd::inputs(columns.data(), columns.size());

    msdd_start start = msdd::start(1, 3);
    start.porosity = msdd::input(&porosity);
    start.fabric_index = msdd::input(&fabricIndex);
    model.initialState(grains, start, state.data());

    double k[3], s[3];
    const msdd_output conductivity[] = {msdd::output(&k[0]), msdd::output(&k[1]), msdd::output(&k[2])};
    const msdd_output stress[] = {msdd::output(&s[0]), msdd::output(&s[1]), msdd::output(&s[2])};
    msdd_step step = msdd::step(1, 3);
    step.state = before.data();
    step.next_state = state.data();
    step.thermal_strain = step.total_thermal_strain = msdd::input(&strain);
    step.conductivity = conductivity;
    step.stress = stress;
    model.advance(grains, step);
    std::printf("porosity %.5f, K %.3f %.3f W/(m K), pressure %.1f Pa\n", values[0], k[0], k[1], (s[0] + s[1])/2);
}
catch (const msdd::Error& error)
{
    std::fprintf(stderr, "advance: %s\n", error.what());
    return 1;
}
