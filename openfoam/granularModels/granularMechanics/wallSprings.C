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

#include "wallConditions.H"

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Share of the largest support of a node below which a direction has none
static const scalar leastSupport = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConditions::findSprings
(
    DynamicList<label>& supports,
    DynamicList<scalar>& normal,
    DynamicList<scalar>& support
) const
{
    // A node in a corner has a direction for each wall; where walls are curved,
    // those of its faces are nearly one
    const label dim = mesh_.dim();
    scalarField diagonal(3*mesh_.size(), Zero), other(diagonal), weights;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        for (label i = 0; w.springs() && i < faces.size(); ++i)
        {
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            const label* nodes = faces.nodes.cdata() + start;
            const scalar* n = normals_[patchi].cdata() + dim*i;
            weights.resize(max(weights.size(), 3*count));
            mesh_.faceWeights(mesh_.points(), nodes, count, weights.data());
            for (label a = 0; a < count; ++a)
            {
                scalar area = 0;
                for (label k = 0; k < dim; ++k)
                {
                    area += weights[dim*a + k]*n[k];
                }
                for (label k = 0; k < dim; ++k)
                {
                    const label next = (k + 1) % dim;
                    const scalar part = w.stiffness*area*n[k];
                    diagonal[3*nodes[a] + k] += part*n[k];
                    if (k < next || dim == 3)
                    {
                        other[3*nodes[a] + k] += part*n[next];
                    }
                }
            }
        }
    }
    mesh_.sum(diagonal, 3);
    mesh_.sum(other, 3);

    scalarField M(dim*dim), values(dim);
    for (label node = 0; node < mesh_.size(); ++node)
    {
        axes(diagonal.cdata() + 3*node, other.cdata() + 3*node, M, values);
        for (label k = dim - 1; k >= 0; --k)
        {
            if (values[k] > max(leastSupport*values[dim - 1], VSMALL))
            {
                supports.append(node);
                support.append(values[k]);
                for (label j = 0; j < dim; ++j)
                {
                    normal.append(M[dim*k + j]);
                }
            }
        }
    }
}


void Foam::wallConditions::addSprings
(
    const scalar time,
    const scalarField& u,
    scalarField& force
) const
{
    const label dim = mesh_.dim();
    for (label i = firstSpring_; i < supports_.size(); ++i)
    {
        const scalar* n = normal_.cdata() + dim*i;
        const label first = dim*supports_[i];
        scalar along = 0;
        for (label k = 0; k < dim; ++k)
        {
            along += n[k]*u[first + k];
        }
        for (label k = 0; k < dim; ++k)
        {
            force[first + k] -= support_[i]*along*n[k];
        }
    }

    // What moves takes its support with it
    scalarField moved(force.size(), Zero), weights;
    bool moving = false;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (!w.springs() || !w.displacement.valid())
        {
            continue;
        }
        moving = true;
        const vector p(w.displacement().value(time));
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        for (label i = 0; i < faces.size(); ++i)
        {
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            const label* nodes = faces.nodes.cdata() + start;
            const scalar* n = normals_[patchi].cdata() + dim*i;
            weights.resize(max(weights.size(), 3*count));
            mesh_.faceWeights(mesh_.points(), nodes, count, weights.data());
            scalar along = 0;
            for (label k = 0; k < dim; ++k)
            {
                along += n[k]*p[k];
            }
            for (label a = 0; a < count; ++a)
            {
                for (label k = 0; k < dim; ++k)
                {
                    moved[dim*nodes[a] + k] +=
                        w.stiffness*along*weights[dim*a + k];
                }
            }
        }
    }
    if (moving)
    {
        mesh_.sum(moved);
        force += moved;
    }
}


// ************************************************************************* //
