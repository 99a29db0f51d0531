//! Formatting of numbers in messages: always short.

/// A number for a message: 0.12, but 1e300 instead of three hundred digits. Parsing the text gives the same number.
pub fn number(value: f64) -> String {
    let plain = value.to_string();
    if plain.len() > 20 { format!("{value:e}") } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_become_short() {
        let cases = [(0.12, "0.12"), (5.0, "5"), (1e300, "1e300"), (-5e-324, "-5e-324"), (f64::NAN, "NaN")];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
