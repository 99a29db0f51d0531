//! Which combination is the cheapest that is accurate enough.
//!
//! All that is left out or coarsened gets a share of the wanted accuracy. On a coarse mesh, runs with and without motion of the
//! grains, with a loose tolerance in time, and with half the cells along each direction show what each choice changes; the known
//! orders of the methods carry these differences to the settings that are not run.

use crate::ChoiceError;
use crate::bands::{CONDUCTIVITY, Law, Lengths, sensitivity};
use crate::bed::Bed;
use crate::quantity::Quantity;
use crate::series::Series;
use crate::settings::{Level, Settings};
use crate::trial::Outcome;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Cells along a direction of the coarse mesh on which choices are compared, at least.
const COARSE: usize = 12;
/// Tolerance in time of these runs, a share of the range of T, and the loose one.
const TOLERANCE: f64 = 1e-3;
const LOOSE: f64 = 1e-2;
/// Tolerances that can be chosen.
const TOLERANCES: [f64; 7] = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];
/// Largest shares of the wanted accuracy; all that is left is for the cells.
const MECHANICS: f64 = 0.3;
const TIME: f64 = 0.2;
/// Largest share of grains that stay because the user says so.
const STAYING: f64 = 0.6;
/// Errors that are extrapolated count so many times, and those that are seen as the distance from a finer run.
const SAFETY: f64 = 1.5;
const SEEN: f64 = 1.1;
/// A direction is dropped if the run without it is away by no more than this share of the wanted accuracy.
const DROP: f64 = 0.1;
/// Finest level: the case's own cells doubled twice.
const FINEST: Level = Level::Halved(-2);
/// Source of the error of grains that stay although they might move.
const STAY: &str = "grains stay";
/// Largest share of the wanted accuracy that model and packing may leave open, and the share at the accuracy that is offered instead.
const OPEN: f64 = 0.95;
const OFFERED: f64 = 0.8;
/// Order of the cell's size in the error of T.
pub const ORDER: i32 = 2;

/// What can be chosen.
#[derive(Clone, Debug)]
pub struct Wishes {
    /// Wanted accuracy of T [% of its range].
    pub accuracy: f64,
    /// Wanted accuracy of p [% of its range], if it is asked for.
    pub pressure: Option<f64>,
    /// Cells along each direction of the user's mesh; empty if it has to be taken as it is.
    pub cells: Vec<usize>,
    /// Whether grains move, if the user says so.
    pub moves: Option<bool>,
    pub bed: Bed,
    pub law: Law,
}

/// One run of the search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    pub what: String,
    pub settings: Settings,
    pub cells: usize,
    pub seconds: f64,
    /// How far it is from the run that it is compared with [% of the range of T].
    pub away: Option<f64>,
}

/// An estimate of what a choice leaves out, the root of the mean square over bed and run. Where p is asked for and takes a larger
/// share of its accuracy, that share of the accuracy of T.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    pub source: String,
    /// Error of T [% of its range].
    pub percent: f64,
    pub how: String,
}

/// The choice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    pub settings: Settings,
    /// Range of T [K].
    pub range: f64,
    /// Of p [Pa].
    pub pressure_range: f64,
    /// Errors of the numerical method and of grains that stay.
    pub shares: Vec<Share>,
    /// What the model and the packing leave open.
    pub open: Vec<Share>,
    pub tried: Vec<Tried>,
    /// What could not be tried, and why.
    pub notes: Vec<String>,
}

impl Found {
    /// All together [% of the range of T]: the sum of the numerical errors, and what model and packing leave open, which is
    /// independent of it and of each other.
    pub fn total(&self) -> f64 {
        let numerical: f64 = self.shares.iter().map(|share| share.percent).sum();
        self.open.iter().fold(numerical, |all, share| all.hypot(share.percent))
    }
}

/// Values at points and times of several quantities.
pub type Values = BTreeMap<Quantity, Series>;

/// What the search has seen at each point and time, for the bands of the chosen run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Differences {
    /// Error of the chosen steps.
    pub time: Values,
    /// What changes if the grains move, where they stay in the chosen run.
    pub motion: Values,
    /// Change of T with the logarithm of the conductivity [K].
    pub sensitivity: Series,
}

/// `a` minus `b`, times a factor.
pub fn difference(a: &Outcome, b: &Outcome, factor: f64) -> Values {
    let of = |(quantity, series): (&Quantity, &Series)| {
        Some((*quantity, series.minus(b.values.get(quantity)?, factor)))
    };
    a.values.iter().filter_map(of).collect()
}

/// Order of the time step's tolerance in the error of T: steps of second order grow with its cube root; with moving grains the
/// splitting of heat and motion is of first order.
fn time_order(moves: bool) -> f64 {
    if moves { 1.0 / 3.0 } else { 2.0 / 3.0 }
}

struct Search<'a, R> {
    run: &'a mut R,
    wishes: &'a Wishes,
    range: f64,
    pressure_range: f64,
    tried: Vec<Tried>,
}

impl<R: FnMut(&Settings, Option<f64>) -> Result<Outcome, ChoiceError>> Search<'_, R> {
    /// Runs a combination and compares it with another run.
    fn compare(
        &mut self,
        what: &str,
        settings: Settings,
        with: Option<&Outcome>,
    ) -> Result<Outcome, ChoiceError> {
        let range = (self.range > 0.0).then_some(self.range);
        let outcome = (self.run)(&settings, range)?;
        self.range = self.range.max(outcome.range);
        if let Some(pressure) = outcome.values.get(&Quantity::Pressure) {
            let mut all = pressure.clone();
            all.values.push(outcome.start_pressure.clone());
            self.pressure_range = self.pressure_range.max(all.range());
        }
        let away = with.map(|other| self.percent(&outcome, other));
        let (cells, seconds) = (outcome.cells, outcome.seconds);
        self.tried.push(Tried { what: what.to_string(), settings, cells, seconds, away });
        Ok(outcome)
    }

    fn percent(&self, a: &Outcome, b: &Outcome) -> f64 {
        let away = |quantity| Some(a.values.get(&quantity)?.distance(b.values.get(&quantity)?));
        self.share(away(Quantity::Temperature).unwrap_or(0.0), away(Quantity::Pressure).unwrap_or(0.0))
    }

    /// Errors of T [K] and p [Pa] as one share [% of the range of T].
    fn share(&self, temperature: f64, pressure: f64) -> f64 {
        let percent = 100.0 * temperature / self.range;
        match self.wishes.pressure {
            Some(wanted) if self.pressure_range > 0.0 => {
                percent.max(100.0 * pressure / self.pressure_range * self.wishes.accuracy / wanted)
            }
            _ => percent,
        }
    }

    /// What model and packing leave open, with the change of T with the logarithm of the conductivity.
    fn open(&self, base: &Outcome, other: &Outcome) -> (Vec<Share>, Series) {
        let sensitivity = sensitivity(base, other);
        let bed = &self.wishes.bed;
        let lengths = Lengths::new(bed, base, &sensitivity);
        let part = |k: usize| {
            let of = |quantity| self.wishes.law.doubt(quantity, k, &lengths);
            self.share(of(Quantity::Temperature), of(Quantity::Pressure))
        };
        let model =
            "what another conductivity would change, and the scenes that the model was judged by".to_string();
        let packing = format!("scatter of beds of {:.0} grains", bed.grains);
        let shares = [("model", 0, model), ("packing", 1, packing)];
        let share = |(source, k, how): (&str, usize, String)| Share {
            source: source.to_string(),
            percent: part(k),
            how,
        };
        (shares.into_iter().map(share).collect(), sensitivity)
    }
}

/// Finds the cheapest combination. `run` makes one run, given the range of T once it is known.
///
/// # Errors
/// [`ChoiceError::OutOfReach`] with the best that can be had; those of `run`, except where grains cannot move.
pub fn find<R>(wishes: &Wishes, run: &mut R) -> Result<(Found, Differences), ChoiceError>
where
    R: FnMut(&Settings, Option<f64>) -> Result<Outcome, ChoiceError>,
{
    let coarse = wishes.cells.iter().map(|&cells| coarse_level(cells)).collect();
    let moves = wishes.moves == Some(true);
    let mut at = Settings { levels: coarse, tolerance: TOLERANCE, moves, conductivity: 1.0 };
    let mut search = Search { run, wishes, range: 0.0, pressure_range: 0.0, tried: Vec::new() };
    let mut base = search.compare("coarse mesh", at.clone(), None)?;
    let mut found = Found {
        settings: at.clone(),
        range: search.range,
        pressure_range: 0.0,
        shares: Vec::new(),
        open: Vec::new(),
        tried: Vec::new(),
        notes: Vec::new(),
    };
    let mut seen = Differences::default();
    if search.range <= 0.0 {
        found.notes.push("T is the same everywhere and always".to_string());
        found.tried = search.tried;
        return Ok((found, seen));
    }

    // What model and packing leave open sets the accuracy that is left for the numerical method.
    let more = Settings { conductivity: CONDUCTIVITY, ..at.clone() };
    let more = search.compare("more conductivity", more, Some(&base))?;
    (found.open, seen.sensitivity) = search.open(&base, &more);
    let open = found.open.iter().fold(0.0f64, |all, share| all.hypot(share.percent));
    if open > OPEN * wishes.accuracy {
        let reason = format!(
            "model and packing leave {open:.2} % open, for a bed of about {:.0} grains",
            wishes.bed.grains
        );
        return Err(ChoiceError::OutOfReach { asked: wishes.accuracy, best: open / OFFERED, reason });
    }
    let accuracy = (wishes.accuracy.powi(2) - open * open).sqrt();

    if wishes.moves != Some(true) {
        let other = Settings { moves: true, ..at.clone() };
        match search.compare("grains move", other.clone(), Some(&base)) {
            Ok(moving) => {
                let percent = search.percent(&moving, &base);
                if wishes.moves.is_none() && percent > MECHANICS * accuracy {
                    (at, base) = (other, moving);
                } else if percent > STAYING * accuracy {
                    let reason = format!(
                        "constant/granularProperties says 'mechanics none', and grains that move change T by {percent:.2} %; \
                         without this key, or with --choose-mechanics, they may move"
                    );
                    let best = 1.001 * open.hypot(percent / STAYING);
                    return Err(ChoiceError::OutOfReach { asked: wishes.accuracy, best, reason });
                } else {
                    let how = "runs with and without their motion".to_string();
                    found.shares.push(Share { source: STAY.to_string(), percent, how });
                    seen.motion = difference(&moving, &base, 1.0);
                }
            }
            Err(ChoiceError::Run { problem, .. }) => {
                found.notes.push(format!("grains that move could not be tried: {problem}"));
            }
            Err(other) => return Err(other),
        }
    }

    let mut out_of_reach = Vec::new();
    let loose = Settings { tolerance: LOOSE, ..at.clone() };
    let loose = search.compare("larger steps", loose, Some(&base))?;
    let order = time_order(at.moves);
    // Error of the base's tolerance over the difference of the two runs.
    let part = 1.0 / ((LOOSE / TOLERANCE).powf(order) - 1.0);
    let growth = |tolerance: f64| part * (tolerance / TOLERANCE).powf(order);
    let percent = search.percent(&loose, &base);
    let error = |tolerance: f64| SAFETY * percent * growth(tolerance);
    let enough = TOLERANCES.into_iter().find(|&tolerance| error(tolerance) <= TIME * accuracy);
    let tolerance = enough.unwrap_or(TOLERANCES[TOLERANCES.len() - 1]);
    if enough.is_none() {
        out_of_reach.push("steps");
    }
    let how = format!("runs with tolerances of {} and {} % of the range", 100.0 * LOOSE, 100.0 * TOLERANCE);
    found.shares.push(Share { source: "time".to_string(), percent: error(tolerance), how });
    seen.time = difference(&loose, &base, growth(tolerance));

    // What is left for the cells. Directions along which nothing changes leave their share to the others.
    let left: f64 = found.shares.iter().filter(|share| share.source == STAY).map(|share| share.percent).sum();
    let mut left = accuracy * (1.0 - TIME) - left;
    let mut directions = Vec::new();
    for (direction, &cells) in wishes.cells.iter().enumerate() {
        let known = direction_at(&mut search, &at, &base, direction, cells, DROP * accuracy)?;
        if known.single {
            left -= known.error;
        }
        directions.push(known);
    }
    let many = directions.iter().filter(|one| !one.single).count().max(1) as f64;
    let mut levels = at.levels.clone();
    let mut worst: f64 = 0.0;
    for (direction, (known, &cells)) in directions.iter().zip(&wishes.cells).enumerate() {
        let (level, estimate) = space(&mut search, &at, &base, direction, cells, known, left / many)?;
        if estimate.percent > left / many && !known.single {
            out_of_reach.push("cells");
            worst = worst.max(estimate.percent);
        }
        levels[direction] = level;
        found.shares.push(estimate);
    }
    if wishes.cells.is_empty() {
        found.notes.push("the error of the mesh is not known".to_string());
    }
    found.settings = Settings { levels, tolerance, ..at };
    (found.range, found.pressure_range) = (search.range, search.pressure_range);
    found.tried = search.tried;
    if out_of_reach.is_empty() {
        return Ok((found, seen));
    }
    let taken = accuracy * (1.0 - TIME) - left;
    let time = found.shares.iter().find(|share| share.source == "time").map_or(0.0, |share| share.percent);
    let best = (time / TIME).max((worst * many + taken) / (1.0 - TIME));
    let reason = match out_of_reach.contains(&"cells") {
        true => "four times the cells of the case along a direction are too few for less",
        false => "smaller steps than the smallest would be needed",
    };
    let best = 1.001 * best.hypot(open);
    Err(ChoiceError::OutOfReach { asked: wishes.accuracy, best, reason: reason.to_string() })
}

/// The coarsest level with enough cells to compare choices on.
fn coarse_level(cells: usize) -> Level {
    let mut level = Level::Halved(0);
    while let Some(next) = level.coarser(cells).filter(|next| next.cells(cells) >= COARSE) {
        level = next;
    }
    level
}

/// What the coarse mesh shows of one direction.
struct Known {
    /// Whether a single cell is enough.
    single: bool,
    /// Error at the coarse mesh's level, or with a single cell [% of the range]; infinite if there are too few cells to tell.
    error: f64,
    how: String,
}

fn with(at: &Settings, direction: usize, level: Level) -> Settings {
    let mut settings = at.clone();
    settings.levels[direction] = level;
    settings
}

/// Compares the coarse mesh with one of half the cells along a direction, and with a single cell if that changes little.
fn direction_at<R>(
    search: &mut Search<'_, R>,
    at: &Settings,
    base: &Outcome,
    direction: usize,
    cells: usize,
    drop: f64,
) -> Result<Known, ChoiceError>
where
    R: FnMut(&Settings, Option<f64>) -> Result<Outcome, ChoiceError>,
{
    let here = at.levels[direction];
    let Some(coarser) = here.coarser(cells) else {
        return Ok(Known { single: false, error: f64::INFINITY, how: String::new() });
    };
    let ratio = here.cells(cells) as f64 / coarser.cells(cells) as f64;
    let what = format!("{} cells along direction {}", coarser.cells(cells), direction + 1);
    let halved = search.compare(&what, with(at, direction, coarser), Some(base))?;
    let error = search.percent(&halved, base) / (ratio.powi(ORDER) - 1.0);
    if error <= drop {
        let what = format!("a single cell along direction {}", direction + 1);
        if let Ok(single) = search.compare(&what, with(at, direction, Level::One), Some(base)) {
            let error = search.percent(&single, base);
            if error <= drop {
                return Ok(Known { single: true, error, how: "a run without this direction".to_string() });
            }
        }
    }
    let how = format!("runs with {} and {} cells", coarser.cells(cells), here.cells(cells));
    Ok(Known { single: false, error, how })
}

/// The coarsest level of one direction, among those that are run, whose error is within its share, and that error: that with half
/// the cells of the coarse mesh, the coarse mesh, or finer levels, which are run one after the other until one is fine enough.
fn space<R>(
    search: &mut Search<'_, R>,
    at: &Settings,
    base: &Outcome,
    direction: usize,
    cells: usize,
    known: &Known,
    share: f64,
) -> Result<(Level, Share), ChoiceError>
where
    R: FnMut(&Settings, Option<f64>) -> Result<Outcome, ChoiceError>,
{
    let source = format!("cells, direction {}", direction + 1);
    if known.single {
        return Ok((Level::One, Share { source, percent: known.error, how: known.how.clone() }));
    }
    let mut level = at.levels[direction];
    let (mut error, mut how) = (SAFETY * known.error, known.how.clone());
    if error <= share {
        let ratio = |next: Level| (level.cells(cells) as f64 / next.cells(cells) as f64).powi(ORDER);
        if let Some(next) = level.coarser(cells).filter(|&next| error * ratio(next) <= share) {
            error *= ratio(next);
            level = next;
        }
        return Ok((level, Share { source, percent: error, how }));
    }
    let mut last = base.clone();
    while level > FINEST {
        let finer = level.finer();
        let what = format!("{} cells along direction {}", finer.cells(cells), direction + 1);
        let next = search.compare(&what, with(at, direction, finer), Some(base))?;
        let ratio = (finer.cells(cells) as f64 / level.cells(cells) as f64).powi(ORDER);
        let away = search.percent(&next, &last);
        how = format!("runs with {} and {} cells", level.cells(cells), finer.cells(cells));
        // The distance itself is most of the error of the coarser of the two.
        let coarse = SEEN * away * ratio / (ratio - 1.0);
        if coarse <= share {
            return Ok((level, Share { source, percent: coarse, how }));
        }
        (error, level, last) = (SAFETY * away / (ratio - 1.0), finer, next);
        if error <= share {
            break;
        }
    }
    Ok((level, Share { source, percent: error, how }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::Series;

    /// A scene whose errors are known: `space[k]` at 1 cell along k, falling with the square; `time` at tolerance 1.
    struct Scene {
        space: Vec<f64>,
        time: f64,
        motion: f64,
        cells: Vec<usize>,
        sensitivity: f64,
    }

    impl Scene {
        fn error(&self, settings: &Settings) -> f64 {
            let space = settings.levels.iter().zip(&self.cells).zip(&self.space);
            let space: f64 = space.map(|((l, &n), e)| e / (l.cells(n) as f64).powi(2)).sum();
            let motion = if settings.moves { 0.0 } else { self.motion };
            space + self.time * settings.tolerance.powf(time_order(settings.moves)) + motion
        }

        fn find(&self, accuracy: f64, moves: Option<bool>) -> Result<Found, ChoiceError> {
            let bed = Bed { grains: 1000.0, mean_radius: 1.0, window: 100.0, neighbours: Vec::new() };
            let (cells, law) = (self.cells.clone(), Law::shipped());
            let wishes = Wishes { accuracy, pressure: None, cells, moves, bed, law };
            let run = &mut |settings: &Settings, _| {
                // A change of the conductivity by 5 % changes T by this many kelvins.
                let more = self.sensitivity * (settings.conductivity - 1.0);
                let series =
                    Series { times: vec![1.0], values: vec![vec![100.0 + self.error(settings) + more]] };
                let cells = settings.levels.iter().zip(&self.cells).map(|(l, &n)| l.cells(n)).product();
                Ok(Outcome {
                    values: Values::from([(Quantity::Temperature, series)]),
                    strain: Series::default(),
                    start_pressure: Vec::new(),
                    range: 100.0,
                    cells,
                    seconds: 1.0,
                    processor: 1.0,
                })
            };
            Ok(find(&wishes, run)?.0)
        }
    }

    #[test]
    fn the_true_error_is_within_the_request_and_no_finer_than_it_needs() {
        let scene = Scene {
            space: vec![300.0, 100.0],
            time: 4.0,
            motion: 0.1,
            cells: vec![200, 100],
            sensitivity: 0.0,
        };
        for accuracy in [5.0, 2.0, 1.0] {
            let found = scene.find(accuracy, None).unwrap();
            let error = scene.error(&found.settings);
            assert!(error <= accuracy, "{accuracy} {error} {:?}", found.settings);
            assert!(!found.settings.moves, "{accuracy}");
            // One level coarser along the first direction would be too much.
            let cells = found.settings.levels[0].cells(200) as f64;
            assert!(300.0 / (cells / 4.0).powi(2) > 0.25 * accuracy, "{accuracy} {cells}");
            assert!(found.total() <= accuracy);
        }
    }

    #[test]
    fn motion_counts_where_it_matters_and_where_the_user_says_so() {
        let scene = Scene { space: vec![10.0], time: 1.0, motion: 4.0, cells: vec![100], sensitivity: 0.0 };
        assert!(scene.find(1.0, None).unwrap().settings.moves);
        assert!(!scene.find(20.0, None).unwrap().settings.moves);
        assert!(scene.find(20.0, Some(true)).unwrap().settings.moves);
        assert!(!scene.find(20.0, Some(false)).unwrap().settings.moves);
        let Err(ChoiceError::OutOfReach { best, reason, .. }) = scene.find(1.0, Some(false)) else {
            panic!()
        };
        assert!(reason.contains("mechanics none") && !scene.find(best, Some(false)).unwrap().settings.moves);
    }

    #[test]
    fn a_direction_along_which_nothing_changes_gets_one_cell() {
        let scene =
            Scene { space: vec![300.0, 0.0], time: 1.0, motion: 0.0, cells: vec![100, 50], sensitivity: 0.0 };
        assert_eq!(scene.find(1.0, None).unwrap().settings.levels[1], Level::One);
    }

    #[test]
    fn a_request_out_of_reach_is_refused_with_the_best_that_can_be_had() {
        let scene =
            Scene { space: vec![30_000.0], time: 1.0, motion: 0.0, cells: vec![20], sensitivity: 0.0 };
        let Err(ChoiceError::OutOfReach { best, .. }) = scene.find(0.5, None) else { panic!() };
        assert!(best > 0.5 && scene.find(best, None).is_ok(), "{best}");
    }

    #[test]
    fn what_model_and_packing_leave_open_is_not_asked_of_the_cells() {
        let scene =
            |sensitivity| Scene { space: vec![700.0], time: 1.0, motion: 0.0, cells: vec![100], sensitivity };
        let cells = |found: &Found| found.settings.levels[0].cells(100);
        let (sure, unsure) = (scene(0.0).find(2.0, None).unwrap(), scene(30.0).find(2.0, None).unwrap());
        assert!(cells(&unsure) > cells(&sure), "{} {}", cells(&unsure), cells(&sure));
        assert!(unsure.total() <= 2.0);
        let Err(ChoiceError::OutOfReach { best, .. }) = scene(100.0).find(2.0, None) else { panic!() };
        assert!(best > 2.0 && scene(100.0).find(best, None).is_ok(), "{best}");
    }
}
