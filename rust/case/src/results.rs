//! Times and fields that a run has written.

use crate::{CaseError, binary};
use msdd_files::list;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Values of one kind, one row for each cell or face, or one for all of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values {
    /// Numbers in a row: 1, 3, 6 or 9.
    pub width: usize,
    pub uniform: bool,
    pub numbers: Vec<f64>,
}

impl Values {
    /// The row of a cell or face.
    pub fn row(&self, index: usize) -> &[f64] {
        let first = if self.uniform { 0 } else { self.width * index };
        self.numbers.get(first..first + self.width).unwrap_or_default()
    }
}

/// A field: in the cells, and on the patches that have values of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    pub file: PathBuf,
    pub cells: Values,
    pub patches: BTreeMap<String, Values>,
}

/// Names of the time folders with a field `T`, of a region if `region` is not empty, in the order of time.
///
/// # Errors
/// [`CaseError::File`], if the folder cannot be read.
pub fn times(case: &Path, region: &str) -> Result<Vec<(f64, String)>, CaseError> {
    let time = |path: &PathBuf| {
        let name = path.file_name()?.to_str()?.to_string();
        let there = present(&path.join(region).join("T"));
        Some((name.parse::<f64>().ok().filter(|time| time.is_finite() && there)?, name))
    };
    let mut times: Vec<(f64, String)> = list(case)?.iter().filter_map(time).collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(times)
}

/// Names of the regions with a mesh, in the order of the alphabet; the mesh without a name, which comes first, has an empty one.
///
/// # Errors
/// [`CaseError::File`], if `constant` cannot be read.
pub fn regions(case: &Path) -> Result<Vec<String>, CaseError> {
    let has_mesh = |folder: &Path| present(&folder.join("polyMesh/points"));
    let constant = case.join("constant");
    let mut names: Vec<String> = list(&constant)?
        .into_iter()
        .filter(|path| has_mesh(path))
        .filter_map(|path| Some(path.file_name()?.to_str()?.to_string()))
        .collect();
    if has_mesh(&constant) {
        names.push(String::new());
    }
    names.sort();
    Ok(names)
}

/// Whether a file is there, or a packed one.
pub fn present(file: &Path) -> bool {
    file.is_file() || file.with_file_name(format!("{}.gz", name(file))).is_file()
}

fn name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

const KINDS: &str = "allowed: a field of scalars, vectors, symmetric tensors or tensors in cells";

impl Field {
    /// Reads a field, in text or binary, also a packed one. None if there is no such file, or if the file of a start
    /// takes its values from elsewhere (`#include`, `$name`). `cells`: number of cells of the mesh.
    ///
    /// # Errors
    /// [`CaseError::Read`] for a file of another form, [`CaseError::Key`] for a field of another size.
    pub fn read(file: &Path, cells: usize) -> Result<Option<Self>, CaseError> {
        if !present(file) {
            return Ok(None);
        }
        let failed =
            |problem: &str| CaseError::Read { file: file.to_path_buf(), problem: problem.to_string() };
        let bytes = binary::read(file).ok_or_else(|| failed("it cannot be read"))?;
        let text = match binary::text_of(file) {
            Some(text) => text,
            None => {
                String::from_utf8(bytes).map_err(|_| failed("neither text nor a binary list of numbers"))?
            }
        };
        let width = match text.split_once("class").map_or("", |(_, rest)| rest.trim_start()) {
            kind if kind.starts_with("volScalar") => 1,
            kind if kind.starts_with("volVector") => 3,
            kind if kind.starts_with("volSymmTensor") => 6,
            kind if kind.starts_with("volTensor") => 9,
            _ => return Err(failed(KINDS)),
        };
        let Some((_, rest)) = text.split_once("internalField") else {
            return if text.contains('#') { Ok(None) } else { Err(failed("there is no internalField")) };
        };
        let (inside, rest) = rest.split_once(';').ok_or_else(|| failed("internalField has no end"))?;
        if inside.contains(['#', '$']) {
            return Ok(None);
        }
        let values = values(inside, width).map_err(|problem| failed(&problem))?;
        if !values.uniform && values.numbers.len() != cells * width {
            return Err(CaseError::Key {
                file: file.to_path_buf(),
                key: "internalField".to_string(),
                value: format!("{} values", values.numbers.len() / width),
                allowed: format!("{cells}, one for each cell of the mesh"),
            });
        }
        Ok(Some(Self { file: file.to_path_buf(), cells: values, patches: patches(rest, width) }))
    }
}

/// `uniform 1`, `nonuniform List<scalar> 2 (1 2)`, or `nonuniform List<scalar> 2{1}`.
fn values(text: &str, width: usize) -> Result<Values, String> {
    let text = text.trim();
    let (uniform, list) = match text.strip_prefix("uniform") {
        Some(rest) => (true, rest),
        None => {
            let rest = text.strip_prefix("nonuniform").ok_or("neither uniform nor nonuniform")?;
            let open = rest.find(['(', '{']).unwrap_or(rest.len());
            (rest[open..].starts_with('{'), &rest[open..])
        }
    };
    let words = list.split(|c: char| c.is_whitespace() || "(){}".contains(c)).filter(|word| !word.is_empty());
    let number = |word: &str| word.parse::<f64>().map_err(|_| format!("'{word}' is no number"));
    let numbers: Vec<f64> = words.map(number).collect::<Result<_, _>>()?;
    if (uniform && numbers.len() != width) || !numbers.len().is_multiple_of(width) {
        return Err(format!("{} numbers, allowed: {width} in a row", numbers.len()));
    }
    Ok(Values { width, uniform, numbers })
}

/// The entries `value` of the patches in the text after `internalField`. What cannot be read has none.
fn patches(text: &str, width: usize) -> BTreeMap<String, Values> {
    let body = text.split_once('{').map_or("", |(_, body)| body);
    let (mut found, mut name, mut depth) = (BTreeMap::new(), String::new(), 0);
    for entry in body.split_inclusive(['{', '}', ';']) {
        let words = entry.trim();
        match words.chars().last() {
            // A list of equal values has braces, too
            Some('{') if depth == 0 => (name, depth) = (words.trim_end_matches('{').trim().to_string(), 1),
            Some('{') => depth += 1,
            Some('}') => depth -= 1,
            _ => {
                let value = words.trim_end_matches(';').trim().strip_prefix("value");
                if let Some(values) = value.filter(|_| depth == 1).and_then(|value| values(value, width).ok())
                {
                    found.insert(name.clone(), values);
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, cells: usize) -> Result<Option<Field>, String> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("T");
        std::fs::write(&file, text).unwrap();
        Field::read(&file, cells).map_err(|error| error.to_string())
    }

    #[test]
    fn fields_of_all_forms() {
        let head = |class: &str| format!("FoamFile {{ format ascii; class {class}; object T; }}\n");
        let text = head("volScalarField")
            + "dimensions [0 0 0 1 0 0 0];\ninternalField nonuniform List<scalar> \n2\n(\n300\n4.5e2\n)\n;\nboundaryField {\n\
               left { type fixedValue; value uniform 7; }\n right { type mixed; table { value uniform 1; } value nonuniform List<scalar> 2(1 2); }\n \
               sides { type empty; } }\n";
        let field = read(&text, 2).unwrap().unwrap();
        assert_eq!(
            (field.cells.row(1), field.patches["left"].row(5), field.patches["right"].row(1)),
            (&[450.0][..], &[7.0][..], &[2.0][..])
        );
        assert_eq!(field.patches.len(), 2);
        let error = read(&text, 3).unwrap_err();
        assert!(
            error.contains("internalField = 2 values, allowed: 3, one for each cell of the mesh"),
            "{error}"
        );
        let text = head("volSymmTensorField") + "internalField uniform (1 2 3 4 5 6);\n";
        assert_eq!(read(&text, 9).unwrap().unwrap().cells.row(8), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let text = head("volScalarField") + "internalField nonuniform List<scalar> 4{300};\n";
        assert!(read(&text, 4).unwrap().unwrap().cells.uniform);
        assert!(
            read(&(head("volScalarField") + "internalField uniform hot;\n"), 1)
                .unwrap_err()
                .contains("'hot' is no number")
        );
        assert!(read(&head("dictionary"), 1).unwrap_err().contains("allowed: a field of scalars"));
        assert_eq!(read(&(head("volScalarField") + "internalField uniform $hot;\n"), 1).unwrap(), None);
        assert_eq!(read(&(head("volScalarField") + "#include \"common\"\n"), 1).unwrap(), None);
        assert_eq!(Field::read(Path::new("/nowhere/T"), 1).unwrap(), None);
    }
}
