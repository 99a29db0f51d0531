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

#include "wallConditions.H"
#include "emptyPolyPatch.H"
#include "symmetryPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "processorPolyPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Width of the layer beside a wall, in mean radii
static const scalar usualLayer = 13;

//- Largest deviator over pressure of grains far from walls
static const scalar usualRatio = 0.25;

} // End namespace Foam


// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::wallConditions::kind>
Foam::wallConditions::kindNames
({
    { kind::rigid, "rigid" },
    { kind::frictionless, "frictionless" },
    { kind::symmetry, "symmetry" },
    { kind::displacement, "displacement" },
    { kind::pressure, "pressure" }
});


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::wallConditions::wallConditions
(
    const dictionary& dict,
    const granularModel& model,
    const quadMesh& mesh,
    const scalar radius
)
:
    mesh_(mesh),
    radius_(radius),
    walls_(mesh.mesh().boundary().size()),
    free_(mesh.size(), vector2D(1, 1)),
    balanced_(mesh.size(), vector2D(1, 1)),
    slip_(mesh.size(), vector2D(1, 1))
{
    checkNames(dict);
    findSides();
    forAll(walls_, patchi)
    {
        walls_.set(patchi, new wall);
        read(dict, model, patchi);
    }
    findFree();
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
    const bool empty = isA<emptyPolyPatch>(patch);
    const bool symmetric =
        isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch);
    if (patch.coupled())
    {
        FatalErrorInFunction
            << "Patch " << patch.name() << " is of type " << patch.type()
            << ", which mechanics equilibrium does not support"
            << exit(FatalError);
    }
    if (empty || symmetric)
    {
        // Sides of one-dimensional meshes, which are empty in y
        w.type = kind::symmetry;
        findAxis(patchi, walls);
        return;
    }

    const dictionary dict(walls.subOrEmptyDict(patch.name()));
    granularProperties::checkKeys
    (
        dict,
        {
            "type", "friction", "slip", "layer", "layerStrength",
            "displacement", "pressure", "displacementCoeffs", "pressureCoeffs"
        }
    );
    w.type = kindNames.getOrDefault("type", dict, kind::rigid);
    findAxis(patchi, dict);

    if (w.type == kind::rigid)
    {
        scalar limit = 0, slip = 0;
        const bool known = model.wallFriction(limit, slip);
        if (!known && !(dict.found("friction") && dict.found("slip")))
        {
            FatalIOErrorInFunction(walls)
                << "Patch " << patch.name() << " needs entries 'friction' and"
                << " 'slip': the model has no friction at walls"
                << exit(FatalIOError);
        }
        w.friction =
            granularProperties::ranged(dict, "friction", limit, 0, 10);
        w.slip = granularProperties::ranged
        (
            dict, "slip", slip, 2e-7*radius_, 2000*radius_
        );
        w.layer = granularProperties::ranged
        (
            dict, "layer", usualLayer*radius_, 0, 1e6*radius_
        );
        w.layerStrength = granularProperties::ranged
        (
            dict,
            "layerStrength",
            max(scalar(1), min(scalar(3), w.friction/usualRatio)),
            0.1,
            3
        );
    }
    if (w.type == kind::pressure)
    {
        w.pressure = Function1<scalar>::New("pressure", dict);
    }
    else if (w.type == kind::displacement || dict.found("displacement"))
    {
        w.displacement = Function1<vector>::New("displacement", dict);
    }
}


void Foam::wallConditions::findSides()
{
    // Patches that are not between processes come first, in the same order on
    // all processes
    sides_ = List<vector>(mesh_.mesh().boundaryMesh().nNonProcessor(), Zero);
    const List<vector2D>& points = mesh_.points();

    forAll(sides_, patchi)
    {
        vector& sum = sides_[patchi];
        for (const quadMesh::edgeOfWall& e : mesh_.wall(patchi))
        {
            const vector2D t(points[e.second] - points[e.first]);
            const vector2D m(0.5*(points[e.second] + points[e.first]));
            const point& C = mesh_.mesh().cellCentres()[e.cell];
            const label axis = mag(t.x()) > mag(t.y());
            const scalar out = (axis ? m.y() - C.y() : m.x() - C.x());
            sum[axis] += out > 0 ? 1 : -1;
            sum.z() += 1;
            if (min(mag(t.x()), mag(t.y())) > 1e-6*mag(t))
            {
                sum.z() = GREAT;
            }
        }
    }
    Pstream::listCombineGather(sides_, plusEqOp<vector>());
    Pstream::listCombineScatter(sides_);
}


void Foam::wallConditions::findAxis(const label patchi, const dictionary& dict)
{
    const polyPatch& patch = mesh_.mesh().boundaryMesh()[patchi];
    const vector& sum = sides_[patchi];
    wall& w = walls_[patchi];

    w.axis = mag(sum.y()) > mag(sum.x());
    w.outwards = sum[w.axis] < 0 ? -1 : 1;

    // Empty patches of one-dimensional meshes have two sides
    if (!isA<emptyPolyPatch>(patch) && mag(sum[w.axis]) < sum.z() - 0.5)
    {
        FatalIOErrorInFunction(dict)
            << "Patch " << patch.name() << " is not plane and along x or y,"
            << " as mechanics equilibrium needs" << exit(FatalIOError);
    }
    if (isA<emptyPolyPatch>(patch))
    {
        w.axis = 1;
    }
}


void Foam::wallConditions::findFree()
{
    // Add the marks of all processes: a process may have a node of a wall
    // without having an edge of that wall
    List<vector2D> held(mesh_.size(), vector2D(Zero));
    List<vector2D> pressed(held), slip(held), count(held);

    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.type == kind::none)
        {
            continue;
        }
        for (const quadMesh::edgeOfWall& e : mesh_.wall(patchi))
        {
            for (const label node : {e.first, e.second})
            {
                if (w.type == kind::pressure)
                {
                    pressed[node] = vector2D(1, 1);
                    continue;
                }
                held[node][w.axis] = 1;
                if (w.type == kind::displacement)
                {
                    held[node] = vector2D(1, 1);
                }
                if (w.friction > 0)
                {
                    slip[node][1 - w.axis] += w.slip;
                    count[node][1 - w.axis] += 1;
                }
            }
        }
    }
    for (List<vector2D>* field : {&held, &pressed, &slip, &count})
    {
        mesh_.sum(*field);
    }
    forAll(free_, i)
    {
        for (label k = 0; k < 2; ++k)
        {
            free_[i][k] = held[i][k] > 0 ? 0 : 1;
            balanced_[i][k] = pressed[i][k] > 0 ? 0 : 1;
            slip_[i][k] = count[i][k] > 0 ? slip[i][k]/count[i][k] : 1;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalarField Foam::wallConditions::strength() const
{
    const vectorField& C = mesh_.mesh().cellCentres();
    scalarField result(C.size(), 1);

    forAll(sides_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.friction <= 0)
        {
            continue;
        }
        scalar place = -GREAT;
        for (const quadMesh::edgeOfWall& e : mesh_.wall(patchi))
        {
            place = max(place, w.outwards*mesh_.points()[e.first][w.axis]);
        }
        reduce(place, maxOp<scalar>());
        forAll(result, celli)
        {
            if (place - w.outwards*C[celli][w.axis] < w.layer)
            {
                result[celli] = max(result[celli], w.layerStrength);
            }
        }
    }
    return result;
}


// ************************************************************************* //
