//! The page.
use crate::ReportError;
use crate::report::Made;

pub fn text(_made: &Made) -> Result<String, ReportError> {
    Ok(String::new())
}
