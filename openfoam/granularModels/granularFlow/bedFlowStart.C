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
#include "OFstream.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

//- Porosities that a bed of spheres has
static const scalar densest = 0.2;

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


} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularFlows::bedFlow::bedFlow
(
    const granularProperties& properties,
    granularState& grains,
    volScalarField& T,
    const dictionary& dict,
    const keyTable& kindKeys
)
:
    properties_(properties),
    grains_(grains),
    T_(T),
    mesh_(T.mesh()),
    dict_((keys.check(dict, kindKeys.names()), dict)),
    gas_(properties, keys, dict_),
    drag_(bedCorrelations::drag(keys.choice(dict_, "drag"))),
    dragFactor_(keys.number(dict_, "dragFactor")),
    constantExchange_(keys.choice(dict_, "exchange") == "constant"),
    linear_
    (
        gas_.isConstant()
     && (constantExchange_ || properties.conductivityFunction().isNumber())
     && properties.thermalExpansion().value() == 0
    ),
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
    flux_
    (
        IOobject
        (
            "gasFlux", mesh_.time().timeName(), mesh_,
            IOobject::READ_IF_PRESENT, IOobject::NO_WRITE
        ),
        mesh_,
        dimensionedScalar(dimMass/dimTime, Zero)
    ),
    massFlux_
    (
        IOobject("gasMassFlux", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedVector(dimMass/dimArea/dimTime, Zero),
        extrapolatedCalculatedFvPatchVectorField::typeName
    ),
    exchangeLaw_
    (
        bedCorrelations::exchange
        (
            constantExchange_ ? "WakaoKaguei" : keys.choice(dict_, "exchange")
        )
    ),
    exchangeCoefficient_
    (
        constantExchange_ ? keys.number(dict_, "exchangeCoefficient") : 0
    ),
    exchangeFactor_(keys.number(dict_, "exchangeFactor")),
    along_(keys.number(dict_, "dispersionAlong")),
    across_(keys.number(dict_, "dispersionAcross")),
    unbalanced_(T.size(), Zero),
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
    flux_.setOriented();
    for (const fvPatch& patch : mesh_.boundary())
    {
        coupled_ = coupled_ || patch.coupled();
    }
    reduce(coupled_, orOp<bool>());
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
    all.resize(max(all.size(), label(totals)), 0);
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::volScalarField Foam::granularFlows::bedFlow::column
(
    const word& name,
    const fvMesh& mesh
)
{
    return volScalarField
    (
        inMemory(name, mesh), mesh, dimensionedScalar(dimless, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    );
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::bedFlow::checkBed() const
{
    const word law(properties_.surrogateDict().get<word>("type"));
    if (law != "spheres" && law != "constant")
    {
        FatalIOErrorInFunction(properties_)
            << "Entry 'flow' is "
            << properties_.get<word>("flow") << " with surrogate type " << law
            << ", allowed: the types spheres and constant. No correlations of"
            << " drag and heat exchange exist for discs"
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


Foam::autoPtr<Foam::granularFlows::bedFlow::port>
Foam::granularFlows::bedFlow::readPort
(
    const word& patch,
    const dictionary& dict
) const
{
    autoPtr<port> made(new port);
    port& result = made();
    result.name = patch;
    result.patch = mesh_.boundaryMesh().findPatchID(patch);
    if (result.patch < 0)
    {
        FatalIOErrorInFunction(dict)
            << "The patch of '" << dict.dictName() << "' is " << patch
            << ", allowed: "
            << granularProperties::listed(mesh_.boundaryMesh().names()).c_str()
            << exit(FatalIOError);
    }
    if (dict.found("temperature"))
    {
        result.temperature = Function1<scalar>::New("temperature", dict);
    }
    checkWall(result);
    return made;
}


void Foam::granularFlows::bedFlow::checkWall(const port& end) const
{
    const dictionary& walls =
        properties_.subOrEmptyDict("equilibriumCoeffs").subOrEmptyDict("walls");
    const entry* found = walls.findEntry(end.name, keyType::REGEX);
    if (!found || !found->isDict())
    {
        return;
    }
    const dictionary& dict = found->dict();
    if (dict.getOrDefault<word>("type", "rigid") == "shell")
    {
        FatalIOErrorInFunction(dict)
            << "Patch " << end.name << " is a wall of type shell, and gas flows"
            << " through it, allowed: other types" << exit(FatalIOError);
    }
    if (!dict.found("displacement"))
    {
        return;
    }
    const autoPtr<Function1<vector>> displacement
    (
        Function1<vector>::New("displacement", dict)
    );
    const fvPatch& patch = mesh_.boundary()[end.patch];
    const vector normal(gSum(patch.Sf())/gSum(patch.magSf()));
    scalar away = 0;
    for (const scalar t : looks())
    {
        away = max(away, displacement->value(t) & normal);
    }
    if (away > 0)
    {
        FatalIOErrorInFunction(dict)
            << "Wall " << end.name << ", through which gas flows, moves by up to "
            << away << " m away from the bed, allowed: at most 0, because the"
            << " grains would leave it" << exit(FatalIOError);
    }
}


void Foam::granularFlows::bedFlow::checkTemperature
(
    const port& from,
    const scalar t,
    const scalar flow
) const
{
    const scalar T =
        from.temperature.valid() ? from.temperature->value(t) : -1;
    if (!(T > 0))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'temperature' of the patch " << from.name << " is ";
        if (from.temperature.valid())
        {
            FatalIOError<< T << ", allowed: > 0";
        }
        else
        {
            FatalIOError
                << "missing, allowed: the temperature of the gas that enters"
                << " there";
        }
        FatalIOError
            << ", because the mass flow is " << flow << " at time " << t
            << exit(FatalIOError);
    }
}


Foam::scalarList Foam::granularFlows::bedFlow::looks() const
{
    const scalar begin = grains_.record().startTime;
    const scalar end = min(mesh_.time().endTime().value(), GREAT);
    scalarList result(1001);
    forAll(result, i)
    {
        result[i] = begin + i*(end - begin)/(result.size() - 1);
    }
    return result;
}


bool Foam::granularFlows::bedFlow::isWall(const label patchi) const
{
    for (const port& each : ports_)
    {
        if (each.patch == patchi)
        {
            return false;
        }
    }
    return !polyPatch::constraintType(mesh_.boundary()[patchi].type());
}


void Foam::granularFlows::bedFlow::findWidth()
{
    scalar walls = 0;
    forAll(mesh_.boundary(), patchi)
    {
        walls += isWall(patchi) ? gSum(mesh_.boundary()[patchi].magSf()) : 0;
    }
    width_ = walls > 0 ? 4*gSum(mesh_.V())/walls : GREAT;
}


void Foam::granularFlows::bedFlow::chooseTemperatures(const scalar T)
{
    findWidth();
    const word choice(keys.choice(dict_, "temperatures"));
    const scalar accuracy = keys.number(dict_, "accuracy");
    const scalarField& V = mesh_.V();
    const scalar volume = gSum(V);
    const scalar flux = gSum(V*mag(massFlux_.primitiveField()))/volume;
    const scalar d = 2*properties_.meanRadius().value();
    const scalar mu = gas_.viscosity(T), k = gas_.conductivity(T);
    const scalar c = gas_.capacity(T);
    const scalar porosity = gSum(pores_*V)/volume;
    const scalar H =
        coefficient
        (
            {flux*d/mu, porosity, mu*c/k}, k, d,
            properties_.conductivityFunction().value(T)
        );
    const scalar M = massThatEnters();
    xi_ = M > 0 ? H*volume/(M*c) : 0;
    scalar& kind = grains_.record().flow[chosen];
    if (choice != "auto")
    {
        kind = choice == "one" ? 1 : 2;
    }
    else if (kind == 0)
    {
        kind = xi_ > 0 && singleGas/std::sqrt(xi_) <= accuracy ? 1 : 2;
    }
    single_ = kind == 1;
    Info<< temperatures().c_str() << nl << endl;
}


Foam::string Foam::granularFlows::bedFlow::temperatures() const
{
    OStringStream os;
    os.precision(3);
    os  << (single_ ? "One temperature" : "Two temperatures")
        << " for gas and grains";
    if (xi_ == 0)
    {
        os  << "; no gas flows at the start, so that the error of one"
            << " temperature cannot be estimated.";
        return os.str();
    }
    os  << ": in a bed of " << xi_
        << " units of transfer one temperature has an error of "
        << singleGas/std::sqrt(xi_) << " % of a sudden change at the inlet in"
        << " the gas and " << singleBed/std::sqrt(xi_) << " % in the grains.";
    return os.str();
}


// ************************************************************************* //
