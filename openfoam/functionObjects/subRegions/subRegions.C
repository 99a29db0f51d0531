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

#include "subRegions.H"
#include "addToRunTimeSelectionTable.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(subRegions, 0);
    addToRunTimeSelectionTable(functionObject, subRegions, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable subRegionsKeys
(
    "subRegions",
    {
        {
            "windows", "number of windows along x and along y", "-",
            "two numbers above 0", "(10 3)"
        }
    }
);

static const keyTable subRegionsColumns
(
    "columns of subRegions",
    {
        {"x_window", "number of the window along x, from 0", "-"},
        {"y_window", "the same along y", "-"},
        {"T", "temperature", "K"},
        {"porosity", "porosity", "-"},
        {"fabricIndex", "fabric index", "-"},
        {"conductivity_xx", "conductivity", "W/(m K)"},
        {"conductivity_yy", "conductivity", "W/(m K)"},
        {"stress_xx", "stress, compression positive", "Pa"},
        {"stress_yy", "the same", "Pa"},
        {"pressure", "pressure, compression positive", "Pa"}
    }
);

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::subRegions::subRegions
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    granularFunctionObject(name, typeName, runTime, dict, subRegionsColumns),
    windows_(subRegionsKeys.value<FixedList<label, 2>>(dict, "windows")),
    windowOf_(mesh_.nCells())
{
    if (min(windows_[0], windows_[1]) < 1)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'windows' is " << windows_ << ", allowed: "
            << subRegionsKeys.allowed("windows") << exit(FatalIOError);
    }

    const boundBox box(mesh_.bounds());
    const vector size(box.span());
    forAll(windowOf_, celli)
    {
        const vector x(mesh_.C()[celli] - box.min());
        const label i = label(windows_[0]*x.x()/size.x());
        const label j = label(windows_[1]*x.y()/size.y());
        windowOf_[celli] =
            min(i, windows_[0] - 1) + windows_[0]*min(j, windows_[1] - 1);
    }
    begin(dict);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::subRegions::write()
{
    if
    (
        lacks
        ({
            "T", "porosity", "fabricIndex", "conductivity",
            "stress", "pressure"
        })
    )
    {
        return true;
    }
    refresh();
    const label count = windows_[0]*windows_[1];
    const tmp<volSymmTensorField> K(present<symmTensor>("conductivity"));
    const tmp<volSymmTensorField> sigma(present<symmTensor>("stress"));
    const scalarField& V = mesh_.V();

    scalarField volume(count, Zero);
    forAll(V, celli)
    {
        volume[windowOf_[celli]] += V[celli];
    }
    Pstream::listCombineGather(volume, plusEqOp<scalar>());

    List<scalarField> means;
    const auto add = [&](const scalarField& values, const scalar sign)
    {
        scalarField mean(count, Zero);
        forAll(V, celli)
        {
            mean[windowOf_[celli]] += sign*V[celli]*values[celli];
        }
        Pstream::listCombineGather(mean, plusEqOp<scalar>());
        means.append(mean);
    };
    add(present<scalar>("T")(), 1);
    add(present<scalar>("porosity")(), 1);
    add(present<scalar>("fabricIndex")(), 1);
    add(K().primitiveField().component(symmTensor::XX)(), 1);
    add(K().primitiveField().component(symmTensor::YY)(), 1);

    // Tension positive becomes compression positive
    add(sigma().primitiveField().component(symmTensor::XX)(), -1);
    add(sigma().primitiveField().component(symmTensor::YY)(), -1);
    add(present<scalar>("pressure")(), 1);

    if (Pstream::master())
    {
        for (label window = 0; window < count; ++window)
        {
            Ostream& os = line();
            os  << tab << window % windows_[0] << tab << window/windows_[0];
            for (const scalarField& mean : means)
            {
                // A window without cells gives 0
                os  << tab << mean[window]/max(volume[window], VSMALL);
            }
            os  << endl;
        }
    }
    return true;
}


// ************************************************************************* //
