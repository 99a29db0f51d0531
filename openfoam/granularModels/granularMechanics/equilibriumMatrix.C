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

//- Least stiffness of a cell, divided by E r/l: grains that do not touch have
//- none, but the equations need some
static const scalar leastStiffness = 0.01;

//- Least ratio of a pivot to its diagonal of a cell's stiffness matrix, and
//- factor by which the other components are reduced until it is reached
static const scalar leastPivot = 0.05;
static const scalar reduction = 0.8;

//- The same for grains that do not slide, and their shear modulus over c11
static const scalar cautiousPivot = 0.8;
static const scalar cautiousShear = 0.35;

//- The linear equations of a Newton iteration are solved until their residual
//- is this share of the imbalance
static const scalar linearTolerance = 0.1;
static const label maxLinear = 500;

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
    const label caution
)
{
    const scalar least = leastStiffness*scale_;
    const scalar leastRatio = caution ? cautiousPivot : leastPivot;
    const scalar factor = caution ? std::pow(2.0, caution - 1) : 1;
    forAll(C_, celli)
    {
        // Symmetric part: conjugate gradients need it, and where grains slide
        // the tangent has no other
        FixedList<scalar, 6>& c = C_[celli];
        c[0] = max(tangent_[0][celli], least);
        c[1] = max(tangent_[4][celli], least);
        c[2] = max(tangent_[8][celli], 0.5*least);
        c[3] = 0.5*(tangent_[1][celli] + tangent_[3][celli]);
        c[4] = 0.5*(tangent_[2][celli] + tangent_[6][celli]);
        c[5] = 0.5*(tangent_[5][celli] + tangent_[7][celli]);

        if (caution)
        {
            c[0] = c[1] = factor*max(c[0], c[1]);
            c[2] = max(factor*c[2], cautiousShear*c[0]);
        }

        // Pivots of the Cholesky factorisation
        for (label k = 0; k < 20; ++k)
        {
            const scalar second = c[1] - sqr(c[3])/c[0];
            const scalar other = c[5] - c[3]*c[4]/c[0];
            const scalar third = c[2] - sqr(c[4])/c[0] - sqr(other)/second;
            if (second > leastRatio*c[1] && third > leastRatio*c[2])
            {
                break;
            }
            c[3] *= reduction;
            c[4] *= reduction;
            c[5] *= reduction;
        }
    }
}


void Foam::granularMechanicsModels::equilibrium::setUniform()
{
    forAll(C_, celli)
    {
        C_[celli] = Zero;
        C_[celli][0] = C_[celli][1] = scale_*uniformC11;
        C_[celli][2] = scale_*uniformG;
        C_[celli][3] = scale_*uniformC12;
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
        const scalar c11 = s.area*C_[celli][0], c12 = s.area*C_[celli][3];
        const scalar G = s.area*C_[celli][2];
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
        const FixedList<scalar, 6>& C = C_[celli];
        for (label a = 0; a < 4; ++a)
        {
            const scalar b = s.b[a], c = s.c[a];
            const scalar hg =
                hourglass*scale_*sqr(reference_[celli].gamma[a]);
            diagonal[q[a]].x() +=
                s.area*(b*(C[0]*b + 2*C[4]*c) + C[2]*c*c) + hg;
            diagonal[q[a]].y() +=
                s.area*(c*(C[1]*c + 2*C[5]*b) + C[2]*b*b) + hg;
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
    forAll(result, i)
    {
        result[i] = vector2D(Zero);
    }
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
        const FixedList<scalar, 6>& C = C_[celli];
        const scalar xx = s.area*(C[0]*exx + C[3]*eyy + C[4]*exy);
        const scalar yy = s.area*(C[3]*exx + C[1]*eyy + C[5]*exy);
        const scalar xy = s.area*(C[4]*exx + C[5]*eyy + C[2]*exy);
        pattern *= hourglass*scale_;
        for (label a = 0; a < 4; ++a)
        {
            vector2D& f = result[q[a]];
            f.x() += s.b[a]*xx + s.c[a]*xy + gamma[a]*pattern.x();
            f.y() += s.c[a]*yy + s.b[a]*xy + gamma[a]*pattern.y();
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


void Foam::granularMechanicsModels::equilibrium::conjugateGradients
(
    const nodeField& r0,
    nodeField& d
)
{
    nodeField r(r0), z(r0), Ap(r0);
    d = nodeField(r0.size(), vector2D(Zero));
    precondition(r, z);
    nodeField p(z);
    scalar rz = quads_.dot(r, z);
    const scalar enough = rz*sqr(linearTolerance);

    for (label i = 0; i < maxLinear && rz > enough && rz > VSMALL; ++i)
    {
        multiply(p, Ap);
        const scalar pAp = quads_.dot(p, Ap);
        if (!(pAp > 0))
        {
            break;      // what remains is rounding error
        }
        const scalar alpha = rz/pAp;
        forAll(d, n)
        {
            d[n] += alpha*p[n];
            r[n] -= alpha*Ap[n];
        }
        precondition(r, z);
        const scalar next = quads_.dot(r, z);
        forAll(p, n)
        {
            p[n] = z[n] + (next/rz)*p[n];
        }
        rz = next;
        ++counters_.linear;
    }
}


// ************************************************************************* //
