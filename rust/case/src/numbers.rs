//! Numbers as a person writes them.

/// A number rounded to `digits` significant digits.
pub fn rounded(value: f64, digits: i32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let places = (digits as usize).saturating_sub(1);
    format!("{value:.places$e}").parse().unwrap_or(value)
}

/// A number with three significant digits.
pub fn short(value: f64) -> String {
    plain(rounded(value, 3))
}

/// A number in its usual short form, such as 0.012 or 1.93e11, which gives exactly the same number when it is read.
pub fn plain(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-4..1e5).contains(&size) { format!("{value}") } else { format!("{value:e}") }
}
