//! Candidate contacts in rows, with the friction history of each.

/// Pairs within the search distance, as compressed rows: row i holds the partners j > i in growing order.
///
/// The order makes sums over contacts independent of when the rows were last rebuilt: a candidate that bears no
/// force adds nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactRows {
    /// Row i is `start[i]..start[i + 1]`.
    pub start: Vec<u32>,
    /// Partner j.
    pub partner: Vec<u32>,
    /// f_t [N] of the last step, on j along t; 0 when the contact is open.
    pub tangential: Vec<f64>,
}

impl ContactRows {
    pub fn row(&self, i: usize) -> std::ops::Range<usize> {
        self.start[i] as usize..self.start[i + 1] as usize
    }

    /// f_t of the pair (i, j), i < j, or 0 if it is no candidate.
    pub fn tangential_of(&self, i: usize, j: u32) -> f64 {
        let row = self.row(i);
        match self.partner[row.clone()].binary_search(&j) {
            Ok(k) => self.tangential[row.start + k],
            Err(_) => 0.0,
        }
    }
}

/// Discs within the search distance of one wall, in growing order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallContacts {
    pub disc: Vec<u32>,
    /// f_t [N] on the disc along t; 0 when the contact is open.
    pub tangential: Vec<f64>,
}

impl WallContacts {
    /// f_t of the disc, or 0 if it is no candidate.
    pub fn tangential_of(&self, disc: u32) -> f64 {
        self.disc.binary_search(&disc).map_or(0.0, |k| self.tangential[k])
    }
}
