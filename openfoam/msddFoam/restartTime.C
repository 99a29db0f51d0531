/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
     \\/     M anipulation  |
-------------------------------------------------------------------------------
License
    SPDX-License-Identifier: GPL-3.0-or-later

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty: see the file LICENSE.
\*---------------------------------------------------------------------------*/

#include "restartTime.H"
#include "runRecord.H"
#include "fileOperation.H"
#include "IFstream.H"
#include "OSspecific.H"
#include "Time.H"
#include "SortableList.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Gives access to Time's size of the last step, which has no public function
struct lastStep
:
    public Time
{
    using Time::deltaTSave_;
};

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::restartTime::restartTime(const argList& args, const bool dryRun)
:
    path_(args.path()),
    dryRun_(dryRun)
{
    if (fileHandler().type() != "uncollated")
    {
        FatalErrorInFunction
            << "File handler is '" << fileHandler().type()
            << "', allowed: uncollated. What belongs to a time is checked file"
            << " by file" << exit(FatalError);
    }
    const fileName control
    (
        args.rootPath()/args.globalCaseName()/"system"/Time::controlDictName
    );
    IFstream is(control);
    if (!is.good())
    {
        return;     // Time reports the missing file
    }
    const dictionary dict(is);
    const word from(dict.lookupOrDefault<word>("startFrom", "latestTime"));

    if (from == "latestTime")
    {
        takeLatest();
    }
    else if (from == "startTime")
    {
        checkStart(dict.get<scalar>("startTime"));
    }
    if (dict.lookupOrDefault<label>("purgeWrite", 0) == 1)
    {
        WarningInFunction
            << "Entry 'purgeWrite' in " << control << " is 1: the last complete"
            << " time is deleted a moment before the next is complete. With 2"
            << " there is always one from which a run can continue" << endl;
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::wordList Foam::restartTime::names() const
{
    List<wordList> found(Pstream::nProcs());
    for (const instant& time : TimePaths::findTimes(path_))
    {
        if (time.name() != "constant")
        {
            found[Pstream::myProcNo()].append(time.name());
        }
    }
    Pstream::gatherList(found);
    Pstream::scatterList(found);

    HashTable<scalar> values;
    for (const wordList& those : found)
    {
        for (const word& name : those)
        {
            values.insert(name, readScalar(name));
        }
    }
    wordList sorted(values.sortedToc());
    std::stable_sort
    (
        sorted.begin(),
        sorted.end(),
        [&](const word& a, const word& b) { return values[a] > values[b]; }
    );
    return sorted;
}


Foam::string Foam::restartTime::anyOf(const string& text)
{
    stringList all(Pstream::nProcs());
    all[Pstream::myProcNo()] = text;
    Pstream::gatherList(all);
    Pstream::scatterList(all);
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


Foam::restartTime::verdict Foam::restartTime::judge
(
    const word& name,
    string& reason
) const
{
    const timeFolder folder(path_/name);
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
        return verdict::good;
    }
    if (runRecord::accepted.found("files"))
    {
        return acceptAsItIs(name, folder, reason);
    }
    if (all(folder.hasRecord()) && any(!folder.hasList()))
    {
        reason = "it was written by a version that kept no list of files";
        return verdict::refused;
    }
    const bool moved = any(folder.hasRecord() && folder.redistributed());
    reason = anyOf(folder.missing());
    if (!reason.empty())
    {
        return moved && all(folder.hasRecord()) ? verdict::refused : verdict::bad;
    }
    if (moved)
    {
        Info<< "Time " << name << " was written by another number of processes:"
            << " all files are there, their checksums do not apply" << nl
            << endl;
        return verdict::good;
    }
    reason = anyOf(folder.changed());
    return reason.empty() ? verdict::good : verdict::bad;
}


Foam::restartTime::verdict Foam::restartTime::acceptAsItIs
(
    const word& name,
    const timeFolder& folder,
    string& reason
) const
{
    reason = anyOf(folder.holds("T") ? string() : string("T is missing"));
    if (!reason.empty())
    {
        return verdict::bad;
    }
    string lost(anyOf(folder.missing()));
    if (lost.empty())
    {
        lost = anyOf(folder.changed());
    }
    if (!lost.empty())
    {
        Info<< "Accepted: time " << name << " as it is. " << lost.c_str() << nl
            << endl;
    }
    return verdict::good;
}


void Foam::restartTime::setAside(const word& name) const
{
    const fileName from(path_/name);
    fileName to(from + ".incomplete");
    for (label i = 2; exists(to, false, false); ++i)
    {
        to = from + ".incomplete" + Foam::name(i);
    }
    if (isDir(from, false) && !mv(from, to))
    {
        FatalErrorInFunction
            << "Cannot rename " << from << " to " << to << exit(FatalError);
    }
}


void Foam::restartTime::takeLatest()
{
    const wordList times(names());
    DynamicList<word> skipped;
    string reason;

    for (const word& name : times)
    {
        const verdict what = judge(name, reason);
        if (what == verdict::good)
        {
            for (const word& newer : skipped)
            {
                taken_ = name;
                if (!dryRun_)
                {
                    setAside(newer);
                }
            }
            // Wait until all processes have renamed their folders
            returnReduce(true, andOp<bool>());
            return;
        }
        if (what == verdict::refused)
        {
            FatalErrorInFunction
                << "A run cannot continue from time " << name << " in " << path_
                << ": " << reason.c_str()
                << ". Allowed: another startTime; or msddFoam -accept files, to"
                << " take it as it is; files that are missing are then replaced"
                << " by initial values" << exit(FatalError);
        }
        Info<< "Time " << name << " is skipped: " << reason.c_str()
            << ". It " << (dryRun_ ? "would be" : "is") << " renamed to "
            << name << ".incomplete" << nl << endl;
        skipped.append(name);
    }
    if (times.size())
    {
        FatalErrorInFunction
            << "No time in " << path_ << " is complete; " << times[0] << ": "
            << reason.c_str() << exit(FatalError);
    }
}


void Foam::restartTime::checkStart(const scalar startTime) const
{
    const instantList times(TimePaths::findTimes(path_));
    const label i = TimePaths::findClosestTimeIndex(times, startTime);
    const word name
    (
        i >= 0 && mag(times[i].value() - startTime) <= 1e-6*mag(startTime)
      ? times[i].name()
      : word::null
    );
    if (!returnReduce(!name.empty(), andOp<bool>()))
    {
        return;     // reading the first missing field reports the error
    }
    string reason;
    if (judge(name, reason) != verdict::good)
    {
        FatalErrorInFunction
            << "Time " << name << " in " << path_
            << ", the startTime of controlDict, is not complete: "
            << reason.c_str() << ". Allowed: an earlier startTime; latestTime,"
            << " which takes the newest complete time; or msddFoam -accept"
            << " files, to take it as it is" << exit(FatalError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::restartTime::apply(Time& runTime) const
{
    if (dryRun_ && !taken_.empty())
    {
        // Time has taken the newest, which a run would have renamed before
        runTime.setTime(instant(readScalar(taken_), taken_), 0);
    }
    setValue(runTime);
}


// * * * * * * * * * * * * * Static Member Functions * * * * * * * * * * * * //

void Foam::restartTime::setValue(Time& runTime)
{
    const timeFolder folder(runTime.timePath());
    scalar value = 0;
    if
    (
        folder.hasRecord()
     && folder.record().readIfPresent("time", value)
     && Time::timeName(value) == runTime.timeName()
    )
    {
        runTime.value() = value;

        // In an adaptive run Time stores the size of the next step, not that
        // of the last one
        const scalar last =
            folder.record().lookupOrDefault<scalar>("lastDeltaT", 0);
        if (last > 0)
        {
            runTime.*(&lastStep::deltaTSave_) = last;
        }
    }
}


// ************************************************************************* //
