# Beds of spheres in three dimensions: the case steel compared with its measurement, what pressure, gas and stress change, growth in cells
# that keep their shape, a restart, several processes, and the messages at input that cannot work.

steel() { # folder: a copy of the case steel with a coarse mesh and few steps
    rm -rf "${work:?}/$1"
    mkdir -p "$work"
    cp -r "$checkout/cases/steel" "$work/$1"
    cd "$work/$1"
    "$checkout/cases/common/clean" > /dev/null
    # As deep as in the sources, but next to the tests.
    sed -i "s#../../common#$checkout/cases/common#" system/*
    sed -i 's/(2 2 100)/(1 1 20)/; s/^stopAt .*/stopAt endTime;/; s/^endTime .*/endTime 100;/; s/^writeInterval .*/writeInterval 50;/' \
        system/blockMeshDict system/controlDict
    logged blockMesh
}
component() { # file of a symmTensor field, component from 1: its value in the last cell
    grep -o '([-+0-9.e]* [-+0-9.e]* [-+0-9.e]* [-+0-9.e]* [-+0-9.e]* [-+0-9.e]*)' "$1" | tail -n 1 | tr -d '()' | cut -d ' ' -f "$2"
}
apart() { # two files of a scalar field: largest difference
    paste -d ' ' <(field "$1") <(field "$2") | awk 'BEGIN { worst = 0 }
        { e = $1 - $2; if (e < 0) e = -e; if (!(e <= worst)) worst = e; n++ } END { print (n > 1 ? worst : "nan") }'
}
coefficient() { sed -i "s/^\( *\)$1 .*;/\1$1 $2;/" constant/granularProperties; }

measured_bed() {
    local end worst
    steel steel
    sed -i 's/(1 1 20)/(1 1 50)/' system/blockMeshDict
    sed -i 's/^endTime .*/endTime 4000;/; s/^writeInterval .*/writeInterval 4000;/' system/controlDict
    logged blockMesh
    logged msddFoam
    end=$(component 4000/conductivity 6)
    check "steel spheres in air conduct $end W/(m K), elements 0.48 to 0.50" is_within "$end" 0.43 0.53
    # The last measurement at each place, in the order of the probes.
    worst=$(awk -F, '!/^#/ && $1 + 0 > 0 { last[$1] = $3 } END { print last["0.040"], last["0.060"], last["0.073"] }' \
        "$checkout/cases/beaulieu/experiment.csv" | paste -d ' ' - <(tail -n 1 postProcessing/probes/0/T) \
        | awk '{ for (i = 1; i <= 3; i++) { e = $(4 + i) - 273.15 - $i; if (e < 0) e = -e; if (!(e <= worst)) worst = e }; print worst }')
    check "after 4000 s within $worst <= 1.5 K of the measured temperatures" below "$worst" 1.5
    check "all answers inside the range of the law" grep -qx 'answers_outside: 0' log
}
# Rms of one row of what compare-dem prints
apart_by() { awk -v name="$1" 'substr($0, 1, length(name)) == name { split(substr($0, 23), n, " "); print n[2] }' differences; }
# What is wanted compared with DEM: 1 % of the range of T, 5 % of pressures, 3 % of the conductivity
as_dem() { # what, largest error of the conductivity
    local t p k wall
    t=$(apart_by 'T at the probes') p=$(apart_by 'p ') k=$(apart_by K) wall=$(apart_by 'stress on the wall')
    check "$1: T differs from the elements by $t <= 1 % of its range (rms)" below "$t" 1
    check "its pressure by $p <= 5 %" below "$p" 5
    check "its conductivity by $k <= $2 %" below "$k" "$2"
    check "and the stress on its wall by $wall <= 5 %" below "$wall" 5
}
column() { # folder: a copy of the case column
    rm -rf "${work:?}/$1"
    cp -r "$checkout/cases/column" "$work/$1"
    cd "$work/$1"
    "$checkout/cases/common/clean" > /dev/null
    sed -i "s#../../common#$checkout/cases/common#" system/*
    logged blockMesh
}
pressed_bed() { # the case column compared with 20 000 spheres
    local same
    column column
    logged msddFoam
    "$checkout/cases/common/compare-dem" lid zz xx yy zz > differences
    check "no warning, not of MPI either" [ "$(grep -c 'FOAM Warning' log)" = 0 ]
    as_dem "a column that is pressed and heated" 2
    check "how much one packing differs from the mean is printed" [ "$(awk '$1 == "p" { print ($5 > 0.5 && $5 < 10) }' differences)" = 1 ]
    rm dem-scatter.csv
    "$checkout/cases/common/compare-dem" lid zz xx yy zz > alone
    same=$(diff <(cut -c1-49 differences) <(cut -c1-49 alone) > /dev/null && echo yes)
    check "the differences are the same without it" [ "$same" = yes ]
    check "refused: no such wall" fails "$checkout/cases/common/compare-dem" roof zz xx yy zz
    check "refused: no component" fails "$checkout/cases/common/compare-dem" lid zz xx yy z
}
fails() { ! "$@" > /dev/null 2>&1; }
heated_store() { # the case store compared with 20 000 spheres
    rm -rf "${work:?}/store"
    cp -r "$checkout/cases/store" "$work/store"
    cd "$work/store"
    "$checkout/cases/common/clean" > /dev/null
    sed -i "s#../../common#$checkout/cases/common#" system/*
    logged blockMesh
    logged msddFoam
    "$checkout/cases/common/compare-dem" $(sed -n 's/.*compare-dem //p' Allrun) > differences
    as_dem "a store that is heated ten times" 3
}
what_changes_it() {
    local plain other
    steel spheres-air
    logged msddFoam
    plain=$(component 100/conductivity 6)
    check "isotropic stress conducts alike in all directions" [ "$plain" = "$(component 100/conductivity 1)" ]
    # 10 Pa: molecules fly from sphere to sphere; the heart of the bed is as usual
    steel spheres-thin
    sed -i 's/gas  *air;/& gasPressure 10;/' constant/granularProperties
    logged msddFoam
    check "a gas that is too thin is distinguished from other reasons" \
        grep -q '^  *- Range.* By the gas or its temperature 100 %\. ' log
    check "and so it is for programs" [ "$(sed -n 's/^answers_outside_by_//p' log | tr '\n' ' ')" = \
        "gas: $(sed -n 's/^answers_outside: //p' log) " ]
    steel spheres-vacuum
    coefficient gas vacuum
    logged msddFoam
    other=$(component 100/conductivity 6)
    check "in a vacuum contacts alone conduct: $other of $plain" is_within "$other" 0.05 0.12
    steel spheres-pressed
    coefficient gas vacuum
    sed -i 's/^internalField .*/internalField uniform (-2.48e6 0 0 -2.48e6 0 -2.48e6);/' 0/stress
    logged msddFoam
    plain=$(component 100/conductivity 6)
    # (1000)^(1/3) = 10, with more contacts, and roughness counts less
    check "under a thousand times the pressure contacts conduct $plain, 10 to 18 times as well" \
        is_within "$(awk "BEGIN { print $plain/$other }")" 10 18
    steel spheres-uniaxial
    coefficient gas vacuum
    sed -i 's/^internalField .*/internalField uniform (-1.98e6 0 0 -1.98e6 0 -3.48e6);/' 0/stress
    logged msddFoam
    check "more along the larger stress" is_within \
        "$(awk "BEGIN { print $(component 100/conductivity 6)/$(component 100/conductivity 1) }")" 1.05 1.4
}
contacts() {
    local few many
    conducts() { # contacts, mobilised friction
        steel "spheres-$1-$2" > /dev/null
        coefficient gas vacuum
        coefficient coordination "$1; mobilised $2"
        logged msddFoam > /dev/null
        component 100/conductivity 6
    }
    few=$(conducts 4 0)
    many=$(conducts 6 0)
    # C grows by about a fifth with a contact per sphere.
    check "six contacts per sphere conduct $many, four $few W/(m K)" \
        is_within "$(awk "BEGIN { print $many/$few }")" 1.3 1.8
    few=$(conducts 4 0.9)
    many=$(conducts 6 0.9)
    check "where friction is mobilised some of the six only rest on others, and they conduct $many, four $few" \
        is_within "$(awk "BEGIN { print $many/$few }")" 1.1 1.3
    few=$(conducts 4 0.85)
    steel spheres-many
    coefficient gas vacuum
    coefficient coordination 6
    sed 's/object *porosity;/object coordination;/; s/^internalField .*/internalField uniform 4;/' 0/porosity > 0/coordination
    rm -rf 50 100
    logged msddFoam
    check "a field of contacts comes before the key" [ "$(component 100/conductivity 6)" = "$few" ]
    coefficient coordination 13
    check "refused: more contacts than spheres have" refused "Entry 'coordination' is 13"
}
# In a vacuum smooth unequal spheres are equal ones of the solid fraction 1 - 0.62 s^2 times theirs and 5.4 s^2 more contacts, with the
# same heat capacity of the bed.
unequal() {
    local worst
    smooth() { # folder
        steel "$1" > /dev/null
        coefficient gas vacuum
        coefficient roughness "0; $2"
    }
    smooth spheres-unequal 'sizeSpread 0.2'
    logged msddFoam
    smooth spheres-equal 'sizeSpread 0'
    sed -i "s/uniform 0.413/uniform $(awk 'BEGIN { printf "%.15g", 1 - 0.587*(1 - 0.62*0.04) }')/" 0/porosity
    sed -i "s#^density .*#density $(awk 'BEGIN { printf "%.15g", 7747/(1 - 0.62*0.04) }');#" constant/granularProperties
    coefficient coordination "$(awk '$1 == "coordination" { printf "%.15g", $2 + 5.4*0.04 }' constant/granularProperties)"
    logged msddFoam
    worst=$(apart 100/T ../spheres-unequal/100/T)
    check "unequal spheres heat as equal ones of a lower solid fraction: apart by $worst <= 1e-5 K" below "$worst" 1e-5
    steel spheres-unequal
    coefficient roughness '3.4e-7; sizeSpread 0.5'
    check "refused: spheres of too unequal size" refused "Entry 'sizeSpread' is 0.5"
}
pressed_with() { # mobilised friction: stress on the lid of the column when it turns
    column "column-mobilised-$1" > /dev/null
    coefficient mobilised "$1"
    sed -i 's/^endTime .*/endTime 12000;/' system/controlDict
    logged msddFoam > /dev/null
    awk '$1 == 12000 { gsub(/[()]/, " "); print -$7 }' postProcessing/wall/0/surfaceFieldValue.dat
}
grown() { # folder, entry of spheresCoeffs: the radii grow in cells that keep their shape
    steel "$1"
    sed -i 's/^thermalExpansion .*/thermalExpansion 1.2e-5;/' constant/granularProperties
    sed -i 's/^internalField .*/internalField uniform 293.15;/' 0/T
    coefficient coordination "5; $2"
}
# A bed that has mobilised less friction is stiffer where it is pressed along one axis. (Where it grows in cells that keep their shape
# hardly anything slides, and it is nearly as stiff.)
friction() {
    local all half
    all=$(pressed_with 1)
    half=$(pressed_with 0.5)
    check "with half of its friction mobilised a bed presses by $half Pa on its lid, with all of it by $all" \
        is_within "$(awk "BEGIN { print $half/$all }")" 1.1 3
    grown friction-all 'mobilised 1'
    logged msddFoam
    all=$(component 100/stress 1)
    grown friction-half 'mobilised 0.5'
    logged msddFoam
    half=$(component 100/stress 1)
    check "heated in cells that keep their shape, by $half and $all Pa" is_within "$(awk "BEGIN { print $half/$all }")" 0.9 1.1
    check "which are not the same" [ "$half" != "$all" ]
    check "the state says so" is_within "$(field 50/mobilised | tail -n 1)" 0.4 0.5001
    grown friction-field ''
    sed 's/object *porosity;/object mobilised;/; s/^internalField .*/internalField uniform 0.5;/' 0/porosity > 0/mobilised
    logged msddFoam
    check "a field of mobilised friction comes before the key" [ "$(component 100/stress 1)" = "$half" ]
    grown friction-wrong 'mobilised 1.5'
    check "refused: more friction than there is" refused "Entry 'mobilised' is 1.5"
}
# A bed that was poured: more contacts along gravity, z, than the stress tells. Grains that grow press more along z then.
directions() {
    local usual poured
    grown fabric-usual ''
    logged msddFoam
    usual=$(awk "BEGIN { print $(component 100/stress 6)/$(component 100/stress 1) }")
    grown fabric-poured 'fabric (0.325 0 0 0.325 0 0.35)'
    logged msddFoam
    poured=$(awk "BEGIN { print $(component 100/stress 6)/$(component 100/stress 1) }")
    check "with the fabric of a poured bed the vertical stress of a heated bed is $poured of the horizontal one, without $usual" \
        is_within "$(awk "BEGIN { print $poured/$usual }")" 1.003 1.5
    poured="$(component 100/stress 1) $(component 100/stress 6)"
    grown fabric-field ''
    sed 's/object *stress;/object fabric;/; s/^dimensions .*/dimensions [0 0 0 0 0 0 0];/; s/^internalField .*/internalField uniform (0.325 0 0 0.325 0 0.35);/' \
        0/stress > 0/fabric
    logged msddFoam
    check "a field of fabric does the same" [ "$(component 100/stress 1) $(component 100/stress 6)" = "$poured" ]
    sed -i 's/^dimensions .*/dimensions [0 1 0 0 0 0 0];/' 0/fabric
    rm -rf 50 100
    check "refused: a fabric with a unit" refused 'Field fabric in'
    grown fabric-wrong 'fabric (1 0 0 1 0 1)'
    check "refused: a fabric whose trace is not 1" refused "Entry 'fabric' is (1 0 0 1 0 1)"
}
growth() {
    local p strain
    steel spheres-growing
    sed -i 's/^thermalExpansion .*/thermalExpansion 1.2e-5;/' constant/granularProperties
    sed -i 's/zeroGradient/fixedValue; value uniform 326.15/; s/^internalField .*/internalField uniform 293.15;/' 0/T
    sed -i 's/^endTime .*/endTime 40000;/; s/^deltaT .*/deltaT 400;/; s/^writeInterval .*/writeInterval 40000;/' system/controlDict
    logged msddFoam
    p=$(component 40000/stress 1)
    # 33 K grow the spheres by 4e-4: boxes that begin under little pressure come to 1.4e-6 to 2.6e-6 E*, with E* = 1.09e11 Pa.
    check "33 K in a rigid box press by $p Pa" is_within "$p" -5e5 -1e5
    check "the stress is three-dimensional" is_within "$(awk "BEGIN { print $(component 40000/stress 6)/($p) }")" 0.99 1.01
}
again_and_in_parts() {
    steel spheres-straight
    sed -i 's/^thermalExpansion .*/thermalExpansion 1.2e-6;/' constant/granularProperties
    logged msddFoam
    rm -rf ../spheres-restarted ../spheres-processes
    cp -r . ../spheres-restarted
    cp -r . ../spheres-processes
    cd ../spheres-restarted
    rm -rf 100
    sed -i 's/^startFrom .*/startFrom latestTime;/' system/controlDict
    logged msddFoam
    local e
    e=$(apart 100/T ../spheres-straight/100/T)
    check "a restart in the middle gives temperatures that differ by $e <= 1e-4 K" below "$e" 1e-4
    e=$(apart 100/elasticCompression ../spheres-straight/100/elasticCompression)
    check "and compressions that differ by $e <= 1e-10" below "$e" 1e-10
    cd ../spheres-processes
    rm -rf 50 100
    cat > system/decomposeParDict <<-END
	FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
	numberOfSubdomains 3;
	method simple;
	simpleCoeffs { n (1 1 3); delta 1e-3; }
	END
    logged decomposePar
    logged mpirun --oversubscribe -np 3 msddFoam -parallel
    logged reconstructPar
    e=$(apart 100/T ../spheres-straight/100/T)
    check "three processes: T differs by $e <= 1e-4 K" below "$e" 1e-4
}
refusals() {
    steel spheres-bad
    mv 0/stress stress
    check "refused: no stress at the start" refused 'Field stress is missing'
    mv stress 0/stress
    coefficient gas steam
    check "refused: an unknown gas" refused "Entry 'gas' is 'steam', allowed: air, nitrogen, helium, argon, vacuum"
    coefficient gas helium
    sed -i 's/^thermalConductivity .*/thermalConductivity 0.05;/' constant/granularProperties
    check "refused: a solid that conducts less than the gas" refused 'at least that of the gas'
    sed -i 's/^thermalConductivity .*/thermalConductivity 42;/' constant/granularProperties
    sed -i 's/uniform 0.413/uniform 0.9/' 0/porosity
    check "refused: a porosity that no packing has" refused 'solid_fraction[0]'
    sed -i 's/uniform 0.9/uniform 0.413/' 0/porosity
    sed -i 's/gas .*;/gass air;/' constant/granularProperties
    check "refused: an unknown key" refused "Unknown entry 'gass'"
}
measured_bed
pressed_bed
heated_store
what_changes_it
contacts
unequal
friction
directions
growth
again_and_in_parts
refusals
