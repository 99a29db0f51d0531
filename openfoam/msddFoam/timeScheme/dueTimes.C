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

#include "dueTimes.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

//- Shares of a step or an interval that are rounding errors
static const Foam::scalar rounding = 1e-9;


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeSchemes::dueTimes::dueTimes
(
    const Time& time,
    const scalar& firstStart
)
:
    time_(time),
    firstStart_(firstStart)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::timeSchemes::dueTimes::toWrite() const
{
    const word control
    (
        time_.controlDict().lookupOrDefault<word>("writeControl", "timeStep")
    );
    const scalar left = time_.endTime().value() - time_.value();

    if
    (
        control != "runTime"
     && control != "adjustableRunTime"
     && control != "adjustable"
    )
    {
        return left;
    }
    const scalar interval = time_.controlDict().get<scalar>("writeInterval");
    // Write times are counted from the start of the first run, if this run
    // writes at the same times: then a restart has exactly the same times
    scalar begin = firstStart_;
    const scalar since = (time_.startTime().value() - begin)/interval;
    if (mag(since - std::round(since)) > 1e-6)
    {
        begin = time_.startTime().value();
    }
    return min(left, toWhole(begin, interval));
}


Foam::scalar Foam::timeSchemes::dueTimes::toFunctions() const
{
    scalar left = GREAT;
    for (const entry& e : time_.controlDict().subOrEmptyDict("functions"))
    {
        if (!e.isDict() || !e.dict().lookupOrDefault("enabled", true))
        {
            continue;
        }
        const dictionary& dict = e.dict();
        if
        (
            time_.value() < dict.lookupOrDefault<scalar>("timeStart", -GREAT)
         || time_.value() > dict.lookupOrDefault<scalar>("timeEnd", GREAT)
        )
        {
            continue;
        }
        for (const word task : {"execute", "write"})
        {
            const word control
            (
                dict.lookupOrDefault<word>(task + "Control", "timeStep")
            );
            const scalar interval =
                dict.lookupOrDefault<scalar>(task + "Interval", 0);
            if
            (
                (control == "adjustableRunTime" || control == "adjustable")
             && interval > 0
            )
            {
                left = min(left, toWhole(time_.startTime().value(), interval));
            }
        }
    }
    return left;
}


Foam::scalar Foam::timeSchemes::dueTimes::toWhole
(
    const scalar begin,
    const scalar interval
) const
{
    const scalar now = time_.value();
    const scalar next = std::floor((now - begin)/interval + rounding) + 1;
    return begin + next*interval - now;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::timeSchemes::dueTimes::next(const scalar deltaT) const
{
    const scalar write = toWrite();
    const scalar functions = toFunctions();
    return
        write - functions > 0.5*part(functions, deltaT) ? functions : write;
}


Foam::scalar Foam::timeSchemes::dueTimes::part
(
    const scalar all,
    const scalar deltaT
)
{
    // At the end of the run what is left may be a rounding error, not zero
    const scalar share = all/deltaT - rounding;
    return share > 0 ? all/std::ceil(share) : deltaT;
}


Foam::scalar Foam::timeSchemes::dueTimes::landing(const scalar deltaT) const
{
    return part(next(deltaT), deltaT);
}


// ************************************************************************* //
