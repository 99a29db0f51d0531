//! The temperatures that a bed has in a run, and the properties of its grains there.

use super::fields::Values;
use super::finding::Findings;
use super::grains::FILE;
use super::{keys, tables};
use crate::dictionary::Dictionary;
use crate::numbers::rounded;
use msdd_rve::message::number;

/// By how much a heat source is taken to warm the bed \[K\].
const HEATED: f64 = 500.0;
/// Distance of the temperatures that are looked at \[K\]; the solver samples functions so, too.
const STEP: f64 = 1.0;
/// The temperature at which the solver takes a property for its usual value \[K\].
const USUAL: f64 = 293.15;
/// The properties of grains that may depend on the temperature, and their units.
const PROPERTIES: [[&str; 2]; 2] = [["thermalConductivity", "W/(m K)"], ["heatCapacity", "J/(kg K)"]];

/// Temperatures of the bed.
pub struct Temperatures<'a> {
    /// At the start, in the cells \[K\].
    pub start: Option<&'a Values>,
    /// Of the walls \[K\].
    pub walls: Vec<f64>,
    /// Whether there are heat sources.
    pub heated: bool,
}

impl Temperatures<'_> {
    /// Of the cells at the start.
    pub fn at_start(&self) -> impl Iterator<Item = f64> {
        self.start.into_iter().flat_map(|start| &start.numbers).map(|value| value[0])
    }

    /// Those that cells may come to, from the start's outwards, so that the first of them is where something ends the run: upwards to the
    /// hottest wall, and 500 K beyond where heat is released, and downwards to the coldest. None where those of the start are not known.
    pub fn later(&self) -> impl Iterator<Item = f64> {
        let [least, most] =
            self.at_start().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], t| [a.min(t), b.max(t)]);
        let walls = self.walls.iter().copied();
        let hottest = walls.clone().fold(most, f64::max) + if self.heated { HEATED } else { 0.0 };
        let coldest = walls.fold(least, f64::min).max(0.0);
        let known = least <= most;
        let steps = move |way: f64| {
            let count = if known { (way / STEP) as u32 } else { 0 };
            (1..=count).map(|k| STEP * f64::from(k))
        };
        let up = steps(hottest - most).map(move |way| most + way).chain([hottest]);
        let down = steps(least - coldest).map(move |way| least - way).chain([coldest]);
        up.chain(down).filter(move |_| known)
    }
}

/// Checks that properties that depend on the temperature are above 0, as the solver demands: at its usual temperature and those of the
/// start, and wherever the bed comes later.
pub fn check(properties: &Dictionary, temperatures: &Temperatures, found: &mut Findings) {
    for [key, unit] in PROPERTIES {
        // Numbers are checked where they stand
        if !keys::is_function(properties, key) {
            continue;
        }
        let wrong = |t: f64| {
            tables::at(properties, key, t).filter(|value| value.is_nan() || *value <= 0.0).map(|v| [v, t])
        };
        let text = |[value, t]: [f64; 2]| {
            format!("{} {unit} at {} K", number(rounded(value, 4)), number(rounded(t, 5)))
        };
        if let Some(case) = std::iter::once(USUAL).chain(temperatures.at_start()).find_map(wrong) {
            found.error([FILE, key], &text(case), &format!("> 0 {unit}"), "The solver refuses it");
            continue;
        }
        // A cell does not quite come to the temperature of the wall beside it
        let ends = &temperatures.walls;
        if let Some(case) = temperatures.later().filter(|t| !ends.contains(t)).find_map(wrong) {
            let advice = "The run ends when a cell reaches this temperature";
            found.doubt([FILE, key], &text(case), &format!("> 0 {unit}"), advice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(text: &str, start: f64, walls: &[f64], heated: bool) -> Vec<String> {
        let properties = Dictionary::parse(Path::new(FILE), text).unwrap();
        let start = Values { numbers: vec![vec![start]], uniform: true };
        let temperatures = Temperatures { start: Some(&start), walls: walls.to_vec(), heated };
        let mut found = Findings::default();
        check(&properties, &temperatures, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn later_temperatures_go_from_the_start_to_the_walls() {
        let start = Values { numbers: vec![vec![300.0], vec![302.5]], uniform: false };
        let later = |start: Option<&Values>, walls: &[f64]| {
            Temperatures { start, walls: walls.to_vec(), heated: false }.later().collect::<Vec<_>>()
        };
        assert_eq!(later(Some(&start), &[305.0, 298.5]), [303.5, 304.5, 305.0, 299.0, 298.5]);
        assert_eq!(later(None, &[305.0]), Vec::<f64>::new());
    }

    #[test]
    fn properties_that_are_not_above_0_are_found_where_the_bed_is() {
        let falls = "heatCapacity polynomial ((400 0) (-1 1));";
        assert_eq!(
            lines(falls, 400.0, &[], false),
            [
                "error: constant/granularProperties: heatCapacity = 0 J/(kg K) at 400 K, allowed: > 0 J/(kg K). The solver refuses it"
            ]
        );
        assert_eq!(lines(falls, 300.0, &[350.0, 400.0], false), Vec::<String>::new());
        let later = "doubt: constant/granularProperties: heatCapacity = 0 J/(kg K) at 400 K, allowed: > 0 J/(kg K). The run ends when \
                     a cell reaches this temperature";
        assert_eq!(lines(falls, 300.0, &[402.0], false), [later]);
        assert_eq!(lines(falls, 300.0, &[], true), [later]);
        // Also where the bed never is: the solver asks for the value at 293.15 K
        let usual = lines("thermalConductivity table ((280 -1) (300 1));", 310.0, &[], false);
        assert!(usual.is_empty(), "{usual:?}");
        let usual = lines("thermalConductivity table ((290 -1) (300 1));", 310.0, &[], false);
        assert!(
            usual[0].starts_with(
                "error: constant/granularProperties: thermalConductivity = -0.37 W/(m K) at 293.15 K"
            ),
            "{usual:?}"
        );
        assert!(
            lines("heatCapacity constant -3;", 310.0, &[], false)[0].contains("= -3 J/(kg K) at 293.15 K")
        );
        assert_eq!(
            lines("heatCapacity -3; thermalConductivity csvFile;", 310.0, &[], true),
            Vec::<String>::new()
        );
    }
}
