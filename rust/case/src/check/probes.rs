//! Checks that probes lie in the mesh.

use super::control::CONTROL as FILE;
use super::domain::Mesh;
use super::finding::Findings;
use crate::dictionary::{Dictionary, Entry};
use crate::numbers::rounded;
use msdd_rve::message::number;

/// By how much a probe may lie beside the box of the mesh, as a share of the length of the box.
const ROUND_OFF: f64 = 1e-6;

/// Doubts probes outside of the box around the mesh, where that is known: `blocks`, the description of the mesh, has no edges that
/// bulge out of the box of its corners.
pub fn check(control: &Dictionary, blocks: Option<&Dictionary>, mesh: &Mesh, found: &mut Findings) {
    let bulges = |blocks: &Dictionary| {
        let is_empty = |key| blocks.value(key).is_ok_and(|tokens| tokens.len() <= 2);
        ["edges", "faces"].into_iter().any(|key| blocks.get(key).is_some() && !is_empty(key))
    };
    if blocks.is_some_and(bulges) {
        return;
    }
    let (Ok(functions), Some([low, high])) = (control.dictionary_at("functions"), mesh.extent) else {
        return;
    };
    for key in functions.keys() {
        let Some(Entry::Dictionary(function)) = functions.get_any(&key.text) else { continue };
        if !function.text("type").is_ok_and(|kind| kind == "probes") || function.get("region").is_some() {
            continue;
        }
        let tokens = function.value("probeLocations").unwrap_or_default();
        let numbers: Vec<f64> = tokens
            .iter()
            .skip_while(|token| token.text != "(")
            .filter_map(|token| token.text.parse().ok())
            .collect();
        let outside = |probe: &&[f64]| {
            probe.iter().enumerate().any(|(k, x)| {
                let more = ROUND_OFF * (high[k] - low[k]);
                !(low[k] - more..=high[k] + more).contains(x)
            })
        };
        if let Some(probe) = numbers.chunks_exact(3).find(outside) {
            let point = |point: &[f64]| {
                let parts: Vec<String> = point.iter().map(|&x| number(rounded(x, 5))).collect();
                format!("({})", parts.join(" "))
            };
            let allowed = format!("points between {} and {}", point(&low), point(&high));
            let advice = "The mesh ends before this point [m], so the probe finds no values";
            found.doubt([FILE, &function.path_of("probeLocations")], &point(probe), &allowed, advice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn probes_lie_in_the_box_of_the_mesh() {
        let read = |text: &str| Dictionary::parse(Path::new("system/blockMeshDict"), text).unwrap();
        let lines_of = |probes: &str, extent: Option<[[f64; 3]; 2]>, blocks: &str| {
            let text = format!("functions {{ p {{ type probes; probeLocations {probes}; }} }}");
            let control = Dictionary::parse(Path::new(FILE), &text).unwrap();
            let mut found = Findings::default();
            check(&control, Some(&read(blocks)), &Mesh { extent, ..Mesh::default() }, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        let lines = |probes: &str, extent| lines_of(probes, extent, "edges ( );");
        let box_of = Some([[0.0, 0.0, 0.0], [0.2, 0.1, 0.1]]);
        assert_eq!(lines("2((0.1 0.05 0.05) (0.2 0.1 0))", box_of), Vec::<String>::new());
        assert_eq!(lines("((5 0.05 0.05))", None), Vec::<String>::new());
        let round = "edges ( arc 0 1 ( 0.3 0 0 ) );";
        assert_eq!(lines_of("((0.25 0.05 0.05))", box_of, round), Vec::<String>::new());
        assert_eq!(
            lines("((0.1 0.05 0.05) (5 0.05 0.05))", box_of),
            [
                "doubt: system/controlDict: functions/p/probeLocations = (5 0.05 0.05), allowed: points between (0 0 0) and (0.2 0.1 \
                 0.1). The mesh ends before this point [m], so the probe finds no values"
            ]
        );
    }
}
