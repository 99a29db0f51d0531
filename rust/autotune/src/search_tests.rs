//! The search on scenes whose errors are known.

use super::*;
use crate::bands::{Law, Numbers};
use crate::bed::{BandInputs, Grains};
use crate::found::Values;
use crate::quantity::Quantity;
use crate::series::Series;
use crate::settings::Level;
use crate::trial::Outcome;

/// Numbers of bands that stay when the shipped ones are fitted anew.
fn law() -> Law {
    Law {
        temperature: Numbers { model: 0.027, packing: vec![0.018, 0.37], factor: 1.72 },
        pressure: Numbers { model: 0.055, packing: vec![0.046], factor: 1.75 },
        request: [0.85, 0.77],
        ..Law::shipped(Grains::Discs)
    }
}

/// A scene whose errors are known: `space[k]` at 1 cell along k, falling with the square; `time` at tolerance 1.
struct KnownErrors {
    space: Vec<f64>,
    time: f64,
    motion: f64,
    cells: Vec<usize>,
    sensitivity: f64,
    /// What a constant conductivity leaves out.
    constant: f64,
    mirrors: Vec<bool>,
}

impl KnownErrors {
    fn error(&self, settings: &Settings) -> f64 {
        let cells = |k: usize| {
            let own = settings.levels[k].cells(settings.own_cells(k, self.cells[k]));
            if settings.halves(k) { 2 * own } else { own }
        };
        let space: f64 = self.space.iter().enumerate().map(|(k, e)| e / (cells(k) as f64).powi(2)).sum();
        let motion = if settings.moves { 0.0 } else { self.motion };
        let constant = settings.constant.map_or(0.0, |_| self.constant);
        constant + space + self.time * settings.tolerance.powf(time_order(settings.moves)) + motion
    }

    fn find(&self, accuracy: f64, moves: Option<bool>) -> Result<Found, ChoiceError> {
        let (kind, neighbours) = (Grains::Discs, Vec::new());
        let bed = BandInputs { kind, grains: 1000.0, mean_radius: 1.0, window: 100.0, neighbours };
        let (cells, law) = (self.cells.clone(), law());
        let target = SearchTarget {
            accuracy,
            pressure: None,
            cells,
            mirrors: self.mirrors.clone(),
            moves,
            constant: true,
            bed,
            law,
        };
        let run = &mut |settings: &Settings, _| {
            // A change of the conductivity by 5 % changes T by this many kelvins.
            let more = self.sensitivity * (settings.conductivity - 1.0);
            let series = Series { times: vec![1.0], values: vec![vec![100.0 + self.error(settings) + more]] };
            let own = |(k, &n): (usize, &usize)| settings.levels[k].cells(settings.own_cells(k, n));
            let cells = self.cells.iter().enumerate().map(own).product();
            let one = Series { times: vec![1.0], values: vec![vec![1.0]] };
            let conductivity = [Quantity::ConductivityXx, Quantity::ConductivityYy].map(|k| (k, one.clone()));
            let mut values = Values::from(conductivity);
            values.insert(Quantity::Temperature, series);
            Ok(Outcome {
                values,
                strain: Series::default(),
                start_pressure: Vec::new(),
                range: 100.0,
                cells,
                seconds: 1.0,
                processor: 1.0,
                beyond: None,
                warnings: Vec::new(),
            })
        };
        Ok(find(&target, run)?.0)
    }
}

/// The best accuracy of T that a refusal offers, and its reason.
fn refused(found: Result<Found, ChoiceError>) -> (f64, String) {
    match found {
        Err(ChoiceError::OutOfReach { missed, reason }) => {
            assert_eq!(missed.iter().map(|one| one.key).collect::<Vec<_>>(), ["accuracy"]);
            (missed[0].best, reason)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_true_error_is_within_the_request_and_no_finer_than_it_needs() {
    let scene = KnownErrors {
        space: vec![300.0, 100.0],
        time: 4.0,
        motion: 0.1,
        cells: vec![200, 100],
        sensitivity: 0.0,
        constant: 50.0,
        mirrors: Vec::new(),
    };
    for accuracy in [5.0, 2.0, 1.0] {
        let found = scene.find(accuracy, None).unwrap();
        let error = scene.error(&found.settings);
        assert!(error <= accuracy, "{accuracy} {error} {:?}", found.settings);
        assert!(!found.settings.moves, "{accuracy}");
        // One level coarser along the first direction would be too much.
        let cells = found.settings.levels[0].cells(200) as f64;
        assert!(300.0 / (cells / 4.0).powi(2) > 0.25 * accuracy, "{accuracy} {cells}");
        assert!(found.total() <= accuracy);
    }
}

#[test]
fn motion_counts_where_it_matters_and_where_the_user_says_so() {
    let scene = KnownErrors {
        space: vec![10.0],
        time: 1.0,
        motion: 4.0,
        cells: vec![100],
        sensitivity: 0.0,
        constant: 50.0,
        mirrors: Vec::new(),
    };
    assert!(scene.find(1.0, None).unwrap().settings.moves);
    assert!(!scene.find(20.0, None).unwrap().settings.moves);
    assert!(scene.find(20.0, Some(true)).unwrap().settings.moves);
    assert!(!scene.find(20.0, Some(false)).unwrap().settings.moves);
    let (best, reason) = refused(scene.find(1.0, Some(false)));
    assert!(reason.contains("mechanics none") && !scene.find(best, Some(false)).unwrap().settings.moves);
}

#[test]
fn a_direction_along_which_nothing_changes_gets_one_cell() {
    let scene = KnownErrors {
        space: vec![300.0, 0.0],
        time: 1.0,
        motion: 0.0,
        cells: vec![100, 50],
        sensitivity: 0.0,
        constant: 50.0,
        mirrors: Vec::new(),
    };
    assert_eq!(scene.find(1.0, None).unwrap().settings.levels[1], Level::One);
}

#[test]
fn a_request_out_of_reach_is_refused_with_the_best_that_can_be_had() {
    let scene = KnownErrors {
        space: vec![30_000.0],
        time: 1.0,
        motion: 0.0,
        cells: vec![20],
        sensitivity: 0.0,
        constant: 50.0,
        mirrors: Vec::new(),
    };
    let (best, _) = refused(scene.find(0.5, None));
    assert!(best > 0.5 && scene.find(best, None).is_ok(), "{best}");
}

#[test]
fn what_model_and_packing_leave_open_is_not_asked_of_the_cells() {
    let scene = |sensitivity| KnownErrors {
        space: vec![700.0],
        time: 1.0,
        motion: 0.0,
        cells: vec![100],
        sensitivity,
        constant: 50.0,
        mirrors: Vec::new(),
    };
    let cells = |found: &Found| found.settings.levels[0].cells(100);
    let (sure, unsure) = (scene(0.0).find(2.0, None).unwrap(), scene(30.0).find(2.0, None).unwrap());
    assert!(cells(&unsure) > cells(&sure), "{} {}", cells(&unsure), cells(&sure));
    assert!(unsure.total() <= 2.0);
    let (best, _) = refused(scene(100.0).find(2.0, None));
    assert!(best > 2.0 && scene(100.0).find(best, None).is_ok(), "{best}");
}

#[test]
fn the_conductivity_is_constant_where_that_changes_little_and_the_grains_stay() {
    let scene = |constant| KnownErrors {
        space: vec![10.0],
        time: 1.0,
        motion: 0.1,
        cells: vec![100],
        sensitivity: 0.0,
        constant,
        mirrors: Vec::new(),
    };
    let found = scene(0.3).find(2.0, None).unwrap();
    assert_eq!(found.settings.constant, Some([1.0, 1.0]));
    let share = found.shares.iter().find(|share| share.source == "constant conductivity").unwrap();
    assert!((share.percent - 0.3).abs() < 1e-9);
    assert!(scene(0.3).error(&found.settings) <= 2.0 && found.total() <= 2.0);
    assert_eq!(scene(0.3).find(2.0, Some(true)).unwrap().settings.constant, None);
    assert_eq!(scene(0.5).find(2.0, None).unwrap().settings.constant, None);
}

#[test]
fn half_of_a_box_that_mirrors_is_enough() {
    let scene = KnownErrors {
        space: vec![300.0, 100.0],
        time: 1.0,
        motion: 4.0,
        cells: vec![100, 36],
        sensitivity: 0.0,
        constant: 50.0,
        mirrors: vec![true, false],
    };
    let found = scene.find(2.0, None).unwrap();
    assert_eq!(found.settings.halved, [true, false]);
    assert!(scene.error(&found.settings) <= 2.0 && found.total() <= 2.0);
    let whole = KnownErrors { mirrors: Vec::new(), ..scene };
    let cells = |found: &Found| found.tried.iter().map(|tried| tried.cells).min().unwrap();
    assert!(cells(&found) < cells(&whole.find(2.0, None).unwrap()));
}

/// Asks for accuracies of T and p in a bed where p grows threefold, whose uncertainty of p is far above that of T. `error`: of p on the
/// coarse mesh [% of its range].
fn with_pressure(accuracy: f64, pressure: f64, error: f64) -> Result<Found, ChoiceError> {
    let (kind, neighbours) = (Grains::Discs, Vec::new());
    let bed = BandInputs { kind, grains: 1e9, mean_radius: 1e-3, window: 1e6, neighbours };
    let target = SearchTarget {
        accuracy,
        pressure: Some(pressure),
        cells: vec![16],
        mirrors: Vec::new(),
        moves: Some(true),
        constant: false,
        bed,
        law: law(),
    };
    let run = &mut |settings: &Settings, _| {
        let more = settings.conductivity - 1.0;
        let cells = settings.levels[0].cells(16);
        let away = 2.0 * error * (16.0 / cells as f64).powi(2);
        let series = |values: [f64; 2]| Series {
            times: vec![0.0, 1.0],
            values: values.map(|value| vec![value, value]).to_vec(),
        };
        let values = Values::from([
            (Quantity::Temperature, series([100.0, 100.0 + more])),
            (Quantity::Pressure, series([100.0, 300.0 + away])),
        ]);
        Ok(Outcome {
            values,
            strain: Series::default(),
            start_pressure: vec![100.0; 2],
            range: 100.0,
            cells,
            seconds: 1.0,
            processor: 1.0,
            beyond: None,
            warnings: Vec::new(),
        })
    };
    Ok(find(&target, run)?.0)
}

#[test]
fn a_refusal_names_what_of_t_and_p_cannot_be_had_and_the_best_of_it() {
    let missed = |found: Result<Found, ChoiceError>| match found {
        Err(ChoiceError::OutOfReach { missed, .. }) => missed,
        other => panic!("{other:?}"),
    };
    // What model and packing leave open of p does not depend on what is asked
    let [low, high] = [2.0, 5.0].map(|pressure| missed(with_pressure(10.0, pressure, 0.0)));
    assert_eq!(low.len(), 1);
    assert_eq!((low[0].key, low[0].asked), ("pressureAccuracy", 2.0));
    assert!((low[0].best / high[0].best - 1.0).abs() < 1e-9, "{low:?} {high:?}");
    let best = low[0].best;
    assert!(best > 5.0 && with_pressure(10.0, best, 0.0).is_ok(), "{best}");
    // The message has the key, and the numbers of p
    let text = with_pressure(10.0, 5.0, 0.0).unwrap_err().to_string();
    let wanted =
        format!("pressureAccuracy = 5 %, allowed: at least {best:.2} % for this scene: model and packing");
    assert!(text.starts_with(&wanted) && text.contains("of the range of p open"), "{text}");
    // T next to it
    let both = missed(with_pressure(1e-6, 5.0, 0.0));
    assert_eq!(both.iter().map(|one| one.key).collect::<Vec<_>>(), ["accuracy", "pressureAccuracy"]);
    assert!((both[1].best / best - 1.0).abs() < 1e-9 && with_pressure(both[0].best, best, 0.0).is_ok());
    // Cells that are too few for p
    let cells = missed(with_pressure(10.0, 1.2 * best, 100.0 * best));
    assert_eq!((cells.len(), cells[0].key), (1, "pressureAccuracy"));
    // More than the range itself
    let none = Missed { key: "pressureAccuracy", asked: 20.0, best: 136.95 };
    assert_eq!(
        none.to_string(),
        "pressureAccuracy = 20 %, allowed: none for this scene, where the best is 136.95 %"
    );
}
