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

#include "wholeFile.H"
#include "OSspecific.H"
#include "error.H"

#include <cerrno>
#include <cstring>
#include <fstream>

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::writeWhole
(
    const fileName& path,
    const std::function<void(std::ostream&)>& write
)
{
    mkDir(path.path());
    const fileName beside(path + ".part");
    errno = 0;
    std::ofstream os(beside, std::ios::binary | std::ios::trunc);
    write(os);
    os.close();
    if (!os || !mv(beside, path))
    {
        const std::string problem(std::strerror(errno));
        rm(beside);
        FatalErrorInFunction
            << "Cannot write " << path << ": " << problem.c_str()
            << ". A restart takes the last time that is complete"
            << exit(FatalError);
    }
}


// ************************************************************************* //
