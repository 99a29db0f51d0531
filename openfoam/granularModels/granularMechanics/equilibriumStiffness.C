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

#include "equilibrium.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularMechanicsModels::equilibrium::findStiffness
(
    const label caution,
    const scalar leastShare
)
{
    if (!hasTangent_)
    {
        law_->addTangent();
        hasTangent_ = true;
    }
    coupled_ = !caution && !law_->elastic();
    law_->stiffen(caution, leastShare);
}


void Foam::granularMechanicsModels::equilibrium::findTangent()
{
    law_->findTangent();
    hasTangent_ = true;
}


void Foam::granularMechanicsModels::equilibrium::setSolver()
{
    const scalar lambda = law_->lambda(), G = law_->shear();
    const label r = nodes_.radial();
    walls_.setStiffness(law_->usualPressure());

    nodeField uniform(u_.size(), Zero);
    nodes_.each([&](const auto& e)
    {
        constexpr label dim = std::decay<decltype(e)>::type::dim;
        const scalar V = reference_.volume[e.cell];
        const scalar s =
            stabilisation*G*nodes_.stabilisationScale(e.cell, reference_);
        for (label a = 0; a < e.size(); ++a)
        {
            const scalar* B = reference_.gradient.cdata() + dim*(e.start + a);
            scalar square = 0;
            for (label k = 0; k < dim; ++k)
            {
                square += sqr(B[k]);
            }
            for (label k = 0; k < dim; ++k)
            {
                uniform[dim*e.nodes[a] + k] +=
                    V*(G*square + (lambda + G)*sqr(B[k]))
                  + s*nodes_.stabilisation(e, a, a);
            }
            if (r >= 0)
            {
                const scalar h = reference_.hoop[e.start + a];
                uniform[dim*e.nodes[a] + r] +=
                    V*((lambda + 2*G)*h*h + 2*lambda*h*B[r]);
            }
        }
    });
    nodes_.sum(uniform);
    walls_.forEachTangentialStiffness([&](const label node, const scalar* t, const scalar k)
    {
        for (label j = 0; j < nodes_.dim(); ++j)
        {
            uniform[nodes_.dim()*node + j] += k*sqr(t[j]);
        }
    });
    diagonal_ = uniform;
    solver_.reset
    (
        new equilibriumSolver
        (
            nodes_, walls_, law_(), reference_, stabilisation, uniform,
            [this](const nodeField& d, nodeField& f) { multiply(d, f); }
        )
    );
}


// ************************************************************************* //
