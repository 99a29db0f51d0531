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

#include "caseWarnings.H"
#include "briefNumber.H"
#include "pascals.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Largest thermal strain that the shipped networks were trained with
static const scalar trainedStrain = 0.05;

//- Strains below which the state is not followed, and steps in which it is
static const scalar leastStrain = 1e-4;
static const label stepsOfWalk = 50;

//- Usual mean pressure at the start over that of packings of equal porosity:
//- packings that were prepared with another friction differ by less
static const scalar leastPressure = 0.6;
static const scalar mostPressure = 1.6;

//- Share of its own weight below which a bed has hardly a stress at the start:
//- friction of walls carries a part of it, but hardly more
static const scalar leastWeight = 0.01;


//- A cell of the mean state of a bed of discs
class meanCell
{
    granularModel& model_;
    List<scalarField> state_, outside_;


public:

    meanCell(granularModel& model, const fvMesh& mesh)
    :
        model_(model),
        state_(model.stateNames().size(), scalarField(1)),
        outside_(state_.size() + 1, scalarField(1))
    {
        const scalarField& V = mesh.V();
        forAll(state_, i)
        {
            state_[i] =
                gSum
                (
                    V
                   *mesh.lookupObject<volScalarField>
                    (
                        model.stateNames()[i]
                    ).primitiveField()
                )/gSum(V);
        }
    }

    static List<scalar*> pointers(List<scalarField>& columns)
    {
        List<scalar*> all(columns.size());
        forAll(all, i)
        {
            all[i] = columns[i].data();
        }
        return all;
    }

    //- Let the state be that of packings with this porosity and fabric
    void begin()
    {
        granularModel::known known;
        const scalarField porosity(state_[0]), fabric(state_[1]);
        known.size = 1;
        known.porosity = porosity.cdata();
        known.fabricIndex = fabric.cdata();
        model_.initialState(known, pointers(state_).cdata());
    }

    //- Strain it; returns the mean pressure in the plane
    scalar strain(const scalar increment, const scalar total)
    {
        const scalarField strains(1, increment), totals(1, total);
        symmTensor K(Zero), stress(Zero);
        granularModel::query query;
        query.size = 1;
        query.trial = true;
        const List<scalar*> state(pointers(state_)), out(pointers(outside_));
        query.state = state.cdata();
        query.nextState = state.cdata();
        query.strain = strains.cdata();
        query.totalStrain = totals.cdata();
        query.conductivity = &K;
        query.stress = &stress;
        query.outside = out.cdata();
        model_.advance(query);
        return 0.5*(stress.xx() + stress.yy());
    }

    scalar porosity() const { return state_[0][0]; }

    //- Column that was outside of the range before the last strain, but for the
    //- fabric index, whose range is narrow: it leaves it when grains lose
    //- contact, which the model describes; -1: none
    label left() const
    {
        for (label i = 0; i < state_.size(); ++i)
        {
            if (i != 1 && outside_[i][0] != 0)
            {
                return i;
            }
        }
        return -1;
    }

    bool above(const label i) const { return outside_[i][0] > 0; }
};

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::caseWarnings::checkKnown()
{
    const label cells = returnReduce(mesh_.nCells(), sumOp<label>());
    label outside = 0;
    const volScalarField& inside =
        mesh_.lookupObject<volScalarField>("inTrainingRange");
    for (const scalar one : inside.primitiveField())
    {
        outside += one < 0.5;
    }
    reduce(outside, sumOp<label>());
    if (!outside || !grains_.model().isThreeDimensional())
    {
        return;
    }
    const scalarField& porosity = grains_.porosity().primitiveField();
    const scalarField& p = grains_.pressure().primitiveField();
    string by;
    for (const auto& item : grains_.modelCounts())
    {
        const std::string::size_type at = item.first.find("_by_");
        if (item.second && at != std::string::npos)
        {
            by += (by.empty() ? "" : ", ") + item.first.substr(at + 4);
        }
    }
    string text
    (
        Foam::name(outside) + " of " + Foam::name(cells) + " cells are outside"
        " of the packings that the law of spheres was trained with, by "
      + (by.empty() ? string("their state") : by) + ": porosity "
      + brief(gMin(porosity)) + " to " + brief(gMax(porosity)) + ", pressure "
      + pascals(gMin(p)) + " to " + pascals(gMax(p)) + ". The solver answers as"
        " well as it can there, and marks them by inTrainingRange = 0"
    );
    scalar least, most;
    if
    (
        by.find("gas") != string::npos
     && grains_.model().knownGas(gAverage(T_.primitiveField()), least, most)
    )
    {
        text +=
            least > most
          ? string(". No pressure of the gas is in the range for these spheres")
          : string
            (
                ". Between these spheres gasPressure is known from about "
              + brief(least) + " to " + brief(most) + " Pa"
            );
        text += ". Is meanRadius in metres?";
    }
    add(text);
}


void Foam::caseWarnings::checkPressure()
{
    IOobject stress
    (
        "stress", mesh_.time().timeName(), mesh_, IOobject::MUST_READ
    );
    if
    (
        grains_.model().type() != "network" || grains_.record().continues
     || !returnReduce
        (
            stress.typeHeaderOk<volSymmTensorField>(true), andOp<bool>()
        )
    )
    {
        return;
    }
    meanCell cell(grains_.model(), mesh_);
    cell.begin();
    const scalar usual = cell.strain(0, 0);
    const scalar p = grains_.pressure().weightedAverage(mesh_.V()).value();
    if (p < leastPressure*usual || p > mostPressure*usual)
    {
        add
        (
            "Field stress has a mean pressure of " + pascals(p) + ", usual: "
          + pascals(leastPressure*usual) + " to " + pascals(mostPressure*usual)
          + ". Packings of a porosity of " + brief(cell.porosity()) + " have"
            " about " + pascals(usual) + " with these grains: pressure is in"
            " proportion to youngModulus times meanRadius. Take fields that"
            " belong to the grains ('msdd case new' packs them), or leave the"
            " file stress away for the mean of the model"
        );
    }
}


void Foam::caseWarnings::checkStrains()
{
    if (grains_.model().type() != "network" || grains_.record().continues)
    {
        return;
    }
    const scalarField& V = mesh_.V();
    const scalar start =
        gSum
        (
            V
           *mesh_.lookupObject<volScalarField>
            (
                "initialTemperature"
            ).primitiveField()
        )/gSum(V);
    // A steady source warms the bed by q L^2/(2 K) at a distance L from walls
    const scalar q = grains_.record().course.values(runCourse::source).most;
    const scalar rise = q*sqr(way_)/(2*conductivity_);
    const scalar alpha = properties_.thermalExpansion().value();
    for (const scalar T : {temperatures_.least, temperatures_.most + rise})
    {
        const scalar strain = alpha*(T - start);
        if (mag(strain) > (1 + 1e-4)*trainedStrain)
        {
            add
            (
                "The thermal strain to " + brief(T) + " K is "
              + brief(alpha) + " times " + brief(T - start) + " K = "
              + brief(strain) + ", beyond the " + brief(-trainedStrain) + " to "
              + brief(trainedStrain) + " that the model was trained with. The"
                " solver adds it up in small steps, but the accuracy of the"
                " result was not measured"
              + (
                    rise > 0
                  ? " (estimated from the steady state with the heat source and"
                    " the conductivity of the start; grains that expand conduct"
                    " better, so the bed gets less hot)"
                  : ""
                )
            );
        }
        else if (mag(strain) > leastStrain)
        {
            walk(strain, T);
        }
    }
}


void Foam::caseWarnings::walk(const scalar strain, const scalar T)
{
    meanCell cell(grains_.model(), mesh_);
    for (label step = 0; step < stepsOfWalk; ++step)
    {
        const scalar from = strain*step/stepsOfWalk;
        const scalar to = strain*(step + 1)/stepsOfWalk;
        cell.strain((1 + to)/(1 + from) - 1, to);
        const label i = cell.left();
        if (step > 0 && i >= 0)
        {
            add
            (
                "Where grains that cannot move get to " + brief(T) + " K, a"
                " thermal strain of " + brief(strain) + ", "
              + grains_.model().stateNames()[i] + " gets "
              + (cell.above(i) ? "above" : "below") + " the range that the model"
                " was trained with, from a strain of " + brief(to) + " on. The"
                " run may end then. With 'mechanics equilibrium' the state"
                " changes less, as long as the bed around yields"
            );
            return;
        }
    }
}


void Foam::caseWarnings::checkWeight()
{
    const vector& g = properties_.gravity();
    const word law
    (
        properties_.subOrEmptyDict("equilibriumCoeffs")
       .getOrDefault<word>("law", "grains")
    );
    if
    (
        mag(g) <= VSMALL || mechanics_.type() == "none" || law == "elastic"
     || grains_.record().continues
    )
    {
        return;
    }
    const scalarField& V = mesh_.V();
    const vector span(mesh_.bounds().span());
    const scalar weight =
        gSum(V*grains_.bulkDensity().primitiveField())/gSum(V)
       *(cmptMag(g) & span);
    scalar most = 0;
    for (const symmTensor& s : grains_.stress().primitiveField())
    {
        most = max(most, max(mag(s.xx()), max(mag(s.yy()), mag(s.zz()))));
    }
    reduce(most, maxOp<scalar>());
    if (most < leastWeight*weight)
    {
        add
        (
            "The stress at the start is at most " + pascals(most) + ", and the"
            " weight of the bed at its lowest point " + pascals(weight)
          + ". Grains that hardly touch have to be pressed together first, in"
            " thousands of short steps. Is the stress in Pa, not in kPa?"
            " restStress in constant/granularProperties finds it from the"
            " weight and the friction of the walls"
        );
    }
}


// ************************************************************************* //
