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

#include "stressLaw.H"
#include "granularProperties.H"

#include <cmath>

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Uniform medium for the preconditioner: Lame's constants, divided by E r/l,
//- with values of densely packed grains
static const scalar uniformLambda = 0.25;
static const scalar uniformShear = 0.3;

//- Least ratio of a pivot to its diagonal of a cell's stiffness matrix, and
//- factor by which the other components are reduced until it is reached
static const scalar leastPivot = 0.05;
static const scalar reduction = 0.8;

//- The same for grains that do not slide, and their shear modulus over that of
//- uniaxial compression
static const scalar cautiousPivot = 0.8;
static const scalar cautiousShear = 0.35;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::stressLaw> Foam::stressLaw::New
(
    const dictionary& dict,
    const granularProperties& properties,
    granularState& grains,
    const elementMesh& mesh
)
{
    const word name(dict.lookupOrDefault<word>("law", "grains"));
    if (name == "elastic")
    {
        return autoPtr<stressLaw>
        (
            new elasticLaw(dict.subDict("elasticCoeffs"), grains, mesh)
        );
    }
    if (name != "grains")
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'law' is " << name << ", allowed: grains, elastic"
            << exit(FatalIOError);
    }
    if (!mesh.plane())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'law' is grains (the default), and the mesh "
            << (mesh.dim() == 3 ? "has three dimensions" : "is a wedge")
            << ": grains that move are known in the plane alone, also those of"
            << " the law of spheres. Allowed here: law elastic, with"
            << " elasticCoeffs { youngModulus; poissonRatio; }. Grains need a"
            << " mesh of one layer between patches of type empty"
            << exit(FatalIOError);
    }
    return autoPtr<stressLaw>(new grainLaw(properties, grains, mesh));
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::stressLaw::stressLaw(granularState& grains, const elementMesh& mesh)
:
    grains_(grains),
    stress_(mesh.dim() == 3 ? 6 : mesh.radial() < 0 ? 3 : 4)
{
    for (scalarField& column : stress_)
    {
        column.resize(mesh.mesh().nCells(), Zero);
    }
}


Foam::grainLaw::grainLaw
(
    const granularProperties& properties,
    granularState& grains,
    const elementMesh& mesh
)
:
    stressLaw(grains, mesh),
    scale_
    (
        properties.youngModulus().value()*properties.meanRadius().value()
    )
{
    if (!grains.model().hasTangent())
    {
        FatalIOErrorInFunction(properties)
            << "Entry 'mechanics' is equilibrium, but the model "
            << grains.model().source() << " has no mechanical tangent"
            << exit(FatalIOError);
    }
    // The columns of the gradient become those of the strain in place: see
    // take()
    gradient_.resize(4);
    label i = 0;
    for
    (
        scalarField* column :
        {&strain_.xx, &strain_.xy, &strain_.rotation, &strain_.yy}
    )
    {
        column->resize(mesh.mesh().nCells(), Zero);
        gradient_.set(i++, column);
    }
}


Foam::elasticLaw::elasticLaw
(
    const dictionary& dict,
    granularState& grains,
    const elementMesh& mesh
)
:
    stressLaw(grains, mesh),
    mesh_(mesh),
    own_(mesh.dim()*mesh.dim() + (mesh.radial() >= 0))
{
    granularProperties::checkKeys(dict, {"youngModulus", "poissonRatio"});
    const scalar E =
        granularProperties::ranged
        (
            dict, "youngModulus", dict.get<scalar>("youngModulus"), SMALL, GREAT
        );
    const scalar nu =
        granularProperties::ranged
        (
            dict, "poissonRatio", dict.get<scalar>("poissonRatio"), -0.99, 0.49999
        );
    lambda_ = E*nu/((1 + nu)*(1 - 2*nu));
    shear_ = 0.5*E/(1 + nu);
    if (mesh.plane())
    {
        // The stress along z, which does no work
        stress_.resize(4);
        stress_[3].resize(mesh.mesh().nCells(), Zero);
    }
    gradient_.resize(own_.size());
    forAll(own_, i)
    {
        own_[i].resize(mesh.mesh().nCells(), Zero);
        gradient_.set(i, &own_[i]);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::grainLaw::take()
{
    stress_[0].transfer(found_.xx);
    stress_[1].transfer(found_.yy);
    stress_[2].transfer(found_.xy);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::grainLaw::lambda() const
{
    return uniformLambda*scale_;
}


Foam::scalar Foam::grainLaw::shear() const
{
    return uniformShear*scale_;
}


void Foam::grainLaw::present()
{
    found_ = grains_.presentStress();
    take();
}


void Foam::grainLaw::find()
{
    // On entry xy and rotation are the components xy and yx of the gradient
    forAll(strain_.xy, celli)
    {
        const scalar xy = strain_.xy[celli], yx = strain_.rotation[celli];
        strain_.xy[celli] = xy + yx;
        strain_.rotation[celli] = 0.5*(yx - xy);
    }
    grains_.tryStrain(strain_, found_, tangent_);
    take();
}


void Foam::grainLaw::findTangent()
{
    strain_.xx = 0;
    strain_.yy = 0;
    strain_.xy = 0;
    strain_.rotation = 0;
    grains_.tryStrain(strain_, found_, tangent_);
}


void Foam::grainLaw::stiffen(const label caution, const scalar leastShare)
{
    const scalar least = leastShare*scale_;
    const scalar leastRatio = caution > 1 ? cautiousPivot : leastPivot;
    const scalar factor = caution > 1 ? std::pow(2.0, caution - 2) : 1;

    forAll(tangent_[0], celli)
    {
        scalar c[9];
        for (label k = 0; k < 9; ++k)
        {
            c[k] = tangent_[k][celli];
        }
        c[0] = max(c[0], least);
        c[4] = max(c[4], least);
        c[8] = max(c[8], 0.5*least);
        if (caution)
        {
            // A matrix that is symmetric and positive
            c[1] = c[3] = 0.5*(c[1] + c[3]);
            c[2] = c[6] = 0.5*(c[2] + c[6]);
            c[5] = c[7] = 0.5*(c[5] + c[7]);
            if (caution > 1)
            {
                c[0] = c[4] = factor*max(c[0], c[4]);
                c[8] = max(factor*c[8], cautiousShear*c[0]);
            }
            // Pivots of the Cholesky factorisation
            for (label k = 0; k < 20; ++k)
            {
                const scalar second = c[4] - sqr(c[1])/c[0];
                const scalar other = c[5] - c[1]*c[2]/c[0];
                const scalar third = c[8] - sqr(c[2])/c[0] - sqr(other)/second;
                if (second > leastRatio*c[4] && third > leastRatio*c[8])
                {
                    break;
                }
                for (const label j : {1, 2, 3, 5, 6, 7})
                {
                    c[j] *= reduction;
                }
            }
        }
        for (label k = 0; k < 9; ++k)
        {
            tangent_[k][celli] = c[k];
        }
    }
}


Foam::tmp<Foam::volSymmTensorField> Foam::grainLaw::initialStress() const
{
    return tmp<volSymmTensorField>::New(grains_.stress());
}


Foam::scalar Foam::elasticLaw::scale() const
{
    return shear_/uniformShear;
}


void Foam::elasticLaw::find()
{
    const scalarField& thermal = grains_.thermalStrain().primitiveField();
    const bool solid = mesh_.dim() == 3;
    const label radial = mesh_.radial();

    forAll(thermal, celli)
    {
        tensor F(tensor::I);
        if (solid)
        {
            for (label i = 0; i < 9; ++i)
            {
                F[i] += own_[i][celli];
            }
        }
        else
        {
            F.xx() += own_[0][celli];
            F.xy() += own_[1][celli];
            F.yx() += own_[2][celli];
            F.yy() += own_[3][celli];
            F.zz() += radial < 0 ? 0 : own_[4][celli];
        }
        // b - 1 without the loss of digits of a difference
        const scalar s = 1 + thermal[celli], J = det(F);
        const tensor G(F - tensor::I);
        const symmTensor e(symm(G + G.T() + (G & G.T())));
        const symmTensor left
        (
            (e - symmTensor::I*thermal[celli]*(2 + thermal[celli]))/sqr(s)
        );
        const scalar logJ =
            std::log1p(tr(G) + invariantII(G) + det(G)) - 3*std::log(s);
        const symmTensor sigma
        (
            (shear_*left + symmTensor::I*(lambda_*logJ))/J
        );
        if (solid)
        {
            stress_[0][celli] = sigma.xx();
            stress_[1][celli] = sigma.yy();
            stress_[2][celli] = sigma.zz();
            stress_[3][celli] = sigma.xy();
            stress_[4][celli] = sigma.yz();
            stress_[5][celli] = sigma.xz();
        }
        else
        {
            stress_[0][celli] = sigma.xx();
            stress_[1][celli] = sigma.yy();
            stress_[2][celli] = sigma.xy();
            stress_[3][celli] = sigma.zz();
        }
    }
}


void Foam::elasticLaw::output()
{
    symmTensorField all(stress_[0].size(), Zero);
    const bool solid = mesh_.dim() == 3;
    forAll(all, celli)
    {
        symmTensor& sigma = all[celli];
        sigma.xx() = stress_[0][celli];
        sigma.yy() = stress_[1][celli];
        if (solid)
        {
            sigma.zz() = stress_[2][celli];
            sigma.xy() = stress_[3][celli];
            sigma.yz() = stress_[4][celli];
            sigma.xz() = stress_[5][celli];
        }
        else
        {
            sigma.xy() = stress_[2][celli];
            sigma.zz() = stress_[3][celli];
        }
    }
    grains_.setStress(all);
}


Foam::tmp<Foam::volSymmTensorField> Foam::elasticLaw::initialStress() const
{
    return 0*grains_.stress();
}


// ************************************************************************* //
