//! Models and cells for tests through the C interface.
#![allow(dead_code)] // each test uses a part

use msdd::abi::{self, msdd_grains, msdd_input, msdd_model, msdd_output, msdd_start, msdd_step};
use msdd::exports::*;
use std::ffi::{CStr, CString, c_char};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr::{null, null_mut};

pub const OK: i32 = abi::MSDD_OK as i32;

/// Discs.
pub const MATERIAL: msdd_grains = msdd_grains {
    struct_size: size_of::<msdd_grains>(),
    conductivity: 100.0,
    young_modulus: 1e7,
    radius: 5e-3,
    poisson_ratio: 0.0,
    roughness: 0.0,
    hardness: 0.0,
    gas: null(),
    gas_pressure: 0.0,
    accommodation: 0.0,
    emissivity: 0.0,
    size_spread: 0.0,
};

/// Columns that are not given or not wanted.
pub const NOT_GIVEN: msdd_input = msdd_input { values: null(), stride: 1 };
pub const UNWANTED: msdd_output = msdd_output { values: null_mut(), stride: 1 };

/// A step and a start of nothing.
pub const STEP: msdd_step = msdd_step {
    struct_size: size_of::<msdd_step>(),
    cells: 0,
    components: 3,
    state: null(),
    thermal_strain: NOT_GIVEN,
    total_thermal_strain: NOT_GIVEN,
    strain: null(),
    rotation: null(),
    temperature: NOT_GIVEN,
    solid_conductivity: NOT_GIVEN,
    emissivity: NOT_GIVEN,
    next_state: null(),
    stress: null(),
    tangent: null(),
    conductivity: null(),
    gas_conductivity: UNWANTED,
    radiation_conductivity: UNWANTED,
    solid_fraction: UNWANTED,
    spread: UNWANTED,
    distance: null(),
    outside: null_mut(),
    outside_cells: 99,
};
pub const START: msdd_start = msdd_start {
    struct_size: size_of::<msdd_start>(),
    cells: 0,
    components: 3,
    porosity: NOT_GIVEN,
    fabric_index: NOT_GIVEN,
    fabric_xy: NOT_GIVEN,
    solid_fraction: NOT_GIVEN,
    stress: null(),
    conductivity: null(),
    fabric: null(),
    coordination: NOT_GIVEN,
    mobilised: NOT_GIVEN,
};

pub fn input(column: &[f64]) -> msdd_input {
    msdd_input { values: column.as_ptr(), stride: 1 }
}

pub fn output(column: &mut [f64]) -> msdd_output {
    msdd_output { values: column.as_mut_ptr(), stride: 1 }
}

pub fn inputs(columns: &[Vec<f64>]) -> Vec<msdd_input> {
    columns.iter().map(|column| input(column)).collect()
}

pub fn outputs(columns: &mut [Vec<f64>]) -> Vec<msdd_output> {
    columns.iter_mut().map(|column| output(column)).collect()
}

/// A loaded model, freed at the end.
pub struct Model(pub *mut msdd_model);

// SAFETY: the header allows any number of threads to use a model at a time.
unsafe impl Sync for Model {}

impl Model {
    pub fn load(source: &str) -> Result<Self, (i32, String)> {
        let (source, mut out) = (CString::new(source).expect("no NUL"), null_mut());
        // SAFETY: a C string, and `out` is writable.
        match unsafe { msdd_model_load(source.as_ptr(), &mut out) } {
            OK => Ok(Self(out)),
            status => {
                assert!(out.is_null());
                Err((status, last_error()))
            }
        }
    }

    pub fn columns(&self) -> usize {
        // SAFETY: live.
        unsafe { msdd_model_state_size(self.0) }
    }

    pub fn has_tangent(&self) -> bool {
        // SAFETY: live.
        unsafe { msdd_model_has_tangent(self.0) == 1 }
    }

    pub fn text(&self, of: unsafe extern "C" fn(*const msdd_model) -> *const c_char) -> String {
        // SAFETY: live.
        text(unsafe { of(self.0) })
    }
}

impl Drop for Model {
    fn drop(&mut self) {
        // SAFETY: live, and used no more.
        unsafe { msdd_model_free(self.0) };
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

/// A step, and the tables that it points to.
pub struct Tables {
    pub step: msdd_step,
    pub state: Vec<msdd_input>,
    pub strain: [msdd_input; 3],
    pub rotation: [msdd_input; 1],
    pub next_state: Vec<msdd_output>,
    pub conductivity: [msdd_output; 3],
    pub stress: [msdd_output; 3],
    pub tangent: Vec<msdd_output>,
    pub distance: Vec<msdd_output>,
}

impl Tables {
    /// The state after the step replaces the state before.
    pub fn in_place(&mut self) {
        for (after, before) in self.next_state.iter_mut().zip(&self.state) {
            after.values = before.values.cast_mut();
        }
    }
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
    pub distance: Vec<Vec<f64>>,
    pub spread: Vec<f64>,
    pub outside: Vec<u8>,
    pub outside_cells: usize,
}

impl Cells {
    /// Cells of many porosities and fabric indices in the initial state of a model, and small strains.
    pub fn new(model: &Model, cells: usize) -> Self {
        let column = |start: f64, step: f64, count: usize| -> Vec<f64> {
            (0..cells).map(|i| start + step * (i % count) as f64).collect()
        };
        let (porosity, fabric_index) = (column(0.09, 1e-3, 70), column(0.05, -2e-3, 47));
        let mut state = vec![vec![-7.0; cells]; model.columns()];
        let columns = outputs(&mut state);
        let start =
            msdd_start { cells, porosity: input(&porosity), fabric_index: input(&fabric_index), ..START };
        // SAFETY: live handle, full structs, columns of `cells` values.
        let status = unsafe { msdd_model_initial_state(model.0, &MATERIAL, &start, columns.as_ptr()) };
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
            distance: vec![vec![-7.0; cells]; model.columns() + 1],
            spread: vec![-7.0; cells],
            outside: vec![9; cells],
            outside_cells: 99,
        }
    }

    /// Advances with `change` made to the step; returns the status.
    pub fn advance_with(&mut self, model: &Model, change: impl FnOnce(&mut Tables)) -> i32 {
        self.advance_of(model.0, &MATERIAL, model.has_tangent(), change)
    }

    /// As [`Cells::advance_with`] with any handle and grains, null ones, too.
    pub fn advance_of(
        &mut self,
        model: *const msdd_model,
        material: *const msdd_grains,
        deforms: bool,
        change: impl FnOnce(&mut Tables),
    ) -> i32 {
        let [kxx, kyy, sxx, syy, kxy, sxy, tangent @ ..] = &mut self.outputs;
        let [xx, yy, xy, rotation] = &self.strain;
        let mut tables = Tables {
            state: inputs(&self.state),
            strain: [xx, yy, xy].map(|column| input(column)),
            rotation: [input(rotation)],
            next_state: outputs(&mut self.next),
            conductivity: [kxx, kyy, kxy].map(|column| output(column)),
            stress: [sxx, syy, sxy].map(|column| output(column)),
            tangent: outputs(tangent),
            distance: outputs(&mut self.distance),
            step: msdd_step {
                cells: self.outside.len(),
                thermal_strain: input(&self.thermal_strain),
                total_thermal_strain: input(&self.total),
                spread: output(&mut self.spread),
                outside: self.outside.as_mut_ptr(),
                ..STEP
            },
        };
        let (strain, rotation) = (tables.strain.as_ptr(), tables.rotation.as_ptr());
        tables.step = msdd_step {
            state: tables.state.as_ptr(),
            strain: if deforms { strain } else { null() },
            rotation: if deforms { rotation } else { null() },
            next_state: tables.next_state.as_ptr(),
            conductivity: tables.conductivity.as_ptr(),
            stress: tables.stress.as_ptr(),
            tangent: if deforms { tables.tangent.as_ptr() } else { null() },
            distance: tables.distance.as_ptr(),
            ..tables.step
        };
        change(&mut tables);
        // SAFETY: null or live handle, null or full structs, columns of `cells` values.
        let status = unsafe { msdd_model_advance(model, material, &mut tables.step) };
        self.outside_cells = tables.step.outside_cells;
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
            distance: self.distance.iter().map(|_| vec![-7.0; count]).collect(),
            spread: vec![-7.0; count],
            outside: vec![9; count],
            outside_cells: 99,
        }
    }

    /// Bits of all outputs of a cell.
    pub fn bits(&self, cell: usize) -> Vec<u64> {
        let columns = self.next.iter().chain(&self.outputs).chain(&self.distance).chain([&self.spread]);
        columns.map(|column| column[cell].to_bits()).chain([u64::from(self.outside[cell])]).collect()
    }
}

/// Compiles a C file of the repository into a shared library; returns what to load.
pub fn plugin(source: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let name = Path::new(source).file_stem().expect("a name").to_string_lossy().into_owned();
    let folder = option_env!("CARGO_TARGET_TMPDIR").map_or_else(std::env::temp_dir, PathBuf::from);
    let out = folder.join(format!("{name}-{}.so", std::process::id()));
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

/// Source of the built-in model as a plug-in. It is a dev-dependency, so its shared library lies next to the tests.
pub fn exported() -> String {
    let test = std::env::current_exe().expect("running");
    let library: PathBuf = test.parent().expect("a folder").join("libmsdd_exported.so");
    format!("plugin:{}", library.display())
}
