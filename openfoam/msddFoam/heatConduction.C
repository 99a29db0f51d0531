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

#include "heatConduction.H"
#include "mappedPatchBase.H"
#include "mixedFvPatchFields.H"
#include "coupledPolyPatch.H"
#include "wedgePolyPatch.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "unitConversion.H"
#include "fvcGrad.H"
#include "fvmLaplacian.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The component of K that is n.K.n at a face along an axis
static inline direction across(const vector& Sf)
{
    return mag(Sf.y()) > mag(Sf.x()) ? symmTensor::YY : symmTensor::XX;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::heatConduction::heatConduction
(
    volScalarField& T,
    const granularProperties& properties,
    const granularState& grains,
    const bool alone,
    const bool wallsReadK
)
:
    T_(T),
    mesh_(T.mesh()),
    aligned_(alone && isAligned()),
    crossed_(!grains.diagonal()),
    wallsReadK_(wallsReadK),
    coupled_(anyCoupled()),
    factor_(properties.conductivityFactor()),
    Kzz_(factor_*grains.model().conductivityZZ()),
    spatial_(grains.model().isThreeDimensional()),
    K_
    (
        IOobject("K", mesh_.time().timeName(), mesh_),
        mesh_,
        dimensionedSymmTensor
        (
            properties.thermalConductivity().dimensions(), Zero
        ),
        extrapolatedCalculatedFvPatchSymmTensorField::typeName
    ),
    gradient_
    (
        IOobject("gradient", mesh_.time().timeName(), mesh_),
        mesh_,
        dimensionedVector(dimTemperature/dimLength, Zero)
    ),
    slanted_(false)
{
    if (!aligned_)
    {
        mesh_.setFluxRequired(T.name());
        findFeet();
    }
    set(grains.conductivity().primitiveField());
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::heatConduction::addAligned(fvScalarMatrix& equation) const
{
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const scalarField& weights = mesh_.weights();
    const scalarField& deltaCoeffs = mesh_.deltaCoeffs();
    const vectorField& Sf = mesh_.Sf();
    const scalarField& magSf = mesh_.magSf();
    const symmTensorField& K = K_.primitiveField();
    scalarField& upper = equation.upper();
    scalarField& diag = equation.diag();

    forAll(owner, facei)
    {
        const label P = owner[facei], N = neighbour[facei];
        const direction k = across(Sf[facei]);
        const scalar onFace = weights[facei]*(K[P][k] - K[N][k]) + K[N][k];
        const scalar flux = deltaCoeffs[facei]*(magSf[facei]*onFace);

        upper[facei] = -flux;
        diag[P] += flux;
        diag[N] += flux;
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const fvPatchScalarField& pT = T_.boundaryField()[patchi];
        const labelUList& cells = patch.faceCells();
        scalarField& internal = equation.internalCoeffs()[patchi];
        scalarField& boundary = equation.boundaryCoeffs()[patchi];
        symmTensorField other;

        if (pT.coupled())
        {
            const scalarField& delta =
                mesh_.deltaCoeffs().boundaryField()[patchi];
            other = K_.boundaryField()[patchi].patchNeighbourField();
            internal = pT.gradientInternalCoeffs(delta);
            boundary = pT.gradientBoundaryCoeffs(delta);
        }
        else
        {
            internal = pT.gradientInternalCoeffs();
            boundary = pT.gradientBoundaryCoeffs();
        }
        forAll(cells, facei)
        {
            const direction k = across(patch.Sf()[facei]);
            scalar onFace = K[cells[facei]][k];
            if (other.size())
            {
                const scalar N = other[facei][k];
                onFace = patch.weights()[facei]*(onFace - N) + N;
            }
            const scalar gamma = patch.magSf()[facei]*onFace;
            internal[facei] *= -gamma;
            boundary[facei] *= gamma;
        }
    }
}


void Foam::heatConduction::findGradient() const
{
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const scalarField& weights = mesh_.weights();
    const vectorField& Sf = mesh_.Sf();
    vectorField& g = gradient_.primitiveFieldRef();

    g = Zero;
    forAll(owner, facei)
    {
        const label P = owner[facei], N = neighbour[facei];
        const vector part
        (
            Sf[facei]*(weights[facei]*(T_[P] - T_[N]) + T_[N])
        );
        g[P] += part;
        g[N] -= part;
    }
    for (const fvPatchScalarField& pT : T_.boundaryField())
    {
        const fvPatch& patch = pT.patch();
        const labelUList& cells = patch.faceCells();
        const vectorField& S = patch.Sf();
        scalarField onFaces;
        if (pT.coupled())
        {
            const scalarField& w = patch.weights();
            onFaces =
                w*pT.patchInternalField() + (1 - w)*pT.patchNeighbourField();
        }
        const scalarField& values = pT;
        const scalarField& T = pT.coupled() ? onFaces : values;
        forAll(cells, facei)
        {
            g[cells[facei]] += S[facei]*T[facei];
        }
    }
    g /= mesh_.V();
    if (coupled_)
    {
        gradient_.correctBoundaryConditions();
    }
}


void Foam::heatConduction::addCrossed
(
    fvScalarMatrix& equation,
    List<scalarField>& faceHeat
) const
{
    findGradient();
    const vectorField& g = gradient_.primitiveField();
    const symmTensorField& K = K_.primitiveField();
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const scalarField& weights = mesh_.weights();
    const vectorField& Sf = mesh_.Sf();
    scalarField& source = equation.source();
    const auto crossed = [](const scalar Kxy, const vector& S, const vector& g)
    {
        return Kxy*(S.x()*g.y() + S.y()*g.x());
    };

    forAll(owner, facei)
    {
        const label P = owner[facei], N = neighbour[facei];
        const scalar w = weights[facei];
        const scalar heat = crossed
        (
            w*(K[P].xy() - K[N].xy()) + K[N].xy(),
            Sf[facei],
            w*(g[P] - g[N]) + g[N]
        );
        source[P] += heat;
        source[N] -= heat;
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const bool coupled = patch.coupled();
        // No heat passes a wall of given gradient because of a change of T
        // along it: the gradient normal to such a wall stands for its heat
        if (!coupled && !isGiven(T_.boundaryField()[patchi]))
        {
            continue;
        }
        const labelUList& cells = patch.faceCells();
        const auto onFaces = [&](const auto& field)
        {
            const auto& values = field.boundaryField()[patchi];
            auto inner(values.patchInternalField());
            if (!coupled)
            {
                return inner;
            }
            const scalarField& w = patch.weights();
            return w*inner + (1 - w)*values.patchNeighbourField();
        };
        const symmTensorField onK(onFaces(K_));
        const vectorField onG(onFaces(gradient_));
        forAll(cells, facei)
        {
            const scalar heat =
                crossed(onK[facei].xy(), patch.Sf()[facei], onG[facei]);
            source[cells[facei]] += heat;
            if (!coupled)
            {
                faceHeat[patchi][facei] += heat;
            }
        }
    }
}


void Foam::heatConduction::insulateWalls()
{
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const bool given = isGiven(T_.boundaryField()[patchi]);
        if (patch.coupled() || (given && !isA<mappedPatchBase>(patch.patch())))
        {
            continue;
        }
        const vectorField n(patch.nf());
        fvPatchSymmTensorField& Kp = K_.boundaryFieldRef()[patchi];
        forAll(Kp, facei)
        {
            // Without the part that leads heat through the wall when T changes
            // along it: K - (n t + t n), with t the tangential part of K.n
            const vector normal(Kp[facei] & n[facei]);
            const vector t(normal - n[facei]*(n[facei] & normal));
            Kp[facei] -= twoSymm(n[facei]*t);
        }
    }
}


void Foam::heatConduction::addTensor
(
    fvScalarMatrix& equation,
    List<scalarField>& faceHeat
) const
{
    fvScalarMatrix conduction(fvm::laplacian(K_, T_, "laplacian(K,T)"));

    equation.upper() = -conduction.upper();
    equation.diag() -= conduction.diag();
    equation.source() -= conduction.source();
    forAll(mesh_.boundary(), patchi)
    {
        equation.internalCoeffs()[patchi] = -conduction.internalCoeffs()[patchi];
        equation.boundaryCoeffs()[patchi] = -conduction.boundaryCoeffs()[patchi];
        if (!mesh_.boundary()[patchi].coupled())
        {
            faceHeat[patchi] =
                conduction.faceFluxCorrectionPtr()->boundaryField()[patchi];
        }
    }
    if (slanted_)
    {
        addWallCorrection(equation, faceHeat);
    }
}


void Foam::heatConduction::addWallCorrection
(
    fvScalarMatrix& equation,
    List<scalarField>& faceHeat
) const
{
    const volVectorField gradT(fvc::grad(T_));

    forAll(feet_, patchi)
    {
        if (feet_[patchi].empty())
        {
            continue;
        }
        const fvPatch& patch = mesh_.boundary()[patchi];
        const labelUList& cells = patch.faceCells();
        const scalarField& internal = equation.internalCoeffs()[patchi];
        forAll(cells, facei)
        {
            // internal = - n.K.n |S| d(snGrad)/dT
            const scalar heat =
               -internal[facei]
               *(feet_[patchi][facei] & gradT[cells[facei]]);
            equation.source()[cells[facei]] += heat;
            faceHeat[patchi][facei] += heat;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::heatConduction::isGiven(const fvPatchScalarField& wall)
{
    return wall.fixesValue() && !isA<mixedFvPatchScalarField>(wall);
}


void Foam::heatConduction::report() const
{
    Info<< "Conduction: "
        << (!aligned_ ? "tensor laplacian"
          : crossed_ ? "n.K.n on the faces, Kxy explicitly"
          : "n.K.n on the faces (exact here)")
        << nl << endl;
    if (!aligned_)
    {
        reportAngle();
    }
}


void Foam::heatConduction::set(const symmTensorField& K)
{
    symmTensorField& cells = K_.primitiveFieldRef();
    cells = K;
    if (factor_ != 1)
    {
        cells *= factor_;
    }
    if (!spatial_ && Kzz_ != 0)
    {
        for (symmTensor& cell : cells)
        {
            cell.zz() = Kzz_;
        }
    }
    // Exchanged once for all patches and not in a loop over patches: every
    // process must take part equally often, however many neighbours it has
    if (!aligned_ || wallsReadK_ || coupled_)
    {
        K_.correctBoundaryConditions();
    }
    if (!aligned_ || wallsReadK_)
    {
        insulateWalls();
    }
}


void Foam::heatConduction::addTo
(
    fvScalarMatrix& equation,
    List<scalarField>& faceHeat
) const
{
    if (isExplicit())
    {
        // Gradients read T at walls and in cells of other processes, where it
        // is still the one before the last solution
        T_.correctBoundaryConditions();
    }
    if (!aligned_)
    {
        addTensor(equation, faceHeat);
        return;
    }
    addAligned(equation);
    if (crossed_)
    {
        addCrossed(equation, faceHeat);
    }
}


// ************************************************************************* //
