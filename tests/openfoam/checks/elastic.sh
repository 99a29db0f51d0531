# Mechanics on meshes of any shape, with law elastic: patch test, thick-walled cylinder under pressure and heat and within a shell,
# piston, against closed forms, bending of a body that is nearly incompressible, three processes, restart on another number of them, and meshes and walls
# that cannot work.

stretched_walls() { # strains along x, y, z: walls that move so that all cells must have these strains
    echo "residual 1e-5; walls { \".*\" { type frictionless; } high { type frictionless; displacement constant ($1 0 0); }
        back { type frictionless; displacement constant (0 $2 0); } top { type frictionless; displacement constant (0 0 $3); } }"
}
uniform_stress() { # what: the stress must be the same in all cells
    logged msddFoam
    local e
    e=$(field 4e+09/stress | awk '{ for (k = 1; k <= 6; k++) { if (NR == 1) first[k] = $k; if (first[k] > most) most = first[k]; e = $k - first[k]; if (e < 0) e = -e
        if (!(e <= w)) w = e } } END { print (NR > 3 && most > 0 ? w/most : "nan") }')
    check "patch test, $1: stress is uniform to $e <= 1e-8" below "$e" 1e-8
}
patch_tests() {
    local walls plane
    walls=$(stretched_walls 1e-4 -5e-5 2e-5) plane=$(stretched_walls 1e-4 -5e-5 0)
    solid patch-triangles "${plane/top*\}/\}}"; awk_mesh tri 6 1; patch_type frontAndBack empty; uniform_stress "triangles"
    solid patch-polygons "${plane/top*\}/\}}"; awk_mesh tri 6 1; patch_type frontAndBack empty
    refine_some 2; uniform_stress "triangles and polygons with nodes within their sides"
    solid patch-hexahedra "$walls"; cube 5; moved_points; uniform_stress "hexahedra whose faces are not plane"
    solid patch-prisms "$walls"; awk_mesh prism 4 1; uniform_stress "prisms"
    solid patch-tetrahedra "$walls"; awk_mesh tet 4 1; uniform_stress "tetrahedra"
    solid patch-polyhedra "$walls"; awk_mesh tet 4 1; logged polyDualMesh 60 -overwrite; uniform_stress "polyhedra about the nodes of tetrahedra"
    solid patch-snappy "$walls"; cube 6; snappy; uniform_stress "polyhedra of snappyHexMesh"
}

# Radii 1 and 2, pressure and temperature inside; strains so small that Hooke's law holds. See Timoshenko and Goodier, Theory of
# Elasticity, for the stresses; no strain along the axis.
cylinder_walls='residual 1e-6; walls { inner { type pressure; pressure constant 10; } outer { type pressure; pressure constant 0; } }'
hot_inside() { sed -i 's/^    "\.\*" { type zeroG/    inner { type fixedValue; value uniform 1; } outer { type fixedValue; value uniform 0; }\n&/' 0/T; }
against_cylinder() { # angle from the middle plane to the points of a wedge: largest errors of displacement and stress
    paste -d ' ' <(field 4e+09/D) <(field 4e+09/stress) <(field 0/C) | awk -v shrink="$(awk -v a="$1" 'BEGIN { print cos(a) }')" -v wedge="$1" '
        function integral(r) { return (r*r/2*log(b/r) + r*r/4 - (1/2*log(b) + 1/4))/log(b) }
        BEGIN { b = 2; nu = 0.3; E = 1e7; alpha = 1e-6; p = 10; A = p/(b*b - 1); B = A*b*b; all = integral(b)*(1)/(b*b - 1) }
        { if (wedge > 0) { r = $11/shrink; u = $2; rr = $7; tt = $9 }
          else { r = sqrt($10*$10 + $11*$11); x = $10/r; y = $11/r; u = $1*x + $2*y
                 rr = $4*x*x + 2*$5*x*y + $7*y*y; tt = $4*y*y - 2*$5*x*y + $7*x*x }
          I = integral(r); k = alpha*E/(1 - nu)/(r*r); T = log(b/r)/log(b)
          srr = A - B/(r*r) + k*((r*r - 1)*all - I); stt = A + B/(r*r) + k*((r*r + 1)*all + I - T*r*r)
          U = (1 + nu)/E*((1 - 2*nu)*A*r + B/r) + (1 + nu)*alpha/((1 - nu)*r)*(I + ((1 - 2*nu)*r*r + 1)*all)
          e = u - U; f = rr - srr; g = tt - stt; if (e < 0) e = -e; if (f < 0) f = -f; if (g < 0) g = -g; if (f < g) f = g
          if (!(e <= we)) we = e; if (!(f <= wf)) wf = f; if (U > mu) mu = U; s = stt < 0 ? -stt : stt; if (s > ms) ms = s }
        END { print (NR > 3 ? we/mu " " wf/ms : "nan nan") }'
}
triangle_ring() { # linear interpolation, on which Gauss gradients rely, is not consistent on triangles
    echo 'gradSchemes { default leastSquares; }' >> system/fvSchemes
    awk_mesh ring "$1" 0; patch_type frontAndBack empty; patch_type low symmetryPlane; patch_type left symmetryPlane
}
cylinder() { # what, mesh, angle, cells across, least order of the stress: error at 64 cells (with --full) and order
    local n errors='' finest=$4
    for n in $((finest/2)) "$finest"; do
        solid "$2-$n" "$cylinder_walls"
        hot_inside
        "$2" "$n"
        cell_geometry
        logged msddFoam
        errors+="$(against_cylinder "$3") "
    done
    set -- "$1" "$5" "$finest" $errors
    local orders
    orders=$(awk "BEGIN { print log($4/$6)/log(2), log($5/$7)/log(2) }")
    check "cylinder, $1, $3 cells across: displacement within $6, stress within $7; orders $orders, at least 1.8 and $2" \
        awk "BEGIN { split(\"$orders\", o, \" \"); exit !(o[1] >= 1.8 && o[2] >= $2 && ($3 < 64 || ($6 <= 1e-3 && ($2 < 1.5 || $7 <= 1e-3)))) }"
}
cylinders() {
    local finest=32
    [ $full = no ] || finest=64
    cylinder "ring of quadrilaterals" ring_mesh 0 $finest 1.8
    cylinder "wedge" wedge_mesh 0.043633231299858237 $finest 1.8
    cylinder "ring of triangles" triangle_ring 0 $finest 0.8
}

# The same cylinder is heated by 1 K throughout, within a thin shell that expands less: u = A r + B/r, no stress at the inner wall, and
# at the outer one that with which the shell moves as the cylinder does.
shell_walls='residual 1e-6; walls { inner { type pressure; pressure constant 0; }
    outer { type shell; youngModulus 4e7; thickness 1; radius 2; thermalExpansion 4e-7; temperature 0; } }'
hot_walls() { sed -i 's/^    "\.\*" { type zeroG/    inner { type fixedValue; value uniform 1; } outer { type fixedValue; value uniform 1; }\n&/' 0/T; }
against_shell() { # angle from the middle plane to the points of a wedge: largest error of the displacement
    paste -d ' ' <(field 4e+09/D) <(field 0/C) | awk -v shrink="$(awk -v a="$1" 'BEGIN { print cos(a) }')" -v wedge="$1" '
        BEGIN { b = 2; nu = 0.3; E = 1e7; G = E/2/(1 + nu); lambda = 2*G*nu/(1 - 2*nu); heat = (3*lambda + 2*G)*1e-6; k = 4e7*1/(b*b)
          # a11 A + a12 B = heat; a21 A + a22 B = c2
          a11 = 2*(lambda + G); a12 = -2*G; a21 = a11 + k*b; a22 = -2*G/(b*b) + k/b; c2 = heat + k*4e-7*b
          det = a11*a22 - a12*a21; A = (heat*a22 - a12*c2)/det; B = (a11*c2 - a21*heat)/det }
        { if (wedge > 0) { r = $5/shrink; u = $2 } else { r = sqrt($4*$4 + $5*$5); u = ($1*$4 + $2*$5)/r }
          U = A*r + B/r; e = u - U; if (e < 0) e = -e; if (!(e <= worst)) worst = e; if (U > most) most = U }
        END { print (NR > 3 && most > 0 ? worst/most : "nan") }'
}
shell() { # what, mesh, angle: error with 16 and 32 cells across
    local n errors=''
    for n in 16 32; do
        solid "shell-$2-$n" "$shell_walls"
        hot_walls
        "$2" "$n"
        cell_geometry
        logged msddFoam
        errors+="$(against_shell "$3") "
    done
    set -- "$1" $errors
    check "shell around a cylinder, $1: displacement within $3 <= 1e-3 with 32 cells across" below "$3" 1e-3
    check "shell around a cylinder, $1: $2 with 16 cells across, order at least 1.8" awk "BEGIN { exit !($2 >= 2^1.8*$3) }"
}
shells() {
    shell "ring of quadrilaterals" ring_mesh 0
    shell "wedge" wedge_mesh 0.043633231299858237
    solid shell-processes "$shell_walls"
    hot_walls
    ring_mesh 16
    cat > system/decomposeParDict <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
	numberOfSubdomains 3; method hierarchical; hierarchicalCoeffs { n (1 3 1); delta 0.001; order xyz; }
	END
    logged decomposePar
    side_by_side 3
    logged reconstructPar
    local e
    e=$(paste -d ' ' <(field 4e+09/D) <(field ../shell-ring_mesh-16/4e+09/D) | awk '{ for (i = 1; i < 3; i++) { e = $i - $(i + 3); if (e < 0) e = -e
        if (!(e <= w)) w = e; if ($i > m) m = $i } } END { print (NR > 3 && m > 0 ? w/m : "nan") }')
    check "shell around a cylinder, cut into three processes: displacement differs by $e <= 1e-8" below "$e" 1e-8
}

# A cube that is hot at low x and cold at high x, between smooth walls, under a piston on top, which does not tilt: with T from 1 to 0, its
# mean m and M = lambda + 2 G, all of it is strained along z by (beta m - p)/M and along x by beta (T - m)/M, so that the top presses
# most where the cube is hot. Under a pressure the top would lean. (Thermal strains of 1e-6 count to the second order.)
piston_walls='residual 1e-6; walls { ".*" { type frictionless; } top { type piston; pressure constant 10; } }'
hot_low() { sed -i 's/^    "\.\*" { type zeroG/    low { type fixedValue; value uniform 1; } high { type fixedValue; value uniform 0; }\n&/' 0/T; }
against_piston() { # largest errors of the displacement along z and of the stress on the piston
    paste -d ' ' <(field 4e+09/D) <(field 4e+09/stress) <(field 0/C) | awk '
        BEGIN { nu = 0.3; E = 1e7; G = E/2/(1 + nu); lambda = 2*G*nu/(1 - 2*nu); M = lambda + 2*G; beta = (3*lambda + 2*G)*1e-6; e = (beta*0.5 - 10)/M }
        { x = $10; z = $12; T = 1 - x; u = e*z - $3; s = M*e + lambda*beta*(T - 0.5)/M - beta*T - $9
          if (u < 0) u = -u; if (s < 0) s = -s; if (!(u <= wu)) wu = u; if (!(s <= ws)) ws = s }
        END { print (NR > 3 ? wu/(e < 0 ? -e : e) " " ws/10 : "nan nan") }'
}
pistons() {
    local e
    solid piston "$piston_walls"
    hot_low
    cube 6
    cell_geometry
    logged msddFoam
    e=$(against_piston)
    check "piston on a cube with one hot side: displacement differs by ${e% *} <= 1e-5 of the top's" below "${e% *}" 1e-5
    check "and the stress by ${e#* } <= 1e-5 of the piston's pressure" below "${e#* }" 1e-5
    solid piston-processes "$piston_walls"
    hot_low
    cube 6
    cat > system/decomposeParDict <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
	numberOfSubdomains 3; method hierarchical; hierarchicalCoeffs { n (3 1 1); delta 0.001; order xyz; }
	END
    logged decomposePar
    side_by_side 3
    logged reconstructPar
    e=$(paste -d ' ' <(field 4e+09/D) <(field ../piston/4e+09/D) | awk '{ for (i = 1; i < 4; i++) { e = $i - $(i + 3); if (e < 0) e = -e
        if (!(e <= w)) w = e; if ($i > m) m = $i } } END { print (NR > 3 && m > 0 ? w/m : "nan") }')
    check "the same, cut across the piston into three processes: displacement differs by $e <= 1e-8" below "$e" 1e-8
}

# A beam of thickness 1 and length 8, held at its left end, is bent by two equal pressures p at the other end: from above between 6
# and 7, from below between 7 and 8. From 1.5 to 4.5 the moment is p, and the lower side must be a parabola of the curvature
# 12 (1 - nu^2) p/E, since nothing is strained along z.
# The elements have a closed form of their own: of n square cells across, the stress at the centres carries 1 - 1/n^2 of the moment,
# the stiffness against the hourglass r/n^2 with r = (1 - nu)/8, for cubes (1 - nu)/4. They bend too much by some 1/n^2, near
# incompressibility as at nu = 0.3. Elements that lock bend too little: bilinear ones that are integrated fully, 4 across, by 0.013
# of the closed form at nu = 0.4999.
# Triangles lock there: with parallel diagonals, 16 across, the beam bends by 0.16 of the closed form. See limits.md.
beam() { # mesh, cells across, Poisson's ratio: prints curvature over that of the closed form; largest error of the stress, over the
    # largest stress, from what the elements must have at this curvature
    solid "beam-$1-$2-$3" 'residual 1e-6; walls { left { type displacement; displacement constant (0 0 0); } free { type pressure; pressure constant 0; }
        "above|below" { type pressure; pressure constant 10; } "front.*|back" { type frictionless; } }'
    sed -i "s/poissonRatio 0.3/poissonRatio $3/" constant/granularProperties
    "$1" "$2"
    cell_geometry
    logged msddFoam
    paste -d ' ' <(sed -n '/^($/,/^)$/p' constant/polyMesh/points | tr -d '()' | grep .) <(field 4e+09/nodeDisplacement) > nodes
    paste -d ' ' <(field 0/C) <(field 4e+09/stress) | awk -v nu="$3" -v p=10 -v E=1e7 '
        function nearest(to,   d) { d = $1 > to ? $1 - to : to - $1; if (!(to in least) || d < least[to]) { least[to] = d; x[to] = $1; v[to] = $5 } }
        function error(e) { if (e < 0) e = -e; if (!(e <= worst)) worst = e }
        NR == FNR { if ($2 == 0 && $3 == 0) { nearest(1.5); nearest(3); nearest(4.5) }; next }
        FNR == 1 { a = 1.5; b = 3; c = 4.5; k = 2*((v[c] - v[b])/(x[c] - x[b]) - (v[b] - v[a])/(x[b] - x[a]))/(x[c] - x[a])/(12*(1 - nu*nu)*p/E) }
        $1 > a && $1 < c { error($4 + k*12*p*($2 - 0.5)); error($5); error($7) }
        END { print (k > 0 && worst > 0 ? k " " worst/(6*p) : "nan nan") }' nodes -
}
beam_of_blocks() { # cells across, type of the patches front and back
    local z x b vertices='' blocks=''
    for z in 0 $(awk "BEGIN { print 1/$1 }"); do for x in 0 6 7 8; do vertices+="($x 0 $z) ($x 1 $z) "; done; done
    for b in 0 2 4; do
        blocks+="hex ($b $((b + 2)) $((b + 3)) $((b + 1)) $((b + 8)) $((b + 10)) $((b + 11)) $((b + 9))) ($(((b ? 1 : 6)*$1)) $1 1) simpleGrading (1 1 1) "
    done
    block_mesh "$vertices" "$blocks" '' "
        left { type wall; faces ((0 8 9 1)); } above { type wall; faces ((3 11 13 5)); } below { type wall; faces ((4 6 14 12)); }
        free { type wall; faces ((0 2 10 8) (2 4 12 10) (1 9 11 3) (5 13 15 7) (6 7 15 14)); }
        back { type $2; faces ((0 1 3 2) (2 3 5 4) (4 5 7 6)); } front { type $2; faces ((8 10 11 9) (10 12 13 11) (12 14 15 13)); }"
}
quadrilateral_beam() { beam_of_blocks "$1" empty; }
cube_beam() { beam_of_blocks "$1" wall; }
triangle_beam() { awk -v kind=beam -v m="$1" -v irregular=1 -f "$here/mesh.awk" > mesh.msh; logged gmshToFoam mesh.msh; patch_type frontAndBack empty; }
against_elements() { # mesh, cells across, r: the ends of the beam, which the closed form leaves out, disturb by 0.1/n^2, the stress by 0.2/n^2
    local nu bent stress expected bound=$(awk "BEGIN { print 0.1/$2^2 }")
    for nu in 0.3 0.4999; do
        read -r bent stress < <(beam "$1" "$2" $nu)
        expected=$(awk "BEGIN { print 1/(1 - (1 - $3*(1 - $nu))/$2^2) }")
        check "bending, $1, $2 across, nu $nu: curvature $bent, of the elements $expected, to $bound; stress to $stress" \
            awk "BEGIN { e = $bent/$expected - 1; exit !(e*e <= $bound^2 && $stress <= 2*$bound) }"
    done
}
bending() {
    local n coarse fine stress
    for n in 2 4 8; do against_elements quadrilateral_beam $n 0.125; done
    against_elements cube_beam 4 0.25
    read -r coarse stress < <(beam triangle_beam 8 0.3)
    read -r fine stress < <(beam triangle_beam 16 0.3)
    check "bending, triangles, nu 0.3: curvature $coarse with 8 across, $fine with 16, within 0.01; order at least 1.8" \
        awk "BEGIN { e = 1 - $coarse; f = 1 - $fine; exit !(f*f <= 1e-4 && e*e >= (f*2^1.8)^2) }"
}

processes_and_restarts() { # the cube between walls that move, on polyhedra, with multigrid and on three processes
    local e
    solid elastic-serial "$(stretched_walls 1e-4 -5e-5 2e-5)"
    cube 6
    snappy
    logged foamDictionary -entry solvers.equilibrium -set '{ preconditioner AMG; }' system/fvSolution
    sed -i 's/^    "\.\*" { type zeroG/    top { type fixedValue; value uniform 20; }\n&/' 0/T
    logged foamDictionary -entry thermalExpansion -set 1e-5 constant/granularProperties
    controls 'endTime 1; deltaT 0.25; writeInterval 2; startFrom latestTime;'
    rm -rf "$work/elastic-parallel"
    cp -r . "$work/elastic-parallel"
    logged msddFoam
    cd "$work/elastic-parallel"
    cat > system/decomposeParDict <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
	numberOfSubdomains 3; method hierarchical; hierarchicalCoeffs { n (3 1 1); delta 0.001; order xyz; }
	END
    logged decomposePar
    controls 'endTime 0.5;'
    side_by_side 3
    logged reconstructPar
    rm -rf processor*
    controls 'endTime 1;'
    sed -i 's/numberOfSubdomains 3/numberOfSubdomains 2/; s/(3 1 1)/(1 2 1)/' system/decomposeParDict
    logged decomposePar -latestTime
    side_by_side 2
    logged reconstructPar
    for name in D stress; do
        e=$(paste -d ' ' <(field 1/$name) <(field "$work/elastic-serial/1/$name") | awk '{ for (i = 1; i <= NF/2; i++) { e = $i - $(i + NF/2); if (e < 0) e = -e
            a = $i < 0 ? -$i : $i; if (a > m) m = a; if (!(e <= w)) w = e } } END { print (NR > 3 && m > 0 ? w/m : "nan") }')
        check "polyhedra: 3 processes, then 2, against one: $name differs by $e <= 1e-6" below "$e" 1e-6
    done
}

refusals() {
    solid floating 'walls { ".*" { type pressure; pressure constant 10; } }'
    ring_mesh 4
    sed -i 's/symmetryPlane/wall/' constant/polyMesh/boundary
    check "refused: a piece that nothing holds" refused 'can move as a whole'
    solid turning 'walls { inner { type frictionless; } outer { type frictionless; } }'
    triangle_ring 4
    sed -i 's/symmetryPlane/wall/' constant/polyMesh/boundary
    check "refused: patches without a rule" refused "No rule in 'walls' of equilibriumCoeffs for the patches"
    solid grains-in-space "walls { }"
    cube 2
    sed -i 's/law elastic;/law grains;/' constant/granularProperties
    check "refused: discs in three dimensions" refused 'has three dimensions: discs that move are modelled in the plane alone'
    solid shell-without-thickness 'walls { inner { type shell; youngModulus 1e11; radius 1; } "outer|low|left" { type frictionless; } }'
    ring_mesh 4
    check "refused: a shell without thickness" refused 'thickness'
    solid shell-without-temperature 'walls { inner { type shell; youngModulus 1e11; radius 1; thickness 1e-3; thermalExpansion 1e-5; }
        outer { type frictionless; } }'
    ring_mesh 4
    check "refused: a shell that expands, without the temperature of its start" refused 'temperature'
    solid piston-that-is-round 'walls { inner { type frictionless; } outer { type piston; pressure constant 1; } }'
    ring_mesh 4
    check "refused: a piston that is not flat" refused 'is a piston but not flat'
    solid piston-that-is-held 'walls { ".*" { type frictionless; } top { type piston; pressure constant 1; } high { type displacement; displacement constant (0 0 0); } }'
    cube 2
    check "refused: a piston that a wall next to it holds" refused 'is a piston, and a wall next to it keeps'
    solid inside-out-cell 'walls { ".*" { type frictionless; } }'
    cube 2
    awk '/^\(/ && NF == 3 && match($0, /^\(.*\)$/) && ++n == 14 { print "(1.7 1.7 1.7)"; next } { print }' constant/polyMesh/points > points.new
    mv points.new constant/polyMesh/points
    check "refused: cells turned inside out" refused 'volume'
}

patch_tests
cylinders
shells
pistons
bending
processes_and_restarts
refusals
