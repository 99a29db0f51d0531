//! Equations: $…$ and $$…$$ become MathML, which browsers show without scripts or fonts of ours. As preprocessor of mdBook:
//! it hands the book over as JSON and takes it back.

use crate::error::{DocsError, Finding, none_found};
use crate::pages::{BOOK, Page};
use crate::print;
use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{RenderConfig, Storage, push_mathml};
use serde_json::Value;
use std::ops::Range;
use std::path::Path;

/// The text of a page with its equations as MathML.
///
/// # Errors
/// Equations that do not parse or are not between $, and $ that belong to none, with page and line.
pub fn with_mathml(page: &Page) -> Result<String, DocsError> {
    let (mut text, mut findings) = (page.text.clone(), Vec::new());
    let options = Options::ENABLE_MATH | Options::ENABLE_TABLES | Options::ENABLE_FOOTNOTES;
    let events: Vec<(Event, Range<usize>)> =
        Parser::new_ext(&page.text, options).into_offset_iter().collect();
    let mut in_block = false;
    // From the end, so that bytes before stay where they are.
    for (event, range) in events.into_iter().rev() {
        let made = match &event {
            Event::Start(Tag::CodeBlock(_)) | Event::End(TagEnd::CodeBlock) => {
                in_block = !in_block;
                continue;
            }
            Event::InlineMath(latex) => mathml(latex, false),
            Event::DisplayMath(latex) => mathml(latex, true),
            Event::Text(plain) if !in_block && plain.contains('$') && !escaped(&page.text, range.start) => {
                Err("a $ that belongs to no equation: write \\$, or close the equation".to_string())
            }
            Event::Text(plain) if !in_block && ["\\(", "\\["].iter().any(|open| plain.contains(open)) => {
                Err("an equation between \\( and \\), which is not shown as one: write $…$".to_string())
            }
            _ => continue,
        };
        match made {
            Ok(made) => text.replace_range(range.clone(), &placed(&page.text, &event, &range, &made)),
            Err(problem) => findings.push(Finding {
                file: page.file.clone(),
                line: page.line(range.start),
                text: problem,
            }),
        }
    }
    none_found(findings)?;
    Ok(text)
}

/// Whether the character at a byte has a backslash before it.
fn escaped(text: &str, at: usize) -> bool {
    text.as_bytes()[..at].last() == Some(&b'\\')
}

/// LaTeX as MathML, without characters that Markdown would take for its own.
fn mathml(latex: &CowStr, display: bool) -> Result<String, String> {
    let wrong = |problem: String| format!("the equation '{}' does not parse: {problem}", latex.trim());
    let storage = Storage::new();
    let mut events = Vec::new();
    for event in pulldown_latex::Parser::new(latex, &storage) {
        events.push(Ok::<_, std::convert::Infallible>(
            event.map_err(|error| wrong(first_line(&error.to_string())))?,
        ));
    }
    let display_mode = if display { DisplayMode::Block } else { DisplayMode::Inline };
    let mut out = String::new();
    push_mathml(&mut out, events.into_iter(), RenderConfig { display_mode, ..RenderConfig::default() })
        .map_err(|error| wrong(error.to_string()))?;
    Ok(sheltered(&out))
}

fn first_line(text: &str) -> String {
    text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default().trim().to_string()
}

/// The same for a browser, and nothing that Markdown reads: in texts between the tags its characters become entities.
fn sheltered(html: &str) -> String {
    let (mut out, mut in_tag, mut in_quotes) = (String::new(), false, false);
    for c in html.chars() {
        match c {
            '<' => in_tag = true,
            '>' => in_tag = false,
            '"' if in_tag => in_quotes = !in_quotes,
            // pulldown-latex leaves no blank between some attributes.
            c if in_tag && !in_quotes && c.is_ascii_alphabetic() && out.ends_with('"') => out.push(' '),
            _ => {}
        }
        match c {
            '\n' | '\r' => out.push(' '),
            '*' | '_' | '`' | '|' | '[' | ']' | '\\' | '$' | '~' | '#' if !in_tag => {
                out.push_str(&format!("&#{};", u32::from(c)));
            }
            c => out.push(c),
        }
    }
    out
}

/// An equation on lines of its own becomes a block, with an empty line on either side, or Markdown would go on in it.
fn placed(text: &str, event: &Event, range: &Range<usize>, made: &str) -> String {
    let before = text[..range.start].rsplit('\n').next().unwrap_or_default();
    let after = text[range.end..].split('\n').next().unwrap_or_default();
    let own_lines = before.trim().is_empty() && after.trim().is_empty();
    if !matches!(event, Event::DisplayMath(_)) || !own_lines {
        return made.to_string();
    }
    format!("\n\n{before}<div class=\"equation\">{made}</div>\n")
}

/// Prints from the code and replaces the equations in all chapters of the book that mdBook hands over: `[context, book]`.
///
/// # Errors
/// Text that is no book, and what is wrong with markers and equations in any chapter.
pub fn preprocess(root: &Path, input: &str) -> Result<String, DocsError> {
    let wrong = |text: String| DocsError::Json { file: "book of mdBook".into(), text };
    let mut input: Value = serde_json::from_str(input).map_err(|error| wrong(error.to_string()))?;
    let book = input.get_mut(1).ok_or_else(|| wrong("is not [context, book]".to_string()))?;
    let mut findings = Vec::new();
    chapters(root, book, &mut findings)?;
    none_found(findings)?;
    serde_json::to_string(book).map_err(|error| wrong(error.to_string()))
}

fn chapters(root: &Path, part: &mut Value, findings: &mut Vec<Finding>) -> Result<(), DocsError> {
    if let Some(chapter) = part.get_mut("Chapter") {
        let name = chapter["source_path"].as_str().or(chapter["name"].as_str()).unwrap_or("?");
        let file = Path::new(BOOK).join(name);
        let page = Page::new(file, chapter["content"].as_str().unwrap_or_default());
        match print::expanded(root, &page).and_then(|page| with_mathml(&page)) {
            Ok(text) => chapter["content"] = text.into(),
            Err(DocsError::Found(found)) => findings.extend(found),
            Err(error) => return Err(error),
        }
    }
    match part {
        Value::Array(parts) => parts.iter_mut().try_for_each(|part| chapters(root, part, findings)),
        Value::Object(entries) => entries.values_mut().try_for_each(|part| chapters(root, part, findings)),
        _ => Ok(()),
    }
}
