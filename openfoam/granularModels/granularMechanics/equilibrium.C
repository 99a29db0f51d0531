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
#include "solverPerformance.H"

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
    tolerance_
    (
        granularProperties::ranged(dict_, "residual", 5, 1e-9, 1e9)
    ),
    maxIterations_
    (
        label(granularProperties::ranged(dict_, "maxIterations", 30, 1, 1000))
    ),
    maxResidual_
    (
        granularProperties::ranged
        (
            dict_, "maxResidual", 20*tolerance_, tolerance_, 1e12
        )
    ),
    sinPhi_(granularProperties::ranged(dict_, "sinPhi", 0.35, 0.01, 1)),
    shearFactor_
    (
        granularProperties::ranged(dict_, "shearFactor", 1, 0.01, 10)
    ),
    scale_
    (
        properties.youngModulus().value()*properties.meanRadius().value()
    ),
    quads_(mesh_),
    walls_(dict_.subOrEmptyDict("walls"), grains.model(), quads_),
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
    shearStress_
    (
        io("shearStress", IOobject::READ_IF_PRESENT),
        mesh_,
        dimensionedScalar(dimPressure, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
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
    u_(quads_.size(), vector2D(Zero)),
    traction_(u_),
    start_(u_),
    nodeArea_(u_.size(), Zero),
    lastTime_(mesh_.time().value()),
    shearModulus_(mesh_.nCells(), Zero),
    friction_(u_),
    newTraction_(u_),
    stick_(u_),
    diagonal_(u_),
    uniformDiagonal_(u_),
    steps_(0),
    solved_(0),
    iterations_(0),
    linear_(0),
    unconverged_(0),
    worst_(0)
{
    granularProperties::checkKeys
    (
        dict_,
        {
            "residual", "maxIterations", "maxResidual", "sinPhi",
            "shearFactor", "walls"
        }
    );
    if (!grains.model().hasTangent())
    {
        FatalIOErrorInFunction(properties)
            << "Entry 'mechanics' is equilibrium, but the model "
            << grains.model().source() << " has no mechanical tangent"
            << exit(FatalIOError);
    }

    readNodes(nodeDisplacement_, u_);
    readNodes(wallTraction_, traction_);
    grains_.setShearStress(shearStress_.primitiveField());

    quads_.shapes(quads_.points(), reference_);
    shapes_ = reference_;
    List<vector2D> area(u_.size(), vector2D(Zero));
    forAll(reference_, celli)
    {
        for (const label node : quads_.quads()[celli])
        {
            area[node].x() += 0.25*reference_[celli].area;
        }
    }
    quads_.sum(area);

    // Out of balance at the start, which stays
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
    setUniform();
    Info<< "Equilibrium: residual " << tolerance_
        << " Pa; initial fields are out of balance by "
        << returnReduce(most, maxOp<scalar>()) << " Pa, which is kept" << nl
        << endl;
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


Foam::granularMechanicsModels::equilibrium::nodeField
Foam::granularMechanicsModels::equilibrium::at
(
    const nodeField& du,
    const scalar share
) const
{
    nodeField result(quads_.points());
    forAll(result, i)
    {
        result[i] += u_[i] + share*du[i];
    }
    return result;
}


Foam::scalar Foam::granularMechanicsModels::equilibrium::imbalance
(
    const nodeField& du,
    const bool moved,
    nodeField& r
)
{
    stress_ = grains_.presentStress();
    if (moved)
    {
        // Strains of the middle are of second order
        scalarField exx(mesh_.nCells()), eyy(exx);
        quads_.shapes(at(du, 0.5), shapes_);
        forAll(shapes_, celli)
        {
            const quadMesh::shape& s = shapes_[celli];
            const quadMesh::quad& q = quads_.quads()[celli];
            scalar xx = 0, yy = 0, xy = 0;
            for (label a = 0; a < 4; ++a)
            {
                const vector2D& v = du[q[a]];
                xx += s.b[a]*v.x();
                yy += s.c[a]*v.y();
                xy += s.c[a]*v.x() + s.b[a]*v.y();
            }
            // A medium stiffer in shear by shearFactor, as stiff in volume
            const scalar deviator = 0.5*(shearFactor_ - 1)*(xx - yy);
            exx[celli] = xx + deviator;
            eyy[celli] = yy - deviator;
            stress_.xy[celli] += shearModulus_[celli]*xy;
        }
        grains_.deform(exx, eyy, sinPhi_, stress_);
    }

    const nodeField now(at(du, 1));
    quads_.shapes(now, shapes_);
    nodeField inner(u_.size(), vector2D(Zero)), outer(inner);
    addStress(stress_, inner);
    forAll(reference_, celli)
    {
        const scalar* gamma = reference_[celli].gamma;
        const quadMesh::quad& q = quads_.quads()[celli];
        vector2D pattern(Zero);
        for (label a = 0; a < 4; ++a)
        {
            pattern += gamma[a]*(u_[q[a]] + du[q[a]]);
        }
        for (label a = 0; a < 4; ++a)
        {
            inner[q[a]] += (hourglass*scale_*gamma[a])*pattern;
        }
    }
    walls_.addPressure(mesh_.time().value(), now, outer);
    forAll(inner, i)
    {
        inner[i] -= outer[i];
    }
    quads_.sum(inner);
    walls_.friction
    (
        stress_, now, du, mesh_.time().value(), lastTime_,
        traction_, friction_, newTraction_, stick_
    );

    r.resize(u_.size());
    scalar most = 0;
    forAll(r, i)
    {
        for (label k = 0; k < 2; ++k)
        {
            r[i][k] =
                walls_.free()[i][k]
               *(start_[i][k] - inner[i][k] + friction_[i][k]);
            most = max(most, mag(r[i][k])/std::sqrt(nodeArea_[i]));
        }
    }
    return returnReduce(most, maxOp<scalar>());
}


void Foam::granularMechanicsModels::equilibrium::keep
(
    const nodeField& du,
    const bool moved
)
{
    traction_ = newTraction_;
    if (moved)
    {
        forAll(u_, i)
        {
            u_[i] += du[i];
        }
        grains_.commitDeformed(stress_.xy);
        shearStress_.primitiveFieldRef() = stress_.xy;
        shearStress_.correctBoundaryConditions();
    }
    vectorField& D = D_.primitiveFieldRef();
    forAll(D, celli)
    {
        vector2D sum(Zero);
        for (const label node : quads_.quads()[celli])
        {
            sum += 0.25*u_[node];
        }
        D[celli] = vector(sum.x(), sum.y(), 0);
    }
    D_.correctBoundaryConditions();
    writeNodes(u_, nodeDisplacement_);
    writeNodes(traction_, wallTraction_);
    lastTime_ = mesh_.time().value();
}


void Foam::granularMechanicsModels::equilibrium::refuse
(
    const scalar residual,
    const nodeField& r
)
{
    label worst = 0;
    scalar most = -1;
    forAll(r, i)
    {
        const scalar here = cmptMax(cmptMag(r[i]))/std::sqrt(nodeArea_[i]);
        if (here > most)
        {
            most = here;
            worst = i;
        }
    }
    grains_.refresh();
    const_cast<Time&>(mesh_.time()).writeNow();

    // One process has the worst node; all end
    if (most >= residual*(1 - 1e-9))
    {
        FatalErrorInFunction
            << "Equilibrium at time " << mesh_.time().timeName() << ": after "
            << maxIterations_ << " iterations " << residual
            << " Pa are out of balance at " << mesh_.points()[quads_.front()[worst]]
            << ", allowed: maxResidual " << maxResidual_
            << " Pa of equilibriumCoeffs. The fields of this time are written"
            << exit(FatalError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularMechanicsModels::equilibrium::solve()
{
    nodeField r, d, du(walls_.way(mesh_.time().value(), u_));
    bool moved = returnReduce(quads_.dot(du, du) > 0, orOp<bool>());

    ++steps_;
    if (moved)
    {
        findTangent();
    }
    scalar now = imbalance(du, moved, r);
    if (!moved && now > tolerance_)
    {
        findTangent();
    }
    const scalar before = now;
    const label linearBefore = linear_;
    label iteration = 0;

    while (now > tolerance_ && iteration < maxIterations_)
    {
        findDiagonal();
        conjugateGradients(r, d);
        const scalar last = now;
        scalar share = 1;
        nodeField tried(du);
        for (label cut = 0; cut < 4; ++cut)
        {
            forAll(tried, i)
            {
                tried[i] = du[i] + share*d[i];
            }
            now = imbalance(tried, true, r);
            if (now < last)
            {
                break;
            }
            share *= 0.5;
        }
        du = tried;
        moved = true;
        ++iteration;
    }
    keep(du, moved);

    solved_ += iteration > 0;
    iterations_ += iteration;
    unconverged_ += now > tolerance_;
    worst_ = max(worst_, now);

    if (now > maxResidual_)
    {
        refuse(now, r);
    }
    // As the line of the linear solver of T
    if (solverPerformance::debug)
    {
        Info<< "Equilibrium: out of balance " << before << " Pa, after "
            << iteration << " iterations (" << linear_ - linearBefore
            << " linear) " << now << " Pa"
            << (now > tolerance_ ? ", not converged" : "") << nl;
    }
}


const Foam::granularState::conductivityColumns&
Foam::granularMechanicsModels::equilibrium::pulledBack
(
    const granularState::conductivityColumns& K
)
{
    pulledBack_ = K;
    forAll(reference_, celli)
    {
        const quadMesh::shape& s = reference_[celli];
        const quadMesh::quad& q = quads_.quads()[celli];
        scalar Fxx = 1, Fyy = 1, Fxy = 0, Fyx = 0;
        for (label a = 0; a < 4; ++a)
        {
            const vector2D& v = u_[q[a]];
            Fxx += s.b[a]*v.x();
            Fxy += s.c[a]*v.x();
            Fyx += s.b[a]*v.y();
            Fyy += s.c[a]*v.y();
        }
        const scalar J = Fxx*Fyy - Fxy*Fyx;
        const scalar xx = K.xx[celli], yy = K.yy[celli];
        pulledBack_.xx[celli] = (sqr(Fyy)*xx + sqr(Fxy)*yy)/J;
        pulledBack_.yy[celli] = (sqr(Fyx)*xx + sqr(Fxx)*yy)/J;
    }
    return pulledBack_;
}


void Foam::granularMechanicsModels::equilibrium::writeReport() const
{
    Info<< "Equilibrium: " << solved_ << " of " << steps_ << " steps solved, "
        << iterations_ << " iterations, " << linear_ << " linear; largest"
        << " displacement " << gMax(mag(D_.primitiveField())()) << " m;"
        << " largest residual left " << worst_ << " Pa, in " << unconverged_
        << " steps above " << tolerance_ << " Pa" << nl;
}


// ************************************************************************* //
