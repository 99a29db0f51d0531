//! What `msdd bed run` computes.

use crate::error::CliError;
use crate::progress::Progress;
use msdd_beds::BedError;
use msdd_beds::bed::{Bed, Heated, PlateKind, prepare};
use msdd_beds::case::{BedCase, Vary};
use msdd_beds::experiment::{self, Measured, Misfit};
use msdd_beds::profile::Slab;

/// Slabs for which averages are reported, by their distance from the plate, over the diameter of a grain.
const SLABS: [[f64; 2]; 3] = [[2.5, 10.0], [7.0, 14.5], [11.5, 19.0]];

/// Those of [`SLABS`] that the bed reaches through; else its middle half [m].
fn slabs(bed: &Bed, diameter: f64) -> Vec<[f64; 2]> {
    let wall = bed.wall();
    let depth = bed.simulation.spheres.iter().map(|s| wall.distance(s.position) + s.radius);
    let depth = depth.fold(0.0, f64::max);
    let slabs = SLABS.map(|slab| slab.map(|d| d * diameter));
    let inside: Vec<_> = slabs.into_iter().filter(|slab| slab[1] < depth - 2.0 * diameter).collect();
    if inside.is_empty() { vec![[0.25 * depth, 0.75 * depth]] } else { inside }
}

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

/// Stages of handling a bed.
fn stages(case: &BedCase) -> Vec<&'static str> {
    let (lid, turn) = (case.lid.as_ref().map(|_| "lid"), case.turn.as_ref().map(|_| "turn"));
    [Some("pour"), lid, turn, case.plate().pressure.map(|_| "plate")].into_iter().flatten().collect()
}

/// Progress over all beds and runs.
struct Course {
    progress: Progress,
    total: u64,
    done: usize,
}

impl Course {
    fn show(&mut self, ahead: usize, share: f64, note: &str) {
        let stage = (self.done + ahead) as f64 + share.min(0.99);
        self.progress.set((100.0 * stage) as u64, self.total, note);
    }

    fn prepare(&mut self, case: &BedCase, threads: usize) -> Result<Bed, BedError> {
        let stages = stages(case);
        let bed = prepare(case, threads, |stage, share| {
            self.show(stages.iter().position(|name| *name == stage).unwrap_or_default(), share, stage);
        })?;
        self.done += stages.len();
        Ok(bed)
    }

    fn heat(&mut self, bed: &Bed, case: &BedCase, kind: PlateKind) -> Result<Heated, BedError> {
        let heated = bed.heat(case, kind, |share| self.show(0, share, "heat"))?;
        self.done += 1;
        Ok(heated)
    }
}

/// Prepares the bed and heats it in both ways; and each bed with one value changed of `vary`. `save` receives the results, first without
/// and then after each of these. A failure in a bed is reported through `failed`.
pub fn compute(
    case: BedCase,
    vary: Vec<(Vary, BedCase)>,
    measured: Vec<Measured>,
    threads: usize,
    failed: impl Fn(BedError) -> CliError + Copy,
    mut save: impl FnMut(&Results) -> Result<(), CliError>,
) -> Result<Results, CliError> {
    let kinds = PlateKind::ALL.len();
    let again = vary.iter().filter(|(vary, _)| vary.changes_packing());
    let handled = stages(&case).len() + again.map(|(_, case)| stages(case).len()).sum::<usize>();
    let total = 100 * (handled + kinds * (1 + vary.len())) as u64;
    let mut course = Course { progress: Progress::new("bed", total), total, done: 0 };
    let bed = course.prepare(&case, threads).map_err(failed)?;
    let mut compared = Vec::new();
    for kind in PlateKind::ALL {
        let heated = course.heat(&bed, &case, kind).map_err(failed)?;
        let misfits = experiment::misfits(&measured, &heated.records);
        compared.push(Compared { heated, misfits });
    }
    let slabs = slabs(&bed, case.grains.diameter);
    let slabs = slabs.into_iter().filter_map(|between| Some((between, bed.slab(&case, between)?))).collect();
    let mut results = Results { case, bed, measured, slabs, compared, varied: Vec::new() };
    save(&results)?;
    for (vary, case) in &vary {
        let other =
            vary.changes_packing().then(|| course.prepare(case, threads)).transpose().map_err(failed)?;
        for kind in PlateKind::ALL {
            let heated = course.heat(other.as_ref().unwrap_or(&results.bed), case, kind).map_err(failed)?;
            if let Some(&misfit) = experiment::misfits(&results.measured, &heated.records).last() {
                let (key, value) = (vary.key.clone(), vary.value.to_string());
                results.varied.push(Varied { key, value, kind, misfit });
            }
        }
        save(&results)?;
    }
    course.progress.finish();
    Ok(results)
}
