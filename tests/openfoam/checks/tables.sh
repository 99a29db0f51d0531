# Tables of function objects: whatever was repeated or continued, the rows of the present run, in the order of time; postProcess; the
# columns of walls. And the order of the components of a tensor in files for ParaView.

tabled() { # folder: the case small with tables at every step, and fields at 0.5 and 1
    changed "$1"
    controls 'writeInterval 10; functions
    {
        #include "'"$here"'/audits"
        spaceProbes { type spaceProbes; libs ("libgranularFunctionObjects.so"); field T; probeLocations ((0.3 0.3 5)); }
        probes { type probes; libs ("libsampling.so"); fields (T); probeLocations ((0.3 0.3 5)); }
    }'
    mesh_is '12 6 1'
}
until_time() { # end time, processes: runs or goes on
    controls "endTime $1;"
    if [ "$2" = 1 ]; then logged msddFoam; else side_by_side "$2"; fi
}
rows() { for name in wallPressure spaceProbes probes heatAudit subRegions; do echo "$name"; msdd case table "${1:-.}" $name | grep -v '^#'; done; }
same_rows() { # folder of the undisturbed run, bound: largest difference of any number from those of this case
    paste -d ' ' <(rows "$1") <(rows) | awk -v bound="$2" 'NF % 2 || !NF { exit bad = 1 }
        NF > 2 { for (i = 1; i <= NF/2; i++) { e = $i - $(i + NF/2); if (e < 0) e = -e; s = $i < 0 ? -$i : $i; if (s > 1) e /= s
            if (!(e <= bound)) exit bad = 1 } n++ }
        END { exit bad || n < 80 }'
}
repeated_and_continued() { # processes, bound
    tabled "tables-whole-$1"
    [ "$1" = 1 ] || in_parts "$1 1"
    until_time 1 "$1"
    local whole=$PWD folder='.'
    [ "$1" = 1 ] || folder='processor*'
    check "tables on $1 processes: the first row is that of the start, the last that of the end" test \
        "$(msdd case table . wallPressure | awk '!/^#/ { if (n++ == 0) first = $1; last = $1 } END { print first, last, n }')" = '0 1 21'
    tabled "tables-$1"
    # Another run, which is over
    grains 'thermalExpansion 0;'
    [ "$1" = 1 ] || in_parts "$1 1"
    until_time 1 "$1"
    grains 'thermalExpansion 1e-3;'
    rm -rf $(eval echo $folder/{0.5,1})
    # Ends between two times that are written, as if killed there: at 0.7, and at 0.6 after a start at 0.5
    until_time 0.7 "$1"
    until_time 0.6 "$1"
    rm -rf $(eval echo "$folder/{0.6,0.7}")
    until_time 1 "$1"
    check "tables on $1 processes: a run repeated, and ended twice between two written times, has the rows of one that was not" \
        same_rows "$whole" "$2"
    check "tables on $1 processes: the list has both parts of the run" \
        test "$(sed -n 's/.*"start": \([^,]*\),.*/\1/p' postProcessing/msddFoam/tables.json | tr '\n' ' ')" = '0 0.5 '
}
post_processed() { # in the case of 'repeated_and_continued'
    local before
    before=$(rows)
    for option in '' -noZero '-time 0'; do
        check "postProcess $option ends well" bash -c "postProcess $option > log.postProcess 2>&1"
        [ "$option" = -noZero ] || check "postProcess $option: no row for the start, and the log says why" \
            grep -q 'wallPressure wallPressure: no row for the time 0, which has no field pressure' log.postProcess
    done
    check "postProcess changes no row of the run" test "$(rows)" = "$before"
    rm -r postProcessing
    logged postProcess
    check "postProcess makes the tables of a run that has none" test \
        "$(msdd case table . wallPressure | awk '!/^#/ { printf "%s ", $1 }')" = '0.5 1 '
}
older_run() { # of a version without the list, with one file of an older run
    tabled tables-older
    until_time 0.5 1
    cp postProcessing/wallPressure/0/wallPressure.dat expected
    rm -rf 0.5
    logged msddFoam
    rm postProcessing/msddFoam/tables.json
    check "without a list: the file that was changed last" \
        test "$(msdd case table . wallPressure | grep -v '^#')" = "$(grep -v '^#' postProcessing/wallPressure/0/wallPressure_0.dat)"
    until_time 1 1
    check "a run that continues one without a list makes none" test ! -e postProcessing/msddFoam/tables.json
    check "without a list: the parts of the run are joined" test "$(msdd case table . wallPressure | awk '!/^#/ { n++ } END { print n }')" = 21
}
walls_in_tables() { # a mesh of another program, such as gmsh, has walls of type patch
    changed tables-patches
    controls 'functions { #include "'"$here"'/audits" }'
    mesh_is '12 6 1'
    logged foamDictionary -entry entry0.right.type -set patch constant/polyMesh/boundary
    logged msddFoam
    check "wallPressure: columns of patches of type wall and patch, none of empty ones" \
        grep -q '^# Time.*left_normal.*right_pressure.*right_normal' postProcessing/wallPressure/0/wallPressure.dat
    check "wallPressure: no column of frontAndBack" bash -c '! grep -q frontAndBack_ postProcessing/wallPressure/0/wallPressure.dat'
    check "wallPressure: the head says what the columns are" grep -q '^# domain: pressure' postProcessing/wallPressure/0/wallPressure.dat
}
tensor_components() { # xx xy xz yy yz zz of OpenFOAM is xx yy zz xy yz xz in a file for ParaView
    changed tables-vtk
    mesh_is '2 1 1'
    sed 's/volScalarField/volSymmTensorField/; s/object .*/object known;/' 0/porosity > 0/known
    foamDictionary -entry internalField -set 'uniform (1 2 3 4 5 6)' 0/known > /dev/null
    foamDictionary -entry boundaryField -set '{ ".*" { type zeroGradient; } frontAndBack { type empty; } }' 0/known > /dev/null
    logged foamToVTK -ascii -time 0 -fields '(known)' -no-boundary
    check "foamToVTK: a symmetric tensor has the components xx yy zz xy yz xz" test \
        "$(sed -n '/<CellData/,/<\/CellData/{/known/{n;p;q}}' VTK/*/internal.vtu | xargs | cut -d ' ' -f 1-6)" = '1 4 6 2 5 3'
}
repeated_and_continued 1 1e-12
post_processed
repeated_and_continued 2 1e-8
older_run
walls_in_tables
tensor_components
