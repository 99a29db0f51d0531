//! Checks the zones of cells that dictionaries name.

use super::finding::Findings;
use super::mesh::Mesh;
use crate::dictionary::{Dictionary, Entry, joined};

/// Checks every entry `cellZone` of a file, but not in what is switched off or looks at another region, and `name` beside `regionType cellZone`, if the mesh is made.
pub fn check(file: &str, dictionary: &Dictionary, mesh: &Mesh, found: &mut Findings) {
    let Some(zones) = &mesh.zones else { return };
    let is =
        |key: &str, words: &[&str]| dictionary.text(key).is_ok_and(|word| words.contains(&word.as_str()));
    if is("enabled", &["no", "off", "false", "n", "f", "none"]) || dictionary.get("region").is_some() {
        return;
    }
    let of_region = dictionary.text("regionType").is_ok_and(|kind| kind == "cellZone");
    let selects = !dictionary.text("selectionMode").is_ok_and(|mode| mode != "cellZone");
    for key in dictionary.keys() {
        match dictionary.get_any(&key.text) {
            Some(Entry::Dictionary(inner)) => check(file, inner, mesh, found),
            Some(Entry::Value(tokens)) => {
                let names_one = (key.text == "cellZone" && selects) || (key.text == "name" && of_region);
                // Patterns may match any zone
                if !names_one || tokens.len() != 1 || tokens[0].quoted || zones.contains(&tokens[0].text) {
                    continue;
                }
                let known = if zones.is_empty() { "none".to_string() } else { zones.join(", ") };
                let allowed = format!("the zones of cells in constant/polyMesh: {known}");
                found.error([file, &dictionary.path_of(&key.text)], &joined(tokens), &allowed, "");
            }
            None => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn zones_that_the_mesh_does_not_have_are_named() {
        let text = "heat { type scalarSemiImplicitSource; selectionMode cellZone; cellZone core; } all { selectionMode all; cellZone no; } off { enabled no; cellZone no; } other { region wall; cellZone no; }
            mean { regionType cellZone; name rim; }";
        let file = Dictionary::parse(Path::new("constant/fvOptions"), text).unwrap();
        let lines = |zones: Option<&[&str]>| {
            let zones = zones.map(|names| names.iter().map(ToString::to_string).collect());
            let mut found = Findings::default();
            check("constant/fvOptions", &file, &Mesh { zones, ..Mesh::default() }, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(lines(Some(&["core", "rim"])), Vec::<String>::new());
        assert_eq!(lines(None), Vec::<String>::new());
        assert_eq!(
            lines(Some(&["rim"])),
            [
                "error: constant/fvOptions: heat/cellZone = core, allowed: the zones of cells in constant/polyMesh: rim"
            ]
        );
        assert!(
            lines(Some(&[]))[1]
                .contains("mean/name = rim, allowed: the zones of cells in constant/polyMesh: none")
        );
    }
}
