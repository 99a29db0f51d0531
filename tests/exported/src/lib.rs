//! Test only: the built-in model as a plug-in, through the same table as anybody's. What comes back from it has to
//! be the built-in model's own answer, bit for bit.
#![allow(unsafe_code)] // the C table of a plug-in

use msdd_abi::{MSDD_PLUGIN_VERSION, msdd_plugin_start, msdd_plugin_step, msdd_plugin_v2};
use msdd_surrogate::dataset::ConductivityKind;
use msdd_surrogate::kernel::LANES;
use msdd_surrogate::surrogate::{Answer, Increment, InitialData, MAX_STATE, Tangent};
use msdd_surrogate::{Surrogate, models};
use std::ffi::{CString, c_char};
use std::sync::LazyLock;

struct Exported {
    model: Box<dyn Surrogate>,
    table: msdd_plugin_v2,
    _texts: Vec<CString>,
    _names: Vec<*const c_char>,
}

// SAFETY: the pointers are to its own texts, which nobody changes.
unsafe impl Send for Exported {}
// SAFETY: as above.
unsafe impl Sync for Exported {}

static EXPORTED: LazyLock<Exported> = LazyLock::new(|| {
    let model = models::builtin(models::BUILTIN).expect("the shipped model is sound");
    let texts: Vec<CString> = model
        .state_names()
        .iter()
        .copied()
        .chain([model.name()])
        .map(|t| CString::new(t).expect("no NUL"))
        .collect();
    let names: Vec<*const c_char> = texts.iter().map(|text| text.as_ptr()).collect();
    let friction = model.wall_friction();
    let table = msdd_plugin_v2 {
        struct_size: size_of::<msdd_plugin_v2>(),
        version: MSDD_PLUGIN_VERSION,
        network_conductivity: u32::from(model.conductivity_kind() == ConductivityKind::Network),
        has_tangent: u32::from(model.has_tangent()),
        reserved: 0,
        name: names[names.len() - 1],
        state_size: names.len() - 1,
        state_names: names.as_ptr(),
        initial_state: Some(initial_state),
        advance: Some(advance),
        solid_fraction: Some(solid_fraction),
        spread: Some(spread),
        last_error: None,
        wall_friction_limit: friction.map_or(0.0, |f| f.limit),
        wall_friction_slip: friction.map_or(0.0, |f| f.slip),
    };
    Exported { model, table, _texts: texts, _names: names }
});

/// # Safety
/// No conditions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_plugin_v2_table() -> *const msdd_plugin_v2 {
    &EXPORTED.table
}

/// One cell's state.
///
/// # Safety
/// The model's state columns, longer than `cell`.
unsafe fn cell_state(state: *const *const f64, cell: usize) -> [f64; MAX_STATE] {
    let count = EXPORTED.table.state_size;
    // SAFETY: in bounds by this function's contract.
    std::array::from_fn(|k| if k < count { unsafe { state.add(k).read().add(cell).read() } } else { 0.0 })
}

/// Writes one cell's state.
///
/// # Safety
/// As for [`cell_state`], writable.
unsafe fn write_state(columns: *const *mut f64, cell: usize, values: &[f64]) {
    for (k, value) in values.iter().take(EXPORTED.table.state_size).enumerate() {
        // SAFETY: in bounds by this function's contract.
        unsafe { columns.add(k).read().add(cell).write(*value) };
    }
}

unsafe extern "C" fn initial_state(start: *const msdd_plugin_start) -> i32 {
    // SAFETY: the host gives full structs and columns of `cells` values; so in all that follow.
    unsafe {
        let start = &*start;
        for cell in 0..start.cells {
            let optional = |column: *const f64| (!column.is_null()).then(|| column.add(cell).read());
            let known = InitialData {
                porosity: start.porosity.add(cell).read(),
                fabric_index: start.fabric_index.add(cell).read(),
                fabric_xy: optional(start.fabric_xy).unwrap_or(0.0),
                reduced_stress: optional(start.stress_xx)
                    .zip(optional(start.stress_yy))
                    .zip(optional(start.stress_xy))
                    .map(|((xx, yy), xy)| [xx, yy, xy]),
                conductivity: optional(start.conductivity_xx)
                    .zip(optional(start.conductivity_yy))
                    .zip(optional(start.conductivity_xy))
                    .map(|((xx, yy), xy)| [xx, yy, xy]),
            };
            write_state(start.state, cell, &EXPORTED.model.initial_state(&known));
        }
    }
    0
}

unsafe extern "C" fn advance(step: *const msdd_plugin_step) -> i32 {
    // SAFETY: see `initial_state`.
    unsafe {
        let step = &*step;
        for cell in 0..step.cells {
            let state = cell_state(step.state, cell);
            let given = |column: *const f64| match column.is_null() {
                true => [0.0; LANES],
                false => [column.add(cell).read(); LANES],
            };
            let strain = Increment {
                thermal: given(step.thermal_strain),
                xx: given(step.strain_xx),
                yy: given(step.strain_yy),
                xy: given(step.strain_xy),
                rotation: given(step.rotation),
            };
            let (mut answer, mut tangent) = (Answer::default(), Tangent::default());
            let wanted = (!step.tangent.is_null()).then_some(&mut tangent);
            EXPORTED.model.advance(&state.map(|value| [value; LANES]), &strain, &mut answer, wanted);
            write_state(step.next_state, cell, &answer.state.map(|lanes| lanes[0]));
            let columns = [
                (step.conductivity_xx, &answer.conductivity[0]),
                (step.conductivity_yy, &answer.conductivity[1]),
                (step.conductivity_xy, &answer.conductivity[2]),
                (step.stress_xx, &answer.stress[0]),
                (step.stress_yy, &answer.stress[1]),
                (step.stress_xy, &answer.stress[2]),
            ];
            columns.iter().for_each(|(column, lanes)| column.add(cell).write(lanes[0]));
            if !step.tangent.is_null() {
                for (k, lanes) in tangent.as_flattened().iter().enumerate() {
                    step.tangent.add(k).read().add(cell).write(lanes[0]);
                }
            }
            write_state(step.outside, cell, &answer.outside.map(|lanes| lanes[0]));
            let last = step.outside.add(EXPORTED.table.state_size).read();
            last.add(cell).write(answer.outside[MAX_STATE][0]);
        }
    }
    0
}

unsafe extern "C" fn solid_fraction(cells: usize, porosity: *const f64, result: *mut f64) -> i32 {
    for cell in 0..cells {
        // SAFETY: see `initial_state`.
        unsafe { result.add(cell).write(EXPORTED.model.solid_fraction(porosity.add(cell).read())) };
    }
    0
}

unsafe extern "C" fn spread(cells: usize, state: *const *const f64, result: *mut f64) -> i32 {
    for cell in 0..cells {
        // SAFETY: see `initial_state`.
        unsafe {
            let uncertainty = EXPORTED.model.uncertainty(&cell_state(state, cell));
            result.add(cell).write(uncertainty.map_or(0.0, |uncertainty| uncertainty.conductivity_spread));
        }
    }
    0
}
