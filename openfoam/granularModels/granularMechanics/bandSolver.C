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

#include <algorithm>
#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Number of independent partial sums of a scalar product, so that additions do
//- not wait for one another and wide registers are filled
static const label sums = 16;

//- Compile a function for AVX2 and for any x86-64, chosen when the program
//- starts; the order of additions, and so every bit, is the same in both
#define FOR_ALL_WIDTHS __attribute__((target_clones("avx2", "default")))

//- Scalar product of 'count' values
static inline float product(const float* a, const float* b, const label count)
{
    float s[sums] = {};
    label k = 0;
    for (; k + sums <= count; k += sums)
    {
        for (label j = 0; j < sums; ++j)
        {
            s[j] += a[k + j]*b[k + j];
        }
    }
    for (label j = 0; k + j < count; ++j)
    {
        s[j] += a[k + j]*b[k + j];
    }
    for (label half = sums/2; half > 0; half /= 2)
    {
        for (label j = 0; j < half; ++j)
        {
            s[j] += s[j + half];
        }
    }
    return s[0];
}


//- x := inverse of the factor times x
FOR_ALL_WIDTHS static void forward
(
    const float* factor,
    const float* inverse,
    float* x,
    const label rows,
    const label width
)
{
    for (label i = 0; i < rows; ++i)
    {
        const label count = min(i, width);
        const float* L = factor + (i + 1)*width - count;
        x[i] = (x[i] - product(L, x + i - count, count))*inverse[i];
    }
}


//- x := inverse of the factor's transpose times x
FOR_ALL_WIDTHS static void backward
(
    const float* factor,
    const float* inverse,
    float* x,
    const label rows,
    const label width
)
{
    for (label i = rows - 1; i >= 0; --i)
    {
        const label count = min(i, width);
        const float* __restrict__ L = factor + (i + 1)*width - count;
        float* __restrict__ before = x + i - count;
        const float value = x[i]*inverse[i];
        x[i] = value;
        for (label k = 0; k < count; ++k)
        {
            before[k] -= L[k]*value;
        }
    }
}


//- Scalar product over the indices first to last - 1, in four independent
//- partial sums
static inline scalar product
(
    const scalar* a,
    const scalar* b,
    const label first,
    const label last
)
{
    scalar s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    label k = first;
    for (; k + 4 <= last; k += 4)
    {
        s0 += a[k]*b[k];
        s1 += a[k + 1]*b[k + 1];
        s2 += a[k + 2]*b[k + 2];
        s3 += a[k + 3]*b[k + 3];
    }
    for (; k < last; ++k)
    {
        s0 += a[k]*b[k];
    }
    return (s0 + s1) + (s2 + s3);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::bandSolver::bandSolver(const quadMesh& mesh)
:
    number_(mesh.size()),
    rows_(2*mesh.size()),
    width_(0)
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
    // Number the nodes by levels of their distance from one node, along x, or
    // along y, whichever gives the narrowest band
    const List<vector2D>& points = mesh.points();
    const scalar span = boundBox(mesh.mesh().points(), false).mag();
    const auto along = [&points, span](const label axis)
    {
        labelList order(identity(points.size()));
        std::stable_sort
        (
            order.begin(), order.end(),
            [&points, axis, span](const label a, const label b)
            {
                // Rounded: coordinates of one column of nodes differ in their
                // last digits
                const scalar xa = std::round(points[a][axis]/span*1e9);
                const scalar xb = std::round(points[b][axis]/span*1e9);
                return
                    xa != xb
                  ? xa < xb
                  : points[a][1 - axis] < points[b][1 - axis];
            }
        );
        return order;
    };
    width_ = labelMax;
    for
    (
        const labelList& order :
        {bandCompression(neighbours), along(0), along(1)}
    )
    {
        labelList number(order.size());
        forAll(order, i)
        {
            number[order[i]] = i;
        }
        label width = 1;
        forAll(neighbours, i)
        {
            for (const label j : neighbours[i])
            {
                width = max(width, 2*mag(number[i] - number[j]) + 1);
            }
        }
        if (width < width_)
        {
            width_ = width;
            number_ = number;
        }
    }
    matrix_.resize(rows_*(width_ + 1), Zero);
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
            const scalar value =
                Li[j] - product(Li, Lj, max(first, j - width_), j);
            if (j < i)
            {
                Li[j] = value/Lj[j];
            }
            else
            {
                // If a rigid motion is free, its last pivot is zero
                Li[i] = value > SMALL*mag(Li[i]) ? std::sqrt(value) : GREAT;
            }
        }
    }

    factor_.resize(rows_*width_);
    inverse_.resize(rows_);
    for (label i = 0; i < rows_; ++i)
    {
        const scalar* L = matrix_.cdata() + i*(width_ + 1);
        for (label k = 0; k < width_; ++k)
        {
            factor_[i*width_ + k] = L[k];
        }
        inverse_[i] = 1/L[width_];
    }
    matrix_.clear();
}


void Foam::bandSolver::solve(List<vector2D>& values) const
{
    // Scaled to a largest value of 1, since single precision has a small range
    scalar most = 0;
    forAll(values, i)
    {
        most = max(most, cmptMax(cmptMag(values[i])));
    }
    const scalar scale = most > VSMALL ? 1/most : 1;
    forAll(values, i)
    {
        x_[2*number_[i]] = scale*values[i].x();
        x_[2*number_[i] + 1] = scale*values[i].y();
    }

    const float* L = factor_.cdata();
    const float* inverse = inverse_.cdata();
    forward(L, inverse, x_.data(), rows_, width_);
    backward(L, inverse, x_.data(), rows_, width_);

    forAll(values, i)
    {
        values[i] =
            vector2D(x_[2*number_[i]], x_[2*number_[i] + 1])/scale;
    }
}


// ************************************************************************* //
