# Beds of spheres as regions, and walls whose resistance the bed's own model gives (granularContact): against msddFoam in a mesh of
# three dimensions, against closed forms, in both programs, with what is refused; walls that are not meshed (granularWall). Region 'bed'
# is grains, 'plate' an ordinary solid.

. "$here/region_cases"
sphere_grains() { # entries of spheresCoeffs, other entries
    foam_file "${3:-constant/bed/granularProperties}" dictionary <<-END
	density 7750; youngModulus 200e9; thermalConductivity 42; heatCapacity 464; thermalExpansion 1.2e-6; meanRadius 1e-3; mechanics none;
	surrogate { type spheres; spheresCoeffs { poissonRatio 0.29; $1 } }
	${2:-}
	END
}
sphere_fields() { # folder of the fields, stress (xx xy xz yy yz zz), tension positive
    local name empty="${3:-frontAndBack { type empty; \}}"
    for name in porosity fabricIndex; do
        foam_file "$1/$name" volScalarField <<< "dimensions [0 0 0 0 0 0 0]; internalField uniform $([ $name = porosity ] && echo 0.42 || echo 0);
            boundaryField { $empty \".*\" { type zeroGradient; } }"
    done
    foam_file "$1/stress" volSymmTensorField <<< "dimensions [1 -1 -2 0 0 0 0]; internalField uniform ($2); boundaryField { $empty \".*\" { type zeroGradient; } }"
}
largest_difference() { # scale, then two commands whose output is compared number by number
    paste -d ' ' <(eval "$2") <(eval "$3") | awk -v scale="$1" '{ for (i = 1; i <= NF/2; i++) { e = ($i - $(i + NF/2))/scale; if (e < 0) e = -e; if (!(e <= w)) w = e }; n++ }
        END { print (n > 1 ? w + 0 : "nan") }'
}

# A block of spheres in air, 30 mm long, with three different temperatures on its sides and a stress that is not isotropic.
block_mesh='scale 0.001; vertices ((0 0 0) (30 0 0) (30 20 0) (0 20 0) (0 0 10) (30 0 10) (30 20 10) (0 20 10)); blocks (hex (0 1 2 3 4 5 6 7) (9 6 4)
    simpleGrading (1 1 1)); boundary ( hot { type wall; faces ((0 4 7 3)); } cold { type wall; faces ((1 2 6 5)); } warm { type wall; faces ((4 5 6 7)); }
    sides { type wall; faces ((0 1 5 4) (3 7 6 2) (0 3 2 1)); } );'
block_T='hot { type fixedValue; value uniform 400; } cold { type fixedValue; value uniform 300; } warm { type fixedValue; value uniform 370; } sides { type zeroGradient; }'
block_alone() { # folder, stress: for msddFoam
    changed "$1"
    rm -rf 0 constant/granularProperties
    foam_file system/blockMeshDict dictionary <<< "$block_mesh"
    sphere_grains "gas air; ${3:-}" '' constant/granularProperties
    sphere_fields 0 "$2" ' '
    foam_file 0/T volScalarField <<< "dimensions [0 0 0 1 0 0 0]; internalField uniform 330; boundaryField { $block_T }"
    controls 'startFrom latestTime; endTime 40; deltaT 2; writeControl timeStep; writeInterval 20; adjustTimeStep no; functions {}'
    scheme 'timeScheme paper;'
    logged blockMesh
}
block_region() { # folder, stress
    regions "$1" bed 1
    controls 'endTime 40; deltaT 2; writeInterval 20;'
    region bed '2 2' '0 0 1 1'
    foam_file system/bed/blockMeshDict dictionary <<< "$block_mesh"
    logged blockMesh -region bed
    foam_file constant/bed/thermophysicalProperties dictionary <<< 'thermoType granularSolidThermo;'
    sphere_grains "gas air; ${3:-}"
    sphere_fields 0/bed "$2" ' '
    foam_file 0/bed/T volScalarField <<< "dimensions [0 0 0 1 0 0 0]; internalField uniform 330; boundaryField { $block_T }"
    foam_file 0/bed/p volScalarField <<< 'dimensions [1 -1 -2 0 0 0 0]; internalField uniform 1e5; boundaryField { ".*" { type zeroGradient; } }'
}
spheres_in_space() {
    local e name differing='' along='-2e6 0 0 -2.6e6 0 -3.4e6'
    block_alone block-alone "$along"
    logged msddFoam
    block_region block-region "$along"
    logged chtMultiRegionFoam
    e=$(largest_difference 100 'field 40/bed/T' "field $work/block-alone/40/T")
    check "spheres as region in three dimensions against msddFoam, 20 steps: T differs by $e <= 1e-6 of the range" below "$e" 1e-6
    e=$(largest_difference 1 'field 40/bed/conductivity' "field $work/block-alone/40/conductivity")
    check "and the conductivity by $e <= 1e-6 W/(m K)" below "$e" 1e-6
    # Spheres of 2 mm that radiate, less where they are hotter
    local radiates='emissivity table ((300 0.9) (400 0.5));' dark
    dark=$(field 40/bed/conductivity | tail -n 1)
    block_alone block-alone-radiates "$along" "$radiates"
    logged msddFoam
    block_region block-region-radiates "$along" "$radiates"
    logged chtMultiRegionFoam
    e=$(largest_difference 1 'field 40/bed/conductivity' "field $work/block-alone-radiates/40/conductivity")
    check "with a table of the emissivity the conductivities differ by $e <= 1e-6 W/(m K)" below "$e" 1e-6
    check "and are larger than without" awk "BEGIN { split(\"$dark $(field 40/bed/conductivity | tail -n 1)\", K, \" \"); exit !(K[7] > 1.005*K[1]) }"
    cd "$work/block-region"
    check "three conductivities: more along the larger stress" awk "BEGIN { split(\"$(field 40/bed/conductivity | tail -n 1)\", K, \" \"); exit !(K[1] < K[4] && K[4] < K[6]) }"
    check "one query of the model at the start and in each step" grep -qx 'Queries: 21' log
    mv 40 whole
    controls 'endTime 20; writeInterval 10;'
    logged chtMultiRegionFoam
    controls 'endTime 40;'
    logged chtMultiRegionFoam
    for name in whole/bed/*; do [ -d "$name" ] || cmp -s "$name" "40/bed/${name##*/}" || differing+=" ${name##*/}"; done
    check "spheres as region, restarted in the middle: bit for bit${differing:+, differing:$differing}" test -z "$differing"
    [ "$(foam_api)" -lt 2606 ] || return 0 # newer solvers take the whole tensor
    # The same stresses along other axes
    block_region block-turned '-2.6e6 0 0.5e6 -2.6e6 0 -3.1e6'
    region_message 'has a component K_xy, K_xz or K_yz in addition to those along the axes'
    check "refused: K_xz of spheres, with the size of the error: $(grep -o 'error of the heat flux is up to [0-9.]* %' log.bad)" test -n "$(grep -o 'error of the heat flux is up to' log.bad)"
    tr -s '\n ' ' ' < log.bad | grep -o 'coordinateSystem {.*; } }' >> constant/bed/thermophysicalProperties
    logged chtMultiRegionFoam
    e=$(sed -n 's/Largest relative error of the heat flux by what the axes leave out: //p' log | tail -n 1)
    check "accepted in the axes of the message, which leave out ${e:-0} <= 0.01 of the flux" below "${e:-0}" 0.01
}
region_message() { # message: the run must have failed with it, in words that may be broken into lines
    check "refused: $1" bash -c '! chtMultiRegionFoam > log.bad 2>&1; tr -s "\n " " " < log.bad | grep -qF -- "$1"' - "$1"
}

# Smooth spheres in a vacuum between 400 K and, behind a plate, 300 K. Contacts alone conduct, so that the wall's resistance is
# that of Hertz's contacts without 0.88 of the bed's own half diameter: 0.8 n (2 a k)/d^2, a = (3 F r/(4 E*))^(1/3), F = p d^2/n.
own='granularContact; value uniform 350;'
contact_case() { # folder, wall of spheresCoeffs, condition of T between the two
    regions "$1" 'bed plate' 60
    controls 'endTime 1e11; deltaT 1e11; writeInterval 1;'
    region bed '16 1' '0 0 0.02 0.01' 'right plate left'
    region plate '8 1' '0.02 0 0.03 0.01' 'left bed right'
    plate plate 15 500 7800
    foam_file constant/bed/thermophysicalProperties dictionary <<< 'thermoType granularSolidThermo;'
    sphere_grains "gas vacuum; $2" 'thermalExpansion 0;'
    sphere_fields 0/bed '-1e4 0 0 -1e4 0 -1e4'
    temperature bed 'uniform 350' "left { type fixedValue; value uniform 400; } right { type $3 } \".*\" { type zeroGradient; }"
    temperature plate 'uniform 350' "right { type fixedValue; value uniform 300; } left { type ${4:-$3} } \".*\" { type zeroGradient; }"
}
steel_wall='wall { thermalConductivity 15; youngModulus 200e9; poissonRatio 0.29; spheres 0.5; }'
flux_through() { # region, x of its first cell and spacing [m], conductivity: flux in the middle of the region [W/m2]
    field "$1" | awk -v dx="$2" -v k="$3" '{ T[NR] = $1 } END { m = int(NR/2); printf "%.10g", k*(T[m] - T[m + 1])/dx }'
}
own_contact() {
    local K R q law e
    contact_case contact-region "$steel_wall" "$own"
    region_heat
    logged chtMultiRegionFoam
    K=$(field 100000000000/bed/conductivity | awk 'NR == 1 { print $1 }')
    R=$(sed -n '/^    right/,/}/p' 100000000000/bed/wallResistance | grep -o 'uniform [0-9.e+-]*\|^[0-9.e+-]*$' | head -n 1 | sed 's/uniform //')
    law=$(awk -v K="$K" 'BEGIN { d = 2e-3; n = 0.5; E = 200e9/(2*(1 - 0.29^2)); F = 1e4*d*d/n; a = (0.75*F*1e-3/E)^(1/3)
        k = 2*42*15/(42 + 15); printf "%.10g", d*d/(0.8*n*2*a*k) - 0.88e-3/K }')
    e=$(awk "BEGIN { e = $R/$law - 1; print (e < 0 ? -e : e) }")
    check "resistance of a wall: $R m2 K/W, Hertz's contacts without 0.44 diameters of the bed $law, differ by $e <= 1e-8" below "$e" 1e-8
    law=$(awk "BEGIN { printf \"%.10g\", 100/(0.02/$K + $R + 0.01/15) }")
    q=$(flux_through 100000000000/plate/T 0.00125 15)
    e=$(awk "BEGIN { e = $q/$law - 1; print (e < 0 ? -e : e) }")
    check "heat through bed, wall and plate: $q W/m2, closed form $law, differ by $e <= 1e-6" below "$e" 1e-6
    e=$(tail -n 1 postProcessing/regionHeat/*/regionHeat.dat | awk '{ print $NF }')
    check "heat over both regions closes to $e <= 1e-9" below "$e" 1e-9
    # The same two regions in msddFoam, where the bed is the region without a name
    cp -r . "$work/contact-solid.new" && rm -rf "$work/contact-solid" && mv "$work/contact-solid.new" "$work/contact-solid" && cd "$work/contact-solid"
    rm -rf 100000000000 postProcessing
    mv 0/bed/* 0 && mv system/bed/* system && mv constant/bed/* constant && rm -r 0/bed system/bed constant/bed constant/thermophysicalProperties
    foam_file constant/regionProperties dictionary <<< 'regions (solid (plate));'
    sed -i 's/sampleRegion *bed/sampleRegion region0/' constant/plate/polyMesh/boundary
    foam_file system/controlDict dictionary <<< 'startFrom latestTime; startTime 0; stopAt endTime; endTime 1e11; deltaT 1e11; writeControl timeStep; writeInterval 1;
        writePrecision 17; timePrecision 12;'
    foam_file system/fvSolution dictionary <<< 'solvers { T { solver PCG; preconditioner DIC; tolerance 1e-16; relTol 0; } } msddFoam { timeScheme paper; }'
    cp system/fvSolution system/plate
    logged msddFoam
    e=$(largest_difference 100 'field 100000000000/plate/T' "field $work/contact-region/100000000000/plate/T")
    check "the same wall in msddFoam with a solid: T differs by $e <= 1e-7 of the range" below "$e" 1e-7
    contact_case contact-gas "$steel_wall" "$own"
    sphere_grains "gas helium; $steel_wall" 'thermalExpansion 0;'
    logged chtMultiRegionFoam
    check "gas takes from the resistance of the wall" awk "BEGIN { exit !($(sed -n '/^    right/,/}/p' 100000000000/bed/wallResistance \
        | grep -o 'uniform [0-9.e+-]*' | head -n 1 | sed 's/uniform //') < 0.2*$R) }"
}
radiating_contact() { # at 1000 K: contacts and radiation side by side to the first spheres; F of the bed is that of 0.6 instead of 0.58 of solid
    local K=() R law e emissivity
    for emissivity in 0 0.8; do
        contact_case contact-radiates "$steel_wall" "$own"
        sphere_grains "gas vacuum; emissivity $emissivity; $steel_wall" 'thermalExpansion 0;'
        sed -i 's/uniform 400/uniform 1000/; s/uniform 300/uniform 999/; s/uniform 350/uniform 999.5/' 0/*/T
        logged chtMultiRegionFoam
        K+=("$(field 100000000000/bed/conductivity | awk 'NR == 1 { print $1 }')")
    done
    R=$(sed -n '/^    right/,/}/p' 100000000000/bed/wallResistance | grep -o 'uniform [0-9.e+-]*\|^[0-9.e+-]*$' | head -n 1 | sed 's/uniform //')
    law=$(awk -v dark="${K[0]}" -v K="${K[1]}" 'BEGIN { d = 2e-3; n = 0.5; E = 200e9/(2*(1 - 0.29^2)); F = 1e4*d*d/n; a = (0.75*F*1e-3/E)^(1/3)
        k = 2*42*15/(42 + 15); black = 4*5.670374e-8*999.5^3; factor = (K - dark)/(black*d)
        hr = black/(1/0.8 - 0.44 + 0.335/factor); h = 0.8*n*2*a*k/d/d + hr; printf "%.10g", 1/h - 1e-3*(0.88 + 0.12*hr/h)/K }')
    e=$(awk "BEGIN { e = ($R - $law)/$law; print (e < 0 ? -e : e) }")
    check "a wall that radiates: $R m2 K/W, closed form $law, differ by $e <= 0.03" below "$e" 0.03
}
contact_in_parts() { # the wall is cut; helium, whose conductivity follows the temperature
    local e name
    contact_case contact-parts "$steel_wall" "$own"
    sphere_grains "gas helium; $steel_wall" ''
    for name in bed plate; do
        sed -i 's/(\([0-9]*\) 1 1)/(\1 6 1)/' system/$name/blockMeshDict
        logged blockMesh -region $name
    done
    sed -i 's/right { type granularContact; value uniform 350; }/& top { type fixedValue; value uniform 380; }/' 0/bed/T
    controls 'endTime 40; deltaT 4; writeInterval 10;'
    logged chtMultiRegionFoam
    mv 40 whole
    foam_file system/decomposeParDict dictionary <<< 'numberOfSubdomains 3; method simple; simpleCoeffs { n (1 3 1); delta 1e-3; }'
    cp system/decomposeParDict system/bed
    cp system/decomposeParDict system/plate
    logged decomposePar -allRegions
    logged timeout 600 mpirun --oversubscribe -np 3 chtMultiRegionFoam -parallel
    logged reconstructPar -allRegions -latestTime
    for name in bed plate; do
        e=$(largest_difference 100 "field whole/$name/T" "field 40/$name/T")
        check "three processes, the wall cut: T of $name differs by $e <= 1e-10 of the range" below "$e" 1e-10
    done
}
of_discs() { # discs touch a wall better than each other: the wall adds nothing
    local e
    for name in own stock; do
        regions "discs-$name" 'bed plate' 30
        region bed '12 8' '0 0 1 0.6' 'right plate left'
        region plate '6 8' '1 0 1.5 0.6' 'left bed right'
        bed bed
        plate plate 20 2 1500
        temperature bed 'uniform 50' "left { type fixedValue; value uniform 90; } right { type $([ $name = own ] && echo "$own" || coupled right | sed 's/^right { type//; s/}$//') } \".*\" { type zeroGradient; }"
        temperature plate 'uniform 50' "right { type fixedValue; value uniform 20; } left { type $([ $name = own ] && echo "$own" || coupled left | sed 's/^left { type//; s/}$//') } \".*\" { type zeroGradient; }"
        logged chtMultiRegionFoam
    done
    e=$(largest_difference 70 "field $work/discs-own/1/plate/T" "field $work/discs-stock/1/plate/T")
    check "a wall next to discs adds nothing: T differs by $e <= 1e-10 of the range from the stock condition" below "$e" 1e-10
}
walls_that_cannot_be() {
    contact_case contact-bad '' "$own"
    region_message "Entry 'wall' is missing: the conditions granularWall and granularContact of T need spheresCoeffs { wall"
    sphere_grains "gas vacuum; wall { thermalConductivity 15; youngModulus 200e9; poissonRatio 0.29; spheres 2; }" 'thermalExpansion 0;'
    region_message "Entry 'spheres' is 2, allowed: 0.01 to 1.16"
    contact_case contact-other "$steel_wall" "$own" "$(coupled left | sed 's/^left { type//; s/}$//')"
    region_message 'allowed: the same on both sides'
    contact_case contact-plain "$steel_wall" "$own"
    sed -i 's/right { type granularContact/& /; s/left { type fixedValue; value uniform 400/left { type granularContact; value uniform 350/' 0/bed/T
    region_message 'is of type wall, allowed: mappedWall'
    contact_case contact-implicit "$steel_wall" "granularContact; useImplicit true; value uniform 350;"
    region_message 'granularContact and useImplicit true, allowed: false'
    contact_case contact-solids "$steel_wall" "$own"
    plate bed 15 500 7800
    region_message 'a bed on neither side, allowed: a bed on one side at least'
}
region_heat() { controls 'functions { regionHeat { type regionHeat; libs ("libgranularFunctionObjects.so"); writeControl writeTime; } }'; }

# A wall that is not meshed (granularWall): temperature, coefficient or flux in series with the resistance. A slab of the same smooth
# spheres in a vacuum, 20 mm thick, the stress uniform: K and the resistance are constants, and T is a straight line.
slab_wall='wall { thermalConductivity 15; youngModulus 200e9; poissonRatio 0.29; spheres 0.5; }'
slab_mesh='scale 0.001; vertices ((0 0 0) (20 0 0) (20 6 0) (0 6 0) (0 0 4) (20 0 4) (20 6 4) (0 6 4)); blocks (hex (0 1 2 3 4 5 6 7) (16 3 1)
    simpleGrading (1 1 1)); boundary ( hot { type wall; faces ((0 4 7 3)); } cold { type wall; faces ((1 2 6 5)); }
    sides { type wall; faces ((4 5 6 7) (0 1 5 4) (3 7 6 2) (0 3 2 1)); } );'
slab() { # folder, condition of the hot wall, of the cold wall, further entries of spheresCoeffs, of granularProperties
    changed "$1"
    rm -rf 0 constant/granularProperties
    foam_file system/blockMeshDict dictionary <<< "$slab_mesh"
    sphere_grains "gas vacuum; $slab_wall ${4:-}" "${5:-thermalExpansion 0;}" constant/granularProperties
    sphere_fields 0 '-1e4 0 0 -1e4 0 -1e4' ' '
    foam_file 0/T volScalarField <<< "dimensions [0 0 0 1 0 0 0]; internalField uniform 350; boundaryField { hot { $2 } cold { $3 } sides { type zeroGradient; } }"
    controls 'libs ("libgranularThermo.so"); startFrom latestTime; timePrecision 12; endTime 1e11; deltaT 1e11; writeControl timeStep; writeInterval 1; adjustTimeStep no; functions {}'
    scheme 'timeScheme paper;'
    echo 'solvers { T { solver PCG; preconditioner DIC; tolerance 1e-16; relTol 0; } }' >> system/fvSolution
    logged blockMesh
}
held() { echo "type granularWall; mode temperature; temperature $1;"; }
slab_law() { # flux and both ends of T in the cells, of K, T and conductance [W/(m2 K)] next to the resistance at the hot wall, T of the cold wall, gap
    awk -v K="$1" -v hot="$2" -v h="$3" -v cold="$4" -v gap="${5:-0}" 'BEGIN { d = 2e-3; n = 0.5; E = 200e9/(2*(1 - 0.29^2)); F = 1e4*d*d/n
        a = (0.75*F*1e-3/E)^(1/3); k = 2*42*15/(42 + 15); R = d*d/(0.8*n*2*a*k) - (0.88e-3 - gap*d)/K; outer = h ? 1/h : 0
        q = (hot - cold)/(0.02/K + 2*R + outer); dx = 0.02/16
        printf "%.12g %.12g %.12g %.12g", R, q, hot - q*(outer + R + 0.5*dx/K), cold + q*(R + 0.5*dx/K) }'
}
ends() { field "$1" | awk -v n=16 '{ T[NR] = $1 } END { printf "%.15g %.15g", T[1], T[n] }'; } # T in the first and last cell of a row
slab_errors() { # largest error of both ends of T over the range of 100 K: file, law
    echo "$(ends "$1") $2" | awk '{ a = $1 - $5; b = $2 - $6; a = a < 0 ? -a : a; b = b < 0 ? -b : b; print (a > b ? a : b)/100 }'
}
walls_not_meshed() {
    local K law e q t=100000000000
    slab slab-held "$(held 400)" "$(held 300)"
    logged msddFoam
    K=$(field $t/conductivity | awk 'NR == 1 { print $1 }')
    law=$(slab_law "$K" 400 0 300)
    e=$(slab_errors $t/T "$law")
    check "walls of given temperature with their resistance ($law: m2 K/W, W/m2, ends of T): T is the closed form within $e <= 1e-8 of the range (linear solver)" below "$e" 1e-8
    check "the log says how much bed a wall stands for" grep -q 'Wall hot: the resistance between wall and grains is that of 0\.0' log
    slab slab-gap "$(held 400)" "$(held 300)"
    sed -i 's/spheres 0.5;/spheres 0.5; gap 0.125;/' constant/granularProperties
    logged msddFoam
    law=$(slab_law "$K" 400 0 300 0.125)
    e=$(slab_errors $t/T "$law")
    check "a mesh that ends 0.125 d before the walls: T is the closed form within $e <= 1e-8 of the range" below "$e" 1e-8
    slab slab-coefficient 'type granularWall; mode coefficient; h 10; Ta 400;' "$(held 300)"
    logged msddFoam
    e=$(slab_errors $t/T "$(slab_law "$K" 400 10 300)")
    check "a heat transfer coefficient outside: within $e <= 1e-8" below "$e" 1e-8
    # The flux of the second case leads to its temperatures
    q=$(slab_law "$K" 400 10 300 | awk '{ print $2 }')
    slab slab-flux "type granularWall; mode flux; q $q;" "$(held 300)"
    logged msddFoam
    e=$(slab_errors $t/T "$(slab_law "$K" 400 10 300)")
    check "a heat flux: within $e <= 1e-8" below "$e" 1e-8
    slab slab-off "$(held 400) resistance off;" "$(held 300) resistance off;"
    logged msddFoam
    slab slab-fixed 'type fixedValue; value uniform 400;' 'type fixedValue; value uniform 300;'
    logged msddFoam
    e=$(largest_difference 100 "field $t/T" "field $work/slab-off/$t/T")
    check "resistance off: T of fixedValue within $e <= 1e-12 of the range" below "$e" 1e-12
    check "walls without it are in the log" grep -q 'Walls without resistance between wall and grains: hot, cold' log
    # Against a solid of one temperature
    own_as_solid
}
own_as_solid() { # the region's case with granularContact, next to a plate that conducts so well that it has one temperature
    local e name
    contact_case contact-isothermal "$steel_wall" "$own"
    plate plate 1e9 500 7800
    logged chtMultiRegionFoam
    contact_case wall-region "$steel_wall" "$own"
    sed -i 's/right { type granularContact[^}]*}/right { type granularWall; temperature 300; }/; s/left { type fixedValue[^}]*}/left { type fixedValue; value uniform 400; }/' 0/bed/T
    sed -i 's/left { type granularContact[^}]*}/left { type zeroGradient; }/' 0/plate/T
    for name in bed plate; do # no longer coupled
        sed -i 's/mappedWall/wall/' constant/$name/polyMesh/boundary
    done
    region_heat
    logged chtMultiRegionFoam
    e=$(largest_difference 100 'field 100000000000/bed/T' "field $work/contact-isothermal/100000000000/bed/T")
    check "in a region, against granularContact next to a solid of one temperature: T differs by $e <= 1e-7 of the range" below "$e" 1e-7
    e=$(tail -n 1 postProcessing/regionHeat/*/regionHeat.dat | awk '{ print $NF }')
    check "heat of the region closes to $e <= 1e-9" below "$e" 1e-9
}
walls_in_time() { # helium that radiates, a wall that follows a table, adaptive steps: balance, restart, processes
    local e name differing='' balance='functions { heatAudit { type heatAudit; libs ("libgranularFunctionObjects.so"); writeControl writeTime; tolerance 1e-9; } }'
    slab slab-time "$(held 'table ((0 350) (20 800))')" 'type granularWall; mode coefficient; h table ((0 50) (40 100)); Ta 300;' 'gas helium; emissivity 0.8;' ' '
    controls "endTime 40; deltaT 1; writeInterval 20; writeControl runTime; adjustTimeStep yes; $balance"
    scheme 'timeScheme secondOrder; temperatureTolerance 0.05;'
    cp -r . ../slab-cut.new && rm -rf ../slab-cut && mv ../slab-cut.new ../slab-cut
    logged msddFoam
    e=$(tail -n 1 postProcessing/heatAudit/*/heatAudit.dat | awk '{ print $NF }')
    check "walls over time, adaptive steps: the heat closes to $e <= 1e-9" below "$e" 1e-9
    mv 40 whole
    logged msddFoam
    for name in whole/*; do [ -d "$name" ] || cmp -s "$name" "40/${name##*/}" || differing+=" ${name##*/}"; done
    check "restarted in the middle: the same bytes${differing:+, differing:$differing}" test -z "$differing"
    cd ../slab-cut
    in_parts '1 3'
    side_by_side 3
    logged reconstructPar -latestTime
    e=$(largest_difference 500 'field 40/T' 'field ../slab-time/whole/T')
    check "three processes, the walls cut: T differs by $e <= 1e-9 of the range" below "$e" 1e-9
    # The resistance of the second stage is that of its temperature
    local fixed
    for fixed in 2 1 0.5; do
        cp -r ../slab-time "../slab-order.new" && rm -rf "../slab-order-$fixed" && mv ../slab-order.new "../slab-order-$fixed" && cd "../slab-order-$fixed"
        rm -rf [1-9]* whole postProcessing
        controls "functions {} deltaT $fixed; adjustTimeStep no; writeInterval 40;"
        scheme 'timeScheme secondOrder; logInterval 1000;'
        logged msddFoam
    done
    e=$(paste -d ' ' <(field ../slab-order-2/40/T) <(field ../slab-order-1/40/T) <(field 40/T) | awk '{ a = $1 - $2; b = $2 - $3; a = a < 0 ? -a : a; b = b < 0 ? -b : b
        A = a > A ? a : A; B = b > B ? b : B } END { print A/B }')
    check "halving of the step, fixed steps: the change of T falls by a factor of $e, 3.3 to 5 (second order: 4)" is_within "$e" 3.3 5
}
walls_refused() {
    slab slab-bad 'type granularWall; mode coefficient; h 10; Ta 400;' "$(held 300)"
    local of message
    while IFS='|' read -r of message; do
        sed -i "s/hot { [^}]*}/hot { type granularWall; $of }/" 0/T
        check "refused: $of" foreseen "$message"
    done <<-'END'
	mode colder;|colder
	mode flux; h 10;|the entry 'h' with mode flux, allowed: with mode coefficient
	temperature -5;|the entry 'temperature' is -5 at the time 0, allowed: > 0
	temperatur 300;|temperatur
	mode temperature;|temperature
	END
    slab slab-nowall "$(held 400)" "$(held 300)"
    sed -i 's/wall {[^}]*}//' constant/granularProperties
    check "refused: no properties of the wall" foreseen "Entry 'wall' is missing: the conditions granularWall and granularContact of T need"
}

spheres_in_space
own_contact
radiating_contact
contact_in_parts
of_discs
walls_that_cannot_be
walls_not_meshed
walls_in_time
walls_refused
