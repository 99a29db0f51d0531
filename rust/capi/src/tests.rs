use crate::exports::*;
use crate::ffi::*;
use crate::status::status;
use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

/// A loaded model, freed at the end.
struct Handle(*mut msdd_surrogate);

impl Handle {
    fn builtin() -> Self {
        let mut out = null_mut();
        // SAFETY: `out` is writable.
        assert_eq!(unsafe { msdd_surrogate_load(null(), &mut out) }, MSDD_OK, "{}", last_error());
        Self(out)
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
    text(msdd_last_error())
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
    inputs: [Vec<f64>; 4],
    outputs: [Vec<f64>; 6],
    clamped: Vec<u8>,
    clamped_cells: usize,
}

impl Cells {
    fn new(cells: usize) -> Self {
        let column = |start: f64, slope: f64| (0..cells).map(|i| start + slope * i as f64).collect();
        Self {
            inputs: [column(0.12, 1e-3), column(0.05, -2e-3), column(1e-3, -1e-4), column(0.01, 1e-3)],
            outputs: std::array::from_fn(|_| vec![-7.0; cells]),
            clamped: vec![9; cells],
            clamped_cells: 99,
        }
    }

    fn batch(&mut self) -> msdd_batch {
        let [porosity, fabric_index, thermal_strain, total_thermal_strain] =
            self.inputs.each_ref().map(|c| c.as_ptr());
        let [delta_porosity, delta_fabric_index, conductivity_xx, conductivity_yy, stress_xx, stress_yy] =
            self.outputs.each_mut().map(|c| c.as_mut_ptr());
        msdd_batch {
            struct_size: size_of::<msdd_batch>(),
            cells: self.clamped.len(),
            porosity,
            fabric_index,
            thermal_strain,
            total_thermal_strain,
            delta_porosity,
            delta_fabric_index,
            conductivity_xx,
            conductivity_yy,
            stress_xx,
            stress_yy,
            clamped: self.clamped.as_mut_ptr(),
            clamped_cells: 99,
        }
    }

    fn evaluate(&mut self, handle: &Handle) -> i32 {
        let mut batch = self.batch();
        // SAFETY: live handle, full structs, columns of `cells` values.
        let status = unsafe { msdd_surrogate_evaluate(handle.0, &MATERIAL, &mut batch) };
        self.clamped_cells = batch.clamped_cells;
        status
    }
}

#[test]
fn answers_are_the_models_in_si() {
    let (handle, mut cells) = (Handle::builtin(), Cells::new(11));
    cells.inputs[0][9] = 1e300;
    assert_eq!(cells.evaluate(&handle), MSDD_OK, "{}", last_error());
    let model = ::msdd_surrogate::Model::builtin().expect("builtin");
    for cell in 0..11 {
        let [porosity, fabric_index, strain, total] = cells.inputs.each_ref().map(|column| column[cell]);
        let expected = model.evaluate(porosity, fabric_index, strain);
        let scale = 1e7 * 5e-3 * (1.0 + total);
        let close = |o: usize, value: f64| (cells.outputs[o][cell] - value).abs() <= 1e-14 * value.abs();
        assert_eq!(cells.outputs[0][cell], expected.delta_porosity);
        assert_eq!(cells.outputs[1][cell], expected.delta_fabric_index);
        assert!(close(2, 100.0 * expected.conductivity_xx) && close(3, 100.0 * expected.conductivity_yy));
        assert!(close(4, scale * expected.stress_xx) && close(5, scale * expected.stress_yy));
        assert_eq!(cells.clamped[cell], u8::from(cell == 9));
    }
    assert_eq!(cells.clamped_cells, 1);
}

#[test]
fn an_answer_does_not_depend_on_its_batch() {
    let handle = Handle::builtin();
    let mut all = Cells::new(21);
    assert_eq!(all.evaluate(&handle), MSDD_OK);
    for cell in 0..21 {
        let mut one = Cells::new(1);
        one.inputs = all.inputs.each_ref().map(|column| vec![column[cell]]);
        assert_eq!(one.evaluate(&handle), MSDD_OK);
        for (single, batch) in one.outputs.iter().zip(&all.outputs) {
            assert_eq!(single[0].to_bits(), batch[cell].to_bits());
        }
    }
}

#[test]
fn a_column_may_be_input_and_output() {
    let (handle, mut apart, mut shared) = (Handle::builtin(), Cells::new(19), Cells::new(19));
    assert_eq!(apart.evaluate(&handle), MSDD_OK);
    let mut batch = shared.batch();
    batch.delta_porosity = shared.inputs[0].as_mut_ptr();
    batch.porosity = batch.delta_porosity;
    // SAFETY: live handle, full structs, columns of `cells` values.
    assert_eq!(unsafe { msdd_surrogate_evaluate(handle.0, &MATERIAL, &mut batch) }, MSDD_OK);
    assert_eq!(shared.inputs[0], apart.outputs[0]);
    assert_eq!(shared.outputs[5], apart.outputs[5]);
}

#[test]
fn unwanted_columns_and_no_cells_are_fine() {
    let (handle, mut cells) = (Handle::builtin(), Cells::new(3));
    let mut batch = msdd_batch {
        total_thermal_strain: null(),
        stress_xx: null_mut(),
        clamped: null_mut(),
        ..cells.batch()
    };
    // SAFETY: live handle, full structs, columns null or of `cells` values.
    assert_eq!(unsafe { msdd_surrogate_evaluate(handle.0, &MATERIAL, &mut batch) }, MSDD_OK);
    assert!(cells.outputs[4] == [-7.0; 3] && cells.clamped == [9; 3] && cells.outputs[5][2] > 0.0);
    let mut none = msdd_batch { cells: 0, porosity: null(), ..batch };
    // SAFETY: no cells, so no column is touched.
    assert_eq!(unsafe { msdd_surrogate_evaluate(handle.0, &MATERIAL, &mut none) }, MSDD_OK);
}

#[test]
fn bad_input_is_named_and_nothing_is_written() {
    let handle = Handle::builtin();
    let refused = |column: usize, value: f64, expected_status: i32, expected: &str| {
        let mut cells = Cells::new(13);
        cells.inputs[column][10] = value;
        let before = cells.clone();
        assert_eq!(cells.evaluate(&handle), expected_status);
        assert_eq!(last_error(), expected);
        assert!(cells.outputs == before.outputs && cells.clamped == before.clamped);
        assert_eq!(cells.clamped_cells, 99);
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
    let (handle, mut cells) = (Handle::builtin(), Cells::new(4));
    let good = cells.batch();
    let refused = |handle: *const msdd_surrogate,
                   material: *const msdd_material,
                   batch: *mut msdd_batch,
                   expected: &str| {
        // SAFETY: null or live handle, null or full structs, columns null or of `cells` values.
        assert_eq!(unsafe { msdd_surrogate_evaluate(handle, material, batch) }, MSDD_INVALID_ARGUMENT);
        assert!(last_error().contains(expected), "{}", last_error());
    };
    let mut batch = good;
    refused(null(), &MATERIAL, &mut batch, "surrogate is NULL");
    refused(handle.0, null(), &mut batch, "material is NULL");
    refused(handle.0, &MATERIAL, null_mut(), "batch is NULL");
    refused(handle.0, &MATERIAL, &mut msdd_batch { struct_size: 8, ..good }, "batch.struct_size = 8");
    refused(handle.0, &msdd_material { struct_size: 0, ..MATERIAL }, &mut batch, "material.struct_size = 0");
    refused(handle.0, &MATERIAL, &mut msdd_batch { fabric_index: null(), ..good }, "fabric_index is NULL");
    refused(handle.0, &MATERIAL, &mut msdd_batch { cells: usize::MAX, ..good }, "batch.cells");
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(handle.0, &msdd_material { young_modulus: bad, ..MATERIAL }, &mut batch, "young_modulus");
        refused(
            handle.0,
            &msdd_material { thermal_conductivity: bad, ..MATERIAL },
            &mut batch,
            "conductivity",
        );
        refused(handle.0, &msdd_material { mean_radius: bad, ..MATERIAL }, &mut batch, "mean_radius");
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
    assert!(text(description).contains(&text(hash)) && text(description).contains("trained_range"));
    assert_eq!(text(msdd_version()), env!("CARGO_PKG_VERSION"));
    assert_eq!(msdd_abi_version(), MSDD_ABI_VERSION);
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
