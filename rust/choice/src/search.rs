//! Which combination is the cheapest that is accurate enough.
//!
//! All that is left out or coarsened gets a share of the wanted accuracy. On a coarse mesh, runs with and without motion of the
//! grains, with a loose tolerance in time, and with half the cells along each direction show what each choice changes; the known
//! orders of the methods carry these differences to the settings that are not run.

use crate::ChoiceError;
use crate::settings::{Level, Settings};
use crate::trial::Outcome;
use serde::{Deserialize, Serialize};

/// Cells along a direction of the coarse mesh on which choices are compared, at least.
const COARSE: usize = 12;
/// Tolerance in time of these runs, a share of the range of T, and the loose one.
const TOLERANCE: f64 = 1e-3;
const LOOSE: f64 = 1e-2;
/// Tolerances that can be chosen.
const TOLERANCES: [f64; 7] = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];
/// Shares of the wanted accuracy.
const MECHANICS: f64 = 0.3;
const TIME: f64 = 0.2;
const SPACE: f64 = 0.5;
/// Estimates that are carried to other settings count so many times.
const SAFETY: f64 = 1.5;
/// A direction is dropped if the run without it is away by no more than this part of the direction's share.
const DROP: f64 = 0.3;
/// Order of the cell's size in the error of T.
pub const ORDER: i32 = 2;

/// What can be chosen.
#[derive(Clone, Debug)]
pub struct Wishes {
    /// Wanted accuracy of T [% of its range].
    pub accuracy: f64,
    /// Cells along each direction of the user's mesh; empty if it has to be taken as it is.
    pub cells: Vec<usize>,
    /// Whether grains move, if the user says so.
    pub moves: Option<bool>,
}

/// One run of the search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    pub what: String,
    pub settings: Settings,
    pub cells: usize,
    pub seconds: f64,
    /// How far T is from the first run on the coarse mesh with the same motion of the grains [% of the range].
    pub away: Option<f64>,
}

/// An estimate of what a choice leaves out.
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
    pub shares: Vec<Share>,
    pub tried: Vec<Tried>,
    /// What could not be tried, and why.
    pub notes: Vec<String>,
}

impl Found {
    /// Sum of the estimates [% of the range of T].
    pub fn total(&self) -> f64 {
        self.shares.iter().map(|share| share.percent).sum()
    }
}

/// Order of the time step's tolerance in the error of T: steps of second order grow with its cube root; with moving grains the
/// splitting of heat and motion is of first order.
fn time_order(moves: bool) -> f64 {
    if moves { 1.0 / 3.0 } else { 2.0 / 3.0 }
}

struct Search<'a, R> {
    run: &'a mut R,
    range: f64,
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
        let away = with.map(|other| self.percent(&outcome, other));
        let (cells, seconds) = (outcome.cells, outcome.seconds);
        self.tried.push(Tried { what: what.to_string(), settings, cells, seconds, away });
        Ok(outcome)
    }

    fn percent(&self, a: &Outcome, b: &Outcome) -> f64 {
        100.0 * a.series.distance(&b.series) / self.range
    }
}

/// Finds the cheapest combination. `run` makes one run, given the range of T once it is known.
///
/// # Errors
/// [`ChoiceError::OutOfReach`] with the best that can be had; those of `run`, except where grains cannot move.
pub fn find<R>(wishes: &Wishes, run: &mut R) -> Result<Found, ChoiceError>
where
    R: FnMut(&Settings, Option<f64>) -> Result<Outcome, ChoiceError>,
{
    let accuracy = wishes.accuracy;
    let coarse = wishes.cells.iter().map(|&cells| coarse_level(cells)).collect();
    let mut at = Settings { levels: coarse, tolerance: TOLERANCE, moves: wishes.moves == Some(true) };
    let mut search = Search { run, range: 0.0, tried: Vec::new() };
    let mut notes = Vec::new();
    let mut base = search.compare("coarse mesh", at.clone(), None)?;
    if search.range <= 0.0 {
        notes.push("T is the same everywhere and always".to_string());
        let settings = at;
        return Ok(Found { settings, range: 0.0, shares: Vec::new(), tried: search.tried, notes });
    }
    let mut shares = Vec::new();
    if wishes.moves.is_none() {
        let other = Settings { moves: true, ..at.clone() };
        match search.compare("grains move", other.clone(), Some(&base)) {
            Ok(moving) => {
                let percent = search.percent(&moving, &base);
                if percent > MECHANICS * accuracy {
                    (at, base) = (other, moving);
                } else {
                    let how = "runs with and without their motion".to_string();
                    shares.push(Share { source: "grains stay".to_string(), percent, how });
                }
            }
            Err(ChoiceError::Run { problem, .. }) => {
                notes.push(format!("grains that move could not be tried: {problem}"));
            }
            Err(other) => return Err(other),
        }
    }

    let mut out_of_reach = Vec::new();
    let loose = Settings { tolerance: LOOSE, ..at.clone() };
    let loose = search.compare("larger steps", loose, Some(&base))?;
    let order = time_order(at.moves);
    let fine = search.percent(&loose, &base) / ((LOOSE / TOLERANCE).powf(order) - 1.0);
    let error = |tolerance: f64| SAFETY * fine * (tolerance / TOLERANCE).powf(order);
    let enough = TOLERANCES.into_iter().find(|&tolerance| error(tolerance) <= TIME * accuracy);
    let tolerance = enough.unwrap_or(TOLERANCES[TOLERANCES.len() - 1]);
    if enough.is_none() {
        out_of_reach.push("steps");
    }
    let how = format!("runs with tolerances of {} and {} % of the range", 100.0 * LOOSE, 100.0 * TOLERANCE);
    shares.push(Share { source: "time".to_string(), percent: error(tolerance), how });

    let mut levels = at.levels.clone();
    for (direction, &cells) in wishes.cells.iter().enumerate() {
        let share = SPACE * accuracy / wishes.cells.len() as f64;
        let (level, estimate) = space(&mut search, &at, &base, direction, cells, share)?;
        if estimate.percent > share {
            out_of_reach.push("cells");
        }
        levels[direction] = level;
        shares.push(estimate);
    }
    if wishes.cells.is_empty() {
        notes.push("the error of the mesh is not known".to_string());
    }
    let settings = Settings { levels, tolerance, moves: at.moves };
    let found = Found { settings, range: search.range, shares, tried: search.tried, notes };
    if out_of_reach.is_empty() {
        return Ok(found);
    }
    // Each share at its smallest, and the whole divided as above.
    let limit = |share: &Share| match share.source.as_str() {
        "time" => share.percent / TIME,
        "grains stay" => 0.0,
        _ => share.percent * wishes.cells.len() as f64 / SPACE,
    };
    let best = found.shares.iter().map(limit).fold(0.0, f64::max);
    let reason = match out_of_reach.contains(&"cells") {
        true => "the mesh of the case is too coarse for less",
        false => "smaller steps than the smallest would be needed",
    };
    Err(ChoiceError::OutOfReach { asked: accuracy, best: 1.001 * best, reason: reason.to_string() })
}

/// The coarsest level with enough cells to compare choices on.
fn coarse_level(cells: usize) -> Level {
    let mut level = Level::Halved(0);
    while let Some(next) = level.coarser(cells).filter(|next| next.cells(cells) >= COARSE) {
        level = next;
    }
    level
}

/// The coarsest level of one direction whose error is within its share, and that error.
fn space<R>(
    search: &mut Search<'_, R>,
    at: &Settings,
    base: &Outcome,
    direction: usize,
    cells: usize,
    share: f64,
) -> Result<(Level, Share), ChoiceError>
where
    R: FnMut(&Settings, Option<f64>) -> Result<Outcome, ChoiceError>,
{
    let source = format!("cells, direction {}", direction + 1);
    let with = |level: Level| {
        let mut settings = at.clone();
        settings.levels[direction] = level;
        settings
    };
    let here = at.levels[direction];
    let Some(coarser) = here.coarser(cells) else {
        let how = "too few cells for a comparison".to_string();
        return Ok((Level::Halved(0), Share { source, percent: 0.0, how }));
    };
    let ratio = |level: Level| here.cells(cells) as f64 / level.cells(cells) as f64;
    let what = format!("{} cells along direction {}", coarser.cells(cells), direction + 1);
    let halved = search.compare(&what, with(coarser), Some(base))?;
    let percent = search.percent(&halved, base) / (ratio(coarser).powi(ORDER) - 1.0);
    if percent <= DROP * share {
        let what = format!("a single cell along direction {}", direction + 1);
        if let Ok(single) = search.compare(&what, with(Level::One), Some(base)) {
            let percent = search.percent(&single, base);
            if percent <= DROP * share {
                return Ok((
                    Level::One,
                    Share { source, percent, how: "a run without this direction".to_string() },
                ));
            }
        }
    }
    let how = format!("runs with {} and {} cells", coarser.cells(cells), here.cells(cells));
    let error = |level: Level| SAFETY * percent * ratio(level).powi(ORDER);
    let mut level = Level::Halved(0);
    while let Some(next) = level.coarser(cells).filter(|&next| error(next) <= share) {
        level = next;
    }
    Ok((level, Share { source, percent: error(level), how }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::Series;

    /// A scene whose errors are known: `space[k]` at 1 cell along k, falling with the square; `time` at tolerance 1.
    struct Known {
        space: Vec<f64>,
        time: f64,
        motion: f64,
        cells: Vec<usize>,
    }

    impl Known {
        fn error(&self, settings: &Settings) -> f64 {
            let space = settings.levels.iter().zip(&self.cells).zip(&self.space);
            let space: f64 = space.map(|((l, &n), e)| e / (l.cells(n) as f64).powi(2)).sum();
            let motion = if settings.moves { 0.0 } else { self.motion };
            space + self.time * settings.tolerance.powf(time_order(settings.moves)) + motion
        }

        fn find(&self, accuracy: f64, moves: Option<bool>) -> Result<Found, ChoiceError> {
            let wishes = Wishes { accuracy, cells: self.cells.clone(), moves };
            find(&wishes, &mut |settings: &Settings, _| {
                let values = vec![vec![0.0], vec![100.0 + self.error(settings)]];
                let series = Series { times: vec![0.0, 1.0], values };
                let cells = settings.levels.iter().zip(&self.cells).map(|(l, &n)| l.cells(n)).product();
                Ok(Outcome { series, range: 100.0, cells, seconds: 1.0 })
            })
        }
    }

    #[test]
    fn the_true_error_is_within_the_request_and_no_finer_than_it_needs() {
        let scene = Known { space: vec![300.0, 100.0], time: 4.0, motion: 0.1, cells: vec![200, 100] };
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
        let scene = Known { space: vec![10.0], time: 1.0, motion: 4.0, cells: vec![100] };
        assert!(scene.find(1.0, None).unwrap().settings.moves);
        assert!(!scene.find(20.0, None).unwrap().settings.moves);
        assert!(scene.find(20.0, Some(true)).unwrap().settings.moves);
        assert!(!scene.find(1.0, Some(false)).unwrap().settings.moves);
    }

    #[test]
    fn a_direction_along_which_nothing_changes_gets_one_cell() {
        let scene = Known { space: vec![300.0, 0.0], time: 1.0, motion: 0.0, cells: vec![100, 50] };
        assert_eq!(scene.find(1.0, None).unwrap().settings.levels[1], Level::One);
    }

    #[test]
    fn a_request_out_of_reach_is_refused_with_the_best_that_can_be_had() {
        let scene = Known { space: vec![300.0], time: 1.0, motion: 0.0, cells: vec![20] };
        let Err(ChoiceError::OutOfReach { best, .. }) = scene.find(0.5, None) else { panic!() };
        assert!(best > 0.5 && scene.find(best, None).is_ok(), "{best}");
    }
}
