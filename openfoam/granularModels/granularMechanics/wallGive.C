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

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::wallConstraints::readGive
(
    const dictionary& dict,
    wall& w
) const
{
    w.slackLayer = 2*radius_*keys.number(dict, "slackLayer");
    w.slackRecovery = keys.number(dict, "slackRecovery");
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::wallConstraints::gives() const
{
    for (const wall& w : walls_)
    {
        if (w.slackLayer > 0)
        {
            return true;
        }
    }
    return false;
}


Foam::scalarField Foam::wallConstraints::give
(
    const elementMesh::shapes& shapes,
    const scalarField& du,
    const scalarField& growth
) const
{
    const label dim = mesh_.dim();
    scalarField sum(du.size(), Zero);
    forAll(walls_, patchi)
    {
        const wall& w = walls_[patchi];
        const elementMesh::wallFaces& faces = mesh_.wall(patchi);
        scalarField ways(faces.size(), Zero);
        for (label i = 0; w.slackLayer > 0 && i < faces.size(); ++i)
        {
            const label celli = faces.cells[i];
            const scalar* n = normals_[patchi].cdata() + dim*i;
            scalar strain = -growth[celli];
            for
            (
                label a = mesh_.cellStarts()[celli];
                a < mesh_.cellStarts()[celli + 1];
                ++a
            )
            {
                const scalar* v = du.cdata() + dim*mesh_.cellNodes()[a];
                const scalar* B = shapes.gradient.cdata() + dim*a;
                scalar moved = 0, slope = 0;
                for (label k = 0; k < dim; ++k)
                {
                    moved += n[k]*v[k];
                    slope += n[k]*B[k];
                }
                strain += moved*slope;
            }

            // Grains that are pressed let the bed end farther out
            ways[i] = -strain*w.slackLayer*(strain < 0 ? 1 : w.slackRecovery);
        }
        if (w.slackLayer > 0)
        {
            holding_->each
            (
                patchi,
                [&](const label face, const label i, const scalar share)
                {
                    holding_->add(i, share*ways[face], sum);
                }
            );
        }
    }
    return mean(sum);
}


// ************************************************************************* //
