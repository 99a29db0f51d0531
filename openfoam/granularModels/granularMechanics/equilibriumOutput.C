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

#include "equilibrium.H"
#include "foamVersions.H"
#include "OStringStream.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Imbalance, divided by E r/l, that rounding errors alone can cause
static const scalar roundOff = 1e-9;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::stringList Foam::granularMechanicsModels::equilibrium::warnings() const
{
    DynamicList<string> all;
    if (!everMoved_ && largest_ > roundOff*law_->scale())
    {
        OStringStream text;
        text<< "The grains were never moved: at most " << largest_ << " Pa were"
            << " out of balance, which is below the entry residual of"
            << " equilibriumCoeffs, " << tolerance_ << " Pa. This run has the"
            << " result of one with mechanics none";
        all.append(text.str());
    }
    return stringList(all);
}


void Foam::granularMechanicsModels::equilibrium::makeFields()
{
    vectorField& D = D_.primitiveFieldRef();
    scalarField& J = areaRatio_.primitiveFieldRef();
    const label dim = nodes_.dim(), r = nodes_.radial();
    forAll(D, celli)
    {
        // Mean of the nodes, moved to the centre of the cell with the gradient
        const label start = nodes_.cellStarts()[celli];
        const label count = nodes_.cellStarts()[celli + 1] - start;
        vector sum(Zero), place(Zero);
        for (label i = start; i < start + count; ++i)
        {
            const label node = nodes_.cellNodes()[i];
            sum += nodes_.vectorAt(u_, node)/count;
            place += nodes_.vectorAt(nodes_.points(), node)/count;
        }
        const tensor F(gradient(celli));
        tensor slope(F - tensor::I);
        vector away(mesh_.cellCentres()[celli] - place);
        if (dim == 2)
        {
            slope.zz() = 0;
            away.z() = 0;
        }
        if (r >= 0)
        {
            // Points of a wedge lie off its middle plane
            away[r] = 0;
        }
        D[celli] = sum + (slope & away);
        J[celli] = det(F);
    }
    D_.correctBoundaryConditions();
    areaRatio_.correctBoundaryConditions();
    grains_.setAreaRatio(J);
    law_->output();

    writeNodes(u_, nodeDisplacement_);
    writeNodes(velocity_, nodeVelocity_);
    writeNodes(velocityBefore_, nodeVelocityBefore_);
    writeNodes(give_, wallGive_);
    writeFriction();
    setWallForce();
    if (mesh_.time().writeTime() && mesh_.time().timeIndex() != written_)
    {
        written_ = mesh_.time().timeIndex();
        takeNodes();
    }
}


void Foam::granularMechanicsModels::equilibrium::setWallForce()
{
    auto* field = mesh_.getObjectPtr<volVectorField>("wallForce");
    if (!field)
    {
        return;
    }
    if (!law_->elastic())
    {
        law_->present();
    }
    if (!placed_)
    {
        invalidCell_ =
            nodes_.findShapes(at(nodeField(u_.size(), Zero), 0), shapes_);
        placed_ = true;
    }
    nodeField force(u_.size(), Zero);
    addStress(law_->stress(), force);
    addUnfitted(nodeField(u_.size(), Zero), force);
    nodes_.sum(force);
    force = volumeForce_ - force;
    const List<vectorField> onFaces(walls_.onFaces(law_->stress(), force));
    forAll(onFaces, patchi)
    {
        if (onFaces[patchi].size())
        {
            field->boundaryFieldRef()[patchi] == onFaces[patchi];
        }
    }
}


void Foam::granularMechanicsModels::equilibrium::takeNodes()
{
    readNodes(nodeDisplacement_, u_);
    readNodes(nodeVelocity_, velocity_);
    readNodes(nodeVelocityBefore_, velocityBefore_);
    readNodes(wallGive_, give_);
    readFriction();
    placed_ = false;
    findMetric();
}


Foam::string Foam::granularMechanicsModels::equilibrium::failure() const
{
    if (notGiven_)
    {
        return "the way by which grains give at the walls is not found; shorter"
            " steps or a smaller 'slackLayer' may help";
    }

    // The invalid cell if there is one, else a cell at the node with the
    // largest imbalance
    label celli = invalidCell_, worst = 0;
    scalar most = 0;
    forAll(r_, i)
    {
        const scalar here = mag(r_[i])/nodeSize_[i/nodes_.dim()];
        if (!(here <= most))
        {
            most = here;
            worst = i/nodes_.dim();
        }
    }
    const bool torn = returnReduce(invalidCell_ >= 0, orOp<bool>());
    const bool here =
        torn ? celli >= 0 : most >= returnReduce(most, maxOp<scalar>());

    stringList texts(Pstream::nProcs());
    if (here)
    {
        nodes_.each([&](const auto& e)
        {
            for (label a = 0; a < e.size(); ++a)
            {
                celli = celli < 0 && e.nodes[a] == worst ? e.cell : celli;
            }
        });
        OStringStream text;
        if (torn)
        {
            text<< "cell " << celli << " at " << mesh_.cellCentres()[celli]
                << " is torn, turned inside out or strained by more than "
                << largestStrain;
        }
        else
        {
            text<< most << " Pa are out of balance at cell " << celli << " at "
                << mesh_.cellCentres()[celli];
        }
        text<< ", whose state is: " << grains_.describe(celli).c_str();
        texts[Pstream::myProcNo()] = text.str();
    }
    Pstream::gatherList(texts);
    fromMaster(texts);
    for (const string& text : texts)
    {
        if (!text.empty())
        {
            return text;
        }
    }
    return "no cell found";
}


void Foam::granularMechanicsModels::equilibrium::refuse()
{
    const string what(failure());
    grains_.commit();
    grains_.refresh();
    const_cast<Time&>(mesh_.time()).writeNow();
    FatalErrorInFunction
        << "Equilibrium at time " << mesh_.time().timeName() << " not found in "
        << mostParts << " parts of " << maxIterations_ << " iterations: "
        << what.c_str() << ". Allowed: maxResidual " << maxResidual_
        << " Pa of equilibriumCoeffs. The fields before the equilibrium of this"
        << " time are written" << exit(FatalError);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::granularMechanics::counters
Foam::granularMechanicsModels::equilibrium::count() const
{
    counters all(counters_);
    all.displacement = gMax(mag(D_.primitiveField())());
    all.warnings = warnings();
    return all;
}


void Foam::granularMechanicsModels::equilibrium::writeReport() const
{
    const counters all(count());
    Info<< "Equilibrium: " << all.solves << " of " << steps_
        << " steps solved, " << all.iterations << " iterations, " << all.linear
        << " linear, " << all.cut << " steps in parts; largest displacement "
        << all.displacement << " m; largest residual left " << all.residual
        << " Pa, in " << all.unconverged << " steps above the limit of the step";
    if (all.unconverged)
    {
        Info<< ", by at most " << all.unbalanced << " Pa";
    }
    Info<< nl;
    for (const string& warning : all.warnings)
    {
        Info<< "Equilibrium: " << warning.c_str() << nl;
    }
}


// ************************************************************************* //
