//! The conductance matrix of a network of pipes, by rows: every pipe stands in the rows of both its ends, so the sum of a
//! row stays in a register. Eight rows in turn have the same length, the longest of theirs (SELL, Kreutzer et al., SIAM J.
//! Sci. Comput. 36, C401, 2014): a loop whose length changed from row to row would be predicted wrongly in each.
//!
//! (Adding each pipe's flow to both its ends, or gathering eight rows at once, was measured to take twice as long.)

use crate::team;

/// Rows of a slice.
const ROWS: usize = 8;
/// Parts that threads share, of as many rows each. More parts than threads: one that is held up leaves its work to others.
const PARTS: usize = 8;

/// Pipes between nodes. Rows are in the order of the other ends, so sums do not depend on pipes of conductance 0.
#[derive(Clone, Debug, Default)]
pub(crate) struct Network {
    /// Row r is `ROWS` rows a slice, each as long as the slice's: `start[s]..start[s + 1]` in all.
    start: Vec<u32>,
    /// The other end; the row's own number where the row has no pipe left.
    other: Vec<u32>,
    /// The pipe; any where the row has none left.
    pipe: Vec<u32>,
    /// [W/K]
    conductance: Vec<f64>,
}

impl Network {
    /// A network of the pipes `ends`, (i, j) with i < j, in the order of i, then j, which gives them their numbers.
    /// Conductances are still to be set.
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
        // Lower numbers first, then higher ones: both in order when the pipes are.
        for (pipe, (i, j)) in (0u32..).zip(ends.clone()) {
            place(j, i, pipe);
        }
        for (pipe, (i, j)) in (0u32..).zip(ends) {
            place(i, j, pipe);
        }
        network
    }

    /// Sets the conductances of all pipes [W/K]; side by side when `parallel`.
    pub fn set(&mut self, parallel: bool, conductance: &[f64]) {
        let part = part_length(parallel, self.pipe.len());
        let parts = self.conductance.chunks_mut(part).zip(self.pipe.chunks(part));
        shared(parallel, parts, |(values, pipes)| {
            for (value, &pipe) in values.iter_mut().zip(pipes) {
                *value = conductance[pipe as usize];
            }
        });
    }

    /// Net flow into each node, Σ_pipes h (x_other − x_own); side by side when `parallel`.
    pub fn inflow(&self, parallel: bool, x: &[f64], flow: &mut [f64]) {
        let slices = part_length(parallel, self.start.len() - 1);
        let parts = flow.chunks_mut(slices * ROWS).zip((0..).step_by(slices));
        shared(parallel, parts, |(flow, first)| self.part_of_inflow(x, first, flow));
    }

    /// As [`Network::inflow`], into the nodes of the slices from `first` on.
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
                    // Where no pipe is left the difference is 0.
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

/// Length of a part of so many items.
fn part_length(parallel: bool, items: usize) -> usize {
    items.div_ceil(if parallel { PARTS } else { 1 }).max(1)
}

/// `work` on each part.
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
        // Small integers: sums are exact.
        assert_eq!(flow, expected);
        flow.fill(f64::NAN);
        network.set(true, &conductance);
        network.inflow(true, &x, &mut flow);
        assert_eq!(flow, expected);
        assert_eq!(network.sums(nodes), diagonal);
    }
}
