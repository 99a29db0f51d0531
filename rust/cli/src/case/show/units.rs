//! Units in which numbers are handy.

use msdd_draw::text::significant;

/// A unit in which the largest value is a handy number, and what to multiply by.
pub fn scaled(most: f64, unit: &'static str) -> (&'static str, f64) {
    match (unit, most.abs()) {
        ("Pa", 1e6..) => ("MPa", 1e-6),
        ("Pa", 1e3..) => ("kPa", 1e-3),
        ("m", ..1.0) => ("mm", 1e3),
        ("J", 1e6..) => ("MJ", 1e-6),
        ("J", 1e3..) => ("kJ", 1e-3),
        ("W", 1e3..) => ("kW", 1e-3),
        ("s", 259_200.0..) => ("d", 1.0 / 86_400.0),
        ("s", 7200.0..) => ("h", 1.0 / 3600.0),
        _ => (unit, 1.0),
    }
}

/// A time in the unit that fits `end`.
pub fn duration(seconds: f64, end: f64) -> String {
    let (unit, factor) = scaled(end, "s");
    format!("{} {unit}", significant(factor * seconds, 3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_fit_the_largest_value() {
        assert_eq!([scaled(-2e6, "Pa"), scaled(900.0, "Pa")].map(|unit| unit.0), ["MPa", "Pa"]);
        assert_eq!(
            [duration(3600.0, 10_800.0), duration(20.0, 20.0), duration(0.0, 1e6)],
            ["1 h", "20 s", "0 d"]
        );
    }
}
