# A bed next to fluids in OpenFOAM's own chtMultiRegionFoam: water that flows past a plate, whose heat is balanced up to its outlet, and a gap
# of air through which the bed radiates, against the closed form. The flow is given (frozenFlow), so that steps may be long.

. "$here/region_cases"
water_past_a_plate() {
    local e given carried
    regions beside-water 'bed plate' 700 water
    controls 'endTime 1e7; deltaT 1e7; writeInterval 1; functions { regionHeat { type regionHeat; libs ("libgranularFunctionObjects.so"); writeControl writeTime; writePrecision 15; } }'
    region bed '12 10' '0 0 0.3 0.2' 'right plate left'
    region plate '4 10' '0.3 0 0.32 0.2' 'left bed right right water left'
    fluid water '6 10' '0.32 0 0.35 0.2' 'left plate right' 1000 4000 1e-3 4 '0 1e-3 0'
    bed bed 'surrogate { type constant; constantCoeffs { conductivity (2 0 0 1 0 0); } } thermalExpansion 0;'
    plate plate 20 500 7800
    temperature bed 'uniform 300' "left { type fixedValue; value uniform 400; } $(coupled right 1e-3) \".*\" { type zeroGradient; }"
    temperature plate 'uniform 300' "$(coupled left 1e-3) $(coupled right) \".*\" { type zeroGradient; }"
    start water T '0 0 0 1 0 0 0' 'uniform 300' "$(of_fluid left) bottom { type fixedValue; value uniform 300; } \".*\" { type zeroGradient; }"
    logged chtMultiRegionFoam
    given=$(tail -n 1 postProcessing/regionHeat/*/regionHeat.dat | awk '{ printf "%.15g", -$5 }')
    # Water: 1 kg/(m2 s), 4000 J/(kg K), 1 W/(m K); its cells are 5 mm wide, 20 mm high and 10 mm deep, and hold 4 J/K
    carried=$(field 10000000/water/T | awk '{ T[NR] = $1 } END { for (i = 1; i <= 6; i++) q += 4000*(T[54 + i] - 300) + (T[i] - 300)/0.01
        for (i = 1; i <= 60; i++) stored += 4*(T[i] - 300)
        printf "%.10g", NR == 60 ? 1e7*q*0.005*0.01 + stored : "nan" }')
    e=$(awk "BEGIN { e = $given/$carried - 1; print (e < 0 ? -e : e) }")
    check "bed, plate and water that flows: $given J left the solids, $carried J went with the water or stayed in it, differ by $e <= 1e-9" below "$e" 1e-9
    e=$(tail -n 1 postProcessing/regionHeat/*/regionHeat.dat | awk '{ print $NF }')
    check "heat over the solids next to water closes to $e <= 1e-9" below "$e" 1e-9
}
bed_that_radiates() { # 1000 K | bed | air at rest | black wall of 300 K: q = K (1000 - T)/a = sigma (T^4 - 300^4) + k (T - 300)/b
    local e T
    regions radiating bed 40 air
    controls 'endTime 1e9; deltaT 1e8; writeInterval 10;'
    region bed '20 1' '0 0 0.1 0.01' 'right air left'
    fluid air '10 1' '0.1 0 0.12 0.01' 'left bed right' 1 1000 1e-5 0.5 '0 0 0'
    sed -i 's/bottom { type wall;/bottom { type empty;/; s/top { type wall;/top { type empty;/' system/air/blockMeshDict
    logged blockMesh -region air
    sed -i 's/bottom { type fixedValue; value uniform ([^)]*); } top { type zeroGradient; }/bottom { type empty; } top { type empty; }/' 0/air/U
    sed -i 's/top { type fixedValue; value uniform 1e5; }/bottom { type empty; } top { type empty; }/' 0/air/p 0/air/p_rgh
    foam_file constant/air/radiationProperties dictionary <<< 'radiation on; radiationModel fvDOM; fvDOMCoeffs { nPhi 2; nTheta 1; maxIter 5; tolerance 1e-12; }
        solverFreq 1; absorptionEmissionModel none; scatterModel none; sootModel none; transmissivityModel none;'
    foam_file constant/air/boundaryRadiationProperties dictionary <<< '"left|right" { type lookup; emissivity 1; absorptivity 1; transmissivity 0; }'
    start air IDefault '1 0 -3 0 0 0 0' 'uniform 0' '"left|right" { type greyDiffusiveRadiation; T T; value uniform 0; } bottom { type empty; } top { type empty; }'
    bed bed 'surrogate { type constant; constantCoeffs { conductivity (2 0 0 1 0 0); } } thermalExpansion 0;'
    temperature bed 'uniform 600' "left { type fixedValue; value uniform 1000; } $(coupled right | sed 's/}$/qrNbr qr; qr none; }/') \".*\" { type zeroGradient; }"
    start air T '0 0 0 1 0 0 0' 'uniform 500' "$(of_fluid left 'qrNbr none; qr qr;') right { type fixedValue; value uniform 300; } bottom { type empty; } top { type empty; }"
    logged chtMultiRegionFoam
    T=$(awk 'BEGIN { low = 300; high = 1000; for (i = 0; i < 100; i++) { T = (low + high)/2
        if (2*(1000 - T)/0.1 > 5.670374e-8*(T^4 - 300^4) + 0.02*(T - 300)/0.02) low = T; else high = T }; printf "%.10g", T }')
    e=$(field 1000000000/bed/T | awk -v T="$T" 'END { wall = $1 - (1000 - T)*0.025; e = wall - T; print (e < 0 ? -e : e) }')
    check "a bed that radiates through a gap of air: its surface differs by $e <= 0.05 K from the closed form $T K" below "$e" 0.05
}
water_past_a_plate
bed_that_radiates
