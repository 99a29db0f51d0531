//! Compares the types of our functions with those that the header declares: where they differ, this does not compile.

use crate::{abi, exports};

macro_rules! same {
    ($($name:ident($($argument:ty),*) $(-> $result:ty)?;)*) => {
        /// The functions compared.
        #[cfg(test)]
        pub(crate) const FUNCTIONS: &[&str] = &[$(stringify!($name)),*];
        const _: () = {
            $(const _: [unsafe extern "C" fn($($argument),*) $(-> $result)?; 2] = [abi::$name, exports::$name];)*
        };
    };
}

use abi::{
    msdd_averages, msdd_grains, msdd_model, msdd_output, msdd_progress, msdd_rve, msdd_sphere_wall,
    msdd_start, msdd_step,
};
use std::ffi::{c_char, c_void};

same! {
    msdd_abi_version() -> u32;
    msdd_version() -> *const c_char;
    msdd_last_error() -> *const c_char;
    msdd_text_free(*mut c_char);
    msdd_model_load(*const c_char, *mut *mut msdd_model) -> i32;
    msdd_model_with_conductivity(*const msdd_model, *const c_char, *mut *mut msdd_model) -> i32;
    msdd_model_hash(*const msdd_model) -> *const c_char;
    msdd_model_describe(*const msdd_model) -> *const c_char;
    msdd_model_state_size(*const msdd_model) -> usize;
    msdd_model_state_name(*const msdd_model, usize) -> *const c_char;
    msdd_model_components(*const msdd_model) -> usize;
    msdd_model_has_tangent(*const msdd_model) -> i32;
    msdd_model_wall_friction(*const msdd_model, *const msdd_grains, *mut f64, *mut f64) -> i32;
    msdd_model_initial_state(*const msdd_model, *const msdd_grains, *const msdd_start, *const msdd_output) -> i32;
    msdd_model_advance(*const msdd_model, *const msdd_grains, *mut msdd_step) -> i32;
    msdd_model_solid_fraction(*const msdd_model, usize, *const f64, *mut f64) -> i32;
    msdd_model_free(*mut msdd_model);
    msdd_wall_resistance(*const msdd_grains, *const msdd_sphere_wall, usize, *const f64, *const f64, *const f64, *mut f64) -> i32;
    msdd_rve_pack(*const c_char, *mut *mut msdd_rve) -> i32;
    msdd_rve_from_json(*const c_char, *mut *mut msdd_rve) -> i32;
    msdd_rve_to_json(*const msdd_rve, *mut *mut c_char) -> i32;
    msdd_rve_clone(*const msdd_rve, *mut *mut msdd_rve) -> i32;
    msdd_rve_strain(*mut msdd_rve, f64, f64, f64, f64, *mut i32) -> i32;
    msdd_rve_homogenise(*const msdd_rve, *mut msdd_averages) -> i32;
    msdd_rve_free(*mut msdd_rve);
    msdd_database_generate(*const c_char, *const c_char, u32, msdd_progress, *mut c_void) -> i32;
    msdd_database_export_csv(*const c_char, *const c_char, *mut u64) -> i32;
    msdd_train(*const c_char, *mut *mut c_char) -> i32;
    msdd_compared(*const c_char, *const c_char, *mut f64, *mut f64) -> i32;
    msdd_gas_conductivity(*const c_char, f64, *mut f64) -> i32;
    msdd_gas_properties(*const c_char, f64, *mut f64) -> i32;
}

/// Checks that the list above contains every function of the header.
#[test]
fn no_function_of_the_header_is_left_out() {
    let header = include_str!("../include/msdd.h");
    // Those of version 4 are inline.
    let header = header.split("#ifndef MSDD_WITHOUT_V4\n\n").next().unwrap_or_default();
    let code = header.split("*/").filter_map(|part| part.split("/*").next()).collect::<String>();
    let declared: Vec<&str> = code
        .split(';')
        .filter(|declaration| !declaration.contains("typedef") && declaration.contains('('))
        .filter_map(|declaration| declaration.split('(').next()?.rsplit([' ', '*', '\n']).next())
        .filter(|name| name.starts_with("msdd_"))
        .collect();
    assert_eq!(declared, FUNCTIONS);
}
