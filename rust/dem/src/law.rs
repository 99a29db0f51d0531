//! The contact law as pure functions (paper, Table 1).
//!
//! n points from i to j, t = (−n_y, n_x). The force on j is f_n n + f_t t, on i its negative; f_n ≥ 0 repels.

/// s_n = 2 E r₁ r₂ / (r₁ + r₂) [N/m], current radii. Not multiplied by the 1 m depth (authors' code).
#[inline(always)]
pub fn pair_stiffness(young_modulus: f64, r1: f64, r2: f64) -> f64 {
    2.0 * young_modulus * r1 * r2 / (r1 + r2)
}

/// s_n of a disc on a flat wall [N/m]: `factor` · E r.
#[inline(always)]
pub fn wall_stiffness(young_modulus: f64, factor: f64, radius: f64) -> f64 {
    factor * young_modulus * radius
}

/// f_t after the slip `slip` [m] of j relative to i along t: elastic step, then Coulomb's limit.
/// The clipped value is what is stored, so a sliding contact keeps no memory of the excess.
#[inline(always)]
pub fn tangential_force(previous: f64, stiffness: f64, slip: f64, limit: f64) -> f64 {
    // max/min, not clamp: clamp panics on NaN limits, and these compile to two instructions.
    (previous - stiffness * slip).max(-limit).min(limit)
}

/// f_d = −μ |f_c| v/|v| [N] for one disc, f_c the resultant of its contact forces. Zero at rest.
#[inline(always)]
pub fn damping_force(damping: f64, force: [f64; 2], velocity: [f64; 2]) -> [f64; 2] {
    let speed2 = velocity[0] * velocity[0] + velocity[1] * velocity[1];
    let force2 = force[0] * force[0] + force[1] * force[1];
    let scale = if speed2 > 0.0 { damping * (force2 / speed2).sqrt() } else { 0.0 };
    [-scale * velocity[0], -scale * velocity[1]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stiffness_of_equal_discs_is_e_r() {
        assert_eq!(pair_stiffness(1e7, 5e-3, 5e-3), 5e4);
        assert_eq!(wall_stiffness(1e7, 2.0, 5e-3), 1e5);
    }

    #[test]
    fn friction_is_elastic_then_clipped() {
        assert_eq!(tangential_force(0.0, 10.0, 0.1, 2.0), -1.0);
        assert_eq!(tangential_force(0.0, 10.0, -1.0, 2.0), 2.0);
        assert_eq!(tangential_force(2.0, 10.0, 0.1, 2.0), 1.0);
    }

    #[test]
    fn damping_opposes_motion_and_vanishes_at_rest() {
        let f = damping_force(0.1, [3.0, 4.0], [0.0, -2.0]);
        assert_eq!(f, [-0.0, 0.5]);
        assert_eq!(damping_force(0.1, [3.0, 4.0], [0.0, 0.0]), [0.0, 0.0]);
    }
}
