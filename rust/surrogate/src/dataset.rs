//! States of the RVE database as training samples.

use crate::SurrogateError;
use crate::network::{INPUTS, OUTPUTS};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// One state of one packing on one ramp. The packed state is stop 0 of the ramps that start from it.
#[derive(Clone, Debug, PartialEq)]
pub struct StateRow {
    /// Index of the packing in the plan.
    pub packing: i64,
    /// "up" (expansion) or "down" (contraction).
    pub ramp: String,
    /// Place on the ramp, 0 = packed.
    pub stop: i64,
    /// Radial strain relative to the packed state [-].
    pub strain: f64,
    /// η, overlaps counted once [-].
    pub porosity: f64,
    /// f = F_xx − F_yy [-].
    pub fabric_index: f64,
    /// K_xx / k [-].
    pub conductivity_xx: f64,
    /// K_yy / k [-].
    pub conductivity_yy: f64,
    /// K_xx/k, K_yy/k with the contact network solved for the disc temperatures; none when the database does not have
    /// it.
    pub conductivity_network: Option<[f64; 2]>,
    /// σ_xx ℓ / (E r̄) [-], ℓ = 1 m, r̄ the current mean radius, compression positive.
    pub stress_xx: f64,
    /// σ_yy ℓ / (E r̄) [-].
    pub stress_yy: f64,
    /// 1 − sum of grain areas over area [-].
    pub porosity_sum_of_areas: f64,
    /// False after unjamming: without force chains the fabric index is only noise.
    pub load_bearing: bool,
}

impl StateRow {
    fn check(&self) -> Result<(), SurrogateError> {
        let values = [
            ("strain", self.strain, -0.9, 1.0),
            ("porosity", self.porosity, 0.0, 1.0),
            ("fabric_index", self.fabric_index, -1.0, 1.0),
            ("conductivity_xx", self.conductivity_xx, -1e3, 1e3),
            ("conductivity_yy", self.conductivity_yy, -1e3, 1e3),
            ("stress_xx", self.stress_xx, -1e3, 1e3),
            ("stress_yy", self.stress_yy, -1e3, 1e3),
            ("porosity_sum_of_areas", self.porosity_sum_of_areas, -1.0, 1.0),
        ];
        match values.iter().find(|(_, value, low, high)| !(low..=high).contains(&value)) {
            None => Ok(()),
            Some((key, value, low, high)) => Err(SurrogateError::Data(format!(
                "packing {}, ramp {}, stop {}: {key} = {value:?}, allowed: {low} to {high}",
                self.packing, self.ramp, self.stop
            ))),
        }
    }
}

/// Two estimates of a state's conductivity from its contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ConductivityKind {
    /// Temperatures of all discs from the mean gradient: Eq. 9, an upper bound.
    Affine,
    /// Temperatures of the discs solved for on the contact network.
    Network,
}

impl ConductivityKind {
    /// Name in model files and descriptions.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Affine => "affine",
            Self::Network => "network",
        }
    }

    /// K_xx/k, K_yy/k of a row; `None` when the database lacks this kind.
    pub fn of(self, row: &StateRow) -> Option<[f64; 2]> {
        match self {
            Self::Affine => Some([row.conductivity_xx, row.conductivity_yy]),
            Self::Network => row.conductivity_network,
        }
    }
}

/// The states of one ramp, in the order of its stops.
#[derive(Clone, Debug)]
pub struct Ramp {
    pub packing: i64,
    pub name: String,
    pub states: Vec<StateRow>,
}

/// Sorts rows into ramps, in order of packing and ramp name.
///
/// # Errors
/// [`SurrogateError::Data`] for a value that is not finite or out of range, or a stop that occurs twice.
pub fn ramps(rows: &[StateRow]) -> Result<Vec<Ramp>, SurrogateError> {
    let mut groups: BTreeMap<(i64, &str), BTreeMap<i64, &StateRow>> = BTreeMap::new();
    for row in rows {
        row.check()?;
        if groups.entry((row.packing, &row.ramp)).or_default().insert(row.stop, row).is_some() {
            let (packing, ramp, stop) = (row.packing, &row.ramp, row.stop);
            let text = format!("packing {packing}, ramp {ramp}, stop {stop} occurs twice");
            return Err(SurrogateError::Data(text));
        }
    }
    let ramp = |((packing, name), states): ((i64, &str), BTreeMap<i64, &StateRow>)| Ramp {
        packing,
        name: name.to_string(),
        states: states.into_values().cloned().collect(),
    };
    Ok(groups.into_iter().map(ramp).collect())
}

/// Radial strain that leads from one state of a ramp to another, relative to the first one's radii [-].
pub fn strain_between(from: &StateRow, to: &StateRow) -> f64 {
    (1.0 + to.strain) / (1.0 + from.strain) - 1.0
}

/// One evaluation of Φ with the result that the database gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// η, f of the state before; ε.
    pub inputs: [f64; INPUTS],
    /// Δη, Δf; K_xx, K_yy (over k), σ_xx, σ_yy (dimensionless) of the state after.
    pub outputs: [f64; OUTPUTS],
    /// Whether Δf is meaningful: both states carry load.
    pub fabric_known: bool,
}

impl Sample {
    fn between(from: &StateRow, to: &StateRow) -> Self {
        let delta_porosity = to.porosity - from.porosity;
        let delta_fabric_index = to.fabric_index - from.fabric_index;
        let [kxx, kyy] = [to.conductivity_xx, to.conductivity_yy];
        Self {
            inputs: [from.porosity, from.fabric_index, strain_between(from, to)],
            outputs: [delta_porosity, delta_fabric_index, kxx, kyy, to.stress_xx, to.stress_yy],
            fabric_known: from.load_bearing && to.load_bearing,
        }
    }

    /// The same RVE turned by 90° (section 2.5).
    pub fn mirrored(&self) -> Self {
        let [porosity, fabric_index, strain] = self.inputs;
        let [delta_porosity, delta_fabric_index, kxx, kyy, sxx, syy] = self.outputs;
        Self {
            inputs: [porosity, -fabric_index, strain],
            outputs: [delta_porosity, -delta_fabric_index, kyy, kxx, syy, sxx],
            fabric_known: self.fabric_known,
        }
    }
}

impl Ramp {
    /// Every pair of stops in outward order, including each stop with itself (zero strain), and the mirror image of
    /// each pair.
    pub fn samples(&self) -> impl Iterator<Item = Sample> + '_ {
        let pairs = self.states.iter().enumerate();
        let pairs = pairs.flat_map(|(i, from)| self.states[i..].iter().map(move |to| (from, to)));
        pairs.map(|(from, to)| Sample::between(from, to)).flat_map(|sample| [sample, sample.mirrored()])
    }
}

/// Number of packings among the ramps.
pub fn packings(ramps: &[Ramp]) -> usize {
    ramps.iter().map(|ramp| ramp.packing).collect::<BTreeSet<_>>().len()
}

/// Ramps for training, for validation (they decide when the training stops), and for testing.
#[derive(Clone, Debug)]
pub struct Split {
    pub training: Vec<Ramp>,
    pub validation: Vec<Ramp>,
    pub test: Vec<Ramp>,
}

/// Shares of validation and test packings (section 3.1.2).
const HELD_SHARE: f64 = 0.15;

/// Puts the items into a random order (Fisher and Yates).
pub(crate) fn shuffle<T>(items: &mut [T], seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for last in (1..items.len()).rev() {
        // The bias of the remainder is below 1e-15.
        items.swap(last, (random.next_u64() % (last as u64 + 1)) as usize);
    }
}

/// Packings for training, validation and test.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PackingSplit {
    pub validation: BTreeSet<i64>,
    pub test: BTreeSet<i64>,
}

/// Splits by packing, not by sample: samples of one packing resemble each other, so a random split of samples would
/// give too good scores. Packings may occur several times.
///
/// # Errors
/// [`SurrogateError::Data`] for fewer than three packings.
pub fn split_packings(
    packings: impl Iterator<Item = i64>,
    seed: u64,
) -> Result<PackingSplit, SurrogateError> {
    let packings: BTreeSet<i64> = packings.collect();
    let mut order: Vec<i64> = packings.into_iter().collect();
    if order.len() < 3 {
        let text = format!("{} packings; the split by packing needs 3 or more", order.len());
        return Err(SurrogateError::Data(text));
    }
    shuffle(&mut order, seed);
    let held = ((order.len() as f64 * HELD_SHARE).round() as usize).max(1);
    let (test, rest) = order.split_at(held);
    let (validation, _) = rest.split_at(held);
    Ok(PackingSplit {
        validation: validation.iter().copied().collect(),
        test: test.iter().copied().collect(),
    })
}

impl PackingSplit {
    /// The ramps of each part.
    pub fn of(&self, ramps: Vec<Ramp>) -> Split {
        let mut split = Split { training: Vec::new(), validation: Vec::new(), test: Vec::new() };
        for ramp in ramps {
            let part = match ramp.packing {
                packing if self.test.contains(&packing) => &mut split.test,
                packing if self.validation.contains(&packing) => &mut split.validation,
                _ => &mut split.training,
            };
            part.push(ramp);
        }
        split
    }
}

/// The split of these ramps alone.
///
/// # Errors
/// [`SurrogateError::Data`] for fewer than three packings.
pub fn split(ramps: Vec<Ramp>, seed: u64) -> Result<Split, SurrogateError> {
    Ok(split_packings(ramps.iter().map(|ramp| ramp.packing), seed)?.of(ramps))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    #[test]
    fn a_ramp_gives_all_outward_pairs_and_their_mirror_images() {
        let ramps = ramps(&synthetic::rows(4, 3)).expect("good rows");
        assert_eq!(ramps.len(), 8);
        let samples: Vec<Sample> = ramps[0].samples().collect();
        assert_eq!(samples.len(), 2 * (4 * 5 / 2)); // packed and 3 stops
        assert_eq!(samples.iter().filter(|s| s.inputs[2] == 0.0).count(), 8);
        assert!(
            samples.iter().filter(|s| s.inputs[2] == 0.0).all(|s| s.outputs[0] == 0.0 && s.outputs[1] == 0.0)
        );
        assert_eq!(samples[1], samples[0].mirrored());
        assert_eq!(samples[0].mirrored().mirrored(), samples[0]);
        let (from, to) = (&ramps[0].states[1], &ramps[0].states[3]);
        assert!(((1.0 + from.strain) * (1.0 + strain_between(from, to)) - (1.0 + to.strain)).abs() < 1e-15);
    }

    #[test]
    fn split_keeps_packings_whole() {
        let all = ramps(&synthetic::rows(40, 2)).expect("good rows");
        let parts = split(all.clone(), 5).expect("enough packings");
        let packings = |ramps: &[Ramp]| ramps.iter().map(|r| r.packing).collect::<BTreeSet<_>>();
        let (a, b, c) = (packings(&parts.training), packings(&parts.validation), packings(&parts.test));
        assert_eq!((a.len(), b.len(), c.len()), (28, 6, 6));
        assert!(a.is_disjoint(&b) && a.is_disjoint(&c) && b.is_disjoint(&c));
        assert_eq!(packings(&split(all.clone(), 5).expect("same").test), c);
        assert_ne!(packings(&split(all, 6).expect("other seed").test), c);
    }

    #[test]
    fn bad_rows_are_named() {
        let mut rows = synthetic::rows(3, 2);
        rows[4].stress_yy = f64::NAN;
        let message = ramps(&rows).expect_err("NaN").to_string();
        assert!(message.contains("stress_yy = NaN") && message.contains("stop"), "{message}");
        rows[4].stress_yy = 1e300;
        assert!(ramps(&rows).expect_err("huge").to_string().contains("stress_yy = 1e300, allowed"));
        let mut rows = synthetic::rows(3, 2);
        rows.push(rows[0].clone());
        assert!(ramps(&rows).expect_err("twice").to_string().contains("twice"));
        let two = ramps(&synthetic::rows(2, 2)).expect("good rows");
        assert!(split(two, 0).expect_err("few").to_string().contains("2 packings"));
    }
}
