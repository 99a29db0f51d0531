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

#include "grainFields.H"
#include "caseChecks.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "stringListOps.H"
#include "OStringStream.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::grainFields::findReaders()
{
    // Fields that are computed only on output. A function object that lists
    // its fields, and lists none of these, needs no update in every step; the
    // function objects of this project call refresh() themselves
    const wordHashSet following
    ({
        "conductivity", "stress", "pressure", "particleDensity", "inTrainingRange",
        "spread", "thermalStrain", "D", "nodeDisplacement", "nodeVelocity",
        "nodeVelocityBefore", "wallTraction", "shellTraction",
        "pistonTraction", "shellMotion", "wallGive", "areaRatio"
    });
    const dictionary functions =
        mesh_.time().controlDict().subOrEmptyDict("functions");

    for (const entry& item : functions)
    {
        if (!item.isDict())
        {
            continue;
        }
        const dictionary& dict = item.dict();
        // Names may stand among other words, as in the blocks of fieldAverage,
        // and text in quotation marks may be an expression that matches any
        label names = 0;
        bool sees = false;
        const auto look = [&](const ITstream& list)
        {
            for (const token& part : list)
            {
                const bool named = part.isWord();
                names += named;
                sees =
                    sees || part.isString() || part.isCompound()
                 || (named && following.found(part.wordToken()));
            }
        };
        if (dict.found("fields"))
        {
            look(dict.lookup("fields"));
        }
        if (dict.found("field"))
        {
            look(dict.lookup("field"));
        }
        sees = sees || !names;
        const word type(dict.lookupOrDefault<word>("type", word::null));
        const wordList ours
        ({
            "wallPressure", "subRegions", "heatAudit", "massAudit",
            "spaceProbes", "regionHeat"
        });
        refreshAlways_ = refreshAlways_ || (sees && !ours.found(type));
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::scalarField> Foam::grainFields::presentPressure() const
{
    const bool spatial = model_->isThreeDimensional();
    tmp<scalarField> result(new scalarField(mesh_.nCells()));
    scalarField& p = result.ref();
    forAll(p, celli)
    {
        if (otherStress_.size())
        {
            const symmTensor& sigma = otherStress_[celli];
            p[celli] = spatial ? -tr(sigma)/3 : -0.5*(sigma.xx() + sigma.yy());
        }
        else
        {
            const symmTensor& sigma = sigma_[celli];
            p[celli] = spatial ? tr(sigma)/3 : 0.5*(sigma.xx() + sigma.yy());
        }
    }
    return result;
}


void Foam::grainFields::see(const volScalarField& T, const scalar source)
{
    runCourse& course = record_.course;
    const auto see = [&](const runCourse::quantity q, const scalarField& values)
    {
        if (values.size())
        {
            course.see(q, min(values), max(values));
        }
    };
    const scalarField p(presentPressure());
    const scalar mean =
        returnReduce(sum(p*mesh_.V()), sumOp<scalar>())
       /returnReduce(sum(mesh_.V().field()), sumOp<scalar>());
    course.see(runCourse::pressure, mean, p.size() ? max(p) : mean);
    course.load(T.time().value(), mean);
    see
    (
        runCourse::thermalStrain,
        properties_.thermalExpansion().value()
       *(T.primitiveField() - initialTemperature_.primitiveField())
    );
    see(runCourse::temperature, T.primitiveField());
    for (const fvPatchScalarField& patch : T.boundaryField())
    {
        if (!patch.coupled())
        {
            see(runCourse::temperature, patch);
        }
    }
    course.see(runCourse::source, 0, source);
    const runCourse::range& now = course.own(runCourse::temperature);
    if (model_->isThreeDimensional() && !now.empty())
    {
        for (const scalar value : {now.least, now.most})
        {
            const scalar ratio = model_->conductivityRatio(value);
            if (ratio > 0)
            {
                course.see(runCourse::ratio, ratio, ratio);
            }
        }
    }
    course.mark(T.time().value());
}


void Foam::grainFields::refresh()
{
    if (followers_)
    {
        followers_();
    }
    symmTensorField& sigma = stress_.primitiveFieldRef();
    forAll(sigma, celli)
    {
        // Compression positive becomes tension positive; not -0
        const symmTensor& s = sigma_[celli];
        sigma[celli] =
            otherStress_.size()
          ? otherStress_[celli]
          : symmTensor
            (
               -s.xx(), 0 - s.xy(), 0 - s.xz(), -s.yy(), 0 - s.yz(), 0 - s.zz()
            );
    }
    pressure_.primitiveFieldRef() = presentPressure();
    // The mass of a cell is constant: if its area grows, the bulk density falls
    particleDensity_.primitiveFieldRef() =
        bulkDensity_.primitiveField()/(1 - porosity().primitiveField());
    if (areaRatio_.size())
    {
        particleDensity_.primitiveFieldRef() /= areaRatio_;
    }

    forAll(state_, i)
    {
        state_[i].correctBoundaryConditions();
    }
    thermalStrain_.correctBoundaryConditions();
    thermalStrainIncrement_.correctBoundaryConditions();
    conductivity_.correctBoundaryConditions();
    stress_.correctBoundaryConditions();
    pressure_.correctBoundaryConditions();
    particleDensity_.correctBoundaryConditions();
    inTrainingRange_.correctBoundaryConditions();
}


void Foam::grainFields::findSpread()
{
    List<const scalar*> state(state_.size());
    forAll(state, i)
    {
        state[i] = state_[i].primitiveField().cdata();
    }
    granularModel::query query;
    query.size = mesh_.nCells();
    query.state = state.cdata();
    const scalarField none(mesh_.nCells(), Zero);
    query.strain = none.cdata();

    scalarField spread(mesh_.nCells(), Zero);
    if (!returnReduce(model_->spread(query, spread), andOp<bool>()))
    {
        return;
    }
    if (!spread_.valid())
    {
        spread_.reset
        (
            new volScalarField
            (
                io("spread"),
                mesh_,
                dimensionedScalar(dimless, Zero),
                extrapolatedCalculatedFvPatchScalarField::typeName
            )
        );
    }
    spread_().primitiveFieldRef() = spread;
    spread_().correctBoundaryConditions();
}


Foam::label Foam::grainFields::cellsOutside() const
{
    label outside = 0;
    for (const scalar inside : inTrainingRange_.primitiveField())
    {
        outside += inside < 0.5;
    }
    return returnReduce(outside, sumOp<label>());
}


Foam::scalarField Foam::grainFields::mass() const
{
    return bulkDensity_.primitiveField()*mesh_.V().field();
}


Foam::scalar Foam::grainFields::storedHeat(const volScalarField& T) const
{
    return properties_.storedHeat(mass(), T, initialTemperature_);
}


Foam::scalar Foam::grainFields::initialHeat() const
{
    return properties_.heldHeat(mass(), initialTemperature_);
}


Foam::scalar Foam::grainFields::meanSpread()
{
    findSpread();
    return spread_.valid()
      ? spread_().weightedAverage(mesh_.V()).value()
      : -1;
}


// ************************************************************************* //
