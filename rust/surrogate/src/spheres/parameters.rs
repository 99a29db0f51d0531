//! The numbers of the law that are fitted to stresses, as parameters without bounds and of about equal size.

use super::contacts::Contacts;
use super::law::{Element, Law};
use super::state::FABRIC;
use nalgebra::DVector;

/// How a number becomes a parameter, and its bounds.
enum Scale {
    /// Its logarithm.
    Logarithm([f64; 2]),
    /// The number over this.
    Over(f64, [f64; 2]),
}

use Scale::{Logarithm, Over};

/// Where a number is in the law.
type Place = fn(&mut Law) -> &mut f64;

const FREE: [f64; 2] = [-1e4, 1e4];
const SIZE: [f64; 2] = [1e-6, 1e6];
const STRENGTH: [f64; 2] = [1e-6, 2.0];
const OF_FABRIC: [f64; 2] = [1e-6, 20.0];
const POWER: [f64; 2] = [-2.0, 1.0];

/// Number of parameters.
pub const PARAMETERS: usize = 52;

/// Coefficients of x are divided by 10.
const TABLE: [(Place, Scale); PARAMETERS] = [
    (|law| &mut law.bulk[0], Logarithm(SIZE)),
    (|law| &mut law.bulk[1], Over(10.0, FREE)),
    (|law| &mut law.bulk[2], Over(1.0, [-5.0, 5.0])),
    (|law| &mut law.bulk[3], Over(1.0, [-1.0, 2.0])),
    (|law| &mut law.bulk[4], Over(1.0, [-1.0, 2.0])),
    (|law| &mut law.bulk[5], Over(1.0, [-20.0, 20.0])),
    (|law| &mut law.shear[0], Over(10.0, FREE)),
    (|law| &mut law.shear[1], Over(1.0, [-1.0, 1.0])),
    (|law| &mut law.shear[2], Over(1.0, [-5.0, 5.0])),
    (|law| &mut law.dilatancy[0], Over(0.1, FREE)),
    (|law| &mut law.dilatancy[1], Over(1.0, FREE)),
    (|law| &mut law.dilatancy[2], Over(0.1, FREE)),
    (|law| &mut law.dilatancy[3], Over(1.0, FREE)),
    (|law| &mut law.dilatancy[4], Over(10.0, FREE)),
    (|law| &mut law.collapse[0], Over(0.1, [0.0, 10.0])),
    (|law| &mut law.collapse[1], Over(10.0, FREE)),
    (|law| &mut law.collapse[2], Over(1.0, [0.0, 3.0])),
    (|law| &mut law.collapse[3], Over(1.0, [0.05, 20.0])),
    (|law| &mut law.mobilising, Over(0.1, [0.0, 100.0])),
    (|law| &mut law.opening_densification[0], Over(1.0, [0.0, 10.0])),
    (|law| &mut law.opening_densification[1], Logarithm([1e-9, 1.0])),
    (|law| &mut law.opening_densification[2], Over(10.0, FREE)),
    (|law| &mut law.opening_densification[3], Over(0.1, [0.0, 0.5])),
    (|law| &mut law.fabric[0], Over(1.0, [0.0, 100.0])),
    (|law| &mut law.elements[0].stiffness, Logarithm(SIZE)),
    (|law| &mut law.elements[0].strength, Logarithm(STRENGTH)),
    (|law| &mut law.elements[0].growth, Over(10.0, FREE)),
    (|law| &mut law.elements[0].unmobilised, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.elements[0].hardening, Over(1.0, [-3.0, 3.0])),
    (|law| &mut law.elements[0].power, Over(1.0, POWER)),
    (|law| &mut law.elements[1].stiffness, Logarithm(SIZE)),
    (|law| &mut law.elements[1].strength, Logarithm(STRENGTH)),
    (|law| &mut law.elements[1].growth, Over(10.0, FREE)),
    (|law| &mut law.elements[1].unmobilised, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.elements[1].hardening, Over(1.0, [-3.0, 3.0])),
    (|law| &mut law.elements[1].power, Over(1.0, POWER)),
    (|law| &mut law.elements[2].stiffness, Logarithm(SIZE)),
    (|law| &mut law.elements[2].strength, Logarithm(STRENGTH)),
    (|law| &mut law.elements[2].growth, Over(10.0, FREE)),
    (|law| &mut law.elements[2].unmobilised, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.elements[2].hardening, Over(1.0, [-3.0, 3.0])),
    (|law| &mut law.elements[2].power, Over(1.0, POWER)),
    (|law| &mut law.elements[FABRIC].stiffness, Logarithm(SIZE)),
    (|law| &mut law.elements[FABRIC].strength, Logarithm(OF_FABRIC)),
    (|law| &mut law.elements[FABRIC].growth, Over(10.0, FREE)),
    (|law| &mut law.elements[FABRIC].unmobilised, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.elements[FABRIC].hardening, Over(1.0, [-3.0, 3.0])),
    (|law| &mut law.elements[FABRIC].power, Over(1.0, POWER)),
    (|law| &mut law.least_contacts, Over(1.0, [0.0, 6.0])),
    (|law| &mut law.forgetting, Over(1.0, [0.0, 1.0])),
    (|law| &mut law.bulk[6], Over(1.0, [-10.0, 1.0])),
    (|law| &mut law.lode, Over(1.0, [0.0, 0.8])),
];

/// The law's numbers as parameters.
pub fn parameters(law: &Law) -> DVector<f64> {
    let mut law = law.clone();
    let all = TABLE.iter().map(|(place, scale)| match scale {
        Logarithm(_) => place(&mut law).ln(),
        Over(size, _) => *place(&mut law) / size,
    });
    DVector::from_vec(all.collect())
}

/// The law of these parameters, with the nearest numbers that [`Law::check`] allows; what is not fitted is as in [`beginning`].
pub fn law(parameters: &DVector<f64>) -> Law {
    let mut law = beginning();
    for ((place, scale), value) in TABLE.iter().zip(parameters.iter()) {
        *place(&mut law) = match scale {
            Logarithm([least, most]) => value.exp().clamp(*least, *most),
            Over(size, [least, most]) => (size * value).clamp(*least, *most),
        };
    }
    law
}

/// Where the fit begins: values of an earlier fit, to three digits.
pub fn beginning() -> Law {
    let element = |[stiffness, strength, growth, unmobilised, hardening, power]: [f64; 6]| Element {
        stiffness,
        strength,
        growth,
        unmobilised,
        hardening,
        power,
    };
    Law {
        bulk: [0.0784, 8.99, 0.0334, 0.216, 0.122, -3.81, -0.856],
        shear: [5.95, 0.16, 0.159],
        least_contacts: 4.12,
        forgetting: 0.249,
        elements: [
            element([0.179, 0.128, 17.1, 0.291, 0.229, -1.27]),
            element([0.816, 0.0474, -19.8, 1.94, 0.32, -0.773]),
            element([0.441, 0.106, 6.19, 0.586, 0.205, -1.0]),
            element([0.0908, 0.526, 7.64, -0.738, 0.187, -0.202]),
        ],
        dilatancy: [0.01, 0.395, -0.0185, -0.287, 4.62],
        collapse: [0.105, 62.9, 0.154, 1.65],
        mobilising: 0.0317,
        opening_densification: [0.0406, 0.00029, 153.0, 0.0306],
        fabric: [5.75, 0.642],
        lode: 0.45,
        contacts: Contacts {
            sheared: [4.17, 10.1, -5.26, 5.61, 48.7, -0.0919],
            surplus: 1.82,
            fading: [0.4, 0.6],
        },
    }
}
