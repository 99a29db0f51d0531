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

#include "wallConstraints.H"
#include "granularProperties.H"
#include "emptyPolyPatch.H"
#include "wedgePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "processorPolyPatch.H"
#include "patchDistMethod.H"
#include "regionSplit.H"
#include "rigidMotion.H"
#include "nodeDyads.H"

#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::wallConstraints::kind>
Foam::wallConstraints::kindNames
({
    { kind::rigid, "rigid" },
    { kind::frictionless, "frictionless" },
    { kind::symmetry, "symmetry" },
    { kind::displacement, "displacement" },
    { kind::pressure, "pressure" },
    { kind::piston, "piston" },
    { kind::shell, "shell" }
});

const Foam::FixedList<Foam::word, Foam::wallConstraints::sides>
Foam::wallConstraints::tractionNames
({
    "wallTraction", "shellTraction", "pistonTraction"
});

const Foam::keyTable Foam::wallConstraints::keys
(
    "walls",
    {
        {
            "type", "kind of wall, see the next table", "-",
            "rigid, frictionless, symmetry, displacement, pressure, piston,"
            " shell", "rigid"
        },
        {
            "friction",
            "friction of the bed along the wall (tangential over normal stress)"
            " after a large slip; after a slip s it is friction s/(s + `slip`)."
            " Spheres also roll along a wall: see [rough"
            " walls](../quality/spheres.md#rough-walls)", "-", "0 to 10",
            "of discs at `rigid` walls from the model; else 0",
            "rigid or shell or piston"
        },
        {
            "slip", "slip at which half of `friction` is reached", "m",
            "2e-7 r to 2000 r",
            "of discs from the model; else required with `friction`",
            "rigid or shell or piston"
        },
        {
            "layer",
            "width of the layer along a wall with friction whose grains are"
            " stronger", "m", "0 to 1e6 r", "13 r", "rigid or shell or piston"
        },
        {
            "layerStrength",
            "factor of the deviator at which grains in this layer slide past"
            " each other, because a shear band finds little space there. Not"
            " used with the initial field `strength`", "-", "0.1 to 3",
            "of discs `friction`/0.3, from 1 to 3; of spheres 1",
            "rigid or shell or piston"
        },
        {
            "displacement",
            "motion of the wall (type `displacement`: of the grains there), a"
            " vector as function of time: `constant (0.01 0 0)`, `table (...)`,"
            " `sine` ...", "m", "a Function1",
            "no motion; required for `displacement`",
            "rigid or frictionless or displacement"
        },
        {
            "pressure",
            "pressure from outside (`piston`: load over area) as function of"
            " time", "Pa", "a Function1", "required", "pressure or piston"
        },
        {
            "displacementCoeffs", "parameters of a Function1", "-",
            "a dictionary", "none", "rigid or frictionless or displacement"
        },
        {
            "pressureCoeffs", "the same for `pressure`", "-", "a dictionary",
            "none", "pressure or piston"
        },
        {
            "slackLayer",
            "additional depth of bed by which the grains at a smooth wall"
            " slip, see [below](#slack-at-smooth-walls)",
            "mean diameters", "0 to 1000", "0", "rigid or frictionless"
        },
        {
            "slackRecovery",
            "share of it that is recovered where the bed extends (the mean of"
            " beds of spheres between plates, which differ much)", "-",
            "0 to 1", "0.1", "rigid or frictionless"
        },
        {
            "youngModulus", "Young's modulus E_w of the wall", "Pa",
            "1e-15 to 1e15", "required", "shell"
        },
        {
            "thickness", "thickness t of the wall", "m", "1e-15 to 1e15",
            "required", "shell"
        },
        {
            "radius",
            "radius R of the wall; a warning says if the mesh has another one"
            " by a quarter or more, or is flat", "m", "1e-15 to 1e15",
            "required", "shell"
        },
        {
            "thermalExpansion",
            "linear thermal expansion coefficient of the wall", "1/K",
            "0 to 0.01", "0", "shell"
        },
        {
            "temperature",
            "temperature of the wall at which it has its initial place", "K",
            "any", "required with `thermalExpansion` above 0", "shell"
        },
        {
            "fixedPoint",
            "a point where the wall stays as it expands along its axis, past"
            " grains that rub on it: where the vessel stands", "m", "a vector",
            "in wedges and in space required with `friction` and"
            " `thermalExpansion` above 0", "shell"
        },
        {
            "axis", "direction of its axis; in a wedge that of the mesh", "-",
            "a vector that is not 0", "in space required with `fixedPoint`",
            "shell"
        }
    }
);


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::wallConstraints::wallConstraints
(
    const dictionary& dict,
    const granularModel& model,
    const elementMesh& mesh,
    const scalar radius,
    const bool elastic,
    const scalar springs
)
:
    mesh_(mesh),
    radius_(radius),
    elastic_(elastic),
    walls_(mesh.mesh().boundary().size()),
    balanced_(mesh.size(), 1)
{
    checkNames(dict);
    forAll(walls_, patchi)
    {
        walls_.set(patchi, new wall);
        read(dict, model, patchi);
        wall& w = walls_[patchi];
        const bool keeps = w.type == kind::rigid || w.type == kind::frictionless;
        if (keeps && w.slackLayer == 0)
        {
            w.stiffness = springs;
        }
    }
    findNormals();
    findHeld();
    findPistons();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConstraints::findNormals()
{
    const label dim = mesh_.dim();
    scalarField weights;
    normals_.resize(walls_.size());
    forAll(walls_, patchi)
    {
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        scalarField& normals = normals_[patchi];
        normals.resize(dim*faces.size());
        for (label i = 0; i < faces.size(); ++i)
        {
            const label start = faces.start[i];
            const label count = faces.start[i + 1] - start;
            weights.resize(max(weights.size(), 3*count));
            mesh_.faceWeights
            (
                mesh_.points(), faces.nodes.cdata() + start, count,
                weights.data()
            );
            scalar square = 0;
            for (label k = 0; k < dim; ++k)
            {
                scalar& n = normals[dim*i + k];
                n = 0;
                for (label a = 0; a < count; ++a)
                {
                    n += weights[dim*a + k];
                }
                square += sqr(n);
            }
            for (label k = 0; k < dim; ++k)
            {
                normals[dim*i + k] /= max(std::sqrt(square), VSMALL);
            }
            smoothWalls::align(normals.data() + dim*i, dim);
        }
    }
}


Foam::boolList Foam::wallConstraints::chosen
(
    std::function<bool(const wall&)> choose
) const
{
    boolList result(walls_.size());
    forAll(result, patchi)
    {
        result[patchi] = choose(walls_[patchi]);
    }
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallConstraints::addLoads(loadHistories& loads) const
{
    for (const wall& w : walls_)
    {
        if (w.displacement.valid())
        {
            loads.add(w.displacement());
        }
        if (w.pressure.valid())
        {
            loads.add(w.pressure());
        }
    }
}


Foam::scalarField Foam::wallConstraints::strength() const
{
    const fvMesh& mesh = mesh_.mesh();
    scalarField result(mesh.nCells(), 1);
    dictionary method;
    method.add("method", "meshWave");

    forAll(walls_, patchi)
    {
        // All processes take part, whether or not they have faces of the patch
        const wall& w = walls_[patchi];
        if (w.friction <= 0 || w.layer <= 0)
        {
            continue;
        }
        volScalarField y
        (
            IOobject("y", mesh.time().timeName(), mesh),
            mesh,
            dimensionedScalar(dimLength, Zero)
        );
        patchDistMethod::New(method, mesh, labelHashSet({patchi}))->correct(y);
        forAll(result, celli)
        {
            if (y[celli] < w.layer)
            {
                result[celli] = max(result[celli], w.layerStrength);
            }
        }
    }
    return result;
}


// ************************************************************************* //
