//! The spheres of a new case: named materials, and materials given by their values.

use crate::CaseError;
use crate::grains::{Grains, Preset};
use crate::numbers::plain;
use crate::ranges::allow;
use msdd_beds::property::Property;

/// Equal spheres of one material. The law of spheres knows one friction between them, 0.3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spheres {
    /// `mean_radius` is the radius of the spheres, `young_modulus` that of the solid.
    pub grains: Grains,
    /// Poisson's ratio \[-\].
    pub poisson_ratio: f64,
    /// Height of the asperities (root mean square) over their slope \[m\]; 0: smooth.
    pub roughness: f64,
    /// Hardness of the surface \[Pa\], which counts where it is rough.
    pub hardness: f64,
    pub emissivity: Emissivity,
}

/// ε \[-\] of the surface of spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emissivity {
    /// 0: without radiation.
    Constant(f64),
    /// Pairs of temperature \[K\] and value.
    Table(&'static [[f64; 2]]),
}

impl Emissivity {
    pub fn property(self) -> Property {
        match self {
            Self::Constant(value) => Property::Constant(value),
            Self::Table(rows) => Property::Table(rows.to_vec()),
        }
    }

    /// The value in `spheresCoeffs`.
    pub fn text(self) -> String {
        match self {
            Self::Constant(value) => plain(value),
            Self::Table(rows) => {
                let rows: Vec<String> =
                    rows.iter().map(|[t, value]| format!("({} {})", plain(*t), plain(*value))).collect();
                format!("table ({})", rows.join(" "))
            }
        }
    }
}

/// A named material of spheres.
pub struct Material {
    pub preset: Preset,
    pub poisson_ratio: f64,
    /// As in [`Spheres`].
    pub roughness: f64,
    pub hardness: f64,
    pub emissivity: Emissivity,
}

/// The named materials; the first one is the default.
pub static MATERIALS: [Material; 4] = [
    Material {
        preset: Preset {
            name: "steel",
            about: "balls of bearing steel 100Cr6 of 6.4 mm diameter (usual values of handbooks; roughness of the balls of \
                    Beaulieu's bed, cases/beaulieu; emissivity of polished steel from 310 to 530 K: J. R. Thome, Radiative heat \
                    transfer, EPFL, 2008, from 670 to 1270 K: \
                    M. A. Bramson, Infrared Radiation, as in FLIR's tables; oxidised steel has 0.8)",
            grains: Grains {
                density: 7800.0,
                young_modulus: 210e9,
                thermal_conductivity: 46.0,
                heat_capacity: 475.0,
                thermal_expansion: 1.2e-5,
                mean_radius: 3.2e-3,
            },
            temperature: 293.15,
        },
        poisson_ratio: 0.3,
        roughness: 3.4e-7,
        hardness: 7e9,
        emissivity: Emissivity::Table(&[
            [200.0, 0.07],
            [310.0, 0.07],
            [530.0, 0.1],
            [670.0, 0.14],
            [1270.0, 0.38],
            [2000.0, 0.38],
        ]),
    },
    Material {
        preset: Preset {
            name: "glass",
            about: "soda-lime glass near room temperature (MakeItFrom.com, annealed soda-lime glass; emissivity as in tables for \
                    thermographs, 0.94 for polished plate glass), smooth beads of 4 mm diameter",
            grains: Grains {
                density: 2400.0,
                young_modulus: 71e9,
                thermal_conductivity: 1.0,
                heat_capacity: 800.0,
                thermal_expansion: 8.8e-6,
                mean_radius: 2e-3,
            },
            temperature: 293.15,
        },
        poisson_ratio: 0.22,
        roughness: 0.0,
        hardness: 5.5e9,
        emissivity: Emissivity::Constant(0.93),
    },
    Material {
        preset: Preset {
            name: "alumina",
            about: "sintered alumina at 20 degrees Celsius (NIST Standard Reference Database 150; R. G. Munro, J. Am. Ceram. \
                    Soc. 80, 1919, 1997; emissivity from 400 to 1500 K: P. E. Liley, Heat Exchanger Design Handbook 5.5.7), \
                    spheres of 6 mm diameter, taken as smooth",
            grains: Grains {
                density: 3984.0,
                young_modulus: 416e9,
                thermal_conductivity: 33.0,
                heat_capacity: 755.0,
                thermal_expansion: 4.6e-6,
                mean_radius: 3e-3,
            },
            temperature: 293.15,
        },
        poisson_ratio: 0.231,
        roughness: 0.0,
        hardness: 15e9,
        emissivity: Emissivity::Table(&[
            [200.0, 0.78],
            [400.0, 0.78],
            [600.0, 0.69],
            [800.0, 0.61],
            [1000.0, 0.54],
            [1200.0, 0.49],
            [1400.0, 0.42],
            [1500.0, 0.4],
            [2000.0, 0.4],
        ]),
    },
    Material {
        preset: Preset {
            name: "lithium-orthosilicate",
            about: "pebbles of a breeder bed near 700 K in round numbers (as cases/blanket; elastic constants: Y. Futamura, Data \
                    Base for Tritium Solid Breeding Materials, University of Toyama, 7.2; emissivity assumed as of other \
                    oxides), 0.5 mm diameter, taken as smooth",
            grains: Grains {
                density: 2400.0,
                young_modulus: 90e9,
                thermal_conductivity: 2.4,
                heat_capacity: 1500.0,
                thermal_expansion: 2.5e-5,
                mean_radius: 2.5e-4,
            },
            temperature: 673.15,
        },
        poisson_ratio: 0.24,
        roughness: 0.0,
        hardness: 1e9,
        emissivity: Emissivity::Constant(0.8),
    },
];

/// The materials as those of any grains.
pub fn presets() -> Vec<&'static Preset> {
    MATERIALS.iter().map(|material| &material.preset).collect()
}

impl Material {
    pub fn spheres(&self) -> Spheres {
        Spheres {
            grains: self.preset.grains,
            poisson_ratio: self.poisson_ratio,
            roughness: self.roughness,
            hardness: self.hardness,
            emissivity: self.emissivity,
        }
    }
}

impl Spheres {
    /// Numbers of the law of spheres alone, by the names that they have in `spheresCoeffs`, with unit.
    pub fn named(&self) -> [(&'static str, f64, &'static str); 3] {
        [
            ("poissonRatio", self.poisson_ratio, ""),
            ("roughness", self.roughness, "m"),
            ("hardness", self.hardness, "Pa"),
        ]
    }

    /// Refuses values out of range; the error names the first of them.
    ///
    /// # Errors
    /// [`CaseError::Parameter`].
    pub fn check(&self) -> Result<(), CaseError> {
        self.grains.check()?;
        let ranges = [
            (-0.99, 0.5, "-0.99 to 0.5"),
            (0.0, 0.01 * self.radius(), "0 (smooth) to a hundredth of the radius [m]"),
            (1.0, 1e15, "1 to 1e15 Pa"),
        ];
        for ((key, value, _), (least, most, allowed)) in self.named().into_iter().zip(ranges) {
            allow(key, value, (least..=most).contains(&value), || allowed.to_string())?;
        }
        match self.emissivity {
            Emissivity::Constant(value) => allow("emissivity", value, (0.0..=1.0).contains(&value), || {
                "0 (without radiation) to 1".into()
            }),
            Emissivity::Table(_) => Ok(()),
        }
    }

    /// \[m\]
    pub fn radius(&self) -> f64 {
        self.grains.mean_radius
    }

    /// E* = E/(2 (1 − ν²)) \[Pa\]: the law's stresses are in proportion to it.
    pub fn contact_modulus(&self) -> f64 {
        0.5 * self.grains.young_modulus / (1.0 - self.poisson_ratio * self.poisson_ratio)
    }
}
