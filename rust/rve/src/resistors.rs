//! Steady temperatures of a network of resistors, by sparse Cholesky factorisation.
//!
//! The solver is nalgebra-sparse, because libraries that choose fused operations at run time would not give the same
//! bits on every machine. It does not reorder the unknowns to reduce fill-in, so they must be given in an order of
//! small bandwidth: sorted along one axis.

use nalgebra::DMatrix;
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::{CooMatrix, CscMatrix};

/// A network with nodes of unknown temperature, the conductances between them, and the heat sources.
pub(crate) struct Resistors {
    /// Pairs of unknown nodes and the conductance between them.
    pub links: Vec<(usize, usize, f64)>,
    /// For each unknown node, its conductance to nodes whose temperature is 0.
    pub ground: Vec<f64>,
    /// Heat into each unknown node, one column per load case.
    pub heat: DMatrix<f64>,
}

impl Resistors {
    /// `count` unknown nodes, `cases` load cases; nothing connected.
    pub fn new(count: usize, cases: usize) -> Self {
        Self { links: Vec::new(), ground: vec![0.0; count], heat: DMatrix::zeros(count, cases) }
    }

    /// Temperatures, one row per node, one column per load case. A cluster without connection to a known temperature is
    /// determined up to a constant (its heat must sum to 0): the temperature of one of its nodes is set to 0. None when
    /// a number is not finite.
    pub fn temperatures(mut self) -> Option<DMatrix<f64>> {
        if self.ground.is_empty() {
            return Some(self.heat);
        }
        self.pin_floating_clusters();
        let count = self.ground.len();
        let mut diagonal = self.ground;
        let mut matrix = CooMatrix::new(count, count);
        for &(i, j, conductance) in &self.links {
            diagonal[i] += conductance;
            diagonal[j] += conductance;
            matrix.push(i, j, -conductance);
            matrix.push(j, i, -conductance);
        }
        diagonal.iter().enumerate().for_each(|(i, &sum)| matrix.push(i, i, sum));
        // The matrix is positive definite by construction, so the factorisation fails only for numbers that are not
        // finite.
        let factor = CscCholesky::factor(&CscMatrix::from(&matrix)).ok()?;
        factor.solve_mut(&mut self.heat);
        Some(self.heat)
    }

    /// Grounds one node of each cluster without connection to ground. No heat flows there, since the heat of the
    /// cluster sums to 0.
    fn pin_floating_clusters(&mut self) {
        let mut parent: Vec<usize> = (0..self.ground.len()).collect();
        for &(i, j, _) in &self.links {
            let (a, b) = (root(&mut parent, i), root(&mut parent, j));
            parent[a.max(b)] = a.min(b);
        }
        let mut grounded = vec![false; parent.len()];
        for node in 0..parent.len() {
            grounded[root(&mut parent, node)] |= self.ground[node] > 0.0;
        }
        for node in 0..parent.len() {
            if parent[node] == node && !grounded[node] {
                self.ground[node] = 1.0;
            }
        }
    }
}

/// Representative of the node's cluster (union–find with path halving).
fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two nodes in series to ground, a floating pair with heat in and out, and a lone node.
    #[test]
    fn clusters_with_and_without_ground() {
        let mut network = Resistors::new(5, 1);
        network.links = vec![(0, 1, 2.0), (2, 3, 4.0)];
        network.ground[0] = 1.0;
        network.heat[1] = 6.0;
        (network.heat[2], network.heat[3]) = (-1.0, 1.0);
        let temperatures = network.temperatures().unwrap();
        for (value, expected) in temperatures.iter().zip([6.0, 9.0, 0.0, 0.25, 0.0]) {
            assert!((value - expected).abs() < 1e-14, "{temperatures}");
        }
    }

    #[test]
    fn nothing_unknown_and_nothing_finite() {
        assert_eq!(Resistors::new(0, 2).temperatures().unwrap().nrows(), 0);
        let mut network = Resistors::new(2, 1);
        network.links = vec![(0, 1, f64::NAN)];
        assert!(network.temperatures().is_none());
    }
}
