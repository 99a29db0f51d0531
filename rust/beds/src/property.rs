//! Properties of materials that may depend on temperature.

use msdd_engine::message::number;
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

/// A property that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    #[error("{}, allowed: {allowed}", number(*value))]
    Value { value: f64, allowed: String },
    #[error("a table with temperature {} K, allowed: 0 to 1000000 K", number(*value))]
    Temperature { value: f64 },
    #[error("{rows} rows, allowed: two at least")]
    Short { rows: usize },
    #[error("temperatures {} K and {} K in this order, allowed: rising temperatures", number(*first), number(*second))]
    Order { first: f64, second: f64 },
    #[error("known from {} K to {} K, allowed: a table that covers {} K to {} K, the temperatures of the run",
        number(known[0]), number(known[1]), number(wanted[0]), number(wanted[1]))]
    Range { known: [f64; 2], wanted: [f64; 2] },
}

impl Property {
    /// Checks that all values are in their range and that the table covers `range` \[K\].
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self, range: [f64; 2], values: [f64; 2]) -> Result<(), TableError> {
        let allowed = msdd_engine::message::range(values);
        let fits = |value: f64| (values[0]..=values[1]).contains(&value);
        match self {
            Self::Constant(value) if fits(*value) => Ok(()),
            Self::Constant(value) => Err(TableError::Value { value: *value, allowed }),
            Self::Table(rows) => {
                if let Some(row) = rows.iter().find(|row| !fits(row[1])) {
                    return Err(TableError::Value { value: row[1], allowed });
                }
                if let Some(row) = rows.iter().find(|row| !(0.0..=1e6).contains(&row[0])) {
                    return Err(TableError::Temperature { value: row[0] });
                }
                let (Some(first), Some(last), true) = (rows.first(), rows.last(), rows.len() > 1) else {
                    return Err(TableError::Short { rows: rows.len() });
                };
                let rising = |pair: &&[[f64; 2]]| pair[0][0] < pair[1][0];
                if let Some(pair) = rows.windows(2).find(|pair| !rising(pair)) {
                    return Err(TableError::Order { first: pair[0][0], second: pair[1][0] });
                }
                let known = [first[0], last[0]];
                match known[0] <= range[0] && known[1] >= range[1] {
                    true => Ok(()),
                    false => Err(TableError::Range { known, wanted: range }),
                }
            }
        }
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
        let text = table.check([293.0, 326.0], VALUES).unwrap_err().to_string();
        assert!(text.starts_with("known from 300 K to 400 K") && text.contains("293 K to 326 K"), "{text}");
        let order = Property::Table(vec![[400.0, 60.0], [300.0, 56.0]]);
        assert!(matches!(order.check([300.0, 301.0], VALUES), Err(TableError::Order { .. })));
        let short = Property::Table(vec![[1.0, 2.0]]);
        assert_eq!(short.check([1.0, 2.0], VALUES), Err(TableError::Short { rows: 1 }));
        let hot = Property::Table(vec![[300.0, 60.0], [f64::INFINITY, 56.0]]);
        assert!(matches!(hot.check([300.0, 301.0], VALUES), Err(TableError::Temperature { .. })));
        #[derive(Debug, Deserialize)]
        struct Key {
            #[serde(rename = "k")]
            _k: Property,
        }
        let text = toml::from_str::<Key>("k = \"x\"").unwrap_err().to_string();
        assert!(text.contains("a number, or a table of pairs [temperature, value]"), "{text}");
        let negative = Property::Constant(-1.0).check([1.0, 2.0], VALUES).unwrap_err().to_string();
        assert_eq!(negative, "-1, allowed: 1e-30 to 1e30");
    }
}
