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

#include "equilibrium.H"
#include "addToRunTimeSelectionTable.H"
#include "extrapolatedCalculatedFvPatchFields.H"

#include <cmath>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularMechanicsModels::equilibrium::readNodes
(
    const pointVectorField& from,
    nodeField& to
) const
{
    const label dim = nodes_.dim();
    forAll(nodes_.front(), node)
    {
        const label pointi = nodes_.front()[node];
        const FixedList<vector, 3> along(directions(pointi));
        for (label k = 0; k < dim; ++k)
        {
            to[dim*node + k] = from[pointi] & along[k];
        }
    }
}


void Foam::granularMechanicsModels::equilibrium::writeNodes
(
    const nodeField& from,
    pointVectorField& to
) const
{
    const label dim = nodes_.dim();
    vectorField& values = to.primitiveFieldRef();
    for (const labelList* points : {&nodes_.front(), &nodes_.back()})
    {
        forAll(*points, node)
        {
            const label pointi = (*points)[node];
            const FixedList<vector, 3> along(directions(pointi));
            values[pointi] = Zero;
            for (label k = 0; k < dim; ++k)
            {
                values[pointi] += from[dim*node + k]*along[k];
            }
        }
    }
}


void Foam::granularMechanicsModels::equilibrium::makeFrictionFields()
{
    const auto make = [this](const word& name, const dimensionSet& dims)
    {
        return new pointVectorField
        (
            io(name, read_),
            pointMesh::New(mesh_),
            dimensionedVector(dims, Zero)
        );
    };
    typedef wallConditions::side side;
    forAll(wallTractions_, i)
    {
        // That of walls which hold also shows where there is none
        if (side(i) == side::held || walls_.rough(side(i)))
        {
            wallTractions_.set
            (
                i, make(wallConditions::tractionNames[i], dimPressure)
            );
        }
    }
    if (walls_.shellsSlide())
    {
        shellMotion_.reset(make("shellMotion", dimLength));
    }
    readFriction();
}


void Foam::granularMechanicsModels::equilibrium::readFriction()
{
    typedef wallConditions::side side;
    nodeField values(u_.size(), Zero);
    forAll(wallTractions_, i)
    {
        if (wallTractions_.set(i))
        {
            readNodes(wallTractions_[i], values);
            walls_.fromNodes(side(i), values, traction_);
        }
    }
    if (shellMotion_.valid())
    {
        readNodes(shellMotion_(), values);
        walls_.fromNodes(side::shell, values, shellSlide_);
    }
}


void Foam::granularMechanicsModels::equilibrium::writeFriction()
{
    typedef wallConditions::side side;
    nodeField values(u_.size(), Zero);
    forAll(wallTractions_, i)
    {
        if (wallTractions_.set(i))
        {
            walls_.toNodes(side(i), traction_, values);
            writeNodes(values, wallTractions_[i]);
        }
    }
    if (shellMotion_.valid())
    {
        walls_.toNodes(side::shell, shellSlide_, values);
        writeNodes(values, shellMotion_());
    }
}


// ************************************************************************* //
