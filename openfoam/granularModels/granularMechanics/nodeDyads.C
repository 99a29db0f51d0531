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

#include "nodeDyads.H"
#include "rigidMotion.H"

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Share of the largest value below which an axis is not spanned: of two unit
//- vectors at an angle a to each other, or to the opposite, a*a/4. Mesh points
//- are rounded, and so the two sides of a thin plate need not be parallel
static const scalar negligible = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::nodeDyads::nodeDyads(const elementMesh& mesh)
:
    mesh_(mesh),
    diagonal_(3*mesh.size(), Zero),
    other_(3*mesh.size(), Zero)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::nodeDyads::add
(
    const label node,
    const scalar* vector,
    const scalar factor
)
{
    const label dim = mesh_.dim();
    for (label k = 0; k < dim; ++k)
    {
        const label next = (k + 1) % dim;
        diagonal_[3*node + k] += factor*sqr(vector[k]);
        if (k < next || dim == 3)
        {
            other_[3*node + k] += factor*vector[k]*vector[next];
        }
    }
}


void Foam::nodeDyads::sum()
{
    mesh_.sum(diagonal_, 3);
    mesh_.sum(other_, 3);
}


Foam::label Foam::nodeDyads::axes
(
    const label node,
    scalarField& vectors,
    scalarField& values
) const
{
    const label dim = mesh_.dim();
    const scalar* d = diagonal_.cdata() + 3*node;
    const scalar* o = other_.cdata() + 3*node;
    if (!(d[0] + d[1] + d[2] > VSMALL))
    {
        return 0;
    }
    scalarField M(dim*dim, Zero), ascending(dim);
    for (label k = 0; k < dim; ++k)
    {
        M[dim*k + k] = d[k];
    }
    M[1] = M[dim] = o[0];
    if (dim == 3)
    {
        M[5] = M[7] = o[1];
        M[2] = M[6] = o[2];
    }
    symmetricEigen(M, ascending);
    vectors.resize(dim*dim);
    values.resize(dim);
    label count = 0;
    for (label k = 0; k < dim; ++k)
    {
        const label from = dim - 1 - k;
        values[k] = ascending[from];
        count += values[k] > negligible*values[0];
        for (label j = 0; j < dim; ++j)
        {
            vectors[dim*k + j] = M[dim*from + j];
        }
    }
    return count;
}


// ************************************************************************* //
