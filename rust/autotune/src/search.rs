//! Which combination is the cheapest that is accurate enough.
//!
//! All that is left out or coarsened gets a share of the wanted accuracy. On a coarse mesh, runs with and without motion of the
//! grains, with a loose tolerance in time, and with half the cells along each direction show what each choice changes; the known
//! orders of the methods carry these differences to the settings that are not run.

use crate::bands::CONDUCTIVITY;
use crate::cells::{Base, Chosen, DirectionErrors, SAFETY, coarse_level, even_level};
use crate::found::{Differences, Found, Share, difference};
use crate::quantity::Quantity;
use crate::runs::{Each, Run, Runs, SearchTarget, larger};
use crate::settings::Settings;
use crate::{ChoiceError, Missed};

/// Tolerance in time of the runs on the coarse mesh, a share of the range of T, and the loose one.
const TOLERANCE: f64 = 1e-3;
const LOOSE: f64 = 1e-2;
/// Tolerances that can be chosen.
const TOLERANCES: [f64; 7] = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];
/// Largest shares of the wanted accuracy; all that is left is for the cells.
const MECHANICS: f64 = 0.3;
const TIME: f64 = 0.2;
/// Largest share of grains that stay because the user says so.
const STAYING: f64 = 0.6;
/// A direction is dropped if the run without it is away by no more than this share of the wanted accuracy.
const DROP: f64 = 0.1;
/// Largest share of half a box, which leaves nothing out but what an unsteady balance of the grains does.
const HALF: f64 = 0.1;
/// Largest share of a constant conductivity.
const CONSTANT: f64 = 0.2;
/// Largest share of the wanted accuracy that model and packing may leave open, and the share at the accuracy that is offered instead.
const OPEN: f64 = 0.95;
const OFFERED: f64 = 0.8;
/// What is offered instead of an accuracy out of reach is a little more than the bound.
const ABOVE: f64 = 1.001;

/// Keys of the accuracies of T and p.
pub const KEYS: [&str; 2] = ["accuracy", "pressureAccuracy"];

/// The power of the time step's tolerance with which the error of T is taken to fall. Steps grow with the square root of the
/// tolerance, so the power is 1 at best; in case HC it was 0.7 to 0.9, and with moving grains 0.5 to 0.8. A smaller one counts
/// too much error for the tolerances between [`TOLERANCE`] and [`LOOSE`], rather than too little.
fn time_order(moves: bool) -> f64 {
    if moves { 1.0 / 3.0 } else { 2.0 / 3.0 }
}

/// Finds the cheapest combination. `run` makes one run, given the range of T once it is known.
///
/// # Errors
/// [`ChoiceError::OutOfReach`] with the best that can be had; those of `run`, except where grains cannot move.
pub fn find<'a>(target: &'a SearchTarget, run: &'a mut Run<'a>) -> Result<(Found, Differences), ChoiceError> {
    let mut search = Search::begin(target, run)?;
    if search.runs.range > 0.0 {
        search.uncertainty()?;
        search.half()?;
        search.motion()?;
        search.constant()?;
        let steps = search.steps()?;
        search.cells(steps)?;
    } else {
        search.found.notes.push("T is the same everywhere and always".to_string());
    }
    let Search { runs, mut found, seen, .. } = search;
    (found.range, found.pressure_range, found.tried) = (runs.range, runs.pressure_range, runs.tried);
    Ok((found, seen))
}

struct Search<'a> {
    target: &'a SearchTarget,
    runs: Runs<'a>,
    base: Base,
    found: Found,
    seen: Differences,
    /// What model and packing leave open of T and p, and the accuracy that is left for the numerical method [% of the range of T].
    open: Each,
    accuracy: f64,
    /// Error of half a box, of grains that stay and of a constant conductivity [% of the range of T].
    left_out: f64,
}

/// Whether the steps can be small enough, and their error [% of the range of T].
struct Steps {
    enough: bool,
    each: Each,
}

impl<'a> Search<'a> {
    /// Runs the coarse mesh.
    fn begin(target: &'a SearchTarget, run: &'a mut Run<'a>) -> Result<Self, ChoiceError> {
        let levels = target.cells.iter().map(|&cells| coarse_level(cells, false)).collect();
        let moves = target.moves == Some(true);
        let settings = Settings::new(levels, TOLERANCE, moves);
        let mut runs = Runs::new(target, run);
        let outcome = runs.compare("coarse mesh", settings.clone(), None)?;
        let found = Found {
            settings: settings.clone(),
            range: 0.0,
            pressure_range: 0.0,
            shares: Vec::new(),
            open: Vec::new(),
            tried: Vec::new(),
            notes: Vec::new(),
        };
        Ok(Self {
            target,
            runs,
            base: Base { settings, outcome },
            found,
            seen: Differences::default(),
            open: [0.0; 2],
            accuracy: target.accuracy,
            left_out: 0.0,
        })
    }

    /// What model and packing leave open sets the accuracy that is left for the numerical method.
    fn uncertainty(&mut self) -> Result<(), ChoiceError> {
        let more = Settings { conductivity: CONDUCTIVITY, ..self.base.settings.clone() };
        let more = self.runs.compare("more conductivity", more, Some(&self.base.outcome))?;
        (self.found.open, self.open, self.seen.sensitivity) = self.runs.open(&self.base.outcome, &more);
        let asked = self.target.accuracy;
        if larger(self.open) > OPEN * asked {
            let missed = [0, 1].into_iter().filter(|&k| self.open[k] > OPEN * asked);
            let missed: Vec<Missed> = missed.map(|k| self.missed(k, self.open[k] / OFFERED)).collect();
            let of = |one: &Missed| {
                let name = if one.key == KEYS[0] { "T" } else { "p" };
                format!("{:.2} % of the range of {name}", OFFERED * one.best)
            };
            let reason = format!(
                "model and packing leave {} open, for a bed of about {:.0} grains",
                missed.iter().map(of).collect::<Vec<_>>().join(" and "),
                self.target.bed.grains
            );
            return Err(ChoiceError::OutOfReach { missed, reason });
        }
        self.accuracy = (asked.powi(2) - larger(self.open).powi(2)).sqrt();
        Ok(())
    }

    /// The wanted accuracy of T (0) or p (1) that is missed, with the best that can be had as a share of the accuracy of T.
    fn missed(&self, quantity: usize, best: f64) -> Missed {
        let asked = [Some(self.target.accuracy), self.target.pressure][quantity].unwrap_or(f64::NAN);
        Missed { key: KEYS[quantity], asked, best: best * asked / self.target.accuracy }
    }

    /// The refusal of a search in which T and p need these accuracies of the numerical method [% of the range of T].
    fn out_of_reach(&self, needed: Each, reason: String) -> ChoiceError {
        let asked = self.target.accuracy;
        let enough = self.accuracy.min(larger(needed));
        let best = |k: usize| {
            // What is open of the other one stays
            let left = (asked.powi(2) - self.open[1 - k].powi(2)).sqrt();
            ABOVE * self.open[k].hypot(needed[k]).max(asked * needed[k] / left)
        };
        let missed = [0, 1].into_iter().filter(|&k| needed[k] >= enough);
        let missed = missed.map(|k| self.missed(k, best(k))).collect();
        ChoiceError::OutOfReach { missed, reason }
    }

    /// Whether half the box, or a quarter, is enough: if it mirrors, and a run of it gives what one of the whole box gives.
    fn half(&mut self) -> Result<(), ChoiceError> {
        let halved = self.target.mirrors.clone();
        if !halved.contains(&true) {
            return Ok(());
        }
        let cells = &self.target.cells;
        let level = |k: usize| if halved[k] { even_level(cells[k]) } else { self.base.settings.levels[k] };
        let levels = (0..cells.len()).map(level).collect();
        let whole = Settings::new(levels, TOLERANCE, self.target.moves != Some(false));
        let half = Settings { halved: halved.clone(), ..whole.clone() };
        let tried = self.runs.compare("whole box", whole, None).and_then(|whole| {
            let part = self.runs.compare("part of the box", half, Some(&whole))?;
            Ok(self.runs.percent(&part, &whole))
        });
        let percent = match tried {
            Err(ChoiceError::Run { problem, .. }) => {
                self.found.notes.push(format!("a part of the box could not be tried: {problem}"));
                return Ok(());
            }
            other => other?,
        };
        if percent > HALF * self.accuracy {
            let note = format!("the box mirrors, but a part of it alone changes T by {percent:.3} %");
            self.found.notes.push(note);
            return Ok(());
        }
        let how = "runs of the whole box and of the part".to_string();
        self.found.shares.push(Share { source: "part of the box".to_string(), percent, how });
        let note = "the chosen case is the half, or quarter, of the box at its lowest corner; points of function objects beyond it stand at their mirror images";
        self.found.notes.push(note.to_string());
        self.left_out += percent;
        let mut settings = Settings { halved, ..self.base.settings.clone() };
        for (k, &cells) in cells.iter().enumerate() {
            settings.levels[k] = coarse_level(settings.own_cells(k, cells), settings.halves(k));
        }
        let outcome =
            self.runs.compare("coarse mesh of the part", settings.clone(), Some(&self.base.outcome))?;
        self.base = Base { settings, outcome };
        Ok(())
    }

    /// Whether the grains move.
    fn motion(&mut self) -> Result<(), ChoiceError> {
        if self.target.moves == Some(true) {
            return Ok(());
        }
        let settings = Settings { moves: true, ..self.base.settings.clone() };
        let moving = match self.runs.compare("grains move", settings.clone(), Some(&self.base.outcome)) {
            Err(ChoiceError::Run { problem, .. }) => {
                self.found.notes.push(format!("grains that move could not be tried: {problem}"));
                return Ok(());
            }
            other => other?,
        };
        let each = self.runs.apart(&moving, &self.base.outcome);
        let percent = larger(each);
        if self.target.moves.is_none() && percent > MECHANICS * self.accuracy {
            self.base = Base { settings, outcome: moving };
        } else if percent > STAYING * self.accuracy {
            let reason = format!(
                "constant/granularProperties says 'mechanics none', and grains that move change T by {percent:.2} %; \
                 without this key, or with --choose-mechanics, they may move"
            );
            return Err(self.out_of_reach(each.map(|one| one / STAYING), reason));
        } else {
            let how = "runs with and without their motion".to_string();
            self.found.shares.push(Share { source: "grains stay".to_string(), percent, how });
            self.left_out += percent;
            self.seen.motion = difference(&moving, &self.base.outcome, 1.0);
        }
        Ok(())
    }

    /// Whether the conductivity may be constant: the mean over bed and run of that with the model. The grains then stay.
    fn constant(&mut self) -> Result<(), ChoiceError> {
        if !self.target.constant || self.target.moves == Some(true) {
            return Ok(());
        }
        let base = &self.base.outcome;
        let mean = [Quantity::ConductivityXx, Quantity::ConductivityYy].map(|k| base.series(k).mean());
        let settings = Settings { constant: Some(mean), moves: false, ..self.base.settings.clone() };
        let constant = match self.runs.compare("constant conductivity", settings.clone(), Some(base)) {
            Err(ChoiceError::Run { problem, .. }) => {
                self.found.notes.push(format!("a constant conductivity could not be tried: {problem}"));
                return Ok(());
            }
            other => other?,
        };
        let percent = self.runs.percent(&constant, base);
        if percent <= CONSTANT * self.accuracy && self.left_out + percent <= STAYING * self.accuracy {
            let how = "runs with the model and without it".to_string();
            self.found.shares.push(Share { source: "constant conductivity".to_string(), percent, how });
            let note =
                "conductivity and pressure of this run are constant; their bands hold what that leaves out";
            self.found.notes.push(note.to_string());
            self.left_out += percent;
            self.seen.constant = difference(base, &constant, 1.0);
            self.base = Base { settings, outcome: constant };
        }
        Ok(())
    }

    /// The largest tolerance of the steps.
    fn steps(&mut self) -> Result<Steps, ChoiceError> {
        let base = &self.base;
        let loose = Settings { tolerance: LOOSE, ..base.settings.clone() };
        let loose = self.runs.compare("larger steps", loose, Some(&base.outcome))?;
        let order = time_order(base.settings.moves);
        // Error of the base's tolerance over the difference of the two runs.
        let part = 1.0 / ((LOOSE / TOLERANCE).powf(order) - 1.0);
        let growth = |tolerance: f64| part * (tolerance / TOLERANCE).powf(order);
        let away = self.runs.apart(&loose, &base.outcome);
        let error = |tolerance: f64| SAFETY * larger(away) * growth(tolerance);
        let enough = TOLERANCES.into_iter().find(|&tolerance| error(tolerance) <= TIME * self.accuracy);
        let tolerance = enough.unwrap_or(TOLERANCES[TOLERANCES.len() - 1]);
        let how =
            format!("runs with tolerances of {} and {} % of the range", 100.0 * LOOSE, 100.0 * TOLERANCE);
        self.found.shares.push(Share { source: "time".to_string(), percent: error(tolerance), how });
        self.seen.time = difference(&loose, &base.outcome, growth(tolerance));
        self.found.settings = Settings { tolerance, ..base.settings.clone() };
        let each = away.map(|one| SAFETY * one * growth(tolerance));
        Ok(Steps { enough: enough.is_some(), each })
    }

    /// The fewest cells along each direction. What motion and steps have left is shared by the directions; those along which
    /// nothing changes leave their share to the others.
    fn cells(&mut self, steps: Steps) -> Result<(), ChoiceError> {
        let mut left = self.accuracy * (1.0 - TIME) - self.left_out;
        let mut directions = Vec::new();
        for (direction, &cells) in self.target.cells.iter().enumerate() {
            let cells = self.base.settings.own_cells(direction, cells);
            let known =
                DirectionErrors::new(&mut self.runs, &self.base, direction, cells, DROP * self.accuracy)?;
            if known.single {
                left -= known.error;
            }
            directions.push(known);
        }
        let many = directions.iter().filter(|one| !one.single).count().max(1) as f64;
        let mut worst: Option<Each> = None;
        for (direction, known) in directions.iter().enumerate() {
            let Chosen { level, share, missed } = known.level(&mut self.runs, &self.base, left / many)?;
            if let Some(missed) = missed {
                let so_far = worst.unwrap_or_default();
                worst = Some([0, 1].map(|k| missed[k].max(so_far[k])));
            }
            self.found.settings.levels[direction] = level;
            self.found.shares.push(share);
        }
        if directions.is_empty() {
            self.found.notes.push(
                "the error of the mesh is unknown, and no part of the estimate and the bands".to_string(),
            );
        }
        let reason = match (worst.is_some(), steps.enough) {
            (false, true) => return Ok(()),
            (true, _) => "four times the cells of the case along a direction are too few for less",
            (false, false) => "smaller steps than the smallest would be needed",
        };
        let taken = self.accuracy * (1.0 - TIME) - left;
        let worst = worst.unwrap_or_default();
        let cells = |k: usize| if worst[k] > 0.0 { (worst[k] * many + taken) / (1.0 - TIME) } else { 0.0 };
        let needed = |k: usize| cells(k).max(steps.each[k] / TIME);
        Err(self.out_of_reach([0, 1].map(needed), reason.to_string()))
    }
}

#[cfg(test)]
#[path = "search_tests.rs"]
mod tests;
