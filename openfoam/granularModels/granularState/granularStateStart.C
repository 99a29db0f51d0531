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

#include "granularState.H"
#include "caseChecks.H"
#include "givenField.H"
#include "wallDistance.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "OStringStream.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Thermal strain of a part in which the grains grow at the start, and least
//- number of parts: spheres under a small load are stiff
static const scalar largestPart = 1e-3;
static const label leastParts = 20;

//- FatalError unless all values are numbers between the limits, which are
//- themselves excluded
static void checkField
(
    const volScalarField& field,
    const dimensionSet& dims,
    const scalar low,
    const scalar high
)
{
    if (field.dimensions() != dims)
    {
        FatalErrorInFunction
            << "Field " << field.name() << " in " << field.objectPath()
            << " has dimensions " << field.dimensions() << ", allowed: "
            << dims << exit(FatalError);
    }
    forAll(field, celli)
    {
        const scalar value = field[celli];
        if (!std::isfinite(value) || value <= low || value >= high)
        {
            FatalErrorInFunction
                << "Field " << field.name() << " in " << field.objectPath()
                << " is " << value << " in cell " << celli
                << ", allowed: between " << low << " and " << high
                << exit(FatalError);
        }
    }
}


//- Shear out of the plane over the pressure above which there is a warning
static const scalar muchShear = 1e-3;


//- Warn of a stress that cannot be that of a mesh of one layer
static void compareWithPlane(const fvMesh& mesh, const symmTensorField& stress)
{
    scalar shear = 0, pressure = 0;
    forAll(stress, celli)
    {
        const symmTensor& s = stress[celli];
        const scalar here = mag(s.xz()) + mag(s.yz());
        if (here > shear)
        {
            shear = here;
            pressure = -tr(s)/3;
        }
    }
    const vector worst
    (
        returnReduce(vector(shear, pressure, 0), maxOp<vector>())
    );
    if (mesh.geometricD()[vector::Z] == -1 && worst.x() > muchShear*worst.y())
    {
        WarningInFunction
            << "Field stress in "
            << (mesh.time().path()/mesh.time().timeName()).c_str()
            << " has a shear out of the plane of the mesh (xz, yz) of up to "
            << worst.x() << " Pa, where the pressure is " << worst.y()
            << " Pa. Both sides of this plane are equal, so that this shear is"
            << " 0; it weakens the packing as one that it bore" << nl << endl;
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularState::granularState
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
    bound_(0),
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
    strengthGiven_(false),
    deforms_(false),
    queries_(0),
    rowsAsked_(0),
    cellSteps_(0),
    clamped_(0),
    clampedNow_(0),
    outsideSeen_(false)
{
    record_.compare(settings());
    record_.course.compare(model_->hash(), model_->stressScale());
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
    allocate();
    if (!bulkDensity_.typeHeaderOk<volScalarField>(true))
    {
        setInitialBulkDensity();
    }
    if (!record_.continues)
    {
        record_.startHeat = storedHeat(T);
    }
    findWalls(T);
    askStart();
    reportWalls(T);
    findReaders();
    refresh();
    record_.refresh = [this]() { refresh(); };
    const scalar across =
        leastWallDistance(mesh_)/(2*properties_.meanRadius().value());
    if (across > 0)
    {
        record_.course.see(runCourse::across, across, across);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

// The patch type extrapolatedCalculated, used above, gives boundary faces the
// value of their cell: the conductivity at a wall is that of the cell beside it

Foam::IOobject Foam::granularState::io
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


void Foam::granularState::readState()
{
    const wordList& names = model_->stateNames();
    PtrList<volScalarField> read(names.size());
    label missing = 0;

    state_.resize(names.size());
    forAll(names, i)
    {
        if (i < 2)
        {
            Info<< "Reading field " << names[i] << endl;
            state_.set
            (
                i,
                new volScalarField(io(names[i], IOobject::MUST_READ), mesh_)
            );
            continue;
        }
        autoPtr<volScalarField> field
        (
            givenField<scalar>(mesh_, names[i], dimless)
        );
        missing += !field.valid();
        state_.set
        (
            i,
            new volScalarField
            (
                io(names[i]),
                mesh_,
                dimensionedScalar(dimless, Zero),
                extrapolatedCalculatedFvPatchScalarField::typeName
            )
        );
        if (field.valid())
        {
            strengthGiven_ = strengthGiven_ || names[i] == "strength";
            read.set(i, field.release());
        }
    }
    checkField(state_[0], dimless, 0, 1);
    checkField(state_[1], dimless, -1, 1);

    // If all columns of the state were read (a restart), or if the model has
    // only porosity and fabric index, no other field is needed
    if (missing || names.size() == 2)
    {
        const auto givenStress
        (
            givenField<symmTensor>(mesh_, "stress", dimPressure)
        );
        tmp<symmTensorField> stress;
        if (properties_.found("restStress") && mesh_.time().timeIndex() == 0)
        {
            if (givenStress.valid())
            {
                FatalIOErrorInFunction(properties_)
                    << "Entry 'restStress' is given together with the field stress in "
                    << givenStress().objectPath()
                    << ", allowed: one of both" << exit(FatalIOError);
            }
            stress = restStress();
        }
        else if (givenStress.valid())
        {
            stress = tmp<symmTensorField>::New(givenStress().primitiveField());
        }
        const auto conductivity
        (
            givenField<symmTensor>
            (
                mesh_, "conductivity", conductivity_.dimensions()
            )
        );
        scalarField xx, yy, xy, zz, xz, yz, Kxx, Kyy, Kxy;
        granularModel::known known;
        known.size = mesh_.nCells();
        if (stress.valid())
        {
            // Tension positive becomes compression positive
            xx = -stress().component(symmTensor::XX);
            yy = -stress().component(symmTensor::YY);
            known.stressXX = xx.cdata();
            known.stressYY = yy.cdata();
            if (!model_->diagonal())
            {
                xy = -stress().component(symmTensor::XY);
                known.stressXY = xy.cdata();
            }
            if (model_->isThreeDimensional())
            {
                zz = -stress().component(symmTensor::ZZ);
                xz = -stress().component(symmTensor::XZ);
                yz = -stress().component(symmTensor::YZ);
                known.stressZZ = zz.cdata();
                known.stressXZ = xz.cdata();
                known.stressYZ = yz.cdata();
                compareWithPlane(mesh_, stress());
            }
        }
        if (conductivity.valid() && missing)
        {
            Kxx = conductivity().primitiveField().component(symmTensor::XX);
            Kyy = conductivity().primitiveField().component(symmTensor::YY);
            known.conductivityXX = Kxx.cdata();
            known.conductivityYY = Kyy.cdata();
            if (!model_->diagonal())
            {
                Kxy = conductivity().primitiveField().component(symmTensor::XY);
                known.conductivityXY = Kxy.cdata();
            }
        }

        List<scalar*> pointers(names.size());
        forAll(pointers, i)
        {
            pointers[i] = state_[i].primitiveFieldRef().data();
        }
        known.porosity = pointers[0];
        known.fabricIndex = pointers[1];
        scalar loosest, unjammed;
        if
        (
            mesh_.time().timeIndex() == 0 && !stress.valid()
         && model_->porosityRange(loosest, unjammed)
        )
        {
            policy_.judgeStart
            (
                state_[0].primitiveField(),
                loosest,
                unjammed
            );
        }
        model_->initialState(known, pointers.cdata());
    }

    Info<< "State of the model:";
    forAll(names, i)
    {
        if (read.set(i))
        {
            state_[i].primitiveFieldRef() = read[i].primitiveField();
        }
        state_[i].correctBoundaryConditions();
        Info<< ' ' << names[i] << (i < 2 || read.set(i) ? " (read)" : "");
    }
    Info<< nl << endl;
}


void Foam::granularState::allocate()
{
    const label cells = mesh_.nCells();
    const label count = state_.size();

    bound_ = model_->smallestStrain();
    for
    (
        scalarField* column :
        {
            &lastStrain_, &strain_, &halfStrain_, &total_, &zero_,
            &askedTemperature_
        }
    )
    {
        column->resize(cells, Zero);
    }
    asked_.setSize(count, model_->components(), cells);
    sigma_ = asked_.stress;
    rows_.setCapacity(cells);
    before_.setSize(count, cells);
}


Foam::scalarField Foam::granularState::initialSolid() const
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


void Foam::granularState::setInitialBulkDensity()
{
    scalarField& density = bulkDensity_.primitiveFieldRef();
    density = properties_.density().value()*initialSolid();
    bulkDensity_.correctBoundaryConditions();
    record_.initialMass = gSum(density*mesh_.V());
}


bool Foam::granularState::writtenByRun() const
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


void Foam::granularState::setInitialTemperature()
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


void Foam::granularState::beginWherePlaced()
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


void Foam::granularState::warm
(
    const volScalarField& T,
    const std::function<void()>& balance
)
{
    const scalarField start(temperature_);
    const scalarField way(T.primitiveField() - start);
    if (!(gMax(mag(way)()) > 0))
    {
        return;
    }
    const scalar largest =
        properties_.thermalExpansion().value()*gMax(mag(way)());
    const label parts =
        largest > 0
      ? max(leastParts, label(std::ceil(largest/largestPart)))
      : 1;
    for (label part = 1; part <= parts; ++part)
    {
        const scalarField from(temperature_);
        strain
        (
            from,
            part == parts
          ? scalarField(T.primitiveField())
          : scalarField(start + (scalar(part)/parts)*way)
        );
        scalar error;
        if (propose(false, error))
        {
            policy_.refuseCut();
        }
        balance();
        commit();
    }
    refresh();

    OStringStream text;
    text.precision(4);
    text<< "The bed has no thermal strain at initialTemperature, "
        << gMin(start) << " to " << gMax(start) << " K. It was brought to T, "
        << gMin(T.primitiveField()) << " to " << gMax(T.primitiveField())
        << " K, by a thermal strain of up to " << largest << " in " << parts
        << " parts: the mean pressure at the start is "
        << pressure_.weightedAverage(mesh_.V()).value() << " Pa.";
    runRecord::note(text.str());
}


void Foam::granularState::askStart()
{
    rows_ = identity(mesh_.nCells());
    gather(zero_);

    const bool restarted = mesh_.time().timeIndex() > 0;
    const label outside = ask(before_, asked_.state, strain_, false);
    if (judge(outside, asked_.state, "At the start") && !restarted)
    {
        policy_.refuseCut();
    }
    policy_.accept();

    // This query is without strain. After a restart, strain accumulated in
    // thermalStrainIncrement is left for the first step, and the total strain
    // given here already contains it
    const scalarField waiting(thermalStrainIncrement_.primitiveField());
    commit();
    startIncrement_ = waiting;
    thermalStrainIncrement_.primitiveFieldRef() = waiting;

    // The strain of the last query is not known after a restart; any value
    // but 0 makes the next query include all cells
    lastStrain_ = restarted ? 1 : 0;
}


// ************************************************************************* //
