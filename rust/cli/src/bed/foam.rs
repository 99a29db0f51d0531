//! `msdd bed case`: the bed of a `bed.toml` as a case folder of the solver.

use super::geometry::{Geometry, INSULATED};
use crate::case::checkout;
use crate::error::CliError;
use clap::Args;
use msdd_beds::case::{BedCase, FRICTION, file_in};
use msdd_beds::schedule::Schedule;
use msdd_beds::sizes::MAX_SPREAD;
use msdd_case::fields::{FieldKind, head};
use msdd_case::folder::{self, File, check_folder};
use msdd_case::numbers::{plain, rounded};
use msdd_case::spheres::wall::{self, WallMaterial};
use msdd_case::values::{property_text, when};
use msdd_training::dem_start::FirstRow;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Share of the largest change of temperature that a time step may be wrong by.
const TOLERANCE: f64 = 2e-3;
/// Frictions of the spheres that the law, trained with [`FRICTION`], was compared with; the key `friction` of the solver has it, too.
const FRICTIONS: [f64; 2] = [0.1, 0.5];
/// Of a wall whose surface has one temperature [W/(m K)].
const ANY_CONDUCTIVITY: f64 = 1e12;
/// Slack of the spheres at a plate: about the mean of the poured beds, see `msdd bed slack`.
const GIVE: &str = "slackLayer 1; slackRecovery 0.1;";

#[derive(Args)]
#[command(after_help = "Examples:
  msdd bed run cases/column --out here           DEM: a quarter of an hour
  msdd bed case cases/column bed --from here/dem.csv
  bed/Allrun                                     the same bed by the solver: a second

The solver's bed starts from the state of DEM: porosity, stress, contacts per sphere, mobilised friction
and fabric. A bed between plates becomes a column of cells, a cylinder a wedge. The mesh ends where the centres of the first layer
are, because a heated wall of DEM holds these, and a sixth of a diameter further in at a heated floor; where heat
goes along the axis to a plate that is not heated, an eighth of a diameter before that, as before a wall that resists.")]
pub struct Arguments {
    /// Folder with bed.toml.
    case: PathBuf,
    /// The new case folder; it must not exist yet, or be empty.
    folder: PathBuf,
    /// Results of DEM, whose first row is the start. Default: dem.csv next to bed.toml.
    #[arg(long, value_name = "FILE")]
    from: Option<PathBuf>,
    /// Write into a folder that is not empty: files of the same name are replaced, all others stay.
    #[arg(long)]
    force: bool,
    /// MSDD's checkout, whose solver the case will run. Default: the one that this program was built in.
    #[arg(long, value_name = "DIR")]
    checkout: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let whole = check_folder(&arguments.folder, arguments.force)?;
    let checkout = checkout(arguments.checkout.as_deref())?;
    let scene = BedCase::read(&arguments.case)?;
    let from = arguments.from.clone().unwrap_or_else(|| arguments.case.join("dem.csv"));
    let start = FirstRow::read(&from)?;
    let name = whole.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let files = files(&arguments.case, &scene, &start, &name, &checkout)?;
    folder::write(&arguments.folder, &files)?;
    for note in notes(&scene) {
        outln!("Note: {note}");
    }
    outln!("written: {}", arguments.folder.display());
    outln!("Run it with {}/Allrun; {0}/README.md says what is where.", arguments.folder.display());
    Ok(())
}

/// What the solver's case leaves out.
fn notes(scene: &BedCase) -> Vec<String> {
    let grains = (scene.grains.friction != FRICTION).then(|| {
        format!(
            "spheres have a friction of {}; the law of spheres was trained with {FRICTION} and compared from {} to {}",
            scene.grains.friction, FRICTIONS[0], FRICTIONS[1]
        )
    });
    let sides =
        scene.sides.is_some().then(|| "the base is strained; in the solver's case it stays".to_string());
    grains.into_iter().chain(sides).collect()
}

/// The files of the case.
///
/// # Errors
/// Those of [`Geometry::new`].
pub fn files(
    folder: &Path,
    scene: &BedCase,
    start: &FirstRow,
    name: &str,
    checkout: &Path,
) -> Result<Vec<File>, CliError> {
    let compared = |wrong: String| {
        let file = file_in(folder);
        let text = format!("{}: grains.{wrong}, for which the law of spheres was compared", file.display());
        Err(CliError::Message(text))
    };
    let (spread, friction, [low, high]) = (scene.grains.moments().spread, scene.grains.friction, FRICTIONS);
    if spread > MAX_SPREAD {
        return compared(format!(
            "sizes: the spread of the diameters is {spread:.3} of their mean, by surface, allowed: up to {MAX_SPREAD}"
        ));
    }
    if !(low..=high).contains(&friction) {
        return compared(format!("friction = {friction}, allowed: {low} to {high}"));
    }
    let geometry = Geometry::new(&file_in(folder), scene, start.depth)?;
    let porosity = geometry.porosity(start);
    let origin = format!("From DEM at the start: {}: written by 'msdd bed case'", start.file.display());
    let stress = geometry.tensor(start.stress.map(|stress| -stress));
    let text = |path: &'static str, text: String| File { path, text, program: false };
    let dictionary = |path, body: String| File::foam(path, "dictionary", &body);
    let porosity_note = format!("1 - volume of the spheres over the volume\n{origin}");
    let stress_note = format!("Initial stress (xx xy xz yy yz zz) [Pa], tension positive\n{origin}");
    let gravity = format!(
        "dimensions      [0 1 -2 0 0 0 0];\nvalue           {};\n",
        geometry.along(-scene.container.gravity)
    );
    let [low, high] = scene.temperatures();
    let tolerance = TOLERANCE * (high - low).max(1e-6);
    let mut files = folder::programs(name, checkout, tolerance, scene.grains.number, false);
    files.extend([
        text("README.md", readme(scene, start, name)),
        text("0/T", temperature(scene)),
        File::field("0/porosity", FieldKind::Ratio, &porosity_note, &plain(porosity)),
        File::field("0/fabricIndex", FieldKind::Ratio, "Not used with spheres", "0"),
        File::field("0/stress", FieldKind::Stress, &stress_note, &stress),
        File::foam("constant/g", "uniformDimensionedVectorField", &gravity),
        dictionary("constant/granularProperties", properties(scene, start, &geometry)),
        dictionary("system/controlDict", control(scene, &geometry)),
        dictionary("system/blockMeshDict", geometry.mesh()),
        dictionary("system/decomposeParDict", geometry.parts()),
    ]);
    if let Some(source) = scene.heat_source {
        files.push(dictionary("constant/fvOptions", folder::heat_source(source * (1.0 - porosity))));
    }
    Ok(files)
}

fn table(schedule: &Schedule, value: impl Fn(f64) -> String) -> String {
    match schedule {
        Schedule::Constant(constant) => format!("constant {}", value(*constant)),
        Schedule::Table(rows) => {
            let rows: Vec<String> =
                rows.iter().map(|[time, of]| format!("({} {})", plain(*time), value(*of))).collect();
            format!("table ({})", rows.join(" "))
        }
    }
}

fn temperature(scene: &BedCase) -> String {
    let start = plain(scene.time.initial_temperature);
    let mut walls = "    #includeEtc \"caseDicts/setConstraintTypes\"\n    \".*\"\n    {\n        type            zeroGradient;\n    }\n".to_string();
    for heated in &scene.heated {
        let (kind, key) = match heated.resists {
            true => ("granularWall", "temperature    "),
            false => ("uniformFixedValue", "uniformValue   "),
        };
        let _ = writeln!(
            walls,
            "    {}\n    {{\n        type            {kind};\n        {key} {};\n        value           uniform {start};\n    }}",
            heated.wall,
            heated.temperature.as_ref().map_or(String::new(), |temperature| table(temperature, plain))
        );
    }
    format!(
        "{}dimensions      [0 0 0 1 0 0 0];\ninternalField   uniform {start};\nboundaryField\n{{\n{walls}}}\n",
        head("volScalarField", "T")
    )
}

fn properties(scene: &BedCase, start: &FirstRow, geometry: &Geometry) -> String {
    let grains = &scene.grains;
    let fabric = geometry.tensor(start.fabric);
    let emissivity = grains.emissivity.as_ref().map_or(String::new(), |emissivity| {
        format!("        emissivity      {};\n", property_text(emissivity))
    });
    let hardness = grains.hardness.unwrap_or(1e9);
    let surface = WallMaterial {
        name: "of one temperature",
        thermal_conductivity: ANY_CONDUCTIVITY,
        young_modulus: grains.young_modulus,
        poisson_ratio: grains.poisson_ratio,
        hardness,
    };
    let resists = scene.heated.iter().any(|heated| heated.resists);
    let surface = when(resists, || surface.entry(grains.roughness.unwrap_or(0.0), hardness, INSULATED));
    let spread = grains.sizes.as_ref().map_or(String::new(), |_| {
        format!("        sizeSpread      {};\n", plain(rounded(grains.moments().spread, 4)))
    });
    let own_friction = when(grains.friction != FRICTION, || {
        format!("        friction        {};\n", plain(grains.friction))
    });
    let mut text = format!(
        "// The law of spheres, and what the bed is like at the start\n\
         surrogate\n{{\n    type            spheres;\n    spheresCoeffs\n    {{\n\
         \x20       poissonRatio    {};\n        roughness       {};\n        hardness        {};\n\
         {emissivity}{spread}{own_friction}{surface}\x20       gas             {};\n        gasPressure     {};\n        accommodation   {};\n\
         \x20       coordination    {};\n        mobilised       {};\n        fabric          {fabric};\n    }}\n}}\n\n\
         density             {};\nyoungModulus        {};\nthermalConductivity {};\nheatCapacity        {};\n\
         thermalExpansion    {};\nmeanRadius          {};\n\nmechanics           equilibrium;\n\nequilibriumCoeffs\n{{\n    walls\n    {{\n",
        plain(grains.poisson_ratio),
        plain(grains.roughness.unwrap_or(0.0)),
        plain(hardness),
        scene.gas.name,
        plain(scene.gas.pressure),
        plain(scene.gas.accommodation),
        plain(start.coordination),
        plain(start.mobilised),
        plain(grains.density),
        plain(grains.young_modulus),
        property_text(&grains.conductivity),
        property_text(&grains.heat_capacity),
        plain(grains.thermal_expansion.unwrap_or(0.0)),
        plain(0.5 * grains.diameter),
    );
    let sphere = [grains.diameter, grains.young_modulus];
    let rigid = wall::entry(grains.wall_friction, sphere);
    let friction = wall::friction(grains.wall_friction, sphere);
    let at_side = wall::widened_friction(grains.wall_friction, sphere, geometry.widening);
    let lid = match scene.lid_moves() {
        (Some(strain), _) => {
            let moved = table(strain, |strain| geometry.along(-strain * geometry.depth()));
            format!("{rigid} {GIVE} displacement {moved};")
        }
        (None, Some(pressing)) => {
            let pressure = table(pressing, |pressure| plain(pressure * geometry.widening.powi(2)));
            format!("type piston; pressure {pressure};{friction}")
        }
        (None, None) => format!("{rigid} {GIVE}"),
    };
    // Under a lid that keeps its pressure it changes no stress.
    let floor = if scene.lid_moves().1.is_some() { "" } else { GIVE };
    let side = match &scene.shell {
        Some(shell) => {
            let radius = geometry.radii.map_or(0.0, |radii| radii[2]);
            let expansion = wall::expansion(
                shell.thermal_expansion,
                scene.time.initial_temperature,
                grains.wall_friction,
            );
            format!(
                "type shell; youngModulus {}; thickness {}; radius {};{expansion}{at_side}",
                plain(shell.young_modulus),
                plain(shell.thickness / geometry.widening),
                plain(radius)
            )
        }
        None if geometry.endless => "type symmetry;".to_string(),
        None if grains.wall_friction > 0.0 => format!("type rigid;{at_side}"),
        None => rigid.clone(),
    };
    if geometry.radii.is_some() {
        text += "        inner { type frictionless; }\n";
    }
    let _ = write!(
        text,
        "        floor {{ {rigid} {floor} }}\n        lid {{ {lid} }}\n        side {{ {side} }}\n    }}\n}}\n"
    );
    text
}

/// Where temperatures are recorded.
pub fn probes(scene: &BedCase, geometry: &Geometry) -> Vec<[f64; 3]> {
    let record = &scene.record;
    let middle = 0.5 * (record.heights[0] + record.heights[1]);
    let at = |&distance: &f64| match record.wall.as_str() {
        "side" => geometry.point(middle, scene.container.radius.unwrap_or(0.0) - distance),
        "lid" => geometry.point(geometry.plates - distance, 0.5 * record.radius.unwrap_or(0.0)),
        _ => geometry.point(distance, 0.5 * record.radius.unwrap_or(0.0)),
    };
    record.distances.iter().map(at).collect()
}

fn control(scene: &BedCase, geometry: &Geometry) -> String {
    let places: Vec<String> = probes(scene, geometry)
        .iter()
        .map(|[x, y, z]| format!("({} {} {})", plain(*x), plain(*y), plain(*z)))
        .collect();
    let time = &scene.time;
    let libraries = match scene.heated.iter().any(|heated| heated.resists) {
        true => "// With granularWall of 0/T\nlibs            (\"libgranularThermo.so\");\n",
        false => "",
    };
    format!(
        "{libraries}application     msddFoam;\nstartFrom       latestTime;\nstartTime       0;\nstopAt          endTime;\nendTime         {};\n\
         deltaT          {};\n\nadjustTimeStep  yes;\nmaxDeltaT       {};\nwriteControl    runTime;\nwriteInterval   {};\n\
         writePrecision  17;\ntimePrecision   8;\nrunTimeModifiable no;\n\nfunctions\n{{\n\
         \x20   // Temperature where DEM records it\n    probes\n    {{\n        type            probes;\n\
         \x20       libs            (\"libsampling.so\");\n        fields          (T);\n        probeLocations  ({});\n\
         \x20       interpolationScheme cellPoint;\n        writeControl    writeTime;\n    }}\n\n\
         \x20   // Means where they take theirs\n    bulk\n    {{\n        type            volFieldValue;\n\
         \x20       libs            (\"libfieldFunctionObjects.so\");\n        regionType      cellZone;\n        name            bulk;\n\
         \x20       operation       volAverage;\n        fields          (stress conductivity);\n        writeFields     no;\n\
         \x20       writeControl    writeTime;\n    }}\n\n\
         \x20   wallPressure\n    {{\n        type            wallPressure;\n        libs            (\"libgranularFunctionObjects.so\");\n\
         \x20       writeControl    writeTime;\n    }}\n}}\n",
        plain(time.end),
        plain(0.25 * time.interval),
        plain(time.output_every),
        plain(time.output_every),
        places.join(" "),
    )
}

fn readme(scene: &BedCase, start: &FirstRow, name: &str) -> String {
    format!(
        "# Case {name}\n\nA bed of {} spheres of {} m as the solver sees it, written by `msdd bed case`. `./Allrun` runs it, `./Allclean` removes the results.\n\n\
         It starts as DEM of `{}` do. Temperatures where these record them go to `postProcessing/probes/0/T`, means of stress and conductivity where they take theirs to `postProcessing/bulk`, pressures on the walls to `postProcessing/wallPressure`.\n\
         Keys: the book's pages on constant/granularProperties and system.\n",
        scene.grains.number,
        plain(scene.grains.diameter),
        start.file.display(),
    )
}
