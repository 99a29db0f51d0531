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
#include "sphereEstimates.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::sceneWarnings::checkCompared()
{
    for (const string& part : grains_.record().course.beyond())
    {
        add
        (
            "Beyond what the model was compared with: " + part + ". Nothing is"
            " known of the model's error there"
        );
    }
}


void Foam::sceneWarnings::checkSpheres()
{
    if (!grains_.model().spatial())
    {
        return;
    }
    const runCourse& course = grains_.record().course;
    const sphereEstimates estimates(properties_, grains_);
    const string radiation
    (
        estimates.radiation(course.values(runCourse::temperature).most)
    );
    if (!radiation.empty())
    {
        add(radiation);
    }
    const sphereEstimates::contacts contacts
    (
        estimates.forces(course.values(runCourse::pressure).most)
    );
    if (contacts.beyond)
    {
        add("Contacts: " + contacts.text);
    }
}


void Foam::sceneWarnings::checkCells()
{
    const Vector<label>& solved = mesh_.geometricD();
    const scalar diameter = 2*properties_.meanRadius().value();
    scalar least = GREAT;
    label small = 0;
    forAll(mesh_.cells(), celli)
    {
        const boundBox box
        (
            mesh_.points(), mesh_.cellPoints()[celli], false
        );
        scalar size = GREAT;
        for (direction i = 0; i < vector::nComponents; ++i)
        {
            size = solved[i] > 0 ? min(size, box.span()[i]) : size;
        }
        small += size < diameter;
        least = min(least, size);
    }
    reduce(small, sumOp<label>());
    reduce(least, minOp<scalar>());
    if (small)
    {
        const label cells = returnReduce(mesh_.nCells(), sumOp<label>());
        add
        (
            brief(100*scalar(small)/cells) + " % of the cells are thinner than a"
            " grain, the thinnest " + brief(least/diameter) + " diameters: what"
            " varies over less than a grain is no average over grains"
        );
    }
}


// ************************************************************************* //
