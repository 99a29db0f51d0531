//! Mechanical tangent of a jammed state: the linear response of stress, porosity and fabric to wall strain, the same in
//! extension and compression.

use crate::least_squares;
use serde::{Deserialize, Serialize};

/// Two neighbouring stops of a wall-strain ramp: their differences, and the state half way between them. Strains are
/// positive in extension; stresses are reduced, σ ℓ/(E r̄), and positive in compression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallStrain {
    pub packing: i64,
    /// Δe_xx, Δe_yy [-].
    pub strain: [f64; 2],
    /// p̃, q̃/p̃ and η half way between the stops.
    pub pressure: f64,
    pub stress_ratio: f64,
    pub porosity: f64,
    /// Δσ̃_xx, Δσ̃_yy.
    pub stress: [f64; 2],
    pub delta_porosity: f64,
    pub delta_fabric_index: f64,
    pub delta_fabric_conductivity: f64,
}

/// Linear laws in (1, √p̃, q̃/p̃), (1, √p̃) and (1, √p̃, η), and the scatter of the data about them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mechanics {
    /// c11 = −dσ̃_xx/de_xx: coefficients of 1, √p̃, q̃/p̃; for y the sign of q̃/p̃ changes.
    pub c11: [f64; 3],
    /// c12 = −dσ̃_xx/de_yy: coefficients of 1, √p̃.
    pub c12: [f64; 2],
    /// dη/d(e_xx + e_yy): coefficients of 1, √p̃, η.
    pub porosity: [f64; 3],
    /// df/d(e_xx − e_yy): coefficients of 1, √p̃.
    pub fabric_index: [f64; 2],
    /// df_K/d(e_xx − e_yy): coefficients of 1, √p̃.
    pub fabric_conductivity: [f64; 2],
    pub samples: usize,
    pub packings: usize,
    pub scatter: Scatter,
}

/// Root mean squares of the residuals over those of the data [-].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scatter {
    pub stress: f64,
    pub porosity: f64,
    pub fabric_index: f64,
    pub fabric_conductivity: f64,
}

/// The tangent at a state; see [`Mechanics`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent {
    pub c11: f64,
    pub c22: f64,
    pub c12: f64,
    pub porosity: f64,
    pub fabric_index: f64,
    pub fabric_conductivity: f64,
}

/// Largest strain from the packed state at which the laws are fitted. At larger strains grains slide, and the tangent
/// is softer than that of small strains (shear modulus at 3 %, p̃ 0.05: two thirds).
pub const LINEAR_STRAIN: f64 = 0.01;
/// Least number of samples that determine the laws.
const LEAST_SAMPLES: usize = 20;
/// Least value of c11 − c12 and c22 − c12, which are twice a shear modulus, over E r̄/ℓ: a sixth of that of packed
/// grains.
const LEAST_SHEAR: f64 = 0.05;
/// Reduced pressure below which packings lose contacts; that of packed grains is 0.05.
const SLIGHT_PRESSURE: f64 = 1e-3;
/// Porosities between which packings unjam (stop bearing load).
const UNJAMMING: [f64; 2] = [0.18, 0.20];
/// Share of the stiffness that remains without contacts, so that the displacements of a loose region are determined.
const LOOSE: f64 = 0.01;

impl Mechanics {
    /// `None` with too few samples.
    pub fn fit(samples: &[WallStrain]) -> Option<Self> {
        if samples.len() < LEAST_SAMPLES {
            return None;
        }
        // A weight between fitting stress increments (weight 1) and fitting slopes (1/strain²). A rearrangement of a
        // few grains changes the stress by about the same amount in a small step as in a large one, so with equal
        // weights of the slopes the small steps would dominate the fit.
        let weight = |s: &WallStrain| 1.0 / s.strain[0].hypot(s.strain[1]);
        let stress = samples.iter().flat_map(|s| {
            let ([ex, ey], root) = (s.strain, s.pressure.sqrt());
            let row =
                |own: f64, other: f64, ratio: f64| [-own, -own * root, -own * ratio, -other, -other * root];
            [
                (row(ex, ey, s.stress_ratio), s.stress[0], weight(s)),
                (row(ey, ex, -s.stress_ratio), s.stress[1], weight(s)),
            ]
        });
        let [a, b, c, d, e] = least_squares::fit(stress);
        let porosity = least_squares::fit(samples.iter().map(|s| {
            let trace = s.strain[0] + s.strain[1];
            ([trace, trace * s.pressure.sqrt(), trace * s.porosity], s.delta_porosity, weight(s))
        }));
        let odd = |value: fn(&WallStrain) -> f64| {
            least_squares::fit(samples.iter().map(|s| {
                let difference = s.strain[0] - s.strain[1];
                ([difference, difference * s.pressure.sqrt()], value(s), weight(s))
            }))
        };
        let mut packings: Vec<i64> = samples.iter().map(|s| s.packing).collect();
        packings.sort_unstable();
        packings.dedup();
        let mut mechanics = Self {
            c11: [a, b, c],
            c12: [d, e],
            porosity,
            fabric_index: odd(|s| s.delta_fabric_index),
            fabric_conductivity: odd(|s| s.delta_fabric_conductivity),
            samples: samples.len(),
            packings: packings.len(),
            scatter: Scatter::default(),
        };
        mechanics.scatter = mechanics.scatter(samples);
        Some(mechanics)
    }

    /// Tangent at a reduced pressure, stress ratio q̃/p̃ and porosity. Where the laws are extrapolated, the result
    /// remains one of a stable medium: c11, c22 ≥ c12 + [`LEAST_SHEAR`]. All three moduli decrease smoothly to
    /// [`LOOSE`] times the laws where there is no pressure and the porosity is so large that grains do not touch.
    pub fn tangent(&self, pressure: f64, stress_ratio: f64, porosity: f64) -> Tangent {
        let law = self.laws(pressure, stress_ratio, porosity);
        let unpressed = (-pressure.max(0.0) / SLIGHT_PRESSURE).exp();
        let [jammed, loose] = UNJAMMING;
        let share = ((porosity - jammed) / (loose - jammed)).clamp(0.0, 1.0);
        let apart = share * share * (3.0 - 2.0 * share);
        let contact = LOOSE + (1.0 - LOOSE) * (1.0 - unpressed * apart);
        let least = law.c12.max(0.0) + LEAST_SHEAR;
        Tangent {
            c11: contact * law.c11.max(least),
            c22: contact * law.c22.max(least),
            c12: contact * law.c12,
            ..law
        }
    }

    /// The laws without these limits.
    fn laws(&self, pressure: f64, stress_ratio: f64, porosity: f64) -> Tangent {
        let root = pressure.max(0.0).sqrt();
        let line = |c: [f64; 2]| c[0] + c[1] * root;
        let [a, b, c] = self.c11;
        Tangent {
            c11: a + b * root + c * stress_ratio,
            c22: a + b * root - c * stress_ratio,
            c12: line(self.c12),
            porosity: self.porosity[0] + self.porosity[1] * root + self.porosity[2] * porosity,
            fabric_index: line(self.fabric_index),
            fabric_conductivity: line(self.fabric_conductivity),
        }
    }

    /// Scatter of the samples about the laws.
    pub fn scatter(&self, samples: &[WallStrain]) -> Scatter {
        let relative = |pair: &dyn Fn(&WallStrain, Tangent) -> [[f64; 2]; 2]| {
            let (mut error, mut value) = (0.0, 0.0);
            for s in samples {
                let weight = 1.0 / (s.strain[0].powi(2) + s.strain[1].powi(2));
                for [data, law] in pair(s, self.laws(s.pressure, s.stress_ratio, s.porosity)) {
                    error += weight * (law - data).powi(2);
                    value += weight * data.powi(2);
                }
            }
            if value > 0.0 { (error / value).sqrt() } else { 0.0 }
        };
        let difference = |s: &WallStrain| s.strain[0] - s.strain[1];
        Scatter {
            stress: relative(&|s, t| {
                let [ex, ey] = s.strain;
                [[s.stress[0], -(t.c11 * ex + t.c12 * ey)], [s.stress[1], -(t.c12 * ex + t.c22 * ey)]]
            }),
            porosity: relative(&|s, t| {
                [[s.delta_porosity, t.porosity * (s.strain[0] + s.strain[1])], [0.0; 2]]
            }),
            fabric_index: relative(&|s, t| {
                [[s.delta_fabric_index, t.fabric_index * difference(s)], [0.0; 2]]
            }),
            fabric_conductivity: relative(&|s, t| {
                [[s.delta_fabric_conductivity, t.fabric_conductivity * difference(s)], [0.0; 2]]
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With the shipped model's laws: the tangent equals the laws where grains are packed; elsewhere it is positive
    /// definite, continuous, and nearly zero where grains do not touch.
    #[test]
    fn tangent_is_a_mediums_everywhere_and_vanishes_at_unjamming() {
        let model = crate::models::builtin("builtin").expect("shipped");
        let law = model.mechanics().expect("has laws");
        let packed = law.tangent(0.05, 0.2, 0.13);
        assert_eq!(packed, law.laws(0.05, 0.2, 0.13));
        let mut last = [0.0; 3];
        for step in 0..=4000 {
            let along = f64::from(step) / 4000.0;
            // The path first lowers the pressure to zero, then increases the porosity.
            let (pressure, porosity) = (0.05 * (1.0 - 2.0 * along).max(0.0), 0.13 + 0.1 * along);
            for ratio in [-1.0, -0.35, 0.0, 0.35, 1.0] {
                let t = law.tangent(pressure, ratio, porosity);
                assert!(t.c12 > 0.0 && t.c11.min(t.c22) >= t.c12 + 0.99 * LOOSE * LEAST_SHEAR, "{t:?}");
            }
            let t = law.tangent(pressure, 0.2, porosity);
            let now = [t.c11, t.c22, t.c12];
            let jump = now.iter().zip(last).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(step == 0 || jump < 0.01, "{pressure} {porosity}: {jump}");
            last = now;
        }
        let apart = law.tangent(0.0, 0.0, 0.21);
        assert!(apart.c11 < 0.02 * packed.c11 && apart.porosity == law.laws(0.0, 0.0, 0.21).porosity);
        assert!(law.tangent(0.0, 0.0, 0.15).c11 > 0.3 * packed.c11, "grains that touch resist");
    }

    #[test]
    fn recovers_the_laws_that_made_the_samples() {
        let law = Mechanics {
            c11: [0.29, 2.06, 0.3],
            c12: [0.2, 0.1],
            porosity: [0.4, -0.3, 2.0],
            fabric_index: [-1.0, 0.5],
            fabric_conductivity: [-3.0, 2.0],
            samples: 40,
            packings: 4,
            scatter: Scatter::default(),
        };
        let sample = |i: usize| {
            let phase = i as f64;
            let strain = [0.01 * (phase * 0.9).sin(), 0.007 * (phase * 1.7).cos()];
            let (pressure, stress_ratio) = (0.05 + 0.04 * (phase * 0.37).sin(), 0.2 * (phase * 0.6).cos());
            let porosity = 0.13 + 0.03 * (phase * 0.23).sin();
            let t = law.laws(pressure, stress_ratio, porosity);
            let difference = strain[0] - strain[1];
            WallStrain {
                packing: (i % 4) as i64,
                strain,
                pressure,
                stress_ratio,
                porosity,
                stress: [-(t.c11 * strain[0] + t.c12 * strain[1]), -(t.c12 * strain[0] + t.c22 * strain[1])],
                delta_porosity: t.porosity * (strain[0] + strain[1]),
                delta_fabric_index: t.fabric_index * difference,
                delta_fabric_conductivity: t.fabric_conductivity * difference,
            }
        };
        let samples: Vec<WallStrain> = (0..40).map(sample).collect();
        let found = Mechanics::fit(&samples).expect("enough samples");
        for (a, b) in found.c11.iter().zip(law.c11).chain(found.c12.iter().zip(law.c12)) {
            assert!((a - b).abs() < 1e-5, "{found:?}");
        }
        assert!(found.scatter.stress < 1e-6 && found.scatter.porosity < 1e-6, "{:?}", found.scatter);
        assert_eq!((found.samples, found.packings), (40, 4));
        assert!(Mechanics::fit(&samples[..3]).is_none());
    }
}
