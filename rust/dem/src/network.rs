//! The conductance matrix of a network of thermal pipes, stored by rows. Every pipe stands in the rows of both its
//! ends, so that the sum over a row can stay in a register. Eight consecutive rows form a slice and are padded to the
//! length of the longest of them (SELL format, Kreutzer et al., SIAM J. Sci. Comput. 36, C401, 2014): if the length
//! changed from row to row, the processor would mispredict the end of nearly every row.
//!
//! (Two alternatives take twice as long, as measured: adding each pipe's flow to both its ends, and gathering eight
//! rows at once.)

use msdd_engine::team;

/// Rows of a slice.
const ROWS: usize = 8;
/// Number of equal parts that the threads share. There are more parts than threads, so that when one thread is held up,
/// the others take over its remaining parts.
const PARTS: usize = 8;

/// Pipes between nodes. A row is ordered by the node at the other end, so pipes of conductance 0 do not change its sum.
#[derive(Clone, Debug, Default)]
pub(crate) struct Network {
    /// Slice s has the entries `start[s]..start[s + 1]`: `ROWS` rows of equal length, one after the other.
    start: Vec<u32>,
    /// Node at the other end of each entry's pipe; the row's own number in entries that only pad the row.
    other: Vec<u32>,
    /// Number of each entry's pipe; arbitrary in entries that only pad the row.
    pipe: Vec<u32>,
    /// Conductance of each entry's pipe [W/K].
    conductance: Vec<f64>,
}

impl Network {
    /// A network of the pipes `ends`, pairs (i, j) with i < j ordered by i, then j; a pipe's number is its position
    /// there. The conductances are set by [`Network::set`].
    pub fn new(nodes: usize, ends: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut degree = vec![0usize; nodes];
        for (i, j) in ends.clone() {
            degree[i as usize] += 1;
            degree[j as usize] += 1;
        }
        let mut network = Self { start: vec![0], ..Self::default() };
        let mut free = Vec::with_capacity(nodes);
        for (slice, degrees) in degree.chunks(ROWS).enumerate() {
            let length = degrees.iter().copied().max().unwrap_or(0);
            for row in 0..degrees.len() {
                free.push(network.other.len());
                network.other.resize(network.other.len() + length, (slice * ROWS + row) as u32);
            }
            network.start.push(network.other.len() as u32);
        }
        network.pipe = vec![0; network.other.len()];
        network.conductance = vec![0.0; network.other.len()];
        let mut place = |row: u32, other: u32, pipe: u32| {
            let entry = free[row as usize];
            free[row as usize] += 1;
            (network.other[entry], network.pipe[entry]) = (other, pipe);
        };
        // For each row, the lower-numbered ends are entered first, then the higher ones: both come in order because the
        // pipes do.
        for (pipe, (i, j)) in (0u32..).zip(ends.clone()) {
            place(j, i, pipe);
        }
        for (pipe, (i, j)) in (0u32..).zip(ends) {
            place(i, j, pipe);
        }
        network
    }

    /// Sets the conductances of all pipes [W/K]; in parallel when `parallel`.
    pub fn set(&mut self, parallel: bool, conductance: &[f64]) {
        let part = part_length(parallel, self.pipe.len());
        let parts = self.conductance.chunks_mut(part).zip(self.pipe.chunks(part));
        shared(parallel, parts, |(values, pipes)| {
            for (value, &pipe) in values.iter_mut().zip(pipes) {
                *value = conductance[pipe as usize];
            }
        });
    }

    /// Net flow into each node, Σ_pipes h (x_other − x_own); in parallel when `parallel`.
    pub fn inflow(&self, parallel: bool, x: &[f64], flow: &mut [f64]) {
        let slices = part_length(parallel, self.start.len() - 1);
        let parts = flow.chunks_mut(slices * ROWS).zip((0..).step_by(slices));
        shared(parallel, parts, |(flow, first)| self.part_of_inflow(x, first, flow));
    }

    /// As [`Network::inflow`], for the nodes of the slices from `first` on.
    fn part_of_inflow(&self, x: &[f64], first: usize, flow: &mut [f64]) {
        let own = &x[first * ROWS..];
        for (slice, (flow, own)) in (first..).zip(flow.chunks_mut(ROWS).zip(own.chunks(ROWS))) {
            let entries = self.start[slice] as usize..self.start[slice + 1] as usize;
            let length = entries.len() / own.len();
            let (mut others, mut conductances) = (&self.other[entries.clone()], &self.conductance[entries]);
            for (flow, own) in flow.iter_mut().zip(own) {
                let (other, later_others) = others.split_at(length);
                let (conductance, later_conductances) = conductances.split_at(length);
                (others, conductances) = (later_others, later_conductances);
                let mut sum = 0.0;
                for (&other, conductance) in other.iter().zip(conductance) {
                    // In an entry that only pads the row, `other` is the row itself and the difference is 0.
                    sum += conductance * (x[other as usize] - own);
                }
                *flow = sum;
            }
        }
    }

    /// Σ_pipes h of each node [W/K].
    pub fn sums(&self, nodes: usize) -> Vec<f64> {
        let mut sums = vec![0.0; nodes];
        for (slice, sums) in sums.chunks_mut(ROWS).enumerate() {
            let entries = self.start[slice] as usize..self.start[slice + 1] as usize;
            let length = entries.len() / sums.len();
            for (entry, k) in entries.enumerate() {
                if self.other[k] as usize != slice * ROWS + entry / length {
                    sums[entry / length] += self.conductance[k];
                }
            }
        }
        sums
    }
}

/// Number of items of one part, for `items` items in all.
fn part_length(parallel: bool, items: usize) -> usize {
    items.div_ceil(if parallel { PARTS } else { 1 }).max(1)
}

/// Does `work` on each part; in parallel when `parallel`.
fn shared<T: Send>(parallel: bool, parts: impl Iterator<Item = T>, work: impl Fn(T) + Sync) {
    if parallel {
        team::share(parts.collect(), work);
    } else {
        parts.for_each(work);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inflow_is_that_of_the_pipes_one_by_one() {
        let nodes = 21;
        let mut ends: Vec<(u32, u32)> =
            (0..60u32).map(|k| (k * 7 % 20, 1 + k * 7 % 20 + k * 3 % (20 - k * 7 % 20))).collect();
        ends.sort_unstable();
        let conductance: Vec<f64> = (0..60).map(|k| f64::from(k * k % 11)).collect();
        let x: Vec<f64> = (0..21).map(|k| f64::from(k * 5 % 13)).collect();
        let (mut expected, mut diagonal) = (vec![0.0; nodes], vec![0.0; nodes]);
        for (&(i, j), value) in ends.iter().zip(&conductance) {
            let (i, j) = (i as usize, j as usize);
            assert!(i < j && j < nodes);
            expected[i] += value * (x[j] - x[i]);
            expected[j] += value * (x[i] - x[j]);
            diagonal[i] += value;
            diagonal[j] += value;
        }
        let mut network = Network::new(nodes, ends.iter().copied());
        network.set(false, &conductance);
        let mut flow = vec![f64::NAN; nodes];
        network.inflow(false, &x, &mut flow);
        // The values are small integers, so the sums are exact and can be compared with ==.
        assert_eq!(flow, expected);
        flow.fill(f64::NAN);
        network.set(true, &conductance);
        network.inflow(true, &x, &mut flow);
        assert_eq!(flow, expected);
        assert_eq!(network.sums(nodes), diagonal);
    }
}
