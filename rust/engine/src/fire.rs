//! The descent of the minimiser FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006): how long the next step is and
//! how far velocities are turned towards the forces. Each engine moves its own grains.

/// Parameters of FIRE with the values of the paper: steps of positive power before the time step grows, factors by
/// which it grows and shrinks, initial value and decay of the turning coefficient.
const PATIENCE: u32 = 5;
const GROW: f64 = 1.1;
const CUT: f64 = 0.5;
const TURN: f64 = 0.1;
const TURN_DECAY: f64 = 0.99;
/// First and largest time step over the stability bound.
const FIRST_STEP: f64 = 0.2;
pub const LARGEST_STEP: f64 = 0.7;
/// Steps between two checks of the state.
pub const LOOK_EVERY: u64 = 20;

/// How far a relaxation has come.
#[derive(Clone, Copy, Debug)]
pub struct Descent {
    step: f64,
    largest_step: f64,
    turn: f64,
    downhill: u32,
}

/// Power of the forces, and squares of speed and force in mass-weighted coordinates, of all grains.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sums {
    pub power: f64,
    pub speed2: f64,
    pub force2: f64,
}

/// What becomes of the velocities v of a grain of mass m under the force f: keep · v + pull · f / m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    pub keep: f64,
    pub pull: f64,
}

impl Default for Descent {
    fn default() -> Self {
        Self { step: 0.0, largest_step: 0.0, turn: TURN, downhill: 0 }
    }
}

impl Descent {
    /// Takes [`LARGEST_STEP`] times the present stability bound, `largest` \[s\], as the largest step.
    pub fn limit(&mut self, largest: f64) {
        self.largest_step = largest;
        if self.step == 0.0 {
            self.step = FIRST_STEP / LARGEST_STEP * largest;
        }
    }

    /// The next step \[s\].
    pub fn step(&self) -> f64 {
        self.step.min(self.largest_step)
    }

    /// How to turn the velocities after a step of length `dt` \[s\]; none when all grains are to be stopped because they
    /// move against the forces.
    ///
    /// The step took the forces before it changed the velocities by them. Half of that change is subtracted here, so
    /// that the power is that of forces and velocities at the same time.
    pub fn turn(&mut self, sums: Sums, dt: f64) -> Option<Turn> {
        if sums.power <= 0.5 * dt * sums.force2 {
            self.step *= CUT;
            self.turn = TURN;
            self.downhill = 0;
            return None;
        }
        let turn = Turn { keep: 1.0 - self.turn, pull: self.turn * (sums.speed2 / sums.force2).sqrt() };
        self.downhill += 1;
        if self.downhill > PATIENCE {
            self.step = (GROW * self.step).min(self.largest_step);
            self.turn *= TURN_DECAY;
        }
        Some(turn)
    }
}
