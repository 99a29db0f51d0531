# Runs that write every step are killed (-9) at random moments, on one process and on three, and go on from the newest whole
# time to the same bytes as a run that nobody killed: fields, boxes of grains, record and all but what function objects keep for
# themselves, which OpenFOAM writes when a run ends. Six ways of running; of each one
# kill, --full nine (108 in all, serial and parallel). MSDD_SEED sets the moments.

RANDOM=${MSDD_SEED:-$(date +%s)}
echo "        moments of the kills: MSDD_SEED=${MSDD_SEED:-of the clock}"
kills=$([ $full = yes ] && echo 9 || echo 1)

every_step() { # folder, fixed or adaptive: small, 20 steps or so, all written
    changed "$1"
    controls 'writeInterval 1; timePrecision 10;'
    [ "$2" = fixed ] || {
        controls 'adjustTimeStep yes; deltaT 1e-3;'
        scheme 'timeScheme secondOrder; temperatureTolerance 0.3;'
    }
}
start() { # processes: the solver, in the background, as $solver
    local command=(msddFoam -case "$PWD")
    [ "$1" = 1 ] || command=(mpirun --oversubscribe -np "$1" "${command[@]}" -parallel)
    (timeout 120 "${command[@]}"; exit $?) >> log 2>&1 &
    solver=$!
}
kill_all() { # as a power cut: no process sees the others die
    pkill -9 -f -- "-case $PWD" || true
    wait "$solver" 2> /dev/null || true
}
killed_and_restarted() { # processes: this case, once
    local times folder=. after
    [ "$1" = 1 ] || folder=processor$(($1 - 1))
    start "$1"
    # In the middle of the step after one of those that the whole run wrote
    times=($(sed -n 's/^Time = //p' "$whole/log"))
    after=${times[$((RANDOM % (${#times[@]} - 2)))]}
    while [ ! -e "$folder/$after/uniform/time" ] && kill -0 "$solver" 2> /dev/null; do sleep 0.002; done
    sleep "$(awk -v r=$RANDOM 'BEGIN { print 0.03*r/32767 }')"
    kill_all
    goes_on "$1"
}
goes_on() { # processes: this case, to the bytes of the whole run
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
same_bytes() { # what: the case here on one process and on three
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
