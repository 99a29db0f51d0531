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
#include "foamVersions.H"

#include <algorithm>
#include <array>

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Share of the largest wall across the axis below which there is none
static const scalar none = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConstraints::readAxis(const dictionary& dict, wall& w) const
{
    // In the plane the axis is normal to it
    const label r = mesh_.radial();
    const bool solid = mesh_.dim() == 3;
    if (dict.found("axis") && !solid)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'axis' is given, allowed: in space; a wedge has its own"
            << " axis, and that of a plane shell is normal to the plane"
            << exit(FatalIOError);
    }
    if (!(w.friction > 0 && w.growth > 0) || (r < 0 && !solid))
    {
        return;
    }
    const vector fixedPoint(dict.get<vector>("fixedPoint"));
    if (solid)
    {
        w.axis = dict.get<vector>("axis");
        if (!(mag(w.axis) > VSMALL))
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'axis' is " << w.axis << ", allowed: "
                << keys.allowed("axis") << exit(FatalIOError);
        }
        w.axis /= mag(w.axis);
    }
    else
    {
        w.axis[1 - r] = 1;
    }
    w.fixedPlace = fixedPoint & w.axis;
}


Foam::scalarField Foam::wallConditions::alongAxis(const label patchi) const
{
    // Where faces begin and end along the axis: the change of the width of wall
    // across it, and of this width times the rise of its temperature. Sorted, so
    // that the sums do not depend on the decomposition
    typedef std::array<scalar, 3> step;
    const wall& w = walls_[patchi];
    const elementMesh::wallFaces& faces = mesh_.wall(patchi);
    const scalarField& area = mesh_.mesh().boundary()[patchi].magSf();
    const scalarField& T =
        mesh_.mesh().lookupObject<volScalarField>("T").boundaryField()[patchi];
    scalarField places(faces.nodes.size());
    forAll(places, j)
    {
        places[j] = mesh_.vectorAt(mesh_.points(), faces.nodes[j]) & w.axis;
    }
    List<scalarField> all(Pstream::nProcs());
    scalarField& own = all[Pstream::myProcNo()];
    own.resize(4*faces.size());
    for (label i = 0; i < faces.size(); ++i)
    {
        const auto ends = std::minmax_element
        (
            places.cdata() + faces.start[i], places.cdata() + faces.start[i + 1]
        );
        own[4*i] = *ends.first;
        own[4*i + 1] = *ends.second;
        own[4*i + 2] = area[i];
        own[4*i + 3] = T[i] - w.temperature;
    }
    Pstream::gatherList(all);
    fromMaster(all);

    std::vector<step> steps;
    for (const scalarField& part : all)
    {
        for (label i = 0; i < part.size(); i += 4)
        {
            const scalar length = part[i + 1] - part[i];
            const scalar width = length > VSMALL ? part[i + 2]/length : 0;
            steps.push_back({part[i], width, width*part[i + 3]});
            steps.push_back({part[i + 1], -width, -width*part[i + 3]});
        }
    }
    std::sort(steps.begin(), steps.end());

    // The motion at each of them, from the first on
    std::vector<scalar> at, moved;
    scalar width = 0, widest = 0, warm = 0, motion = 0;
    for (const step& each : steps)
    {
        if (at.size() && width > none*widest)
        {
            motion += w.growth/w.radius*warm/width*(each[0] - at.back());
        }
        at.push_back(each[0]);
        moved.push_back(motion);
        width += each[1];
        warm += each[2];
        widest = max(widest, width);
    }
    const auto motionAt = [&](const scalar place)
    {
        const auto next = std::upper_bound(at.begin(), at.end(), place);
        const label i = next - at.begin();
        if (i == 0 || next == at.end())
        {
            return i == 0 ? scalar(0) : motion;
        }
        return
            moved[i - 1]
          + (moved[i] - moved[i - 1])*(place - at[i - 1])/(at[i] - at[i - 1]);
    };
    const scalar fixed = motionAt(w.fixedPlace);
    scalarField result(places.size());
    forAll(result, j)
    {
        result[j] = motionAt(places[j]) - fixed;
    }
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::wallConditions::shellsSlide() const
{
    for (const wall& w : walls_)
    {
        if (mag(w.axis) > 0)
        {
            return true;
        }
    }
    return false;
}


Foam::scalarField Foam::wallConditions::shellSlide() const
{
    List<scalarField> motions(walls_.size());
    forAll(walls_, patchi)
    {
        if (mag(walls_[patchi].axis) > 0)
        {
            motions[patchi] = alongAxis(patchi);
        }
    }
    return meanAlong
    (
        [](const wall& w) { return mag(w.axis) > 0; },
        [&](const label patchi, const label j)
        {
            return motions[patchi][j]*walls_[patchi].axis;
        }
    );
}


// ************************************************************************* //
