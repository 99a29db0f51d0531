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

#include "bedFlow.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

const keyTable granularFlows::bedFlow::keys
(
    "throughCoeffs and pressureCoeffs",
    {
        {
            "gas",
            "the gas, or `constant`: a gas or liquid of the constant properties"
            " in `constantGas`. With surrogate type `spheres` the gas of"
            " `spheresCoeffs` flows, and this key is refused", "-",
            "air, nitrogen, helium, argon, constant", "air"
        },
        {
            "gasPressure",
            "pressure where the gas leaves; with surrogate type `spheres` that"
            " of `spheresCoeffs`", "Pa", "1e-3 to 1e9", "1.013e5"
        },
        {
            "constantGas", "properties of `gas constant`", "-", "a dictionary",
            "required with it"
        },
        {
            "temperatures",
            "`two`: gas and grains have their own temperatures. `one`: they have"
            " the same, and the bed conducts better along the flow, which is"
            " exact for long beds. `auto`: one, if its error is below"
            " `accuracy`", "-", "one, two, auto", "auto"
        },
        {
            "accuracy",
            "with `temperatures auto`: error of the temperature, in percent of a"
            " sudden change at the inlet", "%", "1e-6 to 100", "1"
        },
        {
            "drag", "correlation of the pressure drop", "-",
            "Ergun, KTA, ErdimAkgirayDemir", "KTA"
        },
        {
            "exchange",
            "correlation of the heat exchange between gas and grains; the inner"
            " resistance of the grains is added. `constant`: as in"
            " `exchangeCoefficient`", "-",
            "WakaoKaguei, Gunn, KTA, Gnielinski, constant", "WakaoKaguei"
        },
        {
            "exchangeCoefficient",
            "of `exchange constant`: heat exchange per volume of the bed and"
            " kelvin, all resistances included", "W/(m3 K)", "1e-9 to 1e15",
            "required with it"
        },
        {
            "dragFactor", "factor of the drag, for sensitivity studies", "-",
            "0.1 to 10", "1"
        },
        {
            "exchangeFactor",
            "factor of the exchange outside of the grains, for sensitivity"
            " studies", "-", "0.1 to 10", "1"
        },
        {
            "dispersionAlong",
            "thermal dispersion of the gas along the flow, over G c d", "-",
            "0 to 100", "0.5"
        },
        {
            "dispersionAcross", "the same across the flow", "-", "0 to 100",
            "0.1"
        },
        {
            "walls",
            "walls of the vessel that take up heat from gas and grains, by the"
            " names of their patches, see below", "-", "a dictionary", "empty"
        }
    }
);

} // End namespace Foam


// ************************************************************************* //
