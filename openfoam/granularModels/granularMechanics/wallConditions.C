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

#include "wallConditions.H"
#include "regionSplit.H"
#include "rigidMotion.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Share of the largest resistance to a rigid motion below which a piece of the
//- mesh counts as free
static const scalar floating = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::wallConditions::wallConditions
(
    const dictionary& dict,
    const granularModel& model,
    const elementMesh& mesh,
    const scalar radius,
    const bool elastic,
    const scalar springs
)
:
    wallConstraints(dict, model, mesh, radius, elastic, springs)
{
    findRubbing();
    findSupports();
    findCurvature();
    findFloating();
    compareShells();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConditions::findFloating() const
{
    const regionSplit regions(mesh_.mesh());
    const label pieces = regions.nRegions();
    rigidMotion motion(mesh_, regions, pieces);
    const label dim = mesh_.dim();

    forAll(constrainedNodes_, i)
    {
        for (label k = 0; k < directions_[i]; ++k)
        {
            motion.hold(constrainedNodes_[i], basis_.cdata() + dim*(dim*i + k));
        }
    }
    forAll(slipNodes_, i)
    {
        for (label j = (dim - 1)*i; j < (dim - 1)*i + nTangents_[i]; ++j)
        {
            motion.hold(slipNodes_[i], tangents_.cdata() + dim*j);
        }
    }
    forAll(supports_, i)
    {
        motion.hold(supports_[i], normal_.cdata() + dim*i);
    }
    forAll(curved_, i)
    {
        motion.hold(curved_[i], tangent_.cdata() + dim*i);
    }
    const string what(motion.free(floating));
    if (!what.empty())
    {
        FatalErrorInFunction
            << what.c_str() << ". Allowed: pieces that walls of type rigid,"
            << " frictionless, symmetry, displacement or shell hold; see 'walls' of"
            << " equilibriumCoeffs" << exit(FatalError);
    }
}


// ************************************************************************* //
