/*---------------------------------------------------------------------------*\
    MSDD: multiscale data-driven heat conduction in granular media
    SPDX-License-Identifier: GPL-3.0-or-later
-------------------------------------------------------------------------------
Application
    msddFoam

Description
    Transient heat conduction in a granular medium whose conductivity follows
    from its microstructure, which in turn follows from thermal expansion:

        rho_b c dT/dt = div(K(porosity, fabricIndex) & grad(T))

    with K and stress given, cell by cell, by a surrogate model trained on
    discrete-element simulations of representative volumes. Each time step is
    Algorithm 1 of Rangel, Franci, Onate and Gimenez (multiscale data-driven
    modelling of granular media with thermal expansion), in its order.

Usage
    Reads   T, porosity, fabricIndex; at the start also stress (tension
            positive) and fabricConductivity, if there are such files;
            constant/granularProperties:

        surrogate
        {
            type        network;
            model       builtin;    // or builtin:paper, or a model file,
                                    // relative to the case
            hash        "...";      // optional: SHA-256 the file must have
        }
        density, youngModulus, thermalConductivity, heatCapacity,
        thermalExpansion, meanRadius    // of the grains, SI
        bulkDensity     massConsistent; // or paper

    Writes  T, porosity, fabricIndex, conductivity, stress (tension positive),
            pressure (compression positive), bulkDensity, particleDensity,
            thermalStrain; for restarts initialTemperature,
            thermalStrainIncrement and the rest of the model's state
            (reducedPressure, fabricConductivity, reducedDeviator);
            postProcessing/msddFoam/summary.json

    The mesh is two-dimensional, in x and y.

\*---------------------------------------------------------------------------*/

#include "fvCFD.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "granularProperties.H"
#include "granularSurrogate.H"
#include "runSummary.H"

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

int main(int argc, char *argv[])
{
    argList::addNote
    (
        "Heat conduction with thermal expansion in granular media, with"
        " conductivity and stress from a surrogate model"
    );

    const clockTime wallClock;

    #include "addCheckCaseOptions.H"
    #include "setRootCaseLists.H"
    #include "createTime.H"
    #include "createMesh.H"

    if (mesh.solutionD()[vector::Z] != -1)
    {
        FatalErrorInFunction
            << "The surrogate is two-dimensional, in x and y: the mesh needs"
            << " empty patches in z" << exit(FatalError);
    }

    const granularProperties granular(runTime);
    granularSurrogate surrogate(granular, mesh.nCells());
    const runSummary summary(mesh, surrogate, wallClock);

    #include "createFields.H"

    Info<< "\nStarting time loop\n" << endl;

    while (runTime.loop())
    {
        Info<< "Time = " << runTime.timeName() << nl;

        #include "updateState.H"
        #include "TEqn.H"
        #include "thermalStrain.H"

        runTime.write();
        runTime.printExecutionTime(Info);
    }

    summary.write(porosity, fabricIndex, conductivity, stress, pressure);

    Info<< "End\n" << endl;

    return 0;
}


// ************************************************************************* //
