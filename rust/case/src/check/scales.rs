//! Checks temperatures, lengths and times of a case against each other.

use super::control::{CONTROL, Times};
use super::domain::{BLOCKS, Mesh};
use super::fields::Values;
use super::finding::Findings;
use super::state::Bed;
use super::tables;
use crate::dictionary::{Dictionary, Entry, Token};
use crate::grains::Grains;
use crate::numbers::rounded;
use crate::values::grains_in;
use msdd_rve::message::number;

/// Number of grains in a cell below which a mean over them says little.
const LEAST_GRAINS: f64 = 4.0;
/// Least width of a box in mean radii: four grains side by side.
const LEAST_RADII: f64 = 8.0;
/// Largest thermal strain that the shipped models were trained with [-].
const MOST_STRAIN: f64 = 0.05;
/// Usual range of the end time over the time in which heat spreads; outside of it, the check reports a doubt.
const USUAL_END: [f64; 2] = [0.02, 50.0];

/// The parts of a case that could be read. What is not known is not checked.
pub struct Scene<'a> {
    mesh: &'a Mesh,
    times: Option<Times>,
    /// Initial T [K].
    start: Option<&'a Values>,
    /// Names of the walls (patches whose type is not `empty`), and the temperatures that each has over time [K]; no
    /// temperatures for a boundary condition that sets none.
    walls: Vec<(String, Vec<f64>)>,
    /// Whether a wall has a boundary condition other than a temperature or insulation, so that its effect is not known.
    strange: bool,
    /// Heat released [W/m³].
    source: f64,
    has_source: bool,
}

impl<'a> Scene<'a> {
    pub fn new(
        temperature: Option<&Dictionary>,
        start: Option<&'a Values>,
        sources: Option<&Dictionary>,
        mesh: &'a Mesh,
        times: Option<Times>,
    ) -> Self {
        let mut scene = Self {
            mesh,
            times,
            start,
            walls: Vec::new(),
            strange: false,
            source: 0.0,
            has_source: sources.is_some(),
        };
        if let Some(boundary) = temperature.and_then(|file| file.dictionary_at("boundaryField").ok()) {
            for [name, kind] in &mesh.patches {
                if kind != "empty" {
                    scene.read_wall(name, boundary);
                }
            }
        }
        if let Some(sources) = sources {
            scene.source = source_of(sources);
        }
        scene
    }

    fn read_wall(&mut self, name: &str, boundary: &Dictionary) {
        let Some(Entry::Dictionary(patch)) = self.mesh.condition(boundary, name) else { return };
        let kind = patch.text("type").unwrap_or_default();
        let times = self.times.map(|times| [times.start, times.start + times.end]);
        let values = match kind.as_str() {
            "fixedValue" => patch.value("value").map(numbers_in).unwrap_or_default(),
            "uniformFixedValue" => tables::values(patch, "uniformValue", times).unwrap_or_else(|| {
                self.strange = true;
                Vec::new()
            }),
            "zeroGradient" => Vec::new(),
            _ => {
                self.strange = true;
                Vec::new()
            }
        };
        self.walls.push((name.to_string(), values));
    }

    /// Names of the walls, and the temperatures of each over time \[K\].
    pub fn walls(&self) -> &[(String, Vec<f64>)] {
        &self.walls
    }

    /// Temperatures of all walls over time \[K\].
    pub fn wall_temperatures(&self) -> impl Iterator<Item = f64> {
        self.walls.iter().flat_map(|(_, values)| values.iter().copied())
    }

    /// Whether there are heat sources.
    pub fn is_heated(&self) -> bool {
        self.has_source
    }

    /// Reports walls below 0 K, and a case in which nothing heats or cools.
    pub fn check_walls(&self, found: &mut Findings) {
        for (name, values) in &self.walls {
            if let Some(value) = values.iter().find(|value| value.is_nan() || **value < 0.0) {
                let place = format!("boundaryField/{name}");
                found.error(
                    ["0/T", &place],
                    &format!("{} K", number(*value)),
                    ">= 0 K",
                    "Temperatures are in Kelvin",
                );
            }
        }
        let Some(start) = self.start else { return };
        let all = start.numbers.iter().map(|value| value[0]);
        let [least, most] = self.range(all.clone());
        let quiet = !self.strange && !self.has_source && !self.walls.is_empty();
        if quiet && most - least <= 1e-9 * most.abs() {
            let advice = "No wall has another temperature than the bed, and there is no heat source: nothing will happen. Give a \
                          wall a temperature, such as { type fixedValue; value uniform 350; }";
            found.doubt(["0/T", "boundaryField"], "nothing heats or cools", "", advice);
        }
    }

    /// Least and largest temperature of these and of all walls [K].
    fn range(&self, values: impl Iterator<Item = f64>) -> [f64; 2] {
        values
            .chain(self.wall_temperatures())
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], value| [a.min(value), b.max(value)])
    }

    /// Checks the sizes of cells and box against that of the grains.
    pub fn check_cells(&self, grains: &Grains, porosity: f64, found: &mut Findings) {
        if let Some([width, height]) = self.mesh.cell() {
            let count = grains_in(width * height, porosity, grains.mean_radius);
            if count < LEAST_GRAINS {
                let value = format!("{} grains in a cell", number(rounded(count, 2)));
                let side = number(rounded(crate::scene::CELL_RADII * grains.mean_radius, 2));
                let advice = format!(
                    "A cell describes the mean over its grains, which says little for so few, even if the result looks smooth: make \
                     cells of about {side} m (fewer of them), or check meanRadius, which is {} m",
                    number(grains.mean_radius)
                );
                found.doubt([BLOCKS, "blocks"], &value, "about 4 and more", &advice);
            }
        }
        let Some([low, high]) = self.mesh.bounds else { return };
        let narrow = (high[0] - low[0]).min(high[1] - low[1]);
        if narrow < LEAST_RADII * grains.mean_radius {
            let value = format!(
                "a box {} m wide, {} grains",
                number(rounded(narrow, 3)),
                number(rounded(0.5 * narrow / grains.mean_radius, 2))
            );
            let advice = "With so few grains side by side, the walls arrange them, and a bed's mean properties say little. Are the \
                          lengths in metres (key scale)?";
            found.doubt([BLOCKS, "vertices"], &value, "about 4 grains side by side and more", advice);
        }
    }

    /// Checks the thermal strains against the range that the model was trained with. `walk` is called with a strain and its
    /// temperature, and follows the state of the bed to this strain.
    pub fn check_strains(
        &self,
        grains: &Grains,
        bed: &Bed,
        found: &mut Findings,
        walk: impl Fn([f64; 2], &mut Findings),
    ) {
        let Some(start) = self.start else { return };
        let initial = start.mean(0);
        let [least, most] = self.range(start.numbers.iter().map(|value| value[0]));
        // In the steady state, a source q raises T by q L²/(2 K) at the distance L from the wall.
        let rise = self.way().map_or(0.0, |way| self.source * way * way / (2.0 * bed.conductivity));
        for temperature in [least + rise.min(0.0), most + rise.max(0.0)] {
            let strain = grains.thermal_expansion * (temperature - initial);
            if strain.abs() > 1.0001 * MOST_STRAIN {
                let value = format!(
                    "{} times {} K = {}",
                    number(grains.thermal_expansion),
                    number(rounded(temperature - initial, 3)),
                    number(rounded(strain, 3))
                );
                let source = if rise == 0.0 {
                    ""
                } else {
                    " (Estimated from the steady state with the heat source and the initial conductivity. Grains that expand \
                     conduct better, so the bed gets less hot.)"
                };
                let advice = format!(
                    "The strain from the initial to the highest or lowest temperature is outside of what the model was trained with. The \
                     solver adds it up in small steps, but the accuracy of the result has not been measured{source}"
                );
                let advice = advice.as_str();
                found.doubt(
                    [super::grains::FILE, "thermalExpansion"],
                    &value,
                    "strains from -0.05 to 0.05",
                    advice,
                );
            } else if strain.abs() > 1e-4 {
                walk([strain, rounded(temperature, 4)], found);
            }
        }
    }

    /// Length over which heat has to spread [m]: half the box between two walls that have a temperature, the whole box when
    /// only one has.
    fn way(&self) -> Option<f64> {
        let [low, high] = self.mesh.bounds?;
        let warm = |name: &str| self.walls.iter().any(|(wall, values)| wall == name && !values.is_empty());
        let way = |k: usize, a: &str, b: &str| match (warm(a), warm(b)) {
            (true, true) => Some(0.5 * (high[k] - low[k])),
            (false, false) => None,
            _ => Some(high[k] - low[k]),
        };
        match (way(0, "left", "right"), way(1, "bottom", "top")) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    /// Checks the end time and the time step against the time in which heat spreads.
    pub fn check_times(&self, bed: &Bed, found: &mut Findings) {
        let Some(times) = self.times else { return };
        if let Some(way) = self.way() {
            let whole = way * way / bed.diffusivity;
            let ratio = times.end / whole;
            let steady =
                self.walls.iter().all(|(_, values)| values.windows(2).all(|pair| pair[0] == pair[1]));
            let value = format!("{} s", number(times.start + times.end));
            let shown = number(rounded(whole, 2));
            if ratio < USUAL_END[0] {
                let reach = number(rounded((bed.diffusivity * times.end).sqrt(), 2));
                let advice = format!(
                    "Heat takes about {shown} s to spread over the {} m between wall and middle; by the end it has come some {reach} m \
                     far",
                    number(rounded(way, 3))
                );
                found.doubt([CONTROL, "endTime"], &value, "", &advice);
            } else if ratio > USUAL_END[1] && steady {
                let advice = format!(
                    "Heat takes about {shown} s to spread; long before the end nothing changes any more"
                );
                found.doubt([CONTROL, "endTime"], &value, "", &advice);
            }
        }
        if let Some([width, height]) = self.mesh.cell() {
            let side = width.min(height);
            let crossed = side * side / bed.diffusivity;
            if !times.adaptive && times.step > crossed {
                let advice = format!(
                    "Heat crosses a cell in {} s. Longer steps are stable, but inaccurate at the beginning. Take shorter ones, or \
                     adaptive ones (adjustTimeStep yes, timeScheme secondOrder)",
                    number(rounded(crossed, 2))
                );
                found.doubt([CONTROL, "deltaT"], &format!("{} s", number(times.step)), "", &advice);
            }
        }
    }
}

/// All numbers among the tokens, but for the length of a list in front of it.
fn numbers_in(tokens: &[Token]) -> Vec<f64> {
    let open = tokens.iter().position(|token| ["(", "{"].contains(&token.text.as_str())).unwrap_or(0);
    tokens[open..].iter().filter_map(|token| token.text.parse().ok()).collect()
}

/// Sum of the constant sources of T [W/m³] that are given per volume.
fn source_of(sources: &Dictionary) -> f64 {
    let of = |source: &Dictionary| {
        let inner = source.get("scalarSemiImplicitSourceCoeffs");
        let source = if let Some(Entry::Dictionary(inner)) = inner { inner } else { source };
        let rates = source.dictionary_at("injectionRateSuSp").ok()?;
        let specific = source.text("volumeMode").is_ok_and(|mode| mode == "specific");
        // Regions of OpenFOAM's own solvers are solved for the enthalpy
        let rate = rates.value("T").or_else(|_| rates.value("h"));
        specific.then(|| rate.map(numbers_in).unwrap_or_default().first().copied()).flatten()
    };
    let all = sources.keys().filter_map(|key| match sources.get(&key.text) {
        Some(Entry::Dictionary(source)) => of(source),
        _ => None,
    });
    all.sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(left: &str) -> Vec<String> {
        let text = format!("boundaryField {{ left {{ {left} }} right {{ type zeroGradient; }} }}");
        let file = Dictionary::parse(Path::new("0/T"), &text).unwrap();
        let start = Values { numbers: vec![vec![300.0]], uniform: true };
        let patches = [["left", "wall"], ["right", "wall"]].map(|pair| pair.map(str::to_string)).to_vec();
        let mesh = Mesh { patches, ..Mesh::default() };
        let times = Times { start: 0.0, end: 100.0, step: 1.0, adaptive: false };
        let mut found = Findings::default();
        Scene::new(Some(&file), Some(&start), None, &mesh, Some(times)).check_walls(&mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn walls_are_judged_by_their_temperatures_alone() {
        for good in [
            "type fixedValue; value nonuniform List<scalar> 2 ( 310 320 );",
            "type uniformFixedValue; uniformValue polynomial ((350 0) (-0.1 1));",
            "type uniformFixedValue; uniformValue table 2 ((-10 300) (10 400));",
            "type uniformFixedValue; uniformValue sine; uniformValueCoeffs { level 330; }",
            "type uniformFixedValue; uniformValue { type csvFile; file \"w.csv\"; }",
            "type uniformFixedValue; uniformValue table; uniformValueCoeffs { uniformValue table ((0 300) (10 400)); }",
            "type uniformFixedValue; uniformValue { type table; uniformValue table ((0 300) (10 400)); }",
        ] {
            assert_eq!(lines(good), Vec::<String>::new(), "{good}");
        }
        let cold = lines("type uniformFixedValue; uniformValue polynomial ((350 0) (-4 1));");
        assert!(cold[0].starts_with("error: 0/T: boundaryField/left = -10 K"), "{cold:?}");
        let cold = lines(
            "type uniformFixedValue; uniformValue table; uniformValueCoeffs { uniformValue table ((0 300) (9 -4)); }",
        );
        assert!(cold[0].starts_with("error: 0/T: boundaryField/left = -4 K"), "{cold:?}");
        assert!(lines("type fixedValue; value uniform 300;")[0].contains("nothing heats or cools"));
        assert!(lines("type uniformFixedValue; uniformValue 300;")[0].contains("nothing heats or cools"));
    }
}
