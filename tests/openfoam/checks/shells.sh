# Friction on compliant walls: plates and shells along which a body slides, a vessel that expands as its grains do, the motion of a
# shell by temperature along its axis, Janssen's equation in a stiff shell, a silo under its weight and a lid that is heated and cooled,
# without friction, in a rigid wall instead of the shell, restart, three processes; walls that grains have left;
# beds that begin at rest between rough walls; what is refused.

# A stiff body between a flat wall with friction and a plate opposite, which moves along it. The wall is pressed with some 10 kPa; the
# friction is half of its largest after a slip of 1 m, compared with which the motion of the body of some 1e-7 m is small.
pushed() { # folder, wall, field of its friction: prints the mobilised share of the friction after 0.5, 3 and 2.9 m, along y
    local time
    solid "$1" "residual 5e-3; walls { \".*\" { type pressure; pressure constant 0; } top { $2 friction 0.4; slip 1; }
        bottom { type displacement; displacement table ((0 (0 0 0)) (1 (0 0 1e-7)) (2 (0 0.5 1e-7)) (3 (0 3 1e-7)) (4 (0 2.9 1e-7))); } }"
    sed -i 's/youngModulus 1e7;/youngModulus 1e11;/g' constant/granularProperties
    controls "endTime 4; deltaT 1; writeInterval 1;"
    cube 1
    logged msddFoam
    for time in 2 3 4; do
        field "$time/$3" | awk -v stress="$(field "$time/stress")" 'BEGIN { split(stress, s, " "); most = -0.4*s[6] }
            NR > 4 { x = x > $1/most ? x : $1/most; y += $2/most/4 } END { print (NR == 8 && most > 1e-3 && x < 1e-6 ? y : "nan") }' CONVFMT=%.12g OFMT=%.12g
    done
}
along_walls_that_give_way() {
    local wall e
    for wall in shellTraction pistonTraction; do
        e=$(pushed "pushed-$wall" "$([ $wall = shellTraction ] && echo 'type shell; youngModulus 1e12; thickness 0.1; radius 1;' || echo 'type piston; pressure constant 10000;')" $wall |
            awk 'BEGIN { split("0.5 3 2.9", at, " ") } { slip = at[NR] - at[NR - 1]
                if (slip < 0) m += slip; else m = (m/(1 - m) + slip)/(m/(1 - m) + slip + 1)
                e = $1 + m; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR == 3 ? w : "nan") }')
        check "a body slides along a wall that gives way: $wall differs from the closed form by $e <= 1e-6 of its largest" below "$e" 1e-6
    done
}

# A wedge with its axis upright along x, or a quarter in space with its axis along z: radius 0.01 to 0.1 m, 0.4 m high
silo_mesh() { # cells across, cells along
    local vertices
    vertices=$(awk 'BEGIN { t = atan2(0, -1)/72; for (s = -1; s < 2; s += 2) { split("0 0.01 0.4 0.01 0.4 0.1 0 0.1", v, " ")
        for (i = 1; i < 8; i += 2) printf "(%.17g %.17g %.17g) ", v[i], v[i + 1]*cos(t), s*v[i + 1]*sin(t) } }')
    block_mesh "$vertices" "hex (0 1 2 3 4 5 6 7) ($2 $1 1) simpleGrading (1 1 1)" '' '
        inner { type wall; faces ((0 1 5 4)); } side { type wall; faces ((3 7 6 2)); } bottom { type wall; faces ((0 4 7 3)); } top { type wall; faces ((1 2 6 5)); }
        front { type wedge; faces ((0 3 2 1)); } back { type wedge; faces ((4 5 6 7)); }'
}
quarter_mesh() { # cells across, cells along
    local z vertices='' edges='' o=0 r=0.070710678118654757
    for z in 0 0.4; do
        vertices+="(0.01 0 $z) (0.1 0 $z) (0 0.1 $z) (0 0.01 $z) "
        edges+="arc $o $((o + 3)) (0.0070710678118654757 0.0070710678118654757 $z) arc $((o + 1)) $((o + 2)) ($r $r $z) "
        o=4
    done
    block_mesh "$vertices" "hex (0 1 2 3 4 5 6 7) ($1 $1 $2) simpleGrading (1 1 1)" "$edges" '
        inner { type wall; faces ((0 4 7 3)); } side { type wall; faces ((1 2 6 5)); } low { type symmetryPlane; faces ((0 1 5 4)); }
        left { type symmetryPlane; faces ((3 7 6 2)); } bottom { type wall; faces ((0 3 2 1)); } top { type wall; faces ((4 5 6 7)); }'
}

# A vessel and grains with the same thermal expansion are heated by 40 K, which the motion follows by one step: nothing slips, and the stress
# is the same in all cells, of irregular shape in a cube. The strain of 4e-4 is taken for small along the shell; its square is 1e-3 of slip.
as_its_grains() { # what, radius of the shell, its axis, other walls, mesh and its arguments
    local e
    spheres_bed "shells-even-$5" "residual 1e-3; walls { $4
        $([ "$5" = cube ] && echo high || echo side) { type shell; youngModulus 2e11; thickness 1e-3; radius $2; thermalExpansion 1e-5; temperature 300; friction 0.4; slip 1e-4;
            fixedPoint (0 0 0); $3 } }"
    echo 'heat { type scalarSemiImplicitSource; selectionMode all; volumeMode specific; injectionRateSuSp { T (1180 0); } }' > constant/fvOptions
    sed -i '1i FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }' constant/fvOptions
    controls 'endTime 8e4; deltaT 4e4; writeInterval 2;'
    "${@:5}"
    [ "$5" != cube ] || moved_points
    logged msddFoam
    e=$(paste -d ' ' <(field 80000/shellTraction) <(field 80000/nodeDisplacement) | awk '{ e = sqrt($1*$1 + $2*$2 + $3*$3)/2000; if (!(e <= w)) w = e; m += $4 > 0 || $6 > 0 }
        END { print (NR > 40 && m > 20 ? w : "nan") }')
    check "a vessel that expands as its grains do, $1: $e <= 1e-3 of the friction is mobilised" below "$e" 1e-3
    e=$(field 80000/stress | awk '{ for (k = 1; k <= 6; k++) { if (NR == 1) s[k] = $k; e = ($k - s[k])/5000; if (e < 0) e = -e; if (!(e <= w)) w = e } } END { print (NR > 20 ? w : "nan") }')
    check "and the stress is uniform, to $e <= 1e-4 of that at the start" below "$e" 1e-4
}

# Along a shell that is at 300 K at its foot and at 340 K at its top, and stands on 0.1 m: alpha 40 K (z^2 - 0.01 m2)/(2 0.4 m); at its rims
# nothing slips
warm_above() { # mesh, axis, component of the height, processes
    local e
    spheres_bed "shells-warm-$1-$4" "walls { \"bottom|top|inner\" { type frictionless; }
        side { type shell; youngModulus 2e11; thickness 1e-3; radius 0.1; thermalExpansion 1e-5; temperature 300; friction 0.2; slip 1e-4; fixedPoint ($2); $5 } }"
    sed -i 's/gas air/gas vacuum/; s/conductivity 40/conductivity 1e4/' constant/granularProperties
    hot_wall top 340
    hot_wall bottom 300
    controls 'endTime 2e9; deltaT 1e9; writeInterval 2;'
    "$1" 3 8
    if [ "$4" = 1 ]; then
        logged msddFoam
    else
        cat > system/decomposeParDict <<-'END'
		FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
		numberOfSubdomains 3; method hierarchical; hierarchicalCoeffs { n (1 1 3); delta 0.001; order xyz; }
		END
        logged decomposePar
        side_by_side 3
        logged reconstructPar
    fi
    e=$(paste -d ' ' <(list_points) <(field 2e+09/shellMotion) | awk -v k="$3" '{ r = sqrt($1*$1 + $2*$2 + $3*$3 - $k*$k); u = r > 0.0999 && $k > 0.01 && $k < 0.39 ? 1e-5*40*($k^2 - 0.01)/0.8 : 0
        for (j = 1; j < 4; j++) { e = $(3 + j) - (j == k ? u : 0); if (e < 0) e = -e; if (!(e <= w)) w = e } if (u > m) m = u } END { print (NR > 60 && m > 0 ? w/m : "nan") }')
    check "motion of a shell along its axis, $1 on $4 processes: differs from the closed form by $e <= 1e-3 of its largest" below "$e" 1e-3
}
list_points() { sed '1,/^($/d; /^)$/,$d' constant/polyMesh/points | tr -d '()'; }

# Janssen's equation in a round silo of an elastic solid, rigid inside, that is pressed at its top by p: with k = nu/(1 - nu), and all of the friction
# mobilised, the stress falls with exp(-2 mu k r z/(r^2 - 0.01^2)) of the depth z; a quarter of a diameter above the floor and more, below which the
# solid sticks. A shell that yields by 1e-6 of the solid is as a rigid wall.
round_silo() { # folder, wall
    solid "$1" "residual 1e-5; maxIterations 200; walls { side { $2 friction 0.4; slip 1e-9; } \"inner|bottom\" { type frictionless; }
        top { type pressure; pressure constant 1000; } }"
    silo_mesh "$3" 80
    cell_geometry
    controls 'endTime 1; deltaT 1; writeInterval 1;'
    logged msddFoam
}
janssen_in_a_shell() {
    local e
    round_silo shells-janssen-rigid 'type rigid;' 1
    round_silo shells-janssen 'type shell; youngModulus 1e12; thickness 1; radius 0.1;' 1
    e=$(paste -d ' ' <(field 0/C) <(field 1/stress) | awk '{ k = 0.3/0.7; e = -$4/1000 - exp(-2*0.4*k*0.1/(0.01 - 1e-4)*(0.4 - $1)); if (e < 0) e = -e; if ($1 > 0.05 && !(e <= w)) w = e }
        END { print (NR == 80 ? w : "nan") }')
    check "Janssen's equation in a stiff shell: the stress differs by $e <= 5e-4 of that at the top" below "$e" 5e-4
    e=$(paste -d ' ' <(field 1/stress) <(field ../shells-janssen-rigid/1/stress) | awk '{ for (k = 1; k <= 6; k++) { e = ($k - $(k + 6))/1000; if (e < 0) e = -e; if (!(e <= w)) w = e } }
        END { print (NR == 80 ? w : "nan") }')
    check "and in a rigid wall: the stress differs by $e <= 1e-5 of that at the top" below "$e" 1e-5
}

# Spheres under their weight in a vessel of steel, 1 mm thick, between a rough floor and a rough lid that presses; the vessel is heated by 40 K
# and cooled again.
rough_vessel() { # folder, friction of the vessel, more keys of it, wall (default: a shell)
    local key
    spheres_bed "$1" "residual 0.001; walls { bottom { type rigid; friction 0.15; slip 2e-6; } inner { type frictionless; }
        top { type piston; pressure constant 5000; friction 0.15; slip 2e-6; } side { ${4:-type shell; youngModulus 2e11; thickness 1e-3; radius 0.1; thermalExpansion 1.2e-5; temperature 300;} $2 $3 } }"
    sed -i 's/^    "\.\*" { type zeroG/    side { type uniformFixedValue; uniformValue table ((0 300) (400 340) (800 340) (1200 300)); }\n&/' 0/T
    gravity_is '-9.81 0 0'
    silo_mesh 5 16
    controls 'endTime 1600; deltaT 100; writeInterval 1; startFrom latestTime;'
}
rough='friction 0.15; slip 2e-6; fixedPoint (0 0 0);'
same_vessel() { # names of fields, folder, folder
    local name
    for name in $1; do
        [ -n "$(field "$2/$name")" ] && cmp -s <(field "$2/$name") <(field "$3/$name") || { echo "        $name differs" >&2; return 1; }
    done
}
vessel_apart() { # name, folder: largest difference over the largest value
    paste -d ' ' <(field "1600/$1") <(field "$2/1600/$1") | awk '{ for (i = 1; i <= NF/2; i++) { e = $i - $(i + NF/2); if (e < 0) e = -e
        a = $i < 0 ? -$i : $i; if (a > m) m = a; if (!(e <= w)) w = e } } END { print (NR > 3 && m > 0 ? w/m : "nan") }'
}
# Energy that friction takes in all steps, of the traction at the end of each, over area: its sum over the nodes at each time, which must not fall
# below zero at any. Prints the least and the last [J/rad]
energy_of_friction() { # wall: bottom, side, top
    local time last=0
    for time in $(seq 100 100 1600); do
        paste -d ' ' <(list_points) <(field $time/nodeDisplacement) <([ $last = 0 ] && list_points | sed 's/.*/0 0 0/' || field $last/nodeDisplacement)             <(field $time/shellMotion) <([ $last = 0 ] && list_points | sed 's/.*/0 0 0/' || field $last/shellMotion)             <(field $time/$([ "$1" = bottom ] && echo wall || { [ "$1" = side ] && echo shell || echo piston; })Traction) | awk -v on="$1" '{ r = sqrt($2*$2 + $3*$3); c = $2/r; s = $3/r
                area = on == "side" ? 0.1*0.025 : r*0.018*(r > 0.0999 || r < 0.0101 ? 0.5 : 1)
                w -= area*($16*($4 - $7 - (on == "side" ? $10 - $13 : 0)) + (on == "side" ? 0 : ($17*c + $18*s)*(($5 - $8)*c + ($6 - $9)*s)))/2 } END { printf "%.9g\n", w }'
        last=$time
    done | awk '{ sum += $1; if (NR == 1 || sum < least) least = sum } END { print (NR == 16 ? least " " sum : "nan nan") }'
}
vessels() {
    local e name wall
    rough_vessel shells-vessel "$rough" ''
    logged msddFoam
    check "a rough vessel: every step below its residual" grep -q ' in 0 steps above' log
    for wall in bottom side top; do
        e=$(energy_of_friction $wall)
        check "energy of the friction at its $wall: ${e% *} J at its least, at least 0, and ${e#* } J at the end, more than 0" awk "BEGIN { split(\"$e\", e, \" \"); exit !(e[1] >= 0 && e[2] > 1e-9) }"
    done
    rm -rf ../shells-again
    cp -r . ../shells-again
    cd ../shells-again
    rm -rf 9?? 1???
    logged msddFoam
    check "restart bit for bit" same_vessel 'T porosity stress elasticCompression nodeDisplacement wallTraction shellTraction pistonTraction shellMotion' 1600 ../shells-vessel/1600
    rough_vessel shells-parallel "$rough" ''
    in_parts '3 1'
    side_by_side 3
    logged reconstructPar -latestTime
    for name in stress nodeDisplacement shellTraction pistonTraction; do
        e=$(vessel_apart $name ../shells-vessel)
        check "three processes: $name differs by $e <= 1e-5 of its largest" below "$e" 1e-5
    done
    rough_vessel shells-smooth '' ''
    logged msddFoam
    rough_vessel shells-no-friction 'friction 0; slip 2e-6;' ''
    logged msddFoam
    check "without friction: the same bytes as a smooth shell" same_vessel 'T porosity stress elasticCompression nodeDisplacement wallTraction pistonTraction' 1600 ../shells-smooth/1600
    e=$(vessel_apart stress ../shells-vessel)
    check "from which the rough one differs by $e of the largest stress, at least 0.1" below 0.1 "$e"
    rough_vessel shells-little 'friction 1e-9; slip 2e-6; fixedPoint (0 0 0);' ''
    logged msddFoam
    e=$(vessel_apart stress ../shells-smooth)
    check "with a friction of 1e-9: the stress differs by $e <= 1e-6 of its largest, the residual over it" below "$e" 1e-6
    rough_vessel shells-stiff 'friction 0.15; slip 2e-6;' '' 'type shell; youngModulus 1e15; thickness 0.1; radius 0.1;'
    logged msddFoam
    rough_vessel shells-rigid 'friction 0.15; slip 2e-6;' '' 'type rigid;'
    logged msddFoam
    for name in stress nodeDisplacement; do
        e=$(vessel_apart $name ../shells-stiff)
        check "a stiff rough shell and a rigid rough wall: $name differs by $e <= 1e-5 of its largest" below "$e" 1e-5
    done
}

left_wall() { # a rough lid that stays; grains leave it, in part, as the bed sinks: where their displacement is downwards. None of them has friction
    local left
    rough_vessel shells-left 'friction 0.15; slip 2e-6;' '' 'type rigid;'
    sed -i 's/table (.*))/table ((0 300) (40000 310) (160000 280))/' 0/T
    sed -i 's/type piston; pressure constant 5000/type rigid/' constant/granularProperties
    controls 'endTime 1.6e5; deltaT 1e4;'
    logged msddFoam
    left=$(for time in $(seq 10000 10000 160000); do paste -d ' ' <(list_points) <(field $time/nodeDisplacement) <(field $time/wallTraction); done | awk '$1 > 0.399 {
        t = $8*$8 + $9*$9; if ($4 < -1e-9) { n++; rubs += t > 0 } else m += t > 0 } END { print n + 0, rubs + 0, m + 0 }')
    check "grains that have left a rough wall have no friction there: points left, with friction, held with friction: $left" awk "BEGIN { split(\"$left\", n, \" \"); exit !(n[1] >= 20 && n[2] == 0 && n[3] >= 20) }"
}

# A silo twice as high as wide, without a lid, begins at rest under its weight, of which its rough wall carries a third: the mean vertical stress of each
# layer after the first step compared with Janssen's with the ratio of stresses that is given. Near the floor, where nothing slips, it may be above.
at_rest() { # wall, keys of the start: prints the largest difference over the stress at the foot
    spheres_bed shells-rest "residual 1e-2; walls { \"bottom|inner\" { type frictionless; } top { type pressure; pressure constant 0; } side { $1 friction 0.15; slip 2e-6; } }"
    rm 0/stress
    grains "restStress { lateral 0.8; $2 }"
    gravity_is '-9.81 0 0'
    silo_mesh 6 24
    cell_geometry
    logged msddFoam
    paste -d ' ' <(field 0/C) <(field 0/V) <(field 1/stress) | awk '{ i = int(60*$1); V[i] += $4; s[i] -= $4*$5 } END { L = (0.01 - 1e-4)/(2*0.1*0.15*0.8); g = 2500*0.59*9.81*L
        for (i = 0; i < 24; i++) { e = (s[i]/V[i] - g*(1 - exp(-(0.4 - (i + 0.5)/60)/L)))/(g*(1 - exp(-0.4/L))); if (e < 0) e = -e; if (!(e <= w)) w = e }
        print w }'
}
starts_at_rest() {
    local e
    e=$(at_rest 'type shell; youngModulus 2e11; thickness 1e-3; radius 0.1;' '')
    check "a silo begins at rest in a rough shell: the stress differs by $e <= 0.03 of that at the foot from Janssen's" below "$e" 0.03
    at_rest 'type rigid;' '' > "$work/rest"
    e=$(cat "$work/rest")
    check "and in a rigid rough wall: by $e <= 0.03" below "$e" 0.03
    cp 1/stress whole-stress
    rm -r 1
    in_parts '3 1'
    side_by_side 3
    logged reconstructPar -latestTime
    e=$(paste -d ' ' <(field 1/stress) <(field whole-stress) | awk '{ for (k = 1; k <= 6; k++) { e = ($k - $(k + 6))/3700; if (e < 0) e = -e; if (!(e <= w)) w = e } } END { print (NR > 100 ? w : "nan") }')
    check "on three processes, too: the stress differs by $e <= 1e-5 of that at the foot" below "$e" 1e-5
    e=$(at_rest 'type rigid;' 'wallFriction 0;')
    check "without the friction of the walls by $e, at least 0.3" below 0.3 "$e"
    at_rest 'type rigid;' 'wallFriction 0;' > /dev/null
    rm -r 1
    sed -i 's/wallFriction 0;/wallFriction 1.5;/' constant/granularProperties
    check "refused: more than all of the friction of the walls" refused "Entry 'wallFriction' is 1.5, allowed: 0 to 1"
}

refused_shells() { # expected message|walls
    local message walls
    while IFS='|' read -r message walls; do
        spheres_bed shells-refused "walls { \".*\" { type frictionless; } $walls }"
        "$1" 2 2
        check "refused: $walls" refused "$message"
    done
}

along_walls_that_give_way
as_its_grains 'a wedge' 0.1 '' 'bottom { type frictionless; } "top|inner" { type pressure; pressure constant 5000; }' silo_mesh 4 8
as_its_grains 'in space' 1 'axis (0 0 2);' '".*" { type frictionless; } top { type frictionless; displacement table ((4e4 (0 0 0)) (8e4 (0 0 4e-4))); }' cube 4
warm_above silo_mesh '0.1 0 0' 1 1 ''
warm_above quarter_mesh '0 0 0.1' 3 1 'axis (0 0 1);'
warm_above quarter_mesh '0 0 0.1' 3 3 'axis (0 0 1);'
janssen_in_a_shell
vessels
left_wall
starts_at_rest
shell='type shell; youngModulus 2e11; thickness 1e-3; radius 0.1;'
refused_shells silo_mesh <<END
Entry 'friction' is -0.5, allowed: 0 to 10|side { $shell friction -0.5; slip 1e-6; }
Entry 'friction' is -0.5, allowed: 0 to 10|top { type piston; pressure constant 5000; friction -0.5; slip 1e-6; }
Patch side needs entries 'friction' and 'slip'|side { $shell friction 0.1; }
has entry 'friction' and type pressure, allowed: in walls of type rigid or shell or piston|top { type pressure; pressure constant 5000; friction 0.1; slip 1e-6; }
fixedPoint|side { $shell friction 0.1; slip 1e-6; thermalExpansion 1e-5; temperature 300; }
Entry 'axis' is given, allowed: in space|side { $shell axis (1 0 0); }
END
refused_shells quarter_mesh <<END
Entry 'axis' is (0 0 0), allowed: a vector that is not 0|side { $shell friction 0.1; slip 1e-6; thermalExpansion 1e-5; temperature 300; fixedPoint (0 0 0); axis (0 0 0); }
END
