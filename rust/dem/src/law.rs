//! The contact law as pure functions of parameters and contact state (paper, Table 1).
//!
//! n points from i to j, t = (−n_y, n_x). The force on j is f_n n + f_t t, on i its negative; f_n ≥ 0 repels.
//!
//! The functions that the hot loops call are written once for any number of lanes (`Vector`).

use crate::disc::Columns;
use crate::material::Material;
use msdd_engine::vector::Vector;

/// s_n = 2 E r₁ r₂ / (r₁ + r₂) [N/m], current radii. Not multiplied by the 1 m depth (authors' code).
pub fn pair_stiffness(young_modulus: f64, r1: f64, r2: f64) -> f64 {
    2.0 * young_modulus * (r1 * r2) / (r1 + r2)
}

/// s_n of a disc on a flat wall [N/m]: `factor` · E r.
pub fn wall_stiffness(young_modulus: f64, factor: f64, radius: f64) -> f64 {
    factor * young_modulus * radius
}

/// Material parameters in the form that the contact loops use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairLaw {
    pub young_modulus: f64,
    /// ν [-].
    pub stiffness_ratio: f64,
    /// tan φ [-].
    pub friction: f64,
    pub wall_factor: f64,
    /// Δt [s].
    pub dt: f64,
    /// ∂u_x/∂x, ∂u_y/∂y, ∂u_x/∂y [1/s] of the affine motion that carries the grains along, see [`crate::walls::Flow`].
    pub gradient: [f64; 3],
    /// k [W/(m K)] of the grains when heat is on, else none.
    pub conductivity: Option<f64>,
}

impl PairLaw {
    pub fn new(material: &Material, dt: f64, gradient: [f64; 3], conductivity: Option<f64>) -> Self {
        Self {
            young_modulus: material.young_modulus,
            stiffness_ratio: material.stiffness_ratio,
            friction: libm::tan(material.friction_angle),
            wall_factor: material.wall_stiffness_factor,
            dt,
            gradient,
            conductivity,
        }
    }
}

/// Forces of a group of pairs, one pair per lane; zero in lanes whose discs do not touch.
pub(crate) struct PairForce<V> {
    /// (fx, fy) on j [N].
    pub on_j: [V; 2],
    /// To be subtracted from the torque on i, and added to that on j [N m].
    pub torque: [V; 2],
    /// The stored f_t [N].
    pub tangential: V,
    /// A/|d| [-], A the chord of the two circles on 1 m depth: conductance over k. 0 in lanes that do not touch.
    pub conductance: V,
}

/// f_t after the slip `slip` [m] of j relative to i along t: an elastic step, limited to Coulomb's friction. The
/// limited value is stored, so a contact that has slid does not remember the excess.
#[inline(always)]
pub(crate) fn tangential_force<V: Vector>(previous: V, stiffness: V, slip: V, limit: V) -> V {
    let elastic = previous - stiffness * slip;
    elastic.max(limit.like(0.0) - limit).min(limit)
}

/// Forces of a group of pairs, and with `HEAT` their conductances; None when no pair of the group touches.
#[inline(always)]
pub(crate) fn pair_force<V: Vector, const HEAT: bool>(
    law: &PairLaw,
    a: &Columns<V>,
    b: &Columns<V>,
    previous: V,
) -> Option<PairForce<V>> {
    let [ax, ay, ar, avx, avy, aw, ..] = *a;
    let [bx, by, br, bvx, bvy, bw, ..] = *b;
    let (dx, dy) = (bx - ax, by - ay);
    let reach = ar + br;
    let distance2 = dx * dx + dy * dy;
    let touching = (reach * reach).greater(distance2);
    if !V::any(touching) {
        return None;
    }
    let all = |value: f64| ax.like(value);
    let distance = distance2.sqrt();
    // One division for both 1/distance and 1/reach.
    let quotient = all(1.0) / (distance * reach);
    let inverse = quotient * reach;
    let (nx, ny) = (dx * inverse, dy * inverse);
    let overlap = V::select(touching, reach - distance, all(0.0));
    // Lever arms end at the middle of the overlap: r − δ/2.
    let half = all(0.5) * overlap;
    let (arm_a, arm_b) = (ar - half, br - half);
    // Velocity of j relative to i at the contact, along t.
    let [xx, yy, xy] = law.gradient;
    let (vx, vy) = (bvx - avx + all(xx) * dx + all(xy) * dy, bvy - avy + all(yy) * dy);
    let speed = vy * nx - vx * ny - (arm_a * aw + arm_b * bw);
    let stiffness = all(2.0 * law.young_modulus) * (ar * br) * (quotient * distance);
    let normal = stiffness * overlap;
    // In a lane whose discs do not touch the limit is 0, which also clears its friction history.
    let tangential = tangential_force(
        previous,
        all(law.stiffness_ratio) * stiffness,
        speed * all(law.dt),
        all(law.friction) * normal,
    );
    let conductance = if HEAT {
        // Distance of the common chord from the first centre.
        let to_chord = all(0.5) * inverse * (distance2 + ar * ar - br * br);
        let half_chord2 = (ar * ar - to_chord * to_chord).max(all(0.0));
        V::select(touching, all(2.0) * half_chord2.sqrt() * inverse, all(0.0))
    } else {
        all(0.0)
    };
    Some(PairForce {
        conductance,
        on_j: [normal * nx - tangential * ny, normal * ny + tangential * nx],
        torque: [arm_a * tangential, all(0.0) - arm_b * tangential],
        tangential,
    })
}

/// Square of the speed [m²/s²] below which a disc counts as at rest. Drag slows free discs down without end, and the
/// factor μ |f_c|/|v| would be infinite when |v|² underflows to 0.
const REST: f64 = 1e-200;

/// |f_d|/|v| of the damping force f_d = −μ |f_c| v/|v| [kg/s], from the squares of force and speed. Zero at rest.
#[inline(always)]
pub(crate) fn damping_scale<V: Vector>(damping: V, force2: V, speed2: V) -> V {
    let moving = speed2.greater(speed2.like(REST));
    let ratio = force2 / V::select(moving, speed2, speed2.like(1.0));
    V::select(moving, damping * ratio.sqrt(), speed2.like(0.0))
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
    fn damping_is_mu_force_over_speed_and_vanishes_at_rest() {
        assert_eq!(damping_scale(0.1, 25.0, 4.0), 0.25);
        assert_eq!(damping_scale(0.1, 25.0, 0.0), 0.0);
        assert_eq!(damping_scale(0.1, 25.0, 1e-310), 0.0);
        assert!((damping_scale(0.1, 25.0, 1e-198) * 1e-99 - 0.5).abs() < 1e-12);
    }
}
