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

Class
\*---------------------------------------------------------------------------*/

#include "runTables.H"
#include "wholeFile.H"
#include "functionObject.H"
#include "OSspecific.H"
#include "Time.H"

#include <climits>
#include <cstdlib>
#include <dirent.h>
#include <fstream>
#include <sstream>
#include <unistd.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Beginning of the line of a part of the run
static const std::string partBegins("    {\"start\": ");

//- Paths of the files that this process has open
static DynamicList<fileName> openFiles()
{
    DynamicList<fileName> found;
    const std::string all("/proc/self/fd/");
    DIR* folder = ::opendir(all.c_str());
    while (const dirent* entry = folder ? ::readdir(folder) : nullptr)
    {
        char path[PATH_MAX];
        const ssize_t size =
            ::readlink((all + entry->d_name).c_str(), path, sizeof path);
        if (size > 0)
        {
            found.append(fileName(std::string(path, size), false));
        }
    }
    if (folder)
    {
        ::closedir(folder);
    }
    return found;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::runTables::runTables(const Time& time, const bool anew)
:
    folder_(time.globalPath()/functionObject::outputPrefix),
    start_(time.timeName()),
    active_(Pstream::master() && !functionObject::postProcess),
    written_(false)
{
    if (active_ && !anew)
    {
        active_ = readBefore() || !isDir(folder_);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::runTables::readBefore()
{
    std::ifstream is(folder_/"msddFoam/tables.json");
    const scalar start = readScalar(start_);
    std::string line;
    while (std::getline(is, line))
    {
        if (line.compare(0, partBegins.size(), partBegins) == 0)
        {
            const scalar of = std::atof(line.c_str() + partBegins.size());
            if (of < start)
            {
                before_.append(line.substr(0, line.rfind('}') + 1));
            }
        }
    }
    return is.is_open();
}


void Foam::runTables::write() const
{
    std::ostringstream text;
    text<< "{\n  \"schema\": \"msdd-tables-1\",\n  \"runs\": [\n";
    for (const string& part : before_)
    {
        text<< part << ",\n";
    }
    text<< partBegins << start_ << ", \"files\": [";
    const char* comma = "";
    for (const fileName& file : files_.sortedToc())
    {
        text<< comma << '"' << file << '"';
        comma = ", ";
    }
    text<< "]}\n  ]\n}\n";
    writeWhole
    (
        folder_/"msddFoam/tables.json",
        [&](std::ostream& os) { os << text.str(); }
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::runTables::update()
{
    if (!active_)
    {
        return;
    }
    // As the system has it, which follows symbolic links
    char real[PATH_MAX];
    const std::string below
    (
        std::string(::realpath(folder_.c_str(), real) ? real : "") + "/"
    );
    const label count = files_.size();
    for (const fileName& file : openFiles())
    {
        if (below.size() > 1 && file.compare(0, below.size(), below) == 0)
        {
            files_.insert(fileName(file.substr(below.size()), false));
        }
    }
    if (!written_ || files_.size() > count)
    {
        write();
        written_ = true;
    }
}


// ************************************************************************* //
