//! 90 % bands around the values of the chosen run, at the points and times at which runs are compared.

use crate::ChoiceError;
use crate::bands::{Law, Lengths};
use crate::found::{Differences, Values};
use crate::quantity::Quantity;
use crate::scene::Scene;
use crate::trial::Outcome;
use msdd_case::numbers::plain;
use msdd_files::write;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::path::Path;

/// Name of the table in the folder of the chosen run.
pub const FILE: &str = "bands.csv";
const HEAD: &str = "time,x,y,z,quantity,unit,value,low,high,time_error,space_error,motion_error,constant_error,model,packing\n";

/// A band at a point and a time. All parts are halves of a band, in the unit of the quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    pub quantity: Quantity,
    /// Time \[s\], and number of the point.
    pub time: f64,
    pub point: usize,
    pub value: f64,
    pub parts: Parts,
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
}

/// The bands of a run, of the quantities that the law knows and the mesh has. `space`: error of its cells at points and times.
pub fn bands(scene: &Scene, run: &Outcome, seen: &Differences, space: &Values, law: &Law) -> Vec<Band> {
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
                bands.push(Band { quantity, time, point, value, parts });
            }
        }
    }
    bands
}

/// Means of the bands of each quantity.
pub fn means(bands: &[Band]) -> Vec<MeanBand> {
    let of = |quantity: Quantity| {
        let own: Vec<&Band> = bands.iter().filter(|band| band.quantity == quantity).collect();
        let rms = |part: &dyn Fn(&Parts) -> f64| {
            (own.iter().map(|band| part(&band.parts).powi(2)).sum::<f64>() / own.len() as f64).sqrt()
        };
        let parts = Parts {
            time: rms(&|parts| parts.time),
            space: rms(&|parts| parts.space),
            motion: rms(&|parts| parts.motion),
            constant: rms(&|parts| parts.constant),
            model: rms(&|parts| parts.model),
            packing: rms(&|parts| parts.packing),
        };
        let half = rms(&Parts::half);
        (!own.is_empty()).then(|| MeanBand { quantity, unit: quantity.unit().to_string(), half, parts })
    };
    Quantity::ALL.into_iter().filter_map(of).collect()
}

/// The table of bands.
pub fn table(scene: &Scene, bands: &[Band]) -> String {
    let mut text = HEAD.to_string();
    for Band { quantity, time, point, value, parts } in bands {
        let [x, y, z] = scene.points[*point];
        let half = parts.half();
        let place: Vec<String> = [*time, x, y, z].into_iter().map(|number| rounded(number, 7)).collect();
        let numbers: Vec<String> = [*value, value - half, value + half]
            .into_iter()
            .chain(parts.all())
            .map(|number| rounded(number, 7))
            .collect();
        let (name, unit) = (quantity.name(), quantity.unit());
        let _ = writeln!(text, "{},{name},{unit},{}", place.join(","), numbers.join(","));
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
pub fn write_table(scene: &Scene, bands: &[Band], folder: &Path) -> Result<(), ChoiceError> {
    Ok(write(&folder.join(FILE), table(scene, bands).as_bytes())?)
}

/// The means as a table for people.
pub fn text(means: &[MeanBand]) -> String {
    let mut text =
        "90 % bands around the run, half their width, mean over bed and run, and where it comes from:\n"
            .to_string();
    let _ = writeln!(
        text,
        "{:16} {:>8}  {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "", "", "+-", "steps", "cells", "motion", "constant", "model", "packing"
    );
    for MeanBand { quantity, unit, half, parts } in means {
        let numbers: Vec<String> = std::iter::once(*half)
            .chain(parts.all())
            .map(|number| format!("{:>9}", rounded(number, 3)))
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
        let band = |value| Band { quantity: Quantity::Pressure, time: 1.0, point: 0, value, parts };
        let means = means(&[band(1.0), band(2.0)]);
        assert_eq!((means.len(), means[0].half, means[0].parts), (1, 13.0, parts));
        assert!(text(&means).contains("pressure"));
    }
}
