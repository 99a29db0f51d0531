//! What the numbers of a law may be.

use super::law::Law;
use super::parameters;
use crate::SurrogateError;
use crate::document::field;

impl Law {
    /// Refuses numbers for which the law has no meaning.
    ///
    /// # Errors
    /// [`SurrogateError::Field`] with key, value and what is allowed.
    pub fn check(&self) -> Result<(), SurrogateError> {
        parameters::check(self)?;
        let usual = self.fabric[1];
        let fabric = ("fabric[1]", usual, (0.0..=1.0).contains(&usual), "0 to 1");
        match self.contacts.numbers().chain([fabric]).find(|(_, _, good, _)| !good) {
            Some((key, value, _, allowed)) => field(&format!("law.{key}"), value, allowed),
            None => Ok(()),
        }
    }
}
