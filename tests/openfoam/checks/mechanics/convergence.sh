# Order of convergence in the size of the cells, for a manufactured displacement. Sourced by mechanics.sh: needs strained,
# equilibrium.

# The displacement is u = A sin(pi x/L) sin(pi y/H), v = A/2 sin(2 pi x/L) sin(pi y/H), zero at the walls. Its body force is given
# by the field initialStress, the model's stress for the strain and turn of u: the solver keeps the imbalance of that field.
manufactured() { # cells along x: prints the rms errors of u and v, relative to their amplitudes
    local nx=$1 ny=$(($1/2))
    changed "manufactured-$nx"
    uniform_temperature
    fabric_is 0.01
    equilibrium 'residual 1e-8; walls { ".*" { type displacement; displacement constant (0 0 0); } }'
    mesh_is "$nx $ny 1"
    {
        sed -n '1,/^}/p' 0/porosity | sed 's/porosity/initialStress/; s/volScalarField/volSymmTensorField/'
        echo "dimensions [1 -1 -2 0 0 0 0]; internalField nonuniform List<symmTensor> $((nx*ny)) ("
        awk -v nx=$nx -v ny=$ny 'BEGIN { pi = atan2(0, -1); L = 2.15; H = 0.645; A = 1e-5
            for (j = 0; j < ny; j++) for (i = 0; i < nx; i++) { x = pi*(i + 0.5)/nx; y = pi*(j + 0.5)/ny
                ux = A*pi/L*cos(x)*sin(y); uy = A*pi/H*sin(x)*cos(y); vx = A*pi/L*cos(2*x)*sin(y); vy = A/2*pi/H*sin(2*x)*cos(y)
                printf "0 %.17g %.17g %.17g %.17g\n", ux, vy, uy + vx, (vx - uy)/2 } }' \
            | strained gentle | awk '{ printf "(%.17g %.17g 0 %.17g 0 0)\n", -$1, -$3, -$2 }'
        echo '); boundaryField { #includeEtc "caseDicts/setConstraintTypes"
".*" { type zeroGradient; } }'
    } > 0/initialStress
    logged foamDictionary -entry endTime -set 0.05 system/controlDict
    logged msddFoam
    field 0.05/nodeDisplacement | awk -v nx=$nx -v ny=$ny 'NR <= (nx + 1)*(ny + 1) { pi = atan2(0, -1); i = (NR - 1) % (nx + 1); j = int((NR - 1)/(nx + 1))
        x = pi*i/nx; y = pi*j/ny; u += ($1*1e5 - sin(x)*sin(y))^2; v += ($2*1e5 - sin(2*x)*sin(y)/2)^2; n++ } END { print sqrt(u/n), sqrt(v/n) }'
}
order_of_displacement() {
    local n u v last_u="" last_v=""
    for n in 16 32 64; do
        read -r u v < <(manufactured $n)
        if [ -n "$last_u" ]; then
            check "manufactured displacement, $n cells: errors $u, $v, orders $(awk "BEGIN { printf \"%.2f, %.2f\", log($last_u/$u)/log(2), log($last_v/$v)/log(2) }") >= 1.9" \
                awk "BEGIN { exit !($u < 0.05 && $u > 0 && $last_u/$u > 2^1.9 && $last_v/$v > 2^1.9) }"
        fi
        last_u=$u last_v=$v
    done
}
order_of_displacement
