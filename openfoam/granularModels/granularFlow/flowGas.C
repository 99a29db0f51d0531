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

#include "flowGas.H"
#include "granularProperties.H"
#include "msdd.hpp"

#include <algorithm>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

//- Samples, one a kelvin from firstSample, beyond any temperature of a run
static const label samples = 5000;
static const scalar firstSample = 1;

//- Gas constant [J/(mol K)]
static const scalar molarGasConstant = 8.314462618;

const keyTable flowGas::constantKeys
(
    "constantGas",
    {
        {"density", "density", "kg/m3", "1e-9 to 1e5", "required"},
        {
            "heatCapacity", "heat capacity at constant pressure", "J/(kg K)",
            "1e-3 to 1e6", "required"
        },
        {"viscosity", "dynamic viscosity", "Pa s", "1e-9 to 1e3", "required"},
        {
            "thermalConductivity", "thermal conductivity", "W/(m K)",
            "1e-9 to 1e4", "required"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::flowGas::flowGas
(
    const granularProperties& properties,
    const keyTable& keys,
    const dictionary& dict
)
:
    pressure_(keys.number(dict, "gasPressure")),
    gasConstant_(0),
    density_(0),
    coldest_(0),
    hottest_(VGREAT)
{
    const dictionary& law = properties.surrogateDict();
    const bool ofLaw = law.get<word>("type") == "spheres";
    if (ofLaw)
    {
        const dictionary& coeffs = law.subDict("spheresCoeffs");
        name_ = coeffs.getOrDefault<word>("gas", "vacuum");
        pressure_ = keys.number(coeffs, "gasPressure");
        for (const word key : {"gas", "gasPressure"})
        {
            if (dict.found(key))
            {
                FatalIOErrorInFunction(dict)
                    << "Entry '" << key << "' is given twice, allowed: once, in"
                    << " spheresCoeffs of surrogate: the gas that flows is the"
                    << " gas between the spheres" << exit(FatalIOError);
            }
        }
        if (name_ == "vacuum")
        {
            FatalIOErrorInFunction(coeffs)
                << "Entry 'gas' of spheresCoeffs is vacuum, allowed with a flow:"
                << " air, nitrogen, helium, argon" << exit(FatalIOError);
        }
    }
    else
    {
        name_ = keys.choice(dict, "gas");
    }
    if (name_ == "constant")
    {
        readConstant(dict.subDict("constantGas"));
    }
    else
    {
        readNamed();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::flowGas::sampled::integrate()
{
    integrals.resize(values.size());
    integrals[0] = 0;
    for (label i = 1; i < values.size(); ++i)
    {
        integrals[i] = integrals[i - 1] + 0.5*(values[i - 1] + values[i]);
    }
}


Foam::scalar Foam::flowGas::sampled::value(const scalar T) const
{
    const scalar x = max(T - firstSample, scalar(0));
    const label i = min(label(x), values.size() - 1);
    return
        i + 1 >= values.size()
      ? values.last()
      : values[i] + (x - i)*(values[i + 1] - values[i]);
}


Foam::scalar Foam::flowGas::sampled::integral(const scalar T) const
{
    const scalar x = T - firstSample;
    if (values.size() == 1)
    {
        return x*values[0];
    }
    const label i = max(label(0), min(label(x), values.size() - 1));
    return integrals[i] + 0.5*(x - i)*(values[i] + value(T));
}


void Foam::flowGas::readConstant(const dictionary& dict)
{
    constantKeys.check(dict);
    density_ = constantKeys.number(dict, "density");
    const auto number = [&](const char* key, sampled& function)
    {
        function.values = scalarField(1, constantKeys.number(dict, key));
    };
    number("viscosity", viscosity_);
    number("thermalConductivity", conductivity_);
    number("heatCapacity", capacity_);
    storage_.values = density_*capacity_.values;
}


void Foam::flowGas::readNamed()
{
    for (sampled* each : {&viscosity_, &conductivity_, &capacity_, &storage_})
    {
        each->values.resize(samples);
    }
    for (label i = 0; i < samples; ++i)
    {
        const scalar T = firstSample + i;
        const msdd::GasProperties gas(msdd::gasProperties(name_, T));
        viscosity_.values[i] = gas.viscosity;
        conductivity_.values[i] = gas.conductivity;
        capacity_.values[i] = gas.heatCapacity;
        gasConstant_ = molarGasConstant/gas.molarMass;
        coldest_ = gas.coldest;
        hottest_ = gas.hottest;
        storage_.values[i] =
            pressure_/(gasConstant_*max(T, gas.coldest))*gas.heatCapacity;
    }
    capacity_.integrate();
    storage_.integrate();
}


// ************************************************************************* //
