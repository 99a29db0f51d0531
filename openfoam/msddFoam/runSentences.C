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

#include "runSummary.H"
#include "briefNumber.H"
#include "pascals.H"
#include "Time.H"

#include <map>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::runSummary::heatBalance Foam::runSummary::heat() const
{
    const runRecord& record = grains_.record();
    return
    {
        returnReduce(sum(record.heat), sumOp<scalar>()),
        returnReduce(record.sourceHeat, sumOp<scalar>()),
        grains_.storedHeat(T_) - record.startHeat,
        returnReduce(record.exchanged, sumOp<scalar>()),
        max(runRecord::roundedHeat*grains_.initialHeat(), VSMALL)
    };
}


Foam::string Foam::runSummary::range() const
{
    const int64_t clamped = grains_.clampedQueries();
    if (!clamped)
    {
        return
            "Range: no state was outside the range of the model, "
          + string(grains_.record().course.beyond().size() ? "but " : "and ")
          + comparison() + ".";
    }
    const scalar share = 100*scalar(clamped)/max(scalar(grains_.asked()), 1.0);
    const label cells =
        returnReduce(grains_.mesh().nCells(), sumOp<label>());
    return
        "Range: " + brief(share) + " % of the states were outside the range"
        " of the model, where it extrapolates. At the end "
      + Foam::name(grains_.cellsOutside()) + " of " + Foam::name(cells)
      + " cells are outside (field inTrainingRange is 0 there)."
      + outsideBy()
      + (
            grains_.model().reportsDistances()
          ? " Such cells, at most 10000 of each process, are listed in"
            " postProcessing/msddFoam/offenders.json."
          : ""
        )
      + " Compared: " + comparison() + ".";
}


Foam::string Foam::runSummary::outsideBy() const
{
    const std::map<std::string, string> reasons
    ({
        {"answers_outside_by_density", "the density at which it jams"},
        {"answers_outside_by_pressure", "the pressure"},
        {"answers_outside_by_stress_ratio", "the stress ratio"},
        {"answers_outside_by_gas", "the gas or its temperature"}
    });
    const scalar all = max(scalar(grains_.asked()), 1.0);
    string found;
    for (const auto& count : grains_.modelCounts())
    {
        const auto reason = reasons.find(count.first);
        if (reason != reasons.end() && count.second)
        {
            found +=
                (found.empty() ? " By " : ", by ") + reason->second + " "
              + brief(100*scalar(count.second)/all) + " %";
        }
    }
    return found.empty() ? found : string(found + ".");
}


Foam::string Foam::runSummary::warning() const
{
    const scalar spread = grains_.meanSpread();
    if (spread < 0)
    {
        return "Warning: this model does not state how far packings of equal state"
            " differ.";
    }
    return
        "Warning: sampling scatter of the packing: "
      + brief(100*spread) + " % of K (standard deviation between boxes of equal"
        " state, mean over the bed); no cell is more accurate.";
}


Foam::string Foam::runSummary::balance(const heatBalance& heat) const
{
    if (heat.exchanged < heat.least)
    {
        return "Heat: none went into the bed or out of it.";
    }
    return
        string(heat.difference() > runRecord::muchHeat ? "Warning: heat is lost or made. " : "")
      + "Heat: since the start " + brief(heat.patches) + " J came in"
        " through the boundary and " + brief(heat.sources) + " J from sources;"
        " the grains hold " + brief(heat.stored) + " J more. The energy balance"
        " closes to " + brief(heat.difference()) + " of all heat that was exchanged.";
}


Foam::string Foam::runSummary::unloaded() const
{
    const runCourse::relief& relief = grains_.record().course.unloaded();
    if (!relief.periods)
    {
        return string();
    }
    const auto seconds = [](const scalar time)
    {
        OStringStream text;
        text.precision(4);
        text<< time;
        return text.str();
    };
    string text
    (
        "Warning: the bed was nearly without load, its mean pressure below "
      + brief(100*runCourse::slightLoad) + " % of the largest before, from "
      + seconds(relief.since) + " to " + seconds(relief.until) + " s"
    );
    if (relief.periods > 1)
    {
        text +=
            ", and in " + Foam::name(relief.periods - 1) + " later period"
          + (relief.periods > 2 ? "s, " : ", ")
          + seconds(relief.whole) + " s in all";
    }
    text += ". The least mean pressure was " + pascals(relief.least) + '.';
    if (grains_.record().course.lostLoad())
    {
        text +=
            " From " + seconds(relief.loaded) + " to "
          + seconds(grains_.mesh().time().value())
          + " s the bed carries load again, up to " + pascals(relief.regained)
          + ". This pressure is not validated: spheres that are sheared near no"
            " load compact more than the law does. In a vessel heated from"
            " outside, the pressure was up to " + brief(lostLoadError)
          + " times the pressure in DEM.";
    }
    return text;
}


Foam::string Foam::runSummary::contact() const
{
    label loose = 0;
    for (const scalar p : grains_.pressure().primitiveField())
    {
        loose += !(p > 0);
    }
    reduce(loose, sumOp<label>());
    const label cells =
        returnReduce(grains_.mesh().nCells(), sumOp<label>());
    return loose
      ? "Warning: grains in " + Foam::name(loose) + " of " + Foam::name(cells)
      + " cells carry no load at the end. Where they have lost contact, the"
        " model of a loaded bed is not valid."
      : string();
}


Foam::string Foam::runSummary::motion() const
{
    if (mechanics_.type() == "none")
    {
        return
            "Grains: they stay in their cells (mechanics none), as in the"
            " paper. Real grains move where one part of the bed is heated more"
            " than another; mechanics equilibrium in"
            " constant/granularProperties computes that.";
    }
    const granularMechanics::counters moved(mechanics_.count());
    return
        "Grains: they moved by at most " + brief(1e3*moved.displacement)
      + " mm; "
      + (moved.gap > 0
          ? "they left walls, by at most " + brief(1e3*moved.gap) + " mm; "
          : string())
      + (moved.unconverged
          ? Foam::name(moved.unconverged) + " steps ended out of balance, by at"
            " most " + brief(moved.unbalanced) + " Pa."
          : string("the stress was brought into balance in every step."));
}


Foam::string Foam::runSummary::cost() const
{
    const scalar processor = returnReduce
    (
        grains_.mesh().time().elapsedCpuTime(), sumOp<scalar>()
    );
    const scalar steps = max(scalar(grains_.cellSteps()), 1.0);
    const label processes = Pstream::nProcs();
    return
        "Cost: " + brief(wallClock_.elapsedTime()) + " s on "
      + Foam::name(processes) + (processes > 1 ? " processes, " : " process, ")
      + brief(processor) + " s of processor time, "
      + brief(1e6*processor/steps) + " microseconds for each cell and step.";
}


// ************************************************************************* //
