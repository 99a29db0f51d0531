# What keeps the sources fit for other versions of OpenFOAM than the installed one, and how Allwmake takes a sourced one.

header=$checkout/openfoam/granularModels/granularModel/foamVersions.H
stubs=$here/versions
parses() { # version of the header, version of the declarations (0: none)
    g++ -fsyntax-only -std=c++14 -Wall -Wextra -Werror -Wsuggest-override -I"$stubs" -I"$(dirname "$header")" \
        -DOPENFOAM="$1" -DSTUB="$2" "$stubs/use.C" > "$work/parse.log" 2>&1
}
header_of_versions() {
    local version right="" wrong="" before=0 versions="1912 2006 2106 2112 2206 2306 2412 2506 2606"
    for version in $versions; do
        parses "$version" "$version" && right+=" $version"
    done
    check "foamVersions.H parses with the declarations of$right" test "$right" = " $versions"
    for version in 1912 2006 2106 2112 2206 2306 2506 2606; do # each of these changed a declaration
        [ $before = 0 ] || parses $before "$version" || wrong+=" $before"
        [ $before = 0 ] || parses "$version" $before || wrong+=" $version"
        before=$version
    done
    check "foamVersions.H fails with those of the version before or after:$wrong" test "$(echo $wrong | wc -w)" = 14
    check "versions without OPENFOAM are refused in one sentence" test "$(g++ -E -Wfatal-errors "$header" 2>&1 > "$work/parse.log" \
        | grep -c 'error: .*v1912 or newer of openfoam.com')" = 1
    check "OPENFOAM stands in no other files than the book lists" test "$(cd "$checkout/openfoam" \
        && grep -rlw OPENFOAM --include='*.[CH]' --exclude-dir=lnInclude . | sort | tr '\n' ' ')" = \
        "./granularModels/granularModel/foamVersions.H ./granularThermo/refusals/refusals.C ./msddFoam/sha1Stream.C "
}

# Each file is parsed alone, so that none relies on another of its unit. A function of ours that hides one of OpenFOAM is often
# one that a newer version has changed; the build does not see it, since OpenFOAM's headers are system headers there.
files_alone() {
    local part said
    for part in granularModels functionObjects granularThermo msddFoam; do
        said=$(
            . "$checkout/scripts/foam-env" build
            cd "$checkout/openfoam/$part"
            find . -name '*.C' -not -name '*Unit.C' -not -path './lnInclude/*' | xargs -P "$(nproc)" -n 1 \
                g++ -fsyntax-only -std=c++17 -Wall -Wextra -Wno-unused-parameter -Woverloaded-virtual \
                -DOPENFOAM="$msdd_api" -DWM_DP -DWM_LABEL_SIZE="$WM_LABEL_SIZE" -DNoRepository \
                $(pkg-config --cflags PETSc mpi-cxx | sed 's/-I/-isystem/g') -IlnInclude -I. \
                $(sed '/LIBS/,$d' Make/options | grep -oE -- '-I[^ ]+' | sed "s@\$(LIB_SRC)@$WM_PROJECT_DIR/src@") \
                -I"$WM_PROJECT_DIR/src/OpenFOAM/lnInclude" -I"$WM_PROJECT_DIR/src/OSspecific/POSIX/lnInclude" 2>&1
        ) || true
        said=$(grep -E ': (fatal )?error: |: warning: |: note: +by ' <<< "$said" | grep -v '^/' || true) # ours have relative paths
        check "$part: no error, warning or hidden function in any file${said:+: $(sed -n 1p <<< "$said")}" test -z "$said"
    done
}

# An OpenFOAM that is sourced: folders with the few files that are read before anything is built
sourced_build() { # OPENFOAM in wmake's rules or nothing, library of its MPI; prints what Allwmake says, with its status
    local folder=$work/sourced
    rm -rf "$folder"
    mkdir -p "$folder"/{wmake/rules/General,src/OpenFOAM/lnInclude,lib/mpi}
    echo "${1:+WM_VERSION = OPENFOAM=$1}" > "$folder/wmake/rules/General/general"
    cp "$stubs"/*.H "$folder/src/OpenFOAM/lnInclude"
    echo 'int MPI_Init() { return 0; }' > "$folder/mpi.c"
    gcc -shared -fPIC -Wl,-soname,libmpi.so.1 -o "$folder/lib/libmpi.so.1" "$folder/mpi.c"
    gcc -shared -fPIC -Wl,--no-as-needed,-rpath,"$folder/lib" -o "$folder/lib/mpi/libPstream.so" "$folder/mpi.c" "$folder/lib/libmpi.so.1"
    (
        export MSDD_FOAM=sourced WM_PROJECT_DIR=$folder WM_PROJECT_VERSION=v$1 WM_OPTIONS=test FOAM_LIBBIN=$folder/lib FOAM_MPI=mpi
        "$checkout/openfoam/Allwmake" 2>&1
        echo "status $?"
    )
}
sourced() {
    local said
    said=$(sourced_build 2512 || true)
    check "Allwmake names a sourced version and says that it is untested" grep -q \
        "^Allwmake: OpenFOAM v2512 in $work/sourced, untested with this version\$" <<< "$said"
    check "and refuses its MPI, which is not PETSc's" grep -q "^Allwmake: OpenFOAM has the MPI $work/sourced/lib/libmpi.so.1 and PETSc" <<< "$said"
    said=$(sourced_build "" || true)
    check "Allwmake refuses a version of the OpenFOAM Foundation in one sentence" test \
        "$(grep -c 'error: ' <<< "$said") $(grep -c 'MSDD needs OpenFOAM v1912 or newer' <<< "$said")" = "1 2"
    said=$( (unset WM_PROJECT_DIR; MSDD_FOAM=sourced . "$checkout/scripts/foam-env") 2>&1 || true)
    check "refused: $said" grep -q "^foam-env: MSDD_FOAM is 'sourced', but this shell has no OpenFOAM" <<< "$said"
    said=$( (MSDD_FOAM=v2512 . "$checkout/scripts/foam-env") 2>&1 || true)
    check "refused: $said" test "$said" = "foam-env: MSDD_FOAM is 'v2512', allowed: sourced, or not set"
}
mkdir -p "$work"
header_of_versions
sourced
[ $full = no ] || files_alone
