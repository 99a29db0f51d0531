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

Application
    fuzzProperties

Description
    Test: reads constant/granularProperties in damaged forms, each of which
    must be taken or be refused by a message; the header FoamFile stays whole.
    A crash, a trap or a hang is what it looks for. Of each form that is taken
    model, state and mechanics are made, and a tangent is asked for.

Usage
    fuzzProperties -rounds 1000 -seed 1

\*---------------------------------------------------------------------------*/

#include "fvCFD.H"
#include "granularState.H"
#include "granularMechanics.H"

#include <cfenv>
#include <fstream>
#include <iterator>
#include <random>

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

typedef std::mt19937_64 generator;

static size_t below(generator& random, const size_t end)
{
    return end ? random() % end : 0;
}


//- Position and length of a random word or number of the text
static std::pair<size_t, size_t> wordOf
(
    generator& random,
    const std::string& s
)
{
    const std::string blank(" \t\n;{}()");
    size_t from = s.find_first_not_of(blank, below(random, s.size()));
    from = from == std::string::npos ? 0 : from;
    const size_t to = s.find_first_of(blank, from);
    return {from, (to == std::string::npos ? s.size() : to) - from};
}


static std::string damaged(generator& random, std::string s)
{
    static const std::vector<std::string> odd
    ({
        "nan", "inf", "-1", "0", "-0.0", "1e308", "1e-308", "1e400", "5e-324",
        "99999999999999999999", "{}", "()", ";", "\"", "yes", "none", "-", "",
        "equilibrium", "constant", "plugin", "builtin:paper", "(1 2 3)",
        "(0 0 0 0 0 0)", "$density", "[0 1 0 0 0 0 0]", "/*", "//"
    });
    const size_t changes = 1 + below(random, 3);
    for (size_t i = 0; i < changes && !s.empty(); ++i)
    {
        const auto here = wordOf(random, s);
        switch (below(random, 6))
        {
            case 0:
                s[below(random, s.size())] ^= char(1 << below(random, 8));
                break;
            case 1:
                s.erase(below(random, s.size()), below(random, 20));
                break;
            case 2:
            case 3:
                s.replace
                (
                    here.first, here.second, odd[below(random, odd.size())]
                );
                break;
            case 4:
                s.insert(here.first, s.substr(below(random, s.size()), 30));
                break;
            default:
                s.erase(here.first, here.second);
        }
    }
    return s;
}


//- Trap overflow, as in the solver; the trap is off while OpenFOAM reads the
//- dictionary, since its reader of numbers traps on 1e400
static void trapOverflow()
{
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_OVERFLOW);
}


//- Make all parts of the solver that read the dictionary
static void ask(const granularProperties& properties, volScalarField& T)
{
    granularState grains(properties, T);
    autoPtr<granularMechanics> mechanics
    (
        granularMechanics::New(properties, grains)
    );
}


int main(int argc, char *argv[])
{
    argList::addOption("rounds", "number", "forms to try");
    argList::addOption("seed", "number", "of the forms");

    #include "setRootCase.H"
    #include "createTime.H"
    #include "createMesh.H"

    const label rounds = args.getOrDefault<label>("rounds", 1000);
    generator random(args.getOrDefault<label>("seed", 1));

    volScalarField T
    (
        IOobject("T", runTime.timeName(), mesh, IOobject::MUST_READ), mesh
    );
    const fileName file(runTime.constantPath()/"granularProperties");
    std::string good;
    {
        std::ifstream is(file);
        good.assign(std::istreambuf_iterator<char>(is), {});
    }
    // FoamFile is left out: OpenFOAM's reader of it traps on a version of 1e20
    const size_t body = good.find('}') + 1;
    FatalError.throwExceptions();
    FatalIOError.throwExceptions();
    messageStream::level = 0;
    // Without this OpenFOAM ends at a sub-dictionary with a blank in its name
    fileName::debug = 0;

    label taken = 0, asked = 0, refused = 0;
    for (label round = 0; round < rounds; ++round)
    {
        // A file that is written over waits for the disk
        rm(file);
        {
            std::ofstream os(file, std::ios::trunc | std::ios::binary);
            os << good.substr(0, body) << damaged(random, good.substr(body));
        }
        try
        {
            fedisableexcept(FE_OVERFLOW);
            const granularProperties properties(runTime);
            trapOverflow();
            ++taken;
            ask(properties, T);
            ++asked;
        }
        catch (const Foam::error&)
        {
            ++refused;
            trapOverflow();
        }
    }
    {
        std::ofstream os(file, std::ios::trunc | std::ios::binary);
        os << good;
    }
    std::printf
    (
        "%d forms: %d read, %d of them sound, %d refused by a message\n",
        int(rounds), int(taken), int(asked), int(refused)
    );
    return taken && refused ? 0 : 1;
}


// ************************************************************************* //
