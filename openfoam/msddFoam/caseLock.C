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


#include "caseLock.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "error.H"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- How often, and with which pause [microseconds], the lock is tried: processes
//- of a parallel run that was killed may need a moment to end
static const label tries = 50;
static const unsigned pause = 100000;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::caseLock::caseLock(const fileName& caseFolder)
:
    path_(caseFolder/"msddFoam.lock"),
    file_(-1)
{
    if (!Pstream::master())
    {
        return;
    }
    for (label i = 1; !take(); ++i)
    {
        const string other(holder());
        if (i == 1)
        {
            Info<< "Waiting up to " << tries*pause/1000000 << " s for "
                << other.c_str() << ", which computes this case" << nl << endl;
        }
        if (i == tries)
        {
            ::close(file_);
            file_ = -1;
            FatalErrorInFunction
                << "File " << path_ << " is locked by " << other.c_str()
                << ", which computes this case. Allowed: one solver at a time in"
                << " a case folder; wait until it has ended, or take a copy"
                << exit(FatalError);
        }
        ::close(file_);
        file_ = -1;
        ::usleep(pause);
    }
}


Foam::caseLock::~caseLock()
{
    release();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::caseLock::take()
{
    while (true)
    {
        file_ = ::open
        (
            path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666
        );
        if (file_ < 0)
        {
            // That of another user can be read and locked, though not written
            file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
        }
        if (file_ < 0)
        {
            Info<< "No lock on the case: cannot write " << path_ << ": "
                << std::strerror(errno) << nl << endl;
            return true;
        }
        if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
        {
            if (errno == EWOULDBLOCK)
            {
                return false;
            }
            Info<< "No lock on the case: cannot lock " << path_ << ": "
                << std::strerror(errno) << nl << endl;
            ::close(file_);
            file_ = -1;
            return true;
        }
        // The previous holder may have removed the file after it was opened
        // here. Then this lock is of no use, because others would make and lock
        // a new file: try again
        struct stat own, there;
        if
        (
            ::fstat(file_, &own) == 0
         && ::lstat(path_.c_str(), &there) == 0
         && own.st_dev == there.st_dev
         && own.st_ino == there.st_ino
        )
        {
            break;
        }
        ::close(file_);
        file_ = -1;
    }
    const std::string name
    (
        "process " + Foam::name(label(pid())) + " on " + hostName()
    );
    // Only for messages: that the file is locked does not depend on it
    const bool written =
        ::ftruncate(file_, 0) == 0
     && ::write(file_, name.data(), name.size()) == ssize_t(name.size());
    if (!written)
    {
        Info<< "Cannot write who has the lock to " << path_ << ": "
            << std::strerror(errno) << nl << endl;
    }
    return true;
}


Foam::string Foam::caseLock::holder() const
{
    char text[200];
    const ssize_t size = ::pread(file_, text, sizeof text, 0);
    return size > 0 ? string(std::string(text, size)) : "another process";
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::caseLock::release()
{
    if (file_ >= 0)
    {
        ::unlink(path_.c_str());
        ::close(file_);
        file_ = -1;
    }
}


// ************************************************************************* //
