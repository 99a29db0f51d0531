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
#include "resistingWall.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Whether a condition of T contains the resistance of the wall
static bool resists(const fvPatchScalarField& patch)
{
    const auto* wall = dynamic_cast<const resistingWall*>(&patch);
    return wall && wall->resists();
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::grainFields::findWalls(const volScalarField& T)
{
    for (const fvPatchScalarField& patch : T.boundaryField())
    {
        if (resists(patch))
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


void Foam::grainFields::reportWalls(const volScalarField& T) const
{
    wordList without;
    for (label i = 0; i < mesh_.boundaryMesh().nNonProcessor(); ++i)
    {
        const fvPatchScalarField& patch = T.boundaryField()[i];
        const scalarField& area = patch.patch().magSf();
        if (resists(patch))
        {
            scalarField K, R;
            atWall(i, temperature_, true, K, R);
            const scalar length = gSum(area*K*R)/max(gSum(area), VSMALL);
            Info<< "Wall " << patch.patch().name() << ": the resistance between"
                << " wall and grains is that of " << length << " m of the bed"
                << nl << endl;
        }
        else if (patch.type().find("ixedValue") != string::npos)
        {
            without.append(patch.patch().name());
        }
    }
    if (without.size() && model_->type() == "spheres")
    {
        Info<< "Walls without resistance between wall and grains: "
            << granularProperties::listed(without).c_str()
            << " (the condition granularWall of T has it)" << nl << endl;
    }
}


void Foam::grainFields::setWallResistance
(
    const symmTensorField& K,
    const symmTensorField& sigma
)
{
    if (!wallResistance_.valid())
    {
        return;
    }
    const volScalarField& T = mesh_.lookupObject<volScalarField>("T");
    forAll(mesh_.boundary(), patchi)
    {
        if (resists(T.boundaryField()[patchi]))
        {
            scalarField conductivity, resistance;
            atWall
            (
                patchi, temperature_, true, K, sigma, conductivity, resistance
            );
            wallResistance_().boundaryFieldRef()[patchi] == resistance;
        }
    }
}


void Foam::grainFields::atWall
(
    const label patchi,
    const scalarField& T,
    const bool resists,
    const symmTensorField& K,
    const symmTensorField& sigma,
    scalarField& conductivity,
    scalarField& resistance
) const
{
    const fvPatch& patch = mesh_.boundary()[patchi];
    const labelUList& cells = patch.faceCells();
    const vectorField n(patch.nf());
    scalarField stress(n.size()), temperature(n.size());
    conductivity.resize(n.size());
    resistance = scalarField(n.size(), Zero);
    forAll(n, facei)
    {
        const label celli = cells[facei];
        stress[facei] = n[facei] & (sigma[celli] & n[facei]);
        temperature[facei] = T[celli];
        // Above zero for the law, also in a vacuum without contacts
        conductivity[facei] = max
        (
            properties_.conductivityFactor()
           *(n[facei] & (K[celli] & n[facei])),
            SMALL
        );
    }
    if (resists)
    {
        model_->wallResistance(stress, temperature, conductivity, resistance);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::grainFields::atWall
(
    const label patchi,
    const scalarField& T,
    const bool resists,
    scalarField& conductivity,
    scalarField& resistance
) const
{
    atWall
    (
        patchi, T, resists, conductivity_.primitiveField(), sigma_,
        conductivity, resistance
    );
}


// ************************************************************************* //
