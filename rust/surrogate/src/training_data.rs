//! Rows of a database, sorted for the training of all kinds of models.

use crate::SurrogateError;
use crate::dataset::{self, PackingSplit, StateRow};
use crate::tracks::Track;
use crate::wall_friction::WallSlip;

/// Rows of a database for training.
#[derive(Clone, Debug, Default)]
pub struct TrainingData {
    /// States on thermal ramps.
    pub rows: Vec<StateRow>,
    /// All paths of strain, thermal and mechanical, of periodic boxes.
    pub tracks: Vec<Track>,
    pub wall_slips: Vec<WallSlip>,
}

impl TrainingData {
    /// The packings for training, validation and test of a model that is trained on rows and tracks. Models that are trained
    /// on rows alone split by the packings of the rows.
    ///
    /// # Errors
    /// [`SurrogateError::Data`] for fewer than three packings.
    pub fn split(&self, seed: u64) -> Result<PackingSplit, SurrogateError> {
        let rows = self.rows.iter().map(|row| row.packing);
        dataset::split_packings(rows.chain(self.tracks.iter().map(|track| track.packing)), seed)
    }
}

impl From<Vec<StateRow>> for TrainingData {
    fn from(rows: Vec<StateRow>) -> Self {
        Self { rows, ..Self::default() }
    }
}
