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

Application
    msddFoam

Description
    Transient heat conduction in a granular medium whose conductivity follows
    from its microstructure, which in turn follows from thermal expansion:

        rho_b c dT/dt = div(K(state) & grad(T)) + S

    with K, the stress and the change of the state given, cell by cell, by a
    granularModel. Each step of the paper scheme is Algorithm 1 of Rangel,
    Franci, Onate and Gimenez (multiscale data-driven modelling of granular
    media with thermal expansion), in its order.

Usage
    msddFoam -dry-run checks the case and writes nothing: see dryRun.H.

    msddFoam -accept '(name ...)' goes on from a time that was computed with
    other settings: a restart with another model, material or mechanics is
    refused with both values, and the names to accept. The name mesh accepts
    another mesh with as many cells, files a time with missing or changed files.

    Reads   T, porosity, fabricIndex; at the start also stress (tension
            positive), conductivity and initialTemperature, if there are such
            files;
            constant/granularProperties (keys: cases/common);
            constant/fvOptions, if there is one: heat sources [W/m^3];
            system/fvSolution, msddFoam, if there is one (keys: timeScheme.H)

    Writes  T, porosity, fabricIndex, conductivity, stress (tension positive),
            pressure (compression positive), bulkDensity, particleDensity,
            thermalStrain, inTrainingRange, spread if the model has it; for
            restarts initialTemperature, thermalStrainIncrement, the rest of the
            model's state and uniform/msddFoam, the last file of a time: what
            the run was computed with, and the checksums of the other files;
            postProcessing/msddFoam/summary.json, tables.json (runTables), and
            offenders.json if cells were outside the model's region

    The mesh is two-dimensional, in x and y. ddtSchemes are not used.

\*---------------------------------------------------------------------------*/

#include "fvCFD.H"
#include "chooseSettings.H"
#include "dryRun.H"
#include "restartTime.H"
#include "stepWatch.H"
#include "caseChecks.H"
#include "caseLock.H"
#include "equilibriumSolver.H"
#include "runTables.H"

#include "runResults.H"
#include "runSummary.H"
#include "caseWarnings.H"
#include "version.H"

#include <iostream>
#include <unistd.h>

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

//- Refuse a case path with blanks or quotation marks: OpenFOAM removes them
//- from the path, or ends without an explanation
static void checkPaths(const int argc, char* argv[])
{
    char here[4096] = "";
    std::string path(::getcwd(here, sizeof here) ? here : "");
    for (int i = 1; i + 1 < argc; i++)
    {
        path = string(argv[i]) == "-case" ? argv[i + 1] : path;
    }
    if (path.find_first_of(" \t\"'") != std::string::npos)
    {
        std::cerr
            << "--> FOAM FATAL ERROR: The path of the case is " << path
            << ", allowed: no blanks and no quotation marks, which OpenFOAM"
            << " cannot work with\n";
        std::exit(1);
    }
}


//- Ends PETSc before OpenFOAM ends MPI, which PETSc has started where a process
//- runs by itself
class petscSession
{
public:

    petscSession() = default;
    petscSession(const petscSession&) = delete;
    void operator=(const petscSession&) = delete;

    ~petscSession()
    {
        equilibriumSolver::endPetsc();
    }
};


static void addOptions()
{
    argList::addNote
    (
        "Heat conduction with thermal expansion in granular media, with"
        " conductivity and stress from a granularModel"
    );

    argList::addBoolOption
    (
        "version",
        "Print the version and the commit that msddFoam was built from, and"
        " exit; needs no case"
    );

    argList::addOption
    (
        "accept",
        "names",
        "Continue from a time that was computed with other settings, for"
        " example '(model thermalExpansion)'; the name files accepts a time"
        " with missing or changed files, mesh another mesh with as many cells"
    );

    argList::addBoolOption
    (
        "dry-run",
        "Make all that a run needs, from the files and the mesh of the case,"
        " and list every error and warning; nothing is written. The exit status"
        " is 1 with errors, else 0"
    );
}


//- Run the case to its end
static void runCase
(
    Time& runTime,
    solverObjects& made,
    const clockTime& wallClock
)
{
    made.makeAll();
    volScalarField& T = made.T();
    granularState& grains = made.grains();
    granularMechanics& mechanics = made.mechanics();
    timeScheme& scheme = made.scheme();
    const runSummary summary(made.properties(), T, grains, mechanics, wallClock);
    grains.record().findFiles();
    const caseWarnings warnings(made.properties(), T, grains, mechanics);
    warnings.print();

    stepWatch watch(scheme.waitLimit());
    runTables tables(runTime, !grains.record().continues);
    runResults results(T, grains);

    Info<< "\nStarting time loop\n" << endl;

    while (runTime.run())
    {
        tables.update();
        results.begin();
        scheme.step();
        results.update();
        grains.finishStep();
        if (runTime.writeTime())
        {
            stepWatch::doing("the output");
            if (!runTime.write())
            {
                FatalErrorInFunction
                    << "Cannot write " << runTime.timePath()
                    << ". Is the disk full?" << exit(FatalError);
            }
            grains.record().writeLast();
        }
        watch.finished();
    }
    tables.update();

    grains.refresh();
    grains.writeReport();
    mechanics.writeReport();
    made.neighbours->report();
    summary.write
    (
        results, scheme.rejected(), warnings.all(), made.neighbours->warning(),
        scheme.flow()
    );
}


int main(int argc, char *argv[])
{
    addOptions();

    const clockTime wallClock;

    for (int i = 1; i < argc; i++)
    {
        if (string(argv[i]) == "-version")
        {
            Info<< "msddFoam " << msddVersion << ", " << foamText().c_str()
                << endl;
            return 0;
        }
    }

    checkPaths(argc, argv);

    #include "setRootCaseLists.H"

    runRecord::accepted = wordHashSet(args.getList<word>("accept", false));
    // Before all that uses PETSc, so that it ends after it
    const petscSession petsc;
    Info<< "msddFoam " << msddVersion << nl
        << "Built for " << foamText().c_str() << nl << endl;
    if (args.found("dry-run"))
    {
        return dryRun::main(args);
    }
    // Static, so that its file is removed after an error, too. Before the first
    // that changes the case: an incomplete time may be one that another solver
    // is writing
    static caseLock lock(args.rootPath()/args.globalCaseName());
    const restartTime restart(args, false);

    checkWriteInterval(args.rootPath()/args.globalCaseName()/"system/controlDict");
    #include "createTime.H"

    restart.apply(runTime);
    chooseSettings(runTime, lock);
    // Every run writes, at least its summary
    checkWritable(runTime.path());
    if (Pstream::master())
    {
        checkWritable(runTime.globalPath());
    }

    // Six digits in the log, whatever the writePrecision of the fields
    Sout.precision(6);

    solverObjects made(runTime);
    runCase(runTime, made, wallClock);

    Info<< "End\n" << endl;

    return 0;
}


// ************************************************************************* //
