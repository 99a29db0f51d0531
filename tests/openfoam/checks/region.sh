# Outside of the region that the model was trained for.

hot() { # folder, policy: grains that swell by a fifth
    changed "$1"
    shift
    sed -i 's/uniform 100/uniform 800/' 0/T
    grains "surrogate { outOfRegion { $* } }"
    mesh_is '12 6 1'
}
hot region-error
check "dense side: error by default" refused 'of outOfRegion in constant/granularProperties is error'
check "offenders.json is written before" grep -q '"schema": "msdd-offenders-1"' postProcessing/msddFoam/offenders.json
check "offenders.json has rows" grep -q '"side": "below", "column": "porosity"\|"side": "above", "column": "reduced_pressure"' \
    postProcessing/msddFoam/offenders.json

hot region-clamp 'porosity { below clamp; } reducedPressure { above clamp; } thermalStrain { above clamp; }'
logged msddFoam
check "clamp: goes on, and inRegion shows the cells" \
    test "$(field 1/inRegion | awk '$1 == 0 { out++ } $1 == 1 { in_++ } END { print (out > 0 && in_ > 0) }')" = 1
check "clamp: counted" grep -q '"clamped_queries": [1-9]' postProcessing/msddFoam/summary.json
check "clamp: no warning" test "$(grep -c 'FOAM Warning' log)" = 0

hot region-warn 'porosity { below warn; } reducedPressure { above warn; } thermalStrain { above clamp; }'
logged msddFoam
check "warn: said once a column" test "$(grep -c 'below the region\|above the region' log)" -ge 1 -a \
    "$(grep -c 'below the region\|above the region' log)" -le 2

hot region-cap 'maxFraction 0.01; porosity { below clamp; } reducedPressure { above clamp; } thermalStrain { above clamp; }'
check "maxFraction: too many cells outside" refused "Entry 'maxFraction'"

hot region-fixed 'thermalStrain { above cutStep; }'
controls 'deltaT 1; endTime 2;'
check "cutStep with fixed steps: error" refused 'cannot be cut'

hot region-cut 'porosity { below clamp; } reducedPressure { above clamp; }'
controls 'adjustTimeStep yes; deltaT 1; writeControl runTime; writeInterval 1;'
scheme 'timeScheme secondOrder; temperatureTolerance 1000; stateTolerance 100;'
logged msddFoam
check "cutStep with adaptive steps: repeated" \
    grep -q '"rejected_steps": [1-9]' postProcessing/msddFoam/summary.json

changed region-start
sed -i 's/^#include.*porosity.*/&\ninternalField uniform 0.02;/' 0/porosity
mesh_is '12 6 1'
check "the start is judged before the first step" refused 'At the start 72 cells have porosity below'
