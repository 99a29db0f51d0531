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
#include "addToRunTimeSelectionTable.H"
#include "foamVersions.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularFlows
{
    defineTypeNameAndDebug(through, 0);
    addToRunTimeSelectionTable(granularFlow, through, dictionary);
}
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularFlows::through::through
(
    const granularProperties& properties,
    granularState& grains,
    volScalarField& T
)
:
    bedFlow
    (
        properties, grains, T, properties.subDict("throughCoeffs"), kindKeys
    ),
    unit_(flux_)
{
    ports_.append(readEnd("inlet"));
    ports_.append(readEnd("outlet"));
    findAxis();
    findUnitFlux();
    findFlow();
    if (!active())
    {
        gasT_.writeOpt() = IOobject::NO_WRITE;
        return;
    }
    Info<< "Flow of " << gas_.name() << " along " << axis_ << ", "
        << gSum(mesh_.V())/area_ << " m through " << area_ << " m2, at most "
        << largest_ << " kg/(m2 s)" << nl;
    setG(largest_);
    const port& from = ports_[ports_[0].temperature.valid() ? 0 : 1];
    chooseTemperatures(from.temperature->value(grains.record().startTime));
    findFlux(true);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::autoPtr<Foam::granularFlows::bedFlow::port>
Foam::granularFlows::through::readEnd(const word& key) const
{
    const dictionary& dict = dict_.subDict(key);
    endKeys.check(dict);
    return readPort(dict.get<word>("patch"), dict);
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
    const port& inlet = ports_[0];
    const port& outlet = ports_[1];
    const vector S(sumOf(inlet.patch));
    area_ = mag(S);
    axis_ = -S/max(area_, VSMALL);
    const scalar opposite = axis_ & sumOf(outlet.patch);
    if (inlet.patch == outlet.patch || mag(opposite/area_ - 1) > mostTilt)
    {
        FatalIOErrorInFunction(dict_)
            << "The outlet " << outlet.name << " has " << opposite
            << " m2 across the flow and the inlet " << inlet.name << " has "
            << area_ << " m2, allowed with flow through: the same, on opposite"
            << " ends of the bed" << exit(FatalIOError);
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if
        (
            patch.coupled() || patchi == inlet.patch || patchi == outlet.patch
         || patch.type() == "empty"
        )
        {
            continue;
        }
        const vectorField& Sf = mesh_.Sf().boundaryField()[patchi];
        scalar tilt = 0;
        forAll(Sf, facei)
        {
            tilt = max(tilt, mag(Sf[facei] & axis_)/mag(Sf[facei]));
        }
        reduce(tilt, maxOp<scalar>());
        if (tilt > mostTilt)
        {
            FatalErrorInFunction
                << "Patch " << patch.name() << " is turned by a sine of " << tilt
                << " from the axis " << axis_ << " of the flow from "
                << inlet.name << " to " << outlet.name
                << ", allowed with flow through: " << mostTilt
                << ". The cross-section must be the same everywhere, and the"
                << " points of the mesh written with at least 8 digits"
                << " (writePrecision in system/controlDict)"
                << exit(FatalError);
        }
    }
}


void Foam::granularFlows::through::findUnitFlux()
{
    forAll(unit_, facei)
    {
        unit_[facei] = unitFlux(mesh_.Sf()[facei]);
    }
    forAll(mesh_.boundary(), patchi)
    {
        const bool open =
            mesh_.boundary()[patchi].coupled()
         || patchi == ports_[0].patch || patchi == ports_[1].patch;
        const vectorField& S = mesh_.Sf().boundaryField()[patchi];
        scalarField& unit = unit_.boundaryFieldRef()[patchi];
        forAll(unit, facei)
        {
            unit[facei] = open ? unitFlux(S[facei]) : 0;
        }
    }
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

    for (const scalar t : looks())
    {
        const scalar flow = flow_->value(t);
        largest_ = max(largest_, mag(perFlow_*flow));
        if (flow != 0)
        {
            checkTemperature(ports_[flow > 0 ? 0 : 1], t, flow);
        }
    }
}


void Foam::granularFlows::through::setG(const scalar G)
{
    G_ = G;
    flux_ = G*unit_;
    massFlux_.primitiveFieldRef() = G*axis_;
}


void Foam::granularFlows::through::findFlux(const bool)
{
    setG(perFlow_*flow_->value(mesh_.time().value()));
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::granularFlows::through::pressureDrop
(
    const scalar factor
) const
{
    scalar sum = 0;
    const scalarField& V = mesh_.V();
    forAll(V, celli)
    {
        const scalar T = gasT_[celli];
        sum +=
            V[celli]*factor*dragOf(celli)
           *(gas_.compressible() ? gas_.gasConstant()*T : 1/gas_.density(T, 0));
    }
    sum = returnReduce(sum, sumOp<scalar>())/area_;
    const scalar p = gas_.pressure();
    return gas_.compressible() ? 2*sum/(p + std::sqrt(p*p + 2*sum)) : sum;
}


Foam::scalar Foam::granularFlows::through::rayleigh() const
{
    const scalar g = mag(properties_.gravity());
    if (!gas_.compressible() || g == 0)
    {
        return 0;
    }
    // Straight line of the temperature over the height
    const vector up(-properties_.gravity()/g);
    const scalarField& V = mesh_.V();
    const vectorField& C = mesh_.C();
    scalarList sum(6, Zero);
    forAll(V, celli)
    {
        const scalar z = C[celli] & up, T = gasT_[celli];
        const FixedList<scalar, 6> cell
        ({
            1, z, T, z*z, z*T, up & (grains_.conductivity()[celli] & up)
        });
        forAll(sum, i)
        {
            sum[i] += V[celli]*cell[i];
        }
    }
    Pstream::listCombineGather(sum, plusEqOp<scalar>());
    fromMaster(sum);
    for (label i = 1; i < sum.size(); ++i)
    {
        sum[i] /= sum[0];
    }
    const scalar variance = sum[3] - sqr(sum[1]), T = sum[2], K = sum[5];
    const scalar height = std::sqrt(12*variance);
    const scalar colder =
        -(sum[4] - sum[1]*T)/max(variance, VSMALL)*height;
    // The permeability is that of the drag at rest
    const scalar porosity = gSum(V*grains_.porosity())/sum[0];
    const scalar d = 2*properties_.meanRadius().value();
    const scalar permeability =
        sqr(d/(1 - porosity))*pow3(porosity)
       /(dragFactor_*drag_.value({0, porosity, 1}));
    return
        sqr(gas_.density(T, gas_.pressure()))*gas_.capacity(T)*g*colder/T
       *permeability*height/(gas_.viscosity(T)*K);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularFlows::through::addLoads(loadHistories& loads)
{
    loads.add(flow_());
    bedFlow::addLoads(loads);
}


// ************************************************************************* //
