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

Description
    Makes Foam::osha1stream of Debian 13 work, without which every program of
    OpenFOAM ends with an error at a case that has function objects.

    The buffer of that stream takes strings, but not single characters: it has
    xsputn and no overflow. The standard library of GCC 13 and newer writes a
    character of width zero by put, thus by overflow; older ones by xsputn.

    OpenFOAM's header defines the class inline, so that its table of virtual
    functions is a weak symbol. The one below is the program's own, which the
    dynamic linker finds before that of libOpenFOAM.so. The layout of the class
    must be that of OpenFOAM v1912, OSHA1stream.H.

\*---------------------------------------------------------------------------*/

#if OPENFOAM < 2206

#include "SHA1.H"

#include <iostream>

namespace Foam
{

class osha1stream
:
    virtual public std::ios,
    public std::ostream
{
public:

    class sha1buf
    :
        public std::streambuf
    {
        SHA1 sha1_;

    protected:

        virtual std::streamsize xsputn(const char* text, std::streamsize count) override
        {
            sha1_.append(text, count);
            return count;
        }

        virtual int_type overflow(int_type character) override
        {
            if (!traits_type::eq_int_type(character, traits_type::eof()))
            {
                const char text = traits_type::to_char_type(character);
                sha1_.append(&text, 1);
            }
            return traits_type::not_eof(character);
        }
    };
};

//- Has the compiler write the table of virtual functions
std::streambuf* newSha1Buffer()
{
    return new osha1stream::sha1buf;
}

} // End namespace Foam

#endif

// ************************************************************************* //
