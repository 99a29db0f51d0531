//! Noise floor: the scatter of an output between packings of equal state, which is the least error of any function of
//! that state.

/// Number of nearest neighbours in the Gamma test.
const NEIGHBOURS: usize = 8;

/// Group (packing), inputs x and output y.
pub type Sample = (i64, Vec<f64>, f64);

/// Standard deviation of the part of y that is not a smooth function of x: the Gamma test (Stefánsson, Končar and Jones
/// 1997). Half the mean squared difference of y between k-th nearest neighbours is fitted linearly in their mean
/// squared distance in x; the intercept is the variance of the noise. Neighbours are taken from other groups, since
/// states of one packing share its noise. `None` with too few samples.
pub fn deviation(samples: &[Sample]) -> Option<f64> {
    let mut gamma = [0.0; NEIGHBOURS];
    let mut delta = [0.0; NEIGHBOURS];
    if samples.len() < 5 * NEIGHBOURS {
        return None;
    }
    for (group, x, y) in samples {
        let others = samples.iter().filter(|(other, ..)| other != group);
        let mut nearest: Vec<(f64, f64)> = others
            .map(|(_, x2, y2)| {
                let square = x.iter().zip(x2).map(|(a, b)| (a - b) * (a - b)).fold(0.0, |s, t| s + t);
                (square, 0.5 * (y - y2) * (y - y2))
            })
            .collect();
        if nearest.len() < NEIGHBOURS {
            return None;
        }
        nearest.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (k, (square, half)) in nearest[..NEIGHBOURS].iter().enumerate() {
            delta[k] += square / samples.len() as f64;
            gamma[k] += half / samples.len() as f64;
        }
    }
    let mean = |values: &[f64]| values.iter().fold(0.0, |s, t| s + t) / NEIGHBOURS as f64;
    let (mean_delta, mean_gamma) = (mean(&delta), mean(&gamma));
    let covariance = delta.iter().zip(&gamma).map(|(d, g)| (d - mean_delta) * (g - mean_gamma)).sum::<f64>();
    let variance = delta.iter().map(|d| (d - mean_delta).powi(2)).sum::<f64>();
    let slope = if variance > 0.0 { (covariance / variance).max(0.0) } else { 0.0 };
    Some((mean_gamma - slope * mean_delta).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    #[test]
    fn finds_the_noise_beneath_a_curve() {
        let mut random = ChaCha8Rng::seed_from_u64(4);
        let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        for noise in [0.0, 0.1] {
            let samples: Vec<_> = (0..800)
                .map(|i| {
                    let x = vec![2.0 * unit() - 1.0, 2.0 * unit() - 1.0];
                    // Sum of three: variance 3/12, so four times that is one.
                    let normal = 2.0 * (unit() + unit() + unit() - 1.5);
                    let y = x[0] * x[0] + (2.0 * x[1]).sin() + noise * normal;
                    (i, x, y)
                })
                .collect();
            let found = deviation(&samples).expect("enough");
            assert!((found - noise).abs() < 0.03, "{found} against {noise}");
        }
        assert_eq!(deviation(&[(0, vec![0.0], 1.0)]), None);
    }
}
