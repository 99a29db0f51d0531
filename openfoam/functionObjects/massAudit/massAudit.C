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

#include "massAudit.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(massAudit, 0);
    addToRunTimeSelectionTable(functionObject, massAudit, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

//- Relative change of the mass that is no rounding
static const Foam::scalar muchMass = 1e-6;


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable massAuditColumns
(
    "columns of massAudit",
    {
        {"mass", "mass of the grains in the domain", "kg"},
        {"relative_change", "its change since the start", "-"},
        {
            "density_mismatch",
            "largest relative difference of particleDensity*(1 - porosity) and"
            " bulkDensity over the cells (with areaRatio where cells move)", "-"
        },
        {
            "density_ratio",
            "mean of particleDensity over the density of the grains at their"
            " temperature, above 1 because porosity counts overlaps once", "-"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::massAudit::massAudit
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    granularFunctionObject(name, typeName, runTime, dict, massAuditColumns),
    change_(0)
{
    begin(dict);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::massAudit::write()
{
    if (lacks({"bulkDensity", "particleDensity", "porosity", "thermalStrain"}))
    {
        return true;
    }
    refresh();
    const tmp<volScalarField> tbulk(present<scalar>("bulkDensity"));
    const tmp<volScalarField> tparticle(present<scalar>("particleDensity"));
    const tmp<volScalarField> tporosity(present<scalar>("porosity"));
    const tmp<volScalarField> tstrain(present<scalar>("thermalStrain"));
    const granularProperties grains(mesh_);
    // Area of the cells over their initial area, if they move
    const scalarField ratio(cellsOf("areaRatio", 1));
    const scalarField& V = mesh_.V();
    const scalarField& bulk = tbulk();
    const scalarField& particle = tparticle();

    const scalar mass = gSum(bulk*V);
    const scalar before = record().initialMass;
    change_ = before > 0 ? mass/before - 1 : 0;
    const scalarField expanded(sqr(1 + tstrain().primitiveField()));
    const scalar mismatch =
        gMax
        (
            mag
            (
                ratio*particle*(1 - tporosity().primitiveField())/bulk - 1
            )()
        );
    const scalar density =
        gSum(V*ratio*particle*expanded)/gSum(V*ratio)/grains.density().value();

    if (Pstream::master())
    {
        line()
            << tab << mass << tab << change_
            << tab << mismatch << tab << density << endl;
    }
    return true;
}


bool Foam::functionObjects::massAudit::end()
{
    if (mag(change_) > muchMass)
    {
        WarningInFunction
            << "Mass is lost or made: the mass of the grains changed by "
            << change_ << " of that at the start, expected: below "
            << muchMass << endl;
    }
    return true;
}


// ************************************************************************* //
