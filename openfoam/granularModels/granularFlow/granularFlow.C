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

#include "granularFlow.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(granularFlow, 0);
    defineRunTimeSelectionTable(granularFlow, dictionary);
}

// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::granularFlow> Foam::granularFlow::New
(
    const granularProperties& properties,
    granularState& grains,
    volScalarField& T
)
{
    const word type
    (
        granularProperties::grainKeys.choice(properties, "flow")
    );
    autoPtr<granularFlow> flow;
    if (type != "none")
    {
        Info<< "Selecting flow " << type << endl;
        flow =
            (*dictionaryConstructorTablePtr_->cfind(type))
            (properties, grains, T);
    }
    if (!flow.valid() || !flow->active())
    {
        flow.reset(new granularFlow);
    }
    return flow;
}


// ************************************************************************* //
