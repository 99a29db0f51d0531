# What a run reports beyond its model: values beyond those compared with DEM, radiation, forces of contacts, the approach
# to a steady state, cells thinner than grains, smooth sides of tall beds, and friction that is not read.
msdd=$(cd "$checkout" && realpath -m "${CARGO_TARGET_DIR:-target}")/release/msdd

sphere_case() { # folder, options: a new case of spheres, meshed
    local name=$1
    shift
    rm -rf "${work:?}/$name"
    mkdir -p "$work"
    cd "$work"
    "$msdd" case new "$name" --yes --spheres --checkout "$checkout" "$@" > "$name.new" 2>&1 \
        || { cat "$name.new" >&2; echo "tests/openfoam: msdd case new failed" >&2; exit 1; }
    cd "$name"
    logged blockMesh
}
said() { # what, pattern of a line of the end of the log
    check "$1" bash -c "sed -n '/^Accuracy and warnings/,\$p' log | grep -qE -- \"\$1\"" - "$2"
}
warned() { # what, pattern of a warning of the start
    check "$1" grep -qE -- "^Warning [0-9]*: $2" log
}

pebbles() { # lithium orthosilicate in helium, heated from inside between plates
    sphere_case pebbles --material lithium-orthosilicate --mean-radius 0.0005 --gas helium --box 0.02x0.006x0.006 --cells 10x1x1 \
        --left 673 --right 673 --heat-source 1e7 --lid stays --slack-layer 0 --gravity 0 --wall-friction 0
    logged msddFoam
    warned "heat from inside was never compared: at the start" \
        'Beyond what the model was compared with: heat from inside of the bed up to 1e\+07 W/m3 \(compared: none\)'
    warned "nor spheres that conduct 10 times as well as the gas" '.*k of the grains over k of the gas down to 8\.[0-9]* \(compared: 38\.2 to 22400\)'
    said "the range is no clean bill" 'Range: no state was outside the range of the model, but the run lies beyond .*pressure up to [0-9.]+ MPa, 1[0-9][0-9] times the largest \(compared: 4\.32 kPa to 106 kPa\).*Its error there is unknown'
    said "mean force and Hertz pressure of the contacts, beyond the hardness" \
        'Warning: at a pressure of [0-9.]+ MPa the mean force of contacts is [0-9.]+ N, with a Hertz pressure of [0-9.]+ GPa; .* above the hardness of 1 GPa: grains would yield or crush'
    # Rumpf: pi d^2 p/(phi z), with the porosity and contacts of the end
    check "which is Rumpf's force" bash -c "sed -n 's/.*Warning: at a pressure of \([0-9.]*\) MPa the mean force of contacts is \([0-9.]*\) N.*/\1 \2/p' log \
        | awk '{ f = 3.14159*1e-6*\$1*1e6/(0.6*5.5); exit !(\$2 > 0.8*f && \$2 < 1.25*f) }'"
    said "the bed is not steady at the end" 'Steady state: not reached; at the end T changes by up to [0-9.e-]+ K/s. What the bed takes up falls exponentially: it holds 9[0-9.]* % of the heat'
    check "for programs, too" grep -q '"compared": {"known": true, "beyond": \["thermal strain\|"compared": {"known": true, "beyond": \["pressure' postProcessing/msddFoam/summary.json
    check "least, mean and largest values are printed now and then" grep -qE '^ *T: least [0-9.]+, mean [0-9.]+, largest [0-9.]+ K$' log
    # The share that it holds, from the heat of a run five times as long
    local held share long
    held=$(sed -n 's/.*"stored": \([0-9.e+-]*\).*/\1/p' postProcessing/msddFoam/summary.json)
    share=$(sed -n 's/.*"share": \([0-9.e+-]*\).*/\1/p' postProcessing/msddFoam/summary.json)
    logged foamDictionary -entry endTime -set 2000 system/controlDict
    logged msddFoam
    long=$(sed -n 's/.*"stored": \([0-9.e+-]*\).*/\1/p' postProcessing/msddFoam/summary.json)
    check "it held $share of the heat that it holds when steady" is_within "$(echo "$held $long $share" | awk '{ print $1/$2/$3 }')" 0.985 1.015
    said "and is steady in the end" 'Steady state: reached; at the end T changes by at most'
}
hot_alumina() { # what the closed form of rust/beds/src/radiation.rs adds in a vacuum, in the model and out of it
    local t dark added emissivity missing expected on off
    conductivity() {
        awk -F '[:,]' '/"conductivity_(xx|yy|zz)"/ { sum += $2 } END { printf "%.8g", sum/3 }' postProcessing/msddFoam/summary.json
    }
    for t in 873 1500; do
        sphere_case "alumina-$t" --material alumina --mean-radius 0.01 --box 0.3x0.3x0.3 --cells 6x1x1 --gas vacuum --thermal-expansion 0 \
            --mechanics none --left "$t" --right "$t" --initial-temperature "$t"
        controls "stopAt nextWrite; writeInterval 10; deltaT 10;"
        logged msddFoam
        read -r added dark emissivity < <(sed -n "s/.*Radiation: it adds \([0-9.]*\) W.(m K) at $t K to the \([0-9.]*\) W.*emissivity \([0-9.]*\)\.$/\1 \2 \3/p" log)
        check "alumina emits less when it is hotter: $emissivity at $t K" is_within "$emissivity" $([ "$t" = 873 ] && echo 0.583 0.585 || echo 0.399 0.401)
        expected=$(awk -v T="$t" -v k="$(sed -n 's/^thermalConductivity *\([0-9.]*\);/\1/p' constant/granularProperties)" -v dark="$dark" -v e="$emissivity" \
            -v phi="$(awk '/uniform/ { print 1 - $3 }' 0/porosity)" 'BEGIN {
            b = 4*5.670374e-8*T^3*0.02; w = 1.1*phi; g = dark/(phi*k)
            r = e/(exp(2/3*log(phi))*(2.163 - 0.613*e)); print b*(0.4556*(1 - phi)^2/phi + r*(1 - w*g)^2/(1 + w*w*r*b*(1 - g)/(phi*k))) }')
        check "radiation adds $added W/(m K) at $t K, expected $expected" is_within "$(echo "$added $expected" | awk '{ print $1/$2 }')" 0.99 1.01
        check "a bed that radiates has no warning of it" [ "$(grep -c '^Warning.*Radiation' log)" = 0 ]
        on=$(conductivity)
        rm -rf [1-9]*
        sed -i 's/^\( *\)emissivity .*/&\n\1radiation off;/' constant/granularProperties
        logged msddFoam
        off=$(conductivity)
        check "without it the bed conducts $off instead of $on W/(m K)" is_within "$(echo "$on $off $expected" | awk '{ print ($1 - $2)/$3 }')" 0.99 1.01
        warned "which is said" "Radiation would add about $added W/\\(m K\\) at $t K to the .* and is not in the model; emissivity $emissivity \\(radiation is off\\)"
        said "and at the end, too" "Warning: Radiation would add about [0-9.]+ W/\\(m K\\) at $t K"
    done
    rm -rf [1-9]*
    cp constant/granularProperties given
    sed -i '/radiation off/d; /emissivity/d' constant/granularProperties
    logged msddFoam
    said "without an emissivity one is assumed" 'Warning: Radiation would add .* emissivity 0.9, assumed'
    check "and the bed conducts as without radiation" [ "$(conductivity)" = "$off" ]
    rm -rf [1-9]*
    sed 's/emissivity .*/emissivity 1.2;/' given > constant/granularProperties
    check "an emissivity above 1 is refused" refused "Entry 'emissivity' is 1.2, allowed: 0 to 1"
    sed 's/emissivity .*/emissivity table ((300 0.5) (2000 1.3));/' given > constant/granularProperties
    check "of a table, too" refused "Entry 'emissivity' of constant/granularProperties is 1.0647058823529412 at 1500 K, allowed: 0 to 1"
}
within() { # steel under 20 kPa, warmed by a few kelvin
    sphere_case warm --material steel --mean-radius 0.0032 --box 0.15x0.15x0.15 --cells 4x1x1 --left 300 --right 293 --initial-temperature 293 --wall-material none
    controls "stopAt nextWrite; writeInterval 10; deltaT 10;"
    logged msddFoam
    said "a run like those that were compared" 'Range: no state was outside the range of the model, and the run lies within what it was compared with'
    check "has no such warning" [ "$(grep -c 'Beyond what' log)" = 0 ]
    said "forces of contacts are reported all the same" 'Contacts: at a pressure of 1[0-9.]* kPa the mean force'
    # Extremes of the time before a restart
    sed -i 's/uniform 300/uniform 293/' 0/T
    rm -rf ../warmer
    cp -r . ../warmer
    cd ../warmer
    rm -rf [1-9]* log
    sed -i '/left/,/}/ s/uniform .*/uniform 500;/' 0/T
    logged msddFoam
    local first
    first=$(ls -d [1-9]* | head -n 1)
    sed -i '/left/,/}/ s/uniform .*/uniform 300;/' "$first/T"
    controls "stopAt endTime; endTime $((first + 20)); startFrom latestTime;"
    logged msddFoam -accept '(files)'
    check "after a restart the hottest time is not forgotten" grep -q '"beyond": \[.*temperature up to 500 K (compared: 285 K to 354 K)' \
        postProcessing/msddFoam/summary.json
    check "nor when it was" grep -qE '"beyond_since": 0\}|"beyond_since": 10\}' postProcessing/msddFoam/summary.json
}
# A lid leaves a bed but for 8 % of its load, which is within the pressures compared, and comes back. The second run goes on from there
relieved() {
    spheres_bed relieved 'walls { ".*" { type frictionless; } top { type frictionless; displacement table ((0 (0 0 0)) (1 (0 0 5.5e-4)) (2 (0 0 5.5e-4)) (3 (0 0 0)) (4 (0 0 0))); } }'
    cube 2
    controls 'endTime 2;'
    logged msddFoam
    said "a loss of load" 'Warning: the bed was nearly without load, its mean pressure below 10 % of the largest before, from 1 to 2 s\.'
    check "p is validated until the bed carries load again" grep -q '"loaded_since": null, "largest_factor": null' postProcessing/msddFoam/summary.json
    controls 'endTime 4; startFrom latestTime;'
    logged msddFoam
    said "from when to when p is not validated" 'From 3 to 4 s the bed carries load again, up to [0-9.]+ k?Pa\. This pressure is not validated: .* was up to [0-9.]+ times the pressure in DEM'
    said "and that the run lies beyond what was compared" 'beyond what it was compared with by DEM: load after a loss of [0-9.]+ % \(compared: none\)'
    check "with the factor" grep -qE '"loaded_since": 3, "largest_factor": [0-9.]+\}' postProcessing/msddFoam/summary.json
    check "error bands end there" grep -q '"beyond_since": 3\}' postProcessing/msddFoam/summary.json
}
# A shell that expands at once, and more than its grains, and a lid that stays: the bed loses both, and cells at the top all support
opened() {
    sphere_case opened --material glass --diameter 0.004 --radius 0.05 --height 0.1 --cells 6x8 --side 80C --initial-temperature 20C \
        --lid stays --shell 200e9,0.002,1.2e-5 --end-time 30
    logged msddFoam
    said "a bed whose shell leaves it runs to its end" 'Warning: the bed was nearly without load, .* from 0\.3 to 30 s'
    check "steps that grains without support leave out of balance are counted" \
        grep -qE '^Equilibrium: .* largest residual left 10[0-9.]* Pa, in [0-9]+ steps above the limit of the step' log
    controls "stopAt nextWrite; writeInterval 1; deltaT 1;"
    local keys=constant/granularProperties
    cp "$keys" good
    one_step() { rm -rf [1-9]*; sed "$1" good > "$keys"; logged msddFoam; }
    one_step ''
    check "a shell like its mesh: no warning" bash -c '! grep -q "is a shell with" log'
    one_step 's/thickness 0\.002/thickness 0.02/'
    check "a thick shell: a warning" grep -q 'Patch side is a shell with thickness 0.02 m and radius 0.0' log
    one_step 's/temperature 293[0-9.]*/temperature 20/'
    check "a shell with its temperature in degrees: a warning" grep -q 'Patch side is a shell with temperature 20 K, .* 273 K hotter and so 0.328 % larger' log
    one_step 's/fixedPoint ([^)]*)/fixedPoint (1000 0 0)/'
    check "a fixed point beyond the shell: a warning" grep -q 'a fixedPoint at 1e+03 m along its axis, beyond its faces from 0 to 0.1 m' log
}
vessel() { # a tall glass bed in a thin vessel
    sphere_case vessel --material glass --mean-radius 0.002 --radius 0.05 --height 0.33 --side 300 --initial-temperature 293 --gravity 9.81 \
        --shell 200e9,0.002,1.2e-5 --wall-friction 0 --cells 4x20
    controls "stopAt nextWrite; writeInterval 1; deltaT 1;"
    logged msddFoam
    warned "a smooth side of a tall bed, and what friction would carry" \
        'The bed is 3\.3[0-9]* times as high as wide, and its side is smooth \(.*side.*\)\. .* would carry about [0-9]+\.?[0-9]* % of the weight, so that it presses with [0-9.]+ kPa'
    rm -rf [1-9]*
    sed -i 's/^\(value.*\)-9.81/\19.81/' constant/g
    logged msddFoam
    warned "gravity that points to the lid" "Gravity points to wall 'top', whose pressure is given: .* weight of the bed, [0-9.]+ kPa"
    rm -rf [1-9]*
    sed -i 's/type shell;/& friction 0.3;/' constant/granularProperties
    check "a friction without the way of slip is refused" refused "Patch side needs entries 'friction' and 'slip'"
    sphere_case fine --material glass --mean-radius 0.002 --box 0.04x0.02x0.02 --cells 40x2x2 --left 300
    controls "stopAt nextWrite; writeInterval 1; deltaT 1;"
    logged msddFoam
    warned "cells thinner than grains" '100 % of the cells are thinner than a grain, the thinnest 0\.25 diameters'
}
pebbles
hot_alumina
within
relieved
opened
vessel
