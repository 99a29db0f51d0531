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

#include "dryRun.H"
#include "gravityMeshObject.H"
#include "mappedPatchBase.H"
#include "regionProperties.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Libraries that chtMultiRegionFoam is linked to and msddFoam is not
static const char* const regionLibraries[] =
{
    "libcompressibleTurbulenceModels.so", "libradiationModels.so",
    "libcombustionModels.so", "libregionModels.so"
};

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::dryRun::attemptIn
(
    const regionObjects& region,
    const string& file,
    const std::function<void()>& make
)
{
    return attempt
    (
        make,
        file + ": ",
        {"/" + region.name() + "/", "egion " + region.name() + " "}
    );
}


bool Foam::dryRun::makeRegions()
{
    for (const fileName library : regionLibraries)
    {
        runTime_->libs().open(library, false);
    }
    attempt([&]() { meshObjects::gravity::New(runTime_()); });
    label solutions = 1;
    attempt
    (
        [&]()
        {
            solutions =
                fvSolution(runTime_()).subDict("PIMPLE")
               .getOrDefault<label>("nOuterCorrectors", 1);
        }
    );
    if (!attempt([&]() { listRegions(); }))
    {
        return false;
    }
    bool all = true;
    label beds = 0;
    for (regionObjects& region : regions_)
    {
        const string file("constant/" + region.name() + "/polyMesh");
        all = attemptIn(region, file, [&]() { region.makeMesh(); }) && all;
        beds += region.isBed();
    }
    if (!beds)
    {
        add
        (
            warnings_,
            "No region of constant/regionProperties is a bed: none has"
            " thermoType granularSolidThermo in its thermophysicalProperties."
            " A bed of msddFoam needs constant/granularProperties"
        );
    }
    for (regionObjects& region : regions_)
    {
        if (region.hasMesh())
        {
            makeRegion(region, solutions);
        }
    }
    for (regionObjects& region : regions_)
    {
        if (region.hasMesh())
        {
            tryRegion(region);
        }
    }
    return all;
}


void Foam::dryRun::listRegions()
{
    regionProperties listed(runTime_());
    for (const word kind : {"fluid", "solid"})
    {
        for (const word& name : listed[kind])
        {
            regions_.append
            (
                new regionObjects(runTime_(), name, kind == "fluid")
            );
            if (kind == "fluid")
            {
                left_ += (left_.empty() ? "" : ", ") + name;
            }
        }
    }
    if (regions_.empty())
    {
        FatalErrorInFunction
            << "constant/regionProperties has no regions, allowed: names of"
            << " regions in fluid or solid" << exit(FatalError);
    }
}


void Foam::dryRun::makeRegion(regionObjects& region, const label solutions)
{
    const string constant("constant/" + region.name() + "/");
    const string system("system/" + region.name() + "/");
    const string start(runTime_->timeName() + "/" + region.name() + "/");
    const auto make = [&](const string& file, void (regionObjects::*part)())
    {
        return attemptIn(region, file, [&]() { (region.*part)(); });
    };
    const bool made =
        make(constant + basicThermo::dictName, &regionObjects::makeThermo);
    bool ready =
        made
     && make(constant + "radiationProperties", &regionObjects::makeRadiation);
    if (!made)
    {
        region.forgetThermo();
        lookAlone(region);
        if (region.isFluid() && region.isBed())
        {
            return;
        }
    }
    make(constant + "fvOptions", &regionObjects::makeSources);
    if (region.isFluid())
    {
        attemptIn
        (
            region, constant + "turbulenceProperties",
            [&]() { region.readTurbulence(); }
        );
        if (made && make(start + "U", &regionObjects::makeFlow))
        {
            make(start + "p_rgh", &regionObjects::makePressure);
            attemptIn
            (
                region, system + "fvSchemes", [&]() { region.findSchemes(); }
            );
        }
    }
    else
    {
        ready =
            made
         && make(constant + basicThermo::dictName, &regionObjects::makeAxes)
         && ready;
    }
    if (ready)
    {
        region.setReady();
    }
    wordList names;
    attemptIn
    (
        region, system + "fvSolution",
        [&]() { names = region.solved(solutions); }
    );
    for (const word& name : names)
    {
        attemptIn
        (
            region, system + "fvSolution",
            [&]() { region.mesh().solver(name); }
        );
    }
}


void Foam::dryRun::lookAlone(regionObjects& region)
{
    for (const word field : {"T", "p", "porosity", "fabricIndex"})
    {
        if (region.hasField(field))
        {
            attemptIn
            (
                region, runTime_->timeName() + "/" + region.name(),
                [&]() { region.readScalar(field); }
            );
        }
    }
    if (region.isBed())
    {
        attemptIn
        (
            region, "constant/" + region.name() + "/granularProperties",
            [&]() { region.readGrains(); }
        );
    }
}


void Foam::dryRun::tryRegion(regionObjects& region)
{
    const label before = errors_.size();
    const polyBoundaryMesh& patches = region.mesh().boundaryMesh();
    for (label patchi = 0; patchi < patches.nNonProcessor(); ++patchi)
    {
        if (isA<mappedPatchBase>(patches[patchi]))
        {
            attemptIn
            (
                region, "constant/" + region.name() + "/polyMesh/boundary",
                [&]() { region.checkWall(patches[patchi], regions_); }
            );
        }
    }
    if (errors_.size() > before || !region.isReady(regions_))
    {
        return;
    }
    const string place
    (
        runTime_->timeName() + "/" + region.name() + "/T, patch "
    );
    for (label patchi = 0; patchi < patches.nNonProcessor(); ++patchi)
    {
        attemptIn
        (
            region, place + patches[patchi].name(),
            [&]()
            {
                region.thermo().T().boundaryFieldRef()[patchi].updateCoeffs();
            }
        );
    }
    attempt([&]() { warnings_.append(region.warnings()); });
    if (!region.isFluid() && errors_.size() == before)
    {
        attemptIn
        (
            region, "system/" + region.name() + "/fvSchemes",
            [&]() { region.trySolid(); }
        );
    }
}


// ************************************************************************* //
