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
#include "mappedPatchBase.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

const keyTable vesselWalls::keys
(
    "walls of the flow",
    {
        {
            "heatCapacity",
            "heat capacity of the wall per area of its inside, for"
            " example of a steel tube: thickness times density times heat capacity",
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
            "heat transfer coefficient between gas and wall. The default is by"
            " Li and Finlayson, Nu = 0.17 Re^0.79, measured within a factor of"
            " two. The only key of a wall to a solid next to the bed (T has the"
            " condition `granularContact`), which needs no entry",
            "W/(m2 K)", "0 to 1e6", "by the correlation"
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
            IOobject::NO_READ, IOobject::AUTO_WRITE
        ),
        mesh_,
        dimensionedScalar(T.dimensions(), Zero),
        calculatedFvPatchScalarField::typeName
    )
{
    read(keys, dict);
    findSolids();
    if (empty())
    {
        T_.checkOut();
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
                << "Entry '" << item.keyword() << "' of 'walls' of the flow"
                << " is no patch with braces, allowed: "
                << granularProperties::listed(mesh_.boundaryMesh().names())
                  .c_str()
                << exit(FatalIOError);
        }
        const dictionary& of = item.dict();
        keys.check(of);
        const fvPatchScalarField& bed = bedT_.boundaryField()[patchi];
        wall& w = add(patchi);
        if (!w.contact && bed.type() != "zeroGradient")
        {
            FatalErrorInFunction
                << "Patch " << item.keyword() << " of T has the condition "
                << bed.type() << ", allowed with an entry in 'walls' of"
                << " the flow: zeroGradient, because the heat at the wall"
                << " follows from that entry, or granularContact"
                << exit(FatalError);
        }
        for (const word key : {"heatCapacity", "loss", "ambient"})
        {
            if (w.contact && of.found(key))
            {
                FatalIOErrorInFunction(of)
                    << "Entry '" << key << "' of the wall " << item.keyword()
                    << " in 'walls' of the flow is given, allowed where T"
                    << " has the condition granularContact: gasExchange alone,"
                    << " because the solid next to the bed has the rest"
                    << exit(FatalIOError);
            }
        }
        w.capacity = keys.number(of, "heatCapacity");
        w.loss = keys.number(of, "loss");
        w.given = of.found("gasExchange") ? keys.number(of, "gasExchange", 0) : -1;
        if (w.loss > 0)
        {
            w.ambient = Function1<scalar>::New("ambient", of);
            const word key("ambient");
            keys.within(of, key, ambient(w));
        }
    }
}


void Foam::vesselWalls::findSolids()
{
    for (const fvPatchScalarField& bed : bedT_.boundaryField())
    {
        const label patchi = bed.patch().index();
        const auto* contact = dynamic_cast<const contactWall*>(&bed);
        if (contact && !meetsSolid(patchi))
        {
            add(patchi);
        }
        if (!contact && isA<mappedPatchBase>(bed.patch().patch()))
        {
            Info<< "Warning: Flow: the gas does not exchange heat with the"
                << " neighbour of patch " << bed.patch().name() << ", where T"
                << " has the condition " << bed.type() << ", needed:"
                << " granularContact" << nl;
        }
    }
    for (const wall& w : walls_)
    {
        if (w.contact && !exchange_.valid())
        {
            exchange_.reset
            (
                new volScalarField
                (
                    IOobject
                    (
                        "wallExchange", mesh_.time().timeName(), mesh_,
                        IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE
                    ),
                    mesh_,
                    dimensionedScalar(dimPower/dimArea/dimTemperature, Zero),
                    calculatedFvPatchScalarField::typeName
                )
            );
        }
    }
}


Foam::vesselWalls::wall& Foam::vesselWalls::add(const label patchi)
{
    walls_.append(new wall);
    wall& w = walls_.last();
    w.patch = patchi;
    w.capacity = 0;
    w.loss = 0;
    w.given = -1;
    w.storage = 0;
    w.contact =
        dynamic_cast<const contactWall*>(&bedT_.boundaryField()[patchi]);
    return w;
}


Foam::scalar Foam::vesselWalls::ambient(const wall& w) const
{
    return w.ambient.valid() ? w.ambient->value(mesh_.time().value()) : 0;
}


Foam::scalar Foam::vesselWalls::balanced
(
    const wall& w,
    const label facei,
    const scalar gas,
    const scalar bed
) const
{
    const scalar all =
        w.storage + w.toGas[facei] + w.toBed[facei] + w.toOutside[facei];
    return
        (
            w.storage*w.stage[facei] + w.toGas[facei]*gas
          + w.toBed[facei]*bed + w.toOutside[facei]*w.outside[facei]
        )/all;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::vesselWalls::meetsSolid(const label patchi) const
{
    for (const wall& w : walls_)
    {
        if (w.patch == patchi && w.contact)
        {
            return true;
        }
    }
    return false;
}


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
    const bool resists =
        properties_.surrogateDict().subOrEmptyDict("spheresCoeffs").isDict("wall");
    for (wall& w : walls_)
    {
        const fvPatch& patch = mesh_.boundary()[w.patch];
        const labelUList& cells = patch.faceCells();
        w.toGas.resize(patch.size());
        forAll(cells, facei)
        {
            w.toGas[facei] = w.given < 0 ? gas(cells[facei]) : w.given;
        }
        if (w.contact)
        {
            exchange_->boundaryFieldRef()[w.patch] == w.toGas;
            w.contact->exchange(w.toBed, w.toOutside, w.outside);
            continue;
        }
        scalarField k, resistance;
        grains_.atWall(w.patch, bedT_, resists, k, resistance);
        w.toBed = 1/(1/(k*patch.deltaCoeffs()) + resistance);
        w.storage = w.capacity/tau;
        w.toOutside = scalarField(patch.size(), w.loss);
        w.outside = scalarField(patch.size(), ambient(w));
    }
}


void Foam::vesselWalls::add(twoFieldMatrix& matrix, const bool single) const
{
    for (const wall& w : walls_)
    {
        const fvPatch& patch = mesh_.boundary()[w.patch];
        const labelUList& cells = patch.faceCells();
        const scalarField& area = patch.magSf();
        forAll(cells, facei)
        {
            const label P = cells[facei];
            const scalar g = w.toGas[facei], b = w.toBed[facei];
            const scalar o = w.toOutside[facei];
            const scalar all = w.storage + g + b + o;
            const scalar rest =
                (w.storage*w.stage[facei] + o*w.outside[facei])/all*area[facei];
            if (single)
            {
                const scalar both = g + b;
                matrix.bb().matrix.diag()[P] +=
                    both*(w.storage + o)/all*area[facei];
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
        forAll(cells, facei)
        {
            T[facei] =
                balanced(w, facei, gas[cells[facei]], bed[cells[facei]]);
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
        forAll(cells, facei)
        {
            const label P = cells[facei];
            const scalar A = area[facei];
            const scalar fromGas = A*w.toGas[facei]*(gas[P] - T[facei]);
            const scalar fromBed = A*w.toBed[facei]*(bed[P] - T[facei]);
            result.fromGas += fromGas;
            result.fromBed += fromBed;
            result.gasToSolids += w.contact ? fromGas : 0;
            result.bedToSolids += w.contact ? fromBed : 0;
            result.lost += A*w.toOutside[facei]*(T[facei] - w.outside[facei]);
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
