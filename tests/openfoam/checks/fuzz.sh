# Reads constant/granularProperties with random damage: it must be accepted or refused with a message, without a crash, a
# floating-point trap or an endless loop. --full tries 10^6 damaged texts.

build_fuzz() { # builds in a folder outside of the sources
    rm -rf "$work/fuzz-build"
    cp -r "$here/fuzz" "$work/fuzz-build"
    (
        export MSDD_CHECKOUT=$checkout MSDD_APPBIN=$work/fuzz-build/bin MSDD_LIBBIN=$FOAM_USER_LIBBIN
        . "$checkout/scripts/foam-env" build
        wmake -s "$work/fuzz-build" > "$work/fuzz-build/log" 2>&1
    ) || { tail -n 15 "$work/fuzz-build/log" >&2; return 1; }
}
damaged_properties() {
    local rounds=2000
    [ $full = no ] || rounds=1000000
    changed fuzz
    mesh_is '6 3 1'
    sed '/FoamFile/,/^}/d' "$checkout/cases/common/granularProperties" | grep -v '^ *//' > common
    { sed -n '1,/^}/p' constant/granularProperties; cat common
        echo 'mechanics equilibrium; equilibriumCoeffs { residual 1e-3; walls { right { type pressure; pressure constant 2500; } } }'; } > properties
    mv properties constant/granularProperties
    local said status=0
    said=$(timeout 5400 "$work/fuzz-build/bin/fuzzProperties" -rounds $rounds 2>> log | tail -n 1; exit "${PIPESTATUS[0]}") || status=$?
    check "granularProperties in damaged forms: $said" test $status = 0
}
mkdir -p "$work"
check "the program that damages granularProperties builds" build_fuzz
damaged_properties
