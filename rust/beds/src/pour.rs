//! Pouring: grains rain into a box or a cylinder until they are at rest.
//!
//! All grains begin at random places without overlap in a column above the floor, and come down at one speed, which a drag
//! keeps ([`crate::settle`]).

use crate::BedError;
use crate::random::Random;
use crate::settle::{Rest, descent, settle};
use crate::sizes::{Moments, Sizes, radii};
use msdd_spheres::time_step::SAFETY;
use msdd_spheres::{Boundary, Cell, Material, Simulation, Sphere, Wall};
use std::f64::consts::PI;

/// Solid fraction of the grains in the column above the floor. Not settled by any reference; chosen because random places are found quickly up
/// to 0.25, and the bed hardly depends on it.
const LOOSE: f64 = 0.2;
/// Most area of the floor for each grain, over d²: a tenth of a layer. More would be places without grains only.
pub(crate) const WIDEST: f64 = 10.0;
/// Attempts per grain before the column is made higher.
const ATTEMPTS: u32 = 2000;

/// What the grains are poured into; the floor is at z = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Container {
    /// From the origin to these lengths along x and y \[m\].
    Box { base: [f64; 2] },
    /// The same without sides: the bed repeats itself along x and y \[m\].
    Endless { base: [f64; 2] },
    /// Upright, with the z axis as its axis \[m\].
    Cylinder { radius: f64 },
}

impl Container {
    /// \[m²\]
    pub fn area(&self) -> f64 {
        match *self {
            Self::Box { base: [x, y] } | Self::Endless { base: [x, y] } => x * y,
            Self::Cylinder { radius } => PI * radius * radius,
        }
    }

    /// Height of loose grains of this volume \[m³\] and largest diameter \[m\] in it, as they begin \[m\].
    fn loose_height(&self, volume: f64, largest: f64) -> f64 {
        largest + volume / LOOSE / self.area()
    }

    /// Its longest side across \[m\].
    pub(crate) fn width(&self) -> f64 {
        self.extent().iter().fold(0.0, |width: f64, [low, high]| width.max(high - low))
    }

    /// Corners of the block that holds it, along x and y \[m\].
    fn extent(&self) -> [[f64; 2]; 2] {
        match *self {
            Self::Box { base: [x, y] } | Self::Endless { base: [x, y] } => [[0.0, x], [0.0, y]],
            Self::Cylinder { radius } => [[-radius, radius]; 2],
        }
    }

    /// Its walls, by name, with a lid at `height` \[m\].
    pub fn walls(&self, height: f64) -> Vec<(&'static str, Wall)> {
        let at = |point, normal| Wall::at_rest(point, normal);
        let mut walls = vec![("floor", at([0.0; 3], [0.0, 0.0, 1.0]))];
        match *self {
            Self::Box { base: [x, y] } => walls.extend([
                ("x_low", at([0.0; 3], [1.0, 0.0, 0.0])),
                ("x_high", at([x, 0.0, 0.0], [-1.0, 0.0, 0.0])),
                ("y_low", at([0.0; 3], [0.0, 1.0, 0.0])),
                ("y_high", at([0.0, y, 0.0], [0.0, -1.0, 0.0])),
            ]),
            Self::Endless { .. } => {}
            Self::Cylinder { radius } => {
                walls.push(("side", Wall::cylinder([0.0; 3], [0.0, 0.0, 1.0], radius)));
            }
        }
        walls.push(("lid", at([0.0, 0.0, height], [0.0, 0.0, -1.0])));
        walls
    }

    /// The same as an assembly has them. Without sides, the upper face of the cell is as far above the lid as that above the floor.
    pub(crate) fn boundary(&self, height: f64) -> Boundary {
        let walls = self.walls(height).into_iter().map(|(_, wall)| wall).collect();
        match *self {
            Self::Endless { base: [x, y] } => Boundary::Between(Cell::block([x, y, 2.0 * height]), walls),
            _ => Boundary::Walls(walls),
        }
    }

    /// Whether a sphere fits next to the walls at a place.
    fn holds(&self, [x, y]: [f64; 2], sphere: f64) -> bool {
        match *self {
            Self::Box { .. } | Self::Endless { .. } => true,
            Self::Cylinder { radius } => libm::hypot(x, y) <= radius - sphere,
        }
    }
}

/// What to pour.
#[derive(Clone, Debug, PartialEq)]
pub struct Pouring {
    pub spheres: usize,
    pub seed: u64,
    /// d \[m\], the Sauter mean.
    pub diameter: f64,
    /// Of the diameters; none: equal ones.
    pub sizes: Option<Sizes>,
    pub material: Material,
    pub container: Container,
    /// g \[m/s²\], along −z.
    pub gravity: f64,
    /// Simulated time after which a bed that is not at rest is left as it is \[s\].
    pub longest: f64,
    pub threads: usize,
}

impl Pouring {
    fn moments(&self) -> Moments {
        Moments::new(self.sizes.as_ref(), self.spheres)
    }

    /// Of the column of grains, as they begin \[m\].
    pub(crate) fn height(&self) -> f64 {
        let (d, moments) = (self.diameter, self.moments());
        let volume = self.spheres as f64 * PI / 6.0 * d * d * d * moments.volume;
        self.container.loose_height(volume, d * moments.largest)
    }

    /// The time step of the spheres as they come down \[s\]; NaN for a material that there is not.
    pub fn step(&self) -> f64 {
        let radius = 0.5 * self.diameter * self.moments().smallest;
        let mut sphere = Sphere::at_rest([0.0; 3], radius, self.material.density);
        sphere.velocity = [0.0, 0.0, -descent(self.diameter, self.gravity).0];
        let floor = Wall::at_rest([0.0, 0.0, -self.diameter], [0.0, 0.0, 1.0]);
        let one = Simulation::new(self.material.clone(), vec![sphere], Boundary::Walls(vec![floor]));
        one.map_or(f64::NAN, |one| SAFETY * one.stable_step())
    }

    /// Time \[s\] in which the spheres come down, about.
    pub(crate) fn fall(&self) -> f64 {
        self.height() / descent(self.diameter, self.gravity).0
    }

    fn check(&self) -> Result<(), BedError> {
        self.material.check()?;
        let positive = |v: f64| v.is_finite() && v > 0.0;
        let narrow = self.container.extent().map(|[low, high]| high - low);
        let narrow = narrow[0].min(narrow[1]);
        self.sizes.as_ref().map_or(Ok(()), Sizes::check)?;
        let least = 2.0 * self.diameter * self.moments().largest;
        let floor = self.container.area() / (self.spheres as f64 * self.diameter * self.diameter);
        let parameters = [
            ("spheres", self.spheres as f64, (1..=10_000_000).contains(&self.spheres), "1 to 10000000"),
            ("diameter", self.diameter, positive(self.diameter), "above 0 m"),
            ("gravity", self.gravity, positive(self.gravity), "above 0 m/s2"),
            ("longest", self.longest, positive(self.longest), "above 0 s"),
            ("size", narrow, narrow >= least, "two diameters of the largest grain at least"),
            ("floor", floor, floor <= WIDEST, "10 squares of the diameter for each grain, at most"),
        ];
        match parameters.into_iter().find(|parameter| !parameter.2) {
            None => Ok(()),
            Some((key, value, _, allowed)) => Err(BedError::Pouring { key, value, allowed }),
        }
    }

    /// The grains in the column above the floor, and the height of their column \[m\]. They are in the order of their places, first
    /// along the longer side of the base, along which they move least.
    fn rain(&self) -> Result<(Vec<Sphere>, f64), BedError> {
        let d = self.diameter * self.moments().largest;
        let [[x0, x1], [y0, y1]] = self.container.extent();
        let height = self.height();
        let count = [(x1 - x0) / d, (y1 - y0) / d, height / d].map(|n| n as usize + 1);
        let mut cells: Vec<Vec<([f64; 3], f64)>> = vec![Vec::new(); count.iter().product()];
        let place = |[x, y, z]: [f64; 3]| [(x - x0) / d, (y - y0) / d, z / d].map(|n| n as usize);
        let number = |[x, y, z]: [usize; 3]| (y * count[2] + z) * count[0] + x;
        let mut random = Random::new(self.seed);
        for (placed, &r) in radii(self.sizes.as_ref(), self.spheres, self.diameter).iter().enumerate() {
            let free = (0..ATTEMPTS).find_map(|_| {
                let centre = [
                    random.uniform(x0 + r, x1 - r),
                    random.uniform(y0 + r, y1 - r),
                    random.uniform(r, height),
                ];
                if !self.container.holds([centre[0], centre[1]], r) {
                    return None;
                }
                let home = place(centre);
                let clash = (0..27).any(|code| {
                    let shift = [code % 3, code / 3 % 3, code / 9];
                    let cell: [usize; 3] = std::array::from_fn(|k| (home[k] + shift[k]).wrapping_sub(1));
                    (0..3).all(|k| cell[k] < count[k])
                        && cells[number(cell)].iter().any(|(other, radius)| {
                            let square: f64 =
                                (0..3).map(|k| (centre[k] - other[k]) * (centre[k] - other[k])).sum();
                            square < (r + radius) * (r + radius)
                        })
                });
                (!clash).then_some((centre, number(home)))
            });
            let (centre, home) = free.ok_or(BedError::NoRoom { placed, wanted: self.spheres })?;
            cells[home].push((centre, r));
        }
        let density = self.material.density;
        let velocity = [0.0, 0.0, -descent(self.diameter, self.gravity).0];
        let sphere = |(centre, r)| {
            let mut sphere = Sphere::at_rest(centre, r, density);
            sphere.velocity = velocity;
            sphere
        };
        Ok((cells.into_iter().flatten().map(sphere).collect(), height + 0.5 * d))
    }
}

/// Pours. The lid is left above the column that the grains came from. `watch` receives the agitation
/// ([`crate::settle::agitation`]).
///
/// # Errors
/// A parameter outside its range; a run that fails; threads that the system cannot start.
pub fn pour(pouring: &Pouring, watch: impl FnMut(f64)) -> Result<(Simulation, Rest), BedError> {
    pouring.check()?;
    let (spheres, height) = pouring.rain()?;
    let boundary = pouring.container.boundary(height);
    let mut simulation = Simulation::new(pouring.material.clone(), spheres, boundary)?;
    simulation.gravity = [0.0, 0.0, -pouring.gravity];
    simulation.set_threads(pouring.threads).map_err(|error| BedError::Threads(error.to_string()))?;
    let rest = settle(&mut simulation, pouring.longest, watch)?;
    Ok((simulation, rest))
}
