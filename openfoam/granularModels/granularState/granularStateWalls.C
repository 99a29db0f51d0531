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

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularState::findWalls(const volScalarField& T)
{
    for (const fvPatchScalarField& patch : T.boundaryField())
    {
        if (patch.type() == "granularContact")
        {
            wallResistance_.reset
            (
                new volScalarField
                (
                    io("wallResistance"),
                    mesh_,
                    dimensionedScalar
                    (
                        dimArea*dimTemperature/dimPower, Zero
                    )
                )
            );
            return;
        }
    }
}


void Foam::granularState::setWallResistance()
{
    if (!wallResistance_.valid())
    {
        return;
    }
    const volScalarField& T = mesh_.lookupObject<volScalarField>("T");
    forAll(mesh_.boundary(), patchi)
    {
        if (T.boundaryField()[patchi].type() == "granularContact")
        {
            scalarField conductivity, resistance;
            atWall(patchi, temperature_, true, conductivity, resistance);
            wallResistance_().boundaryFieldRef()[patchi] == resistance;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularState::atWall
(
    const label patchi,
    const scalarField& T,
    const bool resists,
    scalarField& conductivity,
    scalarField& resistance
) const
{
    const bool spatial = sigma_.size() == 6;
    const label shear = shearColumn();
    const fvPatch& patch = mesh_.boundary()[patchi];
    const labelUList& cells = patch.faceCells();
    const vectorField n(patch.nf());
    scalarField stress(n.size()), temperature(n.size());
    conductivity.resize(n.size());
    resistance = scalarField(n.size(), Zero);
    forAll(n, facei)
    {
        const label celli = cells[facei];
        const symmTensor sigma
        (
            sigma_[0][celli],
            sigma_[shear][celli],
            spatial ? sigma_[4][celli] : 0,
            sigma_[1][celli],
            spatial ? sigma_[5][celli] : 0,
            spatial ? sigma_[2][celli] : 0
        );
        const symmTensor K
        (
            K_.xx[celli],
            K_.xy.size() ? K_.xy[celli] : 0,
            K_.zz.size() ? K_.xz[celli] : 0,
            K_.yy[celli],
            K_.zz.size() ? K_.yz[celli] : 0,
            K_.zz.size() ? K_.zz[celli] : 0
        );
        stress[facei] = n[facei] & (sigma & n[facei]);
        temperature[facei] = T[celli];
        // Above zero for the law, also in a vacuum without contacts
        conductivity[facei] = max
        (
            properties_.conductivityFactor()
           *(n[facei] & (K & n[facei])),
            SMALL
        );
    }
    if (resists)
    {
        model_->wallResistance(stress, temperature, conductivity, resistance);
    }
}


// ************************************************************************* //
