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

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalarField Foam::wallConstraints::positions(const scalar time) const
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
        holding_->each(patchi, [&](label, const label i, const scalar share)
        {
            holding_->add(i, share*holding_->along(i, p.cdata()), sum);
        });
        for (const label node : mesh_.wall(patchi).nodes)
        {
            for (label k = 0; w.fixes() && k < dim; ++k)
            {
                sum[dim*node + k] += p[k]/fixing_[node];
            }
        }
    }
    return moving ? mean(sum) : sum;
}


Foam::scalarField Foam::wallConstraints::mean(scalarField& sum) const
{
    const label dim = mesh_.dim();
    scalarField result(sum.size(), Zero);
    mesh_.sum(sum);
    forAll(constrainedNodes_, i)
    {
        const label node = constrainedNodes_[i];
        for (label k = 0; k < allDirections_[i]; ++k)
        {
            const scalar* e = allBasis_.cdata() + dim*dim*i + dim*k;
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


Foam::scalarField Foam::wallConstraints::way
(
    const scalar time,
    const scalarField& u
) const
{
    return alongWalls(scalarField(positions(time) - u));
}


void Foam::wallConstraints::addPressure
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


void Foam::wallConditions::addStick
(
    const scalarField& d,
    scalarField& force
) const
{
    const label dim = mesh_.dim();
    forEachTangentialStiffness([&](const label node, const scalar* t, const scalar k)
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
