#include "msdd-bridge/src/bridge.hpp"
#include "msdd-bridge/src/lib.rs.h"

#include <cfenv>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace bridge
{

namespace
{

const int traps = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;

std::vector<msdd_output> columns(rust::Vec<double>& all, std::size_t count)
{
    std::vector<msdd_output> result;
    for (std::size_t k = 0; k < count; ++k)
    {
        result.push_back(msdd::output(all.data() + k*(all.size()/count)));
    }
    return result;
}

rust::Vec<double> filled(std::size_t size)
{
    rust::Vec<double> result;
    result.reserve(size);
    for (std::size_t i = 0; i < size; ++i)
    {
        result.push_back(-7);
    }
    return result;
}

} // namespace

std::unique_ptr<Model> load(rust::Str source)
{
    return std::unique_ptr<Model>(new Model(msdd::Model(std::string(source))));
}

std::unique_ptr<Model> moved(Model& model)
{
    return std::unique_ptr<Model>(new Model(std::move(model.wrapper())));
}

void move_into_itself(Model& model)
{
    msdd::Model& itself = model.wrapper();
    model.wrapper() = std::move(itself);
}

rust::Vec<double> Model::initial_state
(
    rust::Slice<const double> porosity,
    rust::Slice<const double> fabricIndex
) const
{
    msdd_start start = msdd::start(porosity.size(), 3);
    start.porosity = msdd::input(porosity.data());
    start.fabric_index = msdd::input(fabricIndex.data());
    rust::Vec<double> state = filled(state_size()*porosity.size());
    model_.initialState(msdd::grains(1, 1, 1), start, columns(state, state_size()).data());
    return state;
}

void Model::advance(Cells& cells) const { advance(cells, sizeof(msdd_step)); }

rust::Vec<double> Model::wall_friction(double meanRadius) const
{
    double limit = -7, slip = -7;
    rust::Vec<double> result;
    if (model_.wallFriction(msdd::grains(1, 1, meanRadius), limit, slip))
    {
        result.push_back(limit);
        result.push_back(slip);
    }
    else if (limit != -7 || slip != -7)
    {
        throw std::logic_error("set although the model has none");
    }
    return result;
}

void Model::advance_with_wrong_size(Cells& cells) const { advance(cells, sizeof(msdd_step) - 8); }

void Model::advance(Cells& cells, std::size_t structSize) const
{
    msdd_step step = msdd::step(cells.thermal_strain.size(), 3);
    step.struct_size = structSize;
    const std::vector<msdd_output> state = columns(cells.state, state_size());
    std::vector<msdd_input> before;
    for (const msdd_output& column : state)
    {
        before.push_back(msdd::input(column.values));
    }
    const msdd_output conductivity[] =
        {msdd::output(cells.conductivity_xx.data()), msdd::output(cells.conductivity_yy.data()), msdd::output(nullptr)};
    const msdd_output stress[] =
        {msdd::output(cells.stress_xx.data()), msdd::output(cells.stress_yy.data()), msdd::output(nullptr)};
    step.state = before.data();
    step.next_state = state.data();
    step.thermal_strain = msdd::input(cells.thermal_strain.data());
    step.conductivity = conductivity;
    step.stress = stress;
    model_.advance(msdd::grains(1, 1, 1), step);
    cells.clamped_cells = step.outside_cells;
}

rust::Vec<double> strained_rves(double strain)
{
    msdd::Rve rve = msdd::Rve::pack("{\"discs\": 40, \"porosity\": 0.13}");
    msdd::Rve twin = msdd::Rve::fromJson(rve.toJson());
    rust::Vec<double> pressures;
    for (msdd::Rve* each : {&rve, &twin})
    {
        each->strain(strain);
        pressures.push_back(each->homogenise().pressure);
    }
    return pressures;
}

void trap()
{
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(traps);
}

bool trapped_and_clear() { return fegetexcept() == traps && std::fetestexcept(FE_ALL_EXCEPT) == 0; }

} // namespace bridge
