//! A plan of packings and ramps: a TOML file with blocks `[[thermal]]`, `[[mechanics]]` and `[[wall_shear]]`.

use super::DatabaseError;
use crate::slide::Slide;
use crate::{Boundary, Compression, Material, PackingSpec, Preparation, Relaxation};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Width over height of the boxes of `[[wall_shear]]`.
const SHEAR_ASPECT: f64 = 2.0;

/// A plan: blocks of packings, each taken through ramps with stops.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Radii are uniform between these [m].
    pub radius_min: f64,
    pub radius_max: f64,
    /// Seed of the whole plan.
    pub seed: u64,
    /// How forces are brought into balance; default: the grains' own damped motion.
    #[serde(default)]
    pub relaxation: Relaxation,
    /// Grain material.
    #[serde(default)]
    pub material: Material,
    /// Thermal ramps: radii grow and shrink in fixed walls.
    #[serde(default)]
    pub thermal: Vec<Block>,
    /// Mechanical ramps: walls close and open in one direction.
    #[serde(default)]
    pub mechanics: Vec<Block>,
    /// Bottom and top of a box twice as wide as high slip along the grains.
    #[serde(default)]
    pub wall_shear: Vec<Block>,
    /// The text that the plan was read from; [`Plan::hash`] is its hash.
    #[serde(skip)]
    pub text: String,
}

/// Packings of one size: every porosity with every compression and packing friction, `repeats` of each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Discs in a packing.
    pub discs: usize,
    /// Target porosities of the packings, whole box, overlaps counted once [-].
    pub porosities: Vec<f64>,
    pub compressions: Vec<Compression>,
    /// Friction angles of the grains while the walls close [rad]; default: the material's alone.
    #[serde(default)]
    pub packing_friction_angles: Vec<f64>,
    /// Packings for each porosity, compression and packing friction.
    pub repeats: u32,
    /// Ramps of each packing; default: `up` and `down`, or `xx` and `yy`, or `wall_shear`, by the kind of the block.
    #[serde(default)]
    pub ramps: Vec<RampName>,
    /// Magnitudes at which a ramp stops, growing: strain [-], or slip [m] of `wall_shear`.
    pub stops: Vec<f64>,
    /// Magnitudes at which the return of `up_down` and `down_up` stops, falling; 0 is the packed strain and negative
    /// values lie beyond it. Default: the stops in reverse order, then 0.
    #[serde(default)]
    pub return_stops: Vec<f64>,
    /// Boundary of the boxes; default: walls. Periodic boxes are averaged over their whole cell.
    #[serde(default)]
    pub boundary: Boundary,
    /// Directions in which the walls of `wall_shear` move; default: same.
    #[serde(default)]
    pub slide: Option<Slide>,
}

/// What is moved in the ramps of a block: radii, walls, or walls along the grains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    #[default]
    Thermal,
    Mechanics,
    WallShear,
}

/// A ramp: a path through states of one packing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RampName {
    /// The packed state itself: stop 0 of every ramp that starts there.
    #[default]
    Packed,
    /// Radii grow.
    Up,
    /// Radii shrink.
    Down,
    /// Back from the last stop of `up`.
    UpDown,
    /// Back from the last stop of `down`.
    DownUp,
    /// x walls close (stops −1, −2, …), and from the packed state again, open (1, 2, …).
    Xx,
    /// As `xx`, with the y walls.
    Yy,
    /// A periodic box is sheared along x, one way (stops −1, −2, …) and, from the packed state again, the other.
    Xy,
    /// Bottom and top move along x.
    WallShear,
}

/// One packing of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// Index in the plan.
    pub packing: i64,
    pub kind: Kind,
    pub spec: PackingSpec,
    pub preparation: Preparation,
    pub ramps: Vec<RampName>,
    /// Magnitudes, growing; see [`Block`].
    pub stops: Vec<f64>,
    pub return_stops: Vec<f64>,
    pub slide: Slide,
}

impl Kind {
    /// The ramps of a block that names none; and the further ramps that a block of this kind may name.
    fn ramps(self) -> (&'static [RampName], &'static [RampName]) {
        match self {
            Self::Thermal => (&[RampName::Up, RampName::Down], &[RampName::UpDown, RampName::DownUp]),
            Self::Mechanics => (&[RampName::Xx, RampName::Yy], &[RampName::Xy]),
            Self::WallShear => (&[RampName::WallShear], &[]),
        }
    }

    /// The name in plans and rows.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Thermal => "thermal",
            Self::Mechanics => "mechanics",
            Self::WallShear => "wall_shear",
        }
    }

    /// Largest stop: strain [-] or slip [m].
    fn largest_stop(self) -> f64 {
        if self == Self::WallShear { 1.0 } else { 0.2 }
    }
}

impl Job {
    /// Every row that the packing has, in order: ramp and stop.
    pub fn rows(&self) -> Vec<(RampName, i64)> {
        let mut rows = vec![(RampName::Packed, 0)];
        for &ramp in &self.ramps {
            rows.extend(self.stops_of(ramp).into_iter().map(|(stop, _)| (ramp, stop)));
        }
        rows
    }

    /// Stops of a ramp: index and signed value.
    pub fn stops_of(&self, ramp: RampName) -> Vec<(i64, f64)> {
        let numbered = |values: &[f64], sign: f64| -> Vec<(i64, f64)> {
            values.iter().zip(1..).map(|(&value, stop)| (stop, sign * value + 0.0)).collect()
        };
        match ramp {
            RampName::Packed => vec![(0, 0.0)],
            RampName::Up | RampName::WallShear => numbered(&self.stops, 1.0),
            RampName::Down => numbered(&self.stops, -1.0),
            RampName::UpDown => numbered(&self.return_stops, 1.0),
            RampName::DownUp => numbered(&self.return_stops, -1.0),
            RampName::Xx | RampName::Yy | RampName::Xy => {
                let closing = numbered(&self.stops, -1.0).into_iter().map(|(stop, strain)| (-stop, strain));
                closing.chain(numbered(&self.stops, 1.0)).collect()
            }
        }
    }
}

/// A plan with more packings is taken as a typing error: it would compute for months.
const MOST_PACKINGS: u64 = 1_000_000;

impl Plan {
    /// Reads a plan. `file` names it in errors.
    pub fn parse(text: &str, file: &str) -> Result<Self, DatabaseError> {
        let problem = |problem: String| DatabaseError::Plan { file: file.to_string(), problem };
        let mut plan: Self = toml::from_str(text).map_err(|error| problem(error.to_string()))?;
        plan.text = text.to_string();
        plan.check().map_err(problem)?;
        Ok(plan)
    }

    /// SHA-256 of the plan's text, hexadecimal.
    pub fn hash(&self) -> String {
        Sha256::digest(self.text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// All blocks with their kind, and their number among the blocks of that kind.
    fn blocks(&self) -> impl Iterator<Item = (Kind, usize, &Block)> {
        let lists = [
            (Kind::Thermal, &self.thermal),
            (Kind::Mechanics, &self.mechanics),
            (Kind::WallShear, &self.wall_shear),
        ];
        lists
            .into_iter()
            .flat_map(|(kind, list)| list.iter().enumerate().map(move |(k, block)| (kind, k + 1, block)))
    }

    fn check(&self) -> Result<(), String> {
        self.material.check().map_err(|error| error.to_string())?;
        for (kind, number, block) in self.blocks() {
            let within = |problem| format!("[[{}]] {number}: {problem}", kind.as_str());
            block.check(kind).map_err(within)?;
        }
        let packings = self.blocks().map(|(_, _, block)| block.packings()).fold(0, u64::saturating_add);
        if packings > MOST_PACKINGS {
            return Err(format!("{packings} packings, allowed: {MOST_PACKINGS}"));
        }
        let jobs = self.jobs();
        if jobs.is_empty() {
            return Err("at least one block of packings is needed".to_string());
        }
        jobs.iter().try_for_each(|job| job.spec.check().map_err(|error| error.to_string()))
    }

    /// The packings, in order of block, porosity, compression, packing friction, repeat.
    pub fn jobs(&self) -> Vec<Job> {
        let mut jobs = Vec::new();
        for (kind, _, block) in self.blocks() {
            for &porosity in &block.porosities {
                for &compression in &block.compressions {
                    for &friction in &block.frictions(&self.material) {
                        for _ in 0..block.repeats {
                            let packing = jobs.len() as u64;
                            jobs.push(self.job(packing, (kind, block), porosity, compression, friction));
                        }
                    }
                }
            }
        }
        jobs
    }

    fn job(
        &self,
        packing: u64,
        (kind, block): (Kind, &Block),
        porosity: f64,
        compression: Compression,
        friction_angle: f64,
    ) -> Job {
        let spec = PackingSpec {
            discs: block.discs,
            seed: packing_seed(self.seed, packing),
            porosity,
            compression,
            radius_min: self.radius_min,
            radius_max: self.radius_max,
            boundary: block.boundary,
            relaxation: self.relaxation,
        };
        let aspect = if kind == Kind::WallShear { SHEAR_ASPECT } else { 1.0 };
        let back = || block.stops.iter().rev().skip(1).copied().chain([0.0]).collect();
        Job {
            packing: packing as i64,
            kind,
            spec,
            preparation: Preparation {
                friction_angle: Some(friction_angle),
                aspect,
                ..Preparation::default()
            },
            ramps: block.ramps(kind).to_vec(),
            stops: block.stops.clone(),
            return_stops: if block.return_stops.is_empty() { back() } else { block.return_stops.clone() },
            slide: block.slide.unwrap_or_default(),
        }
    }

    /// Rows that the plan makes: one for every stop of every packing.
    pub fn rows(&self) -> usize {
        self.jobs().iter().map(|job| job.rows().len()).sum()
    }

    /// Mean of the radius distribution [m].
    pub fn mean_radius(&self) -> f64 {
        0.5 * (self.radius_min + self.radius_max)
    }
}

impl Block {
    /// Number of packings of the block.
    fn packings(&self) -> u64 {
        let frictions = self.packing_friction_angles.len().max(1);
        let factors = [self.porosities.len(), self.compressions.len(), frictions].map(|count| count as u64);
        factors.into_iter().fold(u64::from(self.repeats), u64::saturating_mul)
    }

    fn frictions(&self, material: &Material) -> Vec<f64> {
        match self.packing_friction_angles.as_slice() {
            [] => vec![material.friction_angle],
            list => list.to_vec(),
        }
    }

    fn ramps(&self, kind: Kind) -> &[RampName] {
        if self.ramps.is_empty() { kind.ramps().0 } else { &self.ramps }
    }

    fn check(&self, kind: Kind) -> Result<(), String> {
        if self.porosities.is_empty() || self.compressions.is_empty() || self.repeats == 0 {
            return Err("porosities, compressions and repeats: at least one of each is needed".into());
        }
        if let Some(angle) =
            self.packing_friction_angles.iter().find(|a| !(0.0..std::f64::consts::FRAC_PI_2).contains(*a))
        {
            return Err(format!("packing_friction_angles: {angle}, allowed: 0 <= angle < pi/2 rad"));
        }
        let largest = kind.largest_stop();
        let inside = self.stops.iter().all(|s| (1e-9..=largest).contains(s));
        if !(inside && self.stops.windows(2).all(|pair| pair[0] < pair[1])) {
            return Err(format!("stops: {:?}, allowed: growing, above 0, at most {largest}", self.stops));
        }
        self.check_returns()?;
        if self.slide.is_some() && kind != Kind::WallShear {
            return Err("slide: allowed in [[wall_shear]] only".into());
        }
        if self.boundary == Boundary::Periodic && kind == Kind::WallShear {
            return Err("boundary: periodic: allowed in [[thermal]] and [[mechanics]] only".into());
        }
        self.check_ramps(kind)
    }

    fn check_returns(&self) -> Result<(), String> {
        let turn = self.stops.last().copied().unwrap_or(0.0);
        let falling = self.return_stops.windows(2).all(|pair| pair[0] > pair[1]);
        let inside = self.return_stops.iter().all(|&s| s < turn && s >= -0.2);
        if falling && inside {
            return Ok(());
        }
        Err(format!("return_stops: {:?}, allowed: falling, below {turn}, at least -0.2", self.return_stops))
    }

    fn check_ramps(&self, kind: Kind) -> Result<(), String> {
        let (usual, more) = kind.ramps();
        let ramps = self.ramps(kind);
        for (k, ramp) in ramps.iter().enumerate() {
            let problem = |problem| Err(format!("ramps: {}: {problem}", ramp.as_str()));
            if !(usual.contains(ramp) || more.contains(ramp)) {
                let allowed: Vec<&str> = usual.iter().chain(more).map(|r| r.as_str()).collect();
                return problem(format!("allowed: {}", allowed.join(", ")));
            }
            if *ramp == RampName::Xy && self.boundary != Boundary::Periodic {
                return problem("needs boundary = \"periodic\"".to_string());
            }
            if ramps[..k].contains(ramp) {
                return problem("is named twice".to_string());
            }
            if let Some(first) = ramp.starts_from().filter(|first| !ramps[..k].contains(first)) {
                return problem(format!("{} must stand before it", first.as_str()));
            }
        }
        Ok(())
    }
}

impl RampName {
    /// The ramp from whose last stop this one starts; none when it starts from the packed state.
    pub fn starts_from(self) -> Option<Self> {
        match self {
            Self::UpDown => Some(Self::Up),
            Self::DownUp => Some(Self::Down),
            _ => None,
        }
    }

    /// The name in plans and rows.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Packed => "packed",
            Self::Up => "up",
            Self::Down => "down",
            Self::UpDown => "up_down",
            Self::DownUp => "down_up",
            Self::Xx => "xx",
            Self::Yy => "yy",
            Self::Xy => "xy",
            Self::WallShear => "wall_shear",
        }
    }
}

/// Seed of one packing. It depends on the plan's seed and the index only, not on order or threads. It has 53 bits, so
/// that CSV readers which hold numbers as f64 keep it exactly.
fn packing_seed(plan_seed: u64, packing: u64) -> u64 {
    let mut bytes = plan_seed.to_le_bytes().to_vec();
    bytes.extend(packing.to_le_bytes());
    let digest = Sha256::digest(&bytes);
    let first = digest.iter().take(8).fold(0u64, |value, &byte| value << 8 | u64::from(byte));
    first >> 11
}

#[cfg(test)]
#[path = "plan_tests.rs"]
mod tests;
