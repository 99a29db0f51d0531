//! Copies of a case of the user's: how they are made, and what a run in them has given.

use crate::jobs::job::{CaseDiscs, CaseJob, CaseProgram, CaseRun};
use crate::{ReportError, read_text};
use msdd_autotune::quantity::Quantity;
use msdd_autotune::record;
use msdd_autotune::series::Series;
use msdd_autotune::settings::{Level, Settings};
use msdd_autotune::trial::{self, Purpose, read_outcome};
use msdd_autotune::user_case::UserCase;
use msdd_autotune::{ChoiceError, trial::check_ours};
use msdd_case::tables;
use msdd_dem_reference::model::SUB_REGIONS;
use msdd_dem_reference::results::{Results, Table};
use msdd_files::{list, write};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Ends of the names of the folders next to the user's case: the copy, and those that `msdd case solve` makes of it.
const COPY: &str = "report";
const OTHERS: [&str; 2] = ["report.chosen", "report.trial"];
/// Name of the function objects whose results are compared, in addition to those of [`trial`].
const WATCH: &str = "msddReport";
/// Folder of the results of discs in the copy.
const DISCS: &str = "discs";

/// Rows of numbers of one time \[s\] each. A number that a point outside of the mesh does not have is missing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rows {
    pub times: Vec<f64>,
    pub values: Vec<Vec<Option<f64>>>,
}

impl Rows {
    fn of(series: Series) -> Self {
        let finite =
            |row: Vec<f64>| row.into_iter().map(|value| Some(value).filter(|v| v.is_finite())).collect();
        Self { times: series.times, values: series.values.into_iter().map(finite).collect() }
    }

    /// The same with NaN for what is missing.
    pub fn series(&self) -> Series {
        let number = |row: &Vec<Option<f64>>| row.iter().map(|value| value.unwrap_or(f64::NAN)).collect();
        Series { times: self.times.clone(), values: self.values.iter().map(number).collect() }
    }
}

/// What is compared of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Cells of the mesh, or discs.
    pub size: usize,
    /// Largest minus smallest T anywhere, the walls included \[K\].
    pub range: f64,
    /// T at the points of the case \[K\].
    pub temperature: Rows,
    /// Pressure at these points; compared with discs one column, the mean of the box \[Pa\].
    pub pressure: Rows,
    /// Displacement at these points, three columns for each; compared with discs at the end alone, in the centres of
    /// [`SUB_REGIONS`]. Empty if grains stay \[m\].
    pub displacement: Rows,
    /// Discs alone: porosity with overlaps counted once and away from the walls [-], fabric index [-], and pressure away from the
    /// walls \[Pa\] at the start.
    pub packing: Option<[f64; 3]>,
}

/// The folder of the copy of a case.
pub fn copy_of(case: &Path) -> PathBuf {
    beside(case, COPY)
}

fn beside(case: &Path, ending: &str) -> PathBuf {
    let name = case.file_name().unwrap_or_default().to_string_lossy();
    case.with_file_name(format!("{name}.{ending}"))
}

/// Refuses a case next to which a folder of the user's has the name of one that jobs make and remove.
///
/// # Errors
/// [`ChoiceError::Foreign`].
pub fn check(case: &Path) -> Result<(), ChoiceError> {
    [&[COPY][..], &OTHERS].concat().into_iter().try_for_each(|ending| check_ours(&beside(case, ending)))
}

/// Removes what a job has made next to the case.
///
/// # Errors
/// [`ChoiceError::Foreign`], [`ChoiceError::Read`] if it cannot be removed.
pub fn clear(case: &Path) -> Result<(), ChoiceError> {
    let ours = [&[COPY][..], &OTHERS].concat();
    ours.into_iter().try_for_each(|ending| trial::clear(&beside(case, ending)))?;
    for ending in OTHERS {
        let _ = std::fs::remove_file(beside(case, &format!("{ending}.lock")));
    }
    Ok(())
}

/// Makes the copy that a job runs in.
///
/// # Errors
/// [`ChoiceError::Run`] when OpenFOAM cannot make its mesh or fields; others when files cannot be read or written.
pub fn prepare(job: &CaseJob) -> Result<(), ChoiceError> {
    let scene = UserCase::read(&job.folder)?;
    let folder = copy_of(&job.folder);
    clear(&job.folder)?;
    match &job.program {
        CaseProgram::Solver(run) => {
            trial::make(&scene, &run.settings, run.range, Purpose::Trial, &folder)?;
            append(&folder, "system/controlDict", &watch(&scene, run))?;
            run.append.iter().try_for_each(|(file, text)| append(&folder, file, text))
        }
        CaseProgram::Choice(_) => trial::plain(&scene, &folder),
        CaseProgram::Discs(_) => {
            let levels = vec![Level::Halved(0); scene.directions().len()];
            let settings = Settings::new(levels, 1e-3, false);
            trial::make(&scene, &settings, None, Purpose::Trial, &folder)?;
            let probes =
                format!("functions {{ probes {{ probeLocations ({}); }} }}\n", points(&scene.points));
            append(&folder, "system/controlDict", &probes)
        }
    }
}

/// The command of a job, run in the copy.
pub fn command(job: &CaseJob, msdd: &Path) -> String {
    let (msdd, copy) = (msdd.display(), copy_of(&job.folder).display().to_string());
    match &job.program {
        CaseProgram::Solver(_) => "msddFoam".to_string(),
        CaseProgram::Choice(percent) => {
            format!("'{msdd}' case solve '{copy}' --accuracy {percent} --choose-mechanics --choose-only")
        }
        CaseProgram::Discs(CaseDiscs { seed, porosity, isotropic, interval }) => format!(
            "'{msdd}' reference run --case '{copy}' --seed {seed} --porosity {porosity} --compression {} \
             --state '{copy}/{DISCS}/packed.json' --out '{copy}/{DISCS}' --interval {interval:e} --profiles 2 --threads 1",
            if *isotropic { "isotropic" } else { "horizontal" }
        ),
    }
}

/// What a job that is done has given, as JSON: [`Measured`], or the record of the choice.
///
/// # Errors
/// When files are missing or cannot be read.
pub fn result(job: &CaseJob) -> Result<String, ReportError> {
    let copy = copy_of(&job.folder);
    let measured = match &job.program {
        CaseProgram::Choice(_) => {
            return read_text(&beside(&job.folder, OTHERS[0]).join(record::FILE));
        }
        CaseProgram::Solver(run) => of_solver(&copy, run)?,
        CaseProgram::Discs(discs) => of_discs(&copy.join(DISCS), discs.seed)?,
    };
    serde_json::to_string(&measured)
        .map_err(|error| ReportError::Read { file: copy, problem: error.to_string() })
}

fn append(folder: &Path, file: &str, text: &str) -> Result<(), ChoiceError> {
    let file = folder.join(file);
    let own = std::fs::read(&file)
        .map_err(|error| ChoiceError::Read { file: file.clone(), problem: error.to_string() })?;
    Ok(write(&file, &[&own[..], b"\n", text.as_bytes()].concat())?)
}

fn points(points: &[[f64; 3]]) -> String {
    points.iter().map(|[x, y, z]| format!("({x} {y} {z})")).collect::<Vec<_>>().join(" ")
}

/// Function objects that write what is compared.
fn watch(scene: &UserCase, run: &CaseRun) -> String {
    let at = points(&scene.points);
    let probes = |name: &str, fields: &str, at: &str| {
        format!(
            "    {WATCH}{name} {{ type probes; libs (\"libsampling.so\"); fields ({fields}); interpolationScheme cellPoint; \
             {} probeLocations ({at}); }}\n",
            trial::watched(scene)
        )
    };
    let Some([corner, size]) = run.discs else {
        return format!("functions\n{{\n{}}}\n", probes("", "pressure D", &at));
    };
    let own = format!("libs (\"libgranularFunctionObjects.so\"); {}", trial::watched(scene));
    let z = scene.points.first().map_or(0.0, |point| point[2]);
    let [nx, ny] = SUB_REGIONS;
    let centre = |k: usize| {
        let share = [((k % nx) as f64 + 0.5) / nx as f64, ((k / nx) as f64 + 0.5) / ny as f64];
        [corner[0] + share[0] * size[0], corner[1] + share[1] * size[1], z]
    };
    let centres: Vec<[f64; 3]> = (0..nx * ny).map(centre).collect();
    let mut text = "functions\n{\n".to_string();
    let _ = writeln!(text, "    {WATCH}T {{ type spaceProbes; field T; probeLocations ({at}); {own} }}");
    let _ = writeln!(text, "    {WATCH}P {{ type wallPressure; {own} }}");
    text + &probes("D", "D", &points(&centres)) + "}\n"
}

fn of_solver(copy: &Path, run: &CaseRun) -> Result<Measured, ReportError> {
    let outcome = read_outcome(copy, 0.0)?;
    // Without rows if the function object wrote none, such as D where grains stay.
    let read = |name: &str, field: &str| {
        let name = format!("{WATCH}{name}");
        match tables::parts(copy, &name, Some(field)) {
            Ok(_) => Series::read(copy, &name, field),
            Err(_) => Ok(Series::default()),
        }
    };
    let (temperature, pressure, displacement) = match run.discs {
        None => (outcome.series(Quantity::Temperature).clone(), read("", "pressure")?, read("", "D")?),
        Some(_) => {
            let mut pressure = read("P", "wallPressure.dat")?;
            pressure.values.iter_mut().for_each(|row| row.truncate(1));
            (read("T", "spaceProbes.dat")?, pressure, last(read("D", "D")?))
        }
    };
    Ok(Measured {
        size: outcome.cells,
        range: outcome.range,
        temperature: Rows::of(temperature),
        pressure: Rows::of(pressure),
        displacement: Rows::of(displacement),
        packing: None,
    })
}

fn last(series: Series) -> Series {
    let row = |(time, row): (&f64, &Vec<f64>)| Series { times: vec![*time], values: vec![row.clone()] };
    series.times.iter().zip(&series.values).next_back().map_or(Series::default(), row)
}

fn of_discs(folder: &Path, seed: u64) -> Result<Measured, ReportError> {
    let ending = format!("_seed{seed}.json");
    let missing = || ReportError::Read { file: folder.to_path_buf(), problem: format!("no file *{ending}") };
    let file = list(folder)?.into_iter().find(|file| file.to_string_lossy().ends_with(&ending));
    let results = Results::read(&file.ok_or_else(missing)?)?;
    let column = |table: &Table, name: &str| table.column(name).unwrap_or_default();
    let times = column(&results.series, "time");
    let columns = |names: &[String]| {
        let columns: Vec<Vec<f64>> = names.iter().map(|name| column(&results.series, name)).collect();
        let row =
            |k: usize| columns.iter().map(|values| values.get(k).copied().unwrap_or(f64::NAN)).collect();
        Series { times: times.clone(), values: (0..times.len()).map(row).collect() }
    };
    let probes: Vec<String> = (1..=results.probes.len()).map(|k| format!("T_P{k}_window")).collect();
    let moved = results.displacement.as_ref().map_or(Series::default(), |table| {
        let [x, y] = ["displacement_x", "displacement_y"].map(|name| column(table, name));
        let row = x.iter().zip(&y).flat_map(|(&x, &y)| [x, y, 0.0]).collect();
        Series { times: times.last().copied().into_iter().collect(), values: vec![row] }
    });
    Ok(Measured {
        size: results.discs,
        range: 0.0,
        temperature: Rows::of(columns(&probes)),
        pressure: Rows::of(columns(&["pressure_inner".to_string()])),
        displacement: Rows::of(moved),
        packing: Some(
            ["porosity_inner", "fabric_index", "pressure_inner"]
                .map(|name| column(&results.series, name).first().copied().unwrap_or_default()),
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_kept_as_missing() {
        let series = Series { times: vec![0.0], values: vec![vec![f64::NAN, 2.0]] };
        let rows = Rows::of(series.clone());
        let text = serde_json::to_string(&rows).unwrap();
        let read: Rows = serde_json::from_str(&text).unwrap();
        assert_eq!(read, rows);
        assert!(read.series().values[0][0].is_nan() && read.series().values[0][1] == 2.0);
        assert_eq!(last(series).times, [0.0]);
    }
}
