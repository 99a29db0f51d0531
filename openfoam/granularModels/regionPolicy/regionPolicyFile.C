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

#include "regionPolicy.H"
#include "foamVersions.H"
#include "functionObject.H"
#include "wholeFile.H"
#include "Time.H"

#include <sstream>

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::regionPolicy::write() const
{
    OStringStream rows;
    rows.precision(10);
    for (const offender& row : offenders_)
    {
        rows<< ",\n  {\"state\": [";
        forAll(row.state, k)
        {
            rows<< (k ? ", " : "") << row.state[k];
        }
        rows<< "], \"strain\": " << row.strain
            << ", \"side\": \"" << (row.distance > 0 ? "above" : "below")
            << "\", \"column\": \"" << columns_[row.column]
            << "\", \"distance\": " << mag(row.distance)
            << ", \"cell\": " << row.cell << ", \"time\": " << row.time << '}';
    }
    List<string> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = rows.str();
    Pstream::gatherList(all);

    string text;
    for (const string& part : all)
    {
        text += part;
    }
    if (!Pstream::master() || text.empty())
    {
        return;
    }

    const auto write = [&](std::ostream& os)
    {
        os  << "{\"schema\": \"msdd-offenders-1\", \"model_hash\": \""
            << hash_.c_str() << "\",\n \"state_names\": [";
        for (label k = 0; k < names_.size() - 1; ++k)
        {
            os  << (k ? ", \"" : "\"") << columns_[k] << '"';
        }
        os  << "],\n \"rows\": [" << text.substr(1).c_str() << "\n]}\n";
    };
    writeWhole(path(mesh_), write);
}


Foam::fileName Foam::regionPolicy::path(const fvMesh& mesh)
{
    return
        mesh.time().globalPath()/functionObject::outputPrefix/"msddFoam"
       /mesh.dbDir()/"offenders.json";
}


// ************************************************************************* //
