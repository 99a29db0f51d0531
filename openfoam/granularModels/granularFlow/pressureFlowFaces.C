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

#include "pressureFlow.H"
#include "fvMatrices.H"
#include "simpleMatrix.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

//- Flux that rounding makes, over what one side of the balance would drive
static const scalar rounded = 1e-13;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::granularFlows::pressure::side Foam::granularFlows::pressure::sideOf
(
    const label celli,
    const scalar length
) const
{
    return
    {
        length, viscous_[celli], perFlux_[celli], porosity_[celli],
        weight_[celli], massFlux_[celli], gradient_[celli],
        gasT_[celli], buoyancy_[celli]
    };
}


Foam::List<Foam::granularFlows::pressure::side>
Foam::granularFlows::pressure::sidesBeyond(const label patchi) const
{
    const auto beyond = [patchi](const volScalarField& field)
    {
        return field.boundaryField()[patchi].patchNeighbourField();
    };
    const scalarField viscous(beyond(viscous_)), perFlux(beyond(perFlux_));
    const scalarField porosity(beyond(porosity_)), weight(beyond(weight_));
    const scalarField T(beyond(gasT_)), buoyancy(beyond(buoyancy_));
    const vectorField G
    (
        massFlux_.boundaryField()[patchi].patchNeighbourField()
    );
    const vectorField gradient
    (
        gradient_.boundaryField()[patchi].patchNeighbourField()
    );
    List<side> result(viscous.size());
    forAll(result, i)
    {
        result[i] =
        {
            0, viscous[i], perFlux[i], porosity[i], weight[i], G[i],
            gradient[i], T[i], buoyancy[i]
        };
    }
    return result;
}


Foam::scalar Foam::granularFlows::pressure::resistance
(
    const side& s,
    const scalar G,
    scalar& change
) const
{
    // f_v changes smoothly with ln G
    const scalar step = 1e-5;
    const scalar factor = drag_.value({s.perFlux*G, s.porosity, 1});
    change =
        s.viscous
       *(drag_.value({(1 + step)*s.perFlux*G, s.porosity, 1}) - factor)/step;
    return s.viscous*factor;
}


Foam::scalar Foam::granularFlows::pressure::linearised
(
    const side* P,
    const side* N,
    const vector& normal,
    const vector& skew,
    const scalar difference,
    const scalar Gn,
    const scalar then,
    scalar& slope
) const
{
    const vector& g = properties_.gravity();
    const scalar length = P->length + (N ? N->length : 0);
    // Positive where the gas is stably stratified
    const scalar stable =
        N ? max((P->T - N->T)/length*(g & normal), scalar(0)) : 0;
    scalar drive = difference, needed = 0, steep = 0, change;
    for (const side* s : {P, N})
    {
        if (!s)
        {
            continue;
        }
        const scalar along2 = max(magSqr(s->G) - sqr(s->G & normal), 0);
        const scalar G2 = max(along2 + sqr(Gn), sqr(guess_));
        const scalar R = resistance(*s, std::sqrt(G2), change);
        drive += s->length*s->weight*(g & normal);
        drive -= s->length/length*(skew & s->gradient);
        const scalar buoyant = s->buoyancy*stable;
        needed += s->length*(R*Gn + buoyant*(Gn - then));
        steep += s->length*(R + change*sqr(Gn)/max(G2, VSMALL) + buoyant);
    }
    slope = 1/steep;
    return Gn + slope*(drive - needed);
}


void Foam::granularFlows::pressure::findGradient()
{
    const vectorField& C = mesh_.C();
    const vector& g = properties_.gravity();
    tensorField squares(psi_.size(), Zero);
    vectorField sums(psi_.size(), Zero);
    const auto add = [&](const label P, const vector& d, const scalar rise)
    {
        const scalar weight = 1/magSqr(d);
        squares[P] += weight*d*d;
        sums[P] += weight*rise*d;
    };
    forAll(mesh_.owner(), facei)
    {
        const label P = mesh_.owner()[facei], N = mesh_.neighbour()[facei];
        const vector d(C[N] - C[P]);
        add(P, d, psi_[N] - psi_[P]);
        add(N, -d, psi_[P] - psi_[N]);
    }
    const auto addPatch = [&](const label patchi, const scalarField& psi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const vectorField d(patch.coupled() ? patch.delta() : patch.Cf() - patch.Cn());
        forAll(psi, facei)
        {
            const label P = patch.faceCells()[facei];
            add(P, d[facei], psi[facei] - psi_[P]);
        }
    };
    boolList open(mesh_.boundary().size(), false);
    forAll(openings_, i)
    {
        open[ports_[i].patch] = openings_[i].isOpen();
        if (openings_[i].isOpen())
        {
            addPatch(ports_[i].patch, psiOf(i));
        }
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (patch.coupled())
        {
            addPatch
            (
                patchi, psi_.boundaryField()[patchi].patchNeighbourField()()
            );
        }
        else if (!open[patchi])
        {
            // Nothing flows through a wall
            const vectorField n(patch.nf());
            forAll(n, facei)
            {
                const label P = patch.faceCells()[facei];
                add(P, n[facei], weight_[P]*(g & n[facei]));
            }
        }
    }
    vectorField& result = gradient_.primitiveFieldRef();
    forAll(result, celli)
    {
        // Nothing is known of the direction across a plane
        const tensor& S = squares[celli];
        result[celli] = inv(S + 1e-12*tr(S)*tensor::I) & sums[celli];
    }
    if (coupled_)
    {
        gradient_.correctBoundaryConditions();
    }
}


void Foam::granularFlows::pressure::setPresent
(
    const label patchi,
    const scalarField& psi,
    const List<side>* beyond
)
{
    const surfaceScalarField& delta = mesh_.nonOrthDeltaCoeffs();
    const surfaceVectorField& skew = mesh_.nonOrthCorrectionVectors();
    const surfaceScalarField& w = mesh_.weights();
    const fvPatch& patch = mesh_.boundary()[patchi];
    const labelUList& cells = patch.faceCells();
    const vectorField normals(patch.nf());
    forAll(cells, facei)
    {
        const label P = cells[facei];
        scalar length = 1/delta.boundaryField()[patchi][facei], here = length;
        vector along(length*skew.boundaryField()[patchi][facei]);
        side n;
        if (beyond)
        {
            here = (1 - w.boundaryField()[patchi][facei])*length;
            n = (*beyond)[facei];
            n.length = length - here;
        }
        else
        {
            const vector d(patch.Cf()[facei] - mesh_.C()[P]);
            here = normals[facei] & d;
            along = here*normals[facei] - d;
        }
        const side p(sideOf(P, here));
        scalar slope;
        const scalar G =
            linearised
            (
                &p, beyond ? &n : nullptr, normals[facei], along,
                psi_[P] - psi[facei],
                flux_.boundaryField()[patchi][facei]/patch.magSf()[facei],
                thermal_.boundaryField()[patchi][facei]
               /patch.magSf()[facei],
                slope
            );
        present_.boundaryFieldRef()[patchi][facei] = patch.magSf()[facei]*G;
        slope_.boundaryFieldRef()[patchi][facei] =
            patch.magSf()[facei]*slope;
    }
}


void Foam::granularFlows::pressure::setPresent()
{
    const bool compressible = gas_.compressible();
    surfaceScalarField::Boundary& presentBf = present_.boundaryFieldRef();
    surfaceScalarField::Boundary& slopeBf = slope_.boundaryFieldRef();
    forAll(psi_, celli)
    {
        const scalar rho =
            gas_.density
            (
                gasT_[celli], gas_.pressure() + toGauge(psi_[celli])
            );
        weight_[celli] =
            sqr(rho)*(compressible ? gas_.gasConstant()*gasT_[celli] : 1);
    }
    if (coupled_)
    {
        psi_.correctBoundaryConditions();
        weight_.correctBoundaryConditions();
        massFlux_.correctBoundaryConditions();
    }
    if (skewed_)
    {
        findGradient();
    }
    const labelUList& owner = mesh_.owner();
    const labelUList& neighbour = mesh_.neighbour();
    const surfaceVectorField& Sf = mesh_.Sf();
    const surfaceScalarField& magSf = mesh_.magSf();
    const surfaceScalarField& delta = mesh_.nonOrthDeltaCoeffs();
    const surfaceVectorField& skew = mesh_.nonOrthCorrectionVectors();
    const surfaceScalarField& w = mesh_.weights();
    const scalar g = mag(properties_.gravity());
    rounding_ = 0;
    forAll(owner, facei)
    {
        const label P = owner[facei], N = neighbour[facei];
        const scalar length = 1/delta[facei];
        const side p(sideOf(P, (1 - w[facei])*length));
        const side n(sideOf(N, w[facei]*length));
        scalar slope;
        const scalar G =
            linearised
            (
                &p, &n, Sf[facei]/magSf[facei], length*skew[facei],
                psi_[P] - psi_[N], flux_[facei]/magSf[facei],
                thermal_[facei]/magSf[facei], slope
            );
        present_[facei] = magSf[facei]*G;
        slope_[facei] = magSf[facei]*slope;
        rounding_ = max
        (
            rounding_,
            rounded*slope_[facei]
           *(mag(psi_[P]) + mag(psi_[N]) + length*g*(p.weight + n.weight))
        );
    }
    reduce(rounding_, maxOp<scalar>());
    forAll(mesh_.boundary(), patchi)
    {
        if (mesh_.boundary()[patchi].coupled())
        {
            const List<side> beyond(sidesBeyond(patchi));
            const scalarField psi
            (
                psi_.boundaryField()[patchi].patchNeighbourField()
            );
            setPresent(patchi, psi, &beyond);
        }
    }
    forAll(openings_, i)
    {
        const label patchi = ports_[i].patch;
        if (!openings_[i].isOpen())
        {
            presentBf[patchi] = 0;
            slopeBf[patchi] = 0;
            continue;
        }
        setPresent(patchi, psiOf(i), nullptr);
    }
}


// ************************************************************************* //
