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


#include "neighbourSolids.H"
#include "granularProperties.H"
#include "regionObjects.H"
#include "IOdictionary.H"
#include "OStringStream.H"
#include "regionProperties.H"
#include "runRecord.H"
#include "mappedPatchBase.H"
#include "fvmLaplacian.H"
#include "fvmSup.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Change of the temperatures of the solids over the largest of them at which
//- the solutions of bed and solids have met: that of the linear solvers
static const scalar met = 1e-10;

//- Solutions of a stage
static const label mostSolutions = 60;

//- While the change of the temperatures of the solids is above so many times
//- that, repetitions for the bed alone end at this share of the change
static const scalar far = 100;
static const scalar enough = 0.03;

//- A change that is not below this share of the least of so many solutions ago
//- is a rounding error, if it is at most this part of the largest temperature
static const scalar falls = 0.5;
static const label patience = 3;
static const scalar rounding = 1e-8;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::neighbourSolids::neighbourSolids(const Time& runTime)
:
    entered_(0),
    given_(0),
    startHeat_(0),
    stages_(0),
    solutions_(0),
    unconverged_(0)
{
    IOobject file
    (
        "regionProperties", runTime.constant(), runTime,
        IOobject::MUST_READ, IOobject::NO_WRITE, false
    );
    if (!file.typeHeaderOk<IOdictionary>(true))
    {
        return;
    }
    const regionProperties regions(runTime);
    forAllConstIters(regions, iter)
    {
        if (iter.key() != "solid" && iter.val().size())
        {
            FatalErrorInFunction
                << "constant/regionProperties has the regions "
                << granularProperties::listed(iter.val()).c_str()
                << " of type '" << iter.key() << "', allowed next to msddFoam:"
                << " solid. With a fluid next to the bed run"
                << " chtMultiRegionFoam, with the bed as solid region of type"
                << " granularSolidThermo" << exit(FatalError);
        }
    }

    // The boundary conditions that couple regions
    // (open() of a text without its type would take it as a switch)
    for
    (
        const fileName library :
        {"libcompressibleTurbulenceModels.so", "libgranularThermo.so"}
    )
    {
        const_cast<Time&>(runTime).libs().open(library);
    }
    // lookup returns a reference, to the default where the word is missing
    const wordList none;
    for (const word& name : regions.lookup("solid", none))
    {
        read(runTime, name);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::neighbourSolids::read(const Time& runTime, const word& name)
{
    Info<< "Solid next to the bed: region " << name << nl;
    solids_.append(new solid);
    solid& s = solids_.last();
    s.mesh = regionObjects::readMesh(runTime, name);
    runRecord::checkMesh(s.mesh());
    s.thermo = solidThermo::New(s.mesh());
    if (!s.thermo->isotropic())
    {
        FatalErrorInFunction
            << "Region " << name << " has a conductivity with directions,"
            << " allowed next to msddFoam: the transport models constIso and"
            << " others without directions" << exit(FatalError);
    }
    s.correctors =
        s.mesh->solutionDict().subOrEmptyDict("PIMPLE")
       .lookupOrDefault<label>("nNonOrthogonalCorrectors", 0);
    s.mesh->solverDict("T");
    s.rho.reset(new volScalarField("solidRho", s.thermo->rho()));
    update(s);
    startHeat_ = storedHeat();
}


void Foam::neighbourSolids::update(solid& s)
{
    s.thermo->he() = s.thermo->he(s.thermo->p(), s.T());
    s.thermo->correct();
    s.capacity.reset(new volScalarField("rhoCp", s.rho()*s.thermo->Cp()));
    s.kappa.reset(new volScalarField("kappa", s.thermo->kappa()));
}


void Foam::neighbourSolids::solve(solid& s, const scalar tau)
{
    volScalarField& T = s.T();
    const fvMesh& mesh = s.mesh();
    fv::options& sources = fv::options::New(mesh);
    const scalarField& rho = s.rho->primitiveField();

    for (label corrector = 0; corrector <= s.correctors; ++corrector)
    {
        // rho (h - h*)/tau with h = h(Tk) + c(Tk) (T - Tk)
        update(s);
        const scalarField& C = s.capacity->primitiveField();
        const scalarField& Tk = T.primitiveField();
        const scalarField& hk = s.h();
        T.correctBoundaryConditions();
        fvScalarMatrix equation
        (
          - fvm::laplacian(s.kappa(), T, "laplacian(kappa,T)")
        );
        equation.diag() += C*mesh.V()/tau;
        equation.source() += (C*Tk - rho*(hk - s.hstar))*mesh.V()/tau;
        s.heat = 0;
        if (!sources.optionList::empty())
        {
            const fvScalarMatrix S(sources(s.capacity(), T));
            equation -= S;
            sources.constrain(equation);
            s.heat -= sum(S.source());
            if (S.hasDiag())
            {
                s.heat += sum(S.diag()*T.primitiveField());
            }
        }
        equation.solve(mesh.solverDict("T"));
        forAll(mesh.boundary(), patchi)
        {
            const fvPatch& patch = mesh.boundary()[patchi];
            if (patch.coupled() || isA<mappedPatchBase>(patch.patch()))
            {
                continue;
            }
            s.heat += sum
            (
                equation.boundaryCoeffs()[patchi]
              - equation.internalCoeffs()[patchi]
               *scalarField(T.primitiveField(), patch.faceCells())
            );
        }
    }
}


Foam::scalarField Foam::neighbourSolids::temperatures()
{
    DynamicList<scalar> result;
    for (solid& s : solids_)
    {
        result.append(s.T().primitiveField());
        for (const fvPatchScalarField& patch : s.T().boundaryField())
        {
            if (isA<mappedPatchBase>(patch.patch().patch()))
            {
                result.append(patch);
            }
        }
    }
    return scalarField(result);
}


void Foam::neighbourSolids::setTemperatures(const scalarField& all)
{
    label at = 0;
    const auto set = [&](scalarField& T)
    {
        T = SubList<scalar>(all, T.size(), at);
        at += T.size();
    };
    for (solid& s : solids_)
    {
        set(s.T().primitiveFieldRef());
        for (fvPatchScalarField& patch : s.T().boundaryFieldRef())
        {
            if (isA<mappedPatchBase>(patch.patch().patch()))
            {
                set(patch);
            }
        }
    }
}


Foam::scalar Foam::neighbourSolids::storedHeat()
{
    scalar heat = 0;
    for (solid& s : solids_)
    {
        heat += gSum(s.rho->primitiveField()*s.h()*s.mesh->V());
    }
    return heat;
}


Foam::neighbourSolids::heatBalance Foam::neighbourSolids::balance()
{
    return
    {
        returnReduce(entered_, sumOp<scalar>()),
        returnReduce(given_, sumOp<scalar>()),
        storedHeat() - startHeat_
    };
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::neighbourSolids::begin()
{
    for (solid& s : solids_)
    {
        s.Told = s.T().primitiveField();
        s.Tstar = s.Told;
        s.hold = s.h();
        s.hstar = s.hold;
    }
}


void Foam::neighbourSolids::restore()
{
    for (solid& s : solids_)
    {
        s.T().primitiveFieldRef() = s.Told;
        s.Tstar = s.Told;
        s.hstar = s.hold;
    }
}


void Foam::neighbourSolids::secondStage(const scalar share)
{
    for (solid& s : solids_)
    {
        update(s);
        scalarField& T = s.T().primitiveFieldRef();
        s.hstar = s.hold + (1 - share)*(s.h() - s.hold)/share;
        s.rate = (T - s.Told)/share;
        s.Tstar = s.Told + (1 - share)*s.rate;
        T = s.Told + s.rate;
    }
}


Foam::scalar Foam::neighbourSolids::stageError(const scalar share) const
{
    scalar error = 0;
    for (const solid& s : solids_)
    {
        const scalarField& T = s.thermo->T().primitiveField();
        error = max(error, gMax(mag(T - s.Tstar - share*s.rate)));
    }
    return error;
}


void Foam::neighbourSolids::couple
(
    const scalar tau,
    const std::function<void(const scalar)>& bed
)
{
    if (empty())
    {
        bed(0);
        return;
    }
    mixing_.clear();
    ++stages_;
    scalar least = GREAT;
    label waited = 0;
    scalarField from(temperatures());
    scalar sufficient = GREAT;
    for (label solution = 1; ; ++solution)
    {
        bed(sufficient);
        for (solid& s : solids_)
        {
            solve(s, tau);
        }
        ++solutions_;
        const scalarField to(temperatures());
        const scalar largest = gMax(mag(to));
        const scalar change = gMax(mag(to - from));
        waited = change < falls*least ? 0 : waited + 1;
        least = min(least, change);
        const bool ends =
            sufficient == 0
         && (
                change <= met*largest
             || (waited >= patience && change <= rounding*largest)
            );
        sufficient = change > far*met*largest ? enough*change : 0;
        if (ends || solution == mostSolutions)
        {
            unconverged_ += !ends;
            return;
        }
        from = mixing_.next(from, to);
        setTemperatures(from);
    }
}


Foam::scalar Foam::neighbourSolids::heat() const
{
    scalar heat = 0;
    for (const solid& s : solids_)
    {
        heat += s.heat;
    }
    return heat;
}


void Foam::neighbourSolids::finish(const scalar entered, const scalar given)
{
    entered_ += entered;
    given_ += given;
    for (solid& s : solids_)
    {
        update(s);
    }
}


void Foam::neighbourSolids::report()
{
    if (empty())
    {
        return;
    }
    const heatBalance heat(balance());
    Info<< "Solids next to the bed: " << heat.entered
        << " J came in from outside, " << heat.given
        << " J went to the bed, and they hold " << heat.more
        << " J more; the difference is " << heat.difference() << " of these. " << scalar(solutions_)/max(stages_, label(1))
        << " solutions a stage";
    if (unconverged_)
    {
        Info<< "; " << unconverged_ << " of " << stages_
            << " stages ended before bed and solids had met";
    }
    Info<< nl << endl;
}


Foam::string Foam::neighbourSolids::warning()
{
    if (empty())
    {
        return string();
    }
    wordList names;
    for (const solid& s : solids_)
    {
        names.append(s.mesh->name());
    }
    const string walls
    (
        "between the bed and " + granularProperties::listed(names)
    );
    const scalar difference = balance().difference();
    OStringStream text;
    text.precision(3);
    if (difference > runRecord::muchHeat)
    {
        text<< "Warning: heat is lost or made at the walls " << walls.c_str()
            << ": what these solids received, gave to the bed and hold differs"
            << " by " << difference << " of these amounts, expected: below "
            << runRecord::muchHeat << ". Where the faces on both sides of a"
            << " wall differ, use sampleMode nearestPatchFaceAMI. ";
    }
    if (unconverged_)
    {
        text<< "Warning: in " << unconverged_ << " of " << stages_
            << " stages the temperatures at the walls " << walls.c_str()
            << " had not converged after " << mostSolutions << " solutions.";
    }
    return text.str();
}


// ************************************************************************* //
