//! A loaded plug-in: calls of its functions, and checks of what they answer.

use crate::PluginError;
use crate::library::{load, text};
use msdd_abi::{msdd_plugin_start, msdd_plugin_step, msdd_plugin_tangent, msdd_plugin_v1};
use std::ffi::c_char;
use std::path::Path;
use std::ptr::null;

/// State columns at most: nobody means more, and a wrong table is likely to say more.
const MOST_COLUMNS: usize = 64;

type Columns<'a> = &'a [&'a [f64]];
type Deform = unsafe extern "C" fn(usize, *const *const f64, *const f64, *const f64, *const *mut f64) -> i32;
type Tangent = unsafe extern "C" fn(*const msdd_plugin_tangent) -> i32;

/// A surrogate model from a shared library; any number of threads may ask it.
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
}

/// Mobilised wall friction limit s/(s + slip) after the slip s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallFriction {
    /// \[-\]
    pub limit: f64,
    /// In mean radii.
    pub slip: f64,
}

/// What is known of cells at the start: columns of equal length. Stress reduced, σ ℓ/(E r̄), compression positive.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a> {
    pub porosity: &'a [f64],
    pub fabric_index: &'a [f64],
    pub fabric_conductivity: Option<&'a [f64]>,
    /// σ_xx, σ_yy.
    pub stress: Option<[&'a [f64]; 2]>,
}

/// One step of cells: columns of equal length, finite. Strains extension positive.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// One column a state name.
    pub state: Columns<'a>,
    /// Above −1.
    pub thermal_strain: &'a [f64],
    /// Share of it, 0 to 1, that leads beyond all that the cell has been strained to before; `None`: all of it.
    pub virgin_share: Option<&'a [f64]>,
    /// Mechanical strains along x and y, after the thermal one; for plug-ins that have a tangent.
    pub strain: Option<[&'a [f64]; 2]>,
}

/// Columns after a step, all finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// One column a state name.
    pub state: Vec<Vec<f64>>,
    /// K_xx/k, K_yy/k; above zero.
    pub conductivity: [Vec<f64>; 2],
    /// σ_xx, σ_yy, reduced, compression positive.
    pub stress: [Vec<f64>; 2],
    /// Per state column, then for the thermal strain: how far outside the model's range, 0 inside.
    pub outside: Vec<Vec<f64>>,
}

impl Plugin {
    /// Loads a shared library, which stays loaded until the process ends.
    ///
    /// # Errors
    /// [`PluginError::Read`] or [`PluginError::Unfit`] with the reason.
    pub fn load(path: &Path) -> Result<Self, PluginError> {
        let loaded = load(path)?;
        // SAFETY: a table of right version and size, whose pointers are as the header says.
        unsafe { Self::from_table(path, &loaded.table, loaded.hash) }
            .map_err(|reason| PluginError::Unfit { path: path.display().to_string(), reason })
    }

    /// # Safety
    /// The table's pointers are null or as the header says.
    unsafe fn from_table(path: &Path, table: &msdd_plugin_v1, hash: String) -> Result<Self, String> {
        // SAFETY: passed on to the caller.
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

    /// Whether its K is that of the resistor network solved; else affine, Eq. 9.
    pub fn network_conductivity(&self) -> bool {
        self.network_conductivity
    }

    /// Whether it has a mechanical tangent.
    pub fn has_tangent(&self) -> bool {
        self.mechanics.is_some()
    }

    /// Whether it has solid fractions.
    pub fn has_solid_fraction(&self) -> bool {
        self.solid_fraction.is_some()
    }

    pub fn wall_friction(&self) -> Option<WallFriction> {
        self.wall_friction
    }

    /// State columns of cells at the start.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    ///
    /// # Panics
    /// When columns differ in length; so do the other functions, and when columns are missing.
    pub fn initial_state(&self, start: &Start) -> Result<Vec<Vec<f64>>, PluginError> {
        let cells = start.porosity.len();
        check_lengths(&[start.fabric_index], cells);
        let optional = |column: Option<&[f64]>| {
            column.map_or(null(), |column| {
                check_lengths(&[column], cells);
                column.as_ptr()
            })
        };
        let mut state = vec![unwritten(cells); self.state_names.len()];
        let to = pointers(&mut state);
        let given = msdd_plugin_start {
            struct_size: size_of::<msdd_plugin_start>(),
            cells,
            porosity: start.porosity.as_ptr(),
            fabric_index: start.fabric_index.as_ptr(),
            fabric_conductivity: optional(start.fabric_conductivity),
            stress_xx: optional(start.stress.map(|s| s[0])),
            stress_yy: optional(start.stress.map(|s| s[1])),
            state: to.as_ptr(),
        };
        // SAFETY: columns of `cells` values, and `state` of as many columns as the table says.
        self.status("initial_state", cells, || unsafe { (self.initial_state)(&given) })?;
        self.check_state("initial_state", &state)?;
        for (k, known) in [start.porosity, start.fabric_index].into_iter().enumerate() {
            if let Some(cell) = (0..cells).find(|&cell| state[k][cell] != known[cell]) {
                let value = state[k][cell];
                return Err(self.answer("initial_state", &self.state_names[k], cell, value, "that given"));
            }
        }
        Ok(state)
    }

    /// Takes cells through one step.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    pub fn advance(&self, step: &Step) -> Result<Answer, PluginError> {
        let thermal = self.advance_once(step.state, step.thermal_strain, step.virgin_share)?;
        let Some(strain) = step.strain else { return Ok(thermal) };
        let deformed = self.deformed(&slices(&thermal.state), strain)?;
        let after = self.advance_once(&slices(&deformed), &vec![0.0; step.thermal_strain.len()], None)?;
        Ok(Answer { outside: thermal.outside, ..after })
    }

    fn advance_once(
        &self,
        state: Columns,
        thermal_strain: &[f64],
        virgin_share: Option<&[f64]>,
    ) -> Result<Answer, PluginError> {
        let cells = thermal_strain.len();
        let given = self.checked_state(state, cells);
        let mut answer = Answer {
            state: vec![unwritten(cells); state.len()],
            conductivity: [unwritten(cells), unwritten(cells)],
            stress: [unwritten(cells), unwritten(cells)],
            outside: vec![vec![0.0; cells]; state.len() + 1],
        };
        let (next, outside) = (pointers(&mut answer.state), pointers(&mut answer.outside));
        let ([kxx, kyy], [sxx, syy]) = (&mut answer.conductivity, &mut answer.stress);
        let step = msdd_plugin_step {
            struct_size: size_of::<msdd_plugin_step>(),
            cells,
            state: given.as_ptr(),
            thermal_strain: thermal_strain.as_ptr(),
            next_state: next.as_ptr(),
            conductivity_xx: kxx.as_mut_ptr(),
            conductivity_yy: kyy.as_mut_ptr(),
            stress_xx: sxx.as_mut_ptr(),
            stress_yy: syy.as_mut_ptr(),
            outside: outside.as_ptr(),
            virgin_share: virgin_share.map_or(std::ptr::null(), <[f64]>::as_ptr),
        };
        // SAFETY: columns of `cells` values, and arrays of as many columns as the table says.
        self.status("advance", cells, || unsafe { (self.advance)(&step) })?;
        self.check_answer(&answer)?;
        Ok(answer)
    }

    fn check_answer(&self, answer: &Answer) -> Result<(), PluginError> {
        self.check_state("advance", &answer.state)?;
        for (name, column) in ["conductivity_xx", "conductivity_yy"].iter().zip(&answer.conductivity) {
            self.check("advance", name, column, "finite, above 0", |k| k.is_finite() && k > 0.0)?;
        }
        for (name, column) in ["stress_xx", "stress_yy"].iter().zip(&answer.stress) {
            self.check("advance", name, column, "finite", f64::is_finite)?;
        }
        for (k, column) in answer.outside.iter().enumerate() {
            let name = self.state_names.get(k).map_or("thermal_strain", String::as_str);
            self.check("advance", &format!("outside {name}"), column, "finite", f64::is_finite)?;
        }
        Ok(())
    }

    /// State after mechanical strains. Without a tangent, the state as it is.
    fn deformed(&self, state: Columns, strain: [&[f64]; 2]) -> Result<Vec<Vec<f64>>, PluginError> {
        let Some((_, deform)) = self.mechanics else { return Ok(state.iter().map(|c| c.to_vec()).collect()) };
        let cells = strain[0].len();
        check_lengths(&strain, cells);
        let given = self.checked_state(state, cells);
        let mut next = vec![unwritten(cells); state.len()];
        let to = pointers(&mut next);
        self.status("deform", cells, || {
            // SAFETY: columns of `cells` values, and arrays of as many columns as the table says.
            unsafe { deform(cells, given.as_ptr(), strain[0].as_ptr(), strain[1].as_ptr(), to.as_ptr()) }
        })?;
        self.check_state("deform", &next)?;
        Ok(next)
    }

    /// c11, c22, c12 (reduced), rates of porosity and fabric index at a state; `None` when it has no tangent.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    pub fn tangent(&self, state: Columns) -> Result<Option<[Vec<f64>; 5]>, PluginError> {
        let Some((tangent, _)) = self.mechanics else { return Ok(None) };
        let cells = state[0].len();
        let given = self.checked_state(state, cells);
        let mut columns: [Vec<f64>; 5] = std::array::from_fn(|_| unwritten(cells));
        let [c11, c22, c12, porosity_rate, fabric_index_rate] = columns.each_mut().map(|c| c.as_mut_ptr());
        let wanted = msdd_plugin_tangent {
            struct_size: size_of::<msdd_plugin_tangent>(),
            cells,
            state: given.as_ptr(),
            c11,
            c22,
            c12,
            porosity_rate,
            fabric_index_rate,
        };
        // SAFETY: columns of `cells` values, and `state` of as many columns as the table says.
        self.status("tangent", cells, || unsafe { tangent(&wanted) })?;
        let names = ["c11", "c22", "c12", "porosity_rate", "fabric_index_rate"];
        for (name, column) in names.iter().zip(&columns) {
            self.check("tangent", name, column, "finite", f64::is_finite)?;
        }
        Ok(Some(columns))
    }

    /// Relative standard deviation of K between RVEs of equal state; `None` when it does not know.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    pub fn spread(&self, state: Columns) -> Result<Option<Vec<f64>>, PluginError> {
        let Some(spread) = self.spread else { return Ok(None) };
        let cells = state[0].len();
        let (given, mut column) = (self.checked_state(state, cells), unwritten(cells));
        // SAFETY: columns of `cells` values, and `state` of as many columns as the table says.
        self.status("spread", cells, || unsafe { spread(cells, given.as_ptr(), column.as_mut_ptr()) })?;
        self.check("spread", "spread", &column, "finite, not negative", |s| s.is_finite() && s >= 0.0)?;
        Ok(Some(column))
    }

    /// Solid fractions, overlaps counted twice, of initial states; `None` when it has none.
    ///
    /// # Errors
    /// [`PluginError::Failed`] or [`PluginError::Answer`].
    pub fn solid_fraction(&self, porosity: &[f64]) -> Result<Option<Vec<f64>>, PluginError> {
        let Some(solid_fraction) = self.solid_fraction else { return Ok(None) };
        let (cells, mut column) = (porosity.len(), unwritten(porosity.len()));
        // SAFETY: columns of `cells` values.
        let call = || unsafe { solid_fraction(cells, porosity.as_ptr(), column.as_mut_ptr()) };
        self.status("solid_fraction", cells, call)?;
        let allowed = "finite, above 0";
        self.check("solid_fraction", "solid_fraction", &column, allowed, |s| s.is_finite() && s > 0.0)?;
        Ok(Some(column))
    }

    /// Calls a function unless there is nothing to do, and turns its status into an error with its text.
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
        let text = self.last_error.map_or(Err("it has no text for that".to_string()), |last_error| {
            // SAFETY: takes nothing, and returns null or a C string, by the header.
            unsafe { text("the text of its last_error", last_error()) }
        });
        let text = text.unwrap_or_else(|reason| reason);
        Err(PluginError::Failed { plugin: self.label.clone(), function, status, text })
    }

    fn check_state(&self, function: &'static str, state: &[Vec<f64>]) -> Result<(), PluginError> {
        let named = self.state_names.iter().zip(state);
        named.into_iter().try_for_each(|(name, column)| {
            self.check(function, &format!("state {name}"), column, "finite", f64::is_finite)
        })
    }

    fn check(
        &self,
        function: &'static str,
        column: &str,
        values: &[f64],
        allowed: &'static str,
        good: impl Fn(f64) -> bool,
    ) -> Result<(), PluginError> {
        match values.iter().position(|value| !good(*value)) {
            None => Ok(()),
            Some(cell) => Err(self.answer(function, column, cell, values[cell], allowed)),
        }
    }

    fn answer(
        &self,
        function: &'static str,
        column: &str,
        cell: usize,
        value: f64,
        allowed: &'static str,
    ) -> PluginError {
        let (plugin, column) = (self.label.clone(), column.to_string());
        PluginError::Answer { plugin, function, column, cell, value, allowed }
    }

    /// Starts of the state's columns.
    fn checked_state(&self, state: Columns, cells: usize) -> Vec<*const f64> {
        assert_eq!(state.len(), self.state_names.len(), "state columns");
        check_lengths(state, cells);
        state.iter().map(|column| column.as_ptr()).collect()
    }
}

/// # Safety
/// The table's texts are null or C strings, as many as its `state_size`.
unsafe fn state_names(table: &msdd_plugin_v1) -> Result<Vec<String>, String> {
    if !(2..=MOST_COLUMNS).contains(&table.state_size) {
        return Err(format!("state_size = {}, allowed: 2 to {MOST_COLUMNS}", table.state_size));
    }
    if table.state_names.is_null() {
        return Err("state_names is NULL".to_string());
    }
    // SAFETY: as many texts as `state_size` says, by this function's contract.
    let name = |k: usize| unsafe { text(&format!("state_names[{k}]"), table.state_names.add(k).read()) };
    let names: Vec<String> = (0..table.state_size).map(name).collect::<Result<_, _>>()?;
    for (k, expected) in ["porosity", "fabric_index"].iter().enumerate() {
        if names[k] != *expected {
            return Err(format!("state_names[{k}] = \"{}\", allowed: \"{expected}\"", names[k]));
        }
    }
    match (1..names.len()).find(|&k| names[..k].contains(&names[k])) {
        Some(k) => Err(format!("state_names[{k}] = \"{}\" is there twice", names[k])),
        None => Ok(names),
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

/// NaN everywhere: a column that a plug-in leaves out is found.
fn unwritten(cells: usize) -> Vec<f64> {
    vec![f64::NAN; cells]
}

fn pointers(columns: &mut [Vec<f64>]) -> Vec<*mut f64> {
    columns.iter_mut().map(|column| column.as_mut_ptr()).collect()
}

fn slices(columns: &[Vec<f64>]) -> Vec<&[f64]> {
    columns.iter().map(Vec::as_slice).collect()
}

fn check_lengths(columns: Columns, cells: usize) {
    assert!(columns.iter().all(|column| column.len() == cells), "columns of {cells} values");
}
