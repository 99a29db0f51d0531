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
#include "mathematicalConstants.H"

#include <cmath>

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Bounds of what the flow is valid for: speed over that of sound, pressure drop
//- over the pressure, Biot number of the grains over 5, mean free path over the
//- hydraulic diameter of the pores, share of the gas that the core of the bed
//- lacks
static const scalar mostMach = 0.3, mostShare = 0.3, mostBiot = 5;
static const scalar mostKnudsen = 0.01, mostMissing = 0.1;

//- Rayleigh number at which gas at rest, heated from below, begins to convect
//- (Horton and Rogers, J. Appl. Phys. 16, 367, 1945; Lapwood, Proc. Camb. Phil.
//- Soc. 44, 508, 1948)
static const scalar mostRayleigh = 4*sqr(constant::mathematical::pi);

//- Share of the gas that the core of a bed lacks because the bed is looser at
//- its walls, by the diameter of the bed over that of the grains (Di Felice and
//- Gibilaro, Chem. Eng. Sci. 59, 3037, 2004)
static scalar missingInCore(const scalar widths)
{
    return 1 - 1/(2.06 - 1.06*sqr(1 - 1/max(widths, scalar(1))));
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::bedFlowTypes::extremes::reduce()
{
    for (label* each : {&outsideDrag, &outsideExchange, &outsideGas})
    {
        Foam::reduce(*each, sumOp<label>());
    }
    for (scalar* each : {&leastRe, &coldest, &widths})
    {
        Foam::reduce(*each, minOp<scalar>());
    }
    for (scalar* each : {&mostRe, &hottest, &mach, &biot, &knudsen, &lift})
    {
        Foam::reduce(*each, maxOp<scalar>());
    }
}


void Foam::granularFlows::bedFlowTypes::extremes::extend(const extremes& now)
{
    outsideDrag = max(outsideDrag, now.outsideDrag);
    outsideExchange = max(outsideExchange, now.outsideExchange);
    outsideGas = max(outsideGas, now.outsideGas);
    leastRe = min(leastRe, now.leastRe);
    coldest = min(coldest, now.coldest);
    widths = min(widths, now.widths);
    mostRe = max(mostRe, now.mostRe);
    hottest = max(hottest, now.hottest);
    mach = max(mach, now.mach);
    biot = max(biot, now.biot);
    knudsen = max(knudsen, now.knudsen);
    lift = max(lift, now.lift);
}


Foam::granularFlows::bedFlow::extremes
Foam::granularFlows::bedFlow::extremesNow() const
{
    extremes now;
    const vector& g = properties_.gravity();
    const scalar R = gas_.gasConstant();
    const auto addSpeed = [&](const label celli, const scalar G, const scalar p)
    {
        const scalar T = gasT_[celli], c = gas_.capacity(T);
        const scalar porosity = grains_.porosity()[celli];
        now.mach = max
        (
            now.mach,
            G/(gas_.density(T, p)*porosity*std::sqrt(c/(c - R)*R*T))
        );
    };
    // The pressure varies most where the gas leaves
    for (label i = 0; gas_.compressible() && i < ports_.size(); ++i)
    {
        const label patchi = ports_[i].patch;
        const fvPatch& patch = mesh_.boundary()[patchi];
        const scalarField G(mag(flux_.boundaryField()[patchi])/patch.magSf());
        forAll(G, facei)
        {
            addSpeed(patch.faceCells()[facei], G[facei], pressureAt(i));
        }
    }
    forAll(gasT_, celli)
    {
        const scalar T = gasT_[celli];
        const bedCorrelations::state s(state(celli));
        const scalar d = diameter(celli);
        now.widths = min(now.widths, width_/d);
        now.outsideDrag += !drag_.isValid(s, width_/d);
        now.outsideExchange +=
            !constantExchange_ && !exchangeLaw_.isValid(s, width_/d);
        now.outsideGas += !gas_.isKnown(T);
        now.leastRe = min(now.leastRe, s.Re);
        now.mostRe = max(now.mostRe, s.Re);
        now.coldest = min(now.coldest, T);
        now.hottest = max(now.hottest, T);
        const scalar p = pressureIn(celli), rho = gas_.density(T, p);
        if (gas_.compressible())
        {
            addSpeed(celli, mag(massFlux_[celli]), p);
            const scalar path =
                gas_.viscosity(T)/p
               *std::sqrt(0.5*constant::mathematical::pi*R*T);
            now.knudsen = max
            (
                now.knudsen, 1.5*(1 - s.porosity)*path/(s.porosity*d)
            );
        }
        if (!constantExchange_)
        {
            now.biot = max
            (
                now.biot,
                exchangeLaw_.value(s)*gas_.conductivity(T)
               /(2*properties_.conductivityFunction().value(T_[celli]))
            );
        }
        const vector& G = massFlux_[celli];
        if ((G & g) < 0)
        {
            now.lift = max
            (
                now.lift,
               -dragOf(celli)/rho*(G & g)
               /(
                    mag(G)*magSqr(g)*(1 - s.porosity)
                   *(properties_.density().value() - rho)
                )
            );
        }
    }
    now.reduce();
    return now;
}


void Foam::granularFlows::bedFlow::observe()
{
    drop_ = 0;
    extremes now;
    if (flows())
    {
        now = extremesNow();
        drop_ = pressureDrop(1);
        largestDrop_ = max(largestDrop_, drop_);
        largestShare_ = max(largestShare_, drop_/gas_.pressure());
    }
    else
    {
        largestRayleigh_ = max(largestRayleigh_, rayleigh());
    }
    if (now.mach > 1)
    {
        FatalErrorInFunction
            << "The flow would be choked at time " << mesh_.time().timeName()
            << ": the gas in the pores reaches " << now.mach
            << " of the speed of sound, allowed: at most 1" << exit(FatalError);
    }
    if (now.lift > 1)
    {
        FatalErrorInFunction
            << "The bed would lift at time " << mesh_.time().timeName()
            << ": the gas flows upwards, and its pressure gradient is up to "
            << now.lift << " times the weight of the grains, allowed: below 1"
            << exit(FatalError);
    }
    const auto warn = [&](const label cells, const label before, const string& what)
    {
        if (cells > 0 && before == 0)
        {
            Info<< "Warning: from time " << mesh_.time().timeName() << " on "
                << cells << " cells are out of the range of " << what.c_str()
                << nl;
        }
    };
    warn(now.outsideDrag, met_.outsideDrag, "the drag " + string(drag_.name));
    warn
    (
        now.outsideExchange, met_.outsideExchange,
        "the heat exchange " + string(exchangeLaw_.name)
    );
    warn
    (
        now.outsideGas, met_.outsideGas,
        "the properties of " + string(gas_.name())
    );
    met_.extend(now);
    if (solverPerformance::debug)
    {
        Info<< "Flow: " << massFlow() << " kg/s, outlet " << last_.outletT
            << " K, pressure drop " << drop_ << " Pa" << nl;
    }
    writeLine();
}


Foam::scalar Foam::granularFlows::bedFlow::frontWidth() const
{
    if (inflow_ == 0)
    {
        return GREAT;
    }
    scalar spread = 0, stored = 0;
    const scalarField& V = mesh_.V();
    forAll(V, celli)
    {
        const scalar c = Gc(celli);
        spread += V[celli]*(sqr(c)/exchange(celli) + along_*c*diameter(celli));
        stored += V[celli]*grains_.bulkDensity()[celli];
    }
    reduce(spread, sumOp<scalar>());
    reduce(stored, sumOp<scalar>());
    const scalar t = mesh_.time().value() - grains_.record().startTime;
    return std::sqrt(2*spread*t/(stored*properties_.heatCapacity().value()));
}


Foam::scalar Foam::granularFlows::bedFlow::longestCell() const
{
    scalarField crossed(T_.size(), Zero);
    forAll(flux_, facei)
    {
        crossed[mesh_.owner()[facei]] += 0.5*mag(flux_[facei]);
        crossed[mesh_.neighbour()[facei]] += 0.5*mag(flux_[facei]);
    }
    forAll(flux_.boundaryField(), patchi)
    {
        const scalarField& m = flux_.boundaryField()[patchi];
        const labelUList& cells = mesh_.boundary()[patchi].faceCells();
        forAll(m, facei)
        {
            crossed[cells[facei]] += 0.5*mag(m[facei]);
        }
    }
    scalar longest = 0;
    forAll(crossed, celli)
    {
        longest = max
        (
            longest,
            mesh_.V()[celli]*mag(massFlux_[celli])/max(crossed[celli], VSMALL)
        );
    }
    return returnReduce(longest, maxOp<scalar>());
}


Foam::string Foam::granularFlows::bedFlow::rangeSentence() const
{
    OStringStream os;
    os.precision(3);
    const auto many = [&os](const bool warning)
    {
        os  << (os.str().empty() ? "" : " ") << (warning ? "Warning: " : "");
        return warning;
    };
    const auto outside = [&](const label cells, const string& what)
    {
        if (cells > 0 && many(true))
        {
            os  << "Flow: up to " << cells << " cells were out of the range of "
                << what.c_str() << ".";
        }
    };
    outside(met_.outsideDrag, "the drag " + string(drag_.name));
    outside(met_.outsideExchange, "the heat exchange " + string(exchangeLaw_.name));
    outside(met_.outsideGas, "the properties of " + string(gas_.name()));
    if (met_.mach > mostMach && many(true))
    {
        os  << "Flow: the gas reaches " << met_.mach
            << " of the speed of sound, allowed: " << mostMach << ".";
    }
    if (largestShare_ > mostShare && many(true))
    {
        os  << "Flow: the pressure drop reaches " << largestShare_
            << " of the pressure, whose change is left out in the heat, allowed: "
            << mostShare << ".";
    }
    if (met_.biot > mostBiot && many(true))
    {
        os  << "Flow: the Biot number h r/k_s of the grains reaches "
            << met_.biot << ", allowed: " << mostBiot
            << "; the temperature inside of the grains is not resolved.";
    }
    if (met_.knudsen > mostKnudsen && many(true))
    {
        os  << "Flow: the mean free path of the gas reaches " << met_.knudsen
            << " of the width of the pores, allowed: " << mostKnudsen
            << "; the drag is lower than computed.";
    }
    if (largestRayleigh_ > mostRayleigh && many(true))
    {
        os  << "Flow: without flow the bed is hot below, with a Rayleigh number"
            << " up to " << largestRayleigh_ << ", allowed: " << mostRayleigh
            << "; the gas would convect, which is left out.";
    }
    const scalar error = xi_ > 0 ? singleGas/std::sqrt(xi_) : 0;
    const scalar accuracy = keys.number(dict_, "accuracy");
    if (single_ && error > accuracy && many(true))
    {
        os  << "Flow: one temperature has an error of " << error
            << " % of a sudden change at the inlet, allowed by 'accuracy': "
            << accuracy << " %; 'temperatures two' has none.";
    }
    const scalar missing = hasLooseWalls() ? 0 : missingInCore(met_.widths);
    if (inflow_ > 0 && missing > mostMissing && many(true))
    {
        os  << "Flow: the bed is " << met_.widths
            << " grains wide and looser at its walls; the core gets about "
            << 100*missing << " % less gas than computed (Di Felice and"
            << " Gibilaro), allowed: " << 100*mostMissing << " %; 'flow pressure'"
            << " with 'channelling layer' computes it.";
    }
    const scalar width = frontWidth(), longest = longestCell();
    if (longest > width && many(true))
    {
        os  << "Flow: cells are up to " << longest
            << " m long, and a front is " << width
            << " m wide at the end; cells of this size would resolve it.";
    }
    if (unsettled_ && many(true))
    {
        os  << "Flow: " << unsettled_ << " of " << solutions_
            << " solutions did not converge in "
            << twoFieldMatrix::mostIterations << " iterations.";
    }
    return os.str();
}


// ************************************************************************* //
