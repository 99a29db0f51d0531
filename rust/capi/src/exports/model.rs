//! Functions of `msdd.h` about models.

use super::{sized, string, writable};
use crate::abi::{msdd_grains, msdd_model, msdd_output, msdd_start, msdd_step};
use crate::columns::{Input, Output, check_length};
use crate::grains::Grains;
use crate::handles::ModelHandle;
use crate::load::load;
use crate::si::Si;
use crate::start::Start;
use crate::status::{Failure, status, value};
use crate::step::{Step, outputs};
use msdd_surrogate::models::BUILTIN;
use std::ffi::c_char;
use std::ptr::null;

/// `msdd_model_load`
///
/// # Safety
/// `source` is null or a C string; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_load(source: *const c_char, out: *mut *mut msdd_model) -> i32 {
    status(|| {
        let out = writable("out", out)?;
        let source = match source.is_null() {
            true => BUILTIN.to_string(),
            // SAFETY: not null, a C string by this function's contract.
            false => unsafe { string("source", source)? },
        };
        let handle = Box::into_raw(Box::new(ModelHandle::new(load(&source)?)));
        // SAFETY: not null, writable by this function's contract.
        unsafe { out.write(handle.cast()) };
        Ok(())
    })
}

/// The model behind a handle.
///
/// # Safety
/// `model` is null or a live handle.
unsafe fn handle<'a>(model: *const msdd_model) -> Option<&'a ModelHandle> {
    // SAFETY: null or live by this function's contract; live handles come from `msdd_model_load`.
    unsafe { model.cast::<ModelHandle>().as_ref() }
}

/// As [`handle`], but a null handle is an error.
///
/// # Safety
/// As for [`handle`].
unsafe fn needed<'a>(model: *const msdd_model) -> Result<&'a ModelHandle, Failure> {
    // SAFETY: the caller guarantees it, by this function's contract.
    unsafe { handle(model) }.ok_or_else(|| Failure::null("model"))
}

/// The grains of a caller.
///
/// # Safety
/// `material` is null or points to its struct, whose gas is null or a C string.
unsafe fn grains(material: *const msdd_grains) -> Result<Grains, Failure> {
    // SAFETY: the caller guarantees it, by this function's contract.
    unsafe { Grains::new(sized("material", material)?) }
}

/// `msdd_model_with_conductivity`
///
/// # Safety
/// `model` is null or a live handle; `kind` is null or a C string; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_with_conductivity(
    model: *const msdd_model,
    kind: *const c_char,
    out: *mut *mut msdd_model,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or a C string, by this function's contract.
        let (handle, kind) = unsafe { (needed(model)?, string("kind", kind)?) };
        let out = writable("out", out)?;
        let model = match handle.model.conductivity() == kind {
            true => handle.model.clone(),
            false => handle.model.with_conductivity(&kind).ok_or_else(|| {
                let allowed = handle.model.conductivities().join(", ");
                let name = handle.model.name();
                Failure::argument("kind", &kind, format!("{allowed}: what model \"{name}\" was trained for"))
            })?,
        };
        let handle = Box::into_raw(Box::new(ModelHandle::new(model)));
        // SAFETY: not null, writable by this function's contract.
        unsafe { out.write(handle.cast()) };
        Ok(())
    })
}

/// `msdd_model_hash`
///
/// # Safety
/// `model` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_hash(model: *const msdd_model) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(model) };
    value(null(), || handle.map_or(null(), |handle| handle.hash.as_ptr()))
}

/// `msdd_model_describe`
///
/// # Safety
/// `model` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_describe(model: *const msdd_model) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(model) };
    value(null(), || handle.map_or(null(), |handle| handle.description.as_ptr()))
}

/// `msdd_model_state_size`
///
/// # Safety
/// `model` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_state_size(model: *const msdd_model) -> usize {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(model) };
    value(0, || handle.map_or(0, |handle| handle.state_names.len()))
}

/// `msdd_model_state_name`
///
/// # Safety
/// `model` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_state_name(model: *const msdd_model, column: usize) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(model) };
    let name = || handle.and_then(|handle| handle.state_names.get(column));
    value(null(), || name().map_or(null(), |name| name.as_ptr()))
}

/// `msdd_model_components`
///
/// # Safety
/// `model` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_components(model: *const msdd_model) -> usize {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(model) };
    value(0, || handle.map_or(0, |handle| handle.model.components()))
}

/// `msdd_model_has_tangent`
///
/// # Safety
/// `model` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_has_tangent(model: *const msdd_model) -> i32 {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(model) };
    value(0, || handle.map_or(0, |handle| i32::from(handle.model.has_tangent())))
}

/// `msdd_model_wall_friction`
///
/// # Safety
/// `model` is null or a live handle; `material` is null or points to its struct, whose gas is null or a C string; the outputs are
/// null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_wall_friction(
    model: *const msdd_model,
    material: *const msdd_grains,
    limit: *mut f64,
    slip: *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or pointing to its struct, by this function's contract.
        let (handle, grains) = unsafe { (needed(model)?, grains(material)?) };
        Si::new(&grains)?;
        let [found_limit, found_slip] = handle.model.wall_friction().ok_or_else(|| {
            Failure::argument("model", handle.model.name(), "a model trained with slipping walls")
        })?;
        for (out, value) in [(limit, found_limit), (slip, found_slip * grains.numbers.radius)] {
            if !out.is_null() {
                // SAFETY: not null, writable by this function's contract.
                unsafe { out.write(value) };
            }
        }
        Ok(())
    })
}

/// `msdd_model_initial_state`
///
/// # Safety
/// `model` is null or a live handle; the structs' pointers are null or point to their struct, the material's gas is null or a C
/// string; the columns are null or have `cells` values; `state` is null or holds as many writable columns as the state has.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_initial_state(
    model: *const msdd_model,
    material: *const msdd_grains,
    start: *const msdd_start,
    state: *const msdd_output,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or pointing to their structs, by this function's contract.
        let (handle, grains, given) = unsafe { (needed(model)?, grains(material)?, sized("start", start)?) };
        if state.is_null() {
            return Err(Failure::null("state"));
        }
        // SAFETY: null or `cells` values, and writable columns, by this function's contract.
        let (start, columns) = unsafe {
            let start = Start::new(&given, handle.model.components())?;
            (start, outputs("state", state, handle.names.len(), given.cells)?)
        };
        handle.model.initial_state(&start, &grains, &columns)
    })
}

/// `msdd_model_advance`
///
/// # Safety
/// `model` is null or a live handle; the others are null or point to their struct (to its `struct_size` at least), the material's
/// gas is null or a C string; the columns of the step are null or have `cells` values, those of outputs writable by this thread
/// alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_advance(
    model: *const msdd_model,
    material: *const msdd_grains,
    step: *mut msdd_step,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or pointing to their structs, by this function's contract.
        let (handle, grains, given) =
            unsafe { (needed(model)?, grains(material)?, sized("step", step.cast_const())?) };
        // SAFETY: the columns are as this function's contract says.
        let columns = unsafe { Step::new(&given, &handle.names, handle.model.components())? };
        let outside_cells = handle.model.advance(&columns, &grains)?;
        // SAFETY: not null, and of full size, as checked.
        unsafe { (*step).outside_cells = outside_cells };
        Ok(())
    })
}

/// `msdd_model_solid_fraction`
///
/// # Safety
/// `model` is null or a live handle; the columns are null or hold `cells` values, the output's writable by this
/// thread alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_solid_fraction(
    model: *const msdd_model,
    cells: usize,
    porosity: *const f64,
    solid_fraction: *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: null or live by this function's contract.
        let handle = unsafe { needed(model)? };
        check_length(cells)?;
        // SAFETY: null or `cells` values, by this function's contract.
        let (input, output) = unsafe {
            (
                Input::contiguous("porosity", porosity, cells)?,
                Output::contiguous("solid_fraction", solid_fraction, cells),
            )
        };
        if solid_fraction.is_null() && cells > 0 {
            return Err(Failure::null("solid_fraction"));
        }
        input.check_range(0.0, 1.0, "0 to 1")?;
        handle.model.solid_fraction(&input, &output)
    })
}

/// `msdd_model_free`
///
/// # Safety
/// `model` is null or a live handle, which nobody uses from now on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_model_free(model: *mut msdd_model) {
    if !model.is_null() {
        // SAFETY: made by `Box::into_raw` in `msdd_model_load`, and freed once, by this function's contract.
        value((), || drop(unsafe { Box::from_raw(model.cast::<ModelHandle>()) }));
    }
}
