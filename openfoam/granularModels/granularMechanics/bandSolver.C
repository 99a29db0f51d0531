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

#include "bandSolver.H"
#include "bandCompression.H"

#include <cmath>

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::bandSolver::bandSolver(const quadMesh& mesh)
:
    number_(mesh.size()),
    rows_(2*mesh.size()),
    width_(1)
{
    List<DynamicList<label>> near(mesh.size());
    for (const quadMesh::quad& q : mesh.quads())
    {
        for (const label a : q)
        {
            for (const label b : q)
            {
                if (a != b && !near[a].found(b))
                {
                    near[a].append(b);
                }
            }
        }
    }
    labelListList neighbours(near.size());
    forAll(near, i)
    {
        neighbours[i] = near[i];
    }
    const labelList order(bandCompression(neighbours));
    forAll(order, i)
    {
        number_[order[i]] = i;
    }
    forAll(neighbours, a)
    {
        for (const label b : neighbours[a])
        {
            width_ = max(width_, 2*mag(number_[a] - number_[b]) + 1);
        }
    }
    factor_.resize(rows_*(width_ + 1), Zero);
    x_.resize(rows_);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::bandSolver::factorise()
{
    for (label i = 0; i < rows_; ++i)
    {
        const label first = max(label(0), i - width_);
        scalar* Li = &entry(i, i) - i;      // Li[j] is entry (i, j)
        for (label j = first; j <= i; ++j)
        {
            const scalar* Lj = &entry(j, j) - j;
            scalar value = Li[j];
            for (label k = max(first, j - width_); k < j; ++k)
            {
                value -= Li[k]*Lj[k];
            }
            if (j < i)
            {
                Li[j] = value/Lj[j];
            }
            else
            {
                // A free rigid motion leaves a zero
                Li[i] = value > SMALL*mag(Li[i]) ? std::sqrt(value) : GREAT;
            }
        }
    }
}


void Foam::bandSolver::solve(List<vector2D>& values) const
{
    forAll(values, i)
    {
        x_[2*number_[i]] = values[i].x();
        x_[2*number_[i] + 1] = values[i].y();
    }
    const label stride = width_ + 1;
    for (label i = 0; i < rows_; ++i)
    {
        const scalar* L = factor_.cdata() + i*stride + width_ - i;
        scalar value = x_[i];
        for (label k = max(label(0), i - width_); k < i; ++k)
        {
            value -= L[k]*x_[k];
        }
        x_[i] = value/L[i];
    }
    for (label i = rows_ - 1; i >= 0; --i)
    {
        const scalar* L = factor_.cdata() + i*stride + width_ - i;
        x_[i] /= L[i];
        const scalar value = x_[i];
        for (label k = max(label(0), i - width_); k < i; ++k)
        {
            x_[k] -= L[k]*value;
        }
    }
    forAll(values, i)
    {
        values[i] =
            vector2D(x_[2*number_[i]], x_[2*number_[i] + 1]);
    }
}


// ************************************************************************* //
