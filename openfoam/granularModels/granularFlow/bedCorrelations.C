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

#include "bedCorrelations.H"
#include "error.H"

#include <cmath>

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace bedCorrelations
{

static scalar overHoldup(const state& s)
{
    return s.Re/(1 - s.porosity);
}

static scalar ergun(const state& s)
{
    return 150 + 1.75*overHoldup(s);
}

static scalar ktaDrag(const state& s)
{
    return 160 + 3*std::pow(overHoldup(s), 0.9);
}

static scalar erdim(const state& s)
{
    return 160 + 2.81*std::pow(overHoldup(s), 0.904);
}

static scalar wakao(const state& s)
{
    return 2 + 1.1*std::cbrt(s.Pr)*std::pow(s.Re, 0.6);
}

static scalar gunn(const state& s)
{
    const scalar e = s.porosity, c = std::cbrt(s.Pr);
    return
        (7 - 10*e + 5*e*e)*(1 + 0.7*std::pow(s.Re, 0.2)*c)
      + (1.33 - 2.4*e + 1.2*e*e)*std::pow(s.Re, 0.7)*c;
}

static scalar ktaExchange(const state& s)
{
    return
        1.27*std::cbrt(s.Pr)*std::pow(s.Re, 0.36)/std::pow(s.porosity, 1.18)
      + 0.033*std::sqrt(s.Pr)*std::pow(s.Re, 0.86)/std::pow(s.porosity, 1.07);
}

static scalar gnielinski(const state& s)
{
    const scalar R = max(s.Re/s.porosity, VSMALL);
    const scalar laminar = 0.664*std::sqrt(R)*std::cbrt(s.Pr);
    const scalar turbulent =
        0.037*std::pow(R, 0.8)*s.Pr
       /(1 + 2.443*std::pow(R, -0.1)*(std::pow(s.Pr, 2.0/3) - 1));
    return
        (1 + 1.5*(1 - s.porosity))
       *(2 + std::sqrt(sqr(laminar) + sqr(turbulent)));
}

static scalar liFinlayson(const state& s)
{
    return 0.17*std::pow(s.Re, 0.79);
}

// Fitted from Re_h of 1 (Erdim: 2) on; below that all of them tend to the law of
// creeping flow by Kozeny and Carman
static const correlation drags[] =
{
    {"Ergun", ergun, correlation::holdup, 0, 2300, 0, 1, 0, VGREAT, 0},
    {"KTA", ktaDrag, correlation::holdup, 0, 1e5, 0.36, 0.42, 0, VGREAT, 0},
    {
        "ErdimAkgirayDemir", erdim, correlation::holdup, 0, 3582, 0.377, 0.47,
        0, VGREAT, 4
    }
};

static const correlation exchanges[] =
{
    {"WakaoKaguei", wakao, correlation::plain, 0, 1e5, 0, 1, 0, VGREAT, 0},
    {"Gunn", gunn, correlation::plain, 0, 1e5, 0.35, 1, 0, VGREAT, 0},
    {
        "KTA", ktaExchange, correlation::plain, 100, 1e5, 0.36, 0.42, 0, VGREAT,
        20
    },
    {
        "Gnielinski", gnielinski, correlation::pores, 0.1, 1000, 0, 1, 0.4,
        1000, 0
    }
};

static const correlation atWall =
    {"LiFinlayson", liFinlayson, correlation::plain, 20, 7600, 0, 1, 0.6, 0.8, 0};

template<class List>
static const correlation& find(const List& all, const word& name)
{
    for (const correlation& each : all)
    {
        if (name == each.name)
        {
            return each;
        }
    }
    FatalErrorInFunction
        << "No correlation of beds is called " << name << exit(FatalError);
    return all[0];
}

} // End namespace bedCorrelations
} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::bedCorrelations::correlation::isValid
(
    const state& s,
    const scalar ratio
) const
{
    const scalar Re =
        kind == holdup ? s.Re/(1 - s.porosity)
      : kind == pores ? s.Re/s.porosity
      : s.Re;
    return
        least <= Re && Re <= most
     && densest <= s.porosity && s.porosity <= loosest
     && leastPr <= s.Pr && s.Pr <= mostPr
     && ratio >= widths;
}


const Foam::bedCorrelations::correlation&
Foam::bedCorrelations::drag(const word& name)
{
    return find(drags, name);
}


const Foam::bedCorrelations::correlation&
Foam::bedCorrelations::exchange(const word& name)
{
    return find(exchanges, name);
}


const Foam::bedCorrelations::correlation& Foam::bedCorrelations::wall()
{
    return atWall;
}


// ************************************************************************* //
