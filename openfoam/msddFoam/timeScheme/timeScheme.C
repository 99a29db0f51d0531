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

#include "timeScheme.H"
#include "mappedPatchBase.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    //- Steps between lines of least, mean and largest values
    static const label reportInterval = 20;

    defineTypeNameAndDebug(timeScheme, 0);
    defineRunTimeSelectionTable(timeScheme, dictionary);
}

const Foam::keyTable Foam::timeScheme::keys
(
    "msddFoam",
    {
        {
            "accuracy",
            "wanted accuracy of T in percent of its range. Above 0 `msddFoam`"
            " does not run this case: `msdd case solve` finds the cheapest"
            " mesh, steps and motion of the grains and runs them in a folder"
            " next to the case; see [Mesh, steps and motion](../theory/choice.md)."
            " Other keys then have no effect. On one process only", "%",
            "0 to 100", "0"
        },
        {
            "pressureAccuracy",
            "with `accuracy`: wanted accuracy of p in percent of its range; 0:"
            " any", "%", "0 to 100", "0"
        },
        {
            "grains",
            "with `accuracy`: number of grains of the whole bed, where the mesh"
            " is a part of it", "-", "1 to 1e15", "as many as the mesh holds"
        },
        {
            "timeScheme",
            "`paper`: heat and grains in turn, with fixed steps, of first"
            " order. `secondOrder`: two stages, of second order, with adaptive"
            " steps if `adjustTimeStep` is on. With `mechanics equilibrium`"
            " displacements are of first order with both", "-",
            "paper, secondOrder", "paper"
        },
        {
            "nNonOrthogonalCorrectors",
            "repetitions of the heat equation in a step, for faces that are not"
            " normal to the line between their cells and for the xy component"
            " of K (which the default model has with `mechanics equilibrium`)",
            "-", "0 to 100", "0"
        },
        {
            "temperatureTolerance", "error of T in an adaptive step", "K",
            "1e-12 to 1e6", "a thousandth of the range of T so far"
        },
        {
            "stateTolerance",
            "error of the model's state in an adaptive step, in percent of the"
            " largest value of each state, at least 0.02. Models with a"
            " mechanical tangent have no such error", "%", "1e-9 to 100", "1"
        },
        {
            "stopWhenSteady",
            "the run ends, and writes, one step after it is steady: at the rates"
            " of the step, in a time as long as the run so far, T changes by less"
            " than this share of its range in the run, and p by less than this"
            " share of its largest value. Walls, sources and loads that change"
            " later keep it going. 0: the run goes on to `endTime`", "-",
            "0 to 1", "0"
        },
        {
            "logInterval",
            "steps between two lines of the log; written times always have one",
            "-", "1 to 1e9", "1"
        },
        {
            "waitLimit",
            "with several processes: time in one step after which a process"
            " reports on the standard error what it waits for. 0: never", "s",
            "0 to 1e9", "300"
        }
    }
);


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeScheme::timeScheme
(
    const dictionary& dict,
    volScalarField& T,
    granularState& grains,
    granularMechanics& mechanics,
    neighbourSolids& neighbours,
    const granularProperties& properties
)
:
    dict_(dict),
    time_(const_cast<Time&>(T.time())),
    T_(T),
    grains_(grains),
    mechanics_(mechanics),
    neighbours_(neighbours),
    heat_
    (
        T,
        properties,
        grains,
        neighbours,
        label(keys.number(dict, "nNonOrthogonalCorrectors"))
    ),
    Told_(T.primitiveField()),
    pressure_(grains.presentPressure()),
    steadyShare_(keys.number(dict, "stopWhenSteady")),
    ends_(false),
    logInterval_(label(keys.number(dict, "logInterval"))),
    waitLimit_(keys.number(dict, "waitLimit"))
{
    grains_.see(T_, heat_.sourceDensity());
    grains_.record().course.begin(time_.value(), received());
}


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::word Foam::timeScheme::typeOf(const fvMesh& mesh)
{
    const dictionary& solution = mesh.solutionDict();
    const dictionary& dict = solution.optionalSubDict("msddFoam");
    if (&dict == &solution)
    {
        return "paper";
    }
    keys.check(dict);
    const word type(dict.lookupOrDefault<word>("timeScheme", "paper"));
    if (!dictionaryConstructorTablePtr_->found(type))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'timeScheme' is '" << type << "', allowed: "
            << granularProperties::listed
               (
                   dictionaryConstructorTablePtr_->sortedToc()
               ).c_str()
            << exit(FatalIOError);
    }
    return type;
}


Foam::autoPtr<Foam::timeScheme> Foam::timeScheme::New
(
    volScalarField& T,
    granularState& grains,
    granularMechanics& mechanics,
    neighbourSolids& neighbours,
    const granularProperties& properties
)
{
    const word type(typeOf(T.mesh()));
    Info<< "Selecting timeScheme " << type << endl;
    runRecord& record = grains.record();
    if (!record.scheme.empty() && record.scheme != type)
    {
        Info<< "The time from which this run continues was computed with"
            << " timeScheme " << record.scheme << nl;
    }
    record.scheme = type;
    return
        (*dictionaryConstructorTablePtr_->cfind(type))
        (
            T.mesh().solutionDict().optionalSubDict("msddFoam"),
            T, grains, mechanics, neighbours, properties
        );
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

void Foam::timeScheme::advanceTime()
{
    grains_.record().lastDeltaT = time_.deltaTValue();
    ++time_;
    if (time_.timeIndex() % logInterval_ == 0 || time_.writeTime())
    {
        Info<< "Time = " << time_.timeName() << nl;
    }
}


void Foam::timeScheme::setLog() const
{
    solverPerformance::debug = time_.timeIndex() % logInterval_ == 0;
}


void Foam::timeScheme::book
(
    const scalar interval,
    const scalarList& patchHeat,
    const List<scalarField>& faceHeat,
    const scalar sourceHeat
)
{
    runRecord& record = grains_.record();
    forAll(patchHeat, patchi)
    {
        record.heat[patchi] += interval*patchHeat[patchi];
        record.exchanged += interval*mag(patchHeat[patchi]);
    }
    record.sourceHeat += interval*sourceHeat;
    record.exchanged += interval*mag(sourceHeat);

    auto* flux = T_.mesh().getObjectPtr<volScalarField>(runRecord::wallFlux);
    if (!flux)
    {
        return;
    }
    forAll(faceHeat, patchi)
    {
        if (faceHeat[patchi].size())
        {
            flux->boundaryFieldRef()[patchi] ==
                faceHeat[patchi]/T_.mesh().boundary()[patchi].magSf();
        }
    }
}


void Foam::timeScheme::account(const scalar interval)
{
    book(interval, heat_.patchHeat(), heat_.faceHeat(), heat_.sourceHeat());
    neighbours_.finish
    (
        interval*neighbours_.heat(), interval*ofNeighbours()
    );
    heat_.flow().finish(interval, 1);
}


void Foam::timeScheme::observe(const scalar deltaT)
{
    grains_.see(T_, heat_.sourceDensity());
    const scalarField before(pressure_);
    pressure_ = grains_.presentPressure();
    scalar change = 0, pressureChange = 0;
    forAll(Told_, celli)
    {
        change = max(change, mag(T_[celli] - Told_[celli]));
        pressureChange =
            max(pressureChange, mag(pressure_[celli] - before[celli]));
    }
    grains_.record().course.step
    (
        deltaT, time_.endTime().value(), change, pressureChange, received()
    );
    stopWhenSteady();
    if (time_.timeIndex() % max(reportInterval, logInterval_) == 0)
    {
        report();
    }
}


void Foam::timeScheme::stopWhenSteady()
{
    if (steadyShare_ <= 0 || ends_)
    {
        return;
    }
    const scalar now = time_.value();
    const runCourse::drift drift
    (
        grains_.record().course.drifts(now - grains_.record().startTime)
    );
    if (!drift.within(steadyShare_))
    {
        return;
    }
    if (!given_.valid())
    {
        given_.reset
        (
            new loadHistories
            (
                grains_.record().startTime, time_.endTime().value()
            )
        );
        mechanics_.addLoads(given_());
        heat_.addLoads(given_());
    }
    if (given_->changesAfter(now))
    {
        return;
    }
    ends_ = true;
    time_.stopAt(Time::saWriteNow);
    OStringStream text;
    text.precision(3);
    text<< "The bed was steady at " << time_.timeName() << " s (stopWhenSteady "
        << steadyShare_ << "): in as long a time as the run so far T would"
        << " change by " << drift.T << " of its range, and p by " << drift.p
        << " of its largest value. The run ended with the next step";
    runRecord::note(text.str());
}


Foam::scalar Foam::timeScheme::received() const
{
    const runRecord& record = grains_.record();
    return sum(record.heat) + record.sourceHeat;
}


void Foam::timeScheme::report() const
{
    const scalarField& V = T_.mesh().V();
    const scalar volume = returnReduce(sum(V), sumOp<scalar>());
    const auto line = [&]
    (
        const char* name,
        const scalarField& values,
        const char* unit
    )
    {
        const scalar mean =
            returnReduce(sum(V*values), sumOp<scalar>())/volume;
        Info<< "    " << name << ": least " << gMin(values) << ", mean " << mean
            << ", largest " << gMax(values) << unit << nl;
    };
    const symmTensorField& K = grains_.conductivity().primitiveField();
    line("T", T_.primitiveField(), " K");
    line("p", grains_.presentPressure()(), " Pa");
    line
    (
        "K, mean of the axes",
        grains_.model().isThreeDimensional()
      ? scalarField(tr(K)/3)
      : scalarField
        (
            0.5*(K.component(symmTensor::XX) + K.component(symmTensor::YY))
        ),
        " W/(m K)"
    );
}


Foam::scalar Foam::timeScheme::ofNeighbours()
{
    const scalarList& heat = heat_.patchHeat();
    scalar sum = -heat_.flow().toSolids();
    forAll(heat, patchi)
    {
        const polyPatch& patch = T_.mesh().boundaryMesh()[patchi];
        sum += isA<mappedPatchBase>(patch) ? heat[patchi] : 0;
    }
    return sum;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::timeScheme::tryHeat()
{
    neighbours_.begin();
    heat_.flow().begin();
    // One iteration shows whether the linear solver can be made
    const_cast<dictionary&>(T_.mesh().solverDict(T_.name())).set("maxIter", 1);
    heat_.solve
    (
        heat_.equivalent(T_.primitiveField())(),
        time_.deltaTValue(),
        mechanics_.pulledBack(grains_.conductivity().primitiveField())
    );
}


// ************************************************************************* //
