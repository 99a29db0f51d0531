//! Representative volumes of spheres: periodic boxes that are strained, and their averages.
//!
//! Lengths are in diameters, stresses in units of E* = E/(2 (1 − ν²)), so nothing depends on the size or stiffness of real
//! grains.
//!
//! | module | what |
//! |---|---|
//! | [`strain`] | strain of the box and of the grains |
//! | [`state`] | state files |
//! | [`averages`](mod@averages) | stress, fabric and reduced conductivities of a box |
//! | [`follow`](mod@follow) | straining a box, and rest after it |
//! | [`prepare`](mod@prepare) | a packed box at a pressure |
//! | [`turn`](mod@turn) | the same box with other names of its axes |

pub mod averages;
pub mod follow;
pub mod prepare;
pub mod state;
pub mod strain;
pub mod turn;

pub use averages::{Averages, GAS_NUMBERS, averages};
pub use follow::advance;
pub use prepare::{Preparation, PrepareError, Prepared, prepare};
pub use strain::{Strain, Tensor};
pub use turn::turned;

use msdd_spheres::{Material, Stiffness};

/// Spheres of density 1 with E* = 1.
pub fn material(poisson_ratio: f64, friction: f64, restitution: f64) -> Material {
    let young_modulus = 2.0 * (1.0 - poisson_ratio * poisson_ratio);
    Material {
        density: 1.0,
        stiffness: Stiffness::HertzMindlin { young_modulus, poisson_ratio },
        friction,
        wall_friction: friction,
        restitution,
    }
}
