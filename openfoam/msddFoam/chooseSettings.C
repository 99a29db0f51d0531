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

#include "chooseSettings.H"
#include "timeScheme.H"

#include <unistd.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Sub-dictionary msddFoam of system/fvSolution
static dictionary ownSettings(const Time& runTime)
{
    const IOdictionary solution
    (
        IOobject
        (
            "fvSolution", runTime.system(), runTime,
            IOobject::MUST_READ, IOobject::NO_WRITE, false
        )
    );
    return solution.subOrEmptyDict("msddFoam");
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::accuracyWanted(const Time& runTime)
{
    const dictionary own(ownSettings(runTime));
    const scalar accuracy = timeScheme::keys.number(own, "accuracy");
    if (accuracy > 0 && Pstream::parRun())
    {
        FatalIOErrorInFunction(own)
            << "Entry 'accuracy' is " << accuracy << ", allowed on several"
            << " processes: none. Run msddFoam once on one process; then"
            << " decompose and run the case that it has made, "
            << runTime.globalPath().name() << ".chosen" << exit(FatalIOError);
    }
    return accuracy;
}


void Foam::chooseSettings(const Time& runTime, caseLock& lock)
{
    const scalar accuracy = accuracyWanted(runTime);
    if (accuracy <= 0)
    {
        return;
    }
    const string path(runTime.path());
    lock.release();
    ::execlp
    (
        "msdd", "msdd", "case", "solve", path.c_str(), static_cast<char*>(0)
    );
    FatalIOErrorInFunction(ownSettings(runTime))
        << "Entry 'accuracy' is " << accuracy << ", and the program msdd, which"
        << " finds the settings for it, is not in the path: . scripts/foam-env,"
        << " after cargo build --release" << exit(FatalIOError);
}


// ************************************************************************* //
