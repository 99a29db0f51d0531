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

#include "secondOrderScheme.H"
#include "resistingWall.H"
#include "stepWatch.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "addToRunTimeSelectionTable.H"

#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace timeSchemes
{
    defineTypeNameAndDebug(secondOrder, 0);
    addToRunTimeSelectionTable(timeScheme, secondOrder, dictionary);
}
}

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Step-size control: the estimates are proportional to the square of the step,
//- so the next step is safety/sqrt(error over tolerance) times the last one,
//- limited to these factors
static const scalar safety = 0.9;
static const scalar largestGrowth = 3;
static const scalar largestCut = 0.1;

//- Defaults: the tolerance of T is toleranceShare of the range of T seen so
//- far, but at least noiseShare of the largest T, which is above the error of
//- the linear solver; the smallest step is smallestShare of the end time. None
//- may be given below leastShare of it, which still is a hundred times the
//- rounding error of the time
static const scalar toleranceShare = 1e-3;
static const scalar noiseShare = 1e-6;
static const scalar smallestShare = 5e-11;
static const scalar leastShare = 1e-14;

static const keyTable stepKeys
(
    "adaptive steps",
    {
        {
            "adjustTimeStep",
            "whether steps follow from the error; requires `timeScheme"
            " secondOrder`", "-", "yes, no", "no"
        },
        {
            "minDeltaT",
            "smallest adaptive step. A step of this size is taken even if its"
            " error is above the tolerance", "s",
            "`endTime`/1e14 (with another `stopAt` `deltaT`/1e14) to 1e15",
            "5e-11 of the same"
        },
        {
            "maxDeltaT", "largest adaptive step", "s", "`minDeltaT` to 1e15",
            "none"
        }
    }
);

//- The end of the run, of which the least steps are shares [s]. Where stopAt is
//- not endTime, OpenFOAM takes it as GREAT: then the first step counts
static scalar lastTime(const Time& time)
{
    const scalar end = time.endTime().value();
    return end < GREAT ? end : time.deltaTValue();
}

//- How often a step is halved because there is no equilibrium of the stress
static const label mostHalvings = 10;

//- Conductivity at the start of the last step, where grains move
static const char* const earlierName = "conductivityBefore";

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeSchemes::secondOrder::secondOrder
(
    const dictionary& dict,
    volScalarField& T,
    granularState& grains,
    granularMechanics& mechanics,
    neighbourSolids& neighbours,
    const granularProperties& properties
)
:
    timeScheme(dict, T, grains, mechanics, neighbours, properties),
    adaptive_(time_.controlDict().lookupOrDefault("adjustTimeStep", false)),
    temperatureTolerance_
    (
        dict.found("temperatureTolerance")
      ? keys.number(dict, "temperatureTolerance")
      : 0
    ),
    stateTolerance_(keys.number(dict, "stateTolerance")),
    minDeltaT_
    (
        stepKeys.number
        (
            time_.controlDict(), "minDeltaT", smallestShare*lastTime(time_), 1,
            adaptive_ ? leastShare*lastTime(time_) : 0
        )
    ),
    maxDeltaT_
    (
        stepKeys.number
        (
            time_.controlDict(), "maxDeltaT", GREAT, 1, minDeltaT_
        )
    ),
    due_(time_, grains.record().startTime),
    loads_(grains.record().startTime, time_.endTime().value()),
    stage_(T.size(), Zero),
    rate_(T.size(), Zero),
    lastDeltaT_(grains.record().lastDeltaT),
    firstHeat_(T.mesh().boundary().size(), Zero),
    firstSource_(0),
    firstOutside_(0),
    firstGiven_(0),
    rejected_(0),
    forced_(0)
{
    updateTemperatureRange();
    if (adaptive_)
    {
        mechanics.addLoads(loads_);
        heat_.addLoads(loads_);
    }
    if (mechanics.canFail())
    {
        IOobject io
        (
            earlierName, time_.timeName(), T.mesh(),
            IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE
        );
        if (!io.typeHeaderOk<volSymmTensorField>(true))
        {
            lastDeltaT_ = 0;
        }
        earlier_.reset
        (
            new volSymmTensorField
            (
                io,
                T.mesh(),
                dimensionedSymmTensor
                (
                    properties.thermalConductivity().dimensions(), Zero
                ),
                extrapolatedCalculatedFvPatchSymmTensorField::typeName
            )
        );
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::timeSchemes::secondOrder::updateTemperatureRange()
{
    runRecord& record = grains_.record();
    const auto look = [&record](const scalarField& T)
    {
        for (const scalar value : T)
        {
            record.leastT = min(record.leastT, value);
            record.mostT = max(record.mostT, value);
        }
    };
    look(T_.primitiveField());
    for (const fvPatchScalarField& patch : T_.boundaryField())
    {
        scalar T = 0;
        const auto* wall = dynamic_cast<const resistingWall*>(&patch);
        if (heatConduction::isGiven(patch))
        {
            look(patch);
        }
        else if (wall && patch.size() && wall->outside(T))
        {
            look(scalarField(1, T));
        }
    }
    heat_.flow().extend(record.leastT, record.mostT);
    // On all processes equally, because the size of the steps follows from it
    reduce(record.leastT, minOp<scalar>());
    reduce(record.mostT, maxOp<scalar>());
}


Foam::scalar Foam::timeSchemes::secondOrder::tolerance() const
{
    if (temperatureTolerance_ > 0)
    {
        return temperatureTolerance_;
    }
    // The range includes the result of this step: a case that starts at a
    // uniform temperature has no range before its first step
    const runRecord& record = grains_.record();
    const scalar least = min(record.leastT, gMin(T_.primitiveField()));
    const scalar most = max(record.mostT, gMax(T_.primitiveField()));
    return max
    (
        max
        (
            toleranceShare*(most - least),
            noiseShare*max(mag(most), mag(least))
        ),
        VSMALL
    );
}


Foam::scalar Foam::timeSchemes::secondOrder::fitted(const scalar deltaT) const
{
    const scalar all = due_.next(deltaT);
    const scalar whole = dueTimes::part(all, deltaT);
    const scalar followed =
        max(minDeltaT_, loads_.follow(time_.value(), whole));
    return
        followed >= whole ? whole
      : all - followed > followed ? followed
      : dueTimes::part(all, followed);
}


Foam::scalar Foam::timeSchemes::secondOrder::attempt
(
    const symmTensorField& K,
    const scalar deltaT,
    bool& cut
)
{
    stepWatch::doing("the heat equation");
    const scalar difference = stages(K, deltaT);
    const scalar error = adaptive_ ? difference/tolerance() : 0;
    cut = false;

    if (adaptive_ && error > 1 && deltaT > minDeltaT_)
    {
        return error;
    }
    stepWatch::doing("the model");
    scalar stateError;
    grains_.strain(Told_, T_.primitiveField());
    cut = grains_.propose(true, stateError);

    return max(error, stateError/stateTolerance_);
}


bool Foam::timeSchemes::secondOrder::settle
(
    const scalar deltaT,
    const bool lastAttempt
)
{
    stepWatch::doing("the mechanics");
    mechanics_.setForce(heat_.flow().force()());
    if (lastAttempt || !mechanics_.canFail())
    {
        advanceTime();
        return mechanics_.solve(true);
    }
    // Displacements and pressures of walls are evaluated at the step's end
    const scalar start = time_.value();
    time_.value() = start + deltaT;
    const bool found = mechanics_.solve(false);
    time_.value() = start;
    if (found)
    {
        advanceTime();
    }
    return found;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::timeSchemes::secondOrder::step()
{
    runRecord& record = grains_.record();
    scalar deltaT = time_.deltaTValue();
    scalar error = 0;
    bool cut = false;
    label halvings = 0;

    if (adaptive_)
    {
        deltaT = record.nextDeltaT > 0 ? record.nextDeltaT : deltaT;
        deltaT = fitted(max(minDeltaT_, min(maxDeltaT_, deltaT)));
    }
    setLog();
    Told_ = T_.primitiveField();
    const symmTensorField& K =
        mechanics_.pulledBack(grains_.conductivity().primitiveField());
    neighbours_.begin();
    heat_.flow().begin();

    while (true)
    {
        time_.setDeltaT(deltaT, false);
        error = attempt(K, deltaT, cut);

        const bool smallest = !adaptive_ || deltaT <= minDeltaT_;
        if (cut && smallest)
        {
            grains_.policy().refuseCut();
        }
        if (!cut && (smallest || error <= 1))
        {
            if (settle(deltaT, smallest || halvings == mostHalvings))
            {
                break;
            }
            cut = true;
            ++halvings;
        }
        ++rejected_;
        T_.primitiveFieldRef() = Told_;
        grains_.reject(Told_);
        neighbours_.restore();
        heat_.flow().restore();
        const scalar factor =
            cut ? 0.5 : max(largestCut, safety/std::sqrt(error));
        deltaT = fitted(max(minDeltaT_, deltaT*factor));
    }
    forced_ += adaptive_ && error > 1;
    updateTemperatureRange();
    if (mechanics_.canFail())
    {
        lastDeltaT_ = deltaT;
        earlier_().primitiveFieldRef() = K;
        earlier_().correctBoundaryConditions();
    }
    grains_.commit();

    accountStages(deltaT);
    observe(deltaT);
    if (adaptive_)
    {
        const scalar factor = safety/std::sqrt(max(error, SMALL));
        record.nextDeltaT = deltaT*min(largestGrowth, factor);
        // Time::run() stops within half of this size of the end time
        time_.setDeltaT(due_.landing(min(maxDeltaT_, record.nextDeltaT)), false);
    }
}


// ************************************************************************* //
