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

//- Areas in the plane of strains from which on a loop is too large. Ten circles
//- of 0.5 % strain, 8e-4, were measured to change the pressure by 1 % at
//- porosity 0.12, 5 % at 0.16 and 19 % at 0.18; that of discs hardly changes.
//- The first is two and a half such circles, where they are all that the strain
//- has done. The second is for loops on a long way: bent ways without a loop
//- have up to 5e-4 in the cases H, C and HC.
static const scalar leastArea = 2e-4;
static const scalar largestArea = 1e-3;

//- Area over the square of the largest strain beyond which a way is a loop and
//- not a bend: two and a half circles; H, C and HC have up to 1
static const scalar mostBent = 2;

//- Imbalance over E r/l that rounding alone can leave
static const scalar roundOff = 1e-9;

//- Strain of a cell from the gradient of its positions, as a vector whose
//- square is the sum of the squares of the tensor: deviator, volume, shear
static vector strainOf(const FixedList<scalar, 4>& F)
{
    const scalar half = 1/std::sqrt(2.0);
    return half*vector(F[0] - F[3], F[0] + F[3] - 2, F[1] + F[2]);
}


//- Whether the strain of a cell has gone round too much
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
        // Triangles from the start: a way there and back has no area
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
    // Few steps change what is said; those that write are enough to see it
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
            << " cells have been strained in loops, to and fro on different"
            << " ways, around an area of more than " << leastArea
            << " in the plane of strains. From here on their stress is not to"
            << " be trusted: loops change it, but hardly that of discs. Ten"
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
        text<< "Nothing was ever solved: at most " << largest_ << " Pa were out"
            << " of balance, and below the entry residual of equilibriumCoeffs,"
            << " " << tolerance_ << " Pa, no solution is sought. All grains"
            << " have kept their place in this run, as with mechanics none";
        all.append(text.str());
    }
    const label cells = loopedCells();
    if (cells)
    {
        OStringStream text;
        text<< cells << " cells have been strained in loops, around an area of"
            << " more than " << leastArea << " in the plane of strains: their"
            << " stress is not to be trusted";
        all.append(text.str());
    }
    return stringList(all);
}


// ************************************************************************* //
