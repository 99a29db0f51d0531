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
#include "addToRunTimeSelectionTable.H"
#include "extrapolatedCalculatedFvPatchFields.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Mean stress at the start over the weight per area below which there is a
//- warning. At rest it is about a half; in silos a hundred times as high as wide,
//- whose sides carry nearly all, it may be a hundredth
static const scalar leastBorne = 0.01;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularMechanicsModels::equilibrium::setWeight()
{
    const label dim = nodes_.dim(), r = nodes_.radial();
    vector across(gravity_);    // where nothing can move
    for (label k = 0; k < dim; ++k)
    {
        across[k] = k == r ? across[k] : 0;
    }
    if (mag(across) > 1e-9*mag(gravity_))
    {
        FatalErrorInFunction
            << "Gravity in constant/g is " << gravity_ << ", allowed in "
            << (r < 0 ? "the plane: along x and y" : "a wedge: along its axis")
            << exit(FatalError);
    }
    addForce(gravity_*grains_.bulkDensity().primitiveField(), weight_);
    volumeForce_ = weight_;
}


void Foam::granularMechanicsModels::equilibrium::addForce
(
    const vectorField& perVolume,
    nodeField& force
) const
{
    // The cells are material and so keep their weight. In bodies of revolution
    // the nodes that are farther out carry more of it, as on rectangles
    const label dim = nodes_.dim(), r = nodes_.radial();
    nodes_.each([&](const auto& e)
    {
        const scalar middle = nodes_.stabilisationScale(e.cell, reference_);
        for (label a = 0; a < e.size(); ++a)
        {
            const label node = e.nodes[a];
            const scalar share =
                r < 0
              ? 1
              : (nodes_.points()[2*node + r] + 2*middle)/(3*middle);
            for (label k = 0; k < dim; ++k)
            {
                force[dim*node + k] +=
                    share*reference_.volume[e.cell]/e.size()
                   *perVolume[e.cell][k];
            }
        }
    });
    nodes_.sum(force);
}


void Foam::granularMechanicsModels::equilibrium::setForce
(
    const vectorField& perVolume
)
{
    if (perVolume.empty())
    {
        return;
    }
    volumeForce_ = 0;
    addForce(perVolume, volumeForce_);
    volumeForce_ += weight_;
}


void Foam::granularMechanicsModels::equilibrium::setStart()
{
    scalarField size(nodes_.size(), Zero);
    nodes_.each([&](const auto& e)
    {
        for (label a = 0; a < e.size(); ++a)
        {
            size[e.nodes[a]] += reference_.volume[e.cell]/e.size();
        }
    });
    nodes_.sum(size, 1);
    // The stress that acts on a face of the node's volume balances its force
    forAll(size, node)
    {
        const label r = nodes_.radial();
        nodeSize_[node] =
            nodes_.dim() == 3 ? sqr(std::cbrt(size[node]))
          : r < 0 ? std::sqrt(size[node])
          : std::sqrt(size[node]*max(nodes_.points()[2*node + r], VSMALL));
        if (r >= 0)
        {
            // On the axis: of the volume alone
            nodeSize_[node] =
                max(nodeSize_[node], sqr(std::cbrt(size[node])));
        }
    }

    for (label i = 0; i < weight_.size() && !law_->elastic(); ++i)
    {
        unsupported_ =
            max(unsupported_, mag(weight_[i])/nodeSize_[i/nodes_.dim()]);
    }
    reduce(unsupported_, maxOp<scalar>());
    setResidual();

    // Imbalance of the initial fields: without gravity it is the reference for
    // all later steps and so is never relaxed
    if (!law_->elastic())
    {
        addStress(law_->split(initialStress_.primitiveField()), start_);
        nodes_.sum(start_);
    }
    const label dim = nodes_.dim();
    nodeField free(start_ - weight_);
    // Shells are at rest under what they carry at the start
    nodeField borne(free.size(), Zero);
    if (!law_->elastic())
    {
        borne = walls_.borneByShells(free);
        free -= borne;
    }
    walls_.project(free);
    scalar most = 0;
    forAll(start_, i)
    {
        if (mag(gravity_) > 0 || walls_.balanced()[i/dim] == 0)
        {
            start_[i] = borne[i];
        }
        most = max
        (
            most, mag(walls_.balanced()[i/dim]*free[i])/nodeSize_[i/dim]
        );
    }
    Info<< "Equilibrium: residual " << tolerance_
        << " Pa; initial fields are out of balance by "
        << returnReduce(most, maxOp<scalar>()) << " Pa, which "
        << (mag(gravity_) > 0 ? "the first step mends" : "is kept") << nl
        << endl;
}


void Foam::granularMechanicsModels::equilibrium::compareWeight() const
{
    const scalar g = mag(gravity_);
    if
    (
        !(g > 0) || mesh_.time().timeIndex() > 0
     || law_->elastic() || !grains_.model().isThreeDimensional()
    )
    {
        return;
    }
    const vector down(gravity_/g);
    scalar area = 0;
    for (const fvPatch& patch : mesh_.boundary())
    {
        if (!patch.coupled() && patch.size())
        {
            area += sum(max(patch.Sf() & down, scalar(0)));
        }
    }
    reduce(area, sumOp<scalar>());
    const scalarField& V = mesh_.V();
    const scalar borne =
       -gSum(V*(down & (initialStress_.primitiveField() & down)))/gSum(V);
    const scalar weight = g*gSum(grains_.mass())/max(area, VSMALL);
    if (borne < leastBorne*weight)
    {
        WarningInFunction
            << "The stress at the start is " << borne << " Pa along gravity in"
            << " the mean, and the weight of the bed over the area below it is "
            << weight << " Pa: spheres under so little stress are far too soft for"
            << " it, and the run may take thousands of steps. Is the stress"
            << " given in Pa? restStress in constant/granularProperties is that"
            << " of a bed at rest" << nl << endl;
    }
}


void Foam::granularMechanicsModels::equilibrium::addStress
(
    const List<scalarField>& stress,
    nodeField& force
) const
{
    const label r = nodes_.radial();
    nodes_.each([&](const auto& e)
    {
        constexpr label dim = std::decay<decltype(e)>::type::dim;
        const scalar V = shapes_.volume[e.cell];
        const scalar* B = shapes_.gradient.cdata() + dim*e.start;
        scalar s[dim][dim];
        if (dim == 2)
        {
            s[0][0] = V*stress[0][e.cell];
            s[1][1] = V*stress[1][e.cell];
            s[0][1] = s[1][0] = V*stress[2][e.cell];
        }
        else
        {
            for (label k = 0; k < dim; ++k)
            {
                const label next = (k + 1) % dim;
                s[k][k] = V*stress[k][e.cell];
                s[k][next] = s[next][k] = V*stress[dim + k][e.cell];
            }
        }
        const scalar ring = r < 0 ? 0 : V*stress[3][e.cell];
        for (label a = 0; a < e.size(); ++a)
        {
            scalar* f = force.data() + dim*e.nodes[a];
            for (label i = 0; i < dim; ++i)
            {
                for (label j = 0; j < dim; ++j)
                {
                    f[i] += s[i][j]*B[dim*a + j];
                }
            }
            if (r >= 0)
            {
                f[r] += ring*shapes_.hoop[e.start + a];
            }
        }
    });
}


// ************************************************************************* //
