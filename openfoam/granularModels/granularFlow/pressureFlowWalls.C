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
#include "meshWavePatchDistMethod.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

//- Pore volume per area of a wall that exceeds the porosity of the inside, and
//- the width of the layer that has it, in diameters
static const scalar looseVolume = 0.058, looseWidth = 1;

//- Share of a cell at a wall within this layer, below which it is not resolved
static const scalar leastShare = 0.5;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularFlows::pressure::findLooseWalls()
{
    const scalar d = 2*properties_.meanRadius().value();
    const scalarField& V = mesh_.V();
    scalar least = 1;
    forAll(mesh_.boundary(), patchi)
    {
        if (!isWall(patchi))
        {
            continue;
        }
        const fvPatch& patch = mesh_.boundary()[patchi];
        const scalar area = gSum(patch.magSf());
        if (area == 0)
        {
            continue;
        }
        volScalarField y
        (
            IOobject("distanceToWall", mesh_.time().timeName(), mesh_), mesh_,
            dimensionedScalar(dimLength, Zero)
        );
        volVectorField normal
        (
            IOobject("normalOfWall", mesh_.time().timeName(), mesh_), mesh_,
            dimensionedVector(dimless, Zero)
        );
        forAll(mesh_.boundary(), i)
        {
            normal.boundaryFieldRef()[i] == mesh_.boundary()[i].nf();
        }
        patchDistMethods::meshWave(mesh_, labelHashSet({patchi})).correct
        (
            y, normal
        );
        // Share of each cell in the layer, by its extent normal to the wall
        scalarField share(V.size());
        forAll(share, celli)
        {
            scalar low = GREAT, high = -GREAT;
            for (const label facei : mesh_.cells()[celli])
            {
                const scalar at = mesh_.faceCentres()[facei] & normal[celli];
                low = min(low, at);
                high = max(high, at);
            }
            const scalar width = max(high - low, VSMALL);
            share[celli] = min
            (
                max((looseWidth*d - y[celli])/width + 0.5, scalar(0)), scalar(1)
            );
        }
        looser_ += looseVolume*d*area/gSum(V*share)*share;
        core_ = max(core_ - share, scalar(0));
        for (const label celli : patch.faceCells())
        {
            least = min(least, share[celli]);
        }
    }
    reduce(least, minOp<scalar>());
    const scalar most = gMax(looser_ + grains_.porosity().primitiveField());
    if (most > loosest || gSum(V*core_) == 0)
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'channelling' is layer, but the bed is too narrow: "
            << gSum(V*core_)/gSum(V) << " of it is more than a diameter away from"
            << " walls, allowed: above 0; and with the looser grains the porosity"
            << " of a cell is " << most << ", allowed: at most " << loosest
            << exit(FatalIOError);
    }
    Info<< "Looser grains at walls: for the drag, the porosity of the bed is "
        << gSum(V*looser_)/gSum(V) << " larger, of a cell at most "
        << gMax(looser_) << nl;
    if (least < leastShare)
    {
        Info<< "Warning: only " << least << " of a cell at a wall is within the"
            << " layer of a diameter that is looser, allowed: " << leastShare
            << "; finer cells would resolve the flow along the walls" << nl;
    }
}


Foam::scalar Foam::granularFlows::pressure::relativeFluxOfCore() const
{
    const scalarField& V = mesh_.V();
    const scalarField G(mag(massFlux_.primitiveField()));
    return gSum(core_*V*G)/gSum(core_*V)*gSum(V)/gSum(V*G);
}


// ************************************************************************* //
