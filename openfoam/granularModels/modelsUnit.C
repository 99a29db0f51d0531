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

#include "granularProperties/keyTable.C"
#include "granularProperties/granularProperties.C"
#include "granularProperties/temperatureFunction.C"
#include "granularModel/granularModel.C"
#include "constantModel/constantModel.C"
#include "surrogateModel/surrogateModel.C"
#include "networkModel/networkModel.C"
#include "pluginModel/pluginModel.C"
#include "spheresModel/spheresKeys.C"
#include "spheresModel/spheresStart.C"
#include "spheresModel/spheresModel.C"
#include "onlineRveModel/rveBox.C"
#include "onlineRveModel/rveHistory.C"
#include "onlineRveModel/onlineRveModel.C"
#include "onlineRveModel/onlineRvePack.C"
#include "onlineRveModel/onlineRveFile.C"
#include "regionPolicy/regionPolicy.C"
#include "regionPolicy/regionPolicyFile.C"
#include "runRecord/wholeFile.C"
#include "runRecord/timeFolder.C"
#include "runRecord/timeVerdict.C"
#include "runRecord/meshNumbers.C"
#include "runRecord/runRecord.C"
#include "runRecord/runTables.C"
#include "runRecord/runCourse.C"
#include "runRecord/wallDistance.C"


// ************************************************************************* //
