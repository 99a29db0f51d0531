//! The page: one HTML file with its figures inside, without scripts.

mod beyond;
mod chart;
mod curves;
mod edge;
mod fields;
mod states;
mod validation;

use crate::ReportError;
use crate::draw::{Style, key};
use crate::report::Made;
use std::fmt::Write;

/// The page's text.
///
/// # Errors
/// [`ReportError::Draw`].
pub fn text(made: &Made) -> Result<String, ReportError> {
    let report = &made.report;
    let stamp = &report.made;
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>MSDD: speed against accuracy</title>\n<style>\n{}</style>\n</head>\n<body>\n\
         <h1>Speed against accuracy</h1>\n<p>Heat conduction with thermal expansion in a bed of 15 000 grains: the solver against \
         discrete elements of the same packings. {} jobs, {} of them from the cache; made {} on {}, commit {}.{}</p>\n",
        include_str!("style.css"),
        report.jobs,
        report.cached_jobs,
        escape(&stamp.date),
        escape(&stamp.cpu),
        escape(&stamp.commit),
        if report.quick {
            " <b>Quick version: few configurations, coarse meshes, one packing.</b>"
        } else {
            ""
        }
    );
    page += "<p class=\"source\">How values are known. <b>committed</b>: the reference by discrete elements, three packings, \
             <code>cases/reference/make</code>, commit as above. <b>measured</b>: in this run. <b>cached</b>: measured by an earlier run \
             with the same programs, keys and processor. <b>extrapolated</b>: from a timed segment. <b>quoted</b>: from the paper. \
             Nothing is fitted to these runs: conductivity, stress, mechanical tangent and wall friction come from the database of \
             small boxes. Cost is processor time of one process, start and output included.</p>\n";
    page += &chart::section(made)?;
    page += &validation::section(made)?;
    page += &edge::section(made)?;
    let _ = write!(page, "<h2>Left out</h2>\n<ul>\n");
    for text in &report.left_out {
        let _ = writeln!(page, "<li>{}</li>", escape(text));
    }
    Ok(numbered(&(page + "</ul>\n</body>\n</html>\n")))
}

/// Captions begin with "Fig. #.": numbered as they follow each other.
fn numbered(page: &str) -> String {
    let mut parts = page.split("Fig. #.");
    let first = parts.next().unwrap_or_default().to_string();
    parts.enumerate().fold(first, |text, (k, part)| format!("{text}Fig. {}.{part}", k + 1))
}

/// Text as HTML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A figure: panels, what the markers mean, one sentence of what one sees, and where it comes from.
struct Figure<'a> {
    id: &'a str,
    panels: Vec<String>,
    keys: Vec<(Style, String)>,
    caption: String,
    source: &'a str,
}

impl Figure<'_> {
    fn html(&self, made: &Made) -> Result<String, ReportError> {
        let mut keys = String::new();
        for (style, text) in &self.keys {
            let _ = write!(keys, "<span>{} {}</span>", key(*style)?, escape(text));
        }
        let stamp = &made.report.made;
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

/// A table that scrolls in its box. Columns whose head begins with "'" hold text, with "\"" long text.
fn table(heads: &[&str], rows: &[Vec<String>]) -> String {
    let class = |head: &str| match head.chars().next() {
        Some('\'') => " class=\"text\"",
        Some('"') => " class=\"long\"",
        _ => "",
    };
    let mut html = "<div class=\"scroll\"><table>\n<tr>".to_string();
    for head in heads {
        let named = head.trim_start_matches(['\'', '"']);
        let aligned = if named.len() == head.len() { "" } else { " class=\"text\"" };
        let _ = write!(html, "<th{aligned}>{}</th>", escape(named));
    }
    html += "</tr>\n";
    for row in rows {
        html += "<tr>";
        for (head, cell) in heads.iter().zip(row) {
            let _ = write!(html, "<td{}>{}</td>", class(head), escape(cell));
        }
        html += "</tr>\n";
    }
    html + "</table></div>\n"
}

/// A number with so many digits after the point; a dash for none.
fn fixed(value: Option<f64>, digits: usize) -> String {
    value.filter(|v| v.is_finite()).map_or("–".to_string(), |v| format!("{v:.digits$}"))
}

/// The cases' names, with a star for those without expansion.
fn case_name(case: &str) -> &str {
    crate::reference::CASES.iter().find(|c| c.0 == case).map_or(case, |c| c.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_runs_cannot_break_the_page() {
        let html = table(&["'a", "b"], &[vec!["<script>".to_string(), "1 & 2".to_string()]]);
        assert!(html.contains("&lt;script&gt;") && html.contains("1 &amp; 2") && !html.contains("<script>"));
        assert_eq!(numbered("a Fig. #. b Fig. #. c"), "a Fig. 1. b Fig. 2. c");
        assert_eq!(fixed(None, 2), "–");
        assert_eq!(fixed(Some(1.005), 1), "1.0");
    }
}
