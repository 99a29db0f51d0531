//! Paths of strain in periodic boxes, on which models are fitted and judged, and errors along them.

use crate::dataset::ConductivityKind;
use serde::Serialize;

/// A state of a packing. Stresses are reduced by E and the present mean radius, compression positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// η, overlaps counted once [-].
    pub porosity: f64,
    /// φ_s: sum of the grains' areas over the area [-].
    pub solid: f64,
    /// σ̃_xx, σ̃_yy, σ̃_xy.
    pub stress: [f64; 3],
    /// K_xx/k, K_yy/k, K_xy/k: affine, and of the network; the latter is none when the database lacks it.
    pub affine: [f64; 3],
    pub network: Option<[f64; 3]>,
    /// F_xx − F_yy and 2 F_xy; none when the database lacks F_xy.
    pub fabric_index: f64,
    pub fabric_shear: Option<f64>,
    /// False without force chains.
    pub load_bearing: bool,
}

impl Point {
    /// K/k of a kind.
    pub fn conductivity(&self, kind: ConductivityKind) -> Option<[f64; 3]> {
        match kind {
            ConductivityKind::Affine => Some(self.affine),
            ConductivityKind::Network => self.network,
        }
    }

    /// p̃, q̃₁, q̃₂.
    pub fn invariants(&self) -> [f64; 3] {
        let [xx, yy, xy] = self.stress;
        [0.5 * (xx + yy), 0.5 * (xx - yy), xy]
    }
}

/// An increment from an earlier state of the track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Number of the state from which it starts: 0 is the packing, k + 1 the state after step k.
    pub from: usize,
    /// Growth of the radii, then xx, yy and 2 xy of the box; extension positive.
    pub strain: [f64; 4],
    /// The state after it.
    pub to: Point,
    /// Whether it is a small strain of a copy, of which only the difference counts.
    pub probe: bool,
}

/// A packing and what was done with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    pub packing: i64,
    pub name: String,
    /// Number of grains.
    pub discs: usize,
    pub packed: Point,
    pub steps: Vec<Step>,
}

impl Track {
    /// The state number `k`, see [`Step::from`].
    pub fn point(&self, k: usize) -> &Point {
        if k == 0 { &self.packed } else { &self.steps[k - 1].to }
    }

    /// Mean p̃ of the states that carry load.
    pub fn pressure(&self) -> f64 {
        let all = std::iter::once(&self.packed).chain(self.steps.iter().map(|step| &step.to));
        let (mut sum, mut count) = (0.0, 0.0);
        for point in all.filter(|point| point.load_bearing) {
            sum += point.invariants()[0];
            count += 1.0;
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }
}

/// Errors along the paths of one kind, root mean squares over all states but probes: p and q over the mean pressure of the
/// path, K over its mean.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PathErrors {
    pub name: String,
    /// Number of grains in the boxes.
    pub discs: usize,
    pub paths: usize,
    pub states: usize,
    pub pressure: f64,
    /// Of both components of the deviator together.
    pub deviator: f64,
    pub conductivity: f64,
    /// Of (K_xx − K_yy, 2 K_xy)/(K_xx + K_yy), both components together, absolute.
    pub anisotropy: f64,
    /// Absolute.
    pub porosity: f64,
    /// Absolute.
    pub fabric_index: f64,
}

/// Errors of small strains that were tried on copies of the boxes (probes): the stress that they add, over the strain, compared with that
/// of the discs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProbeErrors {
    /// Size of the strains.
    pub size: f64,
    /// Number of grains in the boxes.
    pub discs: usize,
    pub probes: usize,
    /// Root mean square error of the stiffnesses xx by xx, yy by xx, xx by yy, yy by yy and xy by xy, over the mean of the
    /// discs' xx by xx and yy by yy.
    pub tangent: f64,
    /// Mean stiffness xx by xx and yy by yy, over the discs', less 1.
    pub normal: f64,
    /// Mean stiffness xy by xy, over the discs', less 1.
    pub shear: f64,
}
