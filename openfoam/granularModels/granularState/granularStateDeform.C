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

#include <cmath>

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::granularState::stressColumns
Foam::granularState::presentStress() const
{
    return stressColumns{-stressXX_, -stressYY_, stressXY_};
}


const Foam::granularState::tangentColumns& Foam::granularState::tangent()
{
    const label cells = mesh_.nCells();
    tangent_.c11.resize(cells);
    tangent_.c22.resize(cells);
    tangent_.c12.resize(cells);

    granularModel::query query(deformation());
    query.c11 = tangent_.c11.data();
    query.c22 = tangent_.c22.data();
    query.c12 = tangent_.c12.data();
    model_->advance(query);

    return tangent_;
}


Foam::granularModel::query Foam::granularState::deformation()
{
    const label cells = mesh_.nCells();

    if (deformedXX_.size() != cells || deformed_.values.empty())
    {
        deformed_.setSize(state_.size(), cells);
        for (scalarField* column :
            {&deformedK_.xx, &deformedK_.yy, &deformedXX_, &deformedYY_})
        {
            column->resize(cells, Zero);
        }
        deviator_ = model_->stateNames().find("reducedDeviator");
    }
    presentState_.resize(state_.size());
    forAll(state_, i)
    {
        presentState_[i] = state_[i].primitiveField().cdata();
    }
    zero_ = 0;
    granularModel::query query;
    query.size = cells;
    query.state = presentState_.cdata();
    query.nextState = deformed_.pointers.cdata();
    query.strain = zero_.cdata();
    query.totalStrain = thermalStrain_.primitiveField().cdata();
    query.conductivityXX = deformedK_.xx.data();
    query.conductivityYY = deformedK_.yy.data();
    query.stressXX = deformedXX_.data();
    query.stressYY = deformedYY_.data();
    return query;
}


Foam::scalar Foam::granularState::limit
(
    const scalar p,
    const scalar q,
    const scalar xy,
    const scalar sinPhi
)
{
    const scalar most = sinPhi*p, has = std::sqrt(sqr(q) + sqr(xy));
    return has > most ? most/has : 1;
}


void Foam::granularState::tryStrain
(
    const scalarField& strainXX,
    const scalarField& strainYY,
    const scalar sinPhi,
    stressColumns& stress
) const
{
    forAll(strainXX, celli)
    {
        const scalar ex = strainXX[celli], ey = strainYY[celli];
        const scalar c12 = tangent_.c12[celli];
        const scalar xx =
            stressXX_[celli] - tangent_.c11[celli]*ex - c12*ey;
        const scalar yy =
            stressYY_[celli] - c12*ex - tangent_.c22[celli]*ey;
        const scalar p = max(0.5*(xx + yy), scalar(0));
        const scalar q = max(-p, min(p, 0.5*(xx - yy)));
        const scalar factor = limit(p, q, stress.xy[celli], sinPhi);

        stress.xx[celli] = -(p + factor*q);
        stress.yy[celli] = -(p - factor*q);
        stress.xy[celli] *= factor;
    }
}


void Foam::granularState::deform
(
    const scalarField& strainXX,
    const scalarField& strainYY,
    const scalar sinPhi,
    const scalarField& stressXY
)
{
    granularModel::query query(deformation());
    query.strainXX = strainXX.cdata();
    query.strainYY = strainYY.cdata();
    model_->advance(query);

    label limited = 0;
    forAll(deformedXX_, celli)
    {
        const scalar p = 0.5*(deformedXX_[celli] + deformedYY_[celli]);
        const scalar q = 0.5*(deformedXX_[celli] - deformedYY_[celli]);
        const scalar factor = limit(p, q, stressXY[celli], sinPhi);
        stressXY_[celli] = stressXY[celli]*factor;
        if (factor < 1 && deviator_ >= 0)
        {
            deformed_.values[deviator_][celli] *= factor;
            ++limited;
        }
    }
    if (limited)
    {
        // Another query with zero strain, for the conductivity and stress of
        // the limited state
        granularModel::query after(deformation());
        after.state = deformed_.pointers.cdata();
        model_->advance(after);
    }

    forAll(state_, i)
    {
        state_[i].primitiveFieldRef() = deformed_.values[i];
    }
    K_.xx = deformedK_.xx;
    K_.yy = deformedK_.yy;
    stressXX_ = deformedXX_;
    stressYY_ = deformedYY_;
}


// ************************************************************************* //
