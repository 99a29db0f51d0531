//! Makes the case folder of a job: the shipped case, its mesh, the initial fields of a packing, the function objects that write
//! results, and the job's own keys.

use crate::jobs::grid::Field;
use crate::jobs::job::{Part, SolverJob};
use crate::{ReportError, read_text, write_text};
use std::path::Path;

/// Fields whose initial values are taken from the windows of a packing.
pub const FIELDS: [&str; 4] = ["porosity", "fabricIndex", "conductivity", "stress"];
/// Time between two values of a series [s], unless steps are longer.
const INTERVAL: f64 = 0.1;

/// Writes the case of `job` into `folder`.
///
/// # Errors
/// When files of the case cannot be read or written.
pub fn write_case(checkout: &Path, job: &SolverJob, folder: &Path) -> Result<(), ReportError> {
    let case = checkout.join("cases").join(&job.case);
    let shipped = job.part == Part::Shipped;
    for part in ["0", "constant", "system"] {
        for file in msdd_files::list(&case.join(part))? {
            // Folders (such as the mesh of an earlier run by hand) are not copied, nor are the fields, which are made below.
            let field = FIELDS.iter().any(|name| file.ends_with(format!("0/{name}")));
            if file.is_dir() || (field && !shipped) {
                continue;
            }
            let text = read_text(&file)?.replace("\"../../", &format!("\"{}/cases/", checkout.display()));
            let name = format!("{part}/{}", file.file_name().unwrap_or_default().to_string_lossy());
            let keys = job.append.get(&name).map_or("", String::as_str);
            write_text(&folder.join(&name), &format!("{text}\n{}{keys}", defaults(&name, job)))?;
        }
    }
    if shipped {
        return Ok(());
    }
    write_text(&folder.join("system/blockMeshDict"), &mesh(job))?;
    write_fields(checkout, job, folder)
}

/// Text that every job adds at the end of a file, before its own keys.
fn defaults(name: &str, job: &SolverJob) -> String {
    match name {
        "system/controlDict" => control(job),
        _ => String::new(),
    }
}

fn control(job: &SolverJob) -> String {
    let lean = job.slant.to_radians().tan();
    let point = |[x, y]: &[f64; 2]| format!("({} {y} 0.005)", x + lean * y);
    let points: Vec<String> = job.part.probes().iter().map(point).collect();
    let library = "libs (\"libgranularFunctionObjects.so\");";
    let series = format!("{library} writeControl runTime; writeInterval {INTERVAL};");
    let places = format!("field T; probeLocations ({});", points.join(" "));
    let probes = if job.part == Part::Shipped { "" } else { &places };
    let at_end = format!("{library} writeControl writeTime;");
    format!(
        "endTime {end};\nwriteInterval {end};\nfunctions\n{{\n\
         \x20   probes {{ enabled no; }}\n\
         \x20   spaceProbes {{ type spaceProbes; {probes} {series} }}\n\
         \x20   wallPressure {{ type wallPressure; {series} }}\n\
         \x20   subRegions {{ type subRegions; windows (10 3); {at_end} }}\n\
         \x20   columns {{ type subRegions; windows (10 1); {at_end} }}\n}}\n",
        end = job.end,
    )
}

/// blockMeshDict of the cases' box or a part of it. Walls have the names of `cases/common/blockMeshDict`; where the box is
/// cut, the patch is a plane of symmetry.
fn mesh(job: &SolverJob) -> String {
    let [width, height] = job.part.size();
    let [nx, ny] = job.mesh;
    let lean = height * job.slant.to_radians().tan();
    let leant = width + lean;
    let right = if job.part == Part::Whole { ("right", "wall") } else { ("middleX", "symmetryPlane") };
    let top = if job.part == Part::Quarter { ("middleY", "symmetryPlane") } else { ("top", "wall") };
    let patch =
        |(name, kind): (&str, &str), face: &str| format!("    {name} {{ type {kind}; faces (({face})); }}\n");
    format!(
        "FoamFile {{ version 2.0; format ascii; class dictionary; object blockMeshDict; }}\nscale 1;\n\
         vertices ((0 0 0) ({width} 0 0) ({leant} {height} 0) ({lean} {height} 0) (0 0 0.01) ({width} 0 0.01) \
         ({leant} {height} 0.01) ({lean} {height} 0.01));\n\
         blocks (hex (0 1 2 3 4 5 6 7) ({nx} {ny} 1) simpleGrading (1 1 1));\nboundary\n(\n{}{}{}{}\
         \x20   frontAndBack {{ type empty; faces ((0 3 2 1) (4 5 6 7)); }}\n);\n",
        patch(("left", "wall"), "0 4 7 3"),
        patch(right, "1 2 6 5"),
        patch(("bottom", "wall"), "0 1 5 4"),
        patch(top, "3 7 6 2"),
    )
}

fn write_fields(checkout: &Path, job: &SolverJob, folder: &Path) -> Result<(), ReportError> {
    let cells = job.mesh[0] * job.mesh[1];
    let keys = |name: &str| job.append.get(&format!("0/{name}")).map_or("", String::as_str);
    if let Some(values) = job.uniform {
        // The other two fields are left out: the solver then uses the model's mean for the given ones.
        for (name, value) in FIELDS.iter().zip(values) {
            let field = Field { values: vec![vec![value]; cells] };
            write_text(&folder.join("0").join(name), &(field.to_text(name) + keys(name)))?;
        }
        return Ok(());
    }
    let windows = checkout.join(format!("cases/reference/fields/seed{}", job.seed));
    for name in FIELDS {
        let field = Field::read(&windows.join(name))?.on(job.mesh, job.part);
        write_text(&folder.join("0").join(name), &(field.to_text(name) + keys(name)))?;
    }
    Ok(())
}

/// Commands, run in the case folder, that make the mesh and, if the job has a plug-in, compile it and name it in
/// MSDD_ALLOW_PLUGINS, because msddFoam loads no other plug-ins when it runs as root.
pub fn preparation(checkout: &Path, job: &SolverJob) -> String {
    let mut commands = "blockMesh > log.blockMesh 2>&1".to_string();
    if let Some(source) = &job.plugin {
        let checkout = checkout.display();
        commands += &format!(
            " && cc -std=c99 -O2 -shared -fPIC -I'{checkout}/rust/capi/include' '{checkout}/{source}' -lm -o plugin.so \
             && export MSDD_ALLOW_PLUGINS=\"$PWD/plugin.so\""
        );
    }
    commands
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkout() -> std::path::PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
    }

    #[test]
    fn a_case_has_its_mesh_fields_and_keys() {
        let folder = std::env::temp_dir().join(format!("msdd-report-setup-{}", std::process::id()));
        let mut job = SolverJob::new("HCstar", 2).grains("surrogate { model builtin:paper; }");
        job.mesh = [10, 3];
        write_case(&checkout(), &job, &folder).unwrap();
        let text = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(text("system/blockMeshDict").contains("(10 3 1)"));
        assert!(text("constant/granularProperties").ends_with("builtin:paper; }\n"));
        assert!(!text("0/T").contains("\"../../"));
        assert_eq!(msdd_dem_reference::solver::nonuniform(&text("0/porosity")).unwrap().len(), 30);
        assert!(text("system/controlDict").contains("deltaT 1e-2;"));
        std::fs::remove_dir_all(&folder).unwrap();
    }

    /// Jobs may run as root, where msddFoam loads a plug-in only if the environment names it.
    #[test]
    fn a_plugin_is_compiled_and_named() {
        let mut job = SolverJob::new("H", 1);
        assert_eq!(preparation(Path::new("/msdd"), &job), "blockMesh > log.blockMesh 2>&1");
        job.plugin = Some("a.c".to_string());
        let commands = preparation(Path::new("/msdd"), &job);
        let expected = "'/msdd/a.c' -lm -o plugin.so && export MSDD_ALLOW_PLUGINS=\"$PWD/plugin.so\"";
        assert!(commands.ends_with(expected), "{commands}");
    }

    #[test]
    fn a_quarter_ends_in_planes_of_symmetry() {
        let job = SolverJob { part: Part::Quarter, mesh: [50, 15], ..SolverJob::new("H", 1) };
        let text = mesh(&job);
        assert!(
            text.contains("middleX { type symmetryPlane") && text.contains("middleY { type symmetryPlane")
        );
        assert!(text.contains("(1.075 0 0)") && text.contains("0.3225 0)"));
    }
}
