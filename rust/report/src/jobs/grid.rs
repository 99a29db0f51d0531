//! Transfers the initial fields of the reference, which are on 100 x 30 cells, to other meshes: each cell gets the mean over
//! its area, so that coarse cells have the mean of the fine ones in them, and finer ones have copies.

use crate::ReportError;
use crate::jobs::job::{BOX, MESH, Part};
use msdd_dem_reference::solver::nonuniform;
use std::fmt::Write;
use std::path::Path;

/// A cell-centred field: for each cell, x index fastest, one number (scalar) or six (symmetric tensor).
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    pub values: Vec<Vec<f64>>,
}

impl Field {
    /// Reads `internalField nonuniform List<...>` of an OpenFOAM field on [`MESH`].
    ///
    /// # Errors
    /// [`ReportError::Read`] when the file is missing or has not exactly one value for each cell of that mesh.
    pub fn read(file: &Path) -> Result<Self, ReportError> {
        let text = crate::read_text(file)?;
        let wrong = |problem: String| ReportError::Read { file: file.to_path_buf(), problem };
        let values = nonuniform(&text).map_err(wrong)?;
        let cells = MESH[0] * MESH[1];
        if values.len() != cells {
            return Err(wrong(format!("{} values of internalField, allowed: {cells}", values.len())));
        }
        Ok(Self { values })
    }

    /// The field on another mesh, of `mesh` cells along x and y, in a part of the box: means over the area of each cell.
    pub fn on(&self, mesh: [usize; 2], part: Part) -> Self {
        let size = part.size();
        let weights = |axis: usize| -> Vec<Vec<(usize, f64)>> {
            (0..mesh[axis]).map(|k| shares(k, mesh[axis], size[axis] / BOX[axis], MESH[axis])).collect()
        };
        let (along_x, along_y) = (weights(0), weights(1));
        let mut values = Vec::with_capacity(mesh[0] * mesh[1]);
        for row in &along_y {
            for column in &along_x {
                let mut mean = vec![0.0; self.values[0].len()];
                for &(j, wy) in row {
                    for &(i, wx) in column {
                        let cell = &self.values[i + MESH[0] * j];
                        mean.iter_mut().zip(cell).for_each(|(m, v)| *m += wx * wy * v);
                    }
                }
                values.push(mean);
            }
        }
        Self { values }
    }

    /// The text of an OpenFOAM field file.
    pub fn to_text(&self, name: &str) -> String {
        let (class, list, dimensions) = match (self.values.first().map_or(1, Vec::len), name) {
            (1, _) => ("volScalarField", "scalar", "[0 0 0 0 0 0 0]"),
            (_, "conductivity") => ("volSymmTensorField", "symmTensor", "[1 1 -3 -1 0 0 0]"),
            _ => ("volSymmTensorField", "symmTensor", "[1 -1 -2 0 0 0 0]"),
        };
        let mut text = format!(
            "FoamFile {{ version 2.0; format ascii; class {class}; object {name}; }}\ndimensions {dimensions};\n\
             internalField nonuniform List<{list}>\n{}\n(\n",
            self.values.len()
        );
        for value in &self.values {
            let numbers: Vec<String> = value.iter().map(|v| format!("{v:.9e}")).collect();
            let line = numbers.join(" ");
            let _ = if value.len() == 1 { writeln!(text, "{line}") } else { writeln!(text, "({line})") };
        }
        text + ")\n;\nboundaryField\n{\n    #includeEtc \"caseDicts/setConstraintTypes\"\n    \".*\" { type zeroGradient; }\n}\n"
    }
}

/// Which of `fine` cells cover cell `k` of `coarse` ones over the first `fraction` of the axis, and their shares, which sum to 1.
fn shares(k: usize, coarse: usize, fraction: f64, fine: usize) -> Vec<(usize, f64)> {
    let width = fraction * fine as f64 / coarse as f64;
    let (low, high) = (k as f64 * width, (k + 1) as f64 * width);
    (0..fine)
        .map(|i| (i, (high.min(i as f64 + 1.0) - low.max(i as f64)).max(0.0) / width))
        .filter(|&(_, share)| share > 1e-12)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> Field {
        let cell = |k: usize| vec![(k % MESH[0]) as f64 + 0.5];
        Field { values: (0..MESH[0] * MESH[1]).map(cell).collect() }
    }

    #[test]
    fn coarse_cells_hold_the_mean_of_the_fine_ones() {
        let coarse = ramp().on([10, 3], Part::Whole);
        assert_eq!(coarse.values.len(), 30);
        assert!((coarse.values[0][0] - 5.0).abs() < 1e-12 && (coarse.values[29][0] - 95.0).abs() < 1e-12);
        // The cells of 7 x 8 do not coincide with edges of those of 100 x 30, but the mean must be the same.
        let odd = ramp().on([7, 8], Part::Whole);
        let mean = odd.values.iter().map(|v| v[0]).sum::<f64>() / 56.0;
        assert!((mean - 50.0).abs() < 1e-9, "{mean}");
    }

    #[test]
    fn fine_cells_hold_copies_and_a_half_the_left_part() {
        let fine = ramp().on([200, 60], Part::Whole);
        assert!((fine.values[0][0] - 0.5).abs() < 1e-12 && (fine.values[1][0] - 0.5).abs() < 1e-12);
        let half = ramp().on([50, 30], Part::Half);
        assert!((half.values[49][0] - 49.5).abs() < 1e-12);
    }

    #[test]
    fn a_field_is_read_as_written() {
        let field =
            Field { values: vec![vec![1.0, 2.0, 0.0, 3.0, 0.0, 0.0], vec![-4.0, 0.5, 0.0, 2.0, 0.0, 1.0]] };
        assert_eq!(nonuniform(&field.to_text("stress")).unwrap(), field.values);
        assert!(nonuniform("internalField uniform 1;").is_err());
    }
}
