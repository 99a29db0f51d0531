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
#include "OStringStream.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::symmTensorField Foam::granularState::endStress() const
{
    symmTensorField stress
    (
        moved_ ? accepted_.stress : proposed_ ? askedStress() : sigma_
    );
    stress.negate();
    return stress;
}


void Foam::granularState::enableDeformation(const scalarField& strength)
{
    const label cells = mesh_.nCells();
    const label column = model_->stateNames().find("strength");

    if (column >= 0 && !strengthGiven_)
    {
        scalarField& now = state_[column].primitiveFieldRef();
        now = max(now, strength);
    }

    deforms_ = true;
    stepStrain_.resize(cells, Zero);
    tried_.setSize(state_.size(), cells);
    accepted_.setSize(state_.size(), cells);
}


void Foam::granularState::strainAll
(
    granularModel::query& query,
    const scalar* const* from,
    const scalarField& thermal
)
{
    query.size = mesh_.nCells();
    query.state = from;
    query.strain = thermal.cdata();
    query.totalStrain = thermalStrain_.primitiveField().cdata();
    query.temperature =
        model_->isThreeDimensional() ? temperature_.cdata() : nullptr;
    query.trial = true;
    model_->advance(query);
}


const Foam::symmTensorField& Foam::granularState::evaluateTrial
(
    const strainColumns& strain,
    const UList<scalar*>& tangent
)
{
    const auto pointers = [](const auto& columns)
    {
        List<const scalar*> result(columns.size());
        forAll(result, i)
        {
            result[i] = columns[i].cdata();
        }
        return result;
    };
    const List<const scalar*> strained(pointers(strain.strain));
    const List<const scalar*> turned(pointers(strain.rotation));
    const List<const scalar*> start(pointers(state_));

    granularModel::query query;
    query.cellStrain = strained.cdata();
    query.rotation = turned.cdata();
    tried_.answer(query);
    if (model_->conductsApart())
    {
        query.conductivity = nullptr;
    }
    query.tangent = tangent.cdata();
    strainAll
    (
        query,
        moved_ ? accepted_.state.pointers.cdata() : start.cdata(),
        stepStrain()
    );
    return tried_.stress;
}


void Foam::granularState::acceptTrial()
{
    if (model_->conductsApart())
    {
        // The conductivity of the state that was tried, which no strain leaves
        // as it is
        granularModel::query query;
        tried_.answer(query);
        strainAll(query, tried_.state.pointers.cdata(), zero_);
    }
    tried_.swap(accepted_);
    moved_ = true;
}


Foam::string Foam::granularState::describe(const label celli) const
{
    // Columns after the first two belong to a law's inner state: a law of
    // spheres has two dozen
    const label row = proposed_ ? rows_.find(celli) : -1;
    OStringStream text;
    for (label i = 0; i < min(state_.size(), label(2)); ++i)
    {
        text<< state_[i].name() << ' '
            << (
                moved_ ? accepted_.state.values[i][celli]
              : row >= 0 ? asked_.state.values[i][row]
              : state_[i][celli]
               )
            << ", ";
    }
    text<< "stress (" << (model_->isThreeDimensional() ? "xx yy zz xy xz yz" : "xx yy xy")
        << ", tension positive)";
    const symmTensor stress(endStress()[celli]);
    for (const direction k : model_->order())
    {
        text<< ' ' << 0 + stress[k];
    }
    text<< " Pa";
    return text.str();
}


// ************************************************************************* //
