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

#include "refusals.H"
#include "foamVersions.H"
#include "foamVersion.H"
#include "rhoReactionThermo.H"

#include <cstdlib>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

#define NUMBER_AS_TEXT(number) #number
#define TEXT_OF(macro) NUMBER_AS_TEXT(macro)

//- What the library was built for. Volatile, so that the comparison is made
//- when it runs: tests change the number in a copy of the library.
static const volatile char builtFor[] = "OpenFOAM API " TEXT_OF(OPENFOAM);

#undef TEXT_OF
#undef NUMBER_AS_TEXT


//- End the run: the region of this mesh is a fluid
template<class Thermo>
static autoPtr<Thermo> refuseFluid(const fvMesh& mesh, const word&)
{
    FatalErrorInFunction
        << "Region " << mesh.name() << " is listed as fluid in "
        << mesh.time().constant()/"regionProperties" << ", but its"
        << " thermophysicalProperties name thermoType granularSolidThermo,"
        << " allowed: a region listed as solid, because grains do not flow"
        << exit(FatalError);
    return autoPtr<Thermo>();
}


//- Puts the refusal into the table from which solvers select the thermo of a
//- fluid region
template<class Thermo>
struct addRefusal
{
    addRefusal()
    {
        MSDD_MAKE_TABLE(Thermo, fvMesh);
        Thermo::fvMeshConstructorTablePtr_->set
        (
            "granularSolidThermo", refuseFluid<Thermo>
        );
    }
};

static const addRefusal<rhoReactionThermo> ofReactingFluids;
static const addRefusal<rhoThermo> ofFluids;

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::checkOpenFOAM()
{
    string built;
    for (const volatile char* c = builtFor; *c; ++c)
    {
        built += *c;
    }
    const int api = std::atoi(built.substr(built.rfind(' ') + 1).c_str());
    if (api != foamVersion::api)
    {
        FatalErrorInFunction
            << "libgranularThermo.so was built for OpenFOAM API " << api
            << ", this program is of OpenFOAM API " << foamVersion::api
            << ", allowed: the same. Build it again with openfoam/Allwmake, or"
            << " set the environment with scripts/foam-env" << exit(FatalError);
    }
}


// ************************************************************************* //
