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

#include "pluginModel.H"
#include "addToRunTimeSelectionTable.H"
#include "dynamicCode.H"
#include "OSspecific.H"

#include <cstdlib>
#include <sstream>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace granularModels
{
    defineTypeNameAndDebug(plugin, 0);
    addToRunTimeSelectionTable(granularModel, plugin, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const keyTable pluginKeys
(
    "pluginCoeffs",
    {
        {
            "library", "the shared library, relative to the case folder", "-",
            "a library that defines `msdd_plugin_v2_table`", "required"
        },
        {
            "hash",
            "SHA-256 of the library, compared after it was loaded: it protects"
            " from a mix-up, not from bad code", "-", "the hash of the file",
            "any"
        }
    }
);


//- The environment variable in which a user names plug-ins
static const char* const allowPlugins = "MSDD_ALLOW_PLUGINS";


//- Path of a file without links and relative parts; empty if there is no file
static fileName realPath(const std::string& path)
{
    char* found = ::realpath(path.c_str(), nullptr);
    const fileName result(found ? found : "");
    ::free(found);
    return result;
}


//- Whether a list of paths, separated by colons, names the file
static bool names(const std::string& list, const fileName& file)
{
    std::istringstream paths(list);
    for (std::string path; std::getline(paths, path, ':');)
    {
        if (!path.empty() && realPath(path) == file)
        {
            return true;
        }
    }
    return false;
}

} // End namespace Foam


// * * * * * * * * * * * * Private Static Functions  * * * * * * * * * * * * //

Foam::fileName Foam::granularModels::plugin::admitted
(
    const granularProperties& properties
)
{
    const dictionary& dict =
        properties.surrogateDict().optionalSubDict("pluginCoeffs");
    const fileName library(dict.get<fileName>("library"));
    const fileName file(realPath(properties.path(library)));

    if (file.empty())
    {
        // There is no such file; loading the model reports it
        return library;
    }
    if (!dynamicCode::allowSystemOperations)
    {
        FatalIOErrorInFunction(dict)
            << "The case loads the plug-in " << file << ", and this machine "
            << "does not allow code of cases." << nl
            << "If you trust it, set 'allowSystemOperations 1;' in the "
            << "InfoSwitches of ~/.OpenFOAM/controlDict." << exit(FatalIOError);
    }
    if (isAdministrator() && !names(getEnv(allowPlugins), file))
    {
        FatalIOErrorInFunction(dict)
            << "The case loads the plug-in " << file << ", and its code would "
            << "run with administrator rights." << nl
            << "If you trust it, name it before the run:" << nl << nl
            << "    export " << allowPlugins << '=' << file << nl << nl
            << "Several are separated by colons. Nothing in a case can "
            << "give this permission." << exit(FatalIOError);
    }
    Info<< "Loading plug-in " << file << ": its code runs in this process"
        << endl;
    return library;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularModels::plugin::plugin
(
    const granularProperties& properties,
    const fvMesh& mesh
)
:
    surrogateModel
    (
        typeName,
        "library",
        admitted(properties),
        "a shared library made against msdd.h",
        properties,
        mesh
    )
{
    checkCoeffs(pluginKeys);
}


// ************************************************************************* //
