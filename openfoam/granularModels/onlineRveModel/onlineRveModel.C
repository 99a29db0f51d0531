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
#include "addToRunTimeSelectionTable.H"
#include "Time.H"
#include "OSspecific.H"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{
    defineTypeNameAndDebug(onlineRve, 0);
    addToRunTimeSelectionTable(granularModel, onlineRve, dictionary);
}
}

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The word of an entry, which must be one of those allowed
static word choice
(
    const dictionary& dict,
    const word& key,
    const wordList& allowed
)
{
    const word value(dict.lookupOrDefault<word>(key, allowed[0]));
    if (!allowed.found(value))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is '" << value << "', allowed: "
            << granularProperties::listed(allowed).c_str()
            << exit(FatalIOError);
    }
    return value;
}


//- A line of a list without its comma
static std::string element(std::istream& is)
{
    std::string line;
    std::getline(is, line);
    if (!line.empty() && line.back() == ',')
    {
        line.pop_back();
    }
    return line;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Private Classes * * * * * * * * * * * * * * //

class Foam::granularModels::onlineRve::boxFile
:
    public regIOobject
{
    const onlineRve& model_;

public:

    boxFile(const onlineRve& model, const fvMesh& mesh)
    :
        regIOobject
        (
            IOobject
            (
                "onlineRve.json", mesh.time().timeName(), mesh,
                IOobject::NO_READ, IOobject::AUTO_WRITE
            )
        ),
        model_(model)
    {}

    virtual bool writeData(Ostream&) const
    {
        return true;
    }

    virtual bool writeObject
    (
        IOstream::streamFormat,
        IOstream::versionNumber,
        IOstream::compressionType,
        const bool
    ) const
    {
        const fileName folder(time().path()/time().timeName());
        mkDir(folder);
        const fileName beside(folder/name() + ".part");
        {
            std::ofstream os(beside);
            model_.write(os);
            if (!os.good())
            {
                FatalErrorInFunction
                    << "Cannot write " << beside << exit(FatalError);
            }
        }
        return mv(beside, folder/name());
    }
};


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::onlineRve::onlineRve
(
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    granularModel(typeName, properties, mesh),
    perGroup_(choice(coeffs_, "rvePer", {"cell", "group"}) == "group"),
    network_
    (
        choice(coeffs_, "conductivity", {"affine", "network"}) == "network"
    )
{
    if (&coeffs_ != &properties.surrogateDict())
    {
        granularProperties::checkKeys
        (
            coeffs_,
            {
                "discs", "seed", "compression", "boundary", "relaxation",
                "conductivity", "stiffnessRatio", "frictionAngle",
                "porosityTolerance", "fabricTolerance", "rvePer"
            }
        );
    }
    file_.reset(new boxFile(*this, mesh));
}


// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::granularModels::onlineRve::~onlineRve()
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularModels::onlineRve::failed
(
    const char* what,
    const std::exception& error
)
{
    FatalErrorInFunction
        << "The RVE could not be " << what << ": " << error.what()
        << exit(FatalError);
    throw;
}


std::string Foam::granularModels::onlineRve::specification
(
    const scalar porosity,
    const label seed
) const
{
    // Radii uniform over 0.6 to 1.4 of the mean, as the paper's 3 to 7 mm
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
               coeffs_,
               "compression",
               {"isotropic", "horizontal", "intermediate", "sheared"}
           ).c_str()
        << "\", \"boundary\": \""
        << choice(coeffs_, "boundary", {"periodic", "walls"}).c_str()
        << "\", \"relaxation\": \""
        << choice(coeffs_, "relaxation", {"fire", "damped"}).c_str()
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
        coeffs_, "fabricTolerance", 0.02, 1e-6, 1
    );
    const label seed =
        label(granularProperties::ranged(coeffs_, "seed", 1, 0, 1e9));

    HashTable<label, word> groups;
    groupOf_.resize(cells.size);
    groupSize_.clear();
    packed_.clear();
    forAll(groupOf_, celli)
    {
        // A tolerance t puts values into bins of width t. The seed follows
        // from the bins, so that it does not depend on the processes.
        const label i = label(std::lround(cells.porosity[celli]/dPorosity));
        const label j = label(std::lround(cells.fabricIndex[celli]/dFabric));
        const word name(Foam::name(i) + '_' + Foam::name(j));

        if (groups.insert(name, label(packed_.size())))
        {
            try
            {
                const label number = seed + i + 1009*std::abs(j) + 7919*(j < 0);
                box b;
                b.grains = std::make_shared<msdd::Rve>
                (
                    msdd::Rve::pack(specification(i*dPorosity, number))
                );
                b.averages = b.grains->homogenise();
                packed_.push_back(b);
                groupSize_.append(0);
            }
            catch (const std::exception& error)
            {
                failed("packed", error);
            }
        }
        groupOf_[celli] = groups[name];
        ++groupSize_[groupOf_[celli]];
    }

    boxes_.clear();
    if (perGroup_)
    {
        boxes_ = packed_;
    }
    else
    {
        for (const label group : groupOf_)
        {
            boxes_.push_back(packed_[group]);
        }
    }
    Info<< "Packed " << returnReduce(label(packed_.size()), sumOp<label>())
        << " groups of cells, "
        << returnReduce(label(boxes_.size()), sumOp<label>()) << " boxes"
        << endl;
}


void Foam::granularModels::onlineRve::write(std::ostream& os) const
{
    const auto list = [&os](const std::vector<box>& boxes)
    {
        for (size_t i = 0; i < boxes.size(); ++i)
        {
            std::string text(boxes[i].grains->toJson());
            std::replace(text.begin(), text.end(), '\n', ' ');
            os << (i ? ",\n" : "") << text;
        }
    };

    os << "{\"schema\": \"msdd-online-rve-1\", \"groups\": " << packed_.size()
       << ", \"boxes\": " << boxes_.size() << ", \"group_of\": [\n";
    forAll(groupOf_, celli)
    {
        os << (celli ? ",\n" : "") << groupOf_[celli];
    }
    os << "\n], \"packed\": [\n";
    list(packed_);
    os << "\n], \"boxes_now\": [\n";
    list(boxes_);
    os << "\n]}\n";
}


bool Foam::granularModels::onlineRve::read()
{
    const Time& time = mesh_.time();
    const fileName path(time.path()/time.timeName()/"onlineRve.json");
    if (!isFile(path))
    {
        return false;
    }

    std::ifstream is(path);
    const std::string header(element(is));
    const auto number = [&header](const char* key) -> label
    {
        const size_t at = header.find(std::string("\"") + key + "\": ");
        return at == std::string::npos
            ? -1
            : label(std::atol(header.c_str() + at + std::strlen(key) + 4));
    };
    const label groups = number("groups"), boxes = number("boxes");
    const label wanted = perGroup_ ? groups : mesh_.nCells();
    if
    (
        header.find("msdd-online-rve-1") == std::string::npos
     || groups < 0 || boxes != wanted
    )
    {
        FatalErrorInFunction
            << "File " << path << " begins with '" << header
            << "', allowed: schema msdd-online-rve-1 with " << wanted
            << " boxes" << exit(FatalError);
    }

    const auto load = [&is](std::vector<box>& list, const label count)
    {
        element(is);
        for (label i = 0; i < count; ++i)
        {
            box b;
            b.grains = std::make_shared<msdd::Rve>
            (
                msdd::Rve::fromJson(element(is))
            );
            b.averages = b.grains->homogenise();
            list.push_back(b);
        }
    };
    try
    {
        groupOf_.resize(mesh_.nCells());
        groupSize_ = labelList(groups, Zero);
        for (label& group : groupOf_)
        {
            group = label(std::stol(element(is)));
            ++groupSize_[group];
        }
        load(packed_, groups);
        load(boxes_, boxes);
    }
    catch (const std::exception& error)
    {
        FatalErrorInFunction
            << "File " << path << " is damaged: " << error.what()
            << exit(FatalError);
    }
    return true;
}


Foam::granularModels::onlineRve::box
Foam::granularModels::onlineRve::strained(const box& from, const scalar strain)
{
    if (strain == 0)
    {
        return from;
    }
    try
    {
        box b;
        b.grains = std::make_shared<msdd::Rve>(from.grains->clone());
        b.grains->strain(strain);
        b.averages = b.grains->homogenise();
        return b;
    }
    catch (const std::exception& error)
    {
        failed("strained", error);
    }
}


void Foam::granularModels::onlineRve::answer
(
    const query& cells,
    const label row,
    const box& b
) const
{
    const msdd_averages& a = b.averages;
    const scalar k = properties_.thermalConductivity().value();

    cells.nextState[0][row] = a.porosity;
    cells.nextState[1][row] = a.fabric_index;
    cells.conductivityXX[row] =
        k*(network_ ? a.conductivity_network_xx : a.conductivity_xx);
    cells.conductivityYY[row] =
        k*(network_ ? a.conductivity_network_yy : a.conductivity_yy);
    cells.stressXX[row] = a.stress_xx;
    cells.stressYY[row] = a.stress_yy;
}


Foam::label Foam::granularModels::onlineRve::advancePerCell(const query& cells)
{
    for (label row = 0; row < cells.size; ++row)
    {
        box& mine = boxes_[cells.cells ? cells.cells[row] : row];
        const box after(strained(mine, cells.strain[row]));

        answer(cells, row, after);
        if (!cells.trial)
        {
            mine = after;
        }
    }
    return 0;
}


Foam::label Foam::granularModels::onlineRve::advancePerGroup(const query& cells)
{
    const auto group = [&](const label row)
    {
        return groupOf_[cells.cells ? cells.cells[row] : row];
    };

    scalarField strain(groupSize_.size(), Zero);
    for (label row = 0; row < cells.size; ++row)
    {
        strain[group(row)] += cells.strain[row]/groupSize_[group(row)];
    }

    std::vector<box> after;
    forAll(strain, i)
    {
        after.push_back(strained(boxes_[i], strain[i]));
    }
    for (label row = 0; row < cells.size; ++row)
    {
        answer(cells, row, after[group(row)]);
    }
    if (!cells.trial)
    {
        boxes_ = after;
    }
    return 0;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularModels::onlineRve::initialState
(
    const known& cells,
    scalar* const* state
)
{
    if (!read())
    {
        pack(cells);
    }
    for (label celli = 0; celli < cells.size; ++celli)
    {
        const box& b = boxes_[perGroup_ ? groupOf_[celli] : celli];
        state[0][celli] = b.averages.porosity;
        state[1][celli] = b.averages.fabric_index;
    }
}


Foam::label Foam::granularModels::onlineRve::advance(const query& cells)
{
    return perGroup_ ? advancePerGroup(cells) : advancePerCell(cells);
}


void Foam::granularModels::onlineRve::solidFraction
(
    const scalarField&,
    scalarField& fraction
) const
{
    forAll(fraction, celli)
    {
        fraction[celli] =
            1 - packed_[groupOf_[celli]].averages.porosity_sum_of_areas;
    }
}


// ************************************************************************* //
