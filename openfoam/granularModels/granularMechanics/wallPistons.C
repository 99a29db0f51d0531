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

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Sine of the angle up to which faces of a piston count as parallel, and other
//- walls as normal to it
static const scalar maxSlant = 1e-6;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConstraints::findPistons()
{
    const label dim = mesh_.dim();
    forAll(walls_, patchi)
    {
        if (walls_[patchi].type != kind::piston)
        {
            continue;
        }
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        const scalarField& normals = normals_[patchi];
        const word& name = mesh_.mesh().boundaryMesh()[patchi].name();
        const auto normal = [&](const label i)
        {
            vector n(Zero);
            for (label k = 0; k < dim; ++k)
            {
                n[k] = normals[dim*i + k];
            }
            return n;
        };
        piston one;
        one.normal = Zero;
        for (label i = 0; i < faces.size(); ++i)
        {
            one.normal += normal(i);
        }
        reduce(one.normal, sumOp<vector>());
        one.normal /= max(mag(one.normal), VSMALL);
        // The side of a body of revolution is round
        const label r = mesh_.radial();
        scalar slant = r < 0 ? 0 : mag(one.normal[r]);
        bool upright = true;
        for (label i = 0; i < faces.size(); ++i)
        {
            slant = max(slant, mag(normal(i) - one.normal));
        }
        reduce(slant, maxOp<scalar>());

        // A process may have a node of a patch without having a face of it
        scalarField on(mesh_.size(), Zero);
        for (const label node : faces.nodes)
        {
            on[node] = 1;
        }
        mesh_.sum(on, 1);
        DynamicList<label> nodes, owned;
        forAll(on, node)
        {
            if (on[node] > 0)
            {
                nodes.append(node);
                if (mesh_.owned().test(node))
                {
                    owned.append(node);
                }
            }
        }
        one.nodes = nodes;
        one.owned = owned;
        one.count = returnReduce(scalar(owned.size()), sumOp<scalar>());

        // Walls next to it, and other pistons, must let it move
        forAll(constrainedNodes_, i)
        {
            for (label j = 0; on[constrainedNodes_[i]] > 0 && j < directions_[i]; ++j)
            {
                scalar along = 0;
                for (label k = 0; k < dim; ++k)
                {
                    along += basis_[dim*dim*i + dim*j + k]*one.normal[k];
                }
                upright = upright && mag(along) < maxSlant;
            }
        }
        for (const piston& other : pistons_)
        {
            bool meets = false;
            for (const label node : other.nodes)
            {
                meets = meets || on[node] > 0;
            }
            upright =
                upright && !(meets && mag(other.normal & one.normal) > maxSlant);
        }
        if (slant >= maxSlant)
        {
            FatalErrorInFunction
                << "Patch " << name << " is a piston but not flat: a face is at"
                << " an angle of " << slant << " rad to the mean of all, allowed:"
                << " up to " << maxSlant << ". Move its points into a plane, which"
                << " snappyHexMesh does not do by itself, or take 'type pressure'"
                << " in 'walls' of equilibriumCoeffs" << exit(FatalError);
        }
        if (!returnReduce(upright, andOp<bool>()))
        {
            FatalErrorInFunction
                << "Patch " << name << " is a piston, and a wall next to it keeps"
                << " it from moving, or another piston that shares points with"
                << " it. Allowed next to it: walls and pistons at right angles to"
                << " it, that is along its motion; a lid of one patch; see"
                << " 'walls' of equilibriumCoeffs" << exit(FatalError);
        }
        pistons_.append(one);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallConstraints::tie(scalarField& values) const
{
    const label dim = mesh_.dim();
    for (const piston& one : pistons_)
    {
        const auto along = [&](const label node)
        {
            scalar sum = 0;
            for (label k = 0; k < dim; ++k)
            {
                sum += one.normal[k]*values[dim*node + k];
            }
            return sum;
        };
        scalar mean = 0;
        for (const label node : one.owned)
        {
            mean += along(node);
        }
        reduce(mean, sumOp<scalar>());
        mean /= max(one.count, scalar(1));
        for (const label node : one.nodes)
        {
            const scalar rest = mean - along(node);
            for (label k = 0; k < dim; ++k)
            {
                values[dim*node + k] += rest*one.normal[k];
            }
        }
    }
}


// ************************************************************************* //
