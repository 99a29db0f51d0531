//! Maps that move: a slider and a button in the page, a figure for each of some times.

use super::maps;
use super::run::Run;
use crate::error::CliError;
use std::fmt::Write;

/// Numbers of times and of colours that are tried until the page is small enough.
const TRIED: [(usize, usize); 5] = [(60, 16), (40, 16), (40, 8), (20, 8), (10, 8)];
const SCRIPT: &str = include_str!("animation.js");

/// The page with the animation before its last section of notes; at most `most` bytes.
pub fn add(run: &Run, page: &str, most: usize) -> Result<String, CliError> {
    let wrong = |text: String| CliError::Message(text);
    let count = run.times.len();
    if count < 2 {
        return Err(wrong(format!(
            "--animate: {count} time is written, allowed: at least 2 (writeInterval in system/controlDict)"
        )));
    }
    let (begin, end) = page.rsplit_once("<p class=\"source\">").unwrap_or((page, ""));
    for (times, shades) in TRIED {
        let section = section(run, &spread(count, times), shades)?;
        if page.len() + section.len() < most {
            return Ok(format!("{begin}{section}<p class=\"source\">{end}"));
        }
    }
    Err(wrong(format!(
        "--animate: the page of {} would have more than {most} bytes: the mesh is too large",
        run.name
    )))
}

/// At most `most` numbers below `count`, evenly spread, the first and the last among them.
fn spread(count: usize, most: usize) -> Vec<usize> {
    let kept = most.min(count);
    (0..kept).map(|k| k * (count - 1) / (kept - 1)).collect()
}

fn section(run: &Run, times: &[usize], shades: usize) -> Result<String, CliError> {
    let names: Vec<String> = times.iter().map(|&time| run.time(time)).collect();
    let mut html = format!(
        "<section id=\"animation\">\n<h2>Animation</h2>\n<p><button type=\"button\">Play</button> <input type=\"range\" min=\"0\" max=\"{}\" \
         value=\"0\" aria-label=\"time\"/> <output>{}</output></p>\n<div class=\"panels\">\n",
        times.len() - 1,
        names[0]
    );
    for (field, frames) in maps::frames(run, times, shades)? {
        let _ = writeln!(html, "<figure id=\"animated-{field}\">");
        for (k, svg) in frames.iter().enumerate() {
            let hidden = if k == 0 { "" } else { " hidden=\"\"" };
            let _ = writeln!(html, "<div class=\"frame\" data-time=\"{}\"{hidden}>{svg}</div>", names[k]);
        }
        html += "</figure>\n";
    }
    Ok(html + "</div>\n<script>\n" + SCRIPT + "</script>\n</section>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_spread_with_both_ends() {
        assert_eq!(spread(3, 60), [0, 1, 2]);
        assert_eq!(spread(101, 5), [0, 25, 50, 75, 100]);
        let many = spread(1000, 60);
        assert_eq!((many.len(), many[0], many[59]), (60, 0, 999));
        assert!(many.windows(2).all(|pair| pair[1] > pair[0]));
    }
}
