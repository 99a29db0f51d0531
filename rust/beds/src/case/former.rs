//! Descriptions as they were before version 0.4, which are still read: names of the file, and the section `heat`.

use toml::{Table, Value};

/// Names of the file.
pub const FILES: [&str; 2] = ["dem.toml", "elements.toml"];

/// The text with `heat` of a bed with a plate as `time` and `record`.
///
/// # Errors
/// A text that is no TOML.
pub fn renewed(text: String) -> Result<String, String> {
    let Ok(mut table) = toml::from_str::<Table>(&text) else { return Ok(text) };
    let Some(Value::Table(mut heat)) = table.remove("heat") else { return Ok(text) };
    let wall = table.get("plate").and_then(|plate| plate.get("wall")).cloned();
    let distances = heat.remove("probes").unwrap_or_else(|| Value::Array(Vec::new()));
    let record = [("wall", wall.unwrap_or_else(|| Value::String(String::new()))), ("distances", distances)];
    table.insert("time".to_string(), Value::Table(heat));
    table.insert(
        "record".to_string(),
        record.map(|(key, value)| (key.to_string(), value)).into_iter().collect::<Table>().into(),
    );
    for vary in table.get_mut("vary").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Some(Value::String(key)) = vary.get_mut("key") {
            *key = key.replace("heat.probes", "record.distances").replace("heat.", "time.");
        }
    }
    toml::to_string(&table).map_err(|error| error.to_string())
}
