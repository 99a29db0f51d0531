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

#include "equilibrium.H"
#include "addToRunTimeSelectionTable.H"
#include "extrapolatedCalculatedFvPatchFields.H"

#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularMechanicsModels
{
    defineTypeNameAndDebug(equilibrium, 0);
    addToRunTimeSelectionTable(granularMechanics, equilibrium, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularMechanicsModels::equilibrium::equilibrium
(
    const granularProperties& properties,
    granularState& grains
)
:
    granularMechanics(grains),
    dict_(properties.subOrEmptyDict("equilibriumCoeffs")),
    scale_
    (
        properties.youngModulus().value()*properties.meanRadius().value()
    ),
    tolerance_
    (
        granularProperties::ranged
        (
            dict_, "residual", 1e-4*scale_, 2e-14*scale_, 2e4*scale_
        )
    ),
    maxIterations_
    (
        label(granularProperties::ranged(dict_, "maxIterations", 30, 1, 1000))
    ),
    maxResidual_
    (
        granularProperties::ranged
        (
            dict_, "maxResidual", 20*tolerance_, tolerance_, 2e7*scale_
        )
    ),
    quads_(mesh_),
    walls_
    (
        dict_.subOrEmptyDict("walls"),
        grains.model(),
        quads_,
        properties.meanRadius().value()
    ),
    uniform_(quads_),
    nodeDisplacement_
    (
        io("nodeDisplacement", IOobject::READ_IF_PRESENT),
        pointMesh::New(mesh_),
        dimensionedVector(dimLength, Zero)
    ),
    wallTraction_
    (
        io("wallTraction", IOobject::READ_IF_PRESENT),
        pointMesh::New(mesh_),
        dimensionedVector(dimPressure, Zero)
    ),
    initialStress_
    (
        io("initialStress", IOobject::READ_IF_PRESENT),
        grains.stress()
    ),
    D_
    (
        io("D", IOobject::NO_READ),
        mesh_,
        dimensionedVector(dimLength, Zero),
        extrapolatedCalculatedFvPatchVectorField::typeName
    ),
    areaRatio_
    (
        io("areaRatio", IOobject::NO_READ),
        mesh_,
        dimensionedScalar("one", dimless, 1),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    u_(quads_.size(), vector2D(Zero)),
    traction_(u_),
    start_(u_),
    nodeArea_(u_.size(), Zero),
    lastTime_(mesh_.time().value()),
    C_(mesh_.nCells()),
    friction_(u_),
    newTraction_(u_),
    stick_(u_),
    coupled_(false),
    slide_(u_),
    share_(1),
    r_(u_),
    before_(0),
    left_(0),
    norm_(0),
    broken_(-1),
    placed_(false),
    diagonal_(u_),
    uniformDiagonal_(u_),
    metric_(mesh_.nCells()),
    steps_(0),
    largest_(0),
    everMoved_(false)
{
    granularProperties::checkKeys
    (
        dict_,
        {
            "residual", "maxIterations", "maxResidual", "walls"
        }
    );
    if (!grains.model().hasTangent())
    {
        FatalIOErrorInFunction(properties)
            << "Entry 'mechanics' is equilibrium, but the model "
            << grains.model().source() << " has no mechanical tangent"
            << exit(FatalIOError);
    }

    grains_.letDeform(walls_.strength());
    readNodes(nodeDisplacement_, u_);
    readNodes(wallTraction_, traction_);
    for
    (
        scalarField* column :
        {&strain_.xx, &strain_.yy, &strain_.xy, &strain_.rotation}
    )
    {
        column->resize(mesh_.nCells(), Zero);
    }
    quads_.shapes(quads_.points(), reference_);
    shapes_ = reference_;
    setStart();
    setUniform();
    findMetric();
    grains_.follow([this]() { makeFields(); });
    grains_.refresh();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::IOobject Foam::granularMechanicsModels::equilibrium::io
(
    const word& name,
    const IOobject::readOption read
) const
{
    return IOobject
    (
        name, mesh_.time().timeName(), mesh_, read, IOobject::AUTO_WRITE
    );
}


void Foam::granularMechanicsModels::equilibrium::setStart()
{
    List<vector2D> area(u_.size(), vector2D(Zero));
    forAll(reference_, celli)
    {
        for (const label node : quads_.quads()[celli])
        {
            area[node].x() += 0.25*reference_[celli].area;
        }
    }
    quads_.sum(area);

    // Imbalance of the initial fields: it is the reference for all later steps
    // and so is never relaxed
    granularState::stressColumns initial
    {
        initialStress_.primitiveField().component(symmTensor::XX),
        initialStress_.primitiveField().component(symmTensor::YY),
        initialStress_.primitiveField().component(symmTensor::XY)
    };
    addStress(initial, start_);
    quads_.sum(start_);

    scalar most = 0;
    forAll(start_, i)
    {
        nodeArea_[i] = area[i].x();
        for (label k = 0; k < 2; ++k)
        {
            start_[i][k] *= walls_.balanced()[i][k];
            most = max
            (
                most,
                walls_.free()[i][k]*mag(start_[i][k])/std::sqrt(nodeArea_[i])
            );
        }
    }
    Info<< "Equilibrium: residual " << tolerance_
        << " Pa; initial fields are out of balance by "
        << returnReduce(most, maxOp<scalar>()) << " Pa, which is kept" << nl
        << endl;
}


void Foam::granularMechanicsModels::equilibrium::readNodes
(
    const pointVectorField& from,
    nodeField& to
) const
{
    forAll(to, i)
    {
        const vector& v = from[quads_.front()[i]];
        to[i] = vector2D(v.x(), v.y());
    }
}


void Foam::granularMechanicsModels::equilibrium::writeNodes
(
    const nodeField& from,
    pointVectorField& to
) const
{
    vectorField& values = to.primitiveFieldRef();
    forAll(from, i)
    {
        const vector v(from[i].x(), from[i].y(), 0);
        values[quads_.front()[i]] = v;
        values[quads_.back()[i]] = v;
    }
}


void Foam::granularMechanicsModels::equilibrium::addStress
(
    const granularState::stressColumns& stress,
    nodeField& force
) const
{
    forAll(shapes_, celli)
    {
        const quadMesh::shape& s = shapes_[celli];
        const quadMesh::quad& q = quads_.quads()[celli];
        const scalar xx = s.area*stress.xx[celli];
        const scalar yy = s.area*stress.yy[celli];
        const scalar xy = s.area*stress.xy[celli];
        for (label a = 0; a < 4; ++a)
        {
            force[q[a]].x() += s.b[a]*xx + s.c[a]*xy;
            force[q[a]].y() += s.c[a]*yy + s.b[a]*xy;
        }
    }
}


Foam::FixedList<Foam::scalar, 4>
Foam::granularMechanicsModels::equilibrium::gradient(const label celli) const
{
    const quadMesh::shape& s = reference_[celli];
    const quadMesh::quad& q = quads_.quads()[celli];
    FixedList<scalar, 4> F({1, 0, 0, 1});
    for (label a = 0; a < 4; ++a)
    {
        const vector2D& v = u_[q[a]];
        F[0] += s.b[a]*v.x();
        F[1] += s.c[a]*v.x();
        F[2] += s.b[a]*v.y();
        F[3] += s.c[a]*v.y();
    }
    return F;
}


void Foam::granularMechanicsModels::equilibrium::findMetric()
{
    forAll(metric_, celli)
    {
        const FixedList<scalar, 4> F(gradient(celli));
        const scalar root = std::sqrt(F[0]*F[3] - F[1]*F[2]);
        forAll(F, k)
        {
            metric_[celli][k] = F[k]/root;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::granularState::conductivityColumns&
Foam::granularMechanicsModels::equilibrium::pulledBack
(
    const granularState::conductivityColumns& K
)
{
    pulledBack_ = K;
    forAll(metric_, celli)
    {
        // J F^-1.K.F^-T, in which the adjugate of F is J F^-1
        const FixedList<scalar, 4>& m = metric_[celli];
        const scalar xx = K.xx[celli], yy = K.yy[celli], xy = K.xy[celli];
        pulledBack_.xx[celli] =
            sqr(m[3])*xx - 2*m[1]*m[3]*xy + sqr(m[1])*yy;
        pulledBack_.yy[celli] =
            sqr(m[2])*xx - 2*m[0]*m[2]*xy + sqr(m[0])*yy;
        pulledBack_.xy[celli] =
            (m[0]*m[3] + m[1]*m[2])*xy - m[2]*m[3]*xx - m[0]*m[1]*yy;
    }
    return pulledBack_;
}

// ************************************************************************* //
