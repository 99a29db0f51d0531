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

#include "printedWarnings.H"

#include <sstream>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Whether a line begins with a text
static bool begins(const std::string& line, const std::string& text)
{
    return line.compare(0, text.size(), text) == 0;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::printedWarnings::printedWarnings(std::ostream& stream)
:
    stream_(stream),
    to_(stream.rdbuf())
{
    stream_.rdbuf(this);
}


Foam::printedWarnings::~printedWarnings()
{
    stream_.rdbuf(to_);
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

int Foam::printedWarnings::overflow(int c)
{
    if (c == EOF)
    {
        return 0;
    }
    text_ += char(c);
    return to_->sputc(char(c));
}


int Foam::printedWarnings::sync()
{
    return to_->pubsync();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::DynamicList<Foam::string> Foam::printedWarnings::found() const
{
    // The lines of a warning are indented, but for the first
    static const std::string title("--> FOAM Warning : ");
    DynamicList<string> all;
    std::istringstream lines(text_);
    bool inside = false;
    for (std::string line; std::getline(lines, line); )
    {
        if (begins(line, title))
        {
            inside = true;
            all.append(line.substr(title.size()));
        }
        else if (!begins(line, " "))
        {
            inside = false;
        }
        else if
        (
            inside
         && !begins(line, "    From function")
         && !begins(line, "    in file")
        )
        {
            all.last() += ' ' + line;
        }
    }
    return all;
}


// ************************************************************************* //
