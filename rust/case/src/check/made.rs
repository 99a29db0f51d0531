//! Checks the files of the mesh in `constant/polyMesh`.

use super::finding::Findings;
use crate::binary::is_binary;
use rayon::prelude::*;
use std::path::Path;

/// Files without which there is no mesh.
const FILES: [&str; 5] = ["points", "faces", "owner", "neighbour", "boundary"];
/// What to do with a mesh that cannot be read.
pub const AGAIN: &str =
    "Make the mesh again, by the program that made it: blockMesh, or whatever stands in Allrun beside it";

/// Finds files that are missing, empty or end too early. Packed and binary files are only looked for.
pub fn check(folder: &Path, found: &mut Findings) {
    let problems: Vec<Option<&str>> = FILES.par_iter().map(|name| problem(&folder.join(name))).collect();
    for (name, problem) in FILES.iter().zip(problems) {
        if let Some(problem) = problem {
            found.error([&format!("constant/polyMesh/{name}"), ""], problem, "", AGAIN);
        }
    }
}

fn problem(file: &Path) -> Option<&'static str> {
    let packed = file.with_file_name(format!("{}.gz", file.file_name()?.to_str()?));
    if !file.exists() {
        return (!packed.exists()).then_some("missing");
    }
    let bytes = std::fs::read(file).ok()?;
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Some("empty");
    }
    let text = std::str::from_utf8(&bytes).ok().filter(|text| !is_binary(text.as_bytes()))?;
    (!is_whole(text)).then_some("the list does not end: the file is truncated")
}

/// Whether there is a list after the head of a file, and all brackets are closed.
fn is_whole(text: &str) -> bool {
    let (mut depth, mut lists, mut rest) = (0_i64, 0, text);
    while let Some(at) = rest.find(['(', ')', '{', '}', '/']) {
        let (found, after) = (rest.as_bytes()[at], &rest[at + 1..]);
        rest = match found {
            b'/' if after.starts_with('/') => after.split_once('\n').map_or("", |(_, next)| next),
            b'/' if after.starts_with('*') => after[1..].split_once("*/").map_or("", |(_, next)| next),
            _ => after,
        };
        match found {
            b'(' | b'{' => {
                depth += 1;
                lists += usize::from(depth == 1);
            }
            b')' | b'}' => depth -= 1,
            _ => {}
        }
    }
    // The first of them is the head.
    depth == 0 && lists > 1
}

/// Least and greatest coordinates of the points \[m\]; `None` if they cannot be read.
pub fn extent(folder: &Path) -> Option<[[f64; 3]; 2]> {
    let text = msdd_files::read_text(&folder.join("points")).ok()?;
    let mut points = Vec::new();
    for point in
        list_of(&text)?.split('(').map(|part| part.trim_end_matches(|c: char| c == ')' || c.is_whitespace()))
    {
        if !point.is_empty() {
            let numbers: Result<Vec<f64>, _> = point.split_whitespace().map(str::parse).collect();
            points.push(<[f64; 3]>::try_from(numbers.ok()?).ok()?);
        }
    }
    Some(extent_of(&points))
}

/// Least and greatest coordinates.
pub fn extent_of(points: &[[f64; 3]]) -> [[f64; 3]; 2] {
    let reach = |[low, high]: [[f64; 3]; 2], point: &[f64; 3]| {
        [std::array::from_fn(|k| low[k].min(point[k])), std::array::from_fn(|k| high[k].max(point[k]))]
    };
    points.iter().fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], reach)
}

/// The list of a file, without the head in front and the number of its entries.
pub fn list_of(text: &str) -> Option<&str> {
    let body = text.split_once('}').map_or(text, |(_, rest)| rest);
    let body = body.find('(').map(|open| &body[open..])?;
    Some(body.trim_end_matches(|c| c != ')'))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "// (c)\nFoamFile { version 2.0; format ascii; class x; }\n";

    #[test]
    fn files_are_whole() {
        assert!(is_whole(&format!("{HEAD}2\n(\n(0 0 0)\n(1 0 0)\n)\n// ****")));
        assert!(is_whole(&format!("{HEAD}0()")));
        assert!(is_whole(&format!("{HEAD}3{{0}}")));
        assert!(!is_whole(&format!("{HEAD}2\n(\n(0 0 0)\n")));
        assert!(is_whole(&format!("/* a smile :) */\n{HEAD}0()")));
        assert!(!is_whole(HEAD));
        assert!(is_binary(b"FoamFile { format binary; }") && !is_binary(HEAD.as_bytes()));
    }

    #[test]
    fn damaged_files_are_named() {
        let folder = std::env::temp_dir().join(format!("msdd-made-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let points = format!("{HEAD}2\n(\n(0 -1 0)\n(1 0 3)\n)\n");
        for (name, text) in [
            ("points", points.as_str()),
            ("faces", ""),
            ("owner", &points[..points.len() - 4]),
            ("boundary.gz", "packed"),
        ] {
            std::fs::write(folder.join(name), text).unwrap();
        }
        let mut found = Findings::default();
        check(&folder, &mut found);
        assert_eq!(extent(&folder), Some([[0.0, -1.0, 0.0], [1.0, 0.0, 3.0]]));
        std::fs::remove_dir_all(&folder).unwrap();
        let lines: Vec<String> = found.0.iter().map(ToString::to_string).collect();
        assert_eq!(lines.len(), 3, "{lines:?}");
        assert!(lines[0].starts_with("error: constant/polyMesh/faces: empty. Make the mesh again"));
        assert!(lines[1].starts_with("error: constant/polyMesh/owner: the list does not end"));
        assert!(lines[2].starts_with("error: constant/polyMesh/neighbour: missing"));
    }
}
