//! Contact laws as pure functions of parameters and contact state.
//!
//! n points from i to j; the force on j is f_n n + f_t, on i its negative; f_n > 0 repels. δ is the overlap, R* =
//! r₁r₂/(r₁+r₂) and m* = m₁m₂/(m₁+m₂) are the effective radius and mass, v_n and v_t the velocities of j relative to i
//! at the contact, along n and across.
//!
//! | | Hertz–Mindlin | linear |
//! |---|---|---|
//! | size a | √(R* δ) \[m\], the radius of the contact | 1 |
//! | elastic normal force | 4/3 E* a δ | k_n δ |
//! | tangential stiffness k_t | 8 G* a | k_t |
//! | damping | f_n −= 2 √(5/6) β √(2 E* a m*) v_n; f_t −= 2 √(5/6) β √(k_t m*) v_t | f_n −= 2 β √(k_n m*) v_n; f_t −= 2 β √(k_t m*) v_t |
//!
//! E* = E/(2 (1 − ν²)) and G* = G/(2 (2 − ν)) with G = E/(2 (1 + ν)) belong to two grains of the same material (Johnson,
//! Contact Mechanics, 1985, ch. 4 and 7; Mindlin, J. Appl. Mech. 16, 259, 1949). β = −ln e/√(π² + ln² e) gives the
//! restitution e: exactly, for Hertz's law too, at any speed (Tsuji et al., Powder Technol. 71, 239, 1992; Antypov &
//! Elliott, EPL 94, 50004, 2011). The damped normal force may attract at the end of a contact; with it cut off, the
//! restitution would be another.
//!
//! f_t is the friction history: it turns with the contact and grows by −k_t v_t Δt. When the contact gets smaller, f_t is
//! scaled down with a; without that, its energy ½ f_t²/k_t would grow (Thornton, Cummins & Cleary, Powder Technol. 233, 30,
//! 2013). With the damping, |f_t| is at most μ f_n. A contact that slides remembers what is left of that after the damping
//! has been taken out, as in LAMMPS; it does not remember the excess.
//!
//! The functions that the hot loops call are written once for any number of lanes ([`Vector`]).

use crate::material::{Material, Stiffness};
use crate::space::{Matrix, cross, dot, minus, plus, scaled};
use crate::sphere::Columns;
use msdd_engine::vector::Vector;
use std::f64::consts::PI;

/// What a contact remembers: f_t on j \[N\], and a (see the table above); 0 when the contact is open.
pub type History<V = f64> = [V; 4];

/// Parameters in the form that the contact loops use.
#[derive(Clone, Copy, Debug)]
pub struct ContactLaw {
    /// Whether a = √(R* δ); else a = 1.
    pub hertz: bool,
    /// Elastic normal force over a δ.
    pub normal: f64,
    /// k_t over a.
    pub tangential: f64,
    /// Damping force over √(a m*) and velocity, along the normal and across.
    pub damping: [f64; 2],
    /// μ [-] of two grains, and of a grain and a wall.
    pub friction: [f64; 2],
    /// Δt \[s\].
    pub dt: f64,
    /// L [1/s], 0 below the diagonal, of the flow that carries the grains along.
    pub gradient: Matrix,
}

/// β = −ln e/√(π² + ln² e).
pub fn damping_ratio(restitution: f64) -> f64 {
    let log = libm::log(restitution);
    -log / (PI * PI + log * log).sqrt()
}

/// E* \[Pa\] of two grains of the same material.
pub fn effective_modulus(young_modulus: f64, poisson_ratio: f64) -> f64 {
    young_modulus / (2.0 * (1.0 - poisson_ratio * poisson_ratio))
}

/// G* \[Pa\] of two grains of the same material.
pub fn effective_shear_modulus(young_modulus: f64, poisson_ratio: f64) -> f64 {
    young_modulus / (4.0 * (1.0 + poisson_ratio) * (2.0 - poisson_ratio))
}

impl ContactLaw {
    pub fn new(material: &Material, dt: f64, gradient: Matrix) -> Self {
        let beta = damping_ratio(material.restitution);
        let (hertz, normal, tangential, damping) = match material.stiffness {
            Stiffness::HertzMindlin { young_modulus, poisson_ratio } => {
                let modulus = effective_modulus(young_modulus, poisson_ratio);
                let tangential = 8.0 * effective_shear_modulus(young_modulus, poisson_ratio);
                let factor = 2.0 * (5.0f64 / 6.0).sqrt() * beta;
                (
                    true,
                    4.0 / 3.0 * modulus,
                    tangential,
                    [2.0 * modulus, tangential].map(|k| factor * k.sqrt()),
                )
            }
            Stiffness::Linear { normal, tangential } => {
                (false, normal, tangential, [normal, tangential].map(|k| 2.0 * beta * k.sqrt()))
            }
        };
        let friction = [material.friction, material.wall_friction];
        Self { hertz, normal, tangential, damping, friction, dt, gradient }
    }

    /// Whether contacts are damped.
    pub fn damped(&self) -> bool {
        self.damping != [0.0; 2]
    }

    /// a of a contact; 0 without overlap.
    pub fn size(&self, overlap: f64, effective_radius: f64) -> f64 {
        match overlap > 0.0 {
            false => 0.0,
            true if self.hertz => (effective_radius * overlap).sqrt(),
            true => 1.0,
        }
    }

    /// Elastic energy of a contact \[J\]: normal ∫ f_n dδ, and tangential ½ f_t²/k_t.
    pub fn energy(&self, overlap: f64, effective_radius: f64, tangential: [f64; 3]) -> [f64; 2] {
        let a = self.size(overlap, effective_radius);
        let overlap = overlap.max(0.0);
        let exponent = if self.hertz { 2.5 } else { 2.0 };
        [self.normal * a * overlap * overlap / exponent, self.friction_energy(tangential, a)]
    }

    /// ½ f_t²/k_t \[J\] in a contact of size a.
    pub fn friction_energy(&self, tangential: [f64; 3], a: f64) -> f64 {
        let square = dot(tangential, tangential);
        if square == 0.0 { 0.0 } else { 0.5 * square / (self.tangential * a) }
    }
}

impl ContactLaw {
    /// Forces f_n and f_t \[N\] and the new history of one contact, see [`force`].
    pub fn force(&self, touch: &Touch<f64>, history: History) -> (f64, [f64; 3], History) {
        match (self.hertz, self.damped()) {
            (true, true) => force::<f64, true, true>(self, touch, history),
            (true, false) => force::<f64, true, false>(self, touch, history),
            (false, true) => force::<f64, false, true>(self, touch, history),
            (false, false) => force::<f64, false, false>(self, touch, history),
        }
    }
}

/// Geometry and motion of a group of contacts, one a lane.
#[derive(Clone, Copy)]
pub struct Touch<V> {
    pub normal: [V; 3],
    /// δ \[m\]; 0 in lanes that do not touch.
    pub overlap: V,
    /// Velocity of j relative to i \[m/s\], and that of the surfaces by rotation: (r ω)_i + (r ω)_j with the lever arms.
    pub velocity: [V; 3],
    pub spin: [V; 3],
    /// R* \[m\] and m* \[kg\].
    pub radius: V,
    pub mass: V,
    /// μ.
    pub friction: f64,
}

/// Numbers below which a divisor is replaced by this; they belong to quotients that are then multiplied by 0.
const TINY: f64 = 1e-100;

/// The f_t that a contact remembers, turned into the contact plane of normal `n` and scaled to the size `a`.
///
/// Its part along n is taken out, and its length restored to second order (exactly, the factor would be 1/√(1 − x)
/// instead of 1 + x/2; this way no energy is made).
#[inline(always)]
pub fn kept<V: Vector>(n: [V; 3], a: V, [hx, hy, hz, previous]: History<V>) -> [V; 3] {
    let all = |value: f64| a.like(value);
    let old = [hx, hy, hz];
    let (out, square) = (dot(old, n), dot(old, old));
    let bounded = [square.max(all(TINY)), previous.max(all(TINY))];
    // One division for turning and scaling.
    let quotient = all(1.0) / (bounded[0] * bounded[1]);
    let turned = all(1.0) + all(0.5) * out * out * (quotient * bounded[1]);
    let shrunk = (a * (quotient * bounded[0])).min(all(1.0));
    scaled(turned * shrunk, plus(old, all(0.0) - out, n))
}

/// Normal force f_n, tangential force f_t on j, and the new history, of a group of contacts. All are 0 in lanes that do
/// not touch.
#[inline(always)]
pub fn force<V: Vector, const HERTZ: bool, const DAMPED: bool>(
    law: &ContactLaw,
    touch: &Touch<V>,
    history: History<V>,
) -> (V, [V; 3], History<V>) {
    let all = |value: f64| touch.overlap.like(value);
    let (n, zero, one) = (touch.normal, all(0.0), all(1.0));
    let a = if HERTZ {
        (touch.radius * touch.overlap).sqrt()
    } else {
        V::select(touch.overlap.greater(zero), one, zero)
    };
    let apart = dot(touch.velocity, n);
    let along = minus(plus(touch.velocity, zero - apart, n), cross(touch.spin, n));
    let mut normal = all(law.normal) * a * touch.overlap;
    let root = if DAMPED { (a * touch.mass).sqrt() } else { zero };
    if DAMPED {
        normal = normal - all(law.damping[0]) * root * apart;
    }
    if touch.friction == 0.0 {
        return (normal, [zero; 3], [zero, zero, zero, a]);
    }
    let spring = plus(kept(n, a, history), zero - all(law.tangential * law.dt) * a, along);
    let damping = if DAMPED { scaled(zero - all(law.damping[1]) * root, along) } else { [zero; 3] };
    let trial = plus(spring, one, damping);
    let limit = (all(touch.friction) * normal).max(zero);
    let trial2 = dot(trial, trial);
    let slides = trial2.greater(limit * limit);
    if !V::any(slides) {
        let [x, y, z] = spring;
        return (normal, trial, [x, y, z, a]);
    }
    let scale = V::select(slides, limit / trial2.max(all(TINY)).sqrt(), one);
    let tangential = scaled(scale, trial);
    let ([x, y, z], [sx, sy, sz]) = (minus(tangential, damping), spring);
    let stored = |slid, stuck| V::select(slides, slid, stuck);
    (normal, tangential, [stored(x, sx), stored(y, sy), stored(z, sz), a])
}

/// Forces of a group of pairs.
pub(crate) struct PairForce<V> {
    /// On j \[N\].
    pub on_j: [V; 3],
    /// Torques on i and j \[N m\].
    pub torque: [[V; 3]; 2],
    pub history: History<V>,
}

/// Forces of a group of pairs, one pair per lane.
#[inline(always)]
pub(crate) fn pair_force<V: Vector, const HERTZ: bool, const DAMPED: bool>(
    law: &ContactLaw,
    a: &Columns<V>,
    b: &Columns<V>,
    history: History<V>,
) -> PairForce<V> {
    let [ax, ay, az, ar, avx, avy, avz, am, awx, awy, awz] = *a;
    let [bx, by, bz, br, bvx, bvy, bvz, bm, bwx, bwy, bwz] = *b;
    let branch = minus([bx, by, bz], [ax, ay, az]);
    let [dx, dy, dz] = branch;
    let reach = ar + br;
    let distance2 = dot(branch, branch);
    let touching = (reach * reach).greater(distance2);
    let zero = ax.like(0.0);
    if !V::any(touching) {
        let none = [zero; 3];
        return PairForce { on_j: none, torque: [none, none], history: [zero; 4] };
    }
    let all = |value: f64| ax.like(value);
    let distance = distance2.sqrt();
    // One division serves 1/distance, 1/(r₁ + r₂) and 1/(m₁ + m₂).
    let masses = am + bm;
    let quotient =
        if DAMPED { all(1.0) / (distance * reach * masses) } else { all(1.0) / (distance * reach) };
    let per_length = if DAMPED { quotient * masses } else { quotient };
    let normal = scaled(per_length * reach, branch);
    let overlap = V::select(touching, reach - distance, all(0.0));
    // Lever arms end at the middle of the overlap: r − δ/2.
    let half = all(0.5) * overlap;
    let (arm_a, arm_b) = (ar - half, br - half);
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = law.gradient;
    let carried = [all(xx) * dx + all(xy) * dy + all(xz) * dz, all(yy) * dy + all(yz) * dz, all(zz) * dz];
    let touch = Touch {
        normal,
        overlap,
        velocity: plus(minus([bvx, bvy, bvz], [avx, avy, avz]), all(1.0), carried),
        spin: plus(scaled(arm_a, [awx, awy, awz]), arm_b, [bwx, bwy, bwz]),
        radius: ar * br * (per_length * distance),
        mass: if DAMPED { am * bm * (quotient * distance * reach) } else { am },
        friction: law.friction[0],
    };
    let (along_n, tangential, history) = force::<V, HERTZ, DAMPED>(law, &touch, history);
    let twist = cross(tangential, normal);
    PairForce {
        on_j: plus(tangential, along_n, normal),
        torque: [scaled(arm_a, twist), scaled(arm_b, twist)],
        history,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law() -> ContactLaw {
        let material = Material {
            density: 1.0,
            stiffness: Stiffness::HertzMindlin { young_modulus: 2.0, poisson_ratio: 0.25 },
            friction: 0.5,
            wall_friction: 0.0,
            restitution: 1.0,
        };
        ContactLaw::new(&material, 1.0, [[0.0; 3]; 3])
    }

    /// A contact along `normal` whose surfaces slip by `slip` in the step.
    fn touch(normal: [f64; 3], overlap: f64, slip: [f64; 3]) -> Touch<f64> {
        Touch { normal, overlap, velocity: slip, spin: [0.0; 3], radius: 0.5, mass: 1.0, friction: 0.5 }
    }

    const UP: [f64; 3] = [0.0, 0.0, 1.0];

    #[test]
    fn tangential_force_is_mindlins_spring_until_it_slides() {
        let law = law();
        let (overlap, slip) = (1e-2, [3e-4, -4e-4, 0.0]);
        let size = (0.5 * overlap).sqrt();
        let stiffness = 8.0 * effective_shear_modulus(2.0, 0.25) * size;
        let (normal, tangential, history) =
            force::<f64, true, false>(&law, &touch(UP, overlap, slip), [0.0; 4]);
        assert!((normal - 4.0 / 3.0 * effective_modulus(2.0, 0.25) * size * overlap).abs() < 1e-17);
        for k in 0..3 {
            assert!((tangential[k] + stiffness * slip[k]).abs() < 1e-17);
        }
        assert_eq!(history[3], size);
        // Far enough it slides at μ f_n, against the slip.
        let far = slip.map(|u| 100.0 * u);
        let (_, tangential, history) = force::<f64, true, false>(&law, &touch(UP, overlap, far), history);
        assert!((dot(tangential, tangential).sqrt() - 0.5 * normal).abs() < 1e-15);
        assert!((tangential[0] / tangential[1] + 0.75).abs() < 1e-9);
        assert_eq!(history[..3], tangential);
    }

    #[test]
    fn tangential_force_shrinks_with_the_contact_and_stays_when_it_grows() {
        let law = law();
        let (_, first, history) =
            force::<f64, true, false>(&law, &touch(UP, 1e-2, [1e-4, 0.0, 0.0]), [0.0; 4]);
        let (_, grown, history) = force::<f64, true, false>(&law, &touch(UP, 2e-2, [0.0; 3]), history);
        assert!((grown[0] / first[0] - 1.0).abs() < 1e-14);
        let (_, shrunk, history) = force::<f64, true, false>(&law, &touch(UP, 0.5e-2, [0.0; 3]), history);
        assert!((shrunk[0] / first[0] - 0.5).abs() < 1e-14);
        let (_, gone, history) = force::<f64, true, false>(&law, &touch(UP, 0.0, [0.0; 3]), history);
        assert_eq!((gone, history), ([0.0; 3], [0.0; 4]));
    }

    #[test]
    fn tangential_force_turns_with_the_contact() {
        let law = law();
        let (_, first, mut history) =
            force::<f64, true, false>(&law, &touch(UP, 1e-2, [1e-4, 2e-4, 0.0]), [0.0; 4]);
        for k in 1..=1000 {
            let angle = 1e-3 * f64::from(k);
            let normal = [angle.sin(), 0.0, angle.cos()];
            history = force::<f64, true, false>(&law, &touch(normal, 1e-2, [0.0; 3]), history).2;
        }
        let last = [history[0], history[1], history[2]];
        assert!((dot(last, last) / dot(first, first) - 1.0).abs() < 1e-9);
        // The length is kept exactly, the direction to the first order in the angle of a step.
        assert!((last[1] / first[1] - 1.0).abs() < 2e-4, "{first:?} {last:?}");
        assert!(
            (last[0] / first[0] - 1.0f64.cos()).abs() < 1e-3
                && (last[2] / -first[0] - 1.0f64.sin()).abs() < 1e-3
        );
    }

    /// Over any path of overlap and slip, the work done on the contact is at least what it stores: no energy is made. In
    /// the limit of small steps; half the force of each end is taken. Without the rescaling, thousandfold more than the
    /// allowed error is made.
    #[test]
    fn no_path_gains_energy() {
        let law = law();
        let (mut history, mut overlap, mut last) = ([0.0; 4], 1e-2, [0.0; 3]);
        let (mut work, mut worst, mut largest) = (law.energy(overlap, 0.5, [0.0; 3])[0], 0.0f64, 0.0f64);
        let mut normal_before = force::<f64, true, false>(&law, &touch(UP, overlap, [0.0; 3]), history).0;
        for k in 0..400_000 {
            let time = 1e-4 * f64::from(k);
            let slip = [4e-7 * (1.7 * time).cos(), 3e-7 * (2.3 * time).sin(), 0.0];
            let next = 1e-2 * (1.0 + 0.6 * (3.1 * time).sin());
            let (normal, tangential, new) = force::<f64, true, false>(&law, &touch(UP, next, slip), history);
            work += 0.5 * (normal + normal_before) * (next - overlap)
                - 0.5 * dot(plus(tangential, 1.0, last), slip);
            (history, overlap, last, normal_before) = (new, next, tangential, normal);
            let [stored, sheared] = law.energy(overlap, 0.5, tangential);
            largest = largest.max(sheared);
            worst = worst.max((stored + sheared - work) / stored);
        }
        assert!(largest > 0.0 && worst < 1e-6, "{worst} {largest}");
    }
}
