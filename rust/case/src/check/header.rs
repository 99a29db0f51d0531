//! Checks the heads of files, without which OpenFOAM refuses a file, or leaves it out.

use super::finding::Findings;
use super::{fields, gravity};
use crate::dictionary::Dictionary;

const KEYS: [&str; 3] = ["version", "format", "class"];

/// The class of a file, by its path in a case of `msddFoam`.
fn class(name: &str) -> &'static str {
    if name == gravity::FILE {
        return "uniformDimensionedVectorField";
    }
    match fields::FIELDS.iter().find(|field| field.file == name) {
        Some(field) => field.class(),
        None if name.starts_with("0/") => "volScalarField",
        None => "dictionary",
    }
}

/// Checks the head of a file with this path.
pub fn check(name: &str, file: &Dictionary, found: &mut Findings) {
    let class = class(name);
    let object = name.rsplit('/').next().unwrap_or(name);
    let advice = "OpenFOAM refuses a file without it, or leaves the file out";
    let Ok(head) = file.dictionary_at("FoamFile") else {
        let allowed = format!("{{ version 2.0; format ascii; class {class}; object {object}; }}");
        found.error([name, "FoamFile"], "missing", &allowed, advice);
        return;
    };
    for key in KEYS {
        let allowed = match key {
            "version" => "2.0",
            "format" => "ascii, binary",
            _ => class,
        };
        match head.text(key) {
            Ok(given) if key == "class" && given != class => {
                found.error([name, "FoamFile/class"], &given, class, advice);
            }
            Ok(_) => {}
            Err(_) => found.error([name, &head.path_of(key)], "missing", allowed, advice),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(name: &str, text: &str) -> Vec<String> {
        let file = Dictionary::parse(Path::new(name), text).unwrap();
        let mut found = Findings::default();
        check(name, &file, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn each_file_has_a_head_with_its_class() {
        for (name, class) in [
            ("0/T", "volScalarField"),
            ("0/p", "volScalarField"),
            ("0/stress", "volSymmTensorField"),
            ("constant/g", "uniformDimensionedVectorField"),
            ("system/fvSchemes", "dictionary"),
        ] {
            let head = format!("FoamFile {{ version 2.0; format ascii; class {class}; }}");
            assert_eq!(lines(name, &head), Vec::<String>::new());
            let wrong = lines(name, &head.replace(class, "volVectorField"));
            let wanted =
                format!("error: {name}: FoamFile/class = volVectorField, allowed: {class}. OpenFOAM");
            assert!(wrong.len() == 1 && wrong[0].starts_with(&wanted), "{wrong:?}");
            assert!(
                lines(name, "")[0].starts_with(&format!("error: {name}: FoamFile = missing, allowed: {{"))
            );
            let short = lines(name, &head.replace("version 2.0;", ""));
            assert!(short[0].contains("FoamFile/version = missing, allowed: 2.0"), "{short:?}");
        }
    }
}
