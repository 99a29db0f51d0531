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

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Largest deviator over pressure of grains far from walls
static const scalar usualRatio = 0.3;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConstraints::checkNames(const dictionary& dict) const
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


void Foam::wallConstraints::read
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


void Foam::wallConstraints::readFriction
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


Foam::wallConstraints::frictionLaw Foam::wallConstraints::frictionOf
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


void Foam::wallConstraints::checkKeysOfType
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


// ************************************************************************* //
