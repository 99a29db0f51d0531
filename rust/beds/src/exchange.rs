//! Exchange of heat by radiation between the spheres and walls of a bed, by ray tracing.
//!
//! Surfaces are opaque, grey and diffuse, and each sphere and wall has one temperature. The share s_ij of what body i emits is absorbed by
//! body j, after any reflections between, and heat between both is 4 σ T³ ε_i A_i s_ij (T_i − T_j) for small differences: ε_i A_i s_ij
//! = ε_j A_j s_ji (Modest, Radiative Heat Transfer, 2003, section 20.3). A packing hardly moves, so its shares are traced once.

use crate::random::Random;
use crate::rays::{Body, Enclosure};
use msdd_engine::message::{number, range};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Rays from each sphere below which the noise is told.
pub const FEW_RAYS: usize = 100;

/// ε \[-\] of bodies that emit and absorb. A ray is reflected 1/ε times in the mean, so a smaller one would take for ever.
pub const RADIATING: [f64; 2] = [0.01, 1.0];

/// How many rays are traced, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracing {
    /// Rays from each sphere, 1 to 1 000 000.
    pub rays: usize,
    pub seed: u64,
    /// The result does not depend on it.
    pub threads: usize,
}

/// ε \[-\] of spheres, [`RADIATING`], and of each wall; walls of 0 reflect everything.
#[derive(Clone, Debug, PartialEq)]
pub struct Emissivities {
    pub spheres: f64,
    pub walls: Vec<f64>,
}

impl Emissivities {
    /// What a body absorbs of what meets it \[-\].
    pub fn absorbed(&self, body: Body) -> f64 {
        match body {
            Body::Sphere(_) => self.spheres,
            Body::Wall(wall) => self.walls[wall as usize],
            Body::Open => 1.0,
        }
    }
}

/// A value outside of its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("radiation: {key} = {value}, allowed: {allowed}", value = number(*value))]
pub struct OutOfRange {
    pub key: &'static str,
    pub value: f64,
    pub allowed: String,
}

impl OutOfRange {
    /// The value, if it is allowed.
    pub(crate) fn check(key: &'static str, value: f64, fits: bool, allowed: &str) -> Result<(), Self> {
        if fits { Ok(()) } else { Err(Self { key, value, allowed: allowed.to_string() }) }
    }
}

/// Part of what a body emits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// By which it is absorbed.
    pub body: Body,
    /// Which image of it, in numbers of cells along the edges.
    pub shift: [i32; 3],
    /// \[-\]
    pub share: f64,
}

/// The exchange in a packing.
#[derive(Clone, Debug, PartialEq)]
pub struct Exchange {
    pub emissivities: Emissivities,
    /// A \[m²\] of each sphere.
    pub areas: Vec<f64>,
    /// What each sphere emits, by absorbers in order; they sum to 1.
    pub spheres: Vec<Vec<Share>>,
    rays: usize,
}

/// Traces the rays of all spheres. Bytes do not depend on the number of threads.
///
/// # Errors
/// A number outside its range.
pub fn exchange(
    enclosure: &Enclosure,
    emissivities: &Emissivities,
    tracing: &Tracing,
) -> Result<Exchange, OutOfRange> {
    let radiates = |emissivity: f64| (RADIATING[0]..=RADIATING[1]).contains(&emissivity);
    let spheres = emissivities.spheres;
    OutOfRange::check("emissivity", spheres, radiates(spheres), &range(RADIATING))?;
    let allowed = format!("0 (reflects everything), or {}", range(RADIATING));
    for &emissivity in &emissivities.walls {
        OutOfRange::check(
            "emissivity of a wall",
            emissivity,
            emissivity == 0.0 || radiates(emissivity),
            &allowed,
        )?;
    }
    let walls = enclosure.walls().len();
    let given = emissivities.walls.len();
    OutOfRange::check("walls with an emissivity", given as f64, given == walls, "as many as the bed has")?;
    let rays = tracing.rays;
    OutOfRange::check("rays", rays as f64, (1..=1_000_000).contains(&rays), "1 to 1000000")?;
    let count = enclosure.radii().len();
    let threads = tracing.threads.clamp(1, count.max(1));
    let each = count.div_ceil(threads);
    let mut rows: Vec<Vec<Share>> = vec![Vec::new(); count];
    std::thread::scope(|scope| {
        for (number, part) in rows.chunks_mut(each.max(1)).enumerate() {
            scope.spawn(move || {
                part.iter_mut().enumerate().for_each(|(k, row)| {
                    *row = shares(enclosure, emissivities, tracing, number * each + k);
                });
            });
        }
    });
    let areas = enclosure.radii().iter().map(|r| 4.0 * PI * r * r).collect();
    Ok(Exchange { emissivities: emissivities.clone(), areas, spheres: rows, rays })
}

/// Of one sphere.
fn shares(
    enclosure: &Enclosure,
    emissivities: &Emissivities,
    tracing: &Tracing,
    sphere: usize,
) -> Vec<Share> {
    let mut random = Random::stream(tracing.seed, sphere as u64);
    let mut counts = BTreeMap::new();
    for _ in 0..tracing.rays {
        let start = enclosure.on_sphere(sphere, &mut random);
        let end = enclosure.follow(start, |body| emissivities.absorbed(body), &mut random);
        *counts.entry((end.body, end.shift)).or_insert(0u32) += 1;
    }
    let share = |count: u32| f64::from(count) / tracing.rays as f64;
    counts.into_iter().map(|((body, shift), count)| Share { body, shift, share: share(count) }).collect()
}

impl Exchange {
    /// ε A s \[m²\] between pairs of spheres, the mean of what both found, in order of their numbers.
    pub fn pairs(&self) -> Vec<(usize, usize, f64)> {
        let mut pairs = BTreeMap::new();
        for (i, shares) in self.spheres.iter().enumerate() {
            for share in shares {
                if let Body::Sphere(j) = share.body
                    && j as usize != i
                {
                    let pair = (i.min(j as usize), i.max(j as usize));
                    let half = 0.5 * self.emissivities.spheres * self.areas[i] * share.share;
                    *pairs.entry(pair).or_insert(0.0) += half;
                }
            }
        }
        pairs.into_iter().map(|((i, j), size)| (i, j, size)).collect()
    }

    /// ε A s \[m²\] between the spheres and a wall, by the number of the sphere.
    pub fn at_wall(&self, wall: usize) -> Vec<(usize, f64)> {
        let sum = |shares: &[Share]| {
            let at = shares.iter().filter(|share| share.body == Body::Wall(wall as u32));
            at.map(|share| share.share).sum::<f64>()
        };
        let rows = self.spheres.iter().enumerate().map(|(i, shares)| (i, sum(shares)));
        rows.filter(|(_, share)| *share > 0.0)
            .map(|(i, share)| (i, self.emissivities.spheres * self.areas[i] * share))
            .collect()
    }

    /// Says which noise few rays leave.
    pub fn warning(&self) -> Option<String> {
        (self.rays < FEW_RAYS).then(|| {
            format!(
                "radiation: rays = {}: each share of a sphere has a standard deviation of up to {:.0} % of what the sphere emits; from {FEW_RAYS} \
                 rays on it is at most {:.0} %",
                self.rays,
                50.0 / (self.rays as f64).sqrt(),
                50.0 / (FEW_RAYS as f64).sqrt()
            )
        })
    }
}
