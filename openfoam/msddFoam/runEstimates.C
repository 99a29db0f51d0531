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
#include "sphereEstimates.H"
#include "Time.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Change of T in a time as long as the run, over the range of T, below which
//- the bed is steady
static const scalar steadyChange = 1e-3;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::string Foam::runSummary::comparison() const
{
    const runCourse& course = grains_.record().course;
    if (!course.compared())
    {
        return "it was not compared with DEM";
    }
    const stringList beyond(course.beyond());
    if (beyond.empty())
    {
        return
            "the run lies within what it was compared with by DEM";
    }
    string text
    (
        "the run lies beyond what it was compared with by DEM: "
    );
    forAll(beyond, i)
    {
        text += (i ? "; " : "") + beyond[i];
    }
    return text + ". Its error there is unknown";
}


Foam::string Foam::runSummary::radiation() const
{
    if (!grains_.model().isThreeDimensional())
    {
        return string();
    }
    const scalar hottest =
        grains_.record().course.values(runCourse::temperature).most;
    const sphereEstimates::added found
    (
        sphereEstimates(properties_, grains_).radiation(hottest)
    );
    return
        found.text.empty()
      ? string()
      : string
        (
            (found.missing ? "Warning: Radiation " : "Radiation: it ")
          + found.text + "."
        );
}


Foam::string Foam::runSummary::contacts() const
{
    if (!grains_.model().isThreeDimensional())
    {
        return string();
    }
    const scalar largest =
        grains_.record().course.values(runCourse::pressure).most;
    const sphereEstimates::contacts found
    (
        sphereEstimates(properties_, grains_).forces(largest)
    );
    return
        found.text.empty()
      ? string()
      : string((found.beyond ? "Warning: " : "Contacts: ") + found.text + ".");
}


Foam::scalar Foam::runSummary::steadyShare(const heatBalance& heat) const
{
    scalar remaining;
    return
        grains_.record().course.remaining(remaining)
     && heat.stored*remaining > 0
      ? heat.stored/(heat.stored + remaining)
      : scalar(-1);
}


Foam::string Foam::runSummary::steadiness(const heatBalance& heat) const
{
    const runCourse& course = grains_.record().course;
    const Time& time = grains_.mesh().time();
    const scalar rate = course.rate();
    const runCourse::drift drift
    (
        course.drifts(time.value() - grains_.record().startTime)
    );
    const string drifts
    (
        " In as long a time as the run T would change by "
      + brief(100*drift.T) + " % of its range, and p by "
      + brief(100*drift.p) + " % of its largest value."
    );
    if (drift.T <= steadyChange)
    {
        return
            "Steady state: reached; at the end T changes by at most "
          + brief(rate) + " K/s." + drifts;
    }
    const scalar share = steadyShare(heat);
    return
        "Steady state: not reached; at the end T changes by up to "
      + brief(rate) + " K/s"
      + (
            share > 0
          ? ". What the bed takes up falls exponentially: it holds "
          + brief(100*share) + " % of the heat that it will hold when steady."
          : string(", and the bed takes up " + brief(course.uptake().heat) + " W.")
        )
      + drifts;
}


// ************************************************************************* //
