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

#include "onlineRveModel.H"

#include <cmath>
#include <map>
#include <utility>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::word Foam::granularModels::onlineRve::choice
(
    const word& key,
    const wordList& allowed
) const
{
    const word value(coeffs_.lookupOrDefault<word>(key, allowed[0]));
    if (!allowed.found(value))
    {
        FatalIOErrorInFunction(coeffs_)
            << "Entry '" << key << "' is '" << value << "', allowed: "
            << granularProperties::listed(allowed).c_str()
            << exit(FatalIOError);
    }
    return value;
}


std::string Foam::granularModels::onlineRve::specification
(
    const scalar porosity,
    const label seed
) const
{
    // Radii uniform from 0.6 to 1.4 of the mean, like the paper's 3 to 7 mm
    const scalar radius = properties_.meanRadius().value();

    OStringStream os;
    os.precision(17);
    os  << "{\"discs\": "
        << label(granularProperties::ranged(coeffs_, "discs", 500, 20, 1e6))
        << ", \"seed\": " << seed
        << ", \"porosity\": " << porosity
        << ", \"compression\": \""
        << choice
           (
               "compression",
               {"isotropic", "horizontal", "intermediate", "sheared"}
           ).c_str()
        << "\", \"boundary\": \""
        << choice("boundary", {"periodic", "walls"}).c_str()
        << "\", \"relaxation\": \""
        << choice("relaxation", {"fire", "damped"}).c_str()
        << "\", \"radius_min\": " << 0.6*radius
        << ", \"radius_max\": " << 1.4*radius
        << ", \"material\": {\"density\": " << properties_.density().value()
        << ", \"young_modulus\": " << properties_.youngModulus().value()
        << ", \"stiffness_ratio\": "
        << granularProperties::ranged(coeffs_, "stiffnessRatio", 0.8, 0.01, 10)
        << ", \"friction_angle\": "
        << granularProperties::ranged(coeffs_, "frictionAngle", 0.5, 0, 1.5)
        << ", \"wall_stiffness_factor\": 1, \"damping\": 0.1}}";
    return os.str();
}


void Foam::granularModels::onlineRve::pack(const known& cells)
{
    const scalar dPorosity = granularProperties::ranged
    (
        coeffs_, "porosityTolerance", 0.002, 1e-6, 1
    );
    const scalar dFabric = granularProperties::ranged
    (
        coeffs_, "fabricTolerance", 0.02, 1e-6, 2
    );
    const label seed =
        label(granularProperties::ranged(coeffs_, "seed", 1, 0, 1e9));

    std::map<std::pair<label, label>, rveBox> groups;
    std::map<std::pair<label, label>, label> roots;
    for (label celli = 0; celli < cells.size; ++celli)
    {
        // A tolerance t sorts values into bins of width t. The seed of a
        // packing is computed from its bins, so that it does not depend on how
        // the cells are distributed over processes.
        const label i = label(std::lround(cells.porosity[celli]/dPorosity));
        const label j = label(std::lround(cells.fabricIndex[celli]/dFabric));
        const std::pair<label, label> bin(i, j);

        if (!groups.count(bin))
        {
            const label number = seed + i + 1009*std::abs(j) + 7919*(j < 0);
            groups[bin] =
                rveBox::packed(specification(i*dPorosity, number));
        }
        if (!shared_ || !roots.count(bin))
        {
            roots[bin] = boxes_.add(groups[bin]);
        }
        places_.push_back(rveHistory::place{roots[bin], 0});
        solid_.append(1 - groups[bin].averages.porosity_sum_of_areas);
    }
    packed_ = groups.size();

    Info<< "Packed " << returnReduce(label(packed_), sumOp<label>())
        << " boxes for " << returnReduce(cells.size, sumOp<label>())
        << " cells" << endl;
}


// ************************************************************************* //
