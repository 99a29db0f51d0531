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

#include "rveBox.H"
#include "error.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{

[[noreturn]] static void failed(const char* what, const std::exception& error)
{
    FatalErrorInFunction
        << "The RVE could not be " << what << ": " << error.what()
        << exit(FatalError);
    throw;
}


static rveBox averaged(msdd::Rve&& grains)
{
    rveBox box;
    box.averages = grains.homogenise();
    box.grains = std::make_shared<const msdd::Rve>(std::move(grains));
    return box;
}

} // End namespace granularModels
} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::granularModels::rveBox Foam::granularModels::rveBox::packed
(
    const std::string& specification
)
{
    try
    {
        return averaged(msdd::Rve::pack(specification));
    }
    catch (const std::exception& error)
    {
        failed("packed", error);
    }
}


Foam::granularModels::rveBox Foam::granularModels::rveBox::read
(
    const std::string& text
)
{
    return averaged(msdd::Rve::fromJson(text));
}


Foam::granularModels::rveBox Foam::granularModels::rveBox::strained
(
    const scalar strain
) const
{
    try
    {
        msdd::Rve after(grains->clone());
        after.strain(strain);
        return averaged(std::move(after));
    }
    catch (const std::exception& error)
    {
        failed("strained", error);
    }
}


// ************************************************************************* //
