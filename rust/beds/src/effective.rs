//! Conductivity of a bed from what the law of spheres says of it: from reduced conductivities to W/(m K).
//!
//! K = k_s κ_c f + k_g κ_g. κ_c and κ_g are those of smooth spheres over the conductivities of solid and gas, κ_g at the number
//! ln(R/h) of the gas, with the distance h of [`crate::gas`] at a contact. The factor f is what roughness leaves of the contacts,
//! taken at the mean contact force p π d²/(φ z): within 1.3 % of networks with the resistance in every contact while f is above 0.5,
//! and 4 % too low at 0.25.
//!
//! That is right for spheres that conduct much better than the gas. Where κ = k_s/k_g is below [`POOR`], as of ceramics in helium, heat
//! does not go from sphere to sphere along straight lines, and κ_g is [`poor_spheres`] instead, a fit to direct solutions of the heat
//! equation (`examples/direct/voxels.rs`). A contact then adds less than its own conductance, because without it heat would go through the thin
//! gas around it. Batchelor and O'Brien (Proc. R. Soc. A 355, 313, 1977) found, for a contact of the radius a, 0.22 λ² instead of 2λ/π
//! (both over π k_g R) where λ = κ a/R is small; in between λ/(λ + 2.9) of the contact's conductance is taken, which has both ends. Between
//! [`POOR`] and [`GOOD`] the two descriptions are mixed by the logarithm of κ.

use crate::gas::{Gas, gas_conductance};
use crate::named_gases::GasName;
use crate::solid::Solid;
use std::f64::consts::PI;

/// κ up to which [`poor_spheres`] counts alone, and κ from which the law of pairs does.
pub const POOR: f64 = 20.0;
pub const GOOD: f64 = 60.0;
/// Spheres that conduct less than this times as well as the gas are beyond the closure.
pub const MIN_RATIO: f64 = 1.0;
/// Third and fourth coefficient of [`poor_spheres`], the only ones that are fitted.
const FITTED: [f64; 2] = [0.079, 0.0041];
/// λ at which a contact adds half of its own conductance.
const HALF: f64 = 2.9;

/// K/k_g of a packing of spheres that just touch, with a gas that does not jump: exp(φ x (1 + (1 − φ) (x/6 − 0.079 x² + 0.0041 x³))),
/// x = ln κ. The terms up to the second order in κ − 1 are exact for isotropic packings; the others are fitted to direct solutions
/// for φ from 0.54 to 0.63 (`examples/voxels.rs`), which are known within 1 % up to κ = 5, within 2 % at κ = 10 and 6 % at κ = 20: so far
/// apart are their extrapolations with the powers 1/2 and 1 of the voxels' size.
pub fn poor_spheres(solid_fraction: f64, ratio: f64) -> f64 {
    let (x, [second, third]) = (libm::log(ratio), FITTED);
    let bend = x * (1.0 / 6.0 - x * (second - x * third));
    libm::exp(solid_fraction * x * (1.0 + (1.0 - solid_fraction) * bend))
}

/// κ_g of the pairs of a packing with the solid fraction φ, whose gas has the distance h at a contact: (0.861 + 5.45 (φ − 0.6)) g(h) +
/// (0.547 + 0.925 (φ − 0.6)) g(h + 0.14 R), where g is the conductance of a pair over π k_g R/2. The first part is that of pairs that touch. Fitted to
/// periodic packings with φ from 0.57 to 0.64 and h as touching spheres have it for κ from 1 to 60, which are met within 1.2 % (`examples/pairs.rs`).
pub fn pairs(solid_fraction: f64, distance: f64, radius: f64) -> f64 {
    let denser = solid_fraction - 0.6;
    let pair = |distance: f64| 2.0 / PI * gas_conductance(1.0, 1.0, distance);
    let h = distance / radius;
    (0.861 + 5.45 * denser) * pair(h) + (0.547 + 0.925 * denser) * pair(h + 0.14)
}

/// ln(R/h) below which the law of spheres does not know κ_g, which is then that of the [`pairs`] of touching spheres.
pub const MIN_NUMBER: f64 = 2.5;

/// κ_g at the number of a gas over that at [`MIN_NUMBER`], where it is below; else 1.
fn beyond_law(solid_fraction: f64, number: f64) -> f64 {
    if number >= MIN_NUMBER {
        return 1.0;
    }
    let at = |number: f64| pairs(solid_fraction, libm::exp(-number), 1.0);
    at(number) / at(MIN_NUMBER)
}

/// How much the law of pairs counts for κ: 0 for poor conductors, 1 for good ones.
pub fn share_of_pairs(ratio: f64) -> f64 {
    (libm::log(ratio / POOR) / libm::log(GOOD / POOR)).clamp(0.0, 1.0)
}

/// κ_g of poor conductors, with the jump length M; [`poor_spheres`]. A jump at the surface is a resistance in series with the sphere (Hasselman and
/// Johnson, J. Compos. Mater. 21, 508, 1987). Where the sphere and its jump conduct less than the gas, molecules fly from grain to grain
/// ([`is_rarefied`]): there κ_g goes with that conductivity, and so with the pressure of the gas, to nothing in a vacuum.
fn poor_gas(solid_fraction: f64, ratio: f64, jump: f64, radius: f64) -> f64 {
    let seen = with_jump(ratio, jump, radius);
    if seen < 1.0 { seen } else { poor_spheres(solid_fraction, seen) }
}

/// κ of a sphere with the jump at its surface.
fn with_jump(ratio: f64, jump: f64, radius: f64) -> f64 {
    ratio / (1.0 + 0.5 * ratio * jump / radius)
}

/// Whether a gas is so thin that its molecules fly from grain to grain, with κ: then κ_g is only of the right order and goes with the
/// pressure.
pub fn is_rarefied(gas: &Gas, ratio: f64, radius: f64) -> bool {
    with_jump(ratio, gas.jump_length(), radius) < 1.0
}

/// What the gas of each pair is multiplied with, so that a homogeneous packing of spheres of the conductivity `solid` \[W/(m K)\] conducts as the
/// closure says.
pub fn pair_factor(gas: &Gas, solid: f64, radius: f64, solid_fraction: f64) -> f64 {
    let ratio = solid / gas.conductivity;
    let share = share_of_pairs(ratio);
    if share >= 1.0 {
        return 1.0;
    }
    let pairs = pairs(solid_fraction, gas.least_distance(radius, solid), radius);
    share + (1.0 - share) * poor_gas(solid_fraction, ratio, gas.jump_length(), radius) / pairs
}

/// K \[W/(m K)\] by gas of a homogeneous packing of spheres of the conductivity `solid` \[W/(m K)\], as of a network whose pairs have
/// [`pair_factor`].
pub fn gas_alone(gas: &Gas, solid: f64, radius: f64, solid_fraction: f64) -> f64 {
    let pairs = pairs(solid_fraction, gas.least_distance(radius, solid), radius);
    gas.conductivity * pairs * pair_factor(gas, solid, radius, solid_fraction)
}

/// What a contact adds over its own conductance, for κ and its size, the conductance over 2 k_s, over R.
pub fn contact_factor(ratio: f64, size: f64) -> f64 {
    let (share, lambda) = (share_of_pairs(ratio), ratio * size);
    share + (1.0 - share) * lambda / (lambda + HALF)
}

/// How far the closure is from direct solutions \[-\], for κ.
pub fn closure_error(ratio: f64) -> f64 {
    [(5.0, 0.01), (10.0, 0.02), (POOR, 0.06)]
        .iter()
        .find(|(to, _)| ratio <= *to)
        .map_or(0.1, |(_, error)| *error)
}

/// What the conductivity of a bed depends on, apart from its material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedState {
    /// \[Pa\]
    pub pressure: f64,
    /// φ \[-\]
    pub solid_fraction: f64,
    /// Contacts per sphere.
    pub coordination: f64,
    /// κ_g by the law of pairs, at the number of the gas, at least [`MIN_NUMBER`].
    pub gas: f64,
}

/// Conduction by gas and contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conduction {
    /// K by the gas \[W/(m K)\].
    pub gas: f64,
    /// The part of it that goes from sphere to sphere, and so mostly where contacts point \[W/(m K)\].
    pub gas_of_pairs: f64,
    /// What there is of k_s κ_c, the conduction by smooth contacts that add to the gas \[-\].
    pub contacts: f64,
}

/// Equal spheres and the gas between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedMaterial {
    /// \[m\]
    pub radius: f64,
    pub solid: Solid,
    pub gas: GasName,
    /// \[Pa\]
    pub gas_pressure: f64,
    /// \[-\]
    pub accommodation: f64,
}

impl BedMaterial {
    /// The gas at a temperature \[K\], which is taken at the nearest known one; none in a vacuum.
    pub fn gas_at(&self, temperature: f64) -> Option<Gas> {
        let [low, high] = self.gas.range();
        self.gas.at(temperature.clamp(low, high), self.gas_pressure, self.accommodation)
    }

    /// ln(R/h) \[-\]: 8.5 for steel spheres of 6 mm in air, less for small spheres, poor solids and thin gases.
    pub fn gas_number(&self, gas: &Gas) -> f64 {
        libm::log(self.radius / gas.least_distance(self.radius, self.solid.conductivity))
    }

    /// Whether the law covers the gas between these spheres. `range`: of the number of a gas, which is that of the law of pairs, which
    /// poor conductors do not have.
    pub fn knows(&self, gas: &Gas, [low, high]: [f64; 2]) -> bool {
        let inside = (low..=high).contains(&self.gas_number(gas)) || self.share_of_pairs(gas) == 0.0;
        inside && !is_rarefied(gas, self.ratio(gas), self.radius)
    }

    /// κ \[-\].
    pub fn ratio(&self, gas: &Gas) -> f64 {
        self.solid.conductivity / gas.conductivity
    }

    /// How much the law of pairs counts: 0 for poor conductors, 1 for good ones.
    pub fn share_of_pairs(&self, gas: &Gas) -> f64 {
        share_of_pairs(self.ratio(gas))
    }

    /// Conduction with this gas, or in a vacuum.
    pub fn conduction(&self, gas: Option<&Gas>, bed: &BedState) -> Conduction {
        let rough = self.roughness_factor(bed.pressure, bed.solid_fraction, bed.coordination);
        let Some(gas) = gas else { return Conduction { gas: 0.0, gas_of_pairs: 0.0, contacts: rough } };
        let (pairs, ratio) = (self.share_of_pairs(gas), self.ratio(gas));
        let of_pairs = bed.gas * beyond_law(bed.solid_fraction, self.gas_number(gas));
        if pairs >= 1.0 {
            let of_gas = gas.conductivity * of_pairs;
            return Conduction { gas: of_gas, gas_of_pairs: of_gas, contacts: rough };
        }
        let poor = poor_gas(bed.solid_fraction, ratio, gas.jump_length(), self.radius);
        Conduction {
            gas: gas.conductivity * (pairs * of_pairs + (1.0 - pairs) * poor),
            gas_of_pairs: gas.conductivity * pairs * of_pairs,
            contacts: rough * contact_factor(ratio, rough * self.mean_contact(bed) / self.radius),
        }
    }

    /// Radius of a smooth contact \[m\] at the mean force p π d²/(φ z).
    fn mean_contact(&self, bed: &BedState) -> f64 {
        if bed.pressure <= 0.0 {
            return 0.0;
        }
        let smooth = Solid { roughness: None, ..self.solid };
        0.5 * smooth.contact_size(
            self.mean_force(bed.pressure, bed.solid_fraction, bed.coordination),
            0.5 * self.radius,
        )
    }

    fn mean_force(&self, pressure: f64, solid_fraction: f64, coordination: f64) -> f64 {
        let diameter = 2.0 * self.radius;
        pressure * PI * diameter * diameter / (solid_fraction * coordination)
    }

    /// f: what roughness leaves of the conduction by contacts \[-\], at a pressure \[Pa\], solid fraction φ and contacts z per sphere.
    pub fn roughness_factor(&self, pressure: f64, solid_fraction: f64, coordination: f64) -> f64 {
        if self.solid.roughness.is_none() || pressure <= 0.0 {
            return 1.0;
        }
        let force = self.mean_force(pressure, solid_fraction, coordination);
        let smooth = Solid { roughness: None, ..self.solid };
        let size = |solid: &Solid| solid.contact_size(force, 0.5 * self.radius);
        size(&self.solid) / size(&smooth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::Roughness;

    fn steel() -> BedMaterial {
        let roughness = Some(Roughness { height_over_slope: 3.4e-7, hardness: 3e9 });
        let solid = Solid { conductivity: 42.0, effective_modulus: 1.09e11, roughness };
        BedMaterial { radius: 3.2e-3, solid, gas: GasName::Air, gas_pressure: 1.013e5, accommodation: 0.7 }
    }

    #[test]
    fn steel_in_air_has_the_number_of_the_literature() {
        let bed = steel();
        let air = bed.gas_at(293.15).expect("no vacuum");
        let number = bed.gas_number(&air);
        assert!((8.0..9.0).contains(&number), "{number}");
        assert_eq!(bed.share_of_pairs(&air), 1.0);
        let helium = BedMaterial { gas: GasName::Helium, ..bed }.gas_at(293.15).expect("no vacuum");
        assert!(bed.gas_number(&helium) < number);
        assert!(BedMaterial { gas: GasName::Vacuum, ..bed }.gas_at(300.0).is_none());
    }

    /// Direct solutions: φ, κ, K/k_g. Up to κ = 5 as `voxels 60 1 72` prints them. At κ = 10 it prints 4.224, 3.911 and 3.514, by the power
    /// 1/2 of the voxels' size, and the power 1 gives 4.298, 3.990 and 3.582; these values were chosen between, 0.7 % below the latter.
    #[test]
    fn poor_spheres_conduct_as_direct_solutions_say() {
        for (phi, ratio, expected) in [
            (0.63, 2.0, 1.567),
            (0.63, 5.0, 2.833),
            (0.63, 10.0, 4.27),
            (0.5947, 2.0, 1.530),
            (0.5947, 5.0, 2.686),
            (0.5947, 10.0, 3.96),
            (0.5456, 2.0, 1.480),
            (0.5456, 5.0, 2.488),
            (0.5456, 10.0, 3.56),
        ] {
            let found = poor_spheres(phi, ratio);
            assert!((found / expected - 1.0).abs() < 0.01, "{phi} {ratio}: {found} {expected}");
        }
        // Exact to the second order.
        let (phi, small) = (0.6, 1e-3);
        let mean = 1.0 + phi * small;
        let exact = mean - phi * (1.0 - phi) * small * small / (3.0 * mean);
        assert!((poor_spheres(phi, 1.0 + small) - exact).abs() < 1e-9);
    }

    /// The closure and the law of pairs meet: no jump as the gas gets better, and more of it conducts more.
    #[test]
    fn conduction_goes_over_from_one_law_to_the_other() {
        let bed = BedState { pressure: 1e5, solid_fraction: 0.6, coordination: 5.0, gas: 6.0 };
        let at = |conductivity: f64| {
            let solid = Solid { conductivity, ..steel().solid };
            let material = BedMaterial { solid, ..steel() };
            let air = material.gas_at(293.15).expect("no vacuum");
            (material.ratio(&air), material.conduction(Some(&air), &bed))
        };
        let air = at(42.0).0 / 42.0;
        for limit in [POOR, GOOD] {
            let [(_, low), (_, high)] = [0.999_999, 1.000_001].map(|side| at(limit * side / air));
            assert!(
                (low.gas / high.gas - 1.0).abs() < 1e-3 && (low.contacts / high.contacts - 1.0).abs() < 1e-3
            );
        }
        let adds: Vec<f64> = [2.0, 10.0, 20.0, 40.0, 60.0].map(|ratio| at(ratio / air).1.contacts).to_vec();
        assert!(adds.windows(2).all(|pair| pair[0] < pair[1]), "{adds:?}");
        assert_eq!(at(100.0 / air).1.contacts, steel().roughness_factor(1e5, 0.6, 5.0));
        let vacuum = steel().conduction(None, &bed);
        assert_eq!(vacuum.gas, 0.0);
    }

    /// A gas that is pumped off conducts less and less, and in proportion to its pressure where it is thin: of good, middling and poor conductors.
    #[test]
    fn a_thin_gas_conducts_nothing() {
        for conductivity in [50.0, 6.0, 0.5] {
            let solid = Solid { conductivity, roughness: None, ..steel().solid };
            let at = |pressure: f64| {
                let material = BedMaterial { solid, gas: GasName::Helium, gas_pressure: pressure, ..steel() };
                let helium = material.gas_at(573.0).expect("no vacuum");
                // As the law answers, which covers the gas of numbers from 2.5 on.
                let number = material.gas_number(&helium).max(MIN_NUMBER);
                let gas = pairs(0.6, material.radius * libm::exp(-number), material.radius);
                let bed = BedState { pressure: 0.0, solid_fraction: 0.6, coordination: 5.0, gas };
                (
                    material.conduction(Some(&helium), &bed).gas,
                    is_rarefied(&helium, material.ratio(&helium), 3.2e-3),
                )
            };
            let all: Vec<(f64, bool)> = (0..40).map(|k| at(1e5 * libm::pow(0.6, f64::from(k)))).collect();
            assert!(all.windows(2).all(|pair| pair[1].0 < pair[0].0), "{conductivity}: {all:?}");
            // No jump where one description ends and the next begins.
            assert!(all.windows(2).all(|pair| pair[1].0 > 0.55 * pair[0].0), "{conductivity}: {all:?}");
            assert!(!all[0].1 && all[39].1);
            let [thin, thinner] = [1e-2, 1e-3].map(|pressure| at(pressure).0);
            assert!((thin / thinner - 10.0).abs() < 0.1, "{conductivity}: {thin} {thinner}");
        }
    }

    /// Roughness leaves more of contacts that carry more, and all of smooth ones.
    #[test]
    fn roughness_counts_less_under_pressure() {
        let bed = steel();
        let [low, high] = [1e3, 1e6].map(|pressure| bed.roughness_factor(pressure, 0.58, 5.0));
        assert!(0.3 < low && low < high && high < 1.0, "{low} {high}");
        assert_eq!(bed.roughness_factor(0.0, 0.58, 5.0), 1.0);
        let smooth = BedMaterial { solid: Solid { roughness: None, ..bed.solid }, ..bed };
        assert_eq!(smooth.roughness_factor(1e3, 0.58, 5.0), 1.0);
    }
}
