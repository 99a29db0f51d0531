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

#include "stiffnessChoice.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::stiffnessChoice::learn
(
    const scalar way,
    const scalar left,
    const bool local
)
{
    stalled_ = left > stalling ? stalled_ + 1 : 0;
    if (rung_ == 0 && way < shortWay)
    {
        resume_ = iterations_ + longPause;
    }
    const bool pauses = iterations_ < resume_;
    ++iterations_;

    if (!(way > 0))
    {
        ++rung_;
        return;
    }
    slow_ += left > slow;
    rung_ =
        slow_ > patience && !pauses ? 0
      : left > stuck ? min(rung_ + 1, unmobilised)
      : local && left < good ? rung_
      : max(rung_ - 1, label(pauses));
    least_ =
        way < 1 ? mostOfLeast
      : left > slow ? max(0.5*least_, leastOfLeast)
      : least_;
}


// ************************************************************************* //
