//! One value of a row, as SQLite and CSV hold it.

use super::kind::{Kind, RampName};
use super::spheres::kind::{PathName, SphereCompression};
use crate::Compression;
use crate::message::shortened;
use rusqlite::types::{Value, ValueRef};
use serde::de::IntoDeserializer;
use serde::de::value::Error;
use serde::{Deserialize, Serialize};

/// A type that a column of the database can have.
pub(super) trait Cell: Sized {
    /// The value as it is stored; a float that is not finite is stored as NULL.
    fn value(&self) -> Value;

    /// Converts a stored value. The error names the value found and the allowed values.
    fn read(value: ValueRef) -> Result<Self, String>;
}

fn refused<T>(value: ValueRef, allowed: &str) -> Result<T, String> {
    let found = match value {
        ValueRef::Null => "empty".to_string(),
        ValueRef::Integer(integer) => integer.to_string(),
        ValueRef::Real(real) => crate::message::number(real),
        ValueRef::Text(text) => format!("'{}'", shortened(&String::from_utf8_lossy(text))),
        ValueRef::Blob(_) => "a blob".to_string(),
    };
    Err(format!("{found}, allowed: {allowed}"))
}

impl Cell for f64 {
    fn value(&self) -> Value {
        if self.is_finite() { Value::Real(*self) } else { Value::Null }
    }

    fn read(value: ValueRef) -> Result<Self, String> {
        match value {
            ValueRef::Real(real) if real.is_finite() => Ok(real),
            ValueRef::Integer(integer) => Ok(integer as f64),
            other => refused(other, "a finite number"),
        }
    }
}

impl Cell for i64 {
    fn value(&self) -> Value {
        Value::Integer(*self)
    }

    fn read(value: ValueRef) -> Result<Self, String> {
        match value {
            ValueRef::Integer(integer) => Ok(integer),
            other => refused(other, "a whole number"),
        }
    }
}

impl Cell for u64 {
    fn value(&self) -> Value {
        i64::try_from(*self).map_or(Value::Null, Value::Integer)
    }

    fn read(value: ValueRef) -> Result<Self, String> {
        match value {
            ValueRef::Integer(integer) if integer >= 0 => Ok(integer as u64),
            other => refused(other, "a whole number from 0"),
        }
    }
}

impl Cell for String {
    fn value(&self) -> Value {
        Value::Text(self.clone())
    }

    fn read(value: ValueRef) -> Result<Self, String> {
        text(value).map(str::to_string)
    }
}

/// A text; bytes that are not UTF-8 give an error and no panic.
fn text(value: ValueRef<'_>) -> Result<&str, String> {
    match value {
        ValueRef::Text(bytes) => std::str::from_utf8(bytes)
            .map_err(|error| format!("byte {} is not UTF-8, allowed: a text", error.valid_up_to())),
        other => refused(other, "a text"),
    }
}

impl<T: Cell> Cell for Option<T> {
    fn value(&self) -> Value {
        self.as_ref().map_or(Value::Null, Cell::value)
    }

    fn read(value: ValueRef) -> Result<Self, String> {
        if matches!(value, ValueRef::Null) { Ok(None) } else { T::read(value).map(Some) }
    }
}

/// Implements [`Cell`] for enumerations, stored by the names that serde gives them.
macro_rules! names {
    ($($type:ty)*) => {$(
        impl Cell for $type {
            fn value(&self) -> Value {
                named(self)
            }

            fn read(value: ValueRef) -> Result<Self, String> {
                from_name(value)
            }
        }
    )*};
}

names!(Kind RampName Compression SphereCompression PathName);

fn named(value: &impl Serialize) -> Value {
    match serde_json::json!(value) {
        serde_json::Value::String(name) => Value::Text(name),
        _ => Value::Null,
    }
}

fn from_name<T: for<'de> Deserialize<'de>>(value: ValueRef) -> Result<T, String> {
    T::deserialize(text(value)?.into_deserializer()).map_err(|error: Error| shortened(&error.to_string()))
}
