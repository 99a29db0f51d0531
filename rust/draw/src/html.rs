//! HTML of parts of a page that needs no other files: head, tables, numbered figures.

use crate::text::escape;
use std::fmt::Write;

/// A table that scrolls if it is too wide. Columns whose head begins with "'" contain text, with "\"" long text, else numbers.
pub fn table(heads: &[&str], rows: &[Vec<String>]) -> String {
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

/// A number with `digits` digits after the point; a dash for `None`.
pub fn fixed(value: Option<f64>, digits: usize) -> String {
    value.filter(|v| v.is_finite()).map_or("–".to_string(), |v| format!("{v:.digits$}"))
}

/// The beginning of a page, up to its first heading.
pub fn head(title: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{}</style>\n</head>\n<body>\n",
        include_str!("style.css"),
        title = escape(title)
    )
}

/// Numbers the figures in their order: captions begin with "Fig. #.".
pub fn numbered(page: &str) -> String {
    let mut parts = page.split("Fig. #.");
    let first = parts.next().unwrap_or_default().to_string();
    parts.enumerate().fold(first, |text, (k, part)| format!("{text}Fig. {}.{part}", k + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_numbered_as_they_follow_each_other() {
        assert_eq!(numbered("a Fig. #. b Fig. #. c"), "a Fig. 1. b Fig. 2. c");
    }

    #[test]
    fn text_of_runs_cannot_break_the_page() {
        let html = table(&["'a", "b"], &[vec!["<script>".to_string(), "1 & 2".to_string()]]);
        assert!(html.contains("&lt;script&gt;") && html.contains("1 &amp; 2") && !html.contains("<script>"));
        assert_eq!(fixed(None, 2), "–");
        assert_eq!(fixed(Some(1.005), 1), "1.0");
    }
}
