/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
     \\/     M anipulation  |
-------------------------------------------------------------------------------
License
    SPDX-License-Identifier: GPL-3.0-or-later

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty: see the file LICENSE.
\*---------------------------------------------------------------------------*/

#include "equilibrium.H"
#include "OStringStream.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Areas enclosed by the strain path of a cell, in a plane of two components
//- of the strain, above which the model's stress is not to be trusted.
//- Measured: ten circles of 0.5 % strain, with an area of 8e-4 together, change
//- the model's pressure by 1 % at porosity 0.12, by 5 % at 0.16 and by 19 % at
//- 0.18, while the pressure of discs hardly changes. The first area, that of
//- two and a half such circles, holds for paths that consist of loops alone.
//- The second holds for loops within a longer path: curved paths without any
//- loop have an area of up to 5e-4 in the cases H, C and HC.
static const scalar leastArea = 2e-4;
static const scalar largestArea = 1e-3;

//- Ratio of the area to the square of the largest strain above which a path
//- counts as loops and not as a curved line: two and a half circles; the paths
//- in H, C and HC have ratios of up to 1
static const scalar mostBent = 2;

//- Imbalance, divided by E r/l, that rounding errors alone can cause
static const scalar roundOff = 1e-9;

//- Strain of a cell from its deformation gradient, as a vector (deviator,
//- volume, shear) whose squared length is the sum of the squares of the strain
//- tensor's components
static vector strainOf(const FixedList<scalar, 4>& F)
{
    const scalar half = 1/std::sqrt(2.0);
    return half*vector(F[0] - F[3], F[0] + F[3] - 2, F[1] + F[2]);
}


//- Whether the loops of a cell's strain path enclose too large an area
static bool looped(const vector& loops)
{
    const scalar area = max(mag(loops.x()), mag(loops.y()));
    return area > max(leastArea, min(mostBent*sqr(loops.z()), largestArea));
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularMechanicsModels::equilibrium::move(const nodeField& du)
{
    List<vector> before(metric_.size());
    forAll(before, celli)
    {
        before[celli] = strainOf(gradient(celli));
    }
    forAll(u_, i)
    {
        u_[i] += du[i];
    }
    vectorField& loops = strainLoops_.primitiveFieldRef();
    forAll(before, celli)
    {
        // Area of the triangle between the initial strain, the strain before
        // and the strain after the step: a path there and back encloses none
        const vector& a = before[celli];
        const vector b(strainOf(gradient(celli)));
        vector& all = loops[celli];
        all.x() += 0.5*(a.x()*b.y() - a.y()*b.x());
        all.y() += 0.5*(a.y()*b.z() - a.z()*b.y());
        all.z() = max(all.z(), mag(b));
    }
    everMoved_ = true;
}


Foam::label Foam::granularMechanicsModels::equilibrium::loopedCells() const
{
    label cells = 0;
    for (const vector& loops : strainLoops_.primitiveField())
    {
        cells += looped(loops);
    }
    return returnReduce(cells, sumOp<label>());
}


void Foam::granularMechanicsModels::equilibrium::warnOfLoops()
{
    // The count changes slowly, so that it is enough to look in every 16th
    // step and whenever fields are written
    if (loopsSaid_ || !(steps_ % 16 == 0 || mesh_.time().writeTime()))
    {
        return;
    }
    const label cells = loopedCells();
    if (cells)
    {
        loopsSaid_ = true;
        WarningInFunction
            << "At time " << mesh_.time().timeName() << ' ' << cells
            << " cells have been strained along closed loops, there and back on"
            << " different paths, around an area of more than " << leastArea
            << " in a plane of strains. From here on their stress is not to be"
            << " trusted: loops change it, but hardly change that of discs. Ten"
            << " circles of 0.5 % strain, an area of 8e-4, were measured to"
            << " change the pressure by 1 % at porosity 0.12, by 5 % at 0.16"
            << " and by 19 % at 0.18" << endl;
    }
}


Foam::stringList Foam::granularMechanicsModels::equilibrium::warnings() const
{
    DynamicList<string> all;
    if (!everMoved_ && largest_ > roundOff*scale_)
    {
        OStringStream text;
        text<< "The grains were never moved: at most " << largest_ << " Pa were"
            << " out of balance, which is below the entry residual of"
            << " equilibriumCoeffs, " << tolerance_ << " Pa. This run has the"
            << " result of one with mechanics none";
        all.append(text.str());
    }
    const label cells = loopedCells();
    if (cells)
    {
        OStringStream text;
        text<< cells << " cells were strained along closed loops, around an area"
            << " of more than " << leastArea << " in a plane of strains: their"
            << " stress is not to be trusted";
        all.append(text.str());
    }
    return stringList(all);
}


// ************************************************************************* //
