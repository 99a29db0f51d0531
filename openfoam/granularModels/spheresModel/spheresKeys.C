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

#include "spheresModel.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

const keyTable granularModels::spheres::keys
(
    "spheresCoeffs",
    {
        {
            "model",
            "`builtin`: the model that is compiled into the library. Else a"
            " model file of spheres, relative to the case folder", "-",
            "builtin, a readable model file", "builtin"
        },
        {"hash", "as in `networkCoeffs`", "-", "the hash of the file", "any"},
        {
            "poissonRatio", "Poisson's ratio of the spheres", "-",
            "-0.99 to 0.5", "required"
        },
        {
            "roughness",
            "height of the asperities of the spheres (root mean square) over"
            " their slope; 0: smooth", "m", "0 to 1", "0"
        },
        {
            "hardness",
            "hardness of the surface: rough contacts conduct by it, and the run"
            " warns if contacts are pressed harder", "Pa", "1 to 1e15",
            "required with `roughness`"
        },
        {
            "crushLoad",
            "force between plates at which a sphere breaks: the run warns if"
            " contacts are pressed harder", "N", "1e-12 to 1e12",
            "not compared"
        },
        {
            "gas",
            "gas between the spheres. Properties are valid from 200 to 2000 K,"
            " of helium from 273 to 1800 K. Spheres that conduct less than the"
            " gas are refused; poor conductors have [their own"
            " model](../theory/radiation.md#poor-conductors)", "-",
            "air, nitrogen, helium, argon, vacuum", "vacuum"
        },
        {
            "gasPressure",
            "pressure of the gas. In very thin gas, whose conductivity is"
            " proportional to its pressure, the model has an error of up to a"
            " factor of two", "Pa", "1e-3 to 1e9", "1.013e5"
        },
        {
            "accommodation",
            "thermal accommodation coefficient of the gas at the spheres", "-",
            "0.01 to 1", "0.9"
        },
        {
            "emissivity",
            "emissivity of the spheres, which are opaque, grey and diffuse, a"
            " number or a function of T, as `thermalConductivity`: above"
            " 0 they conduct by"
            " [radiation](../theory/radiation.md#radiation), too. At 0 the run"
            " warns where radiation would add more than 2 % to the conductivity",
            "-", "0 to 1", "0"
        },
        {
            "radiation", "off: without radiation, whatever the emissivity",
            "-", "on, off", "on"
        },
        {
            "sizeSpread",
            "standard deviation of the diameters over their mean, both weighted"
            " by surface; `meanRadius` is half the mean. The model is then"
            " [that of equal spheres](../theory/spheres-law.md#unequal-spheres)"
            " of a lower solid fraction", "-", "0 to 0.25", "0"
        },
        {
            "friction",
            "coefficient of friction between the spheres: the shipped law is"
            " trained at 0.3 and [was compared](../quality/spheres.md#other-frictions)"
            " within this range", "-", "0.1 to 0.5", "0.3"
        },
        {
            "coordination",
            "contacts per sphere at the start, all spheres counted. With"
            " `sizeSpread` the model adds those that [small spheres"
            " lack](../theory/spheres-law.md#unequal-spheres). A field"
            " `coordination` replaces the sum", "-", "0 to 12",
            "as in a periodic box in this state; beds under gravity have"
            " about 0.4 more"
        },
        {
            "mobilised",
            "[mobilised part of the"
            " friction](../theory/spheres-law.md#mobilised-friction) at the"
            " start: 0.84 to 0.91 in poured beds (`msdd bed run` counts it), 1"
            " in boxes compressed with friction. A field `mobilised` replaces"
            " it", "-", "0 to 1", "0.85"
        },
        {
            "fabric",
            "[fabric tensor](../theory/spheres-law.md#state) at the start, mean"
            " of the dyads of the contact normals, (xx xy xz yy yz zz);"
            " `msdd bed run` counts it. A field `fabric` replaces it", "-",
            "xx, yy, zz >= 0, their sum 1", "follows from the stress"
        },
        {
            "wall",
            "walls where T has the condition"
            " [`granularWall`](fields.md#walls-with-their-resistance) or"
            " [`granularContact`](regions.md#the-resistance-of-a-wall)", "-",
            "a dictionary", "none"
        }
    }
);

const keyTable granularModels::spheres::wallKeys
(
    "wall of spheresCoeffs",
    {
        {
            "thermalConductivity", "thermal conductivity of the wall",
            "W/(m K)", "1e-12 to 1e12", "required"
        },
        {
            "youngModulus", "Young's modulus of the wall", "Pa",
            "1e-9 to 1e15", "required"
        },
        {
            "poissonRatio", "Poisson's ratio of the wall", "-", "-0.99 to 0.5",
            "required"
        },
        {
            "roughness",
            "height of the asperities of sphere and wall together over their"
            " slope; 0: smooth", "m", "0 to 1", "0"
        },
        {
            "hardness", "hardness of the softer one; read with `roughness`",
            "Pa", "1 to 1e15", "required with `roughness`"
        },
        {
            "spheres",
            "spheres at the wall per square of a diameter: 0.85 to 0.87 along a"
            " wall of a poured bed, 1.155 in a hexagonal layer", "-",
            "0.01 to 1.16", "0.87"
        },
        {
            "gap",
            "distance between the wall and the end of the mesh over a diameter:"
            " 0.125 where a bed as dense as inside, without the wider pores"
            " next to the wall, would hold all spheres", "-", "0 to 0.5", "0"
        },
        {
            "emissivity",
            "emissivity of the wall, which exchanges radiation with spheres that"
            " radiate", "-", "0 to 1", "as of the spheres"
        }
    }
);

} // End namespace Foam


// ************************************************************************* //
