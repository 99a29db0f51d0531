//! Properties of materials that may depend on temperature.

use msdd_engine::message::{number, range};
use serde::{Deserialize, Serialize};

/// What most properties may be.
pub const VALUES: [f64; 2] = [1e-30, 1e30];

/// A property: one number, or a table of pairs (temperature \[K\], value), between which it is straight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a number, or a table of pairs [temperature, value]")]
pub enum Property {
    Constant(f64),
    Table(Vec<[f64; 2]>),
}

impl Property {
    /// Value and what is allowed of the first thing that is wrong: values lie in `values`, temperatures rise and cover `wanted` \[K\].
    ///
    /// # Errors
    /// That value, and what is allowed.
    pub fn check(&self, wanted: [f64; 2], values: [f64; 2]) -> Result<(), (String, String)> {
        let wrong = |value: String, allowed: &str| Err((value, allowed.to_string()));
        let fits = |value: f64| (values[0]..=values[1]).contains(&value);
        let rows = match self {
            Self::Constant(value) if fits(*value) => return Ok(()),
            Self::Constant(value) => return wrong(number(*value), &range(values)),
            Self::Table(rows) => rows,
        };
        if let Some(row) = rows.iter().find(|row| !fits(row[1])) {
            return wrong(number(row[1]), &range(values));
        }
        if let Some(row) = rows.iter().find(|row| !(0.0..=1e6).contains(&row[0])) {
            return wrong(format!("a table with temperature {} K", number(row[0])), "0 to 1000000 K");
        }
        let (Some(first), Some(last), true) = (rows.first(), rows.last(), rows.len() > 1) else {
            return wrong(format!("{} rows", rows.len()), "two at least");
        };
        let rising = |pair: &&[[f64; 2]]| pair[0][0] < pair[1][0];
        if let Some(pair) = rows.windows(2).find(|pair| !rising(pair)) {
            let [a, b] = [pair[0][0], pair[1][0]].map(number);
            return wrong(format!("temperatures {a} K and {b} K in this order"), "rising temperatures");
        }
        if first[0] <= wanted[0] && last[0] >= wanted[1] {
            return Ok(());
        }
        let span = |ends: [f64; 2]| format!("{} K to {} K", number(ends[0]), number(ends[1]));
        let allowed = format!("a table that covers {}, the temperatures of the run", span(wanted));
        wrong(format!("known from {}", span([first[0], last[0]])), &allowed)
    }

    /// The value at a temperature \[K\]; beyond the ends of a table, on the line through its last two rows.
    pub fn at(&self, temperature: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Table(rows) => {
                let [a, b] = around(rows, temperature);
                a[1] + (temperature - a[0]) * (b[1] - a[1]) / (b[0] - a[0])
            }
        }
    }

    /// Temperatures of the rows of a table \[K\].
    pub fn rows(&self) -> Vec<f64> {
        match self {
            Self::Constant(_) => Vec::new(),
            Self::Table(rows) => rows.iter().map(|row| row[0]).collect(),
        }
    }

    /// ∫ of the property from the first temperature of the table (0 K if it is constant) to `temperature` \[K\].
    pub fn integral(&self, temperature: f64) -> f64 {
        match self {
            Self::Constant(value) => value * temperature,
            Self::Table(rows) => {
                let [a, _] = around(rows, temperature);
                let whole = rows.windows(2).take_while(|pair| pair[0][0] < a[0]);
                let before: f64 =
                    whole.map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum();
                before + 0.5 * (a[1] + self.at(temperature)) * (temperature - a[0])
            }
        }
    }
}

/// The two rows of a table between which a temperature lies; the first or last two outside of it.
fn around(rows: &[[f64; 2]], temperature: f64) -> [[f64; 2]; 2] {
    let above = rows.partition_point(|row| row[0] <= temperature).clamp(1, rows.len() - 1);
    [rows[above - 1], rows[above]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_straight_between_rows_and_integrated_exactly() {
        let table = Property::Table(vec![[300.0, 60.0], [400.0, 56.0], [600.0, 48.0]]);
        assert_eq!([300.0, 350.0, 400.0, 500.0].map(|t| table.at(t)), [60.0, 58.0, 56.0, 52.0]);
        assert_eq!(table.integral(300.0), 0.0);
        assert_eq!(table.integral(350.0), 50.0 * 59.0);
        assert_eq!(table.integral(500.0), 5800.0 + 100.0 * 54.0);
        assert_eq!(Property::Constant(464.0).integral(300.0), 464.0 * 300.0);
        let slope = (table.integral(470.0 + 1e-4) - table.integral(470.0 - 1e-4)) / 2e-4;
        assert!((slope / table.at(470.0) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn bad_tables_are_refused() {
        let table = Property::Table(vec![[300.0, 60.0], [400.0, 56.0]]);
        assert_eq!(table.check([300.0, 400.0], VALUES), Ok(()));
        let (value, allowed) = table.check([293.0, 326.0], VALUES).unwrap_err();
        assert_eq!(value, "known from 300 K to 400 K");
        assert!(allowed.contains("293 K to 326 K"), "{allowed}");
        let value = |rows: Vec<[f64; 2]>| Property::Table(rows).check([300.0, 301.0], VALUES).unwrap_err().0;
        let falling = value(vec![[400.0, 60.0], [300.0, 56.0]]);
        assert_eq!(falling, "temperatures 400 K and 300 K in this order");
        assert_eq!(value(vec![[1.0, 2.0]]), "1 rows");
        let hot = value(vec![[300.0, 60.0], [f64::INFINITY, 56.0]]);
        assert_eq!(hot, "a table with temperature inf K");
        #[derive(Debug, Deserialize)]
        struct Key {
            #[serde(rename = "k")]
            _k: Property,
        }
        let text = toml::from_str::<Key>("k = \"x\"").unwrap_err().to_string();
        assert!(text.contains("a number, or a table of pairs [temperature, value]"), "{text}");
        let (value, allowed) = Property::Constant(-1.0).check([1.0, 2.0], VALUES).unwrap_err();
        assert_eq!((value.as_str(), allowed.as_str()), ("-1", "1e-30 to 1e30"));
    }
}
