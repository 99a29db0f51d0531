# Strain paths with closed loops must cause a warning, curved paths without loops must not. Sourced by mechanics.sh: needs
# equilibrium, uniform_temperature.

circles() { # folder, porosity, number of circles of 0.5 % strain in the plane of xx and yy, 40 steps each; negative: clockwise
    local table
    changed "$1"
    uniform_temperature
    sed -i "s/^#include.*common.porosity.*/&\ninternalField uniform $2;/" 0/porosity
    table=$(awk -v n="$3" 'BEGIN { pi = atan2(0, -1); s = n < 0 ? -1 : 1
        for (k = 0; k <= 40*n*s; k++) printf "(%g (%.12g %.12g 0)) ", 0.05*k, 2.15*0.005*(cos(pi*k/20) - 1), s*0.645*0.005*sin(pi*k/20) }')
    equilibrium "walls { \".*\" { type frictionless; } \"right|top\" { type frictionless; displacement table ($table); } }"
    controls "writeInterval 40; endTime $(awk -v n="$3" 'BEGIN { print 2*(n < 0 ? -n : n) }');"
    mesh_is '3 2 1'
    logged msddFoam
}
said() { grep -c 'have been strained along closed loops' "${1:-log}"; }
looped() { sed -n 's/.*"looped_cells": \([0-9]*\).*/\1/p' postProcessing/msddFoam/summary.json; }

circles two-circles 0.16 2
check "two circles of 0.5 %: not said" test "$(said)" = 0 -a "$(looped)" = 0
for porosity in 0.12 0.18; do
    for turns in 4 -4; do
        circles four-circles $porosity $turns
        check "four circles, porosity $porosity, $turns: said once, between the second and the third, and counted" \
            test "$(said)" = 1 -a "$(looped)" = 6 -a "$(grep -o 'At time [0-9.]* 6 cells' log)" = 'At time 5.6 6 cells'
    done
done
e=$(field 2/strainLoops | awk '{ e = $1/(atan2(0, -1)*0.005^2) + 1; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print (NR == 6 ? w : "nan") }')
check "the area of a circle is kept: to $e <= 0.01" below "$e" 0.01
cp -r . "$work/four-circles-half"
cd "$work/four-circles-half"
rm -rf 6 8
logged msddFoam
e=$(paste -d ' ' <(field "$work/four-circles/8/strainLoops") <(field 8/strainLoops) \
    | awk '{ for (i = 1; i <= 3; i++) { e = $i - $(i + 3); if (e < 0) e = -e; if (!(e <= w)) w = e } } END { print (NR == 6 ? w + 0 : "nan") }')
check "loops go on after a restart: areas to $e <= 1e-12" below "$e" 1e-12
rm -rf "$work/four-circles-half"

changed straight
uniform_temperature
equilibrium "walls { \".*\" { type frictionless; } \"right|top\" { type frictionless;
    displacement table ((0 (0 0 0)) (0.5 (-0.02 0.005 0)) (1 (0 0 0)) (1.5 (-0.02 0.005 0)) (2 (0 0 0)) (2.5 (-0.02 0.005 0)) (3 (0 0 0))); } }"
controls 'endTime 3; writeInterval 60;'
mesh_is '3 2 1'
logged msddFoam
check "to and fro on one line: not said" test "$(said)" = 0 -a "$(looped)" = 0
