/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
     \\/     M anipulation  |
-------------------------------------------------------------------------------
License
    SPDX-License-Identifier: GPL-3.0-or-later

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty: see the file LICENSE.
\*---------------------------------------------------------------------------*/

#include "sceneWarnings.H"
#include "briefNumber.H"
#include "regionSplit.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Sizes above which a mesh was probably given in other units than metres: the
//- largest silos are some 50 m high, and beds of fine sand some 1e4 grains
static const scalar largestBed = 100;
static const scalar mostGrains = 1e5;

//- Parts of a mesh whose numbers of cells are printed
static const label mostParts = 5;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::sceneWarnings::sceneWarnings
(
    const granularProperties& properties,
    const volScalarField& T,
    const granularState& grains,
    const granularMechanics& mechanics
)
:
    properties_(properties),
    T_(T),
    grains_(grains),
    mechanics_(mechanics),
    mesh_(T.mesh())
{
    checkSize();
    checkParts();
    checkCompared();
    checkSpheres();
    checkCells();
    checkSides();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::sceneWarnings::checkSize()
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


void Foam::sceneWarnings::checkParts()
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
    Pstream::listCombineScatter(cells);
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


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::sceneWarnings::add(const string& text)
{
    all_.append(text);
}


void Foam::sceneWarnings::print() const
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
