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

#include "heatAudit.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(heatAudit, 0);
    addToRunTimeSelectionTable(functionObject, heatAudit, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable heatAuditKeys
(
    "heatAudit",
    {
        {
            "tolerance",
            "largest relative_difference; above it the run ends with an error",
            "-", "any number", "none"
        }
    }
);

static const keyTable heatAuditColumns
(
    "columns of heatAudit",
    {
        {
            "stored",
            "heat that the grains have stored since the start: bulk density"
            " times volume times the integral of c over T", "J"
        },
        {"patches", "heat received through all patches", "J"},
        {
            "sources", "heat received from sources and constraints of fvOptions",
            "J"
        },
        {
            "exchanged",
            "sum of the absolute amounts over patches, sources and steps", "J"
        },
        {
            "relative_difference",
            "|stored - patches - sources| over exchanged, the error of the"
            " linear solver", "-"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::heatAudit::heatAudit
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    granularFunctionObject(name, typeName, runTime, dict, heatAuditColumns),
    tolerance_(heatAuditKeys.number(dict, "tolerance", VGREAT)),
    difference_(0)
{
    begin(dict);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::heatAudit::write()
{
    if (lacks({"T", "initialTemperature", "bulkDensity"}))
    {
        return true;
    }
    const runRecord& known = record();
    const tmp<volScalarField> tT(present<scalar>("T"));
    const tmp<volScalarField> tT0(present<scalar>("initialTemperature"));
    const tmp<volScalarField> tbulk(present<scalar>("bulkDensity"));
    const granularProperties grains(mesh_);
    const scalarField mass(tbulk().primitiveField()*mesh_.V().field());
    const scalar stored =
        grains.storedHeat(mass, tT(), tT0()) - known.startHeat;
    const scalar content = grains.heldHeat(mass, tT0());
    const scalar patches = returnReduce(sum(known.heat), sumOp<scalar>());
    const scalar sources = returnReduce(known.sourceHeat, sumOp<scalar>());
    const scalar exchanged = returnReduce(known.exchanged, sumOp<scalar>());
    difference_ = mag(stored - patches - sources)
       /max(exchanged, runRecord::roundedHeat*content);

    if (Pstream::master())
    {
        line()
            << tab << stored << tab << patches << tab << sources
            << tab << exchanged << tab << difference_ << endl;
    }
    if (difference_ > tolerance_)
    {
        FatalErrorInFunction
            << "Heat stored differs from heat received by " << difference_
            << " of the heat exchanged, allowed: " << tolerance_
            << exit(FatalError);
    }
    return true;
}


bool Foam::functionObjects::heatAudit::end()
{
    if (difference_ > runRecord::muchHeat)
    {
        WarningInFunction
            << "Heat is lost or made: stored and received heat differ by "
            << difference_ << " of the heat exchanged, expected: below "
            << runRecord::muchHeat << endl;
    }
    return true;
}


// ************************************************************************* //
