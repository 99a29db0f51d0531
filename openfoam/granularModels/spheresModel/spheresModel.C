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
#include "givenField.H"
#include "volFields.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{
    defineTypeNameAndDebug(spheres, 0);
    addToRunTimeSelectionTable(granularModel, spheres, dictionary);
}

const keyTable granularModels::spheres::keys
(
    "spheresCoeffs",
    {
        {
            "model",
            "`builtin`: the model that is compiled into the library. Else a"
            " model file of spheres, relative to the case folder", "-",
            "builtin, a readable model file", "builtin"
        },
        {"hash", "as in `networkCoeffs`", "-", "the hash of the file", "any"},
        {
            "poissonRatio", "Poisson's ratio of the spheres", "-",
            "-0.99 to 0.5", "required"
        },
        {
            "roughness",
            "height of the asperities of the spheres (root mean square) over"
            " their slope; 0: smooth", "m", "0 to 1", "0"
        },
        {
            "hardness",
            "hardness of the surface: rough contacts conduct by it, and the run"
            " warns if contacts are pressed harder", "Pa", "1 to 1e15",
            "required with `roughness`"
        },
        {
            "crushLoad",
            "force between plates at which a sphere breaks: the run warns if"
            " contacts are pressed harder", "N", "1e-12 to 1e12",
            "not compared"
        },
        {
            "gas",
            "gas between the spheres. Properties are valid from 200 to 2000 K,"
            " of helium from 273 to 1800 K. Spheres that conduct less than the"
            " gas are refused; poor conductors have [their own"
            " model](../theory/spheres-law.md#poor-conductors)", "-",
            "air, nitrogen, helium, argon, vacuum", "vacuum"
        },
        {
            "gasPressure",
            "pressure of the gas. In very thin gas, whose conductivity is"
            " proportional to its pressure, the model has an error of up to a"
            " factor of two", "Pa", "1e-3 to 1e9", "1.013e5"
        },
        {
            "accommodation",
            "thermal accommodation coefficient of the gas at the spheres", "-",
            "0.01 to 1", "0.9"
        },
        {
            "emissivity",
            "emissivity of the spheres, which are opaque, grey and diffuse, a"
            " number or a function of T, as `thermalConductivity`: above"
            " 0 they conduct by"
            " [radiation](../theory/spheres-law.md#radiation), too. At 0 the run"
            " warns where radiation would add more than 2 % to the conductivity",
            "-", "0 to 1", "0"
        },
        {
            "radiation", "off: without radiation, whatever the emissivity",
            "-", "on, off", "on"
        },
        {
            "sizeSpread",
            "standard deviation of the diameters over their mean, both weighted"
            " by surface; `meanRadius` is half the mean. The model is then"
            " [that of equal spheres](../theory/spheres-law.md#unequal-spheres)"
            " of a lower solid fraction", "-", "0 to 0.25", "0"
        },
        {
            "friction",
            "coefficient of friction between the spheres: the shipped law is"
            " trained at 0.3 and [was compared](../quality/spheres.md#other-frictions)"
            " within this range", "-", "0.2 to 0.5", "0.3"
        },
        {
            "coordination",
            "contacts per sphere at the start, all spheres counted. A field"
            " `coordination` replaces it", "-", "0 to 12",
            "as in a periodic box in this state; beds under gravity have"
            " about 0.4 more"
        },
        {
            "mobilised",
            "[mobilised part of the"
            " friction](../theory/spheres-law.md#mobilised-friction) at the"
            " start: 0.84 to 0.91 in poured beds (`msdd bed run` counts it), 1"
            " in boxes compressed with friction. A field `mobilised` replaces"
            " it", "-", "0 to 1", "0.85"
        },
        {
            "fabric",
            "[fabric tensor](../theory/spheres-law.md#state) at the start, mean"
            " of the dyads of the contact normals, (xx xy xz yy yz zz);"
            " `msdd bed run` counts it. A field `fabric` replaces it", "-",
            "xx, yy, zz >= 0, their sum 1", "follows from the stress"
        },
        {
            "wall",
            "walls where T has the condition"
            " [`granularWall`](fields.md#walls-with-their-resistance) or"
            " [`granularContact`](regions.md#the-resistance-of-a-wall)", "-",
            "a dictionary", "none"
        }
    }
);

static const keyTable sphereWallKeys
(
    "wall of spheresCoeffs",
    {
        {
            "thermalConductivity", "thermal conductivity of the wall",
            "W/(m K)", "1e-12 to 1e12", "required"
        },
        {
            "youngModulus", "Young's modulus of the wall", "Pa",
            "1e-9 to 1e15", "required"
        },
        {
            "poissonRatio", "Poisson's ratio of the wall", "-", "-0.99 to 0.5",
            "required"
        },
        {
            "roughness",
            "height of the asperities of sphere and wall together over their"
            " slope; 0: smooth", "m", "0 to 1", "0"
        },
        {
            "hardness", "hardness of the softer one; read with `roughness`",
            "Pa", "1 to 1e15", "required with `roughness`"
        },
        {
            "spheres",
            "spheres at the wall per square of a diameter: 0.85 to 0.87 along a"
            " wall of a poured bed, 1.155 in a hexagonal layer", "-",
            "0.01 to 1.16", "0.87"
        },
        {
            "gap",
            "distance between the wall and the end of the mesh over a diameter:"
            " 0.125 where a bed as dense as inside, without the wider pores"
            " next to the wall, would hold all spheres", "-", "0 to 0.5", "0"
        },
        {
            "emissivity",
            "emissivity of the wall, which exchanges radiation with spheres that"
            " radiate", "-", "0 to 1", "as of the spheres"
        }
    }
);

//- Resistance of a wall to which nothing conducts, as of the library [m2 K/W]
static const scalar nothing = 1e9;

//- Change of the stress at the start, over the pressure, that is reported
static const scalar notable = 1e-3;

//- By how much the trace of a fabric may differ from 1: it is given rounded
static const scalar unitTrace = 0.01;

//- Contacts per sphere between which packings under load are: without rattlers
//- spheres with friction need four, and dense random packings have seven
static const scalar leastContacts = 2, mostContacts = 9;

//- Largest usual share of a direction in the fabric: of one third in boxes,
//- poured beds have up to 0.37, strongly sheared ones 0.45
static const scalar mostFabric = 0.45;

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
           *sphereWallKeys.number(coeffs_.subDict("wall"), "gap");
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
    sphereWallKeys.check(dict);
    result.struct_size = sizeof(msdd_sphere_wall);
    result.conductivity = sphereWallKeys.number(dict, "thermalConductivity");
    result.young_modulus = sphereWallKeys.number(dict, "youngModulus");
    result.poisson_ratio = sphereWallKeys.number(dict, "poissonRatio");
    result.roughness = sphereWallKeys.number(dict, "roughness");
    if (result.roughness > 0)
    {
        const word key("hardness");
        result.hardness =
            sphereWallKeys.within(dict, key, dict.get<scalar>(key));
    }
    result.spheres = sphereWallKeys.number(dict, "spheres");
    result.emissivity =
        sphereWallKeys.number(dict, "emissivity", grains_.emissivity);
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularModels::spheres::initialState
(
    const known& cells,
    scalar* const* state
)
{
    if (!cells.stress)
    {
        FatalErrorInFunction
            << "Field stress is missing in "
            << (mesh_.time().path()/mesh_.time().timeName()).c_str()
            << ": surrogate type spheres needs the stress at the start [Pa],"
            << " tension positive, for example (-2000 0 0 -2000 0 -2000) of the"
            << " weight of a bed. Without it contacts and stiffness are"
            << " undetermined" << exit(FatalError);
    }
    scalarField solid(cells.size);
    scalar tension = 0;
    label tense = 0;
    forAll(solid, celli)
    {
        solid[celli] = 1 - cells.porosity[celli];
        const scalar p = tr(cells.stress[celli])/3;
        tense += p < 0;
        tension = max(tension, -p);
    }
    if (returnReduce(tense, sumOp<label>()))
    {
        FatalErrorInFunction
            << "Field stress in "
            << (mesh_.time().path()/mesh_.time().timeName()).c_str()
            << " is tension in " << returnReduce(tense, sumOp<label>())
            << " cells, in the mean of the directions up to "
            << returnReduce(tension, maxOp<scalar>()) << " Pa, allowed: at most"
            << " 0, because grains cannot carry tension. Tension is positive:"
            << " the stress of a bed under load is negative" << exit(FatalError);
    }
    // What is not given is left to the law
    const auto given = [&](const char* key)
    {
        scalarField result;
        if (coeffs_.found(key))
        {
            result.resize(cells.size, keys.number(coeffs_, key));
        }
        return result;
    };
    const scalarField contacts(given("coordination"));
    if
    (
        contacts.size()
     && (contacts[0] < leastContacts || contacts[0] > mostContacts)
    )
    {
        WarningInFunction
            << "Entry 'coordination' of spheresCoeffs is " << contacts[0]
            << ": random packings under load have from " << leastContacts
            << " to " << mostContacts << " contacts per sphere" << nl << endl;
    }
    // The stress of a packing depends on it, so a field cannot just replace the
    // column afterwards
    scalarField mobilised(given("mobilised"));
    const auto ofCells(givenField<scalar>(mesh_, "mobilised", dimless));
    if (ofCells.valid())
    {
        mobilised = ofCells().primitiveField();
    }
    const symmTensorField fabric(fabricAtStart(cells.size));
    const std::vector<msdd_input> directions
    (
        tensors<msdd_input>(fabric.empty() ? nullptr : fabric.cdata())
    );
    const std::vector<msdd_input> load(tensors<msdd_input>(cells.stress));
    const auto column = [](const scalarField& values)
    {
        return msdd::input(values.empty() ? nullptr : values.cdata());
    };
    msdd_start data(msdd::start(cells.size, 6));
    data.solid_fraction = msdd::input(solid.cdata());
    data.stress = load.data();
    data.coordination = column(contacts);
    data.mobilised = column(mobilised);
    data.fabric = msdd::table(directions);
    start(data, grains_, state);
    reportStart(cells.size, cells.stress, state);
}


Foam::symmTensorField
Foam::granularModels::spheres::fabricAtStart(const label size) const
{
    symmTensorField given;
    symmTensor everywhere;
    if (coeffs_.readIfPresent("fabric", everywhere))
    {
        given.resize(size, everywhere);
    }
    const auto ofCells(givenField<symmTensor>(mesh_, "fabric", dimless));
    if (ofCells.valid())
    {
        given = ofCells().primitiveField();
    }
    scalar most = 0;
    for (const symmTensor& F : given)
    {
        most = max(most, max(F.xx(), max(F.yy(), F.zz())));
        // A mean of squares: along no direction is it negative
        const bool possible =
            min(F.xx(), min(F.yy(), F.zz())) >= 0
         && sqr(F.xy()) <= F.xx()*F.yy()
         && sqr(F.xz()) <= F.xx()*F.zz()
         && sqr(F.yz()) <= F.yy()*F.zz()
         && det(F) >= -SMALL;
        if (!(possible && mag(tr(F) - 1) <= unitTrace))
        {
            OStringStream value;
            value << F;
            refuse
            (
                "fabric",
                value.str(),
                "the mean of n n over the contacts, with the normals n:"
                " (xx xy xz yy yz zz) with xx + yy + zz = 1, and along no"
                " direction negative"
            );
        }
    }
    reduce(most, maxOp<scalar>());
    if (most > mostFabric)
    {
        WarningInFunction
            << "Entry 'fabric' of spheresCoeffs has a component of " << most
            << ": random packings have up to " << mostFabric
            << ", isotropic ones 1/3" << nl << endl;
    }
    return given;
}


void Foam::granularModels::spheres::reportStart
(
    const label size,
    const symmTensor* given,
    scalar* const* state
) const
{
    symmTensorField found(size);
    query start;
    start.size = size;
    start.state = state;
    start.stress = found.data();
    columns all(columnsOf(start));
    surrogateModel::advance(all, grains_);
    scalar most = 0;
    for (label celli = 0; celli < size; ++celli)
    {
        const scalar p = tr(given[celli])/3;
        if (p > 0)
        {
            most = max(most, cmptMax(cmptMag(found[celli] - given[celli]))/p);
        }
    }
    reduce(most, maxOp<scalar>());
    if (most > notable)
    {
        Info<< "The stress at the start is more than packings of this porosity"
            << " carry: it is changed by up to " << most << " of the pressure, to"
            << " what the law allows" << nl << endl;
    }
}


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
