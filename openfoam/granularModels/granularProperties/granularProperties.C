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

#include "granularProperties.H"
#include "Time.H"
#include "uniformDimensionedFields.H"

#include <sstream>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::granularProperties::bulkDensityModel>
Foam::granularProperties::bulkDensityModelNames
({
    { bulkDensityModel::massConsistent, "massConsistent" },
    { bulkDensityModel::paper, "paper" }
});


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularProperties::granularProperties(const objectRegistry& registry)
:
    IOdictionary
    (
        IOobject
        (
            "granularProperties",
            registry.time().constant(),
            registry,
            IOobject::MUST_READ,
            IOobject::NO_WRITE
        )
    ),
    density_(positive("density", dimDensity)),
    youngModulus_(positive("youngModulus", dimPressure)),
    thermalConductivity_
    (
        *this, "thermalConductivity", dimPower/dimLength/dimTemperature
    ),
    heatCapacity_(*this, "heatCapacity", dimSpecificHeatCapacity),
    thermalExpansion_("thermalExpansion", dimless/dimTemperature, *this),
    meanRadius_(positive("meanRadius", dimLength)),
    conductivityFactor_(ranged(*this, "conductivityFactor", 1, 0.1, 10)),
    gravity_(Zero),
    bulkDensity_
    (
        bulkDensityModelNames.getOrDefault
        (
            "bulkDensity",
            *this,
            bulkDensityModel::massConsistent
        )
    )
{
    checkKeys
    (
        *this,
        {
            "FoamFile", "surrogate", "density", "youngModulus",
            "thermalConductivity", "heatCapacity", "thermalExpansion",
            "meanRadius", "conductivityFactor", "bulkDensity", "mechanics",
            "equilibriumCoeffs", "restStress", "initialTemperature"
        }
    );
    if (!(thermalExpansion_.value() >= 0))
    {
        FatalIOErrorInFunction(*this)
            << "Entry 'thermalExpansion' is " << thermalExpansion_.value()
            << ", allowed: >= 0 [1/K]"
            << exit(FatalIOError);
    }
    IOobject header
    (
        "g", registry.time().constant(), registry,
        IOobject::MUST_READ, IOobject::NO_WRITE, false
    );
    if (header.typeHeaderOk<uniformDimensionedVectorField>(true))
    {
        const uniformDimensionedVectorField g(header);
        if (g.dimensions() != dimAcceleration || !(mag(g.value()) < 1e6))
        {
            FatalIOErrorInFunction(*this)
                << "Gravity in " << header.objectPath() << " is " << g.value()
                << " with dimensions " << g.dimensions()
                << ", allowed: a vector shorter than 1e6, in units "
                << dimAcceleration << exit(FatalIOError);
        }
        gravity_ = g.value();
    }
    if (found("restStress") && surrogateDict().getOrDefault<word>("type", "") == "constant")
    {
        FatalIOErrorInFunction(*this)
            << "Entry 'restStress' is given with surrogate type constant, whose"
            << " stress does not depend on it, allowed: with the other types"
            << exit(FatalIOError);
    }
    if (found("restStress") && mag(gravity_) <= VSMALL)
    {
        FatalIOErrorInFunction(*this)
            << "Entry 'restStress' needs gravity, in " << header.objectPath()
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::dimensionedScalar Foam::granularProperties::positive
(
    const word& key,
    const dimensionSet& dims
) const
{
    const dimensionedScalar value(key, dims, *this);

    if (!(value.value() > 0))
    {
        FatalIOErrorInFunction(*this)
            << "Entry '" << key << "' is " << value.value()
            << ", allowed: > 0, in units " << dims
            << exit(FatalIOError);
    }
    return value;
}


// * * * * * * * * * * * * * * Static Functions  * * * * * * * * * * * * * * //

void Foam::granularProperties::checkKeys
(
    const dictionary& dict,
    const wordList& allowed
)
{
    for (const word& key : dict.toc())
    {
        if (!allowed.found(key))
        {
            FatalIOErrorInFunction(dict)
                << "Unknown entry '" << key << "', allowed: "
                << listed(allowed).c_str() << exit(FatalIOError);
        }
    }
}


Foam::string Foam::granularProperties::listed(const wordList& words)
{
    string text;
    for (const word& each : words)
    {
        text += (text.empty() ? "" : ", ") + each;
    }
    return text;
}


Foam::scalar Foam::granularProperties::ranged
(
    const dictionary& dict,
    const word& key,
    const scalar deflt,
    const scalar low,
    const scalar high
)
{
    const scalar value = dict.getOrDefault<scalar>(key, deflt);

    if (!(value >= low && value <= high))
    {
        // OpenFOAM's streams would print the limits with all digits of the
        // case's writePrecision
        std::ostringstream limits;
        limits << low << " to " << high;
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << value << ", allowed: "
            << limits.str().c_str() << exit(FatalIOError);
    }
    return value;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::fileName Foam::granularProperties::path(const fileName& name) const
{
    fileName path(name);
    path.expand();
    return path.isAbsolute() ? path : time().globalPath()/path;
}


Foam::scalar Foam::granularProperties::storedHeat
(
    const scalarField& mass,
    const scalarField& T,
    const scalarField& start
) const
{
    return heatCapacity().value()
       *gSum
        (
            mass*(heatFunction().equivalent(T) - heatFunction().equivalent(start))
        );
}


Foam::scalar Foam::granularProperties::heldHeat
(
    const scalarField& mass,
    const scalarField& T
) const
{
    return heatCapacity().value()*gSum(mass*mag(heatFunction().equivalent(T)));
}


// ************************************************************************* //
