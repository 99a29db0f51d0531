//! Checks a case of several regions, which OpenFOAM's `chtMultiRegionFoam` solves: its beds are regions of solids with the thermo
//! `granularSolidThermo`. Other regions are checked by OpenFOAM itself.

use super::bed::THERMO;
use super::finding::Findings;
use super::start::Start;
use super::{bed, control, domain, files, grains, gravity, keys, mesh, sources};
use crate::dictionary::{Dictionary, Entry, Token};
use std::path::Path;

/// Path in the case folder of the list of regions.
pub const FILE: &str = "constant/regionProperties";
/// Name of the thermo of beds.
const BED: &str = "granularSolidThermo";

/// Files of a bed, by their names without the region, and whether the solver needs them.
const FILES: [(&str, bool); 14] = [
    (THERMO, true),
    (control::SOLUTION, true),
    ("system/fvSchemes", true),
    (domain::BLOCKS, false),
    (grains::FILE, true),
    (gravity::FILE, false),
    (sources::FILES[0], false),
    (sources::FILES[1], false),
    ("0/T", true),
    ("0/p", true),
    ("0/porosity", true),
    ("0/fabricIndex", true),
    ("0/conductivity", false),
    ("0/stress", false),
];

/// Checks the beds of the case.
pub fn check(folder: &Path, found: &mut Findings) {
    // chtMultiRegionFoam needs gravity without fluids, too
    let needed =
        [(FILE, true), (control::CONTROL, true), (gravity::FILE, true), (control::DECOMPOSITION, false)];
    let own = files::read(folder, &needed, str::to_string, found);
    files::file(&own, control::DECOMPOSITION)
        .into_iter()
        .for_each(|own| control::check_decomposition(own, found));
    let Some(listed) = files::file(&own, FILE) else { return };
    let names = |kind: &str| match listed.value("regions") {
        Ok(tokens) => regions_of(tokens, kind),
        Err(_) => Vec::new(),
    };
    for region in names("fluid").iter().filter(|region| is_bed(folder, region)) {
        let advice = format!("Region {region} is a bed of grains, which do not flow: list it as solid");
        found.error([FILE, "regions/fluid"], region, "", &advice);
    }
    let beds: Vec<String> = names("solid").into_iter().filter(|region| is_bed(folder, region)).collect();
    if beds.is_empty() {
        let advice = format!("No region is a bed: none has thermoType {BED} in its thermophysicalProperties");
        found.doubt([FILE, "regions/solid"], "", "", &advice);
        return;
    }
    let control = files::file(&own, control::CONTROL);
    let start = Start::find(folder, control);
    let times = control.and_then(|control| control::check_of_regions(control, start.time, found));
    for region in &beds {
        let mut here = Findings::default();
        check_bed(folder, region, times, &start, &mut here);
        found.0.extend(here.0.into_iter().map(|mut finding| {
            finding.file = start.path(&in_region(&finding.file, region));
            finding
        }));
    }
}

/// Names in `regions ( fluid (a b) solid (c) )` after this kind.
fn regions_of(tokens: &[Token], kind: &str) -> Vec<String> {
    let words = tokens.iter().map(|token| token.text.as_str());
    let after = words.skip_while(|word| *word != kind).skip(2);
    after.take_while(|word| *word != ")").map(str::to_string).collect()
}

fn is_bed(folder: &Path, region: &str) -> bool {
    let file = folder.join(in_region(THERMO, region));
    Dictionary::expanded(&file).is_ok_and(|thermo| thermo.text("thermoType").is_ok_and(|kind| kind == BED))
}

/// Path of a file of a region: constant/granularProperties becomes constant/bed/granularProperties.
fn in_region(file: &str, region: &str) -> String {
    match file.split_once('/') {
        Some((_, name)) if file == control::CONTROL || name.is_empty() => file.to_string(),
        Some((first, name)) => format!("{first}/{region}/{name}"),
        None => file.to_string(),
    }
}

/// Checks a bed; paths in the findings are without the region.
fn check_bed(
    folder: &Path,
    region: &str,
    times: Option<control::Times>,
    start: &Start,
    found: &mut Findings,
) {
    let files = files::read(folder, &FILES, |name| start.path(&in_region(name, region)), found);
    let file = |name: &str| files::file(&files, name);
    if let Some(thermo) = file(THERMO) {
        keys::check(thermo, THERMO, keys::THERMO, &[], found);
    }
    if let Some(solution) = file(control::SOLUTION) {
        check_solver(solution, found);
    }
    if let Some(Ok(mechanics)) = file(grains::FILE).map(|properties| properties.text("mechanics"))
        && mechanics != "none"
    {
        let advice = "Grains move in msddFoam, which solves a bed alone";
        found.error([grains::FILE, "mechanics"], &mechanics, "none in a region", advice);
    }
    let is_plane = file(grains::FILE).is_none_or(grains::is_plane);
    let mesh = mesh::check(&folder.join("constant").join(region), file(domain::BLOCKS), is_plane, found);
    bed::check([folder, Path::new(region)], &files, &mesh, (times, start), found);
}

/// The energy h needs a linear solver, and another entry for the last solution of a step.
fn check_solver(solution: &Dictionary, found: &mut Findings) {
    for name in ["h", "hFinal"] {
        let there = matches!(solution.dictionary_at("solvers"),
            Ok(solvers) if matches!(solvers.matching(name), Some(Entry::Dictionary(_))));
        if !there {
            let allowed = "a dictionary with the linear solver of the enthalpy, such as { solver PCG; preconditioner DIC; \
                           tolerance 1e-10; relTol 0; }";
            found.error([control::SOLUTION, &format!("solvers/{name}")], "missing", allowed, "");
        }
    }
}
