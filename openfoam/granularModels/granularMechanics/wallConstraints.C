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

#include "wallConstraints.H"
#include "granularProperties.H"
#include "emptyPolyPatch.H"
#include "wedgePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "processorPolyPatch.H"
#include "patchDistMethod.H"
#include "nodeDyads.H"

#include <cmath>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::wallConstraints::across
Foam::wallConstraints::findAcross
(
    const smoothWalls& walls,
    const bool fixed
) const
{
    const label dim = mesh_.dim(), size = mesh_.size();
    nodeDyads directions(mesh_);

    // A plane of symmetry is no part of the wall that meets its image there
    const smoothWalls planes
    (
        mesh_,
        chosen([](const wall& w) { return w.type == kind::symmetry; })
    );
    for (const smoothWalls* each : {&walls, &planes})
    {
        for (label i = 0; i < each->size(); ++i)
        {
            directions.add(each->node(i), each->normal(i), 1);
        }
    }
    // The axis of a body of revolution stays where it is
    const label r = mesh_.radial();
    const scalar tiny = r < 0 ? 0 : 1e-9*max(mesh_.points());
    for (label node = 0; node < size; ++node)
    {
        for (label k = 0; k < dim; ++k)
        {
            const scalar axis[3] = {scalar(k == 0), scalar(k == 1), scalar(k == 2)};
            const bool onAxis = k == r && mesh_.points()[2*node + r] < tiny;
            directions.add
            (
                node, axis, (fixed && fixing_[node] > 0) + onAxis
            );
        }
    }

    DynamicList<label> nodes, counts;
    DynamicList<scalar> basis, squares;
    scalarField vectors, values;
    for (label node = 0; node < size; ++node)
    {
        const label count = directions.axes(node, vectors, values);
        if (count)
        {
            nodes.append(node);
            counts.append(count);
            basis.append(vectors);
            squares.append(values);
        }
    }
    return
    {
        labelList(nodes), labelList(counts), scalarField(basis),
        scalarField(squares)
    };
}


void Foam::wallConstraints::findHeld()
{
    fixing_.resize(mesh_.size(), Zero);
    forAll(walls_, patchi)
    {
        for (const label node : mesh_.wall(patchi).nodes)
        {
            fixing_[node] += walls_[patchi].fixes();
        }
    }
    mesh_.sum(fixing_, 1);
    holding_.reset
    (
        new smoothWalls
        (
            mesh_, chosen([](const wall& w) { return w.holdsAcross(); })
        )
    );
    across held(findAcross(holding_()));
    constrainedNodes_.transfer(held.nodes);
    allDirections_.transfer(held.directions);
    allBasis_.transfer(held.basis);
    squares_.transfer(held.squares);
    findPushing();
    holdOthers();

    scalarField pressed(mesh_.size(), Zero);
    forAll(walls_, patchi)
    {
        if (walls_[patchi].presses())
        {
            for (const label node : mesh_.wall(patchi).nodes)
            {
                pressed[node] = 1;
            }
        }
    }
    mesh_.sum(pressed, 1);
    forAll(balanced_, node)
    {
        balanced_[node] = pressed[node] > 0 ? 0 : 1;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallConstraints::removeConstrained(scalarField& values) const
{
    const label dim = mesh_.dim();
    forAll(constrainedNodes_, i)
    {
        scalar* v = values.data() + dim*constrainedNodes_[i];
        for (label k = 0; k < directions_[i]; ++k)
        {
            const scalar* e = basis_.cdata() + dim*dim*i + dim*k;
            scalar along = 0;
            for (label j = 0; j < dim; ++j)
            {
                along += e[j]*v[j];
            }
            for (label j = 0; j < dim; ++j)
            {
                v[j] = directions_[i] == dim ? 0 : v[j] - along*e[j];
            }
        }
    }
}


void Foam::wallConstraints::project(scalarField& values) const
{
    removeConstrained(values);
    tie(values);
}


void Foam::wallConstraints::keepConstrained(scalarField& values) const
{
    scalarField free(values);
    removeConstrained(free);
    values -= free;
}


// ************************************************************************* //
