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
#include "restartTime.H"
#include "caseChecks.H"
#include "caseWarnings.H"
#include "chooseSettings.H"
#include "timeControlFunctionObject.H"
#include "cellSetOption.H"
#include "fvOptions.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Function objects that end a run at its first step, and those that write
//- nothing, because there is neither a flow nor a thermo of OpenFOAM
static const wordList ending
({
    "forceCoeffs", "forces", "heatTransferCoeff", "turbulenceFields",
    "wallHeatFlux", "wallShearStress"
});
static const wordList silent
({
    "CourantNo", "MachNo", "Q", "flowType", "pressure", "vorticity", "yPlus"
});

//- Methods of decomposition that Debian's OpenFOAM has by name alone
static const wordList missingMethods({"scotch", "ptscotch", "metis", "kahip"});

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::dryRun::hasRegionsAlone() const
{
    const fileName constant(args_.globalPath()/"constant");
    return
        isFile(constant/"regionProperties")
     && !isFile(constant/"granularProperties");
}


bool Foam::dryRun::makeTime()
{
    autoPtr<restartTime> restart;
    if (!hasRegionsAlone())
    {
        attempt([&]() { restart.reset(new restartTime(args_, true)); });
    }
    attempt
    (
        [&]()
        {
            checkWriteInterval
            (
                args_.globalPath()/"system"/Time::controlDictName
            );
        }
    );
    if
    (
        !attempt
        (
            [&]() { runTime_.reset(new Time(Time::controlDictName, args_)); }
        )
    )
    {
        return false;
    }
    Sout.precision(6);
    if (restart.valid())
    {
        attempt([&]() { restart->apply(runTime_()); });
    }
    attempt([&]() { checkWritable(runTime_->path()); });
    attempt([&]() { accuracyWanted(runTime_()); });
    attempt([&]() { checkDecomposition(); });
    return true;
}


bool Foam::dryRun::attemptFor
(
    const string& file,
    const std::function<void()>& make
)
{
    return attempt
    (
        make,
        file + ": ",
        {"constant/", "system/", runTime_->timeName() + "/"}
    );
}


bool Foam::dryRun::makeObjects()
{
    made_.reset(new solverObjects(runTime_()));
    solverObjects& made = made_();
    // Files that are named where a message has none
    const string grains("constant/granularProperties");
    const string solution("system/fvSolution");
    const string fieldT(runTime_->timeName() + "/T");
    const string either(fieldT + " or system/fvSchemes or " + solution);
    const bool hasMesh = attemptFor("constant/polyMesh", [&]() { made.makeMesh(); });
    const bool hasProperties = attemptFor(grains, [&]() { made.makeProperties(); });
    const bool hasNeighbours = attempt([&]() { made.makeNeighbours(); });
    if (!hasMesh)
    {
        return false;
    }
    const bool fits =
        hasProperties
     && attemptFor("constant/polyMesh", [&]() { made.checkMesh(); });
    const bool hasT = attemptFor(fieldT, [&]() { made.makeT(); });
    const bool hasGrains =
        hasT && hasProperties
     && attemptFor(grains, [&]() { made.makeGrains(); });
    attempt
    (
        [&]() { fv::options::New(made.mesh()); },
        "constant/fvOptions: ",
        {"constant/fvOptions"}
    );
    attemptFor(solution, [&]() { timeScheme::typeOf(made.mesh()); });
    attemptFor(solution, [&]() { made.mesh->solverDict("T"); });
    if (!hasGrains)
    {
        lookAlone();
        return true;
    }
    if
    (
        fits && hasNeighbours
     && attemptFor(grains, [&]() { made.makeMechanics(); })
     && attemptFor(either, [&]() { made.makeScheme(); })
    )
    {
        attempt
        (
            [&]()
            {
                const caseWarnings warnings
                (
                    made.properties(), made.T(), made.grains(), made.mechanics()
                );
                warnings_.append(warnings.all());
            }
        );
        // Function objects look at the start
        const scalarField start(made.T().primitiveField());
        const bool heats = attemptFor(either, [&]() { made.scheme->tryHeat(); });
        made.T().primitiveFieldRef() = start;
        if (heats)
        {
            attempt([&]() { checkSources(made.mesh()); });
        }
    }
    return true;
}


void Foam::dryRun::checkSources(const fvMesh& mesh)
{
    const fv::optionList& sources = fv::options::New(mesh);
    for (const fv::option& source : sources)
    {
        for (const word kind : {"vector", "sphericalTensor", "symmTensor", "tensor"})
        {
            if (source.type().find(kind) == 0)
            {
                add
                (
                    warnings_,
                    "Source " + source.name() + " of fvOptions is of type "
                  + source.type() + ", which does not act on T, a scalar: is"
                    " scalarSemiImplicitSource meant?"
                );
            }
        }
        const auto* own = isA<fv::cellSetOption>(source);
        if
        (
            own && !returnReduce(label(own->cells().size()), sumOp<label>())
        )
        {
            add
            (
                warnings_,
                "Source " + source.name() + " of fvOptions acts in no cell: its"
                " selection of cells is empty"
            );
        }
    }
}


void Foam::dryRun::checkDecomposition()
{
    IOobject file
    (
        "decomposeParDict", runTime_->system(), runTime_(),
        IOobject::MUST_READ, IOobject::NO_WRITE, false
    );
    if (!file.typeHeaderOk<IOdictionary>(true))
    {
        return;
    }
    const word method(IOdictionary(file).getOrDefault<word>("method", ""));
    if (missingMethods.found(method))
    {
        add
        (
            warnings_,
            "Entry 'method' of system/decomposeParDict is " + method + ", which"
            " Debian's OpenFOAM is built without: its decomposePar ends with an"
            " error. Allowed there: simple, hierarchical, manual"
        );
    }
}


void Foam::dryRun::checkFunction(const dictionary& dict)
{
    const word type(dict.getOrDefault<word>("type", ""));
    if (!made_.valid())
    {
        return;
    }
    if (ending.found(type))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'type' is " << type << ", allowed: types that need neither"
            << " a flow nor a thermo of OpenFOAM. It ends the run at the first"
            << " step. The function object heatAudit has the heat that came in"
            << " through the patches" << exit(FatalIOError);
    }
    if (silent.found(type))
    {
        add
        (
            warnings_,
            "Function object " + dict.dictName() + " is of type " + type
          + ", which needs a flow: it warns at each step and writes nothing"
        );
    }
}


void Foam::dryRun::lookAlone()
{
    const fvMesh& mesh = made_->mesh();
    for (const word name : {"porosity", "fabricIndex"})
    {
        attempt
        (
            [&]()
            {
                const volScalarField field
                (
                    IOobject
                    (
                        name, runTime_->timeName(), mesh,
                        IOobject::MUST_READ, IOobject::NO_WRITE, false
                    ),
                    mesh
                );
            }
        );
    }
    attempt([&]() { checkVolumes(mesh); });
    attempt([&]() { checkTimeStep(runTime_()); });
    if (made_->properties.valid())
    {
        attempt([&]() { granularModel::New(made_->properties(), mesh); });
    }
}


void Foam::dryRun::makeFunctions()
{
    const entry* all = runTime_->controlDict().findEntry("functions");
    if (!all)
    {
        return;
    }
    if (!all->isDict())
    {
        add(errors_, "system/controlDict: Entry 'functions' is no dictionary");
        return;
    }
    runTime_->libs().open(all->dict(), "libs");
    for (const entry& each : all->dict())
    {
        if (!each.isDict() || !each.dict().getOrDefault("enabled", true))
        {
            continue;
        }
        const auto make = [&]()
        {
            const dictionary& dict = each.dict();
            checkFunction(dict);
            functions_.append
            (
                functionObjects::timeControl::entriesPresent(dict)
              ? autoPtr<functionObject>
                (
                    new functionObjects::timeControl
                    (
                        each.keyword(), runTime_(), dict
                    )
                )
              : functionObject::New(each.keyword(), runTime_(), dict)
            );
        };
        attempt
        (
            make,
            "system/controlDict.functions." + each.keyword() + ": ",
            {"functions." + each.keyword()}
        );
    }
}


// ************************************************************************* //
