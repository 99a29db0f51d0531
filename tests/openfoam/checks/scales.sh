# Grains of any size must give the same result if lengths are measured in grain radii, stresses in E r, and times in units
# proportional to the square of the size. A constant in the solver that is absolute in Pa or m would break this. Loops of
# strain, whose stress is not to be trusted, must cause a warning.

scaled() { # folder, mean radius over 5 mm, entries of fvSolution's msddFoam (then adaptive steps), of granularProperties
    local name=$1 size=$2
    changed "$name"
    echo "scale $(awk "BEGIN { printf \"%.17g\", 0.001*$size }");" >> system/blockMeshDict
    grains "meanRadius $(awk "BEGIN { printf \"%.17g\", 5e-3*$size }"); $4"
    controls "$(awk "BEGIN { t = $size*$size; printf \"endTime %.17g; deltaT %.17g; writeInterval 20;\", t, 0.05*t }")"
    if [ -n "$3" ]; then
        scheme "$3"
        controls "adjustTimeStep yes; writeControl runTime; writeInterval $(awk "BEGIN { printf \"%.17g\", $size*$size }");"
    fi
    mesh_is '12 6 1'
}
latest() { foamListTimes -latestTime 2> /dev/null | tail -n 1; }
against() { # result, result at 5 mm, size: largest difference of each field, relative to the field's largest value
    local name power
    for name in T porosity fabricIndex conductivity stress nodeDisplacement; do
        [ -e "$1/$name" ] || continue
        case $name in stress | nodeDisplacement) power=1 ;; *) power=0 ;; esac
        paste -d ' ' <(field "$1/$name") <(field "$2/$name") | awk -v name=$name -v scale="$(awk "BEGIN { print $3^$power }")" '
            { for (i = 1; i <= NF/2; i++) { a = $i/scale; b = $(i + NF/2); e = a - b; if (e < 0) e = -e; if (b < 0) b = -b
              if (!(e <= worst)) worst = e; if (b > most) most = b }; n++ }
            END { print (n > 1 && most > 0 ? worst/most : "nan") }'
    done | awk '!($1 <= worst) { worst = $1 } { n++ } END { print (n ? worst + 0 : "nan") }'
}
any_size() { # name, bound, scheme, grains
    local size e start
    scaled "$1-1" 1 "$3" "$4"
    logged msddFoam
    start=$PWD/$(latest)
    for size in 0.002 0.02 0.2 20; do
        scaled "$1-$size" $size "$3" "$4"
        logged msddFoam
        e=$(against "$(latest)" "$start" $size)
        check "$1: grains of $(awk "BEGIN { print 5*$size }") mm against 5 mm: $e <= $2" below "$e" "$2"
    done
}
any_size scale-none 1e-10 '' ''
any_size scale-equilibrium 1e-6 '' 'mechanics equilibrium;'
solves() { sed -n 's/.*"solves": \([0-9]*\).*/\1/p' "postProcessing/msddFoam/summary.json"; }
check "scale-equilibrium: $(solves) steps solved" test "$(solves)" -gt 0
any_size scale-adaptive 1e-9 'timeScheme secondOrder; temperatureTolerance 0.5;' ''
any_size scale-adaptive-equilibrium 1e-6 'timeScheme secondOrder; temperatureTolerance 0.5;' 'mechanics equilibrium;'

# The columns, without the time, that function objects write: of one line, or of the lines of all windows
looked_at() { # folder, size
    scaled "$1" $2 '' 'mechanics equilibrium;'
    controls "functions {
        spaceProbes { type spaceProbes; libs (\"libgranularFunctionObjects.so\"); field T; writeControl writeTime;
            probeLocations ($(awk "BEGIN { printf \"(%.17g %.17g %.17g)\", 0.5*$2, 0.2*$2, 0.005*$2 }")); }
        subRegions { type subRegions; libs (\"libgranularFunctionObjects.so\"); windows (3 2); writeControl writeTime; }
        wallPressure { type wallPressure; libs (\"libgranularFunctionObjects.so\"); writeControl writeTime; }
    }"
    logged msddFoam
}
function_objects() {
    local object e
    looked_at scale-objects-1 1
    looked_at scale-objects 0.002
    for object in spaceProbes subRegions wallPressure; do
        # Pressures (the last columns of windows, and all columns of walls) are proportional to the size
        e=$(paste -d ' ' <(grep -v '^#' postProcessing/$object/0/$object.dat) <(grep -v '^#' ../scale-objects-1/postProcessing/$object/0/$object.dat) \
            | awk -v object=$object '{ n = NF/2; for (i = 2; i <= n; i++) { a = $i; b = $(i + n)
                  if (object == "wallPressure" || (object == "subRegions" && i > 8)) b *= 0.002
                  e = a - b; if (e < 0) e = -e; m = b < 0 ? -b : b; if (m > 0) e /= m; if (!(e <= w)) w = e } lines++ }
              END { print (lines ? w + 0 : "nan") }')
        check "$object at 10 um against 5 mm: $e <= 1e-6" below "$e" 1e-6
    done
}
function_objects

# The model onlineRve: with four times the size, all quantities are multiplied by powers of two, without rounding
boxes_in_cells() {
    local size
    for size in 1 0.00390625; do
        changed "scale-boxes-$size"
        echo "scale $(awk "BEGIN { printf \"%.17g\", 0.001*$size }");" >> system/blockMeshDict
        grains "meanRadius $(awk "BEGIN { printf \"%.17g\", 5e-3*$size }"); surrogate { type onlineRve; onlineRveCoeffs { discs 60; } }"
        controls "$(awk "BEGIN { t = $size*$size; printf \"endTime %.17g; deltaT %.17g; writeInterval 4;\", 0.2*t, 0.05*t }")"
        mesh_is '3 1 1'
        logged msddFoam
    done
    size=$(against "$(latest)" "../scale-boxes-1/0.2" 0.00390625)
    check "onlineRve at 20 um against 5 mm: $size <= 1e-9" below "$size" 1e-9
}
boxes_in_cells

# The error of the default residual, from a comparison with a residual a hundred times smaller
exact_enough() {
    local size e residual
    for size in 0.002 0.02; do
        scaled residual-exact $size '' "mechanics equilibrium; equilibriumCoeffs { residual $(awk "BEGIN { print 0.05*$size }"); }"
        logged msddFoam
        scaled residual $size '' 'mechanics equilibrium;'
        logged msddFoam
        e=$(awk 'NR == FNR { a[FNR] = $1; next } { e = $1/a[FNR] - 1; if (e < 0) e = -e; if (!(e <= w)) w = e } END { print w }' \
            <(field "../residual-exact/$(latest)/pressure") <(field "$(latest)/pressure"))
        check "default residual at $(awk "BEGIN { print 5*$size }") mm: pressure to $e <= 0.005" below "$e" 0.005
    done
}
exact_enough
scaled residual-large 0.002 '' 'mechanics equilibrium; equilibriumCoeffs { residual 5; maxResidual 100; }'
logged msddFoam
check "nothing was ever solved: said" grep -q 'The grains were never moved: at most .* Pa were out of balance' log
check "nothing was ever solved: in summary.json" grep -q '"warnings": \["The grains were never moved' postProcessing/msddFoam/summary.json
changed residual-still
grains 'thermalExpansion 0; mechanics equilibrium;'
controls 'endTime 0.1;'
mesh_is '3 2 1'
logged msddFoam
check "nothing to solve: nothing said" grep -q '"warnings": \[\]' postProcessing/msddFoam/summary.json
