//! Checks the fields in `0`: dimensions, values, boundary conditions.

use super::dimensions::Dimensions;
use super::domain::Mesh;
use super::finding::Findings;
use crate::dictionary::{Dictionary, Entry, Token, joined};
use msdd_rve::message::number;

/// A field that the solver reads at the start.
pub struct Expected {
    pub file: &'static str,
    pub required: bool,
    dimensions: &'static str,
    unit: &'static str,
    /// Least and largest value that is allowed.
    range: [f64; 2],
    /// Components of a value.
    components: usize,
}

/// The fields. T, porosity and fabricIndex are required; for the others the solver uses the model's mean when they are missing.
pub const FIELDS: [Expected; 5] = [
    expected("0/T", true, "[ 0 0 0 1 0 0 0 ]", "K", [0.0, 1e6]),
    expected("0/porosity", true, "[ 0 0 0 0 0 0 0 ]", "", [0.0, 1.0]),
    expected("0/fabricIndex", true, "[ 0 0 0 0 0 0 0 ]", "", [-1.0, 1.0]),
    Expected {
        file: "0/conductivity",
        required: false,
        dimensions: "[ 1 1 -3 -1 0 0 0 ]",
        unit: "W/(m K)",
        range: [-1e30, 1e30],
        components: 6,
    },
    Expected {
        file: "0/stress",
        required: false,
        dimensions: "[ 1 -1 -2 0 0 0 0 ]",
        unit: "Pa",
        range: [-1e300, 1e300],
        components: 6,
    },
];

impl Expected {
    /// The class in its head.
    pub fn class(&self) -> &'static str {
        if self.components == 1 { "volScalarField" } else { "volSymmTensorField" }
    }
}

const fn expected(
    file: &'static str,
    required: bool,
    dimensions: &'static str,
    unit: &'static str,
    range: [f64; 2],
) -> Expected {
    Expected { file, required, dimensions, unit, range, components: 1 }
}

/// Values of a field: one for all cells, or one for each cell; each has one component or six.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    pub numbers: Vec<Vec<f64>>,
    pub uniform: bool,
}

impl Values {
    /// Value of a cell.
    pub fn at(&self, cell: usize) -> &[f64] {
        &self.numbers[if self.uniform { 0 } else { cell.min(self.numbers.len() - 1) }]
    }

    /// Mean of a component over the cells.
    pub fn mean(&self, component: usize) -> f64 {
        self.numbers.iter().map(|value| value[component]).sum::<f64>() / self.numbers.len() as f64
    }
}

/// Checks a field; returns its values when they can be read.
pub fn check(field: &Expected, file: &Dictionary, mesh: &Mesh, found: &mut Findings) -> Option<Values> {
    // Scaled units such as mm are refused in fields
    let good = |given: &[Token]| {
        Dimensions::read(given).is_some_and(|given| given.are(field.dimensions) && given.factor == 1.0)
    };
    match file.value("dimensions") {
        Ok(given) if good(given) => {}
        Ok(given) => found.error([field.file, "dimensions"], &joined(given), field.dimensions, ""),
        Err(error) => found.refused(field.file, error, ""),
    }
    check_patches(field, file, mesh, found);
    let values = match file.value("internalField") {
        Ok(tokens) => read(field, tokens, mesh, found)?,
        Err(error) => {
            found.refused(field.file, error, "");
            return None;
        }
    };
    let [least, most] = field.range;
    // Only temperatures may be equal to an end of their range.
    let inside = |value: f64| value < most && (value > least || (field.unit == "K" && value == least));
    let wrong = values.numbers.iter().enumerate().find(|(_, value)| !value.iter().all(|&one| inside(one)));
    if let Some((cell, value)) = wrong {
        let allowed = format!("between {} and {} {}", number(least), number(most), field.unit);
        let advice = match (field.file, value[0]) {
            ("0/T", _) => "Temperatures are in Kelvin",
            ("0/porosity", value) if value > 1.0 => "Is it in per cent?",
            _ => "",
        };
        let shown: Vec<String> = value.iter().map(|&one| number(one)).collect();
        let place = if values.uniform { String::new() } else { format!(" in cell {cell}") };
        found.error([field.file, "internalField"], &(shown.join(" ") + &place), allowed.trim(), advice);
        return None;
    }
    Some(values)
}

fn read(field: &Expected, tokens: &[Token], mesh: &Mesh, found: &mut Findings) -> Option<Values> {
    let words: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
    let (numbers, uniform) = match words.as_slice() {
        ["uniform", rest @ ..] => (numbers_in(rest, field.components), true),
        // OpenFOAM v1912 takes it as uniform
        rest @ [_] if field.components == 1 => (numbers_in(rest, 1), true),
        ["nonuniform", list @ ..] => {
            // The kind of the list and its length may be missing in front of it
            let list =
                if list.first().is_some_and(|word| word.starts_with("List<")) { &list[1..] } else { list };
            let (count, rest) = match list {
                [count, rest @ ..] if *count != "(" => (count.parse::<usize>().ok(), rest),
                rest => (None, rest),
            };
            // A list of equal values is printed by OpenFOAM as 336 { 0.12 }.
            let (numbers, equal) = match rest {
                ["{", value @ .., "}"] => {
                    (numbers_in(value, field.components).filter(|numbers| numbers.len() == 1), true)
                }
                _ => (numbers_in(rest, field.components), false),
            };
            let length = if equal { count } else { numbers.as_ref().map(Vec::len) };
            if let (Some(length), Some(cells)) = (length, mesh.cells)
                && length != cells
            {
                let value = format!("a list of {length} values");
                let advice = "The field belongs to another mesh; a uniform value fits any, and 'msdd reference fields' makes one \
                              for this mesh";
                found.error(
                    [field.file, "internalField"],
                    &value,
                    &format!("{cells}, one for each cell"),
                    advice,
                );
                return None;
            }
            (numbers, equal)
        }
        _ => (None, true),
    };
    if let Some(numbers) = numbers.filter(|numbers| !numbers.is_empty()) {
        return Some(Values { numbers, uniform });
    }
    let value = joined(tokens);
    let kind = if field.components == 1 { "a number" } else { "(xx xy xz yy yz zz)" };
    found.error(
        [field.file, "internalField"],
        &value,
        &format!("uniform and {kind}, or nonuniform and a list of such, as text"),
        "",
    );
    None
}

fn numbers_in(words: &[&str], components: usize) -> Option<Vec<Vec<f64>>> {
    let plain = words.iter().filter(|word| !["(", ")"].contains(word));
    let numbers: Vec<f64> = plain.map(|word| word.parse().ok()).collect::<Option<_>>()?;
    numbers
        .len()
        .is_multiple_of(components)
        .then(|| numbers.chunks(components).map(<[f64]>::to_vec).collect())
}

/// Checks that each patch of the mesh has a boundary condition: by its name, by a group, or by a pattern.
fn check_patches(field: &Expected, file: &Dictionary, mesh: &Mesh, found: &mut Findings) {
    let Ok(boundary) = file.dictionary_at("boundaryField") else {
        found.error(
            [field.file, "boundaryField"],
            "missing",
            "a dictionary with a condition for each patch",
            "",
        );
        return;
    };
    for [name, kind] in &mesh.patches {
        // OpenFOAM itself makes those of patches that are empty
        if kind != "empty" && mesh.condition(boundary, name).is_none() {
            let advice = "The mesh has this patch; give it a condition, such as { type zeroGradient; }";
            found.error([field.file, &boundary.path_of(name)], "missing", "a dictionary in braces", advice);
        }
    }
    for key in boundary.keys().filter(|key| !key.quoted) {
        let known = mesh.patches.iter().any(|[name, kind]| key.text == *name || key.text == *kind)
            || mesh.groups.iter().any(|[group, _]| key.text == *group);
        let constraint = match boundary.get(&key.text) {
            Some(Entry::Dictionary(patch)) => {
                patch.text("type").is_ok_and(|kind| kind == key.text || kind.starts_with("processor"))
            }
            _ => true,
        };
        if !known && !constraint && !mesh.patches.is_empty() {
            let names = mesh.names();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let advice = match super::keys::nearest(&key.text, &names) {
                Some(near) => {
                    format!("The mesh has no such patch, so this has no effect: is '{near}' meant?")
                }
                None => "The mesh has no such patch, so this has no effect".to_string(),
            };
            found.doubt([field.file, &boundary.path_of(&key.text)], "{...}", &names.join(", "), &advice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(field: usize, text: &str) -> Vec<String> {
        let mesh = Mesh {
            patches: [["left", "wall"], ["back", "empty"]].map(|pair| pair.map(str::to_string)).to_vec(),
            groups: vec![["hot".to_string(), "left".to_string()]],
            cells: Some(3),
            ..Mesh::default()
        };
        let file = Dictionary::parse(Path::new(FIELDS[field].file), text).unwrap();
        let mut found = Findings::default();
        check(&FIELDS[field], &file, &mesh, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn good_fields_pass_and_others_are_named_with_what_is_allowed() {
        let good = "dimensions [0 0 0 0 0 0 0]; internalField nonuniform List<scalar> 3 ( 0.1 0.2 0.1 );
            boundaryField { empty { type empty; } \".*\" { type zeroGradient; } }";
        assert_eq!(lines(1, good), Vec::<String>::new());
        // As OpenFOAM prints a list of equal values.
        assert_eq!(lines(1, &good.replace("3 ( 0.1 0.2 0.1 )", "3{0.1}")), Vec::<String>::new());
        assert_eq!(
            lines(1, &good.replace("nonuniform List<scalar> 3 ( 0.1 0.2 0.1 )", "0.1")),
            Vec::<String>::new()
        );
        let grouped = good.replace("\".*\"", "hot");
        assert_eq!(lines(1, &grouped), Vec::<String>::new());
        for bare in ["( 0.1 0.2 0.1 )", "3 ( 0.1 0.2 0.1 )"] {
            let bare = good.replace("List<scalar> 3 ( 0.1 0.2 0.1 )", bare);
            assert_eq!(lines(1, &bare), Vec::<String>::new());
        }
        for (from, to, message) in [
            (
                "[0 0 0 0 0 0 0]",
                "[0 1 0 0 0 0 0]",
                "dimensions = [ 0 1 0 0 0 0 0 ], allowed: [ 0 0 0 0 0 0 0 ]",
            ),
            (
                "3 ( 0.1 0.2 0.1 )",
                "2 ( 0.1 0.2 )",
                "internalField = a list of 2 values, allowed: 3, one for each cell",
            ),
            (
                "3 ( 0.1 0.2 0.1 )",
                "2{0.1}",
                "internalField = a list of 2 values, allowed: 3, one for each cell",
            ),
            ("0.2", "12.5", "internalField = 12.5 in cell 1, allowed: between 0 and 1. Is it in per cent?"),
            ("0.2", "many", "internalField = nonuniform List<scalar> 3 ( 0.1 many 0.1 ), allowed: uniform"),
            ("internalField", "internalFeld", "internalField = missing, allowed: a value"),
            ("\".*\"", "top", "boundaryField/left = missing, allowed: a dictionary in braces"),
            ("boundaryField", "boundary", "boundaryField = missing"),
        ] {
            let all = lines(1, &good.replacen(from, to, 1));
            let wanted = format!("error: 0/porosity: {message}");
            assert!(all.iter().any(|line| line.starts_with(&wanted)), "{wanted}\n{all:#?}");
        }
        let cold = "dimensions [0 0 0 1 0 0 0]; internalField uniform -5; boundaryField { \".*\" { type zeroGradient; } }";
        assert_eq!(
            lines(0, cold),
            ["error: 0/T: internalField = -5, allowed: between 0 and 1000000 K. Temperatures are in Kelvin"]
        );
        assert_eq!(lines(0, &cold.replace("-5", "0")), Vec::<String>::new());
        for units in ["[K]", "[0 0 0 1 0]"] {
            let short = cold.replace("-5", "0").replace("[0 0 0 1 0 0 0]", units);
            assert_eq!(lines(0, &short), Vec::<String>::new());
        }
        let stress = "dimensions [1 -1 -2 0 0 0 0]; internalField uniform ( -3 0 0 -2 0 0 );
            boundaryField { \".*\" { type zeroGradient; } lft { type zeroGradient; } }";
        let all = lines(4, stress);
        assert!(
            all.len() == 1
                && all[0].starts_with("doubt: 0/stress: boundaryField/lft = {...}")
                && all[0].contains("'left'"),
            "{all:?}"
        );
    }
}
