//! What stands in the table of rows of a database: columns, and the type of a row.

use super::cell::Value;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// A column of the database: name, kind (`INTEGER`, `REAL` or `TEXT`), unit, meaning.
pub struct Column(pub &'static str, pub &'static str, pub &'static str, pub &'static str);

/// A row of a database: one state of one packing.
pub trait Row: Clone + Default + PartialEq + Debug + Serialize + DeserializeOwned + Send + 'static {
    /// The columns, in the order of the fields.
    const COLUMNS: &'static [Column];
    /// Version of the columns, in the provenance; raised when they change.
    const SCHEMA: &'static str;
    /// Columns that files of older schemas may lack; they are empty there.
    const LATER: &'static [&'static str];
    /// The names of a row within its packing.
    type Place: Ord + Clone + Debug + Send + Sync;

    /// Reads the fields from cells by the number of their column; the error has the column's name.
    ///
    /// # Errors
    /// A cell that is absent or has no value of the column's type.
    fn from_cells<'a>(
        cell: impl Fn(usize) -> Result<Value<'a>, String>,
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
}

/// Defines a struct of a row and its columns from one list, so that they always agree, with the functions that [`Row`] needs.
macro_rules! row {
    ($(#[$about:meta])* $row:ident: $($name:ident: $type:ty, $kind:literal, $unit:literal, $meaning:literal;)*) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct $row {
            $(#[doc = concat!("\\[", $unit, "\\] ", $meaning)] pub $name: $type,)*
        }

        impl $row {
            fn of_cells<'a>(
                cell: impl Fn(usize) -> Result<$crate::database::cell::Value<'a>, String>,
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
            &[$($crate::database::table::Column(stringify!($name), $kind, $unit, $meaning),)*];
    };
}
pub(super) use row;
