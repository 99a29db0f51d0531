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
#include "foamVersions.H"
#include "fvcSurfaceIntegrate.H"
#include "OFstream.H"

#include <cmath>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

const Foam::granularFlows::bedFlow::rates&
Foam::granularFlows::bedFlow::heatNow() const
{
    if (lastTau_ == 0)
    {
        return last_;
    }
    scalarList all(sums, Zero);
    const scalarField& V = mesh_.V();
    forAll(V, celli)
    {
        const scalar heat =
            V[celli]*exchange_[celli]*(gasT_[celli] - T_[celli]);
        all[toBed] += heat;
        all[exchanged] += mag(heat);
        all[held] +=
            V[celli]*pores_[celli]/lastTau_
           *(gas_.stored(gasT_[celli]) - stage_[celli]);
    }
    for (const port& each : ports_)
    {
        const scalarField& m = flux_.boundaryField()[each.patch];
        forAll(m, facei)
        {
            if (m[facei] < 0)
            {
                const scalar T = temperatureAt(each);
                all[entered] -= m[facei]*gas_.enthalpy(T);
                all[inward] -= m[facei];
                all[mixedInward] -= m[facei]*T;
            }
            else if (m[facei] > 0)
            {
                const scalar T = leave(each.patch, facei).T;
                all[left] += m[facei]*gas_.enthalpy(T);
                all[outward] += m[facei];
                all[mixedOutward] += m[facei]*T;
            }
        }
    }
    const vesselWalls::rates walls(walls_->heat(gasT_, T_));
    all[gasToWall] = walls.fromGas;
    all[bedToWall] = walls.fromBed;
    all[lost] = walls.lost;
    all[heldByWall] = walls.stored;
    all[gasToSolids] = walls.gasToSolids;
    all[bedToSolids] = walls.bedToSolids;
    Pstream::listCombineGather(all, plusEqOp<scalar>());
    fromMaster(all);
    if (single_)
    {
        all[toBed] = all[entered] - all[left] - all[held] - all[gasToWall];
    }
    lastTau_ = 0;
    last_.heat = all;
    last_.inletT = all[inward] > 0 ? all[mixedInward]/all[inward] : 0;
    last_.outletT = all[outward] > 0 ? all[mixedOutward]/all[outward] : 0;
    return last_;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::granularFlows::bedFlow::heat() const
{
    const scalarList& now = heatNow().heat;
    return
        Pstream::master()
      ? now[toBed] - now[bedToWall] + now[bedToSolids] : 0;
}


Foam::scalar Foam::granularFlows::bedFlow::toSolids() const
{
    return Pstream::master() ? heatNow().heat[gasToSolids] : 0;
}


void Foam::granularFlows::bedFlow::received(const scalar heat)
{
    heatNow();
    last_.heat[toBed] = heat + last_.heat[bedToWall];
}


void Foam::granularFlows::bedFlow::finish
(
    const scalar deltaT,
    const scalar share
)
{
    const scalarList& last = heatNow().heat;
    scalarList& all = grains_.record().flow;
    scalarList step(heats);
    forAll(step, i)
    {
        const scalar first = share < 1 ? first_.heat[i] : 0;
        step[i] = deltaT*((1 - share)*first + share*last[i]);
    }
    for (label i = 0; i < passed; ++i)
    {
        all[i] += step[i];
    }
    all[passed] +=
        mag(step[entered] - step[left]) + max(step[exchanged], mag(step[toBed]))
      + mag(step[bedToWall]);
    observe();
}


// ************************************************************************* //
