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
#include "foamVersions.H"
#include "briefNumber.H"
#include "Function1.H"
#include "regionSplit.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Sizes above which a mesh was probably given in other units than metres: the
//- largest silos are some 50 m high, and beds of fine sand some 1e4 grains
static const scalar largestBed = 100;
static const scalar mostGrains = 1e4;

//- Parts of a mesh whose numbers of cells are printed
static const label mostParts = 5;

//- Times of a run at which functions are looked at
static const label samples = 400;


//- Mean conductivity along the directions that are solved for
static scalar meanConductivity
(
    const granularProperties& properties,
    const granularState& grains
)
{
    const fvMesh& mesh = grains.mesh();
    const scalarField& V = mesh.V();
    const symmTensor K
    (
        gSum(V*grains.conductivity().primitiveField())/gSum(V)
    );
    scalar sum = 0;
    const symmTensor::cmptType along[] = {K.xx(), K.yy(), K.zz()};
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        sum += mesh.geometricD()[i] > 0 ? along[i] : scalar(0);
    }
    return properties.conductivityFactor()*sum/mesh.nGeometricD();
}


//- Time from now to the end of the run; GREAT if it has none
static scalar durationOf(const Time& time)
{
    const scalar end = time.endTime().value();
    return end < GREAT ? end - time.value() : GREAT;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::caseWarnings::caseWarnings
(
    const granularProperties& properties,
    const volScalarField& T,
    granularState& grains,
    const granularMechanics& mechanics
)
:
    properties_(properties),
    T_(T),
    grains_(grains),
    mechanics_(mechanics),
    mesh_(T.mesh()),
    sources_(fv::options::New(mesh_)),
    duration_(durationOf(mesh_.time())),
    conductivity_(meanConductivity(properties, grains)),
    cellSize_(0),
    strange_(false),
    steady_(true),
    way_(0)
{
    checkSize();
    checkParts();
    checkCompared();
    checkSpheres();
    checkCells();
    checkGrains();
    checkEffects();
    checkWrites();
    readWalls();
    checkTemperatures();
    checkProperties();
    checkSources();
    checkTimes();
    checkKnown();
    checkPressure();
    checkStrains();
    checkWeight();
    checkGravity();
    checkTetrahedra();
    checkWallKeys();
    checkSides();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::caseWarnings::checkSize()
{
    // The thickness of a plane mesh does not count
    const vector span(mesh_.bounds().span());
    scalar size = 0;
    for (direction i = 0; i < vector::nComponents; ++i)
    {
        size = max(size, mesh_.solutionD()[i] > 0 ? span[i] : scalar(0));
    }
    const scalar across = size/(2*properties_.meanRadius().value());
    if (size > largestBed || across > mostGrains)
    {
        add
        (
            "The mesh is " + brief(size) + " m across, that is "
          + brief(across) + " grains; beds are at most about "
          + brief(largestBed) + " m or " + brief(mostGrains) + " grains across."
            " OpenFOAM's unit of length is the metre: a mesh in mm needs"
            " transformPoints -scale 0.001"
        );
    }
}


void Foam::caseWarnings::checkParts()
{
    const regionSplit part(mesh_);
    const label parts = part.nRegions();
    if (parts < 2)
    {
        return;
    }
    labelList cells(parts, Zero);
    for (const label i : part)
    {
        ++cells[i];
    }
    Pstream::listCombineGather(cells, plusEqOp<label>());
    fromMaster(cells);
    Foam::sort(cells, greaterOp<label>());
    string sizes;
    for (label i = 0; i < min(parts, mostParts); ++i)
    {
        sizes += (i ? ", " : "") + Foam::name(cells[i]);
    }
    add
    (
        "The mesh has " + Foam::name(parts) + " parts without a common face, of "
      + sizes + (parts > mostParts ? ", ..." : "") + " cells: no heat and no"
        " force passes between them. Parts that should touch need stitchMesh or"
        " one mesh"
    );
}


void Foam::caseWarnings::checkEffects()
{
    if (mechanics_.type() == "none" && properties_.found("equilibriumCoeffs"))
    {
        add
        (
            "Entry 'equilibriumCoeffs' of constant/granularProperties has no"
            " effect with mechanics none"
        );
    }
    const dictionary& surrogate = properties_.surrogateDict();
    if
    (
        grains_.model().type() == "constant" && surrogate.found("spheresCoeffs")
     && !surrogate.optionalSubDict("constantCoeffs").found("conductivity")
    )
    {
        add
        (
            "Surrogate type constant does not read spheresCoeffs: without the"
            " entry 'conductivity' [W/(m K)] it takes conductivity and stress"
            " from a model of discs without gas"
        );
    }
}


void Foam::caseWarnings::checkWrites()
{
    const dictionary& control = mesh_.time().controlDict();
    const word kind(control.getOrDefault<word>("writeControl", "timeStep"));
    const scalar interval = control.getOrDefault<scalar>("writeInterval", 0);
    const scalar deltaT = mesh_.time().deltaTValue();
    const bool steps =
        kind == "timeStep"
     && !control.getOrDefault<Switch>("adjustTimeStep", false);
    const bool seconds =
        kind == "runTime" || kind == "adjustable"
     || kind == "adjustableRunTime";
    const scalar longest = steps ? std::round(duration_/deltaT) : duration_;
    // OpenFOAM writes half a step before a time, too
    if
    (
        (steps || seconds) && duration_ > 0
     && interval > longest + (steps ? scalar(0) : 0.5*deltaT)
    )
    {
        const char* unit = steps ? " steps" : " s";
        add
        (
            "Entry 'writeInterval' of system/controlDict is " + brief(interval)
          + unit + ", allowed: at most the length of the run, " + brief(longest)
          + unit + ". No fields will be written: the solver does not write at"
            " the end by itself"
        );
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::caseWarnings::include
(
    const dictionary& dict,
    const word& key,
    range& values
) const
{
    const entry* given = dict.findEntry(key);
    if (!given)
    {
        return;
    }
    word form;
    if (given->isDict())
    {
        given->dict().readIfPresent("type", form);
    }
    else
    {
        const token first(given->stream());
        form = first.isWord() ? first.wordToken() : word::null;
    }
    // Forms of fields alone are not looked at
    if
    (
        !form.empty()
     && !Function1<scalar>::dictionaryConstructorTablePtr_->found(form)
    )
    {
        return;
    }
    const autoPtr<Function1<scalar>> value(Function1<scalar>::New(key, dict));
    const scalar begin = mesh_.time().value();
    for (label i = 0; i <= (duration_ < GREAT ? samples : 0); ++i)
    {
        const scalar now = value->value(begin + i*duration_/samples);
        values.least = min(values.least, now);
        values.most = max(values.most, now);
    }
}



void Foam::caseWarnings::add(const string& text)
{
    all_.append(text);
}


void Foam::caseWarnings::print() const
{
    forAll(all_, i)
    {
        Info<< "Warning " << i + 1 << ": " << all_[i].c_str() << nl;
    }
    if (all_.size())
    {
        Info<< endl;
    }
}


// ************************************************************************* //
