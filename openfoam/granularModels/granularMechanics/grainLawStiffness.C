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

#include "stressLaw.H"
#include "granularProperties.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Least ratio of a pivot to its diagonal of a cell's stiffness matrix, and
//- factor by which the other components are reduced until it is reached
static const scalar leastPivot = 0.05;
static const scalar reduction = 0.8;

//- The same for grains that do not slide, and their shear modulus over that of
//- uniaxial compression
static const scalar cautiousPivot = 0.8;
static const scalar cautiousShear = 0.35;

//- Whether all pivots of the Cholesky factorisation of a symmetric matrix exceed
//- this share of their diagonal
template<label N>
static bool hasPivots(const scalar (&c)[N][N], const scalar least)
{
    scalar v[N][N], pivot[N];
    for (label i = 0; i < N; ++i)
    {
        pivot[i] = c[i][i];
        for (label j = 0; j < i; ++j)
        {
            v[i][j] = c[i][j];
            for (label k = 0; k < j; ++k)
            {
                v[i][j] -= v[i][k]*v[j][k]/pivot[k];
            }
            pivot[i] -= sqr(v[i][j])/pivot[j];
        }
        if (i && !(pivot[i] > least*c[i][i]))
        {
            return false;
        }
    }
    return true;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

template<Foam::label N>
void Foam::grainLaw::stiffen(const label caution, const scalar leastShare)
{
    const scalar least = leastShare*scale_;
    const scalar leastRatio = caution > 1 ? cautiousPivot : leastPivot;
    const scalar factor = caution > 1 ? std::pow(2.0, caution - 2) : 1;
    bool normal[N];
    for (label i = 0; i < N; ++i)
    {
        const label k = order_[i];
        normal[i] =
            k == symmTensor::XX || k == symmTensor::YY || k == symmTensor::ZZ;
    }

    forAll(tangent_[0], celli)
    {
        scalar c[N][N];
        for (label k = 0; k < N*N; ++k)
        {
            c[k/N][k % N] = tangent_[k][celli];
        }
        scalar most = 0;
        for (label i = 0; i < N; ++i)
        {
            c[i][i] = max(c[i][i], normal[i] ? least : 0.5*least);
            most = normal[i] ? max(most, c[i][i]) : most;
        }
        if (caution)
        {
            // A matrix that is symmetric and positive
            for (label i = 0; i < N; ++i)
            {
                for (label j = 0; j < i; ++j)
                {
                    c[i][j] = c[j][i] = 0.5*(c[i][j] + c[j][i]);
                }
            }
            for (label i = 0; caution > 1 && i < N; ++i)
            {
                c[i][i] =
                    normal[i]
                  ? factor*most
                  : max(factor*c[i][i], cautiousShear*factor*most);
            }
            for (label k = 0; k < 20 && !hasPivots(c, leastRatio); ++k)
            {
                for (label i = 0; i < N; ++i)
                {
                    for (label j = 0; j < N; ++j)
                    {
                        c[i][j] *= i == j ? 1 : reduction;
                    }
                }
            }
        }
        for (label k = 0; k < N*N; ++k)
        {
            tangent_[k][celli] = c[k/N][k % N];
        }
    }
}


void Foam::grainLaw::stiffen(const label caution, const scalar leastShare)
{
    switch (order_.size())
    {
        case 3: stiffen<3>(caution, leastShare); break;
        case 4: stiffen<4>(caution, leastShare); break;
        default: stiffen<6>(caution, leastShare);
    }
}


// ************************************************************************* //
