/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
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
#include "unitConversion.H"
#include "IStringStream.H"
#include "mathematicalConstants.H"

#include <cmath>
#include <sstream>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Largest error that is accepted if the case says nothing else
static const scalar defaultTolerance = 0.01;

//- Errors below this one are those of rounding
static const scalar roundOff = 1e-9;

//- |K_xy| over the smaller principal value: the norm of what is left out times
//- the inverse of K
static scalar leftOut(const scalar Kxx, const scalar Kyy, const scalar Kxy)
{
    const scalar mean = 0.5*(Kxx + Kyy), half = 0.5*(Kxx - Kyy);
    return mag(Kxy)/(mean - std::sqrt(sqr(half) + sqr(Kxy)));
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
    tolerance_
    (
        granularProperties::ranged
        (
            dict, "crossTolerance", defaultTolerance, 0, 1
        )
    ),
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
    const granularState::conductivityColumns& K,
    const scalar Kzz,
    vectorField& along
) const
{
    const bool crossed = K.xy.size();
    scalar error = 0;
    if (rotation_.empty())
    {
        forAll(along, celli)
        {
            along[celli] = vector(K.xx[celli], K.yy[celli], Kzz);
        }
        forAll(K.xy, celli)
        {
            error = max
            (
                error, leftOut(K.xx[celli], K.yy[celli], K.xy[celli])
            );
        }
        return error;
    }
    forAll(along, celli)
    {
        const symmTensor mine
        (
            K.xx[celli], crossed ? K.xy[celli] : 0, 0, K.yy[celli], 0, Kzz
        );
        const symmTensor turned
        (
            Foam::transform(rotation_[celli].T(), mine)
        );
        along[celli] = vector(turned.xx(), turned.yy(), turned.zz());
        error = max(error, leftOut(turned.xx(), turned.yy(), turned.xy()));
    }
    return error;
}


void Foam::principalAxes::bestAngle
(
    const granularState::conductivityColumns& K,
    scalar& angle,
    scalar& error
) const
{
    const bool crossed = K.xy.size();
    const scalarField& V = mesh_.V();
    const scalar half = 0.5*gSum(V*(K.xx - K.yy));
    angle = 0.5*std::atan2(crossed ? gSum(V*K.xy) : 0, half);

    const scalar c = std::cos(angle), s = std::sin(angle);
    error = 0;
    forAll(K.xx, celli)
    {
        const scalar x = K.xx[celli], y = K.yy[celli];
        const scalar xy = crossed ? K.xy[celli] : 0;
        error = max
        (
            error,
            leftOut
            (
                c*c*x + s*s*y + 2*c*s*xy,
                s*s*x + c*c*y - 2*c*s*xy,
                (c*c - s*s)*xy - c*s*(x - y)
            )
        );
    }
    reduce(error, maxOp<scalar>());
}


void Foam::principalAxes::refuse
(
    const granularState::conductivityColumns& K,
    const scalar error
) const
{
    scalar angle, left;
    bestAngle(K, angle, left);
    FatalIOErrorInFunction(dict_)
        << "The conductivity of region " << mesh_.name() << " at time "
        << mesh_.time().timeName() << " has a component K_xy besides those"
        << " along the axes of coordinateSystem, which this solver cannot take:"
        << " without it the heat flux errs by up to "
        << shown(100*error).c_str() << " %, allowed: "
        << shown(100*tolerance_).c_str()
        << " % (crossTolerance " << shown(tolerance_).c_str() << "). With"
        << " coordinateSystem { type cartesian; origin (0 0 0); rotation { type"
        << " axes; e1 (" << shown(std::cos(angle), 12).c_str() << ' '
        << shown(std::sin(angle), 12).c_str() << " 0); e3 (0 0 1); } } it would"
        << " err by up to " << shown(100*left).c_str() << " %; msddFoam, which"
        << " solves the bed alone, takes any tensor" << exit(FatalIOError);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::principalAxes::apply
(
    const granularState::conductivityColumns& K,
    const scalar Kzz,
    vectorField& along
)
{
    const scalar mine = turn(K, Kzz, along);
    if (rotation_.empty() && K.xy.empty())
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
        Info<< "Region " << mesh_.name() << ": without K_xy, which this solver"
            << " cannot take, the heat flux errs by up to "
            << shown(100*error).c_str() << " %, allowed: "
            << shown(100*tolerance_).c_str() << " %" << endl;
    }
    error_ = max(error_, error);
}


// ************************************************************************* //
