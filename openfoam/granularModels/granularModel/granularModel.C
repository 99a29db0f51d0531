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

#include "granularModel.H"
#include "msdd.hpp"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(granularModel, 0);
    defineRunTimeSelectionTable(granularModel, dictionary);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModel::granularModel
(
    const word& type,
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    properties_(properties),
    mesh_(mesh),
    coeffs_(properties.surrogateDict().optionalSubDict(type + "Coeffs")),
    stateNames_({"porosity", "fabricIndex"}),
    columnNames_({"porosity", "fabric_index"})
{}


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::granularModel> Foam::granularModel::New
(
    const granularProperties& properties,
    const fvMesh& mesh
)
{
    const dictionary& dict = properties.surrogateDict();
    const word type(dict.get<word>("type"));
    const wordList types(dictionaryConstructorTablePtr_->sortedToc());

    wordList coeffs(types);
    for (word& name : coeffs)
    {
        name += "Coeffs";
    }
    granularProperties::surrogateKeys.check(dict, coeffs);

    const auto constructor = dictionaryConstructorTablePtr_->cfind(type);
    if (!constructor.found())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'type' is '" << type << "', allowed: "
            << granularProperties::listed(types).c_str() << exit(FatalIOError);
    }
    Info<< "Selecting granularModel " << type << endl;
    autoPtr<granularModel> model((*constructor)(properties, mesh));
    if (!model->followsTemperature() && !properties.conductivityFunction().isNumber())
    {
        FatalIOErrorInFunction(properties)
            << "Entry 'thermalConductivity' is a function of the temperature,"
            << " allowed with surrogate type " << type << ": a number"
            << exit(FatalIOError);
    }
    return model;
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

Foam::word Foam::granularModel::fieldName(const std::string& column)
{
    word name;
    bool capital = false;
    for (const char c : column)
    {
        if (c != '_')
        {
            name += capital ? char(std::toupper(c)) : c;
        }
        capital = (c == '_');
    }
    return name;
}


void Foam::granularModel::checkCoeffs(const keyTable& keys) const
{
    if (&coeffs_ != &properties_.surrogateDict())
    {
        keys.check(coeffs_);
    }
}


void Foam::granularModel::checkHash
(
    const fileName& source,
    const std::string& hash
) const
{
    string wanted;
    if
    (
        coeffs_.readIfPresent("hash", wanted) && !wanted.empty()
     && wanted != hash
    )
    {
        FatalIOErrorInFunction(coeffs_)
            << "Entry 'hash' is " << wanted << " but model " << source
            << " has the hash " << hash << exit(FatalIOError);
    }
}


void Foam::granularModel::refuse
(
    const word& key,
    const string& value,
    const string& allowed
) const
{
    FatalIOErrorInFunction(coeffs_)
        << "Entry '" << key << "' is " << value.c_str() << ", allowed: "
        << allowed.c_str() << exit(FatalIOError);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::List<Foam::direction>& Foam::granularModel::order() const
{
    typedef symmTensor t;
    static const List<direction> plane({t::XX, t::YY, t::XY});
    static const List<direction> space
    ({
        t::XX, t::YY, t::ZZ, t::XY, t::XZ, t::YZ
    });
    return isThreeDimensional() ? space : plane;
}


std::string Foam::granularModel::libraryVersion()
{
    return msdd::version();
}


// ************************************************************************* //
