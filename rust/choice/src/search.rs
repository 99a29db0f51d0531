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
/// Largest shares of the wanted accuracy; all that is left is for the cells.
const MECHANICS: f64 = 0.3;
const TIME: f64 = 0.2;
/// Errors that are extrapolated count so many times, and those that are seen as the distance from a finer run.
const SAFETY: f64 = 1.5;
const SEEN: f64 = 1.1;
/// A direction is dropped if the run without it is away by no more than this share of the wanted accuracy.
const DROP: f64 = 0.1;
/// Finest level: the case's own cells doubled twice.
const FINEST: Level = Level::Halved(-2);
/// Source of the error of grains that stay although they might move.
const STAY: &str = "grains stay";
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
                    shares.push(Share { source: STAY.to_string(), percent, how });
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

    // What is left for the cells. Directions along which nothing changes leave their share to the others.
    let left: f64 = shares.iter().filter(|share| share.source == STAY).map(|share| share.percent).sum();
    let mut left = accuracy * (1.0 - TIME) - left;
    let mut directions = Vec::new();
    for (direction, &cells) in wishes.cells.iter().enumerate() {
        let found = direction_at(&mut search, &at, &base, direction, cells, DROP * accuracy)?;
        if found.single {
            left -= found.error;
        }
        directions.push(found);
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
    let taken = accuracy * (1.0 - TIME) - left;
    let time = found.shares.iter().find(|share| share.source == "time").map_or(0.0, |share| share.percent);
    let best = (time / TIME).max((worst * many + taken) / (1.0 - TIME));
    let reason = match out_of_reach.contains(&"cells") {
        true => "four times the cells of the case along a direction are too few for less",
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
    }

    impl Scene {
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
        let scene = Scene { space: vec![300.0, 100.0], time: 4.0, motion: 0.1, cells: vec![200, 100] };
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
        let scene = Scene { space: vec![10.0], time: 1.0, motion: 4.0, cells: vec![100] };
        assert!(scene.find(1.0, None).unwrap().settings.moves);
        assert!(!scene.find(20.0, None).unwrap().settings.moves);
        assert!(scene.find(20.0, Some(true)).unwrap().settings.moves);
        assert!(!scene.find(1.0, Some(false)).unwrap().settings.moves);
    }

    #[test]
    fn a_direction_along_which_nothing_changes_gets_one_cell() {
        let scene = Scene { space: vec![300.0, 0.0], time: 1.0, motion: 0.0, cells: vec![100, 50] };
        assert_eq!(scene.find(1.0, None).unwrap().settings.levels[1], Level::One);
    }

    #[test]
    fn a_request_out_of_reach_is_refused_with_the_best_that_can_be_had() {
        let scene = Scene { space: vec![30_000.0], time: 1.0, motion: 0.0, cells: vec![20] };
        let Err(ChoiceError::OutOfReach { best, .. }) = scene.find(0.5, None) else { panic!() };
        assert!(best > 0.5 && scene.find(best, None).is_ok(), "{best}");
    }
}
