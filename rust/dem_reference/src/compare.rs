//! Errors of solver runs against the reference: each run starts from the fields of one packing and is compared with that
//! packing's DEM; the error of a case is the largest, over time, of the mean difference over the packings.

use crate::ReferenceError;
use crate::packings::{GRAIN_CONDUCTIVITY, Reference, pressure_range, temperature_range};
use crate::results::{Properties, Results};
use crate::series::{at, largest, root_mean_square, spread, statistics};
use crate::solver::{COLUMNS, Run};
use msdd_case::Case;
use msdd_rve::message::number;
use serde::Serialize;

/// Differences over the sub-regions of all packings at the end.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FieldError {
    pub quantity: String,
    pub unit: String,
    pub rms: f64,
    /// Root mean square over the 8 x 1 sub-regions that touch no wall.
    pub rms_inner: f64,
    /// Largest of any sub-region, with its sign.
    pub worst: f64,
    /// Means over the box, and standard deviations over the sub-regions: solver, DEM.
    pub means: [f64; 2],
    pub deviations: [f64; 2],
}

/// Errors of one configuration in one case. Signed: solver minus DEM.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Errors {
    /// Errors of T at P1, P2, P3 [% of the range].
    pub temperature: [f64; 3],
    /// The same errors of each packing.
    pub temperature_of_seeds: Vec<[f64; 3]>,
    /// Error of the mean pressure [% of the paper's range].
    pub pressure: f64,
    pub pressure_of_seeds: Vec<f64>,
    /// Error of the mean pressure against the mean of the discs in the inner region, without the looser layers at the walls,
    /// which the solver's cells do not have either. `None` when the reference has not recorded it.
    pub pressure_inner: Option<f64>,
    pub pressure_inner_of_seeds: Vec<f64>,
    pub fields: Vec<FieldError>,
    /// Error of the displacement along x at the end: largest difference over largest displacement [%].
    pub displacement: Option<f64>,
}

impl Errors {
    /// Largest absolute value of the three probes [% of the range].
    pub fn largest_temperature(&self) -> f64 {
        self.temperature.iter().fold(0.0, |worst, e| worst.max(e.abs()))
    }

    pub fn field(&self, quantity: &str) -> Option<&FieldError> {
        self.fields.iter().find(|f| f.quantity == quantity)
    }
}

/// Compares one run per packing, in the order of the reference's packings. `affine`: K is compared with that of Eq. 9 instead
/// of that of the solved resistor network. `None` when a run ends before the reference.
pub fn errors(reference: &Reference, runs: &[&Run], affine: bool) -> Option<Errors> {
    let times = reference.times();
    let end = times.last()?;
    if runs.len() != reference.results.len()
        || runs.iter().any(|run| run.temperature.last().is_none_or(|row| row[0] < end - 1e-6))
    {
        return None;
    }
    let range = temperature_range(&reference.case);
    let of_probe = |probe: usize| -> Vec<Vec<f64>> {
        let start = reference.temperature()[probe][0][0];
        let differences = |(run, dem): (&&Run, &Vec<f64>)| {
            let series: Vec<[f64; 2]> = run.temperature.iter().map(|row| [row[0], row[1 + probe]]).collect();
            difference(&times, &with_start(&series, start), dem, 100.0 / range)
        };
        runs.iter().zip(&reference.temperature()[probe]).map(differences).collect()
    };
    let temperatures = [0, 1, 2].map(of_probe);
    let pressures = pressure_differences(reference, runs, "pressure");
    let inner = pressure_differences(reference, runs, "pressure_inner");
    Some(Errors {
        temperature: [0, 1, 2].map(|p| largest(&means(&temperatures[p]))),
        temperature_of_seeds: (0..runs.len())
            .map(|seed| [0, 1, 2].map(|p| largest(&temperatures[p][seed])))
            .collect(),
        pressure: largest(&means(&pressures)),
        pressure_of_seeds: pressures.iter().map(|p| largest(p)).collect(),
        pressure_inner: (!inner.is_empty()).then(|| largest(&means(&inner))),
        pressure_inner_of_seeds: inner.iter().map(|p| largest(p)).collect(),
        fields: fields(reference, runs, affine),
        displacement: displacement(reference, runs),
    })
}

/// Refuses to compare a run that recorded T at other points \[m\] than the discs.
///
/// # Errors
/// [`ReferenceError::Parameter`].
pub fn check_points(points: &[[f64; 2]], discs: &Results) -> Result<(), ReferenceError> {
    let near = 1e-6 * discs.size[0].max(discs.size[1]);
    let same = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs() <= near && (a[1] - b[1]).abs() <= near;
    if points.len() == discs.probes.len() && points.iter().zip(&discs.probes).all(same) {
        return Ok(());
    }
    let words = |points: &[[f64; 2]]| {
        let words: Vec<String> = points.iter().map(|[x, y]| format!("({x} {y})")).collect();
        words.join(" ")
    };
    Err(ReferenceError::Parameter {
        key: "points of spaceProbes [m]",
        value: words(points),
        allowed: format!("{}, the probes of the discs' result", words(&discs.probes)),
    })
}

/// Refuses to compare a case with discs that have other grains.
///
/// # Errors
/// [`ReferenceError::Parameter`] with the first property that differs.
pub fn check_grains(case: &Case, discs: &Results) -> Result<(), ReferenceError> {
    let own = Properties::of(case).values();
    match discs.properties().into_iter().zip(own).find(|(found, own)| (found.1 / own.1 - 1.0).abs() > 1e-9) {
        None => Ok(()),
        Some(((key, found), (_, own))) => Err(ReferenceError::Parameter {
            key,
            value: format!("{} in the discs' result", number(found)),
            allowed: format!("{}, as in the case: run the discs again (msdd reference run)", number(own)),
        }),
    }
}

/// Errors of T at each probe of one run (rows of time and a temperature for each probe of the discs) against the means over
/// the windows around the probes in the discs of one packing: solver minus discs where it is largest [% of `range`, which is
/// in K]. Only the times of the discs between the first and last of the solver's are compared.
///
/// # Errors
/// [`ReferenceError::Parameter`]: rows with another number of temperatures than the discs have probes, or a run that ends at
/// another time than the discs (more than a tenth apart).
pub fn temperature_errors(run: &[Vec<f64>], discs: &Results, range: f64) -> Result<Vec<f64>, ReferenceError> {
    let times = discs.series.column("time").unwrap_or_default();
    let probes = discs.probes.len();
    let wrong = |key, value: String, allowed: String| Err(ReferenceError::Parameter { key, value, allowed });
    if let Some(row) = run.iter().find(|row| row.len() != 1 + probes) {
        let allowed = format!("{probes}, one for each probe of the discs");
        return wrong(
            "temperatures in a row of spaceProbes",
            row.len().saturating_sub(1).to_string(),
            allowed,
        );
    }
    let (first, last) = (run.first().map_or(0.0, |r| r[0]), run.last().map_or(0.0, |r| r[0]));
    let end = times.last().copied().unwrap_or(0.0);
    if (last - end).abs() > 0.1 * end {
        return wrong(
            "last time of the solver's run",
            format!("{last} s"),
            format!("about {end} s, the end of the discs"),
        );
    }
    let error = |probe: usize| {
        let values = discs.series.column(&format!("T_P{probe}_window")).unwrap_or_default();
        let series: Vec<[f64; 2]> = run.iter().map(|row| [row[0], row[probe]]).collect();
        let inside = times.iter().zip(&values).filter(|(t, _)| (first..=last).contains(*t));
        let differences: Vec<f64> = inside.map(|(&t, v)| 100.0 / range * (at(&series, t) - v)).collect();
        largest(&differences)
    };
    Ok((1..=probes).map(error).collect())
}

/// Mean pressure of the solver minus a column of the discs [% of the paper's range], by packing; `None` when the discs do not
/// have the column.
fn pressure_differences(reference: &Reference, runs: &[&Run], column: &str) -> Vec<Vec<f64>> {
    let (times, scale) = (reference.times(), 100.0 / pressure_range(&reference.case));
    let series = reference.series(column);
    if series.iter().any(Vec::is_empty) {
        return Vec::new();
    }
    let of =
        |(run, dem): (&&Run, Vec<f64>)| difference(&times, &with_start(&run.pressure, dem[0]), &dem, scale);
    runs.iter().zip(series).map(of).collect()
}

fn means(by_packing: &[Vec<f64>]) -> Vec<f64> {
    statistics(by_packing).into_iter().map(|(mean, _)| mean).collect()
}

/// The series with the value at the start in front, which the solver does not write.
pub fn with_start(series: &[[f64; 2]], start: f64) -> Vec<[f64; 2]> {
    match series.first() {
        Some(first) if first[0] > 1e-9 => [&[[0.0, start]], series].concat(),
        _ => series.to_vec(),
    }
}

/// A series less that of DEM at its times, times a factor.
pub fn difference(times: &[f64], series: &[[f64; 2]], dem: &[f64], scale: f64) -> Vec<f64> {
    times.iter().zip(dem).map(|(&t, &value)| scale * (at(series, t) - value)).collect()
}

/// (quantity, column of the reference, factor to the solver's unit, unit)
fn quantities(affine: bool) -> [(&'static str, &'static str, f64, &'static str); 6] {
    let k = GRAIN_CONDUCTIVITY;
    let (xx, yy) = if affine {
        ("conductivity_xx", "conductivity_yy")
    } else {
        ("conductivity_network_xx", "conductivity_network_yy")
    };
    [
        ("porosity", "porosity", 1.0, "-"),
        ("fabric_index", "fabric_index", 1.0, "-"),
        ("conductivity_xx", xx, k, "W/(m K)"),
        ("conductivity_yy", yy, k, "W/(m K)"),
        ("stress_xx", "stress_xx", 1.0, "Pa"),
        ("stress_yy", "stress_yy", 1.0, "Pa"),
    ]
}

/// A quantity of [`COLUMNS`] in the sub-regions of a run.
pub fn sub_regions(run: &Run, quantity: &str) -> Vec<f64> {
    let Some(k) = COLUMNS.iter().position(|column| *column == quantity) else { return Vec::new() };
    run.sub_regions.iter().map(|row| row[k]).collect()
}

/// A quantity in the sub-regions of the reference, in the solver's units, by packing.
pub fn reference_sub_regions(reference: &Reference, quantity: &str, affine: bool) -> Vec<Vec<f64>> {
    scaled(quantity, affine, |column| reference.sub_regions(column))
}

/// As [`reference_sub_regions`], at the start.
pub fn reference_start(reference: &Reference, quantity: &str, affine: bool) -> Vec<Vec<f64>> {
    scaled(quantity, affine, |column| reference.sub_regions_start(column))
}

fn scaled(quantity: &str, affine: bool, read: impl Fn(&str) -> Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let table = quantities(affine);
    let Some((_, column, factor, _)) = table.iter().find(|q| q.0 == quantity) else { return Vec::new() };
    let in_units = |values: Vec<f64>| values.into_iter().map(|v| factor * v).collect();
    read(column).into_iter().map(in_units).collect()
}

fn fields(reference: &Reference, runs: &[&Run], affine: bool) -> Vec<FieldError> {
    quantities(affine)
        .iter()
        .map(|&(quantity, _, _, unit)| {
            let dem = reference_sub_regions(reference, quantity, affine);
            let solver: Vec<Vec<f64>> = runs.iter().map(|run| sub_regions(run, quantity)).collect();
            let pairs = solver.iter().flatten().zip(dem.iter().flatten());
            let differences: Vec<f64> = pairs.map(|(s, d)| s - d).collect();
            let inner = |k: usize| (1..9).contains(&(k % 10)) && k % 30 / 10 == 1;
            let inside: Vec<f64> =
                (0..differences.len()).filter(|&k| inner(k)).map(|k| differences[k]).collect();
            let both = [&solver, &dem].map(|values| spread(values));
            FieldError {
                quantity: quantity.to_string(),
                unit: unit.to_string(),
                rms: root_mean_square(&differences),
                rms_inner: root_mean_square(&inside),
                worst: largest(&differences),
                means: both.map(|b| b.0),
                deviations: both.map(|b| b.1),
            }
        })
        .collect()
}

fn displacement(reference: &Reference, runs: &[&Run]) -> Option<f64> {
    let solver: Vec<Vec<f64>> = runs.iter().map(|run| run.displacement.clone()).collect::<Option<_>>()?;
    let (solver, dem) = (means(&solver), means(&reference.slices("displacement_x")));
    let differences: Vec<f64> = solver.iter().zip(&dem).map(|(s, d)| s - d).collect();
    let most = largest(&dem).abs();
    // Where nothing moves because of symmetry, the ratio would be meaningless.
    (most > 1e-3).then(|| 100.0 * largest(&differences) / most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn temperatures_are_compared_at_all_probes_of_the_discs_and_at_no_others() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let discs = Results::read(&checkout.join("cases/reference/results/corner_seed11.json")).unwrap();
        let columns =
            ["time", "T_P1_window", "T_P2_window", "T_P3_window"].map(|c| discs.series.column(c).unwrap());
        let rows: Vec<Vec<f64>> =
            (0..columns[0].len()).map(|k| columns.iter().map(|column| column[k]).collect()).collect();
        assert_eq!(temperature_errors(&rows, &discs, 50.0).unwrap(), [0.0; 3]);
        let two: Vec<Vec<f64>> = rows.iter().map(|row| row[..3].to_vec()).collect();
        let error = temperature_errors(&two, &discs, 50.0).unwrap_err().to_string();
        assert!(error.starts_with("temperatures in a row of spaceProbes = 2, allowed: 3"), "{error}");
        assert!(check_points(&discs.probes, &discs).is_ok());
        let error = check_points(&discs.probes[..2], &discs).unwrap_err().to_string();
        assert!(error.starts_with("points of spaceProbes [m] = ("), "{error}");
        let mut moved = discs.probes.clone();
        moved[1][0] += 0.01;
        assert!(check_points(&moved, &discs).is_err());
        let error = temperature_errors(&rows[..100], &discs, 50.0).unwrap_err().to_string();
        assert!(error.contains("last time of the solver's run"), "{error}");
    }
    use std::path::Path;

    #[test]
    fn discs_of_other_grains_are_not_compared() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let case = Case::read(&checkout.join("cases/corner")).unwrap();
        let older = Results::read(&checkout.join("cases/reference/results/corner_seed11.json")).unwrap();
        assert!(check_grains(&case, &older).is_ok());
        let newer = Results { properties: Some(Properties::of(&case)), ..older.clone() };
        assert!(check_grains(&case, &newer).is_ok());
        let mut other = case.clone();
        other.material.friction_angle = 0.3;
        for discs in [&older, &newer] {
            let error = check_grains(&other, discs).unwrap_err().to_string();
            assert!(error.starts_with("friction_angle = 0.5 in the discs' result, allowed: 0.3,"), "{error}");
        }
        let mut other = case.clone();
        other.thermal.expansion *= 2.0;
        let error = check_grains(&other, &newer).unwrap_err().to_string();
        assert!(error.starts_with("expansion = "), "{error}");
        other.radii = [0.8, 1.2];
        assert!(check_grains(&other, &older).unwrap_err().to_string().starts_with("smallest radius"));
    }

    /// A run with the results of the reference, but `offset` warmer [K] and with the pressure times `factor`.
    fn echo(reference: &Reference, packing: usize, offset: f64, factor: f64) -> Run {
        let times = reference.times();
        let temperature = reference.temperature();
        let pressure = &reference.series("pressure")[packing];
        let column = |q: &str| reference_sub_regions(reference, q, false)[packing].clone();
        let columns = COLUMNS.map(|q| if q == "T" || q == "pressure" { vec![0.0; 30] } else { column(q) });
        Run {
            temperature: (1..times.len())
                .map(|k| {
                    let [p1, p2, p3] = [0, 1, 2].map(|p| temperature[p][packing][k]);
                    [times[k], p1 + offset, p2, p3]
                })
                .collect(),
            pressure: (1..times.len()).map(|k| [times[k], factor * pressure[k]]).collect(),
            sub_regions: (0..30).map(|k| columns.iter().map(|c| c[k]).collect()).collect(),
            ..Run::default()
        }
    }

    #[test]
    fn the_reference_has_no_error_against_itself_and_an_offset_is_found() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let reference = Reference::read(&checkout, "HC", &[1, 2]).unwrap();
        let runs = [echo(&reference, 0, 2.0, 1.0), echo(&reference, 1, -1.0, 1.0)];
        let found = errors(&reference, &runs.iter().collect::<Vec<_>>(), false).unwrap();
        assert!((found.temperature[0] - 0.5).abs() < 1e-9, "{:?}", found.temperature);
        assert!(found.temperature[1].abs() < 1e-9 && (found.largest_temperature() - 0.5).abs() < 1e-9);
        assert!((found.temperature_of_seeds[1][0] + 1.0).abs() < 1e-9);
        assert!(found.pressure.abs() < 1e-9 && found.field("stress_xx").unwrap().rms < 1e-9);
        let short = Run { temperature: runs[0].temperature[..100].to_vec(), ..runs[0].clone() };
        assert!(errors(&reference, &[&short, &runs[1]], false).is_none());
    }
}
