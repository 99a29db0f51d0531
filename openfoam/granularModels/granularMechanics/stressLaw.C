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

//- Usual pressure, and usual imbalance that is accepted, divided by the unit of
//- the stiffness
static const scalar pressureShare = 0.05;
static const scalar grainResidual = 1e-4;

//- Spheres: unit of the stiffness over E* (p/E*)^(1/3), of which packings have
//- 0.4 to 0.55 in uniaxial compression and 0.12 to 0.17 in shear; imbalance over the mean
//- pressure; and least pressure over E* for both, a tenth of that of a bed under
//- its own weight, for beds that carry nothing
static const scalar hertzStiffness = 0.5;
static const scalar sphereResidual = 1e-3;
static const scalar leastPressure = 1e-9;

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
    labelList places(own);
    forAll(places, i)
    {
        places[i] = order_.find(grains.model().order()[i]);
    }
    tangent_ = columns(n*n, scalarField(cells, Zero));
    derivatives_ = List<scalar*>(own*own, nullptr);
    for (label i = 0; i < own; ++i)
    {
        for (label j = 0; j < own; ++j)
        {
            if (places[i] >= 0 && places[j] >= 0)
            {
                derivatives_[own*i + j] =
                    tangent_[n*places[i] + places[j]].data();
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


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

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
    stress_ = split(grains_.endStress());
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
    const symmTensorField& found = grains_.evaluateTrial
    (
        strain_, tangent ? derivatives_ : List<scalar*>()
    );
    forAll(order_, k)
    {
        scalarField& column = stress_[k];
        forAll(found, celli)
        {
            // Compression positive becomes tension positive, of which the
            // derivative is the same
            column[celli] = -found[celli][order_[k]];
        }
    }
}


void Foam::grainLaw::addTangent()
{
    grains_.evaluateTrial(strain_, derivatives_);
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
    grains_.evaluateTrial(strain_, derivatives_);
}


Foam::scalar Foam::grainLaw::residual() const
{
    return grainResidual*scale_;
}


Foam::scalar Foam::sphereLaw::pressure() const
{
    return mean(tr(grains_.endStress())/(-3));
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


// ************************************************************************* //
