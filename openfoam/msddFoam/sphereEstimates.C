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

#include "sphereEstimates.H"
#include "briefNumber.H"
#include "pascals.H"
#include "contactForces.H"
#include "OStringStream.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Share of the conductivity from which on radiation is reported
static const scalar muchRadiation = 0.02;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::sphereEstimates::sphereEstimates
(
    const granularProperties& properties,
    const granularState& grains
)
:
    properties_(properties),
    grains_(grains),
    coeffs_(properties.surrogateDict().subOrEmptyDict("spheresCoeffs")),
    diameter_(2*properties.meanRadius().value())
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::sphereEstimates::mean(const scalarField& values) const
{
    const scalarField& V = grains_.mesh().V();
    return
        returnReduce(sum(V*values), sumOp<scalar>())
       /returnReduce(sum(V), sumOp<scalar>());
}


Foam::string Foam::sphereEstimates::place() const
{
    const scalarField p(grains_.presentPressure());
    label worst = 0;
    forAll(p, celli)
    {
        worst = p[celli] > p[worst] ? celli : worst;
    }
    typedef Tuple2<scalar, point> found;
    found most(-GREAT, point::zero);
    if (p.size())
    {
        most = found(p[worst], grains_.mesh().cellCentres()[worst]);
    }
    reduce
    (
        most,
        [](const found& a, const found& b)
        {
            return b.first() > a.first() ? b : a;
        }
    );
    OStringStream text;
    text.precision(3);
    text<< most.second();
    return text.str();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::sphereEstimates::added
Foam::sphereEstimates::radiation(const scalar temperature) const
{
    const granularModel& model = grains_.model();
    scalarField state(model.stateNames().size());
    forAll(state, i)
    {
        const word& name = model.stateNames()[i];
        state[i] =
            mean(grains_.mesh().lookupObject<volScalarField>(name));
    }
    granularModel::radiating found;
    if
    (
        !model.radiation(state, temperature, found)
     || !(found.conductivity > muchRadiation*found.without)
    )
    {
        return added({string(), false});
    }
    const string size
    (
        brief(found.conductivity) + " W/(m K) at "
      + Foam::name(std::round(temperature)) + " K to the "
      + brief(found.without) + " W/(m K) of the bed ("
      + brief(100*found.conductivity/max(found.without, VSMALL)) + " %)"
    );
    const string emissivity("emissivity " + brief(found.emissivity));
    if (found.inModel)
    {
        return added({"adds " + size + "; " + emissivity, false});
    }
    return added
    ({
        "would add about " + size + ", and is not in the model; " + emissivity
      + (
            found.assumed
          ? ", assumed (key emissivity of spheresCoeffs)"
          : " (radiation is off)"
        ),
        true
    });
}


Foam::sphereEstimates::contacts
Foam::sphereEstimates::forces(const scalar pressure) const
{
    if (!(pressure > 0))
    {
        return contacts({string(), false});
    }
    const contactForces of(diameter_, grains_.model().contactModulus());
    const scalar force = of.mean
    (
        pressure,
        1 - mean(grains_.porosity().primitiveField()),
        mean(grains_.mesh().lookupObject<volScalarField>("coordination"))
    );
    const scalar most = contactForces::large*force;
    const scalar middle = of.hertz(force), large = of.hertz(most);
    string text
    (
        "at a pressure of " + pascals(pressure) + " the mean force of contacts"
        " is " + brief(force) + " N, with a Hertz pressure of "
      + pascals(middle) + "; one contact in 100 carries more than "
      + brief(most) + " N (" + pascals(large) + "); p is largest at "
      + place() + " m"
    );
    scalar crush = 0, hardness = 0;
    const bool breaks = coeffs_.readIfPresent("crushLoad", crush) && most > crush;
    if (breaks)
    {
        text +=
            string(", above the crush load of ") + brief(crush)
          + " N: grains would break";
    }
    if (!coeffs_.readIfPresent("hardness", hardness))
    {
        return contacts
        (
            {text + "; the case gives no hardness to compare with", breaks}
        );
    }
    text +=
        large > hardness
      ? string
        (
            string(middle > hardness ? ", above" : ", in part above")
          + " the hardness of " + pascals(hardness) + ": "
          + (middle > hardness ? "grains" : "some grains")
          + " would yield or crush"
        )
      : string(", below the hardness of " + pascals(hardness));
    return contacts({text, breaks || large > hardness});
}


// ************************************************************************* //
