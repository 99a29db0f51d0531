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

#include "grainFields.H"
#include "wallConditions.H"
#include "fvMatrices.H"
#include "laplacianScheme.H"
#include "gradScheme.H"
#include "fixedGradientFvPatchFields.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Cosine between the normal of a face and the vertical below which it is a side
static const scalar sideCosine = 0.3;

static const keyTable restKeys
(
    "restStress",
    {
        {
            "lateral",
            "horizontal over vertical stress. The log says if packings of this"
            " porosity cannot carry it; the run then begins with the most they"
            " can", "-", "0 to 10", "required"
        },
        {"surface", "pressure on the surface", "Pa", "0 to 1e12", "0"},
        {
            "wallFriction",
            "share of the friction of upright walls that carries weight at the"
            " start, with `mechanics equilibrium`", "-", "0 to 1", "1"
        }
    }
);

//- Shear stress that brings the force of the walls into the bed: the gradient of
//- a potential with this divergence, and these values along the normals of walls
static tmp<vectorField> shearWithin
(
    const fvMesh& mesh,
    const scalarField& divergence,
    const List<scalarField>& atWalls
)
{
    volScalarField potential
    (
        IOobject
        (
            "shearPotential", mesh.time().timeName(), mesh, IOobject::NO_READ,
            IOobject::NO_WRITE, false
        ),
        mesh,
        dimensionedScalar(dimless, Zero),
        fixedGradientFvPatchScalarField::typeName
    );
    scalar rest = -sum(mesh.V()*divergence);
    forAll(potential.boundaryField(), patchi)
    {
        fvPatchScalarField& patch = potential.boundaryFieldRef()[patchi];
        if (isA<fixedGradientFvPatchScalarField>(patch))
        {
            refCast<fixedGradientFvPatchScalarField>(patch).gradient() =
                atWalls[patchi];
            rest += sum(atWalls[patchi]*patch.patch().magSf());
        }
    }
    // As a first guess without correction where cells are slanted
    IStringStream laplacian("Gauss linear uncorrected"), gradient("Gauss linear");
    fvScalarMatrix equation
    (
        fv::laplacianScheme<scalar, scalar>::New(mesh, laplacian).ref().fvmLaplacian
        (
            surfaceScalarField
            (
                IOobject
                (
                    "one", mesh.time().timeName(), mesh, IOobject::NO_READ,
                    IOobject::NO_WRITE, false
                ),
                mesh,
                dimensionedScalar("one", dimless, 1)
            ),
            potential
        )
    );
    // Where the section of a bed changes along gravity, the walls take more or
    // less than the cells give: all cells take the rest equally
    rest = returnReduce(rest, sumOp<scalar>())/gSum(mesh.V());
    equation.source() += mesh.V()*(divergence + rest);
    equation.setReference(Pstream::master() ? 0 : -1, 0);
    dictionary controls;
    controls.add("solver", "PCG");
    controls.add("preconditioner", "DIC");
    controls.add("tolerance", 1e-13);
    controls.add("relTol", 0);
    equation.solve(controls);
    return tmp<vectorField>::New
    (
        fv::gradScheme<scalar>::New(mesh, gradient)().calcGrad
        (
            potential, "gradient"
        )().primitiveField()
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::List<Foam::scalarField> Foam::grainFields::sideFriction
(
    const vector& up
) const
{
    const dictionary walls
    (
        properties_.subOrEmptyDict("equilibriumCoeffs").subOrEmptyDict("walls")
    );
    List<scalarField> result(mesh_.boundary().size());
    forAll(result, patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const scalar friction =
            polyPatch::constraintType(patch.type())
          ? 0
          : wallConditions::frictionOf
            (
                walls.subOrEmptyDict(patch.name()), *model_, !model_->isThreeDimensional()
            ).limit;
        result[patchi].resize(patch.size(), Zero);
        forAll(patch, i)
        {
            const vector& face = patch.Sf()[i];
            const bool upright = mag(face & up) < sideCosine*mag(face);
            result[patchi][i] = upright ? friction : 0;
        }
    }
    return result;
}


Foam::tmp<Foam::symmTensorField> Foam::grainFields::restStress()
{
    const dictionary dict(properties_.restStressDict());
    restKeys.check(dict);
    const scalar lateral = restKeys.number(dict, "lateral");
    const scalar above = restKeys.number(dict, "surface");
    const scalar share = restKeys.number(dict, "wallFriction");

    // With the mean density and cross-section: where they vary, the first step
    // finds the rest
    const scalarField& V = mesh_.V();
    const scalar volume = gSum(V);
    const vector& g = properties_.gravity();
    const vector up(-g/mag(g));
    const scalar weight =
        mag(g)*properties_.density().value()*gSum(V*initialSolid())/volume;
    const scalar top = gMax((mesh_.points() & up)());
    scalarField vertical(top - (mesh_.C().primitiveField() & up));
    symmTensorField shear(vertical.size(), Zero);
    List<scalarField> friction;
    scalar rough = 0;
    if
    (
        share > 0
     && properties_.getOrDefault<word>("mechanics", "none") == "equilibrium"
    )
    {
        friction = sideFriction(up);
        forAll(friction, patchi)
        {
            rough += sum(friction[patchi]*mesh_.boundary()[patchi].magSf());
        }
        rough = lateral*share/volume*returnReduce(rough, sumOp<scalar>());
    }
    if (rough > 0)
    {
        // Janssen (1895): d sigma/dz = weight - rough sigma
        restFriction_ = share;
        const scalar depth = 1/rough;
        const scalar height = top - gMin((mesh_.points() & up)());
        const auto at = [&](const scalar z)
        {
            return
                weight*depth + (above - weight*depth)*std::exp(-z/depth);
        };
        for (scalar& z : vertical)
        {
            z = at(z);
        }
        forAll(friction, patchi)
        {
            const vectorField& C = mesh_.boundary()[patchi].Cf();
            forAll(C, i)
            {
                friction[patchi][i] *= lateral*share*at(top - (C[i] & up));
            }
        }
        const vectorField along(shearWithin(mesh_, rough*vertical, friction));
        shear = twoSymm((along - (along & up)*up)*up);
        Info<< "Rest: walls carry "
            << 100*(1 - at(height)/(above + weight*height))
            << " % of the weight and of the pressure on the surface; "
            << at(height) << " Pa are left at the foot (Janssen)" << nl << endl;
    }
    else
    {
        vertical = above + weight*vertical;
    }
    const symmTensor shape
    (
        lateral*symmTensor(symmTensor::I) + (1 - lateral)*sqr(up)
    );
    return shear - vertical*shape;
}


// ************************************************************************* //
