# Prints the largest error of T in the slab, relative to the 50 K step at its wall; arguments: files of T, conductivity (xx,
# one line), bulkDensity (one line), each printed by fields.awk, and -v heat_capacity, length, time.
#
# Slab of length L at 50 K, x = 0 held at 100 K, x = L insulated:
#   (T - 50)/50 = 1 - sum_n 4/((2n+1) pi) sin(m_n x) exp(-m_n^2 K t/(rho_b c)),  m_n = (2n+1) pi/(2 L)
FILENAME == ARGV[1] { T[++cells] = $1; next }
FILENAME == ARGV[2] { conductivity = $1; lines++; next }
{ density = $1; lines++ }
END {
    if (lines != 2 || cells < 2 || conductivity <= 0 || density <= 0) { print "nan"; exit 1 }
    pi = atan2(0, -1)
    for (i = 1; i <= cells; i++) {
        x = (i - 0.5)*length_x/cells
        theta = 1
        for (n = 0; n < 50; n++) {
            m = (2*n + 1)*pi/(2*length_x)
            theta -= 4/((2*n + 1)*pi)*sin(m*x)*exp(-m*m*conductivity*time/(density*heat_capacity))
        }
        error = (T[i] - 50)/50 - theta
        if (error < 0) error = -error
        if (!(error <= worst)) worst = error
    }
    printf "%.3e\n", worst
}
