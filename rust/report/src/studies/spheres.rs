//! Beds of spheres: error against cost of the solver compared with DEM, and beds that were measured.

use crate::jobs::execute::Outcome;
use crate::jobs::job::{Job, SpheresJob};
use crate::jobs::pool::{Asked, Records};
use crate::plan;
use crate::settings::Settings;
use crate::{ReportError, parsed, rows};
use msdd_beds::experiment::{self, Measured, Record, misfits};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Kinds of configurations.
pub const FAMILIES: [&str; 4] = ["as shipped", "other cells", "other steps", "grains stay"];
/// The case whose bed was measured.
pub const MEASURED: &str = "steel";
const EXPERIMENT: &str = "cases/beaulieu/experiment.csv";
const ZEHNER: &str = "cases/zehner/prediction.csv";
const BED: &str = "cases/beaulieu";
/// A run of the solver: cost, and how far it is from DEM or measurements.
#[derive(Clone, Debug, Serialize)]
pub struct SphereRun {
    pub case: String,
    pub family: &'static str,
    pub name: String,
    pub core_seconds: Option<f64>,
    /// Root mean square and worst difference by quantity: T in % of its range compared with elements, in K compared with measurements; else
    /// in %.
    pub errors: BTreeMap<String, [f64; 2]>,
    pub outcome: &'static str,
    pub message: String,
}

/// One of Zehner's beds: conductivities over that of the gas.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ZehnerBed {
    pub material: String,
    /// \[K\]
    pub temperature: f64,
    pub measured: f64,
    #[serde(alias = "prediction_rough")]
    prediction: Option<f64>,
    pub correlation: f64,
}

/// Beds of spheres in the report.
#[derive(Clone, Debug, Serialize)]
pub struct Spheres {
    pub runs: Vec<SphereRun>,
    /// DEM compared with the measurements: rms by the way to take the plate \[K\], and the cost of both together.
    pub elements: BTreeMap<String, f64>,
    pub elements_core_seconds: Option<f64>,
    pub zehner: Vec<ZehnerBed>,
    #[serde(skip)]
    pub measured: Vec<Measured>,
    /// T at the probes of the shipped case compared with the measurements.
    #[serde(skip)]
    pub simulated: Vec<Record>,
}

struct Configuration {
    family: &'static str,
    name: String,
    job: SpheresJob,
}

/// A case, and what is changed in it, as `spheres.toml` describes it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CaseVariant {
    case: String,
    /// Arguments of `cases/common/compare-dem`.
    compare: Vec<String>,
    /// Cells of the blocks of its mesh, and the direction in which they are changed.
    blocks: Vec<[usize; 3]>,
    along: usize,
    /// How it steps in time.
    steps: String,
    /// Other ways: text that is added to `system/controlDict` and to `system/fvSolution`.
    others: Vec<[String; 3]>,
    moves: bool,
}

/// The cases of `spheres.toml`; a test reads them.
fn variants() -> Vec<CaseVariant> {
    let mut all: BTreeMap<String, Vec<CaseVariant>> =
        toml::from_str(include_str!("spheres.toml")).unwrap_or_default();
    all.remove("variant").unwrap_or_default()
}

/// Numbers of cells along each changed direction over those of the shipped case.
const CELLS: [f64; 3] = [0.25, 0.5, 2.0];

fn configurations(scene: &CaseVariant, quick: bool) -> Vec<Configuration> {
    let shipped = SpheresJob {
        case: scene.case.clone(),
        mesh: Vec::new(),
        append: BTreeMap::new(),
        compare: scene.compare.clone(),
        limit: 600,
    };
    let add = |texts: &[(&str, &str)]| {
        let append = texts.iter().map(|(file, text)| (file.to_string(), format!("{text}\n")));
        SpheresJob { append: append.collect(), ..shipped.clone() }
    };
    let name = scene.steps.clone();
    let mut list = vec![Configuration { family: FAMILIES[0], name, job: shipped.clone() }];
    let block = |[x, y, z]: [usize; 3]| format!("({x} {y} {z}) simpleGrading");
    for factor in CELLS {
        let along = |k: usize, cells: usize| {
            if scene.along == k { (cells as f64 * factor).round().max(1.0) as usize } else { cells }
        };
        let mesh = scene
            .blocks
            .iter()
            .map(|&cells| (block(cells), block(std::array::from_fn(|k| along(k, cells[k])))));
        let job = SpheresJob { mesh: mesh.collect(), ..shipped.clone() };
        list.push(Configuration {
            family: FAMILIES[1],
            name: format!("{factor} times the cells along the heat"),
            job,
        });
    }
    for [name, control, solution] in &scene.others {
        let job = add(&[("system/controlDict", control.as_str()), ("system/fvSolution", solution.as_str())]);
        list.push(Configuration { family: FAMILIES[2], name: name.to_string(), job });
    }
    if scene.moves {
        let job = add(&[("constant/granularProperties", "mechanics none;")]);
        list.push(Configuration { family: FAMILIES[3], name: "mechanics none".to_string(), job });
    }
    if quick {
        list.truncate(2);
    }
    list
}

/// The bed of [`MEASURED`] by DEM.
fn bed() -> Job {
    let inputs = [BED, "rust/beds/src", "rust/spheres/src", "rust/engine/src", "Cargo.lock"];
    let run = format!("bed run {BED} --threads 1 --out WORK/bed");
    plan::command(&run, &inputs, Some("bed/comparison.csv"), 900)
}

/// Jobs whose cost is shown.
pub fn jobs(quick: bool) -> Vec<Asked> {
    let of = |scene| configurations(scene, quick).into_iter();
    let solver = variants().iter().flat_map(of).collect::<Vec<_>>().into_iter();
    let solver = solver.map(|one| Asked { job: Job::Spheres(one.job), guess: 3.0 });
    let bed = (!quick).then(|| Asked { job: bed(), guess: 70.0 });
    solver.chain(bed).collect()
}

/// Results of the jobs, and what is committed.
///
/// # Errors
/// When files of the checkout cannot be read.
pub fn read(settings: &Settings, records: &Records) -> Result<Spheres, ReportError> {
    let checkout = &settings.place.checkout;
    let file = checkout.join(EXPERIMENT);
    let measured =
        experiment::read(&file).map_err(|error| ReportError::Read { file, problem: error.to_string() })?;
    let mut spheres = Spheres {
        runs: Vec::new(),
        elements: BTreeMap::new(),
        elements_core_seconds: None,
        zehner: zehner(&checkout.join(ZEHNER))?,
        measured,
        simulated: Vec::new(),
    };
    for scene in &variants() {
        for Configuration { family, name, job } in configurations(scene, settings.quick) {
            let Some(record) = settings.record(records, &Job::Spheres(job.clone())) else { continue };
            let done = record.outcome == Outcome::Done;
            let mut errors = differences(&record.printed);
            if scene.case == MEASURED && done {
                let simulated = probes(record.file.as_deref().unwrap_or_default(), &spheres.measured);
                if let Some(all) = misfits(&spheres.measured, &simulated).last() {
                    errors.insert("T".to_string(), [all.rms, all.worst]);
                }
                if family == FAMILIES[0] {
                    spheres.simulated = simulated;
                }
            }
            spheres.runs.push(SphereRun {
                case: scene.case.clone(),
                family,
                name,
                core_seconds: done.then_some(record.cpu_seconds),
                errors,
                outcome: record.outcome.as_str(),
                message: record.message.clone(),
            });
        }
    }
    if let Some(record) = settings.record(records, &bed()).filter(|record| record.outcome == Outcome::Done) {
        spheres.elements = of_plates(record.file.as_deref().unwrap_or_default());
        spheres.elements_core_seconds = Some(record.cpu_seconds);
    }
    Ok(spheres)
}

/// Root mean square and worst difference by quantity in the table of `compare-dem`, whose columns are as wide as its head says.
fn differences(table: &str) -> BTreeMap<String, [f64; 2]> {
    const NAMES: [(&str, &str); 4] =
        [("T at the probes", "T"), ("p ", "p"), ("K ", "K"), ("stress on the wall", "stress on the wall")];
    let row = |line: &str| {
        let (_, name) = NAMES.iter().find(|(begin, _)| line.starts_with(begin))?;
        let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let [_, rms, worst] = *numbers.as_slice() else { return None };
        Some((name.to_string(), [rms, worst]))
    };
    table.lines().filter_map(row).collect()
}

/// T of the function object `probes`, whose points lie at the distances of the measurements, from the nearest to the farthest.
fn probes(text: &str, measured: &[Measured]) -> Vec<Record> {
    let mut distances: Vec<f64> = measured.iter().map(|one| one.distance).collect();
    distances.sort_by(f64::total_cmp);
    distances.dedup();
    let rows: Vec<Vec<f64>> = (text.lines().filter(|line| !line.starts_with('#')))
        .map(|line| line.split_whitespace().filter_map(|word| word.parse().ok()).collect())
        .collect();
    let at = |k: usize| rows.iter().filter_map(move |row| Some((*row.first()?, *row.get(k + 1)?)));
    distances.iter().enumerate().map(|(k, &distance)| Record { distance, rows: at(k).collect() }).collect()
}

/// The rows of `comparison.csv` that hold all distances: rms by the way to take the plate.
fn of_plates(text: &str) -> BTreeMap<String, f64> {
    #[derive(Deserialize)]
    struct Row {
        plate: String,
        distance: String,
        rms: Option<f64>,
    }
    let rows: Vec<Row> = parsed(text).unwrap_or_default();
    let all = rows.into_iter().filter(|row| row.distance == "all");
    all.filter_map(|row| Some((row.plate, row.rms?))).collect()
}

/// Beds of unknown density have no prediction and are left out.
fn zehner(file: &Path) -> Result<Vec<ZehnerBed>, ReportError> {
    let beds: Vec<ZehnerBed> = rows(file)?;
    Ok(beds.into_iter().filter(|bed| bed.prediction.is_some()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::spheres::write_case;

    fn checkout() -> std::path::PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
    }

    /// Each mesh and key has its place in the shipped case.
    #[test]
    fn every_configuration_can_be_written() {
        let folder = std::env::temp_dir().join(format!("msdd-report-spheres-{}", std::process::id()));
        let variants = variants();
        assert_eq!(variants.len(), 3);
        for scene in &variants {
            let all = configurations(scene, false);
            assert!(
                all.iter().map(|one| &one.name).collect::<std::collections::BTreeSet<_>>().len() == all.len()
            );
            for one in all {
                write_case(&checkout(), &one.job, &folder).unwrap();
                let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
                let mesh = read("system/blockMeshDict");
                assert!(one.job.mesh.iter().all(|(_, to)| mesh.contains(to)), "{} {}", scene.case, one.name);
                for (file, text) in &one.job.append {
                    assert!(read(file).ends_with(text), "{file}");
                }
            }
        }
        let mut job = configurations(&variants[0], true)[0].job.clone();
        job.mesh = vec![("(9 9 9)".to_string(), "(1 1 1)".to_string())];
        let error = write_case(&checkout(), &job, &folder).unwrap_err().to_string();
        assert!(error.contains("blockMeshDict") && error.contains("no '(9 9 9)' in it"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn tables_are_read() {
        let table = "solver minus DEM         points      rms    worst\n\
                     T at the probes             100     1.07    -2.05 % of the range\n\
                     stress 1                     20     8.70   -14.10 %\n\
                     p                            20     9.03   -14.80 %\n\
                     stress on the wall           20    11.83   -16.75 %\n";
        let found = differences(table);
        assert_eq!(found.len(), 3);
        assert_eq!((found["T"], found["p"]), ([1.07, -2.05], [9.03, -14.8]));
        let at = |distance| Measured { distance, time: 5.0, temperature: 300.0 };
        let records = probes("# Probe 0\n 0 293 294\n 10 303 296\n", &[at(0.06), at(0.04), at(0.06)]);
        assert_eq!(records[0], Record { distance: 0.04, rows: vec![(0.0, 293.0), (10.0, 303.0)] });
        let all = misfits(&[at(0.04), at(0.06)], &records)[2];
        assert_eq!((all.points, all.worst), (2, -5.0));
        let plates = of_plates(
            "plate,key,value,distance,points,rms\nheld,,,0.04,7,0.6\nheld,,,all,9,0.4\nresisting,,,all,9,1.9\n",
        );
        assert_eq!(plates, BTreeMap::from([("held".to_string(), 0.4), ("resisting".to_string(), 1.9)]));
        let beds = zehner(&checkout().join(ZEHNER)).unwrap();
        assert!(beds.len() > 60 && beds.iter().all(|bed| bed.prediction.unwrap() > 1.0), "{}", beds.len());
    }
}
