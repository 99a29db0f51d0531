# Heat conduction: a manufactured solution, the maximum principle, a rotated case, symmetry planes.

# T = 50 + 20 exp(p.x) cos(3 y), with p such that div(K grad T) = 0 for K = (34 8; 8 26); on n x n cells of the unit square
# sheared by s, with the exact T at all walls. Prints the rms error over the cells in the steady state.
exact='function T(x, y) { p = 3*sqrt(26/(34 - 64/26)); return 50 + 20*exp(p*(x - 8/26*y))*cos(3*y)/exp(p) }'
manufactured() { # n, shear
    local n=$1 s=$2 side
    changed "manufactured-$n-$s"
    grains 'surrogate { type constant; constantCoeffs { conductivity (34 8 0 26 0 0); } } thermalExpansion 0;'
    cat > system/blockMeshDict <<-END
	$(sed -n '1,/^}/p' "$here/small/system/blockMeshDict")
	#include "../../../../cases/common/blockMeshDict"
	scale 1;
	vertices ((0 0 0) (1 0 0) ($(awk "BEGIN { print 1 + $s }") 1 0) ($s 1 0) (0 0 0.1) (1 0 0.1) ($(awk "BEGIN { print 1 + $s }") 1 0.1) ($s 1 0.1));
	blocks (hex (0 1 2 3 4 5 6 7) ($n $n 1) simpleGrading (1 1 1));
	END
    { sed '/^boundaryField/,$d' "$here/small/0/T"; echo 'boundaryField { frontAndBack { type empty; }'
        for side in left right bottom top; do
            echo "$side { type fixedValue; value nonuniform List<scalar> $n ("
            awk -v n="$n" -v s="$s" -v side=$side "$exact"' BEGIN { for (i = 0; i < n; i++) { u = (i + 0.5)/n
                x = side == "left" ? 0 : side == "right" ? 1 : u; y = side == "bottom" ? 0 : side == "top" ? 1 : u
                printf "%.16g\n", T(x + s*y, y) } }'
            echo '); }'
        done; echo '}'; } > 0/T
    controls 'deltaT 20; endTime 1600; writeInterval 80;'
    scheme 'nNonOrthogonalCorrectors 1;'
    logged blockMesh
    logged msddFoam
    field 1600/T | awk -v n="$n" -v s="$s" "$exact"' { i = (NR - 1) % n; j = int((NR - 1)/n); y = (j + 0.5)/n
        e = $1 - T((i + 0.5)/n + s*y, y); sum += e*e } END { printf "%.6g\n", NR == n*n ? sqrt(sum/NR) : "nan" }'
}
for shear in 0 0.4; do
    coarse=$(manufactured 10 $shear) fine=$(manufactured 20 $shear)
    order=$(awk "BEGIN { printf \"%.2f\", log($coarse/$fine)/log(2) }")
    check "manufactured, K with xy, shear $shear: errors $coarse, $fine K, order in space $order >= 1.8" \
        awk "BEGIN { exit !($order >= 1.8) }"
done

maximum_principle() { # implicit Euler with diagonal K: no new extremes from a checkerboard of T with any time step
    local step
    for step in 0.05 50; do
        changed maximum
        { sed 's/^internalField.*/internalField nonuniform List<scalar> 72 (/; /^boundaryField/,$d' "$here/small/0/T"
            awk 'BEGIN { for (i = 0; i < 72; i++) print (i + int(i/12)) % 2 ? 0 : 100; print ");" }'
            sed -n '/^boundaryField/,$p' "$here/small/0/T"; } > 0/T
        grains 'thermalExpansion 0;'
        controls "deltaT $step; endTime $step;"
        mesh_is '12 6 1'
        logged msddFoam
        check "maximum principle, step $step: T within 0 to 100" test \
            "$(field "$step/T" | awk '$1 < -1e-10 || $1 > 100 + 1e-10 { n++ } END { print NR, n + 0 }')" = "72 0"
    done
}

rotated() { # the case rotated by 90 degrees, x' = H - y, y' = x, must give the rotated result
    changed rotated
    sed -i 's/left/A/; s/right/B/; s/bottom/C/; s/top/D/' 0/T
    sed -i 's/^    A$/    bottom/; s/^    B$/    top/; s/^    C$/    right/; s/^    D$/    left/' 0/T
    sed -i 's/^#include.*fabricIndex.*/&\ninternalField uniform -0.05;/' 0/fabricIndex
    upright_vertices
    mesh_is '6 12 1'
    logged msddFoam
    columns 1/{T,porosity,conductivity,stress}
    local name worst
    for name in T porosity conductivity stress; do
        worst=$(awk -v name=$name '
            NR == FNR { for (k = 1; k <= NF; k++) a[NR - 1, k] = $k; next }
            { c = FNR - 1; i = c % 6; j = int(c/6); o = j + 12*(5 - i)
              n = split(name ~ /T|porosity/ ? "1" : "4 2 3 1 5 6", from, " ")
              for (k = 1; k <= n; k++) { e = $k - a[o, from[k]]; s = $k < 0 ? -$k : $k; if (e < 0) e = -e; if (e/(s + 1) > w) w = e/(s + 1) } }
            END { print (FNR == 72 ? w + 0 : "nan") }' <(field "$work/serial/1/$name") "1/$name.column")
        check "rotated by 90 degrees: $name differs by $worst <= 1e-11" below "$worst" 1e-11
    done
}
upright_vertices() { # the vertices again, since the included file has expanded them already
    cat >> system/blockMeshDict <<-'END'
	vertices ((0 0 0) (645 0 0) (645 2150 0) (0 2150 0) (0 0 10) (645 0 10) (645 2150 10) (0 2150 10));
	END
}

quarter() { # a quarter of case H with symmetry planes must give the result of the whole
    changed whole
    sed -i 's/uniform 70/uniform 100/; s/uniform 0;/uniform 100;/; s/zeroGradient;/fixedValue; value uniform 100;/' 0/T
    mesh_is '12 6 1'
    logged msddFoam
    cp -r . "$work/quarter"
    cd "$work/quarter"
    rm -rf [1-9]* 0.[0-9]* constant/polyMesh postProcessing
    sed -i 's/(12 6 1)/(6 3 1)/' system/blockMeshDict
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
    logged blockMesh
    logged msddFoam
    local name worst
    for name in T porosity; do
        worst=$(awk 'NR == FNR { a[NR - 1] = $1; next } { c = FNR - 1; e = $1 - a[c % 6 + 12*int(c/6)]; if (e < 0) e = -e; if (e > w) w = e }
            END { print (FNR == 18 ? w + 0 : "nan") }' <(field ../whole/1/$name) <(field 1/$name))
        check "quarter with symmetry planes: $name differs by $worst <= 1e-9" below "$worst" 1e-9
    done
}

maximum_principle
small_as_it_is
rotated
rm -rf "$work/quarter"
quarter
