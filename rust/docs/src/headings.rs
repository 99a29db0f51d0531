//! The anchors that headings get, in the book and on web pages that show READMEs.

use crate::pages::Page;
use pulldown_cmark::{Event, Tag, TagEnd};
use std::collections::{BTreeSet, HashMap};

/// Everything on a page that a link with # can lead to: headings, and HTML elements with an id.
pub fn anchors(page: &Page) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut seen: HashMap<String, usize> = HashMap::new();
    let mut heading: Option<(Option<String>, String)> = None;
    for (event, _) in page.events() {
        match event {
            Event::Start(Tag::Heading { id, .. }) => {
                heading = Some((id.map(|id| id.to_string()), String::new()))
            }
            Event::End(TagEnd::Heading(_)) => {
                if let Some((id, text)) = heading.take() {
                    let base = id.unwrap_or_else(|| anchor(&text));
                    let count = seen.entry(base.clone()).or_default();
                    found.insert(if *count == 0 { base } else { format!("{base}-{count}") });
                    *count += 1;
                }
            }
            Event::Text(text) | Event::Code(text) => {
                if let Some((_, heading)) = &mut heading {
                    heading.push_str(&text);
                }
            }
            Event::Html(html) | Event::InlineHtml(html) => found.extend(ids(&html)),
            _ => {}
        }
    }
    found
}

/// Lower case; blanks become hyphens; what is neither letter, digit, _ nor - is left out.
fn anchor(text: &str) -> String {
    let kept = text.trim().chars().filter_map(|c| match c {
        c if c.is_alphanumeric() || c == '_' || c == '-' => Some(c),
        c if c.is_whitespace() => Some('-'),
        _ => None,
    });
    kept.flat_map(char::to_lowercase).collect()
}

/// Values of id="…" in a piece of HTML.
fn ids(html: &str) -> Vec<String> {
    let values = html.split(" id=\"").skip(1).filter_map(|rest| rest.split_once('"'));
    values.map(|(id, _)| id.to_string()).collect()
}
