//! The state of a packing of which solid fraction, stress, and perhaps more are known.

use super::law::{Law, MAX_COMPRESSION, MAX_OF_FRICTION, MAX_STRENGTH, within};
use super::state::{ELEMENTS, FABRIC, MIN_COMPRESSION, POURED, PackingData, State};
use super::tensor::{Tensor, contraction, deviator, mean, square};

/// Ratio of the compressions at which the pressure is compared first; then the most iterations for the root between two of them,
/// about seven of which are used, and the error of the pressure at which they end.
const START_RATIO: f64 = 0.7;
const ITERATIONS: usize = 60;
const NEAR_PRESSURE: f64 = 1e-14;
/// Largest deviator over A for which a stress ratio is looked for: no packing carries as much.
const MAX_DEVIATOR: f64 = 3.0;
/// Shares of it that are looked at; iterations for each, the error at which they end, and the least determinant of their
/// equations.
const SHARES: u32 = 20;
const NEWTONS: u32 = 20;
const NEAR: f64 = 1e-14;
const MIN_DETERMINANT: f64 = 0.05;

/// What determines the part of the deviator that the fabric carries.
enum Borne {
    /// The deviator of the fabric, which is known.
    Fabric(Tensor),
    /// It is not known: the fabric carries its usual part.
    Usual,
}

impl Law {
    /// The state with a solid fraction, a stress over E*, and what else is known. The fabric carries its part; the other elements
    /// share the rest of the deviator as after a proportional load: each carries its part until it slides. A packing that carries more
    /// than the strengths of friction has larger ones, by a common factor of at most 2; what friction cannot carry then, the fabric
    /// carries, whose strength is then at most four times as large. What is beyond that is lost.
    pub fn start(&self, solid: f64, stress: Tensor, known: &PackingData) -> State {
        let mobilised = known.mobilised.unwrap_or(POURED).clamp(0.0, 1.0);
        let mut state = self.start_of_stress(solid, stress, known.fabric.map(deviator), mobilised);
        state.coordination = known.coordination.unwrap_or_else(|| self.contacts.packed(&state));
        state
    }

    fn start_of_stress(&self, solid: f64, stress: Tensor, fabric: Option<Tensor>, mobilised: f64) -> State {
        let (pressure, load) = (mean(stress), deviator(stress));
        let fabric = fabric.map_or(Borne::Usual, Borne::Fabric);
        let at = |compression: f64| self.bearing(solid, compression, &load, &fabric, mobilised);
        if pressure <= 0.0 {
            return State { ratios: [[0.0; 6]; ELEMENTS], strength: 1.0, ..at(0.0) };
        }
        // The pressure grows with v, but where a law has much of it depend on φ_J, which falls as v grows: the largest root counts.
        let beyond = |compression: f64| mean(self.stress(&at(compression))) - pressure;
        let (mut high, mut excess) = (MAX_COMPRESSION, beyond(MAX_COMPRESSION));
        let (mut low, mut lack) = (high, excess);
        while low > MIN_COMPRESSION {
            (low, lack) = (START_RATIO * high, beyond(START_RATIO * high));
            if lack <= 0.0 {
                break;
            }
            if lack > excess {
                return at(high);
            }
            (high, excess) = (low, lack);
        }
        // The secant through both ends; an end that stays twice counts half (method of Illinois).
        let mut above = None;
        for _ in 0..ITERATIONS {
            let next = (low * excess - high * lack) / (excess - lack);
            if !(next > low && next < high) {
                return at(if next <= low { low } else { high });
            }
            let found = beyond(next);
            if found.abs() <= NEAR_PRESSURE * pressure {
                return at(next);
            }
            let kept = if above == Some(found > 0.0) { 0.5 } else { 1.0 };
            above = Some(found > 0.0);
            match found > 0.0 {
                true => (high, excess, lack) = (next, found, kept * lack),
                false => (low, lack, excess) = (next, found, kept * excess),
            }
        }
        at(high)
    }

    /// The stress ratio of which [`Law::deviator`] is this, or the largest share of this of which there is one.
    pub(super) fn ratio_of(&self, deviatoric: &Tensor) -> Tensor {
        let length = contraction(deviatoric, deviatoric).sqrt();
        if self.lode <= 0.0 || length <= 0.0 {
            return *deviatoric;
        }
        let unit = deviatoric.map(|part| part / length);
        let second = deviator(square(&unit));
        // A third of the trace of the cube, which is the determinant.
        let third = contraction(&unit, &second) / 3.0;
        let most = length.min(MAX_DEVIATOR);
        let mut shares = (0..SHARES).map(|k| f64::from(SHARES - k) / f64::from(SHARES) * most);
        let found = shares.find_map(|share| {
            coefficients(self.lode * share, third).map(|found| found.map(|coefficient| share * coefficient))
        });
        let [of_unit, of_second] = found.unwrap_or_default();
        std::array::from_fn(|k| of_unit * unit[k] + of_second * second[k])
    }

    fn bearing(&self, solid: f64, compression: f64, load: &Tensor, fabric: &Borne, mobilised: f64) -> State {
        let mut state = State {
            jamming: solid / (1.0 + compression),
            compression,
            ratios: [[0.0; 6]; ELEMENTS],
            strength: 1.0,
            mobilised,
            coordination: 0.0,
        };
        let (x, unmobilised) = (state.density(), state.unmobilised());
        let loaded = Self::loaded(compression);
        let over = 1.0 / self.pressure(compression, x, unmobilised).max(f64::MIN_POSITIVE);
        if compression <= MIN_COMPRESSION || !load.iter().all(|part| (part * over).is_finite()) {
            return state;
        }
        let ratio = self.ratio_of(&load.map(|part| part * over));
        let [per_anisotropy, usual] = self.fabric;
        let strengths: [f64; FABRIC] = std::array::from_fn(|k| self.strength(k, x, unmobilised, loaded));
        let strength = strengths.iter().sum::<f64>();
        let of_fabric = match fabric {
            Borne::Fabric(fabric) => fabric.map(|part| per_anisotropy * part),
            Borne::Usual => ratio.map(|part| usual * part),
        };
        let most = self.strength(FABRIC, x, unmobilised, loaded);
        state.ratios[FABRIC] = within(&of_fabric, most).0;
        let rest: Tensor = std::array::from_fn(|k| ratio[k] - state.ratios[FABRIC][k]);
        let size = contraction(&rest, &rest).sqrt();
        if size <= 0.0 {
            return state;
        }
        state.strength = (size / strength).clamp(1.0, MAX_OF_FRICTION);
        let more = 1.0 - MAX_OF_FRICTION * strength / size;
        if more > 0.0 {
            let both: Tensor = std::array::from_fn(|k| state.ratios[FABRIC][k] + more * rest[k]);
            let needed = MAX_OF_FRICTION * contraction(&both, &both).sqrt() / most;
            state.strength = needed.clamp(MAX_OF_FRICTION, MAX_STRENGTH);
            state.ratios[FABRIC] = within(&both, most * Self::factor(FABRIC, state.strength)).0;
        }
        let stiffening = self.stiffening(x, unmobilised, loaded);
        let stiffness: [f64; FABRIC] = std::array::from_fn(|k| stiffening * self.elements[k].stiffness);
        let limits: [f64; FABRIC] =
            std::array::from_fn(|k| Self::factor(k, state.strength) * strengths[k] / stiffness[k]);
        let common = shared(limits, stiffness, size);
        for k in 0..FABRIC {
            let carried = common.min(limits[k]) * stiffness[k] / size;
            state.ratios[k] = rest.map(|part| part * carried);
        }
        state
    }
}

/// a and b of the tensor r = a u + b dev(u u) of which r + Λ dev(r r) is u, a deviator of the length 1 with this determinant; `None` if
/// there is none, or hardly one. By the theorem of Cayley and Hamilton,
/// dev(r r) = (a b/3 + b² det u) u + (a² − b²/6) dev(u u).
fn coefficients(lode: f64, third: f64) -> Option<[f64; 2]> {
    let (mut a, mut b) = (1.0, -lode);
    for _ in 0..NEWTONS {
        let misses = [a + lode * (a * b / 3.0 + b * b * third) - 1.0, b + lode * (a * a - b * b / 6.0)];
        let [[aa, ab], [ba, bb]] = [
            [1.0 + lode * b / 3.0, lode * (a / 3.0 + 2.0 * b * third)],
            [2.0 * lode * a, 1.0 - lode * b / 3.0],
        ];
        let determinant = aa * bb - ab * ba;
        if determinant < MIN_DETERMINANT {
            return None;
        }
        if misses[0].abs().max(misses[1].abs()) < NEAR {
            return Some([a, b]);
        }
        a -= (bb * misses[0] - ab * misses[1]) / determinant;
        b -= (aa * misses[1] - ba * misses[0]) / determinant;
    }
    None
}

/// The shear strain over v that all elements have which do not slide, when together they carry a deviator of this size.
fn shared(limits: [f64; FABRIC], stiffness: [f64; FABRIC], size: f64) -> f64 {
    let mut order: [usize; FABRIC] = std::array::from_fn(|k| k);
    order.sort_by(|a, b| limits[*a].total_cmp(&limits[*b]));
    let (mut rest, mut stiff) = (size, stiffness.iter().sum::<f64>());
    let mut common = 0.0;
    for k in order {
        common = rest / stiff.max(f64::MIN_POSITIVE);
        if common <= limits[k] {
            break;
        }
        rest -= stiffness[k] * limits[k];
        stiff -= stiffness[k];
        common = limits[k];
    }
    common
}
