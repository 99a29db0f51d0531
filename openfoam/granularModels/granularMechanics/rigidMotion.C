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

#include "rigidMotion.H"
#include "foamVersions.H"
#include "OStringStream.H"
#include "Pstream.H"

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

extern "C" void dsyev_
(
    const char* job,
    const char* half,
    const int* size,
    double* matrix,
    const int* rows,
    double* values,
    double* work,
    const int* workSize,
    int* error
);


void Foam::symmetricEigen(scalarField& matrix, scalarField& values)
{
    const int n = values.size(), room = 64*n;
    scalarField work(room);
    int error = 0;
    dsyev_
    (
        "V", "U", &n, matrix.data(), &n, values.data(), work.data(), &room,
        &error
    );
}


namespace Foam
{

//- Combine the lists of all processes, value by value
template<class Type, class Operation>
static void combine(List<Type>& values, const Operation& operation)
{
    Pstream::listCombineGather(values, operation);
    fromMaster(values);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rigidMotion::rigidMotion
(
    const elementMesh& mesh,
    const regionSplit& regions,
    const label pieces
)
:
    mesh_(mesh),
    pieces_(pieces),
    pieceOfNode_(mesh.size(), 0),
    centre_(pieces, vector(Zero)),
    size_(pieces, Zero),
    cells_(pieces, Zero),
    motions_(mesh.radial() >= 0 ? 1 : mesh.dim() == 3 ? 6 : 3),
    resistance_(pieces, scalarField(motions_*motions_, Zero))
{
    scalarField count(pieces, Zero);
    mesh_.each([&](const auto& e)
    {
        const label piece = regions[e.cell];
        ++cells_[piece];
        for (label a = 0; a < e.size(); ++a)
        {
            pieceOfNode_[e.nodes[a]] = piece;
            centre_[piece] += mesh_.vectorAt(mesh_.points(), e.nodes[a]);
            ++count[piece];
        }
    });
    combine(centre_, plusEqOp<vector>());
    combine(count, plusEqOp<scalar>());
    combine(cells_, plusEqOp<scalar>());
    forAll(centre_, piece)
    {
        centre_[piece] /= count[piece];
    }
    mesh_.each([&](const auto& e)
    {
        const label piece = regions[e.cell];
        for (label a = 0; a < e.size(); ++a)
        {
            size_[piece] = max
            (
                size_[piece],
                mag(mesh_.vectorAt(mesh_.points(), e.nodes[a]) - centre_[piece])
            );
        }
    });
    combine(size_, maxEqOp<scalar>());
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::rigidMotion::motion
(
    const label node,
    const scalar* direction,
    scalarField& along
) const
{
    if (mesh_.radial() >= 0)
    {
        along[0] = direction[1 - mesh_.radial()];
        return;
    }
    const label piece = pieceOfNode_[node];
    const vector x
    (
        (mesh_.vectorAt(mesh_.points(), node) - centre_[piece])/size_[piece]
    );
    const bool solid = mesh_.dim() == 3;
    const vector d(direction[0], direction[1], solid ? direction[2] : 0);
    const vector turn(x ^ d);
    if (solid)
    {
        for (label k = 0; k < 3; ++k)
        {
            along[k] = d[k];
            along[3 + k] = turn[k];
        }
    }
    else
    {
        along[0] = d.x();
        along[1] = d.y();
        along[2] = turn.z();
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::rigidMotion::hold(const label node, const scalar* direction)
{
    scalarField along(motions_);
    motion(node, direction, along);
    scalarField& sum = resistance_[pieceOfNode_[node]];
    for (label i = 0; i < motions_; ++i)
    {
        for (label j = 0; j < motions_; ++j)
        {
            sum[motions_*i + j] += along[i]*along[j];
        }
    }
}


Foam::string Foam::rigidMotion::free(const scalar share) const
{
    for (label piece = 0; piece < pieces_; ++piece)
    {
        scalarField sum(resistance_[piece]), values(motions_);
        combine(sum, plusEqOp<scalar>());
        symmetricEigen(sum, values);
        if (values[0] > share*max(values[motions_ - 1], VSMALL))
        {
            continue;
        }
        OStringStream text;
        text<< "A piece of the mesh of " << label(cells_[piece]) << " cells"
            << " around " << centre_[piece] << " can move as a whole, ";
        const label turns = motions_ == 6 ? 3 : 1;
        scalar turning = 0;
        for (label k = motions_ - turns; k < motions_ && motions_ > 1; ++k)
        {
            turning += sqr(sum[k]);
        }
        vector along(Zero);
        if (turning > 0.5)
        {
            text<< "turning";
        }
        else
        {
            for (label k = 0; k < motions_ - turns; ++k)
            {
                along[k] = sum[k];
            }
            if (motions_ == 1)
            {
                along = Zero;
                along[1 - mesh_.radial()] = 1;
            }
            text<< "along " << along;
        }
        text<< ": no wall holds it against that";
        return text.str();
    }
    return string();
}


// ************************************************************************* //
