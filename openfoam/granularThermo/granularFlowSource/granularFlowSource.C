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

#include "granularFlowSource.H"
#include "contactWall.H"
#include "wholeFile.H"
#include "OStringStream.H"
#include "functionObject.H"
#include "heatBeyond.H"
#include "OSspecific.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace fv
{
    defineTypeNameAndDebug(granularFlowSource, 0);
    addToRunTimeSelectionTable(option, granularFlowSource, dictionary);

    //- Solutions for properties that depend on the temperature
    static const label mostSolutions = 30;
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::fv::granularFlowSource::granularFlowSource
(
    const word& name,
    const word& modelType,
    const dictionary& dict,
    const fvMesh& mesh
)
:
    option(name, modelType, dict, mesh),
    bed_(bedOf(mesh, dict)),
    flow_
    (
        Foam::granularFlow::New(bed_.grainProperties(), bed_.grains(), bed_.T())
    ),
    step_(-1),
    finished_(false)
{
    checkScheme();
    fieldNames_.resize(1, bed_.he().name());
    applied_.resize(1, false);
}


Foam::fv::granularFlowSource::~granularFlowSource()
{
    if (finished_)
    {
        report();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::granularSolidThermo& Foam::fv::granularFlowSource::bedOf
(
    const fvMesh& mesh,
    const dictionary& dict
)
{
    const auto* bed = isA<granularSolidThermo>
    (
        mesh.lookupObject<basicThermo>(basicThermo::dictName)
    );
    if
    (
        !bed
     || granularProperties::grainKeys.choice(bed->grainProperties(), "flow")
     == "none"
    )
    {
        FatalIOErrorInFunction(dict)
            << "Region " << mesh.name() << " has a source of type granularFlow"
            << " and " << (bed ? "no key 'flow' in granularProperties" : "no bed")
            << ", allowed: a bed with flow through" << exit(FatalIOError);
    }
    return const_cast<granularSolidThermo&>(*bed);
}


void Foam::fv::granularFlowSource::checkScheme() const
{
    const word scheme
    (
        mesh_.ddtScheme
        (
            "ddt((betavSolid*" + bed_.rho()().name() + "),"
          + bed_.he().name() + ')'
        )
    );
    if (scheme != "Euler")
    {
        FatalIOErrorInFunction(bed_.grainProperties())
            << "Entry 'flow' is given, and ddtSchemes in system/"
            << mesh_.name() << "/fvSchemes has " << scheme
            << ", allowed with a flow: Euler" << exit(FatalIOError);
    }
}


Foam::tmp<Foam::fvScalarMatrix> Foam::fv::granularFlowSource::ofTemperature
(
    const fvScalarMatrix& equation
) const
{
    const scalar c = bed_.grainProperties().heatCapacity().value();
    tmp<fvScalarMatrix> result(new fvScalarMatrix(bed_.T(), dimPower));
    fvScalarMatrix& bed = result.ref();
    bed.diag() = c*equation.diag();
    bed.upper() = c*equation.upper();
    bed.lower() = c*equation.lower();
    bed.source() = equation.source();
    forAll(bed.internalCoeffs(), patchi)
    {
        const bool coupled = mesh_.boundary()[patchi].coupled();
        bed.internalCoeffs()[patchi] = c*equation.internalCoeffs()[patchi];
        bed.boundaryCoeffs()[patchi] =
            (coupled ? c : 1)*equation.boundaryCoeffs()[patchi];
    }
    return result;
}


Foam::fileName Foam::fv::granularFlowSource::path() const
{
    return
        mesh_.time().globalPath()/functionObject::outputPrefix/mesh_.name()
       /"msddFoam/summary.json";
}


void Foam::fv::granularFlowSource::report() const
{
    OStringStream os;
    os  << "{\n  \"region\": " << string(mesh_.name()) << ",\n  \"flow\": "
        << flow_->summary().c_str() << ",\n  \"what_to_know\": [";
    const char* comma = "\n    ";
    Info<< nl << "Region " << mesh_.name() << nl
        << "Accuracy and warnings of the flow:" << nl;
    for (const string& sentence : flow_->sentences())
    {
        if (!sentence.empty())
        {
            Info<< "  - " << sentence.c_str() << nl;
            os  << comma << sentence;
            comma = ",\n    ";
        }
    }
    os  << "\n  ]\n}\n";
    if (Pstream::master())
    {
        writeWhole(path(), [&](std::ostream& file) { file << os.str(); });
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::fv::granularFlowSource::addSup
(
    const volScalarField&,
    fvMatrix<scalar>& eqn,
    const label
)
{
    if (step_ == mesh_.time().timeIndex())
    {
        eqn.source() -= heat_;
    }
}


void Foam::fv::granularFlowSource::constrain
(
    fvMatrix<scalar>& eqn,
    const label
)
{
    if (!flow_->active())
    {
        return;
    }
    const label now = mesh_.time().timeIndex();
    const bool again = step_ == now;
    volScalarField& T = bed_.T();
    volScalarField& h = bed_.he();
    const scalar c = bed_.grainProperties().heatCapacity().value();
    T.primitiveFieldRef() = h.primitiveField()/c;
    if (again)
    {
        eqn.source() -= heat_;
        flow_->reopen();
    }
    else
    {
        step_ = now;
        flow_->begin();
        flow_->beginStage();
    }
    const tmp<fvScalarMatrix> bed(ofTemperature(eqn));
    const scalar tau = mesh_.time().deltaTValue();
    for (label solution = 0; solution < mostSolutions; ++solution)
    {
        if (flow_->solve(bed(), tau, GREAT, 0))
        {
            break;
        }
    }
    h.primitiveFieldRef() = c*T.primitiveField();
    heat_ = heatBeyond(eqn);

    equation_.reset(new fvScalarMatrix(eqn));
    forAll(T.boundaryField(), patchi)
    {
        if (dynamic_cast<const contactWall*>(&T.boundaryField()[patchi]))
        {
            equation_->internalCoeffs()[patchi] = Zero;
            equation_->boundaryCoeffs()[patchi] = Zero;
        }
    }
    eqn.source() += heat_;
}


void Foam::fv::granularFlowSource::correct(volScalarField&)
{
    if (!flow_->active())
    {
        return;
    }
    if (!finished_ && Pstream::master())
    {
        rm(path());
    }
    flow_->received(gSum(heatBeyond(equation_())()));
    flow_->finish(mesh_.time().deltaTValue(), 1);
    finished_ = true;
}


// ************************************************************************* //
