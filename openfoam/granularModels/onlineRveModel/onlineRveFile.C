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

#include "onlineRveModel.H"
#include "foamVersions.H"
#include "wholeFile.H"
#include "Time.H"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- A line of a list without its comma
static std::string element(std::istream& is)
{
    std::string line;
    std::getline(is, line);
    if (!line.empty() && line.back() == ',')
    {
        line.pop_back();
    }
    return line;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Private Classes * * * * * * * * * * * * * * //

class Foam::granularModels::onlineRve::boxFile
:
    public regIOobject
{
    const onlineRve& model_;

public:

    boxFile(const onlineRve& model, const fvMesh& mesh)
    :
        regIOobject
        (
            IOobject
            (
                "onlineRve.json", mesh.time().timeName(), mesh,
                IOobject::NO_READ, IOobject::AUTO_WRITE
            )
        ),
        model_(model)
    {}

    virtual bool writeData(Ostream&) const override
    {
        return true;
    }

    virtual bool writeObject
    (
        MSDD_WRITE_PARAMETERS
    ) const override
    {
        const fileName folder(time().timePath()/db().dbDir());
        writeWhole(folder/name(), [&](std::ostream& os) { model_.write(os); });
        return true;
    }
};


// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

// Defined here because the destructor needs the definition of boxFile
Foam::granularModels::onlineRve::~onlineRve()
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::autoPtr<Foam::regIOobject> Foam::granularModels::onlineRve::file() const
{
    return autoPtr<regIOobject>(new boxFile(*this, mesh_));
}


std::string Foam::granularModels::onlineRve::header() const
{
    OStringStream os;
    os.precision(17);
    os  << "{\"schema\": \"msdd-online-rve-2\", \"rve_per\": \""
        << (shared_ ? "history" : "cell") << "\", \"strain_tolerance\": "
        << boxes_.tolerance() << ", \"cells\": " << mesh_.nCells()
        << ", \"boxes\": ";
    return os.str();
}


void Foam::granularModels::onlineRve::write(std::ostream& os) const
{
    const std::vector<rveHistory::node>& nodes = boxes_.nodes();
    char line[128];

    os << header() << nodes.size() << ", \"places\": [\n";
    for (size_t celli = 0; celli < places_.size(); ++celli)
    {
        const rveHistory::place& cell = places_[celli];
        std::snprintf
        (
            line, sizeof line, "%s[%ld, %.17g, %.17g]", celli ? ",\n" : "",
            long(cell.box), cell.remainder, solid_[celli]
        );
        os << line;
    }
    os << "\n], \"trees\": [\n";
    for (size_t i = 0; i < nodes.size(); ++i)
    {
        std::string text(nodes[i].box.grains->toJson());
        std::replace(text.begin(), text.end(), '\n', ' ');
        os << (i ? ",\n" : "") << '[' << nodes[i].parent << ", "
           << nodes[i].side << ", " << text << ']';
    }
    os << "\n]}\n";
}


bool Foam::granularModels::onlineRve::read()
{
    const Time& time = mesh_.time();
    const fileName path(time.timePath()/mesh_.dbDir()/"onlineRve.json");
    const bool found = isFile(path);

    if (!returnReduce(found, orOp<bool>()) && time.timeIndex() == 0)
    {
        return false;
    }
    if (!found)
    {
        FatalErrorInFunction
            << "File " << path << " is missing, with the boxes of grains from"
            << " which the run continues. Allowed: as many processes as wrote it"
            << exit(FatalError);
    }

    std::ifstream is(path);
    const std::string first(element(is)), wanted(header());
    if (first.compare(0, wanted.size(), wanted) != 0)
    {
        FatalErrorInFunction
            << "File " << path << " begins with '" << first
            << "', allowed: '" << wanted << "'" << exit(FatalError);
    }
    try
    {
        readPlaces(is);
        readTrees(is, std::stol(first.substr(wanted.size())));
    }
    catch (const std::exception& error)
    {
        FatalErrorInFunction
            << "File " << path << " is damaged: " << error.what()
            << exit(FatalError);
    }
    return true;
}


void Foam::granularModels::onlineRve::readPlaces(std::istream& is)
{
    for (label celli = 0; celli < mesh_.nCells(); ++celli)
    {
        long box = -1;
        double remainder = 0, solid = 0;
        const std::string line(element(is));
        if
        (
            std::sscanf(line.c_str(), "[%ld, %lf, %lf]", &box, &remainder, &solid)
         != 3
        )
        {
            throw std::runtime_error("no place: '" + line + "'");
        }
        places_.push_back(rveHistory::place{label(box), remainder});
        solid_.append(solid);
    }
    element(is);
}


void Foam::granularModels::onlineRve::readTrees
(
    std::istream& is,
    const long count
)
{
    for (long i = 0; i < count; ++i)
    {
        long parent = -1, side = 0;
        int at = 0;
        const std::string line(element(is));
        if
        (
            std::sscanf(line.c_str(), "[%ld, %ld, %n", &parent, &side, &at) != 2
         || at == 0 || parent >= i || side < 0 || side > 1
        )
        {
            throw std::runtime_error("no box: '" + line.substr(0, 40) + "'");
        }
        const size_t length = line.size() - size_t(at) - 1;
        boxes_.add(rveBox::read(line.substr(at, length)), parent, side);
    }
    for (const rveHistory::place& cell : places_)
    {
        if (cell.box < 0 || cell.box >= count)
        {
            throw std::runtime_error("no box " + std::to_string(cell.box));
        }
    }
}


// ************************************************************************* //
