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

#include "grainFields.H"
#include "caseChecks.H"
#include "givenField.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "OStringStream.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::grainFields::grainFields
(
    const granularProperties& properties,
    const volScalarField& T
)
:
    properties_(properties),
    mesh_(T.mesh()),
    model_(granularModel::New(properties, mesh_)),
    policy_
    (
        properties,
        mesh_,
        model_->stateNames(),
        model_->columnNames(),
        model_->hash()
    ),
    record_(mesh_),
    initialTemperature_(io("initialTemperature", IOobject::READ_IF_PRESENT), T),
    thermalStrainIncrement_
    (
        io("thermalStrainIncrement", IOobject::READ_IF_PRESENT),
        mesh_,
        dimensionedScalar(dimless, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    bulkDensity_
    (
        io("bulkDensity", IOobject::READ_IF_PRESENT),
        mesh_,
        dimensionedScalar(dimDensity, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    thermalStrain_
    (
        io("thermalStrain"),
        mesh_,
        dimensionedScalar(dimless, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    conductivity_
    (
        io("conductivity"),
        mesh_,
        dimensionedSymmTensor(dimPower/dimLength/dimTemperature, Zero),
        extrapolatedCalculatedFvPatchSymmTensorField::typeName
    ),
    stress_
    (
        io("stress"),
        mesh_,
        dimensionedSymmTensor(dimPressure, Zero),
        extrapolatedCalculatedFvPatchSymmTensorField::typeName
    ),
    pressure_
    (
        io("pressure"),
        mesh_,
        dimensionedScalar(dimPressure, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    particleDensity_
    (
        io("particleDensity"),
        mesh_,
        dimensionedScalar(dimDensity, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    inTrainingRange_
    (
        io("inTrainingRange"),
        mesh_,
        dimensionedScalar(dimless, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    refreshAlways_(false),
    strengthGiven_(false)
{
    record_.compare(settings());
    record_.course.compare
    (
        model_->hash(), model_->stressScale(), model_->isThreeDimensional()
    );
    checkField(T, dimTemperature, -GREAT, GREAT);
    checkField(initialTemperature_, dimTemperature, -GREAT, GREAT);
    checkInitialTemperature(T);
    setInitialTemperature();
    checkInitialTemperature(initialTemperature_);
    checkVolumes(mesh_);
    checkTimeStep(mesh_.time());
    temperature_ =
        writtenByRun()
      ? T.primitiveField()
      : initialTemperature_.primitiveField();
    thermalStrain_.primitiveFieldRef() =
        properties_.thermalExpansion().value()
       *(temperature_ - initialTemperature_.primitiveField());
    inTrainingRange_.primitiveFieldRef() = 1;

    readState();
    if (!bulkDensity_.typeHeaderOk<volScalarField>(true))
    {
        setInitialBulkDensity();
    }
    if (!record_.continues)
    {
        record_.startHeat = storedHeat(T);
    }
    findWalls(T);
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

// The patch type extrapolatedCalculated, used above, gives boundary faces the
// value of their cell: the conductivity at a wall is that of the cell next to it

Foam::IOobject Foam::grainFields::io
(
    const word& name,
    const IOobject::readOption read
) const
{
    return IOobject
    (
        name, mesh_.time().timeName(), mesh_, read, IOobject::AUTO_WRITE
    );
}


Foam::scalarField Foam::grainFields::initialSolid() const
{
    // The paper's rho (1 - porosity) counts the overlaps of grains once and so
    // loses their mass; the mass-consistent density counts every grain in full
    scalarField solid(1 - porosity().primitiveField());
    if
    (
        properties_.bulkDensity()
     == granularProperties::bulkDensityModel::massConsistent
    )
    {
        model_->solidFraction(porosity().primitiveField(), solid);
    }
    return solid;
}


void Foam::grainFields::setInitialBulkDensity()
{
    scalarField& density = bulkDensity_.primitiveFieldRef();
    density = properties_.density().value()*initialSolid();
    bulkDensity_.correctBoundaryConditions();
    record_.initialMass = gSum(density*mesh_.V());
}


bool Foam::grainFields::writtenByRun() const
{
    if (record_.continues || mesh_.time().timeIndex() > 0)
    {
        return true;
    }
    const auto there = [this](const word& name)
    {
        IOobject header(io(name, IOobject::MUST_READ));
        return returnReduce
        (
            header.typeHeaderOk<volScalarField>(true), andOp<bool>()
        );
    };
    if (!there("thermalStrainIncrement"))
    {
        return false;
    }
    const bool temperature = there("initialTemperature");
    if (temperature != there("bulkDensity"))
    {
        FatalErrorInFunction
            << "Time " << mesh_.time().timeName() << " in "
            << mesh_.time().path()/mesh_.dbDir() << " has the field"
            << " thermalStrainIncrement and only one of initialTemperature and"
            << " bulkDensity, allowed: both, to begin with the state of a run"
            << " that has written them; or none, to begin at the temperature T"
            << exit(FatalError);
    }
    return temperature;
}


void Foam::grainFields::setInitialTemperature()
{
    const word key("initialTemperature");
    if (record_.continues || !properties_.found(key))
    {
        return;
    }
    if (initialTemperature_.typeHeaderOk<volScalarField>(true))
    {
        FatalIOErrorInFunction(properties_)
            << "Entry '" << key << "' is given together with the field of this name in "
            << initialTemperature_.objectPath() << ", allowed: one of both"
            << exit(FatalIOError);
    }
    initialTemperature_ == dimensionedScalar
    (
        key, dimTemperature,
        granularProperties::grainKeys.number(properties_, key)
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::grainFields::beginWherePlaced()
{
    const auto ratio(givenField<scalar>(mesh_, "areaRatio", dimless));
    if (!ratio.valid())
    {
        return;
    }
    checkField(ratio(), dimless, 0, GREAT);
    const volScalarField& T = mesh_.lookupObject<volScalarField>("T");
    const scalar mass = gSum(this->mass()), heat = storedHeat(T);
    bulkDensity_.primitiveFieldRef() /= ratio().primitiveField();
    bulkDensity_.correctBoundaryConditions();
    record_.initialMass = gSum(this->mass());
    record_.startHeat += storedHeat(T) - heat;

    OStringStream text;
    text.precision(4);
    text<< "The fields of time " << mesh_.time().timeName() << " belong to"
        << " grains that have moved (areaRatio " << gMin(ratio().primitiveField())
        << " to " << gMax(ratio().primitiveField()) << "), without what"
        << " says from where, nodeDisplacement and initialStress. They begin"
        << " anew where the mesh has them: with displacement 0, areaRatio 1, the"
        << " stress of now as initialStress, no friction of walls yet, and the"
        << " bulk density of now (mass " << record_.initialMass << " kg, before "
        << mass << " kg).";
    runRecord::note(text.str());
}


// ************************************************************************* //
