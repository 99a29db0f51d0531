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

#include "bedFlow.H"
#include "foamVersions.H"
#include "fvcSurfaceIntegrate.H"
#include "OFstream.H"

#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularFlows
{
    //- Error of the temperatures, over the largest, at which properties and
    //- fluxes that depend on them have settled
    static const scalar settled = 1e-8, settledFlux = 1e-9;

    //- Mass that enters a bed, over the largest flux of a face, below which the
    //- bed is closed
    static const scalar closed = 1e-9;

    //- Largest normalised residual of a solution
    static const scalar mostResidual = 1e-11;
}
}

// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::granularFlows::bedFlow::~bedFlow()
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::granularFlows::bedFlow::temperatureAt
(
    const port& from
) const
{
    return from.temperature->value(mesh_.time().value());
}


Foam::scalar Foam::granularFlows::bedFlow::diameter(const label celli) const
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
Foam::granularFlows::bedFlow::state(const label celli) const
{
    const scalar T = gasT_[celli], mu = gas_.viscosity(T);
    return
    {
        mag(massFlux_[celli])*diameter(celli)/mu,
        grains_.porosity()[celli],
        mu*gas_.capacity(T)/gas_.conductivity(T)
    };
}


Foam::scalar Foam::granularFlows::bedFlow::coefficient
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


Foam::scalar Foam::granularFlows::bedFlow::stiffness(const label celli) const
{
    if (tau_ == 0)
    {
        return GREAT;
    }
    const scalar grains =
        grains_.bulkDensity()[celli]*properties_.heatCapacity().value()/tau_;
    const scalar size = std::cbrt(mesh_.V()[celli]);
    return
        storage_[celli] + Gc(celli)/size
      + (single_ ? grains : 1/(1/exchange_[celli] + 1/grains));
}


Foam::scalar Foam::granularFlows::bedFlow::exchange(const label celli) const
{
    return coefficient
    (
        state(celli), gas_.conductivity(gasT_[celli]), diameter(celli),
        properties_.conductivityFunction().value(T_[celli])
    );
}


void Foam::granularFlows::bedFlow::setFlux(const bool first)
{
    findFlux(first);
    inflow_ = massThatEnters();
    flows_ = gMax(mag(flux_.primitiveField())) > 0 || inflow_ > 0;
    unbalanced_ = netOutflow(flux_);
    if (coupled_)
    {
        massFlux_.correctBoundaryConditions();
    }
}


Foam::tmp<Foam::scalarField> Foam::granularFlows::bedFlow::netOutflow
(
    const surfaceScalarField& flux
) const
{
    tmp<scalarField> result(new scalarField(mesh_.nCells(), Zero));
    fvc::surfaceIntegrate(result.ref(), flux);
    result.ref() *= mesh_.V();
    return result;
}


Foam::scalar Foam::granularFlows::bedFlow::massThatEnters() const
{
    scalar sum = 0;
    for (const port& each : ports_)
    {
        for (const scalar m : flux_.boundaryField()[each.patch])
        {
            sum -= min(m, scalar(0));
        }
    }
    reduce(sum, sumOp<scalar>());
    // Convection in a closed bed: what enters is the error of the fluxes
    return
        sum > closed*gMax(mag(flux_.primitiveField())) ? sum : 0;
}


void Foam::granularFlows::bedFlow::update(const scalar tau)
{
    tau_ = tau;
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
        const scalar carried = Gc(celli);
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


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularFlows::bedFlow::addLoads(loadHistories& loads)
{
    for (const port& each : ports_)
    {
        if (each.temperature.valid())
        {
            loads.add(each.temperature());
        }
    }
    walls_->addLoads(loads);
}


void Foam::granularFlows::bedFlow::extend(scalar& least, scalar& most) const
{
    for (const port& each : ports_)
    {
        if (each.temperature.valid())
        {
            const scalar T = temperatureAt(each);
            least = min(least, T);
            most = max(most, T);
        }
    }
}


void Foam::granularFlows::bedFlow::begin()
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


void Foam::granularFlows::bedFlow::restore()
{
    gasT_.primitiveFieldRef() = oldT_;
    stage_ = before_;
    walls_->restore();
}


void Foam::granularFlows::bedFlow::secondStage(const scalar share)
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


void Foam::granularFlows::bedFlow::beginStage()
{
    ++stages_;
    lastChange_ = 0;
    lastRatio_ = 0;
    lastShare_ = 0;
    if (coupled_)
    {
        gasT_.correctBoundaryConditions();
    }
    setFlux(true);
    bedThen_.primitiveFieldRef() = T_;
    forAll(stage_, celli)
    {
        const scalar T = gasT_[celli];
        startThen_[celli] =
            T - (gas_.stored(T) - stage_[celli])/gas_.storage(T);
    }
    if (coupled_)
    {
        bedThen_.correctBoundaryConditions();
        startThen_.correctBoundaryConditions();
    }
    findSlopes(bedThen_, bedSlope_);
    findSlopes(startThen_, startSlope_);
}


bool Foam::granularFlows::bedFlow::solve
(
    const fvScalarMatrix& bed,
    const scalar tau,
    const scalar tolerance,
    const scalar sufficient
)
{
    if (fluxDependsOnT() && lastChange_ > 0)
    {
        setFlux(false);
    }
    update(tau);
    matrix_.clear();
    addCells();
    if (flows())
    {
        addFaces();
        forAll(mesh_.boundary(), patchi)
        {
            if (mesh_.boundary()[patchi].coupled())
            {
                addBetween(patchi);
            }
        }
        addPorts();
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
    lastRatio_ = lastChange_ > 0 ? ratio : 0;
    lastChange_ = change;
    lastShare_ = change/size;
    const scalar rest = ratio < 0.5 ? change*ratio/(1 - ratio) : change;
    return
        linear_
     || rest
     <= max((fluxDependsOnT() ? settledFlux : settled)*size, sufficient);
}


Foam::tmp<Foam::vectorField> Foam::granularFlows::bedFlow::force() const
{
    tmp<vectorField> result(new vectorField(T_.size(), Zero));
    const vector& g = properties_.gravity();
    forAll(result(), celli)
    {
        const scalar rho = gas_.density(gasT_[celli], pressureIn(celli));
        const vector& G = massFlux_[celli];
        result.ref()[celli] =
            dragOf(celli)/rho*G/max(mag(G), VSMALL)
          - (1 - grains_.porosity()[celli])*rho*g;
    }
    return result;
}


void Foam::granularFlows::bedFlow::reopen()
{
    grains_.record().flow = totalsBefore_;
    again_ = true;
}


// ************************************************************************* //
