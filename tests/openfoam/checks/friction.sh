# Friction of walls in space, where it is a vector along the wall: a plate that slides under a body, along lines, around a corner and in
# a circle; a column between rough walls in space compared with the same in the plane; Janssen's equation in a square silo; a hollow cylinder compared with a wedge; a silo that is
# turned about its axis; three processes, restart, and what is refused.

# A stiff body, pressed by some 10 kPa onto a plate that slides under it; its own motion along the plate, some 1e-7 m, is small compared with
# the slip of 1 m at which half of the friction is mobilised.
slid() { # folder, positions "x y" of the plate: one at each second from 2 on; prints the mobilised share of the friction at each, x y
    local at time second=1 table='(0 (0 0 0)) (1 (0 0 0))'
    for at in "${@:2}"; do
        second=$((second + 1))
        table+=" ($second ($at 0))"
    done
    solid "$1" "residual 5e-3; walls { \".*\" { type pressure; pressure constant 0; }
        top { type displacement; displacement table ((0 (0 0 0)) (1 (0 0 -1e-7))); }
        bottom { type rigid; friction 0.4; slip 1; displacement table ($table); } }"
    sed -i 's/youngModulus 1e7;/youngModulus 1e11;/g' constant/granularProperties
    controls "endTime $second; deltaT 1; writeInterval 1;"
    cube 1
    logged msddFoam
    for time in $(seq 2 $second); do
        field "$time/wallTraction" | awk -v stress="$(field "$time/stress")" 'NR == 1 { x = $1; y = $2; split(stress, s, " "); most = -0.4*s[6] }
            NR < 5 { if ($1 - x > 1e-6*most || x - $1 > 1e-6*most || $2 - y > 1e-6*most || y - $2 > 1e-6*most) x = "nan" }
            END { print (NR == 8 && most > 2000 ? x/most " " y/most : "nan nan") }' OFMT=%.12g CONVFMT=%.12g
    done
}
along_a_line() { # direction x y: the share of each position must be that of the closed form
    local position positions=() e
    for position in 0.5 3 2.9 0 3; do positions+=("$(awk "BEGIN { printf \"%.17g %.17g\", $1*$position, $2*$position }")"); done
    e=$(slid "slid-$1-$2" "${positions[@]}" | awk -v x="$1" -v y="$2" '
        function size(a) { return a < 0 ? -a : a }
        BEGIN { split("0.5 3 2.9 0 3", at, " ") }
        { slip = at[NR] - at[NR - 1] # 1 m mobilises half; friction drags the body along
          if (m*slip < 0) { back = size(m) < size(slip) ? size(m) : size(slip); if (slip < 0) back = -back; m += back; slip -= back }
          if (slip != 0) { virgin = size(m)/(1 - size(m)) + size(slip); m = (slip < 0 ? -1 : 1)*virgin/(virgin + 1) }
          e = size($1 - m*x) + size($2 - m*y); if (!(e <= w)) w = e } END { print (NR == 5 ? w : "nan") }')
    check "a plate slides to and fro along ($1 $2): friction differs from the closed form by $e <= 1e-6 of its largest" below "$e" 1e-6
}
around() { # a corner, a way back at an angle, and a circle
    local e
    # (0.75 0) and the slip of 1 m make a vector of (0.75 1); its length of 1.25 is 0.5 beyond 0.75, at which 3 m had been slipped
    e=$(slid slid-corner "3 0" "3 1" | awk 'END { m = 3.5/4.5; e = $1 - m*0.75/1.25; f = $2 - m*1/1.25; if (e < 0) e = -e; if (f < 0) f = -f; print e + f }')
    check "around a corner it turns: differs by $e <= 1e-6" below "$e" 1e-6
    # Back by (-1 1) from (0.75 0): unloads to (0.375 0.375), which is at right angles to the slip, and goes on from there to (-0.25 1)
    e=$(slid slid-back "3 0" "2 1" | awk 'END { r = sqrt(2)*0.375; T = sqrt(0.25^2 + 1); v = T - r + r/(1 - r); m = v/(1 + v); e = $1 + m*0.25/T; f = $2 - m/T
        if (e < 0) e = -e; if (f < 0) f = -f; print e + f }')
    check "and on a way back: differs by $e <= 1e-6" below "$e" 1e-6
    local positions=()
    for e in $(seq 1 48); do positions+=("$(awk "BEGIN { t = 2*atan2(0, -1)*$e/16; printf \"%.17g %.17g\", 2*sin(t), 2 - 2*cos(t) }")"); done
    slid slid-circle "${positions[@]}" > "$work/shares"
    e=$(awk '{ m = sqrt($1*$1 + $2*$2); if (!(m <= w)) w = m } END { print (NR == 48 ? w : "nan") }' "$work/shares")
    check "three times around a circle it is $e of the largest friction, 0.8 to 1" is_within "$e" 0.8 0.99999
    e=$(awk 'BEGIN { pi = atan2(0, -1) } NR > 16 { t = 2*pi*(NR - 0.5)/16; a = atan2($1*sin(t) - $2*cos(t), $1*cos(t) + $2*sin(t)); if (a < least || NR == 17) least = a
        if (a > most || NR == 17) most = a } END { print least, most }' "$work/shares")
    check "and lags behind the way by ${e% *} to ${e#* }, from 0.4 to 0.55 (the arcsine of its share over the radius of 2)" awk "BEGIN { split(\"$e\", a, \" \"); exit !(a[1] > 0.4 && a[2] < 0.55) }"
}

# A column of spheres between rough walls that a piston presses. Cells whose depth is the square root of 8 times their width resist the
# hourglass in space as squares do in the plane, so that both must agree to the residual.
upright_mesh() { # layers, depth [m], kind of the patches in front and behind
    block_mesh "(0 0 0) (0.4 0 0) (0.4 1 0) (0 1 0) (0 0 $2) (0.4 0 $2) (0.4 1 $2) (0 1 $2)" "hex (0 1 2 3 4 5 6 7) (4 10 $1) simpleGrading (1 1 1)" '' "
        left { type wall; faces ((0 4 7 3)); } right { type wall; faces ((1 2 6 5)); } bottom { type wall; faces ((0 1 5 4)); }
        top { type wall; faces ((3 7 6 2)); } frontAndBack { type $3; faces ((0 3 2 1) (4 5 6 7)); }"
}
rough_column() { # folder, arguments of upright_mesh
    spheres_bed "$1" 'residual 1e-3; walls { left { type rigid; friction 0.4; slip 1e-5; } right { type rigid; friction 0.2; slip 2e-5;
        displacement table ((0 (0 0 0)) (2 (0 0 0)) (4 (0 -1e-4 0))); } bottom { type frictionless; }
        top { type piston; pressure table ((0 5000) (2 20000) (4 15000)); } "front.*" { type frictionless; } }'
    controls 'endTime 4; writeInterval 4;'
    upright_mesh "${@:2}"
    logged msddFoam
}
plane_and_space() {
    local name e
    rough_column friction-plane 1 1 empty
    rough_column friction-space 2 0.56568542494923806 wall
    # Points and cells along x, then y; in the plane there are points in front and behind, in space those on the middle plane, too
    for name in stress wallTraction; do
        e=$(paste -d ' ' <(field ../friction-plane/4/$name | head -n $([ $name = stress ] && echo 40 || echo 55)) <(field 4/$name) | awk -v cells=$([ $name = stress ] && echo 40 || echo 55) '
            { n = NF > 6 || (cells == 55 && NF > 3) ? NF/2 : 0; if (NR <= cells) for (k = 1; k <= n; k++) first[NR, k] = $k
              i = (NR - 1) % cells + 1; off = NR <= cells ? n : 0
              for (k = 1; k <= (cells == 40 ? 6 : 3); k++) { a = first[i, k]; e = $(off + k) - a; if (e < 0) e = -e; if (!(e <= w)) w = e; if (a < 0) a = -a; if (a > m) m = a } }
            END { print (NR == (cells == 40 ? 80 : 165) && m > 0 ? w/m : "nan") }')
        check "a column between rough walls, two cells deep in space and in the plane: $name differs by $e <= 1e-6 of its largest" below "$e" 1e-6
    done
}

# Janssen's equation in a square silo of width 1 m, of an elastic solid that is pressed at its top by p: with k = nu/(1 - nu), and all of the friction mobilised, the
# stress falls with exp(-4 mu k z) of the depth z.
janssen() { # cells across
    local e
    solid "janssen-$1" 'residual 1e-5; maxIterations 200; walls { "low|high|front|back" { type rigid; friction 0.4; slip 1e-9; } bottom { type frictionless; }
        top { type pressure; pressure constant 1000; } }'
    block_mesh '(0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 3) (1 0 3) (1 1 3) (0 1 3)' "hex (0 1 2 3 4 5 6 7) ($1 $1 60) simpleGrading (1 1 1)" '' '
        bottom { type wall; faces ((0 3 2 1)); } top { type wall; faces ((4 5 6 7)); } front { type wall; faces ((0 1 5 4)); }
        back { type wall; faces ((3 7 6 2)); } low { type wall; faces ((0 4 7 3)); } high { type wall; faces ((1 2 6 5)); }'
    cell_geometry
    controls 'endTime 1; deltaT 1; writeInterval 1;
        functions { wallProfile { type wallProfile; libs ("libgranularFunctionObjects.so"); bins 60; axis (0 0 1); } }'
    logged msddFoam
    e=$(paste -d ' ' <(field 0/C) <(field 1/stress) | awk -v all=$(($1*$1)) '{ k = 0.3/0.7; z = 3 - $3; sum += -$9/1000; n++ } n == all { e = sum/all - exp(-4*0.4*k*z); sum = n = 0; if (e < 0) e = -e; if (!(e <= w)) w = e; rows++ }
        END { print (rows == 60 ? w : "nan") }')
    check "Janssen's equation in a square silo, $1 x $1 cells across: the stress differs by $e <= 0.003 of that at the top" below "$e" 0.003
    e=$(awk '/^# patch/ { name[$3 + 0] = $4; next } /^#/ || $1 == 0 { next } name[$2] ~ /low|high|front|back/ { k = 0.3/0.7; law = 0.4*k*exp(-4*0.4*k*(3 - $3)); e = -$8/1000 - law
        if (e < 0) e = -e; if ($3 > 0.1 && !(e <= w)) w = e; rows++ } END { print (rows == 240 ? w : "nan") }' postProcessing/wallProfile/0/wallProfile.dat)
    check "wallProfile has Janssen's shear, from a tenth of the width above the floor on, within $e <= 0.003 of the stress at the top" below "$e" 0.003
    e=$(awk '/^# patch/ { name[$3 + 0] = $4; next } /^#/ || $1 == 0 { next } { sum += $5*(name[$2] == "bottom" ? -$6 : name[$2] == "top" ? $6 : $8) } END { e = sum/1000; print (e < 0 ? -e : e) }' \
        postProcessing/wallProfile/0/wallProfile.dat)
    check "and the forces on its walls add up to $e <= 1e-7 of that at the top" below "$e" 1e-7
}

# A square silo of spheres under its weight and a lid that presses, on a rough floor that slides, upright and turned by 30 degrees. With half
# the slip two states are in equilibrium to 1e-6 Pa which differ by 2e-4 of the displacement, and runs end in either.
rough_silo() { # folder, displacement of the floor after 4 s
    spheres_bed "$1" 'residual 1e-2; walls { ".*" { type rigid; friction 0.3; slip 2e-5; } low { type frictionless; }
        bottom { type rigid; friction 0.4; slip 2e-5; displacement table ((0 (0 0 0)) (2 (0 0 0)) (4 ('"$2"'))); }
        top { type pressure; pressure table ((0 5000) (2 10000) (4 8000)); } }'
    rm 0/stress
    grains 'restStress { lateral 0.7; surface 5000; wallFriction 0; }' # with friction mobilised at the start it needs twice the slip, see above
    gravity_is '0 0 -9.81'
    controls 'endTime 4; writeInterval 2; startFrom latestTime;'
    awk_mesh tet 4 1
}
turned_silo() {
    local name e
    rough_silo friction-silo '2e-5 1e-4 0'
    logged msddFoam
    rough_silo friction-turned "$(awk 'BEGIN { c = sqrt(0.75); s = 0.5; printf "%.17g %.17g 0", c*2e-5 - s*1e-4, s*2e-5 + c*1e-4 }')"
    logged transformPoints -rotate '((1 0 0) (0.86602540378443865 0.5 0))'
    logged msddFoam
    for name in nodeDisplacement wallTraction; do
        e=$(paste -d ' ' <(field 4/$name) <(field ../friction-silo/4/$name) | awk '{ c = sqrt(0.75); s = 0.5; x = c*$4 - s*$5 - $1; y = s*$4 + c*$5 - $2; z = $6 - $3; e = sqrt(x*x + y*y + z*z)
            a = sqrt($4*$4 + $5*$5 + $6*$6); if (!(e <= w)) w = e; if (a > m) m = a } END { print (NR > 100 && m > 0 ? w/m : "nan") }')
        check "a silo of tetrahedra, turned by 30 degrees: $name differs by $e <= 1e-5 of its largest" below "$e" 1e-5
    done
}
# The same silo, which narrows downwards: its walls take another share of the weight than its cells give
hopper() {
    rough_silo friction-hopper '0 0 0'
    awk '/^\(/ && NF == 3 && match($0, /^\(.*\)$/) { gsub(/[()]/, ""); f = 0.7 + 0.3*$3
        printf "(%.17g %.17g %.17g)\n", 0.5 + f*($1 - 0.5), 0.5 + f*($2 - 0.5), $3; next } { print }' constant/polyMesh/points > points.new
    mv points.new constant/polyMesh/points
    grains 'restStress { lateral 0.7; surface 5000; }'
    controls 'endTime 0.1; deltaT 0.1; writeInterval 1;'
    logged msddFoam
    check "tetrahedra: a warning" grep -q '100 % of the cells are tetrahedra' log
    field 0.1/initialStress > ../one
    rm -rf 0.1
    in_parts '3 1'
    side_by_side 3
    logged reconstructPar
    e=$(paste -d ' ' ../one <(field 0.1/initialStress) | awk '{ for (i = 1; i <= NF/2; i++) { e = $i - $(i + NF/2); a = $i; if (e < 0) e = -e
        if (a < 0) a = -a; if (!(e <= w)) w = e; if (a > m) m = a } } END { print (NR > 100 && m > 0 ? w/m : "nan") }')
    check "a hopper: its stress at rest differs by $e <= 1e-10 between one process and three" below "$e" 1e-10
}
# A hollow cylinder with a rough wall outside, pressed along its axis, as a wedge and as a quarter in space: mean stress along the axis
# and friction on the wall, of each layer
pressed_cylinder() { # folder, mesh, patch that is pressed
    spheres_bed "$1" 'residual 1e-2; walls { ".*" { type frictionless; } outer { type rigid; friction 0.4; slip 1e-5; } end { type pressure; pressure constant 20000; } }'
    "$2" 8
    logged blockMesh
    cell_geometry
    controls 'endTime 1;'
    logged msddFoam
}
long_wedge() {
    wedge_mesh "$1"
    sed -i "s/(4 $1 1)/(8 $1 1)/; s/ends { type symmetry; faces ((0 4 7 3) (1 2 6 5)); }/start { type wall; faces ((0 4 7 3)); } end { type wall; faces ((1 2 6 5)); }/" \
        system/blockMeshDict
}
high_ring() {
    ring_mesh "$1"
    sed -i "s/ 0\.1)/ 1)/g; s/ ($1 $(($1*3/2)) 1) / ($1 $(($1*3/2)) 8) /
        s/frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }/start { type wall; faces ((0 3 2 1)); } end { type wall; faces ((4 5 6 7)); }/" system/blockMeshDict
}
wedge_and_cylinder() {
    local e
    pressed_cylinder friction-wedge long_wedge
    paste -d ' ' <(field 0/C) <(field 0/V) <(field 1/stress) | awk '{ i = int(8*$1); V[i] += $4; s[i] += $4*$5 } END { for (i = 0; i < 8; i++) print s[i]/V[i] }' > rows
    paste -d ' ' <(list_points) <(field 1/wallTraction) | awk '$2 > 1.9 { i = int(8*$1 + 0.5); n[i]++; t[i] += $4 } END { for (i = 0; i < 9; i++) print t[i]/n[i] }' >> rows
    pressed_cylinder friction-cylinder high_ring
    paste -d ' ' <(field 0/C) <(field 0/V) <(field 1/stress) | awk '{ i = int(8*$3); V[i] += $4; s[i] += $4*$10 } END { for (i = 0; i < 8; i++) print s[i]/V[i] }' > rows
    paste -d ' ' <(list_points) <(field 1/wallTraction) | awk '$1*$1 + $2*$2 > 3.9 { i = int(8*$3 + 0.5); n[i]++; t[i] += $6 } END { for (i = 0; i < 9; i++) print t[i]/n[i] }' >> rows
    e=$(paste -d ' ' rows ../friction-wedge/rows | awk '{ e = ($1 - $2)/20000; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR == 17 ? w : "nan") }')
    check "a pressed hollow cylinder with a rough wall as a wedge and as a quarter in space: stress and friction differ by $e <= 4e-3 of the pressure" below "$e" 4e-3
    e=$(awk 'NR == 1 { print -$1/20000 }' rows)
    check "of which $e comes to its other end, at most 0.9" below "$e" 0.9
}
list_points() { sed '1,/^($/d; /^)$/,$d' constant/polyMesh/points | tr -d '()'; }

same_friction() {
    local name
    for name in T porosity stress elasticCompression nodeDisplacement wallTraction; do
        [ -n "$(field "$1/$name")" ] && cmp -s <(field "$1/$name") <(field "$2/$name") || { echo "        $name differs" >&2; return 1; }
    done
}
again_and_in_parts_with_friction() { # the silo that turned_silo has made
    local name e
    rm -rf "$work/friction-again"
    cp -r "$work/friction-silo" "$work/friction-again"
    cd "$work/friction-again"
    rm -rf 4
    logged msddFoam
    check "a silo with rough walls: restart bit for bit" same_friction 4 ../friction-silo/4
    rough_silo friction-parallel '2e-5 1e-4 0'
    cat > system/decomposeParDict <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
	numberOfSubdomains 3; method hierarchical; hierarchicalCoeffs { n (3 1 1); delta 0.001; order xyz; }
	END
    logged decomposePar
    side_by_side 3
    logged reconstructPar
    for name in nodeDisplacement wallTraction; do
        e=$(paste -d ' ' <(field 4/$name) <(field ../friction-silo/4/$name) | awk '{ for (i = 1; i < 4; i++) { e = $i - $(i + 3); if (e < 0) e = -e
            a = $i < 0 ? -$i : $i; if (!(e <= w)) w = e; if (a > m) m = a } } END { print (NR > 100 && m > 0 ? w/m : "nan") }')
        check "three processes: $name differs by $e <= 1e-5 of its largest" below "$e" 1e-5
    done
}

refused_friction() {
    spheres_bed friction-refused 'walls { ".*" { type rigid; friction 0.3; } }'
    cube 2
    check "refused: friction without the way of slip" refused "needs entries 'friction' and 'slip'"
    sed -i 's/friction 0.3;/friction -0.1; slip 1e-6;/' constant/granularProperties
    check "refused: friction below 0" refused "Entry 'friction' is -0.1"
    sed -i 's/friction -0.1; slip 1e-6;/friction 0.3; slip 0;/' constant/granularProperties
    check "refused: no way of slip" refused "Entry 'slip' is 0"
}

for direction in '1 0' '0 1' '0.70710678118654757 0.70710678118654757' '0.8 -0.6'; do along_a_line $direction; done
around
plane_and_space
janssen 1
janssen 2
turned_silo
hopper
wedge_and_cylinder
again_and_in_parts_with_friction
refused_friction
