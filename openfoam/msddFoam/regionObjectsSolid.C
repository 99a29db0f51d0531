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

#include "regionObjects.H"
#include "foamVersions.H"
#include "granularSolidThermo.H"
#include "mappedPatchBase.H"
#include "caseWarnings.H"
#include "fvmDdt.H"
#include "fvmLaplacian.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::regionObjects::makeAxes()
{
    const bool given = hasField("betavSolid");
    share_.reset
    (
        given
      ? new volScalarField(io("betavSolid"), *mesh_)
      : new volScalarField
        (
            IOobject("betavSolid", runTime_.timeName(), *mesh_),
            *mesh_,
            dimensionedScalar("one", dimless, 1)
        )
    );
    if (solid_->isotropic() || foamTakesTensor)
    {
        return;
    }
    const autoPtr<coordinateSystem> axes
    (
        coordinateSystem::New(*mesh_, *solid_, coordinateSystem::typeName_())
    );
    const volVectorField along(solid_->Kappa()/solid_->Cp());
    // The name under which boundary conditions find it
    alongAxes_.reset
    (
        new volSymmTensorField
        (
            IOobject(foamDirectedAlpha, runTime_.timeName(), *mesh_),
            *mesh_,
            dimensionedSymmTensor(along.dimensions(), Zero),
            zeroGradientFvPatchSymmTensorField::typeName
        )
    );
    alongAxes_->primitiveFieldRef() =
        axes->transformPrincipal(mesh_->cellCentres(), along);
    alongAxes_->correctBoundaryConditions();
}


Foam::wordList Foam::regionObjects::solved(const label solutions)
{
    wordList fields({hasThermo() ? thermo().he().name() : word("h")});
    wordList names;
    if (isFluid_ && !frozenFlow())
    {
        fields.append(word("rho"));
        if (pimple().getOrDefault("momentumPredictor", true))
        {
            fields.append(word("U"));
        }
        const bool often =
            solutions > 1
         || number("nCorrectors", 1) > 1
         || number("nNonOrthogonalCorrectors", 0) > 0;
        names.append(word("p_rghFinal"));
        if (often)
        {
            names.append(word("p_rgh"));
        }
    }
    for (const word& field : fields)
    {
        names.append(word(field + "Final"));
        if (solutions > 1)
        {
            names.append(field);
        }
    }
    return names;
}


void Foam::regionObjects::trySolid()
{
    volScalarField& h = solid_->he();
    const volScalarField rho(solid_->rho());
    fv::options& sources = fv::options::New(*mesh_);
    const word scheme("laplacian(alpha,h)");
    fvScalarMatrix equation
    (
        fvm::ddt(share_()*rho, h)
      - (
            alongAxes_.valid()
          ? fvm::laplacian(share_()*alongAxes_(), h, scheme)
          : fvm::laplacian(share_()*solid_->alpha(), h, scheme)
        )
     ==
        sources(rho, h)
    );
    equation.relax();
    sources.constrain(equation);
    dictionary settings(mesh_->solver(h.select(true)));
    settings.set("maxIter", 1);
    equation.solve(settings);
}


// ************************************************************************* //
