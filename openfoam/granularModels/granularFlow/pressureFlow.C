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
    static const scalar settled = 1e-12;

    //- The same over the relative change of the temperatures by the last
    //- solution, if that is larger
    static const scalar settledByT = 1e-4;

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

void Foam::granularFlows::pressure::readOpenings()
{
    const dictionary& all = dict_.subDict("openings");
    label given = 0;
    for (const entry& item : all)
    {
        if (!item.isDict())
        {
            FatalIOErrorInFunction(all)
                << "Entry '" << item.keyword() << "' of 'openings' is no"
                << " patch with braces, allowed: "
                << granularProperties::listed(mesh_.boundaryMesh().names())
                   .c_str()
                << exit(FatalIOError);
        }
        const dictionary& dict = item.dict();
        openingKeys.check(dict);
        ports_.append(readPort(item.keyword(), dict));
        const port& end = ports_.last();
        const fvPatch& patch = mesh_.boundary()[end.patch];
        if (patch.coupled() || polyPatch::constraintType(patch.type()))
        {
            FatalIOErrorInFunction(all)
                << "Opening '" << end.name << "' is a patch of the type "
                << patch.type() << ", allowed: patch, wall"
                << exit(FatalIOError);
        }
        openings_.append(new opening);
        opening& made = openings_.last();
        for (const word key : {"massFlow", "pressure"})
        {
            if (dict.found(key))
            {
                (key == "pressure" ? made.pressure : made.massFlow) =
                    Function1<scalar>::New(key, dict);
            }
        }
        if (made.massFlow.valid() && made.pressure.valid())
        {
            FatalIOErrorInFunction(dict)
                << "Entries 'massFlow' and 'pressure' of the opening "
                << end.name << " are both given, allowed: one of them"
                << exit(FatalIOError);
        }
        given += !made.massFlow.valid();
        for (const scalar t : looks())
        {
            checkTemperature
            (
                end, t, made.massFlow.valid() ? made.massFlow->value(t) : 0
            );
            const scalar p =
                made.pressure.valid() ? made.pressure->value(t) : 1;
            if (!(p > 0))
            {
                FatalIOErrorInFunction(dict)
                    << "Entry 'pressure' of the opening " << end.name << " is "
                    << p << " at time " << t << ", allowed: > 0"
                    << exit(FatalIOError);
            }
        }
        const vector middle
        (
            gSum(patch.magSf()*patch.Cf())/gSum(patch.magSf())
        );
        made.height = (patch.Cf() - middle) & properties_.gravity();
    }
    if (!given && openings_.size())
    {
        FatalIOErrorInFunction(all)
            << "Each of the " << openings_.size() << " openings has a massFlow,"
            << " allowed: at least one without, whose pressure is given"
            << exit(FatalIOError);
    }
}


void Foam::granularFlows::pressure::checkParts() const
{
    const regionSplit parts(mesh_);
    boolList given(parts.nRegions(), false);
    forAll(openings_, i)
    {
        if (!openings_[i].massFlow.valid())
        {
            const fvPatch& patch = mesh_.boundary()[ports_[i].patch];
            for (const label celli : patch.faceCells())
            {
                given[parts[celli]] = true;
            }
        }
    }
    Pstream::listCombineGather(given, orEqOp<bool>());
    fromMaster(given);
    if (given.found(false) && (given.size() > 1 || openings_.size()))
    {
        FatalErrorInFunction
            << "The mesh has " << given.size() << " parts that are not"
            << " connected, and in one of them no opening has a given pressure,"
            << " allowed: each has such an opening, or one part without openings"
            << exit(FatalError);
    }
}


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


Foam::scalarField Foam::granularFlows::pressure::psiOf
(
    const label openingi
) const
{
    const opening& each = openings_[openingi];
    const scalar T = temperatureAt(ports_[openingi]);
    const scalar p = gas_.pressure() + toGauge(each.psi);
    const scalar rho = gas_.density(T, p);
    return
        each.psi + (gas_.compressible() ? p : rho)*rho*each.height;
}


void Foam::granularFlows::pressure::setOpenings()
{
    const scalar t = mesh_.time().value();
    forAll(openings_, i)
    {
        opening& each = openings_[i];
        if (each.massFlow.valid())
        {
            each.flow = each.massFlow->value(t);
        }
        else
        {
            each.psi =
                each.pressure.valid()
              ? toPsi(each.pressure->value(t) - gas_.pressure()) : 0;
        }
    }
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


Foam::scalarList Foam::granularFlows::pressure::openingPsi() const
{
    scalarList result(openings_.size());
    forAll(result, i)
    {
        result[i] = openings_[i].psi;
    }
    return result;
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
    const scalar enough = max(settled, settledByT*lastShare());
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


Foam::string Foam::granularFlows::pressure::summaryOfKind() const
{
    OStringStream os;
    os.precision(12);
    os  << ", \"openings\": {";
    forAll(openings_, i)
    {
        os  << (i ? ", " : "") << string(ports_[i].name)
            << ": {\"mass_flow\": "
            << -gSum(flux_.boundaryField()[ports_[i].patch]) << ", \"pressure\": "
            << pressureAt(i) << "}";
    }
    os  << "}, \"core_relative_flux\": ";
    if (flows() && looseWalls_)
    {
        os  << relativeFluxOfCore();
    }
    else
    {
        os  << "null";
    }
    os  << ", \"expelled_over_entered\": "
        << expelled_/max(entered_, VSMALL)
        << ", \"newton_iterations\": "
        << scalar(newton_)/max(flows_, label(1))
        << ", \"most_newton_iterations\": " << mostNewton_;
    return os.str();
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

void Foam::granularFlows::pressure::addLoads(loadHistories& loads)
{
    for (const opening& each : openings_)
    {
        for (const auto* function : {&each.massFlow, &each.pressure})
        {
            if (function->valid())
            {
                loads.add((*function)());
            }
        }
    }
    bedFlow::addLoads(loads);
}


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
