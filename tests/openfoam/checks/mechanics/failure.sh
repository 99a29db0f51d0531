# Steps that do not converge, loss of contacts, and heat balances with moving grains. Sourced by mechanics.sh.

jump() { # folder, shape of the cells: the right wall of the box of small closes by 0.48 m, a strain of 0.22, in one step of 0.05 s
    changed "$1"
    uniform_temperature
    box "$2" '12 6'
    cell_geometry
    grains "$(sed -n '/^surrogate/,/^}/p' "$checkout/cases/common/granularProperties" | sed 's/maxFraction.*/maxFraction 1; elasticCompression { above clamp; }/; s/below error/below clamp/')"
    equilibrium "residual 1e-3; walls { \".*\" { type frictionless; } right { type frictionless; displacement table ((0 (0 0 0)) (0.05 (-0.48 0 0))); } }"
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
}
summary_of() { sed -n "s/.*\"$1\": \([0-9.e+-]*\)[,}].*/\1/p" postProcessing/msddFoam/summary.json; }
displacement_is_linear() { # what
    local e
    e=$(paste -d ' ' <(field 0.05/D) <(field 0/C) | awk -v cells=$cells '{ e = $1/(-0.48*$4/2.15) - 1; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR == cells ? w + 0 : "nan") }')
    check "$1: displacement is linear to $e <= 1e-6" below "$e" 1e-6
}

parts() { # shape
    jump "parts-$1" "$1"
    logged msddFoam
    check "$1: a step too large is taken in parts" grep -q 'the load of the step is applied in 2 parts' log
    check "$1, parts: the run gets through" test "$(summary_of cut_steps)" = 1 -a "$(summary_of unconverged_steps)" = 0
    displacement_is_linear "$1, parts"
    local e
    e=$(field 0.05/areaRatio | awk -v cells=$cells '{ e = $1/(1 - 0.48/2.15) - 1; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR == cells ? w + 0 : "nan") }')
    check "$1, parts: area of the cells follows to $e <= 1e-6" below "$e" 1e-6
    e=$(paste -d ' ' <(field 0.05/areaRatio) <(field 0.05/particleDensity) <(field 0.05/porosity) <(field 0.05/bulkDensity | awk '{ for (i = 0; i < '$cells'; i++) print }') \
        | awk -v cells=$cells '{ e = $2*$1*(1 - $3)/$4 - 1; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR == cells ? w + 0 : "nan") }')
    check "$1: particleDensity = bulkDensity/areaRatio/(1 - porosity) to $e <= 1e-12" below "$e" 1e-12
}

halved() { # shape: the same with adaptive steps: the step must be repeated until the motion of the wall in it is small enough
    jump "halved-$1" "$1"
    controls 'adjustTimeStep yes; deltaT 0.05; writeControl runTime; writeInterval 0.05; writePrecision 17;'
    scheme 'timeScheme secondOrder;'
    logged msddFoam
    check "$1, adaptive: a step whose stress finds no equilibrium is repeated" \
        test "$(summary_of rejected_steps)" -gt 0 -a "$(summary_of cut_steps)" = 0 -a "$(summary_of steps)" -gt 1 -a "$(summary_of steps)" -lt 100
    displacement_is_linear "$1, adaptive"
}

hopeless() { # shape: a single iteration is allowed for a residual that needs several: the run must end with a message
    both_ways "hopeless-$1"
    equilibrium 'residual 1e-6; maxResidual 1e-6; maxIterations 1;'
    box "$1" '12 6'
    local processes
    for processes in 1 2; do
        if [ $processes = 1 ]; then
            ! msddFoam > log.bad 2>&1 || echo "no failure" > log.bad
        else
            rm -rf 0.* processor*
            logged decomposePar
            ! mpirun --oversubscribe -np 2 msddFoam -parallel > log.bad 2>&1 || echo "no failure" > log.bad
        fi
        check "$1, $processes: no equilibrium: cell, centre, residual and state are said" \
            grep -qE 'not found in 64 parts of 1 iterations: [0-9.e-]+ Pa are out of balance at cell [0-9]+ at \([-0-9. e]+\), whose state is: porosity [0-9.]+, fabricIndex .*stress' <(tr -s ' \n' ' ' < log.bad)
        check "$1, $processes: no equilibrium: the fields are written" test -n "$(find . -path '*0.*/stress' | head -1)"
    done
    jump "torn-$1" "$1"
    sed -i 's/-0.48/-2.3/' constant/granularProperties
    check "$1: walls that meet are refused" refused 'is torn, turned inside out or strained'
}

# A long column, cold at one end, where the grains lose their contacts; at the other end the friction of the walls holds them.
# Triangles whose grains have lost contact resist nothing (see limits.md): single ones open, and then a few steps in a thousand
# stall above the residual. Their centres are nearer to the cold wall, which requires shorter steps.
unjammed() { # shape, time step, residual [Pa], steps that may end above it
    local loose packed bad above
    both_ways "unjam-$1"
    grains 'thermalExpansion 2.5e-3;'
    equilibrium "residual $3; walls { \"bottom|top\" { friction 0.5; slip 5e-4; } }"
    sed -i '/left/,/}/ s/uniform 100/uniform 0/; /right/,/}/ s/uniform 0/uniform 50/; /bottom/,/}/{ s/fixedValue/zeroGradient/; /value /d }' 0/T
    sed -i 's/^#include.*common.porosity.*/&\ninternalField uniform 0.12;/' 0/porosity
    controls "deltaT $2; endTime 8; writeControl runTime; writeInterval 4;"
    box "$1" '24 3' '0.5 0.04'
    logged msddFoam
    read -r loose packed bad < <(paste -d ' ' <(field 8/porosity) <(field 8/pressure) <(field 8/T) <(field 8/nodeDisplacement | head -$cells) | awk '
        { if ($1 > 0.18 && $2 < 200) loose++; if ($2 > 500) packed++
          for (i = 1; i <= NF; i++) if (!($i > -1e9 && $i < 1e9)) bad++; if ($2 < 0) bad++ }
        END { print loose + 0, packed + 0, bad + 0 }')
    check "$1, unjamming: $loose of $cells cells that hardly touch, a sixth to five sixths, $packed under pressure, a seventh" \
        test $((6*loose)) -ge "$cells" -a $((6*loose)) -le $((5*cells)) -a $((7*packed)) -ge "$cells"
    check "$1, unjamming: no value that is no number, no tension" test "$bad" = 0
    above=$(sed -n 's/.* in \([0-9]*\) steps above.*/\1/p' log)
    check "$1, unjamming: $above steps did not find their equilibrium, at most $4" below "$above" "$4"
    rm -rf "$work/unjam-$1-half"
    cp -r . "$work/unjam-$1-half"
    cd "$work/unjam-$1-half"
    rm -rf 8
    logged msddFoam
    check "$1, unjamming: restart bit for bit" same_mechanics "$work/unjam-$1/8" 8
}

audited_mechanics() { # shape: the balance of heat must close however the cells move
    local kind e
    for kind in paper secondOrder; do
        both_ways "audit-moved-$1-$kind"
        controls 'functions { #include "'"$here"'/audits" }'
        scheme "timeScheme $kind;"
        box "$1" '12 6'
        logged msddFoam
        e=$(worst heatAudit 6)
        check "$1, equilibrium, $kind: heat balance closes to $e <= 1e-10" below "$e" 1e-10
        e=$(worst massAudit 4)
        check "$1, equilibrium, $kind: mass closes to $e <= 1e-12" below "$e" 1e-12
        e=$(field 1/areaRatio | awk '{ e = $1 - 1; if (e < 0) e = -e; if (e > w) w = e } END { print (w > 1e-3) }')
        check "$1, equilibrium, $kind: cells changed their area" test "$e" = 1
    done
}
worst() { awk -v k="$2" '!/^#/ { if ($k > w) w = $k; n++ } END { print (n ? w + 0 : "nan") }' "postProcessing/$1/0/$1.dat"; }

for shape in $shapes; do
    parts "$shape"
    halved "$shape"
    hopeless "$shape"
    audited_mechanics "$shape"
done
unjammed quadrilaterals 0.01 1 0
unjammed triangles 0.005 5 16
