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

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

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


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::label Foam::grainFields::readColumns(PtrList<volScalarField>& read)
{
    const wordList& names = model_->stateNames();
    label missing = 0;
    read.resize(names.size());
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
    return missing;
}


Foam::tmp<Foam::symmTensorField> Foam::grainFields::startStress()
{
    const auto given(givenField<symmTensor>(mesh_, "stress", dimPressure));
    if (properties_.found("restStress") && mesh_.time().timeIndex() == 0)
    {
        if (given.valid())
        {
            FatalIOErrorInFunction(properties_)
                << "Entry 'restStress' is given together with the field stress in "
                << given().objectPath()
                << ", allowed: one of both" << exit(FatalIOError);
        }
        return restStress();
    }
    if (!given.valid())
    {
        return nullptr;
    }
    return tmp<symmTensorField>::New(given().primitiveField());
}


void Foam::grainFields::findInitialState(const bool missing)
{
    const tmp<symmTensorField> stress(startStress());
    const auto conductivity
    (
        givenField<symmTensor>(mesh_, "conductivity", conductivity_.dimensions())
    );
    symmTensorField sigma;
    granularModel::known known;
    known.size = mesh_.nCells();
    if (stress.valid())
    {
        // Tension positive becomes compression positive
        sigma = -stress();
        known.stress = sigma.cdata();
        if (model_->isThreeDimensional())
        {
            compareWithPlane(mesh_, stress());
        }
    }
    if (conductivity.valid() && missing)
    {
        known.conductivity = conductivity().primitiveField().cdata();
    }

    List<scalar*> pointers(state_.size());
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
        policy_.judgeStart(state_[0].primitiveField(), loosest, unjammed);
    }
    model_->initialState(known, pointers.cdata());
}


void Foam::grainFields::readState()
{
    PtrList<volScalarField> read;
    const label missing = readColumns(read);

    // If all columns of the state were read (a restart), or if the model has
    // only porosity and fabric index, no other field is needed
    if (missing || state_.size() == 2)
    {
        findInitialState(missing);
    }

    Info<< "State of the model:";
    forAll(state_, i)
    {
        if (read.set(i))
        {
            state_[i].primitiveFieldRef() = read[i].primitiveField();
        }
        state_[i].correctBoundaryConditions();
        Info<< ' ' << state_[i].name()
            << (i < 2 || read.set(i) ? " (read)" : "");
    }
    Info<< nl << endl;
}


// ************************************************************************* //
