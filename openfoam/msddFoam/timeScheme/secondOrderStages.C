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

#include "secondOrderScheme.H"
#include "resistingWall.H"
#include "stepWatch.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "addToRunTimeSelectionTable.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const scalar gamma2 = 1 - 1/std::sqrt(2.0);

//- Largest change of the conductivity by its extrapolation to a stage, over its
//- least component of the directions in which heat is conducted
static const scalar mostAhead = 0.5;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::timeSchemes::secondOrder::extrapolate
(
    const symmTensorField& K,
    const scalar deltaT
)
{
    stageK_ = K;
    if (lastDeltaT_ <= 0)
    {
        return;
    }
    const scalar factor = deltaT/(2*gamma2*lastDeltaT_);
    const bool spatial = grains_.model().isThreeDimensional();
    const symmTensorField& earlier = earlier_().primitiveField();
    forAll(earlier, celli)
    {
        const symmTensor& now = K[celli];
        const symmTensor change(factor*(now - earlier[celli]));
        const scalar least = min
        (
            min(now.xx(), now.yy()), spatial ? now.zz() : now.xx()
        );
        const scalar share =
            min(scalar(1), mostAhead*least/max(mag(change), VSMALL));
        stageK_[celli] = now + share*change;
    }
}


Foam::scalar Foam::timeSchemes::secondOrder::stages
(
    const symmTensorField& K,
    const scalar deltaT
)
{
    scalarField& T = T_.primitiveFieldRef();
    const scalar start = time_.value();

    // Boundary values are evaluated at the time of the stage
    time_.value() = start + gamma2*deltaT;
    const scalarField before(heat_.equivalent(Told_));
    heat_.solve(before, gamma2*deltaT, K);
    firstHeat_ = heat_.patchHeat();
    firstFaceHeat_ = heat_.faceHeat();
    firstSource_ = heat_.sourceHeat();
    firstOutside_ = neighbours_.heat();
    firstGiven_ = ofNeighbours();

    forAll(T, celli)
    {
        rate_[celli] = (T[celli] - Told_[celli])/gamma2;
        // A step that is far too large would go below absolute zero before its
        // error is known
        stage_[celli] =
            max(Told_[celli] + rate_[celli]/(2*gamma2), scalar(0));
    }
    // Where grains move, those that swell in their places would conduct by far
    // too well or too badly: their stress changes before it is in equilibrium
    if (mechanics_.canFail())
    {
        extrapolate(K, deltaT);
    }
    else
    {
        grains_.strain(Told_, stage_);
        grains_.findConductivity(stageK_);
    }

    // The stages of the heat; only the first guess is one of T
    const scalarField first(heat_.equivalent(T));
    forAll(T, celli)
    {
        T[celli] = Told_[celli] + rate_[celli];
        rate_[celli] = (first[celli] - before[celli])/gamma2;
        stage_[celli] = before[celli] + (1 - gamma2)*rate_[celli];
    }
    neighbours_.secondStage(gamma2);
    heat_.flow().secondStage(gamma2);
    time_.value() = start + deltaT;
    heat_.solve(stage_, gamma2*deltaT, stageK_);
    time_.value() = start;

    scalar error = neighbours_.stageError(gamma2);
    const scalarField last(heat_.equivalent(T));
    forAll(T, celli)
    {
        error = max
        (
            error,
            mag(last[celli] - stage_[celli] - gamma2*rate_[celli])
        );
    }
    return returnReduce(error, maxOp<scalar>());
}


void Foam::timeSchemes::secondOrder::accountStages(const scalar deltaT)
{
    const auto mean = [](const auto& first, const auto& second)
    {
        return (1 - gamma2)*first + gamma2*second;
    };
    scalarList patches(firstHeat_);
    List<scalarField> faces(firstFaceHeat_);
    forAll(patches, patchi)
    {
        patches[patchi] = mean(firstHeat_[patchi], heat_.patchHeat()[patchi]);
        faces[patchi] =
            mean(firstFaceHeat_[patchi], heat_.faceHeat()[patchi]);
    }
    book(deltaT, patches, faces, mean(firstSource_, heat_.sourceHeat()));
    neighbours_.finish
    (
        deltaT*mean(firstOutside_, neighbours_.heat()),
        deltaT*mean(firstGiven_, ofNeighbours())
    );
    heat_.flow().finish(deltaT, gamma2);
}


// ************************************************************************* //
