/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
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
    return stressColumns{-stressXX_, -stressYY_, -stressXY_};
}


void Foam::granularState::letDeform(const scalarField& strength)
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
    for
    (
        scalarField* column :
        {
            &deformedK_.xx, &deformedK_.yy, &deformedK_.xy,
            &deformedXX_, &deformedYY_, &deformedXY_
        }
    )
    {
        column->resize(cells, Zero);
    }
    rows_.clear();
    keepOrigin();
}


void Foam::granularState::tryStrain
(
    const strainColumns& strain,
    stressColumns& stress,
    tangentColumns& tangent
)
{
    const label cells = mesh_.nCells();
    FixedList<scalar*, 9> derivatives;
    forAll(tangent, k)
    {
        tangent[k].resize(cells);
        derivatives[k] = tangent[k].data();
    }

    granularModel::query query;
    query.size = cells;
    query.state = origin_.pointers.cdata();
    query.nextState = deformed_.pointers.cdata();
    query.strain = originStrain_.cdata();
    query.totalStrain = thermalStrain_.primitiveField().cdata();
    query.strainXX = strain.xx.cdata();
    query.strainYY = strain.yy.cdata();
    query.strainXY = strain.xy.cdata();
    query.rotation = strain.rotation.cdata();
    query.conductivityXX = deformedK_.xx.data();
    query.conductivityYY = deformedK_.yy.data();
    query.conductivityXY = deformedK_.xy.data();
    query.stressXX = deformedXX_.data();
    query.stressYY = deformedYY_.data();
    query.stressXY = deformedXY_.data();
    query.tangent = derivatives.cdata();
    model_->advance(query);

    // Compression positive becomes tension positive, of which the derivative
    // is the same
    stress.xx = -deformedXX_;
    stress.yy = -deformedYY_;
    stress.xy = -deformedXY_;
}


void Foam::granularState::acceptStrain()
{
    forAll(state_, i)
    {
        state_[i].primitiveFieldRef() = deformed_.values[i];
    }
    // Further strains start from here
    deformed_.swap(origin_);
    originStrain_ = 0;
    K_ = deformedK_;
    stressXX_ = deformedXX_;
    stressYY_ = deformedYY_;
    stressXY_ = deformedXY_;
}


// ************************************************************************* //
