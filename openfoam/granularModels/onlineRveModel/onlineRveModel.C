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

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{
    defineTypeNameAndDebug(onlineRve, 0);
    addToRunTimeSelectionTable(granularModel, onlineRve, dictionary);
}
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::onlineRve::onlineRve
(
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    granularModel(typeName, properties, mesh),
    shared_(choice("rvePer", {"cell", "history"}) == "history"),
    network_
    (
        choice("conductivity", {"affine", "network"}) == "network"
    ),
    boxes_
    (
        granularProperties::ranged
        (
            coeffs_, "strainTolerance", 5e-3, 1e-6, 0.1
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
    if (coeffs_.found("strainTolerance") && !shared_)
    {
        refuse
        (
            "rvePer",
            "cell (the default), which has no strainTolerance",
            "history with strainTolerance, or cell without it"
        );
    }
    file_ = file();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

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
