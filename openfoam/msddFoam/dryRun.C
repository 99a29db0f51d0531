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

#include "dryRun.H"
#include "foamVersions.H"
#include "equilibriumSolver.H"
#include "OSspecific.H"

#include <unistd.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- How long a process with an error waits for the others [s], and how often it
//- looks for them [microseconds]
static const scalar patience = 5;
static const unsigned pause = 1000;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::dryRun::dryRun(const argList& args)
:
    args_(args),
    output_(std::cout),
    communicator_(newCommunicator()),
    broken_(false)
{
    FatalError.throwExceptions();
    FatalIOError.throwExceptions();
    // Some function objects make their files when they are made. The prefix is
    // below the case folder
    label id = pid();
    fromMaster(id);
    fileName folder(getEnv("TMPDIR"));
    if (!(folder.isAbsolute() && isDir(folder)))
    {
        folder = "/tmp";
    }
    scratch_ = folder/("msddFoam-dry-run-" + Foam::name(id));
    string up;
    for (label i = args.globalPath().components().size(); i > 0; --i)
    {
        up += "../";
    }
    functionObject::outputPrefix = word(up + scratch_.substr(1), false);
}


Foam::dryRun::~dryRun()
{
    functions_.clear();
    made_.clear();
    runTime_.clear();
    if (Pstream::master())
    {
        rmDir(scratch_, true);
    }
    UPstream::freeCommunicator(communicator_);
    FatalError.dontThrowExceptions();
    FatalIOError.dontThrowExceptions();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::dryRun::attempt(const std::function<void()>& make)
{
    string place, message;
    if (broken_)
    {
        return false;
    }
    try
    {
        make();
    }
    catch (const IOerror& err)
    {
        place = placeOf(err);
        message = tidy(err.message());
    }
    catch (const error& err)
    {
        message = tidy(err.message());
    }
    catch (const std::exception& err)
    {
        message = tidy(string(err.what()));
    }
    meet(place + message);
    return gather(place, message);
}


bool Foam::dryRun::attempt
(
    const std::function<void()>& make,
    const string& place,
    const stringList& names
)
{
    const label before = errors_.size();
    const bool made = attempt(make);
    for (label i = before; i < errors_.size(); ++i)
    {
        bool named = false;
        for (const string& name : names)
        {
            named = named || errors_[i].find(name) != string::npos;
        }
        errors_[i] = named ? errors_[i] : string(place + errors_[i]);
    }
    return made;
}


bool Foam::dryRun::gather(const string& place, const string& message)
{
    const auto gathered = [this](const string& mine)
    {
        stringList all(Pstream::nProcs());
        all[Pstream::myProcNo()] = mine;
        Pstream::gatherList(all, Pstream::msgType(), communicator_);
        fromMaster(all, communicator_);
        return all;
    };
    const stringList places(gathered(place)), messages(gathered(message));
    label failed = 0;
    forAll(messages, i)
    {
        failed += !messages[i].empty();
        // Processes have their own files, and copies without names
        if (messages.find(messages[i]) == i)
        {
            add(errors_, places[i] + messages[i]);
        }
    }
    broken_ = failed && failed < messages.size();
    return !failed;
}


void Foam::dryRun::meet(const string& mine)
{
    if (!Pstream::parRun())
    {
        return;
    }
    // The usual communicator may be in use by processes that wait for this one
    meeting all(communicator_);
    scalar waited = 0;
    while (!all.over())
    {
        ::usleep(pause);
        waited += 1e-6*pause;
        if (!mine.empty() && waited > patience)
        {
            add(errors_, mine);
            add
            (
                warnings_,
                "Only process " + Foam::name(Pstream::myProcNo()) + " has"
                " this error, and others wait for it: the rest of the case is"
                " not checked"
            );
            print();
            rmDir(scratch_, true);
            Pstream::exit(1);
        }
    }
}


Foam::string Foam::dryRun::tidy(const string& text) const
{
    string line(text);
    line.replaceAll(args_.globalPath() + "/", "");
    for (label i = 0; Pstream::parRun() && i < Pstream::nProcs(); ++i)
    {
        line.replaceAll("processor" + Foam::name(i) + "/../", "");
    }
    string words;
    std::istringstream all(line);
    for (std::string each; all >> each; )
    {
        words += (words.empty() ? "" : " ") + each;
    }
    return words;
}


Foam::string Foam::dryRun::placeOf(const IOerror& err) const
{
    const string file(tidy(err.ioFileName()));
    const label line = err.ioStartLineNumber();
    return
        file.empty() ? file
      : string(file + (line > 0 ? ", line " + Foam::name(line) : word()) + ": ");
}


void Foam::dryRun::add(DynamicList<string>& list, const string& text)
{
    if (!text.empty() && !list.found(text))
    {
        list.append(text);
    }
}


void Foam::dryRun::print() const
{
    const auto many = [](const label n, const char* what)
    {
        return Foam::name(n) + " " + what + (n == 1 ? "" : "s");
    };
    Sout<< nl << "Dry run: " << many(errors_.size(), "error").c_str() << ", "
        << many(warnings_.size(), "warning").c_str() << nl;
    forAll(errors_, i)
    {
        Sout<< "Error " << i + 1 << ": " << errors_[i].c_str() << nl;
    }
    forAll(warnings_, i)
    {
        Sout<< "Warning " << i + 1 << ": " << warnings_[i].c_str() << nl;
    }
    if (!left_.empty())
    {
        Sout<< "Not checked: turbulence and combustion models, and the equations"
            << " of the fluid regions (" << left_.c_str() << ')' << nl;
    }
    Sout<< endl;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

int Foam::dryRun::run()
{
    if (makeTime() && (hasRegionsAlone() ? makeRegions() : makeObjects()))
    {
        makeFunctions();
    }
    // Beds say at their end what they did, in front of the list
    functions_.clear();
    for (regionObjects& region : regions_)
    {
        if (broken_)
        {
            region.forgetThermo();
        }
    }
    regions_.clear();
    if (broken_)
    {
        add
        (
            warnings_,
            "Only some processes have the last error: the rest of the case is"
            " not checked"
        );
    }
    if (Pstream::master())
    {
        for (const string& text : output_.found())
        {
            add(warnings_, tidy(text));
        }
        print();
    }
    // The first process that ends with an error ends all
    returnReduce(true, andOp<bool>(), Pstream::msgType(), communicator_);
    return errors_.empty() ? 0 : 1;
}


int Foam::dryRun::main(const argList& args)
{
    const int status = dryRun(args).run();
    if (status)
    {
        // The end of argList would make the status 0
        equilibriumSolver::endPetsc();
        Pstream::exit(status);
    }
    return status;
}


// ************************************************************************* //
