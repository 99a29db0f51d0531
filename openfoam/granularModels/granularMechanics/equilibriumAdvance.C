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

//- Motions of walls at which grains yield: at most so many, until they miss
//- the way that the grains give by this share of it, or by this share of the
//- mean radius; and the least share of a motion that is tried at once
static const label mostGiving = 20;
static const scalar enoughGiving = 1e-3;
static const scalar leastGiving = 1e-8;
static const scalar leastShare = 0.05;

//- Grains leave walls and come back at most so often in a step
static const label mostLeaving = 20;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::granularMechanicsModels::equilibrium::giveWay
(
    const nodeField& target,
    nodeField& du,
    bool& moved,
    nodeField& give
)
{
    // The motion of a wall changes the strain next to it, and that the motion:
    // a fixed point, approached with the relaxation of Aitken (Irons and Tuck,
    // 1969, Int. J. Numer. Methods Eng. 1:275)
    scalar share = 1;
    nodeField left, last;
    for (label round = 0; round <= mostGiving; ++round)
    {
        give = walls_.give(reference_, du, grains_.stepStrain());
        left = target + give - du;
        walls_.keepConstrained(left);
        if
        (
            gMax(mag(left))
         <= max(enoughGiving*gMax(mag(give)), leastGiving*walls_.radius())
        )
        {
            return true;
        }
        if (round == mostGiving)
        {
            break;
        }
        if (round > 0)
        {
            const nodeField change(left - last);
            share *=
               -nodes_.dot(last, change)
               /max(nodes_.dot(change, change), VSMALL);
            share = max(leastShare, min(share, scalar(1)));
        }
        last = left;
        if (!moved)
        {
            findTangent();
        }
        follow(du, nodeField(share*left));
        moved = true;
        if (!iterate(du, moved))
        {
            return false;
        }
    }
    notGiven_ = true;
    return false;
}


bool Foam::granularMechanicsModels::equilibrium::leaveWalls
(
    const nodeField& target,
    nodeField& du,
    bool& moved,
    nodeField& give
)
{
    scalarField least(nodeSize_);
    least *= tolerance_;
    for (label round = 0; leaves() && round < mostLeaving; ++round)
    {
        if (!walls_.leave(nodeField(target + give - du), onWalls_, least))
        {
            return true;
        }
        nodeField left(target + give - du);
        walls_.keepConstrained(left);
        left_ = imbalance(du, moved);
        findTangent();
        follow(du, left);
        moved = true;
        if
        (
            !iterate(du, moved)
         || (walls_.gives() && !giveWay(target, du, moved, give))
        )
        {
            return false;
        }
    }
    return true;
}


bool Foam::granularMechanicsModels::equilibrium::advance(const label parts)
{
    const scalar time = mesh_.time().value();
    const nodeField u(u_), given(give_);
    const scalarField traction(traction_);
    const nodeField way(walls_.way(time, nodeField(u_ - give_)));
    if (leaves())
    {
        // Those that are held miss their wall by what the steps before left of
        // the way by which grains give
        walls_.setLeft
        (
            walls_.way(lastTime_, nodeField(u_ - give_)),
            2*enoughGiving*gMax(mag(give_))
        );
    }
    slide_ = walls_.slide(lastTime_, time);
    scalarField shellSlide;
    if (walls_.shellsSlide())
    {
        shellSlide = walls_.shellSlide();
        slide_ += shellSlide - shellSlide_;
    }
    share_ = 1;
    notGiven_ = false;
    ignored_ = 0;
    guess_.clear();

    if (parts == 1 && nodes_.dot(velocity_, velocity_) > 0)
    {
        guess_ = (time - lastTime_)*velocity_;
        if (nodes_.dot(velocityBefore_, velocityBefore_) > 0)
        {
            guess_ += (time - lastTime_)*(velocity_ - velocityBefore_);
        }
        walls_.project(guess_);
    }
    if (parts > 1)
    {
        const scalarField slide(slide_);
        slide_ = 0;
        imbalance(nodeField(u_.size(), Zero), false);
        initialResidual_ = r_;
        slide_ = slide/parts;
    }
    for (label part = 1; part <= parts; ++part)
    {
        share_ = scalar(part)/parts;
        // Spheres alone: not compared with discs
        if (walls_.rubbing() > 0 && law_->keepsAcceleration())
        {
            law_->present();
            walls_.keepLimits(law_->stress(), at(nodeField(u_.size(), Zero), 1));
        }
        const nodeField done(walls_.alongWalls(nodeField(u_ - u)));
        const nodeField target(share_*way - done + give_ - given);
        nodeField du(target), give(du.size(), Zero);
        walls_.keepConstrained(du);
        bool moved;
        if
        (
            !balance(du, moved)
         || (walls_.gives() && !giveWay(target, du, moved, give))
         || !leaveWalls(target, du, moved, give)
        )
        {
            placed_ = false;
            if (parts > 1)
            {
                grains_.dropTrials();
                u_ = u;
                traction_ = traction;
                give_ = given;
            }
            return false;
        }
        give_ += give;
        keep(du, moved);
    }
    if (time > lastTime_)
    {
        if (law_->keepsAcceleration())
        {
            velocityBefore_ = velocity_;
        }
        velocity_ = (u_ - u)/(time - lastTime_);
    }
    if (walls_.shellsSlide())
    {
        shellSlide_ = shellSlide;
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
        u_ += du;
        everMoved_ = true;
        law_->accept();
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
    counters_.gap = max
    (
        counters_.gap,
        walls_.largestGap(walls_.way(lastTime_, nodeField(u_ - give_)))
    );
    const label iterations = counters_.iterations - at.iterations;
    counters_.solves += before_ > tolerance_;
    counters_.cut += parts > 1;
    const bool unconverged = left_ > tolerance_;
    counters_.unconverged += unconverged;
    counters_.residual = max(counters_.residual, left_);
    if (unconverged)
    {
        counters_.unbalanced = max(counters_.unbalanced, left_);
    }
    largest_ = max(largest_, before_);

    // For the next step, from the stress in equilibrium: by that of grains which
    // have swelled in their places a step would be judged by its own error
    setResidual();

    // Printed if and only if the line of the linear solver of T is
    if (solverPerformance::debug)
    {
        Info<< "Equilibrium: out of balance before iteration " << before_
            << " Pa, after " << iterations << " iterations ("
            << counters_.linear - at.linear << " linear) " << left_ << " Pa"
            << (unconverged ? ", not converged" : "") << nl;
    }
    return true;
}


// ************************************************************************* //
