//! Heat in time on the network of a bed at rest: each sphere has one temperature.
//!
//! m_i dh(T_i)/dt = Σ_j G_ij (T_j − T_i) + Q_i, with the heat Q_i that a sphere releases, the enthalpy h \[J/kg\] (the integral of the heat capacity) and conductances at the
//! present temperatures. A step is one of the implicit Runge-Kutta method of two stages and second order that damps what
//! it does not resolve (Alexander, SIAM J. Numer. Anal. 14, 1006, 1977): with γ = 1 − 1/√2,
//!
//! h(Y₁) = h₀ + γ Δt F(Y₁),   h(T) = h₀ + (1 − γ) Δt F(Y₁) + γ Δt F(T).
//!
//! Both stages are solved by Newton's method until no sphere misses more than [`MISSED`], or than round-off of the heat that
//! passes through it in the step; so what the spheres store is what
//! the plates gave, up to round-off. The difference of T to the step with F(Y₁) alone, γ Δt (F(T) − F(Y₁))/(m c), is the
//! estimate of the error by which steps are chosen. It is that of a method of first order, so the true error is smaller.

use crate::network::{Conductances, Network, volume};
use crate::solve::{add_flows, conjugate_gradients};

/// γ.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Heat over m c \[K\] that a sphere may miss at the end of a stage.
pub const MISSED: f64 = 1e-11;
/// Round-off of a stage, over that of T and of the heat that passes.
const ROUND_OFF: f64 = 8.0 * f64::EPSILON;
/// A step that does not converge is tried again, this much shorter, down to this share of the end.
const SHORTER: f64 = 0.25;
const MIN_STEP: f64 = 1e-9;
/// Newton's iterations: the conductances change little in a step, and are not differentiated, so it takes three or four.
const MAX_ITERATIONS: usize = 30;
/// How much of the residual an iteration leaves.
const LEFT: f64 = 1e-4;

/// Temperatures of a bed in time.
#[derive(Clone, Debug)]
pub struct Transient<'a> {
    network: &'a Network,
    /// T \[K\] of the spheres and of the plates.
    pub temperatures: Vec<f64>,
    pub plates: Vec<f64>,
    /// t \[s\]
    pub time: f64,
    /// Heat that each plate has given to the spheres that are not held by it \[J\].
    pub given: Vec<f64>,
    /// Steps taken.
    pub steps: u64,
    stored: f64,
}

/// Why a step failed: no convergence, because a number is not finite or the step is far too long.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "t = {time} s: heat does not converge in a step of {step} s; allowed: shorter steps, finite properties"
)]
pub struct NotConverged {
    pub time: f64,
    pub step: f64,
}

impl<'a> Transient<'a> {
    /// A bed of one temperature \[K\] whose plates have theirs from now on.
    pub fn new(network: &'a Network, initial: f64, plates: Vec<f64>) -> Self {
        Self::from(network, &vec![initial; network.held.len()], plates)
    }

    /// A bed whose spheres have `temperatures` \[K\], and whose plates have theirs from now on.
    pub fn from(network: &'a Network, temperatures: &[f64], plates: Vec<f64>) -> Self {
        let temperatures = (network.held.iter().zip(temperatures))
            .map(|(held, &temperature)| held.map_or(temperature, |k| plates[k]))
            .collect();
        let given = vec![0.0; plates.len()];
        let mut transient = Self { network, temperatures, plates, time: 0.0, given, steps: 0, stored: 0.0 };
        transient.stored = transient.enthalpy();
        transient
    }

    /// Of the spheres that are not held \[J\].
    fn enthalpy(&self) -> f64 {
        let capacity = &self.network.materials.heat_capacity;
        let spheres = self.network.mass.iter().zip(&self.temperatures).zip(&self.network.held);
        spheres.filter(|(_, held)| held.is_none()).map(|((m, &t), _)| m * capacity.integral(t)).sum()
    }

    /// What the spheres have stored since the start, less what they released and the plates have given \[J\]: 0 up to round-off.
    pub fn residual(&self) -> f64 {
        self.enthalpy() - self.stored - self.given.iter().sum::<f64>() - self.network.released() * self.time
    }

    /// What the spheres have stored since the start \[J\].
    pub fn stored(&self) -> f64 {
        self.enthalpy() - self.stored
    }

    /// One step of `dt` \[s\]. Returns the estimate of its largest error of T \[K\].
    ///
    /// # Errors
    /// [`NotConverged`]; nothing is changed then.
    pub fn step(&mut self, dt: f64) -> Result<f64, NotConverged> {
        let mut next = self.clone();
        let error = next.advance(dt).ok_or(NotConverged { time: self.time, step: dt })?;
        *self = next;
        Ok(error)
    }

    fn advance(&mut self, dt: f64) -> Option<f64> {
        let network = self.network;
        let capacity = &network.materials.heat_capacity;
        let before: Vec<f64> =
            network.mass.iter().zip(&self.temperatures).map(|(m, &t)| m * capacity.integral(t)).collect();
        let (first, given_first) = self.stage(&before, GAMMA * dt)?;
        let halfway: Vec<f64> = before.iter().zip(&first).map(|(h, f)| h + (1.0 - GAMMA) * dt * f).collect();
        let (second, given_second) = self.stage(&halfway, GAMMA * dt)?;
        for (k, given) in self.given.iter_mut().enumerate() {
            *given += dt * ((1.0 - GAMMA) * given_first[k] + GAMMA * given_second[k]);
        }
        let mut error = 0.0f64;
        for (k, (a, b)) in first.iter().zip(&second).enumerate() {
            let heat = network.mass[k] * capacity.at(self.temperatures[k]);
            error = error.max((GAMMA * dt * (b - a) / heat).abs());
        }
        self.time += dt;
        self.steps += 1;
        error.is_finite().then_some(error)
    }

    /// Solves m h(T) = `start` + `dt` F(T) for the temperatures. Returns F \[W\] of each sphere and of each plate.
    fn stage(&mut self, start: &[f64], dt: f64) -> Option<(Vec<f64>, Vec<f64>)> {
        let network = self.network;
        let capacity = &network.materials.heat_capacity;
        for _ in 0..MAX_ITERATIONS {
            let conductances = network.conductances(&self.temperatures, &self.plates);
            let (flow, given) = self.flow(&conductances);
            let mut diagonal = vec![0.0; start.len()];
            let mut residual = vec![0.0; start.len()];
            let mut passing = vec![0.0; start.len()];
            for &(i, j, g) in &conductances.links {
                passing[i] += g;
                passing[j] += g;
            }
            conductances.plates.iter().for_each(|&(i, _, g)| passing[i] += g);
            let (mut missed, mut goal) = (0.0f64, MISSED);
            for k in 0..start.len() {
                let (m, t) = (network.mass[k], self.temperatures[k]);
                diagonal[k] = m * capacity.at(t);
                if network.held[k].is_none() {
                    residual[k] = start[k] + dt * flow[k] - m * capacity.integral(t);
                    missed = missed.max((residual[k] / diagonal[k]).abs());
                    goal = goal.max(ROUND_OFF * t.abs() * (1.0 + dt * passing[k] / diagonal[k]));
                }
            }
            if !missed.is_finite() {
                return None;
            }
            if missed <= goal {
                return Some((flow, given));
            }
            let change = self.newton(&conductances, diagonal, &mut residual, dt, goal)?;
            for (t, d) in self.temperatures.iter_mut().zip(change) {
                *t += d;
            }
        }
        None
    }

    fn newton(
        &self,
        conductances: &Conductances,
        heat: Vec<f64>,
        residual: &mut [f64],
        dt: f64,
        enough: f64,
    ) -> Option<Vec<f64>> {
        let held = &self.network.held;
        let free = |k: usize| held[k].is_none();
        let mut diagonal = heat.clone();
        for &(i, j, g) in &conductances.links {
            diagonal[i] += dt * g;
            diagonal[j] += dt * g;
        }
        for &(i, _, g) in &conductances.plates {
            diagonal[i] += dt * g;
        }
        let apply = |x: &[f64], y: &mut [f64]| {
            for k in 0..x.len() {
                y[k] += heat[k] * x[k];
            }
            add_flows(&conductances.links, dt, free, x, y);
            for &(i, _, g) in conductances.plates.iter().filter(|&&(i, _, _)| free(i)) {
                y[i] += dt * g * x[i];
            }
        };
        let worst = |residual: &[f64]| {
            residual.iter().zip(&heat).fold(0.0f64, |worst, (r, h)| worst.max((r / h).abs()))
        };
        let goal = (LEFT * worst(residual)).max(0.1 * enough);
        conjugate_gradients(apply, &diagonal, residual, |left| worst(left) <= goal)
    }

    /// Heat into each sphere and out of each plate \[W\]. What flows into a sphere that is held comes from its plate.
    fn flow(&self, conductances: &Conductances) -> (Vec<f64>, Vec<f64>) {
        let (t, held) = (&self.temperatures, &self.network.held);
        let source = |(radius, held): (&f64, &Option<usize>)| match held {
            None => self.network.source * volume(*radius),
            Some(_) => 0.0,
        };
        let mut flow: Vec<f64> = self.network.radii.iter().zip(held).map(source).collect();
        let mut given = vec![0.0; self.plates.len()];
        for &(i, j, g) in &conductances.links {
            let heat = g * (t[j] - t[i]);
            for (k, heat) in [(i, heat), (j, -heat)] {
                match held[k] {
                    None => flow[k] += heat,
                    Some(plate) => given[plate] -= heat,
                }
            }
        }
        for &(i, plate, g) in &conductances.plates {
            let heat = g * (self.plates[plate] - t[i]);
            if held[i].is_none() {
                flow[i] += heat;
                given[plate] += heat;
            }
        }
        (flow, given)
    }

    /// Goes on until `end` \[s\] in steps whose estimated error is at most `tolerance` \[K\], of `step` \[s\] at first; the next
    /// one is kept in `step`. A step that does not converge is tried again, shorter.
    ///
    /// # Errors
    /// [`NotConverged`], of a step that cannot be made shorter.
    pub fn run_to(&mut self, end: f64, tolerance: f64, step: &mut f64) -> Result<(), NotConverged> {
        while end - self.time > MIN_STEP * end {
            let left = end - self.time;
            // No step that leaves a splinter.
            let dt = if *step >= left { left } else { step.min(0.5 * left) };
            let before = self.clone();
            let error = match self.step(dt) {
                Ok(error) => error,
                Err(_) if SHORTER * dt > MIN_STEP * end => {
                    *step = SHORTER * dt;
                    continue;
                }
                Err(error) => return Err(error),
            };
            let factor = 0.9 * (tolerance / error.max(1e-300)).sqrt();
            if error > tolerance && dt > MIN_STEP * end {
                *self = before;
                *step = dt * factor.clamp(0.1, 0.9);
                continue;
            }
            if dt >= *step || factor < 1.0 {
                *step = dt * factor.clamp(0.2, 3.0);
            }
        }
        self.time = end;
        Ok(())
    }
}
