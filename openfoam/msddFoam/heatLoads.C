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

#include "heatEquation.H"
#include "heatBeyond.H"
#include "cellSetOption.H"
#include "mixedFvPatchFields.H"
#include "IStringStream.H"
#include "OStringStream.H"
#include "resistingWall.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::dictionary Foam::heatEquation::entries(const fvPatchScalarField& wall)
{
    OStringStream os;
    os.precision(17);
    wall.write(os);
    IStringStream is(os.str());
    return dictionary(is);
}


bool Foam::heatEquation::wallsReadTensor() const
{
    bool any = false;
    for (const fvPatchScalarField& wall : T_.boundaryField())
    {
        if (!isA<mixedFvPatchScalarField>(wall))
        {
            continue;
        }
        any = true;
        const word kappa
        (
            entries(wall).lookupOrDefault<word>("kappa", "K")
        );
        if (kappa == "conductivity" || kappa == "Kxx" || kappa == "Kyy")
        {
            FatalErrorInFunction
                << "Entry 'kappa' of patch " << wall.patch().name() << " of T"
                << " is " << kappa << ", allowed: K, the conductivity in the"
                << " equation of the step; 'conductivity' belongs to the last"
                << " output" << exit(FatalError);
        }
    }
    return any;
}


void Foam::heatEquation::checkSources()
{
    for (const word& place : {mesh_.time().constant(), mesh_.time().system()})
    {
        IOobject file("fvOptions", place, mesh_, IOobject::MUST_READ);
        const fileName path
        (
            mesh_.time().globalPath()/place/mesh_.dbDir()/"fvOptions"
        );
        if (isFile(path) && !file.typeHeaderOk<IOdictionary>(true))
        {
            FatalErrorInFunction
                << "File " << path << " has no header FoamFile { version 2.0;"
                << " format ascii; class dictionary; object fvOptions; }:"
                << " OpenFOAM would leave its sources out" << exit(FatalError);
        }
    }
    PtrList<fv::option>& all = sources_;
    for (fv::option& source : all)
    {
        const bool fixes = source.type().find("Constraint") != string::npos;
        constrained_ = constrained_ || fixes;
        if (fixes && flow_->active())
        {
            FatalErrorInFunction
                << "Source " << source.name() << " of constant/fvOptions is of"
                << " type " << source.type() << ", allowed in a bed with a"
                << " flow: sources that fix no temperatures"
                << exit(FatalError);
        }
        if (source.applyToField(T_.name()) < 0)
        {
            FatalErrorInFunction
                << "Source " << source.name() << " of constant/fvOptions is none"
                << " of T, the only field that is solved for: allowed T, as in"
                << " injectionRateSuSp { T (1e6 0); }" << exit(FatalError);
        }
    }
}


Foam::tmp<Foam::fvScalarMatrix> Foam::heatEquation::addSources()
{
    if (sources_.optionList::empty())
    {
        return nullptr;
    }
    tmp<fvScalarMatrix> S(sources_(heatCapacity_, T_));
    TEqn_ -= S();
    if (constrained_)
    {
        free_.reset(new fvScalarMatrix(TEqn_));
    }
    sources_.constrain(TEqn_);
    return S;
}


Foam::tmp<Foam::scalarField> Foam::heatEquation::heatOf
(
    const fvScalarMatrix& S
) const
{
    tmp<scalarField> heat(-S.source());
    if (S.hasDiag())
    {
        heat.ref() += S.diag()*T_.primitiveField();
    }
    return heat;
}


Foam::tmp<Foam::scalarField> Foam::heatEquation::presentSources()
{
    tmp<scalarField> heat(heatOf(sources_(heatCapacity_, T_)()));
    const scalarField& V = mesh_.V();
    sourceDensity_ = 0;
    forAll(V, celli)
    {
        sourceDensity_ = max(sourceDensity_, mag(heat()[celli])/V[celli]);
    }
    return heat;
}


Foam::scalar Foam::heatEquation::heatOfConstraints() const
{
    if (!free_.valid())
    {
        return 0;
    }
    // What the equation without them lacks, in the cells whose row they have
    // changed: elsewhere that is the error of the linear solver
    const scalarField beyond(heatBeyond(free_()));
    const scalarField& before = free_().source();
    const scalarField& now = TEqn_.source();
    scalar heat = 0;
    forAll(beyond, celli)
    {
        heat += now[celli] != before[celli] ? beyond[celli] : 0;
    }
    return heat;
}


bool Foam::heatEquation::finishSources(const tmp<fvScalarMatrix>& S)
{
    sourceHeat_ = 0;
    if (!S.valid())
    {
        return true;
    }
    // The heat that the solution has got, and the one at its temperature
    const scalarField got(heatOf(S()));
    const scalarField due(presentSources());
    sourceHeat_ = sum(got) + heatOfConstraints();
    return gMax(mag(got - due)) <= settled*gMax(mag(due));
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::heatEquation::addLoads(loadHistories& loads)
{
    flow_->addLoads(loads);
    const PtrList<fv::option>& all = sources_;
    for (const fv::option& source : all)
    {
        const auto* cells = isA<fv::cellSetOption>(source);
        if (!cells || cells->timeStart() < 0)
        {
            continue;
        }
        const scalar begin = cells->timeStart();
        const scalar end = begin + cells->duration();
        loads.add
        (
            [begin, end](const scalar time)
            {
                return vector(begin <= time && time <= end, 0, 0);
            },
            // Beside each, so that the range of the function is seen
            scalarList({begin - VSMALL - mag(begin)*SMALL, begin, end})
        );
    }
    for (const fvPatchScalarField& wall : T_.boundaryField())
    {
        const auto* resisting = dynamic_cast<const resistingWall*>(&wall);
        if (resisting)
        {
            resisting->addLoads(loads);
            continue;
        }
        const dictionary dict(entries(wall));
        for (const word key : {"uniformValue", "uniformGradient", "Ta", "Q"})
        {
            if (dict.found(key))
            {
                given_.append(Function1<scalar>::New(key, dict));
                loads.add(given_.last());
            }
        }
    }
}


// ************************************************************************* //
