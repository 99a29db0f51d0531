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

#include "heatEquation.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- How often Newton's method is repeated at most
static const label mostNewton = 30;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::heatEquation::heatEquation
(
    volScalarField& T,
    const granularProperties& properties,
    granularState& grains,
    neighbourSolids& neighbours,
    const label correctors
)
:
    T_(T),
    mesh_(T.mesh()),
    sources_(fv::options::New(mesh_)),
    neighbours_(neighbours),
    flow_(granularFlow::New(properties, grains, T)),
    heat_(properties.heatFunction()),
    heatCapacity_
    (
        "volumetricHeatCapacity",
        grains.bulkDensity()*properties.heatCapacity()
    ),
    conduction_(T, properties, grains, neighbours.empty(), wallsReadTensor()),
    TEqn_(T, dimPower),
    controls_(mesh_.solverDict(T.name())),
    correctors_(correctors),
    constrained_(false),
    faceHeat_(mesh_.boundary().size()),
    patchHeat_(mesh_.boundary().size(), Zero),
    sourceHeat_(0),
    sourceDensity_(0)
{
    checkSources();
    // Making the matrix has updated time-dependent walls to the start time and
    // marked them as up to date; without this call they would keep that value
    // during the first step
    T_.correctBoundaryConditions();

    conduction_.report();
    if (!sources_.optionList::empty())
    {
        presentSources();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::heatEquation::setStorage(const scalarField& Tstar, const scalar tau)
{
    const scalar rate = 1/tau;
    const scalarField& capacity = heatCapacity_.primitiveField();
    const scalarField& V = mesh_.V();
    scalarField& diag = TEqn_.diag();
    scalarField& source = TEqn_.source();

    forAll(diag, celli)
    {
        diag[celli] = rate*capacity[celli]*V[celli];
        source[celli] = rate*capacity[celli]*Tstar[celli]*V[celli];
    }
    if (heat_.isNumber())
    {
        return;
    }
    // H(T) is about H(T_k) + c/c0 (T - T_k)
    const scalar c0 = heat_.usual().value();
    forAll(diag, celli)
    {
        const scalar T = T_[celli], slope = heat_.value(T)/c0;
        source[celli] -= diag[celli]*(heat_.equivalent(T) - slope*T);
        diag[celli] *= slope;
    }
}


bool Foam::heatEquation::hasSettled
(
    const scalarField& before,
    const scalar sufficient
) const
{
    const scalarField& T = T_.primitiveField();
    scalar change = 0, size = 0;
    forAll(T, celli)
    {
        change = max(change, mag(T[celli] - before[celli]));
        size = max(size, mag(T[celli]));
    }
    return
        returnReduce(change, maxOp<scalar>())
     <= max(settled*returnReduce(size, maxOp<scalar>()), sufficient);
}


void Foam::heatEquation::solveBed
(
    const scalarField& Tstar,
    const scalar tau,
    const scalar sufficient
)
{
    // Explicit parts, and a heat capacity or sources that depend on the
    // temperature, need repetitions
    const label least = conduction_.isExplicit() ? correctors_ : 0;
    scalarField before;
    for (label corrector = 0; corrector <= least + mostNewton; ++corrector)
    {
        if (!heat_.isNumber())
        {
            before = T_.primitiveField();
        }
        T_.boundaryFieldRef().updateCoeffs();
        forAll(faceHeat_, patchi)
        {
            const fvPatch& patch = mesh_.boundary()[patchi];
            faceHeat_[patchi] =
                scalarField(patch.coupled() ? 0 : patch.size(), Zero);
        }
        // In OpenFOAM's terms
        //     fvm::ddt(C, T) - fvm::laplacian(K, T) == fvOptions(C, T),
        // but with T* of the stage for the old T, with c as a function of T,
        // and without the tensor laplacian where it only costs time (see
        // heatConduction)
        setStorage(Tstar, tau);
        conduction_.addTo(TEqn_, faceHeat_);
        const tmp<fvScalarMatrix> S(addSources());
        bool flowed = true;
        if (flow_->active())
        {
            flowed = flow_->solve
            (
                TEqn_, tau, controls_.get<scalar>("tolerance"), sufficient
            );
        }
        else
        {
            TEqn_.solve(controls_);
        }
        const bool sourced = finishSources(S);
        if
        (
            corrector >= least
         && sourced
         && flowed
         && (heat_.isNumber() || hasSettled(before, sufficient))
        )
        {
            break;
        }
    }
    sourceHeat_ += flow_->heat();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::heatEquation::solve
(
    const scalarField& Tstar,
    const scalar tau,
    const symmTensorField& K
)
{
    conduction_.set(K);
    flow_->beginStage();
    neighbours_.couple
    (
        tau,
        [&](const scalar sufficient) { solveBed(Tstar, tau, sufficient); }
    );

    // Constraints cut their cells off from the walls
    const fvScalarMatrix& equation = free_.valid() ? free_() : TEqn_;
    forAll(patchHeat_, patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (patch.coupled())
        {
            continue;
        }
        const scalarField& internal = equation.internalCoeffs()[patchi];
        const scalarField& boundary = equation.boundaryCoeffs()[patchi];
        const labelUList& cells = patch.faceCells();
        scalarField& heat = faceHeat_[patchi];
        forAll(boundary, facei)
        {
            heat[facei] += boundary[facei] - internal[facei]*T_[cells[facei]];
        }
        patchHeat_[patchi] = sum(heat);
    }
}


// ************************************************************************* //
