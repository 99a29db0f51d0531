//! The numbers of the law that are fitted to stresses, as parameters without bounds and of about equal size.

use super::contacts::{COEFFICIENTS, Contacts};
use super::law::{Element, Law};
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
const POWER: [f64; 2] = [-2.0, 1.0];

/// Number of parameters.
pub const PARAMETERS: usize = 54;

/// Coefficients of x are divided by 10.
const TABLE: [(Place, Scale); PARAMETERS] = [
    (|law| &mut law.bulk[0], Logarithm(SIZE)),
    (|law| &mut law.bulk[1], Over(10.0, FREE)),
    (|law| &mut law.bulk[2], Over(1.0, [-5.0, 5.0])),
    (|law| &mut law.bulk[3], Over(1.0, [-1.0, 2.0])),
    (|law| &mut law.bulk[4], Over(1.0, [-1.0, 2.0])),
    (|law| &mut law.bulk[5], Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.shear[0], Over(10.0, FREE)),
    (|law| &mut law.shear[1], Over(1.0, [-1.0, 1.0])),
    (|law| &mut law.shear[2], Over(1.0, [-5.0, 5.0])),
    (|law| &mut law.lift, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.dilatancy[0], Over(1.0, [0.0, 10.0])),
    (|law| &mut law.dilatancy[1], Over(0.1, FREE)),
    (|law| &mut law.dilatancy[2], Over(1.0, FREE)),
    (|law| &mut law.dilatancy[3], Over(0.1, FREE)),
    (|law| &mut law.collapse[0], Over(0.1, [0.0, 10.0])),
    (|law| &mut law.collapse[1], Over(10.0, FREE)),
    (|law| &mut law.collapse[2], Over(1.0, [0.0, 3.0])),
    (|law| &mut law.collapse[3], Over(1.0, [0.05, 20.0])),
    (|law| &mut law.mobilising, Over(0.1, [0.0, 100.0])),
    (|law| &mut law.settling[0], Over(1.0, [0.0, 10.0])),
    (|law| &mut law.settling[1], Logarithm([1e-9, 1.0])),
    (|law| &mut law.settling[2], Over(10.0, FREE)),
    (|law| &mut law.fabric[0], Over(1.0, [0.0, 100.0])),
    (|law| &mut law.elements[0].stiffness, Logarithm(SIZE)),
    (|law| &mut law.elements[0].strength, Logarithm(STRENGTH)),
    (|law| &mut law.elements[0].growth, Over(10.0, FREE)),
    (|law| &mut law.elements[0].free, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.elements[0].power, Over(1.0, POWER)),
    (|law| &mut law.elements[1].stiffness, Logarithm(SIZE)),
    (|law| &mut law.elements[1].strength, Logarithm(STRENGTH)),
    (|law| &mut law.elements[1].growth, Over(10.0, FREE)),
    (|law| &mut law.elements[1].free, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.elements[1].power, Over(1.0, POWER)),
    (|law| &mut law.elements[2].stiffness, Logarithm(SIZE)),
    (|law| &mut law.elements[2].strength, Logarithm(STRENGTH)),
    (|law| &mut law.elements[2].growth, Over(10.0, FREE)),
    (|law| &mut law.elements[2].free, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.elements[2].power, Over(1.0, POWER)),
    (|law| &mut law.elements[3].stiffness, Logarithm(SIZE)),
    (|law| &mut law.elements[3].strength, Logarithm(STRENGTH)),
    (|law| &mut law.elements[3].growth, Over(10.0, FREE)),
    (|law| &mut law.elements[3].free, Over(1.0, [-10.0, 10.0])),
    (|law| &mut law.elements[3].hardening, Over(1.0, [-100.0, 100.0])),
    (|law| &mut law.elements[3].power, Over(1.0, POWER)),
    (|law| &mut law.elements[0].hardening, Over(1.0, [-3.0, 3.0])),
    (|law| &mut law.elements[1].hardening, Over(1.0, [-3.0, 3.0])),
    (|law| &mut law.elements[2].hardening, Over(1.0, [-3.0, 3.0])),
    (|law| &mut law.reopening, Over(1.0, [0.0, 2.0])),
    (|law| &mut law.healing, Over(0.1, [0.0, 1.0])),
    (|law| &mut law.dilatancy[4], Over(1.0, [0.0, 20.0])),
    (|law| &mut law.dilatancy[5], Over(1.0, FREE)),
    (|law| &mut law.elements[1].dilatancy, Over(0.1, FREE)),
    (|law| &mut law.elements[3].dilatancy, Over(0.1, FREE)),
    (|law| &mut law.settling[3], Over(0.1, [0.0, 0.5])),
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
    let element = |[stiffness, strength, growth, free, hardening, power, dilatancy]: [f64; 7]| Element {
        stiffness,
        strength,
        growth,
        free,
        hardening,
        power,
        dilatancy,
    };
    Law {
        bulk: [0.0756, 9.18, 0.069, 0.243, 0.0786, -3.67],
        shear: [6.24, 0.234, -0.34],
        lift: 0.332,
        elements: [
            element([0.269, 0.326, 46.7, -0.392, 0.701, -0.947, 0.0]),
            element([1.33, 0.0458, -12.4, 2.13, 0.153, -1.02, 0.0891]),
            element([0.502, 0.104, 9.22, 0.819, 0.273, -0.823, 0.0]),
            element([0.0263, 0.212, -14.3, -0.935, 17.3, -0.0796, -0.0954]),
        ],
        dilatancy: [0.0, 0.0245, 0.0543, -0.0946, 0.758, 0.329],
        collapse: [0.0157, 85.1, 0.384, 2.03],
        mobilising: 0.00979,
        healing: 0.0797,
        reopening: 0.144,
        settling: [0.0686, 0.000339, 143.0, 0.0128],
        fabric: [4.99, 0.468],
        contacts: Contacts { usual: [0.0; COEFFICIENTS], fading: [0.0; 2] },
    }
}
