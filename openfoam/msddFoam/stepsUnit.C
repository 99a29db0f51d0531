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

#include "heatEquation.C"
#include "heatConduction.C"
#include "heatConductionMesh.C"
#include "heatLoads.C"
#include "timeScheme/timeScheme.C"
#include "timeScheme/dueTimes.C"
#include "timeScheme/paperScheme.C"
#include "timeScheme/secondOrderScheme.C"
#include "timeScheme/secondOrderStages.C"
#include "restartTime.C"
#include "chooseSettings.C"


// ************************************************************************* //
