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

#include "granularMechanics/loadHistories.C"
#include "granularMechanics/elementMesh.C"
#include "granularMechanics/elementMeshFind.C"
#include "granularMechanics/rigidMotion.C"
#include "granularMechanics/stressLaw.C"
#include "granularMechanics/grainLawStiffness.C"
#include "granularMechanics/elasticLaw.C"
#include "granularMechanics/stiffnessChoice.C"
#include "granularMechanics/equilibriumSolver.C"
#include "granularMechanics/equilibriumNumbers.C"
#include "granularMechanics/equilibriumPreconditioner.C"
#include "granularMechanics/equilibriumMedium.C"
#include "granularMechanics/coulombFriction.C"
#include "granularMechanics/smoothWalls.C"
#include "granularMechanics/nodeDyads.C"
#include "granularMechanics/wallConditions.C"
#include "granularMechanics/wallNormals.C"
#include "granularMechanics/wallKeys.C"
#include "granularMechanics/wallConstraints.C"
#include "granularMechanics/wallForces.C"
#include "granularMechanics/wallFriction.C"
#include "granularMechanics/wallSlip.C"
#include "granularMechanics/wallGive.C"
#include "granularMechanics/wallLeaving.C"
#include "granularMechanics/wallPistons.C"
#include "granularMechanics/wallSprings.C"
#include "granularMechanics/wallCurvature.C"
#include "granularMechanics/wallShells.C"
#include "granularMechanics/wallShellSlide.C"
#include "granularMechanics/granularMechanics.C"
#include "granularMechanics/equilibrium.C"
#include "granularMechanics/equilibriumFields.C"
#include "granularMechanics/equilibriumForces.C"
#include "granularMechanics/equilibriumStep.C"
#include "granularMechanics/equilibriumAdvance.C"
#include "granularMechanics/equilibriumMatrix.C"
#include "granularMechanics/equilibriumStiffness.C"
#include "granularMechanics/equilibriumOutput.C"


// ************************************************************************* //
