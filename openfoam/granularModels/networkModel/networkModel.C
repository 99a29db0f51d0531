/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
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
}


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
    if (&coeffs_ != &properties.surrogateDict())
    {
        granularProperties::checkKeys(coeffs_, {"model", "hash", "conductivityKind"});
    }
}


// ************************************************************************* //
