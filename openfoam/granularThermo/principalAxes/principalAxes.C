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

#include "principalAxes.H"
#include "foamVersions.H"
#include "unitConversion.H"
#include "IStringStream.H"
#include "mathematicalConstants.H"

#include <cmath>
#include <sstream>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::keyTable Foam::principalAxes::thermoKeys
(
    "thermophysicalProperties of a bed",
    {
        {
            "thermoType", "makes the region a bed", "-", "granularSolidThermo",
            "required"
        },
        {
            "coordinateSystem",
            "axes along which the solver takes the conductivity, in any form of"
            " OpenFOAM", "-", "a dictionary", "the axes of the mesh"
        },
        {
            "crossTolerance",
            "largest error of the heat flux, relative to the flux, by the"
            " components of K that the solver cannot take; see below. Solvers"
            " since v2606 take all", "-", "0 to 1", "0.01"
        },
        {
            "accept",
            "what a restart may differ in, as with `msddFoam -accept`: names of"
            " [settings](fields.md#uniformmsddfoam), `mesh`, `files`. Remove it"
            " after the run", "-", "a list of words", "()"
        },
        {"updateT", "as in OpenFOAM", "-", "yes, no", "yes"},
        {"dpdt", "as in OpenFOAM", "-", "yes, no", "yes"}
    }
);


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Errors below this one are those of rounding
static const scalar roundOff = 1e-9;

//- |K_xy| over the smaller principal value: the norm of what is left out times
//- the inverse of K
static scalar leftOut(const scalar Kxx, const scalar Kyy, const scalar Kxy)
{
    const scalar mean = 0.5*(Kxx + Kyy), half = 0.5*(Kxx - Kyy);
    return mag(Kxy)/(mean - std::sqrt(sqr(half) + sqr(Kxy)));
}


//- The same of all three components off the diagonal
static scalar leftOut(const symmTensor& K)
{
    if (K.xz() == 0 && K.yz() == 0)
    {
        return leftOut(K.xx(), K.yy(), K.xy());
    }
    const scalar least = min(K.xx(), min(K.yy(), K.zz()));
    const scalar most = max(mag(K.xy()), max(mag(K.xz()), mag(K.yz())));
    if (most < roundOff*least)
    {
        return most/least;
    }
    const symmTensor beside(0, K.xy(), K.xz(), 0, K.yz(), 0);
    return cmptMax(cmptMag(eigenValues(beside)))/cmptMin(eigenValues(K));
}


//- Whether there is heat out of the plane of x and y because of a gradient in it
static bool isSpatial(const symmTensorField& K)
{
    bool spatial = false;
    for (const symmTensor& cell : K)
    {
        spatial = spatial || cell.xz() != 0 || cell.yz() != 0;
    }
    return returnReduce(spatial, orOp<bool>());
}


//- A number with so many digits, whatever the writePrecision of the case
static string shown(const scalar value, const int digits = 3)
{
    std::ostringstream os;
    os.precision(digits);
    os << value;
    return os.str();
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::principalAxes::principalAxes(dictionary& dict, const fvMesh& mesh)
:
    dict_(dict),
    mesh_(mesh),
    tolerance_(thermoKeys.number(dict, "crossTolerance")),
    error_(0)
{
    if (!dict.found(coordinateSystem::typeName_()))
    {
        IStringStream axes
        (
            "type cartesian; origin (0 0 0); rotation { type none; }"
        );
        dict.add(coordinateSystem::typeName_(), dictionary(axes));
        return;
    }
    const autoPtr<coordinateSystem> axes
    (
        coordinateSystem::New(mesh, dict, coordinateSystem::typeName_())
    );
    if (!axes().uniform())
    {
        rotation_ = axes().R(mesh.cellCentres());
    }
    else if (axes().R() != tensor::I)
    {
        rotation_ = tensorField(mesh.nCells(), axes().R());
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::principalAxes::turn
(
    const symmTensorField& K,
    vectorField& along
) const
{
    scalar error = 0;
    forAll(along, celli)
    {
        symmTensor turned(K[celli]);
        if (rotation_.size())
        {
            turned = Foam::transform(rotation_[celli].T(), turned);
        }
        along[celli] = vector(turned.xx(), turned.yy(), turned.zz());
        error = max(error, leftOut(turned));
    }
    return error;
}


Foam::tensor Foam::principalAxes::bestAxes
(
    const symmTensorField& K
) const
{
    symmTensor sum(Zero);
    forAll(K, celli)
    {
        sum += mesh_.V()[celli]*K[celli];
    }
    reduce(sum, sumOp<symmTensor>());
    if (!isSpatial(K))
    {
        const scalar half = 0.5*(sum.xx() - sum.yy());
        const scalar angle = 0.5*std::atan2(sum.xy(), half);
        const scalar c = std::cos(angle), s = std::sin(angle);
        return tensor(c, s, 0, -s, c, 0, 0, 0, 1);
    }
    // The first axis along the largest conductivity
    const tensor ascending(eigenVectors(sum));
    const vector e1(ascending.z()), e3(ascending.x());
    const vector e2(e3 ^ e1);
    return tensor(e1.x(), e1.y(), e1.z(), e2.x(), e2.y(), e2.z(),
        e3.x(), e3.y(), e3.z());
}


void Foam::principalAxes::refuse
(
    const symmTensorField& K,
    const scalar error
) const
{
    const tensor axes(bestAxes(K));
    scalar left = 0;
    forAll(K, celli)
    {
        left = max
        (
            left, leftOut(Foam::transform(axes, K[celli]))
        );
    }
    reduce(left, maxOp<scalar>());
    const auto text = [](const vector& e) -> string
    {
        return '(' + shown(e.x(), 12) + ' ' + shown(e.y(), 12) + ' '
          + shown(e.z(), 12) + ')';
    };
    FatalIOErrorInFunction(dict_)
        << "The conductivity of region " << mesh_.name() << " at time "
        << mesh_.time().timeName() << " has a component "
        << (isSpatial(K) ? "K_xy, K_xz or K_yz" : "K_xy") << " in addition to those"
        << " along the axes of coordinateSystem, which this solver cannot take:"
        << " without it the error of the heat flux is up to "
        << shown(100*error).c_str() << " %, allowed: "
        << shown(100*tolerance_).c_str()
        << " % (crossTolerance " << shown(tolerance_).c_str() << "). With"
        << " coordinateSystem { type cartesian; origin (0 0 0); rotation { type"
        << " axes; e1 " << text(axes.x()).c_str() << "; e3 "
        << text(axes.z()).c_str() << "; } } it would"
        << " err by up to " << shown(100*left).c_str() << " %; msddFoam, which"
        << " solves the bed alone, takes any tensor" << exit(FatalIOError);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::principalAxes::apply
(
    const symmTensorField& K,
    vectorField& along,
    symmTensorField& taken
)
{
    const scalar mine = turn(K, along);
    forAll(taken, celli)
    {
        const vector& k = along[celli];
        taken[celli] =
            foamTakesTensor
          ? K[celli]
          : Foam::transform
            (
                rotation(celli), symmTensor(k.x(), 0, 0, k.y(), 0, k.z())
            );
    }
    if (foamTakesTensor)
    {
        return;
    }
    const scalar error = returnReduce(mine, maxOp<scalar>());
    if (error > tolerance_)
    {
        refuse(K, error);
    }
    if (error > roundOff && error_ <= roundOff)
    {
        Info<< "Region " << mesh_.name() << ": without what the conductivity"
            << " has across its axes, the error of the heat flux is up to "
            << shown(100*error).c_str() << " %, allowed: "
            << shown(100*tolerance_).c_str() << " %" << endl;
    }
    error_ = max(error_, error);
}


// ************************************************************************* //
