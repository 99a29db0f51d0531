//! How many cells along each direction: what the coarse mesh shows, and how fine the chosen one has to be.

use crate::ChoiceError;
use crate::found::Share;
use crate::runs::{Each, Runs, larger};
use crate::settings::{Level, Settings};
use crate::trial::Outcome;

/// Cells along a direction of the coarse mesh on which choices are compared, at least.
const COARSE: usize = 12;
/// Finest level: the case's own cells doubled twice.
const FINEST: Level = Level::Halved(-2);
/// Errors that are extrapolated count so many times, and those that are seen as the distance from a finer run.
pub const SAFETY: f64 = 1.5;
const SEEN: f64 = 1.1;
/// Order of the cell's size in the error of T.
pub const ORDER: i32 = 2;

/// The coarsest level with enough cells along a direction, or half of it, to compare choices on.
pub fn coarse_level(cells: usize, half: bool) -> Level {
    let least = if half { COARSE / 2 } else { COARSE };
    let mut level = Level::Halved(0);
    while let Some(next) = level.coarser(cells).filter(|next| next.cells(cells) >= least) {
        level = next;
    }
    level
}

/// The coarsest level with enough cells at which half of a direction has exactly half the cells.
pub fn even_level(cells: usize) -> Level {
    let mut halvings = 0;
    while cells.is_multiple_of(4 << halvings) && cells >> (halvings + 1) >= COARSE {
        halvings += 1;
    }
    Level::Halved(halvings)
}

/// The run on the coarse mesh that others are compared with.
pub struct Base {
    pub settings: Settings,
    pub outcome: Outcome,
}

impl Base {
    fn with(&self, direction: usize, level: Level) -> Settings {
        let mut settings = self.settings.clone();
        settings.levels[direction] = level;
        settings
    }
}

/// What the coarse mesh shows of one direction.
pub struct DirectionErrors {
    /// Number of the direction, and the cells of the user's mesh along it.
    direction: usize,
    cells: usize,
    /// Whether a single cell is enough.
    pub single: bool,
    /// Error at the coarse mesh's level, or with a single cell [% of the range]; infinite if there are too few cells to tell.
    pub error: f64,
    how: String,
}

/// The cells along one direction.
pub struct Chosen {
    pub level: Level,
    pub share: Share,
    /// Errors of T and p, if not even the finest level is fine enough.
    pub missed: Option<Each>,
}

impl DirectionErrors {
    /// Compares the coarse mesh with one of half the cells along a direction, and with a single cell if that changes no more
    /// than `drop` [% of the range of T].
    ///
    /// # Errors
    /// Those of the runs.
    pub fn new(
        runs: &mut Runs,
        base: &Base,
        direction: usize,
        cells: usize,
        drop: f64,
    ) -> Result<Self, ChoiceError> {
        let known = |single, error, how| Self { direction, cells, single, error, how };
        let here = base.settings.levels[direction];
        let Some(coarser) = here.coarser(cells) else {
            return Ok(known(false, f64::INFINITY, String::new()));
        };
        let ratio = here.cells(cells) as f64 / coarser.cells(cells) as f64;
        let what = format!("{} cells along direction {}", coarser.cells(cells), direction + 1);
        let halved = runs.compare(&what, base.with(direction, coarser), Some(&base.outcome))?;
        let error = runs.percent(&halved, &base.outcome) / (ratio.powi(ORDER) - 1.0);
        if error <= drop {
            let what = format!("a single cell along direction {}", direction + 1);
            let single = runs.compare(&what, base.with(direction, Level::One), Some(&base.outcome));
            if let Ok(single) = single {
                let error = runs.percent(&single, &base.outcome);
                if error <= drop {
                    return Ok(known(true, error, "a run without this direction".to_string()));
                }
            }
        }
        let how = format!("runs with {} and {} cells", coarser.cells(cells), here.cells(cells));
        Ok(known(false, error, how))
    }

    /// The coarsest level of the direction, among those that are run, whose error is within its share [% of the range of T], and
    /// that error: that with half the cells of the coarse mesh, the coarse mesh, or finer levels, which are run one after the
    /// other until one is fine enough.
    ///
    /// # Errors
    /// Those of the runs.
    pub fn level(&self, runs: &mut Runs, base: &Base, share: f64) -> Result<Chosen, ChoiceError> {
        let chosen = |level, percent, how: String, missed| {
            let source = format!("cells, direction {}", self.direction + 1);
            Chosen { level, share: Share { source, percent, how }, missed }
        };
        if self.single {
            return Ok(chosen(Level::One, self.error, self.how.clone(), None));
        }
        let cells = self.cells;
        let mut level = base.settings.levels[self.direction];
        let (mut error, mut how) = (SAFETY * self.error, self.how.clone());
        if error <= share {
            let ratio = |next: Level| (level.cells(cells) as f64 / next.cells(cells) as f64).powi(ORDER);
            if let Some(next) = level.coarser(cells).filter(|&next| error * ratio(next) <= share) {
                error *= ratio(next);
                level = next;
            }
            return Ok(chosen(level, error, how, None));
        }
        let mut each = [error, 0.0];
        let mut last = base.outcome.clone();
        while level > FINEST {
            let finer = level.finer();
            let what = format!("{} cells along direction {}", finer.cells(cells), self.direction + 1);
            let next = runs.compare(&what, base.with(self.direction, finer), Some(&base.outcome))?;
            let ratio = (finer.cells(cells) as f64 / level.cells(cells) as f64).powi(ORDER);
            let away = runs.apart(&next, &last);
            how = format!("runs with {} and {} cells", level.cells(cells), finer.cells(cells));
            // The distance itself is most of the error of the coarser of the two.
            let coarse = SEEN * larger(away) * ratio / (ratio - 1.0);
            if coarse <= share {
                return Ok(chosen(level, coarse, how, None));
            }
            each = away.map(|away| SAFETY * away / (ratio - 1.0));
            (error, level, last) = (larger(each), finer, next);
            if error <= share {
                return Ok(chosen(level, error, how, None));
            }
        }
        Ok(chosen(level, error, how, Some(each)))
    }
}
