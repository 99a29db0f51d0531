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

#include "regionPolicy.H"
#include "foamVersions.H"
#include "functionObject.H"
#include "wholeFile.H"
#include "Time.H"

#include <sstream>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::regionPolicy::action> Foam::regionPolicy::actionNames
({
    { action::clamp, "clamp" },
    { action::warn, "warn" },
    { action::cutStep, "cutStep" },
    { action::error, "error" }
});

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Rows kept on each process
static const label maxOffenders = 10000;

static const FixedList<word, 2> sides({"below", "above"});

static const keyTable policyKeys
(
    "outOfTrainingRange",
    {
        {
            "maxFraction",
            "share of all cells that may be outside at once; above it the run"
            " ends", "-", "0 to 1", "1"
        },
        {
            "porosity", "actions for the porosity", "-", "actions",
            "`error` below, `clamp` above"
        },
        {"fabricIndex", "for the fabric index", "-", "actions", "`clamp`"},
        {
            "fabricShear",
            "for 2 F_xy; like the next two a state of the default model", "-",
            "actions", "`clamp`"
        },
        {
            "jammingFraction",
            "for the solid fraction at which the packing would carry no load",
            "-", "actions", "`clamp`"
        },
        {
            "elasticCompression",
            "for the compression beyond that", "-", "actions",
            "`clamp` below, `error` above"
        },
        {
            "thermalStrain", "for the strain of the grains in one step", "-",
            "actions", "`cutStep`"
        }
    }
);

static const keyTable sideKeys
(
    "sides of outOfTrainingRange",
    {
        {
            "below", "action where the value is below the region", "-",
            "clamp, warn, cutStep, error", "see above"
        },
        {
            "above", "action where it is above", "-",
            "clamp, warn, cutStep, error", "see above"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::regionPolicy::regionPolicy
(
    const granularProperties& properties,
    const fvMesh& mesh,
    const wordList& stateNames,
    const wordList& columnNames,
    const std::string& modelHash
)
:
    mesh_(mesh),
    dict_(properties.outOfTrainingRangeDict()),
    hash_(modelHash),
    names_(stateNames),
    columns_(columnNames),
    maxFraction_(policyKeys.number(dict_, "maxFraction")),
    looseGiven_(dict_.subOrEmptyDict("porosity").found("above")),
    cells_(mesh.nCells())
{
    names_.append("thermalStrain");
    columns_.append("thermal_strain");
    actions_.resize(names_.size());
    warned_.resize(names_.size());

    // Columns that only other models have are accepted, so that a case can
    // change its model without changing the policy
    policyKeys.check(dict_, names_);

    forAll(names_, i)
    {
        const word& name = names_[i];
        const action other =
            name == "thermalStrain" ? action::cutStep : action::clamp;
        const FixedList<action, 2> dense
        ({
            name == "porosity" ? action::error : other,
            name == "elasticCompression" ? action::error : other
        });
        const dictionary dict(dict_.subOrEmptyDict(name));

        sideKeys.check(dict);
        forAll(sides, side)
        {
            actions_[i][side] =
                actionNames.getOrDefault(sides[side], dict, dense[side]);
            warned_[i][side] = false;
        }
    }
    if (Pstream::master())
    {
        rm(path(mesh));
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::regionPolicy::keep(const offender& found)
{
    const label key =
        2*(found.cell*names_.size() + found.column) + (found.distance > 0);
    const auto place = place_.cfind(key);

    if (!place.found() && offenders_.size() < maxOffenders)
    {
        place_.insert(key, offenders_.size());
        offenders_.append(found);
    }
    else if
    (
        place.found()
     && mag(found.distance) > mag(offenders_[place.val()].distance)
    )
    {
        offenders_[place.val()] = found;
    }
}


void Foam::regionPolicy::act
(
    const label column,
    const label side,
    const label cells,
    const scalar farthest,
    const string& when
)
{
    const word& name = names_[column];

    if (actions_[column][side] == action::error)
    {
        FatalIOErrorInFunction(dict_)
            << when.c_str() << ' ' << cells << " cells have " << name << ' '
            << sides[side] << " the region of the model, by up to " << farthest
            << ". Entry '" << name << "/" << sides[side]
            << "' of outOfTrainingRange in constant/granularProperties is error, "
            << "allowed: "
            << granularProperties::listed(actionNames.sortedToc()).c_str()
            << ". The cells are in " << path(mesh_)
            << exit(FatalIOError);
    }
    const action what = actions_[column][side];
    if
    (
        !warned_[column][side]
     && (what == action::warn || (what == action::clamp && atStart()))
    )
    {
        warned_[column][side] = true;
        Warning
            << when.c_str() << ' ' << cells << " cells have " << name << ' '
            << sides[side] << " the region of the model, by up to " << farthest
            << ": the model answers as well as it can" << endl;
    }
}


void Foam::regionPolicy::judgeShare
(
    const label cells,
    const string& when
) const
{
    if (cells <= maxFraction_*cells_.size())
    {
        return;
    }
    // Written before, unless the model reports no columns
    const fileName list(path(mesh_));
    FatalIOErrorInFunction(dict_)
        << when.c_str() << ' ' << cells << " of " << cells_.size()
        << " cells are outside the region of the model. Entry 'maxFraction'"
        << " of outOfTrainingRange in constant/granularProperties is "
        << maxFraction_ << ", allowed: 0 to 1."
        << (isFile(list) ? " The cells are in " + list : string())
        << exit(FatalIOError);
}


bool Foam::regionPolicy::atStart() const
{
    return mesh_.time().timeIndex() == 0;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::regionPolicy::judgeStart
(
    const scalarField& porosity,
    const scalar loosest,
    const scalar unjammed
) const
{
    label loose = 0, apart = 0;
    for (const scalar value : porosity)
    {
        loose += value > loosest;
        apart += value > unjammed;
    }
    reduce(loose, sumOp<label>());
    reduce(apart, sumOp<label>());
    if (!loose)
    {
        return;
    }
    // Not with the case's writePrecision, which prints more digits than the
    // porosity was given with
    std::ostringstream text;
    text<< gMax(porosity);
    const std::string most(text.str());
    const action what = actions_[names_.find("porosity")][1];

    if (apart && (!looseGiven_ || what == action::error))
    {
        FatalIOErrorInFunction(dict_)
            << "Field porosity in " << mesh_.time().timePath()/"porosity"
            << " is above " << unjammed << " in " << apart << " of "
            << cells_.size() << " cells, up to " << most.c_str()
            << ", allowed: at most " << unjammed << ", beyond which no grains"
            << " touch: the model would answer as for packings of about "
            << loosest << ", which conduct and carry load. To run anyway, give"
            << " porosity { above clamp; } in outOfTrainingRange of"
            << " constant/granularProperties" << exit(FatalIOError);
    }
    Warning
        << "At the start " << loose << " of " << cells_.size()
        << " cells have a porosity above " << loosest << ", up to "
        << most.c_str() << ", looser than all packings that the model was"
        << " trained with: it answers as for packings of about " << loosest
        << endl;
}


bool Foam::regionPolicy::judge
(
    const labelUList& cells,
    const UList<scalarField>& state,
    const scalarField& strain,
    const UList<scalarField>& outside,
    const string& when
)
{
    labelList counts(2*names_.size() + 1, Zero);
    scalarList farthest(2*names_.size(), Zero);

    forAll(cells, row)
    {
        bool any = false;
        forAll(names_, i)
        {
            const scalar distance = outside[i][row];
            if (distance == 0)
            {
                continue;
            }
            any = true;
            const label side = 2*i + (distance > 0);
            ++counts[side];
            farthest[side] = max(farthest[side], mag(distance));

            offender found
            {
                cells_.toGlobal(cells[row]), i, distance, strain[row],
                mesh_.time().value(), scalarList(state.size())
            };
            forAll(state, k)
            {
                found.state[k] = state[k][row];
            }
            tried_.append(found);
        }
        counts.last() += any;
    }
    Pstream::listCombineGather(counts, plusEqOp<label>());
    fromMaster(counts);
    Pstream::listCombineGather(farthest, maxEqOp<scalar>());
    fromMaster(farthest);

    bool ends = counts.last() > maxFraction_*cells_.size();
    bool cut = false;
    forAll(farthest, i)
    {
        const action what = actions_[i/2][i % 2];
        ends = ends || (counts[i] && what == action::error);
        cut = cut || (counts[i] && what == action::cutStep);
    }
    if (ends)
    {
        accept();
        write();
    }
    forAll(farthest, i)
    {
        if (counts[i])
        {
            act(i/2, i % 2, counts[i], farthest[i], when);
        }
    }
    judgeShare(counts.last(), when);
    return cut;
}


void Foam::regionPolicy::judgeRows
(
    const label outside,
    const string& when
) const
{
    const label cells = returnReduce(outside, sumOp<label>());
    judgeShare(cells, when);
    if (atStart())
    {
        Info<< when.c_str() << ' ' << cells << " of " << cells_.size()
            << " cells are outside the range that the model was made for: it"
            << " answers as well as it can" << nl << endl;
    }
}


void Foam::regionPolicy::accept()
{
    for (const offender& found : tried_)
    {
        keep(found);
    }
    tried_.clear();
}


void Foam::regionPolicy::refuseCut()
{
    accept();
    write();
    FatalIOErrorInFunction(dict_)
        << "Cells are outside the region of the model where outOfTrainingRange in"
        << " constant/granularProperties says cutStep, but the time step of "
        << mesh_.time().deltaTValue() << " s cannot be cut: it is fixed or at minDeltaT, or the state at the"
        << " start is outside. The cells are in "
        << path(mesh_) << exit(FatalIOError);
}


// ************************************************************************* //
