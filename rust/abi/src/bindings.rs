//! What bindgen makes of `msdd.h`; `cargo test -p msdd-abi --test header` holds it against the header.

pub const MSDD_ABI_VERSION: u32 = 5;
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
pub struct msdd_model {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_input {
    pub values: *const f64,
    pub stride: usize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_input"][::core::mem::size_of::<msdd_input>() - 16usize];
    ["Alignment of msdd_input"][::core::mem::align_of::<msdd_input>() - 8usize];
    ["Offset of field: msdd_input::values"][::core::mem::offset_of!(msdd_input, values) - 0usize];
    ["Offset of field: msdd_input::stride"][::core::mem::offset_of!(msdd_input, stride) - 8usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_output {
    pub values: *mut f64,
    pub stride: usize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_output"][::core::mem::size_of::<msdd_output>() - 16usize];
    ["Alignment of msdd_output"][::core::mem::align_of::<msdd_output>() - 8usize];
    ["Offset of field: msdd_output::values"][::core::mem::offset_of!(msdd_output, values) - 0usize];
    ["Offset of field: msdd_output::stride"][::core::mem::offset_of!(msdd_output, stride) - 8usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_grains {
    pub struct_size: usize,
    pub conductivity: f64,
    pub young_modulus: f64,
    pub radius: f64,
    pub poisson_ratio: f64,
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
    ["Size of msdd_grains"][::core::mem::size_of::<msdd_grains>() - 96usize];
    ["Alignment of msdd_grains"][::core::mem::align_of::<msdd_grains>() - 8usize];
    ["Offset of field: msdd_grains::struct_size"][::core::mem::offset_of!(msdd_grains, struct_size) - 0usize];
    ["Offset of field: msdd_grains::conductivity"]
        [::core::mem::offset_of!(msdd_grains, conductivity) - 8usize];
    ["Offset of field: msdd_grains::young_modulus"]
        [::core::mem::offset_of!(msdd_grains, young_modulus) - 16usize];
    ["Offset of field: msdd_grains::radius"][::core::mem::offset_of!(msdd_grains, radius) - 24usize];
    ["Offset of field: msdd_grains::poisson_ratio"]
        [::core::mem::offset_of!(msdd_grains, poisson_ratio) - 32usize];
    ["Offset of field: msdd_grains::roughness"][::core::mem::offset_of!(msdd_grains, roughness) - 40usize];
    ["Offset of field: msdd_grains::hardness"][::core::mem::offset_of!(msdd_grains, hardness) - 48usize];
    ["Offset of field: msdd_grains::gas"][::core::mem::offset_of!(msdd_grains, gas) - 56usize];
    ["Offset of field: msdd_grains::gas_pressure"]
        [::core::mem::offset_of!(msdd_grains, gas_pressure) - 64usize];
    ["Offset of field: msdd_grains::accommodation"]
        [::core::mem::offset_of!(msdd_grains, accommodation) - 72usize];
    ["Offset of field: msdd_grains::emissivity"][::core::mem::offset_of!(msdd_grains, emissivity) - 80usize];
    ["Offset of field: msdd_grains::size_spread"]
        [::core::mem::offset_of!(msdd_grains, size_spread) - 88usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_step {
    pub struct_size: usize,
    pub cells: usize,
    pub components: usize,
    pub state: *const msdd_input,
    pub thermal_strain: msdd_input,
    pub total_thermal_strain: msdd_input,
    pub strain: *const msdd_input,
    pub rotation: *const msdd_input,
    pub temperature: msdd_input,
    pub solid_conductivity: msdd_input,
    pub emissivity: msdd_input,
    pub next_state: *const msdd_output,
    pub stress: *const msdd_output,
    pub tangent: *const msdd_output,
    pub conductivity: *const msdd_output,
    pub gas_conductivity: msdd_output,
    pub radiation_conductivity: msdd_output,
    pub solid_fraction: msdd_output,
    pub spread: msdd_output,
    pub distance: *const msdd_output,
    pub outside: *mut u8,
    pub outside_cells: usize,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_step"][::core::mem::size_of::<msdd_step>() - 248usize];
    ["Alignment of msdd_step"][::core::mem::align_of::<msdd_step>() - 8usize];
    ["Offset of field: msdd_step::struct_size"][::core::mem::offset_of!(msdd_step, struct_size) - 0usize];
    ["Offset of field: msdd_step::cells"][::core::mem::offset_of!(msdd_step, cells) - 8usize];
    ["Offset of field: msdd_step::components"][::core::mem::offset_of!(msdd_step, components) - 16usize];
    ["Offset of field: msdd_step::state"][::core::mem::offset_of!(msdd_step, state) - 24usize];
    ["Offset of field: msdd_step::thermal_strain"]
        [::core::mem::offset_of!(msdd_step, thermal_strain) - 32usize];
    ["Offset of field: msdd_step::total_thermal_strain"]
        [::core::mem::offset_of!(msdd_step, total_thermal_strain) - 48usize];
    ["Offset of field: msdd_step::strain"][::core::mem::offset_of!(msdd_step, strain) - 64usize];
    ["Offset of field: msdd_step::rotation"][::core::mem::offset_of!(msdd_step, rotation) - 72usize];
    ["Offset of field: msdd_step::temperature"][::core::mem::offset_of!(msdd_step, temperature) - 80usize];
    ["Offset of field: msdd_step::solid_conductivity"]
        [::core::mem::offset_of!(msdd_step, solid_conductivity) - 96usize];
    ["Offset of field: msdd_step::emissivity"][::core::mem::offset_of!(msdd_step, emissivity) - 112usize];
    ["Offset of field: msdd_step::next_state"][::core::mem::offset_of!(msdd_step, next_state) - 128usize];
    ["Offset of field: msdd_step::stress"][::core::mem::offset_of!(msdd_step, stress) - 136usize];
    ["Offset of field: msdd_step::tangent"][::core::mem::offset_of!(msdd_step, tangent) - 144usize];
    ["Offset of field: msdd_step::conductivity"][::core::mem::offset_of!(msdd_step, conductivity) - 152usize];
    ["Offset of field: msdd_step::gas_conductivity"]
        [::core::mem::offset_of!(msdd_step, gas_conductivity) - 160usize];
    ["Offset of field: msdd_step::radiation_conductivity"]
        [::core::mem::offset_of!(msdd_step, radiation_conductivity) - 176usize];
    ["Offset of field: msdd_step::solid_fraction"]
        [::core::mem::offset_of!(msdd_step, solid_fraction) - 192usize];
    ["Offset of field: msdd_step::spread"][::core::mem::offset_of!(msdd_step, spread) - 208usize];
    ["Offset of field: msdd_step::distance"][::core::mem::offset_of!(msdd_step, distance) - 224usize];
    ["Offset of field: msdd_step::outside"][::core::mem::offset_of!(msdd_step, outside) - 232usize];
    ["Offset of field: msdd_step::outside_cells"]
        [::core::mem::offset_of!(msdd_step, outside_cells) - 240usize];
};
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct msdd_start {
    pub struct_size: usize,
    pub cells: usize,
    pub components: usize,
    pub porosity: msdd_input,
    pub fabric_index: msdd_input,
    pub fabric_xy: msdd_input,
    pub solid_fraction: msdd_input,
    pub stress: *const msdd_input,
    pub conductivity: *const msdd_input,
    pub fabric: *const msdd_input,
    pub coordination: msdd_input,
    pub mobilised: msdd_input,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_start"][::core::mem::size_of::<msdd_start>() - 144usize];
    ["Alignment of msdd_start"][::core::mem::align_of::<msdd_start>() - 8usize];
    ["Offset of field: msdd_start::struct_size"][::core::mem::offset_of!(msdd_start, struct_size) - 0usize];
    ["Offset of field: msdd_start::cells"][::core::mem::offset_of!(msdd_start, cells) - 8usize];
    ["Offset of field: msdd_start::components"][::core::mem::offset_of!(msdd_start, components) - 16usize];
    ["Offset of field: msdd_start::porosity"][::core::mem::offset_of!(msdd_start, porosity) - 24usize];
    ["Offset of field: msdd_start::fabric_index"]
        [::core::mem::offset_of!(msdd_start, fabric_index) - 40usize];
    ["Offset of field: msdd_start::fabric_xy"][::core::mem::offset_of!(msdd_start, fabric_xy) - 56usize];
    ["Offset of field: msdd_start::solid_fraction"]
        [::core::mem::offset_of!(msdd_start, solid_fraction) - 72usize];
    ["Offset of field: msdd_start::stress"][::core::mem::offset_of!(msdd_start, stress) - 88usize];
    ["Offset of field: msdd_start::conductivity"]
        [::core::mem::offset_of!(msdd_start, conductivity) - 96usize];
    ["Offset of field: msdd_start::fabric"][::core::mem::offset_of!(msdd_start, fabric) - 104usize];
    ["Offset of field: msdd_start::coordination"]
        [::core::mem::offset_of!(msdd_start, coordination) - 112usize];
    ["Offset of field: msdd_start::mobilised"][::core::mem::offset_of!(msdd_start, mobilised) - 128usize];
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
    ["Alignment of msdd_sphere_wall"][::core::mem::align_of::<msdd_sphere_wall>() - 8usize];
    ["Offset of field: msdd_sphere_wall::struct_size"]
        [::core::mem::offset_of!(msdd_sphere_wall, struct_size) - 0usize];
    ["Offset of field: msdd_sphere_wall::conductivity"]
        [::core::mem::offset_of!(msdd_sphere_wall, conductivity) - 8usize];
    ["Offset of field: msdd_sphere_wall::young_modulus"]
        [::core::mem::offset_of!(msdd_sphere_wall, young_modulus) - 16usize];
    ["Offset of field: msdd_sphere_wall::poisson_ratio"]
        [::core::mem::offset_of!(msdd_sphere_wall, poisson_ratio) - 24usize];
    ["Offset of field: msdd_sphere_wall::roughness"]
        [::core::mem::offset_of!(msdd_sphere_wall, roughness) - 32usize];
    ["Offset of field: msdd_sphere_wall::hardness"]
        [::core::mem::offset_of!(msdd_sphere_wall, hardness) - 40usize];
    ["Offset of field: msdd_sphere_wall::spheres"]
        [::core::mem::offset_of!(msdd_sphere_wall, spheres) - 48usize];
    ["Offset of field: msdd_sphere_wall::emissivity"]
        [::core::mem::offset_of!(msdd_sphere_wall, emissivity) - 56usize];
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
    ["Offset of field: msdd_averages::struct_size"]
        [::core::mem::offset_of!(msdd_averages, struct_size) - 0usize];
    ["Offset of field: msdd_averages::porosity"][::core::mem::offset_of!(msdd_averages, porosity) - 8usize];
    ["Offset of field: msdd_averages::porosity_sum_of_areas"]
        [::core::mem::offset_of!(msdd_averages, porosity_sum_of_areas) - 16usize];
    ["Offset of field: msdd_averages::fabric_index"]
        [::core::mem::offset_of!(msdd_averages, fabric_index) - 24usize];
    ["Offset of field: msdd_averages::fabric_conductivity"]
        [::core::mem::offset_of!(msdd_averages, fabric_conductivity) - 32usize];
    ["Offset of field: msdd_averages::conductivity_xx"]
        [::core::mem::offset_of!(msdd_averages, conductivity_xx) - 40usize];
    ["Offset of field: msdd_averages::conductivity_yy"]
        [::core::mem::offset_of!(msdd_averages, conductivity_yy) - 48usize];
    ["Offset of field: msdd_averages::conductivity_xy"]
        [::core::mem::offset_of!(msdd_averages, conductivity_xy) - 56usize];
    ["Offset of field: msdd_averages::conductivity_network_xx"]
        [::core::mem::offset_of!(msdd_averages, conductivity_network_xx) - 64usize];
    ["Offset of field: msdd_averages::conductivity_network_yy"]
        [::core::mem::offset_of!(msdd_averages, conductivity_network_yy) - 72usize];
    ["Offset of field: msdd_averages::conductivity_network_xy"]
        [::core::mem::offset_of!(msdd_averages, conductivity_network_xy) - 80usize];
    ["Offset of field: msdd_averages::stress_xx"]
        [::core::mem::offset_of!(msdd_averages, stress_xx) - 88usize];
    ["Offset of field: msdd_averages::stress_yy"]
        [::core::mem::offset_of!(msdd_averages, stress_yy) - 96usize];
    ["Offset of field: msdd_averages::stress_xy"]
        [::core::mem::offset_of!(msdd_averages, stress_xy) - 104usize];
    ["Offset of field: msdd_averages::stress_yx"]
        [::core::mem::offset_of!(msdd_averages, stress_yx) - 112usize];
    ["Offset of field: msdd_averages::pressure"][::core::mem::offset_of!(msdd_averages, pressure) - 120usize];
    ["Offset of field: msdd_averages::coordination"]
        [::core::mem::offset_of!(msdd_averages, coordination) - 128usize];
    ["Offset of field: msdd_averages::mean_radius"]
        [::core::mem::offset_of!(msdd_averages, mean_radius) - 136usize];
    ["Offset of field: msdd_averages::rattlers"][::core::mem::offset_of!(msdd_averages, rattlers) - 144usize];
    ["Offset of field: msdd_averages::contacts"][::core::mem::offset_of!(msdd_averages, contacts) - 152usize];
};
pub const MSDD_SETTLED: msdd_outcome = 0;
pub const MSDD_CAPPED: msdd_outcome = 1;
pub const MSDD_UNJAMMED: msdd_outcome = 2;
pub type msdd_outcome = ::core::ffi::c_uint;
pub type msdd_progress = ::core::option::Option<
    unsafe extern "C" fn(user: *mut ::core::ffi::c_void, done: u64, total: u64, failed: u64) -> i32,
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
    ["Alignment of msdd_plugin_start"][::core::mem::align_of::<msdd_plugin_start>() - 8usize];
    ["Offset of field: msdd_plugin_start::struct_size"]
        [::core::mem::offset_of!(msdd_plugin_start, struct_size) - 0usize];
    ["Offset of field: msdd_plugin_start::cells"][::core::mem::offset_of!(msdd_plugin_start, cells) - 8usize];
    ["Offset of field: msdd_plugin_start::porosity"]
        [::core::mem::offset_of!(msdd_plugin_start, porosity) - 16usize];
    ["Offset of field: msdd_plugin_start::fabric_index"]
        [::core::mem::offset_of!(msdd_plugin_start, fabric_index) - 24usize];
    ["Offset of field: msdd_plugin_start::fabric_xy"]
        [::core::mem::offset_of!(msdd_plugin_start, fabric_xy) - 32usize];
    ["Offset of field: msdd_plugin_start::stress_xx"]
        [::core::mem::offset_of!(msdd_plugin_start, stress_xx) - 40usize];
    ["Offset of field: msdd_plugin_start::stress_yy"]
        [::core::mem::offset_of!(msdd_plugin_start, stress_yy) - 48usize];
    ["Offset of field: msdd_plugin_start::stress_xy"]
        [::core::mem::offset_of!(msdd_plugin_start, stress_xy) - 56usize];
    ["Offset of field: msdd_plugin_start::conductivity_xx"]
        [::core::mem::offset_of!(msdd_plugin_start, conductivity_xx) - 64usize];
    ["Offset of field: msdd_plugin_start::conductivity_yy"]
        [::core::mem::offset_of!(msdd_plugin_start, conductivity_yy) - 72usize];
    ["Offset of field: msdd_plugin_start::conductivity_xy"]
        [::core::mem::offset_of!(msdd_plugin_start, conductivity_xy) - 80usize];
    ["Offset of field: msdd_plugin_start::state"]
        [::core::mem::offset_of!(msdd_plugin_start, state) - 88usize];
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
    ["Alignment of msdd_plugin_step"][::core::mem::align_of::<msdd_plugin_step>() - 8usize];
    ["Offset of field: msdd_plugin_step::struct_size"]
        [::core::mem::offset_of!(msdd_plugin_step, struct_size) - 0usize];
    ["Offset of field: msdd_plugin_step::cells"][::core::mem::offset_of!(msdd_plugin_step, cells) - 8usize];
    ["Offset of field: msdd_plugin_step::state"][::core::mem::offset_of!(msdd_plugin_step, state) - 16usize];
    ["Offset of field: msdd_plugin_step::thermal_strain"]
        [::core::mem::offset_of!(msdd_plugin_step, thermal_strain) - 24usize];
    ["Offset of field: msdd_plugin_step::strain_xx"]
        [::core::mem::offset_of!(msdd_plugin_step, strain_xx) - 32usize];
    ["Offset of field: msdd_plugin_step::strain_yy"]
        [::core::mem::offset_of!(msdd_plugin_step, strain_yy) - 40usize];
    ["Offset of field: msdd_plugin_step::strain_xy"]
        [::core::mem::offset_of!(msdd_plugin_step, strain_xy) - 48usize];
    ["Offset of field: msdd_plugin_step::rotation"]
        [::core::mem::offset_of!(msdd_plugin_step, rotation) - 56usize];
    ["Offset of field: msdd_plugin_step::next_state"]
        [::core::mem::offset_of!(msdd_plugin_step, next_state) - 64usize];
    ["Offset of field: msdd_plugin_step::conductivity_xx"]
        [::core::mem::offset_of!(msdd_plugin_step, conductivity_xx) - 72usize];
    ["Offset of field: msdd_plugin_step::conductivity_yy"]
        [::core::mem::offset_of!(msdd_plugin_step, conductivity_yy) - 80usize];
    ["Offset of field: msdd_plugin_step::conductivity_xy"]
        [::core::mem::offset_of!(msdd_plugin_step, conductivity_xy) - 88usize];
    ["Offset of field: msdd_plugin_step::stress_xx"]
        [::core::mem::offset_of!(msdd_plugin_step, stress_xx) - 96usize];
    ["Offset of field: msdd_plugin_step::stress_yy"]
        [::core::mem::offset_of!(msdd_plugin_step, stress_yy) - 104usize];
    ["Offset of field: msdd_plugin_step::stress_xy"]
        [::core::mem::offset_of!(msdd_plugin_step, stress_xy) - 112usize];
    ["Offset of field: msdd_plugin_step::tangent"]
        [::core::mem::offset_of!(msdd_plugin_step, tangent) - 120usize];
    ["Offset of field: msdd_plugin_step::outside"]
        [::core::mem::offset_of!(msdd_plugin_step, outside) - 128usize];
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
    pub initial_state: ::core::option::Option<unsafe extern "C" fn(start: *const msdd_plugin_start) -> i32>,
    pub advance: ::core::option::Option<unsafe extern "C" fn(step: *const msdd_plugin_step) -> i32>,
    pub solid_fraction: ::core::option::Option<
        unsafe extern "C" fn(cells: usize, porosity: *const f64, solid_fraction: *mut f64) -> i32,
    >,
    pub spread: ::core::option::Option<
        unsafe extern "C" fn(cells: usize, state: *const *const f64, spread: *mut f64) -> i32,
    >,
    pub last_error: ::core::option::Option<unsafe extern "C" fn() -> *const ::core::ffi::c_char>,
    pub wall_friction_limit: f64,
    pub wall_friction_slip: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
const _: () = {
    ["Size of msdd_plugin_v2"][::core::mem::size_of::<msdd_plugin_v2>() - 104usize];
    ["Alignment of msdd_plugin_v2"][::core::mem::align_of::<msdd_plugin_v2>() - 8usize];
    ["Offset of field: msdd_plugin_v2::struct_size"]
        [::core::mem::offset_of!(msdd_plugin_v2, struct_size) - 0usize];
    ["Offset of field: msdd_plugin_v2::version"][::core::mem::offset_of!(msdd_plugin_v2, version) - 8usize];
    ["Offset of field: msdd_plugin_v2::network_conductivity"]
        [::core::mem::offset_of!(msdd_plugin_v2, network_conductivity) - 12usize];
    ["Offset of field: msdd_plugin_v2::has_tangent"]
        [::core::mem::offset_of!(msdd_plugin_v2, has_tangent) - 16usize];
    ["Offset of field: msdd_plugin_v2::reserved"]
        [::core::mem::offset_of!(msdd_plugin_v2, reserved) - 20usize];
    ["Offset of field: msdd_plugin_v2::name"][::core::mem::offset_of!(msdd_plugin_v2, name) - 24usize];
    ["Offset of field: msdd_plugin_v2::state_size"]
        [::core::mem::offset_of!(msdd_plugin_v2, state_size) - 32usize];
    ["Offset of field: msdd_plugin_v2::state_names"]
        [::core::mem::offset_of!(msdd_plugin_v2, state_names) - 40usize];
    ["Offset of field: msdd_plugin_v2::initial_state"]
        [::core::mem::offset_of!(msdd_plugin_v2, initial_state) - 48usize];
    ["Offset of field: msdd_plugin_v2::advance"][::core::mem::offset_of!(msdd_plugin_v2, advance) - 56usize];
    ["Offset of field: msdd_plugin_v2::solid_fraction"]
        [::core::mem::offset_of!(msdd_plugin_v2, solid_fraction) - 64usize];
    ["Offset of field: msdd_plugin_v2::spread"][::core::mem::offset_of!(msdd_plugin_v2, spread) - 72usize];
    ["Offset of field: msdd_plugin_v2::last_error"]
        [::core::mem::offset_of!(msdd_plugin_v2, last_error) - 80usize];
    ["Offset of field: msdd_plugin_v2::wall_friction_limit"]
        [::core::mem::offset_of!(msdd_plugin_v2, wall_friction_limit) - 88usize];
    ["Offset of field: msdd_plugin_v2::wall_friction_slip"]
        [::core::mem::offset_of!(msdd_plugin_v2, wall_friction_slip) - 96usize];
};
unsafe extern "C" {
    pub fn msdd_abi_version() -> u32;
    pub fn msdd_version() -> *const ::core::ffi::c_char;
    pub fn msdd_last_error() -> *const ::core::ffi::c_char;
    pub fn msdd_text_free(text: *mut ::core::ffi::c_char);
    pub fn msdd_model_load(source: *const ::core::ffi::c_char, out: *mut *mut msdd_model) -> i32;
    pub fn msdd_model_with_conductivity(
        model: *const msdd_model,
        kind: *const ::core::ffi::c_char,
        out: *mut *mut msdd_model,
    ) -> i32;
    pub fn msdd_model_hash(model: *const msdd_model) -> *const ::core::ffi::c_char;
    pub fn msdd_model_describe(model: *const msdd_model) -> *const ::core::ffi::c_char;
    pub fn msdd_model_state_size(model: *const msdd_model) -> usize;
    pub fn msdd_model_state_name(model: *const msdd_model, column: usize) -> *const ::core::ffi::c_char;
    pub fn msdd_model_components(model: *const msdd_model) -> usize;
    pub fn msdd_model_has_tangent(model: *const msdd_model) -> i32;
    pub fn msdd_model_wall_friction(
        model: *const msdd_model,
        material: *const msdd_grains,
        limit: *mut f64,
        slip: *mut f64,
    ) -> i32;
    pub fn msdd_model_initial_state(
        model: *const msdd_model,
        material: *const msdd_grains,
        start: *const msdd_start,
        state: *const msdd_output,
    ) -> i32;
    pub fn msdd_model_advance(
        model: *const msdd_model,
        material: *const msdd_grains,
        step: *mut msdd_step,
    ) -> i32;
    pub fn msdd_model_solid_fraction(
        model: *const msdd_model,
        cells: usize,
        porosity: *const f64,
        solid_fraction: *mut f64,
    ) -> i32;
    pub fn msdd_model_free(model: *mut msdd_model);
    pub fn msdd_wall_resistance(
        material: *const msdd_grains,
        wall: *const msdd_sphere_wall,
        faces: usize,
        stress: *const f64,
        temperature: *const f64,
        conductivity: *const f64,
        resistance: *mut f64,
    ) -> i32;
    pub fn msdd_rve_pack(specification: *const ::core::ffi::c_char, out: *mut *mut msdd_rve) -> i32;
    pub fn msdd_rve_from_json(text: *const ::core::ffi::c_char, out: *mut *mut msdd_rve) -> i32;
    pub fn msdd_rve_to_json(rve: *const msdd_rve, out: *mut *mut ::core::ffi::c_char) -> i32;
    pub fn msdd_rve_clone(rve: *const msdd_rve, out: *mut *mut msdd_rve) -> i32;
    pub fn msdd_rve_strain(
        rve: *mut msdd_rve,
        thermal: f64,
        xx: f64,
        yy: f64,
        xy: f64,
        outcome: *mut i32,
    ) -> i32;
    pub fn msdd_rve_homogenise(rve: *const msdd_rve, averages: *mut msdd_averages) -> i32;
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
    pub fn msdd_train(request: *const ::core::ffi::c_char, model: *mut *mut ::core::ffi::c_char) -> i32;
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
