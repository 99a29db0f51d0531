# Grains of spheres that move, in space, in wedges and in the plane: what cells bear against the law itself, which the program
# spheres.c asks; growth in a rigid box and under a given pressure; a wedge beside the sector in space; restart, processes, heat, grain
# size, gravity, and what is refused.

bed() { # folder, walls: spheres of 2 mm under 5 kPa and 300 K, insulated
    rm -rf "${work:?}/$1"
    mkdir -p "$work/$1/0" "$work/$1/constant" "$work/$1/system"
    cd "$work/$1"
    start_field T '[0 0 0 1 0 0 0]' 300
    start_field porosity '[0 0 0 0 0 0 0]' 0.41
    start_field fabricIndex '[0 0 0 0 0 0 0]' 0
    start_field stress '[1 -1 -2 0 0 0 0]' '(-5000 0 0 -5000 0 -5000)'
    sed -i s/volScalarField/volSymmTensorField/ 0/stress
    cat > constant/granularProperties <<-END
	FoamFile { version 2.0; format ascii; class dictionary; object granularProperties; }
	surrogate { type spheres; spheresCoeffs { poissonRatio 0.25; gas air; } }
	density 2500; youngModulus 5e9; thermalConductivity 40; heatCapacity 800; thermalExpansion 1e-5; meanRadius 1e-3;
	mechanics equilibrium;
	equilibriumCoeffs { $2 }
	END
    cat > system/controlDict <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }
	endTime 1; deltaT 1; writeInterval 1; writeFormat ascii; writePrecision 17; timePrecision 6;
	END
    cp "$here/small/system/fvSchemes" system
    cat > system/fvSolution <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object fvSolution; }
	solvers { T { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; } }
	msddFoam { nNonOrthogonalCorrectors 5; }
	END
}
growth_is() { start_field thermalStrainIncrement '[0 0 0 0 0 0 0]' "$1"; } # growth of the radii, which the first step applies
heated() { sed -i "s/^    \"\\.\\*\" { type zeroG/    $1 { type fixedValue; value uniform $2; }\\n&/" 0/T; } # patch, temperature
asked() { "$work/spheres-law" 0.59 5000 5000 5000 0 0 0; } # reads steps, see spheres.c
midway() { awk -v d="$1" 'BEGIN { printf "%.17g", d/(1 + d/2) }'; } # strain of one step in which a length of 1 grows by this
# Largest difference between the stress of all cells and one of six components xx xy xz yy yz zz (tension positive), over the largest of these
from_stress() { # file, components
    field "$1" | awk -v law="$2" 'BEGIN { split(law, s, " "); for (k = 1; k <= 6; k++) { a = s[k] < 0 ? -s[k] : s[k]; if (a > most) most = a } }
        { for (k = 1; k <= 6; k++) { e = $k - s[k]; if (e < 0) e = -e; if (!(e <= w)) w = e } } END { print (NR > 3 && most > 0 ? w/most : "nan") }'
}
answered() { asked | tail -n 1 | awk '{ printf "%.17g %.17g %.17g %.17g %.17g %.17g\n", -$1, -$4, -$5, -$2, -$6, -$3 }'; } # the stress after these steps, in the order of OpenFOAM
stretched() { # strains along x, y, z: walls that move so that all cells have these strains
    echo "residual 1e-4; walls { \".*\" { type frictionless; } \"high|right\" { type frictionless; displacement constant ($1 0 0); }
        back { type frictionless; displacement constant (0 $2 0); } top { type frictionless; displacement constant (0 0 $3); } }"
}
as_the_law() { # what, strains along x, y, z: one step, after which all cells have the stress of the law
    logged msddFoam
    local e
    e=$(from_stress 1/stress "$(echo 0 "$(midway "$2")" "$(midway "$3")" "$(midway "$4")" 0 0 0 0 0 0 | answered)")
    check "spheres, $1: the stress of all cells is that of the law to $e <= 1e-8" below "$e" 1e-8
}
patch_tests_of_spheres() {
    local walls plane press
    walls=$(stretched -1e-4 5e-5 -3e-4) plane=$(stretched -1e-4 -2e-4 0) press=$(stretched 0 0 -5e-4)
    bed spheres-hexahedra "$walls"; cube 4; moved_points; as_the_law "hexahedra whose faces are not plane" -1e-4 5e-5 -3e-4
    bed spheres-tetrahedra "$walls"; awk_mesh tet 3 1; as_the_law "tetrahedra" -1e-4 5e-5 -3e-4
    bed spheres-polyhedra "$walls"; awk_mesh tet 3 1; logged polyDualMesh 60 -overwrite; as_the_law "polyhedra" -1e-4 5e-5 -3e-4
    bed spheres-snappy "$walls"; cube 4; snappy; as_the_law "polyhedra of snappyHexMesh" -1e-4 5e-5 -3e-4
    bed spheres-pressed "$press"; cube 4; as_the_law "uniaxial compression" 0 0 -5e-4
    bed spheres-plane "${plane/top*\}/\}}"; awk_mesh tri 4 1; patch_type frontAndBack empty; as_the_law "triangles in the plane" -1e-4 -2e-4 0
    # A body of revolution about x: the radius, from 1 to 2, grows by the same strain as the hoops
    bed spheres-wedge 'residual 1e-4; walls { inner { type displacement; displacement constant (0 -1e-4 0); } outer { type displacement; displacement constant (0 -2e-4 0); } }'
    wedge_mesh 4
    as_the_law "a wedge" 0 -1e-4 -1e-4
}

mkdir -p "$work"
library=$(cd "$checkout" && realpath -m "${CARGO_TARGET_DIR:-target}")/release/libmsdd.a
"${CC:-cc}" -std=c99 -Wall -Wextra -Werror -I"$checkout/rust/capi/include" "$here/spheres.c" "$library" -lpthread -ldl -lm -o "$work/spheres-law"
patch_tests_of_spheres
