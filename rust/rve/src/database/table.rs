//! What stands in the table of rows of a database: columns, and the type of a row.

use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::{Debug, Display};

/// A column of the database: name, kind (`INTEGER`, `REAL` or `TEXT`), unit, meaning, whether a row has to have a value, and whether the
/// only field of a record is one.
pub struct Column(
    pub &'static str,
    pub &'static str,
    pub &'static str,
    pub &'static str,
    pub bool,
    pub fn(&csv::ByteRecord) -> bool,
);

/// The name of a row within its packing: the way through states and the stop on it.
pub type Place<R> = (<R as Row>::Way, i64);

/// A row of a database: one state of one packing.
pub trait Row: Clone + Default + PartialEq + Debug + Serialize + DeserializeOwned + Send + 'static {
    /// The columns, in the order of the fields.
    const COLUMNS: &'static [Column];
    /// Version of the columns, in the provenance; raised when they change.
    const SCHEMA: &'static str;
    /// Columns that files of older schemas may lack; they are empty there.
    const LATER: &'static [&'static str];
    /// The column that names the way.
    const WAY: &'static str;
    /// The names of ways.
    type Way: Ord + Copy + Debug + Display + Send + Sync;

    fn packing(&self) -> i64;
    fn place(&self) -> Place<Self>;
    fn seed(&self) -> u64;
    /// How the state came to rest.
    fn outcome(&self) -> &str;
    /// Why it was not reached.
    fn failure(&self) -> Option<&str>;

    /// Key by which the rows of a packing are sorted: way, then for each the stops outward, those on the negative side first.
    fn order(&self) -> impl Ord {
        let (way, stop) = self.place();
        (way, stop > 0, stop.unsigned_abs())
    }

    /// The name of a row in messages.
    fn name_of(packing: i64, (way, stop): Place<Self>) -> String {
        format!("packing {packing}, {} {way}, stop {stop}", Self::WAY)
    }

    /// The name of the row in messages.
    fn name(&self) -> String {
        Self::name_of(self.packing(), self.place())
    }
}

/// Defines a row from its version of the columns, the columns that older files may lack, the column of its way, and the list of all
/// columns: so all always agree.
macro_rules! row {
    ($(#[$about:meta])* $row:ident, $schema:literal, $later:expr, $way:ident: $ways:ty;
     $($name:ident: $type:ty, $kind:literal, $unit:literal, $meaning:literal;)*) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct $row {
            $(#[doc = concat!("\\[", $unit, "\\] ", $meaning)] pub $name: $type,)*
        }

        impl $row {
            /// Whether the state was reached and carries load.
            pub fn carries_load(&self) -> bool {
                ["settled", "capped"].contains(&self.outcome.as_str())
            }
        }

        /// The columns, in the order of the fields of the row.
        pub const COLUMNS: &[$crate::database::table::Column] = &[$($crate::database::table::Column(
            stringify!($name),
            $kind,
            $unit,
            $meaning,
            !matches!(stringify!($type).as_bytes(), [b'O', b'p', b't', ..]),
            |field| field.deserialize::<($type,)>(None).is_ok(),
        ),)*];

        impl $crate::database::table::Row for $row {
            const COLUMNS: &'static [$crate::database::table::Column] = COLUMNS;
            const SCHEMA: &'static str = $schema;
            const LATER: &'static [&'static str] = &$later;
            const WAY: &'static str = stringify!($way);
            type Way = $ways;

            fn packing(&self) -> i64 {
                self.packing
            }

            fn place(&self) -> ($ways, i64) {
                (self.$way, self.stop)
            }

            fn seed(&self) -> u64 {
                self.seed
            }

            fn outcome(&self) -> &str {
                &self.outcome
            }

            fn failure(&self) -> Option<&str> {
                self.failure.as_deref()
            }
        }
    };
}
pub(super) use row;
