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

void Foam::wallConditions::sumRubbing
(
    scalarField& values,
    const label each
) const
{
    if (!Pstream::parRun())
    {
        return;
    }
    for (label on = 0; on < sides; ++on)
    {
        if (!rough_[on])
        {
            continue;
        }
        scalarField all(each*mesh_.size(), Zero);
        const label begin = firstRubbing_[on], end = firstRubbing_[on + 1];
        for (label i = begin; i < end; ++i)
        {
            for (label k = 0; k < each; ++k)
            {
                all[each*slipNodes_[i] + k] = values[each*i + k];
            }
        }
        mesh_.sum(all, each);
        for (label i = begin; i < end; ++i)
        {
            for (label k = 0; k < each; ++k)
            {
                values[each*i + k] = all[each*slipNodes_[i] + k];
            }
        }
    }
}


void Foam::wallConditions::findLimits
(
    const List<scalarField>& stress,
    const scalarField& at
)
{
    const label dim = mesh_.dim();
    limit_ = 0;
    length_ = 0;
    pressed_.clear();
    contacts_.clear();
    bool any = false;
    scalarField weights;

    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.friction <= 0)
        {
            continue;
        }
        any = true;
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        for (label i = 0; i < faces.size(); ++i)
        {
            const scalar* n = normals_[patchi].cdata() + dim*i;
            const label celli = faces.cells[i];
            scalar s[6];
            for (label k = 0; k < 3*(dim - 1); ++k)
            {
                s[k] = stress[k][celli];
            }
            const scalar normal = pressureAcross(n, s);
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            const label* nodes = faces.nodes.cdata() + start;
            weights.resize(max(weights.size(), 3*count));
            mesh_.faceWeights(at, nodes, count, weights.data());
            for (label a = 0; a < count; ++a)
            {
                const label index = rubs_[label(w.on())][nodes[a]];
                if (index < 0 || leftAcross(nodes[a], n))
                {
                    continue;
                }
                const scalar part = mag(component(weights, a, n));
                length_[index] += part;
                if (normal > 0)
                {
                    limit_[index] += w.friction*normal*part;
                    contacts_.append({index, w.friction*part});
                }
            }
            if (normal > 0)
            {
                pressed_.append
                (
                    {
                        celli, contacts_.size(),
                        {n[0], n[1], dim == 3 ? n[2] : 0}
                    }
                );
            }
        }
    }
    if (any)
    {
        sumRubbing(limit_, 1);
        sumRubbing(length_, 1);
    }
}


void Foam::wallConditions::keepLimits
(
    const List<scalarField>& stress,
    const scalarField& at
)
{
    findLimits(stress, at);
    forAll(lastLimit_, i)
    {
        lastLimit_[i] = limit_[i]/max(length_[i], VSMALL);
    }
}


Foam::scalar Foam::wallConditions::toShare(const label i, bool& falls) const
{
    const scalar now = limit_[i]/length_[i];
    falls = now < lastLimit_[i];
    return -1/max(now, lastLimit_[i]);
}


void Foam::wallConditions::rubOneWay
(
    const label i,
    const scalarField& slip,
    const scalarField& oldTraction,
    scalar* share
)
{
    const label dim = mesh_.dim();
    const scalar* t = tangents_.cdata() + dim*(dim - 1)*i;
    bool falls;
    const scalar before = toShare(i, falls)*component(oldTraction, i, t);
    const coulombFriction::line m
    (
        coulombFriction::along(before, component(slip, i, t), slip_[i])
    );
    const scalar grip =
        (!falls && mag(before) < coulombFriction::all ? m.memory*before : 0)
      - m.share;
    for (label k = 0; k < dim; ++k)
    {
        share[k] = m.share*t[k];
        normalCoupling_[dim*i + k] = grip*t[k];
    }
    stiffness_[(dim - 1)*i] = m.slope*limit_[i]/slip_[i];
}


void Foam::wallConditions::rubTwoWays
(
    const label i,
    const scalarField& slip,
    const scalarField& oldTraction,
    scalar* share
)
{
    const label node = slipNodes_[i];
    const scalar* t = tangents_.cdata() + 6*i;
    const vector a(t[0], t[1], t[2]), b(t[3], t[4], t[5]);
    const auto within = [&](const scalarField& values)
    {
        return component(values, i, t)*a + component(values, i, t + 3)*b;
    };
    bool falls;
    const vector before(toShare(i, falls)*within(oldTraction));
    const coulombFriction::plane m
    (
        coulombFriction::along(before, within(slip), slip_[i])
    );
    const scalar initial = limit_[i]/slip_[i];
    const vector ahead(mag(m.ahead) > 0 ? m.ahead : a);
    const vector beside((ahead & a)*b - (ahead & b)*a);
    for (label k = 0; k < 3; ++k)
    {
        share[k] = m.share[k];
        normalCoupling_[3*i + k] = (falls ? 0 : m.memory[k]) - m.share[k];
        principal_[6*i + k] = ahead[k];
        principal_[6*i + 3 + k] = beside[k];
    }
    stiffness_[2*i] = m.slope*initial;
    stiffness_[2*i + 1] = m.turn*initial;
    if (mag(m.back) > 0 && mesh_.owned().test(node))
    {
        returns_.append({node, initial*ahead, m.back});
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallConditions::friction
(
    const List<scalarField>& stress,
    const scalarField& at,
    const scalarField& motion,
    const scalarField& slide,
    const scalarField& oldTraction,
    scalarField& force,
    scalarField& traction
)
{
    findLimits(stress, at);
    force = 0;
    traction = 0;
    principal_ = tangents_;
    stiffness_ = 0;
    returns_.clear();
    normalCoupling_ = 0;
    const label dim = mesh_.dim();
    scalarField slip(dim*slipNodes_.size());

    forAll(slipNodes_, i)
    {
        if (limit_[i] <= VSMALL)
        {
            continue;
        }
        for (label k = dim*i; k < dim*(i + 1); ++k)
        {
            slip[k] = motion[dim*slipNodes_[i] + k % dim] - slide[k];
        }
        scalar share[3];
        if (nTangents_[i] == 1)
        {
            rubOneWay(i, slip, oldTraction, share);
        }
        else
        {
            rubTwoWays(i, slip, oldTraction, share);
        }
        for (label k = 0; k < dim; ++k)
        {
            const scalar f = -share[k]*limit_[i];
            force[dim*slipNodes_[i] + k] += f;
            traction[dim*i + k] = f/length_[i];
        }
    }
}


Foam::scalarField Foam::wallConditions::carried
(
    const List<scalarField>& stress,
    const vector& gravity,
    const scalar share
)
{
    findLimits(stress, mesh_.points());
    const label dim = mesh_.dim();
    const vector up(-gravity/mag(gravity));
    scalarField result(dim*slipNodes_.size(), Zero);
    forAll(slipNodes_, i)
    {
        const scalar most =
            length_[i] > 0
          ? coulombFriction::all*share*limit_[i]/length_[i]
          : 0;
        for (label way = (dim - 1)*i; way < (dim - 1)*i + nTangents_[i]; ++way)
        {
            scalar along = 0;
            for (label k = 0; k < dim; ++k)
            {
                along += tangents_[dim*way + k]*up[k];
            }
            for (label k = 0; k < dim; ++k)
            {
                result[dim*i + k] += most*along*tangents_[dim*way + k];
            }
        }
    }
    return result;
}


void Foam::wallConditions::setStiffness(const scalar pressure)
{
    const label dim = mesh_.dim();
    principal_ = tangents_;
    stiffness_ = 0;
    scalarField weights;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        for (label i = 0; i < faces.size() && w.friction > 0; ++i)
        {
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            const label* nodes = faces.nodes.cdata() + start;
            weights.resize(max(weights.size(), 3*count));
            mesh_.faceWeights(mesh_.points(), nodes, count, weights.data());
            for (label a = 0; a < count; ++a)
            {
                scalar square = 0;
                for (label k = 0; k < dim; ++k)
                {
                    square += sqr(weights[dim*a + k]);
                }
                const label index = rubs_[label(w.on())][nodes[a]];
                for (label j = 0; index >= 0 && j < nTangents_[index]; ++j)
                {
                    stiffness_[(dim - 1)*index + j] +=
                        w.friction*pressure/w.slip*std::sqrt(square);
                }
            }
        }
    }
    sumRubbing(stiffness_, dim - 1);
}


// ************************************************************************* //
