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

#include "coulombFriction.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::coulombFriction::line Foam::coulombFriction::along
(
    const scalar before,
    const scalar slip,
    const scalar half
)
{
    line result;
    scalar& m = result.share;
    m = max(-all, min(all, before));
    scalar rest = slip;
    if (m*slip < 0)
    {
        const scalar back = min(mag(slip), mag(m)*half)*sign(slip);
        m += back/half;
        rest = slip - back;
    }
    if (rest != 0 || slip == 0)
    {
        result.memory = rest == slip ? 1/sqr(1 - mag(m)) : 1;
        const scalar virgin = half*mag(m)/(1 - mag(m)) + mag(rest);
        const scalar direction = rest != 0 ? sign(rest) : sign(m);
        m = direction*virgin/(virgin + half);
        result.slope = sqr(1 - mag(m));
        result.memory *= result.slope;
    }
    return result;
}


Foam::coulombFriction::plane Foam::coulombFriction::along
(
    const vector& before,
    const vector& slip,
    const scalar half
)
{
    const scalar size = mag(before);
    const vector m(before*min(scalar(1), all/max(size, VSMALL)));
    plane result;
    vector& ahead = result.ahead;
    result.share = m + slip/half;
    result.memory = size < all ? m : vector(Zero);
    const scalar tried = mag(result.share);
    ahead = tried > 0 ? result.share/tried : vector(Zero);
    if (!(tried > 0) || ((m & slip) < 0 && (result.share & slip) <= 0))
    {
        return result;
    }

    // On its way the share is the least where it is at right angles to the slip
    const scalar way = max(mag(slip), VSMALL);
    const scalar with = min((m & slip)/way, scalar(0));
    const vector foot(m - with/way*slip);
    const scalar least = mag(foot);
    const line grown(along(least, max(tried - least, scalar(0))*half, half));
    result.share = grown.share*ahead;
    result.slope = grown.slope;
    result.turn = grown.share/tried;
    // By the least share, with the slip beyond it for the same t
    const scalar kept = grown.memory - grown.slope;
    if (with < 0 && least > VSMALL)
    {
        result.back = -kept*with*half/(way*least)*foot;
    }
    if (size < all)
    {
        const scalar part = m & ahead;
        result.memory =
            result.turn*(m - part*ahead)
          + (result.slope*part + kept*least)*ahead;
    }
    return result;
}


// ************************************************************************* //
