//! Inputs that are refused: with which status and message, and that nothing is written then.

use super::*;
use crate::abi::{msdd_grains, msdd_model, msdd_start};
use crate::status::status;
use std::ffi::{CStr, CString};

#[test]
fn bad_input_is_named_and_nothing_is_written() {
    let handle = load("builtin");
    let refused = |column: usize, value: f64, expected_status: i32, expected: &str| {
        let mut cells = swelling(&handle, 13);
        match column {
            0 | 1 => cells.state[column][10] = value,
            2 => cells.thermal_strain[10] = value,
            _ => cells.total[10] = value,
        }
        let before = cells.clone();
        assert_eq!(cells.advance_with(&handle, |_| ()), expected_status);
        assert_eq!(last_error(), expected);
        assert!(cells.outputs == before.outputs && cells.outside == before.outside);
        assert!(cells.next == before.next && cells.outside_cells == 99);
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
    let handle = load("builtin");
    let mut cells = swelling(&handle, 4);
    let mut refused = |handle: *const msdd_model,
                       material: *const msdd_grains,
                       change: &dyn Fn(&mut Tables),
                       expected: &str| {
        let status = cells.advance_of(handle, material, true, change);
        assert_eq!(status, MSDD_INVALID_ARGUMENT, "{expected}");
        assert!(last_error().contains(expected), "{expected}: {}", last_error());
    };
    refused(null(), &MATERIAL, &|_| (), "model is NULL");
    refused(handle.0, null(), &|_| (), "material is NULL");
    refused(handle.0, &MATERIAL, &|tables| tables.step.struct_size = 8, "step.struct_size = 8");
    refused(handle.0, &msdd_grains { struct_size: 0, ..MATERIAL }, &|_| (), "material.struct_size = 0");
    refused(handle.0, &MATERIAL, &|tables| tables.step.state = null(), "state is NULL");
    refused(handle.0, &MATERIAL, &|tables| tables.state[0] = NOT_GIVEN, "porosity is NULL");
    refused(handle.0, &MATERIAL, &|tables| tables.step.cells = usize::MAX, "cells");
    refused(handle.0, &MATERIAL, &|tables| tables.step.components = 6, "components = 6, allowed: 3");
    // What discs do not compute is refused where it is wanted; what they do not use may be given.
    let column = [300.0; 4];
    let mut scratch = [0.0; 4];
    let wanted = output(&mut scratch);
    let gas = &|tables: &mut Tables| tables.step.gas_conductivity = wanted;
    refused(handle.0, &MATERIAL, gas, "gas_conductivity = not NULL, allowed: NULL");
    let solid = &|tables: &mut Tables| tables.step.solid_fraction = wanted;
    refused(handle.0, &MATERIAL, solid, "solid_fraction = not NULL");
    let warm = |tables: &mut Tables| tables.step.temperature = input(&column);
    assert_eq!(swelling(&handle, 4).advance_with(&handle, warm), MSDD_OK, "{}", last_error());
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(handle.0, &msdd_grains { young_modulus: bad, ..MATERIAL }, &|_| (), "young_modulus");
        refused(handle.0, &msdd_grains { conductivity: bad, ..MATERIAL }, &|_| (), "conductivity");
        refused(handle.0, &msdd_grains { radius: bad, ..MATERIAL }, &|_| (), "radius");
    }
}

/// At the ends of the allowed ranges of the scales, K and stresses are finite and above zero; outside, a scale is refused
/// and the message gives its range.
#[test]
fn scales_keep_answers_numbers_or_are_refused() {
    let handle = load("builtin");
    let ends = [[1e-12, 1e12], [1e-9, 1e15], [1e-12, 1e6]];
    for choice in 0..8 {
        let [conductivity, young_modulus, radius] = [0, 1, 2].map(|k| ends[k][choice >> k & 1]);
        let material = msdd_grains { conductivity, young_modulus, radius, ..MATERIAL };
        let mut cells = swelling(&handle, 9);
        cells.state[2][4] = f64::MAX;
        let status = cells.advance_of(handle.0, &material, false, |_| ());
        assert_eq!(status, MSDD_OK, "{}", last_error());
        let positive = cells.outputs[..4].iter().flatten().all(|value| value.is_normal() && *value > 0.0);
        assert!(positive && cells.outputs[4..].iter().flatten().all(|value| value.is_finite()), "{cells:?}");
        let (porosity, fabric_index) = ([0.12; 2], [0.0; 2]);
        let (stress, k) = ([-1e30, 1e30], [1e-30, 1e30]);
        let mut rest = vec![vec![0.0; 2]; handle.columns()];
        let state = outputs(&mut rest);
        let (stress, conductivity) = ([input(&stress); 3], [input(&k), input(&k), input(&stress)]);
        let start = msdd_start {
            cells: 2,
            porosity: input(&porosity),
            fabric_index: input(&fabric_index),
            stress: stress.as_ptr(),
            conductivity: conductivity.as_ptr(),
            ..START
        };
        // SAFETY: live handle, full structs, columns of two values.
        let status = unsafe { msdd_model_initial_state(handle.0, &material, &start, state.as_ptr()) };
        assert_eq!(status, MSDD_OK, "{}", last_error());
        assert!(rest.iter().flatten().all(|value| value.is_finite()), "{rest:?}");
    }
    for (k, name, range) in [
        (0, "conductivity", "1e-12 to 1e12 W/(m K)"),
        (1, "young_modulus", "1e-9 to 1e15 Pa"),
        (2, "radius", "1e-12 to 1e6 m"),
    ] {
        for (bad, shown) in [
            (0.99 * ends[k][0], None),
            (1.01 * ends[k][1], None),
            (1e-200, Some("1e-200")),
            (-1.0, Some("-1")),
        ] {
            let mut scales = [100.0, 1e7, 5e-3];
            scales[k] = bad;
            let [conductivity, young_modulus, radius] = scales;
            let material = msdd_grains { conductivity, young_modulus, radius, ..MATERIAL };
            let status = swelling(&handle, 2).advance_of(handle.0, &material, false, |_| ());
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
    for source in ["builtin", "builtin:paper"] {
        let handle = load(source);
        let refused = |column: usize, value: f64, expected: &str| {
            let usual = [0.12, 0.0, 0.01, 1e3, 1e3, 10.0, 30.0, 30.0, 0.5];
            let mut columns = usual.map(|value| vec![value; 11]);
            columns[column][7] = value;
            let mut state = vec![vec![-7.0; 11]; handle.columns()];
            let pointers = outputs(&mut state);
            let given = inputs(&columns);
            let start = msdd_start {
                cells: 11,
                porosity: given[0],
                fabric_index: given[1],
                fabric_xy: given[2],
                stress: given[3..].as_ptr(),
                conductivity: given[6..].as_ptr(),
                ..START
            };
            // SAFETY: live handle, full structs, columns of eleven values.
            let status = unsafe { msdd_model_initial_state(handle.0, &MATERIAL, &start, pointers.as_ptr()) };
            assert_eq!((status, last_error().as_str()), (MSDD_INVALID_ARGUMENT, expected));
            assert!(state.iter().flatten().all(|value| *value == -7.0));
            if column == 0 {
                let mut solid = [-7.0; 11];
                // SAFETY: live handle, columns of eleven values.
                let status = unsafe {
                    msdd_model_solid_fraction(handle.0, 11, columns[0].as_ptr(), solid.as_mut_ptr())
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
        refused(3, -2e30, "stress[xx][7] = -2e30, allowed: -1e30 to 1e30 Pa");
        refused(4, 1e300, "stress[yy][7] = 1e300, allowed: -1e30 to 1e30 Pa");
        refused(5, -2e30, "stress[xy][7] = -2e30, allowed: -1e30 to 1e30 Pa");
        refused(6, -1.0, "conductivity[xx][7] = -1, allowed: above 0, to 1e30 W/(m K)");
        refused(7, 0.0, "conductivity[yy][7] = 0, allowed: above 0, to 1e30 W/(m K)");
        refused(7, 1e31, "conductivity[yy][7] = 1e31, allowed: above 0, to 1e30 W/(m K)");
        refused(8, 1e31, "conductivity[xy][7] = 1e31, allowed: -1e30 to 1e30 W/(m K)");
    }
}

/// Columns at a stride give the bits of contiguous ones; a stride of 0 and overlapping outputs are refused, and then nothing is
/// written. An output may be exactly an input's column.
#[test]
fn columns_have_strides_and_do_not_overlap() {
    let handle = load("builtin");
    let mut apart = Cells::new(&handle, 13);
    apart.advance(&handle);
    // Tensors xx, xy, xz, yy, yz, zz, as OpenFOAM stores them.
    let (mut k, mut strain) = (vec![-7.0; 6 * 13], vec![0.0; 6 * 13]);
    for (component, at) in [(0, 0), (1, 3), (2, 1)] {
        (0..13).for_each(|cell| strain[6 * cell + at] = apart.strain[component][cell]);
    }
    let (k_start, strain_start) = (k.as_mut_ptr(), strain.as_ptr());
    let mut together = apart.part(0, 13);
    let interleaved = |tables: &mut Tables| {
        for (component, at) in [(0, 0), (1, 3), (2, 1)] {
            tables.conductivity[component] =
                crate::abi::msdd_output { values: k_start.wrapping_add(at), stride: 6 };
            tables.strain[component] =
                crate::abi::msdd_input { values: strain_start.wrapping_add(at), stride: 6 };
        }
    };
    assert_eq!(together.advance_with(&handle, interleaved), MSDD_OK, "{}", last_error());
    assert!(together.next == apart.next && together.outputs[2..4] == apart.outputs[2..4]);
    for cell in 0..13 {
        let found = [k[6 * cell], k[6 * cell + 3], k[6 * cell + 1]].map(f64::to_bits);
        assert_eq!(found, [0, 1, 4].map(|o: usize| apart.outputs[o][cell].to_bits()));
        assert!([2, 4, 5].iter().all(|&other| k[6 * cell + other] == -7.0));
    }

    let refused = |change: &dyn Fn(&mut Tables), expected: &str| {
        let mut cells = Cells::new(&handle, 13);
        let before = cells.clone();
        assert_eq!(cells.advance_with(&handle, change), MSDD_INVALID_ARGUMENT, "{expected}");
        assert!(last_error().contains(expected), "{expected}: {}", last_error());
        assert!(cells == before);
    };
    refused(&|tables| tables.state[1].stride = 0, "fabric_index.stride = 0, allowed: 1 or more");
    refused(&|tables| tables.step.thermal_strain.stride = 0, "thermal_strain.stride = 0");
    refused(&|tables| tables.stress[1].stride = 0, "stress.stride = 0");
    refused(&|tables| tables.step.thermal_strain.stride = usize::MAX / 8, "thermal_strain.stride = ");
    refused(&|tables| tables.stress[1] = tables.stress[0], "stress = overlapping stress");
    refused(&|tables| tables.conductivity[0] = tables.next_state[2], "overlapping");
    let shifted = |tables: &mut Tables| {
        tables.stress[0].values = tables.step.thermal_strain.values.cast_mut().wrapping_add(1);
    };
    refused(&shifted, "stress = overlapping thermal_strain");
    let wide = |tables: &mut Tables| {
        tables.conductivity[0] = crate::abi::msdd_output { values: k_start, stride: 5 };
        tables.conductivity[1] = crate::abi::msdd_output { values: k_start.wrapping_add(3), stride: 6 };
    };
    refused(&wide, "conductivity = overlapping conductivity");
}

#[test]
fn loading_says_what_is_wrong() {
    let refused = |source: &CStr| {
        let mut out = null_mut();
        // SAFETY: a C string and a writable pointer.
        let status = unsafe { msdd_model_load(source.as_ptr(), &mut out) };
        assert!(out.is_null());
        (status, last_error())
    };
    let (status, message) = refused(c"no/such/model.json");
    assert!(status == MSDD_IO && message.contains("no/such/model.json"), "{status} {message}");
    let manifest = CString::new(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")).expect("no NUL");
    let (status, message) = refused(&manifest);
    assert!(status == MSDD_MODEL && message.contains("damaged"), "{status} {message}");
    assert_eq!(refused(c"\xff").0, MSDD_INVALID_ARGUMENT);
    let (status, message) = refused(c"builtin:best");
    assert!(status == MSDD_MODEL && message.contains("builtin:paper"), "{status} {message}");
    // SAFETY: null is allowed.
    assert_eq!(unsafe { msdd_model_load(null(), null_mut()) }, MSDD_INVALID_ARGUMENT);
}

#[test]
fn a_panic_becomes_a_status() {
    assert_eq!(status(|| panic!("deliberate, {}", 42)), MSDD_INTERNAL);
    assert!(last_error().contains("deliberate, 42"));
}

/// Requests of a training that cannot be done; what is trained is compared with `msdd train` in tests/python.
#[test]
fn trainings_are_refused_by_key() {
    let refused = |request: &CStr| {
        let mut model = null_mut();
        // SAFETY: a C string; the model is writable.
        let status = unsafe { msdd_train(request.as_ptr(), &mut model) };
        assert!(status != MSDD_OK && model.is_null());
        last_error()
    };
    for (request, expected) in [
        (c"{", "request = {, allowed: a JSON object with \"database\" and other keys of msdd_train"),
        (c"{\"databases\": []}", "unknown field `databases`"),
        (c"{\"database\": []}", "database = [], allowed: at least one database"),
        (c"{\"database\": [\"none.csv\"]}", "none.csv"),
        (c"{\"database\": [\"none.csv\"], \"fix\": {\"lode\": 0.1}}", "fix: lode = 0.1 with model increment"),
        (
            c"{\"database\": [\"a\"], \"model\": \"spheres\", \"fix\": {\"lode\": 2}}",
            "fix = lode=2, allowed: 0 to 0.8",
        ),
    ] {
        let found = refused(request);
        assert!(found.contains(expected), "{request:?}: {found}");
    }
    // SAFETY: null is refused.
    unsafe {
        assert!(msdd_train(null(), &mut null_mut()) != MSDD_OK);
        assert!(msdd_train(c"{}".as_ptr(), null_mut()) != MSDD_OK);
    }
}
