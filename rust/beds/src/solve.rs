//! Sparse linear equations that are symmetric and positive.

/// Iterations after which a solution is given up.
const MAX_ITERATIONS: usize = 10_000;

pub fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Adds to `y` what flows out of each node that is free, by links of two nodes and a conductance, which `factor` multiplies, at the
/// values `x` of the nodes.
pub fn add_flows(
    links: &[(usize, usize, f64)],
    factor: f64,
    free: impl Fn(usize) -> bool,
    x: &[f64],
    y: &mut [f64],
) {
    for &(i, j, g) in links {
        let flow = factor * g * (x[i] - x[j]);
        if free(i) {
            y[i] += flow;
        }
        if free(j) {
            y[j] -= flow;
        }
    }
}

/// Conjugate gradients with the diagonal as the preconditioner: x of A x = r, from x = 0. `apply` adds A d to its second
/// argument, which comes as 0. `residual` is r, and on return what is left of it. None when the iteration does not end:
/// numbers that are not finite, or of too unequal size.
pub fn conjugate_gradients(
    apply: impl Fn(&[f64], &mut [f64]),
    diagonal: &[f64],
    residual: &mut [f64],
    enough: impl Fn(&[f64]) -> bool,
) -> Option<Vec<f64>> {
    let precondition =
        |residual: &[f64]| residual.iter().zip(diagonal).map(|(r, d)| r / d).collect::<Vec<f64>>();
    let mut solution = vec![0.0; diagonal.len()];
    let mut direction = precondition(residual);
    let mut product = inner(residual, &direction);
    let mut flow = vec![0.0; diagonal.len()];
    for _ in 0..MAX_ITERATIONS {
        if enough(residual) {
            return Some(solution);
        }
        flow.fill(0.0);
        apply(&direction, &mut flow);
        let step = product / inner(&direction, &flow);
        for k in 0..solution.len() {
            solution[k] += step * direction[k];
            residual[k] -= step * flow[k];
        }
        let next = precondition(residual);
        let new_product = inner(residual, &next);
        for (d, n) in direction.iter_mut().zip(next) {
            *d = n + new_product / product * *d;
        }
        product = new_product;
        if !product.is_finite() {
            return None;
        }
    }
    None
}
