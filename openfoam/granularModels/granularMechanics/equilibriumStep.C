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

//- Least stiffness of a cell, divided by E r/l: grains that do not touch have
//- none, but the equations need some. Much of it keeps steps short where grains
//- come into contact, and slows the last iterations where none do: after a
//- whole step that lowers norm_ by less than 'slow' it is halved
static const scalar mostOfLeast = 0.05;
static const scalar leastOfLeast = 0.005;
static const scalar slow = 0.5;

//- Largest caution, see findStiffness()
static const label mostCaution = 9;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::granularMechanicsModels::equilibrium::nodeField
Foam::granularMechanicsModels::equilibrium::at
(
    const nodeField& du,
    const scalar share
) const
{
    nodeField result(quads_.points());
    forAll(result, i)
    {
        result[i] += u_[i] + share*du[i];
    }
    return result;
}


bool Foam::granularMechanicsModels::equilibrium::strain(const nodeField& du)
{
    // The strain of the displacement du is computed from gradients on the
    // geometry half-way, at u + du/2: as a midpoint rule this is accurate to
    // second order in du, while the geometry at u or u + du gives first order
    broken_ = quads_.shapes(at(du, 0.5), shapes_);
    if (broken_ >= 0)
    {
        return false;
    }
    forAll(shapes_, celli)
    {
        const quadMesh::shape& s = shapes_[celli];
        const quadMesh::quad& q = quads_.quads()[celli];
        // Gradient of the displacement: xx is du_x/dx, xy is du_x/dy
        scalar xx = 0, yy = 0, xy = 0, yx = 0;
        for (label a = 0; a < 4; ++a)
        {
            const vector2D& v = du[q[a]];
            xx += s.b[a]*v.x();
            yy += s.c[a]*v.y();
            xy += s.c[a]*v.x();
            yx += s.b[a]*v.y();
        }
        strain_.xx[celli] = xx;
        strain_.yy[celli] = yy;
        strain_.xy[celli] = xy + yx;
        strain_.rotation[celli] = 0.5*(yx - xy);

        // This also finds NaN
        if (!(mag(xx) + mag(yy) + mag(xy) + mag(yx) < largestStrain))
        {
            broken_ = celli;
            return false;
        }
    }
    grains_.tryStrain(strain_, stress_, tangent_);
    return true;
}


void Foam::granularMechanicsModels::equilibrium::addHourglass
(
    const nodeField& du,
    nodeField& force
) const
{
    forAll(reference_, celli)
    {
        const scalar* gamma = reference_[celli].gamma;
        const quadMesh::quad& q = quads_.quads()[celli];
        vector2D pattern(Zero);
        for (label a = 0; a < 4; ++a)
        {
            pattern += gamma[a]*(u_[q[a]] + du[q[a]]);
        }
        for (label a = 0; a < 4; ++a)
        {
            force[q[a]] += (hourglass*scale_*gamma[a])*pattern;
        }
    }
}


Foam::scalar Foam::granularMechanicsModels::equilibrium::imbalance
(
    const nodeField& du,
    const bool moved
)
{
    const nodeField now(at(du, 1));
    stress_ = grains_.presentStress();
    broken_ = -1;
    if ((!moved || strain(du)) && (moved || !placed_))
    {
        broken_ = quads_.shapes(now, shapes_);
    }
    placed_ = !moved;
    if (returnReduce(broken_ >= 0, orOp<bool>()))
    {
        norm_ = GREAT;
        return GREAT;
    }

    nodeField inner(u_.size(), vector2D(Zero)), outer(inner), slip(du);
    addStress(stress_, inner);
    addHourglass(du, inner);
    walls_.addPressure(mesh_.time().value(), now, outer);
    forAll(inner, i)
    {
        inner[i] -= outer[i];
        slip[i] -= slide_[i];
    }
    quads_.sum(inner);
    walls_.friction
    (
        stress_, now, slip, traction_, friction_, newTraction_, stick_
    );

    scalar most = 0;
    nodeField scaled(r_.size(), vector2D(Zero));
    forAll(r_, i)
    {
        for (label k = 0; k < 2; ++k)
        {
            scalar& r = r_[i][k];
            r = start_[i][k] - inner[i][k] + friction_[i][k];
            if (share_ < 1)
            {
                r -= (1 - share_)*outset_[i][k];
            }
            r *= walls_.free()[i][k];
            const scalar here = mag(r)/std::sqrt(nodeArea_[i]);
            most = here < GREAT ? max(most, here) : GREAT;
            scaled[i][k] = r/std::sqrt(nodeArea_[i]);
        }
    }
    most = returnReduce(most, maxOp<scalar>());
    norm_ = most < GREAT ? quads_.dot(scaled, scaled) : GREAT;
    return most;
}


Foam::scalar Foam::granularMechanicsModels::equilibrium::search
(
    nodeField& du,
    const nodeField& d,
    const bool moved
)
{
    const scalar last = norm_;
    const scalar work = quads_.dot(r_, d);
    scalar share = 1;
    nodeField tried(du);
    for (label cut = 0; cut < mostCuts; ++cut)
    {
        forAll(tried, i)
        {
            tried[i] = du[i] + share*d[i];
        }
        const scalar now = imbalance(tried, true);
        if
        (
            norm_ < last
         || (now < GREAT && mag(quads_.dot(r_, d)) < enoughWork*work)
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


void Foam::granularMechanicsModels::equilibrium::follow(nodeField& du)
{
    nodeField d, resisted(du.size());
    multiply(du, resisted);
    forAll(r_, i)
    {
        r_[i] -= resisted[i];
    }
    findDiagonal();
    solveLinear(r_, d);
    forAll(du, i)
    {
        du[i] += d[i];
    }
    left_ = imbalance(du, true);
}


bool Foam::granularMechanicsModels::equilibrium::balance
(
    nodeField& du,
    bool& moved
)
{
    moved = quads_.dot(du, du) > 0;
    before_ = left_ = imbalance(nodeField(du.size(), vector2D(Zero)), false);
    if (moved || left_ > tolerance_)
    {
        findTangent();
    }
    if (moved)
    {
        findStiffness(0, mostOfLeast);
        follow(du);
    }

    nodeField d;
    label caution = 0;
    scalar least = mostOfLeast;
    for
    (
        label iteration = 0;
        left_ > tolerance_ && left_ < GREAT && iteration < maxIterations_;
        ++iteration
    )
    {
        findStiffness(caution, least);
        findDiagonal();
        solveLinear(r_, d);
        ++counters_.iterations;
        const scalar last = norm_;
        const scalar share = search(du, d, moved);
        if (share > 0)
        {
            moved = true;
            caution = max(caution - 1, label(0));
            least = share < 1 ? mostOfLeast
                  : norm_ > slow*last ? max(0.5*least, leastOfLeast)
                  : least;
        }
        else if (++caution > mostCaution)
        {
            break;
        }
    }
    return left_ <= maxResidual_;
}


bool Foam::granularMechanicsModels::equilibrium::advance(const label parts)
{
    const scalar time = mesh_.time().value();
    const nodeField u(u_), traction(traction_);
    const nodeField way(walls_.way(time, u_));
    granularState::memory before;
    slide_ = walls_.slide(lastTime_, time);
    share_ = 1;

    if (parts > 1)
    {
        before = grains_.remember();
        const nodeField slide(slide_);
        slide_ = vector2D(Zero);
        imbalance(slide_, false);
        outset_ = r_;
        forAll(slide_, i)
        {
            slide_[i] = slide[i]/parts;
        }
    }
    for (label part = 1; part <= parts; ++part)
    {
        share_ = scalar(part)/parts;
        nodeField du(way);
        forAll(du, i)
        {
            for (label k = 0; k < 2; ++k)
            {
                const scalar held = 1 - walls_.free()[i][k];
                du[i][k] = share_*way[i][k] - held*(u_[i][k] - u[i][k]);
            }
        }
        bool moved;
        if (!balance(du, moved))
        {
            placed_ = false;
            if (parts > 1)
            {
                grains_.restore(before);
                u_ = u;
                traction_ = traction;
            }
            return false;
        }
        keep(du, moved);
    }
    lastTime_ = time;
    return true;
}


void Foam::granularMechanicsModels::equilibrium::keep
(
    const nodeField& du,
    const bool moved
)
{
    traction_ = newTraction_;
    if (moved)
    {
        // The state after du is that of the last imbalance
        forAll(u_, i)
        {
            u_[i] += du[i];
        }
        everMoved_ = true;
        grains_.acceptStrain();
        findMetric();
    }
    placed_ = true;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::granularMechanicsModels::equilibrium::solve(const bool lastAttempt)
{
    const counters at(counters_);
    label parts = 1;

    while (!advance(parts))
    {
        if (!lastAttempt)
        {
            return false;
        }
        if (parts == mostParts)
        {
            refuse();
        }
        parts *= 2;
        Info<< "Equilibrium at time " << mesh_.time().timeName() << ": "
            << failure().c_str() << "; the load of the step is applied in "
            << parts << " parts" << nl;
    }

    ++steps_;
    const label iterations = counters_.iterations - at.iterations;
    counters_.solves += before_ > tolerance_;
    counters_.cut += parts > 1;
    counters_.unconverged += left_ > tolerance_;
    counters_.residual = max(counters_.residual, left_);
    largest_ = max(largest_, before_);

    // Printed if and only if the line of the linear solver of T is
    if (solverPerformance::debug)
    {
        Info<< "Equilibrium: out of balance " << before_ << " Pa, after "
            << iterations << " iterations (" << counters_.linear - at.linear
            << " linear) " << left_ << " Pa"
            << (left_ > tolerance_ ? ", not converged" : "") << nl;
    }
    return true;
}


// ************************************************************************* //
