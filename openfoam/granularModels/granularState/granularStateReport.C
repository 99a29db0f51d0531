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

#include "granularState.H"
#include "caseChecks.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

int64_t Foam::granularState::asked() const
{
    return returnReduce(rowsAsked_, sumOp<int64_t>());
}


int64_t Foam::granularState::cellSteps() const
{
    return returnReduce(cellSteps_, sumOp<int64_t>());
}


Foam::granularModel::counters Foam::granularState::modelCounts() const
{
    granularModel::counters all(model_->count());
    for (auto& item : all)
    {
        item.second = returnReduce(item.second, sumOp<int64_t>());
    }
    return all;
}


int64_t Foam::granularState::clampedQueries() const
{
    return returnReduce(clamped_, sumOp<int64_t>());
}


void Foam::granularState::finishStep()
{
    const bool writes = mesh_.time().writeTime();

    policy_.accept();
    if (writes || refreshAlways_)
    {
        refresh();
    }
    if (writes)
    {
        findSpread();
        checkTemperature(mesh_.lookupObject<volScalarField>("T"));
    }
}


void Foam::granularState::writeReport() const
{
    const scalarField& waiting = thermalStrainIncrement_.primitiveField();

    Info<< "Surrogate model: " << model_->source() << ", SHA-256 "
        << string(model_->hash()) << ", library "
        << string(granularModel::libraryVersion()) << nl
        << "Queries: " << queries_ << nl
        << "Cells evaluated: " << asked() << " of " << cellSteps()
        << " (cells times steps)" << nl
        << "Clamped cell-queries: " << clampedQueries() << nl;
    for (const auto& item : modelCounts())
    {
        // Parts of a number that is printed, too
        if (item.second || item.first.find("_by_") == std::string::npos)
        {
            Info<< item.first.c_str() << ": " << item.second << nl;
        }
    }
    if (bound_ > 0)
    {
        Info<< "Strain not given to the model yet, with the last step: at most "
            << gMax(mag(waiting)()) << ", bound " << bound_ << nl;
    }
    policy_.write();
}


// ************************************************************************* //
