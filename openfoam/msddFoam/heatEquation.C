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
#include "mixedFvPatchFields.H"
#include "coupledPolyPatch.H"
#include "wedgePolyPatch.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "unitConversion.H"
#include "OSspecific.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Sine of the angle to an axis below which a face counts as aligned: mesh
//- points are given with about ten digits
static const scalar alignedSine = 1e-7;

//- How often Newton's method is repeated at most
static const label mostNewton = 30;

//- Non-orthogonality above which the user is warned, as by checkMesh [degrees]
static const scalar largestAngle = 70;

//- A field that the registry does not know
static IOobject unregistered(const word& name, const fvMesh& mesh)
{
    return IOobject
    (
        name,
        mesh.time().timeName(),
        mesh,
        IOobject::NO_READ,
        IOobject::NO_WRITE,
        false
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::heatEquation::heatEquation
(
    volScalarField& T,
    const granularProperties& properties,
    granularState& grains,
    neighbourSolids& neighbours,
    const label correctors
)
:
    T_(T),
    mesh_(T.mesh()),
    sources_(fv::options::New(mesh_)),
    neighbours_(neighbours),
    flow_(granularFlow::New(properties, grains, T)),
    heat_(properties.heatFunction()),
    heatCapacity_
    (
        "volumetricHeatCapacity",
        grains.bulkDensity()*properties.heatCapacity()
    ),
    factor_(properties.conductivityFactor()),
    aligned_(neighbours.empty() && isAligned()),
    crossed_(!grains.diagonal()),
    Kxx_
    (
        unregistered("Kxx", mesh_),
        mesh_,
        dimensionedScalar(properties.thermalConductivity().dimensions(), Zero),
        extrapolatedCalculatedFvPatchScalarField::typeName
    ),
    Kyy_(unregistered("Kyy", mesh_), Kxx_),
    Kxy_(unregistered("Kxy", mesh_), Kxx_),
    K_
    (
        aligned_ && !wallsReadTensor()
      ? nullptr
      : new volSymmTensorField
        (
            IOobject("K", mesh_.time().timeName(), mesh_),
            mesh_,
            dimensionedSymmTensor
            (
                "K",
                Kxx_.dimensions(),
                symmTensor
                (
                    0, 0, 0, 0, 0,
                    factor_*grains.model().conductivityZZ()
                )
            ),
            extrapolatedCalculatedFvPatchSymmTensorField::typeName
        )
    ),
    TEqn_(equation(grains)),
    controls_(mesh_.solverDict(T.name())),
    correctors_(correctors),
    gradX_
    (
        unregistered("gradX", mesh_),
        mesh_,
        dimensionedScalar(T.dimensions()/dimLength, Zero)
    ),
    gradY_(unregistered("gradY", mesh_), gradX_),
    slanted_(false),
    constrained_(false),
    faceHeat_(mesh_.boundary().size()),
    patchHeat_(mesh_.boundary().size(), Zero),
    sourceHeat_(0),
    sourceDensity_(0)
{
    checkSources();
    // Making the matrix has updated time-dependent walls to the start time and
    // marked them as up to date; without this call they would keep that value
    // during the first step
    T_.correctBoundaryConditions();

    if (aligned_)
    {
        findAreas();
    }
    else
    {
        mesh_.setFluxRequired(T.name());
        findFeet();
    }
    Info<< "Conduction: "
        << (!aligned_ ? "tensor laplacian"
          : crossed_ ? "n.K.n on the faces, Kxy explicitly"
          : "n.K.n on the faces (exact here)")
        << nl << endl;
    if (!aligned_)
    {
        reportAngle();
    }
    if (!sources_.optionList::empty())
    {
        presentSources();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::fvScalarMatrix Foam::heatEquation::equation(const granularState& grains)
{
    // Making the matrix updates the boundary conditions, which may need K
    if (K_.valid())
    {
        setTensor(scaled(grains.conductivityOfCells()));
    }
    return fvScalarMatrix(T_, dimPower);
}


bool Foam::heatEquation::isAligned() const
{
    bool aligned = true;

    const surfaceVectorField& Sf = mesh_.Sf();
    const surfaceVectorField delta(mesh_.delta());
    const auto check = [&](const vector& S, const vector& d)
    {
        const vector n(S/mag(S));
        const scalar axis = max(mag(n.x()), mag(n.y()));
        aligned = aligned
         && mag(n ^ d) < alignedSine*mag(d)
         && 1 - sqr(axis) < sqr(alignedSine);
    };
    forAll(mesh_.owner(), facei)
    {
        check(Sf[facei], delta[facei]);
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        // No heat passes the sides of a wedge
        if (isA<wedgePolyPatch>(patch.patch()))
        {
            continue;
        }
        // Components of K are not those of the other side if it is turned
        aligned = aligned
         && (
                !isA<coupledPolyPatch>(patch.patch())
             || refCast<const coupledPolyPatch>(patch.patch()).parallel()
            );
        const vectorField d(patch.delta());
        forAll(patch, facei)
        {
            // The gradient at a wall is taken along its normal, so that the
            // position of the cell's centre matters only for faces between
            // cells
            const vector& S = Sf.boundaryField()[patchi][facei];
            check(S, patch.coupled() ? d[facei] : S);
        }
    }
    return returnReduce(aligned, andOp<bool>());
}


void Foam::heatEquation::findAreas()
{
    const auto split = []
    (
        const vectorField& Sf,
        const scalarField& magSf,
        scalarField& x,
        scalarField& y
    )
    {
        // Rounded, so that only one component of K enters at a face
        x = magSf*neg(mag(Sf.component(vector::Y)) - 0.5*magSf);
        y = magSf - x;
    };
    split(mesh_.Sf(), mesh_.magSf(), areaX_, areaY_);

    const label patches = mesh_.boundary().size();
    patchAreaX_.resize(patches);
    patchAreaY_.resize(patches);
    forAll(patchAreaX_, patchi)
    {
        split
        (
            mesh_.Sf().boundaryField()[patchi],
            mesh_.magSf().boundaryField()[patchi],
            patchAreaX_[patchi],
            patchAreaY_[patchi]
        );
    }
}


void Foam::heatEquation::findFeet()
{
    feet_.resize(mesh_.boundary().size());
    forAll(feet_, patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        // At a wall to another region both sides have to see the same heat,
        // and its condition knows nothing of the feet
        if
        (
            patch.coupled()
         || isA<mappedPatchBase>(patch.patch())
         || isA<wedgePolyPatch>(patch.patch())
        )
        {
            continue;
        }
        const vectorField n(patch.nf());
        const vectorField d(patch.Cf() - patch.Cn());
        feet_[patchi] = d - n*(n & d);
        slanted_ = slanted_ || max(mag(feet_[patchi])/mag(d)) > alignedSine;
    }
    reduce(slanted_, orOp<bool>());
}


void Foam::heatEquation::reportAngle() const
{
    scalar smallest = 1;
    const surfaceVectorField& Sf = mesh_.Sf();
    const surfaceVectorField delta(mesh_.delta());
    forAll(mesh_.owner(), facei)
    {
        const vector& S = Sf[facei];
        const vector& d = delta[facei];
        smallest = min(smallest, (S & d)/(mag(S)*mag(d)));
    }
    reduce(smallest, minOp<scalar>());
    const scalar angle =
        radToDeg(std::acos(max(scalar(-1), min(scalar(1), smallest))));

    Info<< "Non-orthogonality: at most " << angle << " degrees" << nl << endl;
    if (angle > largestAngle)
    {
        WarningInFunction
            << "Non-orthogonality of " << angle << " degrees, at most "
            << largestAngle << " advised: expect per cent of error in T, less"
            << " with more cells and nNonOrthogonalCorrectors" << endl;
    }
}


void Foam::heatEquation::setStorage(const scalarField& Tstar, const scalar tau)
{
    const scalar rate = 1/tau;
    const scalarField& capacity = heatCapacity_.primitiveField();
    const scalarField& V = mesh_.V();
    scalarField& diag = TEqn_.diag();
    scalarField& source = TEqn_.source();

    forAll(diag, celli)
    {
        diag[celli] = rate*capacity[celli]*V[celli];
        source[celli] = rate*capacity[celli]*Tstar[celli]*V[celli];
    }
    if (heat_.isNumber())
    {
        return;
    }
    // H(T) is about H(T_k) + c/c0 (T - T_k)
    const scalar c0 = heat_.usual().value();
    forAll(diag, celli)
    {
        const scalar T = T_[celli], slope = heat_.value(T)/c0;
        source[celli] -= diag[celli]*(heat_.equivalent(T) - slope*T);
        diag[celli] *= slope;
    }
}


bool Foam::heatEquation::hasSettled
(
    const scalarField& before,
    const scalar sufficient
) const
{
    const scalarField& T = T_.primitiveField();
    scalar change = 0, size = 0;
    forAll(T, celli)
    {
        change = max(change, mag(T[celli] - before[celli]));
        size = max(size, mag(T[celli]));
    }
    return
        returnReduce(change, maxOp<scalar>())
     <= max(settled*returnReduce(size, maxOp<scalar>()), sufficient);
}


const Foam::granularState::conductivityColumns& Foam::heatEquation::scaled
(
    const granularState::conductivityColumns& K
)
{
    if (factor_ == 1)
    {
        return K;
    }
    scaledK_.xx = factor_*K.xx;
    scaledK_.yy = factor_*K.yy;
    scaledK_.xy = factor_*K.xy;
    scaledK_.zz = factor_*K.zz;
    scaledK_.xz = factor_*K.xz;
    scaledK_.yz = factor_*K.yz;
    return scaledK_;
}


bool Foam::heatEquation::anyCoupled() const
{
    for (const fvPatch& patch : mesh_.boundary())
    {
        if (patch.coupled())
        {
            return true;
        }
    }
    return false;
}


void Foam::heatEquation::solveBed
(
    const scalarField& Tstar,
    const scalar tau,
    const granularState::conductivityColumns& K,
    const scalar sufficient
)
{
    // Explicit parts, and a heat capacity or sources that depend on the
    // temperature, need repetitions
    const bool explicitly = !aligned_ || crossed_;
    const label least = explicitly ? correctors_ : 0;
    scalarField before;
    for (label corrector = 0; corrector <= least + mostNewton; ++corrector)
    {
        if (!heat_.isNumber())
        {
            before = T_.primitiveField();
        }
        T_.boundaryFieldRef().updateCoeffs();
        forAll(faceHeat_, patchi)
        {
            const fvPatch& patch = mesh_.boundary()[patchi];
            faceHeat_[patchi] =
                scalarField(patch.coupled() ? 0 : patch.size(), Zero);
        }
        setStorage(Tstar, tau);
        if (aligned_)
        {
            addAligned(K);
            if (crossed_)
            {
                addCrossed(K);
            }
        }
        else
        {
            addTensor();
        }
        const tmp<fvScalarMatrix> S(addSources());
        bool flowed = true;
        if (flow_->active())
        {
            flowed = flow_->solve
            (
                TEqn_, tau, controls_.get<scalar>("tolerance"), sufficient
            );
        }
        else
        {
            TEqn_.solve(controls_);
        }
        const bool sourced = finishSources(S);
        if
        (
            corrector >= least
         && sourced
         && flowed
         && (heat_.isNumber() || hasSettled(before, sufficient))
        )
        {
            break;
        }
    }
    sourceHeat_ += flow_->heat();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::heatEquation::isGiven(const fvPatchScalarField& wall)
{
    return wall.fixesValue() && !isA<mixedFvPatchScalarField>(wall);
}


void Foam::heatEquation::solve
(
    const scalarField& Tstar,
    const scalar tau,
    const granularState::conductivityColumns& given
)
{
    const granularState::conductivityColumns& K = scaled(given);
    if (K_.valid())
    {
        setTensor(K);
    }
    flow_->beginStage();
    neighbours_.couple
    (
        tau,
        [&](const scalar sufficient) { solveBed(Tstar, tau, K, sufficient); }
    );

    // Constraints cut their cells off from the walls
    const fvScalarMatrix& equation = free_.valid() ? free_() : TEqn_;
    forAll(patchHeat_, patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (patch.coupled())
        {
            continue;
        }
        const scalarField& internal = equation.internalCoeffs()[patchi];
        const scalarField& boundary = equation.boundaryCoeffs()[patchi];
        const labelUList& cells = patch.faceCells();
        scalarField& heat = faceHeat_[patchi];
        forAll(boundary, facei)
        {
            heat[facei] += boundary[facei] - internal[facei]*T_[cells[facei]];
        }
        patchHeat_[patchi] = sum(heat);
    }
}


// ************************************************************************* //
