/*---------------------------------------------------------------------------*\
    MSDD: multiscale data-driven heat conduction in granular media

    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "granularProperties.H"
#include "Time.H"

const Foam::Enum<Foam::granularProperties::bulkDensityModel>
Foam::granularProperties::bulkDensityModelNames
({
    { bulkDensityModel::massConsistent, "massConsistent" },
    { bulkDensityModel::paper, "paper" }
});


Foam::granularProperties::granularProperties(const Time& runTime)
:
    IOdictionary
    (
        IOobject
        (
            "granularProperties",
            runTime.constant(),
            runTime,
            IOobject::MUST_READ,
            IOobject::NO_WRITE
        )
    ),
    density_(positive("density", dimDensity)),
    youngModulus_(positive("youngModulus", dimPressure)),
    thermalConductivity_
    (
        positive("thermalConductivity", dimPower/dimLength/dimTemperature)
    ),
    heatCapacity_(positive("heatCapacity", dimSpecificHeatCapacity)),
    thermalExpansion_("thermalExpansion", dimless/dimTemperature, *this),
    meanRadius_(positive("meanRadius", dimLength)),
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
    readThermalExpansion();
    readSurrogate();
}


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


void Foam::granularProperties::readThermalExpansion()
{
    if (!(thermalExpansion_.value() >= 0))
    {
        FatalIOErrorInFunction(*this)
            << "Entry 'thermalExpansion' is " << thermalExpansion_.value()
            << ", allowed: >= 0 [1/K]"
            << exit(FatalIOError);
    }
}


void Foam::granularProperties::readSurrogate()
{
    const dictionary& dict = surrogateDict();

    const word type(dict.get<word>("type"));
    if (type != "network")
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'type' is '" << type << "', allowed: network"
            << exit(FatalIOError);
    }

    dict.readEntry("model", model_);
    dict.readIfPresent("hash", modelHash_);
}


Foam::fileName Foam::granularProperties::modelPath() const
{
    if (model_ == "builtin" || model_.startsWith("builtin:"))
    {
        return model_;
    }
    fileName path(model_);
    path.expand();
    return path.isAbsolute() ? path : time().globalPath()/path;
}


// ************************************************************************* //
