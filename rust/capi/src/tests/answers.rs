//! Results of a loaded model through the C functions.

use super::*;
use crate::abi::msdd_start;
use ::msdd_surrogate::surrogate::MAX_STATE;
use std::ffi::{CStr, c_char};

const MODELS: [&str; 2] = ["builtin", "builtin:paper"];

#[test]
fn answers_are_the_models_in_si() {
    for name in MODELS {
        let handle = load(name);
        let mut cells = swelling(&handle, 11);
        cells.state[0][9] = 1e300;
        cells.advance(&handle);
        let model = ::msdd_surrogate::models::builtin(name).expect("shipped");
        for cell in 0..11 {
            let mut state = [0.0; MAX_STATE];
            state.iter_mut().zip(&cells.state).for_each(|(value, column)| *value = column[cell]);
            let expected = model.evaluate(&state, cells.thermal_strain[cell]);
            let scale = 1e7 * 5e-3 * (1.0 + cells.total[cell]);
            let close = |o: usize, value: f64| {
                let found: f64 = cells.outputs[o][cell];
                assert!((found - value).abs() <= 1e-14 * value.abs(), "{name} {o}: {found} {value}");
            };
            for (column, lanes) in cells.next.iter().zip(&expected.state) {
                assert_eq!(column[cell].to_bits(), lanes[0].to_bits());
            }
            for k in [0, 1] {
                close(k, 100.0 * expected.conductivity[k][0]);
                close(2 + k, scale * expected.stress[k][0]);
            }
            close(4, 100.0 * expected.conductivity[2][0]);
            close(5, scale * expected.stress[2][0]);
            assert_eq!(cells.outside[cell], u8::from(cell == 9), "{name} {cell} {expected:?}");
            assert_eq!(cells.distance[0][cell] > 1.0, cell == 9);
        }
        assert_eq!(cells.outside_cells, 1);
    }
}

#[test]
fn an_answer_does_not_depend_on_its_batch() {
    let handle = load("builtin");
    let mut all = swelling(&handle, 21);
    all.advance(&handle);
    for cell in 0..21 {
        let mut one = swelling(&handle, 1);
        one.state = all.state.iter().map(|column| vec![column[cell]]).collect();
        (one.thermal_strain, one.total) = (vec![all.thermal_strain[cell]], vec![all.total[cell]]);
        one.advance(&handle);
        for (single, batch) in one.outputs.iter().chain(&one.next).zip(all.outputs.iter().chain(&all.next)) {
            assert_eq!(single[0].to_bits(), batch[cell].to_bits());
        }
    }
}

#[test]
fn a_state_may_advance_in_place() {
    let handle = load("builtin");
    let (mut apart, mut shared) = (swelling(&handle, 19), swelling(&handle, 19));
    apart.advance(&handle);
    let status = shared.advance_with(&handle, Tables::in_place);
    assert_eq!(status, MSDD_OK);
    assert_eq!(shared.state, apart.next);
    assert_eq!(shared.outputs, apart.outputs);
}

/// A start whose stress, conductivity and fabric are known answers with them; a cell that turns takes them with it.
#[test]
fn what_is_known_of_a_start_is_answered_and_turns_with_the_cell() {
    let handle = load("builtin");
    let columns = [0.12, 0.03, 0.004, 3500.0, 2500.0, 200.0, 31.0, 27.0, 1.0].map(|value| [value; 2]);
    let [porosity, fabric_index, fabric_xy, sxx, syy, sxy, kxx, kyy, kxy] =
        columns.each_ref().map(|column| input(column));
    let mut cells = swelling(&handle, 2);
    let state = outputs(&mut cells.state);
    let (stress, conductivity) = ([sxx, syy, sxy], [kxx, kyy, kxy]);
    let start = msdd_start {
        cells: 2,
        porosity,
        fabric_index,
        fabric_xy,
        stress: stress.as_ptr(),
        conductivity: conductivity.as_ptr(),
        ..START
    };
    // SAFETY: live handle, full structs, columns of two values.
    let status = unsafe { msdd_model_initial_state(handle.0, &MATERIAL, &start, state.as_ptr()) };
    assert_eq!(status, MSDD_OK, "{}", last_error());
    (cells.thermal_strain, cells.total) = (vec![0.0; 2], vec![0.0; 2]);
    // The second cell turns by 0.1 rad.
    let angle: f64 = 0.1;
    cells.strain[3] = vec![0.0, angle];
    cells.advance(&handle);
    let (sine, cosine) = (2.0 * angle).sin_cos();
    for ([xx, yy, xy], [o, p, q]) in [([3500.0, 2500.0, 200.0], [2, 3, 5]), ([31.0, 27.0, 1.0], [0, 1, 4])] {
        let close = |found: f64, expected: f64| {
            assert!((found - expected).abs() < 2e-4 * xx, "{found} {expected}");
        };
        let of = |output: usize, cell: usize| -> f64 { cells.outputs[output][cell] };
        close(of(o, 0), xx);
        close(of(p, 0), yy);
        close(of(q, 0), xy);
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let (along, across) = (cosine * half - sine * xy, sine * half + cosine * xy);
        close(of(o, 1), mean + along);
        close(of(p, 1), mean - along);
        close(of(q, 1), across);
    }
}

#[test]
fn zero_strain_and_unwanted_columns() {
    let handle = load("builtin");
    let mut cells = swelling(&handle, 3);
    cells.thermal_strain = vec![0.0; 3];
    let status = cells.advance_with(&handle, |tables| {
        (tables.step.total_thermal_strain, tables.stress[0]) = (NOT_GIVEN, UNWANTED);
        (tables.step.outside, tables.step.distance) = (null_mut(), null());
    });
    assert_eq!(status, MSDD_OK, "{}", last_error());
    assert!(cells.outputs[2] == [-7.0; 3] && cells.outside == [9; 3] && cells.outputs[3][2] > 0.0);
    assert_eq!(cells.next, cells.state);
    // No strain is a strain of 0.
    let (mut none, stress) = (cells.clone(), cells.outputs[3].clone());
    let absent = none.advance_with(&handle, |tables| {
        (tables.step.thermal_strain, tables.step.total_thermal_strain) = (NOT_GIVEN, NOT_GIVEN);
        (tables.step.strain, tables.step.rotation) = (null(), null());
    });
    assert_eq!((absent, &none.outputs[3]), (MSDD_OK, &stress));
    let none = cells.advance_with(&handle, |tables| {
        (tables.step.cells, tables.step.thermal_strain) = (0, NOT_GIVEN);
    });
    assert_eq!(none, MSDD_OK);
}

/// The tangent is the derivative of the stress that is answered, for all three strains. The paper's model has no tangent, and
/// the message says so.
#[test]
fn the_tangent_is_the_derivative_of_the_stress() {
    let handle = load("builtin");
    // SAFETY: live.
    assert_eq!(unsafe { msdd_model_has_tangent(handle.0) }, 1);
    let start = {
        let mut cells = swelling(&handle, 5);
        (cells.thermal_strain, cells.total) = (vec![0.0; 5], vec![0.0; 5]);
        cells
    };
    let base = [[-1e-4; 5], [2e-4; 5], [3e-4; 5]];
    let strained = |moved: [[f64; 5]; 3], wants: bool| {
        let mut cells = start.clone();
        cells.strain = [moved[0].to_vec(), moved[1].to_vec(), moved[2].to_vec(), vec![0.0; 5]];
        let status = cells.advance_with(&handle, |tables| {
            if !wants {
                (tables.step.tangent, tables.step.spread) = (null(), UNWANTED);
            }
        });
        assert_eq!(status, MSDD_OK, "{}", last_error());
        cells
    };
    let stress = |moved: [[f64; 5]; 3], wants: bool| {
        let cells = strained(moved, wants);
        [2, 3, 5].map(|output| cells.outputs[output].clone())
    };
    let here = strained(base, true);
    let (tangent, spread) = (&here.outputs[6..], &here.spread);
    assert_eq!(stress(base, true), stress(base, false), "the same stress with and without tangent");
    let h = 1e-8;
    let sides = [0, 1, 2].map(|j| {
        [-h, h].map(|by| {
            let mut moved = base;
            moved[j].iter_mut().for_each(|value| *value += by);
            stress(moved, false)
        })
    });
    for (j, [low, high]) in sides.iter().enumerate() {
        for i in 0..3 {
            for cell in 0..5 {
                let (found, slope) = (tangent[3 * i + j][cell], -(high[i][cell] - low[i][cell]) / (2.0 * h));
                assert!((found - slope).abs() < 1.0 + 1e-4 * slope.abs(), "{i} {j} {cell}: {found} {slope}");
            }
        }
    }
    assert!((0..5).all(|cell| tangent[0][cell] > 1e3 && tangent[4][cell] > 1e3), "stiff in Pa: {tangent:?}");
    assert!(spread.iter().all(|s| *s > 0.0 && *s < 1.0));
    let paper = load("builtin:paper");
    let status = swelling(&paper, 5).advance_of(paper.0, &MATERIAL, true, |_| ());
    assert_eq!(status, MSDD_INVALID_ARGUMENT);
    assert!(last_error().contains("no mechanical tangent"), "{}", last_error());
}

#[test]
fn strings_and_solid_fraction() {
    let handle = load("builtin");
    // SAFETY: live or null handle.
    let (hash, description, none) =
        unsafe { (msdd_model_hash(handle.0), msdd_model_describe(handle.0), msdd_model_hash(null())) };
    assert!(none.is_null());
    assert_eq!(text(hash).len(), 64);
    assert!(text(description).contains(&text(hash)) && text(description).contains("provenance"));
    // SAFETY: no conditions.
    let (version, abi_version) = unsafe { (msdd_version(), msdd_abi_version()) };
    assert_eq!((text(version).as_str(), abi_version), (env!("CARGO_PKG_VERSION"), abi::MSDD_ABI_VERSION));
    // SAFETY: live handle.
    let name = |column| unsafe { msdd_model_state_name(handle.0, column) };
    assert_eq!([text(name(0)), text(name(1))], ["porosity", "fabric_index"]);
    assert!(name(99).is_null());
    let (porosity, mut solid) = ([0.125; 9], [0.0; 9]);
    // SAFETY: live handle, columns of nine.
    let status = unsafe { msdd_model_solid_fraction(handle.0, 9, porosity.as_ptr(), solid.as_mut_ptr()) };
    assert!(status == MSDD_OK && solid.iter().all(|s| *s > 0.875 && *s < 0.95), "{solid:?}");
}

/// Least and largest value by the C interface, or the status.
fn compared(hash: &CStr, quantity: &CStr) -> Result<[f64; 2], i32> {
    let [mut least, mut most] = [f64::NAN; 2];
    // SAFETY: C strings and writable numbers.
    match unsafe { msdd_compared(hash.as_ptr(), quantity.as_ptr(), &mut least, &mut most) } {
        MSDD_OK => Ok([least, most]),
        status => Err(status),
    }
}

#[test]
fn the_ranges_that_were_compared_are_told_by_the_hash_of_the_model() {
    let model = load("builtin");
    // SAFETY: live, and owned by the model.
    let hash = unsafe { CStr::from_ptr(msdd_model_hash(model.0)) };
    let [least, most] = compared(hash, c"reduced_pressure").expect("compared");
    assert!(0.0 < least && least < 0.03 && most > 0.09, "{least} {most}");
    assert_eq!(compared(hash, c"heat_source"), Ok([0.0, 0.0]));
    assert_eq!(compared(hash, c"temperature"), Err(MSDD_INVALID_ARGUMENT));
    assert!(last_error().contains("grains_across"), "{}", last_error());
    assert_eq!(compared(c"0123", c"heat_source"), Err(MSDD_INVALID_ARGUMENT));
    let gas = |name: *const c_char, t| {
        let mut found = f64::NAN;
        // SAFETY: C strings or null, and a writable number.
        (unsafe { msdd_gas_conductivity(name, t, &mut found) }, found)
    };
    let (status, helium) = gas(c"helium".as_ptr(), 300.0);
    assert!(status == MSDD_OK && (helium - 0.154).abs() < 0.003, "{helium}");
    let least = gas(c"helium".as_ptr(), 273.0);
    assert_eq!(gas(c"helium".as_ptr(), 20.0), least);
    assert_eq!(gas(null(), 300.0), (MSDD_OK, 0.0));
    assert_eq!(gas(c"neon".as_ptr(), 300.0).0, MSDD_INVALID_ARGUMENT);

    let flowing = |name: *const c_char, t| {
        let mut found = [f64::NAN; 6];
        // SAFETY: C strings or null, and six writable numbers.
        (unsafe { msdd_gas_properties(name, t, found.as_mut_ptr()) }, found)
    };
    let (status, [_, conductivity, heat_capacity, molar_mass, least, most]) =
        flowing(c"helium".as_ptr(), 300.0);
    assert_eq!((status, conductivity, [least, most]), (MSDD_OK, helium, [273.0, 1800.0]));
    assert!((heat_capacity * molar_mass / 8.314_462_618 - 2.5).abs() < 1e-12, "{heat_capacity} {molar_mass}");
    assert_eq!(flowing(c"vacuum".as_ptr(), 300.0).0, MSDD_INVALID_ARGUMENT);
    assert_eq!(flowing(null(), 300.0).0, MSDD_INVALID_ARGUMENT);
}
