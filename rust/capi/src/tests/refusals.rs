//! Inputs that are refused: with which status and message, and that nothing is written then.

use super::{
    Cells, Handle, MATERIAL, MSDD_INTERNAL, MSDD_INVALID_ARGUMENT, MSDD_IO, MSDD_MODEL, MSDD_NON_FINITE,
    MSDD_OK, last_error,
};
use crate::abi::{msdd_batch, msdd_initial, msdd_material, msdd_surrogate};
use crate::exports::*;
use crate::status::status;
use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

#[test]
fn bad_input_is_named_and_nothing_is_written() {
    let handle = Handle::builtin();
    let refused = |column: usize, value: f64, expected_status: i32, expected: &str| {
        let mut cells = Cells::new(&handle, 13);
        match column {
            0 | 1 => cells.state[column][10] = value,
            2 => cells.strain[10] = value,
            _ => cells.total[10] = value,
        }
        let before = cells.clone();
        assert_eq!(cells.advance(&handle), expected_status);
        assert_eq!(last_error(), expected);
        assert!(cells.outputs == before.outputs && cells.clamped == before.clamped);
        assert!(cells.next == before.next && cells.clamped_cells == 99);
    };
    refused(0, f64::NAN, MSDD_NON_FINITE, "porosity[10] = NaN is not finite");
    refused(1, f64::INFINITY, MSDD_NON_FINITE, "fabric_index[10] = inf is not finite");
    refused(2, f64::NEG_INFINITY, MSDD_NON_FINITE, "thermal_strain[10] = -inf is not finite");
    refused(3, f64::NAN, MSDD_NON_FINITE, "total_thermal_strain[10] = NaN is not finite");
    let message = "total_thermal_strain[10] = -1, allowed: above -1, to 10";
    refused(3, -1.0, MSDD_INVALID_ARGUMENT, message);
}

#[test]
fn bad_arguments_are_refused() {
    let handle = Handle::builtin();
    let mut cells = Cells::new(&handle, 4);
    let mut refused = |handle: *const msdd_surrogate,
                       material: *const msdd_material,
                       change: &dyn Fn(&mut msdd_batch),
                       expected: &str| {
        let status = cells.with_batch(|batch| {
            change(batch);
            // SAFETY: null or live handle, null or full structs, columns null or of `cells` values.
            unsafe { msdd_surrogate_advance(handle, material, batch) }
        });
        assert_eq!(status, MSDD_INVALID_ARGUMENT);
        assert!(last_error().contains(expected), "{}", last_error());
    };
    refused(null(), &MATERIAL, &|_| (), "surrogate is NULL");
    refused(handle.0, null(), &|_| (), "material is NULL");
    refused(handle.0, &MATERIAL, &|batch| batch.struct_size = 8, "batch.struct_size = 8");
    refused(handle.0, &msdd_material { struct_size: 0, ..MATERIAL }, &|_| (), "material.struct_size = 0");
    refused(handle.0, &MATERIAL, &|batch| batch.state = null(), "state is NULL");
    refused(handle.0, &MATERIAL, &|batch| batch.thermal_strain = null(), "thermal_strain is NULL");
    refused(handle.0, &MATERIAL, &|batch| batch.cells = usize::MAX, "cells");
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(handle.0, &msdd_material { young_modulus: bad, ..MATERIAL }, &|_| (), "young_modulus");
        refused(handle.0, &msdd_material { thermal_conductivity: bad, ..MATERIAL }, &|_| (), "conductivity");
        refused(handle.0, &msdd_material { mean_radius: bad, ..MATERIAL }, &|_| (), "mean_radius");
    }
}

/// At the ends of the allowed ranges of the scales, K and stresses are finite and above zero; outside, a scale is refused
/// and the message gives its range.
#[test]
fn scales_keep_answers_numbers_or_are_refused() {
    let handle = Handle::builtin();
    let ends = [[1e-12, 1e12], [1e-9, 1e15], [1e-12, 1e6]];
    for choice in 0..8 {
        let [thermal_conductivity, young_modulus, mean_radius] = [0, 1, 2].map(|k| ends[k][choice >> k & 1]);
        let material = msdd_material { thermal_conductivity, young_modulus, mean_radius, ..MATERIAL };
        let mut cells = Cells::new(&handle, 9);
        cells.state[2][4] = f64::MAX;
        let status = cells.with_batch(|batch| {
            // SAFETY: live handle, full structs, columns of `cells` values.
            unsafe { msdd_surrogate_advance(handle.0, &material, batch) }
        });
        assert_eq!(status, MSDD_OK, "{}", last_error());
        let positive = cells.outputs[..4].iter().flatten().all(|value| value.is_normal() && *value > 0.0);
        assert!(positive && cells.outputs[4..].iter().flatten().all(|value| value.is_finite()), "{cells:?}");
        let (mut porosity, mut fabric_index) = ([0.12; 2], [0.0; 2]);
        let (stress, conductivity) = ([-1e30, 1e30], [1e-30, 1e30]);
        let mut rest = vec![[0.0; 2]; handle.columns() - 2];
        let state = [&mut porosity, &mut fabric_index].map(|column| column.as_mut_ptr());
        let state: Vec<*mut f64> = state.into_iter().chain(rest.iter_mut().map(|c| c.as_mut_ptr())).collect();
        let initial = msdd_initial {
            struct_size: size_of::<msdd_initial>(),
            cells: 2,
            porosity: state[0],
            fabric_index: state[1],
            fabric_xy: null(),
            stress_xx: stress.as_ptr(),
            stress_yy: stress.as_ptr(),
            stress_xy: stress.as_ptr(),
            conductivity_xx: conductivity.as_ptr(),
            conductivity_yy: conductivity.as_ptr(),
            conductivity_xy: stress.as_ptr(),
        };
        // SAFETY: live handle, full structs, columns of two values.
        let status = unsafe { msdd_surrogate_initial_state(handle.0, &material, &initial, state.as_ptr()) };
        assert_eq!(status, MSDD_OK, "{}", last_error());
        assert!(rest.iter().flatten().all(|value| value.is_finite()), "{rest:?}");
    }
    for (k, name, range) in [
        (0, "thermal_conductivity", "1e-12 to 1e12 W/(m K)"),
        (1, "young_modulus", "1e-9 to 1e15 Pa"),
        (2, "mean_radius", "1e-12 to 1e6 m"),
    ] {
        for (bad, shown) in [
            (0.99 * ends[k][0], None),
            (1.01 * ends[k][1], None),
            (1e-200, Some("1e-200")),
            (-1.0, Some("-1")),
        ] {
            let mut scales = [100.0, 1e7, 5e-3];
            scales[k] = bad;
            let [thermal_conductivity, young_modulus, mean_radius] = scales;
            let material = msdd_material { thermal_conductivity, young_modulus, mean_radius, ..MATERIAL };
            let status = Cells::new(&handle, 2).with_batch(|batch| {
                // SAFETY: live handle, full structs, columns of `cells` values.
                unsafe { msdd_surrogate_advance(handle.0, &material, batch) }
            });
            let expected = format!("material.{name} = {}", shown.unwrap_or_default());
            let message = last_error();
            assert_eq!(status, MSDD_INVALID_ARGUMENT, "{message}");
            assert!(
                message.starts_with(&expected) && message.ends_with(&format!("allowed: {range}")),
                "{message}"
            );
        }
    }
}

/// An initial value that no packing has is refused: the message names the first such cell, and nothing is written.
#[test]
fn a_start_that_no_packing_has_is_refused() {
    for source in [c"builtin", c"builtin:paper"] {
        let handle = Handle::load(source);
        let refused = |column: usize, value: f64, expected: &str| {
            let usual = [0.12, 0.0, 0.01, 1e3, 1e3, 10.0, 30.0, 30.0, 0.5];
            let mut columns = usual.map(|value| vec![value; 11]);
            columns[column][7] = value;
            let mut state = vec![vec![-7.0; 11]; handle.columns()];
            let pointers: Vec<*mut f64> = state.iter_mut().map(|c| c.as_mut_ptr()).collect();
            let initial = msdd_initial {
                struct_size: size_of::<msdd_initial>(),
                cells: 11,
                porosity: columns[0].as_ptr(),
                fabric_index: columns[1].as_ptr(),
                fabric_xy: columns[2].as_ptr(),
                stress_xx: columns[3].as_ptr(),
                stress_yy: columns[4].as_ptr(),
                stress_xy: columns[5].as_ptr(),
                conductivity_xx: columns[6].as_ptr(),
                conductivity_yy: columns[7].as_ptr(),
                conductivity_xy: columns[8].as_ptr(),
            };
            // SAFETY: live handle, full structs, columns of eleven values.
            let status =
                unsafe { msdd_surrogate_initial_state(handle.0, &MATERIAL, &initial, pointers.as_ptr()) };
            assert_eq!((status, last_error().as_str()), (MSDD_INVALID_ARGUMENT, expected));
            assert!(state.iter().flatten().all(|value| *value == -7.0));
            if column == 0 {
                let mut solid = [-7.0; 11];
                // SAFETY: live handle, columns of eleven values.
                let status = unsafe {
                    msdd_surrogate_solid_fraction(handle.0, 11, columns[0].as_ptr(), solid.as_mut_ptr())
                };
                assert_eq!((status, last_error().as_str()), (MSDD_INVALID_ARGUMENT, expected));
                assert_eq!(solid, [-7.0; 11]);
            }
        };
        refused(0, -1.0, "porosity[7] = -1, allowed: 0 to 1");
        refused(0, 2.0, "porosity[7] = 2, allowed: 0 to 1");
        refused(0, 1e300, "porosity[7] = 1e300, allowed: 0 to 1");
        refused(1, -1.5, "fabric_index[7] = -1.5, allowed: -1 to 1");
        refused(2, 1.5, "fabric_xy[7] = 1.5, allowed: -1 to 1");
        refused(3, -2e30, "stress_xx[7] = -2e30, allowed: -1e30 to 1e30 Pa");
        refused(4, 1e300, "stress_yy[7] = 1e300, allowed: -1e30 to 1e30 Pa");
        refused(5, -2e30, "stress_xy[7] = -2e30, allowed: -1e30 to 1e30 Pa");
        refused(6, -1.0, "conductivity_xx[7] = -1, allowed: above 0, to 1e30 W/(m K)");
        refused(7, 0.0, "conductivity_yy[7] = 0, allowed: above 0, to 1e30 W/(m K)");
        refused(7, 1e31, "conductivity_yy[7] = 1e31, allowed: above 0, to 1e30 W/(m K)");
        refused(8, 1e31, "conductivity_xy[7] = 1e31, allowed: -1e30 to 1e30 W/(m K)");
    }
}

#[test]
fn loading_says_what_is_wrong() {
    let load = |source: &CStr| {
        let mut out = null_mut();
        // SAFETY: a C string and a writable pointer.
        let status = unsafe { msdd_surrogate_load(source.as_ptr(), &mut out) };
        assert!(out.is_null());
        (status, last_error())
    };
    let (status, message) = load(c"no/such/model.json");
    assert!(status == MSDD_IO && message.contains("no/such/model.json"), "{status} {message}");
    let manifest = CString::new(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")).expect("no NUL");
    let (status, message) = load(&manifest);
    assert!(status == MSDD_MODEL && message.contains("damaged"), "{status} {message}");
    assert_eq!(load(c"\xff").0, MSDD_INVALID_ARGUMENT);
    let (status, message) = load(c"builtin:best");
    assert!(status == MSDD_MODEL && message.contains("builtin:paper"), "{status} {message}");
    // SAFETY: null is allowed.
    assert_eq!(unsafe { msdd_surrogate_load(null(), null_mut()) }, MSDD_INVALID_ARGUMENT);
}

#[test]
fn a_panic_becomes_a_status() {
    assert_eq!(status(|| panic!("deliberate, {}", 42)), MSDD_INTERNAL);
    assert!(last_error().contains("deliberate, 42"));
}
