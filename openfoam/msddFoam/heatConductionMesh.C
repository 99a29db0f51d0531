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

#include "heatConduction.H"
#include "mappedPatchBase.H"
#include "mixedFvPatchFields.H"
#include "coupledPolyPatch.H"
#include "wedgePolyPatch.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "unitConversion.H"
#include "fvcGrad.H"
#include "fvmLaplacian.H"
#include "gaussGrad.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Sine of the angle to an axis below which a face counts as aligned: mesh
//- points are given with about ten digits
static const scalar alignedSine = 1e-7;

//- Non-orthogonality above which the user is warned, as by checkMesh [degrees]
static const scalar largestAngle = 70;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::heatConduction::isAligned() const
{
    bool aligned = true;

    const surfaceVectorField& Sf = mesh_.Sf();
    const surfaceVectorField delta(mesh_.delta());
    const auto check = [&](const vector& S, const vector& d)
    {
        const vector n(S/mag(S));
        const scalar axis = max(mag(n.x()), mag(n.y()));
        aligned = aligned
         && mag(n ^ d) < alignedSine*mag(d)
         && 1 - sqr(axis) < sqr(alignedSine);
    };
    forAll(mesh_.owner(), facei)
    {
        check(Sf[facei], delta[facei]);
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        // No heat passes the sides of a wedge
        if (isA<wedgePolyPatch>(patch.patch()))
        {
            continue;
        }
        // Components of K are not those of the other side if it is turned
        aligned = aligned
         && (
                !isA<coupledPolyPatch>(patch.patch())
             || refCast<const coupledPolyPatch>(patch.patch()).parallel()
            );
        const vectorField d(patch.delta());
        forAll(patch, facei)
        {
            // The gradient at a wall is taken along its normal, so that the
            // position of the cell's centre matters only for faces between
            // cells
            const vector& S = Sf.boundaryField()[patchi][facei];
            check(S, patch.coupled() ? d[facei] : S);
        }
    }
    return returnReduce(aligned, andOp<bool>());
}


bool Foam::heatConduction::anyCoupled() const
{
    for (const fvPatch& patch : mesh_.boundary())
    {
        if (patch.coupled())
        {
            return true;
        }
    }
    return false;
}


void Foam::heatConduction::findFeet()
{
    feet_.resize(mesh_.boundary().size());
    forAll(feet_, patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        // At a wall to another region both sides have to see the same heat,
        // and its condition does not include the feet
        if
        (
            patch.coupled()
         || isA<mappedPatchBase>(patch.patch())
         || isA<wedgePolyPatch>(patch.patch())
        )
        {
            continue;
        }
        const vectorField n(patch.nf());
        const vectorField d(patch.Cf() - patch.Cn());
        feet_[patchi] = d - n*(n & d);
        slanted_ = slanted_ || max(mag(feet_[patchi])/mag(d)) > alignedSine;
    }
    reduce(slanted_, orOp<bool>());
}


void Foam::heatConduction::reportAngle() const
{
    scalar smallest = 1;
    const surfaceVectorField& Sf = mesh_.Sf();
    const surfaceVectorField delta(mesh_.delta());
    forAll(mesh_.owner(), facei)
    {
        const vector& S = Sf[facei];
        const vector& d = delta[facei];
        smallest = min(smallest, (S & d)/(mag(S)*mag(d)));
    }
    reduce(smallest, minOp<scalar>());
    const scalar angle =
        radToDeg(std::acos(max(scalar(-1), min(scalar(1), smallest))));

    Info<< "Non-orthogonality: at most " << angle << " degrees" << nl << endl;
    if (angle > largestAngle)
    {
        WarningInFunction
            << "Non-orthogonality of " << angle << " degrees, at most "
            << largestAngle << " advised: expect per cent of error in T, less"
            << " with more cells and nNonOrthogonalCorrectors" << endl;
    }
}


// ************************************************************************* //
