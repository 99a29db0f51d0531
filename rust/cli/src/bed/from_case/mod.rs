//! `msdd bed from-case`: the bed of a case of the solver as a `bed.toml`.

mod read;
mod shape;
mod walls;

use crate::confirm::duration;
use crate::error::CliError;
use clap::Args;
use msdd_beds::case::{BedCase, FILE};
use msdd_beds::cost::estimate;
use msdd_files::{check_target, write};
use read::Reader;
use std::path::{Path, PathBuf};

#[derive(Args)]
#[command(after_help = "Examples:
  msdd case new results/store --yes --spheres --radius 0.03 --height 0.1 --side 320 --pressure 2e4
  msdd bed from-case results/store          writes results/store/bed.toml
  msdd bed run results/store
  msdd case new again --from results/store/bed.toml

The spheres fill the whole bed; the command says how many they are and how long 'msdd bed run' takes. A smaller bed of the same kind
is quicker: change number and base or radius in the file. What the file cannot express is left out and named, in the file as well.")]
pub struct Arguments {
    /// Case folder with spheres and a mesh of system/blockMeshDict, as `msdd case new --spheres` or `msdd bed case` write it.
    case: PathBuf,
    /// Folder for bed.toml. Default: the case folder.
    out: Option<PathBuf>,
    /// Replace a bed.toml that is there.
    #[arg(long)]
    force: bool,
}

/// Threads that the estimate of the time is for, those of `msdd bed run`.
const THREADS: usize = 2;

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let out = arguments.out.as_ref().unwrap_or(&arguments.case);
    let file = out.join(FILE);
    if file.exists() && !arguments.force {
        return Err(CliError::Message(format!(
            "{}: is there already, allowed: another folder, or --force",
            file.display()
        )));
    }
    check_target(&file)?;
    let mut reader = Reader::open(&arguments.case)?;
    let scene = reader.scene()?;
    let mut notes = reader.notes;
    notes.push(format!(
        "not in the case: restitution {}, young_modulus while the spheres are poured {} Pa, seed, steps; friction of the spheres {}, \
         that of the law of spheres",
        scene.grains.restitution, scene.grains.simulated_young_modulus, scene.grains.friction
    ));
    let size = match scene.checked(&file) {
        Ok(()) => format!(
            "{} spheres, about {} on {THREADS} threads",
            scene.grains.number,
            duration(estimate(&scene, THREADS).seconds)
        ),
        Err(problem) => {
            notes.push(format!("'msdd bed run' refuses this file until it is changed: {problem}"));
            format!("{} spheres", scene.grains.number)
        }
    };
    write(&file, text(&scene, &arguments.case, out, &size, &notes)?.as_bytes())?;
    notes.iter().for_each(|note| outln!("Note: {note}"));
    outln!("written: {}: {size}", file.display());
    outln!("Run it with: msdd bed run {}", out.display());
    Ok(())
}

/// The file, with its notes as comments.
fn text(scene: &BedCase, case: &Path, out: &Path, size: &str, notes: &[String]) -> Result<String, CliError> {
    let mut text = format!(
        "# The bed of the case {} by DEM, written by 'msdd bed from-case'. Run it with: msdd bed run {}\n\
         # {size}. Keys: the book, Measured beds. SI units, temperatures in K.\n",
        case.display(),
        out.display()
    );
    notes.iter().for_each(|note| text += &format!("# Note: {note}\n"));
    Ok(text + "\n" + &scene.text(&out.join(FILE))?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bed::foam;
    use msdd_beds::schedule::Schedule;
    use msdd_training::dem_start::FirstRow;

    fn near(found: f64, wanted: f64, tolerance: f64) {
        assert!((found / wanted - 1.0).abs() < tolerance, "{found} {wanted}");
    }

    /// The case of a shipped bed, read again. Needs OpenFOAM, because it reads the files through foamDictionary.
    fn there_and_back(bed: &str, results: &str, resists: bool) -> Option<(BedCase, BedCase)> {
        std::process::Command::new("foamDictionary").arg("-help").output().ok()?;
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases").join(bed);
        let mut scene = BedCase::read(&folder).unwrap();
        scene.heated.iter_mut().for_each(|heated| heated.resists = resists);
        let start = FirstRow::read(&folder.join(results)).unwrap();
        let files = foam::files(&folder, &scene, &start, "bed", Path::new("/checkout")).unwrap();
        let case = std::env::temp_dir().join(format!(
            "msdd-from-{}-{resists}-{}",
            bed.replace('/', "-"),
            std::process::id()
        ));
        msdd_case::folder::write(&case, &files).unwrap();
        let again = Reader::open(&case).unwrap().scene().unwrap();
        again.checked(&case.join(FILE)).unwrap();
        msdd_files::write(&case.join(FILE), again.text(&case).unwrap().as_bytes()).unwrap();
        assert_eq!(BedCase::read(&case).unwrap(), again);
        std::fs::remove_dir_all(&case).unwrap();
        Some((scene, again))
    }

    fn same(scene: &BedCase, again: &BedCase) {
        assert_eq!((&again.gas, &again.heated), (&scene.gas, &scene.heated));
        assert_eq!(again.container.gravity, scene.container.gravity);
        let (a, b) = (&again.grains, &scene.grains);
        assert_eq!(
            (a.number, a.diameter, a.density, a.young_modulus),
            (b.number, b.diameter, b.density, b.young_modulus)
        );
        assert_eq!((a.poisson_ratio, a.roughness, a.hardness), (b.poisson_ratio, b.roughness, b.hardness));
        assert_eq!(
            (&a.conductivity, &a.heat_capacity, a.thermal_expansion),
            (&b.conductivity, &b.heat_capacity, b.thermal_expansion)
        );
        let (a, b) = (&again.time, &scene.time);
        assert_eq!(
            (a.initial_temperature, a.end, a.output_every),
            (b.initial_temperature, b.end, b.output_every)
        );
        let (a, b) = (&again.record, &scene.record);
        assert_eq!((&a.wall, a.distances.len()), (&b.wall, b.distances.len()));
        a.distances.iter().zip(&b.distances).for_each(|(a, b)| near(*a, *b, 1e-6));
        (0..2).for_each(|k| near(a.heights[k], b.heights[k], 1e-9));
    }

    #[test]
    fn a_column_becomes_the_bed_that_it_was_made_of() {
        let Some((scene, again)) = there_and_back("column", "dem.csv", false) else { return };
        same(&scene, &again);
        assert!(again.container.endless && again.lid_moves().1.is_none());
        (0..2).for_each(|k| near(again.container.base.unwrap()[k], scene.container.base.unwrap()[k], 0.05));
        near(again.pressure(), scene.pressure(), 0.15);
        let (Some(Schedule::Table(a)), Some(Schedule::Table(b))) = (again.lid_moves().0, scene.lid_moves().0)
        else {
            panic!("no paths")
        };
        assert!(a.iter().zip(b).all(|(a, b)| a[0] == b[0] && (a[1] - b[1]).abs() < 1e-8), "{a:?}");
    }

    #[test]
    fn a_wedge_becomes_the_cylinder_that_it_was_made_of() {
        for resists in [false, true] {
            let Some((scene, again)) = there_and_back("beds/round-shell", "dem-1.csv", resists) else {
                return;
            };
            same(&scene, &again);
            near(again.container.radius.unwrap(), scene.container.radius.unwrap(), 1e-6);
            near(again.record.radius.unwrap(), scene.record.radius.unwrap(), 1e-6);
            near(again.pressure(), scene.pressure(), 1e-6);
            near(again.lid_moves().1.unwrap().at(0.0), 2e4, 1e-6);
            let (a, b) = (again.shell.unwrap(), scene.shell.unwrap());
            near(a.thickness, b.thickness, 1e-6);
            assert_eq!((a.young_modulus, a.thermal_expansion), (b.young_modulus, b.thermal_expansion));
        }
        let Some((scene, again)) = there_and_back("beds/friction-round", "dem-1.csv", false) else { return };
        near(again.grains.wall_friction, scene.grains.wall_friction, 0.03);
    }
}
