//! The marks in Markdown between which numbers and tables of the results stand: `<!--= key-->0.74<!--/-->` in a line,
//! `<!--= range:name@column-->0.2 to 1.5<!--/-->` for the least and largest number of a table's column (`column ()`: of the
//! numbers in brackets; `@row` at its end: in rows whose first cell has this text), and `<!--= table:name-->` … `<!--/-->` on lines of their own. Marks in code are text.

use crate::error::Finding;
use crate::pages::Page;
use pulldown_cmark::{Event, Tag, TagEnd};
use std::ops::Range;

const OPEN: &str = "<!--=";
const CLOSE: &str = "<!--/-->";

/// A pair of marks.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// `section.key`, `range:name@column`, or `table:name`.
    pub key: String,
    /// Bytes between the marks.
    pub inside: Range<usize>,
    pub line: usize,
    /// Whether the opening mark stands on a line of its own.
    pub own_line: bool,
}

impl Mark {
    pub fn table(&self) -> Option<&str> {
        self.key.strip_prefix("table:")
    }
}

/// The pairs of marks of a page, in their order; and what is wrong with marks.
pub fn marks(page: &Page) -> (Vec<Mark>, Vec<Finding>) {
    let (code, blocks) = code_and_html_blocks(page);
    let text = page.text.as_str();
    let (mut marks, mut findings) = (Vec::new(), Vec::new());
    let mut from = 0;
    while let Some(start) = next(text, from, &code) {
        let line = page.line(start);
        let mut wrong = |text: String| findings.push(Finding { file: page.file.clone(), line, text });
        if text[start..].starts_with(CLOSE) {
            wrong(format!("{CLOSE} without a mark before it that it closes"));
            from = start + CLOSE.len();
            continue;
        }
        let Some(end) = text[start..].find("-->").map(|k| start + k + 3) else {
            wrong(format!("{OPEN} is not ended by -->"));
            break;
        };
        let key = text[start + OPEN.len()..end - 3].trim().to_string();
        let close = next(text, end, &code).filter(|&k| text[k..].starts_with(CLOSE));
        let Some(close) = close else {
            wrong(format!("the mark of '{key}' is not closed: {CLOSE} is missing behind it"));
            from = end;
            continue;
        };
        let own_line = alone(text, start, end) && alone(text, close, close + CLOSE.len());
        if !key.starts_with("table:") && blocks.iter().any(|block| block.contains(&start)) {
            wrong(format!(
                "the mark of '{key}' begins a line, which makes the whole line HTML for Markdown: put a word before it"
            ));
        }
        marks.push(Mark { key, inside: end..close, line, own_line });
        from = close + CLOSE.len();
    }
    (marks, findings)
}

/// The next mark of either kind from byte `from` on that is not in code.
fn next(text: &str, mut from: usize, code: &[Range<usize>]) -> Option<usize> {
    loop {
        let found = [OPEN, CLOSE].iter().filter_map(|mark| text[from..].find(mark)).min()? + from;
        match code.iter().find(|range| range.contains(&found)) {
            Some(range) => from = range.end.max(found + 1),
            None => return Some(found),
        }
    }
}

/// Whether nothing else stands on the line of these bytes.
fn alone(text: &str, start: usize, end: usize) -> bool {
    let before = text[..start].rsplit('\n').next().unwrap_or_default();
    let after = text[end..].split('\n').next().unwrap_or_default();
    before.trim().is_empty() && after.trim().is_empty()
}

/// Bytes of code, in lines and in blocks; and of blocks of HTML.
fn code_and_html_blocks(page: &Page) -> (Vec<Range<usize>>, Vec<Range<usize>>) {
    let (mut code, mut blocks) = (Vec::new(), Vec::new());
    let mut begun = 0;
    for (event, range) in page.events() {
        match event {
            Event::Code(_) => code.push(range),
            Event::Start(Tag::CodeBlock(_)) => begun = range.start,
            Event::End(TagEnd::CodeBlock) => code.push(begun..range.end),
            Event::Html(_) => blocks.push(range),
            _ => {}
        }
    }
    (code, blocks)
}
