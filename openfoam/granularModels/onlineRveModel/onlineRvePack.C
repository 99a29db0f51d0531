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

#include "onlineRveModel.H"

#include <cmath>
#include <map>
#include <utility>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

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
        << label(keys.number(coeffs_, "discs"))
        << ", \"seed\": " << seed
        << ", \"porosity\": " << porosity
        << ", \"compression\": \""
        << keys.choice(coeffs_, "compression").c_str()
        << "\", \"boundary\": \""
        << keys.choice(coeffs_, "boundary").c_str()
        << "\", \"relaxation\": \""
        << keys.choice(coeffs_, "relaxation").c_str()
        << "\", \"radius_min\": " << 0.6*radius
        << ", \"radius_max\": " << 1.4*radius
        << ", \"material\": {\"density\": " << properties_.density().value()
        << ", \"young_modulus\": " << properties_.youngModulus().value()
        << ", \"stiffness_ratio\": "
        << keys.number(coeffs_, "stiffnessRatio")
        << ", \"friction_angle\": "
        << keys.number(coeffs_, "frictionAngle")
        << ", \"wall_stiffness_factor\": 1, \"damping\": 0.1}}";
    return os.str();
}


void Foam::granularModels::onlineRve::pack(const known& cells)
{
    const scalar dPorosity = keys.number(coeffs_, "porosityTolerance");
    const scalar dFabric = keys.number(coeffs_, "fabricTolerance");
    const label seed = label(keys.number(coeffs_, "seed"));

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
