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

#include "caseWarnings.H"
#include "briefNumber.H"
#include "heatEquation.H"
#include "mappedPatchBase.H"
#include "fixedGradientFvPatchFields.H"
#include "zeroGradientFvPatchFields.H"
#include "patchWave.H"
#include "resistingWall.H"
#include "wallDistance.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Differences of temperatures below this share of them are rounding
static const scalar rounding = 1e-9;

//- Times of a run over the time in which heat spreads that are usual
static const scalar leastSpread = 0.02;
static const scalar mostSpread = 50;

//- How much a source of heat may warm a bed [K]: no solid is solid beyond; and
//- how much it is taken to warm it at most when properties are looked at
static const scalar mostRise = 5000;
static const scalar heated = 500;

//- Distance of the temperatures at which properties are looked at [K], and the
//- largest number of them
static const scalar stepOfT = 1;
static const scalar mostSteps = 5000;


//- Whether a wall is given its temperature outside of a resistance
static bool holdsTemperature(const fvPatchScalarField& wall)
{
    return
        dynamic_cast<const resistingWall*>(&wall)
     && heatEquation::entries(wall).found("temperature");
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::caseWarnings::readWalls()
{
    labelHashSet given;
    strange_ = false;
    for (label i = 0; i < mesh_.boundaryMesh().nNonProcessor(); ++i)
    {
        const fvPatchScalarField& wall = T_.boundaryField()[i];
        if (!isWall(mesh_.boundaryMesh()[i]))
        {
            continue;
        }
        range T;
        if
        (
            heatConduction::isGiven(wall)
         && !isA<mappedPatchBase>(mesh_.boundaryMesh()[i])
        )
        {
            T.least = gMin(wall);
            T.most = gMax(wall);
            include(heatEquation::entries(wall), "uniformValue", T);
            given.insert(i);
        }
        else if (holdsTemperature(wall))
        {
            include(heatEquation::entries(wall), "temperature", T);
            given.insert(i);
        }
        else
        {
            strange_ =
                strange_
             || !(
                    isA<zeroGradientFvPatchScalarField>(wall)
                 || (
                        wall.type() == "fixedGradient"
                     && gMax
                        (
                            mag
                            (
                                refCast<const fixedGradientFvPatchScalarField>
                                (
                                    wall
                                ).gradient()
                            )()
                        ) == 0
                    )
                );
        }
        walls_.insert(wall.patch().name(), T);
    }
    if (given.size())
    {
        way_ = gMax(patchWave(mesh_, given, false).distance());
    }
}


void Foam::caseWarnings::checkTemperatures()
{
    range all;
    all.least = gMin(T_.primitiveField());
    all.most = gMax(T_.primitiveField());
    steady_ = true;
    forAllConstIters(walls_, iter)
    {
        const range& T = iter.val();
        if (T.least > T.most)
        {
            continue;
        }
        if (T.least < 0)
        {
            add
            (
                "Wall '" + iter.key() + "' is given down to " + brief(T.least)
              + " K in this run, allowed: 0 K and above. The run ends there:"
                " temperatures are in Kelvin"
            );
        }
        steady_ = steady_ && T.most - T.least <= rounding*mag(T.most);
        all.least = min(all.least, T.least);
        all.most = max(all.most, T.most);
    }
    temperatures_ = all;
    if
    (
        !strange_ && walls_.size() && !sources_.size()
     && properties_.getOrDefault<word>("flow", "none") == "none"
     && all.most - all.least <= rounding*mag(all.most)
    )
    {
        add
        (
            "Nothing heats or cools: no wall has another temperature than the"
            " bed, " + brief(all.most) + " K, and there is no heat source. Give"
            " a wall of T a temperature, such as { type fixedValue; value"
            " uniform 350; }"
        );
    }
}


void Foam::caseWarnings::checkProperties()
{
    const range& T = temperatures_;
    const scalar most = T.most + (sources_.size() ? heated : scalar(0));
    const scalar least = max(T.least, scalar(0));
    const scalar step = max(stepOfT, (most - least)/mostSteps);
    bool positive = true;
    for (const word key : {"thermalConductivity", "heatCapacity"})
    {
        const temperatureFunction& function =
            key == "heatCapacity"
          ? properties_.heatFunction()
          : properties_.conductivityFunction();
        if (function.isNumber())
        {
            continue;
        }
        const autoPtr<Function1<scalar>> value
        (
            Function1<scalar>::New(key, properties_)
        );
        for (scalar t = least; t <= most; t += step)
        {
            if (!(value->value(t) > 0))
            {
                positive = false;
                add
                (
                    "Entry '" + key + "' of constant/granularProperties is "
                  + brief(value->value(t)) + " at " + brief(t) + " K, allowed:"
                    " > 0. The run ends when a cell gets to this temperature"
                );
                break;
            }
        }
    }
    for (scalar t = least; positive && t <= most; t += step)
    {
        const scalar ratio = grains_.model().conductivityRatio(t);
        if (ratio > 0 && ratio < 1)
        {
            add
            (
                "At " + brief(t) + " K the spheres conduct "
              + brief(properties_.conductivityFunction().value(t))
              + " W/(m K), that is " + brief(ratio) + " of the gas between them,"
                " allowed: at least as well as the gas. The run ends when a cell"
                " gets to this temperature"
            );
            break;
        }
    }
    if (positive)
    {
        checkGas();
    }
}


void Foam::caseWarnings::checkSources()
{
    const scalar q = grains_.record().course.values(runCourse::source).most;
    for (const fv::option& source : sources_)
    {
        // A part that depends on T holds the bed at a temperature
        const dictionary rates
        (
            source.coeffs().subOrEmptyDict("injectionRateSuSp")
        );
        Tuple2<scalar, scalar> rate(0, 0);
        if
        (
            source.type() == "scalarSemiImplicitSource"
         && rates.readIfPresent("T", rate) && rate.second() != 0
        )
        {
            return;
        }
    }
    scalar narrow = GREAT;
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        if (mesh_.geometricD()[i] > 0)
        {
            narrow = min(narrow, mesh_.bounds().span()[i]);
        }
    }
    const temperatureFunction& k = properties_.conductivityFunction();
    const scalar rise = min
    (
        sqr(narrow)/(8*k.usual().value()),
        duration_
       /(properties_.density().value()*properties_.heatCapacity().value())
    );
    if (q*rise > mostRise)
    {
        add
        (
            "The heat sources give up to " + brief(q) + " W/m3. More than about "
          + brief(mostRise/rise) + " W/m3 warm this bed by more than "
          + brief(mostRise) + " K in this run, even if it conducts as well as"
            " its grains: no grains stay solid"
        );
    }
}


void Foam::caseWarnings::checkTimes()
{
    const scalarField& V = mesh_.V();
    const scalar a =
        conductivity_
       /(
            gSum(V*grains_.bulkDensity().primitiveField())/gSum(V)
           *properties_.heatCapacity().value()
        );
    const Time& time = mesh_.time();
    if (way_ > 0 && !grains_.record().continues && duration_ < GREAT)
    {
        const scalar whole = sqr(way_)/a;
        const string takes("Heat takes about " + brief(whole) + " s to spread");
        if (duration_ < leastSpread*whole)
        {
            add
            (
                takes + " over the " + brief(way_) + " m from the walls that are"
                " given a temperature. By endTime, " + brief(duration_)
              + " s after the start, it has come some "
              + brief(Foam::sqrt(a*duration_)) + " m far"
            );
        }
        else if (duration_ > mostSpread*whole && steady_ && !strange_)
        {
            add
            (
                takes + ": nothing changes any more long before endTime, "
              + brief(duration_) + " s after the start"
            );
        }
    }
    const scalar crossed = sqr(cellSize_)/a;
    const scalar deltaT = time.deltaTValue();
    if
    (
        deltaT > crossed
     && !time.controlDict().getOrDefault<Switch>("adjustTimeStep", false)
    )
    {
        add
        (
            "Heat crosses a cell in about " + brief(crossed) + " s, and deltaT"
            " is " + brief(deltaT) + " s: longer steps are stable, but"
            " inaccurate at the beginning. Take shorter ones, or adaptive ones"
            " (adjustTimeStep yes, timeScheme secondOrder)"
        );
    }
}


// ************************************************************************* //
