//! One value of a row, as a CSV holds it.

use super::kind::{Kind, RampName};
use super::spheres::kind::{PathName, SphereCompression};
use crate::Compression;
use crate::message::shortened;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::Error;

/// A field of a CSV by the kind of its column.
#[derive(Clone, Copy, Debug)]
pub enum Value<'a> {
    Empty,
    Integer(i64),
    Real(f64),
    Text(&'a [u8]),
}

/// A type that a column of the database can have.
pub(super) trait Cell: Sized {
    /// Converts a value. The error names the value found and the allowed values.
    fn read(value: Value) -> Result<Self, String>;
}

fn refused<T>(value: Value, allowed: &str) -> Result<T, String> {
    let found = match value {
        Value::Empty => "empty".to_string(),
        Value::Integer(integer) => integer.to_string(),
        Value::Real(real) => crate::message::number(real),
        Value::Text(text) => format!("'{}'", shortened(&String::from_utf8_lossy(text))),
    };
    Err(format!("{found}, allowed: {allowed}"))
}

impl Cell for f64 {
    fn read(value: Value) -> Result<Self, String> {
        match value {
            Value::Real(real) if real.is_finite() => Ok(real),
            Value::Integer(integer) => Ok(integer as f64),
            other => refused(other, "a finite number"),
        }
    }
}

impl Cell for i64 {
    fn read(value: Value) -> Result<Self, String> {
        match value {
            Value::Integer(integer) => Ok(integer),
            other => refused(other, "a whole number"),
        }
    }
}

impl Cell for u64 {
    fn read(value: Value) -> Result<Self, String> {
        match value {
            Value::Integer(integer) if integer >= 0 => Ok(integer as u64),
            other => refused(other, "a whole number from 0"),
        }
    }
}

impl Cell for String {
    fn read(value: Value) -> Result<Self, String> {
        text(value).map(str::to_string)
    }
}

/// A text; bytes that are not UTF-8 give an error and no panic.
fn text(value: Value<'_>) -> Result<&str, String> {
    match value {
        Value::Text(bytes) => std::str::from_utf8(bytes)
            .map_err(|error| format!("byte {} is not UTF-8, allowed: a text", error.valid_up_to())),
        other => refused(other, "a text"),
    }
}

impl<T: Cell> Cell for Option<T> {
    fn read(value: Value) -> Result<Self, String> {
        if matches!(value, Value::Empty) { Ok(None) } else { T::read(value).map(Some) }
    }
}

/// Implements [`Cell`] for enumerations, written by the names that serde gives them.
macro_rules! names {
    ($($type:ty)*) => {$(
        impl Cell for $type {
            fn read(value: Value) -> Result<Self, String> {
                from_name(value)
            }
        }
    )*};
}

names!(Kind RampName Compression SphereCompression PathName);

fn from_name<T: for<'de> Deserialize<'de>>(value: Value) -> Result<T, String> {
    T::deserialize(text(value)?.into_deserializer()).map_err(|error: Error| shortened(&error.to_string()))
}
