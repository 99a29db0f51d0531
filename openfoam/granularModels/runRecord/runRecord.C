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
#include "timeFolder.H"
#include "granularModel.H"
#include "OStringStream.H"
#include "ListOps.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(runRecord, 0);
}

Foam::wordHashSet Foam::runRecord::accepted;


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
            IOobject::NO_READ,
            IOobject::NO_WRITE,
            registered
        )
    ),
    mesh_(mesh),
    heat(mesh.boundary().size(), Zero),
    startTime(mesh.time().startTime().value())
{
    const timeFolder folder(mesh.time().timePath()/mesh.dbDir());
    if (returnReduce(folder.hasRecord(), andOp<bool>()))
    {
        read(folder);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::runRecord::read(const timeFolder& folder)
{
    const dictionary& dict = folder.record();
    continues = true;
    dict.readEntry("nextDeltaT", nextDeltaT);
    dict.readEntry("initialMass", initialMass);
    dict.readIfPresent("startHeat", startHeat);
    dict.readIfPresent("lastDeltaT", lastDeltaT);
    dict.readIfPresent("startTime", startTime);
    dict.readIfPresent("leastT", leastT);
    dict.readIfPresent("mostT", mostT);
    course.read(dict.subOrEmptyDict("course"));
    scheme = dict.lookupOrDefault<word>("timeScheme", word::null);
    settings_ = dict.subOrEmptyDict("settings");

    // Each process continues with the sums that it wrote. If the number of
    // processes has changed, the master continues with the sums over all
    bool others = folder.redistributed() && dict.found("allHeat");
    reduce(others, orOp<bool>());
    if (others && !Pstream::master())
    {
        return;
    }
    dict.readEntry(others ? "allSourceHeat" : "sourceHeat", sourceHeat);
    dict.readEntry(others ? "allExchanged" : "exchanged", exchanged);
    const dictionary& patches = dict.subDict(others ? "allHeat" : "heat");
    forAll(heat, patchi)
    {
        // Patches between processes exchange no heat with the outside
        patches.readIfPresent(mesh_.boundary()[patchi].name(), heat[patchi]);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::runRecord::compare(const dictionary& settings)
{
    const dictionary before(settings_);
    settings_ = settings;

    for (const entry& item : before)
    {
        const string was(before.get<string>(item.keyword()));
        const string is
        (
            settings.lookupOrDefault<string>(item.keyword(), string("absent"))
        );
        if (is == was)
        {
            continue;
        }
        if (!accepted.found(item.keyword()))
        {
            FatalErrorInFunction
                << "Setting '" << item.keyword() << "' is " << is.c_str()
                << ", but time " << mesh_.time().timeName() << " in "
                << mesh_.time().path() << " was computed with " << was.c_str()
                << ". Allowed: the same; the case's Allclean, to begin anew; or"
                << " msddFoam -accept " << item.keyword()
                << ", to go on from this time with the new value"
                << exit(FatalError);
        }
        Info<< "Accepted: " << item.keyword() << " changes from " << was.c_str()
            << " to " << is.c_str() << nl;
    }
}


void Foam::runRecord::findFiles()
{
    files_ = fileNameList(1, fileName("uniform/time"));
    for (const word& region : mesh_.time().sortedNames<fvMesh>())
    {
        const fvMesh& mesh = mesh_.time().lookupObject<fvMesh>(region);
        for (const word& name : mesh.thisDb().sortedNames())
        {
            const regIOobject& object =
                mesh.thisDb().lookupObject<regIOobject>(name);
            if
            (
                object.writeOpt() == IOobject::AUTO_WRITE
             && object.instance() == mesh_.time().timeName()
            )
            {
                files_.append(mesh.dbDir()/object.local()/name);
            }
        }
    }
}


void Foam::runRecord::writeLast()
{
    instance() = mesh_.time().timeName();
    OStringStream os;
    os.precision(17);
    writeHeader(os, "dictionary");
    os.writeEntry("program", string(granularModel::libraryVersion()));
    os.writeEntry("time", mesh_.time().value());
    os.writeEntry("startTime", startTime);
    os.writeEntry("processes", Pstream::parRun() ? Pstream::nProcs() : 1);
    os.writeEntry("process", Pstream::myProcNo());
    os.writeEntry("timeScheme", scheme);
    settings_.writeEntry("settings", os);
    os.writeEntry("lastDeltaT", lastDeltaT);
    os.writeEntry("nextDeltaT", nextDeltaT);
    os.writeEntry("leastT", leastT);
    os.writeEntry("mostT", mostT);
    os.writeEntry("initialMass", initialMass);
    os.writeEntry("startHeat", startHeat);
    course.written().writeEntry("course", os);
    os.writeEntry("sourceHeat", sourceHeat);
    os.writeEntry("exchanged", exchanged);

    // The same sums over all processes. Patches that are not between processes
    // exist on all of them, in the same order
    const label patches = mesh_.boundaryMesh().nNonProcessor();
    scalarList all(patches + 2);
    for (label patchi = 0; patchi < patches; ++patchi)
    {
        all[patchi] = heat[patchi];
    }
    all[patches] = sourceHeat;
    all[patches + 1] = exchanged;
    Pstream::listCombineGather(all, plusEqOp<scalar>());
    Pstream::listCombineScatter(all);
    os.writeEntry("allSourceHeat", all[patches]);
    os.writeEntry("allExchanged", all[patches + 1]);

    for (const scalarList* values : {&heat, &all})
    {
        os.beginBlock(values == &all ? "allHeat" : "heat");
        for (label patchi = 0; patchi < patches; ++patchi)
        {
            os.writeEntry(mesh_.boundary()[patchi].name(), (*values)[patchi]);
        }
        os.endBlock();
    }

    timeFolder::write
    (
        mesh_.time().timePath()/mesh_.dbDir(), files_, os.str()
    );
}


// ************************************************************************* //
