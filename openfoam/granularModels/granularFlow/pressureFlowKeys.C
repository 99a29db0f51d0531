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

#include "pressureFlow.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

const keyTable granularFlows::pressure::kindKeys
(
    "pressureCoeffs",
    {
        {
            "openings",
            "patches through which the gas flows, by their names, see below. At"
            " one of them at least the pressure is given. Empty: the bed is"
            " closed, its mean pressure is `gasPressure`, and the gas convects",
            "-", "a dictionary", "required"
        },
        {
            "channelling",
            "`layer`: next to walls that no gas passes, the bed is looser by as"
            " much pore volume as in packings of equal spheres; the drag is"
            " lower there", "-", "none, layer", "layer"
        }
    }
);

const keyTable granularFlows::pressure::openingKeys
(
    "openings of pressureCoeffs",
    {
        {
            "massFlow",
            "mass flow into the bed, a number or a function of time; negative:"
            " out of it. The opening has one pressure, at which this mass"
            " passes; with 0 it is closed", "kg/s", "a number or a function",
            "the pressure is given"
        },
        {
            "pressure", "pressure in the middle of the patch, a number or a"
            " function of time", "Pa", "> 0", "`gasPressure`"
        },
        {
            "temperature",
            "temperature of gas that enters here, a number or a function of"
            " time", "K", "> 0", "required"
        }
    }
);

} // End namespace Foam


// ************************************************************************* //
