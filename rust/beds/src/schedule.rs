//! A quantity that is given over time.

use msdd_engine::message::{number, range};
use serde::{Deserialize, Serialize};

/// One number, or a table of pairs (time \[s\], value), straight in between and constant before and after.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a number, or a table of pairs [time, value]")]
pub enum Schedule {
    Constant(f64),
    Table(Vec<[f64; 2]>),
}

impl Schedule {
    /// Value and what is allowed of the first entry that is wrong: times rise, values lie in `values`.
    ///
    /// # Errors
    /// That value, and what is allowed.
    pub fn check(&self, values: [f64; 2]) -> Result<(), (String, String)> {
        let inside = |value: f64| (values[0]..=values[1]).contains(&value);
        let allowed = || range(values);
        match self {
            Self::Constant(value) if inside(*value) => Ok(()),
            Self::Constant(value) => Err((number(*value), allowed())),
            Self::Table(rows) if rows.is_empty() => {
                Err(("no rows".to_string(), "one row at least".to_string()))
            }
            Self::Table(rows) => {
                if let Some(row) = rows.iter().find(|row| !inside(row[1])) {
                    return Err((number(row[1]), allowed()));
                }
                let falling = rows
                    .windows(2)
                    .find(|pair| pair[0][0].partial_cmp(&pair[1][0]) != Some(std::cmp::Ordering::Less));
                let bad = falling.map(|pair| [pair[0][0], pair[1][0]]);
                match bad {
                    Some([a, b]) => Err((
                        format!("times {} s and {} s in this order", number(a), number(b)),
                        "rising times".to_string(),
                    )),
                    None if rows.iter().all(|row| row[0].is_finite()) => Ok(()),
                    None => Err(("a time that is not finite".to_string(), "finite times".to_string())),
                }
            }
        }
    }

    /// The value at a time \[s\].
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Table(rows) => {
                let after = rows.partition_point(|row| row[0] <= time);
                match (after.checked_sub(1).map(|before| rows[before]), rows.get(after)) {
                    (Some(a), Some(b)) => a[1] + (time - a[0]) * (b[1] - a[1]) / (b[0] - a[0]),
                    (Some(only), None) => only[1],
                    (None, first) => first.map_or(f64::NAN, |row| row[1]),
                }
            }
        }
    }

    /// Its least and largest value.
    pub fn range(&self) -> [f64; 2] {
        match self {
            Self::Constant(value) => [*value; 2],
            Self::Table(rows) => rows.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], row| {
                [low.min(row[1]), high.max(row[1])]
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_straight_between_its_rows_and_constant_outside() {
        let table = Schedule::Table(vec![[10.0, 300.0], [20.0, 320.0], [40.0, 310.0]]);
        assert_eq!(
            [0.0, 10.0, 15.0, 20.0, 30.0, 99.0].map(|t| table.at(t)),
            [300.0, 300.0, 310.0, 320.0, 315.0, 310.0]
        );
        assert_eq!(table.range(), [300.0, 320.0]);
        assert_eq!(table.check([1.0, 5000.0]), Ok(()));
    }

    #[test]
    fn what_is_wrong_is_told() {
        let table = Schedule::Table(vec![[10.0, 300.0], [10.0, 320.0]]);
        assert_eq!(table.check([1.0, 5e3]).unwrap_err().1, "rising times");
        let (value, allowed) = Schedule::Constant(-1.0).check([0.0, 1.0]).unwrap_err();
        assert_eq!((value.as_str(), allowed.as_str()), ("-1", "0 to 1"));
        assert!(Schedule::Table(vec![[f64::NAN, 0.5], [1.0, 0.5]]).check([0.0, 1.0]).is_err());
        assert!(Schedule::Table(Vec::new()).check([0.0, 1.0]).is_err());
    }
}
