//! Averages of a periodic box.

use msdd_spheres::{Partner, Simulation};

/// Averages of a periodic box. Compression is positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Averages {
    /// φ \[-\]: volume of the spheres over that of the box, overlaps counted twice.
    pub solid_fraction: f64,
    /// z \[-\]: contacts per sphere, all spheres counted.
    pub coordination: f64,
    /// z* \[-\]: contacts per sphere that is no rattler, contacts with rattlers left out.
    pub backbone_coordination: f64,
    /// Part of the spheres that are rattlers: spheres that too few contacts hold, see [`averages`].
    pub rattlers: f64,
    /// Love's stress \[Pa\]: Σ f ⊗ branch / V of the contact forces without damping.
    pub stress: [[f64; 3]; 3],
    /// Mean overlap over the mean radius \[-\].
    pub overlap: f64,
}

impl Averages {
    /// p = tr σ/3 \[Pa\].
    pub fn pressure(&self) -> f64 {
        (self.stress[0][0] + self.stress[1][1] + self.stress[2][2]) / 3.0
    }
}

/// Mean stress of the contact forces without damping \[Pa\]; 0 between walls.
pub fn stress(simulation: &Simulation) -> [[f64; 3]; 3] {
    let mut stress = [[0.0; 3]; 3];
    let Some(cell) = simulation.cell() else { return stress };
    simulation.for_each_contact(|contact| {
        let force = contact.force();
        for (row, b) in stress.iter_mut().zip(contact.branch) {
            for (sum, f) in row.iter_mut().zip(force) {
                *sum += f * b;
            }
        }
    });
    stress.map(|row| row.map(|sum| sum / cell.volume()))
}

/// Averages of a periodic box; those over its volume are 0 between walls.
///
/// Rattlers are spheres with fewer than 4 contacts without friction and fewer than 2 with friction, found again and
/// again after the contacts of those found have been taken away.
pub fn averages(simulation: &Simulation) -> Averages {
    let count = simulation.spheres.len();
    let mut pairs = Vec::new();
    let mut overlap = 0.0;
    simulation.for_each_contact(|contact| {
        overlap += contact.overlap;
        if let Partner::Sphere(i) = contact.i {
            pairs.push((i, contact.j));
        }
    });
    let least = if simulation.material.friction > 0.0 { 2 } else { 4 };
    let mut held = vec![true; count];
    let contacts = loop {
        let mut contacts = vec![0; count];
        for &(i, j) in pairs.iter().filter(|&&(i, j)| held[i] && held[j]) {
            contacts[i] += 1;
            contacts[j] += 1;
        }
        let loose: Vec<usize> = (0..count).filter(|&i| held[i] && contacts[i] < least).collect();
        if loose.is_empty() {
            break contacts;
        }
        loose.into_iter().for_each(|i| held[i] = false);
    };
    let backbone = held.iter().filter(|&&held| held).count();
    let volume: f64 = simulation.spheres.iter().map(|sphere| sphere.volume()).sum();
    Averages {
        solid_fraction: simulation.cell().map_or(0.0, |cell| volume / cell.volume()),
        coordination: 2.0 * pairs.len() as f64 / count as f64,
        backbone_coordination: contacts.iter().sum::<usize>() as f64 / backbone.max(1) as f64,
        rattlers: 1.0 - backbone as f64 / count as f64,
        stress: stress(simulation),
        overlap: overlap / pairs.len().max(1) as f64 / simulation.mean_radius(),
    }
}
