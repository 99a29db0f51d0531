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
#include "volFields.H"
#include "nodeDyads.H"
#include "OStringStream.H"


// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Spread of the normals (root mean square) below which faces count as flat
static const scalar flat = 1e-3;

//- Difference of the radius of a shell from that of its faces, over the first,
//- above which there is a warning
static const scalar unlike = 0.25;

//- Thickness over radius up to which a wall is thin, part of its normals along
//- its axis up to which it is round about it, and strain at the start up to
//- which the temperature of its place is likely
static const scalar thin = 0.2, slanted = 0.3, likely = 2e-3;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConstraints::readShell(const dictionary& dict, wall& w) const
{
    w.radius = keys.number(dict, "radius");
    w.thickness = keys.number(dict, "thickness");
    w.stiffness = keys.number(dict, "youngModulus")*w.thickness/sqr(w.radius);
    const scalar expansion = keys.number(dict, "thermalExpansion");
    w.growth = expansion*w.radius;
    if (expansion > 0)
    {
        w.temperature = dict.get<scalar>("temperature");
    }
}


Foam::scalar Foam::wallConstraints::radiusOf(const label patchi) const
{
    // Places x and normals n of a round wall follow x = centre + radius n: sums
    // of n, x and x.n over its area. Around the axis of a wedge the radial parts
    // of the first two vanish
    const label r = mesh_.radial();
    const elementMesh::wallFaces& faces = mesh_.wall(patchi);
    vector sumN(Zero), sumX(Zero);
    scalar area = 0, products = 0;
    scalarField weights;
    for (label i = 0; i < faces.size(); ++i)
    {
        const label start = faces.start[i];
        const label count = faces.start[i + 1] - start;
        const label* nodes = faces.nodes.cdata() + start;
        weights.resize(max(weights.size(), 3*count));
        mesh_.faceWeights(mesh_.points(), nodes, count, weights.data());
        const vector n(mesh_.vectorAt(normals_[patchi], i));
        vector x(Zero);
        scalar A = 0;
        for (label a = 0; a < count; ++a)
        {
            x += mesh_.vectorAt(mesh_.points(), nodes[a])/count;
            A += mesh_.vectorAt(weights, a) & n;
        }
        area += A;
        sumN += A*n;
        sumX += A*x;
        products += A*(x & n);
    }
    reduce(area, sumOp<scalar>());
    reduce(sumN, sumOp<vector>());
    reduce(sumX, sumOp<vector>());
    reduce(products, sumOp<scalar>());
    area = max(area, VSMALL);
    if (r >= 0)
    {
        sumN[r] = sumX[r] = 0;
    }
    const scalar spread = 1 - magSqr(sumN/area);
    return
        spread > sqr(flat)
      ? (products/area - (sumX/area & sumN/area))/spread
      : 0;
}


void Foam::wallConditions::compareShells() const
{
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.type != kind::shell)
        {
            continue;
        }
        const auto warn = [&](const std::string& what)
        {
            WarningInFunction
                << "Patch " << mesh_.mesh().boundaryMesh()[patchi].name()
                << " is a shell with " << what.c_str() << "; see 'walls' of"
                << " equilibriumCoeffs" << nl << endl;
        };
        OStringStream text;
        text.precision(3);
        const scalar radius = mag(radiusOf(patchi));
        if (mag(radius - w.radius) > unlike*w.radius)
        {
            text<< "radius " << w.radius << " m, but ";
            if (radius > 0)
            {
                text<< "its faces have a radius of " << radius << " m";
            }
            else
            {
                text<< "is flat in the mesh";
            }
            text<< ". A shell moves by the pressure times radius^2 over"
                << " youngModulus and thickness, because it is round";
            warn(text.str());
        }
        if (w.thickness > thin*w.radius)
        {
            text.reset();
            text<< "thickness " << w.thickness << " m and radius " << w.radius
                << " m: a wall is thin, and moves as a shell does, up to a"
                << " thickness of a fifth of its radius";
            warn(text.str());
        }
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        const volScalarField* T =
            mesh_.mesh().findObject<volScalarField>("T");
        scalar along = 0, warm = 0, least = GREAT, most = -GREAT;
        for (label i = 0; i < faces.size(); ++i)
        {
            along += mag(mesh_.vectorAt(normals_[patchi], i) & w.axis);
            warm += T ? (*T)[faces.cells[i]] - w.temperature : 0;
            for (label a = faces.start[i]; a < faces.start[i + 1]; ++a)
            {
                const scalar place =
                    mesh_.vectorAt(mesh_.points(), faces.nodes[a]) & w.axis;
                least = min(least, place);
                most = max(most, place);
            }
        }
        const scalar count = max(returnReduce(faces.size(), sumOp<label>()), 1);
        reduce(along, sumOp<scalar>());
        reduce(warm, sumOp<scalar>());
        reduce(least, minOp<scalar>());
        reduce(most, maxOp<scalar>());
        if (along > slanted*count)
        {
            text.reset();
            text<< "axis " << w.axis << ", but the normals of its faces have "
                << along/count << " of their length along it in the mean. A round"
                << " wall expands along the axis that it is round about";
            warn(text.str());
        }
        // The wall itself reaches up to a grain farther than the mesh
        const scalar beyond =
            max(least - w.fixedPlace, w.fixedPlace - most);
        if (mag(w.axis) > 0 && beyond > 2*radius_)
        {
            text.reset();
            text<< "a fixedPoint at " << w.fixedPlace << " m along its axis, beyond"
                << " its faces from " << least << " to " << most << " m. The nearer"
                << " end is taken";
            warn(text.str());
        }
        const scalar strain = w.growth/w.radius*warm/count;
        if (mag(strain) > likely && mesh_.mesh().time().timeIndex() == 0)
        {
            text.reset();
            text<< "temperature " << w.temperature << " K, at which it has its"
                << " place. At the start it is on average " << mag(warm/count)
                << " K " << (warm > 0 ? "hotter" : "colder") << " and so "
                << 100*mag(strain) << " % " << (warm > 0 ? "larger" : "smaller")
                << " than its place";
            warn(text.str());
        }
    }
}


void Foam::wallConditions::findSupports()
{
    // A node has one normal for each smooth wall of a shell, so that a shell of
    // plane faces does not resist when it turns about its axis
    const label dim = mesh_.dim();
    DynamicList<label> supports;
    DynamicList<scalar> normal, support;
    forAll(walls_, patchi)
    {
        wall& w = walls_[patchi];
        if (w.type != kind::shell)
        {
            continue;
        }
        boolList only(walls_.size(), false);
        only[patchi] = true;
        w.shell.reset(new smoothWalls(mesh_, only));
        w.firstSupport = supports.size();
        for (label i = 0; i < w.shell->size(); ++i)
        {
            supports.append(w.shell->node(i));
            support.append(w.stiffness*w.shell->area(i));
            for (label k = 0; k < dim; ++k)
            {
                normal.append(w.shell->normal(i)[k]);
            }
        }
    }
    firstSpring_ = supports.size();
    findSprings(supports, normal, support);
    supports_ = supports;
    normal_ = scalarField(normal);
    support_ = scalarField(support);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalarField Foam::wallConditions::borneByShells
(
    const scalarField& force
) const
{
    const label dim = mesh_.dim();
    nodeDyads directions(mesh_);
    forAll(supports_, i)
    {
        directions.add(supports_[i], normal_.cdata() + dim*i, 1);
    }
    scalarField borne(force.size(), Zero), vectors, values;
    for (label node = 0; node < mesh_.size(); ++node)
    {
        const label count = directions.axes(node, vectors, values);
        for (label j = 0; j < count; ++j)
        {
            const scalar* n = vectors.cdata() + dim*j;
            const scalar along = component(force, node, n);
            for (label k = 0; k < dim; ++k)
            {
                borne[dim*node + k] += along*n[k];
            }
        }
    }
    return borne;
}


void Foam::wallConditions::addShells
(
    const scalar time,
    const scalarField& u,
    scalarField& force
) const
{
    addSprings(time, u, force);
    addCurvature(u, force);
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        if (w.type != kind::shell)
        {
            continue;
        }
        const smoothWalls& shell = w.shell();
        const label dim = mesh_.dim();
        if (w.growth > 0)
        {
            // Where the shell would be if nothing pressed on it
            const scalarField& T =
                mesh_.mesh().lookupObject<volScalarField>("T")
               .boundaryField()[patchi];
            scalarField grown(force.size(), Zero);
            shell.each
            (
                patchi,
                [&](const label face, const label i, const scalar share)
                {
                    const scalar way = w.growth*(T[face] - w.temperature);
                    shell.add(i, support_[w.firstSupport + i]*share*way, grown);
                }
            );
            mesh_.sum(grown);
            force += grown;
        }
        for (label i = 0; i < shell.size(); ++i)
        {
            const scalar along = shell.along(i, u.cdata() + dim*shell.node(i));
            shell.add(i, -support_[w.firstSupport + i]*along, force);
        }
    }
}


// ************************************************************************* //
