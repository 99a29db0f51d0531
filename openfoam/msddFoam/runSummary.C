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

#include "runSummary.H"
#include "foamVersions.H"
#include "OStringStream.H"
#include "wholeFile.H"
#include "Time.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- A list of texts of a JSON file
static void writeTexts(Ostream& os, const UList<string>& texts)
{
    os  << '[';
    forAll(texts, i)
    {
        os  << (i ? ", " : "") << texts[i];
    }
    os  << ']';
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::runSummary::runSummary
(
    const granularProperties& properties,
    const volScalarField& T,
    granularState& grains,
    const granularMechanics& mechanics,
    const clockTime& wallClock
)
:
    properties_(properties),
    T_(T),
    grains_(grains),
    mechanics_(mechanics),
    wallClock_(wallClock)
{
    if (Pstream::master())
    {
        rm(path());
    }
}


Foam::fileName Foam::runSummary::path() const
{
    return
        grains_.mesh().time().globalPath()
       /"postProcessing/msddFoam/summary.json";
}


void Foam::runSummary::writeCourse
(
    Ostream& os,
    const heatBalance& heat,
    const UList<string>& warnings
) const
{
    const runCourse& course = grains_.record().course;
    const scalar since = course.beyondSince();
    const scalar share = steadyShare(heat);
    const auto orNull = [&os](const bool known, const scalar value)
    {
        known ? os << value : os << "null";
    };
    os  << "  \"compared\": {\"known\": "
        << (course.compared() ? "true" : "false") << ", \"beyond\": ";
    writeTexts(os, course.beyond());
    os  << ", \"beyond_since\": ";
    orNull(since < GREAT, since);
    const runCourse::relief& relief = course.unloaded();
    os  << "},\n  \"unloaded\": {\"least_share\": " << relief.share
        << ", \"since\": ";
    orNull(relief.periods, relief.since);
    os  << ", \"until\": ";
    orNull(relief.periods, relief.until);
    os  << ", \"loaded_since\": ";
    orNull(course.lostLoad(), relief.loaded);
    os  << ", \"largest_factor\": ";
    orNull(course.lostLoad(), lostLoadError);
    os  << "},\n  \"steady\": {\"rate\": " << course.rate()
        << ", \"uptake\": " << course.uptake().heat << ", \"share\": ";
    orNull(share > 0, share);
    os  << "},\n  \"warnings\": ";
    writeTexts(os, warnings);
    os  << ",\n";
}


void Foam::runSummary::writeMechanics(Ostream& os) const
{
    const granularMechanics::counters moved(mechanics_.count());
    os  << "  \"mechanics\": {\"kind\": " << string(mechanics_.type())
        << ", \"solves\": " << moved.solves
        << ", \"iterations\": " << moved.iterations
        << ", \"linear_iterations\": " << moved.linear
        << ", \"cut_steps\": " << moved.cut
        << ", \"unconverged_steps\": " << moved.unconverged
        << ", \"residual\": " << moved.residual
        << ", \"unconverged_residual\": " << moved.unbalanced
        << ", \"displacement\": " << moved.displacement
        << ", \"gap\": " << moved.gap
        << ", \"warnings\": [";
    forAll(moved.warnings, i)
    {
        os  << (i ? ", " : "") << moved.warnings[i];
    }
    os  << "]},\n";
}


void Foam::runSummary::writeFinal(Ostream& os) const
{
    const fvMesh& mesh = grains_.mesh();
    const auto mean = [&mesh](const auto& field)
    {
        return field.weightedAverage(mesh.V()).value();
    };
    const symmTensor K = mean(grains_.conductivity());
    const symmTensor stress = mean(grains_.stress());
    os  << "  \"model\": {\"source\": " << grains_.model().source()
        << ", \"hash\": " << string(grains_.model().hash())
        << ", \"library_version\": "
        << string(granularModel::libraryVersion());
    for (const auto& item : grains_.modelCounts())
    {
        os  << ", \"" << item.first.c_str() << "\": " << item.second;
    }
    os  << "},\n"
        << "  \"final\": {\n"
        << "    \"time\": " << mesh.time().value() << ",\n"
        << "    \"porosity\": " << mean(grains_.porosity()) << ",\n"
        << "    \"fabric\": " << mean(grains_.fabricIndex()) << ",\n"
        << "    \"conductivity_xx\": " << K.xx() << ",\n"
        << "    \"conductivity_yy\": " << K.yy() << ",\n";
    if (grains_.model().isThreeDimensional())
    {
        os  << "    \"conductivity_zz\": " << K.zz() << ",\n"
            << "    \"stress_zz\": " << -stress.zz() << ",\n";
    }
    os  << "    \"stress_xx\": " << -stress.xx() << ",\n"
        << "    \"stress_yy\": " << -stress.yy() << ",\n"
        << "    \"pressure\": " << mean(grains_.pressure()) << "\n  }\n}"
        << endl;
}


Foam::DynamicList<Foam::string> Foam::runSummary::sentences
(
    const heatBalance& heat,
    const string& solids,
    const granularFlow& flow
) const
{
    DynamicList<string> result(runRecord::notes);
    DynamicList<string> all(flow.sentences());
    for
    (
        const string& sentence :
        {
            range(), radiation(), contacts(), warning(), unloaded(), contact(),
            balance(heat), solids, steadiness(heat), motion(), cost()
        }
    )
    {
        all.append(sentence);
    }
    for (const string& sentence : all)
    {
        if (!sentence.empty())
        {
            result.append(sentence);
        }
    }
    return result;
}


void Foam::runSummary::write
(
    const runResults& results,
    const label rejected,
    const UList<string>& warnings,
    const string& solids,
    const granularFlow& flow
) const
{
    const fvMesh& mesh = grains_.mesh();
    const Time& time = mesh.time();
    const label steps = time.timeIndex() - time.startTimeIndex();
    const label cells = returnReduce(mesh.nCells(), sumOp<label>());
    const int64_t clamped = grains_.clampedQueries();
    const int64_t asked = grains_.asked(), all = grains_.cellSteps();
    const scalar wallSeconds = wallClock_.elapsedTime();
    const scalar cpuSeconds =
        returnReduce(time.elapsedCpuTime(), sumOp<scalar>());
    const heatBalance heat(this->heat());
    const DynamicList<string> sentences(this->sentences(heat, solids, flow));

    Info<< "Steps: " << steps << ", repeated " << rejected << nl
        << "Wall time: " << wallSeconds << " s" << nl << nl
        << "Results at " << time.value() << " s:" << nl;
    for (const string& sentence : results.sentences())
    {
        Info<< "  - " << sentence.c_str() << nl;
    }
    Info<< nl << "Accuracy and warnings of this run:" << nl;
    for (const string& sentence : sentences)
    {
        Info<< "  - " << sentence.c_str() << nl;
    }
    Info<< endl;

    OStringStream os;
    os.precision(10);
    os  << "{\n  \"application\": \"msddFoam\",\n"
        << "  \"built_for\": \"" << foamText().c_str() << "\",\n"
        << "  \"wall_seconds\": " << wallSeconds << ",\n"
        << "  \"cpu_seconds\": " << cpuSeconds << ",\n"
        << "  \"steps\": " << steps << ",\n"
        << "  \"cells\": " << cells << ",\n"
        << "  \"queries\": " << grains_.queries() << ",\n"
        << "  \"clamped_queries\": " << clamped << ",\n"
        << "  \"cell_queries\": " << asked << ",\n"
        << "  \"cell_steps\": " << all << ",\n"
        << "  \"rejected_steps\": " << rejected << ",\n";
    writeMechanics(os);
    os  << "  \"heat\": {\"patches\": " << heat.patches
        << ", \"sources\": " << heat.sources
        << ", \"stored\": " << heat.stored
        << ", \"exchanged\": " << heat.exchanged
        << ", \"relative_difference\": " << heat.difference() << "},\n";
    const string flowing(flow.summary());
    if (!flowing.empty())
    {
        os  << "  \"flow\": " << flowing.c_str() << ",\n";
    }
    os  << "  \"results\": " << results.json().c_str() << ",\n";
    writeCourse(os, heat, warnings);
    os  << "  \"what_to_know\": [";
    forAll(sentences, i)
    {
        os  << (i ? ",\n    " : "\n    ") << sentences[i];
    }
    os  << "\n  ],\n";
    writeFinal(os);
    if (Pstream::master())
    {
        writeWhole(path(), [&](std::ostream& file) { file << os.str(); });
    }
}


// ************************************************************************* //
