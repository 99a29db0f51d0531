//! Types of `msdd.h`, field by field. `struct_size` catches a drift in size at run time; tests/cpp fills and reads
//! every column from C++.

use ::msdd_surrogate::Model;
use std::ffi::CString;

/// `MSDD_ABI_VERSION`
pub const MSDD_ABI_VERSION: u32 = 1;

/// `enum msdd_status`
pub const MSDD_OK: i32 = 0;
pub const MSDD_INVALID_ARGUMENT: i32 = 1;
pub const MSDD_IO: i32 = 2;
pub const MSDD_MODEL: i32 = 3;
pub const MSDD_NON_FINITE: i32 = 4;
pub const MSDD_INTERNAL: i32 = 255;

/// `msdd_surrogate`: opaque to C.
#[allow(non_camel_case_types)]
pub struct msdd_surrogate {
    pub(crate) model: Model,
    pub(crate) hash: CString,
    pub(crate) description: CString,
}

/// `msdd_material`
#[repr(C)]
#[derive(Clone, Copy)]
#[allow(non_camel_case_types)]
pub struct msdd_material {
    pub struct_size: usize,
    pub thermal_conductivity: f64,
    pub young_modulus: f64,
    pub mean_radius: f64,
}

/// `msdd_batch`
#[repr(C)]
#[derive(Clone, Copy)]
#[allow(non_camel_case_types)]
pub struct msdd_batch {
    pub struct_size: usize,
    pub cells: usize,
    pub porosity: *const f64,
    pub fabric_index: *const f64,
    pub thermal_strain: *const f64,
    pub total_thermal_strain: *const f64,
    pub delta_porosity: *mut f64,
    pub delta_fabric_index: *mut f64,
    pub conductivity_xx: *mut f64,
    pub conductivity_yy: *mut f64,
    pub stress_xx: *mut f64,
    pub stress_yy: *mut f64,
    pub clamped: *mut u8,
    pub clamped_cells: usize,
}
