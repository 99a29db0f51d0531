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

#include "granularState.H"
#include "caseChecks.H"
#include "wallDistance.H"
#include "OStringStream.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Thermal strain of a part in which the grains grow at the start, and least
//- number of parts: spheres under a small load are stiff
static const scalar largestPart = 1e-3;
static const label leastParts = 20;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularState::granularState
(
    const granularProperties& properties,
    const volScalarField& T
)
:
    grainFields(properties, T),
    bound_(model_->smallestStrain()),
    deforms_(false),
    queries_(0),
    rowsAsked_(0),
    cellSteps_(0),
    clamped_(0),
    clampedNow_(0),
    outsideSeen_(false)
{
    allocate();
    askStart();
    reportWalls(T);
    findReaders();
    refresh();
    record_.refresh = [this]() { refresh(); };
    const scalar across =
        leastWallDistance(mesh_)/(2*properties_.meanRadius().value());
    if (across > 0)
    {
        record_.course.see(runCourse::across, across, across);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularState::allocate()
{
    const label cells = mesh_.nCells();
    const label count = state_.size();

    for
    (
        scalarField* column :
        {
            &lastStrain_, &strain_, &halfStrain_, &total_, &zero_,
            &askedTemperature_
        }
    )
    {
        column->resize(cells, Zero);
    }
    asked_.setSize(count, cells);
    sigma_ = asked_.stress;
    rows_.setCapacity(cells);
    before_.setSize(count, cells);
}


void Foam::granularState::askStart()
{
    rows_ = identity(mesh_.nCells());
    gather(zero_);

    const bool restarted = mesh_.time().timeIndex() > 0;
    const label outside = ask(before_, asked_.state, strain_, false);
    if (judge(outside, asked_.state, "At the start") && !restarted)
    {
        policy_.refuseCut();
    }
    policy_.accept();

    // This query is without strain. After a restart, strain accumulated in
    // thermalStrainIncrement is left for the first step, and the total strain
    // given here already contains it
    const scalarField waiting(thermalStrainIncrement_.primitiveField());
    commit();
    startIncrement_ = waiting;
    thermalStrainIncrement_.primitiveFieldRef() = waiting;

    // The strain of the last query is not known after a restart; any value
    // but 0 makes the next query include all cells
    lastStrain_ = restarted ? 1 : 0;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularState::warm
(
    const volScalarField& T,
    const std::function<void()>& balance
)
{
    const scalarField start(temperature_);
    const scalarField way(T.primitiveField() - start);
    if (!(gMax(mag(way)()) > 0))
    {
        return;
    }
    const scalar largest =
        properties_.thermalExpansion().value()*gMax(mag(way)());
    const label parts =
        largest > 0
      ? max(leastParts, label(std::ceil(largest/largestPart)))
      : 1;
    for (label part = 1; part <= parts; ++part)
    {
        const scalarField from(temperature_);
        strain
        (
            from,
            part == parts
          ? scalarField(T.primitiveField())
          : scalarField(start + (scalar(part)/parts)*way)
        );
        scalar error;
        if (propose(false, error))
        {
            policy_.refuseCut();
        }
        balance();
        commit();
    }
    refresh();

    OStringStream text;
    text.precision(4);
    text<< "The bed has no thermal strain at initialTemperature, "
        << gMin(start) << " to " << gMax(start) << " K. It was brought to T, "
        << gMin(T.primitiveField()) << " to " << gMax(T.primitiveField())
        << " K, by a thermal strain of up to " << largest << " in " << parts
        << " parts: the mean pressure at the start is "
        << pressure_.weightedAverage(mesh_.V()).value() << " Pa.";
    runRecord::note(text.str());
}


// ************************************************************************* //
