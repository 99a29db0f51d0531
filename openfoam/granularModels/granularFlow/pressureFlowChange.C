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

#include "pressureFlow.H"
#include "fvMatrices.H"
#include "simpleMatrix.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Largest residual of a linear solution
static const scalar linearTolerance = 1e-7;

//- Share of the diagonal that pins the mean of psi in a closed bed
static const scalar pinned = 1e-12;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::pressure::solveChange
(
    const scalarField& source,
    const scalarField& guess
)
{
    fvScalarMatrix equation(change_, dimless);
    equation.upper() = -slope_.primitiveField();
    equation.diag() = 0;
    forAll(slope_, facei)
    {
        equation.diag()[mesh_.owner()[facei]] += slope_[facei];
        equation.diag()[mesh_.neighbour()[facei]] += slope_[facei];
    }
    equation.source() = source;
    if (openings_.empty())
    {
        // The mean is free, and rounding alone makes the balance of a closed
        // bed differ from 0
        equation.diag() *= 1 + pinned;
        equation.source() -=
            gSum(source)/returnReduce(source.size(), sumOp<label>());
    }
    forAll(slope_.boundaryField(), patchi)
    {
        equation.internalCoeffs()[patchi] = slope_.boundaryField()[patchi];
        equation.boundaryCoeffs()[patchi] =
            mesh_.boundary()[patchi].coupled()
          ? scalarField(slope_.boundaryField()[patchi])
          : scalarField(slope_.boundaryField()[patchi].size(), Zero);
    }
    change_.primitiveFieldRef() = guess;
    dictionary controls;
    controls.add("solver", "PCG");
    controls.add("preconditioner", "DIC");
    controls.add("tolerance", linearTolerance);
    controls.add("relTol", 0);
    controls.add("maxIter", 5000);
    const label level = solverPerformance::debug;
    solverPerformance::debug = 0;
    equation.solve(controls);
    solverPerformance::debug = level;
    if (openings_.empty())
    {
        // The mean stays
        change_.primitiveFieldRef() -=
            gSum(change_.primitiveField()*mesh_.V())/gSum(mesh_.V());
    }
    change_.correctBoundaryConditions();
}


void Foam::granularFlows::pressure::addChange(surfaceScalarField& flux) const
{
    forAll(flux, facei)
    {
        flux[facei] +=
            slope_[facei]
           *(
                change_[mesh_.owner()[facei]]
              - change_[mesh_.neighbour()[facei]]
            );
    }
    forAll(flux.boundaryField(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        scalarField change(change_.primitiveField(), patch.faceCells());
        if (patch.coupled())
        {
            change -= change_.boundaryField()[patchi].patchNeighbourField();
        }
        flux.boundaryFieldRef()[patchi] +=
            slope_.boundaryField()[patchi]*change;
    }
}


Foam::scalar Foam::granularFlows::pressure::iterate()
{
    setPresent();
    guess_ = 0;
    surfaceScalarField flux(present_);

    // With the openings as they are
    scalarField source(-netOutflow(flux));
    const scalarField before(psi_.primitiveField());
    solveChange(source, scalarField(source.size(), Zero));
    addChange(flux);
    psi_.primitiveFieldRef() += change_.primitiveField();

    // Openings with a mass flow: what a change of their psi by 1 would do
    labelList moved;
    forAll(openings_, i)
    {
        if (openings_[i].massFlow.valid() && openings_[i].isOpen())
        {
            moved.append(i);
        }
    }
    const label count = moved.size();
    responses_.resize(openings_.size());
    PtrList<surfaceScalarField> ofFlux(count);
    simpleMatrix<scalar> balance(count, Zero, Zero);
    forAll(moved, k)
    {
        const label patchi = ports_[moved[k]].patch;
        const labelUList& cells = mesh_.boundary()[patchi].faceCells();
        const scalarField& slope = slope_.boundaryField()[patchi];
        source = 0;
        forAll(cells, facei)
        {
            source[cells[facei]] += slope[facei];
        }
        scalarField guess(source.size(), Zero);
        if (responses_.set(moved[k]))
        {
            guess = responses_[moved[k]];
        }
        solveChange(source, guess);
        responses_.set
        (
            moved[k], new scalarField(change_.primitiveField())
        );
        ofFlux.set(k, new surfaceScalarField(0*flux));
        addChange(ofFlux[k]);
        ofFlux[k].boundaryFieldRef()[patchi] -= slope;
    }
    forAll(moved, k)
    {
        const label patchi = ports_[moved[k]].patch;
        balance.source()[k] =
            -openings_[moved[k]].flow - gSum(flux.boundaryField()[patchi]);
        forAll(moved, l)
        {
            balance(k, l) = gSum(ofFlux[l].boundaryField()[patchi]);
        }
    }
    if (count)
    {
        const scalarField change(balance.LUsolve());
        forAll(moved, k)
        {
            openings_[moved[k]].psi += change[k];
            psi_.primitiveFieldRef() += change[k]*responses_[moved[k]];
            flux += change[k]*ofFlux[k];
        }
    }

    const scalar change = max(mag(flux - flux_)).value();
    flux_ = flux;
    setMassFlux();
    fluxScale_ = max(gMax(mag(flux_.primitiveField())), VSMALL);
    psiScale_ = max(gMax(mag(psi_.primitiveField())), VSMALL);
    return max
    (
        gMax(mag(psi_.primitiveField() - before))/psiScale_,
        change <= rounding_ ? 0 : change/fluxScale_
    );
}


void Foam::granularFlows::pressure::setMassFlux()
{
    vectorField& G = massFlux_.primitiveFieldRef();
    const vectorField& C = mesh_.C();
    const surfaceVectorField& Cf = mesh_.Cf();
    G = Zero;
    forAll(flux_, facei)
    {
        const label P = mesh_.owner()[facei], N = mesh_.neighbour()[facei];
        G[P] += flux_[facei]*(Cf[facei] - C[P]);
        G[N] -= flux_[facei]*(Cf[facei] - C[N]);
    }
    forAll(flux_.boundaryField(), patchi)
    {
        const labelUList& cells = mesh_.boundary()[patchi].faceCells();
        forAll(cells, facei)
        {
            const label P = cells[facei];
            G[P] +=
                flux_.boundaryField()[patchi][facei]
               *(Cf.boundaryField()[patchi][facei] - C[P]);
        }
    }
    G /= mesh_.V();
}


// ************************************************************************* //
