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

#include "heatEquation.H"
#include "mappedPatchBase.H"
#include "fvcGrad.H"
#include "fvmLaplacian.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::heatEquation::exchange(const granularState::conductivityColumns& K)
{
    // Exchanged once for all patches and not in a loop over patches: every
    // process must take part equally often, however many neighbours it has
    if (anyCoupled())
    {
        Kxx_.primitiveFieldRef() = K.xx;
        Kyy_.primitiveFieldRef() = K.yy;
        Kxx_.correctBoundaryConditions();
        Kyy_.correctBoundaryConditions();
    }
}


void Foam::heatEquation::addAligned
(
    const granularState::conductivityColumns& K
)
{
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const scalarField& weights = mesh_.weights();
    const scalarField& deltaCoeffs = mesh_.deltaCoeffs();
    scalarField& upper = TEqn_.upper();
    scalarField& diag = TEqn_.diag();

    forAll(owner, facei)
    {
        const label P = owner[facei], N = neighbour[facei];
        const scalar w = weights[facei];
        const scalar x = w*(K.xx[P] - K.xx[N]) + K.xx[N];
        const scalar y = w*(K.yy[P] - K.yy[N]) + K.yy[N];
        const scalar flux =
            deltaCoeffs[facei]*(areaX_[facei]*x + areaY_[facei]*y);

        upper[facei] = -flux;
        diag[P] += flux;
        diag[N] += flux;
    }

    exchange(K);

    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const fvPatchScalarField& pT = T_.boundaryField()[patchi];
        const scalarField& x = patchAreaX_[patchi];
        const scalarField& y = patchAreaY_[patchi];
        const labelUList& cells = patch.faceCells();
        scalarField& internal = TEqn_.internalCoeffs()[patchi];
        scalarField& boundary = TEqn_.boundaryCoeffs()[patchi];

        if (pT.coupled())
        {
            const scalarField otherX
            (
                Kxx_.boundaryField()[patchi].patchNeighbourField()
            );
            const scalarField otherY
            (
                Kyy_.boundaryField()[patchi].patchNeighbourField()
            );
            const scalarField& w = patch.weights();
            const scalarField& delta =
                mesh_.deltaCoeffs().boundaryField()[patchi];

            internal = pT.gradientInternalCoeffs(delta);
            boundary = pT.gradientBoundaryCoeffs(delta);
            forAll(cells, facei)
            {
                const label P = cells[facei];
                const scalar gamma =
                    x[facei]
                   *(w[facei]*(K.xx[P] - otherX[facei]) + otherX[facei])
                  + y[facei]
                   *(w[facei]*(K.yy[P] - otherY[facei]) + otherY[facei]);
                internal[facei] *= -gamma;
                boundary[facei] *= gamma;
            }
        }
        else
        {
            internal = pT.gradientInternalCoeffs();
            boundary = pT.gradientBoundaryCoeffs();
            forAll(cells, facei)
            {
                const label P = cells[facei];
                const scalar gamma = x[facei]*K.xx[P] + y[facei]*K.yy[P];
                internal[facei] *= -gamma;
                boundary[facei] *= gamma;
            }
        }
    }
}


void Foam::heatEquation::findGradient()
{
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const scalarField& weights = mesh_.weights();
    const vectorField& Sf = mesh_.Sf();
    const scalarField& V = mesh_.V();
    scalarField& x = gradX_.primitiveFieldRef();
    scalarField& y = gradY_.primitiveFieldRef();
    x = 0;
    y = 0;

    forAll(owner, facei)
    {
        const label P = owner[facei], N = neighbour[facei];
        const scalar T = weights[facei]*(T_[P] - T_[N]) + T_[N];
        x[P] += Sf[facei].x()*T;
        y[P] += Sf[facei].y()*T;
        x[N] -= Sf[facei].x()*T;
        y[N] -= Sf[facei].y()*T;
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const fvPatchScalarField& pT = T_.boundaryField()[patchi];
        const vectorField& S = mesh_.Sf().boundaryField()[patchi];
        const labelUList& cells = patch.faceCells();
        scalarField T(pT);
        if (pT.coupled())
        {
            const scalarField& w = patch.weights();
            T = w*pT.patchInternalField() + (1 - w)*pT.patchNeighbourField();
        }
        forAll(cells, facei)
        {
            x[cells[facei]] += S[facei].x()*T[facei];
            y[cells[facei]] += S[facei].y()*T[facei];
        }
    }
    x /= V;
    y /= V;
    if (anyCoupled())
    {
        gradX_.correctBoundaryConditions();
        gradY_.correctBoundaryConditions();
    }
}


void Foam::heatEquation::addCrossed
(
    const granularState::conductivityColumns& K
)
{
    // Gradients read T at walls and in cells of other processes, where it is
    // still the one before the last solution
    T_.correctBoundaryConditions();
    findGradient();
    Kxy_.primitiveFieldRef() = K.xy;
    if (anyCoupled())
    {
        Kxy_.correctBoundaryConditions();
    }

    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const scalarField& weights = mesh_.weights();
    const vectorField& Sf = mesh_.Sf();
    scalarField& source = TEqn_.source();

    forAll(owner, facei)
    {
        const label P = owner[facei], N = neighbour[facei];
        const scalar w = weights[facei];
        const scalar Kxy = w*(K.xy[P] - K.xy[N]) + K.xy[N];
        const scalar x = w*(gradX_[P] - gradX_[N]) + gradX_[N];
        const scalar y = w*(gradY_[P] - gradY_[N]) + gradY_[N];
        const scalar heat = Kxy*(Sf[facei].x()*y + Sf[facei].y()*x);
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
        const vectorField& S = mesh_.Sf().boundaryField()[patchi];
        const labelUList& cells = patch.faceCells();
        const auto onFaces = [&](const volScalarField& field)
        {
            const fvPatchScalarField& values = field.boundaryField()[patchi];
            tmp<scalarField> inner(values.patchInternalField());
            if (!coupled)
            {
                return inner;
            }
            const scalarField& w = patch.weights();
            return w*inner + (1 - w)*values.patchNeighbourField();
        };
        const scalarField Kxy(onFaces(Kxy_));
        const scalarField x(onFaces(gradX_)), y(onFaces(gradY_));
        forAll(cells, facei)
        {
            const scalar heat =
                Kxy[facei]*(S[facei].x()*y[facei] + S[facei].y()*x[facei]);
            source[cells[facei]] += heat;
            if (!coupled)
            {
                faceHeat_[patchi][facei] += heat;
            }
        }
    }
}


void Foam::heatEquation::insulateWalls()
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
        fvPatchSymmTensorField& Kp = K_().boundaryFieldRef()[patchi];
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


void Foam::heatEquation::setTensor(const granularState::conductivityColumns& K)
{
    symmTensorField& cells = K_().primitiveFieldRef();
    forAll(cells, celli)
    {
        cells[celli].xx() = K.xx[celli];
        cells[celli].yy() = K.yy[celli];
    }
    forAll(K.xy, celli)
    {
        cells[celli].xy() = K.xy[celli];
    }
    forAll(K.zz, celli)
    {
        cells[celli].zz() = K.zz[celli];
        cells[celli].xz() = K.xz[celli];
        cells[celli].yz() = K.yz[celli];
    }
    K_().correctBoundaryConditions();
    insulateWalls();
}


void Foam::heatEquation::addTensor()
{
    // The explicit gradients below read T at walls and in cells of other
    // processes, where it is still the one before the last solution
    T_.correctBoundaryConditions();

    fvScalarMatrix conduction(fvm::laplacian(K_(), T_, "laplacian(K,T)"));

    TEqn_.upper() = -conduction.upper();
    TEqn_.diag() -= conduction.diag();
    TEqn_.source() -= conduction.source();
    forAll(mesh_.boundary(), patchi)
    {
        TEqn_.internalCoeffs()[patchi] = -conduction.internalCoeffs()[patchi];
        TEqn_.boundaryCoeffs()[patchi] = -conduction.boundaryCoeffs()[patchi];
        if (!mesh_.boundary()[patchi].coupled())
        {
            faceHeat_[patchi] =
                conduction.faceFluxCorrectionPtr()->boundaryField()[patchi];
        }
    }
    if (slanted_)
    {
        addWallCorrection();
    }
}


void Foam::heatEquation::addWallCorrection()
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
        const scalarField& internal = TEqn_.internalCoeffs()[patchi];
        forAll(cells, facei)
        {
            // internal = - n.K.n |S| d(snGrad)/dT
            const scalar heat =
               -internal[facei]
               *(feet_[patchi][facei] & gradT[cells[facei]]);
            TEqn_.source()[cells[facei]] += heat;
            faceHeat_[patchi][facei] += heat;
        }
    }
}


// ************************************************************************* //
