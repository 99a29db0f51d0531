# Equilibrium of the stress: patch test, a step of temperature, wall friction, restart, two processes, a rotated case; and that
# mechanics none is the default. What the grains carry is asked of the model itself by the program law.c, for the state that the
# solver has written and the strain that the test prescribes.

uniform_temperature() { # the case small at 50 K everywhere, insulated, without expansion
    sed -i 's/fixedValue;/zeroGradient;/; /value /d' 0/T
    grains 'thermalExpansion 0;'
}
at_rest() { # folder, fabric index: grains as at the start, whose state the tests need
    changed "$1"
    uniform_temperature
    fabric_is "$2"
    mesh_is '1 1 1'
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
}
state_of() { # folder of a case at rest: the columns of the state
    local name
    for name in $("$work/law" | sed 's/_\(.\)/\U\1/g'); do field "$work/$1/0.05/$name" | head -1; done
}
strained() { "$work/law" $(state_of "$1"); } # folder of a case at rest: reads strains, prints stress and tangent, see law.c
# The closed forms are those of walls that discs do not press into, unless the entries say so
equilibrium() { grains "mechanics equilibrium; equilibriumCoeffs { wallCompliance 0; $* }"; }
fabric_is() { sed -i "s/^#include.*fabricIndex.*/&\ninternalField uniform $1;/" 0/fabricIndex; }
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
    # The strain is that around the middle of the step. Stresses of all cells must be those of the model
    e=$(paste -d ' ' <(field 0.05/stress) <(echo 0 "$(awk 'BEGIN { printf "%.17g %.17g", 0.01/1.005, -0.005/0.9975 }')" 0 0 | strained before) \
        | awk 'NR == 1 { x = $7; y = $8; t = $9 } { e = (-$1 - x)/x; f = (-$4 - y)/y; g = (-$2 - t)/x
            for (k = 0; k < 3; k++) { h = k == 0 ? e : k == 1 ? f : g; if (h < 0) h = -h; if (!(h <= w)) w = h } } END { print (NR == 36 ? w + 0 : "nan") }')
    check "patch test: stress is that of the model to $e <= 1e-8" below "$e" 1e-8
}

step_of_temperature() { # left half strained by 0.01, no conduction: both halves must end with the same stress
    local e d
    changed step
    uniform_temperature
    grains 'thermalExpansion 1e-3; thermalConductivity 1e-9;'
    equilibrium 'residual 1e-6; walls { ".*" { type frictionless; } }'
    mesh_is '40 2 1'
    { sed -n '1,/^}/p' 0/porosity | sed 's/porosity/thermalStrainIncrement/'
        echo 'dimensions [0 0 0 0 0 0 0]; internalField nonuniform List<scalar> 80 ('
        awk 'BEGIN { for (j = 0; j < 2; j++) for (i = 0; i < 40; i++) print (i < 20 ? 0.01 : 0) }'
        echo '); boundaryField { #includeEtc "caseDicts/setConstraintTypes"
".*" { type zeroGradient; } }'
    } > 0/thermalStrainIncrement
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
    e=$(field 0.05/stress | awk 'NR == 1 { x = $1 } { e = $1/x - 1; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print w }')
    check "temperature step: sigma_xx is uniform to $e <= 1e-8" below "$e" 1e-8
    # The middle moves by d. With the strains that this gives to the halves, which are h long, the model must find the same
    # stress in both, and all cells must have it. A difference of stress over the stiffness of both is an error of the strain
    d=$(field 0.05/nodeDisplacement | awk 'NR == 21 { print $1 }')
    set -- $(awk -v d="$d" 'BEGIN { h = 2.15/2; printf "0.01 %.17g 0 0 0\n0 %.17g 0 0 0\n", d/(h + d/2), -d/(h - d/2) }' \
        | strained before | awk '{ print $1, $2, $4 }')
    e=$(paste -d ' ' <(field 0.05/stress) <(field 0.05/D) | awk -v d="$d" -v law="$*" '
        NR == 1 { split(law, s, " "); M = (s[3] + s[6])*d/(2.15/2); w = (s[1] - s[4])/M; if (w < 0) w = -w }
        { i = (NR - 1) % 40; k = i < 20 ? 1 : 4; u = d*(i < 20 ? i + 0.5 : 39.5 - i)/20
          e = (-$1 - s[k])/M; f = (-$4 - s[k + 1])/M; g = $7/u - 1
          for (j = 0; j < 3; j++) { q = j == 0 ? e : j == 1 ? f : g; if (q < 0) q = -q; if (!(q <= w)) w = q } }
        END { print (NR == 80 ? w + 0 : "nan") }')
    check "temperature step: displacement and stress are those of the model to $e <= 1e-7" below "$e" 1e-7
}

# A column of height H is pressed at its left end by s0 more than at the start, and slips along both walls with friction mu. The
# added stress s follows Janssen's equation H ds/dx = -2 mu (sigma_yy at the start + k s), k = C21/C11 of the model's tangent,
# from s0 down to zero, and is zero beyond. s0 is small compared with the pressure, because the tangent depends on the pressure.
# The grains do not slide past each other. Janssen's s is the mean over a section: of one quadrilateral, or of two triangles, one
# at either wall. How far these two are from the mean falls with the first order of their width (measured at 50, 100 and 200
# cells: 3.1, 3.9 and 4.0 over their number).
friction_column() { # shape, cells along the column
    local push=150 sxx syy k section alone # [Pa]
    read -r sxx syy k < <(echo 0 0 0 0 0 | strained gentle | awk '{ printf "%.17g %.17g %.17g\n", $1, $2, $7/$4 }')
    changed "column-$1-$2"
    uniform_temperature
    box "$1" "$2 1" '0.5 0.1'
    fabric_is 0.01
    equilibrium "residual 0.01; maxIterations 200; walls { left { type pressure; pressure constant $(awk "BEGIN { printf \"%.10g\", $sxx + $push }"); }
        right { type frictionless; } \"bottom|top\" { type rigid; friction 0.1; slip 1e-8; } }"
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
    cell_geometry
    read -r section alone < <(paste -d ' ' <(field 0.05/stress) <(field 0/C) <(field 0/V) | awk -v push=$push -v xx="$sxx" -v yy="$syy" -v k="$k" '
        function error(sigma, x,   s) { s = (push + yy/k)*exp(-2*0.1*k*x/0.1) - yy/k; if (s < 0) s = 0
            s = (-sigma - xx - s)/push; return s < 0 ? -s : s }
        { e = error($1, $7); if (!(e <= alone)) alone = e; V += $10; sum += $10*$1; x += $10*$7 }
        NR % '$((cells/$2))' == 0 { e = error(sum/V, x/V); if (!(e <= w)) w = e; V = sum = x = 0; sections++ }
        END { print (sections == '$2' ? w + 0 " " alone + 0 : "nan nan") }')
    check "$1: friction column against the closed form, $2 cells along: $section <= 0.01 of the push" below "$section" 0.01
    [ "$1" = quadrilaterals ] || check "$1: friction column, $2 cells along, a cell alone: $alone <= 5/$2 of the push" below "$alone" "$(awk "BEGIN { print 5/$2 }")"
}

both_ways() { # folder: the case small with mechanics equilibrium
    changed "$1"
    equilibrium 'residual 1e-5;'
}
same_mechanics() {
    local name
    for name in T porosity fabricIndex elasticCompression elasticShear1Xy stress nodeDisplacement wallTraction; do
        cmp -s <(field "$1/$name") <(field "$2/$name") || { echo "        $name differs" >&2; return 1; }
    done
}
newton_iterations() { sed -n 's/^Equilibrium: .* solved, \([0-9]*\) iterations.*/\1/p' log | tail -n 1; }
restart_and_processes() { # shape
    both_ways "moved-$1"
    box "$1" '12 6'
    logged msddFoam
    check "$1, equilibrium: every step below its residual" grep -q ' in 0 steps above' log
    rm -rf "$work/moved-$1-half"
    cp -r . "$work/moved-$1-half"
    cd "$work/moved-$1-half"
    rm -rf 1 0.[6-9]* 0.5[1-9]*
    logged msddFoam
    check "$1, equilibrium: restart bit for bit" same_mechanics "$work/moved-$1/1" 1
    local going e
    going=$(newton_iterations)
    cp 1/nodeDisplacement going
    rm -rf 1 0.[6-9]* 0.5[1-9]* 0.5/nodeVelocity
    logged msddFoam -accept '(files)'
    check "$1, equilibrium: where a step does not begin as the last one ended, $(newton_iterations) iterations > $going" \
        [ "$(newton_iterations)" -gt "$going" ]
    e=$(paste -d ' ' <(field going) <(field 1/nodeDisplacement) | awk '
        { for (k = 1; k <= 3; k++) { d = $k - $(k + 3); d *= d; if (!(d <= w)) w = d; if (!($k*$k <= s)) s = $k*$k } } END { print (NR > 50 ? sqrt(w/s) : "nan") }')
    check "$1, equilibrium: and ends within its residual, $e <= 1e-6 of the largest displacement" below "$e" 1e-6
    both_ways "moved-$1-parallel"
    box "$1" '12 6'
    logged decomposePar
    logged mpirun --oversubscribe -np 2 msddFoam -parallel
    logged reconstructPar -latestTime
    e=$(difference "$work/moved-$1/1" 1)
    check "$1, equilibrium: two processes: difference $e <= 1e-7" below "$e" 1e-7
}

no_temporary_files() { # a serial run makes no folder for them, which another one that ends at that moment would remove
    both_ways temporary
    box quadrilaterals '12 6'
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    : > file
    check "equilibrium: a serial run needs no folder for temporary files" \
        env TMPDIR="$PWD/file" sh -c 'msddFoam > log 2>&1 || { tail log >&2; exit 1; }'
}

turned() { # the case rotated by 90 degrees, x' = H - y, y' = x, must give the rotated result
    both_ways moved-turned
    sed -i 's/left/A/; s/right/B/; s/bottom/C/; s/top/D/' 0/T
    sed -i 's/^    A$/    bottom/; s/^    B$/    top/; s/^    C$/    right/; s/^    D$/    left/' 0/T
    fabric_is -0.05
    cat >> system/blockMeshDict <<-'END'
	vertices ((0 0 0) (645 0 0) (645 2150 0) (0 2150 0) (0 0 10) (645 0 10) (645 2150 10) (0 2150 10));
	END
    mesh_is '6 12 1'
    logged msddFoam
    local e
    e=$(awk 'NR == FNR { x[NR - 1] = $1; y[NR - 1] = $2; next }
        { c = FNR - 1; i = c % 6; j = int(c/6); o = j + 12*(5 - i); e = $1 + y[o]; f = $2 - x[o]
          if (e < 0) e = -e; if (f < 0) f = -f; if (!(e <= w)) w = e; if (!(f <= w)) w = f } END { print (FNR == 72 ? w + 0 : "nan") }' \
        <(field "$work/moved-quadrilaterals/1/D") <(field 1/D))
    check "equilibrium: turned by 90 degrees: D differs by $e <= 1e-7 m" below "$e" 1e-7
}

mkdir -p "$work"
library=$(cd "$checkout" && realpath -m "${CARGO_TARGET_DIR:-target}")/release/libmsdd.a
"${CC:-cc}" -std=c99 -Wall -Wextra -Werror -I"$checkout/rust/capi/include" "$here/law.c" "$library" -lpthread -ldl -lm -o "$work/law"
at_rest before 0.05 # grains that slide past each other as soon as they are sheared further: their stress differs much along x and y
at_rest gentle 0.01 # grains that slide only later
patch_test
step_of_temperature
friction_column quadrilaterals 100
friction_column triangles 100
friction_column triangles 200
for shape in $shapes; do restart_and_processes "$shape"; done
no_temporary_files
turned
. "$here/checks/mechanics/walls.sh"
. "$here/checks/mechanics/failure.sh"
. "$here/checks/mechanics/convergence.sh"
