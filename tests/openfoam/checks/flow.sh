# Gas that flows through the bed (flow through): closed forms of two temperatures and of one, balances, correlations, processes,
# restart, refusals.

. "$here/flow_cases"

# C = 0.6 x 2000 x 500 = 6e5 J/(m3 K), G c = 1000 W/(m2 K), L = 1 m: H = 1000 xi, and tau is reached after 6e5 tau/H seconds.
schumann() { # folder, xi, tau, cells, steps, scheme: errors of gas and grains, in parts of the step of the inlet
    local end
    end=$(awk "BEGIN { printf \"%.15g\", 6e5*$3/(1000*$2) }")
    flow_case "$1" "$4" "massFlux 1; exchangeCoefficient $2e3; temperatures two; $thin_gas" \
        "endTime $end; deltaT $(awk "BEGIN { printf \"%.15g\", $end/$5 }"); writeInterval $5;" "timeScheme $6;" 1e-9
    logged msddFoam
    paste -d ' ' <(field "$end/gasTemperature") <(field "$end/T") <(awk -v xi="$2" -v tau="$3" -v n="$4" -f "$here/schumann.awk") | awk '
        { a = ($1 - 300)/100 - $3; b = ($2 - 300)/100 - $4; if (a < 0) a = -a; if (b < 0) b = -b; if (!(a <= g)) g = a; if (!(b <= s)) s = b }
        END { print (NR > 1 ? g + 0 : "nan"), s + 0 }'
}
two_temperatures() {
    local xi e coarse fine
    for xi in 5 50 500; do
        e=$(schumann flow-schumann-$xi $xi $xi 200 200 secondOrder)
        check "Schumann's bed, xi $xi, 200 cells and steps: gas and grains differ by $e <= 2e-3 of the step" \
            eval "below ${e% *} 2e-3 && below ${e#* } 2e-3"
    done
    coarse=$(schumann flow-order-50 20 20 50 50 secondOrder)
    fine=$(schumann flow-order-100 20 20 100 100 secondOrder)
    check "Schumann's bed, half of the cells and steps: $coarse against $fine, orders at least 1.9" \
        awk "BEGIN { split(\"$coarse\", c, \" \"); split(\"$fine\", f, \" \"); exit !(log(c[1]/f[1])/log(2) >= 1.9 && log(c[2]/f[2])/log(2) >= 1.9) }"
}

largest() { awk '{ e = $1 - $2; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR > 1 ? w + 0 : "nan") }'; } # |first - second| of lines
one_temperature() { # its error follows the law by which temperatures auto decides: the front in the middle of the bed
    local xi e
    for xi in 50 200; do
        flow_case flow-one-$xi 800 "massFlux 1; exchangeCoefficient $((2*xi))e3; temperatures one; $thin_gas" \
            "endTime 300; deltaT 0.75; writeInterval 400;" "timeScheme secondOrder;" 1e-9
        logged msddFoam
        e=$(paste -d ' ' <(field 300/T) <(awk -v xi=$((2*xi)) -v tau=$xi -v n=800 -f "$here/schumann.awk") | awk -v xi=$xi '
            { T = ($1 - 300)/100; a = T - $2; b = T - $3; if (a < 0) a = -a; if (b < 0) b = -b; if (a > g) g = a; if (b > s) s = b }
            END { print 100*g*sqrt(xi), 100*s*sqrt(xi) }')
        check "one temperature, xi $xi: errors over a percent/sqrt(xi) are $e, of 18 and 13.5 to a tenth" \
            eval "is_within ${e% *} 16.2 19.8 && is_within ${e#* } 12.1 14.9"
    done
    # With an inlet of one temperature for gas and grains, and conduction: Ogata and Banks (USGS Prof. Paper 411-A, 1961)
    flow_case flow-ogata 800 "massFlux 1; exchangeCoefficient 1e12; temperatures one; $thin_gas" \
        'endTime 300; deltaT 0.375; writeInterval 800;' 'timeScheme secondOrder;' 10
    hot_wall in 400
    logged msddFoam
    e=$(field 300/T | awk '
        function erfcx(x,    k, t) { # exp(x^2) erfc(x) by its continued fraction; by the series below 2
            if (x < 2) { t = x; s = x; for (k = 1; k < 200; k++) { t *= 2*x*x/(2*k + 1); s += t } return exp(x*x) - 2/sqrt(pi)*s }
            t = 0; for (k = 60; k > 0; k--) t = k/2/(x + t); return 1/sqrt(pi)/(x + t)
        }
        function erfc(x) { return x < 0 ? 2 - erfc(-x) : exp(-x*x)*erfcx(x) }
        BEGIN { pi = atan2(0, -1); t = 300; v = 1/600; D = 10/6e5 }
        { x = (NR - 0.5)/800; a = (x - v*t)/(2*sqrt(D*t)); b = (x + v*t)/(2*sqrt(D*t))
          e = ($1 - 300)/100 - 0.5*(erfc(a) + exp(-a*a)*erfcx(b)); if (e < 0) e = -e; if (!(e <= w)) w = e } END { print w }')
    check "one temperature with conduction, 800 cells and steps: differs from Ogata and Banks by $e <= 1e-4 of the step" below "$e" 1e-4
}
steady_states() {
    local e
    # Heat from inside: the gas rises by q x/(G c), the grains are q/H hotter
    flow_case flow-source 200 "massFlux 1; exchangeCoefficient 4e4; temperatures two; $thin_gas" 'endTime 1e9; deltaT 1e8; writeInterval 10;' '' 1e-9
    cat > constant/fvOptions <<< 'FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; } heat { type scalarSemiImplicitSource; selectionMode all; volumeMode specific; injectionRateSuSp { T (1e4 0); } }'
    logged msddFoam
    e=$(paste -d ' ' <(field 1000000000/gasTemperature) <(field 1000000000/T) | awk -v OFMT=%.15g '{ x = (NR - 0.5)/200; print $1, 400 + 10*x; print $2, 400 + 10*x + 0.25 }' | largest)
    check "heat from inside, at rest: gas and grains differ from the closed form by $e <= 1e-6 of 10 K" below "$e" 1e-5
    # Conduction against the flow, from a hot outlet
    flow_case flow-transpiration 4000 "massFlux 0.01; exchangeCoefficient 100; temperatures two; $thin_gas" 'endTime 1e11; deltaT 1e10; writeInterval 10;' '' 2
    hot_wall out 500
    logged msddFoam
    e=$(paste -d ' ' <(field 100000000000/gasTemperature) <(field 100000000000/T) | awk -v OFMT=%.15g '
        BEGIN { a = 10; b = 50; p = -a/2 + sqrt(a*a/4 + b); q = -a/2 - sqrt(a*a/4 + b)
            # Tg = A + B exp(p x) + C exp(q (x - 0)): Tg(0) = 400, Ts(0)/dx = 0, Ts(1) = 500
            C = 1; B = -C*q*(1 + q/a)/(p*(1 + p/a)); f = B*(1 + p/a)*exp(p) + C*(1 + q/a)*exp(q) - B - C; C = 100/f; B *= C; A = 400 - B - C }
        { x = (NR - 0.5)/4000; print $1, A + B*exp(p*x) + C*exp(q*x); print $2, A + B*(1 + p/a)*exp(p*x) + C*(1 + q/a)*exp(q*x) }' | largest)
    check "conduction against the flow, at rest: gas and grains differ from the closed form by $e <= 1e-6 of 100 K" below "$e" 1e-4
}
# Correlations at Re 1000, Pr 2/3, porosity 0.4: Nu of the package ht 1.2.0 of PyPI (Gunn: written out), pressure gradients of fluids 1.3.1
# for 1 kg/m3 and 1 m/s.
a_ramp() { # T of the gas that rises steadily: the grains lag by C/H, with the inner resistance of spheres
    local e name Nu
    while read -r name Nu; do
        flow_case flow-ramp 100 "massFlux 1; temperatures two; dispersionAlong 0; exchange $name; gas constant;
            constantGas { density 1e-9; heatCapacity 1000; viscosity 2e-5; thermalConductivity 0.03; }" \
            'endTime 2000; deltaT 20; writeInterval 100;' 'timeScheme secondOrder;' 1e-9 0.2
        sed -i 's/temperature 400/temperature table ((0 300) (2000 500))/' constant/granularProperties
        logged msddFoam
        e=$(paste -d ' ' <(field 2000/gasTemperature) <(field 2000/T) | awk -v OFMT=%.15g -v Nu="$Nu" '
            BEGIN { d = 0.02; H = 6*0.6/d/(d/(Nu*0.03) + d/(10*2)); lag = 0.1*6e5/H } NR <= 20 { print ($1 - $2)/lag, 1 }' | largest)
        check "a ramp of the gas, exchange $name: the grains lag by C/H with the resistance of their inside, to $e <= 1e-4" below "$e" 1e-4
    done <<-END
	WakaoKaguei 62.63112112417671
	Gunn 74.85813473423744
	KTA 66.63202350078735
	Gnielinski 68.19578902058133
	END
}
pressure_drops() {
    local e drop
    # A step of a tutorial of a pebble bed reactor, which prints -3493 Pa/m (Virtual Test Bed, generic pebble bed, step 2)
    flow_case flow-kta 20 'massFlux 13.316631; gas constant; temperatures two; drag KTA;
        constantGas { density 8.628204; heatCapacity 5195; viscosity 1.991242e-5; thermalConductivity 0.15; }' 'endTime 1; deltaT 1; writeInterval 1;' '' 2
    sed -i 's/meanRadius 0.01/meanRadius 0.03/' constant/granularProperties
    sed -i 's/uniform 0.4;/uniform 0.39;/' 0/porosity
    logged msddFoam
    drop=$(of_summary pressure_drop)
    check "drag of KTA 3102.3: $drop Pa/m, 3493 to four digits" is_within "$drop" 3492.5 3493.5
    while read -r e drop; do
        flow_case flow-drag 20 "massFlux 1; gas constant; temperatures two; drag $e; constantGas { density 1; heatCapacity 1000; viscosity 2e-5;
            thermalConductivity 0.03; }" 'endTime 1; deltaT 1; writeInterval 1;' '' 2
        logged msddFoam
        drop=$(awk -v a="$(of_summary pressure_drop)" -v b="$drop" 'BEGIN { e = a/b - 1; print (e < 0 ? -e : e) }')
        check "drag $e: differs from another program by $drop <= 1e-9" below "$drop" 1e-9
    done <<-END
	Ergun 862.4999999999997
	KTA 714.6959314254118
	ErdimAkgirayDemir 691.1749541456327
	END
    # Helium at one temperature: p_in^2 - p_out^2 = 2 R T/M L F(G)
    flow_case flow-compressible 50 'massFlux 2; gas helium; gasPressure 2e5; drag Ergun; temperatures two;' 'endTime 1; deltaT 1; writeInterval 1;' '' 2
    sed -i 's/temperature 400/temperature 300/' constant/granularProperties
    logged msddFoam
    e=$(awk -v drop="$(of_summary pressure_drop)" 'BEGIN { T = 300; mu = 3.674e-7*T^0.7; d = 0.02; G = 2; s = 0.6; F = 150*mu*G*s^2/0.4^3/d^2 + 1.75*G^2*s/0.4^3/d
        p = sqrt(4e10 + 2*8.314462618/4.002602e-3*T*F); e = drop/(p - 2e5) - 1; print (e < 0 ? -e : e) }')
    check "pressure drop of helium at one temperature: differs from the closed form by $e <= 1e-8" below "$e" 1e-8
}

vessel='walls { sides { heatCapacity 8000; loss 2; ambient 300; } }'
cycle='massFlux table ((0 0.2) (3000 0.2) (3001 0) (5000 0) (5001 -0.2)); gasPressure 1e5; temperatures two;'
cycle_case() { # folder, controls: air charges a bed of spheres, rests, and comes back; the vessel takes up heat
    across=3 flow_case "$1" 40 "$cycle $vessel" "$2" 'timeScheme secondOrder;' 1
    sed -i 's/outlet { patch out; }/outlet { patch out; temperature 310; }/; s/temperature 400/temperature 700/' constant/granularProperties
}
heat_over_all() {
    local e
    cycle_case flow-cycle 'endTime 8000; deltaT 200; writeInterval 40;'
    logged msddFoam
    e=$(flow_closes)
    check "charge, rest and discharge: heat of gas and vessel closes to $e <= 1e-9" below "$e" 1e-9
    e=$(heat_difference)
    check "charge, rest and discharge: heat of the grains closes to $e <= 1e-9" below "$e" 1e-9
    e=$(of_summary solutions_per_stage)
    check "charge, rest and discharge: $e <= 6 solutions a stage" below "$e" 6
    check "the outlet's temperature is in a table" test "$(grep -vc '^#' postProcessing/flow/0/flow.dat)" = 40
}
on_processes_and_restarted() {
    local parts e name
    cycle_case flow-halves 'endTime 4000; deltaT 200; writeInterval 20;'
    logged msddFoam
    controls 'endTime 8000;'
    logged msddFoam
    check "restart between charge and discharge: same bytes" diff -rq 8000 "$work/flow-cycle/8000"
    for parts in '2 1' '1 3' '4 1'; do
        cycle_case flow-parts 'endTime 8000; deltaT 200; writeInterval 40;'
        in_parts "$parts"
        side_by_side $((${parts% *}*${parts#* }))
        logged reconstructPar
        e=0
        for name in T gasTemperature; do
            e=$(paste -d ' ' <(field 8000/$name) <(field "$work/flow-cycle/8000/$name") | awk -v w="$e" '
                { e = ($1 - $2)/$2; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR > 1 ? w : "nan") }')
        done
        check "gas on $parts processes: temperatures differ by $e <= 1e-10" below "$e" 1e-10
    done
}
warnings() { # beyond what the flow is valid for the log says so, with the number
    local what entries conductivity e
    while IFS='|' read -r what entries conductivity; do
        flow_case flow-warning 20 "temperatures two; $entries" 'endTime 1; deltaT 1; writeInterval 1;' '' 2
        sed -i "s/thermalConductivity 2;/thermalConductivity $conductivity;/" constant/granularProperties
        logged msddFoam
        said "$what" "$what"
    done <<-'END'
	Warning: Flow: the gas reaches|massFlux 60; gas air; drag KTA;|2
	Warning: Flow: the pressure drop reaches|massFlux 60; gas air; drag KTA;|2
	Warning: Flow: the Biot number h r/k_s of the grains reaches|massFlux 1; gas air;|0.05
	Warning: Flow: the mean free path of the gas reaches|massFlux 1e-4; gas air; gasPressure 10;|2
	END
    flow_case flow-warning 20 "massFlux 1; exchangeCoefficient 1e5; temperatures one; accuracy 1; $thin_gas" 'endTime 1; deltaT 1; writeInterval 1;' '' 2
    logged msddFoam
    said "one temperature whose error is above 'accuracy' is in warning" "allowed by 'accuracy': 1 %"
    # The sides are 0.1 m apart: ten grains
    e=$(of_summary bed_width_in_grains)
    check "a bed between plates 0.1 m apart is $e grains wide, 10" is_within "$e" 9.999 10.001
    said "the core of a narrow bed lacks gas" 'the core gets about 16.8 % less gas'
    sed -i 's/meanRadius 0.01/meanRadius 0.002/' constant/granularProperties
    rm -r 1 log
    logged msddFoam
    check "that of a wide one does not" eval '! grep -q "the core gets" log'
}
upwards() { # gas that carries the grains, by the closed form of Ergun's drag
    local G e
    G=$(awk 'BEGIN { A = 150*2e-5*0.36/0.4^3/4e-4; B = 1.75*0.6/0.4^3/0.02; w = 0.6*1999*9.81; printf "%.15g", (sqrt(A*A + 4*B*w) - A)/(2*B) }')
    flow_case flow-lift 20 "massFlux $(awk "BEGIN { printf \"%.15g\", 0.999*$G }"); gas constant; temperatures two; drag Ergun;
        constantGas { density 1; heatCapacity 1000; viscosity 2e-5; thermalConductivity 0.03; }" 'endTime 1; deltaT 1; writeInterval 1;' '' 2
    gravity_is '-9.81 0 0'
    logged msddFoam
    e=$(awk -v G="$G" -v found="$(of_summary pressure_gradient_over_weight)" 'BEGIN { A = 150*2e-5*0.36/0.4^3/4e-4; B = 1.75*0.6/0.4^3/0.02; g = 0.999*G
        e = found/((A*g + B*g^2)/(0.6*1999*9.81)) - 1; print (e < 0 ? -e : e) }')
    check "gas upwards with 0.999 of what lifts the bed: its share of the weight differs by $e <= 1e-6" below "$e" 1e-6
    said 'and the log says so' 'of the weight of the grains'
    sed -i "s/massFlux [^;]*/massFlux $(awk "BEGIN { print 1.001*$G }")/" constant/granularProperties
    rm -r 1
    check "with 1.001 of it the run ends" refused 'The bed would lift at time 1'
}
at_rest() { # helium between a hot floor and a cold lid: Rayleigh number by the closed form
    local e
    flow_case flow-rest 100 'massFlux table ((0 0) (1e10 0) (1.1e10 1e-9)); gas helium; gasPressure 2e5; drag Ergun; temperatures two;' \
        'endTime 1.1e10; deltaT 1e9; writeInterval 11;' '' 2
    hot_wall in 400
    hot_wall out 300
    gravity_is '-9.81 0 0'
    logged msddFoam
    e=$(awk -v Ra="$(of_summary rayleigh_at_rest)" 'BEGIN { T = 350; mu = 3.674e-7*T^0.7; rho = 2e5*4.002602e-3/8.314462618/T
        K = 0.4^3*4e-4/150/0.36; e = Ra/(rho^2*5195*9.81*100/T*K/(mu*2)) - 1; print (e < 0 ? -e : e) }')
    check "Rayleigh number of helium over a hot floor: differs from the closed form by $e <= 1e-3" below "$e" 1e-3
    gravity_is '9.81 0 0'
    rm -r 1[0-9]*
    logged msddFoam
    e=$(of_summary rayleigh_at_rest)
    check "and is $e under a hot lid" test "$e" = 0
}
liquid() { # molten salt, which stores more than the grains
    local e
    flow_case flow-salt 40 'massFlux 2; gas constant; temperatures auto; constantGas { density 1800; heatCapacity 1500; viscosity 2e-3;
        thermalConductivity 0.5; }' 'endTime 100; deltaT 5; writeInterval 20;' 'timeScheme secondOrder;' 2
    logged msddFoam
    e=$(flow_closes)
    check "molten salt: heat closes to $e <= 1e-9" below "$e" 1e-9
    # Both capacities move with the front
    e=$(paste -d ' ' <(field 100/gasTemperature) <(field 100/T) | awk '{ s += 0.4*1800*1500*($1 - 300) + 6e5*($2 - 300) }
        END { e = s/NR/(2*1500*100*100) - 1; print (e < 0 ? -e : e) }')
    check "and is in the pores and grains to $e <= 1e-9" below "$e" 1e-9
}
triangles() { # Schumann's bed on triangles that follow no rows
    local e
    flow_case flow-triangles 40 "massFlux 1; exchangeCoefficient 20e3; temperatures two; $thin_gas" 'endTime 600; deltaT 6; writeInterval 100;' \
        'timeScheme secondOrder;' 1e-9
    rm -r constant/polyMesh
    awk -v kind=box -v n=100 -v m=10 -v width=1 -v height=0.1 -v irregular=1 -f "$here/mesh.awk" \
        | sed 's/"left"/"in"/; s/"right"/"out"/; s/"bottom"/"sides"/; s/"top"/"lid"/' > mesh.msh
    logged gmshToFoam mesh.msh
    logged foamDictionary -entry entry0.frontAndBack.type -set empty constant/polyMesh/boundary
    logged msddFoam
    e=$(flow_closes)
    check "a bed of triangles: heat closes to $e <= 1e-9" below "$e" 1e-9
    logged postProcess -funcs '(writeCellCentres)' -time 600
    e=$(paste -d ' ' <(field 600/Cx) <(field 600/gasTemperature) <(field 600/T) | awk -v table="$(awk -v xi=20 -v tau=20 -v n=2000 -f "$here/schumann.awk")" '
        BEGIN { split(table, line, "\n") }
        { split(line[int($1*2000) + 1], T, " "); for (i = 1; i <= 2; i++) { e = ($(i + 1) - 300)/100 - T[i]; s += e*e } }
        END { print (NR > 1 ? sqrt(s/2/NR) : "nan") }')
    check "Schumann's bed of triangles: gas and grains differ by $e <= 1e-3 of the step (rms)" below "$e" 1e-3
}
no_flow() { # a mass flow of 0 changes nothing
    flow_case flow-off 20 'massFlow 0;' 'endTime 100; deltaT 10; writeInterval 10;' 'timeScheme secondOrder;' 2
    hot_wall out 500
    logged msddFoam
    cp -r . "$work/flow-off-none"
    cd "$work/flow-off-none"
    rm -r 100 postProcessing
    grains 'flow none;'
    logged msddFoam
    check "mass flow 0: same bytes as without flow" diff -rq -x msddFoam 100 "$work/flow-off/100"
}
refusals() {
    local change message
    while IFS='|' read -r message change; do
        flow_case flow-bad 10 'massFlux 0.1;' 'endTime 10; deltaT 10; writeInterval 1;' '' 2
        sed -i "$change" constant/granularProperties
        check "refused: $message" refused "$message"
        check "and foreseen" foreseen "$message"
    done <<-'END'
	Entries 'massFlow' and 'massFlux' are missing|s/massFlux 0.1;//
	Entries 'massFlow' and 'massFlux' are both given|s/massFlux/massFlow 1; &/
	The patch of 'outlet' is nowhere|s/patch out/patch nowhere/
	The outlet sides has|s/patch out/patch sides/
	Entry 'temperature' of the patch out is missing|s/massFlux 0.1/massFlux table ((0 0.1) (10 -0.1))/
	Entry 'temperature' of the patch in is -3|s/temperature 400/temperature -3/
	Entry 'drag' is 'Darcy'|s/massFlux/drag Darcy; &/
	END
    flow_case flow-bad 10 'massFlux 0.1;' 'endTime 10; deltaT 10; writeInterval 1;' '' 2
    start_field stress '[1 -1 -2 0 0 0 0]' '(-2000 0 0 -2000 0 -2000)'
    sed -i 's/volScalarField/volSymmTensorField/' 0/stress
    sed -i 's/surrogate .*/surrogate { type spheres; spheresCoeffs { poissonRatio 0.3; } }/' constant/granularProperties
    check 'spheres without gas are refused' refused "Entry 'gas' of spheresCoeffs is vacuum"
    check 'and foreseen' foreseen "Entry 'gas' of spheresCoeffs is vacuum"
    flow_case flow-bad 10 'massFlux 0.1;' 'endTime 10; deltaT 10; writeInterval 1;' '' 2
    start_field porosity '[0 0 0 0 0 0 0]' 0.18
    sed -i 's/surrogate .*/surrogate { type network; model builtin; }/' constant/granularProperties
    check 'discs are refused' refused "Entry 'flow' is through with surrogate type network"
    check 'and foreseen' foreseen "Entry 'flow' is through with surrogate type network"
}

two_temperatures
one_temperature
steady_states
a_ramp
pressure_drops
warnings
upwards
at_rest
liquid
triangles
heat_over_all
on_processes_and_restarted
no_flow
refusals
