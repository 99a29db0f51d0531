# The model onlineRve with boxes shared by cells of the same strain history (rvePer history), compared with a box for every
# cell; both also on two processes.

counted() { sed -n "s/.*\"$1\": \([0-9.e+-]*\).*/\1/p" postProcessing/msddFoam/summary.json | head -n 1; }

boxed() { # folder, keys of the boxes, further keys: 18 cells, two packings, 20 steps; hot, warm and cold walls
    changed "$1"
    grains "surrogate { type onlineRve; onlineRveCoeffs { discs 60; $2 } ${3:-smallestStrain 0;} }"
    mesh_is '6 3 1'
    two_porosities 0.125 0.135
}
two_porosities() { # left, right: of the columns of cells
    {
        sed '/^#include/d' 0/porosity
        echo 'dimensions [0 0 0 0 0 0 0]; internalField nonuniform List<scalar>'
        echo '18 ('
        for _ in 1 2 3; do printf '%s\n' "$1" "$1" "$1" "$2" "$2" "$2"; done
        echo '); boundaryField { #includeEtc "caseDicts/setConstraintTypes"'
        echo '".*" { type zeroGradient; } }'
    } > porosity.new
    mv porosity.new 0/porosity
}
apart() { # field, two time folders: largest difference of the first component, relative to its largest value
    paste <(field "$2/$1" | awk '{ print $1 }') <(field "$3/$1" | awk '{ print $1 }') | awk '
        { e = $1 - $2; if (e < 0) e = -e; if (!(e <= w)) w = e; a = $1 < 0 ? -$1 : $1; if (a > s) s = a; n++ }
        END { print (n > 1 && s > 0 ? w/s : "nan") }'
}
history() { echo "rvePer history; strainTolerance $1;"; }

dial() { # the results must approach those of a box for every cell as strainTolerance falls
    local tolerance name error=() strained
    boxed own ''
    logged msddFoam
    check "a box a cell: $(counted boxes_strained) strained" test "$(counted boxes_strained)" -gt 200
    for tolerance in 2e-2 5e-3 1e-3; do
        boxed "shared-$tolerance" "$(history $tolerance)"
        logged msddFoam
        strained=$(counted boxes_strained)
        error+=("$(apart stress "$work/own/1" 1)")
        check "tolerance $tolerance: $strained boxes strained, fewer than a fifth of the cells x steps" \
            test "$strained" -gt 2 -a "$strained" -lt 72
        name=$(apart T "$work/own/1" 1)
    done
    check "stress apart falls with the tolerance: ${error[*]}" \
        awk "BEGIN { exit !(${error[1]} < 0.5*${error[0]} && ${error[2]} < 0.5*${error[1]} && ${error[2]} < 0.02) }"
    check "tolerance 1e-3: T apart $name <= 2e-4" below "$name" 2e-4
}

cycled() { # folder, keys: all walls are cooled by 60 K and heated again
    changed "$1"
    grains "thermalExpansion 1e-3; surrogate { type onlineRve; smallestStrain 0; onlineRveCoeffs { discs 60; compression horizontal; $2 } }"
    sed -i '/^boundaryField/,$d; s/uniform 50/uniform 110/' 0/T
    echo 'boundaryField { ".*" { type uniformFixedValue; uniformValue table ((0 110) (2 50) (4 110) (99 110)); }
        frontAndBack { type empty; } }' >> 0/T
    controls 'endTime 24; deltaT 0.2;'
    mesh_is '4 3 1'
}
reversal() { # grains that were unloaded and loaded again differ from those of the start, although T is the same
    local start back after e
    cycled cycle-own ''
    logged msddFoam
    back=$(field 24/pressure | head -n 1)
    cycled cycle-shared "$(history 1e-3)"
    logged msddFoam
    start=$(field 0.2/pressure | head -n 1)
    e=$(field 24/T | awk '{ e = $1 - 110; if (e < 0) e = -e; if (e > w) w = e } END { print w }')
    check "cycle: T is back to $e <= 0.5 K" below "$e" 0.5
    after=$(field 24/pressure | head -n 1)
    check "cycle: pressure $start at the start, $after afterwards, a box a cell $back" \
        awk "BEGIN { exit !(($after - $back)^2 < (0.25*($back - $start))^2 && ($back/$start - 1)^2 > 0.005^2) }"
    check "cycle: boxes dropped: held $(counted boxes_held), made $(counted boxes_strained)" \
        test "$(counted boxes_held)" -lt "$(counted boxes_strained)"
}

halved() { # folder: a restart from the middle must give the same fields and boxes bit for bit
    local name same=yes
    rm -rf "$work/$1-half"
    cp -r "$work/$1" "$work/$1-half"
    cd "$work/$1-half"
    rm -rf 1
    logged msddFoam
    for name in T porosity conductivity stress; do
        cmp -s "$work/$1/1/$name" "1/$name" || same="no, $name differs"
    done
    cmp -s "$work/$1/1/onlineRve.json" 1/onlineRve.json || same="no, boxes differ"
    check "$1: restart bit for bit: $same" test "$same" = yes
}
restarts() {
    boxed halves "$(history 2e-3)"
    controls 'writeInterval 10;'
    logged msddFoam
    halved halves
    sed -i 's/strainTolerance 2e-3/strainTolerance 1e-3/' constant/granularProperties
    check "refused: another tolerance in a restart" refused "Setting 'modelCoeffs' is "
    check "accepted, but the boxes are of another tolerance: refused" \
        bash -c "! msddFoam -accept modelCoeffs > log.bad 2>&1 && grep -qF 'strain_tolerance\\\": 0.002' log.bad"
    rm -rf 1 0.5/onlineRve.json
    sed -i 's/strainTolerance 1e-3/strainTolerance 2e-3/' constant/granularProperties
    logged msddFoam
    check "a restart without its boxes goes back to the start" grep -q 'Time 0.5 is skipped: missing: onlineRve.json' log

    boxed halves-second "$(history 2e-3)"
    scheme 'timeScheme secondOrder; temperatureTolerance 2;'
    controls 'adjustTimeStep yes; deltaT 0.01; writeControl runTime; writeInterval 0.5;'
    logged msddFoam
    halved halves-second
    # The difference from the run with fixed steps is the error of the paper's scheme in time, not that of sharing boxes
    local e
    e=$(apart T "$work/halves/1" 1)
    check "adaptive, second order: T apart from fixed steps $e <= 0.03" below "$e" 0.03
    e=$(counted boxes_strained)
    check "adaptive, second order: questions ahead make no box twice: $e strained" test "$e" -lt 72
}

processes() { # two processes must give the serial result, also with a restart from the processes' folders
    local kind e
    for kind in own shared; do
        boxed "serial-$kind" "$([ $kind = own ] || history 2e-3)"
        logged msddFoam
        boxed "two-$kind" "$([ $kind = own ] || history 2e-3)"
        controls 'writeInterval 10;'
        logged decomposePar
        logged mpirun --oversubscribe -np 2 msddFoam -parallel
        logged reconstructPar -latestTime
        e=$(difference "$work/serial-$kind/1" 1)
        check "$kind boxes, two processes: difference $e <= 1e-9" below "$e" 1e-9
        cp -r processor0/1 whole
        rm -rf 1 processor?/1
        logged mpirun --oversubscribe -np 2 msddFoam -parallel
        check "$kind boxes, two processes: restart bit for bit" cmp -s whole/onlineRve.json processor0/1/onlineRve.json
    done
    rm -rf 1
    logged reconstructPar -latestTime
    controls 'endTime 1.5;'
    check "refused: a serial run that goes on from two processes" refused 'missing: onlineRve.json'
}

reordered() { # the block of the mesh rotated by 180 degrees, so that the order of the cells is reversed
    local name e
    boxed turned "$(history 2e-3)"
    sed -i 's/hex (0 1 2 3 4 5 6 7)/hex (2 3 0 1 6 7 4 5)/' system/blockMeshDict
    logged blockMesh
    two_porosities 0.135 0.125
    logged msddFoam
    for name in T conductivity stress; do
        e=$(paste -d ' ' <(field "$work/serial-shared/1/$name" | awk '{ print $1 }') <(field "1/$name" | awk '{ print $1 }' | tac) |
            awk '{ e = $1/$2 - 1; if (e < 0) e = -e; if (!(e <= w)) w = e; n++ } END { print (n == 18 ? w + 0 : "nan") }')
        check "cells in reverse order: $name differs by $e <= 1e-9" below "$e" 1e-9
    done
}

dial
reversal
restarts
processes
reordered
