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

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Uniform medium for the preconditioner: c11, c12, shear modulus and
//- pressure, divided by E r/l, with values of densely packed grains
static const scalar uniformC11 = 0.8;
static const scalar uniformC12 = 0.25;
static const scalar uniformG = 0.3;
static const scalar uniformPressure = 0.05;

//- Least ratio of a pivot to its diagonal of a cell's stiffness matrix, and
//- factor by which the other components are reduced until it is reached
static const scalar leastPivot = 0.05;
static const scalar reduction = 0.8;

//- The same for grains that do not slide, and their shear modulus over c11
static const scalar cautiousPivot = 0.8;
static const scalar cautiousShear = 0.35;

//- The linear equations of a Newton iteration are solved until their residual
//- is this share of the imbalance, or after so many pairs of products: some
//- tangents of cells that lose contact are nearly singular
static const scalar linearTolerance = 0.1;
static const label maxLinear = 100;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularMechanicsModels::equilibrium::findTangent()
{
    strain_.xx = 0;
    strain_.yy = 0;
    strain_.xy = 0;
    strain_.rotation = 0;
    granularState::stressColumns unused;
    grains_.tryStrain(strain_, unused, tangent_);
}


void Foam::granularMechanicsModels::equilibrium::findStiffness
(
    const label caution,
    const scalar leastShare
)
{
    const scalar least = leastShare*scale_;
    const scalar leastRatio = caution > 1 ? cautiousPivot : leastPivot;
    const scalar factor = caution > 1 ? std::pow(2.0, caution - 2) : 1;
    coupled_ = !caution;
    forAll(C_, celli)
    {
        FixedList<scalar, 9>& c = C_[celli];
        forAll(c, k)
        {
            c[k] = tangent_[k][celli];
        }
        c[0] = max(c[0], least);
        c[4] = max(c[4], least);
        c[8] = max(c[8], 0.5*least);
        if (!caution)
        {
            continue;
        }

        // A matrix that is symmetric and positive
        c[1] = c[3] = 0.5*(c[1] + c[3]);
        c[2] = c[6] = 0.5*(c[2] + c[6]);
        c[5] = c[7] = 0.5*(c[5] + c[7]);
        if (caution > 1)
        {
            c[0] = c[4] = factor*max(c[0], c[4]);
            c[8] = max(factor*c[8], cautiousShear*c[0]);
        }

        // Pivots of the Cholesky factorisation
        for (label k = 0; k < 20; ++k)
        {
            const scalar second = c[4] - sqr(c[1])/c[0];
            const scalar other = c[5] - c[1]*c[2]/c[0];
            const scalar third = c[8] - sqr(c[2])/c[0] - sqr(other)/second;
            if (second > leastRatio*c[4] && third > leastRatio*c[8])
            {
                break;
            }
            for (const label j : {1, 2, 3, 5, 6, 7})
            {
                c[j] *= reduction;
            }
        }
    }
}


void Foam::granularMechanicsModels::equilibrium::setUniform()
{
    forAll(C_, celli)
    {
        C_[celli] = Zero;
        C_[celli][0] = C_[celli][4] = scale_*uniformC11;
        C_[celli][1] = C_[celli][3] = scale_*uniformC12;
        C_[celli][8] = scale_*uniformG;
    }
    stick_ = walls_.stiffness(scale_*uniformPressure);
    quads_.sum(stick_);
    findDiagonal();
    uniformDiagonal_ = diagonal_;

    const nodeField& free = walls_.free();
    nodeField local(diagonal_.size());
    cellDiagonal(local);
    forAll(shapes_, celli)
    {
        const quadMesh::shape& s = shapes_[celli];
        const quadMesh::quad& q = quads_.quads()[celli];
        const scalar c11 = s.area*C_[celli][0], c12 = s.area*C_[celli][1];
        const scalar G = s.area*C_[celli][8];
        for (label a = 0; a < 4; ++a)
        {
            for (label b = 0; b < 4; ++b)
            {
                const scalar hg =
                    hourglass*scale_
                   *reference_[celli].gamma[a]*reference_[celli].gamma[b];
                const scalar xx = c11*s.b[a]*s.b[b] + G*s.c[a]*s.c[b] + hg;
                const scalar yy = c11*s.c[a]*s.c[b] + G*s.b[a]*s.b[b] + hg;
                const scalar xy = c12*s.b[a]*s.c[b] + G*s.c[a]*s.b[b];
                const scalar yx = c12*s.c[a]*s.b[b] + G*s.b[a]*s.c[b];
                const vector2D& fa = free[q[a]];
                const vector2D& fb = free[q[b]];
                uniform_.add(q[a], 0, q[b], 0, fa.x()*fb.x()*xx);
                uniform_.add(q[a], 1, q[b], 1, fa.y()*fb.y()*yy);
                uniform_.add(q[a], 0, q[b], 1, fa.x()*fb.y()*xy);
                uniform_.add(q[a], 1, q[b], 0, fa.y()*fb.x()*yx);
            }
        }
    }
    // Contributions of other processes to a node's diagonal; components held
    // by walls
    forAll(local, i)
    {
        for (label k = 0; k < 2; ++k)
        {
            const scalar more = diagonal_[i][k] - local[i][k];
            uniform_.add(i, k, i, k, free[i][k] > 0 ? more : 1);
        }
    }
    uniform_.factorise();
}


void Foam::granularMechanicsModels::equilibrium::cellDiagonal
(
    nodeField& diagonal
) const
{
    forAll(diagonal, i)
    {
        diagonal[i] = vector2D(Zero);
    }
    forAll(shapes_, celli)
    {
        const quadMesh::shape& s = shapes_[celli];
        const quadMesh::quad& q = quads_.quads()[celli];
        const FixedList<scalar, 9>& C = C_[celli];
        for (label a = 0; a < 4; ++a)
        {
            const scalar b = s.b[a], c = s.c[a];
            const scalar hg =
                hourglass*scale_*sqr(reference_[celli].gamma[a]);
            diagonal[q[a]].x() += s.area*(C[0]*b*b + C[8]*c*c) + hg;
            diagonal[q[a]].y() += s.area*(C[4]*c*c + C[8]*b*b) + hg;
        }
    }
}


void Foam::granularMechanicsModels::equilibrium::findDiagonal()
{
    cellDiagonal(diagonal_);
    quads_.sum(diagonal_);
    forAll(diagonal_, i)
    {
        diagonal_[i] += stick_[i];
    }
}


void Foam::granularMechanicsModels::equilibrium::multiply
(
    const nodeField& d,
    nodeField& result
) const
{
    result = nodeField(d.size(), vector2D(Zero));
    scalarField stressXX(C_.size()), stressYY(C_.size());
    forAll(shapes_, celli)
    {
        const quadMesh::shape& s = shapes_[celli];
        const quadMesh::quad& q = quads_.quads()[celli];
        const scalar* gamma = reference_[celli].gamma;
        scalar exx = 0, eyy = 0, exy = 0;
        vector2D pattern(Zero);
        for (label a = 0; a < 4; ++a)
        {
            const vector2D& v = d[q[a]];
            exx += s.b[a]*v.x();
            eyy += s.c[a]*v.y();
            exy += s.c[a]*v.x() + s.b[a]*v.y();
            pattern += gamma[a]*v;
        }
        const FixedList<scalar, 9>& C = C_[celli];
        const scalar xx = s.area*(C[0]*exx + C[1]*eyy + C[2]*exy);
        const scalar yy = s.area*(C[3]*exx + C[4]*eyy + C[5]*exy);
        const scalar xy = s.area*(C[6]*exx + C[7]*eyy + C[8]*exy);
        stressXX[celli] = xx/s.area;
        stressYY[celli] = yy/s.area;
        pattern *= hourglass*scale_;
        for (label a = 0; a < 4; ++a)
        {
            vector2D& f = result[q[a]];
            f.x() += s.b[a]*xx + s.c[a]*xy + gamma[a]*pattern.x();
            f.y() += s.c[a]*yy + s.b[a]*xy + gamma[a]*pattern.y();
        }
    }
    if (coupled_)
    {
        nodeField change(d.size(), vector2D(Zero));
        walls_.addGrip(stressXX, stressYY, change);
        forAll(result, i)
        {
            result[i] -= change[i];
        }
    }
    quads_.sum(result);
    forAll(result, i)
    {
        for (label k = 0; k < 2; ++k)
        {
            result[i][k] =
                walls_.free()[i][k]*(result[i][k] + stick_[i][k]*d[i][k]);
        }
    }
}


void Foam::granularMechanicsModels::equilibrium::precondition
(
    const nodeField& r,
    nodeField& z
) const
{
    const auto scaled = [this](nodeField& values)
    {
        forAll(values, i)
        {
            for (label k = 0; k < 2; ++k)
            {
                values[i][k] *=
                    walls_.free()[i][k]
                   *std::sqrt
                    (
                        quads_.weight()[i]
                       *uniformDiagonal_[i][k]/diagonal_[i][k]
                    );
            }
        }
    };
    z = r;
    scaled(z);
    uniform_.solve(z);
    scaled(z);
    quads_.sum(z);
}


void Foam::granularMechanicsModels::equilibrium::solveLinear
(
    const nodeField& r0,
    nodeField& d
)
{
    const nodeField none(r0.size(), vector2D(Zero));
    nodeField r(r0), p(r0), v(none), direction(none), along(none), t(none);
    d = none;
    scalar rho = quads_.dot(r0, r);
    const scalar enough = rho*sqr(linearTolerance);

    for (label i = 0; i < maxLinear; ++i)
    {
        precondition(p, direction);
        multiply(direction, v);
        const scalar curvature = quads_.dot(r0, v);
        if (mag(curvature) <= VSMALL)
        {
            break;      // what remains is rounding error
        }
        const scalar alpha = rho/curvature;
        forAll(r, n)
        {
            r[n] -= alpha*v[n];
            d[n] += alpha*direction[n];
        }
        ++counters_.linear;
        if (quads_.dot(r, r) <= enough)
        {
            break;
        }

        precondition(r, along);
        multiply(along, t);
        const scalar tt = quads_.dot(t, t);
        if (tt <= VSMALL)
        {
            break;
        }
        const scalar omega = quads_.dot(t, r)/tt;
        forAll(r, n)
        {
            r[n] -= omega*t[n];
            d[n] += omega*along[n];
        }
        ++counters_.linear;
        const scalar next = quads_.dot(r0, r);
        if (quads_.dot(r, r) <= enough || mag(rho*omega) <= VSMALL)
        {
            break;
        }
        const scalar beta = next/rho*alpha/omega;
        forAll(p, n)
        {
            p[n] = r[n] + beta*(p[n] - omega*v[n]);
        }
        rho = next;
    }
}


// ************************************************************************* //
