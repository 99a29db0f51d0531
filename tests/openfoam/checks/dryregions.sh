# msddFoam -dry-run on cases of chtMultiRegionFoam: good ones have no errors, each error is found with its region and file, on one
# process and on three, and the case stays as it is.

. "$here/region_cases"

dry_vessel() {
    rm -rf "$work/dry-vessel"
    cp -r "$checkout/cases/vessel" "$work/dry-vessel"
    cd "$work/dry-vessel"
    rm -rf [1-9]* constant/*/polyMesh postProcessing
    find . -type f -exec sed -i "s,[./]*/common/,$checkout/cases/common/," {} +
    check "dry run of regions: without meshes it says what makes one" foreseen 'There is no mesh in constant/wall/polyMesh: run blockMesh -region wall'
    check "dry run of regions: of all regions" foreseen 'There is no mesh in constant/bed/polyMesh: run blockMesh -region bed'
    logged blockMesh -region bed
    logged blockMesh -region wall
    check "dry run of regions: vessel" passes
    check "dry run of regions: nothing is left out without fluids" bash -c '! grep -q "^Not checked" log.dry'
}
broken() { # error, command that breaks a copy of the vessel
    rm -rf "$work/dry-broken"
    cp -r "$work/dry-vessel" "$work/dry-broken"
    cd "$work/dry-broken"
    bash -c "$2"
    check "dry run of regions: $1" foreseen "$1"
}
dry_broken() {
    broken 'cannot find file "constant/g"' 'rm constant/g'
    broken '0/wall/T.boundaryField.water, line' "sed -i 's/externalWallHeatFluxTemperature/externalWall/' 0/wall/T"
    broken 'constant/wall/thermophysicalProperties.thermoType, line' "echo 'thermoType { energy sensibleEnthalpi; }' >> constant/wall/thermophysicalProperties"
    broken "constant/bed/thermophysicalProperties, line" "echo 'crosTolerance 0.1;' >> constant/bed/thermophysicalProperties; echo 'porosty 0.1;' >> constant/bed/granularProperties"
    check "dry run of regions: errors of two files at once" foreseen "Unknown entry 'porosty'"
    broken "system/wall/fvSolution.solvers, line 9: Entry 'hFinal' not found" "sed -i 's/#include.*/solvers { h { solver PCG; } } PIMPLE {}/' system/wall/fvSolution"
    broken 'cannot find file "0/wall/T"' 'rm 0/wall/T'
    broken '0/bed/T is missing' 'rm 0/bed/T'
    broken 'Region bed is a bed of grains and has no fields p, porosity' 'rm 0/bed/p 0/bed/porosity'
    broken "constant/bed/polyMesh/boundary: Patch wallSide has samplePatch 'bedSid', allowed: patches of region wall" \
        "sed -i 's/bedSide/bedSid/' constant/bed/polyMesh/boundary"
    broken "constant/bed/polyMesh/boundary: Patch wallSide has sampleRegion 'steel', allowed: regions of constant/regionProperties (bed, wall)" \
        "sed -i 's/sampleRegion *wall/sampleRegion steel/' constant/bed/polyMesh/boundary"
    broken "0/bed/T, patch wallSide: " "sed -i 's/value   uniform 300;/& kappaMethod fluidThermo; Tnbr Tother;/' 0/bed/T"
    broken 'Region bed is listed as fluid' "sed -i 's/(bed wall)/(wall)/; s/fluid *()/fluid (bed)/' constant/regionProperties"
    check "dry run of regions: what follows from that error is not listed" grep -q '^Dry run: 1 error,' log.dry
    broken "constant/wall/fvOptions" ". $here/region_cases; foam_file constant/wall/fvOptions dictionary <<< 'heat { type scalarSemiImplicitSorce; }'"
    broken "system/controlDict.functions.regionHeat" "sed -i 's/endTime .*/& functions { regionHeat { type regionHeet; } }/' system/controlDict"
    broken 'laplacian(alpha,h)' "echo 'laplacianSchemes { default none; }' >> system/wall/fvSchemes"
    broken "Entry 'mechanics' is 'equilibrium'" "echo 'mechanics equilibrium;' >> constant/bed/granularProperties"
}
dry_warned() {
    cd "$work/dry-vessel"
    transformPoints -region bed -scale '(1e4 1e4 1)' >> log
    transformPoints -region wall -scale '(1e4 1e4 1)' >> log
    check "dry run of regions: a mesh in other units" passes
    check "dry run of regions: the bed is named" grep -q '^Warning [0-9]*: Region bed: The mesh is .* m across' log.dry
}
dry_parts() {
    cd "$work/dry-vessel"
    foam_file system/decomposeParDict dictionary <<< 'numberOfSubdomains 3; method simple; simpleCoeffs { n (1 3 1); delta 1e-3; }'
    logged decomposePar -allRegions
    check "dry run of regions: three processes" passes "${on_three[@]}"
    sed -i 's/externalWallHeatFluxTemperature/externalWall/' processor*/0/wall/T
    check "dry run of regions: an error on three processes" foreseen 'externalWall' 3
}
dry_fluid() {
    regions dry-water 'bed plate' 2 water
    region bed '6 4' '0 0 0.3 0.2' 'right plate left'
    region plate '2 4' '0.3 0 0.32 0.2' 'left bed right right water left'
    fluid water '3 4' '0.32 0 0.35 0.2' 'left plate right' 1000 4000 1e-3 4 '0 1e-3 0'
    bed bed
    plate plate 20 500 7800
    temperature bed 'uniform 300' "left { type fixedValue; value uniform 400; } $(coupled right 1e-3) \".*\" { type zeroGradient; }"
    temperature plate 'uniform 300' "$(coupled left 1e-3) $(coupled right) \".*\" { type zeroGradient; }"
    start water T '0 0 0 1 0 0 0' 'uniform 300' "$(of_fluid left) bottom { type fixedValue; value uniform 300; } \".*\" { type zeroGradient; }"
    check "dry run of regions: water past a plate" passes
    check "dry run of regions: what is left out of a fluid is said" grep -q '^Not checked: turbulence .*(water)$' log.dry
    sed -i 's/radiationModel none/radiationModel nothing/' constant/water/radiationProperties
    check "dry run of regions: radiation" foreseen 'constant/water/radiationProperties, line'
    sed -i 's/radiationModel nothing/radiationModel none/' constant/water/radiationProperties
    sed -i 's/divSchemes { default Gauss upwind/divSchemes { default none/' system/water/fvSchemes
    sed -i 's/"p_rgh.*" {/p_rgh {/; s/frozenFlow yes/frozenFlow no/' system/water/fvSolution
    rm constant/water/turbulenceProperties 0/water/U
    check "dry run of regions: a field of a fluid" foreseen 'cannot find file "0/water/U"'
    check "dry run of regions: the kind of turbulence" foreseen 'constant/water/turbulenceProperties'
    check "dry run of regions: the linear solver of a fluid" foreseen 'p_rghFinal'
    start water U '0 1 -1 0 0 0 0' 'uniform (0 1e-3 0)' '".*" { type slip; }'
    sed -i 's/volScalarField/volVectorField/' 0/water/U
    check "dry run of regions: a scheme of a fluid" foreseen 'div(phi,h)'
}

dry_vessel
dry_broken
dry_fluid
dry_warned
dry_parts
