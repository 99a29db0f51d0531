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

#include "heatBeyond.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::scalarField> Foam::heatBeyond
(
    const fvScalarMatrix& equation
)
{
    const scalarField& x = equation.psi().primitiveField();
    tmp<scalarField> result(new scalarField(x.size()));
    scalarField& heat = result.ref();
    equation.Amul
    (
        heat, x, equation.boundaryCoeffs(),
        equation.psi().boundaryField().scalarInterfaces(), 0
    );
    heat -= equation.source();
    forAll(equation.internalCoeffs(), patchi)
    {
        const fvPatch& patch = equation.psi().mesh().boundary()[patchi];
        const scalarField& internal = equation.internalCoeffs()[patchi];
        const scalarField& boundary = equation.boundaryCoeffs()[patchi];
        forAll(internal, facei)
        {
            const label P = patch.faceCells()[facei];
            heat[P] +=
                internal[facei]*x[P] - (patch.coupled() ? 0 : boundary[facei]);
        }
    }
    return result;
}


// ************************************************************************* //
