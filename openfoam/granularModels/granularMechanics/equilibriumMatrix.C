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

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Tangent of the cells with Dim dimensions, and Ring the hoop strain of bodies
//- of revolution: the stress of a gradient, columns as in stressLaw
template<label Dim, bool Ring>
class cellTangent
{
public:

    //- Number of components
    static constexpr label count = Dim == 3 ? 6 : Ring ? 4 : 3;

    typedef scalar square[Dim][Dim];
    typedef scalar vector[count];


private:

    const scalar* columns_[count*count];


public:

    //- Of columns as many as there are entries, else of nothing
    explicit cellTangent(const granularState::tangentColumns& columns)
    :
        columns_()
    {
        for (label k = 0; columns.size() == count*count && k < count*count; ++k)
        {
            columns_[k] = columns[k].cdata();
        }
    }

    //- Entry of a cell
    scalar operator()(const label i, const label j, const label celli) const
    {
        return columns_[count*i + j][celli];
    }

    void stress
    (
        const label celli,
        const square& g,
        const scalar ring,
        vector& sigma
    ) const
    {
        vector e;
        strain(g, ring, e);
        for (label i = 0; i < count; ++i)
        {
            sigma[i] = 0;
            for (label j = 0; j < count; ++j)
            {
                sigma[i] += columns_[count*i + j][celli]*e[j];
            }
        }
    }

    //- Components of the strain of a gradient
    static void strain(const square& g, const scalar ring, vector& e)
    {
        for (label k = 0; k < Dim; ++k)
        {
            e[k] = g[k][k];
            if (Dim == 3)
            {
                const label next = (k + 1) % Dim;
                e[count/2 + k] = g[k][next] + g[next][k];
            }
        }
        if (Dim == 2)
        {
            e[2] = g[0][1] + g[1][0];
            e[count - 1] = Ring ? ring : e[2];
        }
    }

    //- The stress as a square, and that of the hoop
    static void spread(const vector& from, square& sigma, scalar& ring)
    {
        for (label k = 0; k < Dim; ++k)
        {
            const label next = (k + 1) % Dim;
            sigma[k][k] = from[k];
            sigma[k][next] = sigma[next][k] = from[Dim == 3 ? 3 + k : 2];
        }
        ring = Ring && Dim == 2 ? from[count - 1] : 0;
    }
};

//- The same for the number of dimensions that the loops over the cells know
template<bool Ring>
struct cellTangents
{
    const cellTangent<2, Ring> flat;
    const cellTangent<3, Ring> solid;

    explicit cellTangents(const granularState::tangentColumns& columns)
    :
        flat(columns),
        solid(columns)
    {}

    const cellTangent<2, Ring>& of(std::integral_constant<label, 2>) const
    {
        return flat;
    }
    const cellTangent<3, Ring>& of(std::integral_constant<label, 3>) const
    {
        return solid;
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularMechanicsModels::equilibrium::findDiagonal()
{
    if (law_->elastic())
    {
        return;     // that of the preconditioner, which does not change
    }
    const scalar s = stabilisation*law_->shear();
    const label r = nodes_.radial();
    diagonal_ = 0;
    const auto add = [&](auto ring)
    {
        constexpr bool round = decltype(ring)::value;
        const cellTangents<round> tangents(law_->tangent());
        nodes_.each([&](const auto& e)
        {
            constexpr label dim = std::decay<decltype(e)>::type::dim;
            typedef cellTangent<dim, round> tangent;
            const tangent& C =
                tangents.of(std::integral_constant<label, dim>());
            const scalar V = shapes_.volume[e.cell];
            const scalar resistance =
                s*nodes_.stabilisationScale(e.cell, reference_);
            for (label a = 0; a < e.size(); ++a)
            {
                const scalar* B =
                    shapes_.gradient.cdata() + dim*(e.start + a);
                const scalar own = resistance*nodes_.stabilisation(e, a, a);
                scalar* to = diagonal_.data() + dim*e.nodes[a];
                for (label k = 0; k < dim; ++k)
                {
                    scalar sum = C(k, k, e.cell)*B[k]*B[k];
                    for (label j = 1; j < dim; ++j)
                    {
                        // The shear of k and another axis
                        const label other = (k + j) % dim;
                        const label shear =
                            dim == 2 ? 2 : 3 + (j == 1 ? k : other);
                        sum += C(shear, shear, e.cell)*B[other]*B[other];
                    }
                    to[k] += V*sum + own;
                }
                if (round)
                {
                    const scalar h = shapes_.hoop[e.start + a];
                    to[r] +=
                        V*C(tangent::count - 1, tangent::count - 1, e.cell)*h*h;
                }
            }
        });
    };
    r < 0 ? add(std::false_type()) : add(std::true_type());
    nodes_.sum(diagonal_);
    walls_.forEachTangentialStiffness([&](const label node, const scalar* t, const scalar k)
    {
        for (label j = 0; j < nodes_.dim(); ++j)
        {
            diagonal_[nodes_.dim()*node + j] += k*sqr(t[j]);
        }
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


template<bool Ring>
void Foam::granularMechanicsModels::equilibrium::multiplyGrains
(
    const scalar s,
    const nodeField& d,
    nodeField& result
) const
{
    const cellTangents<Ring> tangents(law_->tangent());
    nodes_.each([&](const auto& e)
    {
        constexpr label dim = std::decay<decltype(e)>::type::dim;
        typedef cellTangent<dim, Ring> tangent;
        const tangent& C = tangents.of(std::integral_constant<label, dim>());
        multiply
        (
            e,
            s*nodes_.stabilisationScale(e.cell, reference_),
            [&]
            (
                const label celli,
                const scalar (&g)[dim][dim],
                scalar& ring,
                scalar (&sigma)[dim][dim]
            )
            {
                typename tangent::vector all;
                C.stress(celli, g, ring, all);
                tangent::spread(all, sigma, ring);
            },
            d,
            result
        );
    });
    if (!coupled_ || !walls_.grips())
    {
        return;
    }
    const label r = nodes_.radial();
    nodeField change(d.size(), Zero);
    const auto grip = [&](auto size)
    {
        constexpr label dim = decltype(size)::value;
        typedef cellTangent<dim, Ring> tangent;
        const tangent& C = tangents.of(size);
        const auto stress = [&](const label celli, scalar* values)
        {
            scalar g[dim][dim] = {}, ring = 0;
            for
            (
                label i = nodes_.cellStarts()[celli];
                i < nodes_.cellStarts()[celli + 1];
                ++i
            )
            {
                const scalar* v = d.cdata() + dim*nodes_.cellNodes()[i];
                const scalar* B = shapes_.gradient.cdata() + dim*i;
                for (label k = 0; k < dim; ++k)
                {
                    for (label j = 0; j < dim; ++j)
                    {
                        g[k][j] += v[k]*B[j];
                    }
                }
                ring += Ring ? v[r]*shapes_.hoop[i] : 0;
            }
            typename tangent::vector all;
            C.stress(celli, g, ring, all);
            std::copy(all, all + tangent::count, values);
        };
        walls_.addNormalCoupling(stress, d, change);
    };
    nodes_.dim() == 2
  ? grip(std::integral_constant<label, 2>())
  : grip(std::integral_constant<label, 3>());
    result -= change;
}


void Foam::granularMechanicsModels::equilibrium::multiply
(
    const nodeField& d,
    nodeField& result
) const
{
    result.resize(d.size());
    result = 0;
    const scalar s = stabilisation*law_->shear();

    if (law_->elastic())
    {
        const scalar lambda = law_->lambda(), G = law_->shear();
        nodes_.each([&](const auto& e)
        {
            constexpr label dim = std::decay<decltype(e)>::type::dim;
            multiply
            (
                e,
                s*nodes_.stabilisationScale(e.cell, reference_),
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
        nodes_.radial() < 0
      ? multiplyGrains<false>(s, d, result)
      : multiplyGrains<true>(s, d, result);
    }
    nodes_.sum(result);
    walls_.addStick(d, result);
    walls_.project(result);
}


// ************************************************************************* //
