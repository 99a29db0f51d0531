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

#include "wallConditions.H"

namespace Foam
{

//- Factor of the resistance to motion along curved walls: above 1, so that it
//- also outweighs pressures at the wall above the mean
static const scalar resistance = 3;

//- Curvature times the size of a node's wall below which it is flat
static const scalar flatWall = 1e-6;


static vector normalAt(const scalar* n, const label dim)
{
    return vector(n[0], n[1], dim == 3 ? n[2] : 0);
}


//- Unit vectors along a wall with this normal; in the plane the first alone
static void tangents(const vector& n, FixedList<vector, 2>& along)
{
    if (mag(n.z()) <= SMALL)
    {
        along[0] = vector(-n.y(), n.x(), 0);
    }
    else
    {
        along[0] = n ^ (mag(n.x()) < 0.7 ? vector(1, 0, 0) : vector(0, 1, 0));
    }
    along[0] /= mag(along[0]);
    along[1] = n ^ along[0];
}


//- The largest principal curvatures that a wall has at a node, at most one for
//- each way along it, from the sums of findCurvature: unit vectors times the
//- root of the curvature [1/m]
static List<vector> convexWays
(
    const FixedList<scalar, 7>& sums,
    const FixedList<vector, 2>& along,
    const label ways
)
{
    if (ways == 1)
    {
        const scalar curvature = sums[0] > VSMALL ? sums[1]/sums[0] : 0;
        return
            curvature > 0
          ? List<vector>(1, std::sqrt(curvature)*along[0])
          : List<vector>();
    }
    // K = turn x^T (x x^T)^-1, of which the symmetric part counts
    const scalar a = sums[0], b = sums[1], c = sums[2], det = a*c - b*b;
    if (!(det > SMALL*sqr(a + c)))
    {
        return List<vector>();
    }
    const scalar* N = sums.cdata() + 3;
    const scalar xx = (N[0]*c - N[1]*b)/det, yy = (N[3]*a - N[2]*b)/det;
    const scalar xy = 0.5*((N[1]*a - N[0]*b) + (N[2]*c - N[3]*b))/det;
    const scalar middle = 0.5*(xx + yy);
    const scalar half = std::sqrt(sqr(0.5*(xx - yy)) + sqr(xy));
    const scalar angle = 0.5*std::atan2(xy, 0.5*(xx - yy));
    const vector first(std::cos(angle)*along[0] + std::sin(angle)*along[1]);
    const vector second(std::cos(angle)*along[1] - std::sin(angle)*along[0]);
    DynamicList<vector> result;
    if (middle + half > 0)
    {
        result.append(std::sqrt(middle + half)*first);
    }
    if (middle - half > 0)
    {
        result.append(std::sqrt(middle - half)*second);
    }
    return List<vector>(result);
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConditions::sumTurns
(
    const smoothWalls& walls,
    const labelList& wallOf,
    List<FixedList<vector, 2>>& along,
    List<FixedList<scalar, 7>>& sums
) const
{
    const label dim = mesh_.dim();
    // Over the faces around a node: area times the squares of the ways along the
    // wall from the node to the face, and times the change of the normal on
    // these ways
    const label ways = dim - 1, count = ways*(ways + 1)/2 + ways*ways;
    forAll(walls_, patchi)
    {
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        walls.each(patchi, [&](const label facei, const label i, const scalar share)
        {
            const label node = walls.node(i);
            if (wallOf[node] != i)
            {
                return;
            }
            const vector n(normalAt(walls.normal(i), dim));
            FixedList<vector, 2>& t = along[node];
            tangents(n, t);
            const label start = faces.start[facei], end = faces.start[facei + 1];
            vector x(Zero);
            for (label j = start; j < end; ++j)
            {
                x += mesh_.vectorAt(mesh_.points(), faces.nodes[j])/(end - start);
            }
            x -= mesh_.vectorAt(mesh_.points(), node);
            const vector turn(mesh_.vectorAt(normals_[patchi], facei) - n);
            const scalar area = share*walls.area(i);
            label k = 0;
            for (label a = 0; a < ways; ++a)
            {
                for (label b = a; b < ways; ++b)
                {
                    sums[node][k++] += area*(x & t[a])*(x & t[b]);
                }
            }
            for (label a = 0; a < ways; ++a)
            {
                for (label b = 0; b < ways; ++b)
                {
                    sums[node][k++] += area*(turn & t[a])*(x & t[b]);
                }
            }
        });
    }
    for (label k = 0; k < count; ++k)
    {
        scalarField part(mesh_.size());
        forAll(part, node)
        {
            part[node] = sums[node][k];
        }
        mesh_.sum(part, 1);
        forAll(part, node)
        {
            sums[node][k] = part[node];
        }
    }
}


void Foam::wallConditions::findCurvature()
{
    if (mesh_.radial() >= 0)
    {
        return;
    }
    const label dim = mesh_.dim();
    const smoothWalls walls
    (
        mesh_,
        chosen([](const wall& w)
        {
            return
                (w.holdsAcross() || w.stiffness > 0)
             && !w.displacement.valid();
        })
    );
    // Nodes of one wall alone. Rims could turn, too, but are few compared with the
    // nodes within the wall, whose resistance has a factor above 1
    labelList wallOf(mesh_.size(), -1);
    for (label i = 0; i < walls.size(); ++i)
    {
        label& wall = wallOf[walls.node(i)];
        wall = wall == -1 ? i : -2;
    }
    const label ways = dim - 1;
    List<FixedList<vector, 2>> along(mesh_.size());
    List<FixedList<scalar, 7>> sums(mesh_.size(), FixedList<scalar, 7>(Zero));
    sumTurns(walls, wallOf, along, sums);
    DynamicList<label> nodes;
    DynamicList<scalar> tangent, bend;
    for (label i = 0; i < walls.size(); ++i)
    {
        const label node = walls.node(i);
        if (wallOf[node] != i)
        {
            continue;
        }
        tangents(normalAt(walls.normal(i), dim), along[node]);
        for (const vector& t : convexWays(sums[node], along[node], ways))
        {
            const scalar curvature = magSqr(t), area = walls.area(i);
            const scalar length = dim == 3 ? std::sqrt(area) : area;
            if (curvature*length < flatWall)
            {
                continue;
            }
            nodes.append(node);
            bend.append(curvature*area);
            for (label k = 0; k < dim; ++k)
            {
                tangent.append(t[k]/mag(t));
            }
        }
    }
    curved_.transfer(nodes);
    tangent_ = scalarField(tangent);
    bend_ = scalarField(bend);
}


void Foam::wallConditions::addCurvature
(
    const scalarField& u,
    scalarField& force
) const
{
    const label dim = mesh_.dim();
    forAll(curved_, i)
    {
        const scalar* t = tangent_.cdata() + dim*i;
        const scalar along = component(u, curved_[i], t);
        for (label k = 0; k < dim; ++k)
        {
            force[dim*curved_[i] + k] -= pressing_*bend_[i]*along*t[k];
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallConditions::setPressing(const scalar pressure)
{
    pressing_ = resistance*max(pressure, scalar(0));
}


// ************************************************************************* //
