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

#include "stepWatch.H"
#include "Pstream.H"

#include <chrono>
#include <csignal>
#include <cstdio>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

std::atomic<const char*> Foam::stepWatch::doing_("the start");


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::stepWatch::stepWatch(const double limit)
:
    limit_(limit),
    steps_(0),
    ended_(false)
{
    if (limit_ <= 0 || !Pstream::parRun())
    {
        return;
    }
    // Block all signals in this thread: the solver's thread handles them
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this]() { watch(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}


Foam::stepWatch::~stepWatch()
{
    if (thread_.joinable())
    {
        {
            std::lock_guard<std::mutex> lock(mutex_);
            ended_ = true;
        }
        changed_.notify_one();
        thread_.join();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::stepWatch::watch()
{
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ended_)
    {
        const long seen = steps_;
        double waited = 0, wait = limit_;
        const auto moved = [&]() { return ended_ || steps_ != seen; };
        while
        (
            !changed_.wait_for
            (
                lock, std::chrono::duration<double>(wait), moved
            )
        )
        {
            waited += wait;
            say(waited);
            wait = waited;
        }
    }
}


void Foam::stepWatch::say(const double waited) const
{
    std::fprintf
    (
        stderr,
        "msddFoam: process %d of %d has not finished a step for %g s; it is at"
        " %s. Either this takes long, or it waits for another process: look for"
        " one that prints no such message, or names something else.\n",
        int(Pstream::myProcNo()),
        int(Pstream::nProcs()),
        waited,
        doing_.load(std::memory_order_relaxed)
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::stepWatch::finished()
{
    doing("what comes between two steps");
    if (thread_.joinable())
    {
        {
            std::lock_guard<std::mutex> lock(mutex_);
            ++steps_;
        }
        changed_.notify_one();
    }
}


// ************************************************************************* //
