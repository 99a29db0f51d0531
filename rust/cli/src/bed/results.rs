//! What `msdd bed run` computes.

use crate::error::CliError;
use crate::progress::Progress;
use msdd_beds::bed::{Bed, Heated, PlateKind, prepare};
use msdd_beds::case::{BedCase, CaseError};
use msdd_beds::experiment::{self, Measured, Misfit};
use msdd_beds::profile::Slab;
use std::path::Path;

/// Slabs for which averages are told, by their distance from the plate [m], over the diameter of a grain.
const SLABS: [[f64; 2]; 3] = [[2.5, 10.0], [7.0, 14.5], [11.5, 19.0]];

/// A run with one way to take the plate, and what it differs by from the measurements.
pub struct Compared {
    pub heated: Heated,
    pub misfits: Vec<Misfit>,
}

/// A run with one value changed.
pub struct Varied {
    pub key: String,
    pub value: String,
    pub kind: PlateKind,
    pub misfit: Misfit,
}

/// All that a run has found.
pub struct Results {
    pub case: BedCase,
    pub bed: Bed,
    pub measured: Vec<Measured>,
    pub slabs: Vec<([f64; 2], Slab)>,
    pub compared: Vec<Compared>,
    pub varied: Vec<Varied>,
}

/// Prepares the bed and heats it in both ways, and with each value of `vary`.
pub fn compute(
    folder: &Path,
    case: BedCase,
    measured: Vec<Measured>,
    threads: usize,
) -> Result<Results, CliError> {
    let varied: Vec<(String, BedCase)> = (case.vary.iter())
        .map(|vary| Ok((format!("{}", vary.value), case.varied(folder, vary)?)))
        .collect::<Result<_, CaseError>>()?;
    let handled = [Some("pour"), case.lid.as_ref().map(|_| "lid"), case.turn.as_ref().map(|_| "turn")];
    let handled = handled.into_iter().chain([case.plate.pressure.map(|_| "plate")]).flatten();
    let handled: Vec<&str> = handled.collect();
    let kinds = PlateKind::ALL.len();
    let total = 100 * (handled.len() + kinds * (1 + varied.len())) as u64;
    let mut progress = Progress::new("bed", total);
    let mut show = |stage: usize, share: f64, note: &str| {
        progress.set((100.0 * (stage as f64 + share.min(0.99))) as u64, total, note);
    };
    let bed = prepare(&case, threads, |stage, share| {
        show(handled.iter().position(|name| *name == stage).unwrap_or_default(), share, stage);
    })?;
    let mut stage = handled.len();
    let mut heat = |case: &BedCase, kind: PlateKind| {
        let heated = bed.heat(case, kind, |share| show(stage, share, "heat"));
        stage += 1;
        heated
    };
    let mut compared = Vec::new();
    for kind in PlateKind::ALL {
        let heated = heat(&case, kind)?;
        let misfits = experiment::misfits(&measured, &heated.records);
        compared.push(Compared { heated, misfits });
    }
    let mut changed = Vec::new();
    for (vary, (value, case)) in case.vary.iter().zip(&varied) {
        for kind in PlateKind::ALL {
            let heated = heat(case, kind)?;
            if let Some(&misfit) = experiment::misfits(&measured, &heated.records).last() {
                changed.push(Varied { key: vary.key.clone(), value: value.clone(), kind, misfit });
            }
        }
    }
    progress.finish();
    let slabs = SLABS.map(|slab| slab.map(|d| d * case.grains.diameter));
    let slabs = slabs.into_iter().filter_map(|between| Some((between, bed.slab(&case, between)?))).collect();
    Ok(Results { case, bed, measured, slabs, compared, varied: changed })
}
