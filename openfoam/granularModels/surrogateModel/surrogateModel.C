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
    model_(load(key, allowed, type == "spheres")),
    inSpace_(model_.components() == 6),
    hasTangent_(model_.hasTangent()),
    grains_
    (
        msdd::grains
        (
            properties.thermalConductivity().value(),
            properties.youngModulus().value(),
            properties.meanRadius().value()
        )
    )
{
    // Spheres have porosity and fabric index besides the columns of their model
    own_ = inSpace_ ? stateNames_.size() : 0;
    stateNames_.resize(own_ + label(model_.stateSize()));
    columnNames_.resize(stateNames_.size());
    for (label i = own_; i < stateNames_.size(); ++i)
    {
        columnNames_[i] = model_.stateName(i - own_);
        stateNames_[i] = fieldName(columnNames_[i]);
    }
    checkHash(source_, model_.hash());
    checkNames();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

msdd::Model Foam::granularModels::surrogateModel::load
(
    const word& key,
    const string& allowed,
    const bool spheres
) const
{
    const bool builtin = source_ == "builtin" || source_.startsWith("builtin:");
    const std::string prefix(key == "library" ? "plugin:" : "");

    try
    {
        msdd::Model model
        (
            builtin
          ? std::string(source_) + (spheres ? ":spheres" : "")
          : prefix + properties_.path(source_)
        );
        if ((model.components() == 6) != spheres)
        {
            throw std::runtime_error
            (
                spheres ? "it is a model of discs" : "it is a model of spheres"
            );
        }
        return model;
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
                << std::string(columnNames_[i]) << ", whose field " << name
                << " the solver or its mesh has itself." << nl
                << "Allowed: any name except fields of the mesh and "
                << granularProperties::listed(ownNames()).c_str()
                << exit(FatalIOError);
        }
    }
}


Foam::granularModels::surrogateModel::columns
Foam::granularModels::surrogateModel::columnsOf(const query& cells) const
{
    const label n = components();
    const bool inSpace = inSpace_;
    columns result;
    result.state = msdd::inputs(cells.state + own_, model_.stateSize());
    result.strain = msdd::inputs(cells.cellStrain, n);
    if (cells.cellStrain)
    {
        result.rotation = msdd::inputs(cells.rotation, inSpace ? 3 : 1);
    }
    if (cells.nextState)
    {
        result.nextState =
            msdd::outputs(cells.nextState + own_, model_.stateSize());
    }
    result.conductivity = tensors<msdd_output>(cells.conductivity);
    result.stress = tensors<msdd_output>(cells.stress);
    result.tangent = msdd::outputs(cells.tangent, n*n);
    result.distance = msdd::outputs(cells.outside, model_.stateSize() + 1);
    result.step = msdd::step(cells.size, n);
    result.step.thermal_strain = msdd::input(cells.strain);
    result.step.total_thermal_strain = msdd::input(cells.totalStrain);
    result.step.outside = cells.outsideRow;
    return result;
}


void Foam::granularModels::surrogateModel::advance
(
    columns& columns,
    const msdd_grains& grains
) const
{
    msdd_step& step = columns.step;
    step.state = msdd::table(columns.state);
    step.strain = msdd::table(columns.strain);
    step.rotation = msdd::table(columns.rotation);
    step.next_state = msdd::table(columns.nextState);
    step.conductivity = msdd::table(columns.conductivity);
    step.stress = msdd::table(columns.stress);
    step.tangent = msdd::table(columns.tangent);
    step.distance = msdd::table(columns.distance);
    try
    {
        model_.advance(grains, step);
    }
    catch (const std::exception& error)
    {
        failed("the state of the cells", error);
    }
}


void Foam::granularModels::surrogateModel::start
(
    const msdd_start& start,
    const msdd_grains& grains,
    scalar* const* state
) const
{
    const std::vector<msdd_output> columns
    (
        msdd::outputs(state + own_, model_.stateSize())
    );
    try
    {
        model_.initialState(grains, start, columns.data());
    }
    catch (const std::exception& error)
    {
        failed("the initial state", error);
    }
}


void Foam::granularModels::surrogateModel::failed
(
    const char* what,
    const std::exception& error
)
{
    FatalErrorInFunction
        << "The model failed on " << what << ": " << error.what()
        << exit(FatalError);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularModels::surrogateModel::initialState
(
    const known& cells,
    scalar* const* state
)
{
    const std::vector<msdd_input> stress(tensors<msdd_input>(cells.stress));
    const std::vector<msdd_input> conductivity
    (
        tensors<msdd_input>(cells.conductivity)
    );
    msdd_start data(msdd::start(cells.size, components()));
    data.porosity = msdd::input(cells.porosity);
    data.fabric_index = msdd::input(cells.fabricIndex);
    data.stress = msdd::table(stress);
    data.conductivity = msdd::table(conductivity);
    start(data, grains_, state);
}


Foam::label Foam::granularModels::surrogateModel::advance(const query& cells)
{
    columns all(columnsOf(cells));
    advance(all, grains_);
    return label(all.step.outside_cells);
}


bool Foam::granularModels::surrogateModel::spread
(
    const query& cells,
    scalarField& result
) const
{
    columns all(columnsOf(cells));
    all.step.spread = msdd::output(result.data());
    advance(all, grains_);
    return result.empty() || !std::isnan(result[0]);
}


bool Foam::granularModels::surrogateModel::wallFriction
(
    scalar& limit,
    scalar& slip
) const
{
    return model_.wallFriction(grains_, limit, slip);
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
