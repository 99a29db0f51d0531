//! Variables of the state, and the features (inputs) of the networks.

use crate::SurrogateError;
pub use crate::dataset::ConductivityKind;
use crate::dataset::StateRow;
use crate::kernel::vector::{Portable, Vector};
use crate::kernel::{LANES, Lanes};
use crate::region::Coordinates;
use crate::scaling::Range;
use crate::surrogate::{MAX_STATE, StateLanes};
use serde::{Deserialize, Serialize};

/// The optional variables that the state contains. η, f and p̃ are always in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variables {
    /// f_K = (K_xx − K_yy)/(K_xx + K_yy).
    pub fabric_conductivity: bool,
    /// q̃ = (σ_xx − σ_yy)/2 · ℓ/(E r̄).
    pub stress_deviator: bool,
}

/// Columns of a state: porosity, fabric index, reduced pressure, and the optional ones.
pub const POROSITY: usize = 0;
pub const FABRIC_INDEX: usize = 1;
pub const PRESSURE: usize = 2;

/// Largest number of odd variables: f, f_K, q̃.
pub const MAX_ODD: usize = 3;

impl Variables {
    pub const ALL: Self = Self { fabric_conductivity: true, stress_deviator: true };

    pub fn names(self) -> &'static [&'static str] {
        let all =
            &["porosity", "fabric_index", "reduced_pressure", "fabric_conductivity", "reduced_deviator"];
        match (self.fabric_conductivity, self.stress_deviator) {
            (true, true) => all,
            (true, false) => &all[..4],
            (false, true) => &["porosity", "fabric_index", "reduced_pressure", "reduced_deviator"],
            (false, false) => &all[..3],
        }
    }

    /// Column of f_K.
    pub fn fabric_conductivity(self) -> Option<usize> {
        self.fabric_conductivity.then_some(3)
    }

    /// Column of q̃.
    pub fn deviator(self) -> Option<usize> {
        self.stress_deviator.then_some(if self.fabric_conductivity { 4 } else { 3 })
    }

    /// Columns of the odd variables, f first, q̃ last.
    pub fn odd(self) -> impl Iterator<Item = usize> {
        std::iter::once(FABRIC_INDEX).chain(self.fabric_conductivity()).chain(self.deviator())
    }

    pub fn odd_count(self) -> usize {
        self.odd().count()
    }
}

/// A state of the database in the model's variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// In the order of [`Variables::names`].
    pub state: [f64; MAX_STATE],
    /// (K_xx + K_yy)/2k.
    pub conductivity: f64,
    /// f_K and r = q̃/p̃, also when the state does not contain them.
    pub fabric_conductivity: f64,
    pub stress_ratio: f64,
    /// p̃ > 0. Without force chains, f and the other odd quantities are noise.
    pub jammed: bool,
}

impl Point {
    /// `None` when the row lacks the kind of conductivity.
    pub fn new(variables: Variables, kind: ConductivityKind, row: &StateRow) -> Option<Self> {
        let [kxx, kyy] = kind.of(row)?;
        let pressure = (0.5 * (row.stress_xx + row.stress_yy)).max(0.0);
        let deviator = (0.5 * (row.stress_xx - row.stress_yy)).clamp(-pressure, pressure);
        let jammed = row.load_bearing && pressure > 0.0;
        let fabric_conductivity = if kxx + kyy > 0.0 { (kxx - kyy) / (kxx + kyy) } else { 0.0 };
        let mut state = [0.0; MAX_STATE];
        (state[POROSITY], state[FABRIC_INDEX], state[PRESSURE]) = (row.porosity, row.fabric_index, pressure);
        if let Some(column) = variables.fabric_conductivity() {
            state[column] = fabric_conductivity;
        }
        if let Some(column) = variables.deviator() {
            state[column] = deviator;
        }
        let stress_ratio = stress_ratio(deviator, pressure);
        Some(Self { state, conductivity: 0.5 * (kxx + kyy), fabric_conductivity, stress_ratio, jammed })
    }
}

/// Added to p̃ in the stress ratio, so that the ratio tends to zero at unjamming. A hundredth of p̃ of the loosest
/// packings.
const PRESSURE_FLOOR: f64 = 1e-4;

/// q̃/p̃ [-], finite at zero pressure.
#[inline(always)]
pub fn stress_ratio(deviator: f64, pressure: f64) -> f64 {
    deviator / (pressure + PRESSURE_FLOOR)
}

/// Trained ranges of the features; those of odd features are symmetric about 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FeatureRanges {
    pub porosity: Range,
    pub fabric_index: Range,
    pub pressure: Range,
    pub fabric_conductivity: Range,
    /// Range of q̃/p̃.
    pub stress_ratio: Range,
    pub thermal_strain: Range,
}

/// Number of even inputs of the readout: η, √p̃, the square of the last odd feature.
pub const READOUT_INPUTS: usize = 3;
/// Number of even inputs of the rates: the same and ε.
pub const RATE_INPUTS: usize = 4;

/// Features of a block of cells.
#[derive(Clone, Debug, Default)]
pub struct Features {
    /// Scaled to [-1, 1]: η, √p̃, the square of the last odd feature, ε.
    pub even: [Lanes; RATE_INPUTS],
    /// Scaled to [-1, 1]: f, f_K, q̃/p̃, as far as the state contains them.
    pub odd: [Lanes; MAX_ODD],
    /// √p̃, clamped to its trained range.
    pub root_pressure: Lanes,
}

impl FeatureRanges {
    /// Smallest ranges that hold all states and strains.
    pub fn of(points: &[Point], strains: Range) -> Self {
        let column = |k: usize| Range::of(points.iter().map(|p| p.state[k]));
        let odd = |value: fn(&Point) -> f64| {
            let jammed = points.iter().filter(|p| p.jammed);
            let largest = jammed.map(|p| value(p).abs()).fold(0.0, f64::max);
            Range { min: -largest, max: largest }
        };
        Self {
            porosity: column(POROSITY),
            fabric_index: odd(|p| p.state[FABRIC_INDEX]),
            pressure: Range { min: 0.0, max: column(PRESSURE).max },
            fabric_conductivity: odd(|p| p.fabric_conductivity),
            stress_ratio: odd(|p| p.stress_ratio),
            thermal_strain: strains,
        }
    }

    /// Computes the features of a block of states. `ratio` is their q̃/p̃, see [`stress_ratios`]. Odd features that the
    /// state does not contain are left unchanged.
    #[inline(always)]
    pub fn fill_features<V: Vector>(
        &self,
        variables: Variables,
        state: &StateLanes,
        ratio: &Lanes,
        strain: &Lanes,
        features: &mut Features,
    ) {
        let root = Range { min: 0.0, max: self.pressure.max.sqrt() };
        let root_pressure = clamped(V::read(&state[PRESSURE]), self.pressure).sqrt();
        root_pressure.write(&mut features.root_pressure);
        let mut last = scaled(V::read(&state[FABRIC_INDEX]), self.fabric_index);
        last.write(&mut features.odd[0]);
        let mut count = 1;
        if let Some(column) = variables.fabric_conductivity() {
            last = scaled(V::read(&state[column]), self.fabric_conductivity);
            last.write(&mut features.odd[1]);
            count = 2;
        }
        if variables.stress_deviator {
            last = scaled(V::read(ratio), self.stress_ratio);
            last.write(&mut features.odd[count]);
        }
        let [porosity, pressure, square, thermal_strain] = &mut features.even;
        scaled(V::read(&state[POROSITY]), self.porosity).write(porosity);
        scaled(root_pressure, root).write(pressure);
        ((last + last) * last - V::all(1.0)).write(square);
        scaled(V::read(strain), self.thermal_strain).write(thermal_strain);
    }

    /// As [`FeatureRanges::fill_features`], slower but simpler to call.
    pub fn features(&self, variables: Variables, state: &StateLanes, strain: &Lanes) -> Features {
        let (ratio, mut features) = (stress_ratios::<Portable>(variables, state), Features::default());
        self.fill_features::<Portable>(variables, state, &ratio, strain, &mut features);
        features
    }

    /// As [`crate::surrogate::Answer::outside`]. For the deviator the range of q̃/p̃ counts.
    #[inline(always)]
    pub fn outside<V: Vector>(
        &self,
        variables: Variables,
        state: &StateLanes,
        ratio: &Lanes,
        strain: &Lanes,
        outside: &mut [Lanes; MAX_STATE + 1],
    ) {
        beyond::<V>(&state[POROSITY], self.porosity).write(&mut outside[POROSITY]);
        beyond::<V>(&state[FABRIC_INDEX], self.fabric_index).write(&mut outside[FABRIC_INDEX]);
        beyond::<V>(&state[PRESSURE], self.pressure).write(&mut outside[PRESSURE]);
        if let Some(column) = variables.fabric_conductivity() {
            beyond::<V>(&state[column], self.fabric_conductivity).write(&mut outside[column]);
        }
        if let Some(column) = variables.deviator() {
            let pressure = V::read(&state[PRESSURE]).at_least(V::zero());
            (beyond::<V>(ratio, self.stress_ratio) * pressure).write(&mut outside[column]);
        }
        beyond::<V>(strain, self.thermal_strain).write(&mut outside[MAX_STATE]);
    }
}

/// Upper limit for the deviator [-]: far above any of grains, and far from overflow.
const LARGEST_DEVIATOR: f64 = 1e150;

/// q̃/p̃ of a block of states; 0 when the state does not contain the deviator. Negative pressure (tension) counts as
/// zero.
#[inline(always)]
pub fn stress_ratios<V: Vector>(variables: Variables, state: &StateLanes) -> Lanes {
    let mut ratios = [0.0; LANES];
    if let Some(column) = variables.deviator() {
        let pressure = V::read(&state[PRESSURE]).at_least(V::zero());
        // The limits are far beyond any state of grains. They keep the ratio finite for any input: infinity over a
        // pressure of zero would be NaN.
        let deviator = V::read(&state[column]).within(V::all(-LARGEST_DEVIATOR), V::all(LARGEST_DEVIATOR));
        (deviator / (pressure + V::all(PRESSURE_FLOOR))).write(&mut ratios);
    }
    ratios
}

impl FeatureRanges {
    /// # Errors
    /// [`SurrogateError::Data`] when a feature does not vary.
    pub fn check(&self) -> Result<(), SurrogateError> {
        let ranges = [
            ("porosity", self.porosity),
            ("fabric_index", self.fabric_index),
            ("pressure", self.pressure),
            ("fabric_conductivity", self.fabric_conductivity),
            ("stress ratio", self.stress_ratio),
            ("thermal_strain", self.thermal_strain),
        ];
        match ranges.iter().find(|(_, range)| !(range.width() > 0.0 && range.width().is_finite())) {
            None => Ok(()),
            Some((key, _)) => Err(SurrogateError::Data(format!("{key} is the same in all training states"))),
        }
    }

    /// A state as a point of the [`crate::region::Region`]: η, √p̃ and the odd features, scaled but not clamped.
    pub fn coordinates(&self, variables: Variables, state: &[f64; MAX_STATE]) -> Coordinates {
        let on = |value: f64, range: Range| {
            (value - 0.5 * (range.min + range.max)) / (0.5 * range.width()).max(f64::MIN_POSITIVE)
        };
        let root = Range { min: 0.0, max: self.pressure.max.sqrt() };
        let pressure = state[PRESSURE].max(0.0);
        let mut point = Coordinates::default();
        point[POROSITY] = on(state[POROSITY], self.porosity);
        point[FABRIC_INDEX] = on(state[FABRIC_INDEX], self.fabric_index);
        point[PRESSURE] = on(pressure.sqrt(), root);
        if let Some(column) = variables.fabric_conductivity() {
            point[column] = on(state[column], self.fabric_conductivity);
        }
        if let Some(column) = variables.deviator() {
            point[column] = on(stress_ratio(state[column], pressure), self.stress_ratio);
        }
        point
    }
}

#[inline(always)]
fn clamped<V: Vector>(values: V, range: Range) -> V {
    values.within(V::all(range.min), V::all(range.max))
}

/// Clamped to the range and scaled to [-1, 1].
#[inline(always)]
fn scaled<V: Vector>(values: V, range: Range) -> V {
    let (middle, half) = (0.5 * (range.min + range.max), (0.5 * range.width()).max(f64::MIN_POSITIVE));
    (clamped(values, range) - V::all(middle)) * V::all(1.0 / half)
}

/// Distance outside of the range, negative below it; 0 inside.
#[inline(always)]
fn beyond<V: Vector>(values: &Lanes, range: Range) -> V {
    let values = V::read(values);
    values - clamped(values, range)
}
