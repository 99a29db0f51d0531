# Equilibrium of the stress: patch test, a step of temperature, wall friction, restart, two processes, a rotated case; and that
# mechanics none is the default.

uniform_temperature() { # the case small at 50 K everywhere, insulated, without expansion
    sed -i 's/fixedValue;/zeroGradient;/; /value /d' 0/T
    grains 'thermalExpansion 0;'
}
equilibrium() { grains "mechanics equilibrium; equilibriumCoeffs { $* }"; }
skewed_mesh() { # the unit square in four blocks that meet outside of its centre, so that no cell is a rectangle
    local vertices='' z
    for z in 0 0.1; do
        vertices+="(0 0 $z) (0.5 0 $z) (1 0 $z) (0 0.5 $z) (0.58 0.41 $z) (1 0.5 $z) (0 1 $z) (0.5 1 $z) (1 1 $z) "
    done
    cat >> system/blockMeshDict <<-END
	scale 1;
	vertices ($vertices);
	blocks
	(
	    hex (0 1 4 3 9 10 13 12) (3 3 1) simpleGrading (1 1 1)
	    hex (1 2 5 4 10 11 14 13) (3 3 1) simpleGrading (1 1 1)
	    hex (3 4 7 6 12 13 16 15) (3 3 1) simpleGrading (1 1 1)
	    hex (4 5 8 7 13 14 17 16) (3 3 1) simpleGrading (1 1 1)
	);
	boundary
	(
	    left { type wall; faces ((0 3 12 9) (3 6 15 12)); }
	    right { type wall; faces ((2 5 14 11) (5 8 17 14)); }
	    bottom { type wall; faces ((0 1 10 9) (1 2 11 10)); }
	    top { type wall; faces ((6 7 16 15) (7 8 17 16)); }
	    frontAndBack { type empty; faces ((0 1 4 3) (1 2 5 4) (3 4 7 6) (4 5 8 7)
	        (9 10 13 12) (10 11 14 13) (12 13 16 15) (13 14 17 16)); }
	);
	END
    logged blockMesh
}

patch_test() { # walls move so that the strains must be 0.01 and -0.005 in all cells
    changed patch
    uniform_temperature
    equilibrium 'residual 1e-6; walls { ".*" { type frictionless; displacement constant (0 0 0); }
        right { type frictionless; displacement constant (0.01 0 0); } top { type frictionless; displacement constant (0 -0.005 0); } }'
    skewed_mesh
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
    local e
    e=$(field 0.05/stress | awk 'NR == 1 { x = $1; y = $4 } { e = ($1 - x)/x; f = ($4 - y)/y; g = $2/x
        for (k = 0; k < 3; k++) { h = k == 0 ? e : k == 1 ? f : g; if (h < 0) h = -h; if (!(h <= w)) w = h } } END { print (NR == 36 ? w + 0 : "nan") }')
    check "patch test on slanted cells: stress is uniform to $e <= 1e-8" below "$e" 1e-8
    e=$(paste -d ' ' <(field 0.05/nodeDisplacement) <(sed -n '/^($/,/^)$/p' constant/polyMesh/points | tr -d '()' | grep .) \
        | awk '{ e = $1 - 0.01*$4; f = $2 + 0.005*$5; if (e < 0) e = -e; if (f < 0) f = -f; if (!(e <= w)) w = e; if (!(f <= w)) w = f }
            END { print (NR == 98 ? w + 0 : "nan") }')
    check "patch test: nodes move linearly to $e <= 1e-10 m" below "$e" 1e-10
    # Expected stress: from the tangent that the model file gives for the state before the strain
    law=$(tr -d ' \n' < "$checkout/rust/surrogate/models/state.json" | sed 's/.*"mechanics":{"c11":\[\([^]]*\)\],"c12":\[\([^]]*\)\].*/\1,\2/')
    e=$(paste -d ' ' <(field 0.05/stress | head -1) <(field ../before/0.05/reducedPressure | head -1) <(field ../before/0.05/reducedDeviator | head -1) \
            <(field ../before/0.05/stress | head -1) \
        | awk -v law="$law" '{ split(law, c, ","); r = sqrt($7); c11 = c[1] + c[2]*r + c[3]*$8/$7; c12 = c[4] + c[5]*r
            change = 1e7*5e-3*(c11*log(1.01) + c12*log(0.995)); e = ($1 - $9)/change - 1; print e < 0 ? -e : e }')
    check "patch test: stress by the model's tangent to $e <= 0.005" below "$e" 0.005
}

step_of_temperature() { # left half strained by 0.01, no conduction: both halves must end with the same stress
    local m e
    for m in none equilibrium; do
        changed "step-$m"
        uniform_temperature
        grains 'thermalExpansion 1e-3; thermalConductivity 1e-9;'
        [ $m = none ] || equilibrium 'residual 0.001; walls { ".*" { type frictionless; } }'
        mesh_is '40 2 1'
        { sed -n '1,/^}/p' 0/porosity | sed 's/porosity/thermalStrainIncrement/'
            echo 'dimensions [0 0 0 0 0 0 0]; internalField nonuniform List<scalar> 80 ('
            awk 'BEGIN { for (j = 0; j < 2; j++) for (i = 0; i < 40; i++) print (i < 20 ? 0.01 : 0) }'
            echo '); boundaryField { #includeEtc "caseDicts/setConstraintTypes"
".*" { type zeroGradient; } }'
        } > 0/thermalStrainIncrement
        logged foamDictionary -entry endTime -set 0.05 system/controlDict
        logged msddFoam
    done
    e=$(field 0.05/stress | awk 'NR == 1 { x = $1 } { e = $1/x - 1; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print w }')
    check "temperature step: sigma_xx is uniform to $e <= 1e-4" below "$e" 1e-4
    # (sigma_L - sigma_R)/(c11_L + c11_R) is the strain of either half, L/2 long
    e=$(paste -d ' ' <(field ../step-none/0.05/stress) <(field ../step-none/0.05/reducedPressure) <(field ../step-none/0.05/reducedDeviator) \
            <(field 0.05/D) \
        | awk -v law="$law" '{ split(law, c, ","); r = sqrt($7); M = 1e7*5e-3*(c[1] + c[2]*r + c[3]*$8/$7) }
            NR == 1 { s = $1; m = M } NR == 20 { a = $9 } NR == 21 { b = $9 } NR == 40 { strain = (s - $1)/(m + M) }
            END { e = (a + b)/2/(-strain*2.15/2) - 1; print e < 0 ? -e : e }')
    check "temperature step: displacement against the closed form $e <= 0.03" below "$e" 0.03
}

# A column of height H is pressed at its left end by s0 more than at the start, and slips along both walls with friction mu. The
# added stress s follows Janssen's equation H ds/dx = -2 mu (sigma_yy at the start + k s), k = c12/c11, from s0 down to zero,
# and is zero beyond. s0 is small compared with the pressure, because the tangent depends on the pressure.
friction_column() {
    local push=150 e # [Pa]
    changed column
    uniform_temperature
    cat >> system/blockMeshDict <<-'END'
	scale 1;
	vertices ((0 0 0) (0.5 0 0) (0.5 0.1 0) (0 0.1 0) (0 0 0.1) (0.5 0 0.1) (0.5 0.1 0.1) (0 0.1 0.1));
	END
    mesh_is '100 1 1'
    set -- $(paste -d ' ' <(field ../before/0.05/stress | head -1) <(field ../before/0.05/reducedPressure | head -1) <(field ../before/0.05/reducedDeviator | head -1) \
        | awk -v law="$law" '{ split(law, c, ","); r = sqrt($7); printf "%.10g %.10g %.10g", -$1, -$4, (c[4] + c[5]*r)/(c[1] + c[2]*r + c[3]*$8/$7) }')
    equilibrium "residual 0.01; maxIterations 200; walls { left { type pressure; pressure constant $(awk "BEGIN { printf \"%.10g\", $1 + $push }"); }
        right { type frictionless; } \"bottom|top\" { type rigid; friction 0.1; slip 1e-7; } }"
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
    e=$(field 0.05/stress | awk -v push=$push -v xx=$1 -v yy=$2 -v k=$3 '{ x = (NR - 0.5)/200
        s = (push + yy/k)*exp(-2*0.1*k*x/0.1) - yy/k; if (s < 0) s = 0; e = (-$1 - xx - s)/push; if (e < 0) e = -e; if (!(e <= w)) w = e }
        END { print (NR == 100 ? w + 0 : "nan") }')
    check "friction column against the closed form: $e <= 0.03 of the push" below "$e" 0.03
}

both_ways() { # folder: the case small with mechanics equilibrium
    changed "$1"
    equilibrium 'residual 1e-3;'
}
same_mechanics() {
    local name
    for name in T porosity fabricIndex elasticCompression elasticShear1Xy stress nodeDisplacement wallTraction; do
        cmp -s <(field "$1/$name") <(field "$2/$name") || { echo "        $name differs" >&2; return 1; }
    done
}
restart_and_processes() {
    both_ways moved
    mesh_is '12 6 1'
    logged msddFoam
    check "equilibrium: every step below its residual" grep -q ' in 0 steps above' log
    cp -r . "$work/moved-half"
    cd "$work/moved-half"
    rm -rf 1 0.[6-9]* 0.5[1-9]* 
    logged msddFoam
    check "equilibrium: restart bit for bit" same_mechanics "$work/moved/1" 1
    both_ways moved-parallel
    mesh_is '12 6 1'
    logged decomposePar
    logged mpirun --oversubscribe -np 2 msddFoam -parallel
    logged reconstructPar -latestTime
    local e
    e=$(difference "$work/moved/1" 1)
    check "equilibrium: two processes: difference $e <= 1e-6" below "$e" 1e-6
}

turned() { # the case rotated by 90 degrees, x' = H - y, y' = x, must give the rotated result
    both_ways moved-turned
    sed -i 's/left/A/; s/right/B/; s/bottom/C/; s/top/D/' 0/T
    sed -i 's/^    A$/    bottom/; s/^    B$/    top/; s/^    C$/    right/; s/^    D$/    left/' 0/T
    sed -i 's/^#include.*fabricIndex.*/&\ninternalField uniform -0.05;/' 0/fabricIndex
    cat >> system/blockMeshDict <<-'END'
	vertices ((0 0 0) (645 0 0) (645 2150 0) (0 2150 0) (0 0 10) (645 0 10) (645 2150 10) (0 2150 10));
	END
    mesh_is '6 12 1'
    logged msddFoam
    local e
    e=$(awk 'NR == FNR { x[NR - 1] = $1; y[NR - 1] = $2; next }
        { c = FNR - 1; i = c % 6; j = int(c/6); o = j + 12*(5 - i); e = $1 + y[o]; f = $2 - x[o]
          if (e < 0) e = -e; if (f < 0) f = -f; if (!(e <= w)) w = e; if (!(f <= w)) w = f } END { print (FNR == 72 ? w + 0 : "nan") }' \
        <(field "$work/moved/1/D") <(field 1/D))
    check "equilibrium: turned by 90 degrees: D differs by $e <= 1e-7 m" below "$e" 1e-7
}

rm -rf "$work"/{moved-half,moved-parallel,four-circles-half}
changed before
uniform_temperature
skewed_mesh
logged foamDictionary -entry endTime -set 0.05 system/controlDict
logged msddFoam
patch_test
step_of_temperature
friction_column
restart_and_processes
turned
. "$here/checks/mechanics/walls.sh"
. "$here/checks/mechanics/failure.sh"
. "$here/checks/mechanics/convergence.sh"
