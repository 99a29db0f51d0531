//! What stands in the table of rows of a database: columns, versions of the schema, and the type of a row.

use rusqlite::types::{Value, ValueRef};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// A column of the database: name, SQLite type, unit, meaning.
pub struct Column(pub &'static str, pub &'static str, pub &'static str, pub &'static str);

/// A version of the table; raised when it changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schema {
    /// The number in the provenance.
    pub number: &'static str,
    /// Columns that it does not have yet.
    pub without: &'static [&'static str],
}

impl Schema {
    /// Whether the table of rows has the column.
    pub fn has(self, column: &Column) -> bool {
        !self.without.contains(&column.0)
    }
}

/// A row of a database: one state of one packing.
pub trait Row: Clone + Default + PartialEq + Debug + Serialize + DeserializeOwned + Send + 'static {
    /// The columns, in the order of [`Row::values`].
    const COLUMNS: &'static [Column];
    /// From the oldest to the one of new files.
    const SCHEMAS: &'static [Schema];
    /// The columns that name a row.
    const KEY: &'static str;
    /// The names of a row within its packing.
    type Place: Ord + Clone + Debug + Send + Sync;

    /// The fields in column order, as they are stored.
    fn values(&self) -> Vec<Value>;

    /// Reads the fields from cells by the number of their column; the error has the column's name.
    ///
    /// # Errors
    /// A cell that is absent or has no value of the column's type.
    fn from_cells<'a>(
        cell: impl Fn(usize) -> Result<ValueRef<'a>, String>,
    ) -> Result<Self, (&'static str, String)>;

    fn packing(&self) -> i64;
    fn place(&self) -> Self::Place;
    /// Key by which the rows of a packing are sorted.
    fn order(&self) -> impl Ord;
    /// The name of a row in messages.
    fn name_of(packing: i64, place: &Self::Place) -> String;
    fn seed(&self) -> u64;
    /// Whether the state was not reached.
    fn has_failed(&self) -> bool;

    /// The name of the row in messages.
    fn name(&self) -> String {
        Self::name_of(self.packing(), &self.place())
    }

    /// The schema of new files.
    fn schema() -> Schema {
        Self::SCHEMAS[Self::SCHEMAS.len() - 1]
    }

    /// Columns that the oldest files do not have; they are null there.
    fn later() -> &'static [&'static str] {
        Self::SCHEMAS[0].without
    }
}

/// Defines a struct of a row and its columns from one list, so that they always agree, with the functions that [`Row`] needs.
macro_rules! row {
    ($(#[$about:meta])* $row:ident: $($name:ident: $type:ty, $sql:literal, $unit:literal, $meaning:literal;)*) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct $row {
            $(#[doc = concat!("\\[", $unit, "\\] ", $meaning)] pub $name: $type,)*
        }

        impl $row {
            fn all_values(&self) -> Vec<rusqlite::types::Value> {
                vec![$($crate::database::cell::Cell::value(&self.$name),)*]
            }

            fn of_cells<'a>(
                cell: impl Fn(usize) -> Result<rusqlite::types::ValueRef<'a>, String>,
            ) -> Result<Self, (&'static str, String)> {
                let mut next = 0..;
                $(let $name = next
                    .next()
                    .ok_or_else(|| "no such column".to_string())
                    .and_then(&cell)
                    .and_then($crate::database::cell::Cell::read)
                    .map_err(|problem| (stringify!($name), problem))?;)*
                Ok(Self { $($name,)* })
            }
        }

        /// The columns, in the order of the fields of the row.
        pub const COLUMNS: &[$crate::database::table::Column] =
            &[$($crate::database::table::Column(stringify!($name), $sql, $unit, $meaning),)*];
    };
}
pub(super) use row;
