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
#include "granularProperties.H"

#include <cmath>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConditions::readShell(const dictionary& dict, wall& w) const
{
    const auto positive = [&](const word& key)
    {
        return granularProperties::ranged
        (
            dict, key, dict.get<scalar>(key), SMALL, GREAT
        );
    };
    const scalar radius = positive("radius");
    w.stiffness = positive("youngModulus")*positive("thickness")/sqr(radius);

    // A wall that grows by half of its size is no shell
    const scalar expansion =
        granularProperties::ranged(dict, "thermalExpansion", 0, 0, 1e-2);
    w.growth = expansion*radius;
    if (expansion > 0)
    {
        w.temperature = dict.get<scalar>("temperature");
    }
}


void Foam::wallConditions::findSupports()
{
    // A node has one normal for each shell, so that a shell of plane faces does
    // not resist when it turns about its axis
    const label dim = mesh_.dim();
    DynamicList<label> supports;
    DynamicList<scalar> normal, support;
    scalarField weights;
    forAll(walls_, patchi)
    {
        wall& w = walls_[patchi];
        if (w.type != kind::shell)
        {
            continue;
        }
        scalarField area(dim*mesh_.size(), Zero);
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        for (label i = 0; i < faces.size(); ++i)
        {
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            const label* nodes = faces.nodes.cdata() + start;
            weights.resize(max(weights.size(), 3*count));
            mesh_.faceWeights(mesh_.points(), nodes, count, weights.data());
            for (label a = 0; a < count; ++a)
            {
                for (label k = 0; k < dim; ++k)
                {
                    area[dim*nodes[a] + k] += weights[dim*a + k];
                }
            }
        }
        mesh_.sum(area);
        for (label node = 0; node < mesh_.size(); ++node)
        {
            scalar square = 0;
            for (label k = 0; k < dim; ++k)
            {
                square += sqr(area[dim*node + k]);
            }
            if (!(square > 0))
            {
                continue;
            }
            const scalar size = std::sqrt(square);
            w.supports.insert(node, supports.size());
            supports.append(node);
            support.append(w.stiffness*size);
            for (label k = 0; k < dim; ++k)
            {
                normal.append(area[dim*node + k]/size);
            }
        }
    }
    firstSpring_ = supports.size();
    findSprings(supports, normal, support);
    supports_ = supports;
    normal_ = scalarField(normal);
    support_ = scalarField(support);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalarField Foam::wallConditions::borneByShells
(
    const scalarField& force
) const
{
    const label dim = mesh_.dim();
    scalarField rest(force);
    forAll(supports_, i)
    {
        const scalar* n = normal_.cdata() + dim*i;
        scalar* f = rest.data() + dim*supports_[i];
        scalar along = 0;
        for (label k = 0; k < dim; ++k)
        {
            along += n[k]*f[k];
        }
        for (label k = 0; k < dim; ++k)
        {
            f[k] -= along*n[k];
        }
    }
    return force - rest;
}


void Foam::wallConditions::addShells
(
    const scalar time,
    const scalarField& u,
    scalarField& force
) const
{
    addSprings(time, u, force);
    const label dim = mesh_.dim();
    scalarField weights;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.type != kind::shell)
        {
            continue;
        }

        // Displacement of the shell if nothing pressed on it, times support_
        scalarField grown(mesh_.size(), Zero);
        if (w.growth > 0)
        {
            const scalarField& T =
                mesh_.mesh().lookupObject<volScalarField>("T")
               .boundaryField()[patchi];
            const elementMesh::wallFaces& faces = mesh_.wall(patchi);
            for (label i = 0; i < faces.size(); ++i)
            {
                const label start = faces.start[i];
                const label count = faces.start[i + 1] - start;
                const label* nodes = faces.nodes.cdata() + start;
                weights.resize(max(weights.size(), 3*count));
                mesh_.faceWeights(mesh_.points(), nodes, count, weights.data());
                for (label a = 0; a < count; ++a)
                {
                    const auto support = w.supports.cfind(nodes[a]);
                    scalar size = 0;
                    for (label k = 0; support.good() && k < dim; ++k)
                    {
                        size += weights[dim*a + k]*normal_[dim*(*support) + k];
                    }
                    grown[nodes[a]] +=
                        w.stiffness*size*w.growth*(T[i] - w.temperature);
                }
            }
            mesh_.sum(grown, 1);
        }
        forAllConstIters(w.supports, iter)
        {
            const label node = iter.key(), index = iter.val();
            const scalar* n = normal_.cdata() + dim*index;
            scalar f = grown[node];
            for (label k = 0; k < dim; ++k)
            {
                f -= support_[index]*n[k]*u[dim*node + k];
            }
            for (label k = 0; k < dim; ++k)
            {
                force[dim*node + k] += f*n[k];
            }
        }
    }
}


// ************************************************************************* //
