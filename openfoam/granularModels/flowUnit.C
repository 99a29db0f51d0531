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

#include "granularFlow/flowGas.C"
#include "granularFlow/bedCorrelations.C"
#include "granularFlow/twoFieldMatrix.C"
#include "granularFlow/vesselWalls.C"
#include "heatBeyond/heatBeyond.C"
#include "andersonMixing/andersonMixing.C"
#include "granularFlow/granularFlow.C"
#include "granularFlow/bedFlow.C"
#include "granularFlow/bedFlowHeat.C"
#include "granularFlow/bedFlowStart.C"
#include "granularFlow/bedFlowKeys.C"
#include "granularFlow/bedFlowScheme.C"
#include "granularFlow/bedFlowFaces.C"
#include "granularFlow/bedFlowRange.C"
#include "granularFlow/bedFlowReport.C"
#include "granularFlow/throughFlow.C"
#include "granularFlow/throughFlowKeys.C"
#include "granularFlow/pressureFlow.C"
#include "granularFlow/pressureFlowReport.C"
#include "granularFlow/pressureFlowOpenings.C"
#include "granularFlow/pressureFlowFaces.C"
#include "granularFlow/pressureFlowChange.C"
#include "granularFlow/pressureFlowKeys.C"
#include "granularFlow/pressureFlowWalls.C"


// ************************************************************************* //
