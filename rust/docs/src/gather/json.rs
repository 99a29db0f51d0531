//! Reading entries of JSON files, with messages that name file and entry.

use crate::error::DocsError;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Where scripts/results leaves what the programs wrote, relative to the checkout.
pub const INPUTS: &str = "results/numbers";

/// A file, or a part of it.
#[derive(Clone, Debug)]
pub struct Json {
    file: PathBuf,
    /// Pointer to the part.
    place: String,
    pub value: Value,
}

impl Json {
    /// Reads `file`, relative to the checkout `root`.
    ///
    /// # Errors
    /// A file that is missing or no JSON.
    pub fn read(root: &Path, file: &str) -> Result<Self, DocsError> {
        let text = msdd_files::read_text(&root.join(file))?;
        let failed =
            |error: serde_json::Error| DocsError::Json { file: file.into(), text: error.to_string() };
        Ok(Self {
            file: file.into(),
            place: String::new(),
            value: serde_json::from_str(&text).map_err(failed)?,
        })
    }

    /// The entry at a pointer, `/cases/H/final`.
    ///
    /// # Errors
    /// There is none.
    pub fn at(&self, pointer: &str) -> Result<Self, DocsError> {
        let place = format!("{}{pointer}", self.place);
        match self.value.pointer(pointer) {
            Some(value) => Ok(Self { file: self.file.clone(), place, value: value.clone() }),
            None => Err(self.wrong(pointer, "is missing")),
        }
    }

    /// # Errors
    /// No number is there.
    pub fn number(&self, pointer: &str) -> Result<f64, DocsError> {
        self.at(pointer)?.value.as_f64().ok_or_else(|| self.wrong(pointer, "is not a number"))
    }

    /// The number at a pointer, none if there is no number.
    pub fn maybe(&self, pointer: &str) -> Option<f64> {
        self.value.pointer(pointer).and_then(Value::as_f64)
    }

    /// # Errors
    /// No text is there.
    pub fn text(&self, pointer: &str) -> Result<String, DocsError> {
        let text = self.at(pointer)?.value.as_str().map(str::to_string);
        text.ok_or_else(|| self.wrong(pointer, "is not a text"))
    }

    /// # Errors
    /// No list is there.
    pub fn list(&self, pointer: &str) -> Result<Vec<Self>, DocsError> {
        let whole = self.at(pointer)?;
        let list = whole.value.as_array().ok_or_else(|| self.wrong(pointer, "is not a list"))?;
        let entry = |(k, value): (usize, &Value)| Self {
            file: self.file.clone(),
            place: format!("{}/{k}", whole.place),
            value: value.clone(),
        };
        Ok(list.iter().enumerate().map(entry).collect())
    }

    /// The numbers of a list.
    ///
    /// # Errors
    /// No list is there, or something else than numbers in it.
    pub fn numbers(&self, pointer: &str) -> Result<Vec<f64>, DocsError> {
        self.list(pointer)?.iter().map(|entry| entry.number("")).collect()
    }

    /// The first entry of a list that fits.
    ///
    /// # Errors
    /// No list is there, or none fits; `what` says what was looked for.
    pub fn find(&self, pointer: &str, what: &str, fits: impl Fn(&Self) -> bool) -> Result<Self, DocsError> {
        let found = self.list(pointer)?.into_iter().find(fits);
        found.ok_or_else(|| self.wrong(pointer, &format!("has no entry '{what}'")))
    }

    /// Whether the text at a pointer is this one.
    pub fn says(&self, pointer: &str, text: &str) -> bool {
        self.value.pointer(pointer).and_then(Value::as_str) == Some(text)
    }

    /// An error about an entry.
    pub fn wrong(&self, pointer: &str, text: &str) -> DocsError {
        let place = format!("{}{pointer}", self.place);
        DocsError::Json { file: self.file.clone(), text: format!("'{place}' {text}") }
    }
}
