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

#include "principalAxes/principalAxes.C"
#include "granularSolidThermo/granularSolidThermo.C"
#include "granularSolidThermo/granularSolidThermoFields.C"
#include "refusals/refusals.C"
#include "granularSide/granularSideFvPatchScalarField.C"
#include "granularWall/granularWallFvPatchScalarField.C"
#include "granularContact/granularContactFvPatchScalarField.C"
#include "granularFlowSource/granularFlowSource.C"


// ************************************************************************* //
