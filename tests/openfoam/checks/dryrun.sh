# msddFoam -dry-run: good cases of each kind have no errors, several errors are listed at once, on one process and on three, and the
# case stays as it is; warnings at the start of a run. The single errors are those of bad.sh; each file of warn/ is appended to a file of
# a valid case as those of bad/ are, and its first line has the warning.

dry_discs() {
    changed dry-discs
    mesh_is '12 6 1'
    controls 'functions { points { type probes; libs (sampling); fields (T); probeLocations ((1 0.3 0.05)); writeControl writeTime; }
        least { type fieldMinMax; libs (fieldFunctionObjects); fields (T); } }'
    check "dry run: discs" passes
    grains 'mechanics equilibrium;'
    check "dry run: discs that move" passes
    in_parts '3 1'
    check "dry run: three processes" passes "${on_three[@]}"
    # Of a run that was killed the newest time is left out, but not renamed
    controls 'endTime 0.2;'
    logged msddFoam
    rm 0.2/T
    check "dry run: an incomplete time is left as it is" passes
    check "dry run: an incomplete time is named" grep -q 'It would be renamed to 0.2.incomplete' log.dry
}

# Errors of four groups: dictionary, patch type, function object, time scheme
dry_many() {
    changed dry-many
    mesh_is '12 6 1'
    grains 'porosty 0.1;'
    sed -i '/left/,/}/s/fixedValue/fixdValue/' 0/T
    controls 'functions { points { type prbes; libs (sampling); } }'
    scheme 'timeScheme fast;'
    many() { # processes
        local text
        for text in "Unknown entry 'porosty'" 'Unknown patchField type fixdValue' 'prbes' "Entry 'timeScheme' is 'fast'"; do
            foreseen "$text" "$1" || return 1
        done
    }
    check "dry run: four errors at once" many 1
    check "dry run: four errors are counted" grep -q '^Dry run: 4 errors' log.dry
    controls 'functions { heat { type wallHeatFlux; libs (fieldFunctionObjects); } }'
    check "dry run: a function object that would end the run" foreseen "Entry 'type' is wallHeatFlux, allowed: types that need neither"
    controls 'functions { nameless { libs (sampling); } rim { type volFieldValue; libs (fieldFunctionObjects); fields (T); operation volAverage;
        regionType cellZone; name rim; writeFields no; } }'
    check "dry run: a function object without type" foreseen "system/controlDict.functions.nameless"
    check "dry run: a function object in a zone that is not there" foreseen 'Unknown cell zone name: rim'
    in_parts '3 1'
    check "dry run: four errors at once on three processes" many 3
    cd "$work/dry-discs"
    sed -i 's/zeroGradient/zeroGradint/' processor1/0/T
    check "dry run: an error of one process alone ends in a list" foreseen 'zeroGradint' 3
    rm -r constant/polyMesh
    check "dry run: -dry-run-write of OpenFOAM is not offered" bash -c '! msddFoam -dry-run-write > log.dry 2>&1 && grep -q "Invalid option" log.dry'
    check "dry run: without a mesh it says what makes one" foreseen 'There is no mesh in constant/polyMesh: run blockMesh'
}

# Beds of spheres in space, in a wedge and next to a solid
dry_others() {
    local name
    for name in box wedge; do
        rm -rf "$work/dry-$name"
        msdd case new "$work/dry-$name" --yes --spheres --material steel --bottom 350 --checkout "$checkout" \
            $([ $name = box ] && echo --box 0.2x0.2x0.2 --cells 4x4x4 || echo --radius 0.1 --height 0.3 --side 350) > "$work/log" 2>&1
        cd "$work/dry-$name"
        logged blockMesh
        check "dry run: spheres, $name" passes
    done
    transformPoints -rotate '((0 1 0) (0 0 1))' >> log
    check "dry run: a wedge about z is refused" foreseen 'wedge'
    rm -rf "$work/dry-silo"
    cp -r "$checkout/cases/silo" "$work/dry-silo"
    cd "$work/dry-silo"
    rm -rf [1-9]* constant/polyMesh constant/wall/polyMesh postProcessing
    find . -type f -exec sed -i "s,[./]*/common/,$checkout/cases/common/," {} +
    logged blockMesh
    logged blockMesh -region wall
    check "dry run: a solid next to the bed" passes
    check "dry run: no warning of a library that is not there" bash -c '! grep -q "Could not load" log.dry'
    sed -i '/granularContact;/,/}/s/value .*//' 0/wall/T
    check "dry run: the condition between bed and solid needs no value" passes
    sed -i 's/granularContact/granularContct/' 0/wall/T
    check "dry run: a wrong patch of the solid" foreseen 'granularContct'
}

warned() { # text: a warning at the start of a run, and of a dry run
    msddFoam > log.warned 2>&1; msddFoam -dry-run > log.dry 2>&1
    grep '^Warning 1: ' log.warned | grep -qF -- "$1" && grep '^Warning 1: ' log.dry | grep -qF -- "$1"
}

doubted() { # text: a dry run has a warning with it, and no error
    msddFoam -dry-run > log.dry 2>&1 && grep '^Warning ' log.dry | grep -qF -- "$1"
}
doubtful_dictionaries() {
    local file wanted target
    changed warn
    mesh_is '12 6 1'
    echo 'FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }' > constant/fvOptions
    check "warning: none in a good case" bash -c 'msddFoam -dry-run > log.dry 2>&1; grep -q "^Dry run: 0 errors, 0 warnings" log.dry'
    for file in "$here"/warn/*; do
        wanted=$(sed -n '1s,^// expect: ,,p' "$file")
        target=$(sed -n '2s,^// file: ,,p' "$file")
        : "${target:=constant/granularProperties}"
        cp "$target" good
        cat good "$file" > "$target"
        check "warning: ${file##*/}" doubted "$wanted"
        cp good "$target"
    done
    grains 'thermalExpansion 5e-3;'
    msddFoam > log.warned 2>&1 || true
    check "warning: at the start of a run, too" grep -q '^Warning [0-9]*: The thermal strain to 100 K is 0.005 times 50 K = 0.25' log.warned
}

# Physics of beds of spheres, and of discs under their weight
doubtful_beds() {
    local gravity='FoamFile { version 2.0; format ascii; class uniformDimensionedVectorField; object g; } dimensions [0 1 -2 0 0 0 0];'
    rm -rf "$work/warn-bed"
    msdd case new "$work/warn-bed" --yes --spheres --material steel --box 0.2x0.2x0.2 --cells 4x4x4 --bottom 350 --gas air --checkout "$checkout" > "$work/log" 2>&1
    cd "$work/warn-bed"
    logged blockMesh
    cp constant/granularProperties good
    with() { # name of the check, text, entries of constant/granularProperties
        cat good - <<< "$3" > constant/granularProperties
        check "warning: $1" doubted "$2"
    }
    with "rough spheres" "Entry 'roughness' of spheresCoeffs is 0.0003 m, usual: at most a hundredth of meanRadius" 'surrogate { spheresCoeffs { roughness 3e-4; } }'
    with "a gas too thin for these spheres" 'Between these spheres gasPressure is known from about ' 'surrogate { spheresCoeffs { gasPressure 1e-3; } }'
    cp good constant/granularProperties
    cp 0/porosity good-porosity
    echo 'internalField uniform 0.25;' >> 0/porosity
    check "warning: a porosity that the law does not know" doubted 'cells are outside of the packings that the law of spheres was trained with, by density'
    cp good-porosity 0/porosity
    cp 0/T good-T
    sed -i 's/350/2500/' 0/T
    check "warning: a gas too hot" doubted 'T gets to 2.5e+03 K, and the gas is tabulated up to 2e+03 K'
    cp good-T 0/T
    changed warn-weight
    mesh_is '12 6 1'
    grains 'mechanics equilibrium; equilibriumCoeffs { walls { top { type pressure; pressure constant 1000; } } }'
    echo "$gravity value (0 -5 0);" > constant/g
    check "warning: none of gravity away from the lid" bash -c 'msddFoam -dry-run > log.dry 2>&1; ! grep -q Gravity log.dry'
    echo "$gravity value (-3 -4 0);" > constant/g
    check "warning: gravity across the walls" doubted 'Gravity is (-3 -4 0) m/s2 in constant/g, usual: along one axis of the mesh'
    echo "$gravity value (-5 0 0);" > constant/g
    check "warning: gravity along the lid" doubted "usual: away from wall 'top', which presses on the bed"
    echo "$gravity value (0 5 0);" > constant/g
    check "warning: gravity to the lid" doubted "Gravity points to wall 'top', whose pressure is given"
    echo "$gravity value (0 -5e4 0);" > constant/g
    check "warning: a stress far below the weight" doubted 'Grains that hardly touch have to be pressed together first'
    rm constant/g
    echo 'FoamFile { version 2.0; format ascii; class volSymmTensorField; object stress; } dimensions [1 -1 -2 0 0 0 0];
        internalField uniform (-300 0 0 -300 0 0); boundaryField { ".*" { type zeroGradient; } frontAndBack { type empty; } }' > 0/stress
    check "warning: a pressure that packings of this porosity do not have" doubted 'Field stress has a mean pressure of 300 Pa, usual: '
}

scene_warnings() {
    changed warn-size
    mesh_is '12 6 1'
    logged transformPoints -scale '(1000 1000 1)'
    check "warning: a mesh in other units" warned 'The mesh is 2.15e+03 m across'
    changed warn-parts
    cp system/blockMeshDict other
    mesh_is '12 6 1'
    cp -r . ../warn-parts-other
    logged transformPoints -case ../warn-parts-other -translate '(5 0 0)'
    logged mergeMeshes -overwrite . ../warn-parts-other
    rm -r ../warn-parts-other
    check "warning: a mesh of two parts" warned 'The mesh has 2 parts without a common face, of 72, 72 cells'
}

dry_discs
dry_many
dry_others
scene_warnings
doubtful_dictionaries
doubtful_beds
