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

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Errors of a state column are relative to its largest magnitude over the
//- cells, or to this value if that is larger: otherwise a fabric index close to
//- zero everywhere would demand very small steps
static const scalar smallestScale = 0.02;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularState::select(const scalarField& strain)
{
    rows_.clear();
    const bool all = model_->followsTemperature();
    forAll(strain, celli)
    {
        const scalar e = strain[celli];
        if
        (
            all
         || (
                bound_ > 0
              ? mag(e) >= bound_
              : (e != 0 || lastStrain_[celli] != 0)
            )
        )
        {
            rows_.append(celli);
        }
    }
}


void Foam::granularState::gather(const scalarField& strain)
{
    const scalarField& total = thermalStrain_.primitiveField();
    forAll(state_, i)
    {
        const scalarField& from = state_[i].primitiveField();
        scalarField& to = before_.values[i];
        forAll(rows_, row)
        {
            to[row] = from[rows_[row]];
        }
    }
    forAll(rows_, row)
    {
        strain_[row] = strain[rows_[row]];
        total_[row] = total[rows_[row]];
        askedTemperature_[row] = temperature_[rows_[row]];
    }
}


Foam::label Foam::granularState::ask
(
    columns& from,
    columns& to,
    const scalarField& strain,
    const bool trial,
    const bool wantOutside
)
{
    granularModel::query query;
    query.size = rows_.size();
    query.cells = rows_.cdata();
    query.state = from.pointers.cdata();
    query.nextState = to.pointers.cdata();
    query.strain = strain.cdata();
    query.totalStrain = total_.cdata();
    asked_.answer(query);
    query.temperature =
        model_->isThreeDimensional() ? askedTemperature_.cdata() : nullptr;
    query.outside = wantOutside ? outside_.pointers.cdata() : nullptr;
    query.trial = trial;
    if (!trial && !model_->reportsDistances())
    {
        outsideRow_.resize(rows_.size());
        query.outsideRow = outsideRow_.data();
    }

    return query.size ? model_->advance(query) : 0;
}


bool Foam::granularState::judge
(
    const label outside,
    columns& to,
    const string& when
)
{
    clampedNow_ = outside;
    policy_.forget();
    const bool any = returnReduce(outside > 0, orOp<bool>());
    if (any || outsideSeen_)
    {
        // Cells that were not asked are where they were
        forAll(rows_, row)
        {
            inTrainingRange_[rows_[row]] = 1;
        }
        outsideSeen_ = outsideSeen_ || any;
    }
    if (!any)
    {
        return false;
    }
    if (!model_->reportsDistances())
    {
        forAll(rows_, row)
        {
            inTrainingRange_[rows_[row]] = !outsideRow_[row];
        }
        policy_.judgeRows(outside, when);
        return false;
    }

    // A second query gives the distances from the range. It repeats the first
    // without side effects: models with such a range keep no history
    outside_.setSize(state_.size() + 1, mesh_.nCells());
    ask(before_, to, strain_, false, true);
    forAll(rows_, row)
    {
        for (const scalarField& distance : outside_.values)
        {
            if (distance[row] != 0)
            {
                inTrainingRange_[rows_[row]] = 0;
            }
        }
    }
    return policy_.judge
    (
        rows_, before_.values, strain_, outside_.values, when
    );
}


Foam::scalar Foam::granularState::extrapolate()
{
    forAll(rows_, row)
    {
        halfStrain_[row] = std::sqrt(1 + strain_[row]) - 1;
    }
    ask(before_, half_, halfStrain_, false);
    ask(half_, half_, halfStrain_, false);

    // The error of one strain is quadratic in the strain, and that of two half
    // strains is half as large: twice the one minus the other cancels both
    scalar error = 0;
    forAll(state_, i)
    {
        const scalarField& full = full_.values[i];
        const scalarField& half = half_.values[i];
        scalarField& after = asked_.state.values[i];
        scalar largest = smallestScale, difference = 0;
        forAll(rows_, row)
        {
            after[row] = 2*half[row] - full[row];
            largest = max(largest, mag(half[row]));
            difference = max(difference, mag(half[row] - full[row]));
        }
        reduce(largest, maxOp<scalar>());
        error = max(error, 100*difference/largest);
    }

    // A query with zero strain brings the extrapolated state back into its
    // admissible range and gives the conductivity and stress that belong to it
    ask(asked_.state, asked_.state, zero_, false);
    return returnReduce(error, maxOp<scalar>());
}


Foam::symmTensorField Foam::granularState::askedStress() const
{
    symmTensorField result(sigma_);
    forAll(rows_, row)
    {
        result[rows_[row]] = asked_.stress[row];
    }
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularState::strain(const scalarField& from, const scalarField& to)
{
    // The factor beta = 1/(1 + alpha (T^n - T^0)) makes the strain relative to
    // the radius at step n, as models expect it
    const scalar alpha = properties_.thermalExpansion().value();
    const scalarField& start = initialTemperature_.primitiveField();
    scalarField& increment = thermalStrainIncrement_.primitiveFieldRef();
    scalarField& total = thermalStrain_.primitiveFieldRef();
    temperature_ = to;

    forAll(to, celli)
    {
        const scalar e =
            alpha*(to[celli] - from[celli])/(1 + startStrain_[celli]);
        const scalar waiting = startIncrement_[celli];
        increment[celli] = waiting == 0 ? e : (1 + waiting)*(1 + e) - 1;
        total[celli] = alpha*(to[celli] - start[celli]);
    }
}


bool Foam::granularState::propose(const bool secondOrder, scalar& error)
{
    const scalarField& strain = thermalStrainIncrement_.primitiveField();

    error = 0;
    moved_ = false;
    proposed_ = true;
    select(strain);
    gather(strain);
    if (deforms_)
    {
        stepStrain_ = 0;
        forAll(rows_, row)
        {
            stepStrain_[rows_[row]] = strain_[row];
        }
    }

    const bool twice = secondOrder && !model_->exactIncrements();
    if (twice)
    {
        full_.setSize(state_.size(), mesh_.nCells());
        half_.setSize(state_.size(), mesh_.nCells());
    }
    columns& to = twice ? full_ : asked_.state;
    const label outside = ask(before_, to, strain_, false);
    const string when("At time " + mesh_.time().timeName());

    if (judge(outside, to, when))
    {
        return true;
    }
    if (twice)
    {
        error = extrapolate();
    }
    return false;
}


void Foam::granularState::commit()
{
    queries_ += returnReduce(rows_.size(), sumOp<label>()) > 0;
    rowsAsked_ += rows_.size();
    cellSteps_ += mesh_.nCells();
    clamped_ += clampedNow_;

    symmTensorField& K = conductivity_.primitiveFieldRef();
    scalarField& waiting = thermalStrainIncrement_.primitiveFieldRef();
    if (moved_)
    {
        forAll(state_, i)
        {
            state_[i].primitiveFieldRef() = accepted_.state.values[i];
        }
        sigma_ = accepted_.stress;
        K = accepted_.conductivity;
    }
    else
    {
        forAll(state_, i)
        {
            const scalarField& from = asked_.state.values[i];
            scalarField& to = state_[i].primitiveFieldRef();
            forAll(rows_, row)
            {
                to[rows_[row]] = from[row];
            }
        }
        forAll(rows_, row)
        {
            K[rows_[row]] = asked_.conductivity[row];
            sigma_[rows_[row]] = asked_.stress[row];
        }
    }
    forAll(rows_, row)
    {
        lastStrain_[rows_[row]] = strain_[row];
        waiting[rows_[row]] = 0;
    }
    startIncrement_ = waiting;
    startStrain_ = thermalStrain_.primitiveField();
    proposed_ = moved_ = false;
    setWallResistance(K, sigma_);
}


void Foam::granularState::reject(const scalarField& T)
{
    proposed_ = moved_ = false;
    temperature_ = T;
    setWallResistance(conductivity_.primitiveField(), sigma_);
}


void Foam::granularState::findConductivity(symmTensorField& K)
{
    const scalarField& strain = thermalStrainIncrement_.primitiveField();
    select(strain);
    gather(strain);
    ask(before_, asked_.state, strain_, true);
    K = conductivity_.primitiveField();
    forAll(rows_, row)
    {
        K[rows_[row]] = asked_.conductivity[row];
    }
    if (wallResistance_.valid())
    {
        setWallResistance(K, askedStress());
    }
}


bool Foam::granularState::diagonal() const
{
    // Grains that only swell in their places get no shear
    return model_->diagonal()
     || (
            properties_.getOrDefault<word>("mechanics", "none") == "none"
         && gSum(mag(conductivity_.primitiveField().component(symmTensor::XY)))
          + gSum(mag(sigma_.component(symmTensor::XY))) == 0
        );
}


void Foam::granularState::extrapolateTemperature(scalarField& T) const
{
    const scalar alpha = properties_.thermalExpansion().value();
    const scalarField& total = thermalStrain_.primitiveField();
    const scalarField& increment = thermalStrainIncrement_.primitiveField();

    if (alpha > 0 && bound_ == 0)
    {
        forAll(T, celli)
        {
            T[celli] += increment[celli]*(1 + total[celli])/alpha;
        }
    }
}

// ************************************************************************* //
