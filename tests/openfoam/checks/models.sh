# All models by run-time selection, and the number of cells for which they are evaluated.

number() { sed -n "s/.*\"$1\": \([0-9.e+-]*\).*/\1/p" postProcessing/msddFoam/summary.json | head -n 1; }

small_as_it_is

changed constant # takes the conductivity of the builtin model at the mean initial state
grains 'surrogate { type constant; }'
mesh_is '12 6 1'
logged msddFoam
check "constant: conductivity as in the network's start" test \
    "$(field 1/conductivity | awk 'NR == 1 { printf "%.6f %.6f", $1, $4 }')" = \
    "$(field "$work/serial/0.05/conductivity" | awk 'NR == 1 { printf "%.6f %.6f", $1, $4 }')"

changed paper-network
grains 'surrogate { model builtin:paper; outOfTrainingRange { porosity { below clamp; } } }'
mesh_is '12 6 1'
logged msddFoam
check "network: the paper's has no state but porosity and fabric" test ! -e 1/elasticCompression

changed affine # the affine upper bound must conduct better, and everything else be the same
grains 'surrogate { conductivity affine; }'
mesh_is '12 6 1'
logged msddFoam
check "network: affine conductivity is above the network's" awk '{ if (!($1 > $2 && $1 < 1.1*$2)) bad = 1 } END { exit bad || NR == 0 }' \
    <(paste <(field 0.05/conductivity | awk '{ print $1 }') <(field "$work/serial/0.05/conductivity" | awk '{ print $1 }'))

changed plug-in # the example of a plug-in in C, given by a path relative to the case
compiled() { # library, source in the checkout, macros
    cc -std=c99 -O2 -shared -fPIC -I"$checkout/rust/capi/include" "${@:3}" "$checkout/$2" -lm -o "$1"
}
compiled medium.so rust/capi/examples/effective_medium.c
grains 'surrogate { type plugin; pluginCoeffs { library medium.so; } }'
mesh_is '12 6 1'
library=$(pwd -P)/medium.so
if [ "$(id -u)" = 0 ]; then # as root a plug-in is loaded only if the environment names it
    check "plugin: refused as root" refused "export MSDD_ALLOW_PLUGINS=\"$library\""
    compiled other.so rust/capi/examples/effective_medium.c
    MSDD_ALLOW_PLUGINS=$PWD/other.so:medium check "plugin: refused as root when another is named" refused "export MSDD_ALLOW_PLUGINS=\"$library\""
    check "plugin: refused before its code runs" bash -c '! grep -q "its code runs" log.bad'
fi
export MSDD_ALLOW_PLUGINS=other.so:./medium.so
mkdir -p home/.OpenFOAM
echo 'InfoSwitches { allowSystemOperations 0; }' > home/.OpenFOAM/controlDict
HOME=$PWD/home check "plugin: refused where the machine allows no code of cases" refused 'does not allow code of cases'
logged msddFoam
check "plugin: says that its code runs" grep -qF "Loading plug-in \"$library\": its code runs in this process" log
check "plugin: hotter cells are denser than 0.125, colder ones looser" awk '
    { if (($1 > 50) != ($2 < 0.125)) bad = 1 } END { exit bad || NR != 72 }' <(paste <(field 1/T) <(field 1/porosity))
check "plugin: the summary names it" grep -q 'medium.so' postProcessing/msddFoam/summary.json

foul() { # name of the check, message, macros: a defective plug-in that must be refused
    compiled medium.so rust/plugin/tests/plain.c -DHAS_ALL "${@:3}"
    rm -rf 0.* 1 # from the start
    check "plugin: refused: $1" refused "$2"
}
foul "porosity that leaves its range" ', allowed: 0 to 1' -DANSWERS='step->next_state[0][0]-=1e5*step->thermal_strain[0]'
foul "tension" 'stress_yy[3] = -7, allowed: 0 to 1e30: compression' -DANSWERS='step->stress_yy[3]=-7'
foul "a path for a name" 'state_names[2] = "../../escaped", allowed' -DNAMES='"porosity","fabric_index","../../escaped"'
for column in initial_temperature initialTemperature stress_ T bulk_density uniform points; do
    foul "column $column" "has the state column \"$column\", whose field" -DNAMES="\"porosity\",\"fabric_index\",\"$column\""
done
cp log.bad ..
unset MSDD_ALLOW_PLUGINS

changed own-fields # every field that the solver writes must be among the names that columns of a plug-in may not have
grains 'mechanics equilibrium; surrogate { type network; }'
mesh_is '12 6 1'
logged msddFoam
own_fields() {
    local name columns='porosity fabricIndex fabricShear jammingFraction elasticCompression elasticShear1 elasticShear1Xy elasticShear2 elasticShear2Xy strength ownConductivity ownConductivityIndex ownConductivityShear'
    for name in $(ls 1); do
        grep -qw -- "$name" <<< "$columns $(grep 'Allowed: any name except' ../log.bad)" || { echo "$name is not refused" >&2; return 1; }
    done
}
check "plugin: its columns may have no name of $(ls 1 | wc -l) that the solver writes" own_fields

online() { # folder, further keys: two cells that are heated, with boxes of 60 grains
    changed "$1"
    shift
    grains "surrogate { type onlineRve; onlineRveCoeffs { discs 60; $1 } $2 }"
    controls 'endTime 0.2;'
    mesh_is '2 1 1'
}
online online-cell '' 'smallestStrain 0;'
logged msddFoam
cp -r . "$work/online-half.new"
check "onlineRve: hot cells take porosity" \
    awk 'NR == 1 { first = $1 } END { exit !(first < last_start) }' last_start="$(field 0.05/porosity | head -n 1)" <(field 0.2/porosity)
rm -rf "$work/online-half"
mv "$work/online-half.new" "$work/online-half"
cd "$work/online-half"
rm -rf 0.15 0.2
logged msddFoam
check "onlineRve: restart bit for bit" cmp -s "$work/online-cell/0.2/onlineRve.json" 0.2/onlineRve.json
online online-waits '' 'smallestStrain 0.01;'
logged msddFoam
check "onlineRve: asked less with smallestStrain" \
    test "$(number cell_queries)" -lt "$(cd "$work/online-cell" && number cell_queries)"

changed waits # strains below smallestStrain must be accumulated, not lost
grains 'surrogate { smallestStrain 1e-3; }'
mesh_is '12 6 1'
logged msddFoam
check "economy: asked $(number cell_queries) of $(number cell_steps) cell-steps" \
    test "$(number cell_queries)" -lt "$(number cell_steps)"
e=$(paste -d ' ' <(field "$work/serial/1/T") <(field 1/T) | awk '{ e = $1 - $2; if (e < 0) e = -e; if (e > w) w = e } END { print w }')
check "economy: T within 0.2 K of all asked: $e" below "$e" 0.2

changed still # without expansion the model must be evaluated only once
grains 'thermalExpansion 0;'
mesh_is '12 6 1'
logged msddFoam
check "economy: without expansion 72 cells are asked once" test "$(number cell_queries)" = 72
