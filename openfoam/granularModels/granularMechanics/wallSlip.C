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
#include "coulombFriction.H"

#include <cmath>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConditions::findRubbing
(
    const side on,
    DynamicList<label>& rubbing,
    DynamicList<label>& ways,
    DynamicList<scalar>& along,
    DynamicList<scalar>& half,
    DynamicList<scalar>& number
)
{
    const label dim = mesh_.dim(), size = mesh_.size();
    scalarField slip(size, Zero), count(size, Zero);
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.friction > 0 && w.on() == on)
        {
            for (const label node : mesh_.wall(patchi).nodes)
            {
                slip[node] += w.slip;
                count[node] += 1;
            }
        }
    }
    mesh_.sum(slip, 1);
    mesh_.sum(count, 1);
    const across beside
    (
        findAcross
        (
            smoothWalls
            (
                mesh_,
                chosen
                (
                    [on](const wall& w)
                    {
                        const bool own = w.friction > 0 && w.on() == on;
                        return w.holdsAcross() || w.springs() || own;
                    }
                )
            )
        )
    );
    forAll(beside.nodes, i)
    {
        const label node = beside.nodes[i], held = beside.directions[i];
        if (!(count[node] > 0 && held < dim))
        {
            continue;
        }
        rubs_[label(on)][node] = rubbing.size();
        rubbing.append(node);
        ways.append(dim - held);
        for (label k = held; k < held + dim - 1; ++k)
        {
            for (label j = 0; j < dim; ++j)
            {
                along.append(k < dim ? beside.basis[dim*(dim*i + k) + j] : 0);
            }
        }
        half.append(slip[node]/count[node]);
        number.append(count[node]);
    }
}


void Foam::wallConditions::findRubbing()
{
    const label dim = mesh_.dim();
    DynamicList<label> rubbing, ways;
    DynamicList<scalar> along, half, number;
    for (const side on : {side::held, side::shell, side::piston})
    {
        const label k = label(on);
        firstRubbing_[k] = rubbing.size();
        rubs_[k] = labelList(mesh_.size(), -1);
        rough_[k] = false;
        for (const wall& w : walls_)
        {
            rough_[k] = rough_[k] || (w.friction > 0 && w.on() == on);
        }
        if (rough_[k])
        {
            findRubbing(on, rubbing, ways, along, half, number);
        }
    }
    firstRubbing_[sides] = rubbing.size();
    slipNodes_ = rubbing;
    nTangents_ = ways;
    tangents_ = scalarField(along);
    slip_ = scalarField(half);
    faces_ = scalarField(number);
    limit_.resize(slipNodes_.size(), Zero);
    length_ = limit_;
    lastLimit_ = limit_;
    principal_ = tangents_;
    stiffness_.resize((dim - 1)*slipNodes_.size(), Zero);
    normalCoupling_.resize(dim*slipNodes_.size(), Zero);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallConditions::toNodes
(
    const side on,
    const scalarField& rubbing,
    scalarField& nodes
) const
{
    const label dim = mesh_.dim(), k = label(on);
    nodes.resize(dim*mesh_.size());
    nodes = 0;
    for (label i = firstRubbing_[k]; i < firstRubbing_[k + 1]; ++i)
    {
        for (label j = 0; j < dim; ++j)
        {
            nodes[dim*slipNodes_[i] + j] = rubbing[dim*i + j];
        }
    }
}


void Foam::wallConditions::fromNodes
(
    const side on,
    const scalarField& nodes,
    scalarField& rubbing
) const
{
    const label dim = mesh_.dim(), k = label(on);
    for (label i = firstRubbing_[k]; i < firstRubbing_[k + 1]; ++i)
    {
        for (label j = 0; j < dim; ++j)
        {
            rubbing[dim*i + j] = nodes[dim*slipNodes_[i] + j];
        }
    }
}


Foam::scalarField Foam::wallConditions::meanAlong
(
    std::function<bool(const wall&)> choose,
    std::function<vector(const label, const label)> motion
) const
{
    const label dim = mesh_.dim();
    scalarField result(dim*slipNodes_.size(), Zero);
    scalarField sum((dim - 1)*slipNodes_.size(), Zero);
    bool moving = false;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (!(w.friction > 0 && choose(w)))
        {
            continue;
        }
        moving = true;
        const labelList& nodes = mesh_.wall(patchi).nodes;
        forAll(nodes, at)
        {
            const label i = rubs_[label(w.on())][nodes[at]];
            const vector d(i < 0 ? vector(Zero) : motion(patchi, at));
            for (label j = 0; i >= 0 && j < nTangents_[i]; ++j)
            {
                const label way = (dim - 1)*i + j;
                for (label k = 0; k < dim; ++k)
                {
                    sum[way] += tangents_[dim*way + k]*d[k];
                }
            }
        }
    }
    if (moving)
    {
        sumRubbing(sum, dim - 1);
        forAll(slipNodes_, i)
        {
            for (label way = (dim - 1)*i; way < (dim - 1)*i + nTangents_[i]; ++way)
            {
                for (label k = 0; k < dim; ++k)
                {
                    result[dim*i + k] +=
                        sum[way]/faces_[i]*tangents_[dim*way + k];
                }
            }
        }
    }
    return result;
}


Foam::scalarField Foam::wallConditions::slide
(
    const scalar before,
    const scalar time
) const
{
    vectorField motions(walls_.size(), Zero);
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.friction > 0 && w.displacement.valid())
        {
            motions[patchi] =
                w.displacement().value(time) - w.displacement().value(before);
        }
    }
    return meanAlong
    (
        [](const wall& w) { return w.displacement.valid(); },
        [&](const label patchi, const label) { return motions[patchi]; }
    );
}


// ************************************************************************* //
