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

#include "timeVerdict.H"
#include "foamVersions.H"
#include "runRecord.H"
#include "PstreamReduceOps.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::string Foam::timeVerdict::anyOf(const string& text)
{
    stringList all(Pstream::nProcs());
    all[Pstream::myProcNo()] = text;
    Pstream::gatherList(all);
    fromMaster(all);
    forAll(all, i)
    {
        if (!all[i].empty())
        {
            return
                Pstream::parRun()
              ? "processor" + Foam::name(i) + ": " + all[i]
              : all[i];
        }
    }
    return string();
}


void Foam::timeVerdict::acceptAsItIs(const timeFolder& folder)
{
    reason = anyOf(folder.holdsT() ? string() : string("T is missing"));
    if (!reason.empty())
    {
        return;
    }
    what = good;
    string lost(anyOf(folder.missing()));
    if (lost.empty())
    {
        lost = anyOf(folder.changed());
    }
    if (!lost.empty())
    {
        runRecord::note
        (
            "Accepted: time " + folder.path().name() + " as it is. " + lost
          + "."
        );
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeVerdict::timeVerdict(const fileName& path, const fileName& region)
:
    what(cutShort)
{
    const timeFolder folder(path, region);
    const auto all = [](const bool mine)
    {
        return returnReduce(mine, andOp<bool>());
    };
    const auto any = [](const bool mine)
    {
        return returnReduce(mine, orOp<bool>());
    };

    if (all(folder.isStart()))
    {
        what = good;
        return;
    }
    if (runRecord::accepted.found("files"))
    {
        acceptAsItIs(folder);
        return;
    }
    const bool recorded = all(folder.hasRecord());
    if (recorded && any(!folder.hasList()))
    {
        what = refused;
        reason = "it was written by a version that kept no list of files";
        return;
    }
    const bool moved = any(folder.hasRecord() && folder.redistributed());
    reason = anyOf(folder.missing());
    if (!reason.empty())
    {
        what = moved && recorded ? refused : cutShort;
        return;
    }
    if (moved)
    {
        Info<< "Time " << path.name() << " was written by another number of"
            << " processes: all files are there, their checksums do not apply"
            << nl << endl;
        what = good;
        return;
    }
    reason = anyOf(folder.changed());
    what = reason.empty() ? good : refused;
}


// ************************************************************************* //
