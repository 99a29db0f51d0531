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

#include "solverObjects.H"
#include "caseChecks.H"
#include "regionObjects.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solverObjects::solverObjects(Time& runTime)
:
    runTime_(runTime)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::solverObjects::makeMesh()
{
    Info<< "Create mesh for time = " << runTime_.timeName() << nl << endl;
    mesh = regionObjects::readMesh(runTime_, fvMesh::defaultRegion);
}


void Foam::solverObjects::makeProperties()
{
    properties.reset(new granularProperties(runTime_));
}


void Foam::solverObjects::makeNeighbours()
{
    neighbours.reset(new neighbourSolids(runTime_));
}


void Foam::solverObjects::checkMesh() const
{
    runRecord::checkMesh(mesh());
    checkPlane(mesh(), properties->surrogateDict());
}


void Foam::solverObjects::makeT()
{
    Info<< "Reading field T\n" << endl;
    T.reset
    (
        new volScalarField
        (
            IOobject
            (
                "T", runTime_.timeName(), mesh(),
                IOobject::MUST_READ, IOobject::AUTO_WRITE
            ),
            mesh()
        )
    );
}


void Foam::solverObjects::makeGrains()
{
    grains.reset(new granularState(properties(), T()));
}


void Foam::solverObjects::makeMechanics()
{
    mechanics = granularMechanics::New(properties(), grains());
    grains->warm(T(), [this]() { mechanics->solve(true); });
}


void Foam::solverObjects::makeScheme()
{
    scheme =
        timeScheme::New
        (
            T(), grains(), mechanics(), neighbours(), properties()
        );
}


void Foam::solverObjects::makeAll()
{
    makeMesh();
    makeProperties();
    makeNeighbours();
    checkMesh();
    makeT();
    makeGrains();
    makeMechanics();
    makeScheme();
}


// ************************************************************************* //
