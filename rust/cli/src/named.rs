//! Options and answers that are names of an enum, as serde has them.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::de::value::Error;
use serde::de::{DeserializeOwned, IntoDeserializer};

/// The value with this name.
pub fn read<T: DeserializeOwned>(name: &str) -> Result<T, Error> {
    T::deserialize(name.into_deserializer())
}

/// The parser of an option that takes some of the names.
pub fn parser<T: DeserializeOwned + Clone + Send + Sync + 'static>(
    names: &'static [&'static str],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(names).try_map(|name| read(&name))
}

/// Reads one of some names, in small or capital letters; else says which there are.
pub fn choice<T: DeserializeOwned>(
    names: &'static [&'static str],
) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let name = names.iter().find(|name| name.eq_ignore_ascii_case(text));
        name.and_then(|name| read(name).ok()).ok_or_else(|| names.join(", "))
    }
}
