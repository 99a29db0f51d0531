# Gas that flows by pressure and buoyancy (flow pressure): closed forms of the flow, convection, balances, force on the grains,
# processes, restart, refusals.

. "$here/flow_cases"

of_opening() { sed -n "s/.*\"openings\": {.*\"$1\": {\"mass_flow\": \([^,]*\), \"pressure\": \([^}]*\)}.*/\1 \2/p" postProcessing/msddFoam/summary.json; }
once='endTime 1; deltaT 1; writeInterval 1;'
liquid_of() { echo "gas constant; temperatures two; drag $1; constantGas { density 1; heatCapacity 1000; viscosity 2e-5; thermalConductivity 0.03; }"; }

one_direction() {
    local e G
    # p_in^2 - p_out^2 = 2 R T/M L F(G) on cells of any length
    driven pressure-helium 13 'in { massFlow 0.02; temperature 300; } out { pressure 2e5; temperature 300; }' 'gas helium; drag Ergun; temperatures two;' "$once" '' 2
    logged msddFoam
    e=$(of_opening in | awk '{ T = 300; mu = 3.674e-7*T^0.7; d = 0.02; G = 2; s = 0.6; F = 150*mu*G*s^2/0.4^3/d^2 + 1.75*G^2*s/0.4^3/d
        p = sqrt(4e10 + 2*8.314462618/4.002602e-3*T*F); e = ($2 - 2e5)/(p - 2e5) - 1; print (e < 0 ? -e : e) }')
    check "pressure drop of helium at one temperature: differs from the closed form by $e <= 1e-8" below "$e" 1e-8
    e=$(of_summary most_newton_iterations)
    check "and takes $e <= 8 Newton iterations" below "$e" 8
    # The same by the pressures
    driven pressure-helium 13 'in { pressure 2.5e5; temperature 300; } out { pressure 2e5; temperature 300; }' 'gas helium; drag Ergun; temperatures two;' "$once" '' 2
    logged msddFoam
    e=$(of_opening in | awk '{ T = 300; mu = 3.674e-7*T^0.7; d = 0.02; G = $1/0.01; s = 0.6; F = 150*mu*G*s^2/0.4^3/d^2 + 1.75*G^2*s/0.4^3/d
        e = 2*8.314462618/4.002602e-3*T*F/(6.25e10 - 4e10) - 1; print (e < 0 ? -e : e) }')
    check "mass flow of helium by its pressures: differs from the closed form by $e <= 1e-8" below "$e" 1e-8
    e=$(of_summary most_newton_iterations)
    check "and takes $e <= 8 Newton iterations" below "$e" 8
}
layers() { # of porosity 0.4 and 0.5 side by side: A1 G1 + B1 G1^2 = A2 G2 + B2 G2^2
    local e
    across=2 driven pressure-layers 10 'in { massFlow 0.01; temperature 300; } out { temperature 300; }' "$(liquid_of Ergun)" "$once" '' 2
    { sed '/internalField/,$d' 0/porosity; echo 'internalField nonuniform List<scalar> 20 ('; for i in $(seq 20); do echo $((i > 10 ? 5 : 4))e-1; done
      echo ');'; sed '1,/internalField/d' 0/porosity; } > porosity.new
    mv porosity.new 0/porosity
    logged msddFoam
    e=$(field 1/gasMassFlux | awk 'function F(G, e) { return 150*2e-5*G*(1 - e)^2/e^3/4e-4 + 1.75*G^2*(1 - e)/e^3/0.02 }
        { G[NR] = $1 } END { a = G[1]; b = G[20]; e = F(a, 0.4)/F(b, 0.5) - 1; f = (a + b)/2 - 1; e = e < 0 ? -e : e; f = f < 0 ? -f : f; print (e > f ? e : f) }')
    check "two layers side by side: the shares of the flow differ from the closed form by $e <= 1e-6" below "$e" 1e-6
    e=$(of_summary most_newton_iterations)
    check "and take $e <= 8 Newton iterations" below "$e" 8
}
loose_walls() { # between plates 5 diameters apart, the layers of a diameter have a porosity 0.058 larger: the shares of the flow follow
    local e across
    for across in 10 3; do
        channelling=layer across=$across driven pressure-loose 5 'in { massFlow 0.01; temperature 300; } out { temperature 300; }' \
            "$(liquid_of Ergun)" "$once" '' 2
        logged msddFoam
        e=$(sed -n 's/^Looser grains at walls.*the bed is \(.*\) larger.*/\1/p' log | awk '{ e = $1/(0.058*2*0.02/0.1) - 1; print (e < 0 ? -e : e) }')
        check "looser walls, $across cells across: the pore volume differs from that of the layers by $e <= 1e-5" below "$e" 1e-5
        [ "$across" = 10 ] || continue
        e=$(of_summary core_relative_flux | awk '
            function F(G, e) { return 150*2e-5*G*(1 - e)^2/e^3/4e-4 + 1.75*G^2*(1 - e)/e^3/0.02 }
            { core = $1; layer = (1 - 0.6*core)/0.4; e = F(core, 0.4)/F(layer, 0.458) - 1; print (e < 0 ? -e : e) }')
        check "looser walls: core and layers share the flow as the closed form says, to $e <= 1e-6" below "$e" 1e-6
    done
}

cycle='in { massFlow table ((0 0.002) (3000 0.002) (3001 0) (5000 0) (5001 -0.002)); temperature 700; } out { temperature 310; }'
cycle_case() { # folder, controls: air charges a bed of spheres, rests, and comes back; the vessel takes up heat
    across=3 driven "$1" 40 "$cycle" 'gasPressure 1e5; temperatures two; walls { sides { heatCapacity 8000; loss 2; ambient 300; } }' "$2" \
        'timeScheme secondOrder;' 1
}
worst_of() { # folder, time: largest relative difference of the temperatures from those here
    local e=0 name
    for name in T gasTemperature; do
        e=$(paste -d ' ' <(field "$2/$name") <(field "$1/$2/$name") | awk -v w="$e" '
            { e = ($1 - $2)/$2; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR > 1 ? w : "nan") }')
    done
    echo "$e"
}
as_through() { # the same bed by flow through
    local e
    cycle_case pressure-cycle 'endTime 8000; deltaT 200; writeInterval 40;'
    logged msddFoam
    e=$(flow_closes)
    check "charge, rest and discharge: heat of gas and vessel closes to $e <= 1e-9" below "$e" 1e-9
    e=$(heat_difference)
    check "charge, rest and discharge: heat of the grains closes to $e <= 1e-9" below "$e" 1e-9
    e=$(of_summary most_newton_iterations)
    check "charge, rest and discharge: $e <= 8 Newton iterations" below "$e" 8
    flow_case pressure-through 40 'massFlow table ((0 0.002) (3000 0.002) (3001 0) (5000 0) (5001 -0.002)); gasPressure 1e5; temperatures two;' \
        'endTime 8000; deltaT 200; writeInterval 40;' 'timeScheme secondOrder;' 1
    sed -i 's/outlet { patch out; }/outlet { patch out; temperature 310; }/; s/temperature 400/temperature 700/' constant/granularProperties
    logged msddFoam
    driven pressure-same 40 "$cycle" 'gasPressure 1e5; temperatures two;' 'endTime 8000; deltaT 200; writeInterval 40;' 'timeScheme secondOrder;' 1
    logged msddFoam
    e=$(worst_of "$work/pressure-through" 8000)
    check "flow through: temperatures differ by $e <= 2e-9" below "$e" 2e-9 # the tolerances of both
    cycle_case pressure-halves 'endTime 4000; deltaT 200; writeInterval 20;'
    logged msddFoam
    controls 'endTime 8000;'
    logged msddFoam
    check "restart between charge and discharge: same bytes" diff -rq 8000 "$work/pressure-cycle/8000"
    for parts in '1 3' '4 1'; do
        cycle_case pressure-parts 'endTime 8000; deltaT 200; writeInterval 40;'
        in_parts "$parts"
        side_by_side $((${parts% *}*${parts#* }))
        logged reconstructPar
        e=$(worst_of "$work/pressure-cycle" 8000)
        check "gas on $parts processes: temperatures differ by $e <= 1e-9" below "$e" 1e-9 # the tolerance of the repetitions
    done
}
hand_over() { # the gas comes in at one end, then at the other
    local e
    driven pressure-hand 40 'in { massFlow table ((0 0.002) (2000 0.002) (2100 0)); temperature 600; } out { temperature 310; } sides { massFlow table ((0 0) (2000 0) (2100 0.002)); temperature 500; }' 'gasPressure 1e5; temperatures two;' \
        'endTime 6000; deltaT 100; writeInterval 60;' 'timeScheme secondOrder;' 1
    logged msddFoam
    e=$(flow_closes)
    check "inlets that hand over: heat closes to $e <= 1e-9" below "$e" 1e-9
    e=$(of_opening sides | awk '{ e = $1/0.002 - 1; print (e < 0 ? -e : e) }')
    check "and the second inlet has its mass flow to $e <= 1e-12" below "$e" 1e-12
}
radial() { # liquid from the inner to the outer side of a quarter of a ring, radii 1 and 2: p = A mu m ln 2 + B m^2/2, m per radian and height
    local shape n e errors bound
    for shape in hexahedra triangles; do
        errors=''
        for n in 8 16; do
            driven pressure-ring $n 'inner { massFlow 0.157079632679; temperature 300; } outer { temperature 300; }' "$(liquid_of Ergun)" "$once" '' 2
            rm -r constant/polyMesh
            if [ $shape = triangles ]; then
                awk_mesh ring $n 0
                patch_type frontAndBack empty
            else
                block_mesh '(1 0 0) (2 0 0) (0 2 0) (0 1 0) (1 0 0.1) (2 0 0.1) (0 2 0.1) (0 1 0.1)' \
                    "hex (0 1 2 3 4 5 6 7) ($n $((2*n)) 1) simpleGrading (1 1 1)" 'arc 0 3 (0.70710678 0.70710678 0) arc 1 2 (1.41421356 1.41421356 0)
                    arc 4 7 (0.70710678 0.70710678 0.1) arc 5 6 (1.41421356 1.41421356 0.1)' 'inner { type patch; faces ((0 4 7 3)); }
                    outer { type patch; faces ((1 2 6 5)); } sides { type wall; faces ((0 1 5 4) (3 7 6 2)); } frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }'
            fi
            logged msddFoam
            errors+="$(of_opening inner | awk '{ A = 150*2e-5*0.36/0.4^3/4e-4; B = 1.75*0.6/0.4^3/0.02
                e = ($2 - 101300)/(A*log(2) + B/2) - 1; print (e < 0 ? -e : e) }') "
            e=$(of_summary most_newton_iterations)
            bound=$([ $shape = hexahedra ] && echo 8 || echo 20) # what is taken from the last iteration converges more slowly
            check "radial flow, $shape, $n cells: $e <= $bound Newton iterations" below "$e" $bound
        done
        check "radial flow, $shape: pressure differs from the closed form by $errors, of second order" \
            awk "BEGIN { split(\"$errors\", e, \" \"); exit !(e[2] <= 2e-3 && e[1]/e[2] >= 3.5) }"
    done
}
small() { # grains of 10 um on irregular triangles in mm: one and three processes, balance
    local e
    driven pressure-small 8 'left { massFlow 1e-9; temperature 400; } right { temperature 300; }' 'gas helium; temperatures two;' \
        'endTime 0.01; deltaT 0.001; writeInterval 10;' '' 2
    rm -r constant/polyMesh
    awk -v kind=box -v n=20 -v m=10 -v width=1 -v height=0.5 -v irregular=1 -f "$here/mesh.awk" > mesh.msh
    logged gmshToFoam mesh.msh
    logged transformPoints -scale '(0.001 0.001 0.001)'
    logged foamDictionary -entry entry0.frontAndBack.type -set empty constant/polyMesh/boundary
    sed -i 's/meanRadius 0.01/meanRadius 5e-6/' constant/granularProperties
    rm -rf "$work/pressure-small-parts"
    cp -r . "$work/pressure-small-parts"
    logged msddFoam
    e=$(flow_closes)
    check "grains of 10 um on triangles in mm: heat closes to $e <= 1e-9" below "$e" 1e-9
    e=$(of_summary most_newton_iterations)
    check "and take $e <= 20 Newton iterations" below "$e" 20
    cd "$work/pressure-small-parts"
    in_parts '3 1'
    side_by_side 3
    logged reconstructPar
    e=$(worst_of "$work/pressure-small" 0.01)
    check "and on 3 1 processes: temperatures differ by $e <= 1e-10" below "$e" 1e-10
}
rest() { # air of one temperature between a closed foot and an open top does not flow; the pressure is that of its column
    local e
    driven pressure-rest 20 'out { temperature 300; }' 'gas air; temperatures two;' "$once" '' 2 10
    gravity_is '-9.81 0 0'
    logged msddFoam
    e=$(field 1/gasMassFlux | awk '{ e = $1 < 0 ? -$1 : $1; if (!(e <= w)) w = e } END { print w }')
    check "air at rest flows with $e <= 1e-12 kg/(m2 s)" below "$e" 1e-12
    e=$(field 1/gasGaugePressure | awk 'NR == 1 { z = 10 - 0.25; R = 8.314462618/0.0289586; e = 101300*(exp(9.81*z/(R*300)) - 1)/$1 - 1; print (e < 0 ? -e : e) }')
    check "and its pressure differs from the closed form by $e <= 1e-4" below "$e" 1e-4
}
convection() { # helium between a hot floor and a cold lid in a closed square: Ra = 4 pi^2 at its onset
    local Ra e n=24
    for Ra in 0.98 1.02; do
        driven pressure-onset $n '' "gas helium; gasPressure 1e6; drag Ergun; temperatures one; dispersionAlong 0; dispersionAcross 0;
            exchange constant; exchangeCoefficient 1e12;" 'endTime 3e7; deltaT 5e5; writeInterval 20;' 'timeScheme secondOrder;' 0.1
        block_mesh '(0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 0.1) (1 0 0.1) (1 1 0.1) (0 1 0.1)' \
            "hex (0 1 2 3 4 5 6 7) ($n $n 1) simpleGrading (1 1 1)" '' '
            hot { type wall; faces ((0 1 5 4)); } cold { type wall; faces ((3 7 6 2)); } sides { type wall; faces ((0 4 7 3) (1 2 6 5)); }
            frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }'
        hot_wall hot 303
        hot_wall cold 297
        gravity_is '0 -9.81 0'
        # Diameter of this Rayleigh number, by the permeability of Ergun's drag
        e=$(awk -v Ra="$Ra" 'BEGIN { pi = atan2(0, -1); T = 300; mu = 3.674e-7*T^0.7; rho = 1e6*4.002602e-3/8.314462618/T
            k = Ra*4*pi^2*mu*0.1/(rho^2*5195*9.81*6/T); printf "%.12g", sqrt(k*150*0.36/0.4^3)/2 }')
        sed -i "s/meanRadius 0.01/meanRadius $e/" constant/granularProperties
        logged postProcess -funcs '(writeCellCentres)' -time 0
        { sed '/internalField/,$d' 0/T; echo "internalField nonuniform List<scalar> $((n*n)) ("; field 0/C | awk 'BEGIN { pi = atan2(0, -1) }
            { printf "%.15g\n", 303 - 6*$2 + 0.01*cos(pi*$1)*sin(pi*$2) }'; echo ');'; sed '1,/internalField/d' 0/T; } > T.new
        mv T.new 0/T
        logged msddFoam
        e=$(for t in 10000000 30000000; do field $t/gasMassFlux | awk '{ s += $1*$1 + $2*$2 } END { printf "%.6g ", s }'; done | awk '{ print $2/$1 }')
        check "Rayleigh number $Ra times 4 pi^2: the energy of the flow changes by a factor of $e, $([ $Ra = 0.98 ] && echo below || echo above) 1" \
            awk "BEGIN { exit !($e > 0 && ($Ra < 1 ? $e < 1 : $e > 1)) }"
    done
}
stratified() { # air that is hot above: two hot layers on cold ones do not make the solutions of flow and temperatures swing
    local e
    driven pressure-stratified 20 '' 'gasPressure 1e6; temperatures two;' 'endTime 3000; deltaT 300; writeInterval 10;' 'timeScheme secondOrder;' 0.1
    gravity_is '-9.81 0 0'
    { sed '/internalField/,$d' 0/T; echo 'internalField nonuniform List<scalar> 20 ('; for i in $(seq 20); do echo $((i > 10 ? 800 : 300)); done
      echo ');'; sed '1,/internalField/d' 0/T; } > T.new
    mv T.new 0/T
    logged msddFoam
    e=$(of_summary solutions_per_stage)
    check "air that is hot above: $e <= 5 solutions a stage" below "$e" 5
    e=$(field 3000/gasMassFlux | awk '{ e = $1 < 0 ? -$1 : $1; if (!(e <= w)) w = e } END { print w }')
    check "and flows with $e <= 1e-9 kg/(m2 s)" below "$e" 1e-9
}
column() { # gas upwards through a column of grains: the stress at its foot falls with the pressure drop
    local kind e
    for kind in through pressure; do
        if [ $kind = through ]; then
            flow_case pressure-column 20 "massFlux 1; $(liquid_of Ergun)" "$once" '' 2
        else
            driven pressure-column 20 'in { massFlow 0.01; temperature 400; } out { temperature 300; }' "$(liquid_of Ergun)" "$once" '' 2
        fi
        grains 'mechanics equilibrium; equilibriumCoeffs { law elastic; elasticCoeffs { youngModulus 1e11; poissonRatio 0.3; } residual 0.01;
            walls { in { type frictionless; } sides { type frictionless; } out { type pressure; pressure constant 0; } } }'
        gravity_is '-9.81 0 0'
        logged msddFoam
        e=$(field 1/stress | awk 'NR == 1 { A = 150*2e-5*0.36/0.4^3/4e-4; B = 1.75*0.6/0.4^3/0.02
            e = -$1/((0.6*1999*9.81 - A - B)*(1 - 0.025)) - 1; print (e < 0 ? -e : e) }')
        check "flow $kind upwards through a column: the stress at its foot differs from the closed form by $e <= 1e-4" below "$e" 1e-4
    done
}
forces() { # the foot of a bed of uneven porosity has its weight, less drag and buoyancy
    local e
    across=4 driven pressure-forces 6 'in { massFlow 0.005; temperature 400; } out { temperature 300; }' "$(liquid_of Ergun)" "$once" '' 2
    { sed '/internalField/,$d' 0/porosity; printf 'internalField nonuniform List<scalar>\n24\n(\n'; for i in $(seq 24); do echo 0.$((36 + i*i*7 % 11)); done
      echo ');'; sed '1,/internalField/d' 0/porosity; } > porosity.new
    mv porosity.new 0/porosity
    grains 'mechanics equilibrium; equilibriumCoeffs { law elastic; elasticCoeffs { youngModulus 1e10; poissonRatio 0.3; } residual 3e-4;
        walls { in { type frictionless; } sides { type frictionless; } out { type pressure; pressure constant 0; } } }'
    gravity_is '-9.81 0 0'
    logged msddFoam
    # A virtual displacement that is 1 at the foot and 0 above its first row of cells
    e=$(paste -d ' ' <(field 0/porosity) <(field 1/gasMassFlux) <(field 1/stress) | tr -d '()' | awk '
        { G = sqrt($2^2 + $3^2); F = G > 0 ? (150*2e-5*(1 - $1)^2/$1^3/4e-4 + 1.75*G*(1 - $1)/$1^3/0.02)*$2 : 0; f = F - (1 - $1)*1999*9.81
          first = (NR - 1)%6 == 0; load += first ? f/2 : f; carried += first ? $5*6 : 0 }
        END { e = carried/load - 1; print (e < 0 ? -e : e) }')
    check "force of the foot, weight, drag and buoyancy balance to $e <= 1e-9" below "$e" 1e-9
}
refusals() {
    local change message
    while IFS='|' read -r message change; do
        driven pressure-bad 10 'in { massFlow 0.001; temperature 400; } out { temperature 300; }' '' "$once" '' 2
        sed -i "$change" constant/granularProperties
        check "refused: $message" refused "$message"
        check "and foreseen" foreseen "$message"
    done <<-'END'
	Each of the 2 openings has a massFlow|s/out { /out { massFlow -0.001; /
	Entries 'massFlow' and 'pressure' of the opening in are both given|s/massFlow 0.001;/& pressure 2e5;/
	The patch of 'nowhere' is nowhere|s/out {/nowhere {/
	Entry 'temperature' of the patch out is missing|s/temperature 300;//
	Entry 'temperature' of the patch in is -3|s/temperature 400/temperature -3/
	Entry 'pressure' of the opening out is -1|s/temperature 300;/& pressure -1;/
	Opening 'frontAndBack' is a patch of the type empty|s/out {/frontAndBack {/
	Unknown entry 'inlet'|s/openings/inlet { patch in; } &/
	Patch in is a wall of type shell|s/flow pressure;/& equilibriumCoeffs { walls { in { type shell; } } }/
	Wall out, through which gas flows, moves by up to 0.002 m away|s/flow pressure;/& equilibriumCoeffs { walls { "o.*" { displacement table ((0 (0 0 0)) (1 (0.002 0 0))); } } }/
	Entry 'channelling' is layer, but the bed is too narrow|s/meanRadius 0.01/meanRadius 0.1/; s/channelling none/channelling layer/
	Entry 'channelling' is 'thick'|s/channelling none/channelling thick/
	END
    driven pressure-bad 10 'in { pressure 3e7; temperature 400; } out { temperature 300; }' 'gas air;' "$once" '' 2
    check 'refused: choked flow' refused 'The flow would be choked'
    driven pressure-bad 10 'in { massFlow -2; temperature 400; } out { temperature 300; }' 'gas air;' "$once" '' 2
    check 'refused: more suction than air can follow' refused 'The pressure of the gas would fall to 0'
    check "and foreseen" foreseen 'The pressure of the gas would fall to 0'
}

one_direction
layers
as_through
hand_over
radial
loose_walls
small
rest
convection
stratified
column
forces
refusals
