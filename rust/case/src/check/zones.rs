//! Checks the zones and sets of cells that dictionaries name.

use super::domain::Mesh;
use super::finding::Findings;
use crate::dictionary::{Dictionary, Entry, joined};

/// Checks, if the mesh is made, every entry `cellZone` or `cellSet` of a file that selects cells, and `name` beside
/// `regionType cellZone`, but not in what is switched off or looks at another region.
pub fn check(file: &str, dictionary: &Dictionary, mesh: &Mesh, found: &mut Findings) {
    let is =
        |key: &str, words: &[&str]| dictionary.text(key).is_ok_and(|word| words.contains(&word.as_str()));
    if is("enabled", &["no", "off", "false", "n", "f", "none"]) || dictionary.get("region").is_some() {
        return;
    }
    let selects_zone = !dictionary.text("selectionMode").is_ok_and(|mode| mode != "cellZone");
    for key in dictionary.keys() {
        let (there, what) = match key.text.as_str() {
            "cellZone" if selects_zone => (&mesh.zones, "zones"),
            "name" if is("regionType", &["cellZone"]) => (&mesh.zones, "zones"),
            "cellSet" if is("selectionMode", &["cellSet"]) => (&mesh.sets, "sets"),
            _ => (&None, ""),
        };
        match dictionary.get_any(&key.text) {
            Some(Entry::Dictionary(inner)) => check(file, inner, mesh, found),
            Some(Entry::Value(tokens)) => {
                let (Some(there), [name]) = (there, tokens.as_slice()) else { continue };
                // Patterns may match any zone
                if name.quoted || there.contains(&name.text) {
                    continue;
                }
                let known = if there.is_empty() { "none".to_string() } else { there.join(", ") };
                let allowed = format!("the {what} of cells in constant/polyMesh: {known}");
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

    #[test]
    fn sets_that_are_not_there_are_named() {
        let text = "heat { selectionMode cellSet; cellSet core; } all { selectionMode all; cellSet no; }";
        let file = Dictionary::parse(Path::new("constant/fvOptions"), text).unwrap();
        let lines = |sets: Option<&[&str]>| {
            let sets = sets.map(|names| names.iter().map(ToString::to_string).collect());
            let mut found = Findings::default();
            check("constant/fvOptions", &file, &Mesh { sets, ..Mesh::default() }, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(lines(Some(&["core"])), Vec::<String>::new());
        assert_eq!(lines(None), Vec::<String>::new());
        assert_eq!(
            lines(Some(&[])),
            [
                "error: constant/fvOptions: heat/cellSet = core, allowed: the sets of cells in constant/polyMesh: none"
            ]
        );
    }
}
