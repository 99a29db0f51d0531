//! One contact in the form that averages and audits use, and the iteration over all contacts of a box.

use crate::boundary::Boundary;
use crate::law::{ContactLaw, History};
use crate::neighbours::Neighbours;
use crate::space::{length, minus, plus, scaled};
use crate::sphere::Sphere;
use msdd_engine::Image;

/// What the second sphere of a contact touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Partner {
    Sphere(usize),
    /// By the wall's number.
    Wall(usize),
}

/// Two spheres that touch, or a sphere and a wall. n points from i to j (from the wall to the sphere).
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    pub i: Partner,
    pub j: usize,
    /// In a periodic box, the shift of the image of j that i touches.
    pub shift: [i32; 3],
    /// Unit normal.
    pub normal: [f64; 3],
    /// From centre to centre (of j's image), or from the foot on the wall to the centre \[m\].
    pub branch: [f64; 3],
    /// δ \[m\].
    pub overlap: f64,
    /// R* \[m\].
    pub effective_radius: f64,
    /// f_t \[N\] on j and a, as the last step has stored them.
    pub history: History,
    /// Elastic normal force \[N\], without damping, at the present overlap.
    pub normal_force: f64,
}

impl Contact {
    /// Friction force on j \[N\], without damping.
    pub fn tangential_force(&self) -> [f64; 3] {
        let [x, y, z, _] = self.history;
        [x, y, z]
    }

    /// Force on j \[N\], without damping.
    pub fn force(&self) -> [f64; 3] {
        plus(self.tangential_force(), self.normal_force, self.normal)
    }

    /// The one or two spheres of the contact.
    pub fn spheres(&self) -> impl Iterator<Item = usize> + use<> {
        let first = match self.i {
            Partner::Sphere(i) => Some(i),
            Partner::Wall(_) => None,
        };
        first.into_iter().chain(std::iter::once(self.j))
    }
}

/// The spheres of a box at one moment, from which their contacts are computed.
#[derive(Clone, Copy)]
pub(crate) struct Touching<'a> {
    pub law: ContactLaw,
    pub spheres: &'a [Sphere],
    pub boundary: &'a Boundary,
    pub neighbours: &'a Neighbours,
}

impl Touching<'_> {
    /// The sphere, or the image of a sphere, that an index in the pair list stands for.
    pub fn image_of(&self, index: u32) -> Image<3> {
        match (index as usize).checked_sub(self.spheres.len()) {
            None => Image { owner: index, shift: [0; 3] },
            Some(ghost) => self.neighbours.ghosts[ghost],
        }
    }

    /// Calls `visit` with every candidate: pairs row by row, then the walls one after the other. The overlap of
    /// candidates that do not touch is negative.
    pub fn for_each_candidate(&self, mut visit: impl FnMut(Contact)) {
        let pairs = &self.neighbours.pairs;
        for (k, (&i, &j)) in pairs.rows.i().iter().zip(pairs.rows.j()).enumerate() {
            let image = self.image_of(j);
            let (a, mut b) = (&self.spheres[i as usize], self.spheres[image.owner as usize]);
            if let Some(cell) = self.boundary.cell() {
                b = cell.lattice.image(&b, image.shift);
            }
            let branch = minus(b.position, a.position);
            let distance = length(branch);
            visit(self.contact(
                (Partner::Sphere(i as usize), image.owner as usize, image.shift),
                (scaled(1.0 / distance, branch), branch),
                a.radius + b.radius - distance,
                a.radius * b.radius / (a.radius + b.radius),
                pairs.history(k),
            ));
        }
        for number in 0..self.boundary.walls().len() {
            self.for_each_candidate_at(number, &mut visit);
        }
    }

    /// Likewise with the candidates of one wall.
    pub fn for_each_candidate_at(&self, number: usize, mut visit: impl FnMut(Contact)) {
        let (wall, contacts) = (&self.boundary.walls()[number], &self.neighbours.walls[number]);
        for (&j, &history) in contacts.sphere.iter().zip(&contacts.history) {
            let sphere = &self.spheres[j as usize];
            let (distance, normal) = wall.foot(sphere.position);
            visit(self.contact(
                (Partner::Wall(number), j as usize, [0; 3]),
                (normal, scaled(distance, normal)),
                sphere.radius - distance,
                sphere.radius,
                history,
            ));
        }
    }

    fn contact(
        &self,
        (i, j, shift): (Partner, usize, [i32; 3]),
        (normal, branch): ([f64; 3], [f64; 3]),
        overlap: f64,
        effective_radius: f64,
        history: History,
    ) -> Contact {
        let normal_force = self.law.normal * self.law.size(overlap, effective_radius) * overlap.max(0.0);
        Contact { i, j, shift, normal, branch, overlap, effective_radius, history, normal_force }
    }

    /// Calls `visit` with every contact (positive overlap).
    pub fn for_each(&self, mut visit: impl FnMut(Contact)) {
        self.for_each_candidate(|contact| {
            if contact.overlap > 0.0 {
                visit(contact);
            }
        });
    }
}
