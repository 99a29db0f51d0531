//! Numbers as people write them, and text that is safe in HTML and SVG.

/// A number with up to six significant digits, as people write it: 100, not 100.0.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_string() } else { "–".to_string() };
    }
    let digits = |most: i32| (most - 1 - size.log10().floor() as i32).max(0) as usize;
    if (1e-3..1e6).contains(&size) {
        let text = format!("{value:.*}", digits(6));
        return if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_string()
        } else {
            text
        };
    }
    let text = format!("{value:.3e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
}

/// A number with `digits` significant digits, by [`number`].
pub fn significant(value: f64, digits: usize) -> String {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().map_or("–".to_string(), number)
}

/// Round numbers between `low` and `high`, 2 to `most` of them (at least 3) where the two differ.
pub fn ticks(low: f64, high: f64, most: usize) -> Vec<f64> {
    if high <= low {
        return vec![low];
    }
    let rough = (high - low) / most.max(3) as f64;
    let decade = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * decade).into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(10.0 * decade);
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    // Divided, not multiplied, where the step is below 1: 3/10 and not 3 times 0.1
    let inverse = (1.0 / step).round();
    (first..=last).map(|k| if step < 1.0 { k as f64 / inverse } else { k as f64 * step }).collect()
}

/// Text with the characters escaped that have a meaning in HTML and SVG.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_as_people_write_them() {
        let cases = [
            (100.0, "100"),
            (0.0, "0"),
            (-2.5, "-2.5"),
            (0.001, "0.001"),
            (150_000.0, "150000"),
            (1_500_000.0, "1.5e6"),
            (2e-7, "2e-7"),
            (293.15, "293.15"),
            (1.0 / 3.0, "0.333333"),
            (f64::NAN, "–"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
        assert_eq!(
            (significant(395.26, 3), significant(0.012_345, 2)),
            ("395".to_string(), "0.012".to_string())
        );
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(0.0, 100.0, 5), [0.0, 20.0, 40.0, 60.0, 80.0, 100.0]);
        assert_eq!(ticks(0.11, 0.42, 5), [0.2, 0.3, 0.4]);
        assert_eq!(ticks(7.0, 7.0, 5), [7.0]);
        for (low, high) in [(293.0, 501.3), (-1e-5, 3e-5), (0.1254, 0.1257)] {
            let found = ticks(low, high, 5);
            assert!((2..=6).contains(&found.len()) && found[0] >= low - 1e-12, "{low} {high}: {found:?}");
        }
    }
}
