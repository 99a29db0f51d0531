//! Plain text of comments and help as Markdown.

/// The text with what Markdown would read as its own escaped, and words that are code as code: those between backticks, and
/// every word for which `is_code` says so. `linked` may name an anchor for code.
pub fn prose(text: &str, is_code: impl Fn(&str) -> bool, linked: impl Fn(&str) -> Option<String>) -> String {
    let code = |code: &str| match linked(code) {
        Some(target) => format!("[`{code}`](#{target})"),
        None => format!("`{code}`"),
    };
    let parts = text.split('`').enumerate().map(|(k, part)| match k % 2 {
        1 => code(part),
        _ => words(part, &is_code, code),
    });
    parts.collect::<String>().replace('|', "\\|")
}

/// Text between code: every word is looked at without the marks around it.
fn words(text: &str, is_code: impl Fn(&str) -> bool, code: impl Fn(&str) -> String) -> String {
    let word = |word: &str| {
        let bare = word.trim_matches(|c: char| ",.;:()\"'\n".contains(c));
        match word.split_once(bare) {
            Some((before, after)) if !bare.is_empty() && is_code(bare) => {
                format!("{}{}{}", escaped(before), code(bare), escaped(after))
            }
            _ => escaped(word),
        }
    };
    text.split_inclusive([' ', '\n'])
        .map(|part| {
            let end = part.trim_end().len();
            word(&part[..end]) + &part[end..]
        })
        .collect()
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if "<*$\\".contains(c) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// A table; cells are Markdown. Empty cells become a dash.
pub fn table(titles: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let filled = |row: &Vec<String>| {
        let cell = |cell: &String| if cell.is_empty() { "–".to_string() } else { cell.replace('\n', " ") };
        line(&row.iter().map(cell).collect::<Vec<_>>())
    };
    let titles: Vec<String> = titles.iter().map(ToString::to_string).collect();
    line(&titles)
        + &format!("|{}\n", "---|".repeat(titles.len()))
        + &rows.iter().map(filled).collect::<String>()
}
