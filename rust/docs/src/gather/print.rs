//! Rounding for print.

/// With `digits` digits behind the point.
pub fn decimals(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        return text.trim_start_matches('-').to_string();
    }
    text
}

/// With two digits that count, and all digits before the point: 0.17, 1.6, 26, 131.
pub fn two(value: f64) -> String {
    let size = value.abs();
    let digits = if size >= 9.95 || size == 0.0 {
        0
    } else if size >= 0.995 {
        1
    } else {
        // 0.0123 has its first digit that counts in the second place.
        (1 - (size * 1.005).log10().floor() as i64).clamp(1, 9) as usize
    };
    if digits == 0 { grouped(value) } else { decimals(value, digits) }
}

/// An integer with its thousands apart, by spaces that do not break.
pub fn grouped(value: f64) -> String {
    let digits = decimals(value.abs(), 0);
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push('\u{a0}');
        }
        text.push(digit);
    }
    if value < 0.0 && digits != "0" { format!("-{text}") } else { text }
}

/// One digit that counts, as a power of ten where it is small: 5e-5.
pub fn power(value: f64) -> String {
    format!("{value:.0e}")
}

/// A mean and a deviation.
pub fn with_scatter(mean: f64, deviation: f64, digits: usize) -> String {
    format!("{} ± {}", decimals(mean, digits), decimals(deviation, digits))
}

/// What stands for a number that there is none of.
pub const NONE: &str = "–";

/// The number by `print`, or [`NONE`].
pub fn or_none(value: Option<f64>, print: impl Fn(f64) -> String) -> String {
    value.map_or(NONE.to_string(), print)
}
