//! Initial fields on other meshes of a rectangular box with cells of one size: means over the new cells.

use msdd_case::dictionary::{Dictionary, Entry, Token};
use std::fmt::Write as _;
use std::path::Path;

/// Kinds of lists, and how many numbers an entry has.
const KINDS: [(&str, usize); 3] = [("List<scalar>", 1), ("List<vector>", 3), ("List<symmTensor>", 6)];

/// The fields of a start that are not uniform.
#[derive(Clone, Debug)]
pub struct Averages {
    /// Cells of the user's mesh along x, y and z.
    own: [usize; 3],
    fields: Vec<Field>,
}

#[derive(Clone, Debug)]
struct Field {
    name: String,
    kind: &'static str,
    width: usize,
    /// Numbers of all cells, x fastest.
    numbers: Vec<f64>,
}

impl Averages {
    /// Reads the fields in a folder. None if one of them has to be left to OpenFOAM: values that differ along a wall, lists of another
    /// kind or in binary, or files that cannot be read.
    pub fn read(start: &Path, own: [usize; 3]) -> Option<Self> {
        let (mut fields, cells) = (Vec::new(), own.iter().product());
        for file in msdd_files::list(start).ok()?.into_iter().filter(|file| file.is_file()) {
            let field = Dictionary::expanded(&file).ok()?;
            let name = file.file_name()?.to_str()?.to_string();
            match field.value("internalField") {
                // A file that others include
                Err(_) => continue,
                Ok([word, ..]) if word.text == "uniform" => {}
                // The entry that replaces it is text
                Ok(_) if is_binary(&field) => return None,
                Ok(list) => fields.push(Field::read(name, list, cells)?),
            }
            if differs_along_walls(&field, cells) {
                return None;
            }
        }
        Some(Self { own, fields })
    }

    /// The entry of a field for a mesh with other numbers of cells; empty for a field that is uniform.
    pub fn entry(&self, name: &str, cells: [usize; 3]) -> String {
        let Some(field) = self.fields.iter().find(|field| field.name == name) else { return String::new() };
        let mut numbers = field.numbers.clone();
        let (mut counts, width) = (self.own, field.width);
        for k in 0..3 {
            let stride = width * counts[..k].iter().product::<usize>();
            numbers = along(&numbers, stride, counts[k], cells[k]);
            counts[k] = cells[k];
        }
        let mut text = format!("internalField nonuniform {}\n{}\n(\n", field.kind, numbers.len() / width);
        for value in numbers.chunks_exact(width) {
            let words: Vec<String> = value.iter().map(|number| format!("{number:e}")).collect();
            let _ = match width {
                1 => writeln!(text, "{}", words[0]),
                _ => writeln!(text, "({})", words.join(" ")),
            };
        }
        text + ");\n"
    }
}

impl Field {
    fn read(name: String, list: &[Token], cells: usize) -> Option<Self> {
        let [word, kind, length, rest @ ..] = list else { return None };
        let &(kind, width) = KINDS.iter().find(|(known, _)| *known == kind.text)?;
        let numbers: Vec<f64> = rest.iter().filter_map(|token| token.text.parse().ok()).collect();
        let whole = word.text == "nonuniform"
            && length.text.parse() == Ok(cells)
            && numbers.len() == cells * width
            && numbers.iter().all(|number| number.is_finite());
        whole.then_some(Self { name, kind, width, numbers })
    }
}

fn is_binary(field: &Dictionary) -> bool {
    field
        .dictionary_at("FoamFile")
        .and_then(|head| head.text("format"))
        .is_ok_and(|format| format == "binary")
}

/// Whether a boundary condition has a value for each face. OpenFOAM's conditions for cyclic patches, which a box has not, repeat the
/// list of the `cells` instead.
fn differs_along_walls(field: &Dictionary, cells: usize) -> bool {
    let Ok(boundary) = field.dictionary_at("boundaryField") else { return false };
    let of_faces = |tokens: &[Token]| match tokens {
        [word, _, length, ..] => word.text == "nonuniform" && length.text.parse() != Ok(cells),
        _ => false,
    };
    let listed = |patch: &Dictionary| {
        patch.keys().any(|key| match patch.get_any(&key.text) {
            Some(Entry::Value(tokens)) => of_faces(tokens),
            _ => false,
        })
    };
    boundary
        .keys()
        .any(|key| matches!(boundary.get_any(&key.text), Some(Entry::Dictionary(patch)) if listed(patch)))
}

/// Means along one direction, in which neighbours are `stride` numbers apart, of `from` cells over `to` cells.
fn along(numbers: &[f64], stride: usize, from: usize, to: usize) -> Vec<f64> {
    let mut means = Vec::with_capacity(numbers.len() / from * to);
    for row in numbers.chunks_exact(stride * from) {
        for cell in 0..to {
            // Both meshes are counted in units of which the box has `from` times `to`
            let (low, high) = (cell * from, (cell + 1) * from);
            let overlapped = low / to..high.div_ceil(to);
            for number in 0..stride {
                let sum: f64 = overlapped
                    .clone()
                    .map(|own| {
                        let overlap = high.min((own + 1) * to) - low.max(own * to);
                        overlap as f64 * row[own * stride + number]
                    })
                    .sum();
                means.push(sum / from as f64);
            }
        }
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "FoamFile { version 2.0; format ascii; class volVectorField; object U; }
        internalField nonuniform List<vector> 6 ((1 0 0) (2 0 0) (6 0 0) (3 0 1) (4 0 1) (8 0 1));
        boundaryField { \".*\" { type zeroGradient; } }";

    #[test]
    fn cells_share_what_they_overlap() {
        assert_eq!(along(&[1.0, 2.0, 6.0], 1, 3, 1), [3.0]);
        assert_eq!(along(&[1.0, 2.0, 6.0], 1, 3, 2), [(2.0 + 2.0) / 3.0, (2.0 + 12.0) / 3.0]);
        assert_eq!(along(&[1.0, 2.0], 1, 2, 4), [1.0, 1.0, 2.0, 2.0]);
        assert_eq!(along(&[1.0, -1.0, 3.0, -3.0], 2, 2, 1), [2.0, -2.0]);
        // The sum over the box stays, whatever the numbers of cells
        let own: Vec<f64> = (0..25).map(|cell| f64::from(cell * cell)).collect();
        for to in 1..60 {
            let mean = along(&own, 1, 25, to).iter().sum::<f64>() / to as f64;
            assert!((mean - own.iter().sum::<f64>() / 25.0).abs() < 1e-9, "{to}");
        }
    }

    #[test]
    fn a_field_is_averaged_along_all_directions() {
        let dictionary = Dictionary::parse(Path::new("0/U"), FILE).unwrap();
        let list = dictionary.value("internalField").unwrap();
        let field = Field::read("U".to_string(), list, 6).unwrap();
        assert!(Field::read("U".to_string(), list, 5).is_none());
        let averages = Averages { own: [3, 2, 1], fields: vec![field] };
        let text = averages.entry("U", [1, 1, 1]);
        assert_eq!(text, "internalField nonuniform List<vector>\n1\n(\n(4e0 0e0 5e-1)\n);\n");
        let text = averages.entry("U", [1, 2, 1]);
        assert!(text.contains("(3e0 0e0 0e0)\n(5e0 0e0 1e0)"), "{text}");
        assert_eq!(averages.entry("T", [1, 1, 1]), "");
    }

    #[test]
    fn values_along_a_wall_are_left_to_openfoam() {
        let with = |condition: &str| {
            let text = FILE.replace("type zeroGradient;", condition);
            differs_along_walls(&Dictionary::parse(Path::new("0/U"), &text).unwrap(), 6)
        };
        assert!(!with("type fixedValue; value uniform (0 0 0);"));
        assert!(!with(
            "type cyclicSlip; value nonuniform List<vector> 6 ((1 0 0) (2 0 0) (6 0 0) (3 0 1) (4 0 1) (8 0 1));"
        ));
        assert!(with("type fixedValue; value nonuniform List<vector> 1 ((0 0 0));"));
    }
}
