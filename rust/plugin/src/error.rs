/// Why a plug-in was refused or failed. Every text names the plug-in.
#[derive(Debug, thiserror::Error)]
pub enum PluginError {
    /// The file could not be read.
    #[error("cannot read plug-in \"{path}\": {error}")]
    Read { path: String, error: std::io::Error },
    /// The file is not a plug-in, or not one for this version of the library.
    #[error("plug-in \"{path}\": {reason}")]
    Unfit { path: String, reason: String },
    /// One of its functions returned another status than 0.
    /// `plugin`: name and path.
    #[error("plug-in {plugin}: {function} failed with status {status}: {text}")]
    Failed { plugin: String, function: &'static str, status: i32, text: String },
    /// One of its functions returned a value that no packing of grains can have.
    #[error("plug-in {plugin}: {function} answered {column}[{cell}] = {}, allowed: {allowed}", shown(*value))]
    Answer {
        plugin: String,
        function: &'static str,
        column: String,
        cell: usize,
        value: f64,
        allowed: &'static str,
    },
}

/// A number for a message: very large and very small ones as 1e300, not with 300 digits.
pub fn shown(value: f64) -> String {
    match value == 0.0 || !value.is_finite() || (1e-5..1e15).contains(&value.abs()) {
        true => value.to_string(),
        false => format!("{value:e}"),
    }
}
