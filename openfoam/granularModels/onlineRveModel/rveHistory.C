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

#include "rveHistory.H"

#include <algorithm>
#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Share of the tolerance below which a remainder counts as zero, so that
//- rounding errors do not create boxes
static const scalar zeroShare = 0.01;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::rveHistory::rveHistory(const scalar tolerance)
:
    tolerance_(tolerance),
    made_(0),
    most_(0)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::label Foam::granularModels::rveHistory::child
(
    const label parent,
    const label side
)
{
    if (nodes_[parent].children[side] < 0)
    {
        const scalar strain = std::expm1(side ? tolerance_ : -tolerance_);
        add(nodes_[parent].box.strained(strain), parent, side);
        ++made_;
    }
    return nodes_[parent].children[side];
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::label Foam::granularModels::rveHistory::add
(
    const rveBox& box,
    const label parent,
    const label side
)
{
    const label index = label(nodes_.size());
    if (parent >= 0)
    {
        nodes_[parent].children[side] = index;
    }
    nodes_.push_back(node{box, parent, side, {-1, -1}});
    most_ = std::max(most_, nodes_.size());
    return index;
}


Foam::granularModels::rveHistory::place
Foam::granularModels::rveHistory::moved(const place& from, const scalar strain)
{
    place to(from);
    to.remainder += std::log1p(strain);
    while (std::abs(to.remainder) >= tolerance_)
    {
        const label up = to.remainder > 0;
        to.box = child(to.box, up);
        to.remainder -= up ? tolerance_ : -tolerance_;
    }
    return to;
}


Foam::granularModels::rveHistory::blend
Foam::granularModels::rveHistory::at(const place& where)
{
    const scalar part = std::abs(where.remainder)/tolerance_;
    const scalar weight = std::max(scalar(0), (part - zeroShare)/(1 - zeroShare));

    // The child is made before references are taken: making it may move all
    // nodes in memory
    const label to =
        weight > 0 ? child(where.box, where.remainder > 0) : where.box;

    return blend
    {
        nodes_[where.box].box.averages, nodes_[to].box.averages, weight
    };
}


void Foam::granularModels::rveHistory::strain
(
    const label box,
    const scalar strain
)
{
    if (strain != 0)
    {
        nodes_[box].box = nodes_[box].box.strained(strain);
        ++made_;
    }
}


void Foam::granularModels::rveHistory::prune(std::vector<place>& cells)
{
    std::vector<char> kept(nodes_.size(), 0);
    for (const place& cell : cells)
    {
        kept[cell.box] = 1;
    }

    std::vector<label> now(nodes_.size(), -1);
    std::vector<node> left;
    for (size_t i = 0; i < nodes_.size(); ++i)
    {
        node& old = nodes_[i];
        if (old.parent >= 0 && kept[old.parent])
        {
            kept[i] = 1;
        }
        if (kept[i])
        {
            now[i] = label(left.size());
            old.parent = old.parent < 0 ? -1 : now[old.parent];
            left.push_back(std::move(old));
        }
    }
    for (node& each : left)
    {
        for (label& index : each.children)
        {
            index = index < 0 ? -1 : now[index];
        }
    }
    for (place& cell : cells)
    {
        cell.box = now[cell.box];
    }
    nodes_.swap(left);
}


// ************************************************************************* //
