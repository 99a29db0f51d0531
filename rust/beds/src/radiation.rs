//! Conductivity by radiation of a bed of equal spheres, which are opaque, grey and diffuse.
//!
//! Where each sphere has one temperature the bed conducts K_rad = 4 σ T³ d F, with a factor F of the emissivity ε and the solid fraction φ
//! ([`factor`]). It has two parts: F₀ of rays that go on from sphere to sphere by reflection, which does not depend on ε, and R of emission and
//! absorption.
//!
//! In a poor conductor the temperature varies inside of each sphere, by a part G of the mean gradient. Without radiation G₀ = (K₀ − k_g)/
//! (φ (k_s − k_g)), since the mean flux is k_g times the mean gradient plus k_s − k_g times that in the spheres. Radiation changes G: if the
//! gradient is the same within all spheres, the dissipated heat
//!
//! K₀ + M (G − G₀)² + 4 σ T³ d (F₀ + R (1 − c φ G)²),   M = φ (k_s − k_g)/(1 − G₀),
//!
//! is least in equilibrium. M follows from the same variation without radiation, which is exact for k_s near k_g. The last term is the
//! sum of ray tracing with the temperatures of the surfaces where they emit and absorb: at G = 0 those of the centres, at G = 1 those
//! of the mean gradient. So the least is two resistances in series, of the solid and of radiation:
//!
//! K_rad = 4 σ T³ d (F₀ + R (1 − c φ G₀)²/(1 + (c φ)² R 4 σ T³ d/M)).
//!
//! Only c = 1.1 is fitted, to direct solutions (`examples/direct/voxels.rs`, `examples/radiation.rs`) with κ = k_s/k_g from 5 to 1000, Λ = k_s/
//! (4 σ T³ d) from 0.3 to 100, φ from 0.55 to 0.63 and ε from 0.2 to 1; ray tracing alone gives 1.12. Whatever Λ, the limit of
//! insulating spheres F₀ is kept.

/// σ of Stefan and Boltzmann \[W/(m² K⁴)\].
pub const STEFAN_BOLTZMANN: f64 = 5.670_374e-8;

/// F₀ over (1 − φ)²/φ.
const REFLECTED: f64 = 0.4556;
/// α and β of R = ε/(φ^(2/3) (α − β ε)).
const EMITTED: [f64; 2] = [2.163, 0.613];
/// c.
const WIDTH: f64 = 1.1;
/// Of the interval in which the conductivity without radiation is searched: to 1e-9 of it.
const HALVINGS: usize = 30;
/// (k_s − k_g)/k_s below which the limit of equal conductivities is taken.
const EQUAL: f64 = 1e-3;

/// F \[-\], within 1.5 % of ray tracing for φ from 0.57 to 0.63 and ε from 0.1 to 1, sheared or not, and 4 % above it at φ = 0.55.
pub fn factor(emissivity: f64, solid_fraction: f64) -> f64 {
    reflected(solid_fraction) + emitted(emissivity, solid_fraction)
}

/// F₀.
fn reflected(solid_fraction: f64) -> f64 {
    let pores = 1.0 - solid_fraction;
    REFLECTED * pores * pores / solid_fraction
}

/// R.
fn emitted(emissivity: f64, solid_fraction: f64) -> f64 {
    let third = libm::cbrt(solid_fraction);
    emissivity / (third * third * (EMITTED[0] - EMITTED[1] * emissivity))
}

/// 4 σ T³ d \[W/(m K)\].
pub fn black(temperature: f64, diameter: f64) -> f64 {
    4.0 * STEFAN_BOLTZMANN * temperature * temperature * temperature * diameter
}

/// A bed without radiation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dark {
    /// K₀ \[W/(m K)\], by gas and contacts.
    pub conductivity: f64,
    /// k_s \[W/(m K)\].
    pub solid: f64,
    /// k_g \[W/(m K)\], 0 in a vacuum, at most k_s.
    pub gas: f64,
    /// φ \[-\]
    pub solid_fraction: f64,
}

impl Dark {
    /// K_rad \[W/(m K)\], what radiation adds, for 4 σ T³ d \[W/(m K)\] ([`black`]) and ε.
    pub fn radiation(&self, black: f64, emissivity: f64) -> f64 {
        let (phi, apart) = (self.solid_fraction, self.solid - self.gas);
        // G₀, and 1/M.
        let (gradient, give) = if apart > EQUAL * self.solid {
            let gradient = ((self.conductivity - self.gas) / (phi * apart)).clamp(0.0, 1.0);
            (gradient, (1.0 - gradient) / (phi * apart))
        } else {
            (1.0, (1.0 - phi) / (3.0 * phi * self.solid))
        };
        let (width, emitted) = (WIDTH * phi, emitted(emissivity, phi));
        let left = 1.0 - width * gradient;
        black * (reflected(phi) + emitted * left * left / (1.0 + width * width * emitted * black * give))
    }
}

/// K_rad \[W/(m K)\] of a bed that conducts `bed.conductivity` with it, instead of without it.
pub fn part(bed: &Dark, black: f64, emissivity: f64) -> f64 {
    let total = bed.conductivity;
    let with = |conductivity: f64| Dark { conductivity, ..*bed }.radiation(black, emissivity);
    // What radiation adds falls where more is conducted without it, but by less than that grows.
    let (mut low, mut high) = (0.0, total);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle + with(middle) < total { low = middle } else { high = middle }
    }
    total - high
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIRECT: [[f64; 6]; 12] = [
        [0.634, 1.0, 5.0, 0.3, 2.850, 6.383],
        [0.634, 1.0, 5.0, 3.0, 2.850, 3.351],
        [0.634, 1.0, 20.0, 1.0, 6.413, 14.275],
        [0.634, 1.0, 20.0, 10.0, 6.413, 7.426],
        [0.634, 1.0, 100.0, 0.3, 16.546, 120.200],
        [0.634, 1.0, 1000.0, 3.0, 109.841, 334.403],
        [0.634, 0.6, 5.0, 1.0, 2.850, 3.866],
        [0.634, 0.6, 20.0, 0.3, 6.413, 21.399],
        [0.634, 0.6, 100.0, 1.0, 16.546, 51.119],
        [0.634, 0.2, 5.0, 0.3, 2.850, 4.968],
        [0.634, 0.2, 20.0, 1.0, 6.413, 9.595],
        [0.634, 0.2, 100.0, 10.0, 16.546, 18.453],
    ];

    /// Direct solutions of one packing of 50 spheres each, as `radiation direct 50 1 54` prints them, extrapolated: φ, ε, κ, Λ, K₀/k_g, K/k_g.
    #[test]
    fn conductivities_are_those_of_direct_solutions() {
        for [phi, emissivity, ratio, solid, dark, bright] in DIRECT {
            let bed = Dark { conductivity: dark, solid: ratio, gas: 1.0, solid_fraction: phi };
            let found = dark + bed.radiation(ratio / solid, emissivity);
            assert!(
                (found / bright - 1.0).abs() < 0.03,
                "{phi} {emissivity} {ratio} {solid}: {found} {bright}"
            );
        }
    }

    /// Good conductors have F, insulators F₀ whatever ε; the limit of k_s = k_g is reached without a jump.
    #[test]
    fn limits_are_kept() {
        let bed = Dark { conductivity: 0.5, solid: 1e6, gas: 0.03, solid_fraction: 0.6 };
        assert!((bed.radiation(1.0, 0.7) / factor(0.7, 0.6) - 1.0).abs() < 1e-5);
        let poor = Dark { conductivity: 0.0, solid: 1e-6, gas: 0.0, solid_fraction: 0.6 };
        let [one, other] = [0.2, 0.9].map(|emissivity| poor.radiation(1.0, emissivity));
        assert!(
            (one / other - 1.0).abs() < 1e-5 && (one / reflected(0.6) - 1.0).abs() < 1e-4,
            "{one} {other}"
        );
        let near = |more: f64| {
            let solid = 1.0 + more;
            let conductivity = crate::effective::poor_spheres(0.6, solid);
            Dark { conductivity, solid, gas: 1.0, solid_fraction: 0.6 }.radiation(1.0, 0.9)
        };
        assert!((near(0.0) / near(2e-3) - 1.0).abs() < 2e-3, "{} {}", near(0.0), near(2e-3));
        assert_eq!(bed.radiation(0.0, 0.7), 0.0);
    }

    #[test]
    fn the_part_of_radiation_is_found_again() {
        for conductivity in [0.02, 0.4, 1.2] {
            let bed = Dark { conductivity, solid: 2.0, gas: 0.01, solid_fraction: 0.6 };
            let added = bed.radiation(3.0, 0.8);
            let both = Dark { conductivity: conductivity + added, ..bed };
            assert!((part(&both, 3.0, 0.8) / added - 1.0).abs() < 1e-6, "{conductivity}");
        }
    }
}
