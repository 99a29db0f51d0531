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
#include "OFstream.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

//- Porosities that a bed of spheres has
static const scalar densest = 0.2, loosest = 0.7;

//- Times at which functions of time are looked at
static const label looks = 1000;

} // End namespace Foam


// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static IOobject inMemory(const word& name, const fvMesh& mesh)
{
    return IOobject
    (
        name, mesh.time().timeName(), mesh, IOobject::NO_READ,
        IOobject::NO_WRITE, false
    );
}


//- Work space whose values are exchanged between processes
static volScalarField column(const word& name, const fvMesh& mesh)
{
    return volScalarField
    (
        inMemory(name, mesh), mesh, dimensionedScalar(dimless, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularFlows::through::through
(
    const granularProperties& properties,
    granularState& grains,
    volScalarField& T
)
:
    properties_(properties),
    grains_(grains),
    T_(T),
    mesh_(T.mesh()),
    dict_((keys.check(properties.subDict("throughCoeffs")), properties.subDict("throughCoeffs"))),
    gas_(properties, keys, dict_),
    drag_(bedCorrelations::drag(keys.choice(dict_, "drag"))),
    constantExchange_(keys.choice(dict_, "exchange") == "constant"),
    exchangeLaw_
    (
        bedCorrelations::exchange
        (
            constantExchange_ ? "WakaoKaguei" : keys.choice(dict_, "exchange")
        )
    ),
    linear_
    (
        gas_.isConstant()
     && (constantExchange_ || properties.conductivityFunction().isNumber())
     && properties.thermalExpansion().value() == 0
    ),
    exchangeCoefficient_
    (
        constantExchange_ ? keys.number(dict_, "exchangeCoefficient") : 0
    ),
    dragFactor_(keys.number(dict_, "dragFactor")),
    exchangeFactor_(keys.number(dict_, "exchangeFactor")),
    along_(keys.number(dict_, "dispersionAlong")),
    across_(keys.number(dict_, "dispersionAcross")),
    inlet_(readEnd("inlet")),
    outlet_(readEnd("outlet")),
    unbalanced_(T.size(), Zero),
    gasT_
    (
        IOobject
        (
            "gasTemperature", mesh_.time().timeName(), mesh_,
            IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE
        ),
        mesh_,
        dimensionedScalar(T.dimensions(), Zero),
        zeroGradientFvPatchScalarField::typeName
    ),
    exchange_(column("exchange", mesh_)),
    storage_(column("storage", mesh_)),
    start_(column("start", mesh_)),
    bedThen_(column("bedThen", mesh_)),
    startThen_(column("startThen", mesh_)),
    bedSlope_(column("bedSlope", mesh_)),
    startSlope_(column("startSlope", mesh_)),
    atInlet_(column("atInlet", mesh_)),
    diffusionAlong_(column("diffusionAlong", mesh_)),
    diffusionAcross_(column("diffusionAcross", mesh_)),
    pores_(1 - grains.bulkDensity().primitiveField()/properties.density().value()),
    before_(T.size(), Zero),
    stage_(T.size(), Zero),
    oldT_(T.size(), Zero),
    matrix_(T)
{
    checkBed();
    for (const fvPatch& patch : mesh_.boundary())
    {
        coupled_ = coupled_ || patch.coupled();
    }
    reduce(coupled_, orOp<bool>());
    findAxis();
    findFlow();
    walls_.reset
    (
        new vesselWalls(properties, grains, T, dict_.subOrEmptyDict("walls"))
    );
    if (gMax(gasT_.primitiveField()) <= 0)
    {
        // There was no such file
        gasT_.primitiveFieldRef() = T.primitiveField();
        gasT_.correctBoundaryConditions();
    }
    scalarList& all = grains.record().flow;
    all.resize(totals, 0);
    if (flows_)
    {
        chooseTemperatures();
    }
    else
    {
        gasT_.writeOpt() = IOobject::NO_WRITE;
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::through::checkBed() const
{
    const word law(properties_.surrogateDict().get<word>("type"));
    if (law != "spheres" && law != "constant")
    {
        FatalIOErrorInFunction(properties_)
            << "Entry 'flow' is through with surrogate type " << law
            << ", allowed: the types spheres and constant. No correlations of"
            << " drag and heat exchange are known for discs"
            << exit(FatalIOError);
    }
    const scalar least = gMin(grains_.porosity());
    const scalar most = gMax(grains_.porosity());
    if (least < densest || most > loosest)
    {
        FatalErrorInFunction
            << "Field porosity is from " << least << " to " << most
            << ", allowed with a flow: " << densest << " to " << loosest
            << exit(FatalError);
    }
}


Foam::granularFlows::through::port
Foam::granularFlows::through::readEnd(const word& key) const
{
    const dictionary& dict = dict_.subDict(key);
    endKeys.check(dict);
    port result;
    result.name = dict.get<word>("patch");
    result.patch = mesh_.boundaryMesh().findPatchID(result.name);
    if (result.patch < 0)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'patch' of '" << key << "' is " << result.name
            << ", allowed: "
            << granularProperties::listed(mesh_.boundaryMesh().names()).c_str()
            << exit(FatalIOError);
    }
    if (dict.found("temperature"))
    {
        result.temperature = Function1<scalar>::New("temperature", dict);
    }
    return result;
}


void Foam::granularFlows::through::findAxis()
{
    const auto sumOf = [this](const label patchi)
    {
        return returnReduce
        (
            sum(mesh_.Sf().boundaryField()[patchi]), sumOp<vector>()
        );
    };
    const vector S(sumOf(inlet_.patch));
    area_ = mag(S);
    axis_ = -S/max(area_, VSMALL);
    const scalar opposite = axis_ & sumOf(outlet_.patch);
    if (inlet_.patch == outlet_.patch || mag(opposite/area_ - 1) > mostTilt)
    {
        FatalIOErrorInFunction(dict_)
            << "The outlet " << outlet_.name << " has " << opposite
            << " m2 across the flow and the inlet " << inlet_.name << " has "
            << area_ << " m2, allowed with flow through: the same, on opposite"
            << " ends of the bed" << exit(FatalIOError);
    }
    scalar walls = 0;
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if
        (
            patch.coupled() || patchi == inlet_.patch || patchi == outlet_.patch
         || patch.type() == "empty"
        )
        {
            continue;
        }
        const vectorField& Sf = mesh_.Sf().boundaryField()[patchi];
        scalar tilt = 0, area = 0;
        forAll(Sf, facei)
        {
            tilt = max(tilt, mag(Sf[facei] & axis_)/mag(Sf[facei]));
            area += mag(Sf[facei]);
        }
        reduce(tilt, maxOp<scalar>());
        if (tilt > mostTilt)
        {
            FatalErrorInFunction
                << "Patch " << patch.name() << " is turned by a sine of " << tilt
                << " from the axis " << axis_ << " of the flow from "
                << inlet_.name << " to " << outlet_.name
                << ", allowed with flow through: " << mostTilt
                << ". The cross-section must be the same everywhere, and the"
                << " points of the mesh written with at least 8 digits"
                << " (writePrecision in system/controlDict)"
                << exit(FatalError);
        }
        walls +=
            polyPatch::constraintType(patch.type())
          ? 0 : returnReduce(area, sumOp<scalar>());
    }
    const scalarField& V = mesh_.V();
    const scalar volume = gSum(V);
    length_ = volume/area_;
    width_ = walls > 0 ? 4*volume/walls : GREAT;

    unitFlux_.resize(mesh_.nInternalFaces());
    forAll(unitFlux_, facei)
    {
        unitFlux_[facei] = unitFlux(mesh_.Sf()[facei]);
    }
    scalarField crossed(V.size(), Zero);
    forAll(unitFlux_, facei)
    {
        const label P = mesh_.owner()[facei], N = mesh_.neighbour()[facei];
        unbalanced_[P] += unitFlux_[facei];
        unbalanced_[N] -= unitFlux_[facei];
        crossed[P] += 0.5*mag(unitFlux_[facei]);
        crossed[N] += 0.5*mag(unitFlux_[facei]);
    }
    forAll(mesh_.boundary(), patchi)
    {
        if
        (
            mesh_.boundary()[patchi].coupled()
         || patchi == inlet_.patch || patchi == outlet_.patch
        )
        {
            const labelUList& cells = mesh_.boundary()[patchi].faceCells();
            const vectorField& Sf = mesh_.Sf().boundaryField()[patchi];
            forAll(cells, facei)
            {
                unbalanced_[cells[facei]] += unitFlux(Sf[facei]);
                crossed[cells[facei]] += 0.5*mag(unitFlux(Sf[facei]));
            }
        }
    }
    forAll(V, celli)
    {
        longestCell_ = max(longestCell_, V[celli]/max(crossed[celli], VSMALL));
    }
    reduce(longestCell_, maxOp<scalar>());
}


void Foam::granularFlows::through::findFlow()
{
    const bool whole = dict_.found("massFlow");
    if (whole == dict_.found("massFlux"))
    {
        FatalIOErrorInFunction(dict_)
            << "Entries 'massFlow' and 'massFlux' are "
            << (whole ? "both given" : "missing") << ", allowed: one of them"
            << exit(FatalIOError);
    }
    flow_ = Function1<scalar>::New(whole ? "massFlow" : "massFlux", dict_);
    perFlow_ = whole ? 1/area_ : 1;

    // Each temperature while gas enters with it
    const scalar begin = grains_.record().startTime;
    const scalar end = mesh_.time().endTime().value();
    for (label look = 0; look <= looks; ++look)
    {
        const scalar t = begin + look*(min(end, GREAT) - begin)/looks;
        const scalar flow = flow_->value(t);
        flows_ = flows_ || flow != 0;
        if (flow == 0)
        {
            continue;
        }
        const auto& from = flow > 0 ? inlet_ : outlet_;
        if (!from.temperature.valid())
        {
            FatalIOErrorInFunction(dict_)
                << "Entry 'temperature' of " << (flow > 0 ? "'inlet'" : "'outlet'")
                << " is missing, allowed: the temperature of the gas that"
                << " enters there, because the mass flow is " << flow
                << " at time " << t << exit(FatalIOError);
        }
        const scalar T = from.temperature->value(t);
        if (!(T > 0))
        {
            FatalIOErrorInFunction(dict_)
                << "Entry 'temperature' of " << (flow > 0 ? "'inlet'" : "'outlet'")
                << " is " << T << " at time " << t << ", allowed: > 0"
                << exit(FatalIOError);
        }
    }
}


void Foam::granularFlows::through::chooseTemperatures()
{
    const word choice(keys.choice(dict_, "temperatures"));
    const scalar accuracy = keys.number(dict_, "accuracy");
    const scalar begin = grains_.record().startTime;
    const scalar end = mesh_.time().endTime().value();
    scalar flux = 0;
    for (label look = 0; look <= looks; ++look)
    {
        const scalar t = begin + look*(min(end, GREAT) - begin)/looks;
        flux = max(flux, mag(perFlow_*flow_->value(t)));
    }
    const scalar T =
        (inlet_.temperature.valid() ? inlet_ : outlet_).temperature->value(begin);
    const scalar d = 2*properties_.meanRadius().value();
    const scalar mu = gas_.viscosity(T), k = gas_.conductivity(T);
    const scalar c = gas_.capacity(T);
    const scalar porosity =
        gSum(pores_*mesh_.V())/gSum(mesh_.V().field());
    const scalar H =
        coefficient
        (
            {flux*d/mu, porosity, mu*c/k}, k, d,
            properties_.conductivityFunction().value(T)
        );
    xi_ = H*length_/(flux*c);
    scalar& kind = grains_.record().flow[chosen];
    if (choice != "auto")
    {
        kind = choice == "one" ? 1 : 2;
    }
    else if (kind == 0)
    {
        kind = singleGas/std::sqrt(xi_) <= accuracy ? 1 : 2;
    }
    single_ = kind == 1;
    Info<< "Flow of " << gas_.name() << " along " << axis_ << ", " << length_
        << " m through " << area_ << " m2, at most " << flux
        << " kg/(m2 s)" << nl << temperatures().c_str() << nl << endl;
}


Foam::string Foam::granularFlows::through::temperatures() const
{
    OStringStream os;
    os.precision(3);
    os  << (single_ ? "One temperature" : "Two temperatures")
        << " for gas and grains: in a bed of " << xi_
        << " units of transfer one temperature has an error of "
        << singleGas/std::sqrt(xi_) << " % of a sudden change at the inlet in"
        << " the gas and " << singleBed/std::sqrt(xi_) << " % in the grains.";
    return os.str();
}


// ************************************************************************* //
