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

#include "pressureFlow.H"
#include "OStringStream.H"

// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::string Foam::granularFlows::pressure::summaryOfKind() const
{
    OStringStream os;
    os.precision(12);
    os  << ", \"openings\": {";
    forAll(openings_, i)
    {
        os  << (i ? ", " : "") << string(ports_[i].name)
            << ": {\"mass_flow\": "
            << -gSum(flux_.boundaryField()[ports_[i].patch]) << ", \"pressure\": "
            << pressureAt(i) << "}";
    }
    os  << "}, \"core_relative_flux\": ";
    if (flows() && looseWalls_)
    {
        os  << relativeFluxOfCore();
    }
    else
    {
        os  << "null";
    }
    os  << ", \"expelled_over_entered\": "
        << expelled_/max(entered_, VSMALL)
        << ", \"newton_iterations\": "
        << scalar(newton_)/max(flows_, label(1))
        << ", \"most_newton_iterations\": " << mostNewton_;
    return os.str();
}


// ************************************************************************* //
