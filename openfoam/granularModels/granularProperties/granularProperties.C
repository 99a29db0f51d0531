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

#include "granularProperties.H"
#include "Time.H"
#include "uniformDimensionedFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::granularProperties::bulkDensityModel>
Foam::granularProperties::bulkDensityModelNames
({
    { bulkDensityModel::massConsistent, "massConsistent" },
    { bulkDensityModel::paper, "paper" }
});

const Foam::keyTable Foam::granularProperties::grainKeys
(
    "granularProperties",
    {
        {
            "density", "density of the grains, without the voids", "kg/m3",
            "> 0", "required"
        },
        {
            "youngModulus", "Young's modulus E of the grains", "Pa", "> 0",
            "required"
        },
        {
            "thermalConductivity",
            "thermal conductivity k of the grains; with surrogate type"
            " `spheres` a number or a function of T, see below", "W/(m K)",
            "> 0", "required"
        },
        {
            "heatCapacity",
            "specific heat capacity c of the grains, a number or a function of"
            " T, see below", "J/(kg K)", "> 0", "required"
        },
        {
            "thermalExpansion",
            "linear thermal expansion coefficient of the grains. With 0 the"
            " model is evaluated only at the start (type `spheres`: in every"
            " step, because the conductivity of the gas depends on T)", "1/K",
            ">= 0", "required"
        },
        {
            "meanRadius",
            "mean radius r of the grains in the initial state", "m", "> 0",
            "required"
        },
        {
            "conductivityFactor",
            "factor of the bed's conductivity in the heat equation, for"
            " sensitivity studies; written fields do not include it", "-",
            "0.1 to 10", "1"
        },
        {
            "bulkDensity",
            "mass of a cell from `density` and the initial porosity."
            " `massConsistent`: density times the total area of the grains"
            " over the area of the cell. `paper`: density times"
            " (1 - porosity), which counts overlaps once and loses about 2 % of"
            " the mass", "-", "massConsistent, paper", "massConsistent"
        },
        {
            "initialTemperature",
            "temperature without thermal strain, for which porosity, fabric"
            " index and stress of the start are given. Before the first step"
            " the grains grow from it to T, in parts of at most 0.1 %. A field"
            " of this name may be given instead", "K", "0 to 1e5",
            "T at the start"
        },
        {
            "surrogate", "the constitutive model, see below", "-",
            "a dictionary", "required"
        },
        {
            "mechanics",
            "`none`: the grains stay in place, as in the paper. `equilibrium`:"
            " they move until the forces balance; this requires a model with a"
            " tangent, such as `builtin`", "-", "none, equilibrium", "none"
        },
        {
            "equilibriumCoeffs", "settings of `mechanics equilibrium`", "-",
            "a dictionary", "empty"
        },
        {
            "flow",
            "gas that flows through the bed. `through`: in one direction, with"
            " the same mass flux over the cross-section. `pressure`: through any"
            " openings, by pressure and buoyancy. See below", "-",
            "none, through, pressure", "none"
        },
        {
            "throughCoeffs", "settings of `flow through`", "-", "a dictionary",
            "required with it"
        },
        {
            "pressureCoeffs", "settings of `flow pressure`", "-", "a dictionary",
            "required with it"
        },
        {
            "restStress",
            "initial stress of a bed at rest under its own weight, instead of"
            " the field `stress`; requires gravity, and any surrogate type but"
            " `constant`", "-", "a dictionary", "the field `stress`"
        }
    }
);

const Foam::keyTable Foam::granularProperties::surrogateKeys
(
    "surrogate",
    {
        {
            "type",
            "kind of model; its keys stand in the sub-dictionary `<type>Coeffs`",
            "-", "network, constant, plugin, onlineRve, spheres", "required"
        },
        {
            "smallestStrain",
            "strain of the grains since the last evaluation of a cell, below"
            " which it is not evaluated again; smaller strains add up. 0: cells"
            " are evaluated whenever their strain has changed", "-",
            "0 to 0.01", "0; of `onlineRve` with `rvePer cell` 1e-4"
        },
        {
            "outOfTrainingRange",
            "what is done with cells outside the states that the model was"
            " trained for", "-", "a dictionary", "empty"
        },
        {
            "model",
            "of `network` and `constant`: as in the sub-dictionary of the type,"
            " if there is none", "-", "as there", "as there"
        },
        {"hash", "the same", "-", "as there", "as there"},
        {"conductivity", "the same", "-", "as there", "as there"}
    }
);


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Former names of keys, which are still read, and their names since version 0.3
static const char* const renamedKeys[][2] =
{
    {"give", "slackLayer"},
    {"giveBack", "slackRecovery"},
    {"outOfRegion", "outOfTrainingRange"}
};


//- Rename former keys in a dictionary and its sub-dictionaries, and say so
static void renameFormer(dictionary& dict)
{
    for (const auto& names : renamedKeys)
    {
        if (dict.found(names[0], keyType::LITERAL))
        {
            Info<< "Renamed since version 0.3: entry '" << names[0]
                << "' in " << dict.name() << " is '" << names[1] << "' now"
                << nl;
            autoPtr<entry> renamed
            (
                dict.lookupEntry(names[0], keyType::LITERAL).clone(dict)
            );
            renamed->keyword() = names[1];
            dict.remove(names[0]);
            dict.add(renamed.ptr(), true);
        }
    }
    for (const entry& each : static_cast<const dictionary&>(dict))
    {
        if (each.isDict())
        {
            renameFormer(const_cast<dictionary&>(each.dict()));
        }
    }
}

} // End namespace Foam


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
    // Before a mistyped key is missed
    density_((renameFormer(*this), grainKeys.check(*this), quantity("density", dimDensity))),
    youngModulus_(quantity("youngModulus", dimPressure)),
    thermalConductivity_
    (
        *this, grainKeys, "thermalConductivity", dimPower/dimLength/dimTemperature
    ),
    heatCapacity_(*this, grainKeys, "heatCapacity", dimSpecificHeatCapacity),
    thermalExpansion_(quantity("thermalExpansion", dimless/dimTemperature)),
    meanRadius_(quantity("meanRadius", dimLength)),
    conductivityFactor_(grainKeys.number(*this, "conductivityFactor")),
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
    // Of a region, else of the case
    const auto file = [&registry](const objectRegistry& folder)
    {
        return IOobject
        (
            "g", registry.time().constant(), folder, IOobject::MUST_READ,
            IOobject::NO_WRITE, false
        );
    };
    const word type(uniformDimensionedVectorField::typeName);
    const bool own = isFile(file(registry).globalFilePath(type));
    IOobject header(own ? file(registry) : file(registry.time()));
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
    else if
    (
        isFile
        (
            header.globalFilePath(uniformDimensionedVectorField::typeName)
        )
    )
    {
        FatalIOErrorInFunction(*this)
            << "Gravity in " << header.objectPath() << " is left out, allowed: a"
            << " file with class uniformDimensionedVectorField in its header"
            << exit(FatalIOError);
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

Foam::dimensionedScalar Foam::granularProperties::quantity
(
    const word& key,
    const dimensionSet& dims
) const
{
    const dimensionedScalar value(key, dims, *this);
    grainKeys.within(*this, key, value.value());
    return value;
}


// * * * * * * * * * * * * * * Static Functions  * * * * * * * * * * * * * * //

Foam::string Foam::granularProperties::listed(const wordList& words)
{
    string text;
    for (const word& each : words)
    {
        text += (text.empty() ? "" : ", ") + each;
    }
    return text;
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
