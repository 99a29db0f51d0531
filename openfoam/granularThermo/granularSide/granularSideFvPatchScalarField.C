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

#include "granularSideFvPatchScalarField.H"
#include "granularSolidThermo.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularSideFvPatchScalarField::granularSideFvPatchScalarField
(
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF
)
:
    mixedFvPatchScalarField(p, iF)
{
    refValue() = Zero;
    refGrad() = Zero;
    valueFraction() = 1;
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

void Foam::granularSideFvPatchScalarField::readValues(const dictionary& dict)
{
    // Without a value the wall begins at the temperature of its cells
    fvPatchScalarField::operator=
    (
        dict.found("value")
      ? scalarField("value", dict, size())
      : patchInternalField()()
    );
    if (dict.found("refValue"))
    {
        refValue() = scalarField("refValue", dict, size());
        refGrad() = scalarField("refGradient", dict, size());
        valueFraction() = scalarField("valueFraction", dict, size());
    }
    else
    {
        refValue() = *this;
        refGrad() = Zero;
        valueFraction() = 1;
    }
}


void Foam::granularSideFvPatchScalarField::refuse(const string& what) const
{
    FatalErrorInFunction
        << "Patch " << patch().name() << " of field "
        << internalField().objectPath() << " has the condition "
        << type() << " and " << what.c_str() << exit(FatalError);
}


Foam::tmp<Foam::scalarField>
Foam::granularSideFvPatchScalarField::kappa() const
{
    const fvMesh& mesh = patch().boundaryMesh().mesh();
    if (mesh.foundObject<solidThermo>(basicThermo::dictName))
    {
        const solidThermo& thermo =
            mesh.lookupObject<solidThermo>(basicThermo::dictName);
        if (!thermo.isotropic() && !isA<granularSolidThermo>(thermo))
        {
            refuse
            (
                "its region has a conductivity with directions, allowed: beds,"
                " and solids without directions"
            );
        }
        return thermo.kappa(patch().index());
    }
    if (!mesh.foundObject<volSymmTensorField>("K"))
    {
        refuse
        (
            "its region is neither a bed nor a solid, allowed: these two. A"
            " fluid has compressible::turbulentTemperatureRadCoupledMixed"
        );
    }
    const vectorField n(patch().nf());
    const symmTensorField& K =
        patch().lookupPatchField<volSymmTensorField, symmTensor>("K");
    return n & (K & n);
}


bool Foam::granularSideFvPatchScalarField::resistance(scalarField& R) const
{
    const fvMesh& mesh = patch().boundaryMesh().mesh();
    if (!mesh.foundObject<volScalarField>("wallResistance"))
    {
        return false;
    }
    R = patch().lookupPatchField<volScalarField, scalar>("wallResistance");
    return true;
}


// ************************************************************************* //
