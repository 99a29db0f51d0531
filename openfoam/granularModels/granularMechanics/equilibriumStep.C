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
#include "stiffnessChoice.H"
#include "solverPerformance.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Number of step lengths that the line search tries: 1, 1/2, 1/4, ...
static const label mostCuts = 6;

//- Share of the work of the imbalance on the way ahead at which a step is good
//- enough: along a way that lowers the energy this work falls to zero
static const scalar enoughWork = 0.8;

//- Share of the norm of the imbalance that the first guess may leave
static const scalar enoughGuess = 0.5;

//- Imbalance over the residual up to which a node does not count when steps are
//- judged while at most this share of the nodes is out of balance: on a million
//- nodes, those that are in balance would else decide whether a step may mend
//- the few that are not
static const scalar balanced = 0.5;
static const scalar some = 0.01;

//- A step ends early if its imbalance is below so many residuals and its
//- iterations stall, or leave more than this share while at most this share of
//- the nodes is out of balance: where cells are small, single ones slide and
//- stick in turn, and no motion of all nodes mends them
static const scalar nearly = 2;
static const scalar slow = 0.15;
static const scalar few = 1e-4;

//- Imbalance over the residual that an iteration probably mends
static const scalar probable = 10;

//- Both for meshes with more nodes than this
static const label large = 10000;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::granularMechanicsModels::equilibrium::nodeField
Foam::granularMechanicsModels::equilibrium::at
(
    const nodeField& du,
    const scalar share
) const
{
    nodeField result(nodes_.points());
    forAll(result, i)
    {
        result[i] += u_[i] + share*du[i];
    }
    return result;
}


void Foam::granularMechanicsModels::equilibrium::findGradient
(
    const elementMesh::shapes& shapes,
    const nodeField& d
)
{
    UPtrList<scalarField>& gradient = law_->gradient();
    const label r = nodes_.radial();
    nodes_.each([&](const auto& e)
    {
        constexpr label dim = std::decay<decltype(e)>::type::dim;
        const scalar* B = shapes.gradient.cdata() + dim*e.start;
        scalar g[dim][dim] = {}, ring = 0;
        for (label a = 0; a < e.size(); ++a)
        {
            const scalar* v = d.cdata() + dim*e.nodes[a];
            for (label i = 0; i < dim; ++i)
            {
                for (label j = 0; j < dim; ++j)
                {
                    g[i][j] += v[i]*B[dim*a + j];
                }
            }
            ring += r < 0 ? 0 : v[r]*shapes.hoop[e.start + a];
        }
        scalar most = mag(ring);
        for (label i = 0; i < dim; ++i)
        {
            for (label j = 0; j < dim; ++j)
            {
                gradient[dim*i + j][e.cell] = g[i][j];
                most += mag(g[i][j]);
            }
        }
        if (r >= 0)
        {
            gradient[4][e.cell] = ring;
        }
        // This also finds NaN
        if (!(most < largestStrain) && invalidCell_ < 0)
        {
            invalidCell_ = e.cell;
        }
    });
}


bool Foam::granularMechanicsModels::equilibrium::strain(const nodeField& du)
{
    if (law_->elastic())
    {
        invalidCell_ = -1;
        findGradient(reference_, nodeField(u_ + du));
    }
    else
    {
        // The strain of the displacement du is computed from gradients on the
        // geometry half-way, at u + du/2: as a midpoint rule this is accurate
        // to second order in du, while the geometry at u or u + du gives first
        // order
        invalidCell_ = nodes_.findShapes(at(du, 0.5), shapes_);
        if (invalidCell_ < 0)
        {
            findGradient(shapes_, du);
        }
    }
    if (invalidCell_ >= 0)
    {
        return false;
    }
    law_->find(wantsTangent_);
    hasTangent_ = wantsTangent_;
    return true;
}


void Foam::granularMechanicsModels::equilibrium::addUnfitted
(
    const nodeField& du,
    nodeField& force
) const
{
    const nodeField u(u_ + du);
    const scalar s = stabilisation*law_->shear();
    nodes_.each([&](const auto& e)
    {
        nodes_.addUnfitted
        (
            e,
            s*nodes_.stabilisationScale(e.cell, reference_),
            u.cdata(),
            force.data()
        );
    });
}


Foam::scalar Foam::granularMechanicsModels::equilibrium::measure()
{
    const label dim = nodes_.dim();
    scalar most = 0;
    nodeField excess(r_.size());
    forAll(r_, i)
    {
        const scalar here = mag(r_[i])/nodeSize_[i/dim];
        excess[i] = max(here - ignored_, scalar(0));
        most = here < GREAT ? max(most, here) : GREAT;
    }
    most = returnReduce(most, maxOp<scalar>());
    norm_ = most < GREAT ? nodes_.dot(excess, excess) : GREAT;
    return most;
}


Foam::scalar Foam::granularMechanicsModels::equilibrium::imbalance
(
    const nodeField& du,
    const bool moved
)
{
    const nodeField now(at(du, 1));
    invalidCell_ = -1;
    if (!moved && !law_->elastic())
    {
        law_->present();
    }
    else
    {
        strain(du);
    }
    if (invalidCell_ < 0 && (moved || !placed_))
    {
        invalidCell_ = nodes_.findShapes(now, shapes_);
    }
    placed_ = !moved;
    if (returnReduce(invalidCell_ >= 0, orOp<bool>()))
    {
        norm_ = GREAT;
        return GREAT;
    }

    nodeField inner(u_.size(), Zero), outer(inner);
    addStress(law_->stress(), inner);
    addUnfitted(du, inner);
    walls_.addPressure(mesh_.time().value(), now, outer);
    inner -= outer;
    nodes_.sum(inner);
    walls_.friction
    (
        law_->stress(), now, du, slide_, traction_, friction_, newTraction_
    );

    onWalls_ = friction_ + volumeForce_ - inner;
    r_ = start_ + onWalls_;
    walls_.addShells(mesh_.time().value(), nodeField(u_ + du), r_);
    if (share_ < 1)
    {
        r_ -= (1 - share_)*initialResidual_;
    }
    walls_.project(r_);
    return measure();
}


Foam::scalar Foam::granularMechanicsModels::equilibrium::search
(
    nodeField& du,
    const nodeField& d,
    const bool moved
)
{
    const scalar last = norm_;
    const scalar work = nodes_.dot(r_, d);
    scalar share = 1;
    nodeField tried(du);
    for (label cut = 0; cut < mostCuts; ++cut)
    {
        tried = du + share*d;
        const scalar now = imbalance(tried, true);
        if
        (
            norm_ < last
         || (now < GREAT && mag(nodes_.dot(r_, d)) < enoughWork*work)
        )
        {
            du = tried;
            left_ = now;
            return share;
        }
        share *= 0.5;
    }
    // Stress, tangent and imbalance are those after du again
    left_ = imbalance(du, moved);
    if (!moved)
    {
        findTangent();
    }
    return 0;
}


void Foam::granularMechanicsModels::equilibrium::follow
(
    nodeField& du,
    const nodeField& motion
)
{
    nodeField d, resisted(du.size());
    findStiffness(stiffnessChoice::firstCaution, stiffnessChoice::firstShare);
    multiply(motion, resisted);
    r_ -= resisted;
    findDiagonal();

    // To the residual of the step if it can be: what is left lets the cells
    // next to the walls take most of the motion, and on irregular cells
    // Newton's method may not find the way back from there
    scalar most = tolerance_;
    forAll(r_, i)
    {
        most = max(most, mag(r_[i])/nodeSize_[i/nodes_.dim()]);
    }
    const scalar mostLeft = tolerance_/returnReduce(most, maxOp<scalar>());
    counters_.linear += solver_->solve(true, diagonal_, r_, d, mostLeft);
    du += motion + d;
    left_ = imbalance(du, true);
}


bool Foam::granularMechanicsModels::equilibrium::guess(nodeField& du)
{
    if (guess_.empty())
    {
        return false;
    }
    const scalar still = norm_;
    const scalar now = imbalance(guess_, true);
    if (norm_ < enoughGuess*still)
    {
        du = guess_;
        left_ = now;
        return true;
    }
    left_ = imbalance(du, false);
    return false;
}


bool Foam::granularMechanicsModels::equilibrium::fewOutOfBalance
(
    const scalar share
) const
{
    const label dim = nodes_.dim();
    label all = 0, out = 0;
    for (const label node : nodes_.owned())
    {
        ++all;
        for (label i = dim*node; i < dim*(node + 1); ++i)
        {
            if (mag(r_[i]) > tolerance_*nodeSize_[node])
            {
                ++out;
                break;
            }
        }
    }
    reduce(all, sumOp<label>());
    reduce(out, sumOp<label>());
    return all > large && out <= share*all;
}


bool Foam::granularMechanicsModels::equilibrium::balance
(
    nodeField& du,
    bool& moved
)
{
    const bool pushed = nodes_.dot(du, du) > 0;
    before_ = left_ = imbalance(nodeField(du.size(), Zero), false);
    moved = pushed || (left_ > tolerance_ && guess(du));
    // After a guess that is accepted there is the tangent at its end
    if (pushed || (left_ > tolerance_ && !moved))
    {
        findTangent();
    }
    if (pushed)
    {
        const nodeField motion(du);
        du = 0;
        follow(du, motion);
    }
    return iterate(du, moved);
}


bool Foam::granularMechanicsModels::equilibrium::iterate
(
    nodeField& du,
    bool& moved
)
{
    nodeField d;
    stiffnessChoice choice;
    const scalar enough = min(nearly*tolerance_, maxResidual_);
    for
    (
        label iteration = 0;
        left_ > tolerance_ && left_ < GREAT && iteration < maxIterations_;
        ++iteration
    )
    {
        findStiffness(choice.caution(), choice.leastShare());
        findDiagonal();
        counters_.linear += solver_->solve(!coupled_, diagonal_, r_, d);
        ++counters_.iterations;
        const bool local = fewOutOfBalance(some);
        ignored_ = local ? balanced*tolerance_ : 0;
        measure();
        const scalar before = norm_;
        // If this is probably the last iteration, without a tangent
        wantsTangent_ = left_ > probable*tolerance_;
        const scalar way = search(du, d, moved);
        wantsTangent_ = true;
        moved = moved || way > 0;
        choice.learn(way, norm_/before, local);
        const bool ends =
            left_ <= enough
         && (choice.stalls() || (norm_ > slow*before && fewOutOfBalance(few)));
        if (choice.exhausted() || ends)
        {
            break;
        }
    }
    return left_ <= maxResidual_;
}


// ************************************************************************* //
