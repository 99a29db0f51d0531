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

#include "equilibrium.H"

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Pressure of the uniform medium for the preconditioner, divided by E r/l
static const scalar uniformPressure = 0.05;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularMechanicsModels::equilibrium::findStiffness
(
    const label caution,
    const scalar leastShare
)
{
    coupled_ = !caution && !law_->elastic();
    law_->stiffen(caution, leastShare);
}


void Foam::granularMechanicsModels::equilibrium::setSolver()
{
    const scalar lambda = law_->lambda(), G = law_->shear();
    const label r = nodes_.radial();
    walls_.setStiffness(law_->scale()*uniformPressure);

    nodeField uniform(u_.size(), Zero);
    nodes_.each([&](const auto& e)
    {
        constexpr label dim = std::decay<decltype(e)>::type::dim;
        const scalar V = reference_.volume[e.cell];
        const scalar s =
            unfitted*G*nodes_.unfittedScale(e.cell, reference_);
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
                  + s*nodes_.unfitted(e, a, a);
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
    walls_.eachStick([&](const label node, const scalar* t, const scalar k)
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
            nodes_, walls_, law_(), reference_, unfitted, uniform,
            [this](const nodeField& d, nodeField& f) { multiply(d, f); }
        )
    );
}


void Foam::granularMechanicsModels::equilibrium::findDiagonal()
{
    if (law_->elastic())
    {
        return;     // that of the preconditioner, which does not change
    }
    const granularState::tangentColumns& C = law_->tangent();
    const scalar s = unfitted*law_->shear();
    diagonal_ = 0;
    nodes_.each([&](const auto& e)
    {
        constexpr label dim = std::decay<decltype(e)>::type::dim;
        const scalar V = shapes_.volume[e.cell];
        for (label a = 0; a < e.size(); ++a)
        {
            const scalar b = shapes_.gradient[dim*(e.start + a)];
            const scalar c = shapes_.gradient[dim*(e.start + a) + 1];
            const scalar own = s*nodes_.unfitted(e, a, a);
            scalar* to = diagonal_.data() + dim*e.nodes[a];
            to[0] += V*(C[0][e.cell]*b*b + C[8][e.cell]*c*c) + own;
            to[1] += V*(C[4][e.cell]*c*c + C[8][e.cell]*b*b) + own;
        }
    });
    nodes_.sum(diagonal_);
    walls_.eachStick([&](const label node, const scalar* t, const scalar k)
    {
        diagonal_[2*node] += k*sqr(t[0]);
        diagonal_[2*node + 1] += k*sqr(t[1]);
    });
}


template<class Element, class Stress>
inline void Foam::granularMechanicsModels::equilibrium::multiply
(
    const Element& e,
    const scalar resistance,
    const Stress& stress,
    const nodeField& d,
    nodeField& result
) const
{
    constexpr label dim = Element::dim;
    const label n = e.size();
    const label r = dim == 2 && shapes_.hoop.size() ? nodes_.radial() : -1;
    const scalar* __restrict__ B = shapes_.gradient.cdata() + dim*e.start;
    const scalar* __restrict__ hoop =
        r < 0 ? nullptr : shapes_.hoop.cdata() + e.start;
    const scalar* __restrict__ from = d.cdata();
    scalar* __restrict__ to = result.data();

    scalar g[dim][dim] = {}, s[dim][dim] = {}, ring = 0;
    for (label a = 0; a < n; ++a)
    {
        for (label i = 0; i < dim; ++i)
        {
            for (label j = 0; j < dim; ++j)
            {
                g[i][j] += from[dim*e.nodes[a] + i]*B[dim*a + j];
            }
        }
        if (r >= 0)
        {
            ring += from[dim*e.nodes[a] + r]*hoop[a];
        }
    }
    stress(e.cell, g, ring, s);
    const scalar V = shapes_.volume[e.cell];
    for (label a = 0; a < n; ++a)
    {
        for (label i = 0; i < dim; ++i)
        {
            scalar f = 0;
            for (label j = 0; j < dim; ++j)
            {
                f += s[i][j]*B[dim*a + j];
            }
            to[dim*e.nodes[a] + i] += V*f;
        }
        if (r >= 0)
        {
            to[dim*e.nodes[a] + r] += V*ring*hoop[a];
        }
    }
    nodes_.addUnfitted(e, resistance, from, to);
}


void Foam::granularMechanicsModels::equilibrium::multiply
(
    const nodeField& d,
    nodeField& result
) const
{
    result.resize(d.size());
    result = 0;
    const scalar s = unfitted*law_->shear();

    if (law_->elastic())
    {
        const scalar lambda = law_->lambda(), G = law_->shear();
        nodes_.each([&](const auto& e)
        {
            constexpr label dim = std::decay<decltype(e)>::type::dim;
            multiply
            (
                e,
                s*nodes_.unfittedScale(e.cell, reference_),
                [&]
                (
                    const label,
                    const scalar (&g)[dim][dim],
                    scalar& ring,
                    scalar (&sigma)[dim][dim]
                )
                {
                    scalar volume = ring;
                    for (label i = 0; i < dim; ++i)
                    {
                        volume += g[i][i];
                    }
                    for (label i = 0; i < dim; ++i)
                    {
                        for (label j = 0; j < dim; ++j)
                        {
                            sigma[i][j] =
                                G*(g[i][j] + g[j][i])
                              + (i == j ? lambda*volume : 0);
                        }
                    }
                    ring = lambda*volume + 2*G*ring;
                },
                d,
                result
            );
        });
    }
    else
    {
        const granularState::tangentColumns& columns = law_->tangent();
        const scalar* C[9];
        for (label k = 0; k < 9; ++k)
        {
            C[k] = columns[k].cdata();
        }
        const auto strained = [&C]
        (
            const label celli,
            const scalar exx,
            const scalar eyy,
            const scalar exy
        )
        {
            FixedList<scalar, 3> sigma;
            for (label k = 0; k < 3; ++k)
            {
                sigma[k] =
                    C[3*k][celli]*exx + C[3*k + 1][celli]*eyy
                  + C[3*k + 2][celli]*exy;
            }
            return sigma;
        };
        nodes_.each([&](const auto& e)
        {
            constexpr label dim = std::decay<decltype(e)>::type::dim;
            multiply
            (
                e,
                s,
                [&]
                (
                    const label celli,
                    const scalar (&g)[dim][dim],
                    scalar&,
                    scalar (&sigma)[dim][dim]
                )
                {
                    const FixedList<scalar, 3> all
                    (
                        strained(celli, g[0][0], g[1][1], g[0][1] + g[1][0])
                    );
                    sigma[0][0] = all[0];
                    sigma[1][1] = all[1];
                    sigma[0][1] = sigma[1][0] = all[2];
                },
                d,
                result
            );
        });
        if (coupled_ && walls_.grips())
        {
            nodeField change(d.size(), Zero);
            walls_.addGrip
            (
                [&](const label celli)
                {
                    scalar xx = 0, yy = 0, xy = 0;
                    for
                    (
                        label i = nodes_.cellStarts()[celli];
                        i < nodes_.cellStarts()[celli + 1];
                        ++i
                    )
                    {
                        const scalar* v = d.cdata() + 2*nodes_.cellNodes()[i];
                        const scalar b = shapes_.gradient[2*i];
                        const scalar c = shapes_.gradient[2*i + 1];
                        xx += b*v[0];
                        yy += c*v[1];
                        xy += c*v[0] + b*v[1];
                    }
                    return strained(celli, xx, yy, xy);
                },
                change
            );
            result -= change;
        }
    }
    nodes_.sum(result);
    walls_.addStick(d, result);
    walls_.release(result);
}


// ************************************************************************* //
