//! A loaded plug-in: calls of its functions, and checks of their results.

use crate::PluginError;
use crate::checks::{self, Question};
use crate::columns::{Inputs, pointers, unwritten};
use crate::library::{load, text};
use crate::names::state_names;
use crate::questions::{Answer, Columns, InitialColumns, Step, WallFriction};
use msdd_abi::{msdd_plugin_start, msdd_plugin_step, msdd_plugin_v2};
use std::ffi::c_char;
use std::path::Path;
use std::ptr::null;
use std::sync::atomic::{AtomicBool, Ordering};

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
    has_tangent: bool,
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
    unsafe fn from_table(path: &Path, table: &msdd_plugin_v2, hash: String) -> Result<Self, String> {
        // SAFETY: the caller guarantees it, by this function's contract.
        let (name, state_names) = unsafe { (text("name", table.name)?, state_names(table)?) };
        let flag = |name: &str, value: u32| match value {
            0 | 1 => Ok(value == 1),
            other => Err(format!("{name} = {other}, allowed: 0, 1")),
        };
        Ok(Self {
            label: format!("\"{name}\" ({})", path.display()),
            name,
            hash,
            state_names,
            network_conductivity: flag("network_conductivity", table.network_conductivity)?,
            has_tangent: flag("has_tangent", table.has_tangent)?,
            initial_state: table.initial_state.ok_or("initial_state is NULL")?,
            advance: table.advance.ok_or("advance is NULL")?,
            solid_fraction: table.solid_fraction,
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
        self.has_tangent
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
    pub fn initial_state(&self, start: &InitialColumns) -> Result<Vec<Vec<f64>>, PluginError> {
        let question = self.question("initial_state");
        let state = self.ask_start(start)?;
        question.columns(&question.state(&state))?;
        question.start(&state, [start.porosity, start.fabric_index])?;
        if first_time(&self.started, start.porosity.len()) {
            question.again(&question.state(&state), &question.state(&self.ask_start(start)?))?;
        }
        Ok(state)
    }

    fn ask_start(&self, start: &InitialColumns) -> Result<Vec<Vec<f64>>, PluginError> {
        let cells = start.porosity.len();
        let columns: Vec<&[f64]> = [start.porosity, start.fabric_index]
            .into_iter()
            .chain(start.fabric_xy)
            .chain(start.stress.into_iter().flatten())
            .chain(start.conductivity.into_iter().flatten())
            .collect();
        let inputs = Inputs::new(&columns, cells);
        let stress = 2 + usize::from(start.fabric_xy.is_some());
        let conductivity = stress + if start.stress.is_some() { 3 } else { 0 };
        let given = |known: bool, column: usize| if known { inputs.pointer(column) } else { null() };
        let mut state = vec![unwritten(cells); self.state_names.len()];
        let to = pointers(&mut state);
        let given = msdd_plugin_start {
            struct_size: size_of::<msdd_plugin_start>(),
            cells,
            porosity: inputs.pointer(0),
            fabric_index: inputs.pointer(1),
            fabric_xy: given(start.fabric_xy.is_some(), 2),
            stress_xx: given(start.stress.is_some(), stress),
            stress_yy: given(start.stress.is_some(), stress + 1),
            stress_xy: given(start.stress.is_some(), stress + 2),
            conductivity_xx: given(start.conductivity.is_some(), conductivity),
            conductivity_yy: given(start.conductivity.is_some(), conductivity + 1),
            conductivity_xy: given(start.conductivity.is_some(), conductivity + 2),
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
        let question = self.question("advance");
        let answer = self.ask_step(step)?;
        question.columns(&question.answer(&answer))?;
        question.tensors(&answer)?;
        let strains: Vec<&[f64]> =
            std::iter::once(step.thermal_strain).chain(step.strain.into_iter().flatten()).collect();
        question.rest(step.state, &strains, &answer.state, &answer.outside)?;
        question.packing(step.state, &answer.state)?;
        if first_time(&self.advanced, step.thermal_strain.len()) {
            question.again(&question.answer(&answer), &question.answer(&self.ask_step(step)?))?;
        }
        Ok(answer)
    }

    fn ask_step(&self, step: &Step) -> Result<Answer, PluginError> {
        let (cells, count) = (step.thermal_strain.len(), self.count(step.state));
        let strain = step.strain.filter(|_| self.has_tangent);
        let columns: Vec<&[f64]> = step
            .state
            .iter()
            .copied()
            .chain([step.thermal_strain])
            .chain(strain.into_iter().flatten())
            .collect();
        let inputs = Inputs::new(&columns, cells);
        let zero = || vec![0.0; cells];
        let wanted = step.wants_tangent && self.has_tangent;
        let mut answer = Answer {
            state: vec![unwritten(cells); count],
            conductivity: [unwritten(cells), unwritten(cells), zero()],
            stress: [unwritten(cells), unwritten(cells), zero()],
            tangent: wanted.then(|| std::array::from_fn(|_| unwritten(cells))),
            outside: vec![zero(); count + 1],
        };
        let (next, outside) = (pointers(&mut answer.state), pointers(&mut answer.outside));
        let tangent = answer.tangent.as_mut().map(|columns| pointers(columns));
        let [kxx, kyy, kxy] = answer.conductivity.each_mut().map(|column| column.as_mut_ptr());
        let [sxx, syy, sxy] = answer.stress.each_mut().map(|column| column.as_mut_ptr());
        let given = |k: usize| if strain.is_some() { inputs.pointer(count + 1 + k) } else { null() };
        let step = msdd_plugin_step {
            struct_size: size_of::<msdd_plugin_step>(),
            cells,
            state: inputs.pointers(),
            thermal_strain: inputs.pointer(count),
            strain_xx: given(0),
            strain_yy: given(1),
            strain_xy: given(2),
            rotation: given(3),
            next_state: next.as_ptr(),
            conductivity_xx: kxx,
            conductivity_yy: kyy,
            conductivity_xy: kxy,
            stress_xx: sxx,
            stress_yy: syy,
            stress_xy: sxy,
            tangent: tangent.as_ref().map_or(null(), |columns| columns.as_ptr()),
            outside: outside.as_ptr(),
        };
        // SAFETY: columns of `cells` values, and arrays of as many columns as the table and the header say.
        self.status("advance", cells, || unsafe { (self.advance)(&step) })?;
        Ok(answer)
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

fn wall_friction(table: &msdd_plugin_v2) -> Result<Option<WallFriction>, String> {
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
