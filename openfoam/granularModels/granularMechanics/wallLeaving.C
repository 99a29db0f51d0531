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

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Cosine of the angle to the normal of a wall above which a direction is that
//- of the normal
static const scalar parallel = 1 - 1e-9;

//- The same up to which a face belongs to a wall with this normal: its faces
//- differ from it by less than 45 degrees (see smoothWalls)
static const scalar about = 0.7;

//- Distance from a wall over the mean radius above which grains have left it
static const scalar apart = 1e-6;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConstraints::findPushing()
{
    const label dim = mesh_.dim();
    pushes_.resize(allBasis_.size()/dim, Zero);
    left_.resize(pushes_.size(), false);
    holds_.resize(mesh_.size(), -1);
    forAll(constrainedNodes_, i)
    {
        holds_[constrainedNodes_[i]] = i;
    }
    // Exactly one unit normal along the direction: no plane of symmetry, no
    // axis, no opposite wall
    for (label wall = 0; wall < holding_->size(); ++wall)
    {
        const label node = holding_->node(wall), i = holds_[node];
        for (label k = 0; k < allDirections_[i]; ++k)
        {
            const scalar* e = allBasis_.cdata() + dim*(dim*i + k);
            const scalar along = holding_->along(wall, e);
            const label sign = along > 0 ? 1 : -1;
            const label r = mesh_.radial();
            // The inner wall of a body of revolution carries nearly nothing
            // where it stands for the axis
            const bool inner = r >= 0 && sign*e[r] < -parallel;
            if
            (
                mag(along) > parallel && !inner
             && mag(squares_[dim*i + k] - 1) < 1e-6
            )
            {
                pushes_[dim*i + k] = sign;
            }
        }
    }
}


void Foam::wallConstraints::holdOthers()
{
    const label dim = mesh_.dim();
    directions_.resize(constrainedNodes_.size());
    basis_.resize(allBasis_.size());
    forAll(constrainedNodes_, i)
    {
        label to = 0;
        for (const bool held : {true, false})
        {
            for (label k = 0; k < dim; ++k)
            {
                const bool holds =
                    k < allDirections_[i] && !left_[dim*i + k];
                for (label j = 0; holds == held && j < dim; ++j)
                {
                    basis_[dim*(dim*i + to) + j] =
                        allBasis_[dim*(dim*i + k) + j];
                }
                to += holds == held;
            }
            directions_[i] = held ? to : directions_[i];
        }
    }
}


bool Foam::wallConstraints::leftAcross
(
    const label node,
    const scalar* normal
) const
{
    const label dim = mesh_.dim(), i = holds_[node];
    bool left = false;
    for (label k = 0; i >= 0 && k < allDirections_[i]; ++k)
    {
        const scalar* e = allBasis_.cdata() + dim*(dim*i + k);
        scalar along = 0;
        for (label j = 0; j < dim; ++j)
        {
            along += e[j]*normal[j];
        }
        left = left || (left_[dim*i + k] && mag(along) > about);
    }
    return left;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalarField Foam::wallConstraints::alongWalls(const scalarField& values) const
{
    const label dim = mesh_.dim();
    scalarField result(values.size(), Zero);
    forAll(constrainedNodes_, i)
    {
        for (label k = 0; k < allDirections_[i]; ++k)
        {
            const scalar* e = allBasis_.cdata() + dim*(dim*i + k);
            const scalar along = component(values, constrainedNodes_[i], e);
            for (label j = 0; j < dim; ++j)
            {
                result[dim*constrainedNodes_[i] + j] += along*e[j];
            }
        }
    }
    return result;
}


void Foam::wallConstraints::setLeft
(
    const scalarField& way,
    const scalar missed
)
{
    const scalar least = max(apart*radius_, missed);
    const label dim = mesh_.dim();
    forAll(pushes_, i)
    {
        const scalar* e = allBasis_.cdata() + dim*i;
        left_[i] =
            pushes_[i]
         && pushes_[i]*component(way, constrainedNodes_[i/dim], e) > least;
    }
    holdOthers();
}


Foam::label Foam::wallConstraints::leave
(
    const scalarField& way,
    const scalarField& force,
    const scalarField& least
)
{
    const label dim = mesh_.dim();
    // Processes that share a node decide the same
    scalarField changes(dim*mesh_.size(), Zero);
    forAll(pushes_, i)
    {
        const scalar* e = allBasis_.cdata() + dim*i;
        const label node = constrainedNodes_[i/dim];
        const scalar outward =
            pushes_[i]*component(left_[i] ? way : force, node, e);
        const scalar most = left_[i] ? apart*radius_ : least[node];
        changes[dim*node + i % dim] = pushes_[i] && outward < -most;
    }
    mesh_.sum(changes);
    label count = 0;
    forAll(pushes_, i)
    {
        if (changes[dim*constrainedNodes_[i/dim] + i % dim] > 0)
        {
            left_[i] = !left_[i];
            ++count;
        }
    }
    reduce(count, sumOp<label>());
    if (count)
    {
        holdOthers();
    }
    return count;
}


Foam::scalar Foam::wallConstraints::largestGap(const scalarField& way) const
{
    const label dim = mesh_.dim();
    scalar largest = 0;
    forAll(left_, i)
    {
        const scalar* e = allBasis_.cdata() + dim*i;
        const scalar gap = pushes_[i]*component(way, constrainedNodes_[i/dim], e);
        largest = left_[i] ? max(largest, gap) : largest;
    }
    return returnReduce(largest, maxOp<scalar>());
}


// ************************************************************************* //
