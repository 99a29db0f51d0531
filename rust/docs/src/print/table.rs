//! Tables in Markdown.

/// A table; columns without anything in them are left out, and a unit `-` becomes a dash.
pub fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let kept: Vec<usize> = (0..head.len()).filter(|&k| rows.iter().any(|row| !row[k].is_empty())).collect();
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let mut text = line(kept.iter().map(|&k| head[k].to_string()).collect());
    text += &format!("|{}\n", "---|".repeat(kept.len()));
    for row in rows {
        text += &line(kept.iter().map(|&k| cell(&row[k])).collect());
    }
    text
}

fn cell(text: &str) -> String {
    match text {
        "" | "-" => "–".to_string(),
        _ => escaped(text).replace('|', "\\|"),
    }
}

/// Text of a comment as Markdown: outside of code, `<` begins no element of HTML.
pub fn escaped(text: &str) -> String {
    let parts = text.split('`').enumerate();
    let parts: Vec<String> = parts
        .map(|(k, part)| if k % 2 == 0 { part.replace('<', "&lt;") } else { part.to_string() })
        .collect();
    parts.join("`")
}
