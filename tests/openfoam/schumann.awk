# Schumann's bed (J. Franklin Inst. 208, 405, 1929) after a step of the inlet from 0 to 1: temperatures of gas and grains at the middles
# of n cells along xi transfer units, after tau of them: J(x, tau) and 1 - J(tau, x), where J(x, y) is the sum over k of Poisson's
# probability of k events for the mean y times that of at most k events for the mean x (Marcum's Q). All terms are positive.
function probabilities(mean, p,    k, lead) { # of 0 .. most events, from the most likely one outwards: no underflow
    lead = int(mean)
    for (k = 0; k <= most; k++) p[k] = 0
    p[lead] = 1
    for (k = lead; k < most; k++) p[k + 1] = p[k]*mean/(k + 1)
    for (k = lead; k > 0; k--) p[k - 1] = p[k]*k/mean
    total = 0
    for (k = 0; k <= most; k++) total += p[k]
    for (k = 0; k <= most; k++) p[k] /= total
}
BEGIN {
    most = int((xi > tau ? xi : tau) + 12*sqrt((xi > tau ? xi : tau) + 30))
    probabilities(tau, q)
    for (i = 0; i < n; i++) {
        probabilities((i + 0.5)*xi/n, p)
        gas = grains = belowX = belowY = 0
        for (k = 0; k <= most; k++) {
            belowX += p[k]; gas += q[k]*belowX
            belowY += q[k]; grains += p[k]*belowY
        }
        printf "%.15g %.15g\n", gas, 1 - grains
    }
}
