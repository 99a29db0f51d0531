//! How far the discs of a real bed may lie from a run: 90 % bands of temperature, pressure, conductivity and displacement.
//!
//! A band has two parts in addition to the errors of the numerical method: what the model leaves out, and the scatter of packings. Both are
//! a fitted number times a length that the run itself gives:
//!
//! | | model | packing |
//! |---|---|---|
//! | T | change of T with the logarithm of the conductivity | the same, times √(1000/grains of the bed); mean radius × mean gradient of T |
//! | p, K | logarithm of p over p at the start, times the value; K of spheres: the value | the value × √(100/grains of a window) |
//! | u | its size | mean radius × largest thermal strain so far |
//!
//! K of spheres is known from the state of the bed, not from a start that is given, and a good part of it is the gas's.
//!
//! The numbers are fitted to reference scenes: those of discs by `comparisons scenes --bands`, an example of rust/cli, those of
//! spheres by `comparisons beds --bands`.

use crate::bed::{BandInputs, Grains};
use crate::quantity::Quantity;
use crate::series::Series;
use crate::trial::Outcome;
use serde::{Deserialize, Serialize};

/// Share of the discs' values that lie inside the bands.
pub const LEVEL: f64 = 0.9;
/// Grains of a bed and of a window for which the numbers of the packing stand.
const BED: f64 = 1000.0;
const WINDOW: f64 = 100.0;
/// Least pressure whose share counts, as a share of that at the start.
const MIN_PRESSURE: f64 = 0.05;

/// Standard deviation of the model and of the packing per unit of the numbers that are fitted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Units {
    pub model: f64,
    pub packing: Vec<f64>,
}

/// Fitted numbers of one quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Numbers {
    pub model: f64,
    pub packing: Vec<f64>,
    /// Half of a band over the standard deviation.
    pub factor: f64,
}

impl Numbers {
    /// Halves of the bands of the model alone and of the packing alone.
    pub fn halves(&self, units: &Units) -> [f64; 2] {
        let packing: f64 = self.packing.iter().zip(&units.packing).map(|(a, b)| (a * b).powi(2)).sum();
        [self.factor * self.model * units.model, self.factor * packing.sqrt()]
    }
}

/// All fitted numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Law {
    pub temperature: Numbers,
    pub pressure: Numbers,
    pub conductivity: Numbers,
    /// `None` of spheres, of which no DEM results exist.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub displacement: Option<Numbers>,
    /// For T and p: the root of the mean square of the error over bed and run stays with this probability ([`LEVEL`]) below this factor times
    /// that of the bands' halves.
    pub request: [f64; 2],
}

impl Law {
    /// The numbers that belong to the shipped model of these grains.
    pub fn shipped(of: Grains) -> Self {
        let text = match of {
            Grains::Discs => include_str!("bands.json"),
            Grains::Spheres => include_str!("bands-spheres.json"),
        };
        serde_json::from_str(text).expect("rust/autotune/src/bands*.json are laws of bands")
    }

    /// With four decimals.
    pub fn rounded(mut self) -> Self {
        let groups = [
            Some(&mut self.temperature),
            Some(&mut self.pressure),
            Some(&mut self.conductivity),
            self.displacement.as_mut(),
        ];
        let numbers = groups
            .into_iter()
            .flatten()
            .flat_map(|of| [&mut of.model, &mut of.factor].into_iter().chain(&mut of.packing));
        for number in numbers.chain(&mut self.request) {
            *number = (*number * 1e4).round() / 1e4;
        }
        self
    }

    pub fn of(&self, quantity: Quantity) -> Option<&Numbers> {
        match quantity {
            Quantity::Temperature => Some(&self.temperature),
            Quantity::Pressure => Some(&self.pressure),
            Quantity::ConductivityXx | Quantity::ConductivityYy | Quantity::ConductivityZz => {
                Some(&self.conductivity)
            }
            Quantity::DisplacementX | Quantity::DisplacementY | Quantity::DisplacementZ => {
                self.displacement.as_ref()
            }
        }
    }

    /// What the model (0) or the packing (1) leaves open, root of the mean square over bed and run, with probability [`LEVEL`]
    /// [the unit of the quantity]; 0 for what the run does not give.
    pub fn uncertainty(&self, quantity: Quantity, part: usize, lengths: &Lengths) -> f64 {
        let factor = self.request[usize::from(quantity != Quantity::Temperature)];
        let Some(numbers) = self.of(quantity) else { return 0.0 };
        let rms = lengths.map(quantity, |units| numbers.halves(units)[part]).rms();
        if rms.is_finite() { factor * rms } else { 0.0 }
    }
}

/// Factor of the conductivity of the run that shows what another conductivity would change.
pub const CONDUCTIVITY: f64 = 1.05;

/// Change of T with the logarithm of the conductivity \[K\]: `more` has [`CONDUCTIVITY`] times that of `base`.
pub fn sensitivity(base: &Outcome, more: &Outcome) -> Series {
    let temperature = |run: &Outcome| run.values.get(&Quantity::Temperature).cloned().unwrap_or_default();
    temperature(more).minus(&temperature(base), 1.0 / CONDUCTIVITY.ln())
}

/// What the run gives for the bands.
pub struct Lengths<'a> {
    bed: &'a BandInputs,
    run: &'a Outcome,
    /// Change of T with the logarithm of the conductivity [K].
    sensitivity: &'a Series,
    /// Root of the mean square of the gradient of T over the bed [K/m], and largest thermal strain so far, at each time.
    gradient: Vec<f64>,
    strain: Vec<f64>,
}

impl<'a> Lengths<'a> {
    pub fn new(bed: &'a BandInputs, run: &'a Outcome, sensitivity: &'a Series) -> Self {
        let gradient = run.series(Quantity::Temperature).values.iter().map(|row| bed.gradient(row)).collect();
        let mut largest = 0.0f64;
        let strain = run.strain.values.iter().map(|row| {
            largest = row.iter().filter(|value| value.is_finite()).fold(largest, |a, b| a.max(b.abs()));
            largest
        });
        Self { bed, run, sensitivity, gradient, strain: strain.collect() }
    }

    /// The units of a quantity at a time and a point, by their numbers.
    pub fn units(&self, quantity: Quantity, time: usize, point: usize) -> Option<Units> {
        let value = *self.run.values.get(&quantity)?.values.get(time)?.get(point)?;
        let units = match quantity {
            Quantity::Temperature => {
                let now = self.run.series(quantity).times[time];
                let change = self.sensitivity.at(now)?.get(point)?.abs();
                let all = change * (BED / self.bed.grains).sqrt();
                Units { model: change, packing: vec![all, self.bed.mean_radius * self.gradient[time]] }
            }
            Quantity::Pressure => {
                self.start(point)?;
                self.relative(self.pressure_size(value, point), time, point)?
            }
            Quantity::ConductivityXx | Quantity::ConductivityYy | Quantity::ConductivityZz => {
                match self.bed.kind {
                    Grains::Discs => self.relative(value, time, point)?,
                    Grains::Spheres => Units { model: value, packing: vec![self.of_window(value)] },
                }
            }
            Quantity::DisplacementX | Quantity::DisplacementY | Quantity::DisplacementZ => {
                let all = [Quantity::DisplacementX, Quantity::DisplacementY, Quantity::DisplacementZ];
                let other = |q| self.run.values.get(&q)?.values.get(time)?.get(point).copied();
                let size = all.into_iter().filter_map(other).fold(0.0, f64::hypot);
                Units { model: size, packing: vec![self.bed.mean_radius * self.strain.get(time)?] }
            }
        };
        units.model.is_finite().then_some(units)
    }

    /// The pressure of whose size the band at a point is a share, for a value there.
    pub fn pressure_size(&self, value: f64, point: usize) -> f64 {
        self.start(point).map_or(value, |start| value.max(MIN_PRESSURE * start))
    }

    fn start(&self, point: usize) -> Option<f64> {
        self.run.start_pressure.get(point).copied()
    }

    /// Of what scatters with its own size.
    fn relative(&self, size: f64, time: usize, point: usize) -> Option<Units> {
        let start = self.start(point)?.max(f64::MIN_POSITIVE);
        let now = self.run.values.get(&Quantity::Pressure)?.values.get(time)?.get(point)?;
        let change = (now.max(MIN_PRESSURE * start) / start).ln().abs();
        Some(Units { model: change * size, packing: vec![self.of_window(size)] })
    }

    /// The scatter of a mean over a window, per unit of its size.
    fn of_window(&self, size: f64) -> f64 {
        size * (WINDOW / self.bed.window).sqrt()
    }

    /// A number of the units at all times and points; NaN where there are none.
    pub fn map(&self, quantity: Quantity, number: impl Fn(&Units) -> f64) -> Series {
        let Some(run) = self.run.values.get(&quantity) else { return Series::default() };
        let at = |time, point| self.units(quantity, time, point).map_or(f64::NAN, |units| number(&units));
        let row = |time: usize| (0..run.values[time].len()).map(|point| at(time, point)).collect();
        Series { times: run.times.clone(), values: (0..run.times.len()).map(row).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn series(values: &[&[f64]]) -> Series {
        Series {
            times: (0..values.len()).map(|k| k as f64).collect(),
            values: values.iter().map(|row| row.to_vec()).collect(),
        }
    }

    fn run() -> Outcome {
        let values = BTreeMap::from([
            (Quantity::Temperature, series(&[&[300.0, 310.0], &[300.0, 320.0]])),
            (Quantity::Pressure, series(&[&[100.0, 100.0], &[200.0, 0.0]])),
            (Quantity::ConductivityXx, series(&[&[1.0, 1.0], &[2.0, 1.0]])),
            (Quantity::DisplacementX, series(&[&[0.0, 0.0], &[3.0, f64::NAN]])),
            (Quantity::DisplacementY, series(&[&[0.0, 0.0], &[4.0, f64::NAN]])),
        ]);
        Outcome {
            values,
            strain: series(&[&[-0.02, 0.01], &[0.0, 0.01]]),
            start_pressure: vec![100.0, 100.0],
            range: 20.0,
            cells: 1,
            seconds: 0.0,
            processor: 0.0,
            beyond: None,
            warnings: Vec::new(),
        }
    }

    #[test]
    fn units_of_all_quantities() {
        let neighbours = vec![([0, 1], 0, 5.0)];
        let bed =
            BandInputs { kind: Grains::Discs, grains: 250.0, mean_radius: 0.1, window: 25.0, neighbours };
        let (run, sensitivity) = (run(), series(&[&[0.0, 0.0], &[0.0, -7.0]]));
        let lengths = Lengths::new(&bed, &run, &sensitivity);
        let at = |quantity, point| lengths.units(quantity, 1, point);
        assert_eq!(
            at(Quantity::Temperature, 1),
            Some(Units { model: 7.0, packing: vec![14.0, 0.1 * 20.0 / 5.0] })
        );
        let double = 2.0f64.ln();
        assert_eq!(at(Quantity::Pressure, 0), Some(Units { model: 200.0 * double, packing: vec![400.0] }));
        assert_eq!(at(Quantity::Pressure, 1).unwrap().packing, [10.0]);
        assert_eq!(at(Quantity::ConductivityXx, 0), Some(Units { model: 2.0 * double, packing: vec![4.0] }));
        assert_eq!(at(Quantity::DisplacementY, 0), Some(Units { model: 5.0, packing: vec![0.1 * 0.02] }));
        assert_eq!(at(Quantity::DisplacementY, 1), None);
        assert_eq!(at(Quantity::ConductivityYy, 0), None);
        let spheres = BandInputs { kind: Grains::Spheres, ..bed.clone() };
        let lengths = Lengths::new(&spheres, &run, &sensitivity);
        let units = lengths.units(Quantity::ConductivityXx, 1, 0);
        assert_eq!(units, Some(Units { model: 2.0, packing: vec![4.0] }));
    }

    #[test]
    fn the_shipped_numbers_are_sane() {
        for (kind, quantity) in
            [Grains::Discs, Grains::Spheres].iter().flat_map(|kind| Quantity::ALL.map(|q| (*kind, q)))
        {
            let law = Law::shipped(kind);
            let Some(Numbers { model, packing, factor }) = law.of(quantity) else {
                assert!(kind == Grains::Spheres && quantity.needs_motion());
                continue;
            };
            // Six scenes, of which one is unlike the others, have wide tails.
            let most = if kind == Grains::Discs { 3.0 } else { 4.0 };
            assert!((0.0..1.0).contains(model) && (1.0..most).contains(factor), "{kind:?} {quantity:?}");
            assert!(packing.iter().all(|number| (0.0..3.0).contains(number)), "{kind:?} {quantity:?}");
        }
    }
}
