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

#include "wallPressure.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(wallPressure, 0);
    addToRunTimeSelectionTable(functionObject, wallPressure, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable wallPressureColumns
(
    "columns of wallPressure",
    {
        {
            "domain",
            "pressure, mean over the volume of the bed (Eq. 11 of the paper,"
            " which calls it wall pressure); compression positive", "Pa"
        },
        {
            "<patch>_pressure",
            "pressure in the cells at the patch, mean over its area; pressure is"
            " the mean of xx and yy (discs) or of xx, yy and zz (spheres)", "Pa"
        },
        {
            "<patch>_normal",
            "stress across the patch, n.stress.n with its normal n, in the same"
            " cells", "Pa"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::wallPressure::wallPressure
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    granularFunctionObject(name, typeName, runTime, dict, wallPressureColumns)
{
    for (const fvPatch& patch : mesh_.boundary())
    {
        if (!polyPatch::constraintType(patch.patch().type()))
        {
            walls_.append(patch.index());
        }
    }
    begin(dict);
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

void Foam::functionObjects::wallPressure::writeHead(Ostream& os) const
{
    wallPressureColumns.explain(os);
    writeCommented(os, "Time");
    writeTabbed(os, "domain");
    for (const label patchi : walls_)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        writeTabbed(os, patch.name() + "_pressure");
        writeTabbed(os, patch.name() + "_normal");
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::wallPressure::write()
{
    if (lacks({"pressure", "stress"}))
    {
        return true;
    }
    refresh();
    const tmp<volScalarField> tpressure(present<scalar>("pressure"));
    const tmp<volSymmTensorField> tstress(present<symmTensor>("stress"));

    const scalar mean = tpressure().weightedAverage(mesh_.V()).value();

    // For each wall: area, pressure times area, normal stress times area
    List<vector> sums;
    for (const label patchi : walls_)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const vectorField n(patch.nf());
        const labelUList& cells = patch.faceCells();
        vector sum(Zero);
        forAll(cells, facei)
        {
            const scalar A = patch.magSf()[facei];
            sum.x() += A;
            sum.y() += A*tpressure()[cells[facei]];
            sum.z() -= A*(n[facei] & tstress()[cells[facei]] & n[facei]);
        }
        sums.append(sum);
    }
    Pstream::listCombineGather(sums, plusEqOp<vector>());

    if (Pstream::master())
    {
        Ostream& os = line();
        os  << tab << mean;
        for (const vector& sum : sums)
        {
            const scalar area = max(sum.x(), VSMALL);
            os  << tab << sum.y()/area << tab << sum.z()/area;
        }
        os  << endl;
    }
    return true;
}


// ************************************************************************* //
