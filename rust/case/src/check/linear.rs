//! Checks the linear solver of T and the schemes, for what ends a run of OpenFOAM v1912.

use super::control::SOLUTION;
use super::domain::{Kind as Mesh, Mesh as Domain};
use super::finding::Findings;
use super::keys::{self, Key, Kind};
use crate::dictionary::{Dictionary, Entry, joined};

/// Path in the case folder.
pub const SCHEMES: &str = "system/fvSchemes";
/// For symmetric matrices, as that of T is.
const SOLVERS: &[&str] = &["GAMG", "PBiCGStab", "PCG", "smoothSolver"];
const PRECONDITIONERS: &[&str] = &["DIC", "FDIC", "diagonal", "none"];
const SMOOTHERS: &[&str] =
    &["DIC", "DICGaussSeidel", "FDIC", "GaussSeidel", "nonBlockingGaussSeidel", "symGaussSeidel"];
const NUMBERS: [&str; 4] = ["tolerance", "relTol", "maxIter", "minIter"];
/// Schemes of gradients.
const GRADIENTS: &[&str] = &[
    "Gauss",
    "cellLimited",
    "cellLimited<Venkatakrishnan>",
    "cellLimited<cubic>",
    "cellMDLimited",
    "edgeCellsLeastSquares",
    "faceLimited",
    "faceMDLimited",
    "fourth",
    "leastSquares",
    "pointCellsLeastSquares",
];

/// Checks `solvers/T`, if it is a dictionary; that it is there is checked with the rest of the file.
pub fn check_solver(solution: &Dictionary, found: &mut Findings) {
    let Ok(solvers) = solution.dictionary_at("solvers") else { return };
    let Some(Entry::Dictionary(own)) = solvers.matching("T") else { return };
    let must = |own: &Dictionary, name, words, found: &mut Findings| {
        keys::value(own, SOLUTION, &Key { name, required: true, kind: Kind::Word(words) }, found);
    };
    must(own, "solver", SOLVERS, found);
    match own.text("solver").as_deref() {
        Ok("GAMG" | "smoothSolver") => check_inner(own, "smoother", SMOOTHERS, found),
        Ok("PCG" | "PBiCGStab") => match own.dictionary_at("preconditioner") {
            // As a word it has nowhere to name its smoother
            Ok(inner) if inner.text("preconditioner").is_ok_and(|word| word == "GAMG") => {
                must(inner, "smoother", SMOOTHERS, found);
            }
            _ => check_inner(own, "preconditioner", PRECONDITIONERS, found),
        },
        _ => {}
    }
    for name in NUMBERS {
        let kind = Kind::Range(-1e300, 1e300, "");
        keys::value(own, SOLUTION, &Key { name, required: false, kind }, found);
    }
}

/// A word, which may stand under its own name within a dictionary.
fn check_inner(own: &Dictionary, name: &'static str, words: &'static [&'static str], found: &mut Findings) {
    let place = own.dictionary_at(name).unwrap_or(own);
    keys::value(place, SOLUTION, &Key { name, required: true, kind: Kind::Word(words) }, found);
}

/// Checks `system/fvSchemes`. The schemes themselves are asked for in meshes alone whose faces are not all along x and y.
pub fn check_schemes(schemes: &Dictionary, mesh: &Domain, found: &mut Findings) {
    for section in ["gradSchemes", "divSchemes", "laplacianSchemes"] {
        if schemes.dictionary_at(section).is_err() {
            let allowed = "a dictionary, such as that of a case by 'msdd case new'";
            found.error([SCHEMES, section], "missing", allowed, "The solver needs it; add it");
        }
    }
    if !matches!(mesh.kind(), Mesh::Wedge | Mesh::Solid) {
        return;
    }
    for (section, name, words) in
        [("gradSchemes", "grad(T)", GRADIENTS), ("laplacianSchemes", "laplacian(K,T)", &["Gauss"])]
    {
        let Ok(own) = schemes.dictionary_at(section) else { continue };
        // Keys are read up to their bracket
        if name.split_once('(').is_some_and(|(word, _)| own.get(word).is_some()) {
            continue;
        }
        let key = if own.matching(name).is_some() { name } else { "default" };
        let given = match own.matching(key) {
            Some(Entry::Value(tokens)) => joined(tokens),
            _ => "none".to_string(),
        };
        let first = given.split(' ').next().unwrap_or_default();
        if !words.contains(&first) {
            let advice = format!("The solver needs a scheme for {name} in this mesh");
            found.error([SCHEMES, &own.path_of(key)], &given, &words.join(", "), &advice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn solver(text: &str) -> Vec<String> {
        let file = Dictionary::parse(Path::new(SOLUTION), &format!("solvers {{ T {{ {text} }} }}")).unwrap();
        let mut found = Findings::default();
        check_solver(&file, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    /// All of these were run: the first ones end well, the others with an error of OpenFOAM.
    #[test]
    fn solvers_of_symmetric_matrices_are_known() {
        for good in [
            "solver PCG; preconditioner DIC; tolerance -1; relTol 0;",
            "solver PCG; preconditioner none;",
            "solver PBiCGStab; preconditioner DIC;",
            "solver smoothSolver; smoother GaussSeidel;",
            "solver GAMG; smoother GaussSeidel;",
            "solver PCG; preconditioner { preconditioner GAMG; smoother GaussSeidel; }",
        ] {
            assert_eq!(solver(good), Vec::<String>::new(), "{good}");
        }
        for (bad, wanted) in [
            ("preconditioner DIC;", "solver = missing, allowed: GAMG, PBiCGStab, PCG, smoothSolver"),
            ("solver PBiCG; preconditioner DILU;", "solver = PBiCG, allowed: GAMG"),
            ("solver FPCG; preconditioner DIC;", "solver = FPCG, allowed: GAMG"),
            ("solver PCG;", "preconditioner = missing, allowed: DIC, FDIC, diagonal, none"),
            ("solver PBiCGStab; preconditioner DILU;", "preconditioner = DILU, allowed: DIC"),
            ("solver PCG; preconditioner GAMG;", "preconditioner = GAMG, allowed: DIC"),
            ("solver PCG; preconditioner { preconditioner GAMG; }", "preconditioner/smoother = missing"),
            ("solver smoothSolver;", "smoother = missing, allowed: DIC, DICGaussSeidel"),
            ("solver GAMG; smoother DILU;", "smoother = DILU, allowed: DIC"),
            ("solver PCG; preconditioner DIC; tolerance abc;", "tolerance = abc"),
            ("solver PCG; preconditioner DIC; maxIter x;", "maxIter = x"),
        ] {
            let found = solver(bad);
            let wanted = format!("error: system/fvSolution: solvers/T/{wanted}");
            assert!(found.len() == 1 && found[0].starts_with(&wanted), "{wanted}\n{found:?}");
        }
    }

    #[test]
    fn schemes_that_the_solver_asks_for_are_there() {
        let good = "gradSchemes { default Gauss linear; } divSchemes { default none; }
            laplacianSchemes { default Gauss linear corrected; }";
        let lines = |kind: &str, text: &str| {
            let schemes = Dictionary::parse(Path::new(SCHEMES), text).unwrap();
            let patches = vec![["a", kind].map(str::to_string)];
            let mut found = Findings::default();
            check_schemes(&schemes, &Domain { patches, ..Domain::default() }, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        for kind in ["empty", "wedge", "wall"] {
            assert_eq!(lines(kind, good), Vec::<String>::new());
            for section in ["gradSchemes", "divSchemes", "laplacianSchemes"] {
                let found = lines(kind, &good.replace(section, "other"));
                let wanted = format!("error: system/fvSchemes: {section} = missing");
                assert!(found.len() == 1 && found[0].starts_with(&wanted), "{found:?}");
            }
        }
        let unknown = good.replace("Gauss linear;", "Gaus linear;");
        assert_eq!(lines("empty", &unknown), Vec::<String>::new());
        let found = lines("wedge", &unknown);
        assert!(
            found[0]
                .starts_with("error: system/fvSchemes: gradSchemes/default = Gaus linear, allowed: Gauss")
        );
        let none = good.replace("Gauss linear corrected", "none; \"laplacian(.*)\" none");
        let found = lines("wall", &none);
        assert!(found.len() == 1 && found[0].contains("laplacian(K,T)"), "{found:?}");
        let named = good.replace("default Gauss linear;", "default none; grad(T) leastSquares;");
        assert_eq!(lines("wall", &named), Vec::<String>::new());
    }
}
