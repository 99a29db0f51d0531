//! What a check finds.

use std::fmt;

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The solver refuses the case.
    Error,
    /// The case runs, but its result may not be what was meant.
    Warning,
    /// What was not looked at.
    Omission,
}

/// One thing that is wrong or warned.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    pub severity: Severity,
    /// File, key, value and what is allowed, as far as they are known.
    pub text: String,
}

impl Finding {
    pub fn new(severity: Severity, text: &str) -> Self {
        Self { severity, text: text.to_string() }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let severity = match self.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Omission => "not checked",
        };
        write!(f, "{severity}: {}", self.text)
    }
}
