# Balances of heat and mass, function objects, sources, cells that are held.

. "$here/region_cases"

audited() { # folder, shape of the cells: small with all function objects
    changed "$1"
    controls 'functions { #include "'"$here"'/audits" }'
    box "$2" '12 6'
}
worst() { awk -v k="$2" '!/^#/ { if ($k > w) w = $k; n++ } END { print (n ? w + 0 : "nan") }' "postProcessing/$1/0/$1.dat"; }

heated() { # shape, time scheme
    local e
    audited "audit-$1-$2" "$1"
    scheme "timeScheme $2;"
    cat > constant/fvOptions <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }
	heating
	{
	    type scalarSemiImplicitSource; active yes; selectionMode all; volumeMode specific;
	    injectionRateSuSp { T (5000 -20); }
	}
	END
    logged msddFoam
    e=$(worst heatAudit 6)
    check "$1, $2: heat balance with a source closes to $e <= 1e-10" below "$e" 1e-10
    check "$1, $2: the source gives heat" test "$(awk 'END { print ($4 > 0) }' postProcessing/heatAudit/0/heatAudit.dat)" = 1
    e=$(worst massAudit 4)
    check "$1, $2: mass closes to $e <= 1e-12" below "$e" 1e-12
}
function_objects() { # shape: in the case of 'heated'
    local e mean
    cell_geometry
    e=$(awk 'END { print $2 }' postProcessing/wallPressure/0/wallPressure.dat)
    mean=$(sed -n 's/.*"pressure": \([0-9.e+-]*\).*/\1/p' postProcessing/msddFoam/summary.json)
    check "$1, wallPressure: domain $e = mean pressure $mean" below "$(awk "BEGIN { print ($e/$mean - 1)^2 }")" 1e-16
    e=$(awk 'NR == FNR { k = int($1/2.15*4) + 4*int($2/0.645*3); V[k] += $4; sum[k] += $4*$5; next }
        $1 == 1 { k = $2 + 4*$3; e = $5*V[k]/sum[k] - 1; if (e < 0) e = -e; if (!(e <= w)) w = e; n++ } END { print (n == 12 ? w + 0 : "nan") }' \
        <(paste -d ' ' <(field 0/C) <(field 0/V) <(field 1/porosity)) postProcessing/subRegions/0/subRegions.dat)
    check "$1, subRegions: porosity of the windows is the mean over their cells to $e <= 1e-10" below "$e" 1e-10
}
for shape in $shapes; do
    heated "$shape" paper
    heated "$shape" secondOrder
    function_objects "$shape"
done

crossed() { # folder, box (straight, slanted, triangles): the case small with a conductivity that has an xy component
    changed "$1"
    grains 'surrogate { type constant; constantCoeffs { conductivity (34 8 0 26 0 0); } }'
    [ "$2" != slanted ] || sed -i 's,^blocks.*,vertices ((0 0 0) (2150 0 0) (2350 645 0) (200 645 0) (0 0 10) (2150 0 10) (2350 645 10) (200 645 10));\n&,' \
        system/blockMeshDict
    if [ "$2" = triangles ]; then box triangles '12 6'; else box quadrilaterals '12 6'; fi
}
for kind in straight slanted triangles; do # straight: the heat equation is assembled directly, else by the tensor laplacian
    crossed audit-tensor-$kind $kind
    controls 'functions { #include "'"$here"'/audits" }'
    logged msddFoam
    check "K_xy, $kind: how it is assembled" \
        grep -q "$([ $kind = straight ] && echo 'Conduction: n.K.n on the faces, Kxy explicitly' || echo 'Conduction: tensor laplacian')" log
    e=$(worst heatAudit 6)
    check "K_xy, $kind: heat balance closes to $e <= 1e-10" below "$e" 1e-10

    crossed insulated-tensor-$kind $kind # walls without a gradient are insulated, although T changes along them
    cell_geometry
    sed -i 's/fixedValue;/zeroGradient;/; /value /d' 0/T
    sed -i "s/^internalField.*/internalField nonuniform List<scalar> $cells ($(seq -s ' ' 15 $((14 + cells))));/" 0/T
    logged msddFoam
    e=$(paste -d ' ' <(field 0/V) <(field 0/T) <(field 1/T) | awk '{ V += $1; s += $1*($3 - $2) } END { e = s/V; print (NR == '$cells' ? (e < 0 ? -e : e) : "nan") }')
    check "K_xy, $kind: in an insulated box the mean of T stays to $e <= 1e-9 K" below "$e" 1e-9
done

held() { # shape, time scheme: cells that are held at a temperature, some next to a wall: the heat that this takes counts as a source
    local e
    audited "audit-held-$1-$2" "$1"
    grains 'thermalExpansion 0;'
    scheme "timeScheme $2;"
    foam_file constant/fvOptions dictionary <<< 'held { type scalarFixedValueConstraint; active yes; selectionMode cellSet; cellSet held; fieldValues { T 120; } }'
    foam_file system/topoSetDict dictionary <<< 'actions ({ name held; type cellSet; action new; source boxToCell; sourceInfo { box (-1 0.2 -1) (0.5 0.4 1); } });'
    logged topoSet
    logged msddFoam
    e=$(worst heatAudit 6)
    check "$1, $2: heat balance with cells that are held closes to $e <= 1e-10" below "$e" 1e-10
    if [ "$1" = quadrilaterals ]; then
        rm -rf 0.* [1-9]* postProcessing
        in_parts '4 1' # cells that are held lie at the end of the first process
        side_by_side 4
        e=$(worst heatAudit 6)
        check "and on four processes to $e <= 1e-10" below "$e" 1e-10
    fi
    check "$1, $2: holding them gives heat" test "$(awk 'END { print ($4 > 0) }' postProcessing/heatAudit/0/heatAudit.dat)" = 1
}
for shape in $shapes; do
    held "$shape" paper
    held "$shape" secondOrder
done

shipped() { # case: goes into a copy of it, without results that stand there
    rm -rf "${work:?}/$1"
    mkdir "$work/$1"
    cp -r "$checkout/cases/$1"/{0,constant,system} "$work/$1"
    cd "$work/$1"
    sed -i "s#\.\./\.\./common#$checkout/cases/common#" 0/* constant/granularProperties system/*
}

shipped breeder # with a volumetric heat source
echo 'solvers { T { tolerance 1e-14; } }' >> system/fvSolution # as in the case small
logged blockMesh
logged msddFoam
top=$(field 60/T | awk '$1 > top { top = $1 } END { print top }')
check "breeder: the middle ends at $top, 85 to 89 K" below "$(awk "BEGIN { print ($top - 87)^2 }")" 4
check "breeder: heat balance closes to $(worst heatAudit 6) <= 1e-10" below "$(worst heatAudit 6)" 1e-10

# Prints the largest differences of T at the probes from the discs' means over windows, in % of the range of temperatures
(cd "$checkout" && cargo build --release --quiet ${MSDD_PACKAGES:---package msdd-cli})
msdd=$(cd "$checkout" && realpath -m "${CARGO_TARGET_DIR:-target}")/release/msdd
against_discs() { # reference
    "$msdd" reference compare --case . --discs "$checkout/cases/reference/results/$1.json" | awk '$1 == "largest" { print $2 }'
}
# The shipped cases corner (half of the walls hot) and material (other grains), for which no parameter was chosen; grains move
for case in "corner corner_seed11" "material material_seed12"; do
    set -- $case
    shipped "$1"
    logged blockMesh
    logged msddFoam
    e=$(against_discs "$2")
    check "$1: T against 15 000 discs $e <= 1 % of the range" below "$e" 1
done

# OpenFOAM's means over time, whose lists of fields hold blocks, see the stress of every step
changed averaged
controls 'functions { means { type fieldAverage; libs ("libfieldFunctionObjects.so"); fields (stress { mean on; prime2Mean off; base iteration; }); } }'
mesh_is '12 6 1'
logged msddFoam
e=$(for time in 0.[0-9]* 1; do field $time/stress | sed -n 1p; done | awk -v mean="$(field 1/stressMean | sed -n 1p)" '
    { sum += $1 } END { split(mean, m, " "); e = m[1]*NR/sum - 1; print (NR == 20 ? (e < 0 ? -e : e) : "nan") }')
check "fieldAverage: mean of the stress of 20 steps differs by $e <= 1e-10" below "$e" 1e-10

# The shipped case cycle, ten thermal cycles: grains slide only in the first cycle, when they are strained further than before;
# a restart must keep the largest and least strains
shipped cycle
logged blockMesh
logged msddFoam
e=$(awk '!/^#/ && ($1 == 8 || $1 == 48) { p[$1] = $2 } END { print p[48]/p[8] - 1 }' postProcessing/wallPressure/0/wallPressure.dat)
check "cycle: after six cycles p is that after one, to $e, within 0.01" below "$(awk "BEGIN { print ($e)^2 }")" 1e-4
anisotropy() { field "$1/conductivity" | awk '{ xx += $1; yy += $4 } END { print xx/yy }'; }
e=$(awk "BEGIN { print $(anisotropy 80)/$(anisotropy 8) - 1 }")
check "cycle: after ten cycles K_xx/K_yy is that after one, to $e, within 0.01" below "$(awk "BEGIN { print ($e)^2 }")" 1e-4
rm -rf "${work:?}/cycle-restart"
mkdir "$work/cycle-restart"
cp -r 0 16 constant system "$work/cycle-restart"
cd "$work/cycle-restart"
logged foamDictionary -entry endTime -set 24 system/controlDict
logged msddFoam
check "cycle: restart after two cycles: the same bytes after three" diff -rq ../cycle/24 24
