//! 90 % bands around the values of the chosen run, at the points and times at which runs are compared.

use crate::ChoiceError;
use crate::bands::{Law, Lengths};
use crate::found::{Differences, Values};
use crate::quantity::Quantity;
use crate::trial::{Beyond, Outcome};
use crate::user_case::UserCase;
use msdd_case::numbers::plain;
use msdd_files::write;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::path::Path;

/// Name of the table in the folder of the chosen run.
pub const FILE: &str = "bands.csv";
const HEAD: &str = "time,x,y,z,quantity,unit,value,low,high,time_error,space_error,motion_error,constant_error,model,packing,beyond\n";

/// A band at a point and a time. All parts are halves of a band, in the unit of the quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    pub quantity: Quantity,
    /// Time \[s\], and number of the point.
    pub time: f64,
    pub point: usize,
    pub value: f64,
    pub parts: Parts,
    /// Of p, a factor: half of the band is a share of this size \[Pa\].
    pub size: Option<f64>,
    /// Whether there is no band, because the model was not compared with such a bed.
    pub beyond: bool,
}

impl Band {
    /// Ends of the band. That of p is a factor, so that it has no end below 0.
    pub fn ends(&self) -> [f64; 2] {
        let half = self.parts.half();
        match self.size {
            Some(size) => [self.value.max(0.0) / (half / size).exp(), size * (half / size).exp()],
            None => [self.value - half, self.value + half],
        }
    }
}

/// Where a band comes from. What is not known is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Parts {
    /// Errors of steps and cells, of grains that stay, and of a constant conductivity.
    pub time: f64,
    pub space: f64,
    pub motion: f64,
    pub constant: f64,
    /// What the model leaves out, and the scatter of packings.
    pub model: f64,
    pub packing: f64,
}

impl Parts {
    /// Half of the whole band: numerical errors add up; model and packing are independent of them and of each other.
    pub fn half(&self) -> f64 {
        (self.time + self.space + self.motion + self.constant).hypot(self.model).hypot(self.packing)
    }

    fn all(&self) -> [f64; 6] {
        [self.time, self.space, self.motion, self.constant, self.model, self.packing]
    }
}

/// The bands of a quantity in the mean.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeanBand {
    pub quantity: Quantity,
    pub unit: String,
    /// Half of the band, root of the mean square over bed and run; and that of each part.
    pub half: f64,
    pub parts: Parts,
    /// Of p: the factor, root of the mean square of its logarithm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub factor: Option<f64>,
}

/// The bands of a run, of the quantities that the law covers and the mesh has. `space`: error of its cells at points and times.
pub fn bands(scene: &UserCase, run: &Outcome, seen: &Differences, space: &Values, law: &Law) -> Vec<Band> {
    let lengths = Lengths::new(&scene.bed, run, &seen.sensitivity);
    let mut bands = Vec::new();
    for (&quantity, series) in &run.values {
        let Some(numbers) = law.of(quantity).filter(|_| scene.in_space || !quantity.leaves_plane()) else {
            continue;
        };
        for (index, (&time, row)) in series.times.iter().zip(&series.values).enumerate() {
            let part = |of: &Values, point: usize| {
                let value = of.get(&quantity).and_then(|series| series.at(time)?.get(point).copied());
                value.filter(|value| value.is_finite()).map_or(0.0, f64::abs)
            };
            for (point, &value) in row.iter().enumerate().filter(|(_, value)| value.is_finite()) {
                let units = lengths.units(quantity, index, point).unwrap_or_default();
                let [model, packing] = numbers.halves(&units);
                let [time_error, space, motion, constant] =
                    [&seen.time, space, &seen.motion, &seen.constant].map(|of| part(of, point));
                let parts = Parts { time: time_error, space, motion, constant, model, packing };
                let size = (quantity == Quantity::Pressure).then(|| lengths.pressure_size(value, point));
                let beyond = run.beyond.as_ref().is_some_and(|beyond| time >= beyond.since);
                bands.push(Band { quantity, time, point, value, parts, size, beyond });
            }
        }
    }
    bands
}

/// Means of the bands of each quantity, where there are any.
pub fn means(bands: &[Band]) -> Vec<MeanBand> {
    let of = |quantity: Quantity| {
        let own: Vec<&Band> = bands.iter().filter(|band| band.quantity == quantity && !band.beyond).collect();
        let root = |value: &dyn Fn(&Band) -> f64| {
            (own.iter().map(|band| value(band).powi(2)).sum::<f64>() / own.len() as f64).sqrt()
        };
        let rms = |part: &dyn Fn(&Parts) -> f64| root(&|band| part(&band.parts));
        let parts = Parts {
            time: rms(&|parts| parts.time),
            space: rms(&|parts| parts.space),
            motion: rms(&|parts| parts.motion),
            constant: rms(&|parts| parts.constant),
            model: rms(&|parts| parts.model),
            packing: rms(&|parts| parts.packing),
        };
        let half = rms(&Parts::half);
        let factor = (quantity == Quantity::Pressure)
            .then(|| root(&|band| band.parts.half() / band.size.unwrap_or(f64::INFINITY)).exp());
        (!own.is_empty()).then(|| MeanBand {
            quantity,
            unit: quantity.unit().to_string(),
            half,
            parts,
            factor,
        })
    };
    Quantity::ALL.into_iter().filter_map(of).collect()
}

/// The table of bands. Where there is none, cells are empty and the last says why: `beyond`.
pub fn table(scene: &UserCase, bands: &[Band], beyond: &str) -> String {
    let mut text = HEAD.to_string();
    let join =
        |numbers: &[f64]| numbers.iter().map(|&number| rounded(number, 7)).collect::<Vec<_>>().join(",");
    for band in bands {
        let [x, y, z] = scene.points[band.point];
        let place = join(&[band.time, x, y, z]);
        let [time, space, motion, constant, model, packing] = band.parts.all();
        let numerical = join(&[time, space, motion, constant]);
        let (name, unit, value) = (band.quantity.name(), band.quantity.unit(), join(&[band.value]));
        let _ = match band.beyond {
            true => writeln!(text, "{place},{name},{unit},{value},,,{numerical},,,{beyond}"),
            false => writeln!(
                text,
                "{place},{name},{unit},{value},{},{numerical},{},",
                join(&band.ends()),
                join(&[model, packing])
            ),
        };
    }
    text
}

/// A number with so many significant digits.
fn rounded(number: f64, digits: usize) -> String {
    plain(format!("{number:.*e}", digits - 1).parse().unwrap_or(number))
}

/// Writes the table into the folder of the chosen run.
///
/// # Errors
/// [`ChoiceError::File`].
pub fn write_table(
    scene: &UserCase,
    bands: &[Band],
    beyond: Option<&Beyond>,
    folder: &Path,
) -> Result<(), ChoiceError> {
    let beyond = beyond.map_or(String::new(), Beyond::brief);
    Ok(write(&folder.join(FILE), table(scene, bands, &beyond).as_bytes())?)
}

/// The means as a table for people, and from when on there are none.
pub fn text(means: &[MeanBand], beyond: Option<&Beyond>) -> String {
    let mut text = beyond.map_or(String::new(), |Beyond { since, what }| {
        format!(
            "No bands from {} s on: the run lies beyond what its model was compared with by DEM: {}.\n",
            plain(*since),
            what.join("; ")
        )
    });
    if means.is_empty() {
        return text;
    }
    text += "90 % bands around the run, half their width (of p: a factor), mean over bed and run, and where it comes from:\n";
    let _ = writeln!(
        text,
        "{:16} {:>8}  {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "", "", "+-", "steps", "cells", "motion", "constant", "model", "packing"
    );
    for MeanBand { quantity, unit, half, parts, factor } in means {
        let whole = factor.map_or_else(|| rounded(*half, 3), |factor| format!("x {}", rounded(factor, 3)));
        let numbers: Vec<String> = std::iter::once(whole)
            .chain(parts.all().map(|number| rounded(number, 3)))
            .map(|number| format!("{number:>9}"))
            .collect();
        let _ = writeln!(text, "{:16} {unit:>8}  {}", quantity.name(), numbers.join(" "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numerical_errors_add_up_and_the_rest_is_independent() {
        let parts = Parts { time: 1.0, space: 1.5, motion: 0.0, constant: 0.5, model: 4.0, packing: 12.0 };
        assert_eq!(parts.half(), 13.0);
        let band = |value, beyond| Band {
            quantity: Quantity::Pressure,
            time: 1.0,
            point: 0,
            value,
            parts,
            size: Some(26.0),
            beyond,
        };
        let means = means(&[band(1.0, false), band(2.0, false), band(1e9, true)]);
        assert_eq!((means.len(), means[0].half, means[0].parts), (1, 13.0, parts));
        assert_eq!(means[0].factor, Some(0.5f64.exp()));
        assert!(text(&means, None).contains("pressure"));
        // As wide as p itself, and more: no end lies below 0.
        let [low, high] = Band { size: Some(10.0), ..band(10.0, false) }.ends();
        assert!(low > 0.0 && (low * high - 100.0).abs() < 1e-9, "{low} {high}");
    }

    #[test]
    fn there_are_no_bands_beyond_what_was_compared() {
        let what = vec!["pressure up to 14 MPa, 140 times the largest (compared: 10 to 100 kPa)".to_string()];
        let beyond = Beyond { since: 2.0, what };
        assert_eq!(beyond.brief(), "pressure up to 14 MPa");
        let said = text(&[], Some(&beyond));
        assert!(said.contains("from 2 s on") && said.contains("140 times"), "{said}");
        assert!(!said.contains("90 %"));
    }
}
