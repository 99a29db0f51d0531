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

#include "runCourse.H"
#include "pascals.H"
#include "msdd.hpp"
#include "Pstream.H"
#include "PstreamReduceOps.H"

#include <cmath>
#include <sstream>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- How quantities are named: in msdd_compared and restarts, and in messages.
//- Whether values below those compared count, and whether a factor says more
//- than the values
struct comparedQuantity
{
    const char* key;
    const char* name;
    const char* unit;
    bool below, factor;
};

static const comparedQuantity comparedQuantities[] =
{
    {"reduced_pressure", "pressure", "Pa", true, true},
    {"thermal_strain", "thermal strain", "", true, true},
    {"temperature", "temperature", " K", true, false},
    {"heat_source", "heat from inside of the bed", " W/m3", false, true},
    {"conductivity_ratio", "k of the grains over k of the gas", "", true, false},
    {"grains_across", "grains between opposite walls", "", true, false}
};

//- Share by which values may lie beyond those compared, which are means over a
//- hundred grains and not the extremes of cells
static const scalar margin = 0.2;

//- Factor from which on it is reported
static const scalar leastFactor = 1.5;

//- Shares of the run at which samples are taken; how much the rates between
//- them may differ for what falls exponentially
static const FixedList<scalar, 2> sampleShares({0.6, 0.8});
static const scalar mostSpread = 0.3;


//- A value and its unit
static std::string shown(const comparedQuantity& of, const scalar value)
{
    if (std::string(of.unit) == "Pa")
    {
        return pascals(value);
    }
    std::ostringstream text;
    text.precision(mag(value) < 1000 ? 3 : 5);
    text<< value << of.unit;
    return text.str();
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

std::string Foam::pascals(const scalar value)
{
    const char* const units[] = {" Pa", " kPa", " MPa", " GPa"};
    scalar scaled = value;
    label i = 0;
    for (; i < 3 && mag(scaled) >= 999.5; ++i)
    {
        scaled /= 1e3;
    }
    std::ostringstream text;
    text.precision(3);
    text<< scaled << units[i];
    return text.str();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::runCourse::within(const quantity q, const range& values) const
{
    const range& known = compared_[q];
    return
        known.empty() || values.empty()
     || (
            (q == across || values.most <= known.most + margin*mag(known.most))
         && (
                !comparedQuantities[q].below
             || values.least >= known.least - margin*mag(known.least)
            )
        );
}


Foam::runCourse::range Foam::runCourse::all(const quantity q) const
{
    range result(seen_[q]);
    reduce(result.least, minOp<scalar>());
    reduce(result.most, maxOp<scalar>());
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::runCourse::compare
(
    const std::string& hash,
    const scalar modulus,
    const bool spheres
)
{
    spheres_ = spheres;
    for (label q = 0; q < quantities && modulus > 0; ++q)
    {
        range& known = compared_[q];
        const char* key = comparedQuantities[q].key;
        if (msdd::compared(hash, key, known.least, known.most) && q == pressure)
        {
            known.least *= modulus;
            known.most *= modulus;
        }
    }
}


bool Foam::runCourse::compared() const
{
    return !compared_[pressure].empty();
}


void Foam::runCourse::see
(
    const quantity q,
    const scalar least,
    const scalar most
)
{
    seen_[q].least = min(seen_[q].least, least);
    seen_[q].most = max(seen_[q].most, most);
}


void Foam::runCourse::load(const scalar time, const scalar pressure)
{
    peak_ = max(peak_, pressure);
    // A bed that never had a load, or is in tension, lost none
    const bool relieved = peak_ > 0 && pressure < slightLoad*peak_;
    if (relieved && relieved_)
    {
        relief_.whole += time - observed_;
    }
    if (relieved)
    {
        relief_.since = relief_.periods ? relief_.since : time;
        relief_.periods += !relieved_;
        relief_.until = relief_.periods == 1 ? time : relief_.until;
        relief_.least = min(relief_.least, pressure);
        relief_.share = min(relief_.share, max(pressure, scalar(0))/peak_);
    }
    else if (relief_.periods)
    {
        relief_.loaded = min(relief_.loaded, time);
        relief_.regained = max(relief_.regained, pressure);
    }
    relieved_ = relieved;
    observed_ = time;
}


void Foam::runCourse::mark(const scalar time)
{
    for (label q = 0; q < quantities; ++q)
    {
        if (!within(quantity(q), seen_[q]))
        {
            beyondSince_ = min(beyondSince_, time);
        }
    }
}


void Foam::runCourse::begin(const scalar time, const scalar received)
{
    begin_ = time;
    now_ = time;
    received_ = received;
}


void Foam::runCourse::step
(
    const scalar deltaT,
    const scalar end,
    const scalar change,
    const scalar pressureChange,
    const scalar received
)
{
    now_ += deltaT;
    rate_ = change/deltaT;
    pressureRate_ = pressureChange/deltaT;
    uptake_ = sample({now_ - 0.5*deltaT, (received - received_)/deltaT});
    received_ = received;
    const scalar share = (now_ - begin_)/max(end - begin_, VSMALL);
    while
    (
        samples_.size() < sampleShares.size()
     && share >= sampleShares[samples_.size()]
    )
    {
        samples_.append(uptake());
    }
}


Foam::runCourse::sample Foam::runCourse::uptake() const
{
    return sample({uptake_.time, returnReduce(uptake_.heat, sumOp<scalar>())});
}


Foam::stringList Foam::runCourse::beyond() const
{
    DynamicList<string> parts;
    for (label q = 0; q < quantities; ++q)
    {
        const comparedQuantity& of = comparedQuantities[q];
        const range& known = compared_[q];
        const range values(all(quantity(q)));
        for (const bool upper : {true, false})
        {
            const scalar value = upper ? values.most : values.least;
            const scalar limit = upper ? known.most : known.least;
            range one;
            one.least = one.most = value;
            if ((upper ? value <= limit : value >= limit) || within(quantity(q), one))
            {
                continue;
            }
            const scalar factor = limit != 0 ? value/limit : scalar(0);
            std::ostringstream text;
            text.precision(factor < 10 ? 2 : 6);
            text<< of.name << (upper ? " up to " : " down to ")
                << shown(of, value);
            if (of.factor && factor >= leastFactor)
            {
                // Two digits, or all before the point
                text<< ", " << (factor < 10 ? factor : std::round(factor))
                    << " times the "
                    << (upper ? "largest" : "least");
            }
            text<< " (compared: ";
            if (known.most == 0 && known.least == 0)
            {
                text<< "none)";
            }
            else
            {
                text<< shown(of, known.least) << " to "
                    << shown(of, known.most) << ')';
            }
            parts.append(text.str());
        }
    }
    if (lostLoad())
    {
        std::ostringstream text;
        text.precision(3);
        text<< "load after a loss of " << 100*(1 - relief_.share)
            << " % (compared: none)";
        parts.append(text.str());
    }
    return stringList(parts);
}


Foam::scalar Foam::runCourse::beyondSince() const
{
    return min
    (
        returnReduce(beyondSince_, minOp<scalar>()),
        lostLoad() ? relief_.loaded : GREAT
    );
}


Foam::scalar Foam::runCourse::rate() const
{
    return returnReduce(rate_, maxOp<scalar>());
}


Foam::scalar Foam::runCourse::pressureRate() const
{
    return returnReduce(pressureRate_, maxOp<scalar>());
}


Foam::runCourse::drift Foam::runCourse::drifts(const scalar time) const
{
    const range T(values(temperature)), p(values(pressure));
    return drift
    ({
        time*rate()/max(T.most - T.least, VSMALL),
        time*pressureRate()/max(p.most, VSMALL)
    });
}


bool Foam::runCourse::remaining(scalar& heat) const
{
    if (samples_.size() < sampleShares.size())
    {
        return false;
    }
    // Rates at which the heat falls between the samples, and to the end [1/s]
    const sample& a = samples_[0];
    const sample& b = samples_[1];
    const sample c(uptake());
    const auto fall = [](const sample& from, const sample& to)
    {
        const scalar ratio = to.heat != 0 ? from.heat/to.heat : scalar(0);
        return
            ratio > 1 && to.time > from.time
          ? std::log(ratio)/(to.time - from.time)
          : scalar(0);
    };
    const scalar first = fall(a, b), last = fall(b, c);
    if (!(mag(first - last) < mostSpread*max(first, last)))
    {
        return false;
    }
    heat = c.heat/last;
    return true;
}


void Foam::runCourse::read(const dictionary& dict)
{
    dict.readIfPresent("beyondSince", beyondSince_);
    const dictionary load(dict.subOrEmptyDict("unloaded"));
    load.readIfPresent("peak", peak_);
    load.readIfPresent("observed", observed_);
    load.readIfPresent("now", relieved_);
    load.readIfPresent("periods", relief_.periods);
    load.readIfPresent("since", relief_.since);
    load.readIfPresent("until", relief_.until);
    load.readIfPresent("whole", relief_.whole);
    load.readIfPresent("least", relief_.least);
    load.readIfPresent("share", relief_.share);
    load.readIfPresent("loaded", relief_.loaded);
    load.readIfPresent("regained", relief_.regained);
    for (label q = 0; q < quantities; ++q)
    {
        const word key(comparedQuantities[q].key);
        dict.readIfPresent(key + "Least", seen_[q].least);
        dict.readIfPresent(key + "Most", seen_[q].most);
    }
}


Foam::dictionary Foam::runCourse::written() const
{
    dictionary dict;
    dict.add("beyondSince", beyondSince());
    dictionary load;
    load.add("peak", peak_);
    load.add("observed", observed_);
    load.add("now", relieved_);
    load.add("periods", relief_.periods);
    load.add("since", relief_.since);
    load.add("until", relief_.until);
    load.add("whole", relief_.whole);
    load.add("least", relief_.least);
    load.add("share", relief_.share);
    load.add("loaded", relief_.loaded);
    load.add("regained", relief_.regained);
    dict.add("unloaded", load);
    for (label q = 0; q < quantities; ++q)
    {
        const word key(comparedQuantities[q].key);
        const range values(all(quantity(q)));
        dict.add(word(key + "Least"), values.least);
        dict.add(word(key + "Most"), values.most);
    }
    return dict;
}


// ************************************************************************* //
