//! Figures of the page: panels, legend, caption and the source of the data.

use crate::ReportError;
use crate::jobs::execute::Stamp;
use msdd_draw::{Style, escape, key};
use msdd_reference::packings::CASES;
use std::fmt::Write;

/// A figure: panels, the legend, a caption that says what one sees, and the source of the data.
pub struct Figure<'a> {
    pub id: &'a str,
    pub panels: Vec<String>,
    pub keys: Vec<(Style, String)>,
    pub caption: String,
    pub source: &'a str,
}

impl Figure<'_> {
    pub fn html(&self, stamp: &Stamp) -> Result<String, ReportError> {
        let mut keys = String::new();
        for (style, text) in &self.keys {
            let _ = write!(keys, "<span>{} {}</span>", key(*style)?, escape(text));
        }
        Ok(format!(
            "<figure id=\"{}\">\n<div class=\"panels\">\n{}</div>\n<div class=\"key\">{keys}</div>\n<figcaption>{} \
             <span class=\"source\">{} · <code>scripts/report</code> · {} · {}</span></figcaption>\n</figure>\n",
            self.id,
            self.panels.concat(),
            escape(&self.caption),
            escape(self.source),
            escape(&stamp.commit),
            escape(&stamp.date)
        ))
    }
}

/// Name of the case in a folder; those without expansion have a star.
pub fn case_name(case: &str) -> &str {
    CASES.iter().find(|c| c.0 == case).map_or(case, |c| c.1)
}
