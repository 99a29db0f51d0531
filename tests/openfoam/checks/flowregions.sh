# Gas that flows through a bed which is a region of chtMultiRegionFoam, with a vessel that is a region: against msddFoam, balances, restart,
# processes, refusals.

. "$here/flow_cases"
. "$here/region_cases"

of_summary() { sed -n "s/.*\"flow\": {.*\"$1\": \([^,}]*\).*/\1/p" "postProcessing/${2:-bed}/msddFoam/summary.json"; }
alone_summary() { sed -n "s/.*\"flow\": {.*\"$1\": \([^,}]*\).*/\1/p" postProcessing/msddFoam/summary.json; }
range_apart() { # range, two files of fields: largest difference over the range
    paste -d ' ' <(field "$2") <(field "$3") | awk -v range="$1" '{ e = ($1 - $2)/range; if (e < 0) e = -e; if (!(e <= w)) w = e }
        END { print (NR > 1 ? w + 0 : "nan") }'
}
as_region() { # folder, solutions in a step: goes to a copy of this case of flow_case, with the bed as region
    rm -rf "${work:?}/$1"
    cp -r . "$work/$1"
    cd "$work/$1"
    rm -rf [1-9]* postProcessing log
    mkdir 0/bed system/bed constant/bed
    mv 0/T 0/porosity 0/fabricIndex 0/bed
    mv constant/polyMesh constant/granularProperties constant/bed
    mv system/blockMeshDict system/bed
    foam_file system/bed/fvSchemes dictionary <<< 'ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }
        divSchemes {} laplacianSchemes { default Gauss linear corrected; } interpolationSchemes { default linear; } snGradSchemes { default corrected; }'
    foam_file system/bed/fvSolution dictionary <<< 'solvers { "h|hFinal" { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; } } PIMPLE {}'
    foam_file system/fvSchemes dictionary < /dev/null
    foam_file system/fvSolution dictionary <<< "PIMPLE { nOuterCorrectors $2; }"
    foam_file constant/regionProperties dictionary <<< 'regions ( fluid () solid (bed) );'
    [ -e constant/g ] || foam_file constant/g uniformDimensionedVectorField <<< 'dimensions [0 1 -2 0 0 0 0]; value (0 0 0);'
    foam_file constant/bed/thermophysicalProperties dictionary <<< 'thermoType granularSolidThermo;'
    foam_file constant/bed/fvOptions dictionary <<< 'gas { type granularFlow; }'
    start bed p '1 -1 -2 0 0 0 0' 'uniform 1e5' '".*" { type zeroGradient; }'
    controls 'libs ("libgranularThermo.so"); adjustTimeStep no; maxDi 1e9; runTimeModifiable no;'
    region_heat
}
region_heat() { controls 'functions { regionHeat { type regionHeat; libs ("libgranularFunctionObjects.so"); writeControl writeTime; } }'; }
of_regions() { # column of the last line of regionHeat.dat
    local table
    table=$(ls -t postProcessing/regionHeat/*/regionHeat.dat | head -n 1)
    awk -v name="$1" '/^# Time/ { for (i = 2; i <= NF; i++) at[$i] = i - 1 } !/^#/ { value = $at[name] } END { print value }' "$table"
}
against_msdd_foam() { # Schumann's bed, air with one temperature, air by pressure and buoyancy, and air that charges a bed with a thin vessel
    local e name kind run bound
    run='endTime 600; deltaT 6; writeInterval 100;'
    for kind in schumann one pressure air; do
        if [ $kind = schumann ]; then
            flow_case flow-beside 50 "massFlux 1; exchangeCoefficient 2e4; temperatures two; $thin_gas" "$run" '' 1e-9
        elif [ $kind = one ]; then
            flow_case flow-beside 50 'massFlux 0.3; gasPressure 1e5; temperatures one;' "$run" '' 1
        elif [ $kind = pressure ]; then
            channelling=layer across=3 driven flow-beside 25 'in { massFlow 0.003; temperature 400; } out { temperature 300; }' \
                'gasPressure 1e5; walls { sides { heatCapacity 8000; loss 2; ambient 300; } }' "$run" '' 1
            gravity_is '-9.81 0 0'
        else
            across=3 flow_case flow-beside 50 'massFlux 0.3; gasPressure 1e5; walls { sides { heatCapacity 8000; loss 2; ambient 300; } }' "$run" '' 1
        fi
        logged msddFoam
        as_region flow-region-$kind 1
        logged chtMultiRegionFoam
        for name in T gasTemperature; do
            e=$(range_apart 100 600/bed/$name "$work/flow-beside/600/$name")
            bound=$([ $kind = pressure ] && echo 4e-9 || echo 1e-9) # T and flux are repeated to 1e-9 of T
            check "bed with gas ($kind) as region against msddFoam: $name differs by $e <= $bound of the range" below "$e" $bound
        done
        e=$(of_summary relative_difference)
        check "bed with gas ($kind) as region: $e <= 1e-9 of the heat did not arrive" below "$e" 1e-9
        e=$(of_regions relative_difference)
        check "and the heat of the region closes to $e <= 1e-9" below "$e" 1e-9
    done
    rm -rf 600 postProcessing
    foam_file system/fvSolution dictionary <<< 'PIMPLE { nOuterCorrectors 3; }'
    foam_file system/bed/fvSolution dictionary <<< 'solvers { "h|hFinal" { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; } } PIMPLE { nNonOrthogonalCorrectors 1; }'
    logged chtMultiRegionFoam
    e=$(range_apart 100 600/bed/T "$work/flow-beside/600/T")
    # Properties that depend on T settle to 1e-8 of 400 K, more often so in more solutions
    check "three solutions of two passes begin with the step's start: T differs by $e <= 4e-8 of the range" below "$e" 4e-8
    e=$(of_summary relative_difference)
    check "and $e <= 1e-9 of the heat did not arrive" below "$e" 1e-9
    e=$(awk "BEGIN { e = $(of_summary entered)/$(cd "$work/flow-beside" && alone_summary entered) - 1; print (e < 0 ? -e : e) }")
    check "the heat that entered is that of msddFoam to $e <= 1e-12" below "$e" 1e-12
    check "the table of the flow has one row a step" test "$(grep -vc '^#' postProcessing/bed/flow/0/flow.dat)" = 100
}

# A tube of steel next to a bed of air and rocks, which loses heat to the outside.
steel='type mappedWall; sampleMode nearestPatchFace;'
tube_case() { # folder, solutions in a step, controls, entries of throughCoeffs, condition of T between bed and tube; thickness of the tube in mm
    local mm=${6:-2}
    regions "$1" 'bed tube' "$2"
    controls "$3"
    region bed '20 3' '0 0 1 0.1' 'top tube bottom'
    region tube '20 2' "0 0.1 1 $(awk "BEGIN { print 0.1 + $mm/1000 }")" 'bottom bed top'
    plate tube 15 512 "$(awk "BEGIN { print 15625/$mm }")" # a power of two, else OpenFOAM rounds T in h = c T at a restart
    foam_file constant/bed/thermophysicalProperties dictionary <<< 'thermoType granularSolidThermo;'
    foam_file constant/bed/fvOptions dictionary <<< 'gas { type granularFlow; }'
    foam_file constant/bed/granularProperties dictionary <<-END
	surrogate { type constant; constantCoeffs { conductivity (1 0 0 1 0 1); stress (0 0 0 0 0 0); } }
	density 2000; youngModulus 1e9; thermalConductivity 2; heatCapacity 500; thermalExpansion 0; meanRadius 0.01; bulkDensity paper;
	flow through;
	throughCoeffs { inlet { patch left; temperature 500; } outlet { patch right; } gasPressure 1e5; massFlux 0.2; ${4:-} }
	END
    start bed porosity '0 0 0 0 0 0 0' 'uniform 0.4' '".*" { type zeroGradient; }'
    start bed fabricIndex '0 0 0 0 0 0 0' 'uniform 0' '".*" { type zeroGradient; }'
    local wall="type ${5:-granularContact}; value uniform 300;"
    temperature bed 'uniform 300' "top { $wall } \".*\" { type zeroGradient; }"
    temperature tube 'uniform 300' "bottom { $wall } top { type externalWallHeatFluxTemperature; mode coefficient; h uniform 5; Ta constant 300;
        kappaMethod solidThermo; value uniform 300; } \".*\" { type zeroGradient; }"
    region_heat
}
tube_balance() { # what the gas lost, less what bed, tube, pores and the outside received, over what it lost
    awk "BEGIN { lost = $(of_summary entered) - $(of_summary left) - $(of_summary in_pores)
        e = (lost - $(of_regions bed_stored) - $(of_regions tube_stored) + ($(of_regions patches)))/lost; print (e < 0 ? -e : e) }"
}
steel_tube() {
    local e lost run='endTime 3600; deltaT 60; writeInterval 60;'
    tube_case flow-tube 4 "$run"
    logged chtMultiRegionFoam
    e=$(tube_balance)
    check "gas, bed, tube and loss outside: the heat closes to $e <= 1e-4" below "$e" 1e-4
    lost=$(awk "BEGIN { print -($(of_regions patches))/($(of_summary entered) - $(of_summary left)) }")
    check "and $lost of it is lost outside, 0.005 to 0.5" is_within "$lost" 0.005 0.5
    e=$(awk "BEGIN { a = $(sed -n 's/.*"vessel": {"from_gas": \([^,]*\).*/\1/p' postProcessing/bed/msddFoam/summary.json); print a }")
    check "the gas gives the tube $e > 0 J" awk "BEGIN { exit !($e > 0) }"
    tube_case flow-tube-one 4 "$run" 'temperatures one;'
    logged chtMultiRegionFoam
    e=$(tube_balance)
    check "with one temperature of gas and grains the heat closes to $e <= 1e-4" below "$e" 1e-4
    # A tube that is thinner and conducts less along the flow, as wall of one temperature
    tube_case flow-tube-thin 8 "$run" '' '' 0.2
    logged chtMultiRegionFoam
    sed -i 's/throughCoeffs {/& walls { top { heatCapacity 8000; loss 5; ambient 300; } }/' constant/bed/granularProperties
    sed -i 's/top { type granularContact; value uniform 300; }/top { type zeroGradient; }/' 0/bed/T
    sed -i "s/mappedWall/wall/" constant/bed/polyMesh/boundary
    mv 3600 tube
    rm -rf postProcessing
    foam_file constant/regionProperties dictionary <<< 'regions ( fluid () solid (bed) );'
    logged chtMultiRegionFoam
    e=$(range_apart 200 tube/bed/T 3600/bed/T)
    check "a tube as region against a thin wall: T differs by $e <= 5e-4 of the range" below "$e" 5e-4
}
at_top() { sed -n '/^    top$/,/}/p' "$1" | grep -E '^[0-9.e+-]+$' | tail -n +2; } # values of a field on this patch
balance_at_wall() { # spheres that touch the tube: T of the wall by its equation, and the coefficient of the gas
    local e
    tube_case flow-tube-wall 30 'endTime 600; deltaT 60; writeInterval 10;'
    foam_file constant/bed/granularProperties dictionary <<-'END'
	surrogate { type spheres; spheresCoeffs { poissonRatio 0.29; gas air; wall { thermalConductivity 15; youngModulus 200e9; poissonRatio 0.29; } } }
	density 2600; youngModulus 50e9; thermalConductivity 2; heatCapacity 800; thermalExpansion 0; meanRadius 0.01; mechanics none;
	flow through; throughCoeffs { inlet { patch left; temperature 500; } outlet { patch right; } massFlux 0.2; }
	END
    foam_file 0/bed/stress volSymmTensorField <<< 'dimensions [1 -1 -2 0 0 0 0]; internalField uniform (-1e4 0 0 -1e4 0 -1e4);
        boundaryField { frontAndBack { type empty; } ".*" { type zeroGradient; } }'
    logged chtMultiRegionFoam
    e=$(paste -d ' ' <(at_top 600/bed/vesselTemperature) <(at_top 600/bed/wallExchange) <(at_top 600/bed/wallResistance) \
        <(field 600/bed/T | tail -n 20) <(field 600/bed/gasTemperature | tail -n 20) <(field 600/tube/T | head -n 20) \
        <(field 600/bed/conductivity | tail -n 20) | awk '
        { q = 15/0.0005*($6 - $1); s = ($1 - $4)/($3 + 0.05/3/$10); g = $2*($1 - $5); e = q - s - g; if (e < 0) e = -e; if (!(e <= w)) w = e
          if (-g > most) most = -g } END { print (NR == 20 && most > 0 ? w/most : "nan") }')
    check "wall between spheres, gas and tube: its equation closes to $e <= 1e-8" below "$e" 1e-8
    tube_case flow-tube-constant 1 'endTime 60; deltaT 60; writeInterval 1;' \
        'gas constant; constantGas { density 1; heatCapacity 1000; viscosity 2e-5; thermalConductivity 0.03; }'
    logged chtMultiRegionFoam
    e=$(sed -n '/^    top$/,/}/s/.*uniform \([0-9.e+-]*\);/\1/p' 60/bed/wallExchange)
    e=$(awk "BEGIN { e = ${e:-0}/(0.17*200^0.79*0.03/0.02) - 1; print (e < 0 ? -e : e) }")
    check "coefficient between gas and wall: differs from Nu = 0.17 Re^0.79 by $e <= 1e-12" below "$e" 1e-12
}
given_exchange() {
    tube_case flow-tube-given 1 'endTime 60; deltaT 60; writeInterval 1;' 'walls { top { gasExchange 50; } }'
    logged chtMultiRegionFoam
    check "a given coefficient between gas and tube" bash -c 'sed -n "/^    top$/,/}/p" 60/bed/wallExchange | grep -q "uniform 50;"'
}
without_contact() {
    tube_case flow-tube-blind 3 'endTime 60; deltaT 60; writeInterval 1;' '' 'compressible::turbulentTemperatureRadCoupledMixed; Tnbr T; kappaMethod solidThermo'
    logged chtMultiRegionFoam
    check "a solid that the gas does not see is warned of" grep -q 'the gas does not exchange heat with the neighbour of patch top' log
}
tube_beside_msdd_foam() { # the same tube as neighbour of msddFoam
    local e run='endTime 3600; deltaT 60; writeInterval 60;'
    tube_case flow-tube-many 40 "$run"
    logged chtMultiRegionFoam
    rm -rf "$work/flow-tube-alone"
    cp -r . "$work/flow-tube-alone"
    cd "$work/flow-tube-alone"
    rm -rf 3600 postProcessing log
    mv 0/bed/* 0 && mv system/bed/* system && mv constant/bed/granularProperties constant/bed/polyMesh constant && rm -r 0/bed system/bed constant/bed
    foam_file constant/regionProperties dictionary <<< 'regions (solid (tube));'
    sed -i 's/sampleRegion *bed/sampleRegion region0/' constant/tube/polyMesh/boundary
    foam_file system/controlDict dictionary <<< "startFrom latestTime; startTime 0; stopAt endTime; writeControl timeStep; writePrecision 17; timePrecision 12; $run"
    foam_file system/fvSolution dictionary <<< 'solvers { T { solver PCG; preconditioner DIC; tolerance 1e-14; relTol 0; } } msddFoam { timeScheme paper; }'
    cp system/fvSolution system/tube
    logged msddFoam
    e=$(range_apart 200 3600/T "$work/flow-tube-many/3600/bed/T")
    check "a tube in chtMultiRegionFoam and in msddFoam: T of the bed differs by $e <= 1e-8 of the range" below "$e" 1e-8
    e=$(range_apart 200 3600/tube/T "$work/flow-tube-many/3600/tube/T")
    check "and that of the tube by $e <= 1e-8" below "$e" 1e-8
    e=$(alone_summary relative_difference)
    check "heat of gas and tube in msddFoam closes to $e <= 1e-9" below "$e" 1e-9
    e=$(sed -n 's/.*"heat": {.*"relative_difference": \([^}]*\)}.*/\1/p' postProcessing/msddFoam/summary.json)
    check "that of the grains to $e <= 1e-8" below "$e" 1e-8
    e=$(sed -n 's/^Solids.*the difference is \([^ ]*\) of these.*/\1/p' log)
    check "that of the tube to $e <= 1e-8" below "$e" 1e-8
    rm -rf 3600 postProcessing
    scheme 'timeScheme secondOrder;'
    logged msddFoam
    e=$(sed -n 's/^Solids.*the difference is \([^ ]*\) of these.*/\1/p' log | tail -n 1)
    check "with two stages to $e <= 1e-8" below "$e" 1e-8
}
restarted_and_on_processes() {
    local e name region differing=''
    tube_case flow-tube-whole 3 'endTime 1200; deltaT 60; writeInterval 20;'
    logged chtMultiRegionFoam
    tube_case flow-tube-halves 3 'endTime 600; deltaT 60; writeInterval 10;'
    logged chtMultiRegionFoam
    controls 'endTime 1200;'
    logged chtMultiRegionFoam
    for region in bed tube; do
        differing+=$(diff -rq -x msddFoam "1200/$region" "$work/flow-tube-whole/1200/$region" || true)
    done
    check "bed, gas and tube restarted in the middle: same bytes${differing:+: $differing}" test -z "$differing"
    tube_case flow-tube-parts 3 'endTime 1200; deltaT 60; writeInterval 20;'
    foam_file system/decomposeParDict dictionary <<< 'numberOfSubdomains 3; method simple; simpleCoeffs { n (3 1 1); delta 1e-3; }'
    cp system/decomposeParDict system/bed
    cp system/decomposeParDict system/tube
    logged decomposePar -allRegions
    logged timeout 600 mpirun --oversubscribe -np 3 chtMultiRegionFoam -parallel
    logged reconstructPar -allRegions -latestTime
    for name in bed/T bed/gasTemperature tube/T; do
        e=$(range_apart 300 1200/$name "$work/flow-tube-whole/1200/$name")
        check "bed, gas and tube on three processes: $name differs by $e <= 1e-10 of itself" below "$e" 1e-10
    done
}
no_flow() { # a mass flow of 0 changes nothing
    tube_case flow-tube-off 3 'endTime 600; deltaT 60; writeInterval 10;'
    sed -i 's/massFlux 0.2/massFlux 0/' constant/bed/granularProperties
    sed -i 's/left/right/; s/internalField uniform 300/internalField uniform 350/' 0/tube/T
    logged chtMultiRegionFoam
    mv 600 off
    sed -i 's/flow through/flow none/' constant/bed/granularProperties
    rm constant/bed/fvOptions
    logged chtMultiRegionFoam
    check "mass flow 0 in a region: same bytes as without flow" bash -c 'diff -rq -x msddFoam 600/bed off/bed && diff -rq 600/tube off/tube'
}
lifted() { # gravity of the case acts in a region
    flow_case flow-beside 20 'massFlux 6; gas constant; constantGas { density 1; heatCapacity 1000; viscosity 2e-5; thermalConductivity 0.03; }' \
        'endTime 1; deltaT 1; writeInterval 1;' '' 2
    gravity_is '-9.81 0 0'
    as_region flow-region-lift 1
    check "refused: an upward flow that lifts the bed of a region" bash -c '! chtMultiRegionFoam > log.bad 2>&1; grep -qF "The bed would lift" log.bad'
}
region_refusals() {
    local message change
    while IFS='|' read -r message change; do
        tube_case flow-tube-bad 1 'endTime 60; deltaT 60; writeInterval 1;'
        bash -c "$change"
        check "refused: $message" bash -c '! chtMultiRegionFoam > log.bad 2>&1; tr -s "\n " " " < log.bad | grep -qF -- "$1"' - "$message"
        check "and foreseen" foreseen "$message"
    done <<-'END'
	does not call it, needed: gas { type granularFlow; }|rm constant/bed/fvOptions
	does not call it, needed: gas { type granularFlow; }|sed -i 's/type granularFlow/& ; active no/' constant/bed/fvOptions
	has a source of type granularFlow and no key 'flow' in granularProperties|sed -i 's/flow through;//' constant/bed/granularProperties
	has a source of type granularFlow and no bed|mkdir -p constant/tube; cp constant/bed/fvOptions constant/tube
	has steadyState, allowed with a flow: Euler|sed -i 's/Euler/steadyState/' system/bed/fvSchemes
	is of type fixedTemperatureConstraint, allowed in a bed with a flow|echo 'fixed { type fixedTemperatureConstraint; mode uniform; temperature 300; selectionMode all; }' >> constant/bed/fvOptions
	Entry 'loss' of the wall top|sed -i 's/massFlux/walls { top { loss 5; ambient 300; } } &/' constant/bed/granularProperties
	END
    flow_case flow-fixed 10 'massFlux 0.1;' 'endTime 10; deltaT 10; writeInterval 1;' '' 2
    foam_file constant/fvOptions dictionary <<< 'fixed { type scalarFixedValueConstraint; selectionMode all; fieldValues { T 333; } }'
    check "refused: fixed temperatures in msddFoam" refused 'fixed of constant/fvOptions is of type scalarFixedValueConstraint, allowed in a bed with a flow'
    tube_case flow-tube-good 1 'endTime 60; deltaT 60; writeInterval 1;'
    check "dry run of a bed with gas and a tube" passes
}

against_msdd_foam
steel_tube
balance_at_wall
given_exchange
without_contact
tube_beside_msdd_foam
restarted_and_on_processes
no_flow
lifted
region_refusals
