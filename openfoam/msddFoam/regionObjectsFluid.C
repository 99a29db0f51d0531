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

#include "regionObjects.H"
#include "convectionScheme.H"
#include "findRefCell.H"
#include "pressureControl.H"
#include "surfaceInterpolate.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::regionObjects::frozenFlow() const
{
    return pimple().getOrDefault("frozenFlow", false);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::regionObjects::makeFlow()
{
    rho_.reset
    (
        new volScalarField
        (
            IOobject("rho", runTime_.timeName(), *mesh_), fluid_->rho()
        )
    );
    U_.reset(new volVectorField(io("U"), *mesh_));
    IOobject flux(io("phi"));
    flux.readOpt() = IOobject::READ_IF_PRESENT;
    phi_.reset
    (
        new surfaceScalarField
        (
            flux, linearInterpolate(rho_()*U_()) & mesh_->Sf()
        )
    );
    rotation_.reset(new IOMRFZoneList(*mesh_));
}


void Foam::regionObjects::makePressure()
{
    p_rgh_.reset(new volScalarField(io("p_rgh"), *mesh_));
    mesh_->setFluxRequired("p_rgh");
    const pressureControl limits(fluid_->p(), rho_(), pimple(), false);
    if (p_rgh_->needReference())
    {
        label cell = -1;
        scalar value = 0;
        setRefCell(fluid_->p(), p_rgh_(), pimple(), cell, value);
    }
}


void Foam::regionObjects::readTurbulence() const
{
    const IOdictionary dict
    (
        IOobject
        (
            "turbulenceProperties", runTime_.constant(), *mesh_,
            IOobject::MUST_READ, IOobject::NO_WRITE, false
        )
    );
    const word type(dict.get<word>("simulationType"));
    const wordList types({"laminar", "RAS", "LES"});
    if (!types.found(type))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'simulationType' is '" << type << "', allowed: "
            << granularProperties::listed(types).c_str() << exit(FatalIOError);
    }
    if (type == "laminar")
    {
        return;
    }
    for (const word field : {"k", "epsilon", "omega", "nuTilda", "nut", "alphat"})
    {
        if (hasField(field))
        {
            readScalar(field);
        }
    }
}


void Foam::regionObjects::findSchemes() const
{
    const word energy(fluid_->he().name());
    wordList names({"div(phi," + energy + ")", "div(phi,K)"});
    if (energy == "e")
    {
        mesh_->divScheme("div(phiv,p)");
    }
    for (const word& name : names)
    {
        fv::convectionScheme<scalar>::New(*mesh_, phi_(), mesh_->divScheme(name));
    }
    if (!frozenFlow())
    {
        fv::convectionScheme<vector>::New
        (
            *mesh_, phi_(), mesh_->divScheme("div(phi,U)")
        );
    }
}


// ************************************************************************* //
