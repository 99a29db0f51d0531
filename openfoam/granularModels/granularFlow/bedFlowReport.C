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
#include "OSspecific.H"
#include "functionObject.H"

#include <cmath>

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- A difference of the balances, over the heat that passed, that is neither
//- rounding nor the tolerance of the linear solver
static const scalar mostDifference = 1e-6;

//- Largest change of a front erf(x) by a relative change of its width
static const scalar frontSlope = 0.242;

static const keyTable flowColumns
(
    "flow.dat",
    {
        {
            "massFlow",
            "mass flow that enters the bed; with `flow through` negative from"
            " outlet to inlet", "kg/s"
        },
        {"inletTemperature", "mixed temperature of the gas that enters", "K"},
        {"outletTemperature", "mixed temperature of the gas that leaves", "K"},
        {"pressureDrop", "pressure drop over the bed", "Pa"},
        {"heat", "heat that the gas gives to grains and vessel", "W"}
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::granularFlows::bedFlow::pressureDrop
(
    const scalar factor
) const
{
    scalar sum = 0;
    forAll(gasT_, celli)
    {
        sum +=
            mesh_.V()[celli]*dragOf(celli)*mag(massFlux_[celli])
           /gas_.density(gasT_[celli], pressureIn(celli));
    }
    reduce(sum, sumOp<scalar>());
    return inflow_ > 0 ? factor*sum/inflow_ : 0;
}


Foam::scalar Foam::granularFlows::bedFlow::dragOf(const label celli) const
{
    bedCorrelations::state s(state(celli));
    s.porosity += looserBy(celli);
    return
        dragFactor_*drag_.value(s)*gas_.viscosity(gasT_[celli])*mag(massFlux_[celli])
       *sqr((1 - s.porosity)/diameter(celli))/pow3(s.porosity);
}


void Foam::granularFlows::bedFlow::writeLine()
{
    if (!Pstream::master())
    {
        return;
    }
    if (!table_.valid())
    {
        const fileName folder
        (
            mesh_.time().globalPath()/functionObject::outputPrefix
           /mesh_.dbDir()/"flow"
           /mesh_.time().timeName(mesh_.time().startTime().value())
        );
        mkDir(folder);
        table_.reset(new OFstream(folder/"flow.dat"));
        table_->precision(10);
        flowColumns.explain(table_());
        table_() << "# Time";
        for (const keyTable::entry& column : flowColumns.entries())
        {
            table_() << tab << column.name;
        }
        table_() << nl;
    }
    OStringStream row;
    row.precision(10);
    row << mesh_.time().value() << tab << massFlow() << tab << last_.inletT
        << tab << last_.outletT << tab
        << drop_ << tab << last_.heat[toBed] + last_.heat[gasToWall];
    std::string text(row.str());
    std::ostream& file = table_().stdStream();
    if (again_)
    {
        file.seekp(row_);
        text.resize(max(label(text.size()), rowLength_), ' ');
    }
    row_ = file.tellp();
    rowLength_ = text.size();
    file<< text << std::endl;
}


Foam::scalar Foam::granularFlows::bedFlow::difference() const
{
    const scalarList& all = grains_.record().flow;
    const scalar gas =
        all[entered] - all[left] - all[toBed] - all[held] - all[gasToWall];
    const scalar wall =
        all[gasToWall] + all[bedToWall] - all[lost] - all[heldByWall];
    // Where nothing is exchanged the difference is rounding of what flows
    return
        (mag(gas) + mag(wall))
       /max(all[passed], max(runRecord::roundedHeat*mag(all[entered]), VSMALL));
}


Foam::string Foam::granularFlows::bedFlow::exchangeSentence() const
{
    if (inflow_ == 0 || constantExchange_)
    {
        return string();
    }
    // Share of the exchange in what spreads a front
    scalar share = 0;
    const scalarField& V = mesh_.V();
    const symmTensorField& K = grains_.conductivity().primitiveField();
    forAll(V, celli)
    {
        const scalar carried = Gc(celli);
        const scalar spread = sqr(carried)/exchange(celli);
        const vector e(massFlux_[celli]/max(mag(massFlux_[celli]), VSMALL));
        const scalar others =
            along_*carried*diameter(celli) + (e & (K[celli] & e));
        share += V[celli]*spread/max(spread + others, VSMALL);
    }
    share =
        returnReduce(share, sumOp<scalar>())
       /returnReduce(sum(V), sumOp<scalar>());
    const scalar e = bedCorrelations::exchangeError;
    const scalar width = std::sqrt(share/(1 - e) + 1 - share) - 1;
    OStringStream os;
    os.precision(3);
    os  << "Flow: the heat exchange (" << exchangeLaw_.name
        << ") has an error of " << 100*e
        << " %, which changes the temperature at the outlet by at most "
        << frontSlope*width*(met_.hottest - met_.coldest) << " K.";
    return os.str();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::List<Foam::string> Foam::granularFlows::bedFlow::sentences() const
{
    const scalarList& all = grains_.record().flow;
    OStringStream flow, heat;
    flow.precision(4);
    flow<< "Flow: " << gas_.name() << ", Re " << min(met_.leastRe, met_.mostRe)
        << " to " << met_.mostRe;
    if (inflow_ > 0)
    {
        const scalar e = bedCorrelations::dragError;
        flow<< "; at the end the gas leaves with " << last_.outletT
            << " K, and the pressure drop is " << drop_ << " Pa, "
            << pressureDrop(1 - e) << " to " << pressureDrop(1 + e)
            << " Pa with the error of the drag (" << drag_.name << ", "
            << 100*e << " %)";
    }
    if (met_.lift > 0)
    {
        flow<< "; it carries up to " << 100*met_.lift
            << " % of the weight of the grains";
    }
    flow<< ". " << temperatures().c_str();
    heat.precision(4);
    heat<< (difference() > mostDifference ? "Warning: " : "")
        << "Heat of the flow: the gas lost " << all[entered] - all[left]
        << " J; " << all[toBed] << " J went to the grains, " << all[held]
        << " J stayed in the pores, " << all[gasToWall]
        << " J went to the vessel";
    if (!walls_->empty())
    {
        scalar least, most;
        walls_->extremes(least, most);
        heat<< ", which got " << all[bedToWall] << " J from the grains, passed "
            << all[lost] << " J on to what lies beyond and holds "
            << all[heldByWall] << " J more, at " << least << " to " << most << " K";
    }
    heat<< ". The difference is " << difference() << " of the heat that passed. "
        << scalar(solutions_)/max(stages_, label(1)) << " solutions a stage, "
        << scalar(iterations_)/max(solutions_, label(1))
        << " iterations a solution.";
    return List<string>
    ({
        flow.str(), sentenceOfKind(), exchangeSentence(), rangeSentence(),
        heat.str()
    });
}


Foam::string Foam::granularFlows::bedFlow::summary() const
{
    const scalarList& all = grains_.record().flow;
    const scalar e = bedCorrelations::dragError;
    OStringStream os;
    os.precision(10);
    os  << "{\"gas\": " << string(gas_.name())
        << ", \"temperatures\": " << (single_ ? 1 : 2)
        << ", \"transfer_units\": " << xi_
        << ", \"mass_flow\": " << massFlow()
        << ", \"outlet_temperature\": " << last_.outletT
        << ", \"pressure_drop\": " << drop_
        << ", \"pressure_drop_low\": " << pressureDrop(1 - e)
        << ", \"pressure_drop_high\": " << pressureDrop(1 + e)
        << ", \"largest_pressure_drop\": " << largestDrop_
        << ", \"entered\": " << all[entered] << ", \"left\": " << all[left]
        << ", \"to_grains\": " << all[toBed] << ", \"in_pores\": " << all[held]
        << ", \"vessel\": {\"from_gas\": " << all[gasToWall]
        << ", \"from_grains\": " << all[bedToWall] << ", \"lost\": "
        << all[lost] << ", \"stored\": " << all[heldByWall]
        << "}, \"relative_difference\": " << difference()
        << ", \"cells_outside_drag\": " << met_.outsideDrag
        << ", \"cells_outside_exchange\": " << met_.outsideExchange
        << ", \"cells_outside_gas\": " << met_.outsideGas
        << ", \"bed_width_in_grains\": " << min(met_.widths, 1e9)
        << ", \"mach\": " << met_.mach << ", \"biot\": " << met_.biot
        << ", \"knudsen\": " << met_.knudsen
        << ", \"pressure_gradient_over_weight\": " << met_.lift
        << ", \"rayleigh_at_rest\": " << largestRayleigh_
        << ", \"solutions_per_stage\": "
        << scalar(solutions_)/max(stages_, label(1))
        << ", \"iterations_per_solution\": "
        << scalar(iterations_)/max(solutions_, label(1))
        << summaryOfKind().c_str() << "}";
    return os.str();
}


// ************************************************************************* //
