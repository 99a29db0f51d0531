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

#include "paperScheme.H"
#include "stepWatch.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace timeSchemes
{
    defineTypeNameAndDebug(paper, 0);
    addToRunTimeSelectionTable(timeScheme, paper, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeSchemes::paper::paper
(
    const dictionary& dict,
    volScalarField& T,
    granularState& grains,
    granularMechanics& mechanics,
    neighbourSolids& neighbours,
    const granularProperties& properties
)
:
    timeScheme(dict, T, grains, mechanics, neighbours, properties)
{
    const dictionary& control = time_.controlDict();
    if (control.lookupOrDefault("adjustTimeStep", false))
    {
        FatalIOErrorInFunction(control)
            << "Entry 'adjustTimeStep' is on, allowed: off, or timeScheme"
            << " secondOrder in msddFoam of system/fvSolution"
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::timeSchemes::paper::step()
{
    advanceTime();
    setLog();
    Told_ = T_.primitiveField();
    neighbours_.begin();
    heat_.flow().begin();
    grains_.extrapolateTemperature(T_.primitiveFieldRef());

    stepWatch::doing("the model");
    // Steps 1 to 3: state of the grains from n to n + 1, with the thermal
    // strain of the last change of T
    scalar error;
    if (grains_.propose(false, error))
    {
        grains_.policy().refuseCut();
    }

    stepWatch::doing("the mechanics");
    // Equilibrium of the resulting stress
    mechanics_.setForce(heat_.flow().force()());
    mechanics_.solve(true);
    grains_.commit();

    stepWatch::doing("the heat equation");
    // Step 4: the heat equation
    const scalar deltaT = time_.deltaTValue();
    heat_.solve
    (
        heat_.equivalent(Told_)(),
        deltaT,
        mechanics_.pulledBack(grains_.conductivity().primitiveField())
    );
    account(deltaT);

    // Step 5: thermal strain
    grains_.strain(Told_, T_.primitiveField());
    observe(deltaT);
}


// ************************************************************************* //
