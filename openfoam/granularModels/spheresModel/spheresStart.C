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

#include "spheresModel.H"
#include "givenField.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{

//- Change of the stress at the start, over the pressure, that is reported
static const scalar notable = 1e-3;

//- By how much the trace of a fabric may differ from 1: it is given rounded
static const scalar unitTrace = 0.01;

//- Contacts per sphere between which packings under load are: without rattlers
//- spheres with friction need four, and dense random packings have seven
static const scalar leastContacts = 2, mostContacts = 9;

//- Largest usual share of a direction in the fabric: of one third in boxes,
//- poured beds have up to 0.37, strongly sheared ones 0.45
static const scalar mostFabric = 0.45;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::symmTensorField
Foam::granularModels::spheres::fabricAtStart(const label size) const
{
    symmTensorField given;
    symmTensor everywhere;
    if (coeffs_.readIfPresent("fabric", everywhere))
    {
        given.resize(size, everywhere);
    }
    const auto ofCells(givenField<symmTensor>(mesh_, "fabric", dimless));
    if (ofCells.valid())
    {
        given = ofCells().primitiveField();
    }
    scalar most = 0;
    for (const symmTensor& F : given)
    {
        most = max(most, max(F.xx(), max(F.yy(), F.zz())));
        // A mean of squares: along no direction is it negative
        const bool possible =
            min(F.xx(), min(F.yy(), F.zz())) >= 0
         && sqr(F.xy()) <= F.xx()*F.yy()
         && sqr(F.xz()) <= F.xx()*F.zz()
         && sqr(F.yz()) <= F.yy()*F.zz()
         && det(F) >= -SMALL;
        if (!(possible && mag(tr(F) - 1) <= unitTrace))
        {
            OStringStream value;
            value << F;
            refuse
            (
                "fabric",
                value.str(),
                "the mean of n n over the contacts, with the normals n:"
                " (xx xy xz yy yz zz) with xx + yy + zz = 1, and along no"
                " direction negative"
            );
        }
    }
    reduce(most, maxOp<scalar>());
    if (most > mostFabric)
    {
        WarningInFunction
            << "Entry 'fabric' of spheresCoeffs has a component of " << most
            << ": random packings have up to " << mostFabric
            << ", isotropic ones 1/3" << nl << endl;
    }
    return given;
}


void Foam::granularModels::spheres::reportStart
(
    const label size,
    const symmTensor* given,
    scalar* const* state
) const
{
    symmTensorField found(size);
    query start;
    start.size = size;
    start.state = state;
    start.stress = found.data();
    columns all(columnsOf(start));
    surrogateModel::advance(all, grains_);
    scalar most = 0;
    for (label celli = 0; celli < size; ++celli)
    {
        const scalar p = tr(given[celli])/3;
        if (p > 0)
        {
            most = max(most, cmptMax(cmptMag(found[celli] - given[celli]))/p);
        }
    }
    reduce(most, maxOp<scalar>());
    if (most > notable)
    {
        Info<< "The stress at the start is more than packings of this porosity"
            << " carry: it is changed by up to " << most << " of the pressure, to"
            << " what the law allows" << nl << endl;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::granularModels::spheres::initialState
(
    const known& cells,
    scalar* const* state
)
{
    if (!cells.stress)
    {
        FatalErrorInFunction
            << "Field stress is missing in "
            << (mesh_.time().path()/mesh_.time().timeName()).c_str()
            << ": surrogate type spheres needs the stress at the start [Pa],"
            << " tension positive, for example (-2000 0 0 -2000 0 -2000) of the"
            << " weight of a bed. Without it contacts and stiffness are"
            << " undetermined" << exit(FatalError);
    }
    scalarField solid(cells.size);
    scalar tension = 0;
    label tense = 0;
    forAll(solid, celli)
    {
        solid[celli] = 1 - cells.porosity[celli];
        const scalar p = tr(cells.stress[celli])/3;
        tense += p < 0;
        tension = max(tension, -p);
    }
    if (returnReduce(tense, sumOp<label>()))
    {
        FatalErrorInFunction
            << "Field stress in "
            << (mesh_.time().path()/mesh_.time().timeName()).c_str()
            << " is tension in " << returnReduce(tense, sumOp<label>())
            << " cells, in the mean of the directions up to "
            << returnReduce(tension, maxOp<scalar>()) << " Pa, allowed: at most"
            << " 0, because grains cannot carry tension. Tension is positive:"
            << " the stress of a bed under load is negative" << exit(FatalError);
    }
    // What is not given is left to the law
    const auto given = [&](const char* key)
    {
        scalarField result;
        if (coeffs_.found(key))
        {
            result.resize(cells.size, keys.number(coeffs_, key));
        }
        return result;
    };
    const scalarField contacts(given("coordination"));
    if
    (
        contacts.size()
     && (contacts[0] < leastContacts || contacts[0] > mostContacts)
    )
    {
        WarningInFunction
            << "Entry 'coordination' of spheresCoeffs is " << contacts[0]
            << ": random packings under load have from " << leastContacts
            << " to " << mostContacts << " contacts per sphere" << nl << endl;
    }
    // The stress of a packing depends on it, so a field cannot just replace the
    // column afterwards
    scalarField mobilised(given("mobilised"));
    const auto ofCells(givenField<scalar>(mesh_, "mobilised", dimless));
    if (ofCells.valid())
    {
        mobilised = ofCells().primitiveField();
    }
    const symmTensorField fabric(fabricAtStart(cells.size));
    const std::vector<msdd_input> directions
    (
        tensors<msdd_input>(fabric.empty() ? nullptr : fabric.cdata())
    );
    const std::vector<msdd_input> load(tensors<msdd_input>(cells.stress));
    const auto column = [](const scalarField& values)
    {
        return msdd::input(values.empty() ? nullptr : values.cdata());
    };
    msdd_start data(msdd::start(cells.size, 6));
    data.solid_fraction = msdd::input(solid.cdata());
    data.stress = load.data();
    data.coordination = column(contacts);
    data.mobilised = column(mobilised);
    data.fabric = msdd::table(directions);
    start(data, grains_, state);
    reportStart(cells.size, cells.stress, state);
}


// ************************************************************************* //
