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

#include "wallProfile.H"
#include "regionHeat.H"
#include "resistingWall.H"
#include "solidThermo.H"
#include "unitConversion.H"
#include "uniformDimensionedFields.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(wallProfile, 0);
    addToRunTimeSelectionTable(functionObject, wallProfile, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable wallProfileKeys
(
    "wallProfile",
    {
        {
            "patches", "walls", "-", "names or patterns of patches",
            "all but constraints"
        },
        {
            "axis", "direction of the profile, such as upwards", "-",
            "a vector that is not zero",
            "against gravity; without gravity z in space, x in a wedge, y in a"
            " plane"
        },
        {
            "bins", "parts of equal length along the axis, of each patch", "-",
            "1 to 10000", "20"
        },
        {
            "sectors", "parts of equal angle around the axis", "-",
            "1 to 10000", "1"
        },
        {
            "origin", "a point on the axis, for the angle", "m", "a point",
            "the middle of the box around the mesh"
        }
    }
);

static const keyTable wallProfileColumns
(
    "columns of wallProfile",
    {
        {"patch", "number of the patch; the head of the file has the names", "-"},
        {"height", "along the axis, mean over the area of the part", "m"},
        {
            "angle",
            "around the axis, of the middle of the part, from a direction normal"
            " to it (that of x, or of y if the axis is x)", "degrees"
        },
        {"area", "area of the part", "m2"},
        {
            "normal", "force of the bed across the wall over the area, compression"
            " positive", "Pa"
        },
        {
            "shear", "magnitude of the force along the wall over the area", "Pa"
        },
        {
            "shear_along",
            "its part along the axis: force of the bed on the wall, positive"
            " along the axis (negative where a bed hangs on its wall)", "Pa"
        },
        {
            "heat_flux",
            "heat into the bed in the last step over its length, as it is booked"
            " in the balance of heat; 0 at the start", "W/m2"
        },
        {
            "wall_temperature",
            "temperature of the surface of the wall: as given, else that of the"
            " bed where the mesh ends plus the heat flux times the resistance", "K"
        }
    }
);

static const word wallForce("wallForce");

//- Extent along the axis, over the size of the mesh, that is rounding
static const scalar level = 1e-6;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::wallProfile::wallProfile
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    granularFunctionObject(name, typeName, runTime, dict, wallProfileColumns),
    axis_(findAxis(dict)),
    origin_(dict.getOrDefault("origin", mesh_.bounds().midpoint())),
    bins_(label(wallProfileKeys.number(dict, "bins"))),
    sectors_(label(wallProfileKeys.number(dict, "sectors")))
{
    wordRes wanted({wordRe(".*", wordRe::REGEX)});
    dict.readIfPresent("patches", wanted);
    for (const fvPatch& patch : mesh_.boundary())
    {
        if
        (
            !polyPatch::constraintType(patch.patch().type())
         && wanted.match(patch.name())
        )
        {
            walls_.append(patch.index());
        }
    }
    if (walls_.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'patches' of " << name << " matches no wall, allowed: "
            << granularProperties::listed(mesh_.boundaryMesh().names()).c_str()
            << exit(FatalIOError);
    }
    findBins();
    makeFields();
    begin(dict);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::vector Foam::functionObjects::wallProfile::findAxis
(
    const dictionary& dict
) const
{
    const bool wedge = mesh_.nSolutionD() == 3 && mesh_.nGeometricD() == 2;
    vector axis
    (
        mesh_.nGeometricD() == 3 ? vector(0, 0, 1)
      : wedge ? vector(1, 0, 0)
      : vector(0, 1, 0)
    );
    IOobject io
    (
        "g", time_.constant(), mesh_,
        IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false
    );
    if (io.typeHeaderOk<uniformDimensionedVectorField>(true))
    {
        const vector g(uniformDimensionedVectorField(io).value());
        axis = mag(g) > 0 ? -g : axis;
    }
    dict.readIfPresent("axis", axis);
    if (!(mag(axis) > 0))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'axis' is " << axis << ", allowed: "
            << wallProfileKeys.allowed("axis") << exit(FatalIOError);
    }
    return axis/mag(axis);
}


void Foam::functionObjects::wallProfile::findBins()
{
    // In a box around all of a patch, over all processes
    const vector across(mag(axis_.x()) < 0.9 ? vector(1, 0, 0) : vector(0, 1, 0));
    const vector first(normalised(across - axis_*(axis_ & across)));
    const vector second(axis_ ^ first);
    binOf_.resize(walls_.size());
    forAll(walls_, i)
    {
        const fvPatch& patch = mesh_.boundary()[walls_[i]];
        const scalarField z(patch.Cf() & axis_);
        const scalarField ends(patch.patch().localPoints() & axis_);
        const scalar low = gMin(ends);
        // A wall across the axis is one part
        const scalar length =
            max(gMax(ends) - low, level*mesh_.bounds().mag());
        binOf_[i].resize(z.size());
        forAll(z, facei)
        {
            const vector r(patch.Cf()[facei] - origin_);
            const scalar turn =
                std::atan2(r & second, r & first)/constant::mathematical::twoPi;
            const label bin = label(bins_*(z[facei] - low)/length);
            const label sector = label(sectors_*(turn < 0 ? turn + 1 : turn));
            binOf_[i][facei] =
                min(max(bin, label(0)), bins_ - 1)*sectors_
              + min(sector, sectors_ - 1);
        }
    }
}


template<class Type>
void Foam::functionObjects::wallProfile::make
(
    const word& name,
    const dimensionSet& unit
) const
{
    typedef GeometricField<Type, fvPatchField, volMesh> fieldType;

    if (!mesh_.foundObject<fieldType>(name))
    {
        mesh_.objectRegistry::store
        (
            new fieldType
            (
                IOobject
                (
                    name, time_.timeName(), mesh_,
                    IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE
                ),
                mesh_,
                dimensioned<Type>(unit, Zero)
            )
        );
    }
}


void Foam::functionObjects::wallProfile::makeFields()
{
    if (!mesh_.foundObject<runRecord>("msddFoam"))
    {
        return;
    }
    if (!mesh_.foundObject<solidThermo>(basicThermo::dictName))
    {
        make<scalar>(runRecord::wallFlux, dimPower/dimArea);
    }
    if (mesh_.foundObject<volScalarField>("areaRatio"))
    {
        make<vector>(wallForce, dimPressure);
    }
}


bool Foam::functionObjects::wallProfile::exists(const word& name) const
{
    IOobject header
    (
        name, time_.timeName(), mesh_,
        IOobject::MUST_READ, IOobject::NO_WRITE, false
    );
    return
        mesh_.foundObject<regIOobject>(name)
     || header.typeHeaderOk<volScalarField>(false);
}


Foam::tmp<Foam::scalarField>
Foam::functionObjects::wallProfile::flux(const label patchi) const
{
    if (mesh_.foundObject<solidThermo>(basicThermo::dictName))
    {
        return regionHeat::flux(mesh_, patchi);
    }
    if (exists(runRecord::wallFlux))
    {
        return tmp<scalarField>::New
        (
            present<scalar>(runRecord::wallFlux)().boundaryField()[patchi]
        );
    }
    return nullptr;
}


Foam::vectorField
Foam::functionObjects::wallProfile::force(const label patchi) const
{
    if (exists(wallForce))
    {
        return present<vector>(wallForce)().boundaryField()[patchi];
    }
    const fvPatch& patch = mesh_.boundary()[patchi];
    const tmp<volSymmTensorField> tstress(present<symmTensor>("stress"));
    return
       -(
            patch.nf()
          & symmTensorField(tstress().primitiveField(), patch.faceCells())
        );
}


void Foam::functionObjects::wallProfile::addWall
(
    const label i,
    const tmp<scalarField>& q,
    List<part>& parts
) const
{
    const label patchi = walls_[i];
    const fvPatch& patch = mesh_.boundary()[patchi];
    const vectorField n(patch.nf()), onWall(force(patchi));
    const tmp<volScalarField> tT(present<scalar>("T"));
    const fvPatchScalarField& T = tT().boundaryField()[patchi];
    scalar given = 0;
    const auto* wall = dynamic_cast<const resistingWall*>(&T);
    const bool isGiven = wall && patch.size() && wall->surface(given);
    const auto* R = mesh_.findObject<volScalarField>("wallResistance");
    forAll(n, facei)
    {
        const scalar A = patch.magSf()[facei];
        const scalar across = onWall[facei] & n[facei];
        const vector shear(onWall[facei] - across*n[facei]);
        const scalar heatFlux = q.valid() ? q()[facei] : scalar(0);
        const scalar resistance =
            R ? R->boundaryField()[patchi][facei] : scalar(0);
        part& sums = parts[binOf_[i][facei]];
        sums[wallSums::area] += A;
        sums[wallSums::height] += A*(patch.Cf()[facei] & axis_);
        sums[wallSums::normal] += A*across;
        sums[wallSums::along] += A*(shear & axis_);
        sums[wallSums::shear] += A*mag(shear);
        sums[wallSums::heat] += A*heatFlux;
        sums[wallSums::temperature] +=
            isGiven
          ? A*given
          : A*(T[facei] + (resistance < GREAT ? heatFlux*resistance : 0));
    }
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

void Foam::functionObjects::wallProfile::writeHead(Ostream& os) const
{
    wallProfileColumns.explain(os);
    for (const label patchi : walls_)
    {
        os  << "# patch " << patchi << ": " << mesh_.boundary()[patchi].name()
            << nl;
    }
    writeCommented(os, "Time");
    for (const keyTable::entry& column : wallProfileColumns.entries())
    {
        writeTabbed(os, column.name);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::wallProfile::write()
{
    if (lacks({"T", "stress"}))
    {
        return true;
    }
    refresh();
    forAll(walls_, i)
    {
        const tmp<scalarField> q(flux(walls_[i]));
        const part none(scalar(0));
        List<part> parts(bins_*sectors_, none);
        addWall(i, q, parts);
        Pstream::listCombineGather
        (
            parts,
            [](part& a, const part& b)
            {
                forAll(a, k)
                {
                    a[k] += b[k];
                }
            }
        );
        forAll(parts, bin)
        {
            const part& sums = parts[bin];
            if (!Pstream::master() || !(sums[wallSums::area] > 0))
            {
                continue;
            }
            const scalar A = sums[wallSums::area];
            Ostream& os = line();
            os  << tab << walls_[i] << tab << sums[wallSums::height]/A
                << tab << 360*(bin % sectors_ + 0.5)/sectors_ << tab << A
                << tab << sums[wallSums::normal]/A << tab << sums[wallSums::shear]/A
                << tab << sums[wallSums::along]/A;
            if (q.valid())
            {
                os  << tab << sums[wallSums::heat]/A
                    << tab << sums[wallSums::temperature]/A;
            }
            else
            {
                os  << tab << "nan" << tab << "nan";
            }
            os  << endl;
        }
    }
    return true;
}


// ************************************************************************* //
