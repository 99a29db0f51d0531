/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM v1912
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
#include "IStringStream.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "SHA1.H"
#include "error.H"

#include <fstream>
#include <iterator>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const char* const recordName = "uniform/msddFoam";
static const std::string lastLine = "checksum \"";
static const std::string lastEnd = "\";\n";

//- Last characters of complete files written by OpenFOAM, and of JSON files
static const std::string endOfFile = "* //\n";
static const std::string endOfJson = "}\n";

static std::string contents(const fileName& path)
{
    std::ifstream is(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(is), {});
}


static bool endsWith(const std::string& text, const std::string& end)
{
    return
        text.size() >= end.size()
     && text.compare(text.size() - end.size(), end.size(), end) == 0;
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


//- Whether a file that was just written is complete. Of a compressed file it
//- is only known whether it exists.
static bool isComplete(const fileName& file, const std::string& text)
{
    return
        !text.empty()
     && (
            file.ext() == "gz"
         || endsWith(text, file.ext() == "json" ? endOfJson : endOfFile)
        );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::timeFolder::timeFolder(const fileName& path)
:
    path_(path)
{
    const fileName file(path_/recordName);
    if (!isFile(file, false))
    {
        damage_ = string(recordName) + ", which is written last, is missing";
        return;
    }
    const std::string text(contents(file));
    const size_t last = text.rfind("\n" + lastLine);
    const bool signedFile = last != std::string::npos;
    if (signedFile)
    {
        const std::string body(text, 0, last + 1);
        if (text != body + lastLine + SHA1(body).digest().str() + lastEnd)
        {
            damage_ = string(recordName) + " is damaged";
            return;
        }
    }
    else if (!isOfOlderVersion(text))
    {
        damage_ = string(recordName) + " is incomplete";
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


Foam::fileName Foam::timeFolder::file(const fileName& name) const
{
    const fileName plain(path_/name), compressed(plain + ".gz");
    return
        isFile(plain, false) ? plain
      : isFile(compressed, false) ? compressed
      : fileName();
}


Foam::string Foam::timeFolder::checksum(const fileName& path)
{
    return SHA1(contents(path)).digest().str();
}


// * * * * * * * * * * * * * Static Member Functions * * * * * * * * * * * * //

void Foam::timeFolder::write
(
    const fileName& path,
    const fileNameList& names,
    const std::string& record
)
{
    const timeFolder folder(path);
    std::string text(record);
    text += "files\n(\n";
    for (const fileName& name : names)
    {
        const fileName file(folder.file(name));
        const std::string written(contents(file));
        if (!isComplete(file, written))
        {
            FatalErrorInFunction
                << "Cannot write " << path/name << ": it is missing or ends"
                << " too early. Is the disk full? A restart takes the last"
                << " time that is complete" << exit(FatalError);
        }
        text +=
            "    \"" + name + "\" \"" + SHA1(written).digest().str() + "\"\n";
    }
    text += ");\n";
    text += lastLine + SHA1(text).digest().str() + lastEnd;

    writeWhole(path/recordName, [&](std::ostream& os) { os << text; });
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::timeFolder::exists() const
{
    return isDir(path_, false);
}


bool Foam::timeFolder::isStart() const
{
    return
        holds("T") && !holds("uniform/time")
     && !isFile(path_/recordName, false);
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
          : !holds("uniform/time") && !holds("T")
          ? string(path_.name() + "/T is missing")
          : damage_;
    }
    fileNameList lost;
    for (const auto& item : listed())
    {
        if (!holds(item.first))
        {
            lost.append(item.first);
        }
    }
    return lost.empty() ? string() : "missing: " + listedNames(lost);
}


Foam::string Foam::timeFolder::changed() const
{
    fileNameList other;
    for (const auto& item : listed())
    {
        if (checksum(file(item.first)) != item.second)
        {
            other.append(item.first);
        }
    }
    return other.empty() ? string() : "not as written: " + listedNames(other);
}


// ************************************************************************* //
