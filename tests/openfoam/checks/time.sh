# The second-order scheme with adaptive steps: restart bit for bit, two processes, write times, effect of the tolerance.

adaptive() { # folder, tolerance: the case small with adaptive steps, meshed
    changed "$1"
    controls 'adjustTimeStep yes; deltaT 1e-3; writeControl runTime; writeInterval 0.5;'
    scheme "timeScheme secondOrder; temperatureTolerance $2; stateTolerance 1;"
    mesh_is '12 6 1'
}
same_bits() { # compares two time folders
    local name
    for name in T porosity fabricIndex elasticCompression elasticShear2 conductivity stress thermalStrain; do
        [ -e "$1/$name" ] && cmp -s <(field "$1/$name") <(field "$2/$name") || { echo "        $name differs" >&2; return 1; }
    done
}

adaptive_restart() {
    adaptive whole 0.1
    logged msddFoam
    check "adaptive: ends on the written times" test -e 0.5/T -a -e 1/T
    check "adaptive: a smaller first step than a tolerance asks for is not kept" \
        test "$(grep -c '^Time' log)" -lt 200
    cp -r . "$work/halves"
    cd "$work/halves"
    rm -rf 1 0.5/../1
    logged msddFoam
    check "adaptive: restart bit for bit" same_bits "$work/whole/1" 1
    cp -r "$work/whole" "$work/two"
    cd "$work/two"
    rm -rf 0.5 1
    logged decomposePar
    logged mpirun --oversubscribe -np 2 msddFoam -parallel
    logged reconstructPar -latestTime
    local e
    e=$(difference "$work/whole/1" 1)
    check "adaptive: two processes: difference $e <= 1e-9" below "$e" 1e-9
}

write_times() { # steps that are repeated, because a wall jumps, must not make the run write before a write time, and miss that
    local tolerance late
    for tolerance in 0.3 0.1 0.03 0.01; do
        adaptive "jumps-$tolerance" $tolerance
        controls 'writeInterval 0.05;'
        sed -i '0,/fixedValue;/s//uniformFixedValue; uniformValue table ((0 50) (0.12 50) (0.1201 90) (0.37 90) (0.3701 50) (0.62 50) (0.6201 90) (0.87 90) (0.8701 50));/' 0/T
        logged msddFoam
        late+=" $(ls -d [01]* | awk '{ d = 20*$1 - int(20*$1 + 0.5); if (d*d > 1e-12) print }' | tr '\n' ' ')"
        [ "$(ls -d [01]* | wc -l)" = 21 ] || late+=" $(ls -d [01]* | wc -l) of 21 times"
    done
    check "adaptive: all write times are met, none but these:$late" test -z "${late// /}"
}

function_times() { # function objects may ask for times, too; a write time just after one of them is met as before
    local late interval
    for interval in 0.25 0.51; do
        adaptive "functions-$interval" 0.1
        controls "writeInterval $interval; functions
{
    p { type probes; libs (\"libsampling.so\"); fields (T); probeLocations ((0.01 0.01 0.005)); writeControl adjustableRunTime; writeInterval 0.0625; }
    off { \$p; enabled no; writeInterval 0.003; }
}"
        logged msddFoam
    done
    check "adaptive: a function object that is off asks for no times" test "$(grep -c '^Time' log)" -lt 100
    check "adaptive: write times just after those of a function object are met" test -e 0.51/T -a ! -e 0.5
    late=$(awk '!/^#/ { d = $1/0.0625 - int($1/0.0625 + 0.5); n++; if (d*d > 1e-16) print $1 } END { if (n != 16) print n " of 16 times" }' \
        ../functions-0.25/postProcessing/p/0/T | tr '\n' ' ')
    check "adaptive: all times of a function object are met, none but these: $late" test -z "${late// /}" -a -e ../functions-0.25/0.75/T
}

last_step() { # the sum of these steps is below the end by a rounding error, which must not become a step of its own
    adaptive rounded 0.1
    controls 'endTime 0.11; writeInterval 0.0055;'
    logged msddFoam
    check "adaptive: ends where the sum of its steps is rounded" test -e 0.11/T -a "$(grep -c '^Time = 0.11$' log)" = 1
}

# OpenFOAM sets no end of such a run, and the least step is not a share of it
stopped_now() {
    adaptive stopped 0.1
    controls 'stopAt nextWrite; writeInterval 0.1; minDeltaT 1e-9;'
    logged msddFoam
    check "adaptive: stopAt nextWrite ends at the first write time, after small steps" \
        test -e 0.1/T -a "$(grep -c '^Time' log)" -gt 3
}

# A hundredth of the tolerance must give less than a ninth of the error, a third for each tenth. Tolerances of 3 and 1 give the same
# steps, since these may grow only so much from one to the next, and where grains begin to slide the error falls with the first
# power of the step.
tolerance_counts() {
    local tolerance e
    adaptive fine 0.001
    logged msddFoam
    for tolerance in 10 0.1; do
        adaptive "tolerance-$tolerance" $tolerance
        logged msddFoam
        e=$(difference "$work/fine/1" 1)
        [ $tolerance = 0.1 ] || { coarse=$e; continue; }
        check "adaptive: error falls with the tolerance: $coarse, $e" \
            awk "BEGIN { exit !($e < 0.11*$coarse && $e > 0) }"
    done
}

default_tolerance() { # it is a share of the range of T: with T/100 and 100 times the expansion the steps must be the same
    local scale e
    for scale in 1 100; do
        changed "range-$scale"
        controls 'adjustTimeStep yes; deltaT 1e-3; writeControl runTime; writeInterval 1;'
        scheme 'timeScheme secondOrder;'
        [ $scale = 1 ] || {
            sed -i 's/uniform 50;/uniform 0.5;/; s/uniform 100;/uniform 1;/; s/uniform 70;/uniform 0.7;/' 0/T
            grains 'thermalExpansion 0.1;'
        }
        mesh_is '12 6 1'
        logged msddFoam
    done
    e=$(paste -d ' ' <(field ../range-1/1/T) <(field 1/T) | awk '{ e = $1 - 100*$2; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR == 72 ? w + 0 : "nan") }')
    check "adaptive, default tolerance: $(grep -c '^Time' log) steps, T of a hundredth of the range differs by $e <= 1e-9 K" below "$e" 1e-9
    check "adaptive, default tolerance: as many steps" test "$(grep -c '^Time' log)" = "$(grep -c '^Time' ../range-1/log)"
}

fixed_restart() {
    changed second
    scheme 'timeScheme secondOrder;'
    mesh_is '12 6 1'
    logged msddFoam
    cp -r . "$work/second-half"
    cd "$work/second-half"
    rm -rf 1 0.[6-9]* 0.5[1-9]*
    logged msddFoam
    check "second order: restart bit for bit" same_bits "$work/second/1" 1
}

changed rejected # the first step is far too large and must be rejected
controls 'adjustTimeStep yes; deltaT 1; writeControl runTime; writeInterval 1;'
scheme 'timeScheme secondOrder; temperatureTolerance 0.1;'
mesh_is '12 6 1'
logged msddFoam
check "adaptive: a step too large is repeated" \
    test "$(sed -n 's/.*"rejected_steps": \([0-9]*\).*/\1/p' postProcessing/msddFoam/summary.json)" -gt 0

rm -rf "$work"/{halves,two,second-half}
adaptive_restart
write_times
function_times
last_step
stopped_now
tolerance_counts
fixed_restart
default_tolerance
