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

#include "temperatureFunction.H"
#include "Function1.H"
#include "ITstream.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::scalar Foam::temperatureFunction::usualTemperature = 293.15;


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Highest temperature at which functions are sampled [K]
static const label highest = 5000;

static const wordList& forms()
{
    static const wordList all
    ({
        "constant", "polynomial", "table", "tableFile", "csvFile"
    });
    return all;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::temperatureFunction::temperatureFunction
(
    const dictionary& dict,
    const keyTable& keys,
    const word& key,
    const dimensionSet& dims
)
:
    keys_(keys),
    usual_(key, dims, 0)
{
    const entry* given = dict.findEntry(key, keyType::LITERAL);
    if (given)
    {
        entry_.add(*given);
    }
    bool function = given && given->isDict();
    if (given && given->isStream())
    {
        const ITstream& tokens = given->stream();
        function =
            tokens.size() && tokens[0].isWord()
         && forms().found(tokens[0].wordToken());
    }
    if (function)
    {
        sample(dict);
        return;
    }
    if (!given)
    {
        usual_.value() = keys_.number(dict, key);
        return;
    }
    usual_ = dimensionedScalar(key, dims, dict);
    keys_.within(dict, key, usual_.value());
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::temperatureFunction::sample(const dictionary& dict)
{
    const word& key = usual_.name();
    if (dict.isDict(key))
    {
        const word form(dict.subDict(key).get<word>("type"));
        if (!forms().found(form))
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << key << "' is a function of type " << form
                << ", allowed: a number, or a function of the temperature of"
                << " type constant, polynomial, table, tableFile, csvFile"
                << exit(FatalIOError);
        }
    }
    const autoPtr<Function1<scalar>> f(Function1<scalar>::New(key, dict));
    values_.resize(highest + 1);
    integrals_.resize(highest + 1, Zero);
    forAll(values_, i)
    {
        values_[i] = f->value(i);
        if (i)
        {
            integrals_[i] = integrals_[i - 1] + 0.5*(values_[i - 1] + values_[i]);
        }
    }
    usual_.value() = value(usualTemperature);
}


void Foam::temperatureFunction::check(const scalar value, const scalar T) const
{
    if (value >= least_ && value <= most_)
    {
        return;
    }
    if (!keys_.allows(usual_.name(), value))
    {
        FatalErrorInFunction
            << "Entry '" << usual_.name() << "' of constant/granularProperties is "
            << value << " at " << T << " K, allowed: "
            << keys_.allowed(usual_.name()) << ", in units "
            << usual_.dimensions()
            << exit(FatalError);
    }
    least_ = min(least_, value);
    most_ = max(most_, value);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::temperatureFunction::value(const scalar T) const
{
    if (isNumber())
    {
        return usual_.value();
    }
    const scalar within = max(scalar(0), min(scalar(highest), T));
    const label i = min(label(within), highest - 1);
    const scalar value = values_[i] + (within - i)*(values_[i + 1] - values_[i]);
    check(value, T);
    return value;
}


Foam::tmp<Foam::scalarField>
Foam::temperatureFunction::value(const scalarField& T) const
{
    tmp<scalarField> result(tmp<scalarField>::New(T.size()));
    forAll(T, i)
    {
        result.ref()[i] = value(T[i]);
    }
    return result;
}


Foam::scalar Foam::temperatureFunction::equivalent(const scalar T) const
{
    if (isNumber())
    {
        return T;
    }
    const scalar within = max(scalar(0), min(scalar(highest), T));
    const label i = min(label(within), highest - 1);
    const scalar rest = within - i;
    const scalar integral =
        integrals_[i]
      + rest*(values_[i] + 0.5*rest*(values_[i + 1] - values_[i]))
      + (T - within)*(T > within ? values_.last() : values_.first());
    return integral/usual_.value();
}


Foam::tmp<Foam::scalarField>
Foam::temperatureFunction::equivalent(const scalarField& T) const
{
    tmp<scalarField> result(tmp<scalarField>::New(T));
    if (!isNumber())
    {
        forAll(T, i)
        {
            result.ref()[i] = equivalent(T[i]);
        }
    }
    return result;
}


// ************************************************************************* //
