use crate::abi;
use crate::abi::{msdd_averages, msdd_batch, msdd_initial, msdd_material, msdd_rve, msdd_surrogate};
use crate::exports::*;
use crate::status::status;
use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

/// The header's constants as statuses.
const MSDD_OK: i32 = abi::MSDD_OK as i32;
const MSDD_INVALID_ARGUMENT: i32 = abi::MSDD_INVALID_ARGUMENT as i32;
const MSDD_IO: i32 = abi::MSDD_IO as i32;
const MSDD_MODEL: i32 = abi::MSDD_MODEL as i32;
const MSDD_NON_FINITE: i32 = abi::MSDD_NON_FINITE as i32;
const MSDD_RVE: i32 = abi::MSDD_RVE as i32;
const MSDD_CANCELLED: i32 = abi::MSDD_CANCELLED as i32;
const MSDD_INTERNAL: i32 = abi::MSDD_INTERNAL as i32;

/// A loaded model, freed at the end.
struct Handle(*mut msdd_surrogate);

impl Handle {
    fn load(source: &CStr) -> Self {
        let mut out = null_mut();
        // SAFETY: a C string, and `out` is writable.
        let status = unsafe { msdd_surrogate_load(source.as_ptr(), &mut out) };
        assert_eq!(status, MSDD_OK, "{}", last_error());
        Self(out)
    }

    fn builtin() -> Self {
        Self::load(c"builtin")
    }

    fn columns(&self) -> usize {
        // SAFETY: live.
        unsafe { msdd_surrogate_state_size(self.0) }
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: live, and used no more.
        unsafe { msdd_surrogate_free(self.0) };
    }
}

fn text(pointer: *const c_char) -> String {
    // SAFETY: exports return C strings.
    unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned()
}

fn last_error() -> String {
    // SAFETY: no conditions.
    text(unsafe { msdd_last_error() })
}

const MATERIAL: msdd_material = msdd_material {
    struct_size: size_of::<msdd_material>(),
    thermal_conductivity: 100.0,
    young_modulus: 1e7,
    mean_radius: 5e-3,
};

/// Cells with all columns; outputs start as −7.
#[derive(Clone, Debug, PartialEq)]
struct Cells {
    state: Vec<Vec<f64>>,
    strain: Vec<f64>,
    total: Vec<f64>,
    next: Vec<Vec<f64>>,
    /// K_xx, K_yy, σ_xx, σ_yy.
    outputs: [Vec<f64>; 4],
    outside: Vec<Vec<f64>>,
    clamped: Vec<u8>,
    clamped_cells: usize,
}

impl Cells {
    /// Cells in the initial state of `handle`'s model.
    fn new(handle: &Handle, cells: usize) -> Self {
        let column =
            |start: f64, slope: f64| (0..cells).map(|i| start + slope * i as f64).collect::<Vec<f64>>();
        let (porosity, fabric_index) = (column(0.12, 1e-3), column(0.045, -2e-3));
        let mut state = vec![vec![-7.0; cells]; handle.columns()];
        let pointers: Vec<*mut f64> = state.iter_mut().map(|c| c.as_mut_ptr()).collect();
        let initial = msdd_initial {
            struct_size: size_of::<msdd_initial>(),
            cells,
            porosity: porosity.as_ptr(),
            fabric_index: fabric_index.as_ptr(),
            fabric_conductivity: null(),
            stress_xx: null(),
            stress_yy: null(),
        };
        // SAFETY: live handle, full structs, columns of `cells` values.
        let status =
            unsafe { msdd_surrogate_initial_state(handle.0, &MATERIAL, &initial, pointers.as_ptr()) };
        assert_eq!(status, MSDD_OK, "{}", last_error());
        assert_eq!(state[..2], [porosity, fabric_index]);
        Self {
            state,
            strain: column(1e-3, -1e-4),
            total: column(0.01, 1e-3),
            next: vec![vec![-7.0; cells]; handle.columns()],
            outputs: std::array::from_fn(|_| vec![-7.0; cells]),
            outside: vec![vec![-7.0; cells]; handle.columns() + 1],
            clamped: vec![9; cells],
            clamped_cells: 99,
        }
    }

    /// Calls `with` with a batch of all columns, which live as long as the call.
    fn with_batch(&mut self, with: impl FnOnce(&mut msdd_batch) -> i32) -> i32 {
        let state: Vec<*const f64> = self.state.iter().map(|c| c.as_ptr()).collect();
        let next: Vec<*mut f64> = self.next.iter_mut().map(|c| c.as_mut_ptr()).collect();
        let outside: Vec<*mut f64> = self.outside.iter_mut().map(|c| c.as_mut_ptr()).collect();
        let [conductivity_xx, conductivity_yy, stress_xx, stress_yy] =
            self.outputs.each_mut().map(|c| c.as_mut_ptr());
        let mut batch = msdd_batch {
            struct_size: size_of::<msdd_batch>(),
            cells: self.clamped.len(),
            state: state.as_ptr(),
            thermal_strain: self.strain.as_ptr(),
            total_thermal_strain: self.total.as_ptr(),
            strain_xx: null(),
            strain_yy: null(),
            virgin_share: null(),
            next_state: next.as_ptr(),
            conductivity_xx,
            conductivity_yy,
            stress_xx,
            stress_yy,
            c11: null_mut(),
            c22: null_mut(),
            c12: null_mut(),
            porosity_rate: null_mut(),
            fabric_index_rate: null_mut(),
            clamped: self.clamped.as_mut_ptr(),
            outside: outside.as_ptr(),
            spread: null_mut(),
            clamped_cells: 99,
        };
        let status = with(&mut batch);
        self.clamped_cells = batch.clamped_cells;
        status
    }

    fn advance(&mut self, handle: &Handle) -> i32 {
        // SAFETY: live handle, full structs, columns of `cells` values.
        self.with_batch(|batch| unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) })
    }
}

const MODELS: [&CStr; 2] = [c"builtin", c"builtin:paper"];

#[test]
fn answers_are_the_models_in_si() {
    for name in MODELS {
        let handle = Handle::load(name);
        let mut cells = Cells::new(&handle, 11);
        cells.state[0][9] = 1e300;
        assert_eq!(cells.advance(&handle), MSDD_OK, "{}", last_error());
        let model = ::msdd_surrogate::models::builtin(name.to_str().expect("ASCII")).expect("shipped");
        for cell in 0..11 {
            let mut state = [0.0; 6];
            state.iter_mut().zip(&cells.state).for_each(|(value, column)| *value = column[cell]);
            let expected = model.evaluate(&state, cells.strain[cell]);
            let scale = 1e7 * 5e-3 * (1.0 + cells.total[cell]);
            let close = |o: usize, value: f64| {
                let found: f64 = cells.outputs[o][cell];
                assert!((found - value).abs() <= 1e-14 * value.abs(), "{name:?} {o}: {found} {value}");
            };
            for (column, lanes) in cells.next.iter().zip(&expected.state) {
                assert_eq!(column[cell].to_bits(), lanes[0].to_bits());
            }
            for k in [0, 1] {
                close(k, 100.0 * expected.conductivity[k][0]);
                close(2 + k, scale * expected.stress[k][0]);
            }
            assert_eq!(cells.clamped[cell], u8::from(cell == 9), "{name:?} {cell} {expected:?}");
            assert_eq!(cells.outside[0][cell] > 1.0, cell == 9);
        }
        assert_eq!(cells.clamped_cells, 1);
    }
}

#[test]
fn an_answer_does_not_depend_on_its_batch() {
    let handle = Handle::builtin();
    let mut all = Cells::new(&handle, 21);
    assert_eq!(all.advance(&handle), MSDD_OK);
    for cell in 0..21 {
        let mut one = Cells::new(&handle, 1);
        one.state = all.state.iter().map(|column| vec![column[cell]]).collect();
        (one.strain, one.total) = (vec![all.strain[cell]], vec![all.total[cell]]);
        assert_eq!(one.advance(&handle), MSDD_OK);
        for (single, batch) in one.outputs.iter().chain(&one.next).zip(all.outputs.iter().chain(&all.next)) {
            assert_eq!(single[0].to_bits(), batch[cell].to_bits());
        }
    }
}

#[test]
fn a_state_may_advance_in_place() {
    let handle = Handle::builtin();
    let (mut apart, mut shared) = (Cells::new(&handle, 19), Cells::new(&handle, 19));
    assert_eq!(apart.advance(&handle), MSDD_OK);
    let status = shared.with_batch(|batch| {
        batch.next_state = batch.state.cast();
        // SAFETY: live handle, full structs, columns of `cells` values.
        unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
    });
    assert_eq!(status, MSDD_OK);
    assert_eq!(shared.state, apart.next);
    assert_eq!(shared.outputs, apart.outputs);
}

#[test]
fn virgin_strains_slide_and_others_hardly() {
    let handle = Handle::builtin();
    let with = |share: Option<f64>| {
        let mut cells = Cells::new(&handle, 19);
        let column = share.map(|share| vec![share; 19]);
        let status = cells.with_batch(|batch| {
            batch.virgin_share = column.as_ref().map_or(null(), |column| column.as_ptr());
            // SAFETY: live handle, full structs, columns of `cells` values.
            unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
        });
        assert_eq!(status, MSDD_OK, "{}", last_error());
        cells.next
    };
    let [all, half, none] = [1.0, 0.5, 0.0].map(|share| with(Some(share)));
    assert_eq!(with(None), all);
    // Porosity and pressure do not know the difference; fabric index, f_K and deviator do.
    assert!(none[0] == all[0] && none[2] == all[2]);
    for column in [1, 3, 4] {
        let cell = 3;
        let [all, half, none] = [&all, &half, &none].map(|next| next[column][cell]);
        assert!((none - all).abs() > 1e-8 && (half - 0.5 * (all + none)).abs() < 1e-12, "{column}");
    }
}

#[test]
fn zero_strain_and_unwanted_columns() {
    let handle = Handle::builtin();
    let mut cells = Cells::new(&handle, 3);
    cells.strain = vec![0.0; 3];
    let status = cells.with_batch(|batch| {
        (batch.total_thermal_strain, batch.stress_xx) = (null(), null_mut());
        (batch.clamped, batch.outside) = (null_mut(), null());
        // SAFETY: live handle, full structs, columns null or of `cells` values.
        unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
    });
    assert_eq!(status, MSDD_OK, "{}", last_error());
    assert!(cells.outputs[2] == [-7.0; 3] && cells.clamped == [9; 3] && cells.outputs[3][2] > 0.0);
    assert_eq!(cells.next, cells.state);
    let none = cells.with_batch(|batch| {
        (batch.cells, batch.thermal_strain) = (0, null());
        // SAFETY: no cells, so no column is touched.
        unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
    });
    assert_eq!(none, MSDD_OK);
}

/// Closing along x stiffens, hardens and packs, as the tangent says; the paper's model has none and says so.
#[test]
fn mechanical_strain_follows_the_tangent() {
    let handle = Handle::builtin();
    // SAFETY: live.
    assert_eq!(unsafe { msdd_surrogate_has_tangent(handle.0) }, 1);
    let mut cells = Cells::new(&handle, 5);
    (cells.strain, cells.total) = (vec![0.0; 5], vec![0.0; 5]);
    let mut start = cells.clone();
    assert_eq!(start.advance(&handle), MSDD_OK);
    let (closing, mut tangent) = ([-1e-4; 5], [[0.0; 5]; 5]);
    let mut spread = [-7.0; 5];
    let status = cells.with_batch(|batch| {
        batch.strain_xx = closing.as_ptr();
        let [c11, c22, c12, porosity_rate, fabric_index_rate] = tangent.each_mut().map(|c| c.as_mut_ptr());
        (batch.c11, batch.c22, batch.c12) = (c11, c22, c12);
        (batch.porosity_rate, batch.fabric_index_rate) = (porosity_rate, fabric_index_rate);
        batch.spread = spread.as_mut_ptr();
        // SAFETY: live handle, full structs, columns of `cells` values.
        unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
    });
    assert_eq!(status, MSDD_OK, "{}", last_error());
    for cell in 0..5 {
        let rise = cells.outputs[2][cell] - start.outputs[2][cell];
        let expected = 1e-4 * tangent[0][cell];
        assert!((rise / expected - 1.0).abs() < 0.02, "{rise} {expected}");
        let lateral = cells.outputs[3][cell] - start.outputs[3][cell];
        assert!((lateral / (1e-4 * tangent[2][cell]) - 1.0).abs() < 0.02, "{lateral}");
        assert!(cells.next[0][cell] < start.next[0][cell] && tangent[1][cell] > 0.0);
        assert!(spread[cell] > 0.0 && spread[cell] < 1.0);
    }
    let paper = Handle::load(c"builtin:paper");
    let mut cells = Cells::new(&paper, 5);
    let status = cells.with_batch(|batch| {
        batch.strain_yy = closing.as_ptr();
        // SAFETY: live handle, full structs, columns of `cells` values.
        unsafe { msdd_surrogate_advance(paper.0, &MATERIAL, batch) }
    });
    assert_eq!(status, MSDD_INVALID_ARGUMENT);
    assert!(last_error().contains("no mechanical tangent"), "{}", last_error());
}

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

/// At the ends of the allowed scales K and stresses are numbers above zero; beyond, the scale is refused with its range.
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
        assert!(cells.outputs.iter().flatten().all(|value| value.is_normal() && *value > 0.0), "{cells:?}");
        let (mut porosity, mut fabric_index) = ([0.12; 2], [0.0; 2]);
        let (stress, mut rest) = ([-1e30, 1e30], [[0.0; 2]; 3]);
        let state = [&mut porosity, &mut fabric_index].map(|column| column.as_mut_ptr());
        let state: Vec<*mut f64> = state.into_iter().chain(rest.each_mut().map(|c| c.as_mut_ptr())).collect();
        let initial = msdd_initial {
            struct_size: size_of::<msdd_initial>(),
            cells: 2,
            porosity: state[0],
            fabric_index: state[1],
            fabric_conductivity: null(),
            stress_xx: stress.as_ptr(),
            stress_yy: stress.as_ptr(),
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

/// What no packing has is no start: the first such cell is named, and nothing is written.
#[test]
fn a_start_that_no_packing_has_is_refused() {
    for source in [c"builtin", c"builtin:paper"] {
        let handle = Handle::load(source);
        let refused = |column: usize, value: f64, expected: &str| {
            let mut columns = [vec![0.12; 11], vec![0.0; 11], vec![0.1; 11], vec![1e3; 11], vec![1e3; 11]];
            columns[column][7] = value;
            let mut state = vec![vec![-7.0; 11]; handle.columns()];
            let pointers: Vec<*mut f64> = state.iter_mut().map(|c| c.as_mut_ptr()).collect();
            let initial = msdd_initial {
                struct_size: size_of::<msdd_initial>(),
                cells: 11,
                porosity: columns[0].as_ptr(),
                fabric_index: columns[1].as_ptr(),
                fabric_conductivity: columns[2].as_ptr(),
                stress_xx: columns[3].as_ptr(),
                stress_yy: columns[4].as_ptr(),
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
        refused(2, 1.5, "fabric_conductivity[7] = 1.5, allowed: -1 to 1");
        refused(3, -2e30, "stress_xx[7] = -2e30, allowed: -1e30 to 1e30 Pa");
        refused(4, 1e300, "stress_yy[7] = 1e300, allowed: -1e30 to 1e30 Pa");
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
fn strings_and_solid_fraction() {
    let handle = Handle::builtin();
    // SAFETY: live or null handle.
    let (hash, description, none) = unsafe {
        (msdd_surrogate_hash(handle.0), msdd_surrogate_describe(handle.0), msdd_surrogate_hash(null()))
    };
    assert!(none.is_null());
    assert_eq!(text(hash).len(), 64);
    assert!(text(description).contains(&text(hash)) && text(description).contains("provenance"));
    // SAFETY: no conditions.
    let (version, abi_version) = unsafe { (msdd_version(), msdd_abi_version()) };
    assert_eq!((text(version).as_str(), abi_version), (env!("CARGO_PKG_VERSION"), abi::MSDD_ABI_VERSION));
    // SAFETY: live handle.
    let name = |column| unsafe { msdd_surrogate_state_name(handle.0, column) };
    assert_eq!([text(name(0)), text(name(1))], ["porosity", "fabric_index"]);
    assert!(name(99).is_null());
    let (porosity, mut solid) = ([0.125; 9], [0.0; 9]);
    // SAFETY: live handle, columns of nine.
    let status = unsafe { msdd_surrogate_solid_fraction(handle.0, 9, porosity.as_ptr(), solid.as_mut_ptr()) };
    assert!(status == MSDD_OK && solid.iter().all(|s| *s > 0.875 && *s < 0.95), "{solid:?}");
}

#[test]
fn a_panic_becomes_a_status() {
    assert_eq!(status(|| panic!("deliberate, {}", 42)), MSDD_INTERNAL);
    assert!(last_error().contains("deliberate, 42"));
}

fn pack(specification: &CStr) -> Result<*mut msdd_rve, (i32, String)> {
    let mut rve = null_mut();
    // SAFETY: a C string and a writable pointer.
    match unsafe { msdd_rve_pack(specification.as_ptr(), &mut rve) } {
        MSDD_OK => Ok(rve),
        status => Err((status, last_error())),
    }
}

fn averages(rve: *const msdd_rve) -> msdd_averages {
    // SAFETY: a struct of numbers.
    let mut result: msdd_averages = unsafe { std::mem::zeroed() };
    result.struct_size = size_of::<msdd_averages>();
    // SAFETY: live handle, full struct.
    assert_eq!(unsafe { msdd_rve_homogenise(rve, &mut result) }, MSDD_OK, "{}", last_error());
    result
}

/// An RVE packs, swells, and goes on the same after a trip through text.
#[test]
fn an_rve_from_packing_to_text_and_back() {
    let rve = pack(c"{\"discs\": 60, \"seed\": 3, \"porosity\": 0.13}").expect("packs");
    let (mut twin, mut back, mut json, mut outcome) = (null_mut(), null_mut(), null_mut(), -1);
    // SAFETY: live handles, writable pointers, and each handle freed once at the end.
    unsafe {
        assert_eq!(msdd_rve_clone(rve, &mut twin), MSDD_OK);
        assert_eq!(msdd_rve_to_json(rve, &mut json), MSDD_OK);
        assert_eq!(msdd_rve_from_json(json, &mut back), MSDD_OK, "{}", last_error());
        let start = averages(rve);
        for handle in [rve, twin, back] {
            assert_eq!(msdd_rve_strain(handle, 0.01, 0.0, 0.0, 0.0, &mut outcome), MSDD_OK);
            assert_eq!(outcome, abi::MSDD_SETTLED as i32);
        }
        let end = averages(rve);
        assert!(end.pressure > start.pressure && end.porosity < start.porosity);
        assert_eq!(end.pressure.to_bits(), averages(twin).pressure.to_bits());
        assert_eq!(end.pressure.to_bits(), averages(back).pressure.to_bits());
        // Shear needs a periodic box; the RVE stays as it is.
        assert_eq!(msdd_rve_strain(rve, 0.0, 0.0, 0.0, 0.01, null_mut()), MSDD_INVALID_ARGUMENT);
        assert_eq!(averages(rve).pressure.to_bits(), end.pressure.to_bits());
        msdd_text_free(json);
        [rve, twin, back].into_iter().for_each(|handle| msdd_rve_free(handle));
    }
}

/// Every key of a specification has its default, those of the material among them.
#[test]
fn what_a_specification_leaves_out_is_as_usual() {
    let made = |specification: &CStr| {
        let (rve, mut json) = (pack(specification).expect("packs"), null_mut());
        // SAFETY: a live handle and a writable pointer; both are freed once.
        unsafe {
            assert_eq!(msdd_rve_to_json(rve, &mut json), MSDD_OK);
            let text = text(json);
            msdd_text_free(json);
            msdd_rve_free(rve);
            text
        }
    };
    let whole = made(
        c"{\"discs\": 30, \"porosity\": 0.15, \"material\": {\"density\": 3000, \"young_modulus\": 1e7, \
          \"stiffness_ratio\": 0.8, \"friction_angle\": 0.4, \"wall_stiffness_factor\": 1, \"damping\": 0.1}}",
    );
    let part = made(c"{\"discs\": 30, \"porosity\": 0.15, \"material\": {\"friction_angle\": 0.4}}");
    let usual = made(c"{\"discs\": 30, \"porosity\": 0.15, \"material\": {}}");
    assert!(whole == part && part != usual && usual == made(c"{\"discs\": 30, \"porosity\": 0.15}"));
}

#[test]
fn bad_specifications_and_states_are_refused() {
    let long = CString::new(format!("{{\"discs\": 60, \"x{}\": 1}}", "x".repeat(1 << 20))).expect("no NUL");
    let (status, message) = pack(&long).expect_err("refused");
    assert!(
        status == MSDD_INVALID_ARGUMENT && message.len() < 1000 && message.contains(" and more, allowed: "),
        "{message}"
    );
    for (specification, part) in [
        (c"[]", "specification = [], allowed: a JSON object"),
        (c"[40, 1, 0.12]", "allowed: a JSON object"),
        (c"7", "allowed: a JSON object"),
        (c"{\"material\": []}", "with \"material\" a JSON object"),
        (c"{\"material\": {\"friction\": 0.4}}", "unknown field `friction`"),
        (c"{\"disks\": 60}", "disks"),
        (c"{\"porosity\": 0.9}", "porosity"),
        (c"{\"compression\": \"vertical\"}", "vertical"),
        (c"{", "EOF"),
    ] {
        let (status, message) = pack(specification).expect_err("refused");
        assert!(status == MSDD_INVALID_ARGUMENT && message.contains(part), "{status} {message}");
    }
    let mut out = null_mut();
    // SAFETY: a C string and a writable pointer.
    assert_eq!(unsafe { msdd_rve_from_json(c"{}".as_ptr(), &mut out) }, MSDD_RVE);
    assert!(out.is_null());
}

/// A generation that is stopped after its first packing goes on where it stopped.
#[test]
fn a_database_is_made_in_two_goes() {
    const PLAN: &CStr = c"radius_min = 3e-3\nradius_max = 7e-3\nseed = 5\n[[thermal]]\ndiscs = 40\n\
        porosities = [0.13]\ncompressions = [\"isotropic\"]\nrepeats = 3\nstops = [0.001]\n";
    extern "C" fn stop_after_one(user: *mut std::ffi::c_void, done: u64, total: u64, _failed: u64) -> i32 {
        // SAFETY: `user` is the counter below.
        unsafe { *user.cast::<u64>() += 1 };
        assert_eq!(total, 3);
        i32::from(done == 1)
    }
    let folder = std::env::temp_dir().join(format!("msdd-capi-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("writable");
    let path = CString::new(folder.join("a.msdd").to_string_lossy().as_bytes()).expect("no NUL");
    let csv = CString::new(folder.join("a.csv").to_string_lossy().as_bytes()).expect("no NUL");
    let (mut calls, mut rows) = (0u64, 0u64);
    let user = (&raw mut calls).cast();
    // SAFETY: C strings, a call-back that takes the counter, and writable pointers.
    unsafe {
        let first = msdd_database_generate(PLAN.as_ptr(), path.as_ptr(), 1, Some(stop_after_one), user);
        assert_eq!((first, last_error().as_str()), (MSDD_CANCELLED, "stopped by the progress call-back"));
        assert_eq!(calls, 2);
        assert_eq!(msdd_database_generate(PLAN.as_ptr(), path.as_ptr(), 2, None, null_mut()), MSDD_OK);
        assert_eq!(msdd_database_export_csv(path.as_ptr(), csv.as_ptr(), &mut rows), MSDD_OK);
        assert_eq!(rows, 9);
        assert_eq!(
            msdd_database_generate(c"seed = 1".as_ptr(), path.as_ptr(), 1, None, null_mut()),
            MSDD_RVE
        );
    }
    std::fs::remove_dir_all(&folder).expect("removable");
}
