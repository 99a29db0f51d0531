//! The error bands of the solver: fitted to the reference scenes, and judged by them.

use crate::calibrate::{Coverage, Row, coverage, fit, quantile};
use crate::dem::{PlannedScene, SceneResults};
use msdd_autotune::ChoiceError;
use msdd_autotune::bands::{CONDUCTIVITY, LEVEL, Law, Lengths, Numbers, Units, sensitivity};
use msdd_autotune::quantity::Quantity;
use msdd_autotune::series::Series;
use msdd_autotune::settings::{Level, Settings};
use msdd_autotune::trial::{self, Outcome};
use msdd_autotune::user_case::UserCase;
use msdd_case::numbers::plain;
use msdd_cli::shared::{CliError, attempt, beside};
use msdd_files::{Column, Lock, names, write};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Points along each side of a window over which the solver's fields are averaged.
const POINTS: usize = 4;
/// Tolerance in time of the solver's runs, share of the range of T.
const TOLERANCE: f64 = 1e-3;
const COLUMNS: [Column; 6] = [
    ("quantity", "-", "T, pressure, conductivity (both components) or displacement (both)"),
    ("use", "-", "scenes"),
    ("values", "-", "number of values: windows × times × packings × components"),
    ("inside", "-", "share of the discs' values inside of the 90 % bands, all scenes together"),
    ("inside_worst_scene", "-", "the same in the worst scene"),
    (
        "width",
        "-",
        "width of the bands over twice the standard deviation between packings, median over the scenes",
    ),
];
/// Quantities that have the same numbers, and their name.
pub type Group = (&'static str, &'static [Quantity]);
/// Rows by what their scene is for, and by quantity.
pub type Found = BTreeMap<(&'static str, Quantity), Vec<Row>>;
const GROUPS: [Group; 4] = [
    ("T", &[Quantity::Temperature]),
    ("pressure", &[Quantity::Pressure]),
    ("conductivity", &[Quantity::ConductivityXx, Quantity::ConductivityYy]),
    ("displacement", &[Quantity::DisplacementX, Quantity::DisplacementY]),
];

/// A scene, its packings' results and their case folders.
pub type Done<'a> = (&'a PlannedScene, Vec<(SceneResults, PathBuf)>);

/// The windows of a packing: centres and sizes.
pub struct Windows {
    /// Centre of each [m].
    centres: Vec<[f64; 2]>,
    size: [f64; 2],
    /// Mean number of grains.
    pub grains: f64,
}

impl Windows {
    pub fn of(results: &SceneResults) -> Result<Self, CliError> {
        let packing = |name: &str| results.packing.column(name).and_then(|values| values.first().copied());
        let missing = || CliError::Message("results of a scene without their table of packings".to_string());
        let number = |name: &str| packing(name).ok_or_else(missing);
        let size = [number("window_width")?, number("window_height")?];
        let area = number("width")? * number("height")?;
        let grains = number("discs")? * size[0] * size[1] / area;
        let column = |name: &str| results.windows.column(name).ok_or_else(missing);
        let (times, x, y) = (column("time")?, column("x")?, column("y")?);
        let first = times.iter().take_while(|&&time| time == times[0]).count();
        let centres = (0..first).map(|k| [x[k], y[k]]).collect();
        Ok(Self { centres, size, grains })
    }

    /// Points of all windows, one window after the other, at the height of `z`.
    pub fn points(&self, z: f64) -> Vec<[f64; 3]> {
        let at = |k: usize| (k as f64 + 0.5) / POINTS as f64 - 0.5;
        let of = |centre: &[f64; 2]| {
            let points = (0..POINTS * POINTS).map(|k| {
                let (i, j) = (at(k % POINTS), at(k / POINTS));
                [centre[0] + self.size[0] * i, centre[1] + self.size[1] * j, z]
            });
            points.collect::<Vec<_>>()
        };
        self.centres.iter().flat_map(of).collect()
    }

    /// Means over the windows of values at all points of a scene, of which those of the windows come last.
    pub fn means(&self, values: &[f64]) -> Vec<f64> {
        let own = &values[values.len() - self.centres.len() * POINTS * POINTS..];
        own.chunks(POINTS * POINTS).map(|part| part.iter().sum::<f64>() / part.len() as f64).collect()
    }
}

/// One run of the solver in a case folder, on the mesh of the case.
pub fn run(scene: &UserCase, range: f64, conductivity: f64) -> Result<Outcome, ChoiceError> {
    let levels = vec![Level::Halved(0); scene.directions().len()];
    let settings = Settings { conductivity, ..Settings::new(levels, TOLERANCE, true) };
    let folder = beside(scene, "trial");
    let lock = Lock::take(&folder)?;
    let outcome = attempt(scene, &settings, Some(range), &folder, &lock);
    trial::clear(&folder)?;
    outcome
}

/// Rows of a packing for the fit, by quantity.
fn rows(
    number: usize,
    results: &SceneResults,
    folder: &Path,
    range: f64,
) -> Result<BTreeMap<Quantity, Vec<Row>>, CliError> {
    let failed = |error: ChoiceError| CliError::Message(error.to_string());
    let mut scene = UserCase::read(folder).map_err(failed)?;
    let windows = Windows::of(results)?;
    scene.points.extend(windows.points(scene.points[0][2]));
    let discs = results.packing.column("discs").and_then(|values| values.first().copied());
    scene.bed.grains = discs.unwrap_or(scene.bed.grains);
    scene.bed.window = windows.grains;
    let base = run(&scene, range, 1.0).map_err(failed)?;
    let more = run(&scene, range, CONDUCTIVITY).map_err(failed)?;
    let sensitivity = sensitivity(&base, &more);
    let lengths = Lengths::new(&scene.bed, &base, &sensitivity);

    let mut all = BTreeMap::new();
    for quantity in Quantity::PLANE {
        let parts = base.strain.values.iter().flatten().any(|&strain| strain != 0.0);
        if quantity.needs_motion() && !parts {
            continue;
        }
        let packings = lengths.units(quantity, 0, 0).map_or(0, |units| units.packing.len());
        let model = lengths.map(quantity, |units| units.model);
        let packing: Vec<Series> =
            (0..packings).map(|k| lengths.map(quantity, |units| units.packing[k])).collect();
        let times = results.windows.column("time").unwrap_or_default();
        let discs = results.windows.column(quantity.name()).unwrap_or_default();
        let count = windows.centres.len();
        let mut rows = Vec::new();
        for first in (0..times.len()).step_by(count).filter(|&first| times[first] > 0.0) {
            let mean = |series: &Series| series.at(times[first]).map(|row| windows.means(row));
            let no_time = || {
                let (folder, time) = (scene.folder.display(), times[first]);
                CliError::Message(format!("{folder}: the solver has not written t = {time} s"))
            };
            let values = mean(base.series(quantity)).ok_or_else(no_time)?;
            let model = mean(&model).ok_or_else(no_time)?;
            let packing: Option<Vec<Vec<f64>>> = packing.iter().map(mean).collect();
            let packing = packing.ok_or_else(no_time)?;
            for window in 0..count {
                let discs = discs[first + window];
                rows.push(Row {
                    scene: number,
                    packing: results.seed,
                    key: (first + window) * Quantity::PLANE.len() + quantity as usize,
                    error: discs - values[window],
                    discs,
                    units: Units {
                        model: model[window],
                        packing: packing.iter().map(|of| of[window]).collect(),
                    },
                });
            }
        }
        all.insert(quantity, rows);
    }
    Ok(all)
}

/// Fits the bands to the scenes for calibration and writes their numbers; prints how they do, and writes that into the folder `table`.
pub fn calibrate(all: &[Done], numbers: &Path, table: Option<&Path>) -> Result<Law, CliError> {
    println!("error bands: the solver in {} scenes, with two conductivities", all.len());
    let mut found = Found::new();
    for (number, (scene, packings)) in all.iter().enumerate() {
        let range = scene.case()?.temperature_range();
        for (results, folder) in packings {
            for (quantity, rows) in rows(number, results, folder, range)? {
                found.entry((scene.purpose.as_str(), quantity)).or_default().extend(rows);
            }
        }
    }
    let law = fit_law(&found, &GROUPS)?;
    write_law(&law, numbers)?;
    print_coverage(&found, &law, &GROUPS, table)?;
    Ok(law)
}

/// Rows of the scenes with a purpose, of these quantities.
fn of(found: &Found, purpose: &str, quantities: &[Quantity]) -> Vec<Row> {
    let own = found.iter().filter(|((p, quantity), _)| *p == purpose && quantities.contains(quantity));
    own.flat_map(|(_, rows)| rows.clone()).collect()
}

/// The numbers that fit the scenes for calibration best: of T, p, K and, if it is among the groups, u.
///
/// # Errors
/// Fewer than three groups.
pub fn fit_law(found: &Found, groups: &[Group]) -> Result<Law, CliError> {
    let mut fitted = groups.iter().map(|(_, quantities)| fit(&of(found, "calibrate", quantities)));
    let mut next =
        || fitted.next().ok_or_else(|| CliError::Message("bands of T, p and K are needed".to_string()));
    let [temperature, pressure, conductivity] = [next()?, next()?, next()?];
    let displacement = next().ok();
    let request = [
        request(&of(found, "calibrate", &[Quantity::Temperature]), &temperature),
        request(&of(found, "calibrate", &[Quantity::Pressure]), &pressure),
    ];
    Ok(Law { temperature, pressure, conductivity, displacement, request }.rounded())
}

/// Writes the numbers.
///
/// # Errors
/// A file that cannot be written.
pub fn write_law(law: &Law, file: &Path) -> Result<(), CliError> {
    let text = serde_json::to_string_pretty(law)
        .map_err(|error| CliError::Message(format!("numbers of the bands: {error}")))?;
    Ok(write(file, format!("{text}\n").as_bytes())?)
}

/// Prints how the bands do, and writes that into `bands.csv` of a folder.
///
/// # Errors
/// A file that cannot be written.
pub fn print_coverage(
    found: &Found,
    law: &Law,
    groups: &[Group],
    folder: Option<&Path>,
) -> Result<(), CliError> {
    let mut csv = names(&COLUMNS).join(",") + "\n";
    println!(
        "\n90 % bands: share of the values inside, of all scenes and of the worst; width over twice the scatter"
    );
    for (name, quantities) in groups {
        let Some(numbers) = law.of(quantities[0]) else { continue };
        let mut line = format!("{name:13}");
        for purpose in ["calibrate", "judge", "outside"] {
            let rows = of(found, purpose, quantities);
            let Coverage { inside, worst, width } = coverage(&rows, numbers);
            let _ =
                write!(line, "  {purpose} {:5.1} % ({:3.0} %) {width:5.2}", 100.0 * inside, 100.0 * worst);
            let values: Vec<String> = [inside, worst, width].into_iter().map(plain).collect();
            let _ = writeln!(csv, "{name},{purpose},{},{}", rows.len(), values.join(","));
        }
        println!("{line}");
    }
    if let Some(folder) = folder {
        write(&folder.join("bands.csv"), csv.as_bytes())?;
    }
    Ok(())
}

/// Factor of the bands' halves below which the error of a whole run stays with probability [`LEVEL`]: both as roots of the mean
/// squares over windows and times.
fn request(rows: &[Row], numbers: &Numbers) -> f64 {
    let mut runs: BTreeMap<(usize, u64), (f64, f64)> = BTreeMap::new();
    for row in rows {
        let [model, packing] = numbers.halves(&row.units);
        let sums = runs.entry((row.scene, row.packing)).or_default();
        *sums = (sums.0 + row.error.powi(2), sums.1 + model.powi(2) + packing.powi(2));
    }
    quantile(runs.values().map(|(error, half)| ((error / half).sqrt(), 1.0)).collect(), LEVEL)
}
