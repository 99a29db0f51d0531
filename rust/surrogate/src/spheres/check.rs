//! What the numbers of a law may be.

use super::law::{Element, Law};
use crate::SurrogateError;
use crate::document::field;

/// Largest coefficient of x.
const LARGE: f64 = 1e4;

impl Law {
    /// Refuses numbers for which the law has no meaning.
    ///
    /// # Errors
    /// [`SurrogateError::Field`] with key, value and what is allowed.
    pub fn check(&self) -> Result<(), SurrogateError> {
        let [b0, b1, b2, b3, b4, b5, b6] = self.bulk;
        let [of_density, shear_power, of_unmobilised] = self.shear;
        let [c0, c1, c2, c3] = self.collapse;
        let [s0, s1, s2, s3] = self.opening_densification;
        let z0 = self.least_contacts;
        let [per_anisotropy, usual] = self.fabric;
        let mut numbers = vec![
            ("bulk[0]", b0, (1e-6..=1e6).contains(&b0), "1e-6 to 1e6"),
            ("bulk[1]", b1, b1.abs() <= LARGE, "-1e4 to 1e4"),
            ("bulk[2]", b2, b2.abs() <= 5.0, "-5 to 5"),
            // The pressure grows with the compression at any g and x.
            ("bulk[3]", b3, (-1.0..=2.0).contains(&b3), "-1 to 2"),
            ("bulk[4]", b4, (-1.0..=2.0).contains(&b4), "-1 to 2"),
            ("bulk[5]", b5, b5.abs() <= 20.0, "-20 to 20"),
            ("bulk[6]", b6, (-10.0..=1.0).contains(&b6), "-10 to 1"),
            ("shear[0]", of_density, of_density.abs() <= LARGE, "-1e4 to 1e4"),
            ("shear[1]", shear_power, shear_power.abs() <= 1.0, "-1 to 1"),
            ("shear[2]", of_unmobilised, of_unmobilised.abs() <= 5.0, "-5 to 5"),
            ("least_contacts", z0, (0.0..=6.0).contains(&z0), "0 to 6"),
            ("forgetting", self.forgetting, (0.0..=1.0).contains(&self.forgetting), "0 to 1"),
            ("mobilising", self.mobilising, (0.0..=100.0).contains(&self.mobilising), "0 to 100"),
            ("collapse[0]", c0, (0.0..=10.0).contains(&c0), "0 to 10"),
            ("collapse[1]", c1, c1.abs() <= LARGE, "-1e4 to 1e4"),
            ("collapse[2]", c2, (0.0..=3.0).contains(&c2), "0 to 3"),
            ("collapse[3]", c3, (0.05..=20.0).contains(&c3), "0.05 to 20"),
            ("settling[0]", s0, (0.0..=10.0).contains(&s0), "0 to 10"),
            ("settling[1]", s1, (1e-9..=1.0).contains(&s1), "1e-9 to 1"),
            ("settling[2]", s2, s2.abs() <= LARGE, "-1e4 to 1e4"),
            ("settling[3]", s3, (0.0..=0.5).contains(&s3), "0 to 0.5"),
            ("lode", self.lode, (0.0..=0.8).contains(&self.lode), "0 to 0.8"),
            ("fabric[0]", per_anisotropy, (0.0..=100.0).contains(&per_anisotropy), "0 to 100"),
            ("fabric[1]", usual, (0.0..=1.0).contains(&usual), "0 to 1"),
        ];
        numbers.extend(self.dilatancy.iter().map(|d| ("dilatancy", *d, d.abs() <= LARGE, "-1e4 to 1e4")));
        for element in &self.elements {
            let Element { stiffness, strength, growth, unmobilised, hardening, power } = *element;
            numbers.extend([
                ("element.stiffness", stiffness, (1e-6..=1e6).contains(&stiffness), "1e-6 to 1e6"),
                ("element.strength", strength, (1e-6..=20.0).contains(&strength), "1e-6 to 20"),
                ("element.growth", growth, growth.abs() <= LARGE, "-1e4 to 1e4"),
                ("element.free", unmobilised, unmobilised.abs() <= 10.0, "-10 to 10"),
                ("element.hardening", hardening, hardening.abs() <= 100.0, "-100 to 100"),
                ("element.power", power, (-2.0..=1.0).contains(&power), "-2 to 1"),
            ]);
        }
        numbers.extend(self.contacts.numbers());
        match numbers.into_iter().find(|(_, _, good, _)| !good) {
            Some((key, value, _, allowed)) => field(&format!("law.{key}"), value, allowed),
            None => Ok(()),
        }
    }
}
