# msddFoam -dry-run: good cases of each kind have no errors, several errors are listed at once, on one process and on three, and the
# case stays as it is; warnings at the start of a run. The single errors are those of bad.sh.

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
    in_parts '3 1'
    check "dry run: four errors at once on three processes" many 3
    cd "$work/dry-discs"
    sed -i 's/zeroGradient/zeroGradint/' processor1/0/T
    check "dry run: an error of one process alone ends in a list" foreseen 'zeroGradint' 3
    rm -r constant/polyMesh
    check "dry run: -dry-run-write of OpenFOAM is not offered" bash -c '! msddFoam -dry-run-write > log.dry 2>&1 && grep -q "Invalid option" log.dry'
    check "dry run: without a mesh it says what makes one" foreseen 'There is no mesh in constant/polyMesh: run blockMesh'
}

# Beds of spheres in space, in a wedge and beside a solid
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
    check "dry run: a solid beside the bed" passes
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
