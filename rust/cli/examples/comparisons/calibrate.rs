//! Fits the numbers of the bands to scenes with several packings, of which discs and solver are known.

use msdd_autotune::bands::{LEVEL, Numbers, Units};
use std::collections::BTreeMap;

/// One value of one packing.
#[derive(Clone, Debug)]
pub struct Row {
    /// UserCase, and packing.
    pub scene: usize,
    pub packing: u64,
    /// What is the same for all packings of a scene: quantity, time, window.
    pub key: usize,
    /// Discs minus solver.
    pub error: f64,
    /// The value of the discs.
    pub discs: f64,
    pub units: Units,
}

/// How bands do on rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coverage {
    /// Share of the values inside, of all scenes equally, and that of the worst scene.
    pub inside: f64,
    pub worst: f64,
    /// Half of the band over the standard deviation between packings: median over the scenes.
    pub width: f64,
}

/// Repetitions of the weighted fit of the variances.
const REPETITIONS: usize = 60;

/// Fits the numbers. The packing's are those of the differences of the packings from their mean, the model's those of the means,
/// both by maximum likelihood, scenes weighted equally; the factor is such that [`LEVEL`] of the values of scenes that are left out
/// of the fit one after the other lie inside.
pub fn fit(rows: &[Row]) -> Numbers {
    let mut left_out = Vec::new();
    for scene in scenes(rows) {
        let others: Vec<Row> = rows.iter().filter(|row| row.scene != scene).cloned().collect();
        let numbers = variances(&others);
        let own: Vec<&Row> = rows.iter().filter(|row| row.scene == scene).collect();
        let weight = 1.0 / own.len() as f64;
        left_out.extend(own.iter().map(|row| (row.error.abs() / sigma(&numbers, row), weight)));
    }
    Numbers { factor: quantile(left_out, LEVEL), ..variances(rows) }
}

/// How the bands of these numbers do.
pub fn coverage(rows: &[Row], numbers: &Numbers) -> Coverage {
    let mut parts = Vec::new();
    for scene in scenes(rows) {
        let own: Vec<&Row> = rows.iter().filter(|row| row.scene == scene).collect();
        let half = |row: &Row| numbers.factor * sigma(numbers, row);
        let inside = own.iter().filter(|row| row.error.abs() <= half(row)).count() as f64;
        let mean: f64 = own.iter().map(|row| half(row).powi(2)).sum::<f64>() / own.len() as f64;
        let mut scatter = (0.0, 0.0);
        for values in by_key(&own).values() {
            let middle = values.iter().map(|row| row.discs).sum::<f64>() / values.len() as f64;
            scatter.0 += values.iter().map(|row| (row.discs - middle).powi(2)).sum::<f64>();
            scatter.1 += values.len() as f64 - 1.0;
        }
        parts.push((inside / own.len() as f64, (mean * scatter.1 / scatter.0).sqrt()));
    }
    let count = parts.len() as f64;
    Coverage {
        inside: parts.iter().map(|part| part.0).sum::<f64>() / count,
        worst: parts.iter().map(|part| part.0).fold(1.0, f64::min),
        width: quantile(parts.iter().map(|part| (part.1, 1.0)).collect(), 0.5),
    }
}

/// The value below which this share of the weight lies.
pub fn quantile(mut values: Vec<(f64, f64)>, share: f64) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = values.iter().map(|value| value.1).sum();
    let mut sum = 0.0;
    for (value, weight) in &values {
        sum += weight;
        // Sums of weights are not exact.
        if sum >= share * all * (1.0 - 1e-9) {
            return *value;
        }
    }
    f64::NAN
}

fn scenes(rows: &[Row]) -> Vec<usize> {
    let mut scenes: Vec<usize> = rows.iter().map(|row| row.scene).collect();
    scenes.sort_unstable();
    scenes.dedup();
    scenes
}

fn sigma(numbers: &Numbers, row: &Row) -> f64 {
    let [model, packing] = Numbers { factor: 1.0, ..numbers.clone() }.halves(&row.units);
    model.hypot(packing).max(f64::MIN_POSITIVE)
}

fn by_key<'a>(rows: &[&'a Row]) -> BTreeMap<(usize, usize), Vec<&'a Row>> {
    let mut map: BTreeMap<_, Vec<&Row>> = BTreeMap::new();
    for row in rows {
        map.entry((row.scene, row.key)).or_default().push(row);
    }
    map
}

/// Model and packing, with factor 1.
fn variances(rows: &[Row]) -> Numbers {
    let all: Vec<&Row> = rows.iter().collect();
    let mut counts: BTreeMap<usize, f64> = BTreeMap::new();
    for row in rows {
        *counts.entry(row.scene).or_default() += 1.0;
    }
    let (mut own, mut common) = (Vec::new(), Vec::new());
    for values in by_key(&all).values() {
        let count = values.len() as f64;
        let mean = values.iter().map(|row| row.error).sum::<f64>() / count;
        for row in values {
            let weight = 1.0 / counts[&row.scene];
            let squares: Vec<f64> = row.units.packing.iter().map(|unit| unit * unit).collect();
            if count > 1.0 {
                own.push(Square {
                    of: (row.error - mean).powi(2) * count / (count - 1.0),
                    parts: squares.clone(),
                    known: 0.0,
                    weight,
                });
            }
            common.push((mean * mean, vec![row.units.model.powi(2)], squares, count, weight));
        }
    }
    let packing = likely(&own);
    let common: Vec<Square> = common
        .into_iter()
        .map(|(of, parts, squares, count, weight)| {
            let known = squares.iter().zip(&packing).map(|(a, b)| a * b).sum::<f64>() / count;
            Square { of, parts, known, weight }
        })
        .collect();
    let model = likely(&common);
    let root = |values: &[f64]| values.iter().map(|value| value.sqrt()).collect::<Vec<f64>>();
    Numbers { model: root(&model)[0], packing: root(&packing), factor: 1.0 }
}

/// The square of an error whose expectation is `known` + Σ number × part.
struct Square {
    of: f64,
    parts: Vec<f64>,
    known: f64,
    weight: f64,
}

/// The numbers, not negative, for which normally distributed errors are the likeliest: least squares of the squares, weighted by
/// the inverse square of their expectation, which is renewed until it stays (Fisher's scoring).
fn likely(squares: &[Square]) -> Vec<f64> {
    let count = squares.first().map_or(0, |square| square.parts.len());
    let mean = |value: &dyn Fn(&Square) -> f64| {
        squares.iter().map(|square| square.weight * value(square)).sum::<f64>()
    };
    // Each alone, to begin with.
    let begin = |k: usize| mean(&|s| s.of) / mean(&|s| s.parts[k]).max(f64::MIN_POSITIVE) / count as f64;
    let mut numbers: Vec<f64> = (0..count).map(begin).collect();
    // A thousandth of the mean: where all parts vanish, any error would have no weight or all of it.
    let least = 1e-3 * mean(&|s| s.of) / mean(&|_| 1.0).max(f64::MIN_POSITIVE);
    for _ in 0..REPETITIONS {
        let expected = |s: &Square| {
            s.known + s.parts.iter().zip(&numbers).map(|(part, number)| part * number).sum::<f64>() + least
        };
        let weight = |s: &Square| s.weight / expected(s).powi(2);
        let sum = |value: &dyn Fn(&Square) -> f64| {
            squares.iter().map(|square| weight(square) * value(square)).sum::<f64>()
        };
        let product = |i: usize, j: usize| sum(&|s| s.parts[i] * s.parts[j]);
        let right = |i: usize| sum(&|s| s.parts[i] * (s.of - s.known));
        let alone = |i: usize| (right(i) / product(i, i).max(f64::MIN_POSITIVE)).max(0.0);
        numbers = match count {
            2 => {
                let (a, b, c) = (product(0, 0), product(0, 1), product(1, 1));
                let (p, q) = (right(0), right(1));
                let determinant = a * c - b * b;
                let both = [(p * c - q * b) / determinant, (q * a - p * b) / determinant];
                match both {
                    [x, y] if x >= 0.0 && y >= 0.0 => both.to_vec(),
                    [x, _] if x < 0.0 => vec![0.0, alone(1)],
                    _ => vec![alone(0), 0.0],
                }
            }
            _ => (0..count).map(alone).collect(),
        };
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Normally distributed numbers (sum of twelve evenly distributed ones) of a simple generator.
    fn normal(state: &mut u64) -> f64 {
        let mut even = || {
            *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (*state >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..12).map(|_| even()).sum::<f64>() - 6.0
    }

    fn rows(model: f64, packing: [f64; 2]) -> Vec<Row> {
        let mut state = 7;
        let mut rows = Vec::new();
        for scene in 0..12 {
            for key in 0..100 {
                let units = Units {
                    model: 1.0 + (key % 3) as f64,
                    packing: vec![1.0 + (key % 5) as f64, 3.0 + (scene % 2) as f64 * 4.0],
                };
                let common = model * units.model * normal(&mut state);
                for number in 0..3 {
                    let own = packing[0] * units.packing[0] * normal(&mut state)
                        + packing[1] * units.packing[1] * normal(&mut state);
                    let error = common + own;
                    rows.push(Row { scene, packing: number, key, error, discs: error, units: units.clone() });
                }
            }
        }
        rows
    }

    #[test]
    fn the_numbers_of_made_up_errors_are_found_again() {
        let Numbers { model, packing, factor } = fit(&rows(0.5, [0.3, 0.1]));
        assert!((model - 0.5).abs() < 0.04, "{model}");
        assert!((packing[0] - 0.3).abs() < 0.02 && (packing[1] - 0.1).abs() < 0.02, "{packing:?}");
        assert!((factor - 1.645).abs() < 0.1, "{factor}");
    }

    #[test]
    fn bands_hold_what_they_promise() {
        let rows = rows(0.5, [0.3, 0.0]);
        let numbers = fit(&rows);
        let found = coverage(&rows, &numbers);
        assert!((found.inside - LEVEL).abs() < 0.02 && found.worst > 0.8, "{found:?}");
        let half = Numbers { factor: 0.5 * numbers.factor, ..numbers };
        assert!(coverage(&rows, &half).inside < 0.65);
    }
}
