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

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::granularState::stressColumns
Foam::granularState::presentStress() const
{
    stressColumns stress(sigma_);
    for (scalarField& column : stress)
    {
        column.negate();
    }
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
    origin_.setSize(state_.size(), cells);
    originStrain_.resize(cells, Zero);
    deformed_.setSize(state_.size(), cells);
    deformedK_ = K_;
    deformedSigma_ = sigma_;
    rows_.clear();
    keepOrigin();
}


void Foam::granularState::evaluateTrial
(
    const strainColumns& strain,
    stressColumns& stress,
    const UList<scalar*>& tangent
)
{
    const auto pointers = [](const List<scalarField>& columns)
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

    granularModel::query query;
    query.size = mesh_.nCells();
    query.state = origin_.pointers.cdata();
    query.nextState = deformed_.pointers.cdata();
    query.strain = originStrain_.cdata();
    query.totalStrain = thermalStrain_.primitiveField().cdata();
    query.cellStrain = strained.cdata();
    query.rotation = turned.cdata();
    query.temperature = model_->isThreeDimensional() ? temperature_.cdata() : nullptr;
    answer(query, deformedK_, deformedSigma_);
    if (model_->conductsApart())
    {
        query.conductivityXX = query.conductivityYY = query.conductivityZZ =
            query.conductivityXY = query.conductivityXZ =
            query.conductivityYZ = nullptr;
    }
    query.tangent = tangent.cdata();
    query.trial = true;
    model_->advance(query);

    // Compression positive becomes tension positive, of which the derivative
    // is the same
    stress.resize(deformedSigma_.size());
    forAll(stress, i)
    {
        stress[i] = -deformedSigma_[i];
    }
}


void Foam::granularState::commitTrial()
{
    originStrain_ = 0;
    if (model_->conductsApart())
    {
        // The conductivity of the state that was tried, which no strain leaves
        // as it is
        granularModel::query query;
        query.size = mesh_.nCells();
        query.state = deformed_.pointers.cdata();
        query.nextState = deformed_.pointers.cdata();
        query.strain = originStrain_.cdata();
        query.totalStrain = thermalStrain_.primitiveField().cdata();
        query.temperature = temperature_.cdata();
        answer(query, deformedK_, deformedSigma_);
        query.trial = true;
        model_->advance(query);
    }
    forAll(state_, i)
    {
        state_[i].primitiveFieldRef() = deformed_.values[i];
    }
    // Further strains start from here
    deformed_.swap(origin_);
    K_ = deformedK_;
    sigma_ = deformedSigma_;
    setWallResistance();
}


// ************************************************************************* //
