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

#include "andersonMixing.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    //- Most results that are combined
    static const label mixed = 12;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::andersonMixing::clear()
{
    tried_.clear();
    changes_.clear();
}


Foam::scalarField Foam::andersonMixing::next
(
    const scalarField& from,
    const scalarField& to
)
{
    tried_.append(to);
    changes_.append(scalarField(to - from));
    if (tried_.size() > mixed)
    {
        for (label i = 1; i < tried_.size(); ++i)
        {
            tried_[i - 1].transfer(tried_[i]);
            changes_[i - 1].transfer(changes_[i]);
        }
        tried_.resize(mixed);
        changes_.resize(mixed);
    }

    // Differences from the last, made orthogonal one after the other, the
    // latest first; one that hardly differs from those before says nothing
    const label last = tried_.size() - 1;
    scalarField next(to), left(changes_[last]);
    PtrList<scalarField> directions, ways;
    for (label i = last - 1; i >= 0; --i)
    {
        scalarField d(changes_[i] - changes_[last]);
        scalarField way(tried_[i] - tried_[last]);
        const scalar size = gSumSqr(d);
        forAll(directions, k)
        {
            const scalar part = gSumProd(d, directions[k]);
            d -= part*directions[k];
            way -= part*ways[k];
        }
        const scalar rest = gSumSqr(d);
        if (!(rest > 1e-16*size))
        {
            continue;
        }
        d /= std::sqrt(rest);
        way /= std::sqrt(rest);
        const scalar part = gSumProd(left, d);
        left -= part*d;
        next -= part*way;
        directions.append(new scalarField(d));
        ways.append(new scalarField(way));
    }
    return next;
}


// ************************************************************************* //
