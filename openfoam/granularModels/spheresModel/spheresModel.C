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

#include "spheresModel.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{
    defineTypeNameAndDebug(spheres, 0);
    addToRunTimeSelectionTable(granularModel, spheres, dictionary);
}

//- Resistance of a wall to which nothing conducts, as of the library [m2 K/W]
static const scalar nothing = 1e9;

//- Emissivity of ceramics and of oxidised metals, taken where none is given
static const scalar usualEmissivity = 0.9;

//- Solid fraction of a usual packing
static const scalar usualSolid = 0.6;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::spheres::spheres
(
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    surrogateModel
    (
        typeName,
        "model",
        named(properties),
        "builtin, or a readable model file of spheres",
        properties,
        mesh
    ),
    gas_(keys.choice(coeffs_, "gas")),
    emissivity_(coeffs_, keys, "emissivity", dimless),
    radiates_
    (
        keys.choice(coeffs_, "radiation") == "on"
     && (!emissivity_.isNumber() || emissivity_.usual().value() > 0)
    ),
    hasWall_(coeffs_.isDict("wall")),
    ownEmissivity_(hasWall_ && coeffs_.subDict("wall").found("emissivity")),
    outside_(0),
    outsideBy_(int64_t(0))
{
    completeGrains();
    wall_ = wall();
    if (hasWall_)
    {
        wallGap_ =
            2*properties_.meanRadius().value()
           *wallKeys.number(coeffs_.subDict("wall"), "gap");
    }
    keys.check(coeffs_);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::fileName Foam::granularModels::spheres::named
(
    const granularProperties& properties
)
{
    const dictionary& dict = properties.surrogateDict();
    if (!dict.isDict("spheresCoeffs"))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'spheresCoeffs' is missing: surrogate type spheres needs"
            << " spheresCoeffs { poissonRatio; gas; }" << exit(FatalIOError);
    }
    return dict.subDict("spheresCoeffs").getOrDefault<fileName>
    (
        "model", "builtin"
    );
}


void Foam::granularModels::spheres::completeGrains()
{
    grains_.poisson_ratio = keys.number(coeffs_, "poissonRatio");
    grains_.size_spread = keys.number(coeffs_, "sizeSpread");
    // Only its range counts
    keys.number(coeffs_, "friction");
    grains_.roughness = keys.number(coeffs_, "roughness");
    if (grains_.roughness > 0)
    {
        coeffs_.get<scalar>("hardness");
    }
    grains_.hardness = keys.number(coeffs_, "hardness", 1);
    grains_.gas = gas_.c_str();
    grains_.gas_pressure = keys.number(coeffs_, "gasPressure");
    grains_.accommodation = keys.number(coeffs_, "accommodation");
    grains_.emissivity = radiates_ ? emissivity_.usual().value() : 0;
}


msdd_sphere_wall Foam::granularModels::spheres::wall() const
{
    msdd_sphere_wall result = msdd_sphere_wall();
    if (!hasWall_)
    {
        return result;
    }
    const dictionary& dict = coeffs_.subDict("wall");
    wallKeys.check(dict);
    result.struct_size = sizeof(msdd_sphere_wall);
    result.conductivity = wallKeys.number(dict, "thermalConductivity");
    result.young_modulus = wallKeys.number(dict, "youngModulus");
    result.poisson_ratio = wallKeys.number(dict, "poissonRatio");
    result.roughness = wallKeys.number(dict, "roughness");
    if (result.roughness > 0)
    {
        const word key("hardness");
        result.hardness =
            wallKeys.within(dict, key, dict.get<scalar>(key));
    }
    result.spheres = wallKeys.number(dict, "spheres");
    result.emissivity =
        wallKeys.number(dict, "emissivity", grains_.emissivity);
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::granularModels::spheres::advance(const query& cells)
{
    scalarField solid(cells.size);
    columns all(columnsOf(cells));
    all.step.temperature = msdd::input(cells.temperature);
    all.step.solid_fraction = msdd::output(solid.data());
    const temperatureFunction& k = properties_.conductivityFunction();
    const auto along = [&](const temperatureFunction& f, const bool wanted)
    {
        scalarField values
        (
            wanted && cells.conductivity && !f.isNumber() ? cells.size : 0
        );
        forAll(values, row)
        {
            values[row] = f.value(cells.temperature[row]);
        }
        return values;
    };
    const scalarField conducting(along(k, true));
    const scalarField emitting(along(emissivity_, radiates_));
    const auto column = [](const scalarField& values)
    {
        return msdd::input(values.empty() ? nullptr : values.cdata());
    };
    all.step.solid_conductivity = column(conducting);
    all.step.emissivity = column(emitting);
    surrogateModel::advance(all, grains_);
    for (label row = 0; row < cells.size; ++row)
    {
        // Exactly as before without strain
        bool still = cells.strain[row] == 0;
        for (label i = 0; cells.cellStrain && i < components(); ++i)
        {
            still = still && cells.cellStrain[i][row] == 0;
        }
        cells.nextState[0][row] =
            still ? cells.state[0][row] : 1 - solid[row];
        cells.nextState[1][row] = cells.state[1][row];
    }
    if (!cells.trial && all.step.outside_cells)
    {
        outside_ += all.step.outside_cells;
        for (label row = 0; row < cells.size; ++row)
        {
            forAll(outsideBy_, k)
            {
                outsideBy_[k] += (cells.outsideRow[row] >> k) & 1;
            }
        }
    }
    return label(all.step.outside_cells);
}


void Foam::granularModels::spheres::wallResistance
(
    const scalarField& stress,
    const scalarField& temperature,
    const scalarField& conductivity,
    scalarField& resistance
) const
{
    if (!hasWall_)
    {
        FatalIOErrorInFunction(coeffs_)
            << "Entry 'wall' is missing: the conditions granularWall and"
            << " granularContact of T need spheresCoeffs { wall { thermalConductivity; youngModulus;"
            << " poissonRatio; } }, the properties of the wall"
            << exit(FatalIOError);
    }
    const temperatureFunction& k = properties_.conductivityFunction();
    // Of all faces at once if they have the same properties
    const bool alike = k.isNumber() && (emissivity_.isNumber() || !radiates_);
    const label length = alike ? max(stress.size(), 1) : 1;
    msdd_grains grains(grains_);
    msdd_sphere_wall wall(wall_);
    try
    {
        for (label face = 0; face < stress.size(); face += length)
        {
            if (!alike)
            {
                grains.conductivity = k.value(temperature[face]);
                if (radiates_)
                {
                    grains.emissivity = emissivity_.value(temperature[face]);
                    if (!ownEmissivity_)
                    {
                        wall.emissivity = grains.emissivity;
                    }
                }
            }
            msdd::wallResistance
            (
                grains, wall, length, stress.cdata() + face,
                temperature.cdata() + face, conductivity.cdata() + face,
                resistance.data() + face
            );
        }
    }
    catch (const std::exception& error)
    {
        failed("a wall", error);
    }
    if (wallGap_ > 0)
    {
        resistance = min(resistance + wallGap_/conductivity, nothing);
    }
}


Foam::scalar
Foam::granularModels::spheres::conductivityRatio(const scalar T) const
{
    const scalar gas = msdd::gasConductivity(gas_, min(max(T, 1.0), 1e5));
    return gas > 0 ? properties_.conductivityFunction().value(T)/gas : 0;
}


bool Foam::granularModels::spheres::knownGas
(
    const scalar T,
    scalar& least,
    scalar& most
) const
{
    least = GREAT;
    most = -GREAT;
    if (!(conductivityRatio(T) > 0))
    {
        return false;
    }
    // A packing that the law covers
    const scalar solid = usualSolid;
    const scalarField stress({1e4, 1e4, 1e4, 0, 0, 0});
    scalarField state(stateNames_.size());
    std::vector<msdd_input> given;
    std::vector<scalar*> own;
    for (const scalar& one : stress)
    {
        given.push_back(msdd::input(&one));
    }
    for (scalar& one : state)
    {
        own.push_back(&one);
    }
    const scalar k = properties_.conductivityFunction().value(T);
    msdd_grains grains(grains_);
    msdd_start data(msdd::start(1, 6));
    data.solid_fraction = msdd::input(&solid);
    data.stress = given.data();
    start(data, grains, own.data());
    uint8_t outside = 0;
    query one;
    one.size = 1;
    one.state = own.data();
    one.temperature = &T;
    one.outsideRow = &outside;
    columns all(columnsOf(one));
    all.step.temperature = msdd::input(&T);
    all.step.solid_conductivity = msdd::input(&k);
    for (label tenth = -30; tenth <= 90; ++tenth)
    {
        grains.gas_pressure = std::pow(10, 0.1*tenth);
        surrogateModel::advance(all, grains);
        if (!(outside & 8))
        {
            least = min(least, grains.gas_pressure);
            most = max(most, grains.gas_pressure);
        }
    }
    return true;
}


bool Foam::granularModels::spheres::radiation
(
    const scalarField& state,
    const scalar T,
    radiating& answer
) const
{
    answer.inModel = radiates_;
    answer.emissivity = emissivity_.value(T);
    answer.assumed = !(answer.emissivity > 0);
    if (answer.assumed)
    {
        answer.emissivity = usualEmissivity;
    }
    msdd_grains grains(grains_);
    grains.emissivity = answer.emissivity;
    const scalar k = properties_.conductivityFunction().value(T);
    std::vector<const scalar*> before;
    for (const scalar& one : state)
    {
        before.push_back(&one);
    }
    symmTensor K(Zero);
    query one;
    one.size = 1;
    one.state = before.data();
    one.conductivity = &K;
    columns all(columnsOf(one));
    all.step.temperature = msdd::input(&T);
    all.step.solid_conductivity = msdd::input(&k);
    all.step.radiation_conductivity = msdd::output(&answer.conductivity);
    surrogateModel::advance(all, grains);
    answer.without = tr(K)/3 - answer.conductivity;
    return true;
}


Foam::granularModel::counters Foam::granularModels::spheres::count() const
{
    return counters
    {
        {"answers_outside", outside_},
        {"answers_outside_by_density", outsideBy_[0]},
        {"answers_outside_by_pressure", outsideBy_[1]},
        {"answers_outside_by_stress_ratio", outsideBy_[2]},
        {"answers_outside_by_gas", outsideBy_[3]}
    };
}


// ************************************************************************* //
