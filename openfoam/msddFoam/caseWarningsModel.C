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

#include "caseWarnings.H"
#include "briefNumber.H"
#include "pascals.H"
#include "sphereEstimates.H"
#include "wallDistance.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The largest values of solids, and what has them
struct largestOf
{
    const char* key;
    scalar most;
    const char* unit;
    const char* what;
};
static const largestOf largest[] =
{
    {"density", 3e4, "kg/m3", "osmium, the heaviest of all, has 22600"},
    {"youngModulus", 2e12, "Pa", "diamond, the stiffest of all, has 1.2e12"},
    {
        "thermalConductivity", 1e4, "W/(m K)",
        "diamond and graphite have 2000 to 5000"
    }
};

//- Lateral over vertical stress between which grains do not slide: friction
//- angles up to 55 degrees where the bed can yield sideways, and up to 30
//- where it is pressed from there
static const scalar leastLateral = 0.1;
static const scalar mostLateral = 3;

//- Roughness over the radius above which it is hardly meant
static const scalar mostRough = 0.01;

//- Grains in a cell, and side by side, below which a mean over them says little
static const scalar fewGrains = 4;

//- Conductivities of a gas that differ by less than this share are equal; how
//- often a range of temperatures is halved
static const scalar sameGas = 1e-12;
static const label halvings = 40;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::caseWarnings::checkCompared()
{
    for (const string& part : grains_.record().course.beyond())
    {
        add
        (
            "Beyond what the model was compared with: " + part + ". The"
            " model's error there is unknown"
        );
    }
}


void Foam::caseWarnings::checkSpheres()
{
    if (!grains_.model().isThreeDimensional())
    {
        return;
    }
    const runCourse& course = grains_.record().course;
    const sphereEstimates estimates(properties_, grains_);
    const sphereEstimates::added radiation
    (
        estimates.radiation(course.values(runCourse::temperature).most)
    );
    if (radiation.missing)
    {
        add("Radiation " + radiation.text);
    }
    const sphereEstimates::contacts contacts
    (
        estimates.forces(course.values(runCourse::pressure).most)
    );
    if (contacts.beyond)
    {
        add("Contacts: " + contacts.text);
    }
}


void Foam::caseWarnings::checkCells()
{
    const Vector<label>& solved = mesh_.geometricD();
    const scalar diameter = 2*properties_.meanRadius().value();
    scalar least = GREAT, sum = 0, grains = 0;
    label small = 0;
    // Of a plane mesh: discs over its thickness
    const scalar disc =
        constant::mathematical::pi*sqr(0.5*diameter)
       *mesh_.bounds().span().z();
    forAll(mesh_.cells(), celli)
    {
        const boundBox box
        (
            mesh_.points(), mesh_.cellPoints()[celli], false
        );
        scalar size = GREAT;
        for (direction i = 0; i < vector::nComponents; ++i)
        {
            size = solved[i] > 0 ? min(size, box.span()[i]) : size;
        }
        small += size < diameter;
        least = min(least, size);
        sum += size;
        grains += mesh_.V()[celli]*(1 - grains_.porosity()[celli])/disc;
    }
    reduce(small, sumOp<label>());
    reduce(least, minOp<scalar>());
    const label cells = returnReduce(mesh_.nCells(), sumOp<label>());
    cellSize_ = returnReduce(sum, sumOp<scalar>())/cells;
    const scalar inCell = returnReduce(grains, sumOp<scalar>())/cells;
    if (!grains_.model().isThreeDimensional() && solved.z() < 0 && inCell < fewGrains)
    {
        add
        (
            "A cell has " + brief(inCell) + " grains, usual: about "
          + brief(fewGrains) + " and more. A cell describes the mean over its"
            " grains, which says little for so few, even if the result looks"
            " smooth: make fewer and larger cells, or check meanRadius, which is "
          + brief(0.5*diameter) + " m"
        );
    }
    const scalar across = leastWallDistance(mesh_)/diameter;
    if (across > 0 && across < fewGrains)
    {
        add
        (
            "The bed is " + brief(across) + " grains wide, usual: "
          + brief(fewGrains) + " and more. With so few grains side by side the"
            " walls arrange them, and mean properties of a bed say little. Is"
            " the mesh in metres?"
        );
    }
    if (small)
    {
        add
        (
            brief(100*scalar(small)/cells) + " % of the cells are thinner than a"
            " grain, the thinnest " + brief(least/diameter) + " diameters: what"
            " varies over less than a grain is no average over grains"
        );
    }
}


void Foam::caseWarnings::checkGrains()
{
    const scalar values[] =
    {
        properties_.density().value(),
        properties_.youngModulus().value(),
        properties_.thermalConductivity().value()
    };
    for (label i = 0; i < 3; ++i)
    {
        const largestOf& of = largest[i];
        if (values[i] > of.most)
        {
            add
            (
                string("Entry '") + of.key + "' of constant/granularProperties"
                " is " + brief(values[i]) + ' ' + of.unit + ", usual: up to "
              + brief(of.most) + " in solids; " + of.what
            );
        }
    }
    const scalar lateral =
        properties_.restStressDict().getOrDefault<scalar>("lateral", 1);
    if (lateral < leastLateral || lateral > mostLateral)
    {
        add
        (
            "Entry 'lateral' of restStress is " + brief(lateral) + ", usual: "
          + brief(leastLateral) + " to " + brief(mostLateral) + ". Beyond,"
            " grains slide until the lateral stress is within these shares of"
            " the vertical one"
        );
    }
    const dictionary spheres
    (
        properties_.surrogateDict().subOrEmptyDict("spheresCoeffs")
    );
    const scalar radius = properties_.meanRadius().value();
    for (const dictionary& surface : {spheres, spheres.subOrEmptyDict("wall")})
    {
        const scalar roughness = surface.getOrDefault<scalar>("roughness", 0);
        if (roughness > mostRough*radius)
        {
            add
            (
                "Entry 'roughness' of spheresCoeffs is " + brief(roughness)
              + " m, usual: at most a hundredth of meanRadius, "
              + brief(mostRough*radius) + " m. Is it in metres?"
            );
        }
    }
}


void Foam::caseWarnings::checkGas()
{
    const temperatureFunction& k = properties_.conductivityFunction();
    const granularModel& model = grains_.model();
    const scalar usual = temperatureFunction::usualTemperature;
    if (model.conductivityRatio(usual) == 0)
    {
        return;
    }
    const auto gas = [&](const scalar T)
    {
        return k.value(T)/model.conductivityRatio(T);
    };
    for (const bool hot : {false, true})
    {
        // Beyond the range of the gas the library takes the nearest end
        const scalar T =
            max(hot ? temperatures_.most : temperatures_.least, scalar(1));
        const scalar there = gas(T);
        scalar outside = T, inside = usual;
        for (label i = 0; i < halvings; ++i)
        {
            const scalar middle = 0.5*(inside + outside);
            (mag(gas(middle)/there - 1) < sameGas ? outside : inside) = middle;
        }
        if ((hot ? 1 : -1)*(T - outside) > 1e-6*T && (hot ? T > usual : T < usual))
        {
            add
            (
                "T gets to " + brief(T) + " K, and the gas is tabulated "
              + (hot ? "up to " : "down to ") + brief(outside) + " K. Beyond,"
                " the solver takes it as it is there. Temperatures are in"
                " Kelvin"
            );
        }
    }
}


// ************************************************************************* //
