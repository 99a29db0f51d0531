//! Windows compared with averages over the same region of the whole assembly.

use super::*;
use crate::{Compression, Material, PackingSpec, pack};

fn packed() -> Simulation {
    let spec = PackingSpec {
        discs: 300,
        seed: 4,
        porosity: 0.12,
        compression: Compression::Horizontal,
        ..PackingSpec::default()
    };
    pack(&spec, &Material::default()).unwrap().simulation
}

/// Averages that depend only on the region are the same with and without cropping the assembly.
#[test]
fn a_window_is_a_region() {
    let state = packed();
    let [left, right, bottom, top] = state.walls.position;
    let (low, high) = ([left + 0.03, bottom + 0.02], [right - 0.05, top - 0.04]);
    let a = window(&state, low, high).averages;
    let b = homogenise_in(&state, &Polygon::rectangle(low, high), Cut::Clip);
    assert!(crop(&state, low, high).discs.len() < state.discs.len());
    for (value, expected) in [
        (a.porosity, b.porosity),
        (a.overlap_fraction, b.overlap_fraction),
        (a.fabric_index, b.fabric_index),
        (a.conductivity_xx, b.conductivity_xx),
        (a.conductivity_network_yy, b.conductivity_network_yy),
        (a.stress_xx / b.pressure, b.stress_xx / b.pressure),
        (a.stress_xy / b.pressure, b.stress_xy / b.pressure),
    ] {
        assert!((value - expected).abs() < 1e-12, "{a:?} {b:?}");
    }
    assert_eq!(a.contacts, b.contacts);
}

/// Pores, conductivity and stress of windows that tile the box add up to those of the box.
#[test]
fn windows_tile_the_box() {
    let state = packed();
    let list = windows(&state, 3, 2);
    let whole = window(&state, list[0].low, list[5].high).averages;
    let mean = |field: fn(&Averages) -> f64| list.iter().map(|w| field(&w.averages)).sum::<f64>() / 6.0;
    for field in [
        (|a| a.porosity) as fn(&Averages) -> f64,
        |a| a.conductivity_xx,
        |a| a.stress_yy / 1e3,
        |a| a.porosity_sum_of_areas,
    ] {
        assert!((mean(field) - field(&whole)).abs() < 1e-12, "{} {}", mean(field), field(&whole));
    }
    let rattlers: u64 = list.iter().map(|w| w.averages.rattlers).sum();
    assert_eq!(rattlers, crate::homogenise(&state, crate::RegionKind::Hull).rattlers);
}

#[test]
fn windows_stay_inside() {
    let state = packed();
    let [left, _, _, top] = state.walls.position;
    let corner = window_around(&state, [left, top], 0.05, 0.0);
    assert!((corner.low[0] - left).abs() < 1e-15 && (corner.high[1] - top).abs() < 1e-15, "{corner:?}");
    assert!((corner.high[0] - corner.low[0] - 0.05).abs() < 1e-15);
    let whole = window_around(&state, [0.0, 0.0], 10.0, 0.0);
    let area = (whole.high[0] - whole.low[0]) * (whole.high[1] - whole.low[1]);
    assert!((area / state.walls.area() - 1.0).abs() < 1e-12);
    let off = window_around(&state, [left, top], 0.05, 0.01);
    assert!((off.low[0] - left - 0.01).abs() < 1e-15 && (top - off.high[1] - 0.01).abs() < 1e-15, "{off:?}");
}
