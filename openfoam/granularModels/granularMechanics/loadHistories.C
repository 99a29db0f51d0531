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

#include "loadHistories.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Largest deviation of a function from the line between the ends of a step,
//- over its range
static const scalar follows = 0.05;

//- Points inside a step at which a function that is no table is looked at, and
//- in the whole run
static const label within = 15;
static const label inRun = 400;

//- Points nearer to the ends of a step than this share of it are its ends
static const scalar atEnd = 1e-9;

//- How often a step is shortened
static const label mostShorter = 60;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::loadHistories::shorter
(
    const history& load,
    const scalar now,
    const scalar deltaT
) const
{
    const vector first(load.value(now)), last(load.value(now + deltaT));
    scalar worst = follows*load.range, found = deltaT;
    const auto look = [&](const scalar since)
    {
        const scalar share = since/deltaT;
        if (share < atEnd || share > 1 - atEnd)
        {
            return;
        }
        const vector line((1 - share)*first + share*last);
        const scalar off = mag(load.value(now + since) - line);
        if (off > worst)
        {
            worst = off;
            found = since;
        }
    };
    for (label i = 1; load.points.empty() && i <= within; ++i)
    {
        look(deltaT*i/(within + 1));
    }
    const auto begin =
        std::upper_bound(load.points.begin(), load.points.end(), now);
    for
    (
        auto point = begin;
        point != load.points.end() && *point < now + deltaT;
        ++point
    )
    {
        look(*point - now);
    }
    return found;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::loadHistories::add
(
    const function& value,
    const scalarList& points
)
{
    vector least(vector::max), most(vector::min);
    const auto look = [&](const scalar time)
    {
        const vector here(value(time));
        least = min(least, here);
        most = max(most, here);
    };
    for (const scalar point : points)
    {
        look(point);
    }
    for (label i = 0; points.empty() && i <= inRun; ++i)
    {
        look(begin_ + (end_ - begin_)*i/inRun);
    }
    const scalar range = mag(most - least);
    if (range > 0)
    {
        loads_.append(history{value, points, range});
    }
}


bool Foam::loadHistories::changesAfter(const scalar now) const
{
    for (const history& load : loads_)
    {
        const vector here(load.value(now));
        const auto differs = [&](const scalar time)
        {
            return mag(load.value(time) - here) > atEnd*load.range;
        };
        for (const scalar point : load.points)
        {
            if (point > now && point <= end_ && differs(point))
            {
                return true;
            }
        }
        for (label i = 1; load.points.empty() && i <= inRun; ++i)
        {
            if (differs(now + (end_ - now)*i/inRun))
            {
                return true;
            }
        }
    }
    return false;
}


Foam::scalar Foam::loadHistories::follow
(
    const scalar now,
    const scalar deltaT
) const
{
    scalar step = deltaT;
    for (const history& load : loads_)
    {
        for (label i = 0; i < mostShorter; ++i)
        {
            const scalar found = shorter(load, now, step);
            if (found >= step)
            {
                break;
            }
            step = found;
        }
    }
    return step;
}


// ************************************************************************* //
