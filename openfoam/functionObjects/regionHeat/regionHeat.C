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

#include "regionHeat.H"
#include "foamVersions.H"
#include "fvMatrices.H"
#include "fvOptions.H"
#include "mappedPatchBase.H"
#include "keyTable.H"
#include "runRecord.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(regionHeat, 0);
    addToRunTimeSelectionTable(functionObject, regionHeat, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable regionHeatKeys
(
    "regionHeat",
    {
        {
            "tolerance",
            "largest relative_difference; above it the run ends with an error",
            "-", "any number", "none"
        }
    }
);

static const keyTable regionHeatColumns
(
    "columns of regionHeat",
    {
        {
            "<region>_stored",
            "heat that a region has stored since the start: density times"
            " change of enthalpy times volume", "J"
        },
        {"patches", "heat received through outer patches", "J"},
        {"fluids", "heat received through walls to fluid regions", "J"},
        {
            "sources",
            "heat received from fvOptions, and at walls from a gas that flows"
            " through a bed", "J"
        },
        {
            "interfaces",
            "heat received through walls to other solid regions, sum over both"
            " sides: 0 if the regions agree", "J"
        },
        {
            "exchanged",
            "sum of the absolute amounts over patches, fluids, sources and"
            " steps", "J"
        },
        {
            "relative_difference",
            "|stored - patches - fluids - sources| over exchanged", "-"
        }
    }
);


//- What lets the heat that leaves one region enter the next
static const char* const remedy =
    ". Use more nOuterCorrectors or, where the faces on both sides of a wall"
    " differ, sampleMode nearestPatchFaceAMI";


static const solidThermo* thermoOf(const fvMesh& mesh)
{
    return mesh.findObject<solidThermo>(basicThermo::dictName);
}


//- Fraction of the volume that the solver gives to the solid
static scalarField fraction(const fvMesh& mesh, const label patchi = -1)
{
    const auto* field = mesh.findObject<volScalarField>("betavSolid");
    const label size =
        patchi < 0 ? mesh.nCells() : mesh.boundary()[patchi].size();
    return
        !field ? scalarField(size, 1)
      : patchi < 0 ? scalarField(field->primitiveField())
      : scalarField(field->boundaryField()[patchi]);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::regionHeat::regionHeat
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    stateFunctionObject(name, runTime),
    writeFile(runTime, name, typeName),
    tolerance_(regionHeatKeys.number(dict, "tolerance", GREAT)),
    patches_(0),
    fluids_(0),
    sources_(0),
    interfaces_(0),
    exchanged_(0),
    crossed_(0),
    difference_(0)
{
    resume();
    read(dict);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::wordList Foam::functionObjects::regionHeat::regions() const
{
    wordList names;
    for (const word& name : time_.sortedNames<fvMesh>())
    {
        if (thermoOf(mesh(name)))
        {
            names.append(name);
        }
    }
    return names;
}


const Foam::fvMesh& Foam::functionObjects::regionHeat::mesh
(
    const word& region
) const
{
    return time_.lookupObject<fvMesh>(region);
}


Foam::scalar Foam::functionObjects::regionHeat::storedInStep
(
    const fvMesh& mesh
)
{
    const solidThermo& thermo = *thermoOf(mesh);
    const volScalarField& h = thermo.he();
    return sum
    (
        mesh.V()*fraction(mesh)*thermo.rho()().primitiveField()
       *(h.primitiveField() - h.oldTime().primitiveField())
    );
}


Foam::scalar Foam::functionObjects::regionHeat::content
(
    const fvMesh& mesh
)
{
    const solidThermo& thermo = *thermoOf(mesh);
    return sum
    (
        mesh.V()*fraction(mesh)*thermo.rho()().primitiveField()
       *thermo.Cp()().primitiveField()*thermo.T().primitiveField()
    );
}


Foam::tmp<Foam::scalarField> Foam::functionObjects::regionHeat::flux
(
    const fvMesh& mesh,
    const label patchi
)
{
    const solidThermo& thermo = *thermoOf(mesh);
    const fvPatchScalarField& h = thermo.he().boundaryField()[patchi];
    scalarField alpha(thermo.alpha(patchi));
    if (mesh.foundObject<volSymmTensorField>(foamDirectedAlpha))
    {
        const vectorField n(mesh.boundary()[patchi].nf());
        alpha =
            n
          & mesh.lookupObject<volSymmTensorField>(foamDirectedAlpha)
                .boundaryField()[patchi]
          & n;
    }
    // The coefficients of the last equation: values at the wall may have
    // changed since it was solved
    return
        alpha*fraction(mesh, patchi)
       *(
            h.gradientInternalCoeffs()*h.patchInternalField()
          + h.gradientBoundaryCoeffs()
        );
}


Foam::scalar Foam::functionObjects::regionHeat::fromSources(const fvMesh& mesh)
{
    auto* options = mesh.getObjectPtr<fv::options>(fv::options::typeName);
    if (!options || options->optionList::empty())
    {
        return 0;
    }
    // A copy, with the name by which sources know it: making a matrix of the
    // solver's own field would update its walls
    const solidThermo& thermo = *thermoOf(mesh);
    volScalarField h
    (
        IOobject
        (
            thermo.he().name(),
            mesh.time().timeName(),
            mesh,
            IOobject::NO_READ,
            IOobject::NO_WRITE,
            false
        ),
        mesh,
        thermo.he().dimensions()
    );
    h.primitiveFieldRef() = thermo.he().primitiveField();
    const tmp<volScalarField> rho(thermo.rho());
    const fvScalarMatrix S((*options)(rho(), h));
    scalar heat = -sum(S.source());
    if (S.hasDiag())
    {
        heat += sum(S.diag()*h.primitiveField());
    }
    return heat;
}


Foam::scalar Foam::functionObjects::regionHeat::fromGas
(
    const fvMesh& mesh,
    const label patchi
)
{
    if (!mesh.foundObject<volScalarField>("wallExchange"))
    {
        return 0;
    }
    const auto field = [&mesh](const word& name) -> const volScalarField&
    {
        return mesh.lookupObject<volScalarField>(name);
    };
    const fvPatch& patch = mesh.boundary()[patchi];
    const scalarField gas(field("gasTemperature"), patch.faceCells());
    return sum
    (
        patch.magSf()*field("wallExchange").boundaryField()[patchi]
       *(gas - field("vesselTemperature").boundaryField()[patchi])
    );
}


void Foam::functionObjects::regionHeat::add(const scalar heat, scalar& sum)
{
    const scalar all = returnReduce(heat, sumOp<scalar>());
    sum += all;
    exchanged_ += mag(all);
}


void Foam::functionObjects::regionHeat::addPatches
(
    const fvMesh& mesh,
    const scalar deltaT
)
{
    // Patches between processes, which come last, exist on some of them only
    const label patches = mesh.boundaryMesh().nNonProcessor();
    for (label patchi = 0; patchi < patches; ++patchi)
    {
        const polyPatch& patch = mesh.boundaryMesh()[patchi];
        if (patch.coupled())
        {
            continue;
        }
        const scalar heat =
            deltaT*sum(mesh.boundary()[patchi].magSf()*flux(mesh, patchi));
        const auto* mapped = isA<mappedPatchBase>(patch);
        const bool other = mapped && mapped->sampleRegion() != mesh.name();
        if (!other)
        {
            add(heat, patches_);
        }
        else if (thermoOf(refCast<const fvMesh>(mapped->sampleMesh())))
        {
            // What both regions receive there comes from the gas
            const scalar gas =
                returnReduce(deltaT*fromGas(mesh, patchi), sumOp<scalar>());
            sources_ += gas;
            exchanged_ += mag(gas);
            const scalar all = returnReduce(heat, sumOp<scalar>());
            interfaces_ += all - gas;
            crossed_ += mag(all);
        }
        else
        {
            add(heat, fluids_);
        }
    }
}


void Foam::functionObjects::regionHeat::keep()
{
    setProperty("patches", patches_);
    setProperty("fluids", fluids_);
    setProperty("sources", sources_);
    setProperty("interfaces", interfaces_);
    setProperty("exchanged", exchanged_);
    setProperty("crossed", crossed_);
    for (const word& region : stored_.sortedToc())
    {
        setProperty(region + "_stored", stored_[region]);
    }
}


void Foam::functionObjects::regionHeat::resume()
{
    getProperty("patches", patches_);
    getProperty("fluids", fluids_);
    getProperty("sources", sources_);
    getProperty("interfaces", interfaces_);
    getProperty("exchanged", exchanged_);
    getProperty("crossed", crossed_);
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

void Foam::functionObjects::regionHeat::writeHead(Ostream& os) const
{
    regionHeatColumns.explain(os);
    writeCommented(os, "Time");
    for (const word& region : regions())
    {
        writeTabbed(os, region + "_stored");
    }
    for (const keyTable::entry& column : regionHeatColumns.entries())
    {
        if (column.name[0] != '<')
        {
            writeTabbed(os, column.name);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::regionHeat::read(const dictionary& dict)
{
    return stateFunctionObject::read(dict) && writeFile::read(dict);
}


bool Foam::functionObjects::regionHeat::execute()
{
    if (postProcess)
    {
        return true;
    }
    const scalar deltaT = time_.deltaTValue();
    for (const word& region : regions())
    {
        const fvMesh& solid = mesh(region);
        if (!stored_.found(region))
        {
            stored_.set(region, 0);
            getProperty(region + "_stored", stored_[region]);
        }
        stored_[region] += returnReduce(storedInStep(solid), sumOp<scalar>());
        add(deltaT*fromSources(solid), sources_);
        addPatches(solid, deltaT);
    }
    keep();
    return true;
}


bool Foam::functionObjects::regionHeat::write()
{
    if (postProcess)
    {
        Info<< type() << ' ' << name() << ": no row for the time "
            << time_.timeName() << ", because it needs the heat of every step"
            << endl;
        return true;
    }
    scalar stored = 0, held = 0;
    for (const word& region : regions())
    {
        stored += stored_[region];
        held += returnReduce(content(mesh(region)), sumOp<scalar>());
    }
    // Where nothing is exchanged the difference is rounding of what is held
    difference_ =
        mag(stored - patches_ - fluids_ - sources_)
       /max(exchanged_, max(runRecord::roundedHeat*held, VSMALL));

    if (Pstream::master())
    {
        if (!writtenHeader_)
        {
            resetFile(fileName_);
            writeHead(file());
            file() << endl;
            writtenHeader_ = true;
        }
        file() << time_.timeName();
        for (const word& region : regions())
        {
            file() << tab << stored_[region];
        }
        file()
            << tab << patches_ << tab << fluids_ << tab << sources_
            << tab << interfaces_ << tab << exchanged_ << tab << difference_
            << endl;
    }
    if (difference_ > tolerance_)
    {
        FatalErrorInFunction
            << "Heat stored by the solid regions differs from heat received by "
            << difference_ << " of the heat exchanged, allowed: " << tolerance_
            << remedy << exit(FatalError);
    }
    return true;
}


bool Foam::functionObjects::regionHeat::end()
{
    // Walls that hardly any heat crosses do not count
    const scalar lost =
        mag(interfaces_)
       /max(crossed_, runRecord::muchHeat*exchanged_ + VSMALL);
    if (max(lost, difference_) > runRecord::muchHeat)
    {
        WarningInFunction
            << "Heat is lost or made between the solid regions: " << interfaces_
            << " J at their walls, " << lost << " of the heat that entered and"
            << " left through these; stored and received heat differ by "
            << difference_ << " of the heat exchanged. Expected: both below "
            << runRecord::muchHeat << remedy << endl;
    }
    return true;
}


// ************************************************************************* //
