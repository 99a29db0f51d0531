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

#include "timeFolder.H"
#include "wholeFile.H"
#include "IFstream.H"
#include "IStringStream.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "SHA1.H"
#include "error.H"

#include <iterator>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const std::string lastLine = "checksum \"";
static const std::string lastEnd = "\";\n";

//- Text of a file, of a compressed one what it was compressed from; empty if
//- there is none
static std::string contents(const fileName& path)
{
    IFstream is(path);
    return
        is.good()
      ? std::string(std::istreambuf_iterator<char>(is.stdStream()), {})
      : std::string();
}

static string listedNames(const fileNameList& names)
{
    string text;
    for (const fileName& name : names)
    {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}


static string checksum(const std::string& text)
{
    return SHA1(text).digest().str();
}


//- Whether the record was written by version 0.1, which wrote no list of files
//- and no checksum
static bool isOfOlderVersion(const std::string& record)
{
    const auto has = [&](const char* word)
    {
        return record.find(word) != std::string::npos;
    };
    return has("initialMass") && has("heat") && !has("program");
}


//- Whether a text has its end: the line with which OpenFOAM ends its files, or,
//- of files written by others, a last bracket or semicolon with all brackets
//- closed
static bool isComplete(const std::string& text)
{
    const size_t last = text.find_last_not_of(" \t\r\n");
    if (last == std::string::npos)
    {
        return false;
    }
    if (last >= 3 && text.compare(last - 3, 4, "* //") == 0)
    {
        return true;
    }
    if (text[last] != '}' && text[last] != ';')
    {
        return false;
    }
    label open = 0;
    for (const char c : text)
    {
        open += (c == '{' || c == '(' || c == '[');
        open -= (c == '}' || c == ')' || c == ']');
    }
    return open == 0;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeFolder::timeFolder(const fileName& path, const fileName& region)
:
    path_(path),
    region_(region),
    recordName_(region_/"uniform/msddFoam")
{
    const fileName file(path_/recordName_);
    if (!holds(recordName_))
    {
        damage_ = recordName_ + ", which is written last, is missing";
        return;
    }
    const std::string text(contents(file));
    const size_t last = text.rfind("\n" + lastLine);
    const bool signedFile = last != std::string::npos;
    if (signedFile)
    {
        const std::string body(text, 0, last + 1);
        if (text != body + lastLine + checksum(body) + lastEnd)
        {
            damage_ = recordName_ + " is damaged";
            return;
        }
    }
    else if (!isOfOlderVersion(text))
    {
        damage_ = recordName_ + " is incomplete";
        return;
    }
    IStringStream is(text);
    record_ = dictionary(is);
    record_.name() = file;
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::List<std::pair<Foam::fileName, Foam::string>>
Foam::timeFolder::listed() const
{
    const stringList words(record_.lookupOrDefault("files", stringList()));
    List<std::pair<fileName, string>> result(words.size()/2);
    forAll(result, i)
    {
        result[i].first = words[2*i];
        result[i].second = words[2*i + 1];
    }
    return result;
}


// * * * * * * * * * * * * * Static Member Functions * * * * * * * * * * * * //

void Foam::timeFolder::write
(
    const fileName& path,
    const fileName& region,
    const fileNameList& names,
    const std::string& record
)
{
    const timeFolder folder(path, region);
    std::string text(record);
    text += "files\n(\n";
    for (const fileName& name : names)
    {
        const std::string written(contents(path/name));
        if (!isComplete(written))
        {
            FatalErrorInFunction
                << "Cannot write " << path/name << ": it is missing or ends"
                << " too early. Is the disk full? A restart takes the last"
                << " time that is complete" << exit(FatalError);
        }
        text +=
            "    \"" + name + "\" \"" + checksum(written) + "\"\n";
    }
    text += ");\n";
    text += lastLine + checksum(text) + lastEnd;

    writeWhole(path/folder.recordName_, [&](std::ostream& os) { os << text; });
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::timeFolder::exists() const
{
    return isDir(path_, false);
}


bool Foam::timeFolder::holds(const fileName& name) const
{
    return isFile(path_/name, true);    // or its compressed form
}


bool Foam::timeFolder::isStart() const
{
    return
        holdsT() && !holds("uniform/time") && !holds(recordName_);
}


bool Foam::timeFolder::redistributed() const
{
    return
        record_.lookupOrDefault<label>("processes", 1)
     != (Pstream::parRun() ? Pstream::nProcs() : 1)
     || record_.lookupOrDefault<label>("process", 0) != Pstream::myProcNo();
}


Foam::string Foam::timeFolder::missing() const
{
    if (!hasRecord())
    {
        return
            !exists() ? string("it is not there")
          : !holds("uniform/time") && !holdsT()
          ? string(std::string(path_.name()/region_/"T") + " is missing")
          : damage_;
    }
    fileNameList lost, cut;
    for (const auto& item : listed())
    {
        if (!holds(item.first))
        {
            lost.append(item.first);
        }
        else if (!isComplete(contents(path_/item.first)))
        {
            cut.append(item.first);
        }
    }
    return
        !lost.empty() ? "missing: " + listedNames(lost)
      : !cut.empty() ? "without its end: " + listedNames(cut)
      : string();
}


Foam::string Foam::timeFolder::changed() const
{
    fileNameList other;
    for (const auto& item : listed())
    {
        if (checksum(contents(path_/item.first)) != item.second)
        {
            other.append(item.first);
        }
    }
    return other.empty() ? string() : "not as written: " + listedNames(other);
}


// ************************************************************************* //
