# Any number of processes must give the result of one: 2, 3 and 4 in a row, 2 x 2 and 2 x 3, with every feature. With three in a
# row the middle process has two neighbours and the others one, so that an exchange inside a loop over patches would hang.

same_answer() { # name of the check, bound: compares every decomposition of this case with this case on one process
    local what=$1 bound=$2 name=${PWD##*/} parts e
    logged msddFoam
    for parts in "${decompositions[@]}"; do
        rm -rf "$work/parts"
        cp -r . "$work/parts"
        cd "$work/parts"
        rm -rf 1 0.5 postProcessing
        in_parts "$parts"
        side_by_side $((${parts% *}*${parts#* }))
        logged reconstructPar -latestTime
        e=$(difference "$work/$name/1" 1)
        check "$what on ${parts/ / x } processes: difference $e <= $bound" below "$e" "$bound"
        cd "$work/$name"
    done
}
several() { # folder: the case small, which writes the time 0.5, too
    changed "$1"
    controls 'writeInterval 10;'
}
sheared_vertices() {
    sed -i 's,^blocks.*,vertices ((0 0 0) (2150 0 0) (2350 645 0) (200 645 0) (0 0 10) (2150 0 10) (2350 645 10) (200 645 10));\n&,' system/blockMeshDict
}
every_function_object() { controls "functions { #include \"$here/audits\" }"; }
function_objects_agree() { # compares the last lines of their files on six processes and on one
    local file e
    for file in postProcessing/*/0/*.dat; do
        e=$(lines_differ "$file" "$work/parts/$file")
        check "$file on six processes: difference $e <= 1e-9" below "$e" 1e-9
    done
}

if [ $full = yes ]; then
    decompositions=('2 1' '3 1' '4 1' '2 2' '1 3' '2 3')
else
    decompositions=('3 1' '2 2' '2 3')
fi

several rows-paper
every_function_object
mesh_is '12 6 1'
same_answer "paper's scheme" 1e-10
function_objects_agree

several rows-adaptive
controls 'adjustTimeStep yes; deltaT 1e-3; writeControl runTime; writeInterval 0.5;'
scheme 'timeScheme secondOrder; temperatureTolerance 0.5;'
mesh_is '12 6 1'
same_answer "second order, adaptive" 1e-10

several rows-equilibrium
grains 'mechanics equilibrium; equilibriumCoeffs { residual 1e-5; }'
mesh_is '12 6 1'
same_answer "equilibrium" 1e-7

several rows-equilibrium-adaptive
controls 'adjustTimeStep yes; deltaT 1e-3; writeControl runTime; writeInterval 0.5;'
scheme 'timeScheme secondOrder; temperatureTolerance 0.5;'
grains 'mechanics equilibrium; equilibriumCoeffs { residual 1e-4; maxIterations 300; walls { right { type pressure; pressure constant 2500; } } }'
mesh_is '12 6 1'
same_answer "equilibrium, adaptive, a wall that is pressed" 1e-6

several rows-slanted
sheared_vertices
mesh_is '12 6 1'
same_answer "slanted cells" 1e-10

several rows-slanted-adaptive
sheared_vertices
controls 'adjustTimeStep yes; deltaT 1e-3; writeControl runTime; writeInterval 0.5;'
scheme 'timeScheme secondOrder; temperatureTolerance 0.5; nNonOrthogonalCorrectors 1;'
mesh_is '12 6 1'
same_answer "slanted cells, second order, adaptive" 1e-10

for per in cell history; do
    several rows-online-$per
    grains "surrogate { type onlineRve; onlineRveCoeffs { discs 60; rvePer $per; } smallestStrain 0; }"
    mesh_is '6 4 1'
    same_answer "online RVEs per $per" 1e-10
done

stopped_process() { # one of three processes is stopped for a while: the others must print that they wait, and then continue
    local waiting
    several rows-stopped
    controls 'deltaT 0.001;'
    scheme 'waitLimit 0.5;'
    mesh_is '12 6 1'
    in_parts '3 1'
    timeout 600 mpirun --oversubscribe -np 3 msddFoam -case "$PWD" -parallel > log.stopped 2>&1 &
    waiting=$!
    while ! grep -q '^Time = ' log.stopped && kill -0 $waiting 2> /dev/null; do sleep 0.05; done
    set -- $(pgrep -f -- "^msddFoam -case $PWD -parallel")
    kill -STOP "$3"
    for _ in $(seq 200); do
        [ "$(grep -c 'has not finished a step for' log.stopped)" -lt 2 ] || break
        sleep 0.05
    done
    kill -CONT "$3"
    check "a process is stopped: the other two say that they wait" test "$(grep -c 'of 3 has not finished a step for' log.stopped)" -ge 2
    check "a process is stopped for a while: the run goes on to its end" wait $waiting
}
stopped_process
