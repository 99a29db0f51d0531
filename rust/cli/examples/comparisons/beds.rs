//! `comparisons beds`: compares the solver with beds of spheres computed by DEM, and fits its error bands.

use crate::bands::{Found, Group, fit_law, print_coverage, run as attempt_run, write_law};
use crate::calibrate::Row;
use crate::dem::{BedPlan, PlannedBed};
use crate::scenes::solve;
use clap::Args;
use msdd_autotune::ChoiceError;
use msdd_autotune::bands::{CONDUCTIVITY, Lengths, Units, sensitivity};
use msdd_autotune::quantity::Quantity;
use msdd_autotune::series::Series;
use msdd_autotune::user_case::UserCase;
use msdd_beds::case::{BedCase, file_in};
use msdd_beds::packings::column;
use msdd_case::folder;
use msdd_case::numbers::plain;
use msdd_case::spheres::start::{FABRIC, LATERAL};
use msdd_cli::shared::{CliError, Geometry, checkout, files, probes};
use msdd_files::{Column, read_text, write};
use msdd_training::dem_start::{FirstRow, packings};
use std::fmt::Write as _;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Quantities that are compared, with the columns of `errors.csv`.
const GROUPS: [Group; 3] = [
    ("T", &[Quantity::Temperature]),
    ("pressure", &[Quantity::Pressure]),
    ("conductivity", &[Quantity::ConductivityXx, Quantity::ConductivityZz]),
];
const COLUMNS: [Column; 9] = [
    ("scene", "-", "name of the bed"),
    ("use", "-", "what it is for"),
    ("packings", "-", "number of packings"),
    ("T_error", "%", "error of T, in percent of its range"),
    ("T_scatter", "%", "scatter of T, in percent of its range"),
    ("pressure_error", "%", "error of p, in percent of it"),
    ("pressure_scatter", "%", "scatter of p, in percent of it"),
    ("conductivity_error", "%", "error of K, in percent of it"),
    ("conductivity_scatter", "%", "scatter of K, in percent of it"),
];
/// Points along the axis, and along the radius of a cylinder, over which the solver's fields are averaged.
const ALONG: usize = 8;
const ACROSS: usize = 4;
/// What `msdd case new` proposes for a bed of steel under 20 kPa: porosity, contacts per sphere, and mobilised friction.
const PROPOSED: [f64; 3] = [0.4, 4.68, 0.85];
/// Share of the volume of a bed that spheres fill.
const FILLED: f64 = 0.6;

#[derive(Args)]
#[command(after_help = "Example: comparisons beds --plan cases/beds/plan.toml --out results/beds-by-solver
DEM results are made by 'msdd bed run'; cases/beds/make computes those that are not there.")]
pub struct Arguments {
    /// The plan: a TOML file with blocks [[scenes]] of a name and a use. Beside it stands a folder of each name with bed.toml and
    /// the files dem-<seed>.csv of its packings.
    #[arg(long, value_name = "FILE")]
    plan: PathBuf,
    /// Folder for the solver's cases.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Only the scene of this name; may be given several times. Default: all.
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Fit the error bands to the scenes for calibration, write their numbers into this file (JSON), and print how they do in
    /// all scenes; not with --only.
    #[arg(long, value_name = "FILE", conflicts_with = "only")]
    bands: Option<PathBuf>,
    /// Folder for the tables errors.csv and, with --bands, bands.csv; not with --only.
    #[arg(long, value_name = "DIR", conflicts_with = "only")]
    tables: Option<PathBuf>,
    /// Start from the state that 'msdd case new' proposes for poured beds under the axial stress of DEM, not from DEM's state.
    #[arg(long, conflicts_with = "bands")]
    proposed_start: bool,
    /// MSDD's checkout, whose solver the cases run. Default: the one that this program was built in.
    #[arg(long, value_name = "DIR")]
    checkout: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let plan = BedPlan::read(&arguments.plan)?;
    let names: Vec<&str> = plan.scenes.iter().map(|scene| scene.name.as_str()).collect();
    if let Some(name) = arguments.only.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(CliError::Message(format!("--only = {name}, allowed: {}", names.join(", "))));
    }
    let checkout = checkout(arguments.checkout.as_deref())?;
    let root = arguments.plan.parent().unwrap_or(Path::new("."));
    let mut found = Found::new();
    let mut csv = msdd_files::names(&COLUMNS).join(",") + "\n";
    println!(
        "solver less DEM, and standard deviation of one packing, rms over the run: T in % of the range of T, others in %"
    );
    println!("{:15} {:9} {:>8} {:>13} {:>13} {:>13}", "scene", "use", "packings", "T", "p", "K");
    let wanted = |scene: &&PlannedBed| arguments.only.is_empty() || arguments.only.contains(&scene.name);
    for (number, planned) in plan.scenes.iter().filter(wanted).enumerate() {
        let folder = root.join(&planned.name);
        let bed = BedCase::read(&folder)?;
        let mut all: Vec<(Quantity, Vec<Row>)> = Vec::new();
        let packings = packings(&folder)?;
        for (seed, file) in &packings {
            let place = arguments.out.join(&planned.name).join(format!("seed{seed}"));
            let proposed = arguments.proposed_start;
            let packing = Packing { scene: number, seed: *seed, bed: &bed, folder: &folder, file, proposed };
            all.extend(packing.rows(&place, &checkout)?);
        }
        let [low, high] = bed.temperatures();
        let mut cells = Vec::new();
        for (_, quantities) in GROUPS {
            let own: Vec<&Row> = all
                .iter()
                .filter(|(quantity, _)| quantities.contains(quantity))
                .flat_map(|(_, rows)| rows)
                .collect();
            let range = (quantities == [Quantity::Temperature]).then_some(high - low);
            cells.push([error(&own, range), scatter(&own, range)]);
        }
        let text: Vec<String> = cells.iter().map(|[e, s]| format!("{e:6.2} {s:6.2}")).collect();
        println!(
            "{:15} {:9} {:>8} {}",
            planned.name,
            planned.purpose.as_str(),
            packings.len(),
            text.join(" ")
        );
        let numbers: Vec<String> = cells.iter().flatten().map(|value| decimals(*value)).collect();
        let _ = writeln!(
            csv,
            "{},{},{},{}",
            planned.name,
            planned.purpose.as_str(),
            packings.len(),
            numbers.join(",")
        );
        for (quantity, rows) in all {
            found.entry((planned.purpose.as_str(), quantity)).or_default().extend(rows);
        }
    }
    if let Some(folder) = &arguments.tables {
        write(&folder.join("errors.csv"), csv.as_bytes())?;
    }
    let Some(file) = &arguments.bands else { return Ok(()) };
    let law = fit_law(&found, &GROUPS)?;
    write_law(&law, file)?;
    print_coverage(&found, &law, &GROUPS, arguments.tables.as_deref())
}

/// Points of the region of the averages: means over them stand for means over it.
fn region(bed: &BedCase, geometry: &Geometry) -> Vec<[f64; 3]> {
    let [_, low, high, _] = geometry.levels;
    let height = |k: usize| low + (high - low) * (k as f64 + 0.5) / ALONG as f64;
    let Some(radius) = bed.record.radius else {
        return (0..ALONG).map(|k| geometry.point(height(k), 0.0)).collect();
    };
    // Rings of equal area.
    let ring = |k: usize| radius * ((k as f64 + 0.5) / ACROSS as f64).sqrt();
    (0..ALONG)
        .flat_map(|k| (0..ACROSS).map(move |j| (k, j)))
        .map(|(k, j)| geometry.point(height(k), ring(j)))
        .collect()
}

/// A packing of a bed.
struct Packing<'a> {
    /// Number of the scene, and the seed.
    scene: usize,
    seed: u64,
    bed: &'a BedCase,
    /// Folder of its `bed.toml`, and the results of its DEM.
    folder: &'a Path,
    file: &'a Path,
    /// Whether the start is that of `msdd case new`.
    proposed: bool,
}

/// The state of `msdd case new` under the axial stress of DEM.
fn propose(start: &mut FirstRow) {
    let [_, _, axial] = start.stress;
    start.stress = [LATERAL * axial, LATERAL * axial, axial];
    start.fabric = [FABRIC[0], FABRIC[0], FABRIC[1]];
    [start.porosity, start.coordination, start.mobilised] = PROPOSED;
    start.porosity_outside = start.porosity_outside.map(|_| start.porosity);
}

/// What is compared: a column of the elements with the mean of the solver's values at some of the scene's points.
struct Compared {
    quantity: Quantity,
    column: String,
    points: Range<usize>,
}

impl Packing<'_> {
    /// Rows for the fit, by quantity. Makes and runs the solver's case in the folder `place`.
    fn rows(&self, place: &Path, checkout: &Path) -> Result<Vec<(Quantity, Vec<Row>)>, CliError> {
        let failed = |error: ChoiceError| CliError::Message(error.to_string());
        let mut start = FirstRow::read(self.file)?;
        if self.proposed {
            propose(&mut start);
        }
        let geometry = Geometry::new(&file_in(self.folder), self.bed, start.depth)?;
        folder::write(place, &files(self.folder, self.bed, &start, "bed", checkout)?)?;
        solve(place, checkout).map_err(CliError::Message)?;
        let mut scene = UserCase::read(place).map_err(failed)?;
        let all = self.compared(&geometry, &mut scene);
        scene.bed.grains = self.bed.grains.number as f64;
        scene.bed.window = in_region(self.bed, &geometry);
        let [low, high] = self.bed.temperatures();
        let base = attempt_run(&scene, high - low, 1.0).map_err(failed)?;
        let more = attempt_run(&scene, high - low, CONDUCTIVITY).map_err(failed)?;
        let sensitivity = sensitivity(&base, &more);
        let lengths = Lengths::new(&scene.bed, &base, &sensitivity);
        let text = read_text(self.file)?;
        let elements = |name: &str| {
            column(&text, name).ok_or_else(|| {
                CliError::Message(format!("{}: no column {name} of numbers", self.file.display()))
            })
        };
        let times = elements("time")?;
        let mut rows = Vec::new();
        for (number, of) in all.iter().enumerate() {
            let series = Solver::new(&lengths, base.series(of.quantity), of);
            let mut own = Vec::new();
            for (index, (&time, &discs)) in times.iter().zip(&elements(&of.column)?).enumerate() {
                if time == 0.0 {
                    continue;
                }
                let (value, units) = series.at(time).ok_or_else(|| {
                    CliError::Message(format!("{}: the solver has not written t = {time} s", place.display()))
                })?;
                let key = index * all.len() + number;
                own.push(Row {
                    scene: self.scene,
                    packing: self.seed,
                    key,
                    error: discs - value,
                    discs,
                    units,
                });
            }
            rows.push((of.quantity, own));
        }
        Ok(rows)
    }

    /// What is compared; its points are added to those of the scene.
    fn compared(&self, geometry: &Geometry, scene: &mut UserCase) -> Vec<Compared> {
        let (places, inside) = (probes(self.bed, geometry), region(self.bed, geometry));
        let first = scene.points.len();
        scene.points.extend(places.iter().chain(&inside));
        let probes = self.bed.record.distances.iter().zip(first..);
        let mut all: Vec<Compared> = probes
            .map(|(distance, point)| Compared {
                quantity: Quantity::Temperature,
                column: format!("T_{distance}"),
                points: point..point + 1,
            })
            .collect();
        let along =
            if geometry.radii.is_some() { Quantity::ConductivityXx } else { Quantity::ConductivityZz };
        let begin = first + places.len();
        for (quantity, column) in [(Quantity::Pressure, "p"), (along, "K")] {
            all.push(Compared { quantity, column: column.to_string(), points: begin..begin + inside.len() });
        }
        all
    }
}

/// What the solver gives of one quantity, with the lengths of its band.
struct Solver<'a> {
    value: &'a Series,
    model: Series,
    packing: Vec<Series>,
    points: Range<usize>,
}

impl<'a> Solver<'a> {
    fn new(lengths: &Lengths, value: &'a Series, of: &Compared) -> Self {
        let parts = lengths.units(of.quantity, 0, of.points.start).map_or(0, |units| units.packing.len());
        let model = lengths.map(of.quantity, |units| units.model);
        let packing = (0..parts).map(|k| lengths.map(of.quantity, |units| units.packing[k])).collect();
        Self { value, model, packing, points: of.points.clone() }
    }

    /// Means over the points at a time [s].
    fn at(&self, time: f64) -> Option<(f64, Units)> {
        let mean = |series: &Series| {
            let own = series.at(time)?.get(self.points.clone())?;
            Some(own.iter().sum::<f64>() / own.len() as f64)
        };
        let packing: Option<Vec<f64>> = self.packing.iter().map(mean).collect();
        Some((mean(self.value)?, Units { model: mean(&self.model)?, packing: packing? }))
    }
}

/// Number of spheres in the region of the averages.
fn in_region(bed: &BedCase, geometry: &Geometry) -> f64 {
    let [_, low, high, _] = geometry.levels;
    let area = bed.record.radius.map_or(bed.vessel().area(), |radius| std::f64::consts::PI * radius * radius);
    FILLED * area * (high - low) / (std::f64::consts::PI / 6.0 * bed.grains.diameter.powi(3))
}

/// With three decimals; nothing for the scatter of a single packing, which is not known.
fn decimals(value: f64) -> String {
    if value.is_finite() { plain((value * 1e3).round() / 1e3) } else { String::new() }
}

/// Root of the mean square of the errors of one packing [% of `range`, or of the values].
fn error(rows: &[&Row], range: Option<f64>) -> f64 {
    let squares: f64 = rows.iter().map(|row| (row.error / range.unwrap_or(row.discs)).powi(2)).sum();
    100.0 * (squares / rows.len() as f64).sqrt()
}

/// Standard deviation of DEM between packings, likewise.
fn scatter(rows: &[&Row], range: Option<f64>) -> f64 {
    let mut sums = (0.0, 0.0);
    let keys: std::collections::BTreeSet<usize> = rows.iter().map(|row| row.key).collect();
    for key in keys {
        let own: Vec<f64> = rows.iter().filter(|row| row.key == key).map(|row| row.discs).collect();
        let mean = own.iter().sum::<f64>() / own.len() as f64;
        let scale = range.unwrap_or(mean);
        sums.0 += own.iter().map(|value| ((value - mean) / scale).powi(2)).sum::<f64>();
        sums.1 += own.len() as f64 - 1.0;
    }
    100.0 * (sums.0 / sums.1).sqrt()
}
