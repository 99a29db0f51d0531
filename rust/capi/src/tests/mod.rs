//! The C interface from Rust: models, boxes of grains and databases through their exported functions.

mod answers;
mod refusals;
mod rves;
mod spheres;

use crate::abi::{self, msdd_batch, msdd_initial, msdd_material, msdd_surrogate};
use crate::exports::*;
use std::ffi::{CStr, c_char};
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
    /// K_xx, K_yy, σ_xx, σ_yy, K_xy, σ_xy.
    outputs: [Vec<f64>; 6],
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
            fabric_xy: null(),
            stress_xx: null(),
            stress_yy: null(),
            stress_xy: null(),
            conductivity_xx: null(),
            conductivity_yy: null(),
            conductivity_xy: null(),
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
        let [conductivity_xx, conductivity_yy, stress_xx, stress_yy, conductivity_xy, stress_xy] =
            self.outputs.each_mut().map(|c| c.as_mut_ptr());
        let mut batch = msdd_batch {
            struct_size: size_of::<msdd_batch>(),
            cells: self.clamped.len(),
            state: state.as_ptr(),
            thermal_strain: self.strain.as_ptr(),
            total_thermal_strain: self.total.as_ptr(),
            strain_xx: null(),
            strain_yy: null(),
            strain_xy: null(),
            rotation: null(),
            next_state: next.as_ptr(),
            conductivity_xx,
            conductivity_yy,
            conductivity_xy,
            stress_xx,
            stress_yy,
            stress_xy,
            tangent: null(),
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
