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

#include "granularContactFvPatchScalarField.H"
#include "addToRunTimeSelectionTable.H"
#include "fvPatchFieldMapper.H"
#include "granularSolidThermo.H"
#include "mappedPatchBase.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularContactFvPatchScalarField::granularContactFvPatchScalarField
(
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF
)
:
    mixedFvPatchScalarField(p, iF),
    TnbrName_("T")
{
    refValue() = Zero;
    refGrad() = Zero;
    valueFraction() = 1;
}


Foam::granularContactFvPatchScalarField::granularContactFvPatchScalarField
(
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF,
    const dictionary& dict
)
:
    mixedFvPatchScalarField(p, iF),
    TnbrName_(dict.getOrDefault<word>("Tnbr", "T"))
{
    if (!isA<mappedPatchBase>(p.patch()))
    {
        refuse("is of type " + p.type() + ", allowed: mappedWall");
    }
    if (dict.getOrDefault("useImplicit", false))
    {
        refuse("useImplicit true, allowed: false");
    }
    // Without a value the wall begins at the temperature of its cells
    fvPatchScalarField::operator=
    (
        dict.found("value")
      ? scalarField("value", dict, p.size())
      : patchInternalField()()
    );
    if (dict.found("refValue"))
    {
        refValue() = scalarField("refValue", dict, p.size());
        refGrad() = scalarField("refGradient", dict, p.size());
        valueFraction() = scalarField("valueFraction", dict, p.size());
    }
    else
    {
        refValue() = *this;
        refGrad() = Zero;
        valueFraction() = 1;
    }
}


Foam::granularContactFvPatchScalarField::granularContactFvPatchScalarField
(
    const granularContactFvPatchScalarField& other,
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF,
    const fvPatchFieldMapper& mapper
)
:
    mixedFvPatchScalarField(other, p, iF, mapper),
    TnbrName_(other.TnbrName_)
{}


Foam::granularContactFvPatchScalarField::granularContactFvPatchScalarField
(
    const granularContactFvPatchScalarField& other,
    const DimensionedField<scalar, volMesh>& iF
)
:
    mixedFvPatchScalarField(other, iF),
    TnbrName_(other.TnbrName_)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularContactFvPatchScalarField::refuse(const string& what) const
{
    FatalErrorInFunction
        << "Patch " << patch().name() << " of field "
        << internalField().objectPath() << " has the condition "
        << "granularContact and " << what.c_str() << exit(FatalError);
}


Foam::tmp<Foam::scalarField>
Foam::granularContactFvPatchScalarField::kappa() const
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


bool Foam::granularContactFvPatchScalarField::resistance(scalarField& R) const
{
    const fvMesh& mesh = patch().boundaryMesh().mesh();
    if (!mesh.foundObject<volScalarField>("wallResistance"))
    {
        return false;
    }
    R = patch().lookupPatchField<volScalarField, scalar>("wallResistance");
    return true;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularContactFvPatchScalarField::updateCoeffs()
{
    if (updated())
    {
        return;
    }
    // Messages between processes may be under way already
    const int oldTag = UPstream::msgType();
    UPstream::msgType() = oldTag + 1;

    const mappedPatchBase& mapped =
        refCast<const mappedPatchBase>(patch().patch());
    const fvPatch& nbrPatch =
        refCast<const fvMesh>(mapped.sampleMesh()).boundary()
        [
            mapped.samplePolyPatch().index()
        ];
    const fvPatchScalarField& there =
        nbrPatch.lookupPatchField<volScalarField, scalar>(TnbrName_);
    if (!isA<granularContactFvPatchScalarField>(there))
    {
        refuse
        (
            "patch " + nbrPatch.name() + " on its other side "
          + there.type() + ", allowed: the same on both sides"
        );
    }
    const granularContactFvPatchScalarField& nbr =
        refCast<const granularContactFvPatchScalarField>(there);

    scalarField TcNbr(nbr.patchInternalField());
    scalarField KDeltaNbr(nbr.kappa()*nbrPatch.deltaCoeffs());
    scalarField RNbr(nbr.size(), Zero), R(size(), Zero);
    const bool bedThere = nbr.resistance(RNbr), bedHere = resistance(R);
    if (!bedHere && !bedThere)
    {
        refuse("a bed on neither side, allowed: a bed on one side at least");
    }
    mapped.distribute(TcNbr);
    mapped.distribute(KDeltaNbr);
    mapped.distribute(RNbr);

    const scalarField here(kappa()*patch().deltaCoeffs());
    // Grains that do not touch in a vacuum conduct nothing
    const scalarField across(KDeltaNbr/(1 + KDeltaNbr*(R + RNbr)));
    refValue() = TcNbr;
    refGrad() = Zero;
    valueFraction() = across/max(across + here, VSMALL);
    mixedFvPatchScalarField::updateCoeffs();

    UPstream::msgType() = oldTag;
}


void Foam::granularContactFvPatchScalarField::write(Ostream& os) const
{
    mixedFvPatchScalarField::write(os);
    os.writeEntryIfDifferent<word>("Tnbr", "T", TnbrName_);
}


// * * * * * * * * * * * * * * Build Macro Function  * * * * * * * * * * * * //

namespace Foam
{
    makePatchTypeField(fvPatchScalarField, granularContactFvPatchScalarField);
}


// ************************************************************************* //
