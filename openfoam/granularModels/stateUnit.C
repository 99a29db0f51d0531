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

// The files of this unit are compiled together: OpenFOAM's templates are then
// instantiated once for all of them, which takes a third of the time. Names
// that are local to a file must differ within a unit.

#include "granularState/caseChecks.C"
#include "granularState/granularState.C"
#include "granularState/granularStateStart.C"
#include "granularState/granularStateDeform.C"
#include "granularState/granularStateReport.C"
#include "granularState/grainFields.C"
#include "granularState/grainFieldsRead.C"
#include "granularState/grainFieldsRest.C"
#include "granularState/grainFieldsSettings.C"
#include "granularState/grainFieldsWalls.C"
#include "granularState/grainFieldsOutput.C"


// ************************************************************************* //
