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

#include "constantModel.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{
    defineTypeNameAndDebug(constant, 0);
    addToRunTimeSelectionTable(granularModel, constant, dictionary);
}

static const keyTable constantKeys
(
    "constantCoeffs",
    {
        {
            "conductivity",
            "conductivity tensor `(xx xy xz yy yz zz)`, with xz and yz 0",
            "W/(m K)", "positive definite", "from `model`"
        },
        {
            "stress", "stress tensor, tension positive", "Pa", "any",
            "from `model`"
        },
        {
            "model",
            "model of discs for what is not given, and for the bulk density",
            "-", "as in `networkCoeffs`", "builtin"
        },
        {"hash", "as in `networkCoeffs`", "-", "the hash of the file", "any"}
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::constant::constant
(
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    surrogateModel
    (
        typeName,
        "model",
        properties.surrogateDict().optionalSubDict("constantCoeffs")
           .lookupOrDefault<fileName>("model", "builtin"),
        "builtin, builtin:paper, or a readable model file",
        properties,
        mesh
    ),
    conductivity_(Zero),
    stress_(Zero)
{
    stateNames_.resize(2);
    columnNames_.resize(2);
    checkCoeffs(constantKeys);
    const bool plane = mesh.solutionD()[vector::Z] == -1;
    if (coeffs_.readIfPresent("conductivity", conductivity_) || !plane)
    {
        const symmTensor& K = conductivity_;
        if
        (
            !(K.xx() > 0 && K.yy() > 0 && sqr(K.xy()) < K.xx()*K.yy())
         || !(plane || K.zz() > 0)
         || mag(K.xz()) + mag(K.yz()) > 0
        )
        {
            OStringStream value;
            value << K;
            refuse
            (
                "conductivity",
                value.str(),
                plane
              ? "positive definite, with xz and yz 0 [W/(m K)]"
              : "positive definite, with zz > 0 and xz and yz 0 [W/(m K)]"
            );
        }
    }
    if (coeffs_.readIfPresent("stress", stress_))
    {
        stress_ = -stress_;
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::granularModels::constant::readMean(const known& cells)
{
    scalar volume = 0, porosity = 0, fabric = 0;
    forAll(mesh_.V(), celli)
    {
        volume += mesh_.V()[celli];
        porosity += mesh_.V()[celli]*cells.porosity[celli];
        fabric += mesh_.V()[celli]*cells.fabricIndex[celli];
    }
    reduce(volume, sumOp<scalar>());
    porosity = returnReduce(porosity, sumOp<scalar>())/volume;
    fabric = returnReduce(fabric, sumOp<scalar>())/volume;

    known mean;
    mean.size = 1;
    mean.porosity = &porosity;
    mean.fabricIndex = &fabric;

    scalarField values(label(model_.stateSize()));
    List<scalar*> state(values.size());
    forAll(state, i)
    {
        state[i] = &values[i];
    }
    surrogateModel::initialState(mean, state.cdata());

    const scalar zero = 0;
    symmTensor K(Zero), sigma(Zero);
    query one;
    one.size = 1;
    one.state = state.cdata();
    one.nextState = state.cdata();
    one.strain = &zero;
    one.totalStrain = &zero;
    one.conductivity = &K;
    one.stress = &sigma;
    surrogateModel::advance(one);

    if (!coeffs_.found("conductivity"))
    {
        conductivity_ = K;
    }
    if (!coeffs_.found("stress"))
    {
        stress_ = sigma;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularModels::constant::initialState
(
    const known& cells,
    scalar* const*
)
{
    readMean(cells);
}


Foam::label Foam::granularModels::constant::advance(const query& cells)
{
    for (label row = 0; row < cells.size; ++row)
    {
        forAll(stateNames_, i)
        {
            cells.nextState[i][row] = cells.state[i][row];
        }
        for (const direction k : order())
        {
            cells.conductivity[row][k] = conductivity_[k];
            cells.stress[row][k] = stress_[k];
        }
    }
    return 0;
}


// ************************************************************************* //
