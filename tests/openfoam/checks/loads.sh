# What is given at walls and inside of a bed: functions of time under adaptive steps, equal on any number of processes; heat of walls
# of given flux and of sources that depend on T; a cooling that a first step takes far too far; states that no law covers.

. "$here/region_cases"

heat_in() { # time: heat that came in through the wall left [J]
    awk '/^allHeat/ { all = 1 } all && /left/ { sub(";", "", $2); print $2; exit }' "$1/uniform/msddFoam"
}
adaptive_wall() { # folder, table of T at the wall left, entries of controlDict: the others give no heat
    changed "$1"
    box quadrilaterals '24 6'
    sed -i 's/fixedValue;/zeroGradient;/; /value /d' 0/T
    foamDictionary -entry boundaryField.left -set "{ type uniformFixedValue; uniformValue table ($2); value uniform 50; }" 0/T > /dev/null
    controls "functions {} deltaT 1e-3; adjustTimeStep yes; writeControl adjustableRunTime; $3"
    scheme 'timeScheme secondOrder;'
}
pulses() { # a pulse of heat between two write times; the same with many of these
    local heat=() interval e
    for interval in 8 0.05; do
        adaptive_wall "pulse-$interval" '(0 50) (4 50) (4.1 90) (4.6 90) (4.7 50) (8 50)' "endTime 8; writeInterval $interval;"
        logged msddFoam
        heat+=("$(heat_in 8)")
    done
    e=$(awk "BEGIN { e = ${heat[0]}/${heat[1]} - 1; print e < 0 ? -e : e }")
    check "loads: adaptive steps see a pulse of heat between two write times: ${heat[0]} J, its error $e <= 0.02" below "$e" 0.02
}
one_tolerance() { # T goes beyond its first range, on one of two processes first: a tolerance of each would end in disorder
    local steps=() status=0
    adaptive_wall tolerance '(0 50) (0.5 90) (1 50) (8 50)' 'endTime 4; writeInterval 4;'
    cp -r . "$work/tolerance-2"
    logged msddFoam
    steps+=("$(sed -n 's/^Steps: //p' log)")
    cd "$work/tolerance-2"
    in_parts '2 1'
    timeout 60 mpirun --oversubscribe -np 2 msddFoam -parallel >> log 2>&1 || status=$?
    steps+=("$(sed -n 's/^Steps: //p' log)")
    check "loads: two processes take the steps of one: ${steps[1]}" test "$status" = 0 -a "${steps[0]}" = "${steps[1]}"
}
flux_walls() {
    local heat
    adaptive_wall flux '(0 50) (1 50)' 'libs ("libcompressibleTurbulenceModels.so"); endTime 20; deltaT 0.01; writeInterval 20;'
    flux() { foamDictionary -entry boundaryField.left -set "{ type externalWallHeatFluxTemperature; mode flux; q uniform 4000; kappaMethod lookup; kappa $1; value uniform 50; }" 0/T > /dev/null; }
    flux conductivity
    ! msddFoam > log.refused 2>&1
    check "loads: a wall that reads the conductivity of the last output is refused" grep -q "allowed: K, the conductivity in the" log.refused
    flux K
    logged msddFoam
    heat=$(awk -v heat="$(heat_in 20)" 'BEGIN { e = heat/(0.645*0.01*4000*20) - 1; print e < 0 ? -e : e }')
    check "loads: heat of a wall of given flux on a mesh along the axes: error $heat <= 1e-6" below "$heat" 1e-6
}
mixed_walls() { # without a heat transfer coefficient they insulate, also where K has an xy component
    local side
    changed mixed
    grains 'surrogate { type constant; constantCoeffs { conductivity (34 8 0 26 0 0); } }'
    box quadrilaterals '12 6'
    for side in bottom top; do
        foamDictionary -entry boundaryField.$side -set '{ type mixed; refValue uniform 0; refGradient uniform 0; valueFraction uniform 0; value uniform 50; }' 0/T > /dev/null
    done
    controls 'endTime 5;'
    logged msddFoam
    side=$(awk '/^allHeat/ { all = 1 } all && /bottom|top/ { sub(";", "", $2); sum += $2 < 0 ? -$2 : $2 } END { print sum }' 5/uniform/msddFoam)
    check "loads: heat through insulated walls of the type mixed: $side <= 1e-12 J" below "$side" 1e-12
}
sources() { # heat that falls with T, dT/dt = -Sp/(rho c) T, and one that grows
    local sign step e errors order
    for sign in -20 20; do
        errors=()
        for step in 0.1 0.05; do
            changed "source$sign-$step"
            scheme 'timeScheme secondOrder;'
            grains "thermalExpansion 0; surrogate { type constant; constantCoeffs { conductivity (34 0 0 26 0 0); } }"
            sed -i 's/fixedValue;/zeroGradient;/; /value /d' 0/T
            foam_file constant/fvOptions dictionary <<< "heating { type scalarSemiImplicitSource; active yes; selectionMode all; volumeMode specific; injectionRateSuSp { T (0 ${sign}00); } }"
            controls "functions { #include \"$here/audits\" } deltaT $step; writeControl timeStep; writeInterval $(awk "BEGIN { print 1/$step }");"
            box quadrilaterals '12 6'
            logged msddFoam
            e=$(paste <(field 0/T) <(field 1/T) <(field 1/bulkDensity) | head -n 1 | awk -v s="$sign" -v c="$(awk '$1 == "heatCapacity" { sub(";", "", $2); print $2 }' "$checkout/cases/common/granularProperties")" \
                '{ e = $2/$1/exp(100*s/($3*c)) - 1; print e < 0 ? -e : e }')
            errors+=("$e")
        done
        order=$(awk "BEGIN { print log(${errors[0]}/${errors[1]})/log(2) }")
        check "loads: source of $sign T: errors ${errors[*]}, order in time $order >= 1.9" is_within "$order" 1.9 3
        e=$(awk 'END { print $NF }' postProcessing/heatAudit/0/heatAudit.dat)
        check "loads: source of $sign T: balance of heat $e <= 1e-10" below "$e" 1e-10
    done
    sed -i '/FoamFile/,/}/d' constant/fvOptions
    ! msddFoam > log.refused 2>&1
    check "loads: fvOptions without header is refused" grep -q "has no header FoamFile" log.refused
}
bed_of_spheres() { # folder, T at the left wall, scheme, step, more of controlDict: a column under 10 kPa that is heated or cooled from one side
    spheres_bed "$1" 'residual 1; walls { left { type pressure; pressure constant 1e4; } ".*" { type frictionless; } }'
    echo 'scale 1; vertices ((0 0 0) (0.02 0 0) (0.02 0.01 0) (0 0.01 0) (0 0 0.01) (0.02 0 0.01) (0.02 0.01 0.01) (0 0.01 0.01)); blocks (hex (0 1 2 3 4 5 6 7) (40 1 1) simpleGrading (1 1 1)); boundary ( left { type wall; faces ((0 4 7 3)); } right { type wall; faces ((1 2 6 5)); } bottom { type wall; faces ((0 1 5 4)); } top { type wall; faces ((3 7 6 2)); } frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); } );' \
        | foam_file system/blockMeshDict dictionary
    logged blockMesh
    start_field stress '[1 -1 -2 0 0 0 0]' '(-1e4 0 0 -1e4 0 -1e4)'
    sed -i s/volScalarField/volSymmTensorField/ 0/stress
    hot_wall left "$2"
    controls "endTime 200; deltaT $4; writeInterval 1000; writeControl runTime; writeInterval 200; $5"
    scheme "timeScheme $3;"
}
moving_spheres() {
    local e step
    bed_of_spheres ahead-fine 400 secondOrder 1 ''
    logged msddFoam
    for step in 20 5; do
        bed_of_spheres "ahead-$step" 400 secondOrder $step ''
        logged msddFoam
        e=$(paste <(field "$work/ahead-fine/200/T") <(field 200/T) | awk '{ e = $1 - $2; if (e < 0) e = -e; if (e > w) w = e } END { print w }')
        check "loads: spheres that move, steps of $step s: T within $e <= $(awk "BEGIN { print 0.01*$step }") K of steps of 1 s" \
            below "$e" "$(awk "BEGIN { print 0.01*$step }")"
    done
    bed_of_spheres cooled 200 secondOrder 5 'adjustTimeStep yes;'
    msddFoam >> log 2>&1 && e=0 || e=$?
    check "loads: a cooling that the first step takes below 0 K is repeated" test "$e" = 0
}
unknown_states() {
    bed_of_spheres dense 310 paper 20 ''
    start_field porosity '[0 0 0 0 0 0 0]' 0.25
    logged msddFoam
    check "loads: spheres denser than any packing are outside of the range, and that is said" \
        grep -q "Range: 100 % of the states .* At the end 40 of 40 cells are outside" log
    bed_of_spheres lifted 300 paper 20 ''
    sed -i 's/type pressure; pressure constant 1e4;/type frictionless; displacement table ((0 (0 0 0)) (200 (-1e-4 0 0)));/' constant/granularProperties
    logged msddFoam
    check "loads: grains that lose touch are told" grep -q "Warning: grains in 40 of 40 cells carry no load" log
    check "loads: a bed without heat has no balance of it" grep -q "Heat: none went into the bed" log
    bed_of_spheres tense 300 paper 20 ''
    sed -i 's/-1e4/1e4/g' 0/stress
    check "loads: tension at the start is refused with spheres" refused "allowed: at most 0, because grains cannot carry tension"
}
heavy_bed() { # a stress given in kPa, as if these were Pa, is far below what the spheres weigh: 0.59*2500*9.81*0.4 = 5788 Pa at the bottom
    local pressure said
    for pressure in 3000 3; do
        spheres_bed "heavy-$pressure" 'walls { top { type pressure; pressure constant 0; } ".*" { type frictionless; } }'
        block_mesh '(0 0 0) (0.2 0 0) (0.2 0.2 0) (0 0.2 0) (0 0 0.4) (0.2 0 0.4) (0.2 0.2 0.4) (0 0.2 0.4)' 'hex (0 1 2 3 4 5 6 7) (1 1 4) simpleGrading (1 1 1)' '' '
            bottom { type wall; faces ((0 3 2 1)); } top { type wall; faces ((4 5 6 7)); } sides { type wall; faces ((0 1 5 4) (3 7 6 2) (0 4 7 3) (1 2 6 5)); }'
        gravity_is '0 0 -9.81'
        start_field stress '[1 -1 -2 0 0 0 0]' "(-$pressure 0 0 -$pressure 0 -$pressure)"
        sed -i s/volScalarField/volSymmTensorField/ 0/stress
        controls 'endTime 1e-9; deltaT 1e-9; writeInterval 1;'
        in_parts '2 1'
        timeout 60 mpirun --oversubscribe -np 2 msddFoam -parallel > log.run 2>&1 || true
        said=$(grep -c "is $pressure Pa along gravity in the mean, and the weight of the bed over the area below it is 5[67][0-9]*\.*[0-9]* Pa" log.run || true)
        check "loads: a start under $pressure Pa below 5.8 kPa of weight: said $said times" test "$said" = "$([ $pressure = 3 ] && echo 1 || echo 0)"
    done
}
pulses
one_tolerance
flux_walls
mixed_walls
sources
moving_spheres
unknown_states
heavy_bed
