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


void Foam::granularState::gather
(
    const scalarField& strain,
    const scalarField& total
)
{
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


void Foam::granularState::keepOrigin()
{
    forAll(state_, i)
    {
        origin_.values[i] = state_[i].primitiveField();
    }
    originStrain_ = 0;
    forAll(rows_, row)
    {
        originStrain_[rows_[row]] = strain_[row];
    }
}


void Foam::granularState::answer
(
    granularModel::query& query,
    conductivityColumns& K,
    stressColumns& sigma
) const
{
    query.conductivityXX = K.xx.data();
    query.conductivityYY = K.yy.data();
    query.conductivityXY = K.xy.empty() ? nullptr : K.xy.data();
    query.stressXX = sigma[0].data();
    query.stressYY = sigma[1].data();
    query.stressXY = K.xy.empty() ? nullptr : sigma[shearColumn()].data();
    if (model_->isThreeDimensional())
    {
        query.conductivityZZ = K.zz.data();
        query.conductivityXZ = K.xz.data();
        query.conductivityYZ = K.yz.data();
        query.stressZZ = sigma[2].data();
        query.stressXZ = sigma[4].data();
        query.stressYZ = sigma[5].data();
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
    answer(query, askedK_, askedSigma_);
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
        scalarField& after = after_.values[i];
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
    ask(after_, after_, zero_, false);
    return returnReduce(error, maxOp<scalar>());
}


void Foam::granularState::scatterConductivity(conductivityColumns& K) const
{
    forAll(rows_, row)
    {
        K.xx[rows_[row]] = askedK_.xx[row];
        K.yy[rows_[row]] = askedK_.yy[row];
    }
    if (K.xy.size())
    {
        forAll(rows_, row)
        {
            K.xy[rows_[row]] = askedK_.xy[row];
        }
    }
    if (K.zz.size())
    {
        forAll(rows_, row)
        {
            K.zz[rows_[row]] = askedK_.zz[row];
            K.xz[rows_[row]] = askedK_.xz[row];
            K.yz[rows_[row]] = askedK_.yz[row];
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularState::strain(const scalarField& from, const scalarField& to)
{
    // The factor beta = 1/(1 + alpha (T^n - T^0)) makes the strain relative to
    // the radius at step n, as models expect it
    const scalar alpha = properties_.thermalExpansion().value();
    const scalarField& total = thermalStrain_.primitiveField();
    const scalarField& waiting = thermalStrainIncrement_.primitiveField();
    const scalarField& start = initialTemperature_.primitiveField();
    temperature_ = to;

    forAll(to, celli)
    {
        const scalar e = alpha*(to[celli] - from[celli])/(1 + total[celli]);
        nextIncrement_[celli] =
            waiting[celli] == 0
          ? e
          : (1 + waiting[celli])*(1 + e) - 1;
        nextStrain_[celli] = alpha*(to[celli] - start[celli]);
    }
}


void Foam::granularState::commitStrain()
{
    thermalStrainIncrement_.primitiveFieldRef() = nextIncrement_;
    thermalStrain_.primitiveFieldRef() = nextStrain_;
}


void Foam::granularState::markIncrement()
{
    heldIncrement_ = thermalStrainIncrement_.primitiveField();
    heldStrain_ = thermalStrain_.primitiveField();
}


void Foam::granularState::restartIncrement
(
    const scalarField& from,
    const scalarField& to
)
{
    thermalStrainIncrement_.primitiveFieldRef() = heldIncrement_;
    thermalStrain_.primitiveFieldRef() = heldStrain_;
    strain(from, to);
    commitStrain();
}


bool Foam::granularState::propose
(
    const bool proposed,
    const bool secondOrder,
    scalar& error
)
{
    const scalarField& strain =
        proposed
      ? nextIncrement_
      : static_cast<const scalarField&>
        (
            thermalStrainIncrement_.primitiveField()
        );
    const scalarField& total =
        proposed
      ? nextStrain_
      : static_cast<const scalarField&>(thermalStrain_.primitiveField());

    error = 0;
    select(strain);
    gather(strain, total);

    const bool twice = secondOrder && !model_->exactIncrements();
    if (twice)
    {
        full_.setSize(state_.size(), mesh_.nCells());
        half_.setSize(state_.size(), mesh_.nCells());
    }
    columns& to = twice ? full_ : after_;
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
    asked_ += rows_.size();
    cellSteps_ += mesh_.nCells();
    clamped_ += clampedNow_;

    if (deforms_)
    {
        keepOrigin();
    }
    forAll(state_, i)
    {
        const scalarField& from = after_.values[i];
        scalarField& to = state_[i].primitiveFieldRef();
        forAll(rows_, row)
        {
            to[rows_[row]] = from[row];
        }
    }
    scatterConductivity(K_);

    scalarField& waiting = thermalStrainIncrement_.primitiveFieldRef();
    forAll(rows_, row)
    {
        const label celli = rows_[row];
        // Models without shear leave its column as it is, zero
        forAll(sigma_, i)
        {
            sigma_[i][celli] = askedSigma_[i][row];
        }
        lastStrain_[celli] = strain_[row];
        waiting[celli] = 0;
    }
    setWallResistance();
}


Foam::granularState::snapshot Foam::granularState::saveState() const
{
    snapshot now;
    now.state.resize(state_.size());
    forAll(state_, i)
    {
        now.state[i] = state_[i].primitiveField();
    }
    now.K = K_;
    now.stress = sigma_;
    now.increment = thermalStrainIncrement_.primitiveField();
    now.strain = thermalStrain_.primitiveField();
    now.lastStrain = lastStrain_;
    now.origin = origin_.values;
    now.originStrain = originStrain_;
    if (wallResistance_.valid())
    {
        const auto& patches = wallResistance_().boundaryField();
        now.walls.resize(patches.size());
        forAll(patches, patchi)
        {
            now.walls[patchi] = patches[patchi];
        }
    }
    now.queries = queries_;
    now.asked = asked_;
    now.cellSteps = cellSteps_;
    now.clamped = clamped_;
    return now;
}


void Foam::granularState::restore(const snapshot& before)
{
    forAll(state_, i)
    {
        state_[i].primitiveFieldRef() = before.state[i];
    }
    K_ = before.K;
    sigma_ = before.stress;
    thermalStrainIncrement_.primitiveFieldRef() = before.increment;
    thermalStrain_.primitiveFieldRef() = before.strain;
    lastStrain_ = before.lastStrain;
    forAll(before.origin, i)
    {
        origin_.values[i] = before.origin[i];
    }
    originStrain_ = before.originStrain;
    forAll(before.walls, patchi)
    {
        wallResistance_().boundaryFieldRef()[patchi] == before.walls[patchi];
    }
    queries_ = before.queries;
    asked_ = before.asked;
    cellSteps_ = before.cellSteps;
    clamped_ = before.clamped;
}


const Foam::granularState::conductivityColumns&
Foam::granularState::trialConductivity()
{
    trialK_.xx = K_.xx;
    trialK_.yy = K_.yy;
    trialK_.xy = K_.xy;
    trialK_.zz = K_.zz;
    trialK_.xz = K_.xz;
    trialK_.yz = K_.yz;

    select(nextIncrement_);
    gather(nextIncrement_, nextStrain_);
    ask(before_, after_, strain_, true);
    scatterConductivity(trialK_);

    if (wallResistance_.valid())
    {
        // That of the trial, from its conductivity and stress
        const conductivityColumns K(K_);
        const stressColumns sigma(sigma_);
        K_ = trialK_;
        forAll(sigma_, i)
        {
            forAll(rows_, row)
            {
                sigma_[i][rows_[row]] = askedSigma_[i][row];
            }
        }
        setWallResistance();
        K_ = K;
        sigma_ = sigma;
    }
    return trialK_;
}


bool Foam::granularState::diagonal() const
{
    // Grains that only swell in their places get no shear
    return model_->diagonal()
     || (
            properties_.getOrDefault<word>("mechanics", "none") == "none"
         && gSum(mag(K_.xy)) + gSum(mag(sigma_[shearColumn()])) == 0
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


int64_t Foam::granularState::asked() const
{
    return returnReduce(asked_, sumOp<int64_t>());
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


// ************************************************************************* //
