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

#include "contactForceFields.H"
#include "contactForces.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(contactForceFields, 0);
    addToRunTimeSelectionTable
    (
        functionObject,
        contactForceFields,
        dictionary
    );
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable contactForcesColumns
(
    "columns of contactForces",
    {
        {"force", "mean force of the contacts, mean over the volume", "N"},
        {
            "largest_force",
            "largest value of the force that one contact in a hundred exceeds,"
            " over the cells", "N"
        },
        {"largest_pressure", "Hertz's pressure of this force", "Pa"},
        {"x", "where it is", "m"},
        {"y", "the same", "m"},
        {"z", "the same", "m"}
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::contactForceFields::contactForceFields
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    granularFunctionObject(name, typeName, runTime, dict, contactForcesColumns)
{
    begin(dict);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::functionObjects::contactForceFields::writeField
(
    const word& name,
    const dimensionSet& dimensions,
    const scalarField& values
) const
{
    volScalarField field
    (
        IOobject
        (
            name, time_.timeName(), mesh_,
            IOobject::NO_READ, IOobject::NO_WRITE, false
        ),
        mesh_,
        dimensionedScalar(dimensions, Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    );
    field.primitiveFieldRef() = values;
    field.correctBoundaryConditions();
    field.write();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::contactForceFields::write()
{
    if (lacks({"pressure", "porosity", "coordination"}))
    {
        return true;
    }
    refresh();
    const granularProperties grains(mesh_);
    const scalar nu =
        grains.surrogateDict().subDict("spheresCoeffs")
       .get<scalar>("poissonRatio");
    const contactForces of
    (
        2*grains.meanRadius().value(),
        0.5*grains.youngModulus().value()/(1 - sqr(nu))
    );
    const tmp<volScalarField> p(present<scalar>("pressure"));
    const tmp<volScalarField> porosity(present<scalar>("porosity"));
    const tmp<volScalarField> contacts(present<scalar>("coordination"));
    scalarField force(mesh_.nCells()), pressure(mesh_.nCells());
    label worst = 0;
    forAll(force, celli)
    {
        force[celli] =
            of.mean(p()[celli], 1 - porosity()[celli], contacts()[celli]);
        pressure[celli] = of.hertz(contactForces::large*force[celli]);
        worst = force[celli] > force[worst] ? celli : worst;
    }
    typedef Tuple2<scalar, point> found;
    found most(-GREAT, point::zero);
    if (force.size())
    {
        most = found(contactForces::large*force[worst], mesh_.C()[worst]);
    }
    reduce
    (
        most,
        [](const found& a, const found& b)
        {
            return b.first() > a.first() ? b : a;
        }
    );
    const scalar mean =
        returnReduce(sum(mesh_.V()*force), sumOp<scalar>())
       /returnReduce(sum(mesh_.V().field()), sumOp<scalar>());
    if (Pstream::master())
    {
        const point& at = most.second();
        line()
            << tab << mean << tab << most.first() << tab << of.hertz(most.first())
            << tab << at.x() << tab << at.y() << tab << at.z() << endl;
    }
    if (time_.value() == 0)
    {
        // The folder 0 has the initial fields alone
        return true;
    }
    writeField("contactForce", dimForce, force);
    // A copy, since the operator takes a reference
    const scalar large = contactForces::large;
    writeField("largeContactForce", dimForce, large*force);
    writeField("contactPressure", dimPressure, pressure);
    return true;
}


// ************************************************************************* //
