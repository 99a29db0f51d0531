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

#include "granularSolidThermo.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::uniform
(
    const word& name,
    const dimensionedScalar& value
) const
{
    return volScalarField::New(name, he_.mesh(), value);
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::capacity
(
    const label size
) const
{
    return tmp<scalarField>
    (
        new scalarField(size, properties_.heatCapacity().value())
    );
}


// * * * * * * * * * * * * * * * * * Energy  * * * * * * * * * * * * * * * * //

Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::he
(
    const volScalarField&,
    const volScalarField& T
) const
{
    return properties_.heatCapacity()*T;
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::he
(
    const scalarField&,
    const scalarField& T,
    const labelList&
) const
{
    return properties_.heatCapacity().value()*T;
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::he
(
    const scalarField&,
    const scalarField& T,
    const label
) const
{
    return properties_.heatCapacity().value()*T;
}


Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::hc() const
{
    return uniform("hc", dimensionedScalar(dimEnergy/dimMass, Zero));
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::THE
(
    const scalarField& h,
    const scalarField&,
    const scalarField&,
    const labelList&
) const
{
    return h/properties_.heatCapacity().value();
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::THE
(
    const scalarField& h,
    const scalarField&,
    const scalarField&,
    const label
) const
{
    return h/properties_.heatCapacity().value();
}


// * * * * * * * * * * * * * * * Heat Capacity * * * * * * * * * * * * * * * //

Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::Cp() const
{
    return Cp_;
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::Cp
(
    const scalarField&,
    const scalarField& T,
    const label
) const
{
    return capacity(T.size());
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::Cp
(
    const scalarField&,
    const scalarField& T,
    const labelList&
) const
{
    return capacity(T.size());
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::rhoEoS
(
    const scalarField&,
    const scalarField&,
    const labelList& cells
) const
{
    return tmp<scalarField>(new scalarField(rho_.primitiveField(), cells));
}


const Foam::volSymmTensorField& Foam::granularSolidThermo::aniAlpha() const
{
    begin();
    return aniAlpha_;
}


Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::gamma() const
{
    return uniform("gamma", dimensionedScalar("one", dimless, 1));
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::gamma
(
    const scalarField&,
    const scalarField& T,
    const label
) const
{
    return tmp<scalarField>(new scalarField(T.size(), 1));
}


Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::W() const
{
    // Grains have no molecules: solvers request this only with gases
    return uniform("W", dimensionedScalar("W", dimMass/dimMoles, 1));
}


// * * * * * * * * * * * * * * * Conductivity  * * * * * * * * * * * * * * * //

Foam::tmp<Foam::volVectorField> Foam::granularSolidThermo::Kappa() const
{
    begin();
    return Kappa_;
}


Foam::tmp<Foam::vectorField> Foam::granularSolidThermo::Kappa
(
    const label patchi
) const
{
    begin();
    return Kappa_.boundaryField()[patchi];
}


Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::kappa() const
{
    begin();
    return properties_.heatCapacity()*alpha_;
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::kappa
(
    const label patchi
) const
{
    begin();
    return properties_.heatCapacity().value()*alpha_.boundaryField()[patchi];
}


Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::alphahe() const
{
    begin();
    return alpha_;
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::alphahe
(
    const label patchi
) const
{
    begin();
    return alpha_.boundaryField()[patchi];
}


Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::kappaEff
(
    const volScalarField& alphat
) const
{
    return kappa() + properties_.heatCapacity()*alphat;
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::kappaEff
(
    const scalarField& alphat,
    const label patchi
) const
{
    return kappa(patchi) + properties_.heatCapacity().value()*alphat;
}


Foam::tmp<Foam::volScalarField> Foam::granularSolidThermo::alphaEff
(
    const volScalarField& alphat
) const
{
    return alphahe() + alphat;
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::alphaEff
(
    const scalarField& alphat,
    const label patchi
) const
{
    return alphahe(patchi) + alphat;
}


// ************************************************************************* //
