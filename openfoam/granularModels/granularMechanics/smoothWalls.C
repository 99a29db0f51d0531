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

#include "smoothWalls.H"

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Cosine of the angle between the normals of faces up to which they are one
//- smooth wall: 45 degrees, less so much that a regular octagon has edges also
//- where its points are rounded
static const scalar smooth = 0.7072;

//- Sine of the angle to an axis below which a normal counts as aligned with it
static const scalar alignedSine = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::smoothWalls::smoothWalls
(
    const elementMesh& mesh,
    const boolList& chosen
)
:
    mesh_(mesh),
    dim_(mesh.dim()),
    walls_(chosen.size()),
    shares_(chosen.size())
{
    // Area of each face at each of its nodes, and the areas around each node
    List<vectorField> areas(chosen.size());
    List<List<vector>> around(mesh.size());
    scalarField weights;
    forAll(chosen, patchi)
    {
        if (!chosen[patchi])
        {
            continue;
        }
        const elementMesh::wallFaces& faces = mesh.wall(patchi);
        areas[patchi].resize(faces.nodes.size());
        for (label i = 0; i < faces.size(); ++i)
        {
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            const label* nodes = faces.nodes.cdata() + start;
            weights.resize(max(weights.size(), 3*count));
            mesh.faceWeights(mesh.points(), nodes, count, weights.data());
            for (label a = 0; a < count; ++a)
            {
                areas[patchi][start + a] = mesh.vectorAt(weights, a);
                around[nodes[a]].append(areas[patchi][start + a]);
            }
        }
    }
    mesh.gather(around);

    DynamicList<label> nodes;
    DynamicList<scalar> normals, sizes;
    labelListList wallOf(mesh.size());
    forAll(around, node)
    {
        wallOf[node] = add(node, around[node], nodes, normals, sizes);
    }
    nodes_.transfer(nodes);
    normals_ = scalarField(normals);
    areas_ = scalarField(sizes);

    forAll(areas, patchi)
    {
        const labelList& node = mesh.wall(patchi).nodes;
        walls_[patchi].resize(areas[patchi].size());
        shares_[patchi].resize(areas[patchi].size());
        forAll(areas[patchi], j)
        {
            // Faces with the same area belong to the same wall
            const vector& area = areas[patchi][j];
            const label i = wallOf[node[j]][around[node[j]].find(area)];
            walls_[patchi][j] = i;
            shares_[patchi][j] =
                i < 0 ? 0 : along(i, area.cdata())/areas_[i];
        }
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::smoothWalls::linked(const vector& a, const vector& b)
{
    return (a & b) > smooth*mag(a)*mag(b);
}


Foam::labelList Foam::smoothWalls::grouped(const UList<vector>& areas)
{
    labelList group(identity(areas.size()));
    forAll(areas, i)
    {
        for (label j = 0; j < i; ++j)
        {
            const label from = group[i], to = group[j];
            if (from != to && linked(areas[i], areas[j]))
            {
                for (label k = 0; k <= i; ++k)
                {
                    group[k] = group[k] == from ? to : group[k];
                }
            }
        }
    }
    return group;
}


Foam::labelList Foam::smoothWalls::add
(
    const label node,
    const UList<vector>& areas,
    DynamicList<label>& nodes,
    DynamicList<scalar>& normals,
    DynamicList<scalar>& sizes
) const
{
    const labelList group(grouped(areas));
    labelList result(areas.size(), -1);
    forAll(areas, i)
    {
        if (result[i] >= 0)
        {
            continue;
        }
        vector sum(Zero), alike(Zero);
        forAll(areas, j)
        {
            sum += group[j] == group[i] ? areas[j] : vector(Zero);
            alike += areas[j] == areas[i] ? areas[j] : vector(Zero);
        }
        bool whole = true;
        forAll(areas, j)
        {
            whole = whole && (group[j] != group[i] || linked(areas[j], sum));
        }
        sum = whole ? sum : alike;
        if (!(mag(sum) > VSMALL))
        {
            continue;
        }
        forAll(areas, j)
        {
            const bool belongs =
                whole ? group[j] == group[i] : areas[j] == areas[i];
            result[j] = belongs ? nodes.size() : result[j];
        }
        vector n(sum/mag(sum));
        align(n.data(), dim_);
        nodes.append(node);
        sizes.append(mag(sum));
        for (label k = 0; k < dim_; ++k)
        {
            normals.append(n[k]);
        }
    }
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::smoothWalls::align(scalar* normal, const label dim)
{
    for (label k = 0; k < dim; ++k)
    {
        normal[k] = mag(normal[k]) < alignedSine ? 0 : normal[k];
    }
}


Foam::scalar Foam::smoothWalls::along
(
    const label i,
    const scalar* vector
) const
{
    scalar sum = 0;
    for (label k = 0; k < dim_; ++k)
    {
        sum += normals_[dim_*i + k]*vector[k];
    }
    return sum;
}


void Foam::smoothWalls::add
(
    const label i,
    const scalar value,
    scalarField& sum
) const
{
    for (label k = 0; k < dim_; ++k)
    {
        sum[dim_*nodes_[i] + k] += value*normals_[dim_*i + k];
    }
}


// ************************************************************************* //
