//! Heat through a contact of two solids, and the stress in it.
//!
//! Through a contact of radius a, of two bodies that are large against it: 2 k_s a (Carslaw & Jaeger, Conduction of Heat in
//! Solids, 1959, section 8.2). a follows from the force, a = (3 F R*/(4 E*))^(1/3), with the real stiffness of the
//! material. A simulation may be softer than the material to save time. The forces of a bed at rest hardly depend on
//! that, but its contacts are then too large, as E^(-1/3). (A correction by E^(-1/5), which is that of an impact of given
//! energy, leaves them too large.)
//!
//! Rough surfaces touch at their asperities only. The conductance per area of a rough joint under the pressure p is
//! 1.25 k_s (m/σ) (p/H)^0.95 (Yovanovich's form of the law of Cooper, Mikic & Yovanovich, Int. J. Heat Mass Transfer 12, 279,
//! 1969, who have 1.45 and 0.985). Integrated over Hertz's distribution of the pressure it adds the resistance
//! R_s = 1.18 (σ/m) (H/p0)^0.95/(π k_s a²), with the height σ and the slope m of the asperities, the hardness H of the
//! softer surface, and the largest pressure p0 = 3 F/(2 π a²). 1.18 is (1 + 0.95/2)/1.25.
//!
//! The material yields below the surface once p0 exceeds 1.6 times its yield stress (Johnson, Contact Mechanics, 1985, section
//! 6.1); beyond that, Hertz's law says too much about the force and too little about the contact.

use msdd_engine::message::number;
use std::f64::consts::PI;

/// Hertz's largest pressure over the yield stress at which yielding begins.
pub const YIELD_AT: f64 = 1.6;

/// Factor and exponent of the conductance of a rough joint.
const ROUGH: [f64; 2] = [1.25, 0.95];

/// Rough surfaces of two bodies that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// σ/m \[m\]: height of the asperities (root mean square) over their slope. For two like surfaces it is that of one.
    pub height_over_slope: f64,
    /// H \[Pa\] of the softer surface.
    pub hardness: f64,
}

impl Roughness {
    /// None: smooth, or not known.
    pub fn given(height_over_slope: Option<f64>, hardness: Option<f64>) -> Option<Self> {
        Some(Self { height_over_slope: height_over_slope?, hardness: hardness? })
    }
}

/// The material of the spheres, as far as heat is concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// k_s \[W/(m K)\].
    pub conductivity: f64,
    /// E* \[Pa\] of two spheres, of the real material.
    pub effective_modulus: f64,
    /// None: smooth.
    pub roughness: Option<Roughness>,
}

impl Solid {
    /// Conductance over k_s \[m\] of a contact that carries `force` \[N\]: 2 a if it is smooth.
    pub fn contact_size(&self, force: f64, effective_radius: f64) -> f64 {
        let a = contact_radius(force, effective_radius, self.effective_modulus);
        match self.roughness {
            _ if a == 0.0 => 0.0,
            None => 2.0 * a,
            Some(rough) => {
                let soft = libm::pow(rough.hardness / peak_stress(force, a), ROUGH[1]);
                let factor = (1.0 + 0.5 * ROUGH[1]) / ROUGH[0];
                let resistance = 0.5 / a + factor * rough.height_over_slope * soft / (PI * a * a);
                1.0 / resistance
            }
        }
    }
}

/// a = (3 F R*/(4 E*))^(1/3) \[m\].
pub fn contact_radius(force: f64, effective_radius: f64, effective_modulus: f64) -> f64 {
    libm::cbrt(0.75 * force * effective_radius / effective_modulus)
}

/// p0 = 3 F/(2 π a²) \[Pa\], the largest pressure in a contact of radius `a` \[m\].
pub fn peak_stress(force: f64, a: f64) -> f64 {
    1.5 * force / (PI * a * a)
}

/// What the contacts of a bed carry, against what the material can.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeakStress {
    /// Largest p0 of all contacts \[Pa\], and the force \[N\] there.
    pub largest: f64,
    pub force: f64,
    /// σ_Y \[Pa\].
    pub yield_stress: f64,
    /// Contacts in which p0 exceeds [`YIELD_AT`] σ_Y, and all contacts.
    pub beyond: usize,
    pub contacts: usize,
}

impl PeakStress {
    /// Of contacts with forces \[N\] and effective radii \[m\].
    pub fn new(
        contacts: impl Iterator<Item = (f64, f64)>,
        effective_modulus: f64,
        yield_stress: f64,
    ) -> Self {
        let mut found = Self { largest: 0.0, force: 0.0, yield_stress, beyond: 0, contacts: 0 };
        for (force, effective_radius) in contacts.filter(|&(force, _)| force > 0.0) {
            let stress = peak_stress(force, contact_radius(force, effective_radius, effective_modulus));
            found.contacts += 1;
            found.beyond += usize::from(stress > YIELD_AT * yield_stress);
            if stress > found.largest {
                (found.largest, found.force) = (stress, force);
            }
        }
        found
    }

    /// Says where the elastic law ends; none while all contacts are elastic.
    pub fn warning(&self) -> Option<String> {
        (self.beyond > 0).then(|| {
            format!(
                "{} of {} contacts yield: Hertz's peak stress is up to {} Pa (force {} N), the elastic law holds up to {YIELD_AT} \
                 times the yield stress = {} Pa",
                self.beyond,
                self.contacts,
                number(self.largest),
                number(self.force),
                number(YIELD_AT * self.yield_stress)
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Solid = Solid { conductivity: 42.0, effective_modulus: 1.1e11, roughness: None };

    /// Without pressure dependence the law of the rough joint is h = 1.25 k m/σ (p/H)^0.95; here it is integrated over rings.
    #[test]
    fn roughness_is_the_integral_over_the_contact() {
        let rough = Roughness { height_over_slope: 3.4e-7, hardness: 3e9 };
        let (force, radius) = (0.01, 1.6e-3);
        let a = contact_radius(force, radius, STEEL.effective_modulus);
        let p0 = peak_stress(force, a);
        let count = 100_000;
        let conductance: f64 = (0..count)
            .map(|k| {
                let r = a * (f64::from(k) + 0.5) / f64::from(count);
                let pressure = p0 * (1.0 - r * r / (a * a)).sqrt();
                let local = 1.25 / rough.height_over_slope * (pressure / rough.hardness).powf(0.95);
                local * 2.0 * PI * r * a / f64::from(count)
            })
            .sum();
        let solid = Solid { roughness: Some(rough), ..STEEL };
        let found = solid.contact_size(force, radius);
        let expected = 1.0 / (1.0 / (2.0 * a) + 1.0 / conductance);
        assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
        let smooth = Solid { roughness: Some(Roughness { height_over_slope: 0.0, ..rough }), ..STEEL };
        assert!((smooth.contact_size(force, radius) / (2.0 * a) - 1.0).abs() < 1e-15);
        assert_eq!(solid.contact_size(0.0, radius), 0.0);
    }

    /// p0 = (6 F E*²/(π³ R*²))^(1/3) (Johnson, Eq. 4.24).
    #[test]
    fn yielding_is_told_with_its_values() {
        let (force, radius) = (0.05, 1.6e-3);
        let expected = (6.0 * force * 1.1e11f64.powi(2) / (PI.powi(3) * radius * radius)).cbrt();
        let contacts = || [(force, radius), (0.01, radius), (0.0, radius)].into_iter();
        let found = PeakStress::new(contacts(), 1.1e11, 0.2e9);
        assert!((found.largest / expected - 1.0).abs() < 1e-12, "{found:?} {expected}");
        assert_eq!((found.contacts, found.beyond), (2, 1), "{found:?}");
        let text = found.warning().unwrap();
        assert!(text.starts_with("1 of 2 contacts yield") && text.ends_with("= 320000000 Pa"), "{text}");
        assert_eq!(PeakStress::new(contacts(), 1.1e11, 5e9).warning(), None);
    }
}
