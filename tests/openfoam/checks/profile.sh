# What walls carry (wallProfile), forces of contacts (contactForces) and runs that end when they are steady (stopWhenSteady), on beds of
# `msdd case new --spheres`.
msdd=$(cd "$checkout" && realpath -m "${CARGO_TARGET_DIR:-target}")/release/msdd

profile_case() { # folder, options: a new case of spheres, meshed, that writes the tables of every step
    local name=$1
    shift
    rm -rf "${work:?}/$name"
    mkdir -p "$work"
    cd "$work"
    logged "$msdd" case new "$name" --yes --spheres --checkout "$checkout" "$@"
    cd "$name"
    controls 'functions { #remove "probes"
        wallProfile { writeControl timeStep; writeInterval 1; } contactForces { writeControl timeStep; writeInterval 1; }
        heatAudit { type heatAudit; libs ("libgranularFunctionObjects.so"); writeControl timeStep; writeInterval 1; } }'
    logged blockMesh
}
rows() { cat postProcessing/wallProfile/*/wallProfile.dat; } # of one run
patch_of() { rows | sed -n "s/^# patch \([0-9]*\): $1\$/\1/p" | head -n 1; }
at_end() { # patch, awk expression of its rows at the last time, summed
    rows | grep -v '^#' | awk -v patch="$(patch_of "$1")" -v end="$(rows | tail -n 1 | cut -f 1)" "\$1 == end && \$2 == patch { sum += $2 } END { printf \"%.12g\", sum }"
}
column_of() { # table of a function object, column: its last value
    awk -v name="$2" '/^# Time/ { for (i = 2; i <= NF; i++) if ($i == name) column = i - 1 } END { print $column }' postProcessing/"$1"/*/"$1".dat
}
out_of_balance() { # lengths of a box: the forces on its walls along its axis and its weight, over the weight
    rows | awk -v end="$(rows | tail -n 1 | cut -f 1)" -v weight="$(awk -v a="$1" -v b="$2" -v c="$3" 'BEGIN { print 7800*0.6*9.81*a*b*c }')" '
        /^# patch/ { name[$3 + 0] = $4; next } /^#/ || $1 != end { next }
        { sum += $5*(name[$2] == "bottom" ? -$6 : name[$2] == "top" ? $6 : $8) } END { e = sum/weight + 1; print (e < 0 ? -e : e) }'
}
relative() { echo "$1 $2" | awk '{ e = $1/$2 - 1; print (e < 0 ? -e : e) }'; }

heat_of_walls() { # grains that move, adaptive steps of two stages, walls with their resistance
    local e booked
    profile_case profile-heat --box 0.06x0.04x0.08 --cells 3x2x4 --left 340 --right h=20,T=300 --bottom q=50 --top insulated --initial-temperature 293.15 --gas air --end-time 400
    logged msddFoam
    booked=$(rows | awk '/^#/ { next } $1 != now { step = $1 - now; now = $1 } { sum += $5*$9*step } END { printf "%.12g", sum }')
    e=$(relative "$booked" "$(column_of heatAudit patches)")
    check "heat flux times area, summed over walls and steps: $booked J, booked through the patches within $e <= 1e-6" below "$e" 1e-6
    e=$(tail -n 1 postProcessing/heatAudit/*/heatAudit.dat | awk '{ print $NF }')
    check "and the balance closes to $e <= 1e-6" below "$e" 1e-6
    e=$(relative "$(at_end bottom '$5*$9')" "$(awk 'BEGIN { print 50*0.06*0.04 }')")
    check "a given flux is that of the profile within $e <= 1e-9" below "$e" 1e-9
    e=$(relative "$(at_end left '$5*$10')" "$(awk 'BEGIN { print 340*0.04*0.08 }')")
    check "wall_temperature of a wall of 340 K: within $e <= 1e-5" below "$e" 1e-5
    # The same on three processes, up to the residual of the mechanics
    cp -r . "$work/profile-parts.new" && rm -rf "$work/profile-parts" && mv "$work/profile-parts.new" "$work/profile-parts"
    local alone
    alone=$(at_end left '$5*$6'; echo; at_end left '$5*$9'; echo)
    cd "$work/profile-parts"
    rm -rf [1-9]* postProcessing
    foam_decompose='numberOfSubdomains 3; method simple; simpleCoeffs { n (3 1 1); delta 1e-3; }'
    echo "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; } $foam_decompose" > system/decomposeParDict
    logged decomposePar -force
    side_by_side 3
    e=$(paste -d ' ' <(echo "$alone") <(at_end left '$5*$6'; echo; at_end left '$5*$9'; echo) | awk '{ e = $1/$2 - 1; e = e < 0 ? -e : e; w = e > w ? e : w } END { print w }')
    check "three processes: force and heat of a wall within $e <= 1e-3 (residual of the mechanics)" below "$e" 1e-3
    e=$(out_of_balance 0.06 0.04 0.08)
    check "and the walls bear the weight within $e <= 1e-3 of it" below "$e" 1e-3
}
weight_on_walls() { # smooth walls that stay: the vertical stress is the weight above; rough ones: all forces balance
    local e sides wall
    profile_case profile-weight --box 0.06x0.06x0.12 --cells 1x1x12 --left insulated --thermal-expansion 0 --lid stays --slack-layer 0 --wall-friction 0 --pressure 1e4 --end-time 2
    controls 'functions { wallProfile { bins 12; } }'
    logged msddFoam
    e=$(rows | awk -v patch="$(patch_of left)" '!/^#/ && $2 == patch && $1 > 0 { law = 0.8*(1e4 + 7800*0.6*9.81*(0.12 - $3)); e = $6/law - 1; e = e < 0 ? -e : e; w = e > w ? e : w; n++ } END { print (n >= 12 ? w + 0 : "nan") }')
    check "normal stress over the height: 0.8 of pressure and weight above within $e <= 1e-3" below "$e" 1e-3
    e=$(rows | awk -v patch="$(patch_of left)" '!/^#/ && $2 == patch { e = $7 < 0 ? -$7 : $7; w = e > w ? e : w } END { print w + 0 }')
    check "smooth walls bear no shear: $e <= 1e-3 Pa" below "$e" 1e-3
    profile_case profile-rough --box 0.06x0.06x0.24 --cells 6x6x24 --left insulated --thermal-expansion 0 --pressure 1e3 --end-time 2
    grains 'equilibriumCoeffs { residual 0.1; }'
    logged msddFoam
    e=$(out_of_balance 0.06 0.06 0.24)
    check "rough walls bear the weight within $e <= 1e-4 of it (residual of 1e-5 of the pressure)" below "$e" 1e-4
    sides=0
    for wall in left right front back; do sides=$(echo "$sides $(at_end $wall '$5*$8')" | awk '{ print $1 + $2 }'); done
    check "the sides a part of it, downwards: $sides N" awk "BEGIN { exit !($sides < -0.1*7800*0.6*9.81*0.06*0.06*0.24) }"
}
sectors_and_names() {
    local area
    profile_case profile-sectors --box 0.06x0.04x0.04 --cells 4x4x2 --left 340 --mechanics none --end-time 2
    controls 'functions { wallProfile { patches ("(left|right)"); sectors 4; bins 2; } }'
    logged msddFoam
    check "patches by pattern" test "$(rows | grep -c '^# patch [0-9]')" = 2
    area=$(rows | awk -v patch="$(patch_of right)" '!/^#/ && $1 == 0 && $2 == patch { printf "%g %g;", $4, $5 }')
    check "sectors: faces with y above the middle at 45 degrees, the others at 315: $area" test "$area" = '45 0.0004;315 0.0004;45 0.0004;315 0.0004;'
    controls 'functions { wallProfile { patches (lid); } }'
    check "refused: patches that are not there" foreseen "Entry 'patches' of wallProfile matches no wall"
    controls 'functions { wallProfile { patches (left); axis (0 0 0); } }'
    check "refused: no axis" foreseen "Entry 'axis' is (0 0 0), allowed: a vector that is not zero"
}
contact_forces() { # Love and Weber's mean force of the fields
    local e time
    cd "$work/profile-heat"
    time=$(foamListTimes -latestTime 2> /dev/null | tail -n 1)
    columns "$time/pressure" "$time/porosity" "$time/coordination" "$time/contactForce" "$time/contactPressure" "$time/largeContactForce"
    e=$(cd "$time" && expression '($4 - 3.14159265358979*6.4e-3^2*$1/((1 - $2)*$3))/$4' pressure porosity coordination contactForce)
    check "contactForce is pi d2 p/(phi z) within $e <= 1e-5" below "$e" 1e-5
    e=$(cd "$time" && expression '($2/(6*$1*(210e9/2/(1 - 0.3^2))^2/(3.14159265358979^3*1.6e-3^2))^(1/3) - 1)' largeContactForce contactPressure)
    check "contactPressure is Hertz's of largeContactForce within $e <= 1e-5" below "$e" 1e-5
    controls 'stopAt nextWrite;'
    sed -i 's/hardness  *.*;/hardness 1e15; crushLoad 1e-6;/' constant/granularProperties
    sed -i 's/wall {.*//' constant/granularProperties && sed -i 's/granularWall/granularWall; resistance off/' 0/T
    rm -rf [1-9]* postProcessing
    logged msddFoam
    check "a crush load below the forces is a warning, with force and place" \
        grep -qE 'Warning: at a pressure of .* p is largest at \(.*\) m, above the crush load of 1e-06 N: grains would break' log
}
until_steady() {
    local e end
    profile_case steady --box 0.06x0.04x0.04 --cells 8x1x1 --left 340 --right 300 --initial-temperature 300 --mechanics none --gas vacuum --emissivity 0 --thermal-expansion 0 \
        --wall-material none --steady --probe 0.03,0.02,0.02
    check "--steady writes the key" grep -q 'stopWhenSteady  *1e-3;' system/fvSolution
    logged msddFoam
    end=$(foamListTimes -latestTime 2> /dev/null | tail -n 1)
    check "the run ended when it was steady, at $end s, with a write" bash -c "[ -e $end/T ] && awk \"BEGIN { exit !($end < 0.9*$(foamDictionary -entry endTime -value system/controlDict)) }\""
    check "the log says by what" grep -qE 'The bed was steady at .* s \(stopWhenSteady 0.001\): in as long a time as the run so far T would change by [0-9.e-]+ of its range, and p by 0 of' log
    e=$(field "$end/T" | awk '{ law = 340 - 40*(NR - 0.5)/8; e = ($1 - law)/40; e = e < 0 ? -e : e; w = e > w ? e : w } END { print w }')
    check "T is the straight line within $e <= 1e-3 of the range" below "$e" 1e-3
    check "and the end of the log says how near" grep -q 'In as long a time as the run T would change by' log
    # A wall that gets hotter later keeps the run going
    rm -rf [1-9]* postProcessing
    foamDictionary -entry boundaryField.left -set "{ type uniformFixedValue; uniformValue table ((0 340) ($end 340) ($(awk "BEGIN { print 2*$end }") 350)); value uniform 340; }" 0/T >> log
    logged msddFoam
    check "a wall that gets hotter later keeps it going" \
        awk "BEGIN { exit !($(foamListTimes -latestTime 2> /dev/null | tail -n 1) > 2*$end) }"
}

heat_of_walls
weight_on_walls
sectors_and_names
contact_forces
until_steady
