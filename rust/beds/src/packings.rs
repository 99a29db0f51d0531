//! Several packings of one scene: what they have in common, and how much they differ.
//!
//! Beds that are poured from other random places differ by more than most laws err, so a law is compared with the mean of several.

use std::fmt::Write;

/// The tables of several packings, joined.
#[derive(Clone, Debug, PartialEq)]
pub struct Joined {
    /// Their mean.
    pub mean: String,
    /// Standard deviation of one packing, from N − 1.
    pub scatter: String,
}

/// A table as [`crate::rows::elements`] writes it.
struct Table<'a> {
    header: &'a str,
    /// Cells without a number are `None`.
    rows: Vec<Vec<Option<f64>>>,
}

impl Table<'_> {
    fn place(&self, column: &str) -> Option<usize> {
        self.header.split(',').position(|name| name == column)
    }
}

fn table(text: &str) -> Option<Table<'_>> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header = lines.next()?;
    let columns = header.split(',').count();
    let rows = lines.map(|line| line.split(',').map(|cell| cell.parse().ok()).collect::<Vec<_>>());
    let rows: Vec<_> = rows.collect();
    rows.iter().all(|row| row.len() == columns).then_some(Table { header, rows })
}

/// The value in a column at the first time, if there is one.
pub fn at_start(text: &str, column: &str) -> Option<f64> {
    let table = table(text)?;
    let place = table.place(column)?;
    *table.rows.first()?.get(place)?
}

/// All values in a column; `None` if there is no such column, or a value is missing.
pub fn column(text: &str, column: &str) -> Option<Vec<f64>> {
    let table = table(text)?;
    let place = table.place(column)?;
    table.rows.iter().map(|row| row[place]).collect()
}

/// Joins tables of packings with these seeds, which must have the same columns and times; `None` if they have not, or if there is none.
pub fn join(seeds: &[u64], tables: &[String]) -> Option<Joined> {
    let tables: Vec<Table> = tables.iter().map(|text| table(text)).collect::<Option<_>>()?;
    let first = tables.first()?;
    let times = |table: &Table| table.rows.iter().map(|row| row.first().copied()).collect::<Vec<_>>();
    if tables.iter().any(|other| other.header != first.header || times(other) != times(first)) {
        return None;
    }
    let seeds: Vec<String> = seeds.iter().map(ToString::to_string).collect();
    let text = |what: &str, of: fn(&[f64]) -> f64| {
        let mut text = format!(
            "# DEM: {what} of {} packings, seeds {}; made by 'msdd bed run --packings' of msdd {} from bed.toml\n",
            tables.len(),
            seeds.join(" "),
            env!("CARGO_PKG_VERSION"),
        );
        let _ = writeln!(text, "# Columns: docs/src/reference/beds.md\n{}", first.header);
        for (k, row) in first.rows.iter().enumerate() {
            let cell = |column: usize| {
                let values: Option<Vec<f64>> = tables.iter().map(|table| table.rows[k][column]).collect();
                values.map_or(String::new(), |values| significant(of(&values)))
            };
            let time = row.first().copied().flatten().map_or(String::new(), |time| time.to_string());
            let cells: Vec<String> = std::iter::once(time).chain((1..row.len()).map(cell)).collect();
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    };
    Some(Joined { mean: text("mean", mean), scatter: text("standard deviation", deviation) })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    (squares / (values.len() as f64 - 1.0).max(1.0)).sqrt()
}

/// Seven digits: temperatures to 1e-4 K.
fn significant(value: f64) -> String {
    format!("{value:.6e}").parse::<f64>().unwrap_or(value).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: &str = "# of A\ntime,T_0.01,radius\n0,300,\n60,310.5,\n";
    const B: &str = "# of B\ntime,T_0.01,radius\n0,300,\n60,312.5,\n";

    #[test]
    fn means_and_deviations_are_those_of_the_columns() {
        let joined = join(&[3, 4], &[A.to_string(), B.to_string()]).unwrap();
        let rows = |text: &str| text.lines().skip(2).map(str::to_string).collect::<Vec<_>>();
        assert_eq!(rows(&joined.mean), ["time,T_0.01,radius", "0,300,", "60,311.5,"]);
        assert_eq!(rows(&joined.scatter), ["time,T_0.01,radius", "0,0,", "60,1.414214,"]);
        assert!(joined.mean.starts_with("# DEM: mean of 2 packings, seeds 3 4;"));
        assert_eq!(at_start(&joined.mean, "T_0.01"), Some(300.0));
        assert_eq!((at_start(A, "radius"), at_start(A, "fabric_1")), (None, None));
        // One packing is its own mean, and says nothing about the scatter.
        let alone = join(&[3], &[A.to_string()]).unwrap();
        assert_eq!(rows(&alone.mean), ["time,T_0.01,radius", "0,300,", "60,310.5,"]);
        assert_eq!(rows(&alone.scatter)[2], "60,0,");
    }

    #[test]
    fn tables_of_other_scenes_are_not_joined() {
        let join = |other: &str| join(&[1, 2], &[A.to_string(), other.to_string()]);
        assert_eq!(join("time,T_0.02,radius\n0,300,\n60,310,\n"), None);
        assert_eq!(join("time,T_0.01,radius\n0,300,\n"), None);
        assert_eq!(join("time,T_0.01,radius\n0,300,\n90,310,\n"), None);
        assert_eq!(join("time,T_0.01,radius\n0,300\n60,310\n"), None);
        assert_eq!(join(""), None);
        assert_eq!(super::join(&[], &[]), None);
    }
}
