# Walls that meet at sharp edges or are curved: a closed bed between smooth rigid walls, whose grains grow equally everywhere from an
# isotropic stress, stays in equilibrium. Nothing moves, and the pressure is that of one cell, whatever the shape of the walls, the
# size of their faces and the number of processes. What is refused and warned of in 'walls'.

grown_bed() { # folder, walls: not meshed; grains of 300 K and 5 kPa whose radii grow by 1e-4 in one step
    spheres_bed "$1" "residual 1e-3; walls { $2 }"
    start_field thermalStrainIncrement '[0 0 0 0 0 0 0]' 1e-4
}
smooth='".*" { type frictionless; }'
sheared_cube() { # angle: cells of a cube that leans, whose edges have 90 degrees less and more this angle
    cube 3
    awk -v t="$(awk "BEGIN { a = $1*atan2(0, -1)/180; printf \"%.17g\", sin(a)/cos(a) }")" \
        '/^\(/ && NF == 3 { gsub(/[()]/, ""); printf "(%.17g %s %s)\n", $1 + t*$3, $2, $3; next } { print }' constant/polyMesh/points > points.new
    mv points.new constant/polyMesh/points
}
other_faces_are_walls() { # those that blockMesh takes as empty
    patch_type defaultFaces wall
    sed -i '/inGroups/d' constant/polyMesh/boundary
}
# A prism or, with a smaller top, a cone of blocks around its axis. The first angle between its corners is more than the second
pillar() { # corners (even), first angle less the second [degrees], radius of the top, cells along a side, edges: arc or none
    local geometry vertices blocks edges faces
    geometry=$(awk -v n="$1" -v d="$2" -v top="$3" -v m="$4" -v round="$5" 'BEGIN {
        pi = atan2(0, -1); v = "(0 0 0) "; w = "(0 0 1) "
        for (i = 0; i < n; i++) { a[i] = 2*pi*i/n + (i % 2)*d/2*pi/180
            v = v sprintf("(%.17g %.17g 0) ", cos(a[i]), sin(a[i])); w = w sprintf("(%.17g %.17g 1) ", top*cos(a[i]), top*sin(a[i])) }
        print v w
        for (k = 0; k < n; k += 2) { p = k + 1; q = k + 2; r = (k + 2) % n + 1
            b = b sprintf("hex (0 %d %d %d %d %d %d %d) (%d %d 2) simpleGrading (0.5 0.5 1) ", p, q, r, n + 1, n + 1 + p, n + 1 + q, n + 1 + r, m, m)
            f = f sprintf("(%d %d %d %d) (%d %d %d %d) ", p, q, n + 1 + q, n + 1 + p, q, r, n + 1 + r, n + 1 + q) }
        print b
        for (i = 0; i < n && round == "arc"; i++) { j = (i + 1) % n; c = a[i] + (j ? a[j] - a[i] : 2*pi - a[i])/2
            e = e sprintf("arc %d %d (%.17g %.17g 0) arc %d %d (%.17g %.17g 1) ", i + 1, j + 1, cos(c), sin(c), n + 2 + i, n + 2 + j, top*cos(c), top*sin(c)) }
        print e; print f }')
    { read -r vertices; read -r blocks; read -r edges; read -r faces; } <<< "$geometry"
    block_mesh "$vertices" "$blocks" "$edges" "side { type wall; faces ($faces); }"
    other_faces_are_walls
}
ball() { # hexahedra or tetrahedra of a cube that is blown up to a ball: faces of unequal sizes
    if [ "$1" = tetrahedra ]; then awk_mesh tet 4 1; else cube 4; fi
    awk '/^\(/ && NF == 3 { gsub(/[()]/, ""); m = r = 0; for (k = 1; k <= 3; k++) { x = 2*$k - 1; r += x*x; if (x < 0) x = -x; if (x > m) m = x }
            s = r > 0 ? m/sqrt(r) : 1; printf "(%.17g %.17g %.17g)\n", s*(2*$1 - 1), s*(2*$2 - 1), s*(2*$3 - 1); next } { print }' constant/polyMesh/points > points.new
    mv points.new constant/polyMesh/points
}
plane_corners() { # a rhomboid of one layer with corners of 30 and 150 degrees
    block_mesh '(0 0 0) (1 0 0) (1.8660254037844386 0.5 0) (0.8660254037844386 0.5 0) (0 0 0.1) (1 0 0.1) (1.8660254037844386 0.5 0.1) (0.8660254037844386 0.5 0.1)' \
        'hex (0 1 2 3 4 5 6 7) (4 3 1) simpleGrading (1 3 1)' '' 'frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }'
    other_faces_are_walls
}
hopper_wedge() { # the walls of a hopper in a wedge: angles of 27 and 153 degrees at its rim
    local t vertices
    t=0.043633231299858237
    vertices=$(awk -v t=$t 'BEGIN { split("0 0 1 0 3 1 2 1", v, " "); for (i = 1; i < 8; i += 2) printf "(%d %.17g %.17g) ", v[i], v[i + 1]*cos(t), -v[i + 1]*sin(t)
        for (i = 5; i < 8; i += 2) printf "(%d %.17g %.17g) ", v[i], v[i + 1]*cos(t), v[i + 1]*sin(t) }')
    block_mesh "$vertices" 'hex (0 1 2 3 0 1 4 5) (3 4 1) simpleGrading (1 2 1)' '' 'front { type wedge; faces ((0 1 2 3)); } back { type wedge; faces ((0 1 4 5)); }
        side { type wall; faces ((3 2 4 5)); } ends { type wall; faces ((0 3 5 0) (1 2 4 1)); }'
}
unequal() { # folder of the result, pressure: largest difference of the stress of all cells from this pressure, over it
    field "$1/stress" | awk -v p="$2" '{ for (k = 1; k <= 6; k++) { e = $k/p + (k == 1 || k == 4 || k == 6); if (e < 0) e = -e; if (!(e <= w)) w = e } } END { print (NR && p > 0 ? w + 0 : "nan") }'
}
still() { # what, pressure: the stress of the case that was run
    local e
    e=$(unequal 1 "$2")
    check "closed bed, $1: the stress is that of one cell to $e <= 1e-6" below "$e" 1e-6
}
closed_beds() {
    local angle kind p
    grown_bed walls-one "$smooth"
    cube 1
    logged msddFoam
    p=$(field 1/pressure | head -1)
    check "the growth of the grains raises the pressure from 5000 to $p Pa" is_within "$p" 6000 500000
    for angle in 30 44 46 60 80; do
        grown_bed walls-sheared "$smooth"
        sheared_cube $angle
        logged msddFoam
        still "edges of $((90 - angle)) and $((90 + angle)) degrees" "$p"
    done
    for kind in '8 0 1 1 none' '8 20 1 2 none' '12 0 1 2 none' '12 30 1 2 none' '8 10 1 3 arc' '12 20 0.3 2 none'; do
        grown_bed walls-pillar "$smooth"
        pillar $kind
        logged msddFoam
        still "pillar of $kind (corners, unequal by, top, cells on a side, edges)" "$p"
    done
    for kind in hexahedra tetrahedra; do
        grown_bed "walls-$kind" '".*" { type rigid; friction 0.3; slip 1e-6; }'
        ball $kind
        logged msddFoam
        still "ball of $kind, rough" "$p"
    done
    in_three_parts
    still "ball of tetrahedra on three processes" "$p"
    for kind in plane_corners hopper_wedge; do
        grown_bed "walls-$kind" "$smooth"
        $kind
        logged msddFoam
        still "$kind" "$p"
    done
    moved_ball "$p"
}
# Nodes slide along the planes that touch the wall at the start, so that a round bed which turns would grow and lose its load: it must not
round_vessel() { # mesh, its arguments: a smooth round bed that is heated inside and cooled at its walls
    local turn p
    spheres_bed walls-round "walls { $smooth }"
    sed -i 's/zeroGradient/fixedValue; value uniform 300/' 0/T
    echo 'heat { type scalarSemiImplicitSource; selectionMode all; volumeMode specific; injectionRateSuSp { T (3000 0); } }' > constant/fvOptions
    sed -i '1i FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }' constant/fvOptions
    controls 'endTime 1e6; deltaT 2e4; writeInterval 50;'
    "$@"
    cell_geometry
    logged msddFoam
    turn=$(paste -d ' ' <(field 0/C) <(field 1e+06/D) | awk '{ t = ($5*$1 - $4*$2)/($1*$1 + $2*$2); s += t; n++ } END { s /= n; print (n ? (s < 0 ? -s : s) : "nan") }')
    p=$(field 1e+06/pressure | awk 'NR == 1 || $1 < least { least = $1 } END { print least }')
    check "smooth round bed, $*: it turns by $turn <= 1e-3" below "$turn" 1e-3
    check "and all of it carries load, at least $p Pa" is_within "$p" 1e4 1e9
}
in_three_parts() { # the ball of tetrahedra
    rm -rf "$work/walls-parts"
    cp -r "$work/walls-tetrahedra" "$work/walls-parts"
    cd "$work/walls-parts"
    rm -rf 1
    cat > system/decomposeParDict <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
	numberOfSubdomains 3; method hierarchical; hierarchicalCoeffs { n (3 1 1); delta 0.001; order xyz; }
	END
    logged decomposePar
    side_by_side 3
    logged reconstructPar
}
moved_ball() { # pressure: walls that move as one take the bed with them
    local e
    grown_bed walls-moved '".*" { type frictionless; displacement constant (0.01 -0.02 0.005); }'
    sed -i 's/residual 1e-3/residual 1e-5/' constant/granularProperties
    ball hexahedra
    logged msddFoam
    still "ball that moves" "$1"
    e=$(field 1/D | awk '{ e = $1 - 0.01; f = $2 + 0.02; g = $3 - 0.005; e = sqrt(e*e + f*f + g*g); if (!(e <= w)) w = e } END { print (NR ? w + 0 : "nan") }')
    check "and its grains move with it, to $e <= 1e-8 m" below "$e" 1e-8
}
elastic_corners() { # mesh, arguments: a body heated by a source between smooth walls, whose stress has a closed form. It follows T by one step
    local e
    solid "walls-elastic" 'residual 1e-6; walls { ".*" { type frictionless; } }'
    controls 'endTime 2; deltaT 1; writeInterval 1;'
    cat > constant/fvOptions <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }
	heat { type scalarSemiImplicitSource; selectionMode all; volumeMode specific; injectionRateSuSp { T (25.2 0); } }
	END
    "$@"
    logged msddFoam
    e=$(unequal 2 "$(field 1/T | awk 'NR == 1 { print $1*1e-6*1e7/(1 - 2*0.3) }')")
    check "closed elastic body, $*: the stress is 3 K alpha dT to $e <= 1e-6" below "$e" 1e-6
}
disc_corners() { # discs in the plane
    local e
    changed walls-discs
    start_field T '[0 0 0 1 0 0 0]' 50
    start_field porosity '[0 0 0 0 0 0 0]' 0.125
    start_field fabricIndex '[0 0 0 0 0 0 0]' 0
    start_field thermalStrainIncrement '[0 0 0 0 0 0 0]' 1e-3
    grains 'mechanics equilibrium; equilibriumCoeffs { wallCompliance 0; walls { ".*" { type frictionless; } } }'
    controls 'endTime 0.05;'
    plane_corners
    logged msddFoam
    e=$(field 0.05/stress | awk 'NR == 1 { p = -$1 } { e = -$1/p - 1; f = -$4/p - 1; g = $2/p; if (e < 0) e = -e; if (f < 0) f = -f; if (g < 0) g = -g
        if (!(e <= w)) w = e; if (!(f <= w)) w = f; if (!(g <= w)) w = g } END { print (NR && p > 1000 ? w + 0 : "nan") }')
    check "closed bed of discs with corners of 30 degrees: the stress is uniform to $e <= 1e-6" below "$e" 1e-6
}
judged_shells() { # warnings of shells that are not as round as they say; a piston that is round
    local shell='type shell; youngModulus 2e11; thickness 1e-3'
    grown_bed walls-shell "side { $shell; radius 1; } \".*\" { type frictionless; }"
    pillar 8 10 1 3 arc
    logged msddFoam
    check "a shell as round as its radius: no warning" bash -c '! grep -q "is a shell with radius" log'
    rm -rf 1
    sed -i 's/radius 1;/radius 5;/' constant/granularProperties
    logged msddFoam
    check "a shell with five times the radius of its patch: a warning" grep -q 'Patch side is a shell with radius 5 m, but its faces have a radius of 0.9' log
    grown_bed walls-shell "high { $shell; radius 0.05; } \".*\" { type frictionless; }"
    cube 2
    logged msddFoam
    check "a shell that is flat: a warning" grep -q 'Patch high is a shell with radius 0.05 m, but is flat in the mesh' log
    grown_bed walls-piston 'outer { type piston; pressure constant 5000; } ".*" { type frictionless; }'
    wedge_mesh 2
    check "refused: a piston on the side of a wedge" refused 'is a piston but not flat'
}
elastic_spheres() {
    spheres_bed walls-elastic "law elastic; elasticCoeffs { youngModulus 1e7; poissonRatio 0.3; } walls { $smooth }"
    cube 1
    check "refused: law elastic with spheres" refused "Entry 'law' is elastic with surrogate type spheres, allowed: type constant"
}
doubtful_starts() { # warnings of what no bed under load has at the start
    grown_bed walls-start "$smooth"
    wedge_mesh 2
    logged msddFoam
    check "a start without a warning: no warning" bash -c '! grep -q "FOAM Warning" log'
    rm -rf 1
    sed -i 's/(-5000 0 0 /(-5000 0 3000 /' 0/stress
    sed -i 's/gas air;/gas air; coordination 12;/' constant/granularProperties
    logged msddFoam
    check "shear out of the plane of a wedge: a warning" bash -c "tr -s ' \n' ' ' < log | grep -q 'shear out of the plane of the mesh (xz, yz) of up to 3000 Pa'"
    check "12 contacts per sphere: a warning" bash -c "tr -s ' \n' ' ' < log | grep -q 'is 12: random packings under load have from 2 to 9'"
}

left_bed() { # folder, hexahedra along z: a closed bed under its weight is cooled and warmed up again, so slowly that it has one temperature
    spheres_bed "$1" "walls { $smooth }"
    block_mesh '(0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1)' "hex (0 1 2 3 4 5 6 7) (2 2 $2) simpleGrading (1 1 1)" '' '
        top { type wall; faces ((4 5 6 7)); } bottom { type wall; faces ((0 3 2 1)); }
        sides { type wall; faces ((0 1 5 4) (3 7 6 2) (0 4 7 3) (1 2 6 5)); }'
    cat > constant/g <<-'END'
	FoamFile { version 2.0; format ascii; class uniformDimensionedVectorField; object g; }
	dimensions [0 1 -2 0 0 0 0]; value (0 0 -2);
	END
    sed -i 's/type zeroGradient;/type uniformFixedValue; uniformValue table ((0 300) (8 220) (16 300));/' 0/T
    sed -i 's/heatCapacity 800/heatCapacity 1e-6/' constant/granularProperties
    sed -i 's/^endTime 1; deltaT 1; writeInterval 1;/endTime 16; deltaT 1; writeInterval 8;/' system/controlDict
}
left_lid() { # the lid carries nothing while it is cold, the floor the weight, and no cell is without load
    local gap finer least floor
    left_bed walls-left 4
    logged msddFoam
    gap=$(sed -n 's/.*they left walls, by at most \([^ ]*\) mm.*/\1/p' log)
    least=$(field 8/pressure | awk '{ if (NR == 1 || $1 < p) p = $1 } END { print p }')
    check "cold spheres leave the lid by $gap mm" is_within "$gap" 0.3 3
    check "and the highest cells bear their own weight, $least Pa" is_within "$least" 100 400
    floor=$(field 8/stress | head -n 4 | awk '{ p -= $6/4 } END { print p }')
    check "the lowest cells bear $floor Pa along z, 7/8 of the weight (2581 Pa)" is_within "$floor" 2570 2592
    left_bed walls-left-fine 8
    logged msddFoam
    finer=$(sed -n 's/.*they left walls, by at most \([^ ]*\) mm.*/\1/p' log)
    check "with twice the cells by $finer mm" is_within "$(awk "BEGIN { print $finer/$gap }")" 0.95 1.05
    left_bed walls-left-half 4
    sed -i 's/endTime 16/endTime 8/' system/controlDict
    logged msddFoam
    sed -i 's/endTime 8/endTime 16/; s/^FoamFile.*/&\nstartFrom latestTime;/' system/controlDict
    logged msddFoam
    check "a run that begins with the gap ends as one without a stop" below "$(difference 16 ../walls-left/16)" 1e-6
    left_bed walls-left-parts 4
    in_parts "1 3"
    side_by_side 3
    check "and so do three processes" grep -q "they left walls, by at most $gap mm" log
}

closed_beds
round_vessel pillar 16 10 1 3 arc
round_vessel ball tetrahedra
elastic_corners sheared_cube 80
elastic_corners ball hexahedra
elastic_corners plane_corners
disc_corners
judged_shells
elastic_spheres
doubtful_starts
