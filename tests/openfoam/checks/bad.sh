# Invalid input. Each file of bad/ is appended to constant/granularProperties of a valid case, or to the file that its second
# line names; its first line has the message with which the solver must refuse it, naming the file. A third line "// by OpenFOAM" says
# that the message of a run is one of OpenFOAM, which may not name the file. The message of the dry run always names it.

bad_dictionaries() {
    local file wanted target
    changed bad
    mesh_is '12 6 1'
    echo '{"schema": "msdd-increment-model-1", ' > system/damaged.json
    echo 'FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }' > constant/fvOptions
    for file in "$here"/bad/*; do
        wanted=$(sed -n '1s,^// expect: ,,p' "$file")
        target=$(sed -n '2s,^// file: ,,p' "$file")
        : "${target:=constant/granularProperties}"
        cp "$target" good
        cat good "$file" > "$target"
        answered() { refused "$wanted" && { grep -q '^// by OpenFOAM' "$file" || grep -q "$target" log.bad; }; }
        check "refused: ${file##*/}" answered
        named() { foreseen "$wanted" && grep '^Error ' log.dry | grep -F -- "$wanted" | grep -qF "$target"; }
        check "dry run: ${file##*/}" named
        cp good "$target"
    done
    grains 'mechanics equilibrium;'
    echo 'solvers { equilibrium { sovler GMRES; } }' >> system/fvSolution
    check "refused: unknown key of the linear solver of the mechanics" refused "Unknown entry 'sovler', allowed: solver"
    check "dry run: unknown key of the linear solver of the mechanics" foreseen "Unknown entry 'sovler', allowed: solver"
}

bad_fields() {
    local name
    rm -rf good.0
    cp -r 0 good.0
    bad_field() { # name of the check, field, message, sed expression
        local message=$3 where=0/$2
        sed -i "$4" "$where"
        answered() { refused "$message" && grep -q "$where" log.bad; }
        check "refused: $1" answered
        check "dry run: $1" foreseen "${message#FOAM FATAL}"
        cp good.0/* 0/
    }
    bad_field "porosity in percent" porosity 'allowed: between 0 and 1' 's/^#include.*common.porosity.*/&\ninternalField uniform 12.5;/'
    bad_field "porosity in metres" porosity 'has dimensions [0 1 0 0 0 0 0], allowed: [0 0 0 0 0 0 0]' \
        's/^#include.*common.porosity.*/&\ndimensions [0 1 0 0 0 0 0];/'
    bad_field "T in metres" T 'has dimensions [0 1 0 0 0 0 0], allowed: [0 0 0 1 0 0 0]' 's/^dimensions.*/dimensions [0 1 0 0 0 0 0];/'
    bad_field "T is no number" T 'FOAM FATAL' 's/^internalField.*/internalField uniform nan;/'
    bad_field "T below 0 K" T 'is -5 K in cell 0 at (0.0895833 0.05375), allowed: 0 K and above' 's/^internalField.*/internalField uniform -5;/'
    bad_field "wall below 0 K" T 'is -300 K at patch right, face 0, allowed: 0 K and above' 's/uniform 0;/uniform -300;/'
    bad_field "grains that do not touch" porosity 'above 0.22 in 72 of 72 cells, up to 0.25, allowed: at most 0.22' \
        's/^#include.*common.porosity.*/&\ninternalField uniform 0.25;/'
    bad_field "field without a header" T 'problem while reading header for object T' '/^FoamFile/,/^}/d'
    bad_field "field of another class" porosity 'unexpected class name volVectorField' 's/volScalarField/volVectorField/'
    bad_field "wall without a value" T 'scalar value' 's/value   uniform 100;/value;/'
    for name in T porosity fabricIndex; do
        rm "0/$name"
        answered() { refused "FATAL" && grep -q "0/$name" log.bad; }
        check "refused: field $name missing" answered
        check "dry run: field $name missing" foreseen "0/$name"
        cp good.0/* 0/
    done
}

# Entries of spheresCoeffs, of walls and of fields that the law of spheres does not take
bad_spheres() {
    local good='roughness 1e-7; hardness 3e9;' walls='".*" { type frictionless; } left { type rigid; friction 0.3; slip 1e-6; }'
    changed bad-spheres
    mesh_is '12 6 1'
    echo 'FoamFile { version 2.0; format ascii; class volSymmTensorField; object stress; } dimensions [1 -1 -2 0 0 0 0];
        internalField uniform (-1e4 0 0 -1e4 0 -1e4); boundaryField { ".*" { type zeroGradient; } frontAndBack { type empty; } }' > 0/stress
    echo 'internalField uniform 0.4;' >> 0/porosity
    cp -r . ../bad-spheres-good
    spheres_are() { # coefficients, walls, other entries
        cp ../bad-spheres-good/constant/granularProperties constant/
        cp ../bad-spheres-good/0/* 0/
        grains "youngModulus 200e9; meanRadius 1e-3; thermalConductivity 50; surrogate { type spheres; spheresCoeffs { poissonRatio 0.3; $1 } }
            mechanics equilibrium; equilibriumCoeffs { walls { $2 } } ${3:-}"
    }
    bad_sphere() { # name of the check, message
        check "refused: $1" refused "$2"
        check "dry run: $1" foreseen "$2"
    }
    spheres_are "$good" "$walls"
    check "dry run: spheres between plates" bash -c 'msddFoam -dry-run > log.dry 2>&1 && grep -q "^Dry run: 0 errors" log.dry'
    spheres_are 'roughness 1e-7;' "$walls"
    bad_sphere "roughness without hardness" "Entry 'hardness' not found"
    spheres_are "$good fabric (0.3 0.5 0.4 0.3 0.4 0.4);" "$walls"
    bad_sphere "a fabric that is negative along a direction" 'along no direction negative'
    spheres_are "$good fabric (0.4 0 0 0.4 0 0.4);" "$walls"
    bad_sphere "a fabric with another trace" 'xx + yy + zz = 1'
    spheres_are "$good fabric (1 0 0 0 0 0);" "$walls"
    check "warning: all contacts along x" bash -c 'msddFoam -dry-run > log.dry 2>&1; grep -q "^Warning .*fabric.* has a component of 1" log.dry'
    spheres_are "$good model \"none.json\";" "$walls"
    bad_sphere "no model of spheres" 'a readable model file of spheres'
    spheres_are "$good" 'left { type frictionless; }'
    bad_sphere "spheres without a rule for a wall" 'right'
    spheres_are "$good" '".*" { type rigid; friction 0.3; }'
    bad_sphere "friction without slip" "slip"
    spheres_are "$good gas helium;" "$walls" 'thermalConductivity 0.1;'
    bad_sphere "spheres that conduct less than the gas" 'gas'
    spheres_are "$good" "$walls" 'restStress { lateral 0.5; }'
    echo 'FoamFile { version 2.0; format ascii; class uniformDimensionedVectorField; object g; } dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);' > constant/g
    bad_sphere "stress given twice" "Entry 'restStress' is given together with the field stress"
    sed -i 's/uniformDimensionedVectorField/dictionary/' constant/g
    bad_sphere "gravity of another class" 'is left out, allowed: a file with class uniformDimensionedVectorField'
    rm constant/g
    spheres_are "$good" "$walls"
    echo 'internalField uniform (1e4 0 0 1e4 0 1e4);' >> 0/stress
    bad_sphere "tension" 'because grains cannot carry tension'
    spheres_are "$good" "$walls"
    echo 'internalField uniform 0.9;' >> 0/porosity
    bad_sphere "a porosity of no packing" 'solid_fraction'
    spheres_are "$good" "$walls"
    rm 0/stress
    bad_sphere "spheres without stress" 'Field stress is missing'
}

three_dimensional() {
    changed bad-3d
    cat >> system/blockMeshDict <<-'END'
	boundary
	(
	    left { type wall; faces ((0 4 7 3)); }
	    right { type wall; faces ((1 2 6 5)); }
	    bottom { type wall; faces ((0 1 5 4)); }
	    top { type wall; faces ((3 7 6 2)); }
	    front { type wall; faces ((0 3 2 1)); }
	    back { type wall; faces ((4 5 6 7)); }
	);
	END
    mesh_is '3 2 2'
    check "refused: three-dimensional mesh" refused 'is three-dimensional, allowed: two-dimensional in x and y'
    check "dry run: three-dimensional mesh" foreseen 'is three-dimensional, allowed: two-dimensional in x and y'
}

inside_out() {
    changed bad-mirrored
    mesh_is '12 6 1'
    logged transformPoints -scale '(-1 1 1)'
    check "refused: mesh turned inside out" refused 'constant/polyMesh has 72 cells of 72 with a volume of zero or below'
    check "dry run: mesh turned inside out" foreseen 'constant/polyMesh has 72 cells of 72 with a volume of zero or below'
}

# A heat sink, and a wall, that cool cells below 0 K
too_cold() {
    changed bad-sink
    sed -i 's/fixedValue;/zeroGradient;/; /value /d' 0/T
    cat > constant/fvOptions <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }
	sink { type scalarSemiImplicitSource; selectionMode all; volumeMode specific; injectionRateSuSp { T (-1e6 0); } }
	END
    mesh_is '12 6 1'
    check "refused: a sink that cools below 0 K" refused 'allowed: 0 K and above. A wall, a source of constant/fvOptions'
    check "below 0 K: the fields are written" test -n "$(find . -path './0.*/T' | head -1)"
    changed bad-wall
    sed -i '/left/,/}/{ s/fixedValue/uniformFixedValue/; s/value .*/uniformValue table ((0 100) (0.2 -300)); value uniform 100;/ }' 0/T
    mesh_is '12 6 1'
    check "refused: a wall that is cooled below 0 K" refused 'K at patch left, face 0, allowed: 0 K and above'
}

# Temperatures slightly below 0 K, which a run may have from its discretisation, must be accepted by a restart
undershoot() {
    changed undershoot
    mesh_is '12 6 1'
    controls 'endTime 0.1;'
    logged msddFoam
    awk '/^\($/ && !done { print; getline; print -0.5; done = 1; next } { print }' 0.1/T > T.new
    mv T.new 0.1/T
    controls 'endTime 0.2;'
    logged msddFoam -accept files
    check "an undershoot of half a Kelvin: the restart goes on from it" \
        grep -q 'Accepted: time 0.1 as it is. not as written: T' log
}

blanks() {
    rm -rf "$work/a case"
    cp -r "$work/bad" "$work/a case"
    cd "$work/a case"
    check "refused: a path with blanks" refused 'allowed: no blanks'
    cd "$work"
    check "refused: -case with blanks" bash -c '! msddFoam -case "$PWD/a case" > log.bad 2>&1 && grep -q "allowed: no blanks" log.bad'
}

bad_dictionaries
bad_fields
bad_spheres
undershoot
three_dimensional
inside_out
too_cold
blanks
