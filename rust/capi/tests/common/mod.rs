//! Models and cells for tests through the C interface.
#![allow(dead_code)] // each test uses a part

use msdd::abi::{self, msdd_batch, msdd_initial, msdd_material, msdd_surrogate};
use msdd::exports::*;
use std::ffi::{CStr, CString, c_char};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr::{null, null_mut};

pub const OK: i32 = abi::MSDD_OK as i32;

pub const MATERIAL: msdd_material = msdd_material {
    struct_size: size_of::<msdd_material>(),
    thermal_conductivity: 100.0,
    young_modulus: 1e7,
    mean_radius: 5e-3,
};

/// A loaded model, freed at the end.
pub struct Model(pub *mut msdd_surrogate);

// SAFETY: the header allows any number of threads to use a surrogate at a time.
unsafe impl Sync for Model {}

impl Model {
    pub fn load(source: &str) -> Result<Self, (i32, String)> {
        let (source, mut out) = (CString::new(source).expect("no NUL"), null_mut());
        // SAFETY: a C string, and `out` is writable.
        match unsafe { msdd_surrogate_load(source.as_ptr(), &mut out) } {
            OK => Ok(Self(out)),
            status => {
                assert!(out.is_null());
                Err((status, last_error()))
            }
        }
    }

    pub fn columns(&self) -> usize {
        // SAFETY: live.
        unsafe { msdd_surrogate_state_size(self.0) }
    }

    pub fn has_tangent(&self) -> bool {
        // SAFETY: live.
        unsafe { msdd_surrogate_has_tangent(self.0) == 1 }
    }

    pub fn text(&self, of: unsafe extern "C" fn(*const msdd_surrogate) -> *const c_char) -> String {
        // SAFETY: live.
        text(unsafe { of(self.0) })
    }
}

impl Drop for Model {
    fn drop(&mut self) {
        // SAFETY: live, and used no more.
        unsafe { msdd_surrogate_free(self.0) };
    }
}

pub fn text(pointer: *const c_char) -> String {
    // SAFETY: exports return C strings.
    unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned()
}

pub fn last_error() -> String {
    // SAFETY: no conditions.
    text(unsafe { msdd_last_error() })
}

/// Cells with columns for everything; outputs start as −7.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    pub state: Vec<Vec<f64>>,
    pub thermal_strain: Vec<f64>,
    pub total: Vec<f64>,
    /// Mechanical strains xx, yy, xy and the rotation, given to models that have a tangent.
    pub strain: [Vec<f64>; 4],
    pub next: Vec<Vec<f64>>,
    /// K_xx, K_yy, σ_xx, σ_yy, K_xy, σ_xy, and the nine columns of the tangent.
    pub outputs: [Vec<f64>; 15],
    pub outside: Vec<Vec<f64>>,
    pub spread: Vec<f64>,
    pub clamped: Vec<u8>,
    pub clamped_cells: usize,
}

impl Cells {
    /// Cells of many porosities and fabric indices in the initial state of a model, and small strains.
    pub fn new(model: &Model, cells: usize) -> Self {
        let column = |start: f64, step: f64, count: usize| -> Vec<f64> {
            (0..cells).map(|i| start + step * (i % count) as f64).collect()
        };
        let (porosity, fabric_index) = (column(0.09, 1e-3, 70), column(0.05, -2e-3, 47));
        let mut state = vec![vec![-7.0; cells]; model.columns()];
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
        let status = unsafe { msdd_surrogate_initial_state(model.0, &MATERIAL, &initial, pointers.as_ptr()) };
        assert_eq!(status, OK, "{}", last_error());
        assert_eq!(state[..2], [porosity, fabric_index]);
        Self::new_with(model, cells, state)
    }

    /// Cells in a given state.
    pub fn new_with(model: &Model, cells: usize, state: Vec<Vec<f64>>) -> Self {
        let column = |start: f64, step: f64, count: usize| -> Vec<f64> {
            (0..cells).map(|i| start + step * (i % count) as f64).collect()
        };
        Self {
            state,
            thermal_strain: column(1e-3, -1e-4, 23),
            total: column(0.01, 1e-3, 11),
            strain: [
                column(1e-4, -1e-5, 13),
                column(-1e-4, 1e-5, 17),
                column(2e-4, -3e-5, 14),
                column(-1e-4, 2e-5, 12),
            ],
            next: vec![vec![-7.0; cells]; model.columns()],
            outputs: std::array::from_fn(|_| vec![-7.0; cells]),
            outside: vec![vec![-7.0; cells]; model.columns() + 1],
            spread: vec![-7.0; cells],
            clamped: vec![9; cells],
            clamped_cells: 99,
        }
    }

    /// Advances with `change` made to the batch; returns the status.
    pub fn advance_with(&mut self, model: &Model, change: impl FnOnce(&mut msdd_batch)) -> i32 {
        let state: Vec<*const f64> = self.state.iter().map(|c| c.as_ptr()).collect();
        let next: Vec<*mut f64> = self.next.iter_mut().map(|c| c.as_mut_ptr()).collect();
        let outside: Vec<*mut f64> = self.outside.iter_mut().map(|c| c.as_mut_ptr()).collect();
        let [
            conductivity_xx,
            conductivity_yy,
            stress_xx,
            stress_yy,
            conductivity_xy,
            stress_xy,
            tangent @ ..,
        ] = self.outputs.each_mut().map(|c| c.as_mut_ptr());
        let strain = |k: usize| if model.has_tangent() { self.strain[k].as_ptr() } else { null() };
        let mut batch = msdd_batch {
            struct_size: size_of::<msdd_batch>(),
            cells: self.clamped.len(),
            state: state.as_ptr(),
            thermal_strain: self.thermal_strain.as_ptr(),
            total_thermal_strain: self.total.as_ptr(),
            strain_xx: strain(0),
            strain_yy: strain(1),
            strain_xy: strain(2),
            rotation: strain(3),
            next_state: next.as_ptr(),
            conductivity_xx,
            conductivity_yy,
            conductivity_xy,
            stress_xx,
            stress_yy,
            stress_xy,
            tangent: if model.has_tangent() { tangent.as_ptr() } else { null() },
            clamped: self.clamped.as_mut_ptr(),
            outside: outside.as_ptr(),
            spread: self.spread.as_mut_ptr(),
            clamped_cells: 99,
        };
        change(&mut batch);
        // SAFETY: live handle, full structs, columns of `cells` values.
        let status = unsafe { msdd_surrogate_advance(model.0, &MATERIAL, &mut batch) };
        self.clamped_cells = batch.clamped_cells;
        status
    }

    pub fn advance(&mut self, model: &Model) {
        let status = self.advance_with(model, |_| ());
        assert_eq!(status, OK, "{}", last_error());
    }

    /// Cells `first` to `first + count - 1` of these, not yet advanced.
    pub fn part(&self, first: usize, count: usize) -> Self {
        let cut = |column: &Vec<f64>| column[first..first + count].to_vec();
        Self {
            state: self.state.iter().map(cut).collect(),
            thermal_strain: cut(&self.thermal_strain),
            total: cut(&self.total),
            strain: self.strain.each_ref().map(cut),
            next: self.next.iter().map(|_| vec![-7.0; count]).collect(),
            outputs: std::array::from_fn(|_| vec![-7.0; count]),
            outside: self.outside.iter().map(|_| vec![-7.0; count]).collect(),
            spread: vec![-7.0; count],
            clamped: vec![9; count],
            clamped_cells: 99,
        }
    }

    /// Bits of all outputs of a cell.
    pub fn bits(&self, cell: usize) -> Vec<u64> {
        let columns = self.next.iter().chain(&self.outputs).chain(&self.outside).chain([&self.spread]);
        columns.map(|column| column[cell].to_bits()).chain([u64::from(self.clamped[cell])]).collect()
    }
}

/// Compiles a C file of the repository into a shared library; returns what to load.
pub fn plugin(source: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let name = Path::new(source).file_stem().expect("a name").to_string_lossy().into_owned();
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}.so", std::process::id()));
    let status = Command::new(std::env::var("CC").unwrap_or_else(|_| "cc".to_string()))
        .args(["-std=c99", "-O2", "-shared", "-fPIC", "-Wall", "-Wextra", "-Wpedantic", "-Werror"])
        .arg(format!("-I{}", root.join("rust/capi/include").display()))
        .arg(root.join(source))
        .args(["-lm", "-o"])
        .arg(&out)
        .status();
    assert!(status.expect("a C compiler").success(), "{source} does not compile");
    format!("plugin:{}", out.display())
}

/// Source of the built-in model as a plug-in. It is a dev-dependency, so its shared library lies beside the tests.
pub fn exported() -> String {
    let test = std::env::current_exe().expect("running");
    let library: PathBuf = test.parent().expect("a folder").join("libmsdd_exported.so");
    format!("plugin:{}", library.display())
}
