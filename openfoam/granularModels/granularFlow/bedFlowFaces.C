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

#include "bedFlow.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::bedFlow::addCells()
{
    const scalarField& V = mesh_.V();
    scalarField& gas = matrix_.aa().matrix.diag();
    scalarField& bed = matrix_.bb().matrix.diag();
    forAll(V, celli)
    {
        const scalar H = V[celli]*exchange_[celli];
        const scalar E = V[celli]*storage_[celli];
        // What a cell lacks of a balance of mass carries its own temperature
        const scalar T = gasT_[celli], c = gas_.capacity(T);
        const scalar lack = unbalanced_[celli]*c;
        const scalar source =
            E*start_[celli] + lack*(gas_.enthalpy(T)/c - T);
        gas[celli] = H + (single_ ? 0 : E - lack);
        matrix_.ab()[celli] = -H;
        matrix_.ba()[celli] = single_ ? 0 : -H;
        bed[celli] = single_ ? E - lack : H;
        (single_ ? matrix_.source().b : matrix_.source().a)[celli] = source;
    }
}


void Foam::granularFlows::bedFlow::addFaces()
{
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const vectorField& C = mesh_.C();
    const vectorField& Cf = mesh_.Cf();
    const vectorField& Sf = mesh_.Sf();
    const scalarField& magSf = mesh_.magSf();
    const scalarField& delta = mesh_.nonOrthDeltaCoeffs();
    const scalarField& weight = mesh_.weights();
    lduMatrix& gas = (single_ ? matrix_.bb() : matrix_.aa()).matrix;
    lduMatrix& bed = (single_ ? matrix_.bb() : matrix_.abAround()).matrix;
    scalarField& source = single_ ? matrix_.source().b : matrix_.source().a;
    forAll(owner, facei)
    {
        const label P = owner[facei], N = neighbour[facei];
        const scalar m = flux_[facei];
        const bool forward = m > 0;
        const label U = forward ? P : N, D = forward ? N : P;
        const vector normal(Sf[facei]/magSf[facei]);
        const auto through = [&](const label celli)
        {
            return dispersion
            (
                massFlux_[celli], diffusionAlong_[celli],
                diffusionAcross_[celli], normal
            );
        };
        const scalar k =
            (weight[facei]*through(P) + (1 - weight[facei])*through(N))
           *magSf[facei]*delta[facei];
        gas.diag()[P] += k;
        gas.diag()[N] += k;
        gas.upper()[facei] -= k;
        gas.lower()[facei] -= k;
        if (m == 0)
        {
            continue;
        }
        const cellValues u(valuesOf(U)), d(valuesOf(D));
        const weights c
        (
            carry(u, &d, mag(m), Cf[facei] - C[U], C[D] - C[U]).w
        );
        // upper: row of the owner
        scalarField& ofU = forward ? gas.upper() : gas.lower();
        scalarField& ofD = forward ? gas.lower() : gas.upper();
        gas.diag()[U] += c.gasU;
        ofU[facei] += c.gasD;
        gas.diag()[D] -= c.gasD;
        ofD[facei] -= c.gasU;
        scalarField& bedOfU = forward ? bed.upper() : bed.lower();
        scalarField& bedOfD = forward ? bed.lower() : bed.upper();
        bed.diag()[U] += c.bedU;
        bedOfU[facei] += c.bedD;
        bed.diag()[D] -= c.bedD;
        bedOfD[facei] -= c.bedU;
        source[U] -= c.given;
        source[D] += c.given;
    }
}


void Foam::granularFlows::bedFlow::addBetween(const label patchi)
{
    const fvPatch& patch = mesh_.boundary()[patchi];
    const labelUList& cells = patch.faceCells();
    const vectorField& Sf = mesh_.Sf().boundaryField()[patchi];
    const vectorField& Cf = patch.Cf();
    const scalarField& magSf = patch.magSf();
    const scalarField& weight = patch.weights();
    const scalarField& delta =
        mesh_.nonOrthDeltaCoeffs().boundaryField()[patchi];
    const vectorField toN(patch.delta());
    const vectorField& C = mesh_.C();
    const List<cellValues> beyond(valuesBeyond(patchi));
    twoFieldMatrix::part& gas = single_ ? matrix_.bb() : matrix_.aa();
    twoFieldMatrix::part& bed = single_ ? matrix_.bb() : matrix_.abAround();
    scalarField& source = single_ ? matrix_.source().b : matrix_.source().a;
    forAll(cells, facei)
    {
        const label P = cells[facei];
        const cellValues here(valuesOf(P));
        const cellValues& there = beyond[facei];
        const vector normal(Sf[facei]/magSf[facei]);
        const scalar k =
            (
                weight[facei]
               *dispersion(here.G, here.along, here.across, normal)
              + (1 - weight[facei])
               *dispersion(there.G, there.along, there.across, normal)
            )*magSf[facei]*delta[facei];
        gas.matrix.diag()[P] += k;
        gas.between[patchi][facei] += k;
        const scalar m = flux_.boundaryField()[patchi][facei];
        if (m == 0)
        {
            continue;
        }
        const bool leaves = m > 0;
        const vector mine(Cf[facei] - C[P]);
        const weights c
        (
            carry
            (
                leaves ? here : there, leaves ? &there : &here, mag(m),
                leaves ? mine : toN[facei] - mine, toN[facei]
            ).w
        );
        gas.matrix.diag()[P] += leaves ? c.gasU : -c.gasD;
        gas.between[patchi][facei] += leaves ? -c.gasD : c.gasU;
        bed.matrix.diag()[P] += leaves ? c.bedU : -c.bedD;
        bed.between[patchi][facei] += leaves ? -c.bedD : c.bedU;
        source[P] += leaves ? -c.given : c.given;
    }
}


void Foam::granularFlows::bedFlow::addPorts()
{
    scalarField& source = single_ ? matrix_.source().b : matrix_.source().a;
    scalarField& gas = (single_ ? matrix_.bb() : matrix_.aa()).matrix.diag();
    for (const port& each : ports_)
    {
        const labelUList& cells = mesh_.boundary()[each.patch].faceCells();
        const scalarField& m = flux_.boundaryField()[each.patch];
        forAll(cells, facei)
        {
            const label P = cells[facei];
            if (m[facei] < 0)
            {
                source[P] -= m[facei]*gas_.enthalpy(temperatureAt(each));
            }
            else if (m[facei] > 0)
            {
                const weights c(leave(each.patch, facei).w);
                gas[P] += c.gasU;
                (single_ ? gas[P] : matrix_.ab()[P]) += c.bedU;
                source[P] -= c.given;
            }
        }
    }
}


void Foam::granularFlows::bedFlow::addBed(const fvScalarMatrix& bed)
{
    lduMatrix& matrix = matrix_.bb().matrix;
    scalarField& source = matrix_.source().b;
    matrix.diag() += bed.diag();
    matrix.upper() += bed.upper();
    matrix.lower() += bed.lower();
    source += bed.source();
    forAll(mesh_.boundary(), patchi)
    {
        if (walls_->meetsSolid(patchi))
        {
            continue;
        }
        const fvPatch& patch = mesh_.boundary()[patchi];
        const labelUList& cells = patch.faceCells();
        const scalarField& internal = bed.internalCoeffs()[patchi];
        const scalarField& boundary = bed.boundaryCoeffs()[patchi];
        forAll(internal, facei)
        {
            matrix.diag()[cells[facei]] += internal[facei];
            if (patch.coupled())
            {
                matrix_.bb().between[patchi][facei] += boundary[facei];
            }
            else
            {
                source[cells[facei]] += boundary[facei];
            }
        }
    }
}


// ************************************************************************* //
