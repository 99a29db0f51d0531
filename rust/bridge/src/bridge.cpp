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

std::vector<double*> columns(rust::Vec<double>& all, std::size_t count)
{
    std::vector<double*> result;
    for (std::size_t k = 0; k < count; ++k)
    {
        result.push_back(all.data() + k*(all.size()/count));
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
    return std::unique_ptr<Model>(new Model(msdd::Surrogate(std::string(source))));
}

std::unique_ptr<Model> moved(Model& model)
{
    return std::unique_ptr<Model>(new Model(std::move(model.surrogate())));
}

void move_into_itself(Model& model)
{
    msdd::Surrogate& itself = model.surrogate();
    model.surrogate() = std::move(itself);
}

rust::Vec<double> Model::initial_state
(
    rust::Slice<const double> porosity,
    rust::Slice<const double> fabricIndex
) const
{
    msdd_initial initial = msdd::initial(porosity.size());
    initial.porosity = porosity.data();
    initial.fabric_index = fabricIndex.data();
    rust::Vec<double> state = filled(state_size()*porosity.size());
    surrogate_.initialState(msdd::material(1, 1, 1), initial, columns(state, state_size()).data());
    return state;
}

void Model::advance(Cells& cells) const { advance(cells, sizeof(msdd_batch)); }

rust::Vec<double> Model::wall_friction(double meanRadius) const
{
    double limit = -7, slip = -7;
    rust::Vec<double> result;
    if (surrogate_.wallFriction(msdd::material(1, 1, meanRadius), limit, slip))
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

void Model::advance_with_wrong_size(Cells& cells) const { advance(cells, sizeof(msdd_batch) - 8); }

void Model::advance(Cells& cells, std::size_t structSize) const
{
    msdd_batch batch = msdd::batch(cells.thermal_strain.size());
    batch.struct_size = structSize;
    const std::vector<double*> state = columns(cells.state, state_size());
    batch.state = state.data();
    batch.next_state = state.data();
    batch.thermal_strain = cells.thermal_strain.data();
    batch.conductivity_xx = cells.conductivity_xx.data();
    batch.conductivity_yy = cells.conductivity_yy.data();
    batch.stress_xx = cells.stress_xx.data();
    batch.stress_yy = cells.stress_yy.data();
    surrogate_.advance(msdd::material(1, 1, 1), batch);
    cells.clamped_cells = batch.clamped_cells;
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
