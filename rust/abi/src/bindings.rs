//! What bindgen makes of `msdd.h`; `cargo test -p msdd-abi --test header` holds it against the header.

pub const MSDD_ABI_VERSION: u32 = 4;
pub const MSDD_PLUGIN_VERSION: u32 = 2;
pub const MSDD_OK: msdd_status = 0;
pub const MSDD_INVALID_ARGUMENT: msdd_status = 1;
pub const MSDD_IO: msdd_status = 2;
pub const MSDD_MODEL: msdd_status = 3;
pub const MSDD_NON_FINITE: msdd_status = 4;
pub const MSDD_RVE: msdd_status = 5;
pub const MSDD_CANCELLED: msdd_status = 6;
pub const MSDD_PLUGIN: msdd_status = 7;
pub const MSDD_INTERNAL: msdd_status = 255;
pub type msdd_status = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_surrogate {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_material {
    pub struct_size: usize,
    pub thermal_conductivity: f64,
    pub young_modulus: f64,
    pub mean_radius: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_material"][::core::mem::size_of::<msdd_material>() - 32usize];
    ["Alignment of msdd_material"][::core::mem::align_of::<msdd_material>() - 8usize];
    [
        "Offset of field: msdd_material::struct_size",
    ][::core::mem::offset_of!(msdd_material, struct_size) - 0usize];
    [
        "Offset of field: msdd_material::thermal_conductivity",
    ][::core::mem::offset_of!(msdd_material, thermal_conductivity) - 8usize];
    [
        "Offset of field: msdd_material::young_modulus",
    ][::core::mem::offset_of!(msdd_material, young_modulus) - 16usize];
    [
        "Offset of field: msdd_material::mean_radius",
    ][::core::mem::offset_of!(msdd_material, mean_radius) - 24usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_batch {
    pub struct_size: usize,
    pub cells: usize,
    pub state: *const *const f64,
    pub thermal_strain: *const f64,
    pub total_thermal_strain: *const f64,
    pub strain_xx: *const f64,
    pub strain_yy: *const f64,
    pub strain_xy: *const f64,
    pub rotation: *const f64,
    pub next_state: *const *mut f64,
    pub conductivity_xx: *mut f64,
    pub conductivity_yy: *mut f64,
    pub conductivity_xy: *mut f64,
    pub stress_xx: *mut f64,
    pub stress_yy: *mut f64,
    pub stress_xy: *mut f64,
    pub tangent: *const *mut f64,
    pub clamped: *mut u8,
    pub outside: *const *mut f64,
    pub spread: *mut f64,
    pub clamped_cells: usize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_batch"][::core::mem::size_of::<msdd_batch>() - 168usize];
    ["Alignment of msdd_batch"][::core::mem::align_of::<msdd_batch>() - 8usize];
    [
        "Offset of field: msdd_batch::struct_size",
    ][::core::mem::offset_of!(msdd_batch, struct_size) - 0usize];
    [
        "Offset of field: msdd_batch::cells",
    ][::core::mem::offset_of!(msdd_batch, cells) - 8usize];
    [
        "Offset of field: msdd_batch::state",
    ][::core::mem::offset_of!(msdd_batch, state) - 16usize];
    [
        "Offset of field: msdd_batch::thermal_strain",
    ][::core::mem::offset_of!(msdd_batch, thermal_strain) - 24usize];
    [
        "Offset of field: msdd_batch::total_thermal_strain",
    ][::core::mem::offset_of!(msdd_batch, total_thermal_strain) - 32usize];
    [
        "Offset of field: msdd_batch::strain_xx",
    ][::core::mem::offset_of!(msdd_batch, strain_xx) - 40usize];
    [
        "Offset of field: msdd_batch::strain_yy",
    ][::core::mem::offset_of!(msdd_batch, strain_yy) - 48usize];
    [
        "Offset of field: msdd_batch::strain_xy",
    ][::core::mem::offset_of!(msdd_batch, strain_xy) - 56usize];
    [
        "Offset of field: msdd_batch::rotation",
    ][::core::mem::offset_of!(msdd_batch, rotation) - 64usize];
    [
        "Offset of field: msdd_batch::next_state",
    ][::core::mem::offset_of!(msdd_batch, next_state) - 72usize];
    [
        "Offset of field: msdd_batch::conductivity_xx",
    ][::core::mem::offset_of!(msdd_batch, conductivity_xx) - 80usize];
    [
        "Offset of field: msdd_batch::conductivity_yy",
    ][::core::mem::offset_of!(msdd_batch, conductivity_yy) - 88usize];
    [
        "Offset of field: msdd_batch::conductivity_xy",
    ][::core::mem::offset_of!(msdd_batch, conductivity_xy) - 96usize];
    [
        "Offset of field: msdd_batch::stress_xx",
    ][::core::mem::offset_of!(msdd_batch, stress_xx) - 104usize];
    [
        "Offset of field: msdd_batch::stress_yy",
    ][::core::mem::offset_of!(msdd_batch, stress_yy) - 112usize];
    [
        "Offset of field: msdd_batch::stress_xy",
    ][::core::mem::offset_of!(msdd_batch, stress_xy) - 120usize];
    [
        "Offset of field: msdd_batch::tangent",
    ][::core::mem::offset_of!(msdd_batch, tangent) - 128usize];
    [
        "Offset of field: msdd_batch::clamped",
    ][::core::mem::offset_of!(msdd_batch, clamped) - 136usize];
    [
        "Offset of field: msdd_batch::outside",
    ][::core::mem::offset_of!(msdd_batch, outside) - 144usize];
    [
        "Offset of field: msdd_batch::spread",
    ][::core::mem::offset_of!(msdd_batch, spread) - 152usize];
    [
        "Offset of field: msdd_batch::clamped_cells",
    ][::core::mem::offset_of!(msdd_batch, clamped_cells) - 160usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_initial {
    pub struct_size: usize,
    pub cells: usize,
    pub porosity: *const f64,
    pub fabric_index: *const f64,
    pub fabric_xy: *const f64,
    pub stress_xx: *const f64,
    pub stress_yy: *const f64,
    pub stress_xy: *const f64,
    pub conductivity_xx: *const f64,
    pub conductivity_yy: *const f64,
    pub conductivity_xy: *const f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_initial"][::core::mem::size_of::<msdd_initial>() - 88usize];
    ["Alignment of msdd_initial"][::core::mem::align_of::<msdd_initial>() - 8usize];
    [
        "Offset of field: msdd_initial::struct_size",
    ][::core::mem::offset_of!(msdd_initial, struct_size) - 0usize];
    [
        "Offset of field: msdd_initial::cells",
    ][::core::mem::offset_of!(msdd_initial, cells) - 8usize];
    [
        "Offset of field: msdd_initial::porosity",
    ][::core::mem::offset_of!(msdd_initial, porosity) - 16usize];
    [
        "Offset of field: msdd_initial::fabric_index",
    ][::core::mem::offset_of!(msdd_initial, fabric_index) - 24usize];
    [
        "Offset of field: msdd_initial::fabric_xy",
    ][::core::mem::offset_of!(msdd_initial, fabric_xy) - 32usize];
    [
        "Offset of field: msdd_initial::stress_xx",
    ][::core::mem::offset_of!(msdd_initial, stress_xx) - 40usize];
    [
        "Offset of field: msdd_initial::stress_yy",
    ][::core::mem::offset_of!(msdd_initial, stress_yy) - 48usize];
    [
        "Offset of field: msdd_initial::stress_xy",
    ][::core::mem::offset_of!(msdd_initial, stress_xy) - 56usize];
    [
        "Offset of field: msdd_initial::conductivity_xx",
    ][::core::mem::offset_of!(msdd_initial, conductivity_xx) - 64usize];
    [
        "Offset of field: msdd_initial::conductivity_yy",
    ][::core::mem::offset_of!(msdd_initial, conductivity_yy) - 72usize];
    [
        "Offset of field: msdd_initial::conductivity_xy",
    ][::core::mem::offset_of!(msdd_initial, conductivity_xy) - 80usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_spheres {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_sphere_material {
    pub struct_size: usize,
    pub diameter: f64,
    pub young_modulus: f64,
    pub poisson_ratio: f64,
    pub conductivity: f64,
    pub roughness: f64,
    pub hardness: f64,
    pub gas: *const ::core::ffi::c_char,
    pub gas_pressure: f64,
    pub accommodation: f64,
    pub emissivity: f64,
    pub size_spread: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    [
        "Size of msdd_sphere_material",
    ][::core::mem::size_of::<msdd_sphere_material>() - 96usize];
    [
        "Alignment of msdd_sphere_material",
    ][::core::mem::align_of::<msdd_sphere_material>() - 8usize];
    [
        "Offset of field: msdd_sphere_material::struct_size",
    ][::core::mem::offset_of!(msdd_sphere_material, struct_size) - 0usize];
    [
        "Offset of field: msdd_sphere_material::diameter",
    ][::core::mem::offset_of!(msdd_sphere_material, diameter) - 8usize];
    [
        "Offset of field: msdd_sphere_material::young_modulus",
    ][::core::mem::offset_of!(msdd_sphere_material, young_modulus) - 16usize];
    [
        "Offset of field: msdd_sphere_material::poisson_ratio",
    ][::core::mem::offset_of!(msdd_sphere_material, poisson_ratio) - 24usize];
    [
        "Offset of field: msdd_sphere_material::conductivity",
    ][::core::mem::offset_of!(msdd_sphere_material, conductivity) - 32usize];
    [
        "Offset of field: msdd_sphere_material::roughness",
    ][::core::mem::offset_of!(msdd_sphere_material, roughness) - 40usize];
    [
        "Offset of field: msdd_sphere_material::hardness",
    ][::core::mem::offset_of!(msdd_sphere_material, hardness) - 48usize];
    [
        "Offset of field: msdd_sphere_material::gas",
    ][::core::mem::offset_of!(msdd_sphere_material, gas) - 56usize];
    [
        "Offset of field: msdd_sphere_material::gas_pressure",
    ][::core::mem::offset_of!(msdd_sphere_material, gas_pressure) - 64usize];
    [
        "Offset of field: msdd_sphere_material::accommodation",
    ][::core::mem::offset_of!(msdd_sphere_material, accommodation) - 72usize];
    [
        "Offset of field: msdd_sphere_material::emissivity",
    ][::core::mem::offset_of!(msdd_sphere_material, emissivity) - 80usize];
    [
        "Offset of field: msdd_sphere_material::size_spread",
    ][::core::mem::offset_of!(msdd_sphere_material, size_spread) - 88usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_sphere_batch {
    pub struct_size: usize,
    pub cells: usize,
    pub state: *const *const f64,
    pub thermal_strain: *const f64,
    pub strain: *const *const f64,
    pub rotation: *const *const f64,
    pub temperature: *const f64,
    pub solid_conductivity: *const f64,
    pub emissivity: *const f64,
    pub next_state: *const *mut f64,
    pub stress: *const *mut f64,
    pub tangent: *const *mut f64,
    pub conductivity: *const *mut f64,
    pub gas_conductivity: *mut f64,
    pub radiation_conductivity: *mut f64,
    pub solid_fraction: *mut f64,
    pub outside: *mut u8,
    pub outside_cells: usize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    [
        "Size of msdd_sphere_batch",
    ][::core::mem::size_of::<msdd_sphere_batch>() - 144usize];
    [
        "Alignment of msdd_sphere_batch",
    ][::core::mem::align_of::<msdd_sphere_batch>() - 8usize];
    [
        "Offset of field: msdd_sphere_batch::struct_size",
    ][::core::mem::offset_of!(msdd_sphere_batch, struct_size) - 0usize];
    [
        "Offset of field: msdd_sphere_batch::cells",
    ][::core::mem::offset_of!(msdd_sphere_batch, cells) - 8usize];
    [
        "Offset of field: msdd_sphere_batch::state",
    ][::core::mem::offset_of!(msdd_sphere_batch, state) - 16usize];
    [
        "Offset of field: msdd_sphere_batch::thermal_strain",
    ][::core::mem::offset_of!(msdd_sphere_batch, thermal_strain) - 24usize];
    [
        "Offset of field: msdd_sphere_batch::strain",
    ][::core::mem::offset_of!(msdd_sphere_batch, strain) - 32usize];
    [
        "Offset of field: msdd_sphere_batch::rotation",
    ][::core::mem::offset_of!(msdd_sphere_batch, rotation) - 40usize];
    [
        "Offset of field: msdd_sphere_batch::temperature",
    ][::core::mem::offset_of!(msdd_sphere_batch, temperature) - 48usize];
    [
        "Offset of field: msdd_sphere_batch::solid_conductivity",
    ][::core::mem::offset_of!(msdd_sphere_batch, solid_conductivity) - 56usize];
    [
        "Offset of field: msdd_sphere_batch::emissivity",
    ][::core::mem::offset_of!(msdd_sphere_batch, emissivity) - 64usize];
    [
        "Offset of field: msdd_sphere_batch::next_state",
    ][::core::mem::offset_of!(msdd_sphere_batch, next_state) - 72usize];
    [
        "Offset of field: msdd_sphere_batch::stress",
    ][::core::mem::offset_of!(msdd_sphere_batch, stress) - 80usize];
    [
        "Offset of field: msdd_sphere_batch::tangent",
    ][::core::mem::offset_of!(msdd_sphere_batch, tangent) - 88usize];
    [
        "Offset of field: msdd_sphere_batch::conductivity",
    ][::core::mem::offset_of!(msdd_sphere_batch, conductivity) - 96usize];
    [
        "Offset of field: msdd_sphere_batch::gas_conductivity",
    ][::core::mem::offset_of!(msdd_sphere_batch, gas_conductivity) - 104usize];
    [
        "Offset of field: msdd_sphere_batch::radiation_conductivity",
    ][::core::mem::offset_of!(msdd_sphere_batch, radiation_conductivity) - 112usize];
    [
        "Offset of field: msdd_sphere_batch::solid_fraction",
    ][::core::mem::offset_of!(msdd_sphere_batch, solid_fraction) - 120usize];
    [
        "Offset of field: msdd_sphere_batch::outside",
    ][::core::mem::offset_of!(msdd_sphere_batch, outside) - 128usize];
    [
        "Offset of field: msdd_sphere_batch::outside_cells",
    ][::core::mem::offset_of!(msdd_sphere_batch, outside_cells) - 136usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_sphere_wall {
    pub struct_size: usize,
    pub conductivity: f64,
    pub young_modulus: f64,
    pub poisson_ratio: f64,
    pub roughness: f64,
    pub hardness: f64,
    pub spheres: f64,
    pub emissivity: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_sphere_wall"][::core::mem::size_of::<msdd_sphere_wall>() - 64usize];
    [
        "Alignment of msdd_sphere_wall",
    ][::core::mem::align_of::<msdd_sphere_wall>() - 8usize];
    [
        "Offset of field: msdd_sphere_wall::struct_size",
    ][::core::mem::offset_of!(msdd_sphere_wall, struct_size) - 0usize];
    [
        "Offset of field: msdd_sphere_wall::conductivity",
    ][::core::mem::offset_of!(msdd_sphere_wall, conductivity) - 8usize];
    [
        "Offset of field: msdd_sphere_wall::young_modulus",
    ][::core::mem::offset_of!(msdd_sphere_wall, young_modulus) - 16usize];
    [
        "Offset of field: msdd_sphere_wall::poisson_ratio",
    ][::core::mem::offset_of!(msdd_sphere_wall, poisson_ratio) - 24usize];
    [
        "Offset of field: msdd_sphere_wall::roughness",
    ][::core::mem::offset_of!(msdd_sphere_wall, roughness) - 32usize];
    [
        "Offset of field: msdd_sphere_wall::hardness",
    ][::core::mem::offset_of!(msdd_sphere_wall, hardness) - 40usize];
    [
        "Offset of field: msdd_sphere_wall::spheres",
    ][::core::mem::offset_of!(msdd_sphere_wall, spheres) - 48usize];
    [
        "Offset of field: msdd_sphere_wall::emissivity",
    ][::core::mem::offset_of!(msdd_sphere_wall, emissivity) - 56usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_rve {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_averages {
    pub struct_size: usize,
    pub porosity: f64,
    pub porosity_sum_of_areas: f64,
    pub fabric_index: f64,
    pub fabric_conductivity: f64,
    pub conductivity_xx: f64,
    pub conductivity_yy: f64,
    pub conductivity_xy: f64,
    pub conductivity_network_xx: f64,
    pub conductivity_network_yy: f64,
    pub conductivity_network_xy: f64,
    pub stress_xx: f64,
    pub stress_yy: f64,
    pub stress_xy: f64,
    pub stress_yx: f64,
    pub pressure: f64,
    pub coordination: f64,
    pub mean_radius: f64,
    pub rattlers: u64,
    pub contacts: u64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_averages"][::core::mem::size_of::<msdd_averages>() - 160usize];
    ["Alignment of msdd_averages"][::core::mem::align_of::<msdd_averages>() - 8usize];
    [
        "Offset of field: msdd_averages::struct_size",
    ][::core::mem::offset_of!(msdd_averages, struct_size) - 0usize];
    [
        "Offset of field: msdd_averages::porosity",
    ][::core::mem::offset_of!(msdd_averages, porosity) - 8usize];
    [
        "Offset of field: msdd_averages::porosity_sum_of_areas",
    ][::core::mem::offset_of!(msdd_averages, porosity_sum_of_areas) - 16usize];
    [
        "Offset of field: msdd_averages::fabric_index",
    ][::core::mem::offset_of!(msdd_averages, fabric_index) - 24usize];
    [
        "Offset of field: msdd_averages::fabric_conductivity",
    ][::core::mem::offset_of!(msdd_averages, fabric_conductivity) - 32usize];
    [
        "Offset of field: msdd_averages::conductivity_xx",
    ][::core::mem::offset_of!(msdd_averages, conductivity_xx) - 40usize];
    [
        "Offset of field: msdd_averages::conductivity_yy",
    ][::core::mem::offset_of!(msdd_averages, conductivity_yy) - 48usize];
    [
        "Offset of field: msdd_averages::conductivity_xy",
    ][::core::mem::offset_of!(msdd_averages, conductivity_xy) - 56usize];
    [
        "Offset of field: msdd_averages::conductivity_network_xx",
    ][::core::mem::offset_of!(msdd_averages, conductivity_network_xx) - 64usize];
    [
        "Offset of field: msdd_averages::conductivity_network_yy",
    ][::core::mem::offset_of!(msdd_averages, conductivity_network_yy) - 72usize];
    [
        "Offset of field: msdd_averages::conductivity_network_xy",
    ][::core::mem::offset_of!(msdd_averages, conductivity_network_xy) - 80usize];
    [
        "Offset of field: msdd_averages::stress_xx",
    ][::core::mem::offset_of!(msdd_averages, stress_xx) - 88usize];
    [
        "Offset of field: msdd_averages::stress_yy",
    ][::core::mem::offset_of!(msdd_averages, stress_yy) - 96usize];
    [
        "Offset of field: msdd_averages::stress_xy",
    ][::core::mem::offset_of!(msdd_averages, stress_xy) - 104usize];
    [
        "Offset of field: msdd_averages::stress_yx",
    ][::core::mem::offset_of!(msdd_averages, stress_yx) - 112usize];
    [
        "Offset of field: msdd_averages::pressure",
    ][::core::mem::offset_of!(msdd_averages, pressure) - 120usize];
    [
        "Offset of field: msdd_averages::coordination",
    ][::core::mem::offset_of!(msdd_averages, coordination) - 128usize];
    [
        "Offset of field: msdd_averages::mean_radius",
    ][::core::mem::offset_of!(msdd_averages, mean_radius) - 136usize];
    [
        "Offset of field: msdd_averages::rattlers",
    ][::core::mem::offset_of!(msdd_averages, rattlers) - 144usize];
    [
        "Offset of field: msdd_averages::contacts",
    ][::core::mem::offset_of!(msdd_averages, contacts) - 152usize];
};
pub const MSDD_SETTLED: msdd_outcome = 0;
pub const MSDD_CAPPED: msdd_outcome = 1;
pub const MSDD_UNJAMMED: msdd_outcome = 2;
pub type msdd_outcome = ::core::ffi::c_uint;
pub type msdd_progress = ::core::option::Option<
    unsafe extern "C" fn(
        user: *mut ::core::ffi::c_void,
        done: u64,
        total: u64,
        failed: u64,
    ) -> i32,
>;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_plugin_start {
    pub struct_size: usize,
    pub cells: usize,
    pub porosity: *const f64,
    pub fabric_index: *const f64,
    pub fabric_xy: *const f64,
    pub stress_xx: *const f64,
    pub stress_yy: *const f64,
    pub stress_xy: *const f64,
    pub conductivity_xx: *const f64,
    pub conductivity_yy: *const f64,
    pub conductivity_xy: *const f64,
    pub state: *const *mut f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_plugin_start"][::core::mem::size_of::<msdd_plugin_start>() - 96usize];
    [
        "Alignment of msdd_plugin_start",
    ][::core::mem::align_of::<msdd_plugin_start>() - 8usize];
    [
        "Offset of field: msdd_plugin_start::struct_size",
    ][::core::mem::offset_of!(msdd_plugin_start, struct_size) - 0usize];
    [
        "Offset of field: msdd_plugin_start::cells",
    ][::core::mem::offset_of!(msdd_plugin_start, cells) - 8usize];
    [
        "Offset of field: msdd_plugin_start::porosity",
    ][::core::mem::offset_of!(msdd_plugin_start, porosity) - 16usize];
    [
        "Offset of field: msdd_plugin_start::fabric_index",
    ][::core::mem::offset_of!(msdd_plugin_start, fabric_index) - 24usize];
    [
        "Offset of field: msdd_plugin_start::fabric_xy",
    ][::core::mem::offset_of!(msdd_plugin_start, fabric_xy) - 32usize];
    [
        "Offset of field: msdd_plugin_start::stress_xx",
    ][::core::mem::offset_of!(msdd_plugin_start, stress_xx) - 40usize];
    [
        "Offset of field: msdd_plugin_start::stress_yy",
    ][::core::mem::offset_of!(msdd_plugin_start, stress_yy) - 48usize];
    [
        "Offset of field: msdd_plugin_start::stress_xy",
    ][::core::mem::offset_of!(msdd_plugin_start, stress_xy) - 56usize];
    [
        "Offset of field: msdd_plugin_start::conductivity_xx",
    ][::core::mem::offset_of!(msdd_plugin_start, conductivity_xx) - 64usize];
    [
        "Offset of field: msdd_plugin_start::conductivity_yy",
    ][::core::mem::offset_of!(msdd_plugin_start, conductivity_yy) - 72usize];
    [
        "Offset of field: msdd_plugin_start::conductivity_xy",
    ][::core::mem::offset_of!(msdd_plugin_start, conductivity_xy) - 80usize];
    [
        "Offset of field: msdd_plugin_start::state",
    ][::core::mem::offset_of!(msdd_plugin_start, state) - 88usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_plugin_step {
    pub struct_size: usize,
    pub cells: usize,
    pub state: *const *const f64,
    pub thermal_strain: *const f64,
    pub strain_xx: *const f64,
    pub strain_yy: *const f64,
    pub strain_xy: *const f64,
    pub rotation: *const f64,
    pub next_state: *const *mut f64,
    pub conductivity_xx: *mut f64,
    pub conductivity_yy: *mut f64,
    pub conductivity_xy: *mut f64,
    pub stress_xx: *mut f64,
    pub stress_yy: *mut f64,
    pub stress_xy: *mut f64,
    pub tangent: *const *mut f64,
    pub outside: *const *mut f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_plugin_step"][::core::mem::size_of::<msdd_plugin_step>() - 136usize];
    [
        "Alignment of msdd_plugin_step",
    ][::core::mem::align_of::<msdd_plugin_step>() - 8usize];
    [
        "Offset of field: msdd_plugin_step::struct_size",
    ][::core::mem::offset_of!(msdd_plugin_step, struct_size) - 0usize];
    [
        "Offset of field: msdd_plugin_step::cells",
    ][::core::mem::offset_of!(msdd_plugin_step, cells) - 8usize];
    [
        "Offset of field: msdd_plugin_step::state",
    ][::core::mem::offset_of!(msdd_plugin_step, state) - 16usize];
    [
        "Offset of field: msdd_plugin_step::thermal_strain",
    ][::core::mem::offset_of!(msdd_plugin_step, thermal_strain) - 24usize];
    [
        "Offset of field: msdd_plugin_step::strain_xx",
    ][::core::mem::offset_of!(msdd_plugin_step, strain_xx) - 32usize];
    [
        "Offset of field: msdd_plugin_step::strain_yy",
    ][::core::mem::offset_of!(msdd_plugin_step, strain_yy) - 40usize];
    [
        "Offset of field: msdd_plugin_step::strain_xy",
    ][::core::mem::offset_of!(msdd_plugin_step, strain_xy) - 48usize];
    [
        "Offset of field: msdd_plugin_step::rotation",
    ][::core::mem::offset_of!(msdd_plugin_step, rotation) - 56usize];
    [
        "Offset of field: msdd_plugin_step::next_state",
    ][::core::mem::offset_of!(msdd_plugin_step, next_state) - 64usize];
    [
        "Offset of field: msdd_plugin_step::conductivity_xx",
    ][::core::mem::offset_of!(msdd_plugin_step, conductivity_xx) - 72usize];
    [
        "Offset of field: msdd_plugin_step::conductivity_yy",
    ][::core::mem::offset_of!(msdd_plugin_step, conductivity_yy) - 80usize];
    [
        "Offset of field: msdd_plugin_step::conductivity_xy",
    ][::core::mem::offset_of!(msdd_plugin_step, conductivity_xy) - 88usize];
    [
        "Offset of field: msdd_plugin_step::stress_xx",
    ][::core::mem::offset_of!(msdd_plugin_step, stress_xx) - 96usize];
    [
        "Offset of field: msdd_plugin_step::stress_yy",
    ][::core::mem::offset_of!(msdd_plugin_step, stress_yy) - 104usize];
    [
        "Offset of field: msdd_plugin_step::stress_xy",
    ][::core::mem::offset_of!(msdd_plugin_step, stress_xy) - 112usize];
    [
        "Offset of field: msdd_plugin_step::tangent",
    ][::core::mem::offset_of!(msdd_plugin_step, tangent) - 120usize];
    [
        "Offset of field: msdd_plugin_step::outside",
    ][::core::mem::offset_of!(msdd_plugin_step, outside) - 128usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_plugin_v2 {
    pub struct_size: usize,
    pub version: u32,
    pub network_conductivity: u32,
    pub has_tangent: u32,
    pub reserved: u32,
    pub name: *const ::core::ffi::c_char,
    pub state_size: usize,
    pub state_names: *const *const ::core::ffi::c_char,
    pub initial_state: ::core::option::Option<
        unsafe extern "C" fn(start: *const msdd_plugin_start) -> i32,
    >,
    pub advance: ::core::option::Option<
        unsafe extern "C" fn(step: *const msdd_plugin_step) -> i32,
    >,
    pub solid_fraction: ::core::option::Option<
        unsafe extern "C" fn(
            cells: usize,
            porosity: *const f64,
            solid_fraction: *mut f64,
        ) -> i32,
    >,
    pub spread: ::core::option::Option<
        unsafe extern "C" fn(
            cells: usize,
            state: *const *const f64,
            spread: *mut f64,
        ) -> i32,
    >,
    pub last_error: ::core::option::Option<
        unsafe extern "C" fn() -> *const ::core::ffi::c_char,
    >,
    pub wall_friction_limit: f64,
    pub wall_friction_slip: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_plugin_v2"][::core::mem::size_of::<msdd_plugin_v2>() - 104usize];
    ["Alignment of msdd_plugin_v2"][::core::mem::align_of::<msdd_plugin_v2>() - 8usize];
    [
        "Offset of field: msdd_plugin_v2::struct_size",
    ][::core::mem::offset_of!(msdd_plugin_v2, struct_size) - 0usize];
    [
        "Offset of field: msdd_plugin_v2::version",
    ][::core::mem::offset_of!(msdd_plugin_v2, version) - 8usize];
    [
        "Offset of field: msdd_plugin_v2::network_conductivity",
    ][::core::mem::offset_of!(msdd_plugin_v2, network_conductivity) - 12usize];
    [
        "Offset of field: msdd_plugin_v2::has_tangent",
    ][::core::mem::offset_of!(msdd_plugin_v2, has_tangent) - 16usize];
    [
        "Offset of field: msdd_plugin_v2::reserved",
    ][::core::mem::offset_of!(msdd_plugin_v2, reserved) - 20usize];
    [
        "Offset of field: msdd_plugin_v2::name",
    ][::core::mem::offset_of!(msdd_plugin_v2, name) - 24usize];
    [
        "Offset of field: msdd_plugin_v2::state_size",
    ][::core::mem::offset_of!(msdd_plugin_v2, state_size) - 32usize];
    [
        "Offset of field: msdd_plugin_v2::state_names",
    ][::core::mem::offset_of!(msdd_plugin_v2, state_names) - 40usize];
    [
        "Offset of field: msdd_plugin_v2::initial_state",
    ][::core::mem::offset_of!(msdd_plugin_v2, initial_state) - 48usize];
    [
        "Offset of field: msdd_plugin_v2::advance",
    ][::core::mem::offset_of!(msdd_plugin_v2, advance) - 56usize];
    [
        "Offset of field: msdd_plugin_v2::solid_fraction",
    ][::core::mem::offset_of!(msdd_plugin_v2, solid_fraction) - 64usize];
    [
        "Offset of field: msdd_plugin_v2::spread",
    ][::core::mem::offset_of!(msdd_plugin_v2, spread) - 72usize];
    [
        "Offset of field: msdd_plugin_v2::last_error",
    ][::core::mem::offset_of!(msdd_plugin_v2, last_error) - 80usize];
    [
        "Offset of field: msdd_plugin_v2::wall_friction_limit",
    ][::core::mem::offset_of!(msdd_plugin_v2, wall_friction_limit) - 88usize];
    [
        "Offset of field: msdd_plugin_v2::wall_friction_slip",
    ][::core::mem::offset_of!(msdd_plugin_v2, wall_friction_slip) - 96usize];
};
unsafe extern "C" {
    pub fn msdd_abi_version() -> u32;
    pub fn msdd_version() -> *const ::core::ffi::c_char;
    pub fn msdd_last_error() -> *const ::core::ffi::c_char;
    pub fn msdd_text_free(text: *mut ::core::ffi::c_char);
    pub fn msdd_surrogate_load(
        source: *const ::core::ffi::c_char,
        out: *mut *mut msdd_surrogate,
    ) -> i32;
    pub fn msdd_surrogate_with_conductivity(
        surrogate: *const msdd_surrogate,
        kind: *const ::core::ffi::c_char,
        out: *mut *mut msdd_surrogate,
    ) -> i32;
    pub fn msdd_surrogate_hash(
        surrogate: *const msdd_surrogate,
    ) -> *const ::core::ffi::c_char;
    pub fn msdd_surrogate_describe(
        surrogate: *const msdd_surrogate,
    ) -> *const ::core::ffi::c_char;
    pub fn msdd_surrogate_state_size(surrogate: *const msdd_surrogate) -> usize;
    pub fn msdd_surrogate_state_name(
        surrogate: *const msdd_surrogate,
        column: usize,
    ) -> *const ::core::ffi::c_char;
    pub fn msdd_surrogate_has_tangent(surrogate: *const msdd_surrogate) -> i32;
    pub fn msdd_surrogate_wall_friction(
        surrogate: *const msdd_surrogate,
        material: *const msdd_material,
        limit: *mut f64,
        slip: *mut f64,
    ) -> i32;
    pub fn msdd_surrogate_initial_state(
        surrogate: *const msdd_surrogate,
        material: *const msdd_material,
        initial: *const msdd_initial,
        state: *const *mut f64,
    ) -> i32;
    pub fn msdd_surrogate_advance(
        surrogate: *const msdd_surrogate,
        material: *const msdd_material,
        batch: *mut msdd_batch,
    ) -> i32;
    pub fn msdd_surrogate_solid_fraction(
        surrogate: *const msdd_surrogate,
        cells: usize,
        porosity: *const f64,
        solid_fraction: *mut f64,
    ) -> i32;
    pub fn msdd_surrogate_free(surrogate: *mut msdd_surrogate);
    pub fn msdd_spheres_load(
        source: *const ::core::ffi::c_char,
        out: *mut *mut msdd_spheres,
    ) -> i32;
    pub fn msdd_spheres_hash(spheres: *const msdd_spheres) -> *const ::core::ffi::c_char;
    pub fn msdd_spheres_describe(
        spheres: *const msdd_spheres,
    ) -> *const ::core::ffi::c_char;
    pub fn msdd_spheres_state_size(spheres: *const msdd_spheres) -> usize;
    pub fn msdd_spheres_state_name(
        spheres: *const msdd_spheres,
        column: usize,
    ) -> *const ::core::ffi::c_char;
    pub fn msdd_spheres_initial_state(
        spheres: *const msdd_spheres,
        material: *const msdd_sphere_material,
        cells: usize,
        solid_fraction: *const f64,
        stress: *const *const f64,
        coordination: *const f64,
        mobilised: *const f64,
        fabric: *const *const f64,
        state: *const *mut f64,
    ) -> i32;
    pub fn msdd_spheres_advance(
        spheres: *const msdd_spheres,
        material: *const msdd_sphere_material,
        batch: *mut msdd_sphere_batch,
    ) -> i32;
    pub fn msdd_spheres_free(spheres: *mut msdd_spheres);
    pub fn msdd_spheres_wall_resistance(
        material: *const msdd_sphere_material,
        wall: *const msdd_sphere_wall,
        faces: usize,
        stress: *const f64,
        temperature: *const f64,
        conductivity: *const f64,
        resistance: *mut f64,
    ) -> i32;
    pub fn msdd_rve_pack(
        specification: *const ::core::ffi::c_char,
        out: *mut *mut msdd_rve,
    ) -> i32;
    pub fn msdd_rve_from_json(
        text: *const ::core::ffi::c_char,
        out: *mut *mut msdd_rve,
    ) -> i32;
    pub fn msdd_rve_to_json(
        rve: *const msdd_rve,
        out: *mut *mut ::core::ffi::c_char,
    ) -> i32;
    pub fn msdd_rve_clone(rve: *const msdd_rve, out: *mut *mut msdd_rve) -> i32;
    pub fn msdd_rve_strain(
        rve: *mut msdd_rve,
        thermal: f64,
        xx: f64,
        yy: f64,
        xy: f64,
        outcome: *mut i32,
    ) -> i32;
    pub fn msdd_rve_homogenise(
        rve: *const msdd_rve,
        averages: *mut msdd_averages,
    ) -> i32;
    pub fn msdd_rve_free(rve: *mut msdd_rve);
    pub fn msdd_database_generate(
        plan: *const ::core::ffi::c_char,
        path: *const ::core::ffi::c_char,
        threads: u32,
        progress: msdd_progress,
        user: *mut ::core::ffi::c_void,
    ) -> i32;
    pub fn msdd_database_export_csv(
        database: *const ::core::ffi::c_char,
        csv: *const ::core::ffi::c_char,
        rows: *mut u64,
    ) -> i32;
    pub fn msdd_plugin_v2_table() -> *const msdd_plugin_v2;
    pub fn msdd_compared(
        hash: *const ::core::ffi::c_char,
        quantity: *const ::core::ffi::c_char,
        least: *mut f64,
        most: *mut f64,
    ) -> i32;
    pub fn msdd_gas_conductivity(
        gas: *const ::core::ffi::c_char,
        temperature: f64,
        conductivity: *mut f64,
    ) -> i32;
    pub fn msdd_gas_properties(
        gas: *const ::core::ffi::c_char,
        temperature: f64,
        properties: *mut f64,
    ) -> i32;
}
