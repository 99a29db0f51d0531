# Runs that write every step are killed (-9) at random moments, on one process and on three. Continued from the newest complete
# time they must give the same bytes as a run that was not killed: fields, boxes of grains and the run's record; the state that
# function objects keep is excepted, since OpenFOAM writes it only when a run ends. Seven kinds of runs, each killed once, with
# --full nine times (126 kills in all, serial and parallel). MSDD_SEED sets the random moments.

. "$here/flow_cases"
RANDOM=${MSDD_SEED:-$(date +%s)}
echo "        moments of the kills: MSDD_SEED=${MSDD_SEED:-of the clock}"
kills=$([ $full = yes ] && echo 9 || echo 1)

every_step() { # folder, fixed or adaptive: the case small with about 20 steps, all of which are written
    changed "$1"
    controls 'writeInterval 1; timePrecision 10;'
    [ "$2" = fixed ] || {
        controls 'adjustTimeStep yes; deltaT 1e-3;'
        scheme 'timeScheme secondOrder; temperatureTolerance 0.3;'
    }
}
start() { # processes: starts the solver in the background; $solver is its process id
    local command=(msddFoam -case "$PWD")
    [ "$1" = 1 ] || command=(mpirun --oversubscribe -np "$1" "${command[@]}" -parallel)
    (timeout 600 "${command[@]}"; exit $?) >> log 2>&1 &
    solver=$!
}
kill_all() { # kills all processes at once, as a power cut would: none sees another one end
    pkill -9 -f -- "-case $PWD" || [ $? = 1 ] # 1: none was left
    wait "$solver" 2> /dev/null || true
}
killed_and_restarted() { # processes: runs this case, kills it once and restarts it
    local times folder=. after
    [ "$1" = 1 ] || folder=processor$(($1 - 1))
    start "$1"
    # The kill falls into the step after a random one of the times that the undisturbed run wrote
    times=($(sed -n 's/^Time = //p' "$whole/log"))
    after=${times[$((RANDOM % (${#times[@]} - 2)))]}
    while [ ! -e "$folder/$after/uniform/time" ] && kill -0 "$solver" 2> /dev/null; do sleep 0.002; done
    sleep "$(awk -v r=$RANDOM 'BEGIN { print 0.03*r/32767 }')"
    kill_all
    goes_on "$1"
}
goes_on() { # processes: after a kill this case must end with the bytes of the undisturbed run
    local last
    start "$1"
    wait "$solver" || { tail -n 15 log >&2; return 1; }
    for last in "$whole"/processor*/1 "$whole"/1; do
        [ ! -d "$last" ] || diff -rq -x functionObjects "$last" "${last/#$whole/$PWD}" >&2 || return 1
    done
}
copy_of_whole() {
    rm -rf "$work/killed"
    cp -r "$whole" "$work/killed"
    cd "$work/killed"
}
same_bytes() { # name of the check: for this case on one process and on three
    local what=$1 name=${PWD##*/} processes i same whole
    for processes in 1 3; do
        whole=$work/$name-$processes
        rm -rf "$whole"
        cp -r "$work/$name" "$whole"
        cd "$whole"
        if [ $processes = 3 ]; then
            in_parts '3 1'
            rm -rf 0
        fi
        start $processes
        wait "$solver" || { tail -n 15 log >&2; check "$what runs on $processes processes" false; continue; }
        copy_of_whole
        rm -rf processor*/1 1 log
        check "$what on $processes processes: the last step alone, done again, has the same bytes" goes_on $processes
        same=0
        for ((i = 0; i < kills; i++)); do
            copy_of_whole
            rm -rf processor*/0.* processor*/1 0.* 1 log
            killed_and_restarted $processes && same=$((same + 1))
        done
        check "$what, killed while it writes, on $processes processes: $same of $kills go on to the same bytes" test $same = "$kills"
    done
}
for steps in fixed adaptive; do
    every_step killed-none-$steps $steps
    mesh_is '12 6 1'
    same_bytes "grains that stay, $steps steps"
    every_step killed-equilibrium-$steps $steps
    grains 'mechanics equilibrium; equilibriumCoeffs { residual 1e-2; }'
    mesh_is '12 6 1'
    same_bytes "equilibrium, $steps steps"
    every_step killed-online-$steps $steps
    grains "surrogate { type onlineRve; onlineRveCoeffs { discs 60; rvePer history; } smallestStrain 0; }"
    mesh_is '6 3 1'
    same_bytes "online RVEs, $steps steps"
done
channelling=layer across=3 driven killed-flow 6 'in { massFlow table ((0 0.002) (1 0.004)); temperature 700; } out { temperature 310; }' \
    'gasPressure 1e5; temperatures two; walls { sides { heatCapacity 8000; loss 2; ambient 300; } }' \
    'endTime 1; deltaT 0.05; writeInterval 1;' '' 1
gravity_is '-9.81 0 0'
same_bytes "gas by pressure and buoyancy"
