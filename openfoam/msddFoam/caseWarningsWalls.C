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

#include "caseWarnings.H"
#include "briefNumber.H"
#include "pascals.H"
#include "wallDistance.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Height over width from which on smooth sides are reported
static const scalar tallBed = 1.5;

//- Friction of a bed of spheres along a wall with the usual coefficient 0.3:
//- most spheres roll, or do not slide
static const scalar usualFriction = 0.3;
static const scalar frictionOfBed = 0.154;

//- Cosine between a wall's normal and the load below which it is a side, and
//- share of the sides that has to be smooth
static const scalar sideCosine = 0.3;
static const scalar mostlySmooth = 0.5;

//- Share of the smooth sides below which a patch is not named, such as the hole
//- at the axis of a wedge
static const scalar smallSide = 0.05;

//- Largest usual values of keys of walls, and why
struct usualOfWall
{
    const char* key;
    scalar most;
    const char* why;
};
static const usualOfWall usualOfWalls[] =
{
    {"friction", 2, "grains on metals have 0.2 to 0.6, on sandpaper 1"},
    {"slackLayer", 10, "beds between smooth plates had 0.7 to 3.5 mean diameters"},
    {"slackRecovery", 0.5, "it was -0.5 to 0.5 in beds between smooth plates"}
};

//- Faces of a tetrahedron, and share of the cells from which on they count
static const label facesOfTetrahedron = 4;
static const scalar someCells = 0.05;

//- Share of gravity along another axis from which on it is inclined
static const scalar inclined = 1e-3;


//- The rules of the walls of a case whose grains move
static dictionary wallRules(const granularProperties& properties)
{
    return
        properties.subOrEmptyDict("equilibriumCoeffs").subOrEmptyDict("walls");
}


//- Whether a wall is given a pressure
static bool isLid(const dictionary& rules, const polyPatch& patch)
{
    const word type
    (
        rules.subOrEmptyDict(patch.name()).getOrDefault<word>("type", "")
    );
    return type == "piston" || type == "pressure";
}


static bool isSmooth(const dictionary& wall)
{
    const word type(wall.getOrDefault<word>("type", "rigid"));
    const scalar friction = wall.getOrDefault<scalar>("friction", 0);
    return type == "frictionless" || (type == "shell" && friction == 0)
     || (type == "rigid" && wall.found("friction") && friction == 0);
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::caseWarnings::checkGravity()
{
    const vector& g = properties_.gravity();
    if (mag(g) <= VSMALL || mechanics_.type() == "none")
    {
        return;
    }
    bool endless = false;
    label lids = 0;
    vector out(Zero);
    word lid;
    const dictionary rules(wallRules(properties_));
    for (label i = 0; i < mesh_.boundaryMesh().nNonProcessor(); ++i)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[i];
        endless = endless || patch.coupled();
        if (isLid(rules, patch))
        {
            ++lids;
            lid = patch.name();
            out = returnReduce(sum(patch.faceAreas()), sumOp<vector>());
        }
    }
    label along = 0;
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        along += mag(g[i]) > inclined*mag(g);
    }
    const string shown
    (
        "Gravity is (" + brief(g.x()) + ' ' + brief(g.y()) + ' ' + brief(g.z())
      + ") m/s2 in constant/g"
    );
    if (!endless && along > 1)
    {
        add
        (
            shown + ", usual: along one axis of the mesh. It presses the bed"
            " sideways onto its walls, too"
        );
    }
    else if (lids == 1 && (out & g) > -inclined*mag(out)*mag(g))
    {
        const scalar below = out & g;
        add
        (
            below > (1 - sideCosine)*mag(out)*mag(g)
          ? "Gravity points to wall '" + lid + "', whose pressure is given: the"
            " pressure has to carry the weight of the bed, "
          + brief(1e-3*magSqr(g)*gSum(grains_.mass())/below) + " kPa. Gravity"
            " points away from a lid: see constant/g"
          : shown + ", usual: away from wall '" + lid + "', which presses on the"
            " bed and is taken as its top"
        );
    }
}


void Foam::caseWarnings::checkTetrahedra()
{
    if (mechanics_.type() == "none")
    {
        return;
    }
    label count = 0;
    for (const cell& one : mesh_.cells())
    {
        count += one.size() == facesOfTetrahedron;
    }
    const scalar share =
        scalar(returnReduce(count, sumOp<label>()))
       /mesh_.globalData().nTotalCells();
    if (share > someCells)
    {
        add
        (
            brief(100*share) + " % of the cells are tetrahedra, usual: hexahedra,"
            " prisms or polyhedra (polyDualMesh). Where grains expand unevenly,"
            " linear tetrahedra lock: the mean pressure was up to 2.4 times too"
            " high, that of single cells more. Forces on whole walls are right"
        );
    }
}


void Foam::caseWarnings::checkWallKeys()
{
    const dictionary rules(wallRules(properties_));
    for (const entry& each : rules)
    {
        if (!each.isDict())
        {
            continue;
        }
        for (const usualOfWall& usual : usualOfWalls)
        {
            const scalar given = each.dict().getOrDefault<scalar>(usual.key, 0);
            if (given > usual.most)
            {
                add
                (
                    string("Entry '") + usual.key + "' of wall '"
                  + string(each.keyword()) + "' is " + brief(given)
                  + ", usual: up to " + brief(usual.most) + "; " + usual.why
                );
            }
        }
        range p;
        include(each.dict(), "pressure", p);
        if (p.least < 0)
        {
            add
            (
                "Wall '" + string(each.keyword()) + "' is given a pressure down"
                " to " + pascals(p.least) + ", usual: 0 Pa and more. It pulls,"
                " and grains carry no tension"
            );
        }
    }
}


Foam::vector Foam::caseWarnings::loadDirection() const
{
    // The load acts along gravity, else along the normal of a piston
    const dictionary rules(wallRules(properties_));
    vector along(properties_.gravity());
    for (label patchi = 0; patchi < mesh_.boundaryMesh().nNonProcessor(); ++patchi)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        if (mag(properties_.gravity()) <= VSMALL && isLid(rules, patch))
        {
            along = returnReduce(sum(patch.faceAreas()), sumOp<vector>());
        }
    }
    return along/max(mag(along), VSMALL);
}


bool Foam::caseWarnings::hasSmoothSides(const vector& along, string& names) const
{
    const dictionary rules(wallRules(properties_));
    // Patches between processes come last, and are not walls
    const label patches = mesh_.boundaryMesh().nNonProcessor();
    scalar smooth = 0, sides = 0;
    DynamicList<scalar> areas;
    DynamicList<word> smoothNames;
    for (label patchi = 0; patchi < patches; ++patchi)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        const dictionary rule(rules.subOrEmptyDict(patch.name()));
        scalar area = 0;
        for (const vector& face : patch.faceAreas())
        {
            area += mag(face & along) < sideCosine*mag(face) ? mag(face) : 0;
        }
        reduce(area, sumOp<scalar>());
        if (!isWall(patch) || area <= 0)
        {
            continue;
        }
        sides += area;
        if (isSmooth(rule))
        {
            smooth += area;
            areas.append(area);
            smoothNames.append(patch.name());
        }
    }
    forAll(areas, i)
    {
        if (areas[i] > smallSide*smooth)
        {
            names += (names.empty() ? "" : ", ") + smoothNames[i];
        }
    }
    return smooth > mostlySmooth*sides;
}


void Foam::caseWarnings::checkSides()
{
    const scalar g = mag(properties_.gravity());
    if (!grains_.model().isThreeDimensional() || mechanics_.type() == "none")
    {
        return;
    }
    const vector along(loadDirection());
    string names;
    if (mag(along) <= SMALL || !hasSmoothSides(along, names))
    {
        return;
    }
    // Lengths along the load and across it
    const vector distances(wallDistances(mesh_));
    scalar height = 0, width = GREAT;
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        if (mag(along[i]) > 1 - sideCosine)
        {
            height = mesh_.bounds().span()[i];
        }
        else if (distances[i] > 0)
        {
            width = min(width, distances[i]);
        }
    }
    if (!(height > tallBed*width))
    {
        return;
    }
    // Janssen: the stress along the bed falls by 1/e over this depth
    const scalarField& V = mesh_.V();
    const symmTensor stress(gSum(V*grains_.stress().primitiveField())/gSum(V));
    const scalar vertical = along & stress & along;
    const scalar lateral =
        mag(vertical) > VSMALL ? 0.5*(tr(stress)/vertical - 1) : scalar(0.5);
    const scalar depth =
        width/(4*frictionOfBed*max(min(lateral, scalar(1)), scalar(0.2)));
    const scalar share = 1 - std::exp(-height/depth);
    const scalar weight =
        g*height*gSum(V*grains_.bulkDensity().primitiveField())/gSum(V);
    string text
    (
        "The bed is " + brief(height/width) + " times as high as wide, and its"
        " side is smooth (" + names + "). At a usual friction of "
      + brief(usualFriction) + " the side would carry about "
    );
    if (weight > 0)
    {
        const scalar carried = 1 - share*depth/height;
        text +=
            brief(100*carried) + " % of the weight, so that it presses with "
          + brief(1e-3*weight*(1 - carried)) + " kPa at the foot and not "
          + brief(1e-3*weight) + " kPa, and ";
    }
    add
    (
        text + brief(100*share) + " % of a load on top (Janssen's estimate)."
        " Rigid walls and shells can have friction: see walls of"
        " equilibriumCoeffs"
    );
}


// ************************************************************************* //
