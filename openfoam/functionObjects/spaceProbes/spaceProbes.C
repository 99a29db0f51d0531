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

#include "spaceProbes.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(spaceProbes, 0);
    addToRunTimeSelectionTable(functionObject, spaceProbes, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable spaceProbesKeys
(
    "spaceProbes",
    {
        {"field", "the scalar field", "-", "a scalar field", "required"},
        {
            "probeLocations",
            "the points; one outside of the domain gets the largest number that"
            " can be written", "m", "a list of points", "required"
        }
    }
);

static const keyTable spaceProbesColumns
(
    "columns of spaceProbes",
    {
        {
            "<field><number>",
            "value at each point, which is fixed in space while the grains move",
            "of the field; stresses compression positive"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::spaceProbes::spaceProbes
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    granularFunctionObject(name, typeName, runTime, dict, spaceProbesColumns),
    field_(spaceProbesKeys.value<word>(dict, "field")),
    points_(spaceProbesKeys.value<pointField>(dict, "probeLocations"))
{
    begin(dict);
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

void Foam::functionObjects::spaceProbes::writeHead(Ostream& os) const
{
    spaceProbesColumns.explain(os);
    forAll(points_, i)
    {
        writeHeaderValue(os, "Probe " + Foam::name(i), points_[i]);
    }
    writeCommented(os, "Time");
    forAll(points_, i)
    {
        writeTabbed(os, field_ + Foam::name(i));
    }
}


template<class Type>
Type Foam::functionObjects::spaceProbes::at
(
    const interpolationCellPoint<Type>& field,
    const point& where
) const
{
    const label celli = mesh_.findCell(where);
    const label owner =
        returnReduce(celli >= 0 ? Pstream::myProcNo() : -1, maxOp<label>());
    Type value(Zero);
    if (owner == Pstream::myProcNo())
    {
        value = field.interpolate(where, celli);
    }
    return owner < 0 ? pTraits<Type>::max : returnReduce(value, sumOp<Type>());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::spaceProbes::write()
{
    if (lacks({field_}))
    {
        return true;
    }
    refresh();
    const tmp<volScalarField> tfield(present<scalar>(field_));
    const interpolationCellPoint<scalar> field(tfield());
    autoPtr<interpolationCellPoint<vector>> D;
    scalarList values(points_.size());

    if (mesh_.foundObject<volVectorField>("D"))
    {
        D.reset
        (
            new interpolationCellPoint<vector>
            (
                mesh_.lookupObject<volVectorField>("D")
            )
        );
    }
    forAll(points_, i)
    {
        point X(points_[i]);
        // Solve X = x - D(X) by fixed-point iteration, which converges since
        // the strains, the gradient of D, are some per cent
        for (label iteration = 0; D.valid() && iteration < 10; ++iteration)
        {
            X = points_[i] - at(D(), X);
        }
        values[i] = at(field, X);
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
