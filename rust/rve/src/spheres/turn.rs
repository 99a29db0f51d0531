//! The same box with other names of its axes: x becomes y, y becomes z, z becomes x. No law may depend on that.

use super::averages::Averages;
use super::strain::{Strain, Tensor};
use msdd_spheres::{Boundary, Simulation};

/// Old number of each new axis.
const FROM: [usize; 3] = [2, 0, 1];

fn vector<T: Copy>(old: [T; 3]) -> [T; 3] {
    FROM.map(|axis| old[axis])
}

/// The box turned; none between walls, or when the box is sheared, so that its edges would not be along the axes any more.
pub fn turned(simulation: &Simulation) -> Option<Simulation> {
    let mut state = simulation.state();
    let Boundary::Periodic(cell) = &mut state.boundary else { return None };
    let edges = cell.lattice.edges;
    if (0..3).any(|row| (0..3).any(|column| row != column && edges[row][column] != 0.0)) {
        return None;
    }
    cell.lattice.origin = vector(cell.lattice.origin);
    cell.lattice.edges = vector(edges).map(vector);
    cell.velocity_gradient = vector(cell.velocity_gradient).map(vector);
    for sphere in &mut state.spheres {
        sphere.position = vector(sphere.position);
        sphere.velocity = vector(sphere.velocity);
        sphere.angular_velocity = vector(sphere.angular_velocity);
    }
    for friction in &mut state.friction {
        friction.shift = vector(friction.shift);
        let [x, y, z, size] = friction.history;
        let [x, y, z] = vector([x, y, z]);
        friction.history = [x, y, z, size];
    }
    Simulation::from_state(state).ok()
}

/// A symmetric tensor in the turned axes.
pub fn turned_tensor([xx, yy, zz, xy, xz, yz]: Tensor) -> Tensor {
    [zz, xx, yy, xz, yz, xy]
}

/// A symmetric tensor of a turned box in the axes of the box that was turned.
pub fn turned_back(tensor: Tensor) -> Tensor {
    turned_tensor(turned_tensor(tensor))
}

/// A strain along the axes in the turned axes.
pub fn turned_strain(strain: Strain) -> Strain {
    Strain { stretch: turned_tensor(strain.stretch), ..strain }
}

impl Averages {
    /// Averages of a turned box in the axes of the box that was turned.
    pub fn turned_back(self) -> Self {
        Self {
            fabric: turned_back(self.fabric),
            stress: turned_back(self.stress),
            contact_conductivity: turned_back(self.contact_conductivity),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_back_undoes_turning() {
        let tensor = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(turned_back(turned_tensor(tensor)), tensor);
        // Turned three times, all is as before.
        assert_eq!(turned_tensor(turned_tensor(turned_tensor(tensor))), tensor);
        // y y is what x x was, x y what z x was.
        assert_eq!((turned_tensor(tensor)[1], turned_tensor(tensor)[3]), (1.0, 5.0));
    }
}
