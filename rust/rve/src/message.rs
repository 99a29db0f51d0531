//! Shortening of long texts and numbers in messages.

pub use msdd_dem::message::{number, range};

/// Longest text that a message shows whole [characters].
const LONGEST: usize = 300;

/// A text for a message; of a long one only the beginning and the end.
pub fn shortened(text: &str) -> String {
    let count = text.chars().count();
    if count <= LONGEST {
        return text.to_string();
    }
    let (first, last) = (LONGEST * 2 / 3, LONGEST / 3);
    let start: String = text.chars().take(first).collect();
    let end: String = text.chars().skip(count - last).collect();
    format!("{start} … ({} characters left out) … {end}", count - first - last)
}

/// A value for a message, which may be a number of three hundred digits.
pub fn value(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && text.len() > 20 => number(value),
        _ => shortened(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_and_values_become_short() {
        assert_eq!(shortened("a text"), "a text");
        let long = format!("begin {} end", "ä".repeat(1_000_000));
        let short = shortened(&long);
        assert!(short.starts_with("begin ä") && short.ends_with("ä end"), "{short}");
        assert!(short.chars().count() < 400, "{short}");
        assert_eq!(value(&1e300.to_string()), "1e300");
        assert_eq!((value("0.12").as_str(), value("walls").as_str()), ("0.12", "walls"));
    }
}
