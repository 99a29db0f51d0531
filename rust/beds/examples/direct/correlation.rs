//! A published correlation for the conductivity of packed beds, for comparison with simulations.

use msdd_beds::radiation::STEFAN_BOLTZMANN;

/// k_r \[W/(m K)\] of radiation between layers of grains: 4 σ T³ d/(2/ε − 1).
pub fn radiation(temperature: f64, diameter: f64, emissivity: f64) -> f64 {
    4.0 * STEFAN_BOLTZMANN * temperature.powi(3) * diameter / (2.0 / emissivity - 1.0)
}

/// The width of the pores of a packing of spheres over their diameter, as that of a slit between two walls with their volume and surface: 2 V/S =
/// d (1 − φ)/(3 φ). Half of the mean chord.
pub fn pore_width(solid_fraction: f64) -> f64 {
    (1.0 - solid_fraction) / (3.0 * solid_fraction)
}

/// Conductivity of a bed of spheres over that of the gas by Zehner, Bauer and Schlünder (VDI Heat Atlas, 2nd ed., 2010, section D6.3),
/// without contacts. `ratio` is k_s/k_g, `radiation` is k_r/k_g, and `gaps` is k_G/k_g = 1/(1 + M/d) of the gas in the gaps,
/// with the jump length M ([`msdd_beds::gas::Gas::jump_length`]); 1: no jump.
pub fn zehner_bauer_schluender(porosity: f64, ratio: f64, radiation: f64, gaps: f64) -> f64 {
    let shape = 1.25 * libm::pow((1.0 - porosity) / porosity, 10.0 / 9.0);
    let both = ratio + radiation;
    let jump = 1.0 / gaps - 1.0;
    let n = (1.0 + (radiation - shape * gaps) / ratio) / gaps - shape * jump * (1.0 + radiation / ratio);
    let log = libm::log(both / (shape * (gaps + (1.0 - gaps) * both)));
    let core = 2.0 / n
        * (shape / (n * n) * (both - 1.0) / (ratio * gaps) * log
            + (shape + 1.0) / (2.0 * shape) * (radiation / gaps - shape * (1.0 + jump * radiation))
            - (shape - 1.0) / (n * gaps));
    let root = (1.0 - porosity).sqrt();
    (1.0 - root) * porosity * (1.0 / (porosity + jump) + radiation) + root * core
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Solids that conduct as the gas make a bed that does so, without radiation; better ones one that lies between both.
    #[test]
    fn equal_conductivities_are_nearly_kept() {
        let equal = zehner_bauer_schluender(0.4, 1.0 + 1e-6, 0.0, 1.0);
        assert!((equal - 1.0).abs() < 1e-3, "{equal}");
        let steel = zehner_bauer_schluender(0.4, 2000.0, 0.0, 1.0);
        assert!((15.0..25.0).contains(&steel), "{steel}");
    }

    /// Without radiation the core is made of columns of height 1 at the radius r, of solid to z and of gas above, with
    /// r² + z²/(B − (B − 1) z)² = 1; the jump adds 1/k_G − 1 to the resistance of each.
    #[test]
    fn the_core_is_the_integral_over_columns() {
        let (porosity, ratio) = (0.4f64, 50.0);
        let shape = 1.25 * ((1.0 - porosity) / porosity).powf(10.0 / 9.0);
        let count = 200_000;
        for gaps in [1.0, 0.98, 0.8] {
            let core: f64 = (0..count)
                .map(|k| {
                    let z = (f64::from(k) + 0.5) / f64::from(count);
                    let w = shape - (shape - 1.0) * z;
                    let area = 2.0 * z / (w * w) * (1.0 + z * (shape - 1.0) / w);
                    area / (z / ratio + 1.0 - z + 1.0 / gaps - 1.0) / f64::from(count)
                })
                .sum();
            let root = (1.0 - porosity).sqrt();
            let around = (1.0 - root) * porosity / (porosity - 1.0 + 1.0 / gaps);
            let expected = around + root * core;
            let found = zehner_bauer_schluender(porosity, ratio, 0.0, gaps);
            assert!((found / expected - 1.0).abs() < 1e-6, "{gaps}: {found} {expected}");
        }
    }

    /// Evaluated apart from this program: ψ = 0.4 has B = 1.961421; with k_s = 50 and k_r = 5, N = 1.060772 and the core is 14.44868.
    #[test]
    fn radiation_counts_as_in_the_heat_atlas() {
        let root = 0.6f64.sqrt();
        let expected = (1.0 - root) * (1.0 + 0.4 * 5.0) + root * 14.448_684;
        let found = zehner_bauer_schluender(0.4, 50.0, 5.0, 1.0);
        assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    }

    /// Simple cubic spheres: twice the pore volume of a cell of edge d over the surface of its sphere.
    #[test]
    fn pores_are_as_wide_as_a_slit() {
        let ball = std::f64::consts::PI / 6.0;
        let expected = 2.0 * (1.0 - ball) / std::f64::consts::PI;
        assert!((pore_width(ball) - expected).abs() < 1e-15);
    }

    #[test]
    fn radiation_of_black_bodies() {
        assert!((radiation(1000.0, 0.01, 1.0) - 4.0 * 5.670_374e-8 * 1e9 * 0.01).abs() < 1e-9);
    }
}
