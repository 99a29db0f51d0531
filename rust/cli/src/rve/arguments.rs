//! Arguments of `msdd rve`.

use crate::error::CliError;
use crate::named::parser;
use crate::simd::SimdArgument;
use clap::Args;
use msdd_beds::sizes::Sizes;
use msdd_rve::{Boundary, Cut, RegionKind, Relaxation};
use std::path::PathBuf;

/// Of discs or of spheres.
const COMPRESSIONS: [&str; 5] = ["isotropic", "horizontal", "intermediate", "uniaxial", "sheared"];
const RELAXATIONS: [&str; 2] = ["damped", "fire"];

#[derive(Args)]
#[command(after_help = "Examples:
  msdd rve pack --discs 500 --seed 1 --porosity 0.12 --compression horizontal --out state.json
  msdd rve pack --spheres 1000 --pressure 1e-6 --friction 0.3 --shaking 0.005 --out spheres.json")]
pub struct PackArguments {
    /// Number of discs. Allowed: 10 to 1000000.
    #[arg(long, default_value_t = 500)]
    pub discs: usize,
    /// Number that all random choices follow from.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Porosity of the whole box to pack discs to, overlaps counted once. The printed value refers to the averaging
    /// region. Allowed: 0.01 to 0.3. Default: required for discs.
    #[arg(long, required_unless_present = "spheres")]
    pub porosity: Option<f64>,
    /// Directions in which the box closes. Discs: isotropic, horizontal, intermediate, sheared; spheres: isotropic, uniaxial
    /// (along z), sheared (along z, while it opens along x and y).
    #[arg(long, value_parser = COMPRESSIONS, default_value = COMPRESSIONS[0])]
    pub compression: String,
    /// Rigid walls, or a periodic box; spheres are always in a periodic one.
    #[arg(long, value_parser = parser::<Boundary>(&["walls", "periodic"]), default_value = "walls")]
    pub boundary: Boundary,
    /// Smallest radius of discs [m]; radii are uniformly distributed between the smallest and the largest. Allowed: 1e-30 to
    /// 1e30.
    #[arg(long, default_value_t = 3e-3)]
    pub radius_min: f64,
    /// Largest radius of discs [m]. Allowed: --radius-min to ten times that.
    #[arg(long, default_value_t = 7e-3)]
    pub radius_max: f64,
    #[command(flatten)]
    pub of_spheres: OfSpheres,
    /// How equilibrium is found: by the damped motion of the grains, or by the minimiser FIRE, which is several times as fast.
    #[arg(long, value_parser = parser::<Relaxation>(&RELAXATIONS), default_value = RELAXATIONS[0])]
    pub relaxation: Relaxation,
    /// State file (JSON) to write. If the run fails, the last good state is written to FILE.last-good.json instead.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Folder for ParaView files of the state.
    #[arg(long, value_name = "DIR")]
    pub vtk: Option<PathBuf>,
    #[command(flatten)]
    pub simd: SimdArgument,
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
    pub state: PathBuf,
    /// Strain of the radii; this, --stops or a strain of the box has to be given. Allowed: -0.2 to 0.2.
    #[arg(long, allow_negative_numbers = true, conflicts_with = "stops")]
    pub strain: Option<f64>,
    /// Strains of the radii at several stops, reached one after the other, with commas between; at each, the grains come to
    /// equilibrium. Instead of --strain. Allowed: -0.2 to 0.2, of one sign, growing in size.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    pub stops: Vec<f64>,
    /// Strain of the box along x (extension positive) at the stops, one value for each stop. Allowed: -0.2 to 0.2. Default:
    /// 0.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    pub xx: Vec<f64>,
    /// Strain of the box along y at the stops. Allowed: -0.2 to 0.2. Default: 0.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    pub yy: Vec<f64>,
    /// Strain of a box of spheres along z at the stops. Allowed: -0.2 to 0.2. Default: 0.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    pub zz: Vec<f64>,
    /// Shear γxy of a periodic box at the stops: displacement along x over the distance along y. Allowed: -0.2 to 0.2.
    /// Default: 0.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    pub xy: Vec<f64>,
    /// Shear γxz of a box of spheres at the stops: displacement along x over the distance along z. Allowed: -0.2 to 0.2.
    /// Default: 0.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    pub xz: Vec<f64>,
    /// Shear γyz of a box of spheres at the stops: displacement along y over the distance along z. Allowed: -0.2 to 0.2.
    /// Default: 0.
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true)]
    pub yz: Vec<f64>,
    /// Of discs: rate of the strain that changes most [1/s]. Allowed: 1e-6 to 100 for grains like the paper's. Default: 0.1
    /// when contacts close, 0.02 when they open.
    #[arg(long)]
    pub rate: Option<f64>,
    /// Of discs: how equilibrium is found, by the damped motion of the grains, or by the minimiser FIRE, which is several
    /// times as fast.
    #[arg(long, value_parser = parser::<Relaxation>(&RELAXATIONS), default_value = RELAXATIONS[0])]
    pub relaxation: Relaxation,
    /// State file (JSON) to write: the state at the last stop. If the run fails, the last good state is written to
    /// FILE.last-good.json instead.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Folder for a ParaView time series of the stops.
    #[arg(long, value_name = "DIR")]
    pub vtk: Option<PathBuf>,
    #[command(flatten)]
    pub simd: SimdArgument,
}

#[derive(Args)]
pub struct HomogeniseArguments {
    /// State file.
    #[arg(long, value_name = "FILE")]
    pub state: PathBuf,
    /// Averaging region: hull of the inner discs, the box without a margin of 0.8 mean radii, or the whole box. A periodic
    /// box is always averaged as a whole.
    #[arg(long, value_parser = parser::<RegionKind>(&["hull", "inset", "cell"]), default_value = "inset")]
    pub region: RegionKind,
    /// Whether contacts that cross the border of the region count with their share inside of it, or in full.
    #[arg(long, value_parser = parser::<Cut>(&["clip", "whole"]), default_value = "clip")]
    pub cut: Cut,
}

/// What only spheres have.
#[derive(Args)]
pub struct OfSpheres {
    /// Number of spheres, instead of discs, in a periodic box. Lengths are in diameters, stresses over E* = E/(2 (1 - ν²)).
    /// Allowed: 50 to 1000000.
    #[arg(long, conflicts_with_all = ["discs", "porosity", "boundary", "radius_min", "radius_max", "relaxation"])]
    pub spheres: Option<usize>,
    /// Distribution of the diameters, which are over their Sauter mean, in the form of `sizes` of a bed.toml:
    /// 'uniform = [0.8, 1.2]', 'normal = 0.2', 'log_normal = 0.2', 'sieve = [[1, 0], [1, 0.3], [2, 0.3], [2, 1]]'. Default:
    /// equal spheres.
    #[arg(long, requires = "spheres")]
    pub sizes: Option<Sizes>,
    /// Pressure over E* to pack spheres to. Allowed: 1e-8 to 1e-3.
    #[arg(long, default_value = "1e-6", requires = "spheres")]
    pub pressure: f64,
    /// Friction of spheres. Allowed: 0 to 2.
    #[arg(long, default_value_t = 0.3, requires = "spheres")]
    pub friction: f64,
    /// Friction of spheres while the box closes; less packs denser. Allowed: 0 to `friction`. Default: `friction`.
    #[arg(long, requires = "spheres")]
    pub packing_friction: Option<f64>,
    /// How far the packed box is opened to be shaken and pressed again with the friction of the spheres; 0: it is not.
    /// Allowed: 0, or 0.002 to 0.1.
    #[arg(long, default_value_t = 0.0, requires = "spheres")]
    pub shaking: f64,
    /// Poisson's ratio of spheres. Allowed: 0 to 0.5.
    #[arg(long, default_value_t = 0.25, requires = "spheres")]
    pub poisson_ratio: f64,
    /// Restitution of spheres, which only decides how fast they come to rest. Allowed: above 0, to 1.
    #[arg(long, default_value_t = 0.3, requires = "spheres")]
    pub restitution: f64,
}

/// The strains at the stops, of the radii and xx, yy, zz, xy, xz, yz: as many as the longest list has; lists that are not
/// given count as zero.
pub fn strains(arguments: &ExpandArguments) -> Result<Vec<[f64; 7]>, CliError> {
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
