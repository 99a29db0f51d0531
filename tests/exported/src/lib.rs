//! Test only: the built-in state model as a plug-in, through the same table as anybody's. What comes back from it has to
//! be the built-in model's own answer, bit for bit.
#![allow(unsafe_code)] // the C table of a plug-in

use msdd_abi::{
    MSDD_PLUGIN_VERSION, msdd_plugin_start, msdd_plugin_step, msdd_plugin_tangent, msdd_plugin_v1,
};
use msdd_surrogate::kernel::LANES;
use msdd_surrogate::state::variables::ConductivityKind;
use msdd_surrogate::surrogate::{Answer, Known, MAX_STATE};
use msdd_surrogate::{Surrogate, models};
use std::ffi::{CString, c_char};
use std::sync::LazyLock;

struct Exported {
    model: Box<dyn Surrogate>,
    table: msdd_plugin_v1,
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
    let table = msdd_plugin_v1 {
        struct_size: size_of::<msdd_plugin_v1>(),
        version: MSDD_PLUGIN_VERSION,
        network_conductivity: u32::from(model.conductivity_kind() == ConductivityKind::Network),
        name: names[names.len() - 1],
        state_size: names.len() - 1,
        state_names: names.as_ptr(),
        initial_state: Some(initial_state),
        advance: Some(advance),
        solid_fraction: Some(solid_fraction),
        tangent: Some(tangent),
        deform: Some(deform),
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
pub unsafe extern "C" fn msdd_plugin_v1_table() -> *const msdd_plugin_v1 {
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
            let known = Known {
                porosity: start.porosity.add(cell).read(),
                fabric_index: start.fabric_index.add(cell).read(),
                fabric_conductivity: optional(start.fabric_conductivity),
                reduced_stress: optional(start.stress_xx).zip(optional(start.stress_yy)).map(|(x, y)| [x, y]),
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
            let strain = step.thermal_strain.add(cell).read();
            let share = if step.virgin_share.is_null() { 1.0 } else { step.virgin_share.add(cell).read() };
            let (lanes, mut answer) = (|value: f64| [value; LANES], Answer::default());
            EXPORTED.model.block_into(&state.map(lanes), &lanes(strain), &lanes(share), &mut answer);
            write_state(step.next_state, cell, &answer.state.map(|lanes| lanes[0]));
            step.conductivity_xx.add(cell).write(answer.conductivity[0][0]);
            step.conductivity_yy.add(cell).write(answer.conductivity[1][0]);
            step.stress_xx.add(cell).write(answer.stress[0][0]);
            step.stress_yy.add(cell).write(answer.stress[1][0]);
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

unsafe extern "C" fn tangent(wanted: *const msdd_plugin_tangent) -> i32 {
    // SAFETY: see `initial_state`.
    unsafe {
        let wanted = &*wanted;
        for cell in 0..wanted.cells {
            let Some(t) = EXPORTED.model.tangent(&cell_state(wanted.state, cell)) else { return 1 };
            wanted.c11.add(cell).write(t.c11);
            wanted.c22.add(cell).write(t.c22);
            wanted.c12.add(cell).write(t.c12);
            wanted.porosity_rate.add(cell).write(t.porosity);
            wanted.fabric_index_rate.add(cell).write(t.fabric_index);
        }
    }
    0
}

unsafe extern "C" fn deform(
    cells: usize,
    state: *const *const f64,
    xx: *const f64,
    yy: *const f64,
    next: *const *mut f64,
) -> i32 {
    for cell in 0..cells {
        // SAFETY: see `initial_state`.
        unsafe {
            let lanes = cell_state(state, cell).map(|value| [value; msdd_surrogate::kernel::LANES]);
            let strain = [xx, yy].map(|column| [column.add(cell).read(); msdd_surrogate::kernel::LANES]);
            write_state(next, cell, &EXPORTED.model.deformed(&lanes, &strain).map(|lanes| lanes[0]));
        }
    }
    0
}

unsafe extern "C" fn spread(cells: usize, state: *const *const f64, result: *mut f64) -> i32 {
    for cell in 0..cells {
        // SAFETY: see `initial_state`.
        unsafe {
            let doubt = EXPORTED.model.doubt(&cell_state(state, cell));
            result.add(cell).write(doubt.map_or(0.0, |doubt| doubt.conductivity_spread));
        }
    }
    0
}
