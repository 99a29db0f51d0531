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

#include "elementMesh.H"
#include "emptyPolyPatch.H"
#include "wedgePolyPatch.H"
#include "syncTools.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Distance from the axis of a wedge, over the size of the mesh, below which a
//- point lies on it
static const scalar axial = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::elementMesh::findKind()
{
    label wedges = 0, empty = 0;
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        empty += isA<emptyPolyPatch>(patch) && patch.size();
        if (const auto* wedge = isA<wedgePolyPatch>(patch))
        {
            ++wedges;
            const vector axis(cmptMag(wedge->axis()));
            radial_ = axis.x() > 0.5 ? 1 : 0;
            if (axis.z() > 0.5 || mag(wedge->centreNormal().z()) < 0.5)
            {
                FatalErrorInFunction
                    << "The patches of type wedge lie about the axis "
                    << wedge->axis() << " and on both sides of a plane with"
                    << " normal " << wedge->centreNormal() << ", allowed with"
                    << " mechanics equilibrium: axis x or y, normal z"
                    << exit(FatalError);
            }
        }
    }
    reduce(empty, sumOp<label>());
    kind_ = wedges ? kind::axisymmetric : empty ? kind::plane : kind::solid;
}


void Foam::elementMesh::findPlaneNodes()
{
    labelList nodeOfPoint(mesh_.nPoints(), -1);
    DynamicList<label> front(mesh_.nPoints());
    labelList faceOfCell(mesh_.nCells(), -1);
    label found = 0;

    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        if (!isA<emptyPolyPatch>(patch) && !isA<wedgePolyPatch>(patch))
        {
            continue;
        }
        forAll(patch, i)
        {
            const vector n(patch[i].areaNormal(mesh_.points()));
            if (n.z() < -0.5*mag(n))
            {
                faceOfCell[patch.faceCells()[i]] = patch.start() + i;
                ++found;
            }
        }
    }
    const bool missing = found != mesh_.nCells() || faceOfCell.found(-1);
    if (returnReduce(missing, orOp<bool>()))
    {
        FatalErrorInFunction
            << "The mesh does not have exactly one face at the lower z for each"
            << " cell on patches of type empty or wedge, as mechanics"
            << " equilibrium needs for meshes of one layer"
            << exit(FatalError);
    }

    start_.resize(mesh_.nCells() + 1);
    start_[0] = 0;
    forAll(faceOfCell, celli)
    {
        start_[celli + 1] =
            start_[celli] + mesh_.faces()[faceOfCell[celli]].size();
    }
    nodes_.resize(start_.last());
    forAll(faceOfCell, celli)
    {
        // The face is at the lower z and its normal points outwards, down: seen
        // from above its points go clockwise, here they are reversed
        const face& f = mesh_.faces()[faceOfCell[celli]];
        forAll(f, a)
        {
            const label pointi = f[f.size() - 1 - a];
            label& node = nodeOfPoint[pointi];
            if (node < 0)
            {
                node = front.size();
                front.append(pointi);
            }
            nodes_[start_[celli] + a] = node;
        }
    }
    front_ = front;
    findBack(nodeOfPoint);
    findWalls(nodeOfPoint);
}


void Foam::elementMesh::findBack(const labelList& nodeOfPoint)
{
    back_ = front_;
    const scalar near = axial*mesh_.bounds().mag();
    const auto onAxis = [&](const label point)
    {
        return
            kind_ == kind::axisymmetric
         && mag(mesh_.points()[point][radial_]) < near;
    };
    for (const face& f : mesh_.faces())
    {
        forAll(f, i)
        {
            const label p = f[i], q = f.nextLabel(i);
            const label a = nodeOfPoint[p], b = nodeOfPoint[q];
            // On the axis of a wedge a node has no point behind it: the points
            // next to it belong to other nodes
            if (a >= 0 && b < 0 && !onAxis(p))
            {
                back_[a] = q;
            }
            else if (b >= 0 && a < 0 && !onAxis(q))
            {
                back_[b] = p;
            }
        }
    }
}


void Foam::elementMesh::findSolidNodes()
{
    front_ = identity(mesh_.nPoints());
    back_ = front_;
    start_.resize(mesh_.nCells() + 1);
    start_[0] = 0;
    DynamicList<label> nodes(8*mesh_.nCells());
    forAll(mesh_.cells(), celli)
    {
        nodes.append(mesh_.cells()[celli].labels(mesh_.faces()));
        start_[celli + 1] = nodes.size();
    }
    nodes_.transfer(nodes);
    findWalls(front_);
}


void Foam::elementMesh::findWalls(const labelList& nodeOfPoint)
{
    walls_.resize(mesh_.boundary().size());
    forAll(walls_, patchi)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        DynamicList<label> nodes, start, cells;
        start.append(0);
        forAll(patch, i)
        {
            const face& f = patch[i];
            const label first = nodes.size();
            const vector n(f.areaNormal(mesh_.points()));
            if (kind_ == kind::solid)
            {
                nodes.append(f);
            }
            else if (mag(n.z()) <= 0.5*mag(n) && !isA<wedgePolyPatch>(patch))
            {
                for (const label pointi : f)
                {
                    if (nodeOfPoint[pointi] >= 0)
                    {
                        nodes.append(nodeOfPoint[pointi]);
                    }
                }
                if (nodes.size() == first + 2)
                {
                    label& a = nodes[first];
                    label& b = nodes[first + 1];
                    const vector t
                    (
                        mesh_.points()[front_[b]] - mesh_.points()[front_[a]]
                    );
                    if (n.x()*t.y() - n.y()*t.x() < 0)
                    {
                        Swap(a, b);
                    }
                }
                else
                {
                    // On the axis of a body of revolution
                    nodes.resize(first);
                }
            }
            if (nodes.size() > first)
            {
                start.append(nodes.size());
                cells.append(patch.faceCells()[i]);
            }
        }
        walls_[patchi].start = start;
        walls_[patchi].nodes = nodes;
        walls_[patchi].cells = cells;
    }
}


void Foam::elementMesh::findOwned()
{
    owned_.resize(size(), true);
    if (!Pstream::parRun())
    {
        return;
    }
    labelList first(size(), Pstream::myProcNo());
    scalarField count(size(), 1);
    syncTools::syncPointList(mesh_, front_, first, minEqOp<label>(), labelMax);
    syncTools::syncPointList
    (
        mesh_, front_, count, plusEqOp<scalar>(), scalar(0)
    );
    DynamicList<label> shared, points;
    forAll(first, node)
    {
        owned_.set(node, first[node] == Pstream::myProcNo());
        if (count[node] > 1.5)
        {
            shared.append(node);
            points.append(front_[node]);
        }
    }
    shared_.transfer(shared);
    sharedPoints_.transfer(points);
}


void Foam::elementMesh::findFits()
{
    const bool quads = dim() == 2 && corners_ == 4;
    if (quads)
    {
        pattern_.resize(4*mesh_.nCells());
    }
    else
    {
        fit_.resize(dim()*(1 + dim())*mesh_.nCells(), Zero);
    }

    each([&](const auto& e)
    {
        constexpr label dim = std::decay<decltype(e)>::type::dim;
        const auto x = [&](const label a, const label k)
        {
            return points_[dim*e.nodes[a] + k];
        };
        if (quads)
        {
            // The combination of the nodes that vanishes for linear functions:
            // areas of the triangles of the other three nodes, with signs
            scalar* pattern = pattern_.data() + 4*e.cell;
            scalar square = 0;
            for (label a = 0; a < 4; ++a)
            {
                const label i = (a + 1) % 4, j = (a + 2) % 4, k = (a + 3) % 4;
                pattern[a] =
                    (a % 2 ? -1 : 1)
                   *(
                        (x(j, 0) - x(i, 0))*(x(k, 1) - x(i, 1))
                      - (x(k, 0) - x(i, 0))*(x(j, 1) - x(i, 1))
                    );
                square += sqr(pattern[a]);
            }
            for (label a = 0; a < 4; ++a)
            {
                pattern[a] /= std::sqrt(square);
            }
            return;
        }
        scalar* fit = fit_.data() + (dim + dim*dim)*e.cell;
        tensor M(Zero);
        for (label a = 0; a < e.size(); ++a)
        {
            for (label k = 0; k < dim; ++k)
            {
                fit[k] += x(a, k)/e.size();
            }
        }
        for (label a = 0; a < e.size(); ++a)
        {
            for (label i = 0; i < dim; ++i)
            {
                for (label j = 0; j < dim; ++j)
                {
                    M(i, j) += (x(a, i) - fit[i])*(x(a, j) - fit[j]);
                }
            }
        }
        if (dim == 2)
        {
            M.zz() = tr(M);
        }
        const tensor inverse(inv(M));
        for (label i = 0; i < dim; ++i)
        {
            for (label j = 0; j < dim; ++j)
            {
                fit[dim + dim*i + j] = inverse(i, j);
            }
        }
    });
}


// ************************************************************************* //
