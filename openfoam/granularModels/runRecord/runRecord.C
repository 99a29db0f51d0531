/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
     \\/     M anipulation  |
-------------------------------------------------------------------------------
License
    SPDX-License-Identifier: GPL-3.0-or-later

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty: see the file LICENSE.
\*---------------------------------------------------------------------------*/

#include "runRecord.H"
#include "dictionary.H"
#include "Time.H"
#include "ListOps.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(runRecord, 0);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::runRecord::runRecord(const fvMesh& mesh, const bool registered)
:
    regIOobject
    (
        IOobject
        (
            "msddFoam",
            mesh.time().timeName(),
            "uniform",
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE,
            registered
        )
    ),
    heat(mesh.boundary().size(), Zero)
{
    if (headerOk())
    {
        const dictionary dict(readStream(typeName));
        close();
        dict.readEntry("nextDeltaT", nextDeltaT);
        dict.readEntry("sourceHeat", sourceHeat);
        dict.readEntry("exchanged", exchanged);
        dict.readEntry("initialMass", initialMass);
        const dictionary& patches = dict.subDict("heat");
        forAll(heat, patchi)
        {
            // Patches between processes are not there in a serial run
            patches.readIfPresent(mesh.boundary()[patchi].name(), heat[patchi]);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::runRecord::writeData(Ostream& os) const
{
    const int precision = os.precision(17);
    const fvMesh& mesh = refCast<const fvMesh>(db());

    os.writeEntry("nextDeltaT", nextDeltaT);
    os.writeEntry("sourceHeat", sourceHeat);
    os.writeEntry("exchanged", exchanged);
    os.writeEntry("initialMass", initialMass);
    os.beginBlock("heat");
    forAll(heat, patchi)
    {
        os.writeEntry(mesh.boundary()[patchi].name(), heat[patchi]);
    }
    os.endBlock();
    os.precision(precision);
    return os.good();
}


// ************************************************************************* //
