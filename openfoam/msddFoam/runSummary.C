/*---------------------------------------------------------------------------*\
    MSDD: multiscale data-driven heat conduction in granular media

    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "runSummary.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "Time.H"

Foam::runSummary::runSummary
(
    const fvMesh& mesh,
    const granularSurrogate& surrogate,
    const clockTime& wallClock
)
:
    mesh_(mesh),
    surrogate_(surrogate),
    wallClock_(wallClock)
{
    if (Pstream::master())
    {
        rm(path());
    }
}


Foam::fileName Foam::runSummary::path() const
{
    return mesh_.time().globalPath()/"postProcessing/msddFoam/summary.json";
}


void Foam::runSummary::write
(
    const volScalarField& porosity,
    const volScalarField& fabricIndex,
    const volSymmTensorField& conductivity,
    const volSymmTensorField& stress,
    const volScalarField& pressure
) const
{
    const Time& time = mesh_.time();
    const label steps = time.timeIndex() - time.startTimeIndex();
    const label cells = returnReduce(mesh_.nCells(), sumOp<label>());
    const int64_t clamped = surrogate_.clampedQueries();

    const scalar meanPorosity = porosity.weightedAverage(mesh_.V()).value();
    const scalar meanFabric = fabricIndex.weightedAverage(mesh_.V()).value();
    const symmTensor meanK = conductivity.weightedAverage(mesh_.V()).value();
    const symmTensor meanStress = stress.weightedAverage(mesh_.V()).value();
    const scalar meanPressure = pressure.weightedAverage(mesh_.V()).value();
    const scalar wallSeconds = wallClock_.elapsedTime();

    Info<< "Surrogate model: " << surrogate_.source() << ", SHA-256 "
        << surrogate_.hash() << ", library " << msdd::version() << nl
        << "Queries: " << surrogate_.queries() << " of " << cells
        << " cells each" << nl
        << "Clamped cell-queries: " << clamped << nl
        << "Steps: " << steps << nl
        << "Wall time: " << wallSeconds << " s" << nl << endl;

    if (!Pstream::master())
    {
        return;
    }

    mkDir(path().path());
    const fileName beside(path() + ".part");
    {
        OFstream os(beside);
        os.precision(10);
        os  << "{\n  \"application\": \"msddFoam\",\n"
            << "  \"wall_seconds\": " << wallSeconds << ",\n"
            << "  \"steps\": " << steps << ",\n"
            << "  \"cells\": " << cells << ",\n"
            << "  \"queries\": " << surrogate_.queries() << ",\n"
            << "  \"clamped_queries\": " << clamped << ",\n"
            << "  \"model\": {\"source\": " << string(surrogate_.source())
            << ", \"hash\": " << string(surrogate_.hash())
            << ", \"library_version\": " << string(msdd::version()) << "},\n"
            << "  \"final\": {\n"
            << "    \"time\": " << time.value() << ",\n"
            << "    \"porosity\": " << meanPorosity << ",\n"
            << "    \"fabric\": " << meanFabric << ",\n"
            << "    \"conductivity_xx\": " << meanK.xx() << ",\n"
            << "    \"conductivity_yy\": " << meanK.yy() << ",\n"
            << "    \"stress_xx\": " << -meanStress.xx() << ",\n"
            << "    \"stress_yy\": " << -meanStress.yy() << ",\n"
            << "    \"pressure\": " << meanPressure << "\n  }\n}" << endl;

        if (!os.good())
        {
            FatalErrorInFunction
                << "Cannot write " << beside << exit(FatalError);
        }
    }
    mv(beside, path());
}


// ************************************************************************* //
