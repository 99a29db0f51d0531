//! Thermal boundary conditions of the walls over time, from the patches of `0/T`.

use crate::CaseError;
use crate::dictionary::{Dictionary, Entry, Token, joined};
use crate::functions::schedule;
use msdd_beds::schedule::Schedule;
use msdd_dem::{Side, WallHeat};

/// Names of the four walls in the mesh, in the order of [`Side`].
const PATCHES: [&str; 4] = ["left", "right", "bottom", "top"];
const EACH: &str = "a dictionary for each of left, right, bottom, top";
/// Patch types that say something about the mesh and not about heat. The standard include of OpenFOAM lists all of them,
/// whether a patch has this type or not.
const CONSTRAINTS: &str = "empty cyclic cyclicAMI cyclicACMI cyclicSlip nonuniformTransformCyclic processor processorCyclic \
                           symmetry symmetryPlane wedge overset";

pub(crate) fn is_constraint(kind: &str) -> bool {
    CONSTRAINTS.split(' ').any(|known| known == kind)
}

/// Thermal boundary condition of a wall.
#[derive(Clone, Debug, PartialEq)]
pub enum WallOverTime {
    Steady(WallHeat),
    /// Times \[s\], rising from 0, and temperatures \[K\]: linear between two rows, constant after the last.
    Table(Vec<[f64; 2]>),
    /// A heat transfer coefficient \[W/(m² K)\] to the outside of this temperature \[K\].
    Coefficient {
        coefficient: f64,
        outside: f64,
    },
    /// A heat flux into the bed \[W/m²\].
    Flux(f64),
}

impl WallOverTime {
    /// Makes a table from rows of time \[s\] and temperature \[K\]; `None` unless there are at least two rows with finite numbers,
    /// and their times rise from 0.
    pub fn table(rows: Vec<[f64; 2]>) -> Option<Self> {
        let finite = rows.iter().flatten().all(|number: &f64| number.is_finite());
        let rising = rows.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        (rows.len() > 1 && rows[0][0] == 0.0 && finite && rising).then_some(Self::Table(rows))
    }

    /// Temperatures over time of the wall, or outside of it \[K\]; empty when there is none.
    pub fn temperatures(&self) -> Vec<f64> {
        match self {
            Self::Steady(WallHeat::Temperature(value)) | Self::Coefficient { outside: value, .. } => {
                vec![*value]
            }
            Self::Steady(_) | Self::Flux(_) => Vec::new(),
            Self::Table(rows) => rows.iter().map(|row| row[1]).collect(),
        }
    }

    /// Whether heat passes the wall.
    pub fn conducts(&self) -> bool {
        matches!(self, Self::Flux(_)) || !self.temperatures().is_empty()
    }

    /// The condition at `time` \[s\] for DEM; `None` for a coefficient or a flux, which they do not compute.
    pub fn at(&self, time: f64) -> Option<WallHeat> {
        match self {
            Self::Steady(heat) => Some(*heat),
            Self::Table(rows) => Some(WallHeat::Temperature(interpolated(rows, time))),
            Self::Coefficient { .. } | Self::Flux(_) => None,
        }
    }
}

/// Least and largest temperature of the start and of walls at any time \[K\].
pub fn temperatures(start: f64, walls: &[WallOverTime]) -> [f64; 2] {
    let all = walls.iter().flat_map(WallOverTime::temperatures);
    all.fold([start; 2], |[least, most], value| [least.min(value), most.max(value)])
}

fn interpolated(rows: &[[f64; 2]], time: f64) -> f64 {
    let next = rows.partition_point(|row| row[0] <= time).clamp(1, rows.len() - 1);
    let ([t0, from], [t1, to]) = (rows[next - 1], rows[next]);
    from + (to - from) * ((time - t0) / (t1 - t0)).clamp(0.0, 1.0)
}

/// The four walls of `0/T`, in the order of [`Side`].
///
/// # Errors
/// [`CaseError::Key`] for a patch, type or key that the reference does not know.
pub fn heat_of_walls(file: &Dictionary) -> Result<[WallOverTime; 4], CaseError> {
    let patches = file.dictionary_at("boundaryField")?;
    let stray = |key: &&Token| {
        let wall = PATCHES.iter().any(|name| if key.quoted { key.matches(name) } else { key.text == *name });
        let constraint = match patches.get(&key.text) {
            Some(Entry::Dictionary(patch)) => patch.text("type").is_ok_and(|kind| is_constraint(&kind)),
            _ => false,
        };
        !wall && !constraint
    };
    if let Some(key) = patches.keys().find(stray) {
        return Err(patches.refuse(&key.text, "{...}", "left, right, bottom, top, or a constraint type"));
    }
    let mut walls = [WallHeat::Insulated; 4].map(WallOverTime::Steady);
    for side in Side::ALL {
        let name = PATCHES[side as usize];
        walls[side as usize] = match patches.matching(name) {
            Some(Entry::Dictionary(patch)) => wall_heat(patch)?,
            _ => return Err(patches.refuse(name, "missing", EACH)),
        };
    }
    Ok(walls)
}

fn wall_heat(patch: &Dictionary) -> Result<WallOverTime, CaseError> {
    use WallOverTime::Steady;
    let kind = patch.text("type")?;
    match kind.as_str() {
        "fixedValue" => {
            patch.check_keys(&[&["type", "value"]])?;
            Ok(Steady(WallHeat::Temperature(patch.uniform("value")?)))
        }
        "uniformFixedValue" => {
            patch.check_keys(&[&["type", "uniformValue", "value"]])?;
            let tokens = patch.value("uniformValue")?;
            let table = match schedule(tokens, 1, |value| value[0]) {
                Some(Schedule::Table(rows)) => WallOverTime::table(rows),
                _ => None,
            };
            let allowed = "table ((time T) ...), times from 0 on, rising";
            table.ok_or_else(|| patch.refuse("uniformValue", &joined(tokens), allowed))
        }
        "zeroGradient" => {
            patch.check_keys(&[&["type", "value"]])?;
            Ok(Steady(WallHeat::Insulated))
        }
        "fixedGradient" => {
            patch.check_keys(&[&["type", "gradient", "value"]])?;
            match patch.uniform("gradient")? {
                0.0 => Ok(Steady(WallHeat::Insulated)),
                // The heat flux would be K times the gradient, and DEM has no K of the bed.
                other => Err(patch.refuse("gradient", &format!("uniform {other}"), "uniform 0")),
            }
        }
        _ => Err(patch.refuse("type", &kind, "fixedValue, uniformFixedValue, zeroGradient, fixedGradient")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn walls_of(patches: &str) -> Result<[WallOverTime; 4], String> {
        let text = format!("boundaryField {{ {patches} }}");
        let file = Dictionary::parse(Path::new("0/T"), &text).unwrap();
        heat_of_walls(&file).map_err(|error| error.to_string())
    }

    #[test]
    fn walls_are_those_of_patches_by_name_and_by_pattern_over_time() {
        let walls = walls_of(
            "empty { type empty; } \".*\" { type zeroGradient; } \"left|right\" { type fixedValue; value uniform 7; }
             right { type fixedGradient; gradient uniform 0; }
             top { type uniformFixedValue; uniformValue table ((0 50) (2 70) (4 30)); value uniform 50; }",
        )
        .unwrap();
        let at = |wall: usize, time| match walls[wall].at(time) {
            Some(WallHeat::Temperature(temperature)) => temperature,
            _ => 0.0,
        };
        let steady = [0, 1, 2].map(|wall| at(wall, 0.0));
        let over_time = [0.0, 1.0, 3.0, 9.0].map(|time| at(3, time));
        assert_eq!((steady, over_time), ([7.0, 0.0, 0.0], [50.0, 60.0, 50.0, 30.0]));
    }

    #[test]
    fn refuses_what_it_does_not_know() {
        let table = "{ type uniformFixedValue; uniformValue";
        for (left, message) in [
            ("left { type codedFixedValue; }", "/left/type = codedFixedValue, allowed: fixedValue"),
            (&format!("left {table} sine; }}"), "left/uniformValue = sine, allowed: table"),
            (&format!("left {table} table ((0 1) (0 2)); }}"), "allowed: table ((time T) ...)"),
            (&format!("left {table} table ((0 1)); }}"), "allowed: table ((time T) ...)"),
            ("left { type fixedValue; value nonuniform 3; }", "/left/value = nonuniform 3"),
            ("left { type fixedValue; value uniform 3; ramp 2; }", "/left/ramp = 2, allowed: the keys"),
            (
                "left { type fixedGradient; gradient uniform 5; }",
                "/left/gradient = uniform 5, allowed: uniform 0",
            ),
            ("leeft { type zeroGradient; }", "/leeft = {...}, allowed: left, right"),
            ("", "/left = missing"),
        ] {
            let error =
                walls_of(&format!("{left} \"right|bottom|top\" {{ type zeroGradient; }}")).unwrap_err();
            assert!(error.starts_with("0/T: boundaryField/le") && error.contains(message), "{error}");
        }
    }
}
