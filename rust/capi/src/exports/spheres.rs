//! Functions of `msdd.h` about the law of spheres.

use super::{sized, string, writable};
use crate::abi::{msdd_sphere_batch, msdd_sphere_material, msdd_spheres};
use crate::batch::{check_length, outputs};
use crate::columns::{Input, Output};
use crate::handles::SpheresHandle;
use crate::si::LARGEST_STRESS;
use crate::sphere_material::{GasThere, Material};
use crate::status::{Failure, status, value};
use ::msdd_surrogate::kernel::{LANES, Lanes};
use ::msdd_surrogate::models::BUILTIN;
use ::msdd_surrogate::spheres::model::{Answers, Block, COLUMNS, NAMES, SphereModel, Wanted, allowed};
use ::msdd_surrogate::spheres::state::PackingData;
use ::msdd_surrogate::spheres::tensor::Tensor;
use std::ffi::c_char;
use std::ptr::null;

/// Components of a tensor, and what their columns are called in messages.
const COMPONENTS: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];
const AXES: [&str; 3] = ["x", "y", "z"];
/// Largest strain, and angle \[rad\] by which a cell turns, in one step.
const LARGEST_STEP: f64 = 0.2;
/// \[K\]
const REFERENCE_TEMPERATURE: f64 = 293.15;
/// Beside [`OUTSIDE`](::msdd_surrogate::spheres::model::OUTSIDE), in the column `outside`.
const OUTSIDE_BY_GAS: u8 = 8;

/// The law behind a handle.
///
/// # Safety
/// `spheres` is null or a live handle.
unsafe fn handle<'a>(spheres: *const msdd_spheres) -> Option<&'a SpheresHandle> {
    // SAFETY: null or live by this function's contract; live handles come from `msdd_spheres_load`.
    unsafe { spheres.cast::<SpheresHandle>().as_ref() }
}

/// `msdd_spheres_load`
///
/// # Safety
/// `source` is null or a C string; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_spheres_load(source: *const c_char, out: *mut *mut msdd_spheres) -> i32 {
    status(|| {
        let out = writable("out", out)?;
        let source = match source.is_null() {
            true => BUILTIN.to_string(),
            // SAFETY: not null, a C string by this function's contract.
            false => unsafe { string("source", source)? },
        };
        let failed = |error| Failure::Model { path: source.clone(), error };
        let model = match source == BUILTIN {
            true => SphereModel::builtin().map_err(failed)?,
            false => {
                let text = std::fs::read_to_string(&source)
                    .map_err(|error| Failure::File { path: source.clone(), error })?;
                SphereModel::read(&text).map_err(failed)?
            }
        };
        let handle = Box::into_raw(Box::new(SpheresHandle::new(model)));
        // SAFETY: not null, writable by this function's contract.
        unsafe { out.write(handle.cast()) };
        Ok(())
    })
}

/// `msdd_spheres_hash`
///
/// # Safety
/// `spheres` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_spheres_hash(spheres: *const msdd_spheres) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(spheres) };
    value(null(), || handle.map_or(null(), |handle| handle.hash.as_ptr()))
}

/// `msdd_spheres_describe`
///
/// # Safety
/// `spheres` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_spheres_describe(spheres: *const msdd_spheres) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(spheres) };
    value(null(), || handle.map_or(null(), |handle| handle.description.as_ptr()))
}

/// `msdd_spheres_state_size`
///
/// # Safety
/// `spheres` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_spheres_state_size(spheres: *const msdd_spheres) -> usize {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(spheres) };
    value(0, || handle.map_or(0, |handle| handle.state_names.len()))
}

/// `msdd_spheres_state_name`
///
/// # Safety
/// `spheres` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_spheres_state_name(
    spheres: *const msdd_spheres,
    column: usize,
) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { handle(spheres) };
    let name = || handle.and_then(|handle| handle.state_names.get(column));
    value(null(), || name().map_or(null(), |name| name.as_ptr()))
}

/// Readable columns from a caller's array of them, with names for messages.
///
/// # Safety
/// `columns`, unless null, points to as many pointers as there are names, each null or to `cells` values.
unsafe fn inputs<'a>(
    names: impl IntoIterator<Item = &'a str>,
    columns: *const *const f64,
    cells: usize,
) -> Result<Vec<Input<'a>>, Failure> {
    let names = names.into_iter().enumerate();
    // SAFETY: as many pointers, and what they point to, by this function's contract.
    names.map(|(k, name)| unsafe { Input::new(name, columns.add(k).read(), cells) }).collect()
}

/// A column that may be null.
///
/// # Safety
/// `column` is null or points to `cells` values.
unsafe fn optional<'a>(
    name: &'a str,
    column: *const f64,
    cells: usize,
) -> Result<Option<Input<'a>>, Failure> {
    match column.is_null() {
        true => Ok(None),
        // SAFETY: `cells` values by this function's contract.
        false => unsafe { Input::new(name, column, cells) }.map(Some),
    }
}

/// `msdd_spheres_initial_state`
///
/// # Safety
/// `spheres` is null or a live handle; `material` is null or points to its struct, whose gas is null or a C string; the columns are
/// null or hold `cells` values; `stress` and `fabric` are null or hold six columns, `state` null or as many writable ones as the state
/// has.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_spheres_initial_state(
    spheres: *const msdd_spheres,
    material: *const msdd_sphere_material,
    cells: usize,
    solid_fraction: *const f64,
    stress: *const *const f64,
    coordination: *const f64,
    mobilised: *const f64,
    fabric: *const *const f64,
    state: *const *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: null or live by this function's contract.
        let handle = unsafe { handle(spheres) }.ok_or_else(|| Failure::null("spheres"))?;
        check_length(cells)?;
        // SAFETY: null or pointing to its struct with a C string, by this function's contract.
        let material = unsafe { Material::new(&sized("material", material)?)? };
        if stress.is_null() {
            return Err(Failure::null("stress"));
        }
        let names = COMPONENTS.map(|component| format!("stress[{component}]"));
        let fabric_names = COMPONENTS.map(|component| format!("fabric[{component}]"));
        // SAFETY: `cells` values, six columns, and writable columns by this function's contract.
        let (solid, stress, coordination, mobilised, fabric, state) = unsafe {
            (
                Input::new("solid_fraction", solid_fraction, cells)?,
                inputs(names.iter().map(String::as_str), stress, cells)?,
                optional("coordination", coordination, cells)?,
                optional("mobilised", mobilised, cells)?,
                match fabric.is_null() {
                    true => None,
                    false => Some(inputs(fabric_names.iter().map(String::as_str), fabric, cells)?),
                },
                outputs("state", state, COLUMNS, cells)?,
            )
        };
        solid.check_finite()?;
        solid.check_range(0.3, 0.8, "0.3 to 0.8")?;
        for column in &stress {
            column.check_finite()?;
            column.check_range(-LARGEST_STRESS, LARGEST_STRESS, "-1e30 to 1e30 Pa")?;
        }
        if let Some(column) = &coordination {
            column.check_finite()?;
            column.check_range(0.0, 12.0, "0 to 12")?;
        }
        if let Some(column) = &mobilised {
            column.check_finite()?;
            column.check_range(0.0, 1.0, "0 to 1")?;
        }
        for column in fabric.iter().flatten() {
            column.check_finite()?;
            column.check_range(-1.0, 1.0, "-1 to 1")?;
        }
        for cell in 0..cells {
            let stress: Tensor = std::array::from_fn(|k| stress[k].at(cell) / material.modulus());
            let known = PackingData {
                coordination: coordination.map(|column| column.at(cell)),
                mobilised: mobilised.map(|column| column.at(cell)),
                fabric: fabric.as_ref().map(|columns| std::array::from_fn(|k| columns[k].at(cell))),
            };
            let found = handle.model.initial_state(material.density() * solid.at(cell), stress, &known);
            state.iter().zip(found).for_each(|(column, value)| column.write_one(cell, value));
        }
        Ok(())
    })
}

/// Checked columns of a batch.
struct Columns<'a> {
    state: Vec<Input<'a>>,
    thermal: Option<Input<'a>>,
    /// Six and three columns, or none.
    strain: Vec<Input<'a>>,
    rotation: Vec<Input<'a>>,
    temperature: Option<Input<'a>>,
    solid_conductivity: Option<Input<'a>>,
    emissivity: Option<Input<'a>>,
    next_state: Vec<Output<f64>>,
    stress: Vec<Output<f64>>,
    tangent: Vec<Output<f64>>,
    conductivity: Vec<Output<f64>>,
    gas: Output<f64>,
    radiation: Output<f64>,
    solid: Output<f64>,
    outside: Output<u8>,
}

/// Names of the columns of strain and rotation in messages.
struct Names {
    strain: [String; 6],
    rotation: [String; 3],
}

impl<'a> Columns<'a> {
    /// # Safety
    /// The batch's columns are null or hold `cells` values, those of outputs writable by this thread alone.
    unsafe fn new(batch: &msdd_sphere_batch, names: &'a Names) -> Result<Self, Failure> {
        let cells = batch.cells;
        check_length(cells)?;
        if batch.state.is_null() {
            return Err(Failure::null("state"));
        }
        let optional = |name, start: *const f64| match start.is_null() {
            true => Ok(None),
            // SAFETY: `cells` values by this function's contract.
            false => unsafe { Input::new(name, start, cells) }.map(Some),
        };
        let several = |names: &'a [String], columns: *const *const f64| match columns.is_null() {
            true => Ok(Vec::new()),
            // SAFETY: as many columns by this function's contract.
            false => unsafe { inputs(names.iter().map(String::as_str), columns, cells) },
        };
        let wanted = |name, columns: *const *mut f64, count| match columns.is_null() {
            true => Ok(Vec::new()),
            // SAFETY: as many columns by this function's contract.
            false => unsafe { outputs(name, columns, count, cells) },
        };
        // SAFETY: the columns are as this function's contract says.
        let columns = unsafe {
            Self {
                state: inputs(NAMES, batch.state, cells)?,
                thermal: optional("thermal_strain", batch.thermal_strain)?,
                strain: several(&names.strain, batch.strain)?,
                rotation: several(&names.rotation, batch.rotation)?,
                temperature: optional("temperature", batch.temperature)?,
                solid_conductivity: optional("solid_conductivity", batch.solid_conductivity)?,
                emissivity: optional("emissivity", batch.emissivity)?,
                next_state: wanted("next_state", batch.next_state, COLUMNS)?,
                stress: wanted("stress", batch.stress, 6)?,
                tangent: wanted("tangent", batch.tangent, 36)?,
                conductivity: wanted("conductivity", batch.conductivity, 6)?,
                gas: Output::new(batch.gas_conductivity, cells),
                radiation: Output::new(batch.radiation_conductivity, cells),
                solid: Output::new(batch.solid_fraction, cells),
                outside: Output::new(batch.outside, cells),
            }
        };
        columns.check()?;
        Ok(columns)
    }

    fn check(&self) -> Result<(), Failure> {
        for (k, column) in self.state.iter().enumerate() {
            let ([least, most], range) = allowed(k);
            // A number that is not finite is out of every range.
            column.check_range(least, most, range).or_else(|error| column.check_finite().and(Err(error)))?;
        }
        for column in self.thermal.iter().chain(&self.strain).chain(&self.rotation) {
            column.check_finite()?;
            // The lower end does not belong to the range.
            if let Some(cell) = column.position(|value| value <= -LARGEST_STEP || value > LARGEST_STEP) {
                let name = format!("{}[{cell}]", column.name);
                return Err(Failure::number(name, column.at(cell), "above -0.2, to 0.2"));
            }
        }
        if let Some(column) = &self.temperature {
            column.check_finite()?;
            column.check_range(0.0, 1e5, "0 to 1e5 K")?;
        }
        if let Some(column) = &self.solid_conductivity {
            column.check_finite()?;
            column.check_range(1e-12, 1e12, "1e-12 to 1e12 W/(m K)")?;
        }
        if let Some(column) = &self.emissivity {
            column.check_finite()?;
            column.check_range(0.0, 1.0, "0 to 1")?;
        }
        Ok(())
    }

    fn wanted(&self) -> Wanted {
        // Columns of a row of the tangent, up to the last that is wanted in any of them.
        let strains = self.tangent.iter().enumerate().filter(|(_, column)| column.is_wanted());
        let strains = strains.map(|(k, _)| k % 6 + 1).max().unwrap_or(0);
        let conducts = self.conductivity.iter().chain([&self.gas, &self.radiation]);
        let mechanics_alone = strains > 0 || self.stress.iter().any(Output::is_wanted);
        let conduction = self.outside.is_wanted() || { conducts }.any(Output::is_wanted) || !mechanics_alone;
        Wanted { strains, conduction }
    }

    /// Takes all cells through the step; returns the number of those outside of the range.
    fn advance(&self, model: &SphereModel, material: &Material, cells: usize) -> Result<usize, Failure> {
        let one = |column: &Option<Input>, usual, cell| column.map_or(usual, |column: Input| column.at(cell));
        let there = |cell| {
            material.with(
                one(&self.solid_conductivity, material.solid_conductivity(), cell),
                one(&self.emissivity, material.emissivity(), cell),
            )
        };
        let wanted = self.wanted();
        // Everything that can be refused, before anything is written.
        let gas_at = |cell| there(cell).gas(one(&self.temperature, REFERENCE_TEMPERATURE, cell));
        let conducting = if wanted.conduction { cells } else { 0 };
        let gases: Vec<GasThere> = (0..conducting).map(gas_at).collect::<Result<_, _>>()?;
        let mut count = 0;
        let (mut block, mut answers) = (Block::default(), Answers::default());
        for first in (0..cells).step_by(LANES) {
            let here = (cells - first).min(LANES);
            // What is not given is 0.
            let read = |lanes: &mut [Lanes], columns: &[Input]| {
                lanes.iter_mut().zip(columns).for_each(|(lanes, column)| *lanes = column.lanes(first));
            };
            read(&mut block.state, &self.state);
            read(&mut block.cell, &self.strain);
            read(&mut block.rotation, &self.rotation);
            if let Some(column) = &self.thermal {
                block.thermal = column.lanes(first);
            }
            let gases = gases.get(first..first + here).unwrap_or_default();
            block.gas_number.iter_mut().zip(gases).for_each(|(number, gas)| *number = gas.number);
            model.advance_block(&block, here, wanted, &mut answers);
            let write = |columns: &[Output<f64>], lanes: &[Lanes]| {
                columns.iter().zip(lanes).for_each(|(column, lanes)| column.write(first, lanes));
            };
            let in_pascal = |lanes: &Lanes| lanes.map(|value| value * material.modulus());
            write(&self.next_state, &answers.state);
            write(&self.stress, &answers.stress.each_ref().map(in_pascal));
            if !self.tangent.is_empty() {
                for (column, lanes) in self.tangent.iter().zip(answers.tangent.as_flattened()) {
                    column.write(first, &in_pascal(lanes));
                }
            }
            self.solid.write(first, &answers.solid.map(|solid| solid / material.density()));
            for k in 0..here {
                let (cell, gas) = (first + k, gases.get(k));
                let of_gas = gas.is_some_and(|gas| gas.outside);
                let outside = answers.outside_at(k) | if of_gas { OUTSIDE_BY_GAS } else { 0 };
                self.outside.write_one(cell, outside);
                count += usize::from(outside > 0);
                let Some(gas) = gas else { continue };
                let found = there(cell).conductivity(&answers, k, gas);
                for (column, value) in self.conductivity.iter().zip(found.tensor) {
                    column.write_one(cell, value);
                }
                self.gas.write_one(cell, found.gas);
                self.radiation.write_one(cell, found.radiation);
            }
        }
        Ok(count)
    }
}

/// `msdd_spheres_advance`
///
/// # Safety
/// `spheres` is null or a live handle; the structs' pointers are null or point to their struct (to its `struct_size` at least), the
/// material's gas is null or a C string; the batch's columns are null or hold `cells` values, those of outputs writable by this thread alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_spheres_advance(
    spheres: *const msdd_spheres,
    material: *const msdd_sphere_material,
    batch: *mut msdd_sphere_batch,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and null or pointing to its struct, by this function's contract.
        let (handle, material, given) = unsafe {
            (
                handle(spheres),
                Material::new(&sized("material", material)?)?,
                sized("batch", batch.cast_const())?,
            )
        };
        let handle = handle.ok_or_else(|| Failure::null("spheres"))?;
        let names = Names {
            strain: COMPONENTS.map(|component| format!("strain[{component}]")),
            rotation: AXES.map(|axis| format!("rotation[{axis}]")),
        };
        // SAFETY: the columns are as this function's contract says.
        let columns = unsafe { Columns::new(&given, &names)? };
        let outside = columns.advance(&handle.model, &material, given.cells)?;
        // SAFETY: not null, and of full size, as checked.
        unsafe { (*batch).outside_cells = outside };
        Ok(())
    })
}

/// `msdd_spheres_free`
///
/// # Safety
/// `spheres` is null or a live handle, which nobody uses from now on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_spheres_free(spheres: *mut msdd_spheres) {
    if !spheres.is_null() {
        // SAFETY: made by `Box::into_raw` in `msdd_spheres_load`, and freed once, by this function's contract.
        value((), || drop(unsafe { Box::from_raw(spheres.cast::<SpheresHandle>()) }));
    }
}
