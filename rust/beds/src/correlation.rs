//! A published correlation for the conductivity of packed beds, to stand beside simulations.

/// σ of Stefan and Boltzmann \[W/(m² K⁴)\].
pub const STEFAN_BOLTZMANN: f64 = 5.670_374e-8;

/// k_r \[W/(m K)\] of radiation between layers of grains: 4 σ T³ d/(2/ε − 1).
pub fn radiation(temperature: f64, diameter: f64, emissivity: f64) -> f64 {
    4.0 * STEFAN_BOLTZMANN * temperature.powi(3) * diameter / (2.0 / emissivity - 1.0)
}

/// Conductivity of a bed of spheres over that of the gas by Zehner, Bauer and Schlünder (VDI Heat Atlas, 2nd ed., 2010, section D6.3),
/// without contacts and at usual pressure of the gas. `ratio` is k_s/k_g, `radiation` is k_r/k_g.
pub fn zehner_bauer_schluender(porosity: f64, ratio: f64, radiation: f64) -> f64 {
    let shape = 1.25 * libm::pow((1.0 - porosity) / porosity, 10.0 / 9.0);
    let n = 1.0 + (radiation - shape) / ratio;
    let log = libm::log((ratio + radiation) / shape);
    let core = 2.0 / n
        * (shape / (n * n) * (ratio + radiation - 1.0) / ratio * log
            + (shape + 1.0) / (2.0 * shape) * (radiation - shape)
            - (shape - 1.0) / n);
    let root = (1.0 - porosity).sqrt();
    (1.0 - root) * (1.0 + porosity * radiation) + root * core
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Solids that conduct as the gas make a bed that does so, without radiation; better ones one that lies between both.
    #[test]
    fn equal_conductivities_are_nearly_kept() {
        let equal = zehner_bauer_schluender(0.4, 1.0 + 1e-6, 0.0);
        assert!((equal - 1.0).abs() < 1e-3, "{equal}");
        let steel = zehner_bauer_schluender(0.4, 2000.0, 0.0);
        assert!((15.0..25.0).contains(&steel), "{steel}");
    }

    #[test]
    fn radiation_of_black_bodies() {
        assert!((radiation(1000.0, 0.01, 1.0) - 4.0 * 5.670_374e-8 * 1e9 * 0.01).abs() < 1e-9);
    }
}
