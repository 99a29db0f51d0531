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

#include "stressLaw.H"
#include "granularProperties.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Imbalance that is accepted over the unit of the stiffness
static const scalar elasticResidual = 1e-9;

static const keyTable elasticKeys
(
    "elasticCoeffs",
    {
        {
            "youngModulus", "Young's modulus of the solid", "Pa",
            "1e-15 to 1e15", "required"
        },
        {
            "poissonRatio", "its Poisson's ratio", "-", "-0.99 to 0.49999",
            "required"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

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
    elasticKeys.check(dict);
    const scalar E = elasticKeys.number(dict, "youngModulus");
    const scalar nu = elasticKeys.number(dict, "poissonRatio");
    lambda_ = E*nu/((1 + nu)*(1 - 2*nu));
    shear_ = 0.5*E/(1 + nu);
    if (mesh.plane())
    {
        // The stress along z, which does no work
        order_.append(symmTensor::ZZ);
        stress_.append(scalarField(mesh.mesh().nCells(), Zero));
    }
    gradient_.resize(own_.size());
    forAll(own_, i)
    {
        own_[i].resize(mesh.mesh().nCells(), Zero);
        gradient_.set(i, &own_[i]);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::elasticLaw::scale() const
{
    return shear_/uniformShear;
}


Foam::scalar Foam::elasticLaw::residual() const
{
    return elasticResidual*scale();
}


void Foam::elasticLaw::find(const bool)
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
        forAll(order_, k)
        {
            stress_[k][celli] = sigma[order_[k]];
        }
    }
}


void Foam::elasticLaw::output()
{
    symmTensorField all(stress_[0].size(), Zero);
    forAll(order_, k)
    {
        all.replace(order_[k], stress_[k]);
    }
    grains_.setStress(all);
}


Foam::tmp<Foam::volSymmTensorField> Foam::elasticLaw::initialStress() const
{
    return 0*grains_.stress();
}


// ************************************************************************* //
