//! A loaded plug-in: calls of its functions, and checks of their results.

use crate::PluginError;
use crate::checks::{self, Question};
use crate::columns::{Inputs, pointers, slices, unwritten};
use crate::library::{load, text};
use crate::names::state_names;
use crate::questions::{Answer, Columns, Start, Step, WallFriction};
use msdd_abi::{msdd_plugin_start, msdd_plugin_step, msdd_plugin_tangent, msdd_plugin_v1};
use std::ffi::c_char;
use std::path::Path;
use std::ptr::null;
use std::sync::atomic::{AtomicBool, Ordering};

type Deform = unsafe extern "C" fn(usize, *const *const f64, *const f64, *const f64, *const *mut f64) -> i32;
type Tangent = unsafe extern "C" fn(*const msdd_plugin_tangent) -> i32;

/// A surrogate model from a shared library; any number of threads may use it at the same time.
#[derive(Debug)]
pub struct Plugin {
    /// Its name and path, for messages.
    label: String,
    name: String,
    hash: String,
    state_names: Vec<String>,
    network_conductivity: bool,
    initial_state: unsafe extern "C" fn(*const msdd_plugin_start) -> i32,
    advance: unsafe extern "C" fn(*const msdd_plugin_step) -> i32,
    solid_fraction: Option<unsafe extern "C" fn(usize, *const f64, *mut f64) -> i32>,
    mechanics: Option<(Tangent, Deform)>,
    spread: Option<unsafe extern "C" fn(usize, *const *const f64, *mut f64) -> i32>,
    last_error: Option<unsafe extern "C" fn() -> *const c_char>,
    wall_friction: Option<WallFriction>,
    /// Whether `initial_state` and `advance` have been called before: the first call of each is made twice, and the results
    /// are compared.
    started: AtomicBool,
    advanced: AtomicBool,
}

impl Plugin {
    /// Loads a shared library, which stays loaded until the process ends.
    ///
    /// # Errors
    /// [`PluginError::Read`] or [`PluginError::Unfit`] with the reason.
    pub fn load(path: &Path) -> Result<Self, PluginError> {
        let loaded = load(path)?;
        // SAFETY: version and size of the table have been checked; its pointers are as the header requires.
        unsafe { Self::from_table(path, &loaded.table, loaded.hash) }
            .map_err(|reason| PluginError::Unfit { path: path.display().to_string(), reason })
    }

    /// # Safety
    /// The table's pointers are null or as the header requires.
    unsafe fn from_table(path: &Path, table: &msdd_plugin_v1, hash: String) -> Result<Self, String> {
        // SAFETY: the caller guarantees it, by this function's contract.
        let (name, state_names) = unsafe { (text("name", table.name)?, state_names(table)?) };
        let mechanics = match (table.tangent, table.deform) {
            (None, None) => None,
            (Some(tangent), Some(deform)) => Some((tangent, deform)),
            (Some(_), None) => return Err("deform is NULL, but tangent is not: both or none".to_string()),
            (None, Some(_)) => return Err("tangent is NULL, but deform is not: both or none".to_string()),
        };
        let network_conductivity = match table.network_conductivity {
            0 => false,
            1 => true,
            other => return Err(format!("network_conductivity = {other}, allowed: 0, 1")),
        };
        Ok(Self {
            label: format!("\"{name}\" ({})", path.display()),
            name,
            hash,
            state_names,
            network_conductivity,
            initial_state: table.initial_state.ok_or("initial_state is NULL")?,
            advance: table.advance.ok_or("advance is NULL")?,
            solid_fraction: table.solid_fraction,
            mechanics,
            spread: table.spread,
            last_error: table.last_error,
            wall_friction: wall_friction(table)?,
            started: AtomicBool::new(false),
            advanced: AtomicBool::new(false),
        })
    }

    /// Name that the plug-in gives itself.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// SHA-256 of the file, 64 hexadecimal digits.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// Names of the state columns; the first two are porosity and fabric_index.
    pub fn state_names(&self) -> &[String] {
        &self.state_names
    }

    /// Whether its K is that of the resistor network solved; else it is affine, Eq. 9 of the paper.
    pub fn network_conductivity(&self) -> bool {
        self.network_conductivity
    }

    /// Whether it has a mechanical tangent.
    pub fn has_tangent(&self) -> bool {
        self.mechanics.is_some()
    }

    /// Whether it has a function for the solid fraction.
    pub fn has_solid_fraction(&self) -> bool {
        self.solid_fraction.is_some()
    }

    pub fn wall_friction(&self) -> Option<WallFriction> {
        self.wall_friction
    }

    /// Initial state of cells, one column per state name.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    ///
    /// # Panics
    /// When columns differ in length. The other functions panic then, too, and when columns are missing.
    pub fn initial_state(&self, start: &Start) -> Result<Vec<Vec<f64>>, PluginError> {
        let question = self.question("initial_state");
        let state = self.ask_start(start)?;
        question.columns(&question.state(&state))?;
        question.start(&state, [start.porosity, start.fabric_index])?;
        if first_time(&self.started, start.porosity.len()) {
            question.again(&question.state(&state), &question.state(&self.ask_start(start)?))?;
        }
        Ok(state)
    }

    fn ask_start(&self, start: &Start) -> Result<Vec<Vec<f64>>, PluginError> {
        let cells = start.porosity.len();
        let stress = start.stress.into_iter().flatten();
        let columns: Vec<&[f64]> = [start.porosity, start.fabric_index]
            .into_iter()
            .chain(start.fabric_conductivity)
            .chain(stress)
            .collect();
        let inputs = Inputs::new(&columns, cells);
        let stress = 2 + usize::from(start.fabric_conductivity.is_some());
        let given = |known: bool, column: usize| if known { inputs.pointer(column) } else { null() };
        let mut state = vec![unwritten(cells); self.state_names.len()];
        let to = pointers(&mut state);
        let given = msdd_plugin_start {
            struct_size: size_of::<msdd_plugin_start>(),
            cells,
            porosity: inputs.pointer(0),
            fabric_index: inputs.pointer(1),
            fabric_conductivity: given(start.fabric_conductivity.is_some(), 2),
            stress_xx: given(start.stress.is_some(), stress),
            stress_yy: given(start.stress.is_some(), stress + 1),
            state: to.as_ptr(),
        };
        // SAFETY: columns of `cells` values, and `state` of as many columns as the table says.
        self.status("initial_state", cells, || unsafe { (self.initial_state)(&given) })?;
        Ok(state)
    }

    /// Takes cells through one step.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    pub fn advance(&self, step: &Step) -> Result<Answer, PluginError> {
        let mut answer = self.advance_once(step.state, step.thermal_strain, step.virgin_share)?;
        if let Some(strain) = step.strain {
            let deformed = self.deformed(&answer, strain)?;
            let rest = vec![0.0; step.thermal_strain.len()];
            let after = self.advance_once(&slices(&deformed), &rest, None)?;
            answer = Answer { outside: answer.outside, ..after };
        }
        self.question("advance").packing(step.state, &answer.state)?;
        Ok(answer)
    }

    /// Makes and checks a step of thermal strain, without mechanical strain.
    fn advance_once(
        &self,
        state: Columns,
        thermal_strain: &[f64],
        virgin_share: Option<&[f64]>,
    ) -> Result<Answer, PluginError> {
        let question = self.question("advance");
        let answer = self.ask_step(state, thermal_strain, virgin_share)?;
        question.columns(&question.answer(&answer))?;
        question.rest(state, &[thermal_strain], &answer.state, &answer.outside)?;
        if first_time(&self.advanced, thermal_strain.len()) {
            let second = self.ask_step(state, thermal_strain, virgin_share)?;
            question.again(&question.answer(&answer), &question.answer(&second))?;
        }
        Ok(answer)
    }

    fn ask_step(
        &self,
        state: Columns,
        thermal_strain: &[f64],
        virgin_share: Option<&[f64]>,
    ) -> Result<Answer, PluginError> {
        let (cells, count) = (thermal_strain.len(), self.count(state));
        let columns: Vec<&[f64]> =
            state.iter().copied().chain([thermal_strain]).chain(virgin_share).collect();
        let inputs = Inputs::new(&columns, cells);
        let mut answer = Answer {
            state: vec![unwritten(cells); count],
            conductivity: [unwritten(cells), unwritten(cells)],
            stress: [unwritten(cells), unwritten(cells)],
            outside: vec![vec![0.0; cells]; count + 1],
        };
        let (next, outside) = (pointers(&mut answer.state), pointers(&mut answer.outside));
        let ([kxx, kyy], [sxx, syy]) = (&mut answer.conductivity, &mut answer.stress);
        let step = msdd_plugin_step {
            struct_size: size_of::<msdd_plugin_step>(),
            cells,
            state: inputs.pointers(),
            thermal_strain: inputs.pointer(count),
            next_state: next.as_ptr(),
            conductivity_xx: kxx.as_mut_ptr(),
            conductivity_yy: kyy.as_mut_ptr(),
            stress_xx: sxx.as_mut_ptr(),
            stress_yy: syy.as_mut_ptr(),
            outside: outside.as_ptr(),
            virgin_share: virgin_share.map_or(null(), |_| inputs.pointer(count + 1)),
        };
        // SAFETY: columns of `cells` values, and arrays of as many columns as the table says.
        self.status("advance", cells, || unsafe { (self.advance)(&step) })?;
        Ok(answer)
    }

    /// State after mechanical strains that follow on the thermal step `before`. Without a tangent, the state of `before`.
    fn deformed(&self, before: &Answer, strain: [&[f64]; 2]) -> Result<Vec<Vec<f64>>, PluginError> {
        let state = slices(&before.state);
        let Some((_, deform)) = self.mechanics else { return Ok(before.state.clone()) };
        let (cells, count) = (strain[0].len(), self.count(&state));
        let columns: Vec<&[f64]> = state.iter().copied().chain(strain).collect();
        let inputs = Inputs::new(&columns, cells);
        let mut next = vec![unwritten(cells); count];
        let to = pointers(&mut next);
        let (xx, yy) = (inputs.pointer(count), inputs.pointer(count + 1));
        // SAFETY: columns of `cells` values, and arrays of as many columns as the table says.
        self.status("deform", cells, || unsafe { deform(cells, inputs.pointers(), xx, yy, to.as_ptr()) })?;
        let question = self.question("deform");
        question.columns(&question.state(&next))?;
        question.rest(&state, &strain, &next, &before.outside)?;
        Ok(next)
    }

    /// c11, c22, c12 (reduced), rates of porosity and fabric index at a state; `None` when it has no tangent.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    pub fn tangent(&self, state: Columns) -> Result<Option<[Vec<f64>; 5]>, PluginError> {
        let Some((tangent, _)) = self.mechanics else { return Ok(None) };
        let cells = state[..self.count(state)][0].len();
        let inputs = Inputs::new(state, cells);
        let mut columns: [Vec<f64>; 5] = std::array::from_fn(|_| unwritten(cells));
        let [c11, c22, c12, porosity_rate, fabric_index_rate] = columns.each_mut().map(|c| c.as_mut_ptr());
        let wanted = msdd_plugin_tangent {
            struct_size: size_of::<msdd_plugin_tangent>(),
            cells,
            state: inputs.pointers(),
            c11,
            c22,
            c12,
            porosity_rate,
            fabric_index_rate,
        };
        // SAFETY: columns of `cells` values, and `state` of as many columns as the table says.
        self.status("tangent", cells, || unsafe { tangent(&wanted) })?;
        let question = self.question("tangent");
        let [c11, c22, c12, porosity, fabric_index] = columns.each_ref().map(Vec::as_slice);
        question.stiffness([c11, c22, c12])?;
        question.column("porosity_rate", porosity, checks::FINITE)?;
        question.column("fabric_index_rate", fabric_index, checks::FINITE)?;
        Ok(Some(columns))
    }

    /// Relative standard deviation of K between RVEs of equal state; `None` when the plug-in does not know it.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    pub fn spread(&self, state: Columns) -> Result<Option<Vec<f64>>, PluginError> {
        let Some(spread) = self.spread else { return Ok(None) };
        let cells = state[..self.count(state)][0].len();
        let (inputs, mut column) = (Inputs::new(state, cells), unwritten(cells));
        // SAFETY: columns of `cells` values, and `state` of as many columns as the table says.
        self.status("spread", cells, || unsafe { spread(cells, inputs.pointers(), column.as_mut_ptr()) })?;
        self.question("spread").column("spread", &column, checks::SPREAD)?;
        Ok(Some(column))
    }

    /// Solid fractions, overlaps counted twice, of initial states; `None` when the plug-in does not know them.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    pub fn solid_fraction(&self, porosity: &[f64]) -> Result<Option<Vec<f64>>, PluginError> {
        let Some(solid_fraction) = self.solid_fraction else { return Ok(None) };
        let cells = porosity.len();
        let (inputs, mut column) = (Inputs::new(&[porosity], cells), unwritten(cells));
        // SAFETY: columns of `cells` values.
        let call = || unsafe { solid_fraction(cells, inputs.pointer(0), column.as_mut_ptr()) };
        self.status("solid_fraction", cells, call)?;
        self.question("solid_fraction").column("solid_fraction", &column, checks::SOLID_FRACTION)?;
        Ok(Some(column))
    }

    fn question(&self, function: &'static str) -> Question<'_> {
        Question { plugin: &self.label, function, state_names: &self.state_names }
    }

    /// Number of state columns; panics when another number is given.
    fn count(&self, state: Columns) -> usize {
        assert_eq!(state.len(), self.state_names.len(), "state columns");
        state.len()
    }

    /// Calls a function unless there are no cells, and turns its status into an error with the plug-in's text.
    fn status(
        &self,
        function: &'static str,
        cells: usize,
        call: impl FnOnce() -> i32,
    ) -> Result<(), PluginError> {
        if cells == 0 {
            return Ok(());
        }
        let status = call();
        if status == 0 {
            return Ok(());
        }
        let text = self.last_error.map_or(Err("it gives no message".to_string()), |last_error| {
            // SAFETY: takes nothing, and returns null or a C string, by the header.
            unsafe { text("the text of its last_error", last_error()) }
        });
        let text = text.unwrap_or_else(|reason| reason);
        Err(PluginError::Failed { plugin: self.label.clone(), function, status, text })
    }
}

fn wall_friction(table: &msdd_plugin_v1) -> Result<Option<WallFriction>, String> {
    let (limit, slip) = (table.wall_friction_limit, table.wall_friction_slip);
    if limit == 0.0 {
        return Ok(None);
    }
    match limit > 0.0 && limit.is_finite() && slip > 0.0 && slip.is_finite() {
        true => Ok(Some(WallFriction { limit, slip })),
        false => Err(format!("wall friction of limit {limit} and slip {slip}, allowed: above 0, or limit 0")),
    }
}

/// Whether this is the first call of a function with any cells; remembers the call in `asked`.
fn first_time(asked: &AtomicBool, cells: usize) -> bool {
    cells > 0 && !asked.swap(true, Ordering::Relaxed)
}
