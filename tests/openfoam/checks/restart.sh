# A restart must continue from the newest complete time that was computed with the same settings on the same mesh. If files are
# missing or cut short, the time before is taken; if they were changed, the run is refused. What was written by another number of
# processes is said; nothing may be replaced silently.

halfway() { # folder: the case small, run to the time 0.5, which is written
    changed "$1"
    controls 'writeInterval 5; endTime 0.5;'
}
skipped() { # reason: the run must continue from 0.25 and print why
    msddFoam > log.bad 2>&1 && grep -qF "Time 0.5 is skipped: $1. It is renamed to 0.5.incomplete" log.bad \
        && grep -q '^Create mesh for time = 0.25' log.bad && [ -e 0.5.incomplete ] && [ -e 0.5/uniform/msddFoam ]
}
again() { rm -rf 0.5 0.5.incomplete; cp -r "$whole" 0.5; }
flip() { # file: flips one bit in its middle
    local at=$(($(stat -c %s "$1")/2)) byte
    byte=$(od -An -tu1 -j $at -N 1 "$1")
    printf "\\x$(printf %x $((byte ^ 1)))" | dd of="$1" bs=1 seek=$at conv=notrunc status=none
}

asks_for_consent() { # reason: the run must be refused with it and with the option that takes the time as it is
    refused "A run cannot continue from time 0.5 in \"$PWD\": $1. Allowed: msddFoam -accept files" && [ ! -e 0.5.incomplete ]
}

every_file() { # name of the check: removes each file of the time 0.5 in turn, then flips one bit in each
    local what=$1 whole=$PWD/0.5.whole file files lost=0 changed=0 unharmed
    logged msddFoam
    mv 0.5 "$whole"
    # Not checked: spread, which no restart reads, and the state of function objects, which OpenFOAM writes after the time
    files=($(cd "$whole" && find . -type f ! -name spread ! -name msddFoam ! -path '*/functionObjects/*' | sed 's,^\./,,'))
    for file in "${files[@]}"; do
        again
        rm "0.5/$file"
        skipped "missing: $file" && lost=$((lost + 1)) || echo "        lost unnoticed: $file" >&2
        again
        flip "0.5/$file"
        asks_for_consent "not as written: $file" && changed=$((changed + 1)) || echo "        changed unnoticed: $file" >&2
    done
    check "$what: the loss of each of ${#files[@]} files is said, the time before is taken: $lost" test $lost = ${#files[@]}
    check "$what: one flipped bit in each of ${#files[@]} files, refused: $changed" test $changed = ${#files[@]}
    again
    truncate -s -3000 0.5/T
    check "$what: a file without its end, the time before is taken" skipped 'without its end: T'
    again
    rm 0.5/uniform/msddFoam
    check "$what: no record, so the time is not whole" skipped 'uniform/msddFoam, which is written last, is missing'
    again
    flip 0.5/uniform/msddFoam
    check "$what: a flipped bit in the record" skipped 'uniform/msddFoam is damaged'
    again
    sed -i 5q 0.5/uniform/msddFoam
    check "$what: half a record" skipped 'uniform/msddFoam is incomplete'
    again
    unharmed=$(cd 0.5 && find . -type f -exec sha1sum {} + | sha1sum)
    rm -rf 0.5
    logged msddFoam
    check "$what: the time computed again has the same bytes" \
        test "$(cd 0.5 && find . -type f -exec sha1sum {} + | sha1sum)" = "$unharmed"
}

other_settings() { # a restart with another setting must be refused with both values, and accepted with -accept and its name
    local before=$PWD/constant/granularProperties.before key
    cp constant/granularProperties "$before"
    setting() { # name of the setting, both values, entry
        cp "$before" constant/granularProperties
        grains "$4"
        check "restart with another $1: refused with both values" \
            refused "Setting '$1' is $3, but time 0.5 in \"$PWD\" was computed with $2."
        logged foamDictionary -entry endTime -set 0.55 system/controlDict
        check "restart with another $1: accepted by name" \
            bash -c "msddFoam -accept '($1 ${5:-})' > log.bad 2>&1 && grep -q 'Accepted: $1 changes from' log.bad"
        rm -rf 0.55
    }
    setting thermalExpansion 0.001 0.002 'thermalExpansion 2e-3;'
    setting youngModulus 10000000 20000000 'youngModulus 2e7;'
    setting meanRadius 0.005 0.001 'meanRadius 1e-3;'
    setting mechanics none equilibrium 'mechanics equilibrium;' mechanicsCoeffs
    cp "$before" constant/granularProperties
    grains 'surrogate { model builtin:paper; }'
    check "restart with another model: refused" refused "Setting 'model' is network "
    cp "$before" constant/granularProperties
    logged foamDictionary -entry endTime -set 0.5 system/controlDict
}

edited() { # a time that was changed on purpose, and one of which no number was changed
    again
    logged foamDictionary -entry boundaryField.left.value -set 'uniform 60' 0.5/T
    check "a wall that was changed by hand: refused" asks_for_consent 'not as written: T'
    controls 'endTime 0.55; writeInterval 1;'
    logged msddFoam -accept files
    check "a wall that was changed by hand: accepted by name, the run goes on from it and says so at its end" bash -c \
        'grep -q "value *uniform 60" 0.55/T && sed -n "/Accuracy and warnings/,\$p" log | grep -q -- "- Accepted: time 0.5 as it is. not as written: T"'
    again
    rm -rf 0.55
    logged msddFoam
    mv 0.55 plain
    again
    find 0.5 -type f -exec gzip {} +
    logged msddFoam
    check "a time that was compressed: taken, same bytes at the end" bash -c 'diff -rq plain 0.55 && [ -e 0.5/T.gz ]'
    find 0.5 -type f -exec gunzip {} +
    rm -rf 0.55
    logged msddFoam
    check "and uncompressed again" diff -rq plain 0.55
    rm -rf 0.55 plain
    controls 'endTime 0.5; writeInterval 5;'
}

other_mesh() { # the mesh was changed after the time: refused with what differs; points that were only rounded are the same
    local points=constant/polyMesh/points
    changed other-mesh
    controls 'endTime 0.1; writeInterval 1;'
    mesh_is '12 6 1'
    logged msddFoam
    controls 'endTime 0.15;'
    rm -rf "$work/mesh-before"
    cp -r constant "$work/mesh-before"
    before() { rm -rf constant 0.15; cp -r "$work/mesh-before" constant; }
    on_other_mesh() { refused "is not that on which time 0.1 in \"$PWD\" was computed: $1"; }
    logged renumberMesh -overwrite
    check "restart over renumbered cells: refused" on_other_mesh 'its cells, faces or points have other numbers or places. Allowed: '
    in_parts '2 1'
    check "restart over renumbered cells on two processes: refused" bash -c \
        '! mpirun --oversubscribe -np 2 msddFoam -parallel > log.bad 2>&1 && grep -q "have other numbers or places" log.bad'
    rm -rf processor*
    before
    logged transformPoints -scale '(2 1 1)'
    check "restart on a wider mesh: refused" on_other_mesh 'it reaches from (0 0 '
    check "restart on a wider mesh: accepted by name" bash -c 'msddFoam -accept mesh > log.bad 2>&1 && grep -q -- "- Accepted: another mesh" log.bad'
    before
    sed -i 's/(12 6 1)/(6 12 1)/' system/blockMeshDict
    logged blockMesh
    check "restart on another mesh with as many cells: refused" on_other_mesh 'its cells, faces or points'
    before
    sed -i 's/(6 12 1)/(6 6 1)/' system/blockMeshDict
    logged blockMesh
    check "restart on another number of cells: refused" on_other_mesh 'it has 36 cells, the other 72. Allowed: '
    check "and not accepted by name" bash -c '! msddFoam -accept mesh > log.bad 2>&1 && grep -q "it has 36 cells, the other 72" log.bad'
    before
    # Six digits, as foamFormatConvert may leave them
    awk '/^\(-?[0-9.e+-]+ / { gsub(/[()]/, ""); printf "(%.6g %.6g %.6g)\n", $1, $2, $3; next } { print }' $points > points.new
    mv points.new $points
    check "restart on a mesh with points that were rounded to six digits: the same" bash -c 'msddFoam > log.bad 2>&1'
    before
}

moved_fields() { # mapFields takes no fields at points: a bed that has moved begins anew from its stress, and says so
    local source e
    changed moved-from
    grains 'mechanics equilibrium; equilibriumCoeffs { residual 1e-2; }'
    mesh_is '12 6 1'
    controls 'writeInterval 10; endTime 0.5;'
    logged msddFoam
    source=$PWD
    rm -rf "$work/moved-to"
    cp -r . "$work/moved-to"
    cd "$work/moved-to"
    rm -rf [1-9]* 0.[0-9]*
    controls 'writeInterval 1; endTime 0.05; startFrom latestTime;'
    logged mapFields "$source" -sourceTime 0.5 -consistent
    logged msddFoam
    check "fields of a bed that has moved, without its displacement: said in the log and at the end" \
        test "$(grep -c 'The fields of time 0 belong to grains that have moved (areaRatio ' log)" = 2
    (cd "$source" && controls 'writeInterval 1; endTime 0.55;' && logged msddFoam)
    e=$(paste <(field "$source/0.55/pressure") <(field 0.05/pressure) | awk '{ e = $1 - $2; e = e < 0 ? -e : e; d = e > d ? e : d; m = $1 > m ? $1 : m } END { print (NR > 9 ? d/m : "nan") }')
    check "the pressure is that of the run that goes on, within $e <= 0.02" below "$e" 0.02
    e=$(paste -d ' ' <(field "$source/0.55/D") <(field "$source/0.5/D") <(field 0.05/D) | awk '{ d = 0; m = 0
        for (k = 1; k <= 3; k++) { a = $k - $(3 + k); m += a*a; d += (a - $(6 + k))^2 }; if (m > most) most = m; if (d > worst) worst = d }
        END { print (NR == 72 ? sqrt(worst/most) : "nan") }')
    check "and grains move as in that run: the displacement in the step differs by $e <= 0.1 of the largest" below "$e" 0.1
    e=$(sed -n 's/.*"relative_difference": \([^}]*\)}.*/\1/p' postProcessing/msddFoam/summary.json)
    check "heat received and held differ by $e <= 1e-6" below "$e" 1e-6
    rm -rf 0.05
    rm 0/initialTemperature
    check "a part of what a run wrote: refused" refused 'has the field thermalStrainIncrement and only one of initialTemperature and bulkDensity'
}

packed_at() { # folder, initialTemperature (field, key or none), entries: a bed at 90 K that was packed at 50 K
    changed "$1"
    sed -i 's/uniform [0-9]*/uniform 90/' 0/T
    mesh_is '2 1 1'
    controls 'endTime 0.05;'
    [ "$2" = key ] && grains 'initialTemperature 50;' || [ "$2" = none ] \
        || sed 's/object .*/object initialTemperature;/; s/uniform 90/uniform 50/' 0/T > 0/initialTemperature
    grains "${3:-}"
}
mean_of() { # field of the time 0.05, and its folder
    field "${2:-$work/warmed-field/0.05}/$1" | awk '{ s += $1; n++ } END { printf "%.6g", s/n }'
}
warmed() { # the grains grow from initialTemperature to T: as in a run that heats the bed from there, with the same increments
    local name p
    packed_at warmed-field field
    logged msddFoam
    p=$(mean_of pressure)
    check "the log says that the bed was brought from its initialTemperature to T" \
        grep -q 'brought to T, 90 to 90 K, by a thermal strain of up to 0.04 in 40 parts' log
    packed_at warmed-slowly none
    sed -i 's/uniform 90/uniform 50/; s/fixedValue/zeroGradient/' 0/T
    # 1 K in each step; the state follows one step later
    cat > constant/fvOptions <<-END
	FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }
	heat { type scalarSemiImplicitSource; selectionMode all; volumeMode specific;
	    injectionRateSuSp { T ($(field "$work/warmed-field/0.05/bulkDensity" | awk 'NR == 1 { printf "%.17g", 20*$1 }') 0); } }
	END
    controls 'endTime 2.05; writeInterval 41;'
    logged msddFoam
    for name in pressure porosity conductivity; do
        check "a bed packed at 50 K begins at 90 K: $name $(mean_of $name) as of one that is heated, $(mean_of $name "$PWD/2.05")" \
            test "$(field "$work/warmed-field/0.05/$name" | head -n 1 | awk '{ printf "%.9g", $1 }')" = "$(field 2.05/$name | head -n 1 | awk '{ printf "%.9g", $1 }')"
    done
    packed_at warmed-key key
    logged msddFoam
    check "the same by a key" test "$(mean_of pressure 0.05)" = "$p"
    controls 'endTime 0.1;'
    logged msddFoam
    check "a restart does not warm it again" test "$(field 0.1/pressure)" = "$(field 0.05/pressure)"
    packed_at warmed-moving key 'mechanics equilibrium;'
    logged msddFoam
    check "grains that may move, heated alike: $(mean_of pressure 0.05) Pa, with none that move $p" is_within "$(awk "BEGIN { print $(mean_of pressure 0.05)/$p }")" 0.98 1.02
    packed_at warmed-twice field 'initialTemperature 50;'
    check "field and key: refused" refused "Entry 'initialTemperature' is given together with the field of this name"
}

named_start() { # restarts with startTime instead of latestTime
    controls 'startFrom startTime; startTime 0.5;'
    rm 0.5/porosity
    check "startTime of a time that is not whole: refused" \
        refused "Time 0.5 in \"$PWD\", the startTime of controlDict, is not complete: missing: porosity"
    controls 'startFrom latestTime;'
}

older_version() { # a record of version 0.1, without a list of files
    again
    sed -i '/^files/,$d; /^program/d' 0.5/uniform/msddFoam
    check "record of a version that kept no list: refused" refused 'it was written by a version that kept no list of files'
    logged foamDictionary -entry endTime -set 0.55 system/controlDict
    check "record of a version that kept no list: accepted by name" bash -c 'msddFoam -accept files > log.bad 2>&1 && [ -e 0.55/T ] || [ -e 0.5/T ]'
    logged foamDictionary -entry endTime -set 0.5 system/controlDict
}

nothing_whole() {
    rm -rf 0 0.25 0.5
    mkdir 0.5
    check "no time that is whole: refused" refused 'No time in'
}

full_disk() { # all files end after 2 KiB, as on a full disk; the next run has no such limit
    local e
    changed full
    controls 'writeInterval 5; endTime 0.5;'
    mesh_is '12 6 1'
    (trap '' XFSZ; ulimit -f 2; ! msddFoam 2>&1) | cat > log.full
    check "full disk: the run ends with an error" grep -q 'Is the disk full' log.full
    logged msddFoam
    e=$(difference "$work/restart-none/0.5.whole" 0.5)
    check "full disk: once there is room the run starts anew and ends as it should: difference $e" test "$e" = 0
}

blocked() { # a file stands where the folder of summary.json must be
    changed blocked
    controls 'writeInterval 5; endTime 0.5;'
    mesh_is '12 6 1'
    mkdir -p postProcessing
    touch postProcessing/msddFoam
    check "a file that cannot be written is named with the reason" refused 'msddFoam/tables.json": Not a directory'
}

read_only() { # a folder in which nothing can be made is refused before the first step
    local without=()
    changed read-only
    mesh_is '12 6 1'
    in_parts '2 1'
    # Who may write everywhere gives that up
    [ "$(id -u)" != 0 ] || without=(setpriv --bounding-set=-dac_override)
    unwritable() { # folder, program and arguments: they must fail with the folder's name before the first step
        local folder=$1 log=$work/read-only.log
        chmod a-w "$folder"
        ! "${without[@]}" "${@:2}" > "$log" 2>&1
        chmod u+w "$folder"
        grep -qF "Folder \"$folder\" cannot be written: Permission denied" "$log" && ! grep -q '^Time = ' "$log"
    }
    check "a case folder that cannot be written is refused at the start" unwritable "$PWD" msddFoam
    check "a folder of one of two processes, too" unwritable "$PWD/processor1" mpirun --oversubscribe -np 2 msddFoam -parallel
}

other_processes() { # shape: on 1, 3, 1 and 2 x 2 processes in turn, compared with 1 throughout; the sums of heat must be kept
    local e way end=0.5
    changed "moved-on-$1-whole"
    controls "writeInterval 2; functions { #include \"$here/audits\" }"
    box "$1" '12 6'
    rm -rf "$work/moved-on-$1"
    cp -r . "$work/moved-on-$1"
    logged msddFoam
    cd "$work/moved-on-$1"
    for way in '1 1' '3 1' '1 1' '2 2'; do
        controls "endTime $end;"
        if [ "$way" = '1 1' ]; then
            logged msddFoam
        else
            in_parts "$way"
            side_by_side $((${way% *}*${way#* }))
            logged reconstructPar -latestTime
        fi
        end=$(awk "BEGIN { print $end + ($end < 0.65 ? 0.1 : 0.3) }")
    done
    check "$1: restarts on other numbers of processes say so" \
        test "$(grep -c 'was written by another number of processes' log)" = 3
    e=$(difference "$work/moved-on-$1-whole/1" 1)
    check "$1: restarts on 1, 3, 1 and 4 processes: difference $e <= 1e-10" below "$e" 1e-10
    for way in heatAudit massAudit; do
        e=$(lines_differ "$work/moved-on-$1-whole/postProcessing/$way/0/$way.dat" postProcessing/$way/0.7/$way.dat)
        check "$1: restarts on 1, 3, 1 and 4 processes: last line of $way differs by $e <= 1e-9" below "$e" 1e-9
    done
}

binary_and_compressed() { # restarts with these formats must give the same bytes, too
    local format
    for format in 'writeFormat binary;' 'writeCompression on;'; do
        changed formats
        controls "$format writeInterval 10;"
        mesh_is '12 6 1'
        logged msddFoam
        mv 1 whole
        logged msddFoam
        check "restart with $format has the same bytes" diff -rq whole 1
        rm -rf 1
        flip "$(ls 0.5/T 0.5/T.gz 2> /dev/null)"
        check "flipped bit with $format: found" bash -c 'msddFoam > log.bad 2>&1; grep -q "time 0.5 .*: not as written: T\|Time 0.5 is skipped: without its end: T" log.bad'
    done
}

one_solver() { # a second solver in a folder is refused while the first runs, also if that was started in parallel; a killed one keeps none out
    local processes first second
    for processes in 1 2; do
        changed "one-solver-$processes"
        controls 'endTime 1e6; writeInterval 1000000000;'
        mesh_is '12 6 1'
        in_parts '2 1'
        if [ $processes = 1 ]; then
            msddFoam > log.first 2>&1 &
        else
            mpirun --oversubscribe -np 2 msddFoam -parallel > log.first 2>&1 &
        fi
        first=$!
        while ! grep -q '^Time = ' log.first && kill -0 $first; do sleep 0.1; done
        second=$(sed 's/ .*//' <<< "$(cut -d ' ' -f 2 msddFoam.lock)")
        check "a second solver in the folder of one on $processes processes is refused" \
            refused "msddFoam.lock\" is locked by process $second on $(hostname)"
        check "it says at once what it waits for" grep -q "^Waiting up to 5 s for process $second on $(hostname), which computes this case" log.bad
        kill -9 "$second" # of several processes, the others end with it
        wait $first 2> /dev/null || true
        check "the lock file of a killed solver on $processes processes stays" test -e msddFoam.lock
        controls 'endTime 0.05; writeInterval 1;'
        logged msddFoam
        check "it keeps no other solver out, and that one removes it" test ! -e msddFoam.lock
    done
    changed one-solver-error
    mesh_is '12 6 1'
    grains 'unknown 1;'
    check "refused input leaves no lock file" bash -c '! msddFoam > log.bad 2>&1 && test ! -e msddFoam.lock'
}

wedge() { # in a wedge, too, a restart must give the same bytes: motion along the radius is rounded when it is written
    local steps
    for steps in fixed adaptive; do
        spheres_bed "wedge-$steps" 'walls { "inner|outer" { type frictionless; } }'
        wedge_mesh 4
        sed -i '/"\.\*"/i inner { type fixedValue; value uniform 400; }' 0/T
        controls 'endTime 800000; deltaT 80000; writeInterval 5;'
        [ $steps = fixed ] || {
            scheme 'timeScheme secondOrder; temperatureTolerance 1;'
            controls 'adjustTimeStep yes; deltaT 8000; writeControl runTime; writeInterval 400000;'
        }
        logged msddFoam
        mv 800000 whole
        logged msddFoam
        check "restart in a wedge, $steps steps, has the same bytes" diff -rq whole 800000
    done
}

mapped() { # goes on from fields that OpenFOAM's mapFields took to finer cells: heat counts from there, also after a restart
    local source e
    halfway mapped-from
    mesh_is '12 6 1'
    logged msddFoam
    source=$PWD
    changed mapped
    controls "startFrom latestTime; endTime 0.05; writeInterval 1; functions { #include \"$here/audits\" }"
    mesh_is '24 12 1'
    logged mapFields "$source" -sourceTime 0.5 -consistent
    logged msddFoam
    controls 'endTime 0.1;'
    logged msddFoam
    for e in 0 0.05; do
        e=$(tail -n 1 postProcessing/heatAudit/$e/heatAudit.dat | awk '{ print $NF }')
        check "fields mapped to finer cells: heat received and held differ by $e <= 1e-6" below "$e" 1e-6
    done
    check "fields mapped to finer cells: no warning about the heat" bash -c '! grep -q "heat is lost" log'
}

halfway restart-none
mesh_is '12 6 1'
every_file "grains that stay"
whole=$PWD/0.5.whole
again
other_settings
again
edited
again
named_start
older_version
nothing_whole

halfway restart-equilibrium
grains 'mechanics equilibrium; equilibriumCoeffs { residual 1e-2; }'
mesh_is '12 6 1'
every_file "equilibrium"

halfway restart-online
grains "surrogate { type onlineRve; onlineRveCoeffs { discs 60; rvePer history; } smallestStrain 0; }"
mesh_is '4 2 1'
every_file "online RVEs"

full_disk
blocked
read_only
one_solver
other_mesh
wedge
mapped
moved_fields
warmed
for shape in $shapes; do other_processes "$shape"; done
binary_and_compressed
