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

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::List<Foam::vector2D>
Foam::wallConditions::positions(const scalar time) const
{
    List<vector2D> sum(mesh_.size(), vector2D(Zero)), count(sum);

    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.type == kind::none || w.type == kind::pressure)
        {
            continue;
        }
        const vector p
        (
            w.displacement.valid() ? w.displacement().value(time) : vector(Zero)
        );
        for (const quadMesh::edgeOfWall& e : mesh_.wall(patchi))
        {
            for (const label node : {e.first, e.second})
            {
                for (label k = 0; k < 2; ++k)
                {
                    // At a corner, a component that one wall holds follows that
                    // wall; a wall that only rubs along it has no weight
                    const bool holds =
                        k == w.axis || w.type == kind::displacement;
                    const scalar weight = holds ? 1 : 1e-9;
                    sum[node][k] += weight*p[k];
                    count[node][k] += weight;
                }
            }
        }
    }
    mesh_.sum(sum);
    mesh_.sum(count);
    forAll(sum, i)
    {
        for (label k = 0; k < 2; ++k)
        {
            sum[i][k] /= max(count[i][k], VSMALL);
        }
    }
    return sum;
}


Foam::List<Foam::vector2D> Foam::wallConditions::way
(
    const scalar time,
    const List<vector2D>& u
) const
{
    List<vector2D> result(positions(time));
    forAll(result, i)
    {
        for (label k = 0; k < 2; ++k)
        {
            result[i][k] = (1 - free_[i][k])*(result[i][k] - u[i][k]);
        }
    }
    return result;
}


Foam::List<Foam::vector2D> Foam::wallConditions::slide
(
    const scalar before,
    const scalar time
) const
{
    List<vector2D> result(mesh_.size(), vector2D(Zero));
    bool moving = false;
    forAll(walls_, patchi)
    {
        moving = moving || walls_[patchi].displacement.valid();
    }
    if (moving)
    {
        result = positions(time);
        const List<vector2D> start(positions(before));
        forAll(result, i)
        {
            result[i] -= start[i];
        }
    }
    return result;
}


void Foam::wallConditions::addPressure
(
    const scalar time,
    const List<vector2D>& at,
    List<vector2D>& force
) const
{
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.type != kind::pressure)
        {
            continue;
        }
        const scalar p = w.pressure().value(time);
        for (const quadMesh::edgeOfWall& e : mesh_.wall(patchi))
        {
            const vector2D t(at[e.second] - at[e.first]);
            // The pressure acts on the grains, against the outward normal
            vector2D n(t.y(), -t.x());
            n *= n[w.axis]*w.outwards < 0 ? -1 : 1;
            force[e.first] -= 0.5*p*n;
            force[e.second] -= 0.5*p*n;
        }
    }
}


void Foam::wallConditions::findLimits
(
    const granularState::stressColumns& stress,
    const List<vector2D>& at
)
{
    limit_ = List<vector2D>(mesh_.size(), vector2D(Zero));
    length_ = limit_;
    contacts_.clear();

    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.friction <= 0)
        {
            continue;
        }
        const label t = 1 - w.axis;
        for (const quadMesh::edgeOfWall& e : mesh_.wall(patchi))
        {
            const scalar normal =
                w.axis == 0 ? -stress.xx[e.cell] : -stress.yy[e.cell];
            const scalar half = 0.5*mag(at[e.second][t] - at[e.first][t]);
            for (const label node : {e.first, e.second})
            {
                length_[node][t] += half;
                if (normal > 0)
                {
                    limit_[node][t] += w.friction*normal*half;
                    contacts_.append({node, e.cell, w.axis, w.friction*half});
                }
            }
        }
    }
    mesh_.sum(limit_);
    mesh_.sum(length_);
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


void Foam::wallConditions::friction
(
    const granularState::stressColumns& stress,
    const List<vector2D>& at,
    const List<vector2D>& slip,
    const List<vector2D>& oldTraction,
    List<vector2D>& force,
    List<vector2D>& traction,
    List<vector2D>& stiffness
)
{
    findLimits(stress, at);
    force = List<vector2D>(mesh_.size(), vector2D(Zero));
    traction = force;
    stiffness = force;
    grip_ = force;

    forAll(force, i)
    {
        for (label t = 0; t < 2; ++t)
        {
            const scalar most = limit_[i][t];
            if (free_[i][t] == 0 || most <= VSMALL)
            {
                continue;
            }
            scalar slope, memory;
            const scalar before = -oldTraction[i][t]*length_[i][t]/most;
            const scalar m =
                mobilised(before, slip[i][t], slip_[i][t], slope, memory);
            force[i][t] = -m*most;
            traction[i][t] = -m*most/length_[i][t];
            stiffness[i][t] = slope*most/slip_[i][t];
            grip_[i][t] = (mag(before) < 0.999 ? memory*before : 0) - m;
        }
    }
}


void Foam::wallConditions::addGrip
(
    const scalarField& xx,
    const scalarField& yy,
    List<vector2D>& force
) const
{
    for (const contact& c : contacts_)
    {
        const scalar normal = c.axis == 0 ? -xx[c.cell] : -yy[c.cell];
        force[c.node][1 - c.axis] +=
            grip_[c.node][1 - c.axis]*c.share*normal;
    }
}


Foam::List<Foam::vector2D>
Foam::wallConditions::stiffness(const scalar pressure) const
{
    List<vector2D> result(mesh_.size(), vector2D(Zero));
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        const label t = 1 - w.axis;
        for (const quadMesh::edgeOfWall& e : mesh_.wall(patchi))
        {
            const scalar half =
                0.5*mag(mesh_.points()[e.second] - mesh_.points()[e.first]);
            for (const label node : {e.first, e.second})
            {
                result[node][t] +=
                    free_[node][t]*w.friction*pressure*half/w.slip;
            }
        }
    }
    return result;
}


// ************************************************************************* //
