/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM
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

const Foam::keyTable Foam::granularModels::onlineRve::keys
(
    "onlineRveCoeffs",
    {
        {"discs", "number of grains in a box", "-", "20 to 1e6", "500"},
        {
            "seed",
            "number from which the random places and radii of all packings"
            " follow", "-", "0 to 1e9", "1"
        },
        {
            "compression",
            "packing of a box: compressed along x and y equally, along x only,"
            " twice as fast along x as along y, or along x while it slowly"
            " extends along y", "-",
            "isotropic, horizontal, intermediate, sheared", "isotropic"
        },
        {
            "boundary",
            "boundary of a box; rigid walls make it softer than the material"
            " inside", "-", "periodic, walls", "periodic"
        },
        {
            "relaxation",
            "how grains come to rest after a strain: FIRE (a fast method of"
            " minimisation) or their own damped motion", "-", "fire, damped",
            "fire"
        },
        {
            "conductivity", "as in `networkCoeffs`", "-", "affine, network",
            "affine"
        },
        {
            "stiffnessRatio", "tangential over normal stiffness of a contact",
            "-", "0.01 to 10", "0.8"
        },
        {
            "frictionAngle",
            "friction angle between grains: they slide at a tangential force of"
            " tan(angle) times the normal force", "rad", "0 to 1.5", "0.5"
        },
        {
            "porosityTolerance",
            "cells start from the same packing if their initial porosities"
            " agree within this", "-", "1e-6 to 1", "0.002"
        },
        {
            "fabricTolerance", "and their initial fabric indices within this",
            "-", "1e-6 to 2", "0.02"
        },
        {
            "rvePer",
            "`cell`: every cell has its own box. `history`: cells of one"
            " packing share boxes as long as their strains agree within"
            " `strainTolerance`", "-", "cell, history", "cell"
        },
        {
            "strainTolerance",
            "with `rvePer history`: logarithmic strain of one step of a box; a"
            " cell between two boxes gets their linear mean. Smaller reversals"
            " of the strain are not seen", "-", "1e-6 to 0.1", "5e-3"
        }
    }
);


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::onlineRve::onlineRve
(
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    granularModel(typeName, properties, mesh),
    shared_(keys.choice(coeffs_, "rvePer") == "history"),
    network_(keys.choice(coeffs_, "conductivity") == "network"),
    boxes_(keys.number(coeffs_, "strainTolerance")),
    packed_(0)
{
    checkCoeffs(keys);
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
    cells.conductivity[row].xx() = k*at
    (
        network_
      ? &msdd_averages::conductivity_network_xx
      : &msdd_averages::conductivity_xx
    );
    cells.conductivity[row].yy() = k*at
    (
        network_
      ? &msdd_averages::conductivity_network_yy
      : &msdd_averages::conductivity_yy
    );
    cells.stress[row].xx() = at(&msdd_averages::stress_xx);
    cells.stress[row].yy() = at(&msdd_averages::stress_yy);
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
