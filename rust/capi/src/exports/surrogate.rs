//! Functions of `msdd.h` about surrogate models.

use super::{sized, string, writable};
use crate::abi::{msdd_batch, msdd_initial, msdd_material, msdd_surrogate};
use crate::batch::{self, Columns};
use crate::columns::{Input, Output};
use crate::handles::SurrogateHandle;
use crate::model::{BatchModel, InitialColumns, Own};
use crate::si::{LARGEST_STRESS, Si};
use crate::status::{Failure, status, value};
use ::msdd_surrogate::models;
use msdd_plugin::Plugin;
use std::ffi::c_char;
use std::path::Path;
use std::ptr::null;
use std::sync::Arc;

/// `msdd_surrogate_load`
///
/// # Safety
/// `source` is null or a C string; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_load(source: *const c_char, out: *mut *mut msdd_surrogate) -> i32 {
    status(|| {
        let out = writable("out", out)?;
        let source = match source.is_null() {
            true => models::BUILTIN.to_string(),
            // SAFETY: not null, a C string by this function's contract.
            false => unsafe { string("source", source)? },
        };
        let handle = Box::into_raw(Box::new(SurrogateHandle::new(load(&source)?)));
        // SAFETY: not null, writable by this function's contract.
        unsafe { out.write(handle.cast()) };
        Ok(())
    })
}

/// Start of a `source` that names a plug-in, a shared library.
const PLUGIN: &str = "plugin:";

fn load(source: &str) -> Result<Arc<dyn BatchModel>, Failure> {
    #[cfg(feature = "inject-panic")]
    assert_ne!(source, "panic", "injected");
    if let Some(path) = source.strip_prefix(PLUGIN) {
        return Ok(Arc::new(Plugin::load(Path::new(path))?));
    }
    let failed = |error| Failure::Model { path: source.to_string(), error };
    if source == models::BUILTIN || source.starts_with("builtin:") {
        return Ok(Arc::new(Own(models::builtin(source).map_err(failed)?)));
    }
    let text =
        std::fs::read_to_string(source).map_err(|error| Failure::File { path: source.to_string(), error })?;
    Ok(Arc::new(Own(models::read(&text).map_err(failed)?)))
}

/// The model behind a handle.
///
/// # Safety
/// `surrogate` is null or a live handle.
unsafe fn handle<'a>(surrogate: *const msdd_surrogate) -> Option<&'a SurrogateHandle> {
    // SAFETY: null or live by this function's contract; live handles come from `msdd_surrogate_load`.
    unsafe { surrogate.cast::<SurrogateHandle>().as_ref() }
}

/// As [`handle`], but a null handle is an error.
///
/// # Safety
/// As for [`handle`].
unsafe fn needed<'a>(surrogate: *const msdd_surrogate) -> Result<&'a SurrogateHandle, Failure> {
    // SAFETY: the caller guarantees it, by this function's contract.
    unsafe { handle(surrogate) }.ok_or_else(|| Failure::null("surrogate"))
}

/// `msdd_surrogate_with_conductivity`
///
/// # Safety
/// `surrogate` is null or a live handle; `kind` is null or a C string; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_with_conductivity(
    surrogate: *const msdd_surrogate,
    kind: *const c_char,
    out: *mut *mut msdd_surrogate,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or a C string, by this function's contract.
        let (handle, kind) = unsafe { (needed(surrogate)?, string("kind", kind)?) };
        let out = writable("out", out)?;
        let model = match handle.model.conductivity() == kind {
            true => handle.model.clone(),
            false => handle.model.with_conductivity(&kind).ok_or_else(|| {
                let allowed = handle.model.conductivities().join(", ");
                let name = handle.model.name();
                Failure::argument("kind", &kind, format!("{allowed}: what model \"{name}\" was trained for"))
            })?,
        };
        let handle = Box::into_raw(Box::new(SurrogateHandle::new(model)));
        // SAFETY: not null, writable by this function's contract.
        unsafe { out.write(handle.cast()) };
        Ok(())
    })
}

/// `msdd_surrogate_hash`
///
/// # Safety
/// `surrogate` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_hash(surrogate: *const msdd_surrogate) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(surrogate) };
    value(null(), || handle.map_or(null(), |handle| handle.hash.as_ptr()))
}

/// `msdd_surrogate_describe`
///
/// # Safety
/// `surrogate` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_describe(surrogate: *const msdd_surrogate) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(surrogate) };
    value(null(), || handle.map_or(null(), |handle| handle.description.as_ptr()))
}

/// `msdd_surrogate_state_size`
///
/// # Safety
/// `surrogate` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_state_size(surrogate: *const msdd_surrogate) -> usize {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(surrogate) };
    value(0, || handle.map_or(0, |handle| handle.state_names.len()))
}

/// `msdd_surrogate_state_name`
///
/// # Safety
/// `surrogate` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_state_name(
    surrogate: *const msdd_surrogate,
    column: usize,
) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(surrogate) };
    let name = || handle.and_then(|handle| handle.state_names.get(column));
    value(null(), || name().map_or(null(), |name| name.as_ptr()))
}

/// `msdd_surrogate_has_tangent`
///
/// # Safety
/// `surrogate` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_has_tangent(surrogate: *const msdd_surrogate) -> i32 {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(surrogate) };
    value(0, || handle.map_or(0, |handle| i32::from(handle.model.has_tangent())))
}

/// `msdd_surrogate_wall_friction`
///
/// # Safety
/// `surrogate` is null or a live handle; `material` is null or points to its struct; the outputs are null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_wall_friction(
    surrogate: *const msdd_surrogate,
    material: *const msdd_material,
    limit: *mut f64,
    slip: *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or pointing to its struct, by this function's contract.
        let (handle, material) = unsafe { (needed(surrogate)?, sized("material", material)?) };
        Si::new(&material)?;
        let [found_limit, found_slip] = handle.model.wall_friction().ok_or_else(|| {
            Failure::argument("surrogate", handle.model.name(), "a model trained with slipping walls")
        })?;
        for (out, value) in [(limit, found_limit), (slip, found_slip * material.mean_radius)] {
            if !out.is_null() {
                // SAFETY: not null, writable by this function's contract.
                unsafe { out.write(value) };
            }
        }
        Ok(())
    })
}

/// `msdd_surrogate_initial_state`
///
/// # Safety
/// `surrogate` is null or a live handle; the structs' pointers are null or point to their struct; the columns are null or
/// hold `cells` values; `state` is null or holds as many writable columns as the state has.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_initial_state(
    surrogate: *const msdd_surrogate,
    material: *const msdd_material,
    initial: *const msdd_initial,
    state: *const *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or pointing to their structs, by this function's contract.
        let (handle, material, initial) =
            unsafe { (needed(surrogate)?, sized("material", material)?, sized("initial", initial)?) };
        let (si, cells) = (Si::new(&material)?, initial.cells);
        batch::check_length(cells)?;
        // SAFETY: null or `cells` values, and writable columns, by this function's contract.
        let (start, columns) =
            unsafe { (start(&initial)?, batch::outputs("state", state, handle.names.len(), cells)?) };
        handle.model.initial_state(&start, &si, &columns)?;
        Ok(())
    })
}

/// Checked columns of an initial state.
///
/// # Safety
/// The columns are null or hold `cells` values.
unsafe fn start<'a>(initial: &msdd_initial) -> Result<InitialColumns<'a>, Failure> {
    let cells = initial.cells;
    // SAFETY: null or `cells` values by this function's contract.
    let needed = |name, start: *const f64| unsafe { Input::new(name, start, cells) };
    let optional = |name, start: *const f64| match start.is_null() {
        true => Ok(None),
        false => needed(name, start).map(Some),
    };
    let stress = [optional("stress_xx", initial.stress_xx)?, optional("stress_yy", initial.stress_yy)?];
    let conductivity = [
        optional("conductivity_xx", initial.conductivity_xx)?,
        optional("conductivity_yy", initial.conductivity_yy)?,
    ];
    let start = InitialColumns {
        cells,
        porosity: needed("porosity", initial.porosity)?,
        fabric_index: needed("fabric_index", initial.fabric_index)?,
        fabric_xy: optional("fabric_xy", initial.fabric_xy)?,
        stress_xy: optional("stress_xy", initial.stress_xy)?,
        conductivity: match conductivity {
            [Some(xx), Some(yy)] => Some([xx, yy]),
            [None, None] => None,
            _ => {
                return Err(Failure::argument(
                    "conductivity_xx, conductivity_yy",
                    "one of them",
                    "both or none",
                ));
            }
        },
        conductivity_xy: optional("conductivity_xy", initial.conductivity_xy)?,
        stress: match stress {
            [Some(xx), Some(yy)] => Some([xx, yy]),
            [None, None] => None,
            _ => return Err(Failure::argument("stress_xx, stress_yy", "one of them", "both or none")),
        },
    };
    let given =
        [start.porosity, start.fabric_index].into_iter().chain(start.fabric_xy).chain(start.stress_xy);
    let given = given.chain(start.conductivity.into_iter().flatten()).chain(start.conductivity_xy);
    given.chain(start.stress.into_iter().flatten()).try_for_each(|column| column.check_finite())?;
    start.porosity.check_range(0.0, 1.0, "0 to 1")?;
    start.fabric_index.check_range(-1.0, 1.0, "-1 to 1")?;
    if let Some(column) = &start.fabric_xy {
        column.check_range(-1.0, 1.0, "-1 to 1")?;
    }
    if start.conductivity.is_none() && start.conductivity_xy.is_some() {
        let allowed = "NULL without conductivity_xx and conductivity_yy";
        return Err(Failure::argument("conductivity_xy", "not NULL", allowed));
    }
    for column in start.conductivity.iter().flatten() {
        column.check_range(f64::MIN_POSITIVE, LARGEST_STRESS, "above 0, to 1e30 W/(m K)")?;
    }
    if let Some(column) = &start.conductivity_xy {
        column.check_range(-LARGEST_STRESS, LARGEST_STRESS, "-1e30 to 1e30 W/(m K)")?;
    }
    if start.stress.is_none() && start.stress_xy.is_some() {
        return Err(Failure::argument("stress_xy", "not NULL", "NULL without stress_xx and stress_yy"));
    }
    for column in start.stress.iter().flatten().chain(&start.stress_xy) {
        column.check_range(-LARGEST_STRESS, LARGEST_STRESS, "-1e30 to 1e30 Pa")?;
    }
    Ok(start)
}

/// `msdd_surrogate_advance`
///
/// # Safety
/// `surrogate` is null or a live handle; the others are null or point to their struct (to its `struct_size` at least);
/// the batch's columns are null or hold `cells` values, those of outputs writable by this thread alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_advance(
    surrogate: *const msdd_surrogate,
    material: *const msdd_material,
    batch: *mut msdd_batch,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or pointing to their structs, by this function's contract.
        let (handle, material, given) = unsafe {
            (needed(surrogate)?, sized("material", material)?, sized("batch", batch.cast_const())?)
        };
        // SAFETY: the columns are as this function's contract says.
        let columns = unsafe { Columns::new(&handle.names, &given)? };
        let clamped_cells = handle.model.advance(&columns, &Si::new(&material)?)?;
        // SAFETY: not null, and of full size, as checked.
        unsafe { (*batch).clamped_cells = clamped_cells };
        Ok(())
    })
}

/// `msdd_surrogate_solid_fraction`
///
/// # Safety
/// `surrogate` is null or a live handle; the columns are null or hold `cells` values, the output's writable by this
/// thread alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_solid_fraction(
    surrogate: *const msdd_surrogate,
    cells: usize,
    porosity: *const f64,
    solid_fraction: *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: null or live by this function's contract.
        let handle = unsafe { needed(surrogate)? };
        batch::check_length(cells)?;
        // SAFETY: null or `cells` values by this function's contract.
        let (input, output) =
            unsafe { (Input::new("porosity", porosity, cells)?, Output::new(solid_fraction, cells)) };
        if solid_fraction.is_null() && cells > 0 {
            return Err(Failure::null("solid_fraction"));
        }
        input.check_finite()?;
        input.check_range(0.0, 1.0, "0 to 1")?;
        handle.model.solid_fraction(&input, &output)
    })
}

/// `msdd_surrogate_free`
///
/// # Safety
/// `surrogate` is null or a live handle, which nobody uses from now on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_free(surrogate: *mut msdd_surrogate) {
    if !surrogate.is_null() {
        // SAFETY: made by `Box::into_raw` in `msdd_surrogate_load`, and freed once, by this function's contract.
        value((), || drop(unsafe { Box::from_raw(surrogate.cast::<SurrogateHandle>()) }));
    }
}
