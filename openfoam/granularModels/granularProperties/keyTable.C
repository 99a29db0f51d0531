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


#include "keyTable.H"
#include "granularProperties.H"
#include "IOmanip.H"

#include <cctype>
#include <cstdlib>
#include <sstream>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Letters to insert, remove or replace to make one word of another, without
//- regard to capitals
static label editDistance(const std::string& a, const std::string& b)
{
    labelList row(identity(b.size() + 1));
    for (std::string::size_type i = 1; i <= a.size(); ++i)
    {
        label before = row[0];
        row[0] = i;
        for (std::string::size_type j = 1; j <= b.size(); ++j)
        {
            const label replaced =
                before + (std::tolower(a[i - 1]) != std::tolower(b[j - 1]));
            before = row[j];
            row[j] = min(replaced, 1 + min(row[j], row[j - 1]));
        }
    }
    return row.last();
}


//- ". Is 'key' meant?" with the key that is most like a word; empty if none is
static string nearest(const word& given, const wordList& allowed)
{
    label least = 2 + given.size()/4;
    string text;
    for (const word& each : allowed)
    {
        const label distance = editDistance(given, each);
        if (distance < least)
        {
            least = distance;
            text = ". Is '" + each + "' meant?";
        }
    }
    return text;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::keyTable::keyTable(const char*, std::initializer_list<entry> entries)
:
    entries_(entries)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

const Foam::keyTable::entry& Foam::keyTable::find(const word& name) const
{
    for (const entry& each : entries_)
    {
        if (name == each.name)
        {
            return each;
        }
    }
    FatalErrorInFunction
        << "The table of keys that begins with '" << entries_[0].name
        << "' has no '" << name << "'" << exit(FatalError);
    return entries_[0];
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::keyTable::range Foam::keyTable::limits
(
    const word& key,
    const scalar scale,
    const scalar least
) const
{
    const std::string text(find(key).allowed);
    range result;
    const bool above = text[0] == '>';
    const std::size_t to = text.find(" to ");
    if (above)
    {
        result.open = text[1] != '=';
    }
    else if (to == std::string::npos)
    {
        return result;
    }
    else
    {
        result.high = scale*std::strtod(text.c_str() + to + 4, nullptr);
    }
    const char* low = text.c_str() + (above ? 2 - result.open : 0);
    result.low = max(least, scale*std::strtod(low, nullptr));
    return result;
}


Foam::wordList Foam::keyTable::names() const
{
    wordList result;
    for (const entry& each : entries_)
    {
        result.append(each.name);
    }
    return result;
}


bool Foam::keyTable::allows(const word& key, const scalar value) const
{
    return limits(key, 1, -VGREAT).holds(value);
}


Foam::scalar Foam::keyTable::usual(const word& key) const
{
    return std::strtod(find(key).usual, nullptr);
}


void Foam::keyTable::check
(
    const dictionary& dict,
    const wordList& others
) const
{
    wordList allowed;
    for (const entry& each : entries_)
    {
        allowed.append(each.name);
    }
    for (const word& other : others)
    {
        if (!allowed.found(other))
        {
            allowed.append(other);
        }
    }
    for (const word& key : dict.toc())
    {
        if (!allowed.found(key) && key != "FoamFile")
        {
            FatalIOErrorInFunction(dict)
                << "Unknown entry '" << key << "', allowed: "
                << granularProperties::listed(allowed).c_str()
                << nearest(key, allowed).c_str() << exit(FatalIOError);
        }
    }
}


void Foam::keyTable::explain(Ostream& os) const
{
    for (const entry& column : entries_)
    {
        // The width of a column of the file would apply to the first text
        os  << setw(1) << "#" << ' ' << column.name << ": " << column.meaning
            << " [" << column.unit << ']' << nl;
    }
}


Foam::scalar Foam::keyTable::number
(
    const dictionary& dict,
    const word& key
) const
{
    const bool required = std::string(find(key).usual) == "required";
    const scalar value =
        required ? dict.get<scalar>(key)
      : dict.getOrDefault<scalar>(key, usual(key));
    return within(dict, key, value);
}


Foam::scalar Foam::keyTable::number
(
    const dictionary& dict,
    const word& key,
    const scalar usual,
    const scalar scale,
    const scalar least
) const
{
    return within
    (
        dict, key, dict.getOrDefault<scalar>(key, usual), scale, least
    );
}


Foam::scalar Foam::keyTable::within
(
    const dictionary& dict,
    const word& key,
    const scalar value,
    const scalar scale,
    const scalar least
) const
{
    const range limits(this->limits(key, scale, least));
    if (limits.holds(value))
    {
        return value;
    }
    // OpenFOAM's streams would print the limits with all digits of the case's
    // writePrecision
    std::ostringstream text;
    if (limits.high == VGREAT)
    {
        text << (limits.open ? "> " : ">= ") << limits.low;
    }
    else
    {
        text << limits.low << " to " << limits.high;
    }
    const std::string unit(find(key).unit);
    if (unit != "-")
    {
        text << " [" << unit << ']';
    }
    FatalIOErrorInFunction(dict)
        << "Entry '" << key << "' is " << value << ", allowed: "
        << text.str().c_str() << exit(FatalIOError);
    return value;
}


Foam::word Foam::keyTable::choice(const dictionary& dict, const word& key) const
{
    return choice(dict, key, find(key).usual);
}


Foam::word Foam::keyTable::choice
(
    const dictionary& dict,
    const word& key,
    const word& usual
) const
{
    const word value(dict.getOrDefault<word>(key, usual));
    const string allowed(find(key).allowed);
    if ((", " + allowed + ',').find(", " + value + ',') == std::string::npos)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is '" << value << "', allowed: "
            << allowed.c_str() << exit(FatalIOError);
    }
    return value;
}


// ************************************************************************* //
