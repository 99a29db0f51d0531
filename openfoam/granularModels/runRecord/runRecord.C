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

#include "runRecord.H"
#include "timeFolder.H"
#include "meshNumbers.H"
#include "granularModel.H"
#include "fileOperation.H"
#include "OStringStream.H"
#include "ListOps.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(runRecord, 0);
}

Foam::wordHashSet Foam::runRecord::accepted;
Foam::string Foam::runRecord::acceptedIn;
Foam::DynamicList<Foam::string> Foam::runRecord::notes;


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
    files_(1, fileName("uniform/time")),
    heat(mesh.boundary().size(), Zero),
    startTime(mesh.time().startTime().value())
{
    const timeFolder folder(mesh.time().timePath(), mesh.dbDir());
    if (returnReduce(folder.hasRecord(), andOp<bool>()))
    {
        readFrom(folder);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::runRecord::readFrom(const timeFolder& folder)
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
    dict.readIfPresent("flow", flow);
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


void Foam::runRecord::add(const fvMesh& mesh, const bool own)
{
    meshes_.add(mesh.name(), meshNumbers(mesh).dict());
    for (const word& name : mesh.thisDb().sortedNames())
    {
        regIOobject& object = mesh.thisDb().lookupObjectRef<regIOobject>(name);
        if
        (
            object.writeOpt() == IOobject::AUTO_WRITE
         && object.instance() == mesh_.time().timeName()
        )
        {
            files_.append(mesh.dbDir()/object.local()/name);
            if (own)
            {
                object.writeOpt() = IOobject::NO_WRITE;
                fields_.append(&object);
            }
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::runRecord::note(const string& sentence)
{
    Info<< sentence.c_str() << nl << endl;
    notes.append(sentence);
}


Foam::string Foam::runRecord::toAccept(const word& name)
{
    return
        acceptedIn.empty()
      ? string("msddFoam -accept " + name)
      : string("the entry 'accept (" + name + ");' in " + acceptedIn);
}


void Foam::runRecord::checkMesh(const fvMesh& mesh, const fileName& region)
{
    if (fileHandler().type() != "uncollated")
    {
        FatalErrorInFunction
            << "File handler is '" << fileHandler().type()
            << "', allowed: uncollated. What belongs to a time is checked file"
            << " by file" << exit(FatalError);
    }
    const timeFolder folder(mesh.time().timePath(), region);
    const dictionary meshes(folder.record().subOrEmptyDict("meshes"));
    if (!returnReduce(meshes.found(mesh.name()), andOp<bool>()))
    {
        return;
    }
    const meshNumbers before(meshes.subDict(mesh.name())), now(mesh);
    const string difference
    (
        now.difference
        (
            before, returnReduce(folder.redistributed(), orOp<bool>())
        )
    );
    const bool taken =
        accepted.found("mesh") && now.cells() == before.cells();
    if (difference.empty())
    {
        return;
    }
    if (!taken)
    {
        FatalErrorInFunction
            << "The mesh in " << (mesh.time().constant()/mesh.meshDir()).c_str()
            << " is not that on which time " << mesh.time().timeName() << " in "
            << mesh.time().path() << " was computed: " << difference.c_str()
            << ". Allowed: that mesh; the case's Allclean, to begin anew; or "
            << (
                   now.cells() == before.cells()
                 ? toAccept("mesh") + ", to take the values cell by cell"
                 : string("mapFields, to take fields to another mesh")
               ).c_str()
            << exit(FatalError);
    }
    note
    (
        "Accepted: another mesh in "
      + string(mesh.time().constant()/mesh.meshDir()) + ": " + difference
      + ". Its cells got the values of the cells with the same numbers."
    );
}


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
                << ". Allowed: the same; the case's Allclean, to begin anew; or "
                << toAccept(item.keyword()).c_str()
                << ", to go on from this time with the new value"
                << exit(FatalError);
        }
        note
        (
            "Accepted: " + item.keyword() + " changes from " + was + " to " + is
          + " at time " + mesh_.time().timeName() + "."
        );
    }
}


void Foam::runRecord::findFiles()
{
    for (const word& region : mesh_.time().sortedNames<fvMesh>())
    {
        add(mesh_.time().lookupObject<fvMesh>(region), false);
    }
}


void Foam::runRecord::writeRegion()
{
    add(mesh_, true);
    writeOpt() = IOobject::AUTO_WRITE;
}


bool Foam::runRecord::writeObject
(
    MSDD_WRITE_PARAMETERS
) const
{
    bool ok = true;
    for (const regIOobject* field : fields_)
    {
        ok = field->writeObject(MSDD_WRITE_ARGUMENTS) && ok;
    }
    const_cast<runRecord&>(*this).writeLast();
    return ok;
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
    if (!scheme.empty())
    {
        os.writeEntry("timeScheme", scheme);
    }
    settings_.writeEntry("settings", os);
    meshes_.writeEntry("meshes", os);
    os.writeEntry("lastDeltaT", lastDeltaT);
    os.writeEntry("nextDeltaT", nextDeltaT);
    os.writeEntry("leastT", leastT);
    os.writeEntry("mostT", mostT);
    os.writeEntry("initialMass", initialMass);
    os.writeEntry("startHeat", startHeat);
    course.written().writeEntry("course", os);
    if (flow.size())
    {
        os.writeEntry("flow", flow);
    }
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
    fromMaster(all);
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
        mesh_.time().timePath(), mesh_.dbDir(), files_, os.str()
    );
}


// ************************************************************************* //
