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

#include "restartTime.H"
#include "foamVersions.H"
#include "runRecord.H"
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
    fromMaster(found);

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
        const timeVerdict verdict(path_/name);
        reason = verdict.reason;
        if (verdict.what == timeVerdict::good)
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
        if (verdict.what == timeVerdict::refused)
        {
            FatalErrorInFunction
                << "A run cannot continue from time " << name << " in " << path_
                << ": " << reason.c_str() << ". Allowed: "
                << runRecord::toAccept("files").c_str() << ", to take it as it"
                << " is now; files that are missing are then replaced by initial"
                << " values; or another startTime" << exit(FatalError);
        }
        runRecord::note
        (
            "Time " + name + " is skipped: " + reason + ". It "
          + (dryRun_ ? "would be" : "is") + " renamed to " + name + ".incomplete."
        );
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
    const timeVerdict verdict(path_/name);
    if (verdict.what != timeVerdict::good)
    {
        FatalErrorInFunction
            << "Time " << name << " in " << path_
            << ", the startTime of controlDict, "
            << (
                   verdict.what == timeVerdict::cutShort
                 ? "is not complete: "
                 : "cannot be taken: "
               )
            << verdict.reason.c_str() << ". Allowed: an earlier startTime;"
            << " latestTime, which takes the newest complete time; or "
            << runRecord::toAccept("files").c_str() << ", to take it as it is"
            << exit(FatalError);
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
