//! `msdd bed case`: the bed of an `elements.toml` as a case folder of the solver.

use super::start::Start;
use crate::case::checkout;
use crate::error::CliError;
use clap::Args;
use msdd_beds::property::Property;
use msdd_beds::scene::{FILE, Scene};
use msdd_beds::schedule::Schedule;
use msdd_case::fields::{FieldKind, head, uniform};
use msdd_case::folder::{self, File, check_folder};
use msdd_case::numbers::plain;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Cells along a direction in which heat flows, and half of the angle of the wedge of a cylinder [rad].
const CELLS: f64 = 40.0;
const HALF_ANGLE: f64 = 2.5 * std::f64::consts::PI / 180.0;
/// Where the mesh of a cylinder ends before the axis, over its radius, and the width of the column of a box, in diameters.
const INNER: f64 = 0.008;
const WIDTH: f64 = 3.0;
/// Share of the largest change of temperature that a time step may be wrong by.
const TOLERANCE: f64 = 2e-3;

#[derive(Args)]
#[command(after_help = "Examples:
  msdd bed run cases/column --out here           discrete elements: a quarter of an hour
  msdd bed case cases/column bed --from here/elements.csv
  bed/Allrun                                     the same bed by the solver: a second

The solver's bed starts from what the discrete elements are at the start: porosity, stress, contacts per sphere, mobilised friction
and fabric. A bed between plates becomes a column of cells, a cylinder a wedge. The mesh ends where the centres of the first layers
are, because a heated wall of the discrete elements holds these.")]
pub struct Arguments {
    /// Folder with elements.toml.
    case: PathBuf,
    /// The new case folder; it must not exist yet, or be empty.
    folder: PathBuf,
    /// Results of the discrete elements, whose first row is the start. Default: elements.csv beside elements.toml.
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
    let scene = Scene::read(&arguments.case)?;
    let from = arguments.from.clone().unwrap_or_else(|| arguments.case.join("elements.csv"));
    let start = Start::read(&from)?;
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
fn notes(scene: &Scene) -> Vec<String> {
    let friction = (scene.grains.wall_friction > 0.0).then(|| {
        format!(
            "walls have a friction of {}; those of the solver's case have none",
            scene.grains.wall_friction
        )
    });
    let grains = (scene.grains.friction != 0.3).then(|| {
        format!("spheres have a friction of {}; the law of spheres knows 0.3", scene.grains.friction)
    });
    friction.into_iter().chain(grains).collect()
}

/// The bed as the solver's mesh has it: lengths in metres.
pub struct Geometry {
    /// Levels along the axis: floor, the two heights of the averages, lid.
    pub levels: [f64; 4],
    /// In a cylinder: where the mesh begins, the radius of the averages, where it ends.
    pub radii: Option<[f64; 3]>,
    /// Of the cylinder over that of the mesh.
    widening: f64,
    /// Cells between the levels, and between the radii.
    cells: ([usize; 3], [usize; 2]),
    diameter: f64,
}

impl Geometry {
    /// Of a bed of this depth [m].
    ///
    /// # Errors
    /// What the solver's mesh cannot have: sides of a box that are heated, averages beyond the centres of the first layers.
    pub fn new(file: &Path, scene: &Scene, depth: f64) -> Result<Self, CliError> {
        let wrong = |key: &str, value: String, allowed: &str| {
            CliError::Message(format!("{}: {key} = {value}, allowed: {allowed}", file.display()))
        };
        let heated = |name: &str| scene.heated.iter().any(|heated| heated.wall == name);
        if let Some(side) = ["x_low", "x_high", "y_low", "y_high"].into_iter().find(|name| heated(name)) {
            return Err(wrong(
                "heated.wall",
                side.to_string(),
                "floor, lid, and the side of a cylinder, where the solver's case is a column of cells",
            ));
        }
        let half = 0.5 * scene.grains.diameter;
        let [low, high] = scene.record.heights;
        if low <= half || high >= depth - half {
            let allowed = format!(
                "{} to {} m, between the centres of the first layers",
                plain(half),
                plain(depth - half)
            );
            return Err(wrong("record.heights", format!("{low} to {high}"), &allowed));
        }
        let levels = [half, low, high, depth - half];
        let share = |lengths: &[f64], all: f64| -> Vec<usize> {
            let whole: f64 = lengths.iter().sum();
            lengths.iter().map(|length| ((all * length / whole).round() as usize).max(1)).collect()
        };
        let along = [1, 2, 3].map(|k| levels[k] - levels[k - 1]);
        let axial = if heated("floor") || heated("lid") { share(&along, CELLS) } else { vec![1; 3] };
        let radii = match (scene.container.radius, scene.record.radius) {
            (Some(radius), Some(inner)) if inner < radius - half => {
                Some([INNER * radius, inner, radius - half])
            }
            (Some(radius), Some(inner)) => {
                let allowed = format!("less than {} m, the centres of the first layer", plain(radius - half));
                return Err(wrong("record.radius", inner.to_string(), &allowed));
            }
            _ => None,
        };
        let radial = radii
            .map_or(vec![1; 2], |[a, b, c]| share(&[b - a, c - b], if heated("side") { 20.0 } else { 4.0 }));
        let widening = scene.container.radius.map_or(1.0, |radius| radius / (radius - half));
        let cells = ([axial[0], axial[1], axial[2]], [radial[0], radial[1]]);
        Ok(Self { levels, radii, widening, cells, diameter: scene.grains.diameter })
    }

    /// Of the mesh along the axis [m].
    fn depth(&self) -> f64 {
        self.levels[3] - self.levels[0]
    }

    /// A point at a height and, in a cylinder, a distance from the axis [m].
    pub fn point(&self, height: f64, radius: f64) -> [f64; 3] {
        match self.radii {
            Some(_) => [height, radius, 0.0],
            None => [0.5 * WIDTH * self.diameter, 0.5 * WIDTH * self.diameter, height],
        }
    }

    /// Values along radius, around the axis and along it, or along x, y, z, as a symmetric tensor of OpenFOAM.
    fn tensor(&self, [first, second, third]: [f64; 3]) -> String {
        let [x, y, z] = if self.radii.is_some() { [third, first, second] } else { [first, second, third] };
        format!("({} 0 0 {} 0 {})", plain(x), plain(y), plain(z))
    }

    /// Of the whole mesh: in a cylinder by the areas.
    fn porosity(&self, start: &Start) -> f64 {
        match (self.radii, start.porosity_outside) {
            (Some([_, inner, radius]), Some(outside)) => {
                let share = (inner / radius).powi(2);
                share * start.porosity + (1.0 - share) * outside
            }
            _ => start.porosity,
        }
    }

    /// A vector along the axis.
    fn along(&self, value: f64) -> String {
        let value = plain(value);
        if self.radii.is_some() { format!("({value} 0 0)") } else { format!("(0 0 {value})") }
    }

    /// How a parallel run is divided: along the direction with the most cells.
    fn parts(&self) -> String {
        let (axial, radial) = self.cells;
        let many = "$..numberOfSubdomains";
        let parts = match self.radii {
            None => format!("1 1 {many}"),
            Some(_) if radial.iter().sum::<usize>() > axial.iter().sum() => format!("1 {many} 1"),
            Some(_) => format!("{many} 1 1"),
        };
        format!(
            "// './Allrun -parallel N' sets their number\nnumberOfSubdomains 2;\nmethod          simple;\nsimpleCoeffs\n{{\n    n           ({parts});\n    delta       0.001;\n}}\n"
        )
    }

    fn mesh(&self) -> String {
        let (axial, radial) = self.cells;
        let mut vertices = String::new();
        let mut blocks = String::new();
        let mut patches = [const { String::new() }; 6];
        let [floor, lid, inner, side, front, back] = &mut patches;
        match self.radii {
            None => {
                let width = WIDTH * self.diameter;
                for z in self.levels {
                    for [x, y] in [[0.0, 0.0], [width, 0.0], [width, width], [0.0, width]] {
                        let _ = writeln!(vertices, "    ({} {} {})", plain(x), plain(y), plain(z));
                    }
                }
                for (k, cells) in axial.iter().enumerate() {
                    let n = |corner: usize| 4 * k + corner;
                    let name = if k == 1 { "bulk " } else { "" };
                    let _ = writeln!(
                        blocks,
                        "    hex ({} {} {} {} {} {} {} {}) {name}(1 1 {cells}) simpleGrading (1 1 1)",
                        n(0),
                        n(1),
                        n(2),
                        n(3),
                        n(4),
                        n(5),
                        n(6),
                        n(7)
                    );
                    for [a, b] in [[0, 1], [1, 2], [2, 3], [3, 0]] {
                        let _ = write!(side, " ({} {} {} {})", n(a), n(b), n(b + 4), n(a + 4));
                    }
                }
                *floor = " (0 3 2 1)".to_string();
                *lid = " (12 13 14 15)".to_string();
            }
            Some(radii) => {
                for sign in [-1.0, 1.0] {
                    for r in radii {
                        for x in self.levels {
                            let (y, z) = (r * HALF_ANGLE.cos(), sign * r * HALF_ANGLE.sin());
                            let _ = writeln!(vertices, "    ({} {y:.12e} {z:.12e})", plain(x));
                        }
                    }
                }
                // Corner at a level, a radius and a side of the wedge.
                let n = |level: usize, radius: usize, half: usize| 12 * half + 4 * radius + level;
                for (j, across) in radial.iter().enumerate() {
                    for (k, along) in axial.iter().enumerate() {
                        let name = if (k, j) == (1, 0) { "bulk " } else { "" };
                        let face = |half: usize| {
                            [n(k, j, half), n(k + 1, j, half), n(k + 1, j + 1, half), n(k, j + 1, half)]
                        };
                        let [a, b, c, d] = face(0);
                        let [e, f, g, h] = face(1);
                        let _ = writeln!(
                            blocks,
                            "    hex ({a} {b} {c} {d} {e} {f} {g} {h}) {name}({along} {across} 1) simpleGrading (1 1 1)"
                        );
                        let _ = write!(front, " ({a} {d} {c} {b})");
                        let _ = write!(back, " ({e} {f} {g} {h})");
                        if k == 0 {
                            let _ = write!(floor, " ({a} {e} {h} {d})");
                        }
                        if k == 2 {
                            let _ = write!(lid, " ({b} {c} {g} {f})");
                        }
                        if j == 0 {
                            let _ = write!(inner, " ({a} {b} {f} {e})");
                        } else {
                            let _ = write!(side, " ({d} {h} {g} {c})");
                        }
                    }
                }
            }
        }
        let patch = |name: &str, kind: &str, faces: &str| match faces {
            "" => String::new(),
            _ => format!("    {name}\n    {{\n        type {kind};\n        faces ({} );\n    }}\n", faces),
        };
        let [floor, lid, inner, side, front, back] = patches;
        let boundary: String = [
            ("floor", "wall", floor),
            ("lid", "wall", lid),
            ("inner", "wall", inner),
            ("side", "wall", side),
            ("front", "wedge", front),
            ("back", "wedge", back),
        ]
        .iter()
        .map(|(name, kind, faces)| patch(name, kind, faces))
        .collect();
        format!("vertices\n(\n{vertices});\n\nblocks\n(\n{blocks});\n\nboundary\n(\n{boundary});\n")
    }
}

/// The files of the case.
///
/// # Errors
/// Those of [`Geometry::new`].
pub fn files(
    folder: &Path,
    scene: &Scene,
    start: &Start,
    name: &str,
    checkout: &Path,
) -> Result<Vec<File>, CliError> {
    let geometry = Geometry::new(&folder.join(FILE), scene, start.depth)?;
    let porosity = geometry.porosity(start);
    let origin = format!(
        "That of the discrete elements at the start, from {}: written by 'msdd bed case'",
        start.file.display()
    );
    let stress = geometry.tensor(start.stress.map(|stress| -stress));
    let text = |path: &'static str, text: String| File { path, text, program: false };
    let dictionary = |path: &'static str, body: String| {
        let object = path.rsplit('/').next().unwrap_or(path);
        text(path, head("dictionary", object) + &body)
    };
    let gravity = format!(
        "dimensions      [0 1 -2 0 0 0 0];\nvalue           {};\n",
        geometry.along(-scene.container.gravity)
    );
    let [low, high] = scene.temperatures();
    let tolerance = TOLERANCE * (high - low).max(1e-6);
    let mut files = folder::programs(name, checkout, tolerance, scene.grains.number);
    files.extend([
        text("README.md", readme(scene, start, name)),
        text("0/T", temperature(scene)),
        text(
            "0/porosity",
            uniform(
                "porosity",
                FieldKind::Ratio,
                &format!("1 - volume of the spheres over the volume\n{origin}"),
                &plain(porosity),
            ),
        ),
        text("0/fabricIndex", uniform("fabricIndex", FieldKind::Ratio, "Not used with spheres", "0")),
        text(
            "0/stress",
            uniform(
                "stress",
                FieldKind::Stress,
                &format!("Initial stress (xx xy xz yy yz zz) [Pa], tension positive\n{origin}"),
                &stress,
            ),
        ),
        text("constant/g", head("uniformDimensionedVectorField", "g") + &gravity),
        dictionary("constant/granularProperties", properties(scene, start, &geometry)),
        dictionary("system/controlDict", control(scene, &geometry)),
        dictionary("system/blockMeshDict", geometry.mesh()),
        dictionary("system/decomposeParDict", geometry.parts()),
    ]);
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

fn temperature(scene: &Scene) -> String {
    let start = plain(scene.time.initial_temperature);
    let mut walls = "    #includeEtc \"caseDicts/setConstraintTypes\"\n    \".*\"\n    {\n        type            zeroGradient;\n    }\n".to_string();
    for heated in &scene.heated {
        let _ = writeln!(
            walls,
            "    {}\n    {{\n        type            uniformFixedValue;\n        uniformValue    {};\n        value           uniform {start};\n    }}",
            heated.wall,
            table(&heated.temperature, plain)
        );
    }
    format!(
        "{}dimensions      [0 0 0 1 0 0 0];\ninternalField   uniform {start};\nboundaryField\n{{\n{walls}}}\n",
        head("volScalarField", "T")
    )
}

fn property(of: &Property) -> String {
    match of {
        Property::Constant(value) => plain(*value),
        Property::Table(rows) => {
            let rows: Vec<String> =
                rows.iter().map(|[t, value]| format!("({} {})", plain(*t), plain(*value))).collect();
            format!("table ({})", rows.join(" "))
        }
    }
}

fn properties(scene: &Scene, start: &Start, geometry: &Geometry) -> String {
    let grains = &scene.grains;
    let fabric = geometry.tensor(start.fabric);
    let mut text = format!(
        "// The law of spheres, and what the bed is like at the start\n\
         surrogate\n{{\n    type            spheres;\n    spheresCoeffs\n    {{\n\
         \x20       poissonRatio    {};\n        roughness       {};\n        hardness        {};\n\
         \x20       gas             {};\n        gasPressure     {};\n        accommodation   {};\n\
         \x20       coordination    {};\n        mobilised       {};\n        fabric          {fabric};\n    }}\n}}\n\n\
         density             {};\nyoungModulus        {};\nthermalConductivity {};\nheatCapacity        {};\n\
         thermalExpansion    {};\nmeanRadius          {};\n\nmechanics           equilibrium;\n\nequilibriumCoeffs\n{{\n    walls\n    {{\n",
        plain(grains.poisson_ratio),
        plain(grains.roughness.unwrap_or(0.0)),
        plain(grains.hardness.unwrap_or(1e9)),
        scene.gas.name.as_str(),
        plain(scene.gas.pressure),
        plain(scene.gas.accommodation),
        plain(start.coordination),
        plain(start.mobilised),
        plain(grains.density),
        plain(grains.young_modulus),
        property(&grains.conductivity),
        property(&grains.heat_capacity),
        plain(grains.thermal_expansion.unwrap_or(0.0)),
        plain(0.5 * grains.diameter),
    );
    let lid = match (&scene.lid.strain, &scene.lid.pressing) {
        (Some(strain), _) => {
            let moved = table(strain, |strain| geometry.along(-strain * geometry.depth()));
            format!("type frictionless; displacement {moved};")
        }
        (None, Some(pressing)) => {
            let pressure = table(pressing, |pressure| plain(pressure * geometry.widening.powi(2)));
            format!("type pressure; pressure {pressure};")
        }
        (None, None) => "type frictionless;".to_string(),
    };
    let side = match &scene.shell {
        Some(shell) => {
            let radius = geometry.radii.map_or(0.0, |radii| radii[2]);
            let expansion = match shell.thermal_expansion > 0.0 {
                true => format!(
                    " thermalExpansion {}; temperature {};",
                    plain(shell.thermal_expansion),
                    plain(scene.time.initial_temperature)
                ),
                false => String::new(),
            };
            format!(
                "type shell; youngModulus {}; thickness {}; radius {};{expansion}",
                plain(shell.young_modulus),
                plain(shell.thickness / geometry.widening),
                plain(radius)
            )
        }
        None => "type frictionless;".to_string(),
    };
    if geometry.radii.is_some() {
        text += "        inner { type frictionless; }\n";
    }
    let _ = write!(
        text,
        "        floor {{ type frictionless; }}\n        lid {{ {lid} }}\n        side {{ {side} }}\n    }}\n}}\n"
    );
    text
}

/// Where temperatures are recorded.
pub fn probes(scene: &Scene, geometry: &Geometry) -> Vec<[f64; 3]> {
    let record = &scene.record;
    let depth = geometry.levels[3] + geometry.levels[0];
    let middle = 0.5 * (record.heights[0] + record.heights[1]);
    let at = |&distance: &f64| match record.wall.as_str() {
        "side" => geometry.point(middle, scene.container.radius.unwrap_or(0.0) - distance),
        "lid" => geometry.point(depth - distance, 0.5 * record.radius.unwrap_or(0.0)),
        _ => geometry.point(distance, 0.5 * record.radius.unwrap_or(0.0)),
    };
    record.distances.iter().map(at).collect()
}

fn control(scene: &Scene, geometry: &Geometry) -> String {
    let places: Vec<String> = probes(scene, geometry)
        .iter()
        .map(|[x, y, z]| format!("({} {} {})", plain(*x), plain(*y), plain(*z)))
        .collect();
    let time = &scene.time;
    format!(
        "application     msddFoam;\nstartFrom       latestTime;\nstartTime       0;\nstopAt          endTime;\nendTime         {};\n\
         deltaT          {};\n\nadjustTimeStep  yes;\nmaxDeltaT       {};\nwriteControl    runTime;\nwriteInterval   {};\n\
         writePrecision  17;\ntimePrecision   8;\nrunTimeModifiable no;\n\nfunctions\n{{\n\
         \x20   // Temperature where the discrete elements record it\n    probes\n    {{\n        type            probes;\n\
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

fn readme(scene: &Scene, start: &Start, name: &str) -> String {
    format!(
        "# Case {name}\n\nA bed of {} spheres of {} m as the solver sees it, written by `msdd bed case`. `./Allrun` runs it, `./Allclean` removes the results.\n\n\
         It starts as the discrete elements of `{}` do. Temperatures where these record them go to `postProcessing/probes/0/T`, means of stress and conductivity where they take theirs to `postProcessing/bulk`, pressures on the walls to `postProcessing/wallPressure`.\n\
         Keys: the book's pages on constant/granularProperties and system.\n",
        scene.grains.number,
        plain(scene.grains.diameter),
        start.file.display(),
    )
}
