//! `msdd rve`: single RVEs, of discs and (module [`spheres`]) of spheres. The state file says which it has.

mod spheres;

use crate::error::CliError;
use crate::simd::SimdArgument;
use clap::{Args, Subcommand, ValueEnum};
use msdd_files::{check_target, read_text, write};
use msdd_rve::{
    Averages, Axis, Boundary, Compression, Cut, Material, PackingSpec, Preparation, Protocol, RegionKind,
    Relaxation, RveError, Settled, Simulation, Strains, follow, heat_check, homogenise_in, last_good,
    pack_watched, region, state, unbalanced_force, vtk,
};
use serde_json::json;
use std::path::{Path, PathBuf};

#[derive(Subcommand)]
pub enum Command {
    /// Pack random discs to a porosity, or spheres to a pressure, and let them come to equilibrium.
    Pack(PackArguments),
    /// Strain a packed state: expand or contract the grains, or deform the box.
    Expand(ExpandArguments),
    /// Print the averages of a state as JSON.
    Homogenise(HomogeniseArguments),
    /// Measure the conductivity of a packing by conducting heat through all of it, grains at rest; prints it beside the
    /// homogenised conductivity as JSON.
    HeatCheck(HeatCheckArguments),
    /// Draw the grains of a state and the forces between them as SVG, alone or beside a field of the solver.
    Draw(crate::draw::Arguments),
}

#[derive(Args)]
#[command(after_help = "Examples:
  msdd rve pack --discs 500 --seed 1 --porosity 0.12 --compression horizontal --out state.json
  msdd rve pack --spheres 1000 --pressure 1e-6 --friction 0.3 --shaking 0.005 --out spheres.json")]
pub struct PackArguments {
    #[arg(long, default_value_t = 500)]
    discs: usize,
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Porosity of the whole box to pack discs to, overlaps counted once. The value that is printed is that of the averaging
    /// region.
    #[arg(long, required_unless_present = "spheres")]
    porosity: Option<f64>,
    /// Directions in which the box closes. Discs: isotropic, horizontal, intermediate, sheared; spheres: isotropic, uniaxial
    /// (along z), sheared (along z, while it opens along x and y).
    #[arg(long, value_enum, default_value_t = CompressionName::Isotropic)]
    compression: CompressionName,
    /// Rigid walls, or a periodic box; spheres are always in a periodic one.
    #[arg(long, value_enum, default_value_t = BoundaryName::Walls)]
    boundary: BoundaryName,
    /// Smallest radius of discs [m]; radii are uniformly distributed between the smallest and the largest.
    #[arg(long, default_value_t = 3e-3)]
    radius_min: f64,
    #[arg(long, default_value_t = 7e-3)]
    radius_max: f64,
    #[command(flatten)]
    of_spheres: spheres::PackArguments,
    /// How equilibrium is found: by the damped motion of the grains, or by the minimiser FIRE, which is several times as fast.
    #[arg(long, value_enum, default_value_t = RelaxationName::Damped)]
    relaxation: RelaxationName,
    /// State file (JSON) to write. If the run fails, the last good state is written to FILE.last-good.json instead.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Folder for ParaView files of the state.
    #[arg(long, value_name = "DIR")]
    vtk: Option<PathBuf>,
    #[command(flatten)]
    simd: SimdArgument,
}

#[derive(Args)]
#[command(after_help = "Examples:
  msdd rve expand --state state.json --strain 0.02 --out out.json
  msdd rve expand --state state.json --stops 0.01,0.02,0.05 --out out.json   (writes the last, prints all)
  msdd rve expand --state state.json --xx=-0.01,-0.02 --out out.json            (walls close along x)
  msdd rve expand --state periodic.json --xy 0.01,0.02 --out out.json            (shear of a periodic box)
  msdd rve expand --state spheres.json --zz=-0.001,-0.002 --out out.json         (a box of spheres closes along z)")]
pub struct ExpandArguments {
    /// State file to start from; strains are relative to its radii and its box.
    #[arg(long, value_name = "FILE")]
    state: PathBuf,
    /// Thermal strain of the radii.
    #[arg(long, allow_negative_numbers = true, conflicts_with = "stops")]
    strain: Option<f64>,
    /// Thermal strains of several stops, reached one after the other; at each, the grains come to equilibrium.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    stops: Vec<f64>,
    /// Strain of the box along x (extension positive) at the stops, one value for each stop; 0 when not given.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    xx: Vec<f64>,
    /// Strain of the box along y at the stops.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    yy: Vec<f64>,
    /// Strain of a box of spheres along z at the stops.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    zz: Vec<f64>,
    /// Shear γxy of a periodic box at the stops: displacement along x over the distance along y.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    xy: Vec<f64>,
    /// Shear γxz of a box of spheres at the stops.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    xz: Vec<f64>,
    /// Shear γyz of a box of spheres at the stops.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    yz: Vec<f64>,
    /// When the walls move, displace all grains with the mean strain of the box; else only the walls push them.
    #[arg(long)]
    affine: bool,
    /// Rate of the strain that changes most [1/s]; default: 0.1 when contacts close, 0.02 when they open.
    #[arg(long)]
    rate: Option<f64>,
    /// Contact stiffness of the walls over E r; default: that of the state.
    #[arg(long)]
    wall_stiffness: Option<f64>,
    /// How equilibrium is found: by the damped motion of the grains, or by the minimiser FIRE, which is several times as fast.
    #[arg(long, value_enum, default_value_t = RelaxationName::Damped)]
    relaxation: RelaxationName,
    /// State file (JSON) to write: the state at the last stop. If the run fails, the last good state is written to
    /// FILE.last-good.json instead.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Folder for a ParaView time series of the stops.
    #[arg(long, value_name = "DIR")]
    vtk: Option<PathBuf>,
    #[command(flatten)]
    simd: SimdArgument,
}

#[derive(Args)]
pub struct HomogeniseArguments {
    #[arg(long, value_name = "FILE")]
    state: PathBuf,
    /// Averaging region: hull of the inner discs, the box without a margin of 0.8 mean radii, or the whole box. A periodic box
    /// is always averaged as a whole.
    #[arg(long, value_enum, default_value_t = RegionName::Inset)]
    region: RegionName,
    /// Whether contacts that cross the border of the region count with their share inside of it, or in full.
    #[arg(long, value_enum, default_value_t = CutName::Clip)]
    cut: CutName,
}

#[derive(Args)]
#[command(
    after_help = "Two opposite walls have different temperatures, the other two are insulated. Prints three conductivities over \
that of the grains, k: k_measured (heat flux over the temperature gradient in the inner part), and, averaged over windows of the \
inner part, k_affine (Eq. 9 of the paper) and k_network (resistor network of the contacts solved)."
)]
pub struct HeatCheckArguments {
    #[arg(long, value_name = "FILE")]
    state: PathBuf,
    /// Direction of the temperature difference.
    #[arg(long, value_enum, default_value_t = AxisName::X)]
    axis: AxisName,
}

#[derive(Clone, Copy, ValueEnum)]
enum AxisName {
    X,
    Y,
}

#[derive(Clone, Copy, ValueEnum)]
enum CompressionName {
    Isotropic,
    Horizontal,
    Intermediate,
    Uniaxial,
    Sheared,
}

#[derive(Clone, Copy, ValueEnum)]
enum BoundaryName {
    Walls,
    Periodic,
}

#[derive(Clone, Copy, ValueEnum)]
enum RegionName {
    Hull,
    Inset,
    Cell,
}

#[derive(Clone, Copy, ValueEnum)]
enum CutName {
    Clip,
    Whole,
}

#[derive(Clone, Copy, ValueEnum)]
enum RelaxationName {
    Damped,
    Fire,
}

impl From<RelaxationName> for Relaxation {
    fn from(name: RelaxationName) -> Self {
        match name {
            RelaxationName::Damped => Self::Damped,
            RelaxationName::Fire => Self::Fire,
        }
    }
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Pack(arguments) => pack_one(arguments),
        Command::Expand(arguments) => expand_one(arguments),
        Command::Homogenise(arguments) => homogenise_one(arguments),
        Command::HeatCheck(arguments) => check_heat(arguments),
        Command::Draw(arguments) => crate::draw::run(arguments),
    }
}

/// What a state file has.
enum Assembly {
    Discs(Simulation),
    Spheres(msdd_spheres::Simulation),
}

/// Reads a state file of discs or of spheres.
fn read_either(path: &Path) -> Result<Assembly, CliError> {
    let failed = |source| CliError::State { file: path.to_path_buf(), source };
    let text = read_text(path)?;
    match state::dimension(&text).map_err(failed)? {
        3 => msdd_rve::spheres::state::from_json(&text).map(Assembly::Spheres),
        _ => state::from_json(&text).map(Assembly::Discs),
    }
    .map_err(failed)
}

/// Reads a state file of discs.
pub fn read_state(path: &Path) -> Result<Simulation, CliError> {
    let failed = |source| CliError::State { file: path.to_path_buf(), source };
    state::from_json(&read_text(path)?).map_err(failed)
}

/// Writes a state file.
pub fn write_state(path: &Path, simulation: &Simulation) -> Result<(), CliError> {
    let failed = |source| CliError::State { file: path.to_path_buf(), source };
    Ok(write(path, state::to_file(simulation).map_err(failed)?.as_bytes())?)
}

/// Writes the last good state of a failed run beside `out`, and names it in the error.
fn failed(out: &Path, source: RveError, last_good: Option<&Simulation>) -> CliError {
    let Some(state) = last_good else { return CliError::Rve(source) };
    match last_good::write(out, state) {
        Ok(file) => CliError::Stopped { source, file, steps: state.steps, time: state.time },
        Err(error) => CliError::Message(format!("{source}; its last good state cannot be written: {error}")),
    }
}

fn pack_one(arguments: &PackArguments) -> Result<(), CliError> {
    check_target(&arguments.out)?;
    arguments.simd.apply()?;
    let porosity = match (arguments.of_spheres.count(), arguments.porosity) {
        (Some(count), _) => return spheres::pack(arguments, count),
        (None, Some(porosity)) => porosity,
        (None, None) => return Err(CliError::Message("give --porosity, or --spheres".to_string())),
    };
    let spec = PackingSpec {
        discs: arguments.discs,
        seed: arguments.seed,
        porosity,
        compression: match arguments.compression {
            CompressionName::Isotropic => Compression::Isotropic,
            CompressionName::Horizontal => Compression::Horizontal,
            CompressionName::Intermediate => Compression::Intermediate,
            CompressionName::Sheared => Compression::Sheared,
            CompressionName::Uniaxial => {
                let allowed = "isotropic, horizontal, intermediate, sheared; uniaxial is for spheres";
                return Err(CliError::Message(format!("--compression: uniaxial, allowed: {allowed}")));
            }
        },
        radius_min: arguments.radius_min,
        radius_max: arguments.radius_max,
        relaxation: arguments.relaxation.into(),
        boundary: match arguments.boundary {
            BoundaryName::Walls => Boundary::Walls,
            BoundaryName::Periodic => Boundary::Periodic,
        },
    };
    let packed = pack_watched(&spec, &Preparation::default(), &Material::default())
        .map_err(|stopped| failed(&arguments.out, stopped.error, stopped.last_good.as_deref()))?;
    write_state(&arguments.out, &packed.simulation)?;
    let mut series = Series::new(arguments.vtk.as_deref());
    series.add(0.0, &packed.simulation)?;
    report("packed", &packed.settled, &msdd_rve::homogenise(&packed.simulation, RegionKind::default()));
    Ok(())
}

fn expand_one(arguments: &ExpandArguments) -> Result<(), CliError> {
    check_target(&arguments.out)?;
    arguments.simd.apply()?;
    let mut simulation = match read_either(&arguments.state)? {
        Assembly::Discs(simulation) => simulation,
        Assembly::Spheres(simulation) => return spheres::expand(arguments, simulation),
    };
    if ![&arguments.zz, &arguments.xz, &arguments.yz].iter().all(|list| list.is_empty()) {
        return Err(CliError::Message("--zz, --xz, --yz: are for boxes of spheres".to_string()));
    }
    simulation.affine = arguments.affine;
    if let Some(factor) = arguments.wall_stiffness {
        simulation.material.wall_stiffness_factor = factor;
        simulation.material.check().map_err(|error| CliError::Message(error.to_string()))?;
    }
    let path = path(arguments)?;
    let mut protocol = Protocol { relaxation: arguments.relaxation.into(), ..Protocol::usual(&simulation) };
    if let Some(rate) = arguments.rate {
        (protocol.expansion_rate, protocol.contraction_rate) = (rate, rate);
    }
    let mut series = Series::new(arguments.vtk.as_deref());
    let mut written = series.add(0.0, &simulation);
    let mut written_stops = 0;
    let ramp = follow(&mut simulation, &path, protocol, |stop, simulation| {
        if written.is_ok() {
            written = series.add((written_stops + 1) as f64, simulation);
        }
        written_stops += 1;
        let Strains { thermal, xx, yy, xy } = stop.strains;
        let walls = if xx == 0.0 && yy == 0.0 { String::new() } else { format!(", walls {xx:+} {yy:+}") };
        let shear = if xy == 0.0 { String::new() } else { format!(", shear {xy:+}") };
        report(&format!("strain {thermal:+}{walls}{shear}"), &stop.settled, &stop.averages);
    })?;
    written?;
    match ramp.failure {
        Some(failure) => Err(failed(&arguments.out, failure, simulation.take_last_good().as_ref())),
        None => write_state(&arguments.out, &simulation),
    }
}

/// The strains at the stops, of the radii and xx, yy, zz, xy, xz, yz: as many as the longest list has; lists that are not
/// given count as zero.
fn strains(arguments: &ExpandArguments) -> Result<Vec<[f64; 7]>, CliError> {
    let thermal = arguments.strain.map_or_else(|| arguments.stops.clone(), |strain| vec![strain]);
    let ExpandArguments { xx, yy, zz, xy, xz, yz, .. } = arguments;
    let lists = [("stops", &thermal), ("xx", xx), ("yy", yy), ("zz", zz), ("xy", xy), ("xz", xz), ("yz", yz)];
    let count = lists.iter().map(|(_, list)| list.len()).max().unwrap_or(0);
    if count == 0 {
        return Err(CliError::Message("give --strain, --stops, or a strain of the box".to_string()));
    }
    if let Some((name, list)) = lists.iter().find(|(_, list)| !list.is_empty() && list.len() != count) {
        return Err(CliError::Message(format!(
            "--{name}: {} values, expected {count}, one a stop",
            list.len()
        )));
    }
    let at = |stop: usize| lists.map(|(_, list)| list.get(stop).copied().unwrap_or(0.0));
    Ok((0..count).map(at).collect())
}

/// The same for discs.
fn path(arguments: &ExpandArguments) -> Result<Vec<Strains>, CliError> {
    let of = |[thermal, xx, yy, _, xy, ..]: [f64; 7]| Strains { thermal, xx, yy, xy };
    Ok(strains(arguments)?.into_iter().map(of).collect())
}

/// Prints one line about a state.
fn report(what: &str, settled: &Settled, averages: &Averages) {
    outln!(
        "{what}: {} after {} steps, porosity {:.4}, fabric index {:+.4}, K/k {:.4} {:.4}, pressure {:.1} Pa, \
         coordination {:.2}, rattlers {}",
        settled.outcome.as_str(),
        settled.steps,
        averages.porosity,
        averages.fabric_index,
        averages.conductivity_xx,
        averages.conductivity_yy,
        averages.pressure,
        averages.coordination,
        averages.rattlers
    );
}

fn homogenise_one(arguments: &HomogeniseArguments) -> Result<(), CliError> {
    let simulation = match read_either(&arguments.state)? {
        Assembly::Discs(simulation) => simulation,
        Assembly::Spheres(simulation) => return spheres::homogenise(&simulation),
    };
    let kind = match arguments.region {
        RegionName::Hull => RegionKind::Hull,
        RegionName::Inset => RegionKind::Inset,
        RegionName::Cell => RegionKind::Cell,
    };
    let cut = match arguments.cut {
        CutName::Clip => Cut::Clip,
        CutName::Whole => Cut::Whole,
    };
    let averages = homogenise_in(&simulation, &region::region(&simulation, kind), cut);
    let json = as_json(&averages, unbalanced_force(&simulation));
    print(&json)
}

fn print(json: &serde_json::Value) -> Result<(), CliError> {
    outln!("{}", serde_json::to_string_pretty(json).map_err(|e| CliError::Message(e.to_string()))?);
    Ok(())
}

fn check_heat(arguments: &HeatCheckArguments) -> Result<(), CliError> {
    let axis = match arguments.axis {
        AxisName::X => Axis::X,
        AxisName::Y => Axis::Y,
    };
    let check = heat_check(&read_state(&arguments.state)?, axis);
    outln!("{}", serde_json::to_string_pretty(&check).map_err(|e| CliError::Message(e.to_string()))?);
    Ok(())
}

/// The averages as JSON: conductivities over k; stresses in Pa, compression positive.
fn as_json(a: &Averages, unbalanced: f64) -> serde_json::Value {
    json!({
        "porosity": a.porosity,
        "porosity_sum_of_areas": a.porosity_sum_of_areas,
        "overlap_fraction": a.overlap_fraction,
        "fabric_index": a.fabric_index,
        "fabric_conductivity": a.fabric_conductivity,
        "conductivity": {"xx": a.conductivity_xx, "yy": a.conductivity_yy, "xy": a.conductivity_xy},
        "conductivity_network": {
            "xx": a.conductivity_network_xx, "yy": a.conductivity_network_yy, "xy": a.conductivity_network_xy
        },
        "stress": {"xx": a.stress_xx, "yy": a.stress_yy, "xy": a.stress_xy, "yx": a.stress_yx},
        "pressure": a.pressure,
        "coordination": a.coordination,
        "rattlers": a.rattlers,
        "contacts": a.contacts,
        "mean_radius": a.mean_radius,
        "unbalanced": unbalanced,
    })
}

/// Writes a ParaView time series to a folder; without a folder, it writes nothing.
struct Series<'a> {
    folder: Option<&'a Path>,
    particles: Vec<(f64, String)>,
    contacts: Vec<(f64, String)>,
}

impl<'a> Series<'a> {
    fn new(folder: Option<&'a Path>) -> Self {
        Self { folder, particles: Vec::new(), contacts: Vec::new() }
    }

    fn add(&mut self, time: f64, simulation: &Simulation) -> Result<(), CliError> {
        let Some(folder) = self.folder else { return Ok(()) };
        let number = self.particles.len();
        for (name, text, list) in [
            ("particles", vtk::particles(simulation), &mut self.particles),
            ("contacts", vtk::contacts(simulation), &mut self.contacts),
        ] {
            let file = format!("{name}_{number:04}.vtp");
            write(&folder.join(&file), text.as_bytes())?;
            list.push((time, file));
            write(&folder.join(format!("{name}.pvd")), vtk::series(list).as_bytes())?;
        }
        Ok(())
    }
}
