# Properties that depend on the temperature: the heat that is stored against the integral of the heat capacity, heat balances, and the
# conductivity of spheres against that of a number; what is refused.

bed_at_rest() { # folder: a block of eight cells that keep their place
    spheres_bed "$1" 'walls { ".*" { type frictionless; } }'
    sed -i 's/mechanics equilibrium/mechanics none/; /^\tequilibriumCoeffs\|^equilibriumCoeffs/d; s/thermalExpansion 1e-5/thermalExpansion 0/' \
        constant/granularProperties
    cube 2
}
property() { sed -i "s/$1 [0-9.]*;/$1 $2;/" constant/granularProperties; }
heated_through() { # heat capacity, time scheme, heat [J/kg] that it must have taken as a function of T in awk
    local e
    bed_at_rest "properties-$2"
    property heatCapacity "$1"
    scheme "timeScheme $2; nNonOrthogonalCorrectors 5;"
    # 2500*0.59 kg/m3; 300 K to about 800 K
    cat > constant/fvOptions <<-'END'
	FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }
	heating { type scalarSemiImplicitSource; active yes; selectionMode all; volumeMode specific; injectionRateSuSp { T (5e6 0); } }
	END
    controls 'endTime 100; deltaT 20; writeInterval 5; functions { heatAudit { type heatAudit; libs ("libgranularFunctionObjects.so"); } }'
    logged msddFoam
    e=$(field 100/T | awk 'function heat(T) { return '"$3"' } { e = (heat($1) - heat(300))/(5e8/(2500*0.59)) - 1; if (e < 0) e = -e; if (!(e <= w)) w = e }
        END { print (NR ? w : "nan") }')
    check "heatCapacity $1, $2: the heat taken is its integral to $e <= 1e-6" below "$e" 1e-6
    e=$(awk '!/^#/ { if ($6 > w) w = $6; n++ } END { print (n ? w + 0 : "nan") }' postProcessing/heatAudit/0/heatAudit.dat)
    check "heatCapacity $1, $2: heat balance closes to $e <= 1e-10" below "$e" 1e-10
}
heat_balance() { # time scheme: grains that move, a hot wall, a heat capacity with kinks
    local e
    spheres_bed "properties-moving-$1" 'walls { ".*" { type frictionless; } top { type pressure; pressure constant 5000; } }'
    property heatCapacity 'table ((280 500) (310 900) (330 600) (400 800))'
    property thermalConductivity 'polynomial ((10 0) (0.1 1))'
    hot_wall top 400
    cube 4
    moved_points
    scheme "timeScheme $1; nNonOrthogonalCorrectors 5;"
    controls 'endTime 8e4; deltaT 2e4; writeInterval 4; functions { heatAudit { type heatAudit; libs ("libgranularFunctionObjects.so"); } }'
    logged msddFoam
    e=$(awk '!/^#/ { if ($6 > w) w = $6; n++ } END { print (n ? w + 0 : "nan") }' postProcessing/heatAudit/0/heatAudit.dat)
    check "heatCapacity and thermalConductivity of the temperature, grains that move, $1: heat balance closes to $e <= 1e-9" below "$e" 1e-9
}
conductivity_of_temperature() {
    local e
    bed_at_rest properties-number
    logged msddFoam
    bed_at_rest properties-function
    property thermalConductivity 'polynomial ((10 0) (0.1 1))'
    logged msddFoam
    e=$(paste -d ' ' <(field 1/conductivity) <(field ../properties-number/1/conductivity) | awk '{ e = $1/$7 - 1; print e < 0 ? -e : e }' | tail -n 1)
    check "thermalConductivity 10 + T/10 at 300 K: the bed conducts as with 40, to $e <= 1e-12" below "$e" 1e-12
    sed -i 's/uniform 300/uniform 400/' 0/T ../properties-number/0/T
    rm -r 1 ../properties-number/1
    logged msddFoam
    cd ../properties-number
    logged msddFoam
    e=$(paste -d ' ' <(field 1/conductivity) <(field ../properties-function/1/conductivity) | awk '{ print $7/$1 }' | tail -n 1)
    # Contacts conduct as k, 1.25 times as much, and gas hardly more
    check "at 400 K it conducts $e times as well as with 40: 1.03 to 1.24" is_within "$e" 1.03 1.24
}
refused_properties() {
    bed_at_rest properties-refused
    property heatCapacity 'sine { }'
    check "refused: a property of another form" refused 'heatCapacity'
    bed_at_rest properties-refused
    property heatCapacity 'polynomial ((-10 0))'
    check "refused: a heat capacity below zero" refused "Entry 'heatCapacity' of constant/granularProperties is -10 at"
    changed properties-discs
    grains 'thermalConductivity table ((0 100) (100 200));'
    mesh_is '2 2 1'
    check "refused: a conductivity of the temperature for discs" refused "allowed with surrogate type network: a number"
}

heated_through 'polynomial ((400 0) (0.5 1))' paper '400*T + 0.25*T*T'
heated_through 'table ((300 500) (600 800) (1000 700))' secondOrder '(T < 600 ? 500*(T - 300) + 0.5*(T - 300)^2 : 195000 + 800*(T - 600) - 0.125*(T - 600)^2)'
heat_balance paper
heat_balance secondOrder
conductivity_of_temperature
refused_properties
