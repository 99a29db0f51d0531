# Grains of spheres that move, in space, in wedges and in the plane: what cells carry against the law itself, which the program
# spheres.c asks; growth in a rigid box and under a given pressure; a wedge compared with the sector in space; restart, processes, heat, grain
# size, gravity, and what is refused.

growth_is() { start_field thermalStrainIncrement '[0 0 0 0 0 0 0]' "$1"; } # growth of the radii, which the first step applies
asked() { "$work/spheres-law" 0.59 5000 5000 5000 0 0 0; } # reads steps, see spheres.c
# Largest difference between the stress of all cells and one of six components xx xy xz yy yz zz (tension positive), over the largest of these
from_stress() { # file, components
    field "$1" | awk -v law="$2" 'BEGIN { split(law, s, " "); for (k = 1; k <= 6; k++) { a = s[k] < 0 ? -s[k] : s[k]; if (a > most) most = a } }
        { for (k = 1; k <= 6; k++) { e = $k - s[k]; if (e < 0) e = -e; if (!(e <= w)) w = e } } END { print (NR > 0 && most > 0 ? w/most : "nan") }'
}
answered() { asked | tail -n 1 | awk '{ printf "%.17g %.17g %.17g %.17g %.17g %.17g\n", -$1, -$4, -$5, -$2, -$6, -$3 }'; } # the stress after these steps, in the order of OpenFOAM
stretched() { # strains along x, y, z: walls that move so that all cells have these strains
    echo "residual 1e-6; walls { \".*\" { type frictionless; } \"high|right\" { type frictionless; displacement constant ($1 0 0); }
        back { type frictionless; displacement constant (0 $2 0); } top { type frictionless; displacement constant (0 0 $3); } }"
}
as_the_law() { # what, strains along x, y, z: one step, after which all cells have the stress of the law
    logged msddFoam
    local e
    e=$(from_stress 1/stress "$(echo 0 "$2" "$3" "$4" 0 0 0 0 0 0 | answered)")
    check "spheres, $1: the stress of all cells is that of the law to $e <= 1e-8" below "$e" 1e-8
}
patch_tests_of_spheres() {
    local walls plane press
    walls=$(stretched -1e-4 5e-5 -3e-4) plane=$(stretched -1e-4 -2e-4 0) press=$(stretched 0 0 -5e-4)
    spheres_bed spheres-hexahedra "$walls"; cube 4; moved_points; as_the_law "hexahedra whose faces are not plane" -1e-4 5e-5 -3e-4
    spheres_bed spheres-tetrahedra "$walls"; awk_mesh tet 3 1; as_the_law "tetrahedra" -1e-4 5e-5 -3e-4
    spheres_bed spheres-polyhedra "$walls"; awk_mesh tet 3 1; logged polyDualMesh 60 -overwrite; as_the_law "polyhedra" -1e-4 5e-5 -3e-4
    spheres_bed spheres-snappy "$walls"; cube 4; snappy; as_the_law "polyhedra of snappyHexMesh" -1e-4 5e-5 -3e-4
    spheres_bed spheres-pressed "$press"; cube 4; as_the_law "uniaxial compression" 0 0 -5e-4
    spheres_bed spheres-plane "${plane/top*\}/\}}"; awk_mesh tri 4 1; patch_type frontAndBack empty; as_the_law "triangles in the plane" -1e-4 -2e-4 0
    # A body of revolution about x: the radius, from 1 to 2, grows by the same strain as the hoops
    spheres_bed spheres-wedge 'residual 1e-4; walls { inner { type displacement; displacement constant (0 -1e-4 0); } outer { type displacement; displacement constant (0 -2e-4 0); } }'
    wedge_mesh 4
    as_the_law "a wedge" 0 -1e-4 -1e-4
}


growth_of_spheres() {
    local e d
    # In a rigid box of irregular cells nothing moves, and all cells go along the isotropic path of the law
    spheres_bed spheres-confined 'walls { ".*" { type frictionless; } }'
    cube 4
    moved_points
    growth_is 4e-4
    logged msddFoam
    e=$(from_stress 1/stress "$(echo 4e-4 0 0 0 0 0 0 0 0 0 | answered)")
    check "spheres that grow in a rigid box: the stress is that of the law to $e <= 1e-10" below "$e" 1e-10
    check "and nothing moves" grep -q 'largest displacement [0-9.]*e-1[0-9] m\|largest displacement 0 m' log
    # Under the pressure of the start they keep their stress, and the bed grows as they do
    spheres_bed spheres-free 'residual 1e-6; walls { "low|front|bottom" { type symmetry; } "high|back|top" { type pressure; pressure constant 5000; } }'
    cube 4
    moved_points
    growth_is 4e-4
    logged msddFoam
    e=$(from_stress 1/stress '-5000 0 0 -5000 0 -5000')
    check "spheres that grow under a given pressure keep it to $e <= 1e-8" below "$e" 1e-8
    d=$(field 1/nodeDisplacement | awk '{ for (k = 1; k <= 3; k++) if ($k > w) w = $k } END { print w/4e-4 - 1 }')
    check "and the bed grows by as much as the spheres: relative difference $d, at most 1e-6" is_within "$d" -1e-6 1e-6
}

# Grains that yield at the top of a box of 1 m: as if 50 diameters of bed, 0.1 m, were beyond it. A lid that moves by -3e-4 m strains
# the bed by -3e-4/1.1; on its way back by 2e-4 m, of which 0.1 goes back there, by 2e-4/1.01; and growth in a rigid box lets the
# bed grow by a tenth of what it is pressed. The solver finds what the grains give to a thousandth.
giving_is() { # what, time, displacement of the top, largest error
    local e
    e=$(field "$2/nodeDisplacement" | awk -v d="$3" '{ if ($3*$3 > w*w) w = $3 } END { e = w/d - 1; print e < 0 ? -e : e }')
    check "grains that give way, $1: the bed follows by $3 m, to $e <= $4" below "$e" "$4"
}
walls_that_give() {
    spheres_bed spheres-giving 'walls { ".*" { type frictionless; } top { type frictionless; slackLayer 50; displacement table ((0 (0 0 0)) (1 (0 0 -3e-4)) (2 (0 0 -1e-4))); } }'
    cube 4
    moved_points
    controls 'endTime 2;'
    logged msddFoam
    giving_is "lid moves" 1 "$(awk 'BEGIN { printf "%.9g", -3e-4/1.1 }')" 1e-4
    giving_is "lid goes back" 2 "$(awk 'BEGIN { printf "%.9g", -3e-4/1.1 + 2e-4/1.01 }')" 1e-4
    cp 2/nodeDisplacement whole-nodeDisplacement
    cp 2/wallGive whole-wallGive
    # The same in four processes, whose borders cross the lid and lie below it
    cat > system/decomposeParDict <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
	numberOfSubdomains 4; method hierarchical; hierarchicalCoeffs { n (2 1 2); delta 0.001; order xyz; }
	END
    rm -r 1 2
    logged decomposePar
    side_by_side 4
    logged reconstructPar
    local name e
    for name in nodeDisplacement wallGive; do
        e=$(paste -d ' ' <(field 2/$name) <(field whole-$name) | awk '{ for (i = 1; i <= 3; i++) { e = $i - $(i + 3); if (e < 0) e = -e
            a = $i < 0 ? -$i : $i; if (a > m) m = a; if (!(e <= w)) w = e } } END { print (NR > 3 && m > 0 ? w/m : "nan") }')
        check "grains that give way, four processes: $name differs by $e <= 1e-3 of the largest" below "$e" 1e-3
    done
    spheres_bed spheres-giving-grown 'walls { ".*" { type frictionless; } top { type frictionless; slackLayer 50; } }'
    cube 4
    growth_is 4e-4
    logged msddFoam
    giving_is "spheres grow" 1 "$(awk 'BEGIN { printf "%.9g", 0.1*4e-4/1.1 }')" 1e-3
}

# A column of 1 m under its weight: 2500*0.59 kg/m3, 9.81 m/s2. Stress over that of the closed form at the bottom.
from_weight() { # component of the position, of the stress along it; density: largest error of the vertical stress, over that at the bottom
    paste -d ' ' <(field 0/C) <(field 1/stress) | awk -v x="$1" -v s="$2" -v full="$(awk "BEGIN { printf \"%.17g\", $3*9.81 }")" '
        { e = $(3 + s) + full*(1 - $x); if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR > 3 ? w/full : "nan") }'
}
column_walls='walls { ".*" { type frictionless; } "top|outer" { type pressure; pressure constant 0; } }'
weights() {
    local e
    spheres_bed spheres-at-rest "$column_walls"
    rm 0/stress
    grains 'restStress { lateral 0.7; }'
    gravity_is '0 0 -9.81'
    cube 6
    cell_geometry
    logged msddFoam
    e=$(from_weight 3 6 "2500*0.59")
    check "a column at rest stays so: vertical stress differs from the closed form by $e <= 1e-10" below "$e" 1e-10
    e=$(field 1/stress | awk '{ e = $1/$6 - 0.7; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print w }')
    check "with the lateral stress that was given, to $e <= 1e-10" below "$e" 1e-10
    # From a uniform stress the bed finds its rest by itself
    spheres_bed spheres-settling "residual 1e-2; $column_walls"
    gravity_is '0 0 -9.81'
    cube 6
    cell_geometry
    logged msddFoam
    e=$(from_weight 3 6 "2500*0.59")
    check "a column from uniform stress: vertical stress differs from the closed form by $e <= 1e-5" below "$e" 1e-5
    # The same for a hollow cylinder with its axis upright, as a wedge, and for discs in the plane
    spheres_bed spheres-upright "walls { \"inner|outer|low\" { type frictionless; } top { type pressure; pressure constant 0; } }"
    rm 0/stress
    grains 'restStress { lateral 0.7; }'
    gravity_is '-9.81 0 0'
    wedge_mesh 4
    sed -i 's/ends { type symmetry; faces ((0 4 7 3) (1 2 6 5)); }/low { type wall; faces ((0 4 7 3)); } top { type wall; faces ((1 2 6 5)); }/' \
        system/blockMeshDict
    logged blockMesh
    cell_geometry
    logged msddFoam
    e=$(from_weight 1 1 "2500*0.59")
    check "a wedge with its axis upright stays at rest: vertical stress differs from the closed form by $e <= 1e-10" below "$e" 1e-10
    changed discs-at-rest
    sed -i 's/fixedValue;/zeroGradient;/; /value /d' 0/T
    grains 'density 300; thermalExpansion 0; restStress { lateral 0.8; } mechanics equilibrium;
        equilibriumCoeffs { residual 1e-6; walls { ".*" { type frictionless; } top { type pressure; pressure constant 0; } } }'
    gravity_is '0 -9.81 0'
    box quadrilaterals '4 6'
    cell_geometry
    controls 'endTime 0.05; writeInterval 1; writePrecision 17;'
    logged msddFoam
    e=$(paste -d ' ' <(field 0/C) <(field 0.05/stress) | awk -v bulk="$(field 0.05/bulkDensity | head -n 1)" '{ e = $7 + bulk*9.81*(0.645 - $2); if (e < 0) e = -e; if (!(e <= w)) w = e
        f = bulk*9.81*0.645 } END { print (NR > 3 ? w/f : "nan") }')
    check "discs at rest under their weight: vertical stress differs from the closed form by $e <= 1e-6" below "$e" 1e-6
    spheres_bed spheres-wedge-weight "walls { \"inner|outer\" { type frictionless; } }"
    gravity_is '0 0 -9.81'
    wedge_mesh 4
    check "refused: gravity across the axis of a wedge" refused 'allowed in a wedge: along its axis'
    spheres_bed spheres-both "$column_walls"
    grains 'restStress { lateral 0.5; }'
    gravity_is '0 0 -9.81'
    cube 2
    check "refused: restStress together with the field stress" refused "Entry 'restStress' is given together with the field stress"
    rm constant/g
    check "refused: restStress without gravity" refused "Entry 'restStress' needs gravity"
    gravity_is '0 0 -9.81'
    sed -i 's/0 1 -2 0 0 0 0/0 1 -1 0 0 0 0/' constant/g
    check "refused: gravity with other dimensions" refused 'allowed: a vector shorter than 1e6'
}

# A compliant wall is at rest under what it carries at the start, by the weight of the bed or without, also where a lid meets it. Then
# the whole bed is pressed by 2 kPa more.
resting_shell() { # folder, what, pressure on the lid [Pa]
    local e
    spheres_bed "shell-at-rest-$1" 'residual 1e-4; walls { ".*" { type frictionless; }
        high { type shell; youngModulus 2e8; thickness 3e-3; radius 1; } top { type pressure; pressure table ((1 '"$3"') (2 '"$(($3 + 2000))"')); } }'
    if [ "$1" = weight ]; then
        rm 0/stress
        grains 'restStress { lateral 0.7; }'
        gravity_is '0 0 -9.81'
    fi
    cube 4
    controls 'endTime 2;'
    logged msddFoam
    e=$(field 1/nodeDisplacement | awk '{ for (k = 1; k <= 3; k++) { e = $k < 0 ? -$k : $k; if (!(e <= w)) w = e } } END { print (NR ? w + 0 : "nan") }')
    check "a shell under $2 stays at rest: it moves by $e <= 1e-9 m" below "$e" 1e-9
    e=$(field 2/nodeDisplacement | awk '{ if ($1 > w) w = $1 } END { print w }')
    check "and yields under more: $e m, from 1e-4 to 4e-3" awk "BEGIN { exit !($e > 1e-4 && $e < 4e-3) }"
}
resting_shells() {
    resting_shell weight "the weight of the bed" 0
    resting_shell lid "a lid" 5000
}

# A hollow cylinder, from radius 1 to 2 m, is heated from within for a day, in a rigid ring and with a given pressure inside: as a wedge
# and as a quarter in space. Rows: for each radius T and the stress along the radius, the hoop and the axis.
hollow() { # folder, mesh
    spheres_bed "$1" 'residual 1e-2; walls { ".*" { type rigid; } inner { type pressure; pressure constant 5000; } }'
    hot_wall inner 340
    hot_wall outer 300
    "$2" 16
    if [ "$2" = ring_mesh ]; then
        sed -i 's/type empty/type wall/' system/blockMeshDict
        logged blockMesh
    fi
    controls 'endTime 8e4; deltaT 2e4; writeInterval 4;'
    cell_geometry
    logged msddFoam
}
by_radius() { # awk expressions of the index of the radius and of cosine and sine of the angle: means over the cells of a radius
    paste -d ' ' <(field 0/C) <(field 80000/T) <(field 80000/stress) | awk '
        { i = '"$1"'; r = sqrt($1*$1 + $2*$2); c = '"$2"'; s = '"$3"'; n[i]++; T[i] += $4; rr[i] += c*c*$5 + 2*c*s*$6 + s*s*$8
          tt[i] += '"$4"'; zz[i] += '"$5"' } END { for (i = 0; i < 16; i++) print T[i]/n[i], rr[i]/n[i], tt[i]/n[i], zz[i]/n[i] }'
}
wedge_and_sector() {
    local e
    hollow spheres-sector ring_mesh
    by_radius '(NR - 1) % 16' '$1/r' '$2/r' 's*s*$5 - 2*c*s*$6 + c*c*$8' '$10' > rows
    hollow spheres-hollow-wedge wedge_mesh
    by_radius 'int((NR - 1)/4)' 0 1 '$10' '$5' > rows
    e=$(paste -d ' ' rows ../spheres-sector/rows | awk '{ for (k = 1; k <= 4; k++) { e = $k - $(k + 4); if (e < 0) e = -e; if (!(e <= w[k])) w[k] = e
        a = $k < 0 ? -$k : $k; if (a > most[k > 1]) most[k > 1] = a } }
        END { most[0] = 40; for (k = 1; k <= 4; k++) { e = w[k]/most[k > 1]; if (!(e <= all)) all = e } print (NR == 16 ? all : "nan") }')
    check "a heated hollow cylinder as a wedge and as a quarter in space: T and stress differ by $e <= 3e-3 of their largest" below "$e" 3e-3
    e=$(awk 'NR == 1 { print -$3/5000 }' rows)
    check "its hoops are pressed $e times as much as at the start, at least 1.3" below 1.3 "$e"
}

hot_column() { # folder, size of the spheres [m]: a column under its weight and a load that grows, heated from above; the floor gives by 0.02 m of bed
    spheres_bed "$1" 'walls { ".*" { type frictionless; } bottom { type frictionless; slackLayer '"$(awk "BEGIN { print 0.01/$2 }")"'; } top { type pressure; pressure table ((0 5000) (8e4 20000)); } }'
    sed -i "s/meanRadius 1e-3/meanRadius $2/; s/gas air/gas vacuum/" constant/granularProperties
    gravity_is '0 0 -9.81'
    hot_wall top 340
    cube 5
    moved_points
    controls 'endTime 8e4; deltaT 2e4; writeInterval 2; startFrom latestTime; functions { #include "'"$here"'/audits" }'
    sed -i '/subRegions/d' system/controlDict
}
apart_by() { # name of a field, another folder: largest difference of the components, over the largest of them
    paste -d ' ' <(field "80000/$1") <(field "$2/80000/$1") | awk '{ for (i = 1; i <= NF/2; i++) { e = $i - $(i + NF/2); if (e < 0) e = -e
        a = $i < 0 ? -$i : $i; if (a > m) m = a; if (!(e <= w)) w = e } } END { print (NR > 3 && m > 0 ? w/m : "nan") }'
}
same_spheres() {
    local name
    for name in T porosity conductivity stress elasticCompression nodeDisplacement wallGive; do
        [ -n "$(field "$1/$name")" ] && cmp -s <(field "$1/$name") <(field "$2/$name") || { echo "        $name differs" >&2; return 1; }
    done
}
again_and_in_parts_in_space() {
    local e name
    hot_column spheres-column 1e-3
    logged msddFoam
    check "a heated column: every step below its residual" grep -q ' in 0 steps above' log
    e=$(awk '!/^#/ { if ($6 > w) w = $6; n++ } END { print (n ? w + 0 : "nan") }' postProcessing/heatAudit/0/heatAudit.dat)
    check "its heat balance closes to $e <= 1e-9" below "$e" 1e-9
    e=$(awk '!/^#/ { if ($4 > w) w = $4; n++ } END { print (n ? w + 0 : "nan") }' postProcessing/massAudit/0/massAudit.dat)
    check "its mass closes to $e <= 1e-12" below "$e" 1e-12
    rm -rf ../spheres-column-again
    cp -r . ../spheres-column-again
    cd ../spheres-column-again
    rm -rf 80000
    logged msddFoam
    check "restart bit for bit" same_spheres 80000 ../spheres-column/80000
    hot_column spheres-column-parallel 1e-3
    cat > system/decomposeParDict <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
	numberOfSubdomains 3; method hierarchical; hierarchicalCoeffs { n (3 1 1); delta 0.001; order xyz; }
	END
    logged decomposePar
    side_by_side 3
    logged reconstructPar
    # Both end below the residual, 1e-3 of the pressure
    for name in T stress; do
        e=$(apart_by $name ../spheres-column)
        check "three processes: $name differs by $e <= 1e-3" below "$e" 1e-3
    done
    hot_column spheres-column-fine 1e-5
    logged msddFoam
    for name in stress conductivity nodeDisplacement; do
        e=$(apart_by $name ../spheres-column)
        check "spheres of 20 um instead of 2 mm: $name differs by $e <= 1e-9" below "$e" 1e-9
    done
    check "and they moved" grep -q 'Equilibrium: 4 of 4 steps solved' log
}
mkdir -p "$work"
library=$(cd "$checkout" && realpath -m "${CARGO_TARGET_DIR:-target}")/release/libmsdd.a
"${CC:-cc}" -std=c99 -Wall -Wextra -Werror -I"$checkout/rust/capi/include" "$here/spheres.c" "$library" -lpthread -ldl -lm -o "$work/spheres-law"
patch_tests_of_spheres
growth_of_spheres
walls_that_give
weights
resting_shells
wedge_and_sector
again_and_in_parts_in_space
