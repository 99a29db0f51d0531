//! Checks the names of state columns. Solvers make names of fields from them, and so names of files.

use crate::library::text;
use msdd_abi::msdd_plugin_v2;

/// Largest number of state columns. A larger number is taken for a sign of a broken table.
const MAX_COLUMNS: usize = 64;
/// Largest number of characters of a name.
const LONGEST_NAME: usize = 64;

/// Checked names of a table's state columns.
///
/// # Errors
/// What is wrong with which name, and what is allowed.
///
/// # Safety
/// The table's texts are null or C strings, as many as its `state_size`.
pub(crate) unsafe fn state_names(table: &msdd_plugin_v2) -> Result<Vec<String>, String> {
    if !(2..=MAX_COLUMNS).contains(&table.state_size) {
        return Err(format!("state_size = {}, allowed: 2 to {MAX_COLUMNS}", table.state_size));
    }
    if table.state_names.is_null() {
        return Err("state_names is NULL".to_string());
    }
    // SAFETY: as many texts as `state_size` says, by this function's contract.
    let name = |k: usize| unsafe { text(&format!("state_names[{k}]"), table.state_names.add(k).read()) };
    let names: Vec<String> = (0..table.state_size).map(name).collect::<Result<_, _>>()?;
    for (k, expected) in ["porosity", "fabric_index"].iter().enumerate() {
        if names[k] != *expected {
            return Err(format!("state_names[{k}] = {}, allowed: \"{expected}\"", quoted(&names[k])));
        }
    }
    (2..names.len()).try_for_each(|k| check(k, &names))?;
    Ok(names)
}

/// Checks that name `k` is a letter followed by letters, digits and underscores, and differs from those before it.
fn check(k: usize, names: &[String]) -> Result<(), String> {
    let (name, before) = (&names[k], &names[..k]);
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic());
    let word = name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    if !starts || !word || name.len() > LONGEST_NAME {
        return Err(format!(
            "state_names[{k}] = {}, allowed: a letter, and then letters, digits and underscores of ASCII, \
             {LONGEST_NAME} characters in all at most",
            quoted(name)
        ));
    }
    let plain = |name: &String| name.replace('_', "").to_ascii_lowercase();
    match before.iter().find(|other| plain(other) == plain(name)) {
        None => Ok(()),
        Some(other) if other == name => Err(format!("state_names[{k}] = \"{name}\" is there twice")),
        Some(other) => Err(format!(
            "state_names[{k}] = \"{name}\" differs from \"{other}\" in underscores or capitals alone, and \
             msddFoam names its field reduced_pressure reducedPressure: allowed are names that differ otherwise"
        )),
    }
}

/// A name for a message: quoted, with escapes for invisible characters, and shortened if it is very long.
fn quoted(name: &str) -> String {
    let shown: String = name.chars().take(LONGEST_NAME).collect();
    format!("{shown:?}{}", if shown.len() < name.len() { " and more" } else { "" })
}
