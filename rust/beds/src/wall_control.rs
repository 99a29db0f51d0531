//! Walls that move while a bed is heated: along a given path, under a given pressure, or with the compliance of a shell.
//!
//! A compliant wall moves as a body of the mass of some layers of grains, pushed by the grains on one side and by what holds it
//! on the other, and stopped by the same drag as the grains; only where it comes to rest counts. A thin shell (thickness t, radius R,
//! Young's modulus E_w) holds with the pressure p₀ + E_w t/R² (u − u_T), where u is what its radius has grown by, u_T = α_w (T − T₀) R is its
//! own expansion, and p₀ the pressure of the grains at the start (Timoshenko & Woinowsky-Krieger, Theory of Plates and Shells, 1959,
//! section 15.1: the hoop alone). Spheres that rub on it also feel its expansion along the axis, from the floor on.

use msdd_spheres::time_step::SAFETY;
use msdd_spheres::{Failure, Simulation, StepChoice, Surface};
use std::f64::consts::PI;

/// Steps between two looks at the time step, and between two changes of the velocities of walls.
pub(crate) const BLOCK: u64 = 50;
const FEW: u64 = 5;
/// Mass of a compliant wall, in layers of grains.
const LAYERS: f64 = 8.0;

/// What holds a compliant wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WallControl {
    /// It is where it is said to be: moved towards the grains by this since the start \[m\].
    Place { moved: f64 },
    /// It presses with this \[Pa\].
    Pressure { pressure: f64 },
    /// A shell.
    Shell {
        /// E_w t/R² \[Pa/m\].
        stiffness: f64,
        /// p₀ \[Pa\].
        at_start: f64,
        /// u_T \[m\].
        grown: f64,
    },
}

/// Drag \[1/s\] over the diameter over the depth of a bed and the time step: near critical for its slowest wave, because a wave of a
/// jammed bed crosses about a thirtieth of a grain in a step.
const DRAG: f64 = 0.05;

/// The drag on grains and walls \[1/s\] that stops a bed of a depth \[m\] soonest.
pub(crate) fn drag(simulation: &Simulation, depth: f64) -> f64 {
    DRAG * 2.0 * simulation.mean_radius() / depth / simulation.time_step
}

/// A wall that moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Moving {
    /// By its number.
    pub wall: usize,
    pub hold: WallControl,
    /// Moved towards the grains since the start \[m\].
    pub moved: f64,
    /// Strain along the axis of a shell since the start that is aimed at \[-\].
    pub stretch: f64,
    /// That strain now.
    stretched: f64,
    /// Towards the grains \[m/s\], and rate of that strain \[1/s\].
    speed: f64,
    stretching: f64,
}

/// Area of a wall against a bed \[m²\]; `across` \[m²\] is that of a flat one, `height` \[m\] that of a cylinder.
pub fn wall_area(simulation: &Simulation, wall: usize, across: f64, height: f64) -> f64 {
    match simulation.boundary.walls()[wall].surface {
        Surface::Flat { .. } => across,
        Surface::Cylinder { radius, .. } => 2.0 * PI * radius * height,
    }
}

impl Moving {
    pub fn new(wall: usize, hold: WallControl) -> Self {
        Self { wall, hold, moved: 0.0, stretch: 0.0, stretched: 0.0, speed: 0.0, stretching: 0.0 }
    }

    /// What holds it from outside \[Pa\]; `None` at a given place.
    fn outside(&self) -> Option<f64> {
        match self.hold {
            WallControl::Place { .. } => None,
            WallControl::Pressure { pressure } => Some(pressure),
            WallControl::Shell { stiffness, at_start, grown } => {
                Some(at_start - stiffness * (self.moved + grown))
            }
        }
    }

    /// How far the pressure of the grains is from what holds it \[Pa\]; 0 at a given place.
    pub fn lag(&self, pressure: f64) -> f64 {
        self.outside().map_or(0.0, |outside| (pressure - outside).abs())
    }

    /// Chooses its velocity for the next steps, which take `dt` \[s\]; `pressure` is that of the grains \[Pa\]. It comes to its
    /// place, and a shell to its strain along the axis, after `left` \[s\].
    pub fn steer(&mut self, simulation: &mut Simulation, pressure: f64, dt: f64, left: f64) {
        if let WallControl::Place { moved } = self.hold {
            self.speed = (moved - self.moved) / left;
        }
        if let Some(outside) = self.outside() {
            let stiffness =
                if let WallControl::Shell { stiffness, .. } = self.hold { stiffness } else { 0.0 };
            let sphere = &simulation.spheres[0];
            let mass = LAYERS * sphere.mass / (4.0 * sphere.radius * sphere.radius);
            // The spring of a shell is taken implicitly.
            let resisting = 1.0 + dt * simulation.drag + dt * dt * stiffness / mass;
            self.speed = (self.speed + dt * (outside - pressure) / mass) / resisting;
        }
        self.moved += self.speed * dt;
        self.stretching = (self.stretch - self.stretched) / left;
        self.stretched += self.stretching * dt;
        self.set(simulation);
    }

    fn set(&self, simulation: &mut Simulation) {
        let wall = &mut simulation.boundary.walls_mut()[self.wall];
        match &mut wall.surface {
            Surface::Flat { normal } => wall.velocity = normal.map(|n| self.speed * n),
            Surface::Cylinder { growth, stretch, .. } => (*growth, *stretch) = (-self.speed, self.stretching),
        }
    }

    /// Stops it.
    pub fn stop(&mut self, simulation: &mut Simulation) {
        (self.speed, self.stretching) = (0.0, 0.0);
        self.set(simulation);
    }
}

/// Takes [`BLOCK`] steps, in which the walls are steered by `steer` every few: it receives the time that these take, and what is left of the
/// block \[s\].
///
/// # Errors
/// Those of [`Simulation::run`].
pub(crate) fn steered(
    simulation: &mut Simulation,
    mut steer: impl FnMut(&mut Simulation, f64, f64),
) -> Result<(), Failure> {
    simulation.choose_time_step(StepChoice::Adaptive { safety: SAFETY })?;
    let dt = FEW as f64 * simulation.time_step;
    for left in (1..=BLOCK / FEW).rev() {
        steer(simulation, dt, left as f64 * dt);
        simulation.take_steps(FEW);
    }
    simulation.check()
}

#[cfg(test)]
mod tests {
    use super::*;
    use msdd_spheres::law::effective_modulus;
    use msdd_spheres::{Boundary, Material, Sphere, Stiffness, Wall};

    const YOUNG: f64 = 1e9;
    const RADIUS: f64 = 3e-3;

    fn material() -> Material {
        let stiffness = Stiffness::HertzMindlin { young_modulus: YOUNG, poisson_ratio: 0.3 };
        Material { density: 2500.0, stiffness, friction: 0.0, wall_friction: 0.0, restitution: 0.3 }
    }

    /// 4/3 E* √R* δ^(3/2).
    fn hertz(radius: f64, overlap: f64) -> f64 {
        4.0 / 3.0 * effective_modulus(YOUNG, 0.3) * radius.sqrt() * overlap.powf(1.5)
    }

    fn settle(simulation: &mut Simulation, wall: &mut Moving, area: impl Fn(&Simulation) -> f64) {
        simulation.drag = 3000.0;
        for _ in 0..1000 {
            steered(simulation, |simulation, dt, left| {
                let pressure = simulation.wall_load(wall.wall) / area(simulation);
                wall.steer(simulation, pressure, dt, left);
            })
            .unwrap();
        }
        wall.stop(simulation);
    }

    /// Seven spheres in a shell, one in the middle of six, grow. In the middle of each pair, and on the shell, Hertz's law holds; a sphere
    /// of the ring is pushed outwards by the one in the middle and, each by half, by its two neighbours; the shell yields by R²/(E_w t) p.
    #[test]
    fn a_shell_yields_to_spheres_that_grow_as_it_should() {
        let (radius, height, stiffness, growth) = (3.0 * RADIUS, 0.02, 3e9, 1e-2);
        let mut places = vec![[0.0; 3]];
        places.extend((0..6).map(|k| {
            let angle = PI / 3.0 * f64::from(k);
            [2.0 * RADIUS * angle.cos(), 2.0 * RADIUS * angle.sin(), 0.0]
        }));
        let spheres = places.into_iter().map(|place| Sphere::at_rest(place, RADIUS, 2500.0)).collect();
        let side = Wall::cylinder([0.0; 3], [0.0, 0.0, 1.0], radius);
        let mut simulation = Simulation::new(material(), spheres, Boundary::Walls(vec![side])).unwrap();
        let grown = RADIUS * (1.0 + growth);
        simulation.resize(&[grown; 7]);
        let mut shell = Moving::new(0, WallControl::Shell { stiffness, at_start: 0.0, grown: 0.0 });
        settle(&mut simulation, &mut shell, |simulation| wall_area(simulation, 0, 0.0, height));
        // What is missing to the place of the shell, by the overlap of the spheres.
        let state = |overlap: f64| {
            let force = 2.0 * hertz(0.5 * grown, overlap);
            let at_wall = (force / hertz(grown, 1.0)).powf(2.0 / 3.0);
            let place = 3.0 * grown - overlap - at_wall;
            (force, place, place - radius - 6.0 * force / (2.0 * PI * place * height) / stiffness)
        };
        let (mut low, mut high) = (0.0, 3.0 * growth * RADIUS);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if state(middle).2 > 0.0 { low = middle } else { high = middle }
        }
        let (force, place, _) = state(low);
        let found = simulation.wall_load(0);
        assert!((found / (6.0 * force) - 1.0).abs() < 1e-4, "{found} {}", 6.0 * force);
        let moved = radius - shell.moved;
        assert!(((moved - radius) / (place - radius) - 1.0).abs() < 1e-4, "{moved} {place}");
        // It moves by a good part of what a rigid one would not.
        assert!((place - radius) / (3.0 * growth * RADIUS) > 0.1, "{place}");
    }

    /// Two spheres across a cylinder, which rubs on them: they roll, with 2/7 of the speed of the wall next to them.
    #[test]
    fn a_shell_takes_spheres_along_that_rub_on_it() {
        let (place, strain, overlap) = (0.01, 1e-5, 1e-6);
        let rubbing = Material { wall_friction: 0.3, ..material() };
        let spheres = [RADIUS, -RADIUS].map(|x| Sphere::at_rest([x, 0.0, place], RADIUS, 2500.0)).into();
        let side = Wall::cylinder([0.0; 3], [0.0, 0.0, 1.0], 2.0 * RADIUS - overlap);
        let mut simulation = Simulation::new(rubbing, spheres, Boundary::Walls(vec![side])).unwrap();
        let mut shell = Moving::new(0, WallControl::Place { moved: 0.0 });
        for block in 0..100 {
            shell.stretch = strain * f64::min(f64::from(block) / 80.0, 1.0);
            steered(&mut simulation, |simulation, dt, left| shell.steer(simulation, 0.0, dt, left)).unwrap();
        }
        let share = (simulation.spheres[0].position[2] / place - 1.0) / strain;
        assert!((share / (2.0 / 7.0) - 1.0).abs() < 0.01, "{share}");
    }

    /// A sphere between a floor and a lid with a pressure, and with a given place.
    #[test]
    fn a_lid_presses_as_it_is_told() {
        let (area, start) = (4e-5, 1e-5);
        let sphere = Sphere::at_rest([0.0, 0.0, RADIUS - 0.5 * start], RADIUS, 2500.0);
        let walls = vec![
            Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]),
            Wall::at_rest([0.0, 0.0, 2.0 * RADIUS - start], [0.0, 0.0, -1.0]),
        ];
        let mut simulation = Simulation::new(material(), vec![sphere], Boundary::Walls(walls)).unwrap();
        let mut lid = Moving::new(1, WallControl::Place { moved: 1e-5 });
        settle(&mut simulation, &mut lid, |_| area);
        let place = 2.0 * RADIUS - simulation.boundary.walls()[1].point[2];
        assert!((place - start - 1e-5).abs() < 1e-10, "{place}");
        let force = simulation.wall_load(1);
        assert!((force / hertz(RADIUS, 1e-5) - 1.0).abs() < 1e-6, "{force}");
        lid.hold = WallControl::Pressure { pressure: 5e4 };
        settle(&mut simulation, &mut lid, |_| area);
        let overlap = 0.5 * (start + lid.moved);
        assert!((hertz(RADIUS, overlap) / (5e4 * area) - 1.0).abs() < 1e-4, "{overlap}");
    }
}
