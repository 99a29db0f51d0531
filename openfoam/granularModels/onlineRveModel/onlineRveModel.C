/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
     \\/     M anipulation  |
-------------------------------------------------------------------------------
License
    SPDX-License-Identifier: GPL-3.0-or-later

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty: see the file LICENSE.
\*---------------------------------------------------------------------------*/

#include "onlineRveModel.H"
#include "addToRunTimeSelectionTable.H"

#include <cmath>
#include <map>
#include <utility>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{
    defineTypeNameAndDebug(onlineRve, 0);
    addToRunTimeSelectionTable(granularModel, onlineRve, dictionary);
}
}

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The word of an entry, which must be one of those allowed
static word choice
(
    const dictionary& dict,
    const word& key,
    const wordList& allowed
)
{
    const word value(dict.lookupOrDefault<word>(key, allowed[0]));
    if (!allowed.found(value))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is '" << value << "', allowed: "
            << granularProperties::listed(allowed).c_str()
            << exit(FatalIOError);
    }
    return value;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::onlineRve::onlineRve
(
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    granularModel(typeName, properties, mesh),
    shared_(choice(coeffs_, "rvePer", {"cell", "history"}) == "history"),
    network_
    (
        choice(coeffs_, "conductivity", {"affine", "network"}) == "network"
    ),
    boxes_
    (
        granularProperties::ranged
        (
            coeffs_, "strainTolerance", 1e-3, 1e-6, 0.1
        )
    ),
    packed_(0)
{
    if (&coeffs_ != &properties.surrogateDict())
    {
        granularProperties::checkKeys
        (
            coeffs_,
            {
                "discs", "seed", "compression", "boundary", "relaxation",
                "conductivity", "stiffnessRatio", "frictionAngle",
                "porosityTolerance", "fabricTolerance", "rvePer",
                "strainTolerance"
            }
        );
    }
    file_ = file();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

std::string Foam::granularModels::onlineRve::specification
(
    const scalar porosity,
    const label seed
) const
{
    // Radii uniform over 0.6 to 1.4 of the mean, as the paper's 3 to 7 mm
    const scalar radius = properties_.meanRadius().value();

    OStringStream os;
    os.precision(17);
    os  << "{\"discs\": "
        << label(granularProperties::ranged(coeffs_, "discs", 500, 20, 1e6))
        << ", \"seed\": " << seed
        << ", \"porosity\": " << porosity
        << ", \"compression\": \""
        << choice
           (
               coeffs_,
               "compression",
               {"isotropic", "horizontal", "intermediate", "sheared"}
           ).c_str()
        << "\", \"boundary\": \""
        << choice(coeffs_, "boundary", {"periodic", "walls"}).c_str()
        << "\", \"relaxation\": \""
        << choice(coeffs_, "relaxation", {"fire", "damped"}).c_str()
        << "\", \"radius_min\": " << 0.6*radius
        << ", \"radius_max\": " << 1.4*radius
        << ", \"material\": {\"density\": " << properties_.density().value()
        << ", \"young_modulus\": " << properties_.youngModulus().value()
        << ", \"stiffness_ratio\": "
        << granularProperties::ranged(coeffs_, "stiffnessRatio", 0.8, 0.01, 10)
        << ", \"friction_angle\": "
        << granularProperties::ranged(coeffs_, "frictionAngle", 0.5, 0, 1.5)
        << ", \"wall_stiffness_factor\": 1, \"damping\": 0.1}}";
    return os.str();
}


void Foam::granularModels::onlineRve::pack(const known& cells)
{
    const scalar dPorosity = granularProperties::ranged
    (
        coeffs_, "porosityTolerance", 0.002, 1e-6, 1
    );
    const scalar dFabric = granularProperties::ranged
    (
        coeffs_, "fabricTolerance", 0.02, 1e-6, 2
    );
    const label seed =
        label(granularProperties::ranged(coeffs_, "seed", 1, 0, 1e9));

    std::map<std::pair<label, label>, rveBox> groups;
    std::map<std::pair<label, label>, label> roots;
    for (label celli = 0; celli < cells.size; ++celli)
    {
        // A tolerance t puts values into bins of width t. The seed follows
        // from the bins, so that it does not depend on the processes.
        const label i = label(std::lround(cells.porosity[celli]/dPorosity));
        const label j = label(std::lround(cells.fabricIndex[celli]/dFabric));
        const std::pair<label, label> bin(i, j);

        if (!groups.count(bin))
        {
            const label number = seed + i + 1009*std::abs(j) + 7919*(j < 0);
            groups[bin] =
                rveBox::packed(specification(i*dPorosity, number));
        }
        if (!shared_ || !roots.count(bin))
        {
            roots[bin] = boxes_.add(groups[bin]);
        }
        places_.push_back(rveHistory::place{roots[bin], 0});
        solid_.append(1 - groups[bin].averages.porosity_sum_of_areas);
    }
    packed_ = groups.size();

    Info<< "Packed " << returnReduce(label(packed_), sumOp<label>())
        << " boxes for " << returnReduce(cells.size, sumOp<label>())
        << " cells" << endl;
}


void Foam::granularModels::onlineRve::answer
(
    const query& cells,
    const label row,
    const rveHistory::blend& told
) const
{
    const auto at = [&told](double msdd_averages::*quantity)
    {
        return (1 - told.weight)*(told.from.*quantity)
          + told.weight*(told.to.*quantity);
    };
    const scalar k = properties_.thermalConductivity().value();

    cells.nextState[0][row] = at(&msdd_averages::porosity);
    cells.nextState[1][row] = at(&msdd_averages::fabric_index);
    cells.conductivityXX[row] = k*at
    (
        network_
      ? &msdd_averages::conductivity_network_xx
      : &msdd_averages::conductivity_xx
    );
    cells.conductivityYY[row] = k*at
    (
        network_
      ? &msdd_averages::conductivity_network_yy
      : &msdd_averages::conductivity_yy
    );
    cells.stressXX[row] = at(&msdd_averages::stress_xx);
    cells.stressYY[row] = at(&msdd_averages::stress_yy);
}


void Foam::granularModels::onlineRve::advancePerCell(const query& cells)
{
    for (label row = 0; row < cells.size; ++row)
    {
        const label box =
            places_[cells.cells ? cells.cells[row] : row].box;
        const rveBox before(boxes_.nodes()[box].box);

        boxes_.strain(box, cells.strain[row]);
        answer(cells, row, boxes_.at(rveHistory::place{box, 0}));
        if (cells.trial)
        {
            boxes_.put(box, before);
        }
    }
}


void Foam::granularModels::onlineRve::advanceShared(const query& cells)
{
    bool left = false;
    for (label row = 0; row < cells.size; ++row)
    {
        rveHistory::place& mine =
            places_[cells.cells ? cells.cells[row] : row];
        const rveHistory::place after
        (
            boxes_.moved(mine, cells.strain[row])
        );
        answer(cells, row, boxes_.at(after));
        if (!cells.trial)
        {
            left = left || after.box != mine.box;
            mine = after;
        }
    }
    if (left)
    {
        boxes_.prune(places_);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularModels::onlineRve::initialState
(
    const known& cells,
    scalar* const* state
)
{
    if (!read())
    {
        pack(cells);
    }
    for (label celli = 0; celli < cells.size; ++celli)
    {
        const rveHistory::blend told(boxes_.at(places_[celli]));
        const scalar w = told.weight;
        state[0][celli] =
            (1 - w)*told.from.porosity + w*told.to.porosity;
        state[1][celli] =
            (1 - w)*told.from.fabric_index + w*told.to.fabric_index;
    }
}


Foam::label Foam::granularModels::onlineRve::advance(const query& cells)
{
    if (shared_)
    {
        advanceShared(cells);
    }
    else
    {
        advancePerCell(cells);
    }
    return 0;
}


void Foam::granularModels::onlineRve::solidFraction
(
    const scalarField&,
    scalarField& fraction
) const
{
    fraction = solid_;
}


Foam::granularModel::counters
Foam::granularModels::onlineRve::count() const
{
    return
    {
        {"boxes_packed", packed_},
        {"boxes_strained", boxes_.made()},
        {"boxes_held", boxes_.most()}
    };
}


// ************************************************************************* //
