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

#include <cmath>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalarField Foam::wallConditions::positions(const scalar time) const
{
    const label dim = mesh_.dim();
    scalarField sum(dim*mesh_.size(), Zero);

    bool moving = false;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (!w.holds() || !w.displacement.valid())
        {
            continue;
        }
        moving = true;
        const vector p(w.displacement().value(time));
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        for (label i = 0; i < faces.size(); ++i)
        {
            const scalar* n = normals_[patchi].cdata() + dim*i;
            scalar along = 0;
            for (label k = 0; k < dim; ++k)
            {
                along += n[k]*p[k];
            }
            for (label j = faces.start[i]; j < faces.start[i + 1]; ++j)
            {
                for (label k = 0; k < dim; ++k)
                {
                    sum[dim*faces.nodes[j] + k] += w.fixes() ? p[k] : along*n[k];
                }
            }
        }
    }
    return moving ? mean(sum) : sum;
}


Foam::scalarField Foam::wallConditions::mean(scalarField& sum) const
{
    const label dim = mesh_.dim();
    scalarField result(sum.size(), Zero);
    mesh_.sum(sum);
    forAll(held_, i)
    {
        const label node = held_[i];
        for (label k = 0; k < directions_[i]; ++k)
        {
            const scalar* e = basis_.cdata() + dim*dim*i + dim*k;
            scalar along = 0;
            for (label j = 0; j < dim; ++j)
            {
                along += e[j]*sum[dim*node + j];
            }
            for (label j = 0; j < dim; ++j)
            {
                result[dim*node + j] += along/squares_[dim*i + k]*e[j];
            }
        }
    }
    return result;
}


void Foam::wallConditions::sumRubbing(scalarField& values) const
{
    if (!Pstream::parRun())
    {
        return;
    }
    scalarField all(mesh_.size(), Zero);
    forAll(rubbing_, i)
    {
        all[rubbing_[i]] = values[i];
    }
    mesh_.sum(all, 1);
    forAll(rubbing_, i)
    {
        values[i] = all[rubbing_[i]];
    }
}


Foam::scalarField Foam::wallConditions::way
(
    const scalar time,
    const scalarField& u
) const
{
    scalarField result(positions(time) - u);
    restrict(result);
    return result;
}


Foam::scalarField Foam::wallConditions::slide
(
    const scalar before,
    const scalar time
) const
{
    scalarField result(mesh_.dim()*mesh_.size(), Zero);
    scalarField motion(rubbing_.size(), Zero);
    bool moving = false;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.friction > 0 && w.displacement.valid())
        {
            moving = true;
            const vector d
            (
                w.displacement().value(time) - w.displacement().value(before)
            );
            for (const label node : mesh_.wall(patchi).nodes)
            {
                const label i = rubs_[node];
                if (i >= 0)
                {
                    motion[i] += along_[2*i]*d.x() + along_[2*i + 1]*d.y();
                }
            }
        }
    }
    if (moving)
    {
        sumRubbing(motion);
        forAll(rubbing_, i)
        {
            for (label k = 0; k < 2; ++k)
            {
                result[2*rubbing_[i] + k] =
                    motion[i]/faces_[i]*along_[2*i + k];
            }
        }
    }
    return result;
}


void Foam::wallConditions::addPressure
(
    const scalar time,
    const scalarField& at,
    scalarField& force
) const
{
    const label dim = mesh_.dim();
    scalarField weights;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (!w.presses())
        {
            continue;
        }
        // The pressure acts on the grains, against the outward normal
        const scalar p = w.pressure().value(time);
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        for (label i = 0; i < faces.size(); ++i)
        {
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            const label* nodes = faces.nodes.cdata() + start;
            weights.resize(max(weights.size(), 3*count));
            mesh_.faceWeights(at, nodes, count, weights.data());
            for (label a = 0; a < count; ++a)
            {
                for (label k = 0; k < dim; ++k)
                {
                    force[dim*nodes[a] + k] -= p*weights[dim*a + k];
                }
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
    limit_ = 0;
    length_ = 0;
    contacts_.clear();
    bool any = false;

    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.friction <= 0)
        {
            continue;
        }
        any = true;
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        scalar weights[4];
        for (label i = 0; i < faces.size(); ++i)
        {
            const scalar nx = normals_[patchi][2*i];
            const scalar ny = normals_[patchi][2*i + 1];
            const label celli = faces.cells[i];
            const scalar normal =
              - nx*nx*stress[0][celli] - ny*ny*stress[1][celli]
              - 2*nx*ny*stress[2][celli];
            const label* nodes = faces.nodes.cdata() + faces.start[i];
            mesh_.faceWeights(at, nodes, 2, weights);
            for (label a = 0; a < 2; ++a)
            {
                const label index = rubs_[nodes[a]];
                if (index < 0)
                {
                    continue;
                }
                const scalar part =
                    mag(nx*weights[2*a] + ny*weights[2*a + 1]);
                length_[index] += part;
                if (normal > 0)
                {
                    limit_[index] += w.friction*normal*part;
                    contacts_.append({index, celli, nx, ny, w.friction*part});
                }
            }
        }
    }
    if (any)
    {
        sumRubbing(limit_);
        sumRubbing(length_);
    }
}


Foam::scalar Foam::wallConditions::mobilised
(
    const scalar before,
    const scalar slip,
    const scalar half,
    scalar& slope,
    scalar& memory
)
{
    scalar m = max(scalar(-0.999), min(scalar(0.999), before));
    scalar rest = slip;
    slope = 1;
    memory = 1;
    if (m*slip < 0)
    {
        const scalar back = min(mag(slip), mag(m)*half)*sign(slip);
        m += back/half;
        rest = slip - back;
    }
    if (rest != 0 || slip == 0)
    {
        memory = rest == slip ? 1/sqr(1 - mag(m)) : 1;
        const scalar virgin = half*mag(m)/(1 - mag(m)) + mag(rest);
        const scalar direction = rest != 0 ? sign(rest) : sign(m);
        m = direction*virgin/(virgin + half);
        slope = sqr(1 - mag(m));
        memory *= slope;
    }
    return m;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallConditions::friction
(
    const List<scalarField>& stress,
    const scalarField& at,
    const scalarField& slip,
    const scalarField& oldTraction,
    scalarField& force,
    scalarField& traction
)
{
    findLimits(stress, at);
    force = 0;
    traction = 0;
    stiffness_ = 0;
    grip_ = 0;

    forAll(rubbing_, i)
    {
        const scalar most = limit_[i];
        if (most <= VSMALL)
        {
            continue;
        }
        const label node = rubbing_[i];
        const scalar tx = along_[2*i], ty = along_[2*i + 1];
        const auto along = [&](const scalarField& v)
        {
            return tx*v[2*node] + ty*v[2*node + 1];
        };
        scalar slope, memory;
        const scalar before = -along(oldTraction)*length_[i]/most;
        const scalar m = mobilised(before, along(slip), slip_[i], slope, memory);
        force[2*node] = -m*most*tx;
        force[2*node + 1] = -m*most*ty;
        traction[2*node] = force[2*node]/length_[i];
        traction[2*node + 1] = force[2*node + 1]/length_[i];
        stiffness_[i] = slope*most/slip_[i];
        grip_[i] = (mag(before) < 0.999 ? memory*before : 0) - m;
    }
}


void Foam::wallConditions::setStiffness(const scalar pressure)
{
    stiffness_ = 0;
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        scalar weights[4];
        for (label i = 0; i < faces.size() && w.friction > 0; ++i)
        {
            const label* nodes = faces.nodes.cdata() + faces.start[i];
            mesh_.faceWeights(mesh_.points(), nodes, 2, weights);
            for (label a = 0; a < 2; ++a)
            {
                if (rubs_[nodes[a]] >= 0)
                {
                    stiffness_[rubs_[nodes[a]]] +=
                        w.friction*pressure/w.slip
                       *std::hypot(weights[2*a], weights[2*a + 1]);
                }
            }
        }
    }
    sumRubbing(stiffness_);
}


void Foam::wallConditions::addStick
(
    const scalarField& d,
    scalarField& force
) const
{
    const label dim = mesh_.dim();
    eachStick([&](const label node, const scalar* t, const scalar k)
    {
        scalar along = 0;
        for (label j = 0; j < dim; ++j)
        {
            along += t[j]*d[dim*node + j];
        }
        for (label j = 0; j < dim; ++j)
        {
            force[dim*node + j] += k*along*t[j];
        }
    });
}


// ************************************************************************* //
