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

#include "networkModel.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{
    defineTypeNameAndDebug(network, 0);
    addToRunTimeSelectionTable(granularModel, network, dictionary);
}

static const keyTable networkKeys
(
    "networkCoeffs",
    {
        {
            "model",
            "`builtin` (or `builtin:increment`): the"
            " [model](../theory/surrogate.md) that is compiled into the"
            " library. `builtin:paper`: the paper's network. Else a model file,"
            " relative to the case folder", "-",
            "builtin, builtin:increment, builtin:paper, a readable model file",
            "required"
        },
        {
            "hash",
            "SHA-256 that the model file must have: 64 hexadecimal digits in"
            " quotation marks", "-", "the hash of the file", "any"
        },
        {
            "conductivity",
            "`network`: from the temperatures that balance the heat of every"
            " grain. `affine`: Eq. 9 of the paper, an upper bound", "-",
            "network, affine; as far as the model was trained for them",
            "the model's own; `network` of `builtin`"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::network::network
(
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    surrogateModel
    (
        typeName,
        "model",
        properties.surrogateDict().optionalSubDict("networkCoeffs")
           .get<fileName>("model"),
        "builtin, builtin:paper, or a readable model file",
        properties,
        mesh
    )
{
    checkCoeffs(networkKeys);
    word kind;
    if (coeffs_.readIfPresent("conductivity", kind))
    {
        try
        {
            model_ = model_.withConductivity(kind);
        }
        catch (const std::exception& error)
        {
            refuse("conductivity", kind, error.what());
        }
    }
}


// ************************************************************************* //
