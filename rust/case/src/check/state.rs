//! Checks the initial state against the range of the case's model, and the states to which expansion will lead.

use super::fields::Values;
use super::finding::Findings;
use super::grains::{FILE, field_name};
use crate::dictionary::Dictionary;
use crate::grains::Grains;
use crate::numbers::rounded;
use msdd_rve::message::number;
use msdd_surrogate::Surrogate;
use msdd_surrogate::surrogate::{Known, MAX_STATE};

/// Porosity [-] above which the solver refuses an initial state without stress, because no grains touch. The same value as in
/// networkModel.H.
const UNJAMMED: f64 = 0.22;
/// Number of steps in which the model is taken to a thermal strain.
const WALK: usize = 50;
/// Usual range of the initial mean pressure over that of packings of the same mean porosity; outside of it, the check reports
/// a doubt. Packings that were prepared with another friction differ by less than this.
const USUAL_PRESSURE: [f64; 2] = [0.6, 1.6];

/// Of stress [Pa] and conductivity [W/(m K)], by which the model's answers are multiplied.
type Scales = (f64, f64);

/// Places of xx, yy and xy in OpenFOAM's symmetric tensors.
const PLANE: [usize; 3] = [0, 3, 1];

/// The initial fields; stress is OpenFOAM's, tension positive.
pub struct Start<'a> {
    pub porosity: &'a Values,
    pub fabric_index: &'a Values,
    pub conductivity: Option<&'a Values>,
    pub stress: Option<&'a Values>,
}

impl Start<'_> {
    fn known(&self, (scale, grains): Scales, cell: usize) -> Known {
        Known {
            porosity: self.porosity.at(cell)[0],
            fabric_index: self.fabric_index.at(cell)[0],
            fabric_xy: 0.0,
            reduced_stress: self.stress.map(|values| PLANE.map(|k| -values.at(cell)[k] / scale)),
            conductivity: self.conductivity.map(|values| PLANE.map(|k| values.at(cell)[k] / grains)),
        }
    }

    fn mean(&self, (scale, grains): Scales) -> Known {
        Known {
            porosity: self.porosity.mean(0),
            fabric_index: self.fabric_index.mean(0),
            fabric_xy: 0.0,
            reduced_stress: self.stress.map(|values| PLANE.map(|k| -values.mean(k) / scale)),
            conductivity: self.conductivity.map(|values| PLANE.map(|k| values.mean(k) / grains)),
        }
    }

    fn cells(&self) -> usize {
        let all = [Some(self.porosity), Some(self.fabric_index), self.conductivity, self.stress];
        all.into_iter().flatten().map(|values| values.numbers.len()).max().unwrap_or(1)
    }
}

/// Mean properties of the bed, which other checks need.
pub struct Bed {
    /// Mean of K_xx and K_yy [W/(m K)].
    pub conductivity: f64,
    /// Thermal diffusivity [m²/s].
    pub diffusivity: f64,
    /// Share of the plane with grains, overlaps counted once [-].
    pub filled: f64,
}

/// Checks the state of every cell and returns the properties of the mean state.
pub fn check(
    model: &dyn Surrogate,
    start: &Start,
    grains: &Grains,
    file: &Dictionary,
    found: &mut Findings,
) -> Bed {
    let scale = (grains.stress_scale(), grains.thermal_conductivity);
    let outside = outside_at_start(model, start, scale);
    let loose = check_loose(start, file, found);
    for (column, name) in
        columns(model).iter().enumerate().filter(|(_, name)| !(loose && *name == "porosity"))
    {
        for side in [0, 1] {
            let [cells, far] = outside[column][side];
            if cells > 0.0 {
                report_outside(name, ["below", "above"][side], [cells, far], start.cells(), file, found);
            }
        }
    }
    check_stress(model, start, scale, found);
    let answer = model.evaluate(&model.initial_state(&start.mean(scale)), 0.0);
    let share = 0.5 * (answer.conductivity[0][0] + answer.conductivity[1][0]);
    let conductivity = share * grains.thermal_conductivity;
    let porosity = start.porosity.mean(0);
    let storage = grains.density * grains.heat_capacity * model.solid_fraction(porosity);
    Bed { conductivity, diffusivity: conductivity / storage, filled: 1.0 - porosity }
}

/// Names of the fields of the model's state columns, and of the thermal strain at the end.
fn columns(model: &dyn Surrogate) -> Vec<String> {
    let names = model.state_names().iter().map(|name| field_name(name));
    names.chain(["thermalStrain".to_string()]).collect()
}

/// For each state column and each side of the trained range: how many cells are outside, and by how much at most.
fn outside_at_start(model: &dyn Surrogate, start: &Start, scale: Scales) -> Vec<[[f64; 2]; 2]> {
    let count = model.state_names().len();
    let mut all = vec![[[0.0; 2]; 2]; count + 1];
    for cell in 0..start.cells() {
        let answer = model.evaluate(&model.initial_state(&start.known(scale, cell)), 0.0);
        for (column, sides) in all.iter_mut().enumerate().take(count) {
            let beyond = answer.outside[column][0];
            if beyond != 0.0 {
                let side = &mut sides[usize::from(beyond > 0.0)];
                *side = [side[0] + 1.0, f64::max(side[1], beyond.abs())];
            }
        }
    }
    all
}

/// What the solver will do with a state outside of the trained range: the value in the case, else the default of
/// regionPolicy.C.
fn policy(file: &Dictionary, column: &str, side: &str) -> String {
    let given = file
        .dictionary_at("surrogate")
        .ok()
        .and_then(|surrogate| surrogate.dictionary_at("outOfRegion").ok());
    let given = given.and_then(|all| all.dictionary_at(column).ok()).and_then(|sides| sides.text(side).ok());
    given.unwrap_or_else(|| match (column, side) {
        ("porosity", "below") | ("elasticCompression", "above") => "error".to_string(),
        ("thermalStrain", _) => "cutStep".to_string(),
        _ => "clamp".to_string(),
    })
}

fn report_outside(
    name: &str,
    side: &str,
    [cells, far]: [f64; 2],
    all: usize,
    file: &Dictionary,
    found: &mut Findings,
) {
    let place = if name == "porosity" || name == "fabricIndex" {
        format!("0/{name}")
    } else {
        "0/stress".to_string()
    };
    let who = if cells == all as f64 { "all cells".to_string() } else { format!("{cells} of {all} cells") };
    let far = number(rounded(far, 3));
    let value = format!("{who} have {name} {side} the region of the model, by up to {far}");
    match policy(file, name, side).as_str() {
        "error" => {
            let advice = format!(
                "The solver will refuse it: change the field, or give '{name} {{ {side} clamp; }}' in outOfRegion of {FILE} to \
                 have the nearest state of the region used"
            );
            found.error(
                [&place, "internalField"],
                &value,
                "packings that the model was trained with",
                &advice,
            );
        }
        _ => {
            let advice = "The model will be evaluated at the nearest end of its trained range";
            found.doubt(
                [&place, "internalField"],
                &value,
                "packings that the model was trained with",
                advice,
            );
        }
    }
}

/// Reports porosities that packings do not have. Returns whether porosities that are too large were reported.
fn check_loose(start: &Start, file: &Dictionary, found: &mut Findings) -> bool {
    let [densest, loosest] = crate::packing::POROSITIES;
    let all = || start.porosity.numbers.iter().map(|value| value[0]);
    let (least, most) = (all().fold(1.0, f64::min), all().fold(0.0, f64::max));
    if start.stress.is_some() {
        return false;
    }
    if least < densest {
        let advice = "That is denser than all packings that the model was trained with, and no stress is given: it takes that of \
                      the densest";
        let value = format!("down to {}", number(rounded(least, 4)));
        found.doubt(["0/porosity", "internalField"], &value, &format!("{densest} and above"), advice);
    }
    if most <= loosest {
        return false;
    }
    let given = file.dictionary_at("surrogate").and_then(|surrogate| surrogate.dictionary_at("outOfRegion"));
    let given = given.and_then(|all| all.dictionary_at("porosity")).and_then(|sides| sides.text("above"));
    let value = format!("up to {}", number(rounded(most, 4)));
    if most > UNJAMMED && given.as_deref().unwrap_or("error") == "error" {
        let advice = "Discs that fill so little of a plane do not touch, so the bed would not conduct: the solver refuses it. \
                      'porosity { above clamp; }' in outOfRegion has it treated as the loosest packing";
        found.error(["0/porosity", "internalField"], &value, &format!("at most {UNJAMMED}"), advice);
    } else {
        let advice = format!(
            "That is looser than all packings that the model was trained with; it will be evaluated at {loosest}"
        );
        found.doubt(["0/porosity", "internalField"], &value, &format!("at most {loosest}"), &advice);
    }
    true
}

/// Checks the initial pressure against that of packings of the same porosity.
fn check_stress(model: &dyn Surrogate, start: &Start, scales: Scales, found: &mut Findings) {
    let Some(stress) = start.stress else { return };
    let pressure = -0.5 * (stress.mean(0) + stress.mean(3));
    let place = ["0/stress", "internalField"];
    if stress.numbers.iter().any(|value| value[0] > 0.0 || value[3] > 0.0) {
        let advice = "OpenFOAM's stress is positive in tension, which grains cannot bear: compressed grains have negative xx and yy";
        found.error(place, "tension in some cells", "xx and yy of 0 and below", advice);
        return;
    }
    let without = Known { reduced_stress: None, ..start.mean(scales) };
    let answer = model.evaluate(&model.initial_state(&without), 0.0);
    let usual = 0.5 * scales.0 * (answer.stress[0][0] + answer.stress[1][0]);
    let ratio = pressure / usual;
    if !(USUAL_PRESSURE[0]..=USUAL_PRESSURE[1]).contains(&ratio) {
        let value = format!("a mean pressure of {} Pa", number(rounded(pressure, 3)));
        let [low, high] = USUAL_PRESSURE.map(|share| number(rounded(share * usual, 2)));
        let advice = format!(
            "Packings of a porosity of {} have about {} Pa with these grains (pressure is in proportion to youngModulus times \
             meanRadius). Take fields that belong to the grains: 'msdd case new' packs them; without the file stress, the \
             model's mean stands in",
            number(rounded(start.porosity.mean(0), 3)),
            number(rounded(usual, 3))
        );
        found.doubt(place, &value, &format!("about {low} to {high} Pa"), &advice);
    }
}

/// Takes the mean state to a thermal strain, with the box held fixed, and reports when it leaves the trained range of the
/// model on the way. `what`: what causes the strain, for the message.
pub fn walk(
    model: &dyn Surrogate,
    start: &Start,
    grains: &Grains,
    [strain, temperature]: [f64; 2],
    found: &mut Findings,
) {
    let names = columns(model);
    let mut state: [f64; MAX_STATE] =
        model.initial_state(&start.mean((grains.stress_scale(), grains.thermal_conductivity)));
    for step in 0..WALK {
        let part = |k: usize| strain * k as f64 / WALK as f64;
        let increment = (1.0 + part(step + 1)) / (1.0 + part(step)) - 1.0;
        let answer = model.evaluate(&state, increment);
        let left = (0..names.len() - 1).find(|&column| {
            let beyond = answer.outside[column][0];
            // The fabric index is not reported: its range is narrow, and it leaves it when grains lose contact, which the model
            // can describe.
            beyond != 0.0 && names[column] != "fabricIndex" && step > 0
        });
        if let Some(column) = left {
            let side = if answer.outside[column][0] > 0.0 { "above" } else { "below" };
            let value = format!("a strain of {} at {} K", number(rounded(strain, 3)), number(temperature));
            let advice = format!(
                "Where grains that cannot move reach this temperature, {} gets {side} the range that the model was trained with, from a \
                 strain of {} on. The run may end then. With 'mechanics equilibrium' the state changes less, as long as the bed around gives way",
                names[column],
                number(rounded(part(step + 1), 2))
            );
            found.doubt(
                [FILE, "thermalExpansion"],
                &value,
                "strains for which the state stays in the range of the model",
                &advice,
            );
            return;
        }
        state = answer.state.map(|column| column[0]);
    }
}
