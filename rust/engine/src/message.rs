//! Formatting of numbers in messages: always short.

/// A number for a message: 0.12, but 1e300 instead of three hundred digits. Parsing the text gives the same number.
pub fn number(value: f64) -> String {
    let plain = value.to_string();
    if plain.len() > 20 { format!("{value:e}") } else { plain }
}

/// A range for a message: 1e-12 to 1e15, 1 to 1000000.
pub fn range(ends: [f64; 2]) -> String {
    let [low, high] = ends.map(|end| {
        let plain = end.to_string();
        if plain.len() > 8 { format!("{end:e}") } else { plain }
    });
    format!("{low} to {high}")
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
        assert_eq!(range([1e-12, 1e15]), "1e-12 to 1e15");
        assert_eq!(range([-0.2, 10_000_000.0]), "-0.2 to 10000000");
    }
}
