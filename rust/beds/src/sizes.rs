//! Diameters of spheres of unequal size.
//!
//! The diameter of such a bed is its Sauter mean d₃₂ = Σ d³/Σ d², that of equal spheres with the same surface per volume. Diameters are
//! the quantiles of a distribution, so that every bed of as many spheres has the same ones, at other places.

use msdd_engine::message::{number, range};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Largest over smallest diameter, at most: the search for pairs takes cells of the largest sphere.
pub const MAX_RATIO: f64 = 4.0;
/// Standard deviations at which normal and log-normal distributions are cut.
const CUT: f64 = 2.0;
/// Standard deviation over the mean before the cut, which keeps the ratio.
const NORMAL: [f64; 2] = [1e-3, 0.3];
const LOG_NORMAL: [f64; 2] = [1e-3, 0.35];
/// Bisections for a quantile of the normal distribution, and rows of a sieve table.
const HALVINGS: u32 = 52;
const ROWS: [usize; 2] = [2, 100];

/// A distribution of diameters. Those of `uniform` and `sieve` have any unit: only their ratios count.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Sizes {
    /// As many of each diameter between the least and the largest.
    Uniform([f64; 2]),
    /// Standard deviation over the mean, by number, before it is cut at two standard deviations.
    Normal(f64),
    /// The same of diameters whose logarithm is normal.
    LogNormal(f64),
    /// Rows of an opening and the share of the mass that passes it, from 0 to 1. Between two rows the mass is even over the diameter;
    /// two rows of one opening are spheres of that diameter.
    Sieve(Vec<[f64; 2]>),
}

/// Moments of diameters, over the Sauter mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// By number.
    pub mean: f64,
    /// Standard deviation over the mean, both weighted by the surface: √(d₄₃/d₃₂ − 1).
    pub spread: f64,
    pub smallest: f64,
    pub largest: f64,
    /// Mean volume over that of a sphere of the Sauter mean.
    pub volume: f64,
    /// The Sauter mean in the unit of the distribution.
    pub sauter: f64,
}

impl Moments {
    /// Of equal spheres: what is multiplied by these keeps its bytes.
    pub const EQUAL: Self =
        Self { mean: 1.0, spread: 0.0, smallest: 1.0, largest: 1.0, volume: 1.0, sauter: 1.0 };

    /// Of so many spheres.
    pub fn new(sizes: Option<&Sizes>, count: usize) -> Self {
        sizes.map_or(Self::EQUAL, |sizes| sizes.moments(count))
    }
}

impl fmt::Display for Moments {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(
            out,
            "diameters from {:.3} to {:.3} of their Sauter mean, which is {:.4} in the unit of the distribution; sizeSpread {:.3}",
            self.smallest, self.largest, self.sauter, self.spread
        )
    }
}

/// A distribution that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{value}, allowed: {allowed}")]
pub struct SizesError {
    pub value: String,
    pub allowed: String,
}

impl Sizes {
    /// Refuses what is no distribution, or wider than 1:4.
    ///
    /// # Errors
    /// The value, and what is allowed.
    pub fn check(&self) -> Result<(), SizesError> {
        let wrong = |value: String, allowed: &str| Err(SizesError { value, allowed: allowed.to_string() });
        let inside = |name: &str, value: f64, [least, most]: [f64; 2]| match (least..=most).contains(&value) {
            true => Ok(()),
            false => wrong(format!("{name} {}", number(value)), &range([least, most])),
        };
        let positive = |d: f64| (1e-12..=1e12).contains(&d);
        let [least, most] = match self {
            Self::Normal(spread) => return inside("normal", *spread, NORMAL),
            Self::LogNormal(spread) => return inside("log_normal", *spread, LOG_NORMAL),
            Self::Uniform([least, most]) if positive(*least) && positive(*most) && least <= most => {
                [*least, *most]
            }
            Self::Uniform(ends) => return wrong(format!("uniform {ends:?}"), "two rising diameters"),
            Self::Sieve(rows) => {
                let rising = |k: usize| rows.windows(2).all(|pair| pair[0][k] <= pair[1][k]);
                let ends = rows.first().zip(rows.last()).map(|(first, last)| [first[1], last[1]]);
                let whole = (ROWS[0]..=ROWS[1]).contains(&rows.len()) && ends == Some([0.0, 1.0]);
                if !(whole && rising(0) && rising(1) && rows.iter().all(|row| positive(row[0]))) {
                    let allowed = "2 to 100 rows of a diameter and the share of the mass below it, both rising, the share from 0 to 1";
                    return wrong(format!("sieve {rows:?}"), allowed);
                }
                let filled = rows.windows(2).filter(|pair| pair[1][1] > pair[0][1]);
                filled.fold([f64::INFINITY, 0.0], |[low, high], pair| {
                    [pair[0][0].min(low), pair[1][0].max(high)]
                })
            }
        };
        match most <= MAX_RATIO * least {
            true => Ok(()),
            false => wrong(format!("diameters from {} to {}", number(least), number(most)), "up to 1:4"),
        }
    }

    /// So many diameters in the unit of the distribution, the largest first.
    fn own(&self, count: usize) -> Vec<f64> {
        let share = |k: usize| 1.0 - (k as f64 + 0.5) / count as f64;
        match self {
            Self::Uniform([least, most]) => (0..count).map(|k| least + share(k) * (most - least)).collect(),
            Self::Normal(spread) => (0..count).map(|k| 1.0 + spread * normal(share(k))).collect(),
            Self::LogNormal(spread) => {
                let width = libm::log1p(spread * spread).sqrt();
                (0..count).map(|k| libm::exp(width * normal(share(k)))).collect()
            }
            Self::Sieve(rows) => {
                let classes: Vec<Class> = rows.windows(2).filter_map(Class::new).collect();
                let all: f64 = classes.iter().map(|class| class.number).sum();
                (0..count).map(|k| Class::quantile(&classes, share(k) * all)).collect()
            }
        }
    }

    /// The log-normal distribution with this [`Moments::spread`], or the widest one.
    pub fn of_spread(spread: f64) -> Self {
        const COUNT: usize = 1000;
        let [mut low, mut high] = LOG_NORMAL;
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if Self::LogNormal(middle).moments(COUNT).spread < spread { low = middle } else { high = middle }
        }
        Self::LogNormal(high)
    }

    /// So many diameters over their Sauter mean, the largest first.
    pub fn diameters(&self, count: usize) -> Vec<f64> {
        let own = self.own(count);
        let sauter = sauter(&own);
        own.into_iter().map(|d| d / sauter).collect()
    }

    fn moments(&self, count: usize) -> Moments {
        let own = self.own(count);
        let (sauter, n) = (sauter(&own), count as f64);
        let sum = |of: &dyn Fn(f64) -> f64| own.iter().map(|d| of(d / sauter)).sum::<f64>();
        let mean = sum(&|d| d) / n;
        Moments {
            mean,
            spread: (sum(&|d| d * d * (d - 1.0) * (d - 1.0)) / sum(&|d| d * d)).sqrt(),
            smallest: own.last().map_or(f64::NAN, |d| d / sauter),
            largest: own.first().map_or(f64::NAN, |d| d / sauter),
            volume: sum(&|d| d * d * d) / n,
            sauter,
        }
    }
}

impl std::str::FromStr for Sizes {
    type Err = String;

    /// From a line of TOML, checked.
    fn from_str(text: &str) -> Result<Self, String> {
        let sizes: Self = toml::from_str(text).map_err(|error| error.message().to_string())?;
        sizes.check().map_err(|problem| problem.to_string())?;
        Ok(sizes)
    }
}

/// Largest [`Moments::spread`] for which the law of equal spheres serves. Mixtures of two sizes have more: 1:2 with a fifth of the mass in
/// small spheres 0.28, with half 0.35.
pub const MAX_SPREAD: f64 = 0.25;
/// By how much unequal spheres pack denser, and by how much more their gas conducts than in equal ones of that lower φ, both over the
/// square of the spread. Fitted to packings with frictions of 0.1 to 0.5 (`sizes states` of the examples of msdd-rve).
const DENSER: f64 = 0.62;
const MORE_GAS: f64 = 1.0;
/// By how many contacts per sphere a bed of equal spheres has more than a poured one of unequal spheres that conducts and is stressed
/// equally, over the square of the spread: small spheres rest without load in gaps between others. Fitted to a bed with a spread of 0.19.
const MORE_CONTACTS: f64 = 5.4;

/// φ over that of unequal spheres of the packing of equal ones that carries stress and conducts by contacts equally.
pub fn equal_density(spread: f64) -> f64 {
    1.0 - DENSER * spread * spread
}

/// Contacts per sphere of equal spheres less those that are counted in a poured bed of unequal ones.
pub fn more_contacts(spread: f64) -> f64 {
    MORE_CONTACTS * spread * spread
}

/// Conductivity by gas over that of this packing, with the Sauter mean.
pub fn gas_factor(spread: f64) -> f64 {
    1.0 + MORE_GAS * spread * spread
}

/// Radii \[m\] of so many spheres of a Sauter mean \[m\], the largest first; equal without sizes.
pub fn radii(sizes: Option<&Sizes>, count: usize, diameter: f64) -> Vec<f64> {
    let radius = 0.5 * diameter;
    match sizes {
        None => vec![radius; count],
        Some(sizes) => sizes.diameters(count).into_iter().map(|d| radius * d).collect(),
    }
}

/// Σ d³/Σ d².
pub fn sauter(diameters: &[f64]) -> f64 {
    let (cubes, squares) = diameters.iter().fold((0.0, 0.0), |(c, s), d| (c + d * d * d, s + d * d));
    cubes / squares
}

/// Spheres between two openings.
struct Class {
    from: f64,
    to: f64,
    /// Spheres, up to a factor that is common to all classes.
    number: f64,
}

impl Class {
    fn new(rows: &[[f64; 2]]) -> Option<Self> {
        let ([from, below], [to, passes]) = (rows[0], rows[1]);
        // ∫ dd/d³ over to − from.
        let per_mass = 0.5 * (from + to) / (from * from * to * to);
        (passes > below).then_some(Self { from, to, number: (passes - below) * per_mass })
    }

    /// The diameter below which there are so many spheres.
    fn quantile(classes: &[Self], mut number: f64) -> f64 {
        for class in classes {
            if number <= class.number {
                let [a, b] = [class.from, class.to].map(|d| 1.0 / (d * d));
                return 1.0 / (a - number / class.number * (a - b)).sqrt();
            }
            number -= class.number;
        }
        classes.last().map_or(f64::NAN, |class| class.to)
    }
}

/// Quantile of the standard normal distribution between −[`CUT`] and [`CUT`].
fn normal(share: f64) -> f64 {
    let cut = libm::erf(CUT * std::f64::consts::FRAC_1_SQRT_2);
    let goal = (2.0 * share - 1.0) * cut;
    let (mut low, mut high) = (-CUT, CUT);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if libm::erf(middle * std::f64::consts::FRAC_1_SQRT_2) < goal { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, wanted: f64, tolerance: f64) {
        assert!((found / wanted - 1.0).abs() < tolerance, "{found}, {wanted}");
    }

    /// Closed moments. Quantiles in the middle of each share miss them by about 1/count².
    #[test]
    fn moments_are_those_of_the_distributions() {
        let uniform = Sizes::Uniform([0.6, 1.4]).moments(1000);
        let [square, cube, fourth] = [1.0 + 0.16 / 3.0, 1.16, 1.32 + 0.0256 / 5.0];
        near(uniform.spread, (fourth * square / (cube * cube) - 1.0f64).sqrt(), 1e-5);
        near(uniform.sauter, (1.0 + 0.16) / (1.0 + 0.16 / 3.0), 1e-5);
        near(uniform.largest / uniform.smallest, 1.4 / 0.6, 2e-3);
        // A normal distribution cut at c has the variance 1 − 2 c φ(c)/erf(c/√2).
        let density = (-0.5 * CUT * CUT).exp() / (2.0 * std::f64::consts::PI).sqrt();
        let left = (1.0 - 2.0 * CUT * density / libm::erf(CUT / 2f64.sqrt())).sqrt();
        near(Sizes::Normal(0.01).moments(20_000).spread, 0.01 * left, 2e-3);
        near(Sizes::LogNormal(0.01).moments(20_000).spread, 0.01 * left, 2e-3);
        near(Sizes::of_spread(0.2).moments(1000).spread, 0.2, 1e-6);
        let wide = Sizes::LogNormal(LOG_NORMAL[1]).moments(10_000);
        assert!(wide.largest / wide.smallest <= MAX_RATIO, "{wide:?}");
    }

    /// A mixture of 1:2 with half of the mass each has eight small spheres for a large one.
    #[test]
    fn a_sieve_table_is_a_distribution_by_mass() {
        let mixture = Sizes::Sieve(vec![[1.0, 0.0], [1.0, 0.5], [2.0, 0.5], [2.0, 1.0]]);
        mixture.check().unwrap();
        let diameters = mixture.diameters(900);
        assert_eq!(diameters.iter().filter(|d| **d > 1.2 * diameters[899]).count(), 100);
        near(mixture.moments(900).sauter, 16.0 / 12.0, 1e-12);
        near(sauter(&diameters), 1.0, 1e-12);
        // Mass that is even over the diameter: d₃₂ = 1/∫ dd/d = 1/ln 2 between 1 and 2.
        let even = Sizes::Sieve(vec![[1.0, 0.0], [2.0, 1.0]]);
        near(even.moments(2000).sauter, 1.0 / 2f64.ln(), 1e-5);
        near(even.moments(2000).mean * even.moments(2000).sauter, 4.0 / 3.0, 1e-5);
    }

    #[test]
    fn what_is_no_distribution_is_refused() {
        for (sizes, text) in [
            (Sizes::Uniform([1.0, 4.1]), "diameters from 1 to 4.1, allowed: up to 1:4"),
            (Sizes::Uniform([1.2, 0.8]), "uniform [1.2, 0.8], allowed: two rising diameters"),
            (Sizes::Normal(0.31), "normal 0.31, allowed: 0.001 to 0.3"),
            (Sizes::LogNormal(f64::NAN), "log_normal NaN, allowed: 0.001 to 0.35"),
            (Sizes::Sieve(vec![[1.0, 0.0], [2.0, 0.9]]), "share from 0 to 1"),
            (Sizes::Sieve(vec![[1.0, 0.0], [5.0, 1.0]]), "up to 1:4"),
        ] {
            let found = sizes.check().unwrap_err().to_string();
            assert!(found.contains(text), "{found}");
        }
        // Empty classes do not count.
        Sizes::Sieve(vec![[0.1, 0.0], [1.0, 0.0], [2.0, 1.0], [9.0, 1.0]]).check().unwrap();
    }
}
