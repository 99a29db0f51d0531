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

#include "wallConditions.H"
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

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Largest deviator over pressure of grains far from walls
static const scalar usualRatio = 0.3;

//- Share of the largest resistance to a rigid motion below which a piece of the
//- mesh counts as free
static const scalar floating = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::wallConditions::kind>
Foam::wallConditions::kindNames
({
    { kind::rigid, "rigid" },
    { kind::frictionless, "frictionless" },
    { kind::symmetry, "symmetry" },
    { kind::displacement, "displacement" },
    { kind::pressure, "pressure" },
    { kind::piston, "piston" },
    { kind::shell, "shell" }
});

const Foam::FixedList<Foam::word, Foam::wallConditions::sides>
Foam::wallConditions::tractionNames
({
    "wallTraction", "shellTraction", "pistonTraction"
});

const Foam::keyTable Foam::wallConditions::keys
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

Foam::wallConditions::wallConditions
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
    findRubbing();
    findSupports();
    findCurvature();
    findFloating();
    compareShells();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConditions::checkNames(const dictionary& dict) const
{
    const wordList names(mesh_.mesh().boundaryMesh().names());
    for (const entry& item : dict)
    {
        const keyType& key = item.keyword();
        bool found = false;
        for (const word& name : names)
        {
            found = found || key.match(name);
        }
        if (!found)
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << key << "' of walls is no patch, allowed: "
                << granularProperties::listed(names).c_str()
                << exit(FatalIOError);
        }
    }
    wordList missing;
    for (const polyPatch& patch : mesh_.mesh().boundaryMesh())
    {
        const bool planar =
            isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch)
         || isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch);
        const dictionary* own =
            planar ? dict.findDict(patch.name(), keyType::LITERAL) : nullptr;
        if (own && own->getOrDefault<word>("type", "rigid") != "symmetry")
        {
            FatalIOErrorInFunction(*own)
                << "Patch " << patch.name() << " has an entry in 'walls' and is"
                << " of type " << patch.type() << " in the mesh, allowed there:"
                << " no entry, or type symmetry" << exit(FatalIOError);
        }
        const bool ruled =
            planar || patch.coupled() || dict.found(patch.name(), keyType::REGEX);
        if (elastic_ && !ruled)
        {
            missing.append(patch.name());
        }
    }
    if (missing.size())
    {
        FatalIOErrorInFunction(dict)
            << "No rule in 'walls' of equilibriumCoeffs for the patches "
            << granularProperties::listed(missing).c_str()
            << ", allowed types: " << keys.allowed("type")
            << exit(FatalIOError);
    }
}


void Foam::wallConditions::read
(
    const dictionary& walls,
    const granularModel& model,
    const label patchi
)
{
    const polyPatch& patch = mesh_.mesh().boundaryMesh()[patchi];
    wall& w = walls_[patchi];

    if (isA<processorPolyPatch>(patch))
    {
        return;
    }
    if (patch.coupled())
    {
        FatalErrorInFunction
            << "Patch " << patch.name() << " is of type " << patch.type()
            << ", which mechanics equilibrium does not support"
            << exit(FatalError);
    }
    if (isA<wedgePolyPatch>(patch))
    {
        return;
    }
    if
    (
        isA<emptyPolyPatch>(patch)
     || isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch)
    )
    {
        // Patches that are empty: the sides of meshes of one dimension
        w.type = kind::symmetry;
        return;
    }

    const dictionary dict(walls.subOrEmptyDict(patch.name()));
    keys.check(dict);
    w.type = kindNames.getOrDefault("type", dict, kind::rigid);
    checkKeysOfType(dict, patch.name(), w.type);

    if
    (
        w.type == kind::rigid || w.type == kind::shell
     || w.type == kind::piston
    )
    {
        readFriction(dict, model, patch.name(), w);
    }
    if (w.type == kind::shell)
    {
        readShell(dict, w);
        readAxis(dict, w);
    }
    else if (w.presses())
    {
        w.pressure = Function1<scalar>::New("pressure", dict);
    }
    else if (w.type == kind::displacement || dict.found("displacement"))
    {
        w.displacement = Function1<vector>::New("displacement", dict);
    }
    readGive(dict, w);
}


void Foam::wallConditions::readFriction
(
    const dictionary& dict,
    const granularModel& model,
    const word& name,
    wall& w
) const
{
    const frictionLaw law(frictionOf(dict, model, !elastic_));
    w.friction = law.limit;
    if (!law.known && !(dict.found("friction") && dict.found("slip")))
    {
        FatalIOErrorInFunction(dict)
            << "Patch " << name << " needs entries 'friction' and"
            << " 'slip': the model has no friction at walls"
            << exit(FatalIOError);
    }
    w.slip =
        keys.number(dict, "slip", law.slip > 0 ? law.slip : radius_, radius_);
    w.layer = keys.number(dict, "layer", keys.usual("layer")*radius_, radius_);
    w.layerStrength = keys.number
    (
        dict,
        "layerStrength",
        law.known ? max(scalar(1), min(scalar(3), w.friction/usualRatio)) : 1
    );
}


Foam::wallConditions::frictionLaw Foam::wallConditions::frictionOf
(
    const dictionary& dict,
    const granularModel& model,
    const bool own
)
{
    frictionLaw law;
    const kind type = kindNames.getOrDefault("type", dict, kind::rigid);
    const bool given = dict.found("friction");
    if (type == kind::rigid || type == kind::shell || type == kind::piston)
    {
        law.known =
            own && (given || type == kind::rigid)
          ? model.wallFriction(law.limit, law.slip)
          : !given;
        law.limit = keys.number(dict, "friction", law.limit);
    }
    return law;
}


void Foam::wallConditions::checkKeysOfType
(
    const dictionary& dict,
    const word& name,
    const kind type
) const
{
    for (const keyTable::entry& each : keys.entries())
    {
        const string types(each.of);
        const bool fits =
            types.empty()
         || (' ' + types + ' ').find(' ' + kindNames[type] + ' ')
         != std::string::npos;
        if (!fits && dict.found(each.name))
        {
            FatalIOErrorInFunction(dict)
                << "Patch " << name << " has entry '" << each.name
                << "' and type " << kindNames[type]
                << ", allowed: in walls of type " << types.c_str()
                << exit(FatalIOError);
        }
    }
}


void Foam::wallConditions::addLoads(loadHistories& loads) const
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


void Foam::wallConditions::findNormals()
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


Foam::boolList Foam::wallConditions::chosen
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


Foam::wallConditions::across
Foam::wallConditions::findAcross(const smoothWalls& walls) const
{
    const label dim = mesh_.dim(), size = mesh_.size();
    nodeDyads directions(mesh_);

    // A plane of symmetry is no part of the wall that meets its image there
    const smoothWalls planes
    (
        mesh_,
        chosen([](const wall& w) { return w.type == kind::symmetry; })
    );
    for (const smoothWalls* each : {&walls, &planes})
    {
        for (label i = 0; i < each->size(); ++i)
        {
            directions.add(each->node(i), each->normal(i), 1);
        }
    }
    // The axis of a body of revolution stays where it is
    const label r = mesh_.radial();
    const scalar tiny = r < 0 ? 0 : 1e-9*max(mesh_.points());
    for (label node = 0; node < size; ++node)
    {
        for (label k = 0; k < dim; ++k)
        {
            const scalar axis[3] = {scalar(k == 0), scalar(k == 1), scalar(k == 2)};
            const bool onAxis = k == r && mesh_.points()[2*node + r] < tiny;
            directions.add(node, axis, (fixing_[node] > 0) + onAxis);
        }
    }

    DynamicList<label> nodes, counts;
    DynamicList<scalar> basis, squares;
    scalarField vectors, values;
    for (label node = 0; node < size; ++node)
    {
        const label count = directions.axes(node, vectors, values);
        if (count)
        {
            nodes.append(node);
            counts.append(count);
            basis.append(vectors);
            squares.append(values);
        }
    }
    return
    {
        labelList(nodes), labelList(counts), scalarField(basis),
        scalarField(squares)
    };
}


void Foam::wallConditions::findHeld()
{
    fixing_.resize(mesh_.size(), Zero);
    forAll(walls_, patchi)
    {
        for (const label node : mesh_.wall(patchi).nodes)
        {
            fixing_[node] += walls_[patchi].fixes();
        }
    }
    mesh_.sum(fixing_, 1);
    holding_.reset
    (
        new smoothWalls
        (
            mesh_, chosen([](const wall& w) { return w.holdsAcross(); })
        )
    );
    across held(findAcross(holding_()));
    constrainedNodes_.transfer(held.nodes);
    allDirections_.transfer(held.directions);
    allBasis_.transfer(held.basis);
    squares_.transfer(held.squares);
    findPushing();
    holdOthers();

    scalarField pressed(mesh_.size(), Zero);
    forAll(walls_, patchi)
    {
        if (walls_[patchi].presses())
        {
            for (const label node : mesh_.wall(patchi).nodes)
            {
                pressed[node] = 1;
            }
        }
    }
    mesh_.sum(pressed, 1);
    forAll(balanced_, node)
    {
        balanced_[node] = pressed[node] > 0 ? 0 : 1;
    }
}


void Foam::wallConditions::findFloating() const
{
    const regionSplit regions(mesh_.mesh());
    const label pieces = regions.nRegions();
    rigidMotion motion(mesh_, regions, pieces);
    const label dim = mesh_.dim();

    forAll(constrainedNodes_, i)
    {
        for (label k = 0; k < directions_[i]; ++k)
        {
            motion.hold(constrainedNodes_[i], basis_.cdata() + dim*(dim*i + k));
        }
    }
    forAll(slipNodes_, i)
    {
        for (label j = (dim - 1)*i; j < (dim - 1)*i + nTangents_[i]; ++j)
        {
            motion.hold(slipNodes_[i], tangents_.cdata() + dim*j);
        }
    }
    forAll(supports_, i)
    {
        motion.hold(supports_[i], normal_.cdata() + dim*i);
    }
    forAll(curved_, i)
    {
        motion.hold(curved_[i], tangent_.cdata() + dim*i);
    }
    const string what(motion.free(floating));
    if (!what.empty())
    {
        FatalErrorInFunction
            << what.c_str() << ". Allowed: pieces that walls of type rigid,"
            << " frictionless, symmetry, displacement or shell hold; see 'walls' of"
            << " equilibriumCoeffs" << exit(FatalError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallConditions::removeConstrained(scalarField& values) const
{
    const label dim = mesh_.dim();
    forAll(constrainedNodes_, i)
    {
        scalar* v = values.data() + dim*constrainedNodes_[i];
        for (label k = 0; k < directions_[i]; ++k)
        {
            const scalar* e = basis_.cdata() + dim*dim*i + dim*k;
            scalar along = 0;
            for (label j = 0; j < dim; ++j)
            {
                along += e[j]*v[j];
            }
            for (label j = 0; j < dim; ++j)
            {
                v[j] = directions_[i] == dim ? 0 : v[j] - along*e[j];
            }
        }
    }
}


void Foam::wallConditions::project(scalarField& values) const
{
    removeConstrained(values);
    tie(values);
}


void Foam::wallConditions::keepConstrained(scalarField& values) const
{
    scalarField free(values);
    removeConstrained(free);
    values -= free;
}


Foam::scalarField Foam::wallConditions::strength() const
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
