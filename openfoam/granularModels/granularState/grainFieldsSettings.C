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

#include "grainFields.H"
#include "OStringStream.H"
#include "SHA1.H"

#include <cctype>
#include <fstream>
#include <iterator>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Texts longer than this are shortened: OpenFOAM reads at most 1024 characters
static const size_t longest = 600;

static string shown(const scalar value)
{
    OStringStream os;
    os.precision(15);
    os << value;
    return os.str();
}


//- The entries of a dictionary in one line, without those named in 'but' and
//- without sub-dictionaries <type>Coeffs; a long text ends with a checksum
static string shown(const dictionary& dict, const wordHashSet& but)
{
    OStringStream os;
    os.precision(15);
    for (const entry& item : dict)
    {
        if (!but.found(item.keyword()) && !item.keyword().endsWith("Coeffs"))
        {
            os << item;
        }
    }
    string text;
    bool blank = true;
    for (const char c : os.str())
    {
        const bool space = std::isspace(c);
        if (!space || !blank)
        {
            text += space ? ' ' : c;
        }
        blank = space;
    }
    if (text.size() > longest)
    {
        return
            text.substr(0, longest/2) + "... (SHA-1 "
          + SHA1(text).digest().str() + ")";
    }
    return text.empty() ? string("default") : text;
}

static string shown(const temperatureFunction& f)
{
    if (f.isNumber())
    {
        return shown(f.usual().value());
    }
    string text(shown(f.given(), wordHashSet()));
    fileName file;
    if (f.given().readIfPresent("file", file))
    {
        std::ifstream is(file.expand(), std::ios::binary);
        const std::string content(std::istreambuf_iterator<char>(is), {});
        text += " (SHA-1 " + SHA1(content).digest().str() + ")";
    }
    return text;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::dictionary Foam::grainFields::settings() const
{
    const dictionary& surrogate = properties_.surrogateDict();
    const word type(surrogate.get<word>("type"));
    const word mechanics
    (
        properties_.lookupOrDefault<word>("mechanics", "none")
    );
    dictionary all;
    const auto add = [&](const word& key, const string& value)
    {
        all.add(key, value);
    };
    const auto number = [&](const dimensionedScalar& value)
    {
        add(value.name(), shown(value.value()));
    };

    // The hash identifies the model whatever the name of its file
    add("model", type + (model_->hash().empty() ? "" : " " + model_->hash()));
    add
    (
        "modelCoeffs",
        shown
        (
            surrogate.optionalSubDict(type + "Coeffs"),
            wordHashSet
            ({
                "type", "model", "library", "hash", "smallestStrain",
                "outOfTrainingRange"
            })
        )
    );
    number(properties_.density());
    number(properties_.youngModulus());
    add("thermalConductivity", shown(properties_.conductivityFunction()));
    add("heatCapacity", shown(properties_.heatFunction()));
    number(properties_.thermalExpansion());
    number(properties_.meanRadius());
    add
    (
        "bulkDensity",
        granularProperties::bulkDensityModelNames[properties_.bulkDensity()]
    );
    add("mechanics", mechanics);
    const vector& g = properties_.gravity();
    if (mechanics != "none")
    {
        add("g", shown(g.x()) + " " + shown(g.y()) + " " + shown(g.z()));
    }
    add
    (
        "mechanicsCoeffs",
        shown
        (
            properties_.subOrEmptyDict(mechanics + "Coeffs"),
            wordHashSet({"residual", "maxIterations", "maxResidual"})
        )
    );
    const word flow(properties_.lookupOrDefault<word>("flow", "none"));
    if (flow != "none")
    {
        // What is given at the ends may change, as the conditions of T may
        add("flow", flow);
        add
        (
            "flowCoeffs",
            shown
            (
                properties_.subOrEmptyDict(flow + "Coeffs"),
                wordHashSet
                (
                    {"inlet", "outlet", "massFlow", "massFlux", "openings"}
                )
            )
        );
    }
    return all;
}


// ************************************************************************* //
