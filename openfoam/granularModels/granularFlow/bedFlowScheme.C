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

#include <cmath>

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

// At a face behind a cell of length l along the flow, Tg is what the cell's
// own equation gives, for Ts that is linear in the cell: with n = H l/(G c)
// and b = n/(exp(n) - 1),
//
//     Tf = b Tg + (1 - b) Ts + (1/2 - (1 - b)/n) s,
//
// where s is the limited change of Ts over the cell, from the differences on
// both sides such that Tf is exact for Ts of second degree. All weights are
// positive: for small n it is the scheme of Lax and Wendroff, for large n the
// upwind-biased one of third order for Ts. The storage of the gas counts as
// exchange with the gas at the stage's start. With dispersion the scheme is
// central as far as that is positive.
//
// What a cell lacks of a balance of mass (rounding, or an equation of the
// pressure that did not converge) carries its own temperature.

namespace Foam
{

//- n above which the exponential of it is beyond all numbers
static const scalar mostUnits = 500;

//- n below which b and what follows from it are series
static const scalar fewUnits = 0.01;

//- Slope of a cell that has no neighbour upstream
static const scalar none = VGREAT;

//- Factor of the difference downstream that gives the slope of a cell: with
//- this share of it and the rest of the difference upstream, as far as the
//- profile stays monotone (as by Koren, Notes Numer. Fluid Mech. 45, 117, 1993)
static scalar limited
(
    const scalar upstream,
    const scalar downstream,
    const scalar share
)
{
    // The front is not in this cell yet
    if (downstream == 0)
    {
        return 1;
    }
    if (upstream*downstream <= 0)
    {
        return 0;
    }
    const scalar r = upstream/downstream;
    return min(min(scalar(2), 2*r), share + (1 - share)*r);
}

//- Unit vector; 0 of a vector that is 0
static vector unitVector(const vector& G)
{
    return G/max(mag(G), VSMALL);
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::bedFlow::findSlopes
(
    const volScalarField& field,
    volScalarField& slope
)
{
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const vectorField& C = mesh_.C();
    // Least squares: faces between cells at the same place along the flow,
    // as in triangles, say nothing of the slope
    scalarField sum(field.size(), Zero), squares(field.size(), Zero);
    const auto add = [&]
    (
        const label to, const scalar m, const scalar rise, const scalar x
    )
    {
        sum[to] += m*rise*x;
        squares[to] += m*x*x;
    };
    forAll(owner, facei)
    {
        const scalar m = flux_[facei];
        const label U = m > 0 ? owner[facei] : neighbour[facei];
        const label D = m > 0 ? neighbour[facei] : owner[facei];
        if (m != 0)
        {
            add
            (
                D, mag(m), field[D] - field[U],
                mag((C[D] - C[U]) & unitVector(massFlux_[D]))
            );
        }
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (!patch.coupled())
        {
            continue;
        }
        const vectorField delta(patch.delta());
        const scalarField beyond
        (
            field.boundaryField()[patchi].patchNeighbourField()
        );
        const labelUList& cells = patch.faceCells();
        forAll(cells, facei)
        {
            const scalar m = flux_.boundaryField()[patchi][facei];
            if (m < 0)
            {
                add
                (
                    cells[facei], -m, field[cells[facei]] - beyond[facei],
                    mag(delta[facei] & unitVector(massFlux_[cells[facei]]))
                );
            }
        }
    }
    // In the first cells the gas that enters is what lies upstream
    atInlet_.primitiveFieldRef() = 0;
    for (const port& each : ports_)
    {
        const scalarField& m = flux_.boundaryField()[each.patch];
        const vectorField& Cf = mesh_.Cf().boundaryField()[each.patch];
        forAll(m, facei)
        {
            if (m[facei] < 0)
            {
                const label P = mesh_.boundary()[each.patch].faceCells()[facei];
                atInlet_[P] = 1;
                add
                (
                    P, -m[facei], field[P] - temperatureAt(each),
                    mag((C[P] - Cf[facei]) & unitVector(massFlux_[P]))
                );
            }
        }
    }
    forAll(slope, celli)
    {
        slope[celli] =
            squares[celli] > 0 ? sum[celli]/squares[celli] : none;
    }
    if (coupled_)
    {
        slope.correctBoundaryConditions();
        atInlet_.correctBoundaryConditions();
    }
}


Foam::granularFlows::bedFlow::cellValues
Foam::granularFlows::bedFlow::valuesOf(const label P) const
{
    return
    {
        exchange_[P], storage_[P], start_[P], gasT_[P], T_[P],
        bedThen_[P], startThen_[P], bedSlope_[P], startSlope_[P],
        diffusionAlong_[P], diffusionAcross_[P], atInlet_[P], massFlux_[P]
    };
}


Foam::List<Foam::granularFlows::bedFlow::cellValues>
Foam::granularFlows::bedFlow::valuesBeyond(const label patchi) const
{
    const auto beyond = [patchi](const volScalarField& field)
    {
        return field.boundaryField()[patchi].patchNeighbourField();
    };
    const scalarField exchange(beyond(exchange_)), storage(beyond(storage_));
    const scalarField start(beyond(start_)), gas(beyond(gasT_)), bed(beyond(T_));
    const scalarField bedThen(beyond(bedThen_)), startThen(beyond(startThen_));
    const scalarField bedSlope(beyond(bedSlope_));
    const scalarField startSlope(beyond(startSlope_));
    const scalarField along(beyond(diffusionAlong_));
    const scalarField across(beyond(diffusionAcross_));
    const scalarField atInlet(beyond(atInlet_));
    const vectorField G
    (
        massFlux_.boundaryField()[patchi].patchNeighbourField()
    );
    List<cellValues> result(gas.size());
    forAll(result, i)
    {
        result[i] =
        {
            exchange[i], storage[i], start[i], gas[i], bed[i], bedThen[i],
            startThen[i], bedSlope[i], startSlope[i], along[i], across[i],
            atInlet[i], G[i]
        };
    }
    return result;
}


Foam::granularFlows::bedFlow::weights
Foam::granularFlows::bedFlow::reconstruct
(
    const cellValues& U,
    const cellValues* D,
    const scalar length,
    const scalar distance
) const
{
    const scalar carried = mag(U.G)*gas_.capacity(U.gas);
    scalar b = 0, kappa = 0.5, bedShare = 1, share = 2.0/3;
    if (!single_)
    {
        const scalar rate = U.exchange + U.storage;
        const scalar n = min(rate*length/carried, mostUnits);
        const bool few = n < fewUnits;
        b = few ? 1 - n/2 + n*n/12*(1 - n*n/60) : n/std::expm1(n);
        kappa = few ? n/12*(1 - n*n/60) : 0.5 - (1 - b)/n;
        // For Ts of second degree in the cell
        share = 0.5
          + (few ? n/60 : (1.0/12 - (0.5 - (1 - b)/n)/n)/kappa);
        bedShare = rate > 0 ? U.exchange/rate : 1;
    }
    const scalar startShare = 1 - bedShare;
    weights w;
    w.gasU = b;
    w.bedU = (1 - b)*bedShare;
    w.given = (1 - b)*startShare*U.start;
    if (!D)
    {
        const auto rise = [length](const scalar slope)
        {
            return slope == none ? 0 : length*slope;
        };
        w.given += kappa
           *(bedShare*rise(U.bedSlope) + startShare*rise(U.startSlope));
        return w;
    }
    const auto change = [&](const scalar slope, const scalar rise)
    {
        const scalar psi =
            slope == none ? 1
          : U.atInlet > 0 ? min(scalar(1), limited(slope*distance, rise, 1))
          : limited(slope*distance, rise, share);
        return kappa*min(scalar(2), psi*length/distance);
    };
    const scalar ofBed = bedShare*change(U.bedSlope, D->bedThen - U.bedThen);
    w.bedU -= ofBed;
    w.bedD = ofBed;
    w.given += startShare*change(U.startSlope, D->startThen - U.startThen)
       *(D->start - U.start);

    if (single_)
    {
        return w;
    }
    // Central as far as dispersion keeps that monotone
    const scalar half = min(scalar(1), 0.5*length/distance);
    const scalar diffusion = (1 - half)*U.along + half*D->along;
    const scalar central = min(scalar(1), 2*diffusion/(carried*length));
    for (scalar* each : {&w.gasU, &w.bedU, &w.bedD, &w.given})
    {
        *each *= 1 - central;
    }
    w.gasU += central*(1 - half);
    w.gasD += central*half;
    return w;
}


Foam::granularFlows::bedFlow::convection
Foam::granularFlows::bedFlow::carry
(
    const cellValues& U,
    const cellValues* D,
    const scalar flux,
    const vector& toFace,
    const vector& toD
) const
{
    const vector e(unitVector(U.G));
    const scalar length = max(2*mag(toFace & e), VSMALL);
    const scalar distance = max(mag(toD & e), VSMALL);
    convection result;
    result.w = reconstruct(U, D, length, distance);
    weights& w = result.w;
    result.T =
        w.gasU*U.gas + w.bedU*U.bed + w.given
      + (D ? w.gasD*D->gas + w.bedD*D->bed : 0);
    const scalar c = gas_.capacity(result.T);
    // h(Tf) by Newton's method
    w.given += gas_.enthalpy(result.T)/c - result.T;
    for (scalar* each : {&w.gasU, &w.bedU, &w.gasD, &w.bedD, &w.given})
    {
        *each *= flux*c;
    }
    return result;
}


Foam::granularFlows::bedFlow::convection
Foam::granularFlows::bedFlow::leave(const label patchi, const label facei) const
{
    const fvPatch& patch = mesh_.boundary()[patchi];
    const label P = patch.faceCells()[facei];
    const vector toFace(patch.Cf()[facei] - mesh_.C()[P]);
    return carry
    (
        valuesOf(P), nullptr, mag(flux_.boundaryField()[patchi][facei]), toFace,
        2*toFace
    );
}


// ************************************************************************* //
