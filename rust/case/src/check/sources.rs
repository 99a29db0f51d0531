//! Checks `fvOptions`, the sources and constraints of a case.

use super::domain::Mesh;
use super::files::{self, Files};
use super::finding::Findings;
use super::zones;
use crate::dictionary::{Dictionary, Entry};

/// Paths in the case folder; OpenFOAM reads the first that is there.
pub const FILES: [&str; 2] = ["constant/fvOptions", "system/fvOptions"];
/// Types that look for the enthalpy of OpenFOAM's own solvers as soon as they are made, even if they are switched off.
const OF_ENTHALPY: [&str; 2] = ["fixedTemperatureConstraint", "limitTemperature"];

/// The sources of a bed, with the file in which they stand.
pub fn of(files: &Files) -> Option<(&'static str, &Dictionary)> {
    FILES.iter().find_map(|&name| Some((name, files::file(files, name)?)))
}

/// Checks the sources; `alone`: whether msddFoam solves the bed, which knows no enthalpy.
pub fn check(files: &Files, mesh: &Mesh, alone: bool, found: &mut Findings) {
    let Some((name, sources)) = of(files) else { return };
    zones::check(name, sources, mesh, found);
    for key in sources.keys().filter(|_| alone) {
        let Some(Entry::Dictionary(source)) = sources.get_any(&key.text) else { continue };
        let kind = source.text("type").unwrap_or_default();
        if OF_ENTHALPY.contains(&kind.as_str()) {
            let advice = "This type needs the enthalpy of OpenFOAM's own solvers; msddFoam solves for T";
            let allowed =
                "types that act on T, such as scalarSemiImplicitSource and scalarFixedValueConstraint";
            found.error([name, &source.path_of("type")], &kind, allowed, advice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn the_first_file_counts_and_types_without_t_are_refused() {
        let file = |kind: &str| {
            let text = format!("one {{ type {kind}; active no; }}");
            Dictionary::parse(Path::new("fvOptions"), &text).unwrap()
        };
        let lines = |files: &[(&'static str, &str)], alone: bool| {
            let files: Files = files.iter().map(|(name, kind)| (*name, file(kind))).collect();
            let mut found = Findings::default();
            check(&files, &Mesh::default(), alone, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        let [first, second] = FILES;
        let wrong = lines(&[(second, "limitTemperature")], true);
        assert!(
            wrong[0].starts_with("error: system/fvOptions: one/type = limitTemperature, allowed: types"),
            "{wrong:?}"
        );
        assert_eq!(lines(&[(second, "limitTemperature")], false), Vec::<String>::new());
        let both = [(second, "limitTemperature"), (first, "scalarSemiImplicitSource")];
        assert_eq!(lines(&both, true), Vec::<String>::new());
    }
}
