//! Questions on the terminal, one line each; an empty answer takes the proposal.

use crate::error::CliError;
use msdd_beds::units::TEMPERATURE;
use msdd_case::CaseError;
use std::io::{self, BufRead};

/// What an answer means; else what is allowed.
type Read<T> = Result<T, String>;

/// Gets values from the user, or takes the proposals.
pub struct Prompter {
    /// Whether questions are asked; otherwise all proposals are taken.
    pub interactive: bool,
}

impl Prompter {
    /// The value that was given as an option, else the answer to a question, else the proposal. `help`: text that is
    /// printed before the question and explains it.
    ///
    /// # Errors
    /// [`CliError::Message`] when a proposal cannot be parsed, or the input has ended.
    pub fn value<T>(
        &self,
        given: Option<T>,
        help: &str,
        question: &str,
        proposal: &str,
        read: impl Fn(&str) -> Read<T>,
    ) -> Result<T, CliError> {
        if let Some(value) = given {
            return Ok(value);
        }
        if !self.interactive {
            return read(proposal).map_err(|allowed| wrong(question, proposal, &allowed));
        }
        outln!("\n{help}");
        loop {
            out!("{question} [{proposal}]: ");
            crate::output::flush();
            let mut line = String::new();
            let bytes = io::stdin().lock().read_line(&mut line);
            if bytes.map_err(|error| CliError::Message(format!("cannot read the answer: {error}")))? == 0 {
                let message = format!(
                    "no answer to '{question}', the input has ended; --yes takes all proposals without asking"
                );
                return Err(CliError::Message(message));
            }
            let answer = line.trim();
            let answer = if answer.is_empty() { proposal } else { answer };
            match read(answer) {
                Ok(value) => return Ok(value),
                Err(allowed) => outln!("    '{answer}' cannot be taken, allowed: {allowed}"),
            }
        }
    }

    /// Reads by `read`, and an answer also by `check`, so that one out of range is asked again at once. Options and proposals are
    /// checked when all values are known.
    pub fn within<T>(
        &self,
        read: impl Fn(&str) -> Read<T>,
        check: impl Fn(&T) -> Result<(), CaseError>,
    ) -> impl Fn(&str) -> Read<T> {
        let asks = self.interactive;
        move |text| {
            let value = read(text)?;
            match check(&value) {
                Err(CaseError::Parameter { allowed, .. }) if asks => Err(allowed),
                Err(other) if asks => Err(other.to_string()),
                _ => Ok(value),
            }
        }
    }
}

/// The error of an answer or an option that is not allowed.
pub fn wrong(key: &str, value: &str, allowed: &str) -> CliError {
    CliError::Message(format!("{key} = {value}, allowed: {allowed}"))
}

/// A temperature \[K\], with or without a unit.
pub fn temperature(text: &str) -> Read<f64> {
    TEMPERATURE.parse(text)
}

/// Parses a finite number; its range is that of [`Prompter::within`].
pub fn number(text: &str) -> Read<f64> {
    text.parse()
        .ok()
        .filter(|value: &f64| value.is_finite())
        .ok_or_else(|| "a number, such as 0.05 or 2e11".to_string())
}
