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

#include "meshNumbers.H"
#include "labelIOList.H"
#include "OStringStream.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Distances over the diagonal of the mesh that are the rounding of points in a
//- file of six digits
static const scalar rounding = 1e-5;

//- Pseudo-random number from -1 to 1 (the finaliser of splitmix64)
static scalar weight(const uint64_t kind, const label number)
{
    uint64_t x = (kind << 60) + uint64_t(number) + 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30))*0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27))*0x94d049bb133111eb;
    x ^= x >> 31;
    return std::ldexp(scalar(x >> 11), -52) - 1;
}


//- Numbers in the undecomposed mesh, as decomposePar writes them; false if there
//- are none
static bool readNumbers
(
    const polyMesh& mesh,
    const word& name,
    labelList& numbers
)
{
    IOobject io
    (
        name, mesh.facesInstance(), polyMesh::meshSubDir, mesh,
        IOobject::MUST_READ, IOobject::NO_WRITE, false
    );
    if (!io.typeHeaderOk<labelIOList>(true))
    {
        return false;
    }
    numbers = labelIOList(io);
    return true;
}


//- Sum over the faces of each cell, and over the faces of the boundary
static vector sumOf
(
    const polyMesh& mesh,
    const labelUList& cells,
    const labelUList& faces,
    const labelUList& points
)
{
    const labelList& owner = mesh.faceOwner();
    const labelList& neighbour = mesh.faceNeighbour();
    vector sum(Zero);
    const auto add = [&](const label facei, const scalar factor)
    {
        for (const label pointi : mesh.faces()[facei])
        {
            sum += factor*weight(0, points[pointi])*mesh.points()[pointi];
        }
    };
    forAll(owner, facei)
    {
        const bool inner = mesh.isInternalFace(facei);
        add
        (
            facei,
            weight(1, cells[owner[facei]])
          + (inner ? weight(1, cells[neighbour[facei]]) : 0)
        );
    }
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        for (label i = 0; i < patch.size() && !patch.coupled(); ++i)
        {
            add(patch.start() + i, weight(2, faces[patch.start() + i]));
        }
    }
    return sum;
}


static string shown(const vector& value)
{
    OStringStream os;
    os.precision(6);
    os << value;
    return os.str();
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::meshNumbers::meshNumbers(const fvMesh& mesh)
:
    cells_(returnReduce(mesh.nCells(), sumOp<label>())),
    low_(mesh.bounds().min()),
    high_(mesh.bounds().max()),
    places_
    (
        sumOf
        (
            mesh, identity(mesh.nCells()), identity(mesh.nFaces()),
            identity(mesh.nPoints())
        )
    ),
    allPlaces_(places_),
    numbered_(true)
{
    if (!Pstream::parRun())
    {
        return;
    }
    labelList cells, faces, points;
    numbered_ = returnReduce
    (
        readNumbers(mesh, "cellProcAddressing", cells)
     && readNumbers(mesh, "faceProcAddressing", faces)
     && readNumbers(mesh, "pointProcAddressing", points)
     && cells.size() == mesh.nCells() && faces.size() == mesh.nFaces()
     && points.size() == mesh.nPoints(),
        andOp<bool>()
    );
    if (numbered_)
    {
        // Counted from 1, with the sign of their direction
        for (label& facei : faces)
        {
            facei = mag(facei) - 1;
        }
        allPlaces_ = returnReduce
        (
            sumOf(mesh, cells, faces, points), sumOp<vector>()
        );
    }
}


Foam::meshNumbers::meshNumbers(const dictionary& dict)
:
    cells_(dict.get<label>("cells")),
    low_(dict.get<vector>("low")),
    high_(dict.get<vector>("high")),
    places_(dict.get<vector>("places")),
    allPlaces_(dict.lookupOrDefault<vector>("allPlaces", Zero)),
    numbered_(dict.found("allPlaces"))
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::dictionary Foam::meshNumbers::dict() const
{
    dictionary result;
    result.add("cells", cells_);
    result.add("low", low_);
    result.add("high", high_);
    result.add("places", places_);
    if (numbered_)
    {
        result.add("allPlaces", allPlaces_);
    }
    return result;
}


Foam::string Foam::meshNumbers::difference
(
    const meshNumbers& before,
    const bool moved
) const
{
    if (cells_ != before.cells_)
    {
        return
            "it has " + Foam::name(cells_) + " cells, the other "
          + Foam::name(before.cells_);
    }
    const scalar most = rounding*mag(before.high_ - before.low_);
    if (mag(low_ - before.low_) > most || mag(high_ - before.high_) > most)
    {
        return
            "it reaches from " + shown(low_) + " to " + shown(high_)
          + " m, the other from " + shown(before.low_) + " to "
          + shown(before.high_);
    }
    // Rounding errors of the points add up like random numbers
    const scalar mostOfSums = most*std::sqrt(scalar(cells_));
    const bool same =
        moved
      ? (
            !numbered_ || !before.numbered_
         || mag(allPlaces_ - before.allPlaces_) <= mostOfSums
        )
      : mag(places_ - before.places_) <= mostOfSums;
    return
        returnReduce(same, andOp<bool>())
      ? string()
      : string("its cells, faces or points have other numbers or places");
}


// ************************************************************************* //
