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
#include "addToRunTimeSelectionTable.H"
#include "extrapolatedCalculatedFvPatchFields.H"

#include <cmath>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularMechanicsModels
{
    defineTypeNameAndDebug(equilibrium, 0);
    addToRunTimeSelectionTable(granularMechanics, equilibrium, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// The wallCompliance of discs: at the walls of 96 packings the mean overlap is
// 2.5 (a disc touches every 2.4 radii), and a bed as deep as a radius is
// shortened by 1.1
const keyTable stressLaw::equilibriumKeys
(
    "equilibriumCoeffs",
    {
        {
            "law",
            "constitutive law of the stress. `grains`: the surrogate model."
            " `elastic`: an isotropic elastic solid that expands with T, on any"
            " mesh, only with surrogate type `constant` and its `conductivity`",
            "-", "grains, elastic", "grains"
        },
        {"elasticCoeffs", "keys of `law elastic`", "-", "a dictionary", "none"},
        {
            "residual",
            "change of stress across a cell that may stay out of balance; the"
            " next step takes it over. S is E r/l (l = 1 m); of spheres"
            " E* (p/E*)^(1/3)/2 with the mean pressure p at the start; with"
            " `law elastic` the shear modulus over 0.3", "Pa",
            "2e-14 S to 2e4 S",
            "1e-4 S; of spheres 1e-3 of the present mean pressure; with"
            " `law elastic` 1e-9 S"
        },
        {
            "maxIterations", "iterations of Newton's method for one solution",
            "-", "1 to 1000", "30"
        },
        {
            "maxResidual",
            "a step has failed if its residual is above this after"
            " `maxIterations`. An adaptive step is then repeated with half its"
            " size, the load of a fixed one is applied in 2, 4, ... 64 parts; else"
            " the run ends", "Pa", "`residual` to 2e7 S",
            "20 `residual`, at least the weight of the largest cell over its"
            " area: that of grains which nothing supports"
        },
        {
            "walls", "boundary condition of each wall", "-", "a dictionary",
            "every wall `rigid`"
        },
        {
            "wallCompliance",
            "by how much more discs overlap with a `rigid` or `frictionless`"
            " wall than the bed that would be there is shortened, for a normal"
            " stress of E r/l ([computation](../theory/equilibrium.md#walls))."
            " Walls with `slackLayer` have none", "mean radii",
            "0 to 1000; of spheres and with `law elastic` 0",
            "1.4; of spheres and with `law elastic` 0"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularMechanicsModels::equilibrium::equilibrium
(
    const granularProperties& properties,
    granularState& grains
)
:
    granularMechanics(grains),
    dict_(properties.subOrEmptyDict("equilibriumCoeffs")),
    nodes_(mesh_),
    law_(stressLaw::New(dict_, properties, grains, nodes_)),
    tolerance_(0),
    maxIterations_
    (
        label(stressLaw::equilibriumKeys.number(dict_, "maxIterations"))
    ),
    maxResidual_(0),
    walls_
    (
        dict_.subOrEmptyDict("walls"),
        grains.model(),
        nodes_,
        properties.meanRadius().value(),
        law_->elastic() || grains.model().isThreeDimensional(),
        springs(properties)
    ),
    read_(placesLost() ? IOobject::NO_READ : IOobject::READ_IF_PRESENT),
    written_(-1),
    nodeDisplacement_
    (
        io("nodeDisplacement", read_),
        pointMesh::New(mesh_),
        dimensionedVector(dimLength, Zero)
    ),
    nodeVelocity_
    (
        io("nodeVelocity", read_),
        pointMesh::New(mesh_),
        dimensionedVector(dimVelocity, Zero)
    ),
    nodeVelocityBefore_
    (
        io("nodeVelocityBefore", read_),
        pointMesh::New(mesh_),
        dimensionedVector(dimVelocity, Zero)
    ),
    wallGive_
    (
        io("wallGive", read_),
        pointMesh::New(mesh_),
        dimensionedVector(dimLength, Zero)
    ),
    wallTractions_(wallConditions::sides),
    initialStress_
    (
        io("initialStress", read_),
        law_->initialStress()
    ),
    D_
    (
        io("D", IOobject::NO_READ),
        mesh_,
        dimensionedVector(dimLength, Zero),
        extrapolatedCalculatedFvPatchVectorField::typeName
    ),
    areaRatio_
    (
        io("areaRatio", IOobject::NO_READ),
        mesh_,
        dimensionedScalar("one", dimless, 1),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    u_(nodes_.dim()*nodes_.size(), Zero),
    velocity_(u_),
    velocityBefore_(u_),
    give_(u_),
    traction_(nodes_.dim()*walls_.rubbing(), Zero),
    shellSlide_(traction_),
    gravity_(properties.gravity()),
    weight_(u_),
    volumeForce_(u_),
    start_(u_),
    nodeSize_(nodes_.size(), Zero),
    lastTime_(mesh_.time().value()),
    friction_(u_),
    newTraction_(traction_),
    coupled_(false),
    slide_(traction_),
    share_(1),
    r_(u_),
    before_(0),
    left_(0),
    invalidCell_(-1),
    norm_(0),
    placed_(false),
    diagonal_(u_),
    steps_(0),
    largest_(0),
    everMoved_(false)
{
    stressLaw::equilibriumKeys.check(dict_);
    if (law_->elastic() && walls_.gives())
    {
        FatalIOErrorInFunction(dict_)
            << "A wall has entry 'slackLayer', allowed: 0 with law elastic, which has"
            << " no grains that rearrange" << exit(FatalIOError);
    }
    if (read_ == IOobject::NO_READ && !law_->elastic())
    {
        grains_.beginWherePlaced();
    }
    law_->begin(initialStress_);
    setResidual();
    if (!law_->elastic())
    {
        grains_.enableDeformation(walls_.strength());
    }
    readNodes(nodeDisplacement_, u_);
    readNodes(nodeVelocity_, velocity_);
    readNodes(nodeVelocityBefore_, velocityBefore_);
    if (!law_->keepsAcceleration())
    {
        nodeVelocityBefore_.writeOpt() = IOobject::NO_WRITE;
    }
    readNodes(wallGive_, give_);
    makeFrictionFields();
    // Where 'slackLayer' was taken out at a restart, what was given stays
    if (!walls_.gives() && !(gMax(mag(wallGive_.primitiveField())()) > 0))
    {
        wallGive_.writeOpt() = IOobject::NO_WRITE;
    }
    invalidCell_ = nodes_.findShapes(nodes_.points(), reference_);
    if (returnReduce(invalidCell_ >= 0, orOp<bool>()))
    {
        FatalErrorInFunction
            << "The mesh has cells that are turned inside out or have no"
            << " volume, such as " << failure().c_str()
            << "; see checkMesh" << exit(FatalError);
    }
    shapes_ = reference_;
    if (grains_.restFriction() > 0)
    {
        traction_ = walls_.carried
        (
            law_->split(initialStress_.primitiveField()), gravity_,
            grains_.restFriction()
        );
    }
    setWeight();
    setStart();
    compareWeight();
    setSolver();
    findMetric();
    grains_.follow([this]() { makeFields(); });
    grains_.refresh();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::IOobject Foam::granularMechanicsModels::equilibrium::io
(
    const word& name,
    const IOobject::readOption read
) const
{
    return IOobject
    (
        name, mesh_.time().timeName(), mesh_, read, IOobject::AUTO_WRITE
    );
}


bool Foam::granularMechanicsModels::equilibrium::placesLost() const
{
    const auto there = [this](const word& name, const word& type)
    {
        IOobject header(io(name, IOobject::MUST_READ));
        return returnReduce
        (
            header.typeHeaderOk<volScalarField>(false)
         && header.headerClassName() == type,
            andOp<bool>()
        );
    };
    // The stress at the start is that of grains that were not displaced
    return
        there("areaRatio", volScalarField::typeName)
     && !(
            there("nodeDisplacement", pointVectorField::typeName)
         && there("initialStress", volSymmTensorField::typeName)
        );
}


Foam::scalar Foam::granularMechanicsModels::equilibrium::springs
(
    const granularProperties& properties
) const
{
    const bool discs = !law_->elastic() && !grains_.model().isThreeDimensional();
    const keyTable& keys = stressLaw::equilibriumKeys;
    const word key("wallCompliance");
    const scalar compliance =
        discs ? keys.number(dict_, key) : keys.number(dict_, key, 0, 0);
    return
        compliance > 0
      ? law_->scale()/(compliance*properties.meanRadius().value())
      : 0;
}


void Foam::granularMechanicsModels::equilibrium::setResidual()
{
    const scalar scale = law_->scale();
    const keyTable& keys = stressLaw::equilibriumKeys;
    tolerance_ = keys.number(dict_, "residual", law_->residual(), scale);
    if (!dict_.found("residual"))
    {
        tolerance_ =
            min(tolerance_, dict_.getOrDefault<scalar>("maxResidual", GREAT));
    }
    maxResidual_ = keys.number
    (
        dict_, "maxResidual", max(20*tolerance_, unsupported_), scale,
        tolerance_
    );
    walls_.setPressing(law_->pressure());
}


Foam::FixedList<Foam::vector, 3>
Foam::granularMechanicsModels::equilibrium::directions
(
    const label pointi
) const
{
    FixedList<vector, 3> result
    ({
        vector(1, 0, 0), vector(0, 1, 0), vector(0, 0, 1)
    });
    const label r = nodes_.radial();
    if (r >= 0)
    {
        vector out(mesh_.points()[pointi]);
        out[1 - r] = 0;
        result[r] = mag(out) > VSMALL ? out/mag(out) : result[r];
    }
    return result;
}


Foam::tensor
Foam::granularMechanicsModels::equilibrium::gradient(const label celli) const
{
    const label dim = nodes_.dim(), r = nodes_.radial();
    tensor F(tensor::I);
    for
    (
        label i = nodes_.cellStarts()[celli];
        i < nodes_.cellStarts()[celli + 1];
        ++i
    )
    {
        const label node = nodes_.cellNodes()[i];
        for (label j = 0; j < dim; ++j)
        {
            for (label k = 0; k < dim; ++k)
            {
                F(j, k) += u_[dim*node + j]*reference_.gradient[dim*i + k];
            }
        }
        if (r >= 0)
        {
            F.zz() += u_[2*node + r]*reference_.hoop[i];
        }
    }
    return F;
}


void Foam::granularMechanicsModels::equilibrium::findMetric()
{
    if (law_->elastic())
    {
        return;
    }
    if (grains_.model().isThreeDimensional())
    {
        inverse_.resize(mesh_.nCells());
        forAll(inverse_, celli)
        {
            const tensor F(gradient(celli));
            inverse_[celli] = inv(F)*std::sqrt(det(F));
        }
        return;
    }
    metric_.resize(mesh_.nCells());
    forAll(metric_, celli)
    {
        const tensor F(gradient(celli));
        const scalar root = std::sqrt(F.xx()*F.yy() - F.xy()*F.yx());
        metric_[celli][0] = F.xx()/root;
        metric_[celli][1] = F.xy()/root;
        metric_[celli][2] = F.yx()/root;
        metric_[celli][3] = F.yy()/root;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::symmTensorField&
Foam::granularMechanicsModels::equilibrium::pulledBack(const symmTensorField& K)
{
    if (law_->elastic())
    {
        return K;
    }
    pulledBack_ = K;
    forAll(inverse_, celli)
    {
        // J F^-1.K.F^-T
        const tensor& m = inverse_[celli];
        const tensor back(m & K[celli] & m.T());
        pulledBack_[celli] = symmTensor
        (
            back.xx(), back.xy(), back.xz(), back.yy(), back.yz(), back.zz()
        );
    }
    forAll(metric_, celli)
    {
        // J F^-1.K.F^-T, in which the adjugate of F is J F^-1
        const FixedList<scalar, 4>& m = metric_[celli];
        const scalar xx = K[celli].xx(), yy = K[celli].yy(), xy = K[celli].xy();
        symmTensor& back = pulledBack_[celli];
        back.xx() = sqr(m[3])*xx - 2*m[1]*m[3]*xy + sqr(m[1])*yy;
        back.yy() = sqr(m[2])*xx - 2*m[0]*m[2]*xy + sqr(m[0])*yy;
        back.xy() = (m[0]*m[3] + m[1]*m[2])*xy - m[2]*m[3]*xx - m[0]*m[1]*yy;
    }
    return pulledBack_;
}


// ************************************************************************* //
