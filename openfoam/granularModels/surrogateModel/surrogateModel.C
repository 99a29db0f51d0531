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

#include "surrogateModel.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Fields of the solver besides the state of a model (the book's columns: range;
//- read at the start, written)
static const keyTable ownFields
(
    "fields",
    {
        {
            "T",
            "temperature of the grains, with OpenFOAM's boundary conditions that"
            " need neither a flow nor a thermo", "K", "> 0", "required, out"
        },
        {
            "stress",
            "stress, tension positive; at the start by default the mean of"
            " packings in that state", "Pa", "any", "in, out"
        },
        {
            "conductivity",
            "conductivity of the bed; at the start the packing's own, by default"
            " the mean of packings in that state", "W/(m K)", "> 0",
            "in, out"
        },
        {
            "pressure",
            "mean of xx and yy (discs) or of xx, yy and zz (spheres),"
            " compression positive", "Pa", "any", "out"
        },
        {
            "thermalStrain",
            "strain of the radii by thermal expansion since"
            " `initialTemperature`", "-", "> -1", "out"
        },
        {
            "bulkDensity", "mass of grains per volume of the bed", "kg/m3",
            "> 0", "restart, out"
        },
        {
            "particleDensity",
            "`bulkDensity` over (1 - porosity), over `areaRatio` where cells"
            " move", "kg/m3", "> 0", "out"
        },
        {
            "inTrainingRange", "1 where the model was trained for the state, else 0",
            "-", "0, 1", "out"
        },
        {
            "wallResistance",
            "what a wall with the condition"
            " [`granularContact`](regions.md#the-resistance-of-a-wall) adds to"
            " the resistance of the bed", "m2 K/W", ">= 0", "out"
        },
        {
            "spread",
            "relative standard deviation of the conductivity between packings"
            " of equal state, if the model gives it", "-", ">= 0", "out"
        },
        {
            "initialTemperature",
            "temperature without thermal strain, here or as"
            " [key](granular-properties.md#the-grains); by default T at the"
            " start", "K", ">= 0", "in, out"
        },
        {
            "thermalStrainIncrement",
            "strain for which the model was not evaluated yet", "-", "> -1",
            "restart, out"
        },
        {
            "D", "displacement of the cells since the start", "m", "any", "out"
        },
        {
            "areaRatio", "area (volume) of a cell over that at the start", "-",
            "> 0", "out"
        },
        {
            "nodeDisplacement", "displacement of the points of the mesh", "m",
            "any", "restart, out"
        },
        {
            "nodeVelocity", "its mean rate over the last step", "m/s", "any",
            "restart, out"
        },
        {
            "nodeVelocityBefore",
            "of spheres: the rate over the step before the last", "m/s", "any",
            "restart, out"
        },
        {
            "wallTraction",
            "friction force per area of walls but shells and pistons", "Pa",
            "any", "restart, out"
        },
        {
            "shellTraction", "the same of shells, if they have friction", "Pa",
            "any", "restart, out"
        },
        {
            "pistonTraction", "the same of pistons", "Pa", "any", "restart, out"
        },
        {
            "shellMotion",
            "thermal motion along its axis of a shell with friction", "m",
            "any", "restart, out"
        },
        {
            "wallGive",
            "slip of the grains at walls with the key `slackLayer`, along the outward"
            " normal", "m", "any", "restart, out"
        },
        {
            "initialStress", "stress at the start, tension positive", "Pa",
            "any", "restart, out"
        }
    }
);

//- Names of these and of the solver's folders, which no column may have
static wordList ownNames()
{
    wordList names
    ({
        "Kxx", "Kyy", "granularProperties", "msddFoam", "onlineRve", "polyMesh",
        "uniform"
    });
    for (const keyTable::entry& field : ownFields.entries())
    {
        names.append(field.name);
    }
    return names;
}


//- End the run: the library failed, for example on inputs that are not finite
static void failed(const char* what, const std::exception& error)
{
    FatalErrorInFunction
        << "The surrogate model failed on " << what << ": " << error.what()
        << exit(FatalError);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::surrogateModel::surrogateModel
(
    const word& type,
    const word& key,
    const fileName& source,
    const string& allowed,
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    granularModel(type, properties, mesh),
    source_(source),
    model_(load(key, allowed)),
    material_
    (
        msdd::material
        (
            properties.thermalConductivity().value(),
            properties.youngModulus().value(),
            properties.meanRadius().value()
        )
    )
{
    stateNames_.resize(label(model_.stateSize()));
    columnNames_.resize(stateNames_.size());
    forAll(stateNames_, i)
    {
        columnNames_[i] = model_.stateName(i);
        stateNames_[i] = fieldName(columnNames_[i]);
    }
    checkHash(source_, model_.hash());
    checkNames();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

msdd::Surrogate Foam::granularModels::surrogateModel::load
(
    const word& key,
    const string& allowed
) const
{
    const bool builtin = source_ == "builtin" || source_.startsWith("builtin:");
    const std::string prefix(key == "library" ? "plugin:" : "");

    try
    {
        return msdd::Surrogate
        (
            builtin ? std::string(source_) : prefix + properties_.path(source_)
        );
    }
    catch (const std::exception& error)
    {
        refuse(key, '"' + source_ + '"', allowed + ": " + error.what());
        throw;
    }
}


void Foam::granularModels::surrogateModel::checkNames() const
{
    for (label i = 2; i < stateNames_.size(); ++i)
    {
        const word& name = stateNames_[i];

        if (ownNames().found(name) || mesh_.thisDb().found(name))
        {
            FatalIOErrorInFunction(coeffs_)
                << "Model " << source_ << " has the state column "
                << model_.stateName(i) << ", whose field " << name
                << " the solver or its mesh has itself." << nl
                << "Allowed: any name except fields of the mesh and "
                << granularProperties::listed(ownNames()).c_str()
                << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularModels::surrogateModel::initialState
(
    const known& cells,
    scalar* const* state
)
{
    msdd_initial initial(msdd::initial(cells.size));
    initial.porosity = cells.porosity;
    initial.fabric_index = cells.fabricIndex;
    initial.stress_xx = cells.stressXX;
    initial.stress_yy = cells.stressYY;
    initial.stress_xy = cells.stressXY;
    initial.conductivity_xx = cells.conductivityXX;
    initial.conductivity_yy = cells.conductivityYY;
    initial.conductivity_xy = cells.conductivityXY;

    try
    {
        model_.initialState(material_, initial, state);
    }
    catch (const std::exception& error)
    {
        failed("the initial state", error);
    }
}


Foam::label Foam::granularModels::surrogateModel::advance(const query& cells)
{
    msdd_batch batch(msdd::batch(cells.size));
    batch.state = cells.state;
    batch.next_state = cells.nextState;
    batch.thermal_strain = cells.strain;
    batch.total_thermal_strain = cells.totalStrain;
    batch.conductivity_xx = cells.conductivityXX;
    batch.conductivity_yy = cells.conductivityYY;
    batch.conductivity_xy = cells.conductivityXY;
    batch.stress_xx = cells.stressXX;
    batch.stress_yy = cells.stressYY;
    batch.stress_xy = cells.stressXY;
    batch.outside = cells.outside;
    if (cells.cellStrain)
    {
        batch.strain_xx = cells.cellStrain[0];
        batch.strain_yy = cells.cellStrain[1];
        batch.strain_xy = cells.cellStrain[2];
        batch.rotation = cells.rotation[0];
    }
    batch.tangent = cells.tangent;

    try
    {
        model_.advance(material_, batch);
    }
    catch (const std::exception& error)
    {
        failed("the state of the cells", error);
    }
    return label(batch.clamped_cells);
}


bool Foam::granularModels::surrogateModel::spread
(
    const query& cells,
    scalarField& result
) const
{
    msdd_batch batch(msdd::batch(cells.size));
    batch.state = cells.state;
    batch.thermal_strain = cells.strain;
    batch.spread = result.data();

    try
    {
        model_.advance(material_, batch);
    }
    catch (const std::exception& error)
    {
        failed("the spread of the cells", error);
    }
    return result.empty() || !std::isnan(result[0]);
}


bool Foam::granularModels::surrogateModel::wallFriction
(
    scalar& limit,
    scalar& slip
) const
{
    return model_.wallFriction(material_, limit, slip);
}


void Foam::granularModels::surrogateModel::solidFraction
(
    const scalarField& porosity,
    scalarField& fraction
) const
{
    try
    {
        model_.solidFraction
        (
            porosity.size(),
            porosity.cdata(),
            fraction.data()
        );
    }
    catch (const std::exception& error)
    {
        failed("the initial porosity", error);
    }
}


// ************************************************************************* //
