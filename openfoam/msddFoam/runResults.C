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

#include "runResults.H"
#include "briefNumber.H"
#include "pascals.H"
#include "Time.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- With five digits
static string number(const scalar value)
{
    OStringStream text;
    text.precision(5);
    text<< value;
    return text.str();
}


//- "(1 2 3) m"; coordinates of a mesh of this size that are rounding are 0
static string place(const point& at, const scalar size)
{
    const auto coordinate = [size](const scalar x)
    {
        return number(mag(x) < 1e-9*size ? 0 : x);
    };
    return
        "(" + coordinate(at.x()) + ' ' + coordinate(at.y()) + ' '
      + coordinate(at.z()) + ") m";
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::runResults::peak::take(const scalar other, const point& place)
{
    const auto before = [](const point& a, const point& b)
    {
        return
            a.x() != b.x() ? a.x() < b.x()
          : a.y() != b.y() ? a.y() < b.y()
          : a.z() < b.z();
    };
    if (other > value || (other == value && before(place, at)))
    {
        value = other;
        at = place;
    }
}


Foam::runResults::peak Foam::runResults::largest
(
    const UList<scalar>& values,
    const UList<point>& places
)
{
    peak own;
    forAll(values, i)
    {
        own.take(values[i], places[i]);
    }
    List<scalar> value(Pstream::nProcs(), own.value);
    List<point> at(Pstream::nProcs(), own.at);
    value[Pstream::myProcNo()] = own.value;
    at[Pstream::myProcNo()] = own.at;
    Pstream::gatherList(value);
    Pstream::scatterList(value);
    Pstream::gatherList(at);
    Pstream::scatterList(at);
    peak result;
    forAll(value, proci)
    {
        result.take(value[proci], at[proci]);
    }
    return result;
}


Foam::runResults::wall Foam::runResults::wallOf(const fvPatch& patch) const
{
    const vectorField n(patch.nf());
    // By the forces on its nodes where they are known: the stress of the cells
    // next to it is less accurate
    vectorField t
    (
      - (
            n
          & grains_.stress().boundaryField()[patch.index()]
           .patchInternalField()
        )
    );
    if (const auto* force = T_.mesh().findObject<volVectorField>("wallForce"))
    {
        t = force->boundaryField()[patch.index()];
    }
    const scalarField normal(t & n);
    const scalarField shear(mag(t - normal*n));
    const scalar area = max(gSum(patch.magSf()), VSMALL);
    wall result;
    result.name = patch.name();
    result.heat = 0;
    if (before_.size())
    {
        const label i = patch.index();
        result.heat =
            returnReduce(grains_.record().heat[i] - before_[i], sumOp<scalar>())
           /T_.time().deltaTValue();
    }
    result.least = gMin(normal);
    result.mean = gSum(patch.magSf()*normal)/area;
    result.most = largest(normal, patch.Cf());
    result.shear = gSum(patch.magSf()*shear)/area;
    return result;
}


Foam::DynamicList<Foam::runResults::wall> Foam::runResults::walls() const
{
    DynamicList<wall> result;
    for (const fvPatch& patch : T_.mesh().boundary())
    {
        if (!polyPatch::constraintType(patch.patch().type()))
        {
            result.append(wallOf(patch));
        }
    }
    return result;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::runResults::runResults
(
    const volScalarField& T,
    const granularState& grains
)
:
    T_(T),
    grains_(grains)
{
    update();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::runResults::update()
{
    const peak now(largest(T_, T_.mesh().C()));
    if (now.value > hottest_.value)
    {
        hottest_ = now;
        hottest_.time = T_.time().value();
    }
}


Foam::DynamicList<Foam::string> Foam::runResults::sentences() const
{
    DynamicList<string> lines;
    const scalar size = T_.mesh().bounds().mag();
    const volSymmTensorField& K = grains_.conductivity();
    const scalarField mean(tr(K.primitiveField())/3);
    lines.append
    (
        "Temperature: " + number(gMin(T_.primitiveField())) + " to "
      + number(gMax(T_.primitiveField())) + " K. The largest in a cell since "
      + number(T_.time().startTime().value()) + " s was "
      + number(hottest_.value) + " K at " + place(hottest_.at, size)
      + " after " + number(hottest_.time) + " s."
    );
    lines.append
    (
        "Conductivity, mean of the axes: " + brief(gMin(mean)) + " to "
      + brief(gMax(mean)) + " W/(m K)."
    );
    string heat, stress;
    for (const wall& w : walls())
    {
        heat += (heat.empty() ? "" : ", ") + w.name + ' ' + brief(w.heat);
        stress +=
            (stress.empty() ? "" : "; ") + w.name + ' ' + pascals(w.least)
          + ", " + pascals(w.mean) + ", " + pascals(w.most.value) + " at "
          + place(w.most.at, size) + ", " + pascals(w.shear);
    }
    if (!heat.empty())
    {
        lines.append("Heat into the bed in the last step [W]: " + heat + '.');
        lines.append
        (
            "Stress on walls (normal: least, mean, largest; shear: mean): "
          + stress + '.'
        );
    }
    return lines;
}


Foam::string Foam::runResults::json() const
{
    const auto at = [](Ostream& os, const point& p)
    {
        os  << '[' << p.x() << ", " << p.y() << ", " << p.z() << ']';
    };
    const scalarField mean(tr(grains_.conductivity().primitiveField())/3);
    OStringStream os;
    os.precision(10);
    os  << "{\"temperature\": {\"least\": " << gMin(T_.primitiveField())
        << ", \"largest\": " << gMax(T_.primitiveField())
        << ", \"peak\": " << hottest_.value << ", \"peak_at\": ";
    at(os, hottest_.at);
    os  << ", \"peak_time\": " << hottest_.time
        << "}, \"conductivity\": {\"least\": " << gMin(mean)
        << ", \"largest\": " << gMax(mean) << "}, \"walls\": {";
    bool first = true;
    for (const wall& w : walls())
    {
        os  << (first ? "" : ", ") << string(w.name)
            << ": {\"heat\": " << w.heat
            << ", \"normal_least\": " << w.least
            << ", \"normal_mean\": " << w.mean
            << ", \"normal_largest\": " << w.most.value
            << ", \"normal_largest_at\": ";
        at(os, w.most.at);
        os  << ", \"shear_mean\": " << w.shear << '}';
        first = false;
    }
    os  << "}}";
    return os.str();
}


// ************************************************************************* //
