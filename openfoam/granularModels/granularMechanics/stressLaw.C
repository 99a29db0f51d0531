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

// * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Uniform medium for the preconditioner: Lame's constants, divided by E r/l,
//- with values of densely packed grains
static const scalar uniformLambda = 0.25;
static const scalar uniformShear = 0.3;

//- Usual pressure, and usual imbalance that is accepted, of discs and of elastic
//- solids, divided by the unit of the stiffness
static const scalar pressureShare = 0.05;
static const scalar grainResidual = 1e-4;
static const scalar elasticResidual = 1e-9;

//- Spheres: unit of the stiffness over E* (p/E*)^(1/3), of which packings have
//- 0.4 to 0.55 in uniaxial compression and 0.12 to 0.17 in shear; imbalance over the mean
//- pressure; and least pressure over E* for both, a tenth of that of a bed under
//- its own weight, for beds that bear nothing
static const scalar hertzStiffness = 0.5;
static const scalar sphereResidual = 1e-3;
static const scalar leastPressure = 1e-9;

//- Components of a symmTensor in the order of the granularModel
static const label modelOrder[] =
{
    symmTensor::XX, symmTensor::YY, symmTensor::ZZ,
    symmTensor::XY, symmTensor::XZ, symmTensor::YZ
};
static const label planeOrder[] =
{
    symmTensor::XX, symmTensor::YY, symmTensor::XY
};

//- Least ratio of a pivot to its diagonal of a cell's stiffness matrix, and
//- factor by which the other components are reduced until it is reached
static const scalar leastPivot = 0.05;
static const scalar reduction = 0.8;

//- The same for grains that do not slide, and their shear modulus over that of
//- uniaxial compression
static const scalar cautiousPivot = 0.8;
static const scalar cautiousShear = 0.35;

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

//- Whether all pivots of the Cholesky factorisation of a symmetric matrix exceed
//- this share of their diagonal
template<label N>
static bool hasPivots(const scalar (&c)[N][N], const scalar least)
{
    scalar v[N][N], pivot[N];
    for (label i = 0; i < N; ++i)
    {
        pivot[i] = c[i][i];
        for (label j = 0; j < i; ++j)
        {
            v[i][j] = c[i][j];
            for (label k = 0; k < j; ++k)
            {
                v[i][j] -= v[i][k]*v[j][k]/pivot[k];
            }
            pivot[i] -= sqr(v[i][j])/pivot[j];
        }
        if (i && !(pivot[i] > least*c[i][i]))
        {
            return false;
        }
    }
    return true;
}

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
    const word name(equilibriumKeys.choice(dict, "law"));
    if (name == "elastic")
    {
        const dictionary& surrogate = properties.surrogateDict();
        const word& type = grains.model().type();
        if
        (
            type != "constant"
         || !surrogate.optionalSubDict("constantCoeffs").found("conductivity")
        )
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'law' is elastic with surrogate type " << type
                << ", allowed: type constant with the entry 'conductivity',"
                << " because a solid without grains has no other"
                << " conductivity" << exit(FatalIOError);
        }
        return autoPtr<stressLaw>
        (
            new elasticLaw(dict.subDict("elasticCoeffs"), grains, mesh)
        );
    }
    if (grains.model().isThreeDimensional())
    {
        return autoPtr<stressLaw>(new sphereLaw(properties, grains, mesh));
    }
    if (!mesh.plane())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'law' is grains (the default), and the mesh "
            << (mesh.dim() == 3 ? "has three dimensions" : "is a wedge")
            << ": discs that move are modelled in the plane alone, on a mesh of one"
            << " layer between patches of type empty. Allowed here: surrogate"
            << " type spheres, or law elastic, with"
            << " elasticCoeffs { youngModulus; poissonRatio; }"
            << exit(FatalIOError);
    }
    if (grains.model().type() == "constant")
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'law' is grains (the default), and surrogate type constant"
            << " has no grains that resist a strain. Allowed here: law elastic,"
            << " with elasticCoeffs { youngModulus; poissonRatio; }, mechanics"
            << " none, or another surrogate" << exit(FatalIOError);
    }
    return autoPtr<stressLaw>(new grainLaw(properties, grains, mesh));
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::stressLaw::stressLaw(granularState& grains, const elementMesh& mesh)
:
    grains_(grains),
    order_({symmTensor::XX, symmTensor::YY, symmTensor::XY})
{
    if (mesh.dim() == 3)
    {
        order_ = labelList
        ({
            symmTensor::XX, symmTensor::YY, symmTensor::ZZ,
            symmTensor::XY, symmTensor::YZ, symmTensor::XZ
        });
    }
    else if (mesh.radial() >= 0)
    {
        order_.append(symmTensor::ZZ);
    }
    stress_ = columns(order_.size(), scalarField(mesh.mesh().nCells(), Zero));
}


Foam::grainLaw::grainLaw
(
    const granularProperties& properties,
    granularState& grains,
    const elementMesh& mesh
)
:
    stressLaw(grains, mesh),
    shears_(mesh.dim() == 3 ? 3 : 1),
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
    const label cells = mesh.mesh().nCells();
    const bool spatial = grains.model().isThreeDimensional();
    const label own = grains.model().components(), n = order_.size();
    places_.resize(own);
    forAll(places_, i)
    {
        places_[i] = order_.find(spatial ? modelOrder[i] : planeOrder[i]);
    }
    tangent_ = columns(n*n, scalarField(cells, Zero));
    derivatives_ = List<scalar*>(own*own, nullptr);
    for (label i = 0; i < own; ++i)
    {
        for (label j = 0; j < own; ++j)
        {
            if (places_[i] >= 0 && places_[j] >= 0)
            {
                derivatives_[own*i + j] =
                    tangent_[n*places_[i] + places_[j]].data();
            }
        }
    }

    // The columns of the gradient become those of strain and rotation in place:
    // see find()
    strain_.strain = columns(own, scalarField(cells, Zero));
    strain_.rotation = columns(spatial ? 3 : 1, scalarField(cells, Zero));
    columns& e = strain_.strain;
    columns& turn = strain_.rotation;
    List<scalarField*> from;
    if (mesh.dim() == 3)
    {
        from = List<scalarField*>
        ({
            &e[0], &e[3], &e[4], &turn[2], &e[1], &e[5], &turn[1], &turn[0],
            &e[2]
        });
    }
    else
    {
        from = List<scalarField*>
        ({
            &e[0], spatial ? &e[3] : &e[2], &turn.last(), &e[1]
        });
        if (mesh.radial() >= 0)
        {
            from.append(&e[2]);
        }
    }
    gradient_.resize(from.size());
    forAll(from, i)
    {
        gradient_.set(i, from[i]);
    }
}


Foam::sphereLaw::sphereLaw
(
    const granularProperties& properties,
    granularState& grains,
    const elementMesh& mesh
)
:
    grainLaw(properties, grains, mesh),
    mesh_(mesh.mesh()),
    modulus_(grains.model().contactModulus()),
    pressure_(leastPressure*modulus_)
{}


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


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::grainLaw::take()
{
    forAll(places_, i)
    {
        if (places_[i] >= 0)
        {
            stress_[places_[i]].transfer(found_[i]);
        }
    }
}


Foam::scalar Foam::sphereLaw::mean(const scalarField& pressure) const
{
    const scalarField& V = mesh_.V();
    return max
    (
        gSum(V*max(pressure, scalar(0)))/gSum(V), leastPressure*modulus_
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::stressLaw::columns
Foam::stressLaw::split(const symmTensorField& stress) const
{
    columns result(order_.size());
    forAll(order_, k)
    {
        result[k] = stress.component(order_[k]);
    }
    return result;
}


Foam::scalar Foam::stressLaw::usualPressure() const
{
    return pressureShare*scale();
}


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
    found_ = grains_.endStress();
    take();
}


void Foam::grainLaw::find(const bool tangent)
{
    // On entry a shear and its rotation are the components ij and ji of the
    // gradient, i before j; the angle about y turns z towards x
    columns& e = strain_.strain;
    columns& turn = strain_.rotation;
    for (label k = 0; k < shears_; ++k)
    {
        scalarField& shear = e[e.size() - (e.size() == 6 ? 3 : 1) + k];
        scalarField& angle = turn[turn.size() - 1 - k];
        const scalar half = k == 1 ? -0.5 : 0.5;
        forAll(shear, celli)
        {
            const scalar upper = shear[celli], lower = angle[celli];
            shear[celli] = upper + lower;
            angle[celli] = half*(lower - upper);
        }
    }
    if (e.size() == 6)
    {
        findStretch();
    }
    grains_.evaluateTrial
    (
        strain_, found_, tangent ? derivatives_ : List<scalar*>()
    );
    take();
}


void Foam::grainLaw::addTangent()
{
    grains_.evaluateTrial(strain_, found_, derivatives_);
}


void Foam::grainLaw::findStretch()
{
    columns& e = strain_.strain;
    forAll(e[0], celli)
    {
        const symmTensor h
        (
            0.5*e[0][celli], 0.25*e[3][celli], 0.25*e[4][celli],
            0.5*e[1][celli], 0.25*e[5][celli], 0.5*e[2][celli]
        );
        const tensor stretch(2*(h & inv(symmTensor::I - h)));
        e[0][celli] = stretch.xx();
        e[1][celli] = stretch.yy();
        e[2][celli] = stretch.zz();
        e[3][celli] = stretch.xy() + stretch.yx();
        e[4][celli] = stretch.xz() + stretch.zx();
        e[5][celli] = stretch.yz() + stretch.zy();
    }
}


void Foam::grainLaw::findTangent()
{
    for (columns* all : {&strain_.strain, &strain_.rotation})
    {
        for (scalarField& column : *all)
        {
            column = 0;
        }
    }
    grains_.evaluateTrial(strain_, found_, derivatives_);
}


void Foam::grainLaw::stiffen(const label caution, const scalar leastShare)
{
    switch (order_.size())
    {
        case 3: stiffen<3>(caution, leastShare); break;
        case 4: stiffen<4>(caution, leastShare); break;
        default: stiffen<6>(caution, leastShare);
    }
}


template<Foam::label N>
void Foam::grainLaw::stiffen(const label caution, const scalar leastShare)
{
    const scalar least = leastShare*scale_;
    const scalar leastRatio = caution > 1 ? cautiousPivot : leastPivot;
    const scalar factor = caution > 1 ? std::pow(2.0, caution - 2) : 1;
    bool normal[N];
    for (label i = 0; i < N; ++i)
    {
        const label k = order_[i];
        normal[i] =
            k == symmTensor::XX || k == symmTensor::YY || k == symmTensor::ZZ;
    }

    forAll(tangent_[0], celli)
    {
        scalar c[N][N];
        for (label k = 0; k < N*N; ++k)
        {
            c[k/N][k % N] = tangent_[k][celli];
        }
        scalar most = 0;
        for (label i = 0; i < N; ++i)
        {
            c[i][i] = max(c[i][i], normal[i] ? least : 0.5*least);
            most = normal[i] ? max(most, c[i][i]) : most;
        }
        if (caution)
        {
            // A matrix that is symmetric and positive
            for (label i = 0; i < N; ++i)
            {
                for (label j = 0; j < i; ++j)
                {
                    c[i][j] = c[j][i] = 0.5*(c[i][j] + c[j][i]);
                }
            }
            for (label i = 0; caution > 1 && i < N; ++i)
            {
                c[i][i] =
                    normal[i]
                  ? factor*most
                  : max(factor*c[i][i], cautiousShear*factor*most);
            }
            for (label k = 0; k < 20 && !hasPivots(c, leastRatio); ++k)
            {
                for (label i = 0; i < N; ++i)
                {
                    for (label j = 0; j < N; ++j)
                    {
                        c[i][j] *= i == j ? 1 : reduction;
                    }
                }
            }
        }
        for (label k = 0; k < N*N; ++k)
        {
            tangent_[k][celli] = c[k/N][k % N];
        }
    }
}


Foam::scalar Foam::grainLaw::residual() const
{
    return grainResidual*scale_;
}


Foam::scalar Foam::sphereLaw::pressure() const
{
    const granularState::stressColumns s(grains_.endStress());
    return mean((s[0] + s[1] + s[2])/(-3));
}


Foam::scalar Foam::sphereLaw::residual() const
{
    return sphereResidual*pressure();
}


void Foam::sphereLaw::begin(const volSymmTensorField& initialStress)
{
    pressure_ = mean(tr(initialStress.primitiveField())/(-3));
    scale_ = hertzStiffness*modulus_*std::cbrt(pressure_/modulus_);
}


Foam::tmp<Foam::volSymmTensorField> Foam::grainLaw::initialStress() const
{
    return tmp<volSymmTensorField>::New(grains_.stress());
}


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
