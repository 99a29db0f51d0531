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

#include "granularSolidThermo.H"
#include "caseChecks.H"
#include "refusals.H"
#include "timeVerdict.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "gradientEnergyFvPatchScalarField.H"
#include "mixedEnergyFvPatchScalarField.H"
#include "mixedFvPatchFields.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(granularSolidThermo, 0);
    addToRunTimeSelectionTable(solidThermo, granularSolidThermo, fvMesh);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

void Foam::granularSolidThermo::checkTime(const fvMesh& mesh)
{
    const IOdictionary dict
    (
        IOobject
        (
            dictName, mesh.time().constant(), mesh,
            IOobject::MUST_READ, IOobject::NO_WRITE, false
        )
    );
    principalAxes::thermoKeys.check(dict);
    runRecord::accepted = wordHashSet
    (
        dict.lookupOrDefault<wordList>("accept", wordList())
    );
    runRecord::acceptedIn =
        mesh.time().constant()/mesh.dbDir()/dictName;

    const timeVerdict verdict(mesh.time().timePath(), mesh.dbDir());
    if (verdict.what != timeVerdict::good)
    {
        FatalErrorInFunction
            << "Region " << mesh.name() << " cannot begin with time "
            << mesh.time().timeName() << " in " << mesh.time().path() << ": "
            << verdict.reason.c_str() << ". Allowed: an earlier startTime, or,"
            << " if the last run was stopped while it wrote, the removal of the"
            << " folder " << mesh.time().timePath() << " (of all processes), to"
            << " go on from the time before; or "
            << runRecord::toAccept("files").c_str() << ", to take it as it is"
            << " now; files that are missing are then replaced by initial"
            << " values" << exit(FatalError);
    }
    runRecord::checkMesh(mesh, mesh.dbDir());
}


const Foam::fvMesh& Foam::granularSolidThermo::checked(const fvMesh& mesh)
{
    checkOpenFOAM();
    checkTime(mesh);

    const wordList needed({"T", "p", "porosity", "fabricIndex"});
    wordList missing;
    for (const word& name : needed)
    {
        IOobject header
        (
            name, mesh.time().timeName(), mesh,
            IOobject::MUST_READ, IOobject::NO_WRITE, false
        );
        if (!header.typeHeaderOk<volScalarField>(true))
        {
            missing.append(name);
        }
    }
    if (missing.size())
    {
        FatalErrorInFunction
            << "Region " << mesh.name() << " is a bed of grains and has no"
            << " fields " << granularProperties::listed(missing).c_str()
            << " in " << mesh.time().timePath()/mesh.dbDir() << ", needed: "
            << granularProperties::listed(needed).c_str()
            << exit(FatalError);
    }
    return mesh;
}


Foam::granularSolidThermo::granularSolidThermo
(
    const fvMesh& mesh,
    const word& phaseName
)
:
    solidThermo(checked(mesh), phaseName),
    properties_(mesh),
    grains_(properties_, T_),
    tables_(mesh.time(), false),
    Cp_
    (
        IOobject("Cp", mesh.time().timeName(), mesh),
        mesh,
        properties_.heatCapacity()
    ),
    axes_(*this, mesh),
    Kappa_
    (
        IOobject("Kappa", mesh.time().timeName(), mesh),
        mesh,
        dimensionedVector
        (
            properties_.thermalConductivity().dimensions(), Zero
        ),
        extrapolatedCalculatedFvPatchVectorField::typeName
    ),
    aniAlpha_
    (
        IOobject("aniAlpha", mesh.time().timeName(), mesh),
        mesh,
        dimensionedSymmTensor(alpha_.dimensions(), Zero),
        extrapolatedCalculatedFvPatchVectorField::typeName
    ),
    he_
    (
        IOobject("h", mesh.time().timeName(), mesh),
        mesh,
        dimEnergy/dimMass,
        heBoundaryTypes(),
        heBoundaryBaseTypes()
    ),
    step_(mesh.time().timeIndex()),
    startT_(T_.primitiveField())
{
    checkEntries();
    checkPlane(mesh, properties_.surrogateDict());

    rho_ == grains_.bulkDensity();
    mu_ == dimensionedScalar(mu_.dimensions(), Zero);
    psi_ == dimensionedScalar(psi_.dimensions(), Zero);

    grains_.warm(T_, []() {});
    setEnergy();
    setGradients();
    setConductivity();
    grains_.record().writeRegion();
}


Foam::granularSolidThermo::~granularSolidThermo()
{
    tables_.update();
    Info<< nl << "Region " << he_.mesh().name() << nl;
    grains_.writeReport();
    if (axes_.error() > 0)
    {
        Info<< "Largest relative error of the heat flux by what the axes leave"
            << " out: "
            << axes_.error() << nl;
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularSolidThermo::checkEntries() const
{
    const word mechanics
    (
        properties_.lookupOrDefault<word>("mechanics", "none")
    );
    if (mechanics != "none")
    {
        FatalIOErrorInFunction(properties_)
            << "Entry 'mechanics' is '" << mechanics << "', allowed in a region"
            << " of " << typeName << ": none. msddFoam, which solves the bed"
            << " alone, can move the grains" << exit(FatalIOError);
    }
    if (!properties_.heatFunction().isNumber())
    {
        FatalIOErrorInFunction(properties_)
            << "Entry 'heatCapacity' is a function of the temperature, allowed"
            << " in a region of " << typeName << ": a number. msddFoam takes it"
            << exit(FatalIOError);
    }
    checkFlow();
}


void Foam::granularSolidThermo::checkFlow() const
{
    if (granularProperties::grainKeys.choice(properties_, "flow") == "none")
    {
        return;
    }
    const fvMesh& mesh = T_.mesh();
    bool called = false;
    for (const word& place : {mesh.time().constant(), mesh.time().system()})
    {
        IOobject file
        (
            "fvOptions", place, mesh,
            IOobject::MUST_READ, IOobject::NO_WRITE, false
        );
        if (!file.typeHeaderOk<IOdictionary>(true))
        {
            continue;
        }
        const IOdictionary dict(file);
        for (const entry& item : dict.optionalSubDict("options"))
        {
            const word type
            (
                item.isDict()
              ? item.dict().getOrDefault<word>("type", word::null)
              : word::null
            );
            called =
                called
             || (
                    type == "granularFlow"
                 && item.dict().getOrDefault("active", true)
                );
            if (type.find("Constraint") != string::npos)
            {
                FatalIOErrorInFunction(dict)
                    << "Source " << item.keyword() << " is of type " << type
                    << ", allowed in a bed with a flow: sources that fix no"
                    << " temperatures" << exit(FatalIOError);
            }
        }
        break;
    }
    if (!called)
    {
        FatalIOErrorInFunction(properties_)
            << "Entry 'flow' is given, and constant/" << mesh.name()
            << "/fvOptions does not call it, needed:"
            << " gas { type granularFlow; }" << exit(FatalIOError);
    }
}


void Foam::granularSolidThermo::setEnergy()
{
    const scalar c = properties_.heatCapacity().value();
    he_.primitiveFieldRef() = c*T_.primitiveField();
    forAll(he_.boundaryField(), patchi)
    {
        he_.boundaryFieldRef()[patchi] == c*T_.boundaryField()[patchi];
    }
}


void Foam::granularSolidThermo::setGradients()
{
    for (fvPatchScalarField& patch : he_.boundaryFieldRef())
    {
        // From values: snGrad of newer versions queries the class of the patch
        const tmp<scalarField> gradient
        (
            patch.patch().deltaCoeffs()*(patch - patch.patchInternalField())
        );
        if (isA<gradientEnergyFvPatchScalarField>(patch))
        {
            refCast<gradientEnergyFvPatchScalarField>(patch).gradient() =
                gradient;
        }
        else if (isA<mixedEnergyFvPatchScalarField>(patch))
        {
            refCast<mixedEnergyFvPatchScalarField>(patch).refGrad() = gradient;
        }
    }
}


void Foam::granularSolidThermo::setConductivity()
{
    vectorField& along = Kappa_.primitiveFieldRef();
    symmTensorField K(grains_.conductivity().primitiveField());
    if (!grains_.model().isThreeDimensional())
    {
        for (symmTensor& cell : K)
        {
            cell.zz() = grains_.model().conductivityZZ();
        }
    }
    axes_.apply
    (
        K,
        along,
        aniAlpha_.primitiveFieldRef()
    );
    if (properties_.conductivityFactor() != 1)
    {
        along *= properties_.conductivityFactor();
    }
    Kappa_.correctBoundaryConditions();

    const scalar c = properties_.heatCapacity().value();
    aniAlpha_.primitiveFieldRef() *= properties_.conductivityFactor()/c;
    aniAlpha_.correctBoundaryConditions();
    const bool space = he_.mesh().nSolutionD() == 3;
    scalarField& alpha = alpha_.primitiveFieldRef();
    forAll(alpha, celli)
    {
        const vector& K = along[celli];
        alpha[celli] =
            (space ? (K.x() + K.y() + K.z())/3 : 0.5*(K.x() + K.y()))/c;
    }
    forAll(alpha_.boundaryField(), patchi)
    {
        alpha_.boundaryFieldRef()[patchi] == normal(patchi)/c;
    }
}


void Foam::granularSolidThermo::guessEnergy()
{
    // Otherwise the value of the old time would become the guess
    he_.oldTime();

    scalarField T(T_.primitiveField());
    grains_.extrapolateTemperature(T);
    he_.primitiveFieldRef() = properties_.heatCapacity().value()*T;
}


Foam::tmp<Foam::scalarField> Foam::granularSolidThermo::normal
(
    const label patchi
) const
{
    const fvPatch& patch = he_.mesh().boundary()[patchi];
    const labelUList& cells = patch.faceCells();
    const vectorField n(patch.nf());
    tmp<scalarField> value(new scalarField(n.size()));

    // The solver takes the conductivity at a wall from the cell next to it
    forAll(n, facei)
    {
        if (foamTakesTensor)
        {
            value.ref()[facei] =
                properties_.heatCapacity().value()
               *(n[facei] & aniAlpha_[cells[facei]] & n[facei]);
            continue;
        }
        const vector m(axes_.rotation(cells[facei]).T() & n[facei]);
        const vector& K = Kappa_[cells[facei]];
        value.ref()[facei] =
            sqr(m.x())*K.x() + sqr(m.y())*K.y() + sqr(m.z())*K.z();
    }
    return value;
}


void Foam::granularSolidThermo::begin() const
{
    const Time& time = he_.mesh().time();
    if (time.timeIndex() == step_)
    {
        return;
    }
    // Solvers request the conductivity through a constant reference
    granularSolidThermo& self = const_cast<granularSolidThermo&>(*this);
    self.step_ = time.timeIndex();
    self.startT_ = T_.primitiveField();
    self.guessEnergy();

    // Steps 1 to 3 of Algorithm 1, with the strain of the last step
    scalar error;
    if (self.grains_.propose(false, error))
    {
        self.grains_.policy().refuseCut();
    }
    self.grains_.commit();
    self.setConductivity();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularSolidThermo::correct()
{
    tables_.update();
    if (updateT())
    {
        const scalar c = properties_.heatCapacity().value();
        T_.primitiveFieldRef() = he_.primitiveField()/c;
        forAll(T_.boundaryField(), patchi)
        {
            // Mixed walls say that they fix the value, but theirs follows from
            // the cells, too: the new one belongs to the heat of this solution
            fvPatchScalarField& patch = T_.boundaryFieldRef()[patchi];
            if (!patch.fixesValue() || isA<mixedFvPatchScalarField>(patch))
            {
                patch == he_.boundaryField()[patchi]/c;
            }
        }
    }
    setEnergy();

    // Step 5, anew after each solution in a step
    grains_.strain(startT_, T_.primitiveField());
    grains_.finishStep();
}


// ************************************************************************* //
