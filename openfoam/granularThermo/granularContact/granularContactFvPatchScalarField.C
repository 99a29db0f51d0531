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
#include "mappedPatchBase.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularContactFvPatchScalarField::granularContactFvPatchScalarField
(
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF
)
:
    granularSideFvPatchScalarField(p, iF),
    TnbrName_("T")
{}


Foam::granularContactFvPatchScalarField::granularContactFvPatchScalarField
(
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF,
    const dictionary& dict
)
:
    granularSideFvPatchScalarField(p, iF),
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
    readValues(dict);
}


Foam::granularContactFvPatchScalarField::granularContactFvPatchScalarField
(
    const granularContactFvPatchScalarField& other,
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF,
    const fvPatchFieldMapper& mapper
)
:
    granularSideFvPatchScalarField(other, p, iF, mapper),
    TnbrName_(other.TnbrName_)
{}


Foam::granularContactFvPatchScalarField::granularContactFvPatchScalarField
(
    const granularContactFvPatchScalarField& other,
    const DimensionedField<scalar, volMesh>& iF
)
:
    granularSideFvPatchScalarField(other, iF),
    TnbrName_(other.TnbrName_)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularContactFvPatchScalarField::addGas
(
    scalarField& h,
    scalarField& hT
) const
{
    const fvMesh& mesh = patch().boundaryMesh().mesh();
    if (mesh.foundObject<volScalarField>("wallExchange"))
    {
        const fvPatchScalarField& own =
            patch().lookupPatchField<volScalarField, scalar>("wallExchange");
        const scalarField T
        (
            mesh.lookupObject<volScalarField>("gasTemperature"),
            patch().faceCells()
        );
        h += own;
        hT += own*T;
    }
}


void Foam::granularContactFvPatchScalarField::lookBeyond
(
    scalarField& G,
    scalarField& T,
    scalarField& R
) const
{
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

    T = nbr.patchInternalField();
    scalarField KDeltaNbr(nbr.kappa()*nbrPatch.deltaCoeffs());
    scalarField RNbr(nbr.size(), Zero);
    scalarField h(nbr.size(), Zero), hT(nbr.size(), Zero);
    R = scalarField(size(), Zero);
    const bool bedThere = nbr.resistance(RNbr), bedHere = resistance(R);
    if (!bedHere && !bedThere)
    {
        refuse("a bed on neither side, allowed: a bed on one side at least");
    }
    nbr.addGas(h, hT);
    for (scalarField* each : {&T, &KDeltaNbr, &RNbr, &h, &hT})
    {
        mapped.distribute(*each);
    }
    UPstream::msgType() = oldTag;

    const scalarField across(KDeltaNbr/(1 + KDeltaNbr*RNbr));
    G = across + h;
    T += (hT - h*T)/max(G, VSMALL);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularContactFvPatchScalarField::updateCoeffs()
{
    if (updated())
    {
        return;
    }
    scalarField G, T, R;
    lookBeyond(G, T, R);
    scalarField h(size(), Zero), hT(size(), Zero);
    addGas(h, hT);
    G += h;
    T += (hT - h*T)/max(G, VSMALL);

    const scalarField here(kappa()*patch().deltaCoeffs());
    // Grains that do not touch in a vacuum conduct nothing
    const scalarField across(G/(1 + G*R));
    refValue() = T;
    refGrad() = Zero;
    valueFraction() = across/max(across + here, VSMALL);
    mixedFvPatchScalarField::updateCoeffs();
}


void Foam::granularContactFvPatchScalarField::exchange
(
    scalarField& toBed,
    scalarField& beyond,
    scalarField& T
) const
{
    scalarField R;
    lookBeyond(beyond, T, R);
    const scalarField here(kappa()*patch().deltaCoeffs());
    toBed = here/(1 + here*R);
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
