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

#include "caseChecks.H"
#include "foamVersions.H"
#include "IFstream.H"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <sstream>
#include <unistd.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- T may fall below 0 K during a run by this share of the largest temperature
static const scalar undershoot = 0.01;

//- The same share at the start, where only rounding errors are accepted
static const scalar roundOff = 1e-9;

//- The lowest temperature that is accepted [K]
static scalar lowest(const volScalarField& T, const scalar share)
{
    return -share*max(gMax(T.primitiveField()), scalar(0));
}


//- Text that says where T is below a bound on this process; empty if nowhere
static string whereBelowHere(const volScalarField& T, const scalar bound)
{
    std::ostringstream text;
    forAll(T, celli)
    {
        if (T[celli] < bound)
        {
            const point& C = T.mesh().cellCentres()[celli];
            text<< T[celli] << " K in cell " << celli << " at (" << C.x() << ' '
                << C.y() << ')';
            return text.str();
        }
    }
    for (const fvPatchScalarField& patch : T.boundaryField())
    {
        // Only walls with a given temperature: others follow from the cells
        forAll(patch, facei)
        {
            if (patch.fixesValue() && patch[facei] < bound)
            {
                text<< patch[facei] << " K at patch " << patch.patch().name()
                    << ", face " << facei;
                return text.str();
            }
        }
    }
    return string();
}


//- The same text, of any process, returned on all processes
static string whereBelow(const volScalarField& T, const scalar bound)
{
    stringList texts(Pstream::nProcs());
    texts[Pstream::myProcNo()] = whereBelowHere(T, bound);
    Pstream::gatherList(texts);
    fromMaster(texts);
    for (const string& text : texts)
    {
        if (!text.empty())
        {
            return text;
        }
    }
    return string();
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::checkWritable(const fileName& folder)
{
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
    {
        FatalErrorInFunction
            << "Folder " << folder << " cannot be written: "
            << std::strerror(errno) << ". Allowed: a case folder in which you can"
            << " make files, since a run writes its results there; take a copy"
            << exit(FatalError);
    }
}


void Foam::checkWriteInterval(const fileName& file)
{
    // OpenFOAM divides by it while it makes the time
    IFstream is(file);
    const dictionary control(is);
    scalar interval = 1;
    if (control.readIfPresent("writeInterval", interval) && !(interval > 0))
    {
        FatalIOErrorInFunction(control)
            << "Entry 'writeInterval' is " << interval << ", allowed: > 0"
            << exit(FatalIOError);
    }
}


void Foam::checkTimeStep(const Time& runTime)
{
    const dictionary& control = runTime.controlDict();
    const scalar deltaT = runTime.deltaTValue();
    const scalar left = runTime.endTime().value() - runTime.value();

    if (!(deltaT > 0))
    {
        FatalIOErrorInFunction(control)
            << "Entry 'deltaT' is " << deltaT << ", allowed: > 0 [s]"
            << exit(FatalIOError);
    }
    // At a restart it is no error if no time is left
    if (runTime.timeIndex() == 0 && !(left > 0.5*deltaT))
    {
        FatalIOErrorInFunction(control)
            << "Entry 'deltaT' is " << deltaT << ", allowed: at most " << left
            << " s, the time from the start at " << runTime.timeName()
            << " to endTime " << runTime.endTime().value()
            << ". No step would be taken" << exit(FatalIOError);
    }
}


void Foam::checkPlane(const fvMesh& mesh, const dictionary& surrogate)
{
    const word type(surrogate.lookupOrDefault<word>("type", word::null));
    if
    (
        mesh.solutionD()[vector::Z] != -1
     && type != "constant" && type != "spheres"
    )
    {
        FatalErrorInFunction
            << "The mesh in "
            << (mesh.time().constant()/mesh.meshDir()).c_str()
            << " is three-dimensional, allowed: two-dimensional in x and y,"
            << " with empty patches in z. This model is made from discs and"
            << " has no third direction; the surrogate types spheres and"
            << " constant take any mesh" << exit(FatalError);
    }
}


void Foam::checkVolumes(const fvMesh& mesh)
{
    label cells = 0;
    scalar least = GREAT;
    for (const scalar V : mesh.cellVolumes())
    {
        cells += !(V > VSMALL);
        least = min(least, V);
    }
    reduce(cells, sumOp<label>());
    reduce(least, minOp<scalar>());
    if (cells)
    {
        FatalErrorInFunction
            << "The mesh in "
            << (mesh.time().constant()/mesh.meshDir()).c_str() << " has "
            << cells << " cells of "
            << returnReduce(mesh.nCells(), sumOp<label>())
            << " with a volume of zero or below, the least " << least
            << " m^3, allowed: > 0. A mesh that has been mirrored is turned"
            << " inside out; see checkMesh" << exit(FatalError);
    }
}


void Foam::checkInitialTemperature(const volScalarField& T)
{
    const bool restarted = T.time().timeIndex() > 0;
    const string where
    (
        whereBelow(T, lowest(T, restarted ? undershoot : roundOff))
    );
    if (!where.empty())
    {
        FatalErrorInFunction
            << "Field " << T.name() << " in " << T.objectPath() << " is "
            << where.c_str() << ", allowed: 0 K and above. Temperatures are in"
            << " Kelvin" << exit(FatalError);
    }
}


void Foam::checkTemperature(const volScalarField& T)
{
    const string where(whereBelow(T, lowest(T, undershoot)));
    if (!where.empty())
    {
        Time& runTime = const_cast<Time&>(T.time());
        runTime.writeNow();
        FatalErrorInFunction
            << "Field " << T.name() << " at time " << runTime.timeName()
            << " is " << where.c_str() << ", allowed: 0 K and above. A wall, a"
            << " source of constant/fvOptions or a time step that is too large"
            << " has cooled it. The fields of this time are written"
            << exit(FatalError);
    }
}


void Foam::checkField
(
    const volScalarField& field,
    const dimensionSet& dims,
    const scalar low,
    const scalar high
)
{
    if (field.dimensions() != dims)
    {
        FatalErrorInFunction
            << "Field " << field.name() << " in " << field.objectPath()
            << " has dimensions " << field.dimensions() << ", allowed: "
            << dims << exit(FatalError);
    }
    forAll(field, celli)
    {
        const scalar value = field[celli];
        if (!std::isfinite(value) || value <= low || value >= high)
        {
            FatalErrorInFunction
                << "Field " << field.name() << " in " << field.objectPath()
                << " is " << value << " in cell " << celli
                << ", allowed: between " << low << " and " << high
                << exit(FatalError);
        }
    }
}


// ************************************************************************* //
