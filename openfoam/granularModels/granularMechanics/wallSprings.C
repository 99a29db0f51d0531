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
#include "nodeDyads.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConditions::findSprings
(
    DynamicList<label>& supports,
    DynamicList<scalar>& normal,
    DynamicList<scalar>& support
)
{
    // A node in a corner has a direction for each wall
    const label dim = mesh_.dim();
    springs_.reset
    (
        new smoothWalls
        (
            mesh_, chosen([](const wall& w) { return w.springs(); })
        )
    );
    nodeDyads stiffness(mesh_);
    forAll(walls_, patchi)
    {
        const scalar k = walls_[patchi].stiffness;
        springs_->each(patchi, [&](label, const label i, const scalar share)
        {
            stiffness.add
            (
                springs_->node(i), springs_->normal(i), k*share*springs_->area(i)
            );
        });
    }
    stiffness.sum();

    scalarField vectors, values;
    for (label node = 0; node < mesh_.size(); ++node)
    {
        const label count = stiffness.axes(node, vectors, values);
        for (label k = 0; k < count; ++k)
        {
            supports.append(node);
            support.append(values[k]);
            for (label j = 0; j < dim; ++j)
            {
                normal.append(vectors[dim*k + j]);
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
    scalarField moved(force.size(), Zero);
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
        springs_->each(patchi, [&](label, const label i, const scalar share)
        {
            const scalar along = springs_->along(i, p.cdata());
            springs_->add(i, w.stiffness*share*springs_->area(i)*along, moved);
        });
    }
    if (moving)
    {
        mesh_.sum(moved);
        force += moved;
    }
}


// ************************************************************************* //
