//! One force-bearing contact in the form that averages and audits use, and the iteration over all contacts of a box.

use crate::disc::Disc;
use crate::law::{pair_stiffness, wall_stiffness};
use crate::material::Material;
use crate::neighbours::Neighbours;
use crate::periodic::{Cell, Image, Shift};
use crate::walls::{Side, Walls};

/// A force-bearing contact. n points from i to j (from the wall inwards), t = (−n_y, n_x).
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// First partner, or the wall.
    pub i: Result<usize, Side>,
    /// Second partner.
    pub j: usize,
    /// In a periodic box, the shift of the image of j that i touches.
    pub shift: Shift,
    /// Unit normal.
    pub normal: [f64; 2],
    /// Centre to centre, of j's image in a periodic box; of a wall contact, the foot of the centre on the wall to the centre \[m\].
    pub branch: [f64; 2],
    /// δ \[m\].
    pub overlap: f64,
    /// s_n [N/m].
    pub stiffness: f64,
    /// f_t \[N\], on j along t.
    pub tangential_force: f64,
}

impl Contact {
    /// f_n = s_n δ \[N\], repulsive.
    pub fn normal_force(&self) -> f64 {
        self.stiffness * self.overlap
    }

    /// Force on j \[N\].
    pub fn force(&self) -> [f64; 2] {
        let ([nx, ny], normal, tangential) = (self.normal, self.normal_force(), self.tangential_force);
        [normal * nx - tangential * ny, normal * ny + tangential * nx]
    }

    /// ½ s_n δ² + ½ f_t²/s_t \[J\].
    pub fn energy(&self, stiffness_ratio: f64) -> f64 {
        let (normal, tangential) = (self.normal_force(), self.tangential_force);
        // Without tangential stiffness there is no f_t to divide.
        let along = if tangential == 0.0 { 0.0 } else { tangential * tangential / stiffness_ratio };
        0.5 * (normal * normal + along) / self.stiffness
    }

    /// The one or two discs of the contact.
    pub fn discs(&self) -> impl Iterator<Item = usize> + use<> {
        self.i.ok().into_iter().chain(std::iter::once(self.j))
    }
}

/// The discs of a box at one moment, from which their contacts are computed.
#[derive(Clone, Copy)]
pub(crate) struct Touching<'a> {
    pub material: &'a Material,
    pub discs: &'a [Disc],
    pub walls: &'a Walls,
    /// The cell of a periodic box; none between walls.
    pub cell: Option<Cell>,
    pub neighbours: &'a Neighbours,
}

impl Touching<'_> {
    /// Calls `visit` with every force-bearing contact: pairs row by row, then the walls.
    pub fn for_each(&self, mut visit: impl FnMut(Contact)) {
        let pairs = &self.neighbours.pairs;
        for (k, (&i, &j)) in pairs.i().iter().zip(pairs.j()).enumerate() {
            if let Some(contact) = self.pair_contact(i as usize, self.image_of(j), pairs.tangential[k]) {
                visit(contact);
            }
        }
        self.for_each_at_walls(visit);
    }

    /// Calls `visit` with every force-bearing contact of a wall.
    pub fn for_each_at_walls(&self, mut visit: impl FnMut(Contact)) {
        for side in Side::ALL {
            let contacts = &self.neighbours.walls[side as usize];
            for (&j, &tangential) in contacts.disc.iter().zip(&contacts.tangential) {
                if let Some(contact) = self.wall_contact(side, j as usize, tangential) {
                    visit(contact);
                }
            }
        }
    }

    /// The disc, or the image of a disc, that an index in the pair list stands for.
    pub fn image_of(&self, index: u32) -> Image {
        match (index as usize).checked_sub(self.discs.len()) {
            None => Image { owner: index, shift: [0, 0] },
            Some(ghost) => self.neighbours.ghosts[ghost],
        }
    }

    fn pair_contact(&self, i: usize, image: Image, tangential_force: f64) -> Option<Contact> {
        let Image { owner, shift } = image;
        let (a, mut b) = (&self.discs[i], self.discs[owner as usize]);
        if let Some(cell) = self.cell.filter(|_| shift != [0, 0]) {
            b = cell.image(&b, shift);
        }
        let branch = [b.x - a.x, b.y - a.y];
        let distance = (branch[0] * branch[0] + branch[1] * branch[1]).sqrt();
        let overlap = a.radius + b.radius - distance;
        (overlap > 0.0).then(|| Contact {
            i: Ok(i),
            j: owner as usize,
            shift,
            normal: [branch[0] / distance, branch[1] / distance],
            branch,
            overlap,
            stiffness: pair_stiffness(self.material.young_modulus, a.radius, b.radius),
            tangential_force,
        })
    }

    fn wall_contact(&self, side: Side, j: usize, tangential_force: f64) -> Option<Contact> {
        let disc = &self.discs[j];
        let distance = self.walls.distance(side, disc.x, disc.y);
        let normal = side.normal();
        let overlap = disc.radius - distance;
        let (young_modulus, factor) = (self.material.young_modulus, self.material.wall_stiffness_factor);
        (overlap > 0.0).then(|| Contact {
            i: Err(side),
            j,
            shift: [0, 0],
            normal,
            branch: [distance * normal[0], distance * normal[1]],
            overlap,
            stiffness: wall_stiffness(young_modulus, factor, disc.radius),
            tangential_force,
        })
    }
}
