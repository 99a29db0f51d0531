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

#include "throughFlow.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

const keyTable granularFlows::through::kindKeys
(
    "throughCoeffs",
    {
        {
            "inlet",
            "where the gas enters while the mass flow is positive, see below",
            "-", "a dictionary", "required"
        },
        {
            "outlet", "where it leaves, see below", "-", "a dictionary",
            "required"
        },
        {
            "massFlow",
            "mass flow through the cross-section of the mesh, a number or a"
            " function of time; negative from outlet to inlet. A wedge of 5"
            " degrees has 1/72 of the mass flow of its cylinder", "kg/s",
            "a number or a function", "required, or `massFlux`"
        },
        {
            "massFlux",
            "the same over the area of the cross-section, voids and grains"
            " together", "kg/(m2 s)", "a number or a function",
            "required, or `massFlow`"
        }
    }
);

const keyTable granularFlows::through::endKeys
(
    "inlet and outlet of throughCoeffs",
    {
        {
            "patch", "the patch of the mesh", "-", "a patch", "required"
        },
        {
            "temperature",
            "temperature of gas that enters here, a number or a function of"
            " time. Required at the outlet only if the mass flow turns round",
            "K", "> 0", "required where gas enters"
        }
    }
);

} // End namespace Foam

// ************************************************************************* //
