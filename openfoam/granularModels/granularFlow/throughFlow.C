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

#include "throughFlow.H"
#include "foamVersions.H"
#include "OFstream.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularFlows
{
    defineTypeNameAndDebug(through, 0);
    addToRunTimeSelectionTable(granularFlow, through, dictionary);

    //- Error of the temperatures, over the largest, at which properties that
    //- depend on them have settled
    static const scalar settled = 1e-8;

    //- Largest normalised residual of a solution
    static const scalar mostResidual = 1e-11;
}
}

// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::granularFlows::through::~through()
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::granularFlows::through::inflow(const bool reversed) const
{
    const port& from = reversed ? outlet_ : inlet_;
    return from.temperature->value(mesh_.time().value());
}


Foam::scalar Foam::granularFlows::through::diameter(const label celli) const
{
    return
        2*properties_.meanRadius().value()
       *(
            1
          + properties_.thermalExpansion().value()
           *(T_[celli] - grains_.initialTemperature()[celli])
        );
}


Foam::bedCorrelations::state
Foam::granularFlows::through::state(const label celli) const
{
    const scalar T = gasT_[celli], mu = gas_.viscosity(T);
    return
    {
        mag(G_)*diameter(celli)/mu,
        grains_.porosity()[celli],
        mu*gas_.capacity(T)/gas_.conductivity(T)
    };
}


Foam::scalar Foam::granularFlows::through::coefficient
(
    const bedCorrelations::state& s,
    const scalar k,
    const scalar d,
    const scalar solid
) const
{
    return
        constantExchange_
      ? exchangeFactor_*exchangeCoefficient_
      : 6*(1 - s.porosity)
       /(d*(d/(exchangeFactor_*exchangeLaw_.value(s)*k) + d/(10*solid)));
}


Foam::scalar Foam::granularFlows::through::exchange(const label celli) const
{
    return coefficient
    (
        state(celli), gas_.conductivity(gasT_[celli]), diameter(celli),
        properties_.conductivityFunction().value(T_[celli])
    );
}


void Foam::granularFlows::through::update(const scalar tau)
{
    scalarField& H = exchange_.primitiveFieldRef();
    scalarField& E = storage_.primitiveFieldRef();
    scalarField& start = start_.primitiveFieldRef();
    scalarField& along = diffusionAlong_.primitiveFieldRef();
    scalarField& across = diffusionAcross_.primitiveFieldRef();
    forAll(H, celli)
    {
        const scalar T = gasT_[celli], slope = gas_.storage(T);
        H[celli] = exchange(celli);
        E[celli] = pores_[celli]*slope/tau;
        start[celli] = T - (gas_.stored(T) - stage_[celli])/slope;
        const scalar carried = Gc(T);
        const scalar d = carried*diameter(celli);
        along[celli] = along_*d + (single_ ? sqr(carried)/H[celli] : 0);
        across[celli] = across_*d;
    }
    if (coupled_)
    {
        T_.correctBoundaryConditions();
        for
        (
            volScalarField* field :
            {&exchange_, &storage_, &start_, &diffusionAlong_, &diffusionAcross_}
        )
        {
            field->correctBoundaryConditions();
        }
    }
    if (!walls_->empty())
    {
        walls_->update
        (
            tau,
            [this](const label celli)
            {
                return
                    bedCorrelations::wall().value(state(celli))
                   *gas_.conductivity(gasT_[celli])/diameter(celli);
            }
        );
    }
}


const Foam::granularFlows::through::rates&
Foam::granularFlows::through::heatNow() const
{
    if (lastTau_ == 0)
    {
        return last_;
    }
    scalarList all(heats, 0);
    const scalarField& V = mesh_.V();
    forAll(V, celli)
    {
        all[toBed] += V[celli]*exchange_[celli]*(gasT_[celli] - T_[celli]);
        all[held] +=
            V[celli]*pores_[celli]/lastTau_
           *(gas_.stored(gasT_[celli]) - stage_[celli]);
    }
    if (G_ != 0)
    {
        const port& from = G_ > 0 ? inlet_ : outlet_;
        const port& to = G_ > 0 ? outlet_ : inlet_;
        const scalar h = gas_.enthalpy(inflow(G_ < 0));
        for (const vector& S : mesh_.Sf().boundaryField()[from.patch])
        {
            all[entered] += mag(G_*(axis_ & S))*h;
        }
        const vectorField& S = mesh_.Sf().boundaryField()[to.patch];
        const scalarField T(leavingTemperature(to.patch));
        forAll(T, facei)
        {
            const scalar m = mag(G_*(axis_ & S[facei]));
            all[left] += m*gas_.enthalpy(T[facei]);
            all[mixed] += m*T[facei];
            all[carried] += m;
        }
    }
    const vesselWalls::rates walls(walls_->heat(gasT_, T_));
    all[gasToWall] = walls.fromGas;
    all[bedToWall] = walls.fromBed;
    all[lost] = walls.lost;
    all[heldByWall] = walls.stored;
    all[gasToSolids] = walls.gasToSolids;
    all[bedToSolids] = walls.bedToSolids;
    Pstream::listCombineGather(all, plusEqOp<scalar>());
    fromMaster(all);
    if (single_)
    {
        all[toBed] = all[entered] - all[left] - all[held] - all[gasToWall];
    }
    lastTau_ = 0;
    last_.heat = all;
    last_.outletT = all[carried] > 0 ? all[mixed]/all[carried] : 0;
    return last_;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularFlows::through::addLoads(loadHistories& loads)
{
    loads.add(flow_());
    for (const port* each : {&inlet_, &outlet_})
    {
        if (each->temperature.valid())
        {
            loads.add(each->temperature());
        }
    }
    walls_->addLoads(loads);
}


void Foam::granularFlows::through::extend(scalar& least, scalar& most) const
{
    for (const port* each : {&inlet_, &outlet_})
    {
        if (each->temperature.valid())
        {
            const scalar T = each->temperature->value(mesh_.time().value());
            least = min(least, T);
            most = max(most, T);
        }
    }
}


void Foam::granularFlows::through::begin()
{
    oldT_ = gasT_;
    forAll(before_, celli)
    {
        before_[celli] = gas_.stored(oldT_[celli]);
    }
    stage_ = before_;
    walls_->begin();
    totalsBefore_ = grains_.record().flow;
    again_ = false;
}


void Foam::granularFlows::through::restore()
{
    gasT_.primitiveFieldRef() = oldT_;
    stage_ = before_;
    walls_->restore();
}


void Foam::granularFlows::through::secondStage(const scalar share)
{
    first_ = heatNow();
    forAll(stage_, celli)
    {
        stage_[celli] =
            before_[celli]
          + (1 - share)/share*(gas_.stored(gasT_[celli]) - before_[celli]);
    }
    walls_->secondStage(share);
}


void Foam::granularFlows::through::beginStage()
{
    ++stages_;
    lastChange_ = 0;
    G_ = perFlow_*flow_->value(mesh_.time().value());
    bedThen_.primitiveFieldRef() = T_;
    forAll(stage_, celli)
    {
        const scalar T = gasT_[celli];
        startThen_[celli] =
            T - (gas_.stored(T) - stage_[celli])/gas_.storage(T);
    }
    if (coupled_)
    {
        gasT_.correctBoundaryConditions();
        bedThen_.correctBoundaryConditions();
        startThen_.correctBoundaryConditions();
    }
    findSlopes(bedThen_, bedSlope_);
    findSlopes(startThen_, startSlope_);
}


bool Foam::granularFlows::through::solve
(
    const fvScalarMatrix& bed,
    const scalar tau,
    const scalar tolerance
)
{
    update(tau);
    matrix_.clear();
    addCells();
    if (G_ != 0)
    {
        addFaces();
        forAll(mesh_.boundary(), patchi)
        {
            if (mesh_.boundary()[patchi].coupled())
            {
                addBetween(patchi);
            }
        }
        addEnds();
    }
    walls_->add(matrix_, single_);
    addBed(bed);

    twoFieldMatrix::pair x({gasT_.primitiveField(), T_.primitiveField()});
    unsettled_ += !matrix_.solve(x, min(tolerance, mostResidual));
    ++solutions_;
    iterations_ += matrix_.iterations();

    scalar change = 0, size = 0;
    forAll(x.a, celli)
    {
        change = max(change, mag(x.a[celli] - gasT_[celli]));
        change = max(change, mag(x.b[celli] - T_[celli]));
        size = max(size, mag(x.b[celli]));
    }
    gasT_.primitiveFieldRef() = x.a;
    T_.primitiveFieldRef() = x.b;
    gasT_.correctBoundaryConditions();
    T_.correctBoundaryConditions();
    walls_->solve(gasT_, T_);
    lastTau_ = tau;
    if (solverPerformance::debug)
    {
        Info<< "twoFieldMatrix:  Solving for T and gasTemperature, residual = "
            << matrix_.residual() << ", No Iterations "
            << matrix_.iterations() << endl;
    }
    reduce(change, maxOp<scalar>());
    reduce(size, maxOp<scalar>());
    // What further solutions would change, by the ratio of the last two
    const scalar ratio = lastChange_ > 0 ? change/lastChange_ : 1;
    lastChange_ = change;
    const scalar rest = ratio < 0.5 ? change*ratio/(1 - ratio) : change;
    return linear_ || rest <= settled*size;
}


Foam::scalar Foam::granularFlows::through::heat() const
{
    const scalarList& now = heatNow().heat;
    return
        Pstream::master()
      ? now[toBed] - now[bedToWall] + now[bedToSolids] : 0;
}


Foam::scalar Foam::granularFlows::through::toSolids() const
{
    return Pstream::master() ? heatNow().heat[gasToSolids] : 0;
}


void Foam::granularFlows::through::received(const scalar heat)
{
    heatNow();
    last_.heat[toBed] = heat + last_.heat[bedToWall];
}


void Foam::granularFlows::through::reopen()
{
    grains_.record().flow = totalsBefore_;
    again_ = true;
}


void Foam::granularFlows::through::finish
(
    const scalar deltaT,
    const scalar share
)
{
    const scalarList& last = heatNow().heat;
    scalarList& all = grains_.record().flow;
    scalarList step(heats);
    forAll(step, i)
    {
        const scalar first = share < 1 ? first_.heat[i] : 0;
        step[i] = deltaT*((1 - share)*first + share*last[i]);
    }
    for (label i = 0; i < passed; ++i)
    {
        all[i] += step[i];
    }
    all[passed] += mag(step[entered] - step[left]) + mag(step[toBed]);
    observe();
}


// ************************************************************************* //
