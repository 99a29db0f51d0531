//! Blocks of a plan: which packings to make, and what to do to each.

use super::kind::{Kind, RampName};
use super::paths::Steps;
use crate::{Boundary, Compression, Material};
use serde::{Deserialize, Serialize};

/// Largest strain at which a ramp may stop [-], and largest slip [m].
const LARGEST_STRAIN: f64 = 0.2;
const LARGEST_SLIP: f64 = 1.0;
/// Least strain at which a ramp may stop on its way back [-].
const MIN_RETURN: f64 = -0.2;
/// Friction angles while a box closes.
const ANGLES: &str = "0 <= angle < pi/2 rad";
/// Sizes that an increment of a path and a probe may have [-].
const STEPS: [f64; 2] = [1e-5, 1e-2];
const PROBES: [f64; 2] = [1e-6, 1e-2];

/// Packings of one size: every porosity with every compression and packing friction, `repeats` of each.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Grains in a packing. Allowed: `DISCS`.
    pub discs: usize,
    /// Porosities to pack to: of the whole box, overlaps counted once. Allowed: `POROSITIES`.
    pub porosities: Vec<f64>,
    /// How the boxes close.
    pub compressions: Vec<Compression>,
    /// Friction angles while the box closes; smoother grains pack denser. The material's own is back before the packed state comes
    /// to rest \[rad\]. Allowed: `ANGLES`. Default: the material's alone.
    #[serde(default)]
    pub packing_friction_angles: Vec<f64>,
    /// Packings for each porosity, compression and packing friction. Allowed: 1 or more.
    pub repeats: u32,
    /// Ways through states of a packing. Allowed: see below. Default: those of the kind that start from the packed state.
    #[serde(default)]
    pub ramps: Vec<RampName>,
    /// Sizes of the strain at which a ramp stops and is averaged, growing; of `wall_shear` the slip of the walls \[- or m\].
    /// Allowed: 1e-9 to `LARGEST_STRAIN`; of `wall_shear` 1e-9 to `LARGEST_SLIP`.
    pub stops: Vec<f64>,
    /// Strains at which the ramps `up_down` and `down_up` stop on their way back, falling; 0 is the packed state, and values below
    /// 0 lie beyond it. Allowed: `MIN_RETURN` to below the last stop. Default: the stops backwards, then 0.
    #[serde(default)]
    pub return_stops: Vec<f64>,
    /// What is around a box: rigid `walls`, or a box that repeats itself without end, `periodic`. Not `periodic` in `wall_shear`.
    #[serde(default)]
    pub boundary: Boundary,
    /// Of `wall_shear` only: whether the friction that bottom and top have mobilised while the box closed is taken back before they
    /// slip. Walls that stay while a box closes along them are loaded in both directions, and then seem half as stiff as in a bed
    /// whose walls came along with the grains.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub release_walls: bool,
}

/// Packings of one size, each of which follows paths of strain from its packed state. The boxes are periodic.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathBlock {
    /// Grains in a packing. Allowed: `DISCS`.
    pub discs: usize,
    /// Porosities to pack to: of the whole box, overlaps counted once. Allowed: `POROSITIES`.
    pub porosities: Vec<f64>,
    /// How the boxes close.
    pub compressions: Vec<Compression>,
    /// Friction angles while the box closes; smoother grains pack denser. The material's own is back before the packed state comes
    /// to rest \[rad\]. Allowed: `ANGLES`. Default: the material's alone.
    #[serde(default)]
    pub packing_friction_angles: Vec<f64>,
    /// Packings for each porosity, compression and packing friction. Allowed: 1 or more.
    pub repeats: u32,
    /// Paths that every packing follows, each at most once and from the packed state: the names of paths in the table above.
    /// Allowed: see there.
    pub paths: Vec<RampName>,
    /// Size of an increment h. Allowed: `STEPS`.
    #[serde(default = "usual_step")]
    pub step: f64,
    /// Sizes of strains that are tried on copies of the box, growing: along x, along y and shear, each with either sign.
    /// Allowed: `PROBES`.
    #[serde(default)]
    pub probes: Vec<f64>,
    /// Increments between two states that are probed. The packed state is probed as well, once for all paths: in the first of the
    /// list. `equivalence` is not probed. Allowed: 1 or more.
    #[serde(default = "usual_probe_every")]
    pub probe_every: u32,
}

fn usual_step() -> f64 {
    1e-3
}

fn usual_probe_every() -> u32 {
    20
}

/// What every block says about its packings.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packings<'a> {
    pub discs: usize,
    pub porosities: &'a [f64],
    pub compressions: &'a [Compression],
    pub packing_friction_angles: &'a [f64],
    pub repeats: u32,
    pub boundary: Boundary,
}

impl Packings<'_> {
    /// Number of packings.
    pub fn count(&self) -> u64 {
        let frictions = self.packing_friction_angles.len().max(1);
        let factors = [self.porosities.len(), self.compressions.len(), frictions].map(|count| count as u64);
        factors.into_iter().fold(u64::from(self.repeats), u64::saturating_mul)
    }

    /// Friction angles while the box closes [rad].
    pub fn frictions(&self, material: &Material) -> Vec<f64> {
        match self.packing_friction_angles {
            [] => vec![material.friction_angle],
            list => list.to_vec(),
        }
    }

    fn check(&self) -> Result<(), String> {
        if self.porosities.is_empty() || self.compressions.is_empty() || self.repeats == 0 {
            return Err("porosities, compressions and repeats: at least one of each is needed".into());
        }
        let allowed = 0.0..std::f64::consts::FRAC_PI_2;
        match self.packing_friction_angles.iter().find(|angle| !allowed.contains(*angle)) {
            Some(angle) => Err(format!("packing_friction_angles: {angle}, allowed: {ANGLES}")),
            None => Ok(()),
        }
    }
}

/// A block of any kind.
#[derive(Clone, Copy, Debug)]
pub(super) enum AnyBlock<'a> {
    Ramps(Kind, &'a Block),
    Paths(&'a PathBlock),
}

impl AnyBlock<'_> {
    pub fn kind(&self) -> Kind {
        match self {
            Self::Ramps(kind, _) => *kind,
            Self::Paths(_) => Kind::Paths,
        }
    }

    pub fn packings(&self) -> Packings<'_> {
        macro_rules! of {
            ($block:expr, $boundary:expr) => {
                Packings {
                    discs: $block.discs,
                    porosities: &$block.porosities,
                    compressions: &$block.compressions,
                    packing_friction_angles: &$block.packing_friction_angles,
                    repeats: $block.repeats,
                    boundary: $boundary,
                }
            };
        }
        match self {
            Self::Ramps(_, block) => of!(block, block.boundary),
            Self::Paths(block) => of!(block, Boundary::Periodic),
        }
    }

    /// The error names key, value and allowed range.
    pub fn check(&self) -> Result<(), String> {
        self.packings().check()?;
        match self {
            Self::Ramps(kind, block) => block.check(*kind),
            Self::Paths(block) => block.check(),
        }
    }
}

impl Block {
    /// The ramps of a packing, in the order in which they are made.
    pub(super) fn ramps(&self, kind: Kind) -> &[RampName] {
        if self.ramps.is_empty() { kind.ramps().0 } else { &self.ramps }
    }

    fn check(&self, kind: Kind) -> Result<(), String> {
        let largest = if kind == Kind::WallShear { LARGEST_SLIP } else { LARGEST_STRAIN };
        let inside = self.stops.iter().all(|s| (1e-9..=largest).contains(s));
        if !(inside && self.stops.windows(2).all(|pair| pair[0] < pair[1])) {
            return Err(format!("stops: {:?}, allowed: growing, above 0, at most {largest}", self.stops));
        }
        self.check_returns()?;
        if self.release_walls && kind != Kind::WallShear {
            return Err("release_walls: allowed in [[wall_shear]] only".into());
        }
        if self.boundary == Boundary::Periodic && kind == Kind::WallShear {
            return Err("boundary: periodic: allowed in [[thermal]] and [[mechanics]] only".into());
        }
        self.check_ramps(kind)
    }

    fn check_returns(&self) -> Result<(), String> {
        let turn = self.stops.last().copied().unwrap_or(0.0);
        let falling = self.return_stops.windows(2).all(|pair| pair[0] > pair[1]);
        let inside = self.return_stops.iter().all(|&s| s < turn && s >= MIN_RETURN);
        if falling && inside {
            return Ok(());
        }
        let allowed = format!("falling, below {turn}, at least {MIN_RETURN}");
        Err(format!("return_stops: {:?}, allowed: {allowed}", self.return_stops))
    }

    fn check_ramps(&self, kind: Kind) -> Result<(), String> {
        let (usual, more) = kind.ramps();
        let ramps = self.ramps(kind);
        for (k, ramp) in ramps.iter().enumerate() {
            let problem = |problem| Err(format!("ramps: {ramp}: {problem}"));
            if !(usual.contains(ramp) || more.contains(ramp)) {
                let allowed: Vec<String> = usual.iter().chain(more).map(RampName::to_string).collect();
                return problem(format!("allowed: {}", allowed.join(", ")));
            }
            if *ramp == RampName::Xy && self.boundary != Boundary::Periodic {
                return problem("needs boundary = \"periodic\"".to_string());
            }
            if ramps[..k].contains(ramp) {
                return problem("is named twice".to_string());
            }
            if let Some(first) = ramp.starts_from().filter(|first| !ramps[..k].contains(first)) {
                return problem(format!("{first} must stand before it"));
            }
        }
        Ok(())
    }
}

impl PathBlock {
    pub(super) fn steps(&self) -> Steps {
        Steps { size: self.step, probes: self.probes.clone(), probe_every: self.probe_every as usize }
    }

    fn check(&self) -> Result<(), String> {
        if self.paths.is_empty() {
            return Err("paths: at least one is needed".into());
        }
        for (k, path) in self.paths.iter().enumerate() {
            let problem = |problem| Err(format!("paths: {path}: {problem}"));
            if !path.is_path() {
                return problem(format!(
                    "allowed: {}",
                    RampName::PATHS.map(|path| path.to_string()).join(", ")
                ));
            }
            if self.paths[..k].contains(path) {
                return problem("is named twice".to_string());
            }
        }
        let [least, most] = STEPS;
        if !(least..=most).contains(&self.step) {
            return Err(format!("step: {}, allowed: {least:e} to {most:e}", self.step));
        }
        let [least, most] = PROBES;
        let inside = self.probes.iter().all(|probe| (least..=most).contains(probe));
        if !(inside && self.probes.windows(2).all(|pair| pair[0] < pair[1])) {
            return Err(format!("probes: {:?}, allowed: growing, {least:e} to {most:e}", self.probes));
        }
        if self.probe_every == 0 {
            return Err("probe_every: 0, allowed: at least 1".into());
        }
        Ok(())
    }
}
