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

#include "twoFieldMatrix.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::label Foam::twoFieldMatrix::mostIterations = 500;

namespace Foam
{
    //- Iterations without a smaller residual, after which the rest is rounding
    static const label patience = 20;
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::twoFieldMatrix::part::part(const fvMesh& mesh)
:
    matrix(mesh),
    between(mesh.boundary().size())
{
    forAll(mesh.boundary(), patchi)
    {
        const fvPatch& patch = mesh.boundary()[patchi];
        between.set
        (
            patchi,
            new scalarField(patch.coupled() ? patch.size() : 0, Zero)
        );
    }
    matrix.diag();
    matrix.lower();
    matrix.upper();
}


Foam::twoFieldMatrix::twoFieldMatrix(const volScalarField& field)
:
    mesh_(field.mesh()),
    interfaces_(field.boundaryField().scalarInterfaces()),
    ab_(field.size(), Zero),
    ba_(field.size(), Zero),
    source_({scalarField(field.size(), Zero), scalarField(field.size(), Zero)}),
    aa_(mesh_),
    abAround_(mesh_),
    bb_(mesh_),
    inverse_(field.size()),
    iterations_(0),
    residual_(0)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::twoFieldMatrix::part::clear()
{
    matrix.diag() = 0;
    matrix.lower() = 0;
    matrix.upper() = 0;
    forAll(between, patchi)
    {
        between[patchi] = 0;
    }
}


Foam::twoFieldMatrix::block Foam::twoFieldMatrix::block::inverse() const
{
    const scalar over = 1/(aa*bb - ab*ba);
    block result;
    result.aa = over*bb;
    result.ab = -over*ab;
    result.ba = -over*ba;
    result.bb = over*aa;
    return result;
}


Foam::twoFieldMatrix::block Foam::twoFieldMatrix::block::operator*
(
    const block& other
) const
{
    block result;
    result.aa = aa*other.aa + ab*other.ba;
    result.ab = aa*other.ab + ab*other.bb;
    result.ba = ba*other.aa + bb*other.ba;
    result.bb = ba*other.ab + bb*other.bb;
    return result;
}


Foam::twoFieldMatrix::pair Foam::twoFieldMatrix::times(const pair& x) const
{
    pair result({scalarField(x.a.size()), scalarField(x.b.size())});
    scalarField other(x.b.size());
    aa_.matrix.Amul(result.a, x.a, aa_.between, interfaces_, 0);
    abAround_.matrix.Amul(other, x.b, abAround_.between, interfaces_, 0);
    bb_.matrix.Amul(result.b, x.b, bb_.between, interfaces_, 0);
    forAll(other, celli)
    {
        result.a[celli] += other[celli] + ab_[celli]*x.b[celli];
        result.b[celli] += ba_[celli]*x.a[celli];
    }
    return result;
}


void Foam::twoFieldMatrix::factorise()
{
    const labelUList& starts = mesh_.lduAddr().ownerStartAddr();
    const labelUList& upper = mesh_.lduAddr().upperAddr();
    forAll(inverse_, celli)
    {
        inverse_[celli].aa = aa_.matrix.diag()[celli];
        inverse_[celli].ab = abAround_.matrix.diag()[celli] + ab_[celli];
        inverse_[celli].ba = ba_[celli];
        inverse_[celli].bb = bb_.matrix.diag()[celli];
    }
    forAll(inverse_, celli)
    {
        inverse_[celli] = inverse_[celli].inverse();
        for (label facei = starts[celli]; facei < starts[celli + 1]; ++facei)
        {
            block down, up;
            down.aa = aa_.matrix.lower()[facei];
            down.ab = abAround_.matrix.lower()[facei];
            down.bb = bb_.matrix.lower()[facei];
            up.aa = aa_.matrix.upper()[facei];
            up.ab = abAround_.matrix.upper()[facei];
            up.bb = bb_.matrix.upper()[facei];
            const block change(down*(inverse_[celli]*up));
            block& next = inverse_[upper[facei]];
            next.aa -= change.aa;
            next.ab -= change.ab;
            next.ba -= change.ba;
            next.bb -= change.bb;
        }
    }
}


Foam::twoFieldMatrix::pair
Foam::twoFieldMatrix::precondition(const pair& r) const
{
    const labelUList& starts = mesh_.lduAddr().ownerStartAddr();
    const labelUList& upper = mesh_.lduAddr().upperAddr();
    const scalarField& lowerAA = aa_.matrix.lower();
    const scalarField& lowerAB = abAround_.matrix.lower();
    const scalarField& lowerBB = bb_.matrix.lower();
    const scalarField& upperAA = aa_.matrix.upper();
    const scalarField& upperAB = abAround_.matrix.upper();
    const scalarField& upperBB = bb_.matrix.upper();
    pair w(r);
    const label cells = r.a.size();
    for (label celli = 0; celli < cells; ++celli)
    {
        const block& D = inverse_[celli];
        const scalar a = D.aa*w.a[celli] + D.ab*w.b[celli];
        const scalar b = D.ba*w.a[celli] + D.bb*w.b[celli];
        w.a[celli] = a;
        w.b[celli] = b;
        for (label facei = starts[celli]; facei < starts[celli + 1]; ++facei)
        {
            w.a[upper[facei]] -= lowerAA[facei]*a + lowerAB[facei]*b;
            w.b[upper[facei]] -= lowerBB[facei]*b;
        }
    }
    for (label celli = cells - 1; celli >= 0; --celli)
    {
        scalar a = 0, b = 0;
        for (label facei = starts[celli]; facei < starts[celli + 1]; ++facei)
        {
            const label N = upper[facei];
            a += upperAA[facei]*w.a[N] + upperAB[facei]*w.b[N];
            b += upperBB[facei]*w.b[N];
        }
        const block& D = inverse_[celli];
        w.a[celli] -= D.aa*a + D.ab*b;
        w.b[celli] -= D.ba*a + D.bb*b;
    }
    return w;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::twoFieldMatrix::clear()
{
    for (part* each : {&aa_, &abAround_, &bb_})
    {
        each->clear();
    }
    ab_ = 0;
    ba_ = 0;
    source_.a = 0;
    source_.b = 0;
}


bool Foam::twoFieldMatrix::solve(pair& x, const scalar tolerance)
{
    const auto dot = [](const pair& p, const pair& q)
    {
        return
            returnReduce(sumProd(p.a, q.a) + sumProd(p.b, q.b), sumOp<scalar>());
    };
    const auto size = [](const pair& p)
    {
        return returnReduce(sumMag(p.a) + sumMag(p.b), sumOp<scalar>());
    };
    // y += f p
    const auto add = [](pair& y, const scalar f, const pair& p)
    {
        y.a += f*p.a;
        y.b += f*p.b;
    };
    factorise();

    const pair Ax(times(x));
    pair r(source_);
    add(r, -1, Ax);
    const scalar mean = gAverage(x.b);
    const pair reference
    (
        times({scalarField(x.a.size(), mean), scalarField(x.b.size(), mean)})
    );
    pair left(Ax), right(source_);
    add(left, -1, reference);
    add(right, -1, reference);
    const scalar scale = size(left) + size(right) + VSMALL;

    iterations_ = 0;
    residual_ = size(r)/scale;
    scalar least = residual_;
    label waited = 0;
    const pair shadow(r);
    pair best(x), p(r), v(r);
    scalar rho = 0, alpha = 0, omega = 0;
    while
    (
        residual_ > tolerance
     && iterations_ < mostIterations && waited < patience
    )
    {
        const scalar rhoBefore = rho;
        rho = dot(shadow, r);
        if (mag(rho) < VSMALL)
        {
            break;
        }
        if (iterations_)
        {
            const scalar beta = (rho/rhoBefore)*(alpha/omega);
            add(p, -omega, v);
            p.a = r.a + beta*p.a;
            p.b = r.b + beta*p.b;
        }
        const pair y(precondition(p));
        v = times(y);
        alpha = rho/dot(shadow, v);
        add(r, -alpha, v);
        add(x, alpha, y);
        ++iterations_;
        residual_ = size(r)/scale;
        if (residual_ > tolerance)
        {
            const pair z(precondition(r));
            const pair t(times(z));
            const scalar length = dot(t, t);
            if (length < VSMALL)
            {
                break;
            }
            omega = dot(t, r)/length;
            add(x, omega, z);
            add(r, -omega, t);
            residual_ = size(r)/scale;
            if (mag(omega) < VSMALL)
            {
                break;
            }
        }
        waited = residual_ < least ? 0 : waited + 1;
        if (residual_ < least)
        {
            least = residual_;
            best = x;
        }
    }
    if (residual_ > least)
    {
        x = best;
        residual_ = least;
    }
    return iterations_ < mostIterations;
}


// ************************************************************************* //
