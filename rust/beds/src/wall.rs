//! What a wall adds to the resistance of a bed of spheres.
//!
//! A bed is taken as a body of the conductivity K up to its surface. The spheres at a wall pass heat to it through their contacts
//! and through the gas next to these, by the laws of [`crate::solid`] and [`crate::gas`]. With n spheres on d² of the wall, each of which carries
//! the force p d²/n, that is the conductance per area h = n (G_contact + G_gas)/d² between the wall and the centres of these
//! spheres, which lie R away from it. The body has conducted over this distance, too: so what the wall adds is R_w = 1/h − l/K, or
//! nothing if that is negative.
//!
//! Two numbers are fitted to networks of poured beds (`examples/walls.rs`, `examples/cylinders.rs`), at floors and at the sides of cylinders of 5 to 20 d, at
//! 2 to 200 kPa. The contacts conduct 0.8 of what n contacts with one force do (0.75 to 0.84): not all n spheres carry load, and
//! their forces scatter. The first spheres conduct less well to the next ones than the bed: l is 0.88 R (0.98 at floors, 0.8 to 0.92 at
//! sides), in so far as contacts and gas conduct to them. That the side is curved changes neither: fewer spheres stand along it, but the gas between
//! each of them and the side is thinner.
//!
//! Radiation goes from the wall to spheres of several layers, and adds h_r = 4 σ T³/(1/ε_w − 0.44 + 0.335/F) to h, with the emissivity ε_w of
//! the wall and K_rad = 4 σ T³ d F of the bed. Found by ray tracing in a bed of 1000 spheres that was poured on a floor, with spheres of
//! one temperature each: for emissivities of wall and spheres from 0.2 to 1, R_w is within 0.1/(4 σ T³), or 2 %, of what the network has.
//! Without the bed's own half diameter it is the jump of temperature next to a dense cloud, 1/ε_w − 1/2 (Deissler, J. Heat Transfer 86, 240, 1964),
//! less 0.165/F, because the layers next to a wall are loose.
//!
//! With n = 0.87 (counted are gaps up to half a radius next to a floor) this h is within 4 % of that of the network, whose plate is shared by all
//! spheres that see it ([`crate::plate_view_areas`]).

use crate::effective::BedMaterial;
use crate::gas::plate_conductance;
use crate::solid::{Roughness, Solid};

/// What contacts at a wall conduct over n equally loaded contacts, and the distance l over R: fitted, see above.
const CARRYING: f64 = 0.8;
const TO_NEXT: f64 = 0.88;

/// The surface of a wall next to a bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// k \[W/(m K)\] of the wall; none: its surface has one temperature.
    pub conductivity: Option<f64>,
    /// E* \[Pa\] of a sphere and the wall.
    pub effective_modulus: f64,
    /// Of sphere and wall together; none: smooth.
    pub roughness: Option<Roughness>,
    /// n, spheres at the wall on the square of a diameter \[-\].
    pub spheres: f64,
}

impl Wall {
    /// h \[W/(m² K)\] between the wall and the centres of the spheres at it, under a stress normal to the wall \[Pa\] and at a temperature
    /// of the gas \[K\].
    pub fn conductance(&self, bed: &BedMaterial, stress: f64, temperature: f64) -> f64 {
        let diameter = 2.0 * bed.radius;
        let force = stress.max(0.0) * diameter * diameter / self.spheres;
        let solid = bed.solid.conductivity;
        let pair =
            Solid { conductivity: 1.0, effective_modulus: self.effective_modulus, roughness: self.roughness };
        // 2 a k of two half-spaces of one k; of two different ones, their harmonic mean. A surface of one temperature: twice k.
        let harmonic = self.conductivity.map_or(2.0 * solid, |wall| 2.0 * solid * wall / (solid + wall));
        let contact = CARRYING * harmonic * pair.contact_size(force, bed.radius);
        let by_gas = bed.gas_at(temperature).map_or(0.0, |gas| {
            let distance = gas.plate_distance(0.0, bed.radius, solid);
            plate_conductance(gas.conductivity, bed.radius, distance, gas.jump_length())
        });
        self.spheres * (contact + by_gas) / (diameter * diameter)
    }

    /// R_w \[m² K/W\] next to a bed that conducts `conductivity` \[W/(m K)\] across the wall, 0 at least. Infinite where nothing
    /// conducts.
    pub fn resistance(
        &self,
        bed: &BedMaterial,
        stress: f64,
        temperature: f64,
        conductivity: f64,
        radiating: &Radiating,
    ) -> f64 {
        let by_radiation = radiating.conductance(2.0 * bed.radius);
        let between = self.conductance(bed, stress, temperature) + by_radiation;
        if between <= 0.0 {
            return f64::INFINITY;
        }
        // What radiates to the spheres is fitted with l = R.
        let distance = bed.radius * (TO_NEXT + (1.0 - TO_NEXT) * by_radiation / between);
        (1.0 / between - distance / conductivity).max(0.0)
    }
}

/// A wall that radiates to a bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radiating {
    /// ε_w, 0: it does not.
    pub emissivity: f64,
    /// 4 σ T³ d, and what radiation is of the conductivity of the bed \[W/(m K)\].
    pub black: f64,
    pub bed: f64,
}

impl Radiating {
    pub const NONE: Self = Self { emissivity: 0.0, black: 0.0, bed: 0.0 };

    /// h_r \[W/(m² K)\] between the wall and the centres of the first spheres, of this diameter \[m\].
    pub fn conductance(&self, diameter: f64) -> f64 {
        if self.emissivity <= 0.0 || self.bed <= 0.0 {
            return 0.0;
        }
        let factor = self.bed / self.black;
        // Two numbers are fitted to ray tracing, see the test.
        self.black / diameter / (1.0 / self.emissivity - 0.44 + 0.335 / factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::named_gases::GasName;

    fn steel(gas: GasName) -> BedMaterial {
        let solid = Solid { conductivity: 42.0, effective_modulus: 1.09e11, roughness: None };
        BedMaterial { radius: 1e-3, solid, gas, gas_pressure: 1.013e5, accommodation: 0.9 }
    }

    const SMOOTH: Wall =
        Wall { conductivity: Some(42.0), effective_modulus: 1.09e11, roughness: None, spheres: 1.0 };

    /// Hertz: contacts conduct 2 a k, with a = (3 F R/(4 E*))^(1/3).
    #[test]
    fn in_a_vacuum_contacts_alone_conduct() {
        let bed = steel(GasName::Vacuum);
        let force: f64 = 1e4 * 4e-6;
        let a = (0.75 * force * 1e-3 / 1.09e11).cbrt();
        let found = SMOOTH.conductance(&bed, 1e4, 300.0);
        assert!((found / (CARRYING * 2.0 * a * 42.0 / 4e-6) - 1.0).abs() < 1e-12, "{found}");
        // Eight times the pressure, twice the conductance; fewer spheres that carry more each: n^(2/3).
        assert!((SMOOTH.conductance(&bed, 8e4, 300.0) / found - 2.0).abs() < 1e-12);
        let few = Wall { spheres: 0.125, ..SMOOTH };
        assert!((few.conductance(&bed, 1e4, 300.0) / found - 0.25).abs() < 1e-12);
        assert_eq!(SMOOTH.resistance(&bed, 0.0, 300.0, 0.5, &Radiating::NONE), f64::INFINITY);
    }

    /// Gas, poor walls and rough surfaces each count in the right direction; the bed's own half diameter is taken off.
    #[test]
    fn a_wall_adds_what_its_spheres_do_not_conduct() {
        let (air, bed) = (steel(GasName::Air), steel(GasName::Vacuum));
        let at = |wall: &Wall, bed: &BedMaterial| wall.conductance(bed, 1e4, 300.0);
        assert!(at(&SMOOTH, &air) > at(&SMOOTH, &bed));
        let poor = Wall { conductivity: Some(0.2), ..SMOOTH };
        assert!(at(&poor, &bed) < 0.02 * at(&SMOOTH, &bed));
        let rough = Wall { roughness: Some(Roughness { height_over_slope: 2e-6, hardness: 3e9 }), ..SMOOTH };
        assert!(at(&rough, &bed) < at(&SMOOTH, &bed));
        let h = at(&SMOOTH, &air);
        let found = SMOOTH.resistance(&air, 1e4, 300.0, 2e-3 * h, &Radiating::NONE);
        // K = 2e-3 h: R/K is half of 1/h.
        assert!((found * h - (1.0 - 0.5 * TO_NEXT)).abs() < 1e-12, "{found}");
        assert_eq!(SMOOTH.resistance(&air, 1e4, 300.0, 1e-4 * h, &Radiating::NONE), 0.0);
    }

    /// As on the floor of 2500 poured spheres by ray tracing (`examples/walls.rs`, `walls radiation 2500`): emissivity of the wall, F, and
    /// R_w 4 σ T³.
    #[test]
    fn walls_radiate_as_ray_tracing_says() {
        for [wall, factor, expected] in [
            [1.0, 1.030, 0.415],
            [0.6, 1.030, 1.083],
            [0.2, 1.030, 4.415],
            [1.0, 0.606, 0.332],
            [0.6, 0.606, 1.020],
            [0.2, 0.606, 4.378],
            [1.0, 0.283, -0.025],
            [0.6, 0.283, 0.687],
            [0.2, 0.283, 4.165],
        ] {
            let diameter = 2.0;
            let radiating = Radiating { emissivity: wall, black: diameter, bed: factor * diameter };
            let found = radiating.conductance(diameter) * (expected + 0.5 / factor);
            assert!((found - 1.0).abs() < 0.04, "{wall} {factor}: {found} {expected}");
        }
    }
}
