//! The findings of a check.

use crate::CaseError;
use msdd_rve::message::shortened;
use std::fmt;

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The solver refuses the case, or computes something else than was meant.
    Error,
    /// The case runs, but its result may be wrong.
    Doubt,
}

/// One thing that is wrong or doubtful.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub severity: Severity,
    /// Path below the case folder; may be empty in a message of the solver, which is the advice alone.
    pub file: String,
    /// The key with those of its enclosing dictionaries; empty when the whole file is meant.
    pub key: String,
    pub value: String,
    pub allowed: String,
    /// A sentence that says why, or what to do about it.
    pub advice: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let severity = if self.severity == Severity::Error { "error" } else { "doubt" };
        write!(f, "{severity}: {}", self.file)?;
        if [&self.key, &self.value, &self.allowed].iter().all(|text| text.is_empty()) {
            return write!(f, "{}{}", if self.file.is_empty() { "" } else { ": " }, self.advice);
        }
        if !self.key.is_empty() {
            write!(f, ": {}", self.key)?;
        }
        if !self.value.is_empty() {
            let sign = if self.key.is_empty() { ":" } else { " =" };
            write!(f, "{sign} {}", shortened(&self.value))?;
        }
        if !self.allowed.is_empty() {
            write!(f, ", allowed: {}", self.allowed)?;
        }
        if !self.advice.is_empty() {
            write!(f, ". {}", self.advice)?;
        }
        Ok(())
    }
}

/// Findings in the order of the files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings(pub Vec<Finding>);

impl Findings {
    /// Adds something that the solver refuses.
    pub fn error(&mut self, [file, key]: [&str; 2], value: &str, allowed: &str, advice: &str) {
        self.add(Severity::Error, [file, key], value, allowed, advice);
    }

    /// Adds something that the user should know before the run, although the solver accepts it.
    pub fn doubt(&mut self, [file, key]: [&str; 2], value: &str, allowed: &str, advice: &str) {
        self.add(Severity::Doubt, [file, key], value, allowed, advice);
    }

    fn add(&mut self, severity: Severity, [file, key]: [&str; 2], value: &str, allowed: &str, advice: &str) {
        let [file, key, value, allowed, advice] = [file, key, value, allowed, advice].map(str::to_string);
        self.0.push(Finding { severity, file, key, value, allowed, advice });
    }

    /// Adds the error with which reading a file of the case ended.
    pub fn refused(&mut self, file: &str, error: CaseError, advice: &str) {
        match error {
            CaseError::Key { key, value, allowed, .. } => self.error([file, &key], &value, &allowed, advice),
            CaseError::Syntax { line, problem, .. } => {
                let advice = "Look at the line, and at those before it, for a missing ';' or bracket";
                self.error([file, ""], &format!("line {line}: {problem}"), "", advice);
            }
            CaseError::Read { problem, .. } => self.error([file, ""], &problem, "", advice),
            other => self.error([file, ""], &other.to_string(), "", advice),
        }
    }

    /// Numbers of errors and of doubts.
    pub fn counts(&self) -> [usize; 2] {
        [Severity::Error, Severity::Doubt]
            .map(|severity| self.0.iter().filter(|finding| finding.severity == severity).count())
    }
}
