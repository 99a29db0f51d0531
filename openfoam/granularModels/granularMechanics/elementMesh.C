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
#include "syncTools.H"

#include <cmath>

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::elementMesh::elementMesh(const fvMesh& mesh)
:
    mesh_(mesh),
    kind_(kind::plane),
    radial_(1),
    corners_(0)
{
    findKind();
    kind_ == kind::solid ? findSolidNodes() : findPlaneNodes();

    corners_ = mesh_.nCells() ? start_[1] : 0;
    for (label celli = 0; celli < mesh_.nCells(); ++celli)
    {
        if (start_[celli + 1] - start_[celli] != corners_)
        {
            corners_ = 0;
        }
    }
    points_.resize(dim()*size());
    forAll(front_, node)
    {
        const point& p = mesh_.points()[front_[node]];
        if (kind_ == kind::axisymmetric)
        {
            points_[2*node + 1 - radial_] = p[1 - radial_];
            points_[2*node + radial_] = std::hypot(p[radial_], p.z());
        }
        else
        {
            for (label k = 0; k < dim(); ++k)
            {
                points_[dim()*node + k] = p[k];
            }
        }
    }
    findOwned();
    findFits();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::label Foam::elementMesh::planeShapes
(
    const scalarField& at,
    shapes& result
) const
{
    const label rad = radial(), ax = 1 - radial_;
    label broken = -1;

    each([&](const auto& e)
    {
        const label n = e.size();
        scalar* W = result.gradient.data() + 2*e.start;
        const auto x = [&](const label a, const label k)
        {
            return at[2*e.nodes[a] + k];
        };
        scalar area = 0;
        for (label a = 0; a < n; ++a)
        {
            const label next = a + 1 < n ? a + 1 : 0, last = a ? a - 1 : n - 1;
            W[2*a] = 0.5*(x(next, 1) - x(last, 1));
            W[2*a + 1] = 0.5*(x(last, 0) - x(next, 0));
            // Differences from the first node, whose rounding errors are small
            area += W[2*a]*(x(a, 0) - x(0, 0));
        }
        result.volume[e.cell] = area;
        scalar factor = 1/area;
        if (rad >= 0 && area > 0)
        {
            scalar* hoop = result.hoop.data() + e.start;
            for (label a = 0; a < n; ++a)
            {
                hoop[a] = 0;
            }
            // The mean radial derivative is that in the plane; the axial one
            // and the hoop strain follow from integrals with the factor r
            scalar volume = 0;
            FixedList<scalar, 2> n2;
            for (label a = 0; a < n; ++a)
            {
                W[2*a + rad] /= area;
                W[2*a + ax] = 0;
            }
            for (label a = 0; a < n; ++a)
            {
                const label b = a + 1 < n ? a + 1 : 0;
                n2[0] = x(b, 1) - x(a, 1);
                n2[1] = x(a, 0) - x(b, 0);
                const scalar ra = (2*x(a, rad) + x(b, rad))/6;
                const scalar rb = (x(a, rad) + 2*x(b, rad))/6;
                W[2*a + ax] += n2[ax]*ra;
                W[2*b + ax] += n2[ax]*rb;
                hoop[a] += n2[rad]*ra;
                hoop[b] += n2[rad]*rb;
                volume +=
                    n2[ax]
                   *(ra*(x(a, ax) - x(0, ax)) + rb*(x(b, ax) - x(0, ax)));
            }
            for (label a = 0; a < n; ++a)
            {
                W[2*a + ax] /= volume;
                hoop[a] = hoop[a]/volume - W[2*a + rad];
            }
            result.volume[e.cell] = volume;
            area = min(area, volume);
            factor = 1;
        }
        if (!(area > 0))
        {
            broken = broken < 0 ? e.cell : broken;
        }
        for (label i = 0; i < 2*n; ++i)
        {
            W[i] *= factor;
        }
    });
    return broken;
}


Foam::label Foam::elementMesh::solidShapes
(
    const scalarField& at,
    shapes& result
) const
{
    const faceList& faces = mesh_.faces();
    const labelUList& owner = mesh_.faceOwner();
    const labelUList& neighbour = mesh_.faceNeighbour();
    scalarField weights;
    result.gradient = 0;

    const auto add = [&](const label celli, const face& f, const scalar sign)
    {
        const label* nodes = nodes_.cdata() + start_[celli];
        scalar* W = result.gradient.data() + 3*start_[celli];
        forAll(f, i)
        {
            label a = 0;
            while (nodes[a] != f[i])
            {
                ++a;
            }
            for (label k = 0; k < 3; ++k)
            {
                W[3*a + k] += sign*weights[3*i + k];
            }
        }
    };
    forAll(faces, facei)
    {
        const face& f = faces[facei];
        weights.resize(max(weights.size(), 3*f.size()));
        faceWeights(at, f.cdata(), f.size(), weights.data());
        add(owner[facei], f, 1);
        if (facei < neighbour.size())
        {
            add(neighbour[facei], f, -1);
        }
    }
    label broken = -1;
    each([&](const auto& e)
    {
        scalar* W = result.gradient.data() + 3*e.start;
        const scalar* first = at.cdata() + 3*e.nodes[0];
        scalar volume = 0;
        for (label a = 1; a < e.size(); ++a)
        {
            for (label k = 0; k < 3; ++k)
            {
                volume += W[3*a + k]*(at[3*e.nodes[a] + k] - first[k])/3;
            }
        }
        result.volume[e.cell] = volume;
        if (!(volume > 0))
        {
            broken = broken < 0 ? e.cell : broken;
        }
        for (label i = 0; i < 3*e.size(); ++i)
        {
            W[i] /= volume;
        }
    });
    return broken;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::elementMesh::findShapes
(
    const scalarField& at,
    shapes& result
) const
{
    result.volume.resize(mesh_.nCells());
    result.gradient.resize(dim()*nodes_.size());
    if (kind_ == kind::axisymmetric)
    {
        result.hoop.resize(nodes_.size());
    }
    return
        kind_ == kind::solid
      ? solidShapes(at, result)
      : planeShapes(at, result);
}


void Foam::elementMesh::faceWeights
(
    const scalarField& at,
    const label* nodes,
    const label count,
    scalar* weights
) const
{
    if (kind_ != kind::solid)
    {
        const scalar* a = at.cdata() + 2*nodes[0];
        const scalar* b = at.cdata() + 2*nodes[1];
        const label r = radial();
        const scalar wa = r < 0 ? 0.5 : (2*a[r] + b[r])/6;
        const scalar wb = r < 0 ? 0.5 : (a[r] + 2*b[r])/6;
        weights[0] = wa*(b[1] - a[1]);
        weights[1] = wa*(a[0] - b[0]);
        weights[2] = wb*(b[1] - a[1]);
        weights[3] = wb*(a[0] - b[0]);
        return;
    }
    const auto x = [&](const label i)
    {
        return vector(vectorAt(at, nodes[i]));
    };
    if (count == 3)
    {
        const vector S(((x(1) - x(0)) ^ (x(2) - x(0)))/6);
        for (label i = 0; i < 9; ++i)
        {
            weights[i] = S[i % 3];
        }
        return;
    }
    vector centre(Zero), all(Zero);
    for (label i = 0; i < count; ++i)
    {
        centre += x(i)/count;
    }
    for (label i = 0; i < 3*count; ++i)
    {
        weights[i] = 0;
    }
    for (label i = 0; i < count; ++i)
    {
        const label next = i + 1 < count ? i + 1 : 0;
        const vector S(((x(i) - centre) ^ (x(next) - centre))/6);
        all += S;
        for (label k = 0; k < 3; ++k)
        {
            weights[3*i + k] += S[k];
            weights[3*next + k] += S[k];
        }
    }
    for (label i = 0; i < 3*count; ++i)
    {
        weights[i] += all[i % 3]/count;
    }
}


Foam::scalar Foam::elementMesh::stabilisationScale
(
    const label celli,
    const shapes& reference
) const
{
    if (kind_ == kind::plane)
    {
        return 1;
    }
    if (kind_ == kind::solid)
    {
        return std::cbrt(reference.volume[celli]);
    }
    scalar r = 0;
    for (label i = start_[celli]; i < start_[celli + 1]; ++i)
    {
        r += points_[2*nodes_[i] + radial_];
    }
    return r/(start_[celli + 1] - start_[celli]);
}


void Foam::elementMesh::sum(scalarField& values, const label each) const
{
    if (!Pstream::parRun())
    {
        return;
    }
    // OpenFOAM's exchange between processes handles vectors of three components
    // only (it may rotate them between periodic patches)
    List<vector> all(shared_.size(), vector(Zero));
    forAll(all, i)
    {
        for (label k = 0; k < each; ++k)
        {
            all[i][k] = values[each*shared_[i] + k];
        }
    }
    syncTools::syncPointList
    (
        mesh_, sharedPoints_, all, plusEqOp<vector>(), vector(Zero)
    );
    forAll(all, i)
    {
        for (label k = 0; k < each; ++k)
        {
            values[each*shared_[i] + k] = all[i][k];
        }
    }
}


void Foam::elementMesh::gather(List<List<vector>>& lists) const
{
    if (!Pstream::parRun())
    {
        return;
    }
    List<List<vector>> all(UIndirectList<List<vector>>(lists, shared_));
    syncTools::syncPointList
    (
        mesh_,
        sharedPoints_,
        all,
        [](List<vector>& to, const List<vector>& from) { to.append(from); },
        List<vector>(),
        mapDistribute::transform()
    );
    forAll(all, i)
    {
        lists[shared_[i]] = all[i];
    }
}


Foam::scalar Foam::elementMesh::dot
(
    const scalarField& a,
    const scalarField& b
) const
{
    scalar result = 0;
    forAll(a, i)
    {
        result += a[i]*b[i];
    }
    // Less what other processes count, too
    const label d = dim();
    for (const label node : shared_)
    {
        if (!owned_.test(node))
        {
            for (label i = d*node; i < d*(node + 1); ++i)
            {
                result -= a[i]*b[i];
            }
        }
    }
    return returnReduce(result, sumOp<scalar>());
}


Foam::vector Foam::elementMesh::vectorAt
(
    const scalarField& values,
    const label node
) const
{
    const label d = dim();
    return vector
    (
        values[d*node],
        values[d*node + 1],
        d == 3 ? values[d*node + 2] : 0
    );
}


// ************************************************************************* //
