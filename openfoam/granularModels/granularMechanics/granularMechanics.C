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

#include "granularMechanics.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(granularMechanics, 0);
    defineRunTimeSelectionTable(granularMechanics, dictionary);

namespace granularMechanicsModels
{
    //- Every cell keeps its stress and its place
    class none
    :
        public granularMechanics
    {
    public:

        TypeName("none");

        none(const granularProperties&, granularState& grains)
        :
            granularMechanics(grains)
        {
            grains.beginWherePlaced();
        }
    };

    defineTypeNameAndDebug(none, 0);
    addToRunTimeSelectionTable(granularMechanics, none, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularMechanics::granularMechanics(granularState& grains)
:
    grains_(grains),
    mesh_(grains.mesh())
{}


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::granularMechanics> Foam::granularMechanics::New
(
    const granularProperties& properties,
    granularState& grains
)
{
    const word type(properties.lookupOrDefault<word>("mechanics", "none"));
    const auto constructor = dictionaryConstructorTablePtr_->cfind(type);

    if (!constructor.found())
    {
        FatalIOErrorInFunction(properties)
            << "Entry 'mechanics' is '" << type << "', allowed: "
            << granularProperties::listed
               (
                   dictionaryConstructorTablePtr_->sortedToc()
               ).c_str()
            << exit(FatalIOError);
    }
    Info<< "Selecting granularMechanics " << type << endl;
    return (*constructor)(properties, grains);
}


// ************************************************************************* //
