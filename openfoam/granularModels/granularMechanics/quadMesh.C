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

#include "quadMesh.H"
#include "syncTools.H"
#include "emptyPolyPatch.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::quadMesh::quadMesh(const fvMesh& mesh)
:
    mesh_(mesh)
{
    findQuads();

    List<vector2D> ones(size(), vector2D(1, 1));
    sum(ones);
    weight_.resize(size());
    forAll(weight_, i)
    {
        weight_[i] = 1/ones[i].x();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::quadMesh::findQuads()
{
    labelList nodeOfPoint(mesh_.nPoints(), -1);
    DynamicList<label> front(mesh_.nPoints());
    quads_.resize(mesh_.nCells());
    label found = 0;

    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        if (!isA<emptyPolyPatch>(patch))
        {
            continue;
        }
        forAll(patch, i)
        {
            const face& f = patch[i];
            const vector n(f.areaNormal(mesh_.points()));
            if (n.z() >= -0.5*mag(n))
            {
                continue;
            }
            if (f.size() != 4)
            {
                FatalErrorInFunction
                    << "Cell " << patch.faceCells()[i] << " of the mesh has "
                    << f.size() << " points in the plane, allowed with"
                    << " mechanics equilibrium: 4" << exit(FatalError);
            }
            quad& q = quads_[patch.faceCells()[i]];
            // The face is at the lower z and its normal points outwards, down:
            // seen from above its points go clockwise, here they are reversed
            forAll(f, a)
            {
                label& node = nodeOfPoint[f[3 - a]];
                if (node < 0)
                {
                    node = front.size();
                    front.append(f[3 - a]);
                }
                q[a] = node;
            }
            ++found;
        }
    }
    if (returnReduce(found != mesh_.nCells(), orOp<bool>()))
    {
        FatalErrorInFunction
            << "The mesh does not have exactly one empty face at the lower z for"
            << " each cell, as mechanics equilibrium needs" << exit(FatalError);
    }

    front_ = front;
    points_.resize(front_.size());
    forAll(points_, i)
    {
        const point& p = mesh_.points()[front_[i]];
        points_[i] = vector2D(p.x(), p.y());
    }
    findBack(nodeOfPoint);
    findWalls(nodeOfPoint);
}


void Foam::quadMesh::findBack(const labelList& nodeOfPoint)
{
    back_.resize(front_.size());
    forAll(back_, i)
    {
        back_[i] = front_[i];
        for (const label pointi : mesh_.pointPoints()[front_[i]])
        {
            if (nodeOfPoint[pointi] < 0)
            {
                back_[i] = pointi;
            }
        }
    }
}


void Foam::quadMesh::findWalls(const labelList& nodeOfPoint)
{
    walls_.resize(mesh_.boundary().size());
    forAll(walls_, patchi)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        DynamicList<edgeOfWall> edges;
        forAll(patch, i)
        {
            const face& f = patch[i];
            const vector n(f.areaNormal(mesh_.points()));
            if (mag(n.z()) > 0.5*mag(n))
            {
                continue;
            }
            edgeOfWall e;
            e.first = e.second = -1;
            e.cell = patch.faceCells()[i];
            for (const label pointi : f)
            {
                const label node = nodeOfPoint[pointi];
                if (node >= 0)
                {
                    (e.first < 0 ? e.first : e.second) = node;
                }
            }
            edges.append(e);
        }
        walls_[patchi] = edges;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::quadMesh::shapes
(
    const List<vector2D>& at,
    List<shape>& result
) const
{
    static const scalar h[4] = {1, -1, 1, -1};

    result.resize(quads_.size());
    forAll(quads_, celli)
    {
        shape& s = result[celli];
        scalar x[4], y[4];
        for (label a = 0; a < 4; ++a)
        {
            x[a] = at[quads_[celli][a]].x();
            y[a] = at[quads_[celli][a]].y();
        }
        s.area =
            0.5*((x[2] - x[0])*(y[3] - y[1]) + (x[1] - x[3])*(y[2] - y[0]));
        if (!(s.area > 0))
        {
            return celli;
        }
        const scalar r = 0.5/s.area;
        scalar hx = 0, hy = 0;
        for (label a = 0; a < 4; ++a)
        {
            const label next = (a + 1) % 4, last = (a + 3) % 4;
            s.b[a] = r*(y[next] - y[last]);
            s.c[a] = r*(x[last] - x[next]);
            hx += h[a]*x[a];
            hy += h[a]*y[a];
        }
        for (label a = 0; a < 4; ++a)
        {
            s.gamma[a] = 0.25*(h[a] - hx*s.b[a] - hy*s.c[a]);
        }
    }
    return -1;
}


void Foam::quadMesh::sum(List<vector2D>& values) const
{
    if (Pstream::parRun())
    {
        // OpenFOAM's exchange between processes handles vectors of three
        // components only (it may rotate them between periodic patches)
        List<vector> all(values.size());
        forAll(all, i)
        {
            all[i] = vector(values[i].x(), values[i].y(), 0);
        }
        syncTools::syncPointList
        (
            mesh_, front_, all, plusEqOp<vector>(), vector(Zero)
        );
        forAll(all, i)
        {
            values[i] = vector2D(all[i].x(), all[i].y());
        }
    }
}


Foam::scalar Foam::quadMesh::dot
(
    const List<vector2D>& a,
    const List<vector2D>& b
) const
{
    scalar result = 0;
    forAll(a, i)
    {
        result += weight_[i]*(a[i].x()*b[i].x() + a[i].y()*b[i].y());
    }
    return returnReduce(result, sumOp<scalar>());
}


// ************************************************************************* //
