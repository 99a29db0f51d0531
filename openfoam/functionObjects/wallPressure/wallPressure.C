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

#include "wallPressure.H"
#include "addToRunTimeSelectionTable.H"
#include "wallFvPatch.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(wallPressure, 0);
    addToRunTimeSelectionTable(functionObject, wallPressure, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::wallPressure::wallPressure
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    granularFunctionObject(name, typeName, runTime, dict)
{
    read(dict);
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

void Foam::functionObjects::wallPressure::writeHeader(Ostream& os) const
{
    writeCommented(os, "Time");
    writeTabbed(os, "domain");
    for (const fvPatch& patch : mesh_.boundary())
    {
        if (isA<wallFvPatch>(patch))
        {
            writeTabbed(os, patch.name() + "_pressure");
            writeTabbed(os, patch.name() + "_normal");
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::wallPressure::write()
{
    refresh();
    const tmp<volScalarField> tpressure(present<scalar>("pressure"));
    const tmp<volSymmTensorField> tstress(present<symmTensor>("stress"));

    scalarList values(1, tpressure().weightedAverage(mesh_.V()).value());
    for (const fvPatch& patch : mesh_.boundary())
    {
        if (!isA<wallFvPatch>(patch))
        {
            continue;
        }
        const vectorField n(patch.nf());
        const labelUList& cells = patch.faceCells();
        scalar area = 0, pressure = 0, normal = 0;
        forAll(cells, facei)
        {
            const scalar A = patch.magSf()[facei];
            area += A;
            pressure += A*tpressure()[cells[facei]];
            normal -= A*(n[facei] & tstress()[cells[facei]] & n[facei]);
        }
        reduce(area, sumOp<scalar>());
        values.append(returnReduce(pressure, sumOp<scalar>())/area);
        values.append(returnReduce(normal, sumOp<scalar>())/area);
    }

    if (Pstream::master())
    {
        Ostream& os = line();
        for (const scalar value : values)
        {
            os  << tab << value;
        }
        os  << endl;
    }
    return true;
}


// ************************************************************************* //
