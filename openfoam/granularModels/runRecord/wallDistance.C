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

#include "wallDistance.H"
#include "emptyPolyPatch.H"
#include "symmetryPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "wedgePolyPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Cosine of the angle to an axis below which a face is a wall across it
static const scalar facing = 0.7;

//- Share of the radius of a wedge below which the hole around its axis is none
static const scalar axisHole = 0.05;

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

bool Foam::isWall(const polyPatch& patch)
{
    return
        !patch.coupled() && !isA<emptyPolyPatch>(patch)
     && !isA<wedgePolyPatch>(patch) && !isA<symmetryPolyPatch>(patch)
     && !isA<symmetryPlanePolyPatch>(patch);
}


Foam::vector Foam::wallDistances(const fvMesh& mesh)
{
    // Along x, y, z, at the low end and at the high end
    FixedList<bool, 6> walls(false);
    bool wedge = false;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        wedge = wedge || isA<wedgePolyPatch>(patch);
        if (!isWall(patch))
        {
            continue;
        }
        for (const vector& area : patch.faceAreas())
        {
            for (direction i = 0; i < vector::nComponents; ++i)
            {
                const scalar part = area[i]/max(mag(area), VSMALL);
                walls[2*i] = walls[2*i] || part < -facing;
                walls[2*i + 1] = walls[2*i + 1] || part > facing;
            }
        }
    }
    vector distances(Zero);
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        const bool low = returnReduce(walls[2*i], orOp<bool>());
        const bool high = returnReduce(walls[2*i + 1], orOp<bool>());
        const scalar from = mesh.bounds().min()[i], to = mesh.bounds().max()[i];
        // The hole that some meshes of a wedge have around the axis
        const bool hole = wedge && low && high && mag(from) < axisHole*mag(to);
        if (low || high)
        {
            distances[i] = (low && high && !hole ? 1 : 2)*(to - from);
        }
    }
    return distances;
}


Foam::scalar Foam::leastWallDistance(const fvMesh& mesh)
{
    scalar least = GREAT;
    const vector distances(wallDistances(mesh));
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        least = distances[i] > 0 ? min(least, distances[i]) : least;
    }
    return least < GREAT ? least : scalar(0);
}


// ************************************************************************* //
