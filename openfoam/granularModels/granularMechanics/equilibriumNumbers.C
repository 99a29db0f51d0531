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

#include "petscObjects.H"
#include "granularProperties.H"
#include "syncTools.H"
#include "globalIndex.H"
#include "OStringStream.H"

#include <cmath>
#include <cstdlib>
#include <dlfcn.h>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::equilibriumSolver::findNumbers()
{
    const bitSet& owned = mesh_.owned();
    const globalIndex offsets(label(owned.count()));
    number_.resize(mesh_.size(), -1);
    label count = 0;
    forAll(number_, node)
    {
        if (owned.test(node))
        {
            number_[node] = offsets.toGlobal(count++);
        }
    }
    if (Pstream::parRun())
    {
        syncTools::syncPointList
        (
            mesh_.mesh(), mesh_.front(), number_, maxEqOp<label>(), label(-1)
        );
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::equilibriumSolver::toVector
(
    const scalarField& from,
    double* to
) const
{
    const label dim = mesh_.dim();
    if (!Pstream::parRun())
    {
        std::copy(from.begin(), from.end(), to);
        return;
    }
    label at = 0;
    for (label node = 0; node < mesh_.size(); ++node)
    {
        if (mesh_.owned().test(node))
        {
            for (label k = 0; k < dim; ++k)
            {
                to[at++] = from[dim*node + k];
            }
        }
    }
}


void Foam::equilibriumSolver::toField
(
    const double* from,
    scalarField& to
) const
{
    const label dim = mesh_.dim();
    to.resize(dim*mesh_.size());
    if (!Pstream::parRun())
    {
        std::copy(from, from + to.size(), to.begin());
        return;
    }
    label at = 0;
    for (label node = 0; node < mesh_.size(); ++node)
    {
        const bool mine = mesh_.owned().test(node);
        for (label k = 0; k < dim; ++k)
        {
            to[dim*node + k] = mine ? from[at++] : 0;
        }
    }
    mesh_.sum(to);
}


// ************************************************************************* //
