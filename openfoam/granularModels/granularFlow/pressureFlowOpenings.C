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
#include "OStringStream.H"
#include "addToRunTimeSelectionTable.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "regionSplit.H"
#include "simpleMatrix.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::pressure::readOpenings()
{
    const dictionary& all = dict_.subDict("openings");
    label given = 0;
    for (const entry& item : all)
    {
        if (!item.isDict())
        {
            FatalIOErrorInFunction(all)
                << "Entry '" << item.keyword() << "' of 'openings' is no"
                << " patch with braces, allowed: "
                << granularProperties::listed(mesh_.boundaryMesh().names())
                   .c_str()
                << exit(FatalIOError);
        }
        const dictionary& dict = item.dict();
        openingKeys.check(dict);
        ports_.append(readPort(item.keyword(), dict));
        const port& end = ports_.last();
        const fvPatch& patch = mesh_.boundary()[end.patch];
        if (patch.coupled() || polyPatch::constraintType(patch.type()))
        {
            FatalIOErrorInFunction(all)
                << "Opening '" << end.name << "' is a patch of the type "
                << patch.type() << ", allowed: patch, wall"
                << exit(FatalIOError);
        }
        openings_.append(new opening);
        opening& made = openings_.last();
        for (const word key : {"massFlow", "pressure"})
        {
            if (dict.found(key))
            {
                (key == "pressure" ? made.pressure : made.massFlow) =
                    Function1<scalar>::New(key, dict);
            }
        }
        if (made.massFlow.valid() && made.pressure.valid())
        {
            FatalIOErrorInFunction(dict)
                << "Entries 'massFlow' and 'pressure' of the opening "
                << end.name << " are both given, allowed: one of them"
                << exit(FatalIOError);
        }
        given += !made.massFlow.valid();
        for (const scalar t : looks())
        {
            checkTemperature
            (
                end, t, made.massFlow.valid() ? made.massFlow->value(t) : 0
            );
            const scalar p =
                made.pressure.valid() ? made.pressure->value(t) : 1;
            if (!(p > 0))
            {
                FatalIOErrorInFunction(dict)
                    << "Entry 'pressure' of the opening " << end.name << " is "
                    << p << " at time " << t << ", allowed: > 0"
                    << exit(FatalIOError);
            }
        }
        const vector middle
        (
            gSum(patch.magSf()*patch.Cf())/gSum(patch.magSf())
        );
        made.height = (patch.Cf() - middle) & properties_.gravity();
    }
    if (!given && openings_.size())
    {
        FatalIOErrorInFunction(all)
            << "Each of the " << openings_.size() << " openings has a massFlow,"
            << " allowed: at least one without, whose pressure is given"
            << exit(FatalIOError);
    }
}


void Foam::granularFlows::pressure::checkParts() const
{
    const regionSplit parts(mesh_);
    boolList given(parts.nRegions(), false);
    forAll(openings_, i)
    {
        if (!openings_[i].massFlow.valid())
        {
            const fvPatch& patch = mesh_.boundary()[ports_[i].patch];
            for (const label celli : patch.faceCells())
            {
                given[parts[celli]] = true;
            }
        }
    }
    Pstream::listCombineGather(given, orEqOp<bool>());
    fromMaster(given);
    if (given.found(false) && (given.size() > 1 || openings_.size()))
    {
        FatalErrorInFunction
            << "The mesh has " << given.size() << " parts that are not"
            << " connected, and in one of them no opening has a given pressure,"
            << " allowed: each has such an opening, or one part without openings"
            << exit(FatalError);
    }
}


Foam::scalarField Foam::granularFlows::pressure::psiOf
(
    const label openingi
) const
{
    const opening& each = openings_[openingi];
    const scalar T = temperatureAt(ports_[openingi]);
    const scalar p = gas_.pressure() + toGauge(each.psi);
    const scalar rho = gas_.density(T, p);
    return
        each.psi + (gas_.compressible() ? p : rho)*rho*each.height;
}


void Foam::granularFlows::pressure::setOpenings()
{
    const scalar t = mesh_.time().value();
    forAll(openings_, i)
    {
        opening& each = openings_[i];
        if (each.massFlow.valid())
        {
            each.flow = each.massFlow->value(t);
        }
        else
        {
            each.psi =
                each.pressure.valid()
              ? toPsi(each.pressure->value(t) - gas_.pressure()) : 0;
        }
    }
}


Foam::scalarList Foam::granularFlows::pressure::openingPsi() const
{
    scalarList result(openings_.size());
    forAll(result, i)
    {
        result[i] = openings_[i].psi;
    }
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularFlows::pressure::addLoads(loadHistories& loads)
{
    for (const opening& each : openings_)
    {
        for (const auto* function : {&each.massFlow, &each.pressure})
        {
            if (function->valid())
            {
                loads.add((*function)());
            }
        }
    }
    bedFlow::addLoads(loads);
}


// ************************************************************************* //
