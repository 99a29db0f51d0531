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
#include "foamVersions.H"
#include "granularSolidThermo.H"
#include "mappedPatchBase.H"
#include "caseWarnings.H"
#include "fvmDdt.H"
#include "fvmLaplacian.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The type of the thermo of beds. msddFoam is not linked to its library: a
//- case has to name it in libs
static const word bedThermo("granularSolidThermo");


static string listedNames(const PtrList<regionObjects>& all)
{
    wordList names;
    for (const regionObjects& region : all)
    {
        names.append(region.name());
    }
    return granularProperties::listed(names);
}


static const regionObjects* find
(
    const PtrList<regionObjects>& all,
    const word& name
)
{
    for (const regionObjects& region : all)
    {
        if (region.name() == name)
        {
            return &region;
        }
    }
    return nullptr;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::regionObjects::regionObjects
(
    const Time& runTime,
    const word& name,
    const bool isFluid
)
:
    runTime_(runTime),
    name_(name),
    isFluid_(isFluid),
    isReady_(false)
{}


Foam::regionObjects::~regionObjects()
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::IOobject Foam::regionObjects::io(const word& field) const
{
    return IOobject
    (
        field, runTime_.timeName(), *mesh_,
        IOobject::MUST_READ, IOobject::NO_WRITE
    );
}


const Foam::dictionary& Foam::regionObjects::pimple() const
{
    return mesh_->solutionDict().subDict("PIMPLE");
}


Foam::label Foam::regionObjects::number
(
    const word& key,
    const label deflt
) const
{
    return pimple().getOrDefault<label>(key, deflt);
}


// * * * * * * * * * * * * * Static Member Functions * * * * * * * * * * * * //

Foam::autoPtr<Foam::fvMesh> Foam::regionObjects::readMesh
(
    const Time& runTime,
    const word& name
)
{
    const bool alone = name == fvMesh::defaultRegion;
    const fileName local
    (
        alone ? fileName(polyMesh::meshSubDir) : name/polyMesh::meshSubDir
    );
    const fileName folder
    (
        runTime.findInstance(local, "faces", IOobject::READ_IF_PRESENT)/local
    );
    if (!isFile(runTime.path()/folder/"faces"))
    {
        const string of(alone ? string() : string(" -region " + name));
        FatalErrorInFunction
            << "There is no mesh in " << (runTime.path()/folder).c_str()
            << ": run blockMesh" << of.c_str()
            << ", or what makes the mesh of this case"
            << (Pstream::parRun() ? ", then decomposePar" : "")
            << (Pstream::parRun() ? of.c_str() : "") << exit(FatalError);
    }
    return autoPtr<fvMesh>
    (
        new fvMesh
        (
            IOobject(name, runTime.timeName(), runTime, IOobject::MUST_READ)
        )
    );
}


// * * * * * * * * * * * * * * * * * Access  * * * * * * * * * * * * * * * * //

Foam::basicThermo& Foam::regionObjects::thermo()
{
    if (isFluid_)
    {
        return *fluid_;
    }
    return *solid_;
}


bool Foam::regionObjects::isBed() const
{
    const IOdictionary dict
    (
        IOobject
        (
            basicThermo::dictName, runTime_.constant(), name_, runTime_,
            IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false
        )
    );
    const entry* type = dict.findEntry("thermoType");
    return type && type->isStream() && dict.get<word>("thermoType") == bedThermo;
}


bool Foam::regionObjects::hasField(const word& field) const
{
    return io(field).typeHeaderOk<IOdictionary>(false);
}


bool Foam::regionObjects::isReady(const PtrList<regionObjects>& all) const
{
    if (!isReady_)
    {
        return false;
    }
    for (const polyPatch& patch : mesh_->boundaryMesh())
    {
        if (isA<mappedPatchBase>(patch))
        {
            const regionObjects* other =
                find(all, refCast<const mappedPatchBase>(patch).sampleRegion());
            if (!other || !other->isReady_)
            {
                return false;
            }
        }
    }
    return true;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::regionObjects::makeMesh()
{
    Info<< "Create mesh of region " << name_ << endl;
    mesh_ = readMesh(runTime_, name_);
}


void Foam::regionObjects::makeThermo()
{
    if (isFluid_)
    {
        fluid_ = rhoReactionThermo::New(*mesh_);
        fluid_->validate("chtMultiRegionFoam", "h", "e");
    }
    else
    {
        solid_ = solidThermo::New(*mesh_);
    }
}


void Foam::regionObjects::forgetThermo()
{
    // The end of a bed compares processes
    fluid_.release();
    solid_.release();
}


void Foam::regionObjects::readScalar(const word& field) const
{
    const volScalarField alone
    (
        IOobject
        (
            field, runTime_.timeName(), *mesh_,
            IOobject::MUST_READ, IOobject::NO_WRITE, false
        ),
        *mesh_
    );
}


void Foam::regionObjects::readGrains() const
{
    const granularProperties properties(*mesh_);
    granularModel::New(properties, *mesh_);
}


void Foam::regionObjects::makeRadiation()
{
    // The model itself is not among the headers. Its source of heat makes it
    dictionary dict;
    dict.add("type", word("radiation"));
    dict.add("active", true);
    radiation_ = fv::option::New("radiation", dict, *mesh_);
}


void Foam::regionObjects::makeSources()
{
    fv::options::New(*mesh_);
}


void Foam::regionObjects::checkWall
(
    const polyPatch& patch,
    const PtrList<regionObjects>& all
) const
{
    const mappedPatchBase& wall = refCast<const mappedPatchBase>(patch);
    const regionObjects* other = find(all, wall.sampleRegion());
    if (!other)
    {
        FatalErrorInFunction
            << "Patch " << patch.name() << " has sampleRegion '"
            << wall.sampleRegion() << "', allowed: regions of"
            << " constant/regionProperties (" << listedNames(all).c_str()
            << ')'
            << exit(FatalError);
    }
    if
    (
        !other->hasMesh()
     || wall.mode() == mappedPatchBase::NEARESTCELL
     || wall.mode() == mappedPatchBase::NEARESTFACE
    )
    {
        return;
    }
    const polyBoundaryMesh& patches = other->mesh_->boundaryMesh();
    const label found = patches.findPatchID(wall.samplePatch());
    if (found < 0)
    {
        wordList names(patches.names());
        names.resize(patches.nNonProcessor());
        FatalErrorInFunction
            << "Patch " << patch.name() << " has samplePatch '"
            << wall.samplePatch() << "', allowed: patches of region "
            << other->name() << " (" << granularProperties::listed(names).c_str()
            << ')' << exit(FatalError);
    }
    const mappedPatchBase* back = isA<mappedPatchBase>(patches[found]);
    if
    (
        !back
     || back->sampleRegion() != name_ || back->samplePatch() != patch.name()
    )
    {
        FatalErrorInFunction
            << "Patch " << patch.name() << " meets patch " << patches[found].name()
            << " of region " << other->name() << ", which meets ";
        if (back)
        {
            FatalError
                << "patch " << back->samplePatch() << " of region "
                << back->sampleRegion();
        }
        else
        {
            FatalError
                << "no other patch (type " << patches[found].type() << ')';
        }
        FatalError
            << ", allowed: type mappedWall; sampleRegion " << name_
            << "; samplePatch " << patch.name() << ';' << exit(FatalError);
    }
}


Foam::DynamicList<Foam::string> Foam::regionObjects::warnings()
{
    DynamicList<string> found;
    if (!solid_.valid() || solid_->type() != bedThermo)
    {
        return found;
    }
    granularSolidThermo& bed = static_cast<granularSolidThermo&>(solid_());
    const autoPtr<granularMechanics> mechanics
    (
        granularMechanics::New(bed.grainProperties(), bed.grains())
    );
    const caseWarnings warnings
    (
        bed.grainProperties(), bed.T(), bed.grains(), mechanics()
    );
    for (const string& text : warnings.all())
    {
        found.append("Region " + name_ + ": " + text);
    }
    return found;
}


// ************************************************************************* //
