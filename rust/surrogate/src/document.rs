//! What model files of all kinds share: JSON with a schema, identified by its SHA-256; errors name the key.

use crate::SurrogateError;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::borrow::Cow;

/// Cannot fail for plain data of finite numbers and string keys.
pub(crate) fn json<T: Serialize>(value: &T) -> String {
    serde_json::to_string_pretty(value).unwrap_or_else(|error| unreachable!("{error}"))
}

/// SHA-256 of a text, 64 hexadecimal digits.
pub fn hash(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Schema of a model file of any kind.
pub(crate) fn schema(text: &str) -> Result<String, SurrogateError> {
    #[derive(Deserialize)]
    struct Head {
        schema: String,
    }
    let head: Result<Head, _> = serde_json::from_str(text);
    head.map(|head| head.schema).map_err(|error| SurrogateError::Damaged(error.to_string()))
}

/// The error that refuses the value of a key.
pub(crate) fn field<T>(
    key: &str,
    value: impl ToString,
    allowed: impl Into<Cow<'static, str>>,
) -> Result<T, SurrogateError> {
    Err(SurrogateError::Field { key: key.to_string(), value: value.to_string(), allowed: allowed.into() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hash_is_sha_256() {
        assert_eq!(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
