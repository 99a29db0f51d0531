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

#include "granularFunctionObject.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::granularFunctionObject::granularFunctionObject
(
    const word& name,
    const word& file,
    const Time& runTime,
    const dictionary& dict,
    const keyTable& columns
)
:
    fvMeshFunctionObject(name, runTime, dict),
    writeFile(mesh_, name, file),
    columns_(columns)
{}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

void Foam::functionObjects::granularFunctionObject::begin
(
    const dictionary& dict
)
{
    read(dict);
    const runRecord* run = mesh_.findObject<runRecord>("msddFoam");
    const word control(dict.lookupOrDefault<word>("writeControl", "timeStep"));
    if
    (
        run && !run->continues && control != "none" && control != "onEnd"
     && time_.value() >= dict.lookupOrDefault<scalar>("timeStart", -VGREAT)
    )
    {
        write();
    }
}


bool Foam::functionObjects::granularFunctionObject::lacks
(
    const wordList& fields
) const
{
    for (const word& name : fields)
    {
        IOobject header
        (
            name, time_.timeName(), mesh_,
            IOobject::MUST_READ, IOobject::NO_WRITE, false
        );
        if
        (
            !mesh_.foundObject<regIOobject>(name)
         && !header.typeHeaderOk<volScalarField>(false, false, false)
        )
        {
            Info<< type() << ' ' << this->name() << ": no row for the time "
                << time_.timeName() << ", which has no field " << name << endl;
            return true;
        }
    }
    return false;
}


Foam::scalarField
Foam::functionObjects::granularFunctionObject::cellsOf
(
    const word& name,
    const scalar otherwise
) const
{
    IOobject header
    (
        name, time_.timeName(), mesh_,
        IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false
    );
    if
    (
        mesh_.foundObject<volScalarField>(name)
     || header.typeHeaderOk<volScalarField>(true)
    )
    {
        return present<scalar>(name)().primitiveField();
    }
    return scalarField(mesh_.nCells(), otherwise);
}


const Foam::runRecord&
Foam::functionObjects::granularFunctionObject::record()
{
    if (mesh_.foundObject<runRecord>("msddFoam"))
    {
        return mesh_.lookupObject<runRecord>("msddFoam");
    }
    // Run by postProcess: the record that the solver wrote at this time
    read_.reset(new runRecord(mesh_, false));
    return read_();
}


void Foam::functionObjects::granularFunctionObject::refresh()
{
    const runRecord& found = record();
    if (found.refresh)
    {
        found.refresh();
    }
}


Foam::Ostream& Foam::functionObjects::granularFunctionObject::line()
{
    if (!writtenHeader_)
    {
        resetFile(fileName_);
        writeHead(file());
        file() << endl;
        writtenHeader_ = true;
    }
    file() << time_.timeName();
    return file();
}


void Foam::functionObjects::granularFunctionObject::writeHead
(
    Ostream& os
) const
{
    columns_.explain(os);
    writeCommented(os, "Time");
    for (const keyTable::entry& column : columns_.entries())
    {
        writeTabbed(os, column.name);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::granularFunctionObject::read
(
    const dictionary& dict
)
{
    return fvMeshFunctionObject::read(dict) && writeFile::read(dict);
}


// ************************************************************************* //
