# Cells outside of the range that the model was trained for (its region).

hot() { # folder, policy: a case whose grains swell by a fifth
    changed "$1"
    shift
    sed -i 's/uniform 100/uniform 800/' 0/T
    grains "surrogate { outOfTrainingRange { $* } }"
    mesh_is '12 6 1'
}
hot region-error
check "dense side: error by default" refused 'of outOfTrainingRange in constant/granularProperties is error'
check "offenders.json is written before" grep -q '"schema": "msdd-offenders-1"' postProcessing/msddFoam/offenders.json
check "offenders.json has rows" grep -q '"side": "below", "column": "porosity"\|"side": "above", "column": "elastic_compression"' \
    postProcessing/msddFoam/offenders.json

hot region-clamp 'porosity { below clamp; } elasticCompression { above clamp; } thermalStrain { above clamp; }'
logged msddFoam
check "clamp: goes on, and inTrainingRange shows the cells" \
    test "$(field 1/inTrainingRange | awk '$1 == 0 { out++ } $1 == 1 { in_++ } END { print (out > 0 && in_ > 0) }')" = 1
check "clamp: counted" grep -q '"clamped_queries": [1-9]' postProcessing/msddFoam/summary.json
check "clamp: the end of the run says how many states were outside, and how many cells are" grep -q -- \
    "- Range: .* % of the states were outside .* At the end $(field 1/inTrainingRange | grep -cx 0) of 72 cells are outside" log
check "clamp: no warning" test "$(grep -c 'FOAM Warning' log)" = 0

hot region-former 'porosity { below clamp; } elasticCompression { above clamp; } thermalStrain { above clamp; }'
sed -i 's/outOfTrainingRange/outOfRegion/' constant/granularProperties
logged msddFoam
check "the former name of a key is read, with a line in the log" \
    grep -q "^Renamed since version 0.3: entry 'outOfRegion' in .* is 'outOfTrainingRange' now" log
check "former name: the same fields" cmp 1/T ../region-clamp/1/T
check "former name: the same cells" cmp 1/inTrainingRange ../region-clamp/1/inTrainingRange

hot region-warn 'porosity { below warn; } elasticCompression { above warn; } thermalStrain { above clamp; }'
logged msddFoam
check "warn: said once a column" test "$(grep -c 'below the region\|above the region' log)" -ge 1 -a \
    "$(grep -c 'below the region\|above the region' log)" -le 2

hot region-cap 'maxFraction 0.01; porosity { below clamp; } elasticCompression { above clamp; } thermalStrain { above clamp; }'
check "maxFraction: too many cells outside" refused "Entry 'maxFraction'"

hot region-fixed 'thermalStrain { above cutStep; }'
controls 'deltaT 1; endTime 2;'
check "cutStep with fixed steps: error" refused 'cannot be cut'

hot region-cut 'porosity { below clamp; } elasticCompression { above clamp; }'
controls 'adjustTimeStep yes; deltaT 1; writeControl runTime; writeInterval 1;'
scheme 'timeScheme secondOrder; temperatureTolerance 1000; stateTolerance 100;'
logged msddFoam
check "cutStep with adaptive steps: repeated" \
    grep -q '"rejected_steps": [1-9]' postProcessing/msddFoam/summary.json
check "cells of steps that were repeated are not listed, others are" \
    awk '/"column": "thermal_strain"/ { bad = 1 } /"column"/ { n++ } END { exit !(n > 0 && !bad) }' postProcessing/msddFoam/offenders.json
controls 'minDeltaT 0;'
rm -rf 1
check "refused: adaptive steps without a least one" refused "Entry 'minDeltaT' is 0, allowed: 1e-14 to"

changed region-start
sed -i 's/^#include.*porosity.*/&\ninternalField uniform 0.02;/' 0/porosity
mesh_is '12 6 1'
check "the start is judged before the first step" refused 'At the start 72 cells have porosity below'

loose_start() { # folder, porosity, policy
    changed "$1"
    sed -i "s/^#include.*porosity.*/&\ninternalField uniform $2;/" 0/porosity
    grains "surrogate { outOfTrainingRange { porosity { $3 } } }"
    mesh_is '2 1 1'
    controls 'endTime 0.05;'
}
loose_start region-packed 0.185 ''
logged msddFoam
check "a start among the packings: nothing is said" test "$(grep -c 'At the start' log)" = 0
loose_start region-loose 0.2 ''
logged msddFoam
check "a loose start is said, with cells and porosity" \
    grep -q 'At the start 2 of 2 cells have a porosity above 0.19, up to 0.2, looser than all packings' log
loose_start region-loose-error 0.21 'above error;'
logged msddFoam
for porosity in 0.25 0.4 0.999; do
    loose_start region-apart $porosity ''
    check "porosity $porosity: refused, grains do not touch" refused "above 0.22 in 2 of 2 cells, up to $porosity, allowed: at most 0.22"
done
loose_start region-apart-error 0.25 'above error;'
check "porosity 0.25, above error: refused" refused "above 0.22 in 2 of 2 cells"
loose_start region-apart-clamp 0.4 'above clamp;'
logged msddFoam
check "porosity 0.4, above clamp: allowed and said" grep -q 'At the start 2 of 2 cells have a porosity above 0.19' log
check "porosity 0.4, above clamp: how far outside is said" \
    grep -q 'At the start 2 cells have porosity above the region of the model, by up to 0.132' log
