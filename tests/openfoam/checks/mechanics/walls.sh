# The types of walls compared with the model itself; symmetry planes, one-dimensional meshes, balance of work. Sourced by
# mechanics.sh: needs strained, equilibrium.

uniaxial() { # folder, entries of the right wall: the box of the case small with frictionless walls, one step
    changed "$1"
    uniform_temperature
    mesh_is '12 6 1'
    equilibrium "residual 1e-5; walls { \".*\" { type frictionless; } right { $2 } }"
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
}

# A wall that moves by d gives the strain d/(L + d/2), around the middle of the step. Stress of all cells must be that of the model
# for this strain, and displacements are linear; prints the largest error, relative to a push [Pa]
error_of_uniaxial() { # d [m], sigma_xx, sigma_yy [Pa], push [Pa]
    paste -d ' ' <(field 0.05/stress) <(field 0.05/D) | awk -v d=$1 -v xx=$2 -v yy=$3 -v push=$4 '
        { e = (-$1 - xx)/push; f = (-$4 - yy)/push; g = $7/(d*((NR - 1) % 12 + 0.5)/12) - 1
          for (k = 0; k < 3; k++) { h = k == 0 ? e : k == 1 ? f : g; if (h < 0) h = -h; if (!(h <= w)) w = h } } END { print (NR == 72 ? w + 0 : "nan") }'
}
uniaxial_strain() { awk -v d=$1 'BEGIN { printf "0 %.17g 0 0 0\n", d/(2.15 + d/2) }'; }
prescribed_walls() {
    local e d sxx pressure
    sxx=$(echo 0 0 0 0 0 | strained before | awk '{ print $1 }')
    pressure=$(awk "BEGIN { printf \"%.17g\", $sxx + 100 }")
    uniaxial pressed "type pressure; pressure constant $pressure;"
    d=$(field 0.05/nodeDisplacement | awk 'NR == 13 { print $1 }')
    set -- $(uniaxial_strain "$d" | strained before)
    e=$(error_of_uniaxial "$d" "$pressure" "$2" 100)
    check "pressure on a wall: stress and displacement against the model $e <= 1e-6" below "$e" 1e-6
    e=$(awk "BEGIN { e = ($1 - $pressure)/100; print e < 0 ? -e : e }")
    check "pressure on a wall: the model carries it at this displacement, to $e <= 1e-6" below "$e" 1e-6
    uniaxial pushed 'type displacement; displacement constant (-0.005 0 0);'
    set -- $(uniaxial_strain -0.005 | strained before)
    e=$(error_of_uniaxial -0.005 "$1" "$2" "$(awk "BEGIN { print $1 - $sxx }")")
    check "prescribed displacement: stress and displacement against the model $e <= 1e-6" below "$e" 1e-6
}

# Discs press into all four walls, of which one is pushed by 5 mm. The stress is that of the model for the strain between the nodes
# at the walls, and these are off the walls by 1.4 mean radii times the change of the force on the wall, per length at the start, over
# E r/l
pressed_into_walls() {
    local e
    set -- $(echo 0 0 0 0 0 | strained before)
    local xx=$1 yy=$2
    uniaxial yielding 'type frictionless; displacement constant (-0.005 0 0); } } wallCompliance 1.4; walls { right {'
    set -- $(field 0.05/nodeDisplacement | awk 'NR == 1 { l = $1; b = $2 } NR == 13 { r = $1 } NR == 79 { t = $2 } END { print l, r, b, t }')
    e=$(awk -v l="$1" -v r="$2" -v b="$3" -v t="$4" \
            'BEGIN { printf "0 %.17g %.17g 0 0\n", (r - l)/(2.15 + (r - l)/2), (t - b)/(0.645 + (t - b)/2) }' | strained before \
        | awk -v l="$1" -v r="$2" -v b="$3" -v t="$4" -v xx="$xx" -v yy="$yy" '
        { x = 1.4e-7*($1*(1 + (t - b)/0.645) - xx); y = 1.4e-7*($2*(1 + (r - l)/2.15) - yy); split(l + x " " r + 0.005 - x " " b + y " " t - y, e, " ")
          for (k = 1; k <= 4; k++) { if (e[k] < 0) e[k] = -e[k]; if (!(e[k] <= w)) w = e[k] } print w/x }')
    check "discs press into walls: by what the stress of the model presses, to $e <= 1e-6" below "$e" 1e-6
    e=$(field 0.05/stress | awk 'NR == 1 { x = $1; y = $4 } { e = ($1 - x)/x; f = ($4 - y)/y
        for (k = 0; k < 2; k++) { h = k ? e : f; if (h < 0) h = -h; if (!(h <= w)) w = h } } END { print (NR == 72 ? w + 0 : "nan") }')
    check "discs press into walls: stress is uniform to $e <= 1e-7" below "$e" 1e-7
}

shell_beside_grains() { # a shell that its temperature moves by 5 mm, with a compliance of 1e-5 m/Pa
    local d e sxx
    sxx=$(echo 0 0 0 0 0 | strained before | awk '{ print $1 }')
    uniaxial shell 'type shell; youngModulus 2e5; thickness 0.5; radius 1; thermalExpansion 5e-4; temperature 40;'
    d=$(field 0.05/nodeDisplacement | awk 'NR == 13 { print $1 }')
    set -- $(uniaxial_strain "$d" | strained before)
    e=$(awk "BEGIN { e = ($1 - $sxx)/(1e5*($d - 0.005)) - 1; print e < 0 ? -e : e }")
    check "shell next to grains: the pressure that the model carries at its displacement of $d is its own, to $e <= 1e-6" below "$e" 1e-6
}

symmetric_quarter() { # all walls at 100 K: a quarter with symmetry planes must give the result of the whole
    both_ways moved-whole
    sed -i 's/uniform 70/uniform 100/; s/uniform 0;/uniform 100;/; s/zeroGradient;/fixedValue; value uniform 100;/' 0/T
    mesh_is '12 6 1'
    logged msddFoam
    both_ways moved-quarter
    sed -i 's/uniform 70/uniform 100/; s/uniform 0;/uniform 100;/; s/zeroGradient;/fixedValue; value uniform 100;/' 0/T
    cat >> system/blockMeshDict <<-'END'
	vertices ((0 0 0) (1075 0 0) (1075 322.5 0) (0 322.5 0) (0 0 10) (1075 0 10) (1075 322.5 10) (0 322.5 10));
	boundary
	(
	    left { type wall; faces ((0 4 7 3)); }
	    bottom { type wall; faces ((0 1 5 4)); }
	    middleX { type symmetryPlane; faces ((1 2 6 5)); }
	    middleY { type symmetryPlane; faces ((3 7 6 2)); }
	    frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }
	);
	END
    sed -i 's/^    right$/    middleX/; s/^    top$/    middleY/' 0/T
    awk '/middle[XY]/ { skip = 1; print; print "{ type symmetryPlane; }"; next } skip { if (/}/) skip = 0; next } { print }' 0/T > T.new
    mv T.new 0/T
    mesh_is '6 3 1'
    logged msddFoam
    local name e
    for name in T porosity D; do
        e=$(awk 'NR == FNR { a[NR - 1] = $1; next } { c = FNR - 1; e = $1 - a[c % 6 + 12*int(c/6)]; if (e < 0) e = -e; if (!(e <= w)) w = e }
            END { print (FNR == 18 ? w + 0 : "nan") }' <(field ../moved-whole/1/$name) <(field 1/$name))
        check "equilibrium: quarter with symmetry planes: $name differs by $e <= 1e-6" below "$e" 1e-6
    done
    e=$(field 1/D | awk '{ e = $1 < 0 ? -$1 : $1; if (e > w) w = e } END { print (w > 1e-5) }')
    check "equilibrium: the quarter's grains moved" test "$e" = 1
}

one_dimension() { # a mesh that is empty along y must give the result of three cells along y between smooth insulated walls
    local cells name e
    for cells in 1 3; do
        changed "line-$cells"
        equilibrium 'residual 1e-4; walls { "bottom|top" { type frictionless; } }'
        sed -i 's/^        type    fixedValue;\r*$/&/; /bottom/,/}/{ s/fixedValue/zeroGradient/; /value /d }' 0/T
        if [ $cells = 1 ]; then
            sed -i '/bottom/,/}/ s/zeroGradient/empty/; /top/,/}/ s/zeroGradient/empty/' 0/T
            cat >> system/blockMeshDict <<-'END'
	boundary
	(
	    left { type wall; faces ((0 4 7 3)); }
	    right { type wall; faces ((1 2 6 5)); }
	    bottom { type empty; faces ((0 1 5 4)); }
	    top { type empty; faces ((3 7 6 2)); }
	    frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }
	);
	END
            sed -i 's/"bottom|top" { type frictionless; }//' constant/granularProperties
        fi
        mesh_is "40 $cells 1"
        logged msddFoam
    done
    for name in T porosity D; do
        e=$(awk 'NR == FNR { a[NR - 1] = $1; next } FNR <= 40 { e = $1 - a[FNR - 1]; if (e < 0) e = -e; if (!(e <= w)) w = e }
            END { print (FNR == 120 ? w + 0 : "nan") }' <(field ../line-1/1/$name) <(field 1/$name))
        check "equilibrium: one dimension against two with smooth walls: $name differs by $e <= 1e-6" below "$e" 1e-6
    done
    e=$(field 1/D | awk '{ e = $1 < 0 ? -$1 : $1; if (e > w) w = e } END { print (w > 1e-4) }')
    check "equilibrium: the line's grains moved" test "$e" = 1
}

# A wall with a pressure moves a little, and the grains hardly slip along the walls with friction. Then everything is linear,
# and work is the mean of the forces before and after times the displacement. The work of the moved wall must be equal to the
# work stored in the cells plus the work done against friction.
polygons() { # prints the nodes of each cell of a plane mesh, counter-clockwise: its face at z = 0, which looks down
    paste -d ' ' <(list owner) <(list faces | sed 's/^[0-9]*//' | tr -d '()') | awk '
        NR == FNR { z[NR - 1] = $3; next }
        { flat = 1; for (k = 2; k <= NF; k++) if (z[$k] > 1e-9) flat = 0
          if (flat) { line = $1; for (k = NF; k > 1; k--) line = line " " $k; print line } }' <(list points | tr -d '()') - | sort -n | cut -d ' ' -f 2-
}
list() { sed '1,/^($/d; /^)$/,$d' "constant/polyMesh/$1"; } # file of the mesh: its entries, one line each
energy() { # shape
    local e sxx syy
    read -r sxx syy e < <(echo 0 0 0 0 0 | strained before)
    changed "energy-$1"
    uniform_temperature
    box "$1" '20 6'
    equilibrium "residual 1e-7; walls { right { type pressure; pressure constant $(awk "BEGIN { printf \"%.12g\", $sxx + 1 }"); }
        left { type frictionless; } \"bottom|top\" { type rigid; friction 0.4; slip 0.05; } }"
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
    e=$(awk -v xx=$sxx -v yy=$syy '
        function equal(a, b) { return a - b < 1e-9 && b - a < 1e-9 }
        NR == FNR { n = NR - 1; X[n] = $1; Y[n] = $2; ux[n] = $4; uy[n] = $5; t[n] = $7; x[n] = $1 + $4/2; y[n] = $2 + $5/2; next } # halfway
        { n = NF - 6; hx = hy = 0
          for (k = 0; k < n; k++) { a = $(7 + k); b = $(7 + (k + 1) % n); before = $(7 + (k + n - 1) % n)
              wx = (y[b] - y[before])/2; wy = (x[before] - x[b])/2 # area times mean gradient of u = sum of u w
              stored += 0.5*(($1 - xx)*ux[a]*wx + ($4 - yy)*uy[a]*wy + $2*(ux[a]*wy + uy[a]*wx))
              hx += (k % 2 ? -0.25 : 0.25)*ux[a]; hy += (k % 2 ? -0.25 : 0.25)*uy[a]
              if (equal(Y[a], Y[b]) && (equal(Y[a], 0) || equal(Y[a], 0.645))) # along a wall with friction
                  rub -= 0.25*(x[b] > x[a] ? x[b] - x[a] : x[a] - x[b])*(t[a]*ux[a] + t[b]*ux[b])
              if (equal(X[a], 2.15) && equal(X[b], 2.15)) # along the wall that presses
                  work -= 0.5*(xx + 0.5)*((y[b] - y[a])*(ux[a] + ux[b]) - (x[b] - x[a])*(uy[a] + uy[b])) }
          if (n == 4) stored += 0.5*0.1*1e7*5e-3*(hx*hx + hy*hy) } # the hourglass, which the solver holds by a stiffness of 0.1 E r
        END { added = work*0.5/(xx + 0.5); print (stored + rub - work)/added, rub/added }' \
        <(paste -d ' ' <(list points | tr -d '()') <(field 0.05/nodeDisplacement) <(field 0.05/wallTraction)) \
        <(paste -d ' ' <(field 0.05/stress) <(polygons)))
    set -- "$1" $e
    check "$1, energy: stored and friction give the work of the wall to $2 <= 1e-5 of what the push adds" below "${2#-}" 1e-5
    check "$1, energy: the walls take a share of what the push adds, $3, above 0.01" below 0.01 "$3"
}

prescribed_walls
pressed_into_walls
shell_beside_grains
symmetric_quarter
one_dimension
for shape in $shapes; do energy "$shape"; done

# Both of OpenFOAM's forms of a function of time: an entry with a separate dictionary of coefficients, or one dictionary
functions_of_time() {
    local name of
    local -A forms=(
        [constant]='displacement constant (-0.005 0 0);'
        [plain]='displacement (-0.005 0 0);'
        [uniform]='displacement uniform (-0.005 0 0);'
        [table]='displacement table ((0 (0 0 0)) (0.05 (-0.005 0 0)));'
        [polynomial]='displacement polynomial (((-0.1 0 0) (1 1 1)));'
        [scale]='displacement scale; displacementCoeffs { scale constant 0.1; value constant (-0.05 0 0); }'
        [sine]='displacement sine; displacementCoeffs { frequency 5; amplitude 1; scale (-0.005 0 0); level (0 0 0); }'
        [sineDictionary]='displacement { type sine; frequency 5; amplitude 1; scale (-0.005 0 0); level (0 0 0); }'
        [square]='displacement square; displacementCoeffs { frequency 5; amplitude 1; scale (-0.005 0 0); level (0 0 0); }'
        [tableFile]='displacement tableFile; displacementCoeffs { file "constant/way"; }'
        [csvFile]='displacement csvFile; displacementCoeffs { nHeaderLine 0; refColumn 0; componentColumns (1 2 3);
            separator ","; mergeSeparators no; file "constant/way.csv"; }'
    )
    for name in "${!forms[@]}"; do
        changed "function-$name"
        uniform_temperature
        mesh_is '3 2 1'
        echo '((0 (0 0 0)) (0.05 (-0.005 0 0)))' > constant/way
        printf '0,0,0,0\n0.05,-0.005,0,0\n' > constant/way.csv
        equilibrium "walls { \".*\" { type frictionless; } right { type frictionless; ${forms[$name]} } }"
        logged foamDictionary -entry endTime -set 0.05 system/controlDict
        logged msddFoam
        check "displacement as $name: the wall gets there" \
            test "$(field 0.05/nodeDisplacement | awk 'NR == 4 { e = $1/-0.005 - 1; print (e < 1e-8 && e > -1e-8) }')" = 1
    done
    uniaxial pressed-sine 'type pressure; pressure sine; pressureCoeffs { frequency 5; amplitude 1; scale 0; level 2500; }'
    check "pressure as sine with coefficients beside" test -d 0.05
}
functions_of_time
