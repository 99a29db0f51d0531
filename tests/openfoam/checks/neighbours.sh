# msddFoam with a solid next to the bed: two layers with a contact resistance against the closed form, in both time schemes; heat over
# bed and solid; three processes; grains that move within a shell; regions that cannot be. The bed is the region without a name, the
# solid is region 'plate'.

file_of() { # path, class: begins a file of OpenFOAM with its head and appends what is read
    mkdir -p "$(dirname "$1")"
    { echo "FoamFile { version 2.0; format ascii; class $2; object ${1##*/}; }"; cat; } > "$1"
}
layer_mesh() { # folder below system, x0, x1 [m], cells, patch that is coupled, region and patch next to it, option of blockMesh
    local left='' right='' link="type mappedWall; sampleMode nearestPatchFace; sampleRegion $6; samplePatch $7;"
    [ "$5" = left ] && left=$link || right=$link
    file_of "system/$1/blockMeshDict" dictionary <<-END
	scale 1;
	vertices (($2 0 0) ($3 0 0) ($3 0.1 0) ($2 0.1 0) ($2 0 0.01) ($3 0 0.01) ($3 0.1 0.01) ($2 0.1 0.01));
	blocks (hex (0 1 2 3 4 5 6 7) ($4 3 1) simpleGrading (1 1 1));
	boundary
	(
	    left { type wall; faces ((0 4 7 3)); $left } right { type wall; faces ((1 2 6 5)); $right }
	    bottom { type wall; faces ((0 1 5 4)); } top { type wall; faces ((3 7 6 2)); } frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }
	);
	END
    logged blockMesh $8
}
cells_are() { # path, dimensions, values of the cells, boundary
    file_of "$1" volScalarField <<< "dimensions [$2]; internalField $3; boundaryField { frontAndBack { type empty; } $4 \".*\" { type zeroGradient; } }"
}
coupling() { # patch, method: the condition of T on a coupled patch, with the contact resistance R = 0.1 m2 K/W
    echo "$1 { type compressible::turbulentTemperatureRadCoupledMixed; Tnbr T; kappaMethod $2; kappa K;
        thicknessLayers (0.1); kappaLayers (1); value uniform 300; }"
}
layers_case() { # folder, cells of each layer, entries of controlDict, of msddFoam in fvSolution: a bed of width 0.4 m and a plate of 0.6 m
    rm -rf "${work:?}/$1"
    mkdir -p "$work/$1/system"
    cd "$work/$1"
    file_of constant/regionProperties dictionary <<< 'regions (solid (plate));'
    file_of system/controlDict dictionary <<< "writeFormat ascii; writePrecision 17; timePrecision 12; $3"
    cp "$here/small/system/fvSchemes" system
    file_of system/fvSolution dictionary <<< "solvers { T { solver PCG; preconditioner DIC; tolerance 1e-16; relTol 0; } } msddFoam { $4 }"
    mkdir -p system/plate
    file_of system/plate/fvSchemes dictionary <<< 'ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes {}
        laplacianSchemes { default Gauss linear corrected; } interpolationSchemes { default linear; } snGradSchemes { default corrected; }'
    file_of system/plate/fvSolution dictionary <<< "solvers { T { solver PCG; preconditioner DIC; tolerance 1e-16; relTol 0; } } PIMPLE {}"
    layer_mesh . 0 0.4 "$2" right plate left ''
    layer_mesh plate 0.4 1 "$2" left region0 right '-region plate'
    file_of constant/granularProperties dictionary <<-END
	surrogate { type constant; constantCoeffs { conductivity (2 0 0 1 0 0); stress (0 0 0 0 0 0); } }
	density 3000; youngModulus 1e7; thermalConductivity 1; heatCapacity 1; thermalExpansion 0; meanRadius 5e-3; bulkDensity paper;
	END
    file_of constant/plate/thermophysicalProperties dictionary <<< 'thermoType { type heSolidThermo; mixture pureMixture; transport constIso;
        thermo hConst; equationOfState rhoConst; specie specie; energy sensibleEnthalpy; }
        mixture { specie { molWeight 1; } transport { kappa 5; } thermodynamics { Hf 0; Cp 3; } equationOfState { rho 800; } }'
    cells_are 0/porosity '0 0 0 0 0 0 0' 'uniform 0.125' ''
    cells_are 0/fabricIndex '0 0 0 0 0 0 0' 'uniform 0' ''
    cells_are 0/plate/p '1 -1 -2 0 0 0 0' 'uniform 1e5' ''
}
# The first mode: x -> sin(k1 x) in the bed, B sin(k2 (a + b - x)) in the plate, which decays as exp(-lambda t); lambda from the flux,
# which is continuous, and the jump R q at the contact.
first_mode='BEGIN { a = 0.4; b = 0.6; K1 = 2; K2 = 5; C1 = 2625; C2 = 2400; R = 0.1; for (high = 1e-6; g(high) > 0; high *= 1.01) low = high
      for (i = 0; i < 200; i++) { mid = (low + high)/2; if (g(mid) > 0) low = mid; else high = mid }; g(low); l = low
      B = -K1*k1*cos(k1*a)/(K2*k2*cos(k2*b)) }
  function g(l) { k1 = sqrt(l*C1/K1); k2 = sqrt(l*C2/K2)
      return K2*k2*sin(k1*a)*cos(k2*b) + K1*k1*cos(k1*a)*sin(k2*b) + R*K1*k1*K2*k2*cos(k1*a)*cos(k2*b) }
  function phi(layer, i, n) { i = i % n + 0.5; return layer == "bed" ? sin(k1*i*a/n) : B*sin(k2*(b - i*b/n)) }'
begin_with_mode() { # cells of each layer: 300 K and 100 K times the mode
    local layer values
    for layer in bed plate; do
        values=$(awk -v n="$1" -v layer=$layer "$first_mode"'
            BEGIN { printf "nonuniform List<scalar> %d (", 3*n; for (i = 0; i < 3*n; i++) printf "%.17g ", 300 + 100*phi(layer, i, n); print ")" }')
        if [ $layer = bed ]; then
            cells_are 0/T '0 0 0 1 0 0 0' "$values" "left { type fixedValue; value uniform 300; } $(coupling right lookup)"
        else
            cells_are 0/plate/T '0 0 0 1 0 0 0' "$values" "right { type fixedValue; value uniform 300; } $(coupling left solidThermo)"
        fi
    done
}
error_of_mode() { # cells of each layer, time: largest error over 100 K
    local layer
    for layer in bed plate; do field "$2/${layer/bed/.}/T" | awk -v layer=$layer '{ print layer, NR - 1, $1 }'; done | awk -v n="$1" -v t="$2" "$first_mode"'
        { e = ($3 - 300)/100 - phi($1, $2, n)*exp(-l*t); if (e < 0) e = -e; if (!(e <= worst)) worst = e } END { print (NR > 3 ? worst : "nan") }'
}
heat_closes() { sed -n 's/.*the difference is \([^ ]*\) of these.*/\1/p' log; }
layers() { # scheme, cells, steps: error of the mode after 200 s
    layers_case "neighbour-$1-$2-$3" "$2" "endTime 200; deltaT $((200/$3)); writeInterval $3;" "timeScheme $1;"
    begin_with_mode "$2"
    logged msddFoam
    error_of_mode "$2" 200
}
orders() {
    local coarse fine
    coarse=$(layers secondOrder 8 100)
    fine=$(layers secondOrder 16 100)
    check "solid next to the bed: error $coarse with 8 cells in each layer, $fine <= 1e-3 with 16" below "$fine" 1e-3
    check "solid next to the bed: order in space at least 1.8" awk "BEGIN { exit !($coarse >= 2^1.8*$fine) }"
    coarse=$(layers paper 128 10)
    fine=$(layers paper 128 20)
    check "solid next to the bed, scheme of the paper: error $coarse with 10 steps, $fine <= 0.02 with 20" below "$fine" 0.02
    check "solid next to the bed, scheme of the paper: order in time at least 0.9" awk "BEGIN { exit !($coarse >= 2^0.9*$fine) }"
    coarse=$(layers secondOrder 128 2)
    fine=$(layers secondOrder 128 4)
    check "solid next to the bed, second order: error $coarse with 2 steps, $fine <= 0.01 with 4" below "$fine" 0.01
    check "solid next to the bed, second order: order in time at least 1.7" awk "BEGIN { exit !($coarse >= 2^1.7*$fine) }"
}
heat_over_all() {
    local e
    for name in paper-128-20 secondOrder-128-4; do
        cd "$work/neighbour-$name"
        e=$(heat_closes)
        check "solid next to the bed, $name: heat that came in from outside against heat in the solid and the bed $e <= 1e-9" below "$e" 1e-9
        e=$(sed -n 's/.*"relative_difference": \([^}]*\)}.*/\1/p' postProcessing/msddFoam/summary.json)
        check "solid next to the bed, $name: heat of the bed $e <= 1e-9" below "$e" 1e-9
    done
}
unequal_faces() { # 24 faces of the bed meet 5 of the plate, hot below: nearestPatchFace loses heat, which must be said
    local mode e
    for mode in nearestPatchFace nearestPatchFaceAMI; do
        layers_case neighbour-unequal-$mode 40 'endTime 10000; deltaT 500; writeInterval 20;' ''
        sed -i "s/nearestPatchFace;/$mode;/; s/(40 3 1)/(40 24 1)/" system/blockMeshDict
        sed -i "s/nearestPatchFace;/$mode;/; s/(40 3 1)/(40 5 1)/" system/plate/blockMeshDict
        logged blockMesh
        logged blockMesh -region plate
        grains 'surrogate { type constant; constantCoeffs { conductivity (2 0 0 2 0 0); } }'
        cells_are 0/T '0 0 0 1 0 0 0' 'uniform 300' "left { type fixedValue; value uniform 300; }
            bottom { type fixedValue; value uniform 500; } $(coupling right lookup | sed 's/thicknessLayers.*//') }"
        cells_are 0/plate/T '0 0 0 1 0 0 0' 'uniform 300' "right { type fixedValue; value uniform 300; }
            $(coupling left solidThermo | sed 's/thicknessLayers.*//') }"
        sed -i 's/kappa K;/kappa K; value uniform 300;/' 0/T 0/plate/T
        logged msddFoam
        e=$(heat_closes)
        if [ $mode = nearestPatchFace ]; then
            check "unequal faces, $mode: the loss of $e is a warning with its remedy" grep -q \
                'Warning: heat is lost or made at the walls between the bed and plate: .*use sampleMode nearestPatchFaceAMI' log
            check "unequal faces, $mode: it is in summary.json" grep -q 'Warning: heat is lost or made at the walls' postProcessing/msddFoam/summary.json
        else
            check "unequal faces, $mode: heat closes to $e <= 1e-8" below "$e" 1e-8
            check "unequal faces, $mode: no warning about it" bash -c '! grep -q "heat is lost" log'
        fi
    done
}
on_processes() { # the coupled patches are cut along y
    local e name
    layers_case neighbour-processes 16 'endTime 20; deltaT 2; writeInterval 10;' 'timeScheme secondOrder;'
    begin_with_mode 16
    cp -r . "$work/neighbour-serial"
    for name in system system/plate; do
        file_of $name/decomposeParDict dictionary <<< 'numberOfSubdomains 3; method hierarchical; hierarchicalCoeffs { n (1 3 1); delta 0.001; order xyz; }'
    done
    logged decomposePar
    logged decomposePar -region plate
    side_by_side 3
    logged reconstructPar
    logged reconstructPar -region plate
    cd "$work/neighbour-serial"
    logged msddFoam
    for name in T plate/T; do
        e=$(paste -d ' ' <(field 20/$name) <(field "$work/neighbour-processes/20/$name") | awk '{ e = $1 - $2; if (e < 0) e = -e; if (!(e <= w)) w = e }
            END { print (NR > 3 ? w : "nan") }')
        check "solid next to the bed on three processes: $name differs by $e <= 1e-6 K" below "$e" 1e-6
    done
}
restarted() { # a run that ends in the middle and goes on has the same bytes as one that does not
    local name
    layers_case neighbour-whole 16 'endTime 20; deltaT 2; writeInterval 5; startFrom latestTime;' 'timeScheme secondOrder;'
    begin_with_mode 16
    cp -r . "$work/neighbour-halves"
    logged msddFoam
    cd "$work/neighbour-halves"
    controls 'endTime 10;'
    logged msddFoam
    controls 'endTime 20;'
    logged msddFoam
    for name in T plate/T; do
        check "solid next to the bed, restarted in the middle: $name has the same bytes" cmp "20/$name" "$work/neighbour-whole/20/$name"
    done
}
killed_with_a_solid() { # killed (-9) three times while it writes every step; a damaged file of the solid
    local after solver
    layers_case neighbour-killed 16 'endTime 20; deltaT 1; writeInterval 1; startFrom latestTime;' 'timeScheme secondOrder;'
    begin_with_mode 16
    echo 'thermalExpansion 1e-6;' >> constant/granularProperties
    rm -rf "$work/neighbour-unkilled"
    cp -r . "$work/neighbour-unkilled"
    (cd "$work/neighbour-unkilled" && logged msddFoam)
    for after in 3 9 15; do
        (exec msddFoam >> log 2>&1) &
        solver=$!
        while [ ! -e $after/plate/T ] && kill -0 $solver 2> /dev/null; do sleep 0.002; done
        kill -9 $solver 2> /dev/null || true
        wait $solver 2> /dev/null || true
    done
    check "solid next to the bed, killed three times: $(grep -c '^Create time' log) runs so far, stopped before the end" test ! -e 20
    logged msddFoam
    check "solid next to the bed, killed three times: the last time has the same bytes" diff -rq -x functionObjects 20 "$work/neighbour-unkilled/20"
    truncate -s -40 20/plate/T
    logged msddFoam
    check "solid next to the bed: a time whose file of the solid is damaged is skipped" grep -q 'Time 20 is skipped: without its end: plate/T' log
    check "and computed again to the same bytes" diff -rq -x functionObjects 20 "$work/neighbour-unkilled/20"
    logged transformPoints -region plate -scale '(1 1.001 1)'
    controls 'endTime 21;'
    check "solid next to the bed: another mesh of the solid is refused" refused 'constant/plate/polyMesh is not that on which time 20'
}
by_temperature() { # folder, scheme, steps of 200 s in all: conductivity and heat capacity of the plate follow its temperature
    layers_case "$1" 24 "endTime ${4:-200}; deltaT $(awk "BEGIN { print ${4:-200}/$3 }"); writeInterval $3;" "timeScheme $2;"
    begin_with_mode 24
    file_of constant/plate/thermophysicalProperties dictionary <<< 'thermoType { type heSolidThermo; mixture pureMixture; transport polynomial;
        thermo hPolynomial; equationOfState icoPolynomial; specie specie; energy sensibleEnthalpy; }
        mixture { specie { molWeight 1; } transport { kappaCoeffs<8> (-4 0.03 0 0 0 0 0 0); }
        thermodynamics { Hf 0; Sf 0; CpCoeffs<8> (-3 0.02 0 0 0 0 0 0); } equationOfState { rhoCoeffs<8> (800 0 0 0 0 0 0 0); } }'
}
apart_at() { paste -d ' ' <(field "$work/$1/200/plate/T") <(field "$work/$2/200/plate/T") | awk '{ e = $1 - $2; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR > 3 ? w : "nan") }'; }
follows_its_temperature() {
    local coarse fine e n
    for n in 4 8 16; do
        by_temperature neighbour-follows-$n secondOrder $n
        logged msddFoam
    done
    coarse=$(apart_at neighbour-follows-4 neighbour-follows-8)
    fine=$(apart_at neighbour-follows-8 neighbour-follows-16)
    check "solid whose properties follow its temperature: 4 and 8 steps differ by $coarse K, 8 and 16 by $fine K, of second order" \
        awk "BEGIN { exit !($coarse > 1e-6 && $coarse >= 2^1.7*$fine) }"
    e=$(heat_closes)
    check "solid whose properties follow its temperature: heat closes to $e <= 1e-9" below "$e" 1e-9
    # At rest: the heat through bed and contact is that through the plate, the integral of its conductivity -4 + 0.03 T
    by_temperature neighbour-follows-rest paper 1 1e9
    sed -i 's/left { type fixedValue; value uniform 300/left { type fixedValue; value uniform 500/' 0/T
    logged msddFoam
    e=$(awk 'BEGIN { low = 300; high = 500; for (i = 0; i < 100; i++) { T = (low + high)/2; q = ((500 - T)/(0.4/2 + 0.1))*0.6
        if (-4*(T - 300) + 0.015*(T*T - 90000) < q) low = T; else high = T }; print q/0.6 }' | awk -v T="$(field 1000000000/T | head -n 1)" '{ e = (500 - T)*2/(0.4/48)/$1 - 1; print (e < 0 ? -e : e) }')
    check "solid whose properties follow its temperature, at rest: the heat is that of the closed form to $e <= 1e-4" below "$e" 1e-4
}
slanted() { # cells are parallelograms, K has an xy component, and T changes along the wall: both sides must see the same heat
    local e mesh
    layers_case neighbour-slanted 12 'endTime 100; deltaT 10; writeInterval 10;' 'timeScheme secondOrder; nNonOrthogonalCorrectors 3;'
    begin_with_mode 12
    for mesh in system system/plate; do # the upper corners move to the right
        awk '/^vertices/ { gsub(/[()]/, " "); sub(/;/, ""); printf "vertices ("; for (i = 2; i <= NF; i += 3) printf "(%s %s %s)", $i + 0.4*$(i + 1), $(i + 1), $(i + 2); print ");"; next } { print }' \
            $mesh/blockMeshDict > dict && mv dict $mesh/blockMeshDict
    done
    logged blockMesh
    logged blockMesh -region plate
    sed -i 's/PIMPLE {}/PIMPLE { nNonOrthogonalCorrectors 3; }/' system/plate/fvSolution
    sed -i 's/conductivity (2 0 0 1 0 0)/conductivity (2 0.5 0 1 0 0)/' constant/granularProperties
    sed -i 's/".*" { type zeroGradient; }/bottom { type fixedValue; value uniform 400; } &/' 0/T
    logged msddFoam
    e=$(heat_closes)
    check "solid next to the bed, slanted cells and K_xy: heat closes to $e <= 1e-9" below "$e" 1e-9
    e=$(sed -n 's/.*"relative_difference": \([^}]*\)}.*/\1/p' postProcessing/msddFoam/summary.json)
    check "solid next to the bed, slanted cells and K_xy: heat of the bed closes to $e <= 1e-9" below "$e" 1e-9
}
within_a_shell() { # grains that move, elastic here: the shell stands where its temperature and the pressure put it
    local e
    layers_case neighbour-shell 16 'endTime 100; deltaT 1; adjustTimeStep yes; writeControl adjustableRunTime; writeInterval 100;' 'timeScheme secondOrder;'
    begin_with_mode 16
    cat >> constant/granularProperties <<-'END'
	thermalExpansion 1e-6; mechanics equilibrium;
	equilibriumCoeffs { law elastic; elasticCoeffs { youngModulus 1e7; poissonRatio 0.3; } residual 1e-6; walls { ".*" { type frictionless; }
	    right { type shell; youngModulus 1e8; thickness 0.01; radius 0.5; thermalExpansion 2e-6; temperature 300; } } }
	END
    logged msddFoam
    e=$(awk -v p="$(field 100/stress | awk 'NR == 16 { print -$1 }')" -v u="$(field 100/D | awk 'NR == 16 { print $1 }')" \
        -v before="$(field 100/D | awk 'NR == 15 { print $1 }')" '
        /^    right/ { inside = 1 } inside && /^    }/ { inside = 0 }
        inside && $1 == "value" { sub(/.*\(/, ""); T = $1 + 0 }
        END { wall = u + (u - before)/2; place = 2e-6*0.5*(T - 300) + p*0.25/(1e8*0.01); e = wall/place - 1; print (T > 300 && p != 0 ? (e < 0 ? -e : e) : "nan") }' 100/T)
    check "shell next to a bed with a solid: it is where its temperature and the pressure put it, to $e <= 0.01" below "$e" 0.01
    e=$(heat_closes)
    check "shell next to a bed with a solid: heat closes to $e <= 1e-9" below "$e" 1e-9
}
neighbours_that_cannot_be() {
    layers_case neighbour-fluid 4 'endTime 1; deltaT 1; writeInterval 1;' ''
    begin_with_mode 4
    file_of constant/regionProperties dictionary <<< 'regions (solid (plate) fluid (water));'
    check "refused: a fluid next to msddFoam" refused "the regions water of type 'fluid'"
    file_of constant/regionProperties dictionary <<< 'regions (solid (plate));'
    sed -i 's/constIso/constAnIso/; s/kappa 5/kappa (5 5 1)/' constant/plate/thermophysicalProperties
    check "refused: settings for a bed with a solid" test "$(msdd case solve . 2>&1 | grep -c 'the bed has solids next to it')" = 1
    check "refused: a solid whose conductivity has directions" refused 'Region plate has a conductivity with directions'
}
orders
heat_over_all
unequal_faces
on_processes
restarted
killed_with_a_solid
follows_its_temperature
slanted
within_a_shell
neighbours_that_cannot_be
