//! Steady temperatures of spheres that conduct, and the line through values; shared by examples.

/// T \[K\] of spheres that each receive `heat` \[W\], with links (i, j, G \[W/K\]) and plates of 0 K (i, plate, G); conjugate
/// gradients. Spheres that nothing touches have no temperature, NaN.
pub fn steady(mut heat: Vec<f64>, links: &[(usize, usize, f64)], plates: &[(usize, usize, f64)]) -> Vec<f64> {
    let count = heat.len();
    let mut diagonal = vec![1e-12; count];
    for &(i, j, g) in links {
        diagonal[i] += g;
        diagonal[j] += g;
    }
    for &(k, _, g) in plates {
        diagonal[k] += g;
    }
    heat.iter_mut().zip(&diagonal).filter(|(_, d)| **d <= 1e-11).for_each(|(heat, _)| *heat = 0.0);
    let mut rest = heat;
    let inner = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let scaled = |r: &[f64]| r.iter().zip(&diagonal).map(|(r, d)| r / d).collect::<Vec<f64>>();
    let mut t = vec![0.0; count];
    let mut direction = scaled(&rest);
    let mut product = inner(&rest, &direction);
    let first = product;
    for _ in 0..20 * count {
        if product <= 1e-22 * first {
            break;
        }
        let mut flow: Vec<f64> = direction.iter().zip(&diagonal).map(|(x, d)| x * d).collect();
        for &(i, j, g) in links {
            flow[i] -= g * direction[j];
            flow[j] -= g * direction[i];
        }
        let step = product / inner(&direction, &flow);
        for k in 0..count {
            t[k] += step * direction[k];
            rest[k] -= step * flow[k];
        }
        let next = scaled(&rest);
        let new_product = inner(&rest, &next);
        direction.iter_mut().zip(next).for_each(|(d, n)| *d = n + new_product / product * *d);
        product = new_product;
    }
    (0..count).map(|k| if diagonal[k] > 1e-11 { t[k] } else { f64::NAN }).collect()
}

/// Value at 0 and slope of the straight line through points.
pub fn line(points: &[[f64; 2]]) -> (f64, f64) {
    let n = points.len() as f64;
    let [x, y] = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let product: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    let square: f64 = points.iter().map(|p| (p[0] - x) * (p[0] - x)).sum();
    let slope = product / square;
    (y - slope * x, slope)
}
