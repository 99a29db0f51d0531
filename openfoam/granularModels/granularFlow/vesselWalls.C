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

#include "vesselWalls.H"
#include "calculatedFvPatchFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

const keyTable vesselWalls::keys
(
    "walls of throughCoeffs",
    {
        {
            "heatCapacity",
            "heat capacity of the wall per area of its inside, such as that of"
            " a steel tube: its thickness times density times heat capacity",
            "J/(m2 K)", "0 to 1e9", "0"
        },
        {
            "loss",
            "heat transfer coefficient from the wall to the outside, on the"
            " area of its inside: insulation and its surface", "W/(m2 K)",
            "0 to 1e6", "0"
        },
        {
            "ambient", "temperature outside, a number or a function of time",
            "K", "> 0", "required with `loss`"
        },
        {
            "gasExchange",
            "heat transfer coefficient between gas and wall. Without it that of"
            " Li and Finlayson, Nu = 0.17 Re^0.79, measured within a factor of"
            " two", "W/(m2 K)", "0 to 1e6", "by the correlation"
        }
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::vesselWalls::vesselWalls
(
    const granularProperties& properties,
    const granularState& grains,
    const volScalarField& T,
    const dictionary& dict
)
:
    properties_(properties),
    grains_(grains),
    bedT_(T),
    mesh_(T.mesh()),
    T_
    (
        IOobject
        (
            "vesselTemperature", mesh_.time().timeName(), mesh_,
            IOobject::NO_READ,
            dict.empty() ? IOobject::NO_WRITE : IOobject::AUTO_WRITE,
            !dict.empty()
        ),
        mesh_,
        dimensionedScalar(T.dimensions(), Zero),
        calculatedFvPatchScalarField::typeName
    )
{
    read(keys, dict);
    if (empty())
    {
        return;
    }
    T_.primitiveFieldRef() = T.primitiveField();
    for (const wall& w : walls_)
    {
        Tw(w) = scalarField
        (
            T.primitiveField(), mesh_.boundary()[w.patch].faceCells()
        );
    }
    IOobject stored(T_);
    stored.readOpt() = IOobject::MUST_READ;
    stored.registerObject() = false;
    if (stored.typeHeaderOk<volScalarField>(true))
    {
        T_ == volScalarField(stored, mesh_);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::vesselWalls::read(const keyTable& keys, const dictionary& dict)
{
    for (const entry& item : dict)
    {
        const label patchi = mesh_.boundaryMesh().findPatchID(item.keyword());
        if (!item.isDict() || patchi < 0)
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << item.keyword() << "' of 'walls' of throughCoeffs"
                << " is no patch with braces, allowed: "
                << granularProperties::listed(mesh_.boundaryMesh().names())
                  .c_str()
                << exit(FatalIOError);
        }
        const dictionary& of = item.dict();
        keys.check(of);
        const fvPatchScalarField& bed = bedT_.boundaryField()[patchi];
        if (bed.type() != "zeroGradient")
        {
            FatalErrorInFunction
                << "Patch " << item.keyword() << " of T has the condition "
                << bed.type() << ", allowed with an entry in 'walls' of"
                << " throughCoeffs: zeroGradient, because the heat at the wall"
                << " follows from that entry" << exit(FatalError);
        }
        walls_.append(new wall);
        wall& w = walls_.last();
        w.patch = patchi;
        w.capacity = keys.number(of, "heatCapacity");
        w.loss = keys.number(of, "loss");
        w.given = of.found("gasExchange") ? keys.number(of, "gasExchange", 0) : -1;
        w.storage = 0;
        if (w.loss > 0)
        {
            w.ambient = Function1<scalar>::New("ambient", of);
            const word key("ambient");
            keys.within(of, key, outside(w));
        }
    }
}


Foam::scalar Foam::vesselWalls::outside(const wall& w) const
{
    return w.ambient.valid() ? w.ambient->value(mesh_.time().value()) : 0;
}


Foam::scalar Foam::vesselWalls::balanced
(
    const wall& w,
    const label facei,
    const scalar gas,
    const scalar bed,
    const scalar outside
) const
{
    const scalar all = w.storage + w.toGas[facei] + w.toBed[facei] + w.loss;
    return
        (
            w.storage*w.stage[facei] + w.toGas[facei]*gas
          + w.toBed[facei]*bed + w.loss*outside
        )/all;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::vesselWalls::addLoads(loadHistories& loads)
{
    for (const wall& w : walls_)
    {
        if (w.ambient.valid())
        {
            loads.add(w.ambient());
        }
    }
}


void Foam::vesselWalls::begin()
{
    for (wall& w : walls_)
    {
        w.before = Tw(w);
        w.stage = w.before;
    }
}


void Foam::vesselWalls::restore()
{
    for (wall& w : walls_)
    {
        Tw(w) = w.before;
        w.stage = w.before;
    }
}


void Foam::vesselWalls::secondStage(const scalar share)
{
    for (wall& w : walls_)
    {
        w.stage = w.before + (1 - share)/share*(Tw(w) - w.before);
    }
}


void Foam::vesselWalls::update
(
    const scalar tau,
    const std::function<scalar(label)>& gas
)
{
    const granularState::conductivityColumns& K = grains_.conductivityOfCells();
    const bool resists =
        properties_.surrogateDict().subOrEmptyDict("spheresCoeffs").isDict("wall");
    const granularState::stressColumns stress
    (
        resists ? grains_.presentStress() : granularState::stressColumns()
    );
    for (wall& w : walls_)
    {
        const fvPatch& patch = mesh_.boundary()[w.patch];
        const labelUList& cells = patch.faceCells();
        const vectorField n(patch.nf());
        scalarField normal(patch.size(), Zero), across(patch.size());
        scalarField resistance(patch.size(), Zero), there(patch.size());
        w.toGas.resize(patch.size());
        w.toBed.resize(patch.size());
        w.storage = w.capacity/tau;
        forAll(cells, facei)
        {
            const label P = cells[facei];
            const vector& v = n[facei];
            const auto part = [P](const scalarField& column)
            {
                return column.empty() ? 0 : column[P];
            };
            const symmTensor k
            (
                K.xx[P], part(K.xy), part(K.xz), K.yy[P], part(K.yz), part(K.zz)
            );
            across[facei] = v & (k & v);
            there[facei] = bedT_[P];
            if (resists)
            {
                const symmTensor s
                (
                    stress[0][P], stress[3][P], stress[4][P],
                    stress[1][P], stress[5][P], stress[2][P]
                );
                normal[facei] = -(v & (s & v));
            }
            w.toGas[facei] = w.given < 0 ? gas(P) : w.given;
        }
        if (resists)
        {
            grains_.model().wallResistance(normal, there, across, resistance);
        }
        const scalarField& delta = patch.deltaCoeffs();
        forAll(cells, facei)
        {
            const scalar k = properties_.conductivityFactor()*across[facei];
            w.toBed[facei] = 1/(1/(k*delta[facei]) + resistance[facei]);
        }
    }
}


void Foam::vesselWalls::add(twoFieldMatrix& matrix, const bool single) const
{
    for (const wall& w : walls_)
    {
        const fvPatch& patch = mesh_.boundary()[w.patch];
        const labelUList& cells = patch.faceCells();
        const scalarField& area = patch.magSf();
        const scalar around = outside(w);
        forAll(cells, facei)
        {
            const label P = cells[facei];
            const scalar g = w.toGas[facei], b = w.toBed[facei];
            const scalar all = w.storage + g + b + w.loss;
            const scalar rest =
                (w.storage*w.stage[facei] + w.loss*around)/all*area[facei];
            if (single)
            {
                const scalar both = g + b;
                matrix.bb().matrix.diag()[P] +=
                    both*(w.storage + w.loss)/all*area[facei];
                matrix.source().b[P] += both*rest;
                continue;
            }
            const scalar between = g*b/all*area[facei];
            matrix.aa().matrix.diag()[P] += g*(all - g)/all*area[facei];
            matrix.bb().matrix.diag()[P] += b*(all - b)/all*area[facei];
            matrix.ab()[P] -= between;
            matrix.ba()[P] -= between;
            matrix.source().a[P] += g*rest;
            matrix.source().b[P] += b*rest;
        }
    }
}


void Foam::vesselWalls::solve(const scalarField& gas, const scalarField& bed)
{
    for (const wall& w : walls_)
    {
        const labelUList& cells = mesh_.boundary()[w.patch].faceCells();
        scalarField& T = Tw(w);
        const scalar around = outside(w);
        forAll(cells, facei)
        {
            T[facei] =
                balanced(w, facei, gas[cells[facei]], bed[cells[facei]], around);
        }
    }
}


Foam::vesselWalls::rates Foam::vesselWalls::heat
(
    const scalarField& gas,
    const scalarField& bed
) const
{
    rates result;
    for (const wall& w : walls_)
    {
        const fvPatch& patch = mesh_.boundary()[w.patch];
        const labelUList& cells = patch.faceCells();
        const scalarField& area = patch.magSf();
        const scalarField& T = Tw(w);
        const scalar around = outside(w);
        forAll(cells, facei)
        {
            const label P = cells[facei];
            const scalar A = area[facei];
            result.fromGas += A*w.toGas[facei]*(gas[P] - T[facei]);
            result.fromBed += A*w.toBed[facei]*(bed[P] - T[facei]);
            result.lost += A*w.loss*(T[facei] - around);
            result.stored += A*w.storage*(T[facei] - w.stage[facei]);
        }
    }
    return result;
}


void Foam::vesselWalls::extremes(scalar& least, scalar& most) const
{
    least = GREAT;
    most = -GREAT;
    for (const wall& w : walls_)
    {
        const scalarField& T = Tw(w);
        if (T.size())
        {
            least = min(least, min(T));
            most = max(most, max(T));
        }
    }
    reduce(least, minOp<scalar>());
    reduce(most, maxOp<scalar>());
}


// ************************************************************************* //
