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

#include "pressureFlow.H"
#include "OStringStream.H"
#include "addToRunTimeSelectionTable.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "regionSplit.H"
#include "simpleMatrix.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularFlows
{
    defineTypeNameAndDebug(pressure, 0);
    addToRunTimeSelectionTable(granularFlow, pressure, dictionary);

    //- Faces that are turned less are normal to the line between their cells
    static const scalar mostSkew = 1e-9;

    //- Change of fluxes and psi, over the largest, at which they are solved,
    //- and the most iterations
    static const scalar settledChange = 1e-12;

    //- The same over the relative change of the temperatures by the last
    //- solution, if that is larger
    static const scalar changeByT = 1e-4;

    static const label mostNewton = 50;

    //- Share of the last change above which iterations are combined
    static const scalar slow = 0.01;

    //- Mass that the pores lose or gain, over what enters, above which the run
    //- reports a warning
    static const scalar mostExpelled = 0.05;
}
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularFlows::pressure::pressure
(
    const granularProperties& properties,
    granularState& grains,
    volScalarField& T
)
:
    bedFlow
    (
        properties, grains, T, properties.subDict("pressureCoeffs"), kindKeys
    ),
    gauge_
    (
        IOobject
        (
            "gasGaugePressure", mesh_.time().timeName(), mesh_,
            IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE
        ),
        mesh_,
        dimensionedScalar(dimPressure, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    psi_(column("psi", mesh_)),
    change_(column("psiChange", mesh_)),
    viscous_(column("viscous", mesh_)),
    perFlux_(column("perFlux", mesh_)),
    porosity_(column("porosityOfFlow", mesh_)),
    weight_(column("weight", mesh_)),
    buoyancy_(column("buoyancyOfFlow", mesh_)),
    gradient_
    (
        IOobject("psiGradient", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedVector(dimless, Zero),
        extrapolatedCalculatedFvPatchVectorField::typeName
    ),
    present_("presentFlux", flux_),
    slope_("slopeOfFlux", flux_),
    thermal_("thermalFlux", flux_),
    looseWalls_(kindKeys.choice(dict_, "channelling") == "layer"),
    looser_(T.size(), Zero),
    core_(T.size(), scalar(1)),
    fluxBefore_(flux_)
{
    massFlux_.writeOpt() = IOobject::AUTO_WRITE;
    flux_.writeOpt() = IOobject::AUTO_WRITE;
    skewed_ = max(mag(mesh_.nonOrthCorrectionVectors())).value() > mostSkew;
    readOpenings();
    checkParts();
    if (looseWalls_)
    {
        findLooseWalls();
    }
    scalarList& kept = grains.record().flow;
    kept.resize(totals + openings_.size(), 0);
    forAll(openings_, i)
    {
        openings_[i].psi = kept[totals + i];
    }
    pressure::begin();

    // The time at which most gas enters
    scalar most = 0, busiest = grains.record().startTime;
    for (const scalar t : looks())
    {
        scalar sum = 0;
        for (const opening& each : openings_)
        {
            sum += each.massFlow.valid() ? max(each.massFlow->value(t), 0) : 0;
        }
        if (sum > most)
        {
            most = sum;
            busiest = t;
        }
    }
    Time& time = const_cast<Time&>(mesh_.time());
    const scalar now = time.value();
    time.value() = busiest;
    findFlux(true);
    Info<< "Flow of " << gas_.name() << " through " << openings_.size()
        << " openings, at most " << massThatEnters() << " kg/s" << nl;
    chooseTemperatures
    (
        ports_.empty() ? gAverage(T.primitiveField()) : temperatureAt(ports_[0])
    );
    time.value() = now;
    pressure::restore();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::granularFlows::pressure::toPsi(const scalar gauge) const
{
    return
        gas_.compressible()
      ? gauge*(gas_.pressure() + 0.5*gauge)
      : gas_.density(0, 0)*gauge;
}


Foam::scalar Foam::granularFlows::pressure::toGauge(const scalar psi) const
{
    if (!gas_.compressible())
    {
        return psi/gas_.density(0, 0);
    }
    const scalar p = gas_.pressure();
    return 2*psi/(p + std::sqrt(max(p*p + 2*psi, scalar(0))));
}


void Foam::granularFlows::pressure::setProperties()
{
    const bool compressible = gas_.compressible();
    forAll(gauge_, celli)
    {
        const scalar T = gasT_[celli], mu = gas_.viscosity(T);
        const scalar porosity = grains_.porosity()[celli] + looser_[celli];
        const scalar d = diameter(celli);
        const scalar rho = gas_.density(T, pressureIn(celli));
        const scalar w = compressible ? gas_.gasConstant()*T : 1;
        porosity_[celli] = porosity;
        perFlux_[celli] = d/mu;
        viscous_[celli] =
            dragFactor_*mu*sqr((1 - porosity)/d)/pow3(porosity)*w;
        weight_[celli] = sqr(rho)*w;
        buoyancy_[celli] =
            compressible
          ? weight_[celli]*gas_.capacity(T)/(T*stiffness(celli)) : 0;
        psi_[celli] = toPsi(gauge_[celli]);
    }
    if (coupled_)
    {
        for
        (
            volScalarField* each :
            {&porosity_, &perFlux_, &viscous_, &buoyancy_, &gasT_}
        )
        {
            each->correctBoundaryConditions();
        }
    }
}


void Foam::granularFlows::pressure::guess()
{
    guess_ = 0;
    if (gMax(mag(flux_.primitiveField())) > 0)
    {
        return;
    }
    scalar steepest = 0;
    forAll(openings_, i)
    {
        const fvPatch& from = mesh_.boundary()[ports_[i].patch];
        const scalar area = gSum(from.magSf());
        guess_ = max(guess_, mag(openings_[i].flow)/area);
        for (label j = 0; j < i; ++j)
        {
            const fvPatch& to = mesh_.boundary()[ports_[j].patch];
            const scalar distance =
                mag(gAverage(from.Cf()) - gAverage(to.Cf()));
            if (!openings_[i].massFlow.valid() && !openings_[j].massFlow.valid())
            {
                steepest = max
                (
                    steepest,
                    mag(openings_[i].psi - openings_[j].psi)
                   /max(distance, VSMALL)
                );
            }
        }
    }
    // R(G) G = grad psi, of a cell in the mean
    const side mean
    {
        1, gAverage(viscous_), gAverage(perFlux_), gAverage(porosity_), 0, Zero,
        Zero, 0, 0
    };
    scalar G = 0;
    for (label i = 0; i < 30; ++i)
    {
        scalar change;
        const scalar R = resistance(mean, G, change);
        G -= (R*G - steepest)/(R + change);
    }
    guess_ = max(guess_, G);
}


Foam::scalarField Foam::granularFlows::pressure::unknowns() const
{
    DynamicList<scalar> x(psi_.size() + 2*flux_.size());
    const auto add = [&x](const scalarField& values, const scalar scale)
    {
        for (const scalar value : values)
        {
            x.append(value/scale);
        }
    };
    add(psi_.primitiveField(), psiScale_);
    add(flux_.primitiveField(), fluxScale_);
    for (const scalarField& patch : flux_.boundaryField())
    {
        add(patch, fluxScale_);
    }
    for (const opening& each : openings_)
    {
        x.append(each.psi/psiScale_);
    }
    return scalarField(x);
}


void Foam::granularFlows::pressure::setUnknowns(const scalarField& x)
{
    label i = 0;
    const auto take = [&](scalarField& values, const scalar scale)
    {
        for (scalar& value : values)
        {
            value = scale*x[i++];
        }
    };
    take(psi_.primitiveFieldRef(), psiScale_);
    take(flux_.primitiveFieldRef(), fluxScale_);
    for (scalarField& patch : flux_.boundaryFieldRef())
    {
        take(patch, fluxScale_);
    }
    for (opening& each : openings_)
    {
        each.psi = psiScale_*x[i++];
    }
    setMassFlux();
}


Foam::scalar Foam::granularFlows::pressure::massInPores() const
{
    scalar sum = 0;
    forAll(gauge_, celli)
    {
        sum +=
            mesh_.V()[celli]*grains_.porosity()[celli]
           *gas_.density(gasT_[celli], pressureIn(celli));
    }
    return returnReduce(sum, sumOp<scalar>());
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::pressure::findFlux(const bool first)
{
    const scalarField before(unknowns());
    setOpenings();
    setProperties();
    thermal_ = flux_;
    ++flows_;
    setMassFlux();
    guess();
    if (first)
    {
        // A restarted run has none
        responses_.clear();
    }
    label iterations = 0;
    scalar change = GREAT;
    const scalar enough = max(settledChange, changeByT*lastShare());
    mixing_.clear();
    while (change > enough && iterations < mostNewton)
    {
        const scalar last = change;
        const scalarField from(unknowns());
        change = iterate();
        ++iterations;
        if (change > enough && change > slow*last)
        {
            setUnknowns(mixing_.next(from, unknowns()));
        }
    }
    if (first)
    {
        mixingOfT_.clear();
    }
    else if (convergesSlowly())
    {
        setUnknowns(mixingOfT_.next(before, unknowns()));
    }
    newton_ += iterations;
    mostNewton_ = max(mostNewton_, iterations);
    unsettled_ += change > enough;
    scalar least = GREAT;
    forAll(gauge_, celli)
    {
        gauge_[celli] = toGauge(psi_[celli]);
        least = min(least, pressureIn(celli));
    }
    reduce(least, minOp<scalar>());
    gauge_.correctBoundaryConditions();
    if (gas_.compressible() && least <= 0)
    {
        FatalErrorInFunction
            << "The pressure of the gas would fall to 0 at time "
            << mesh_.time().timeName() << ": so much mass flow does not pass"
            << " the bed at the pressures of the openings" << exit(FatalError);
    }
    scalarList& kept = grains_.record().flow;
    forAll(openings_, i)
    {
        kept[totals + i] = openings_[i].psi;
    }
}


Foam::string Foam::granularFlows::pressure::sentenceOfKind() const
{
    OStringStream os;
    os.precision(6);
    os  << "Flow: at the end ";
    forAll(openings_, i)
    {
        os  << ports_[i].name << " has "
            << -gSum(flux_.boundaryField()[ports_[i].patch]) << " kg/s at "
            << pressureAt(i) << " Pa, ";
    }
    os  << "the largest mass flux is "
        << gMax(mag(massFlux_.primitiveField())) << " kg/(m2 s).";
    if (flows() && looseWalls_)
    {
        os  << " Away from the walls it is " << relativeFluxOfCore()
            << " of the mean of the bed.";
    }
    os  << " The flow took " << scalar(newton_)/max(flows_, label(1))
        << " Newton iterations in the mean, at most " << mostNewton_ << ".";
    if (unsettled_)
    {
        os  << " Warning: Flow: " << unsettled_ << " of " << flows_
            << " solutions for the pressure did not converge in " << mostNewton
            << " iterations.";
    }
    if (expelled_ > mostExpelled*entered_)
    {
        os  << " Warning: Flow: the gas in the pores loses or gains "
            << expelled_/entered_ << " of the mass that enters, because its"
            << " temperature changes; that mass is left out of the flow,"
            << " allowed: " << mostExpelled << ".";
    }
    return os.str();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularFlows::pressure::begin()
{
    bedFlow::begin();
    gaugeBefore_ = gauge_;
    fluxBefore_ = flux_;
    openingsBefore_ = openingPsi();
    massBefore_ = massInPores();
}


void Foam::granularFlows::pressure::restore()
{
    bedFlow::restore();
    gauge_.primitiveFieldRef() = gaugeBefore_;
    flux_ = fluxBefore_;
    forAll(openings_, i)
    {
        openings_[i].psi = openingsBefore_[i];
    }
}


void Foam::granularFlows::pressure::finish
(
    const scalar deltaT,
    const scalar share
)
{
    bedFlow::finish(deltaT, share);
    entered_ += deltaT*inflow();
    expelled_ += inflow() > 0 ? mag(massInPores() - massBefore_) : 0;
}


// ************************************************************************* //
