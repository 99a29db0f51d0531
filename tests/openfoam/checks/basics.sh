# A closed-form solution, relations between written fields, a restart, and two processes.

slab() { # compared with the closed form; a conductivity or heat capacity that is wrong by 0.5 % exceeds the bound
    fresh slab slab
    logged msddFoam
    local error
    error=$(awk -v heat_capacity=2 -v length_x=0.1 -v time=0.6 -f "$here/slab.awk" \
        <(field 0.6/T) <(field 0.6/conductivity) <(field 0.6/bulkDensity) || true)
    check "slab: error of T against the closed form $error <= 1e-3 of the step" below "$error" 1e-3
    check "slab: fabric 0.05 conducts and presses more along x than along y" test \
        "$(paste -d ' ' <(field 0.6/conductivity) <(field 0.6/stress) | awk '{ print ($1 > $4 && $7 < $10) }')" = 1
    check "slab: no expansion, so one query" grep -q '"queries": 1,' postProcessing/msddFoam/summary.json
}

formulas() { # relations that the written fields must satisfy after 20 steps with expansion
    fresh small serial
    logged msddFoam
    columns 1/{T,thermalStrain,thermalStrainIncrement,porosity,particleDensity,pressure,stress} 0.95/{T,porosity}
    check "thermalStrain = alpha (T - T0)" below "$(expression '$2 - 1e-3*($1 - 50)' 1/T 1/thermalStrain)" 1e-14
    check "strain increment = alpha (T1 - T0)/(1 + alpha (T0 - 50)), step 5" below \
        "$(expression '$3 - 1e-3*($2 - $1)/(1 + 1e-3*($1 - 50))' 0.95/T 1/T 1/thermalStrainIncrement)" 1e-14
    check "particleDensity = bulkDensity/(1 - porosity)" below \
        "$(expression '$2*(1 - $1)/'"$(field 1/bulkDensity)"' - 1' 1/porosity 1/particleDensity)" 1e-13
    check "pressure = -(stress_xx + stress_yy)/2" below "$(expression '$1/(-0.5*($2 + $5)) - 1' 1/pressure 1/stress)" 1e-13
    check "stress is tension positive, and the grains are compressed: cells with xx or yy >= 0" below \
        "$(awk '$1 >= 0 || $4 >= 0 { n++ } END { print n + 0 }' 1/stress.column)" 0
    check "hot grains take porosity, cold ones give it: sign of the change against that of T - 50" below \
        "$(paste -d ' ' 1/T.column 1/porosity.column | awk '($1 > 60 && $2 >= 0.125) || ($1 < 40 && $2 <= 0.125) { n++ } END { print n + 0 }')" 0
    check "the summary of the run has range, warning, heat, grains, cost" test \
        "$(sed -n '/^Accuracy and warnings/,/^$/p' log | grep -c '^  - \(Range: no state was outside\|Warning: sampling scatter\|Heat: since\|Grains: they stay\|Cost: \)')" = 5
    local heat
    heat=$(sed -n 's/.*"stored": \([^,]*\),.*"relative_difference": \([^}]*\)}.*/\1 \2/p' postProcessing/msddFoam/summary.json)
    check "summary.json: heat $heat was stored, and its balance closes" test "$(echo "$heat" | awk '{ print ($1 != 0 && $2 >= 0 && $2 < 1e-7) }')" = 1
    check "the log begins with version and commit, and the version of OpenFOAM" test \
        "$(grep -A1 '^msddFoam [0-9.]* (commit [0-9a-z]*)$' log | sed -n 2p)" = "Built for OpenFOAM v$(foam_api)$(
            [ "$(foam_api)" = 1912 ] || echo ', untested with this version')"
    check "summary.json names it, too" grep -q "\"built_for\": \"$(sed -n 's/^Built for //p' log)\"" postProcessing/msddFoam/summary.json
    results_are_right
    check "a query a step" grep -q '"queries": 20,' postProcessing/msddFoam/summary.json
}

results_are_right() { # the numbers at the end against the fields and the balance of heat
    check "the log has the results" test "$(sed -n '/^Results at 1 s:/,/^$/p' log | grep -c '^  - \(Temperature\|Conductivity\|Heat into\|Stress on walls\)')" = 4
    python3 - postProcessing/msddFoam/summary.json $(field 1/T | sort -g | sed -n '1p;$p') > results.txt <<'PYTHON'
import json, sys
summary = json.load(open(sys.argv[1]))
results, (least, largest) = summary["results"], map(float, sys.argv[2:])
T, walls = results["temperature"], results["walls"]
print(max(abs(T["least"] / least - 1), abs(T["largest"] / largest - 1)))
heat = sum(wall["heat"] for wall in walls.values())
print(abs(heat - summary["steady"]["uptake"]) / max(abs(wall["heat"]) for wall in walls.values()))
print(min(wall["normal_mean"] - wall["normal_least"] for wall in walls.values()) >= 0)
print(min(wall["normal_largest"] - wall["normal_mean"] for wall in walls.values()) >= 0)
PYTHON
    local e
    e=$(sed -n 1p results.txt)
    check "results: T differs from the field by $e <= 1e-9" below "$e" 1e-9
    e=$(sed -n 2p results.txt)
    check "results: heat through walls differs from the heat taken up by $e <= 1e-7 of the largest" below "$e" 1e-7
    check "results: least <= mean <= largest" test "$(sed -n '3,4p' results.txt | tr '\n' ' ')" = "True True "
}

restarted() { # ten steps, a restart and ten more must give the result of twenty steps
    fresh small restart
    logged foamDictionary -entry endTime -set 0.5 system/controlDict
    logged msddFoam
    logged foamDictionary -entry endTime -set 1 system/controlDict
    logged msddFoam
    local e
    e=$(difference ../serial/1 1)
    check "restart: difference $e <= 1e-12" below "$e" 1e-12
}

parallel() {
    fresh small parallel
    logged decomposePar
    logged mpirun --oversubscribe -np 2 msddFoam -parallel
    logged reconstructPar -latestTime
    local e
    e=$(difference ../serial/1 1)
    check "two processes: difference $e <= 1e-9" below "$e" 1e-9
    local results=(../serial/postProcessing/msddFoam/summary.json postProcessing/msddFoam/summary.json)
    e=$(python3 - "${results[@]}" <<'PYTHON'
import json, sys
def numbers(value):
    if isinstance(value, dict):
        return [x for part in value.values() for x in numbers(part)]
    return [x for part in value for x in numbers(part)] if isinstance(value, list) else [value]
a, b = (numbers(json.load(open(file))["results"]) for file in sys.argv[1:])
print(max(abs(x - y) / max(abs(x), abs(y), 1e-9) for x, y in zip(a, b)) if len(a) == len(b) else 1)
PYTHON
    )
    check "two processes: results differ by $e <= 1e-6" below "$e" 1e-6
}

bulk_density() { # the paper's option is density x (1 - porosity); the mass-consistent one counts overlaps twice and is larger
    fresh small paper
    echo 'bulkDensity paper;' >> constant/granularProperties
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
    local paper consistent
    paper=$(field 0.05/bulkDensity)
    consistent=$(field ../serial/1/bulkDensity)
    check "bulkDensity paper: $paper = 3000 (1 - 0.125)" below "$(awk "BEGIN { print ($paper - 2625)^2 }")" 1e-12
    check "bulkDensity massConsistent: $consistent is 0 to 5 % above" below \
        "$(awk "BEGIN { print ($consistent/$paper - 1.025)^2 }")" 0.000625
}

conductivity_factor() { # twice the conductivity and twice the heat capacity: the same T
    fresh small factor
    echo 'conductivityFactor 2; heatCapacity 2;' >> constant/granularProperties
    logged msddFoam
    local e
    e=$(difference ../serial/1 1)
    check "conductivityFactor 2, twice the heat capacity: difference $e <= 1e-12" below "$e" 1e-12
}

slab
formulas
restarted
parallel
bulk_density
conductivity_factor
