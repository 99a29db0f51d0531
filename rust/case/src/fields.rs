//! Makes the text of the solver's initial fields in `0`.

use std::fmt::Write;

/// Kind of the values of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldKind {
    /// A number without unit.
    Ratio,
    /// A symmetric tensor \[Pa\], tension positive as everywhere in OpenFOAM.
    Stress,
    /// A symmetric tensor [W/(m K)].
    Conductivity,
}

impl FieldKind {
    /// OpenFOAM's words for the class of the field, the type of its values, and their dimensions.
    fn words(self) -> [&'static str; 3] {
        match self {
            Self::Ratio => ["volScalarField", "scalar", "[0 0 0 0 0 0 0]"],
            Self::Stress => ["volSymmTensorField", "symmTensor", "[1 -1 -2 0 0 0 0]"],
            Self::Conductivity => ["volSymmTensorField", "symmTensor", "[1 1 -3 -1 0 0 0]"],
        }
    }
}

/// Boundary conditions of a field that needs none: a wall has the value of the cell next to it.
const NO_WALLS: &str = "boundaryField\n{\n    #includeEtc \"caseDicts/setConstraintTypes\"\n    \".*\"\n    {\n        \
                        type    zeroGradient;\n    }\n}\n";

/// A field with a value for each cell, in the order of the mesh's cells; `note` says where the values come from.
pub fn list(name: &str, kind: FieldKind, note: &str, lines: impl ExactSizeIterator<Item = String>) -> String {
    let [class, values, dimensions] = kind.words();
    let mut text = format!(
        "{}// {note}\n\ndimensions      {dimensions};\ninternalField   nonuniform List<{values}>\n{}\n(\n",
        head(class, name),
        lines.len()
    );
    for line in lines {
        let _ = writeln!(text, "{line}");
    }
    text + ");\n" + NO_WALLS
}

/// A field with one value for all cells; `note` may have several lines.
pub fn uniform(name: &str, kind: FieldKind, note: &str, value: &str) -> String {
    let [class, _, dimensions] = kind.words();
    let note: String = note.lines().map(|line| format!("// {line}\n")).collect();
    format!(
        "{}{note}\ndimensions      {dimensions};\ninternalField   uniform {value};\n{NO_WALLS}",
        head(class, name)
    )
}

/// The head that every file of OpenFOAM has.
pub fn head(class: &str, object: &str) -> String {
    format!(
        "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {class};\n    object      {object};\n}}\n\n"
    )
}
