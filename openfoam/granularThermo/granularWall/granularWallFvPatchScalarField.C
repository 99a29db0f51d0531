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

#include "granularWallFvPatchScalarField.H"
#include "addToRunTimeSelectionTable.H"
#include "fvPatchFieldMapper.H"
#include "loadHistories.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

const keyTable granularWallFvPatchScalarField::keys
(
    "granularWall",
    {
        {
            "mode",
            "what is given outside of the resistance: the `temperature` of the"
            " wall, a heat transfer `coefficient` to the outside, or the heat"
            " `flux` into the bed", "-", "temperature, coefficient, flux",
            "temperature"
        },
        {
            "temperature", "temperature of the wall, a number or a function of"
            " time", "K", "> 0", "required", "temperature"
        },
        {
            "h",
            "heat transfer coefficient between the wall's surface at the grains"
            " and the outside, a number or a function of time: of insulation,"
            " air outside, and the wall itself, in series", "W/(m2 K)",
            "0 to 1e9", "required", "coefficient"
        },
        {
            "Ta", "temperature outside, a number or a function of time", "K",
            "> 0", "required", "coefficient"
        },
        {
            "q", "heat flux into the bed, a number or a function of time",
            "W/m2", "any number", "required", "flux"
        },
        {
            "resistance",
            "whether the resistance between wall and grains counts; off: the"
            " bed has the temperature of the wall where the mesh ends", "-",
            "on, off", "on"
        },
        {
            "value", "temperature of the bed where the mesh ends, at the start",
            "K", "a field", "as in the cells"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularWallFvPatchScalarField::granularWallFvPatchScalarField
(
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF
)
:
    granularSideFvPatchScalarField(p, iF),
    mode_("temperature"),
    resists_(true)
{}


Foam::granularWallFvPatchScalarField::granularWallFvPatchScalarField
(
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF,
    const dictionary& dict
)
:
    granularSideFvPatchScalarField(p, iF),
    mode_(keys.choice(dict, "mode")),
    resists_(keys.choice(dict, "resistance") == "on")
{
    keys.check
    (
        dict,
        wordList
        ({
            "type", "patchType", "refValue", "refGradient", "valueFraction"
        })
    );
    for (const keyTable::entry& key : keys.entries())
    {
        const word of(key.of);
        if (!of.empty() && of != mode_ && dict.found(key.name))
        {
            refuse
            (
                "the entry '" + string(key.name) + "' with mode " + mode_
              + ", allowed: with mode " + of
            );
        }
        if (of == mode_)
        {
            given_.append(Function1<scalar>::New(key.name, dict));
        }
    }
    readValues(dict);
}


Foam::granularWallFvPatchScalarField::granularWallFvPatchScalarField
(
    const granularWallFvPatchScalarField& other,
    const fvPatch& p,
    const DimensionedField<scalar, volMesh>& iF,
    const fvPatchFieldMapper& mapper
)
:
    granularSideFvPatchScalarField(other, p, iF, mapper),
    mode_(other.mode_),
    resists_(other.resists_),
    given_(other.given_)
{}


Foam::granularWallFvPatchScalarField::granularWallFvPatchScalarField
(
    const granularWallFvPatchScalarField& other,
    const DimensionedField<scalar, volMesh>& iF
)
:
    granularSideFvPatchScalarField(other, iF),
    mode_(other.mode_),
    resists_(other.resists_),
    given_(other.given_)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::granularWallFvPatchScalarField::now(const label i) const
{
    const scalar value =
        given_[i].value(patch().boundaryMesh().mesh().time().value());
    const word& key = given_[i].name();
    if (!keys.allows(key, value))
    {
        refuse
        (
            "the entry '" + key + "' is " + Foam::name(value) + " at the time "
          + patch().boundaryMesh().mesh().time().timeName() + ", allowed: "
          + keys.allowed(key)
        );
    }
    return value;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::granularWallFvPatchScalarField::outside(scalar& T) const
{
    if (mode_ == "flux")
    {
        return false;
    }
    T = now(given_.size() - 1);
    return true;
}


void Foam::granularWallFvPatchScalarField::addLoads(loadHistories& loads) const
{
    for (label i = 0; i < given_.size(); ++i)
    {
        loads.add(given_[i]);
    }
}


void Foam::granularWallFvPatchScalarField::updateCoeffs()
{
    if (updated())
    {
        return;
    }
    const scalarField K(kappa());
    if (mode_ == "flux")
    {
        refValue() = patchInternalField();
        refGrad() = now(0)/max(K, VSMALL);
        valueFraction() = 0;
        mixedFvPatchScalarField::updateCoeffs();
        return;
    }
    scalarField R(size(), Zero);
    if (resists_ && !resistance(R))
    {
        refuse("its region is no bed, allowed: beds");
    }
    scalar T = 0;
    outside(T);
    const scalarField here(K*patch().deltaCoeffs());
    // In series with the resistance [W/(m^2 K)]
    scalarField across(1/max(R, VSMALL));
    if (mode_ == "coefficient")
    {
        across = 1/(1/max(now(0), VSMALL) + R);
    }
    refValue() = T;
    refGrad() = Zero;
    // Grains that do not touch in a vacuum conduct nothing
    valueFraction() = across/max(across + here, VSMALL);
    mixedFvPatchScalarField::updateCoeffs();
}


void Foam::granularWallFvPatchScalarField::write(Ostream& os) const
{
    mixedFvPatchScalarField::write(os);
    os.writeEntry("mode", mode_);
    os.writeEntry("resistance", word(resists_ ? "on" : "off"));
    for (label i = 0; i < given_.size(); ++i)
    {
        given_[i].writeData(os);
    }
}


// * * * * * * * * * * * * * * Build Macro Function  * * * * * * * * * * * * //

namespace Foam
{
    makePatchTypeField(fvPatchScalarField, granularWallFvPatchScalarField);
}


// ************************************************************************* //
