//! Zehner's packed beds: prediction, experiment and correlation side by side.
//!
//!     cargo run --release -p msdd-beds --example zehner [SEEDS [FOLDER]]
//!
//! reads the measurements in FOLDER (`cases/zehner`), packs boxes of 1000 spheres with four frictions and SEEDS seeds (without SEEDS: those of
//! `packings.csv`, if it is there), writes `packings.csv` and `prediction.csv` there, and prints tables of errors. A stagnant conductivity is the intercept at Pe = 0 of a
//! straight line through the four runs of lowest Pe of a series (ten numbers each): most series are concave in Pe, and a
//! line through all runs would be too high at Pe = 0. The errors against that one are printed, too.

#[path = "direct/mod.rs"]
mod direct;

use direct::correlation::{pore_width, radiation, zehner_bauer_schluender};
use msdd_beds::conductances::{contact_links, gas_links, near_pairs};
use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::effective::{contact_factor, poor_spheres, share_of_pairs};
use msdd_beds::named_gases::GasName;
use msdd_beds::property::Property;
use msdd_beds::radiation::{Dark, black, factor as exchange_factor};
use msdd_beds::solid::{Roughness, Solid};
use msdd_beds::{Packing, pack};
use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Material, Stiffness};
use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;

type Any<T> = Result<T, Box<dyn Error>>;

/// ln(R/h) at which the gas is solved; between them it is quadratic.
const LOGS: [f64; 3] = [3.5, 6.0, 8.5];
/// Of the packings; spheres of unit diameter, density and Young's modulus.
const FRICTIONS: [f64; 4] = [0.0, 0.1, 0.3, 0.5];
const PRESSURE: f64 = 1e-6;
/// Temperatures \[K\] of the columns of conductivities of the grains.
const COLUMNS: [f64; 5] = [320.0, 600.0, 800.0, 900.0, 1000.0];
/// Assumed: Poisson's ratio and hardness \[Pa\] of all grains, friction of the walls, ratio of the stresses in the bed.
const POISSON: f64 = 0.3;
const HARDNESS: f64 = 3e9;
const WALL_FRICTION: f64 = 0.3;
const STRESS_RATIO: f64 = 0.5;
/// Runs of lowest Péclet number that give the conductivity without flow.
const LOWEST: usize = 4;
/// Series that lie far off the others of the same bed, and material without density, left out of the tables.
const APART: [&str; 2] = ["SK05/70", "IK09"];

/// C, three κ_g, and z as straight lines over φ: value at 0.6 and slope; and the scatter about them.
struct Packings([[f64; 3]; 5]);

/// Packs, and writes `packings.csv`.
fn packed(seeds: u64, file: &Path) -> Any<()> {
    let mut text =
        "friction,seed,solid_fraction,contact_conductivity,gas_3.5,gas_6,gas_8.5,coordination\n".to_string();
    for friction in FRICTIONS {
        for seed in 1..=seeds {
            let stiffness = Stiffness::HertzMindlin { young_modulus: 1.0, poisson_ratio: 0.25 };
            let material =
                Material { density: 1.0, stiffness, friction, wall_friction: 0.0, restitution: 0.3 };
            let packed = pack(&Packing {
                spheres: 1000,
                seed,
                diameter: 1.0,
                sizes: None,
                material,
                pressure: PRESSURE,
                steps: 400_000,
            })?;
            let (s, a) = (&packed.simulation, &packed.averages);
            let volume = s.cell().map_or(0.0, |cell| cell.volume());
            let solid =
                Solid { conductivity: 1.0, effective_modulus: effective_modulus(1.0, 0.25), roughness: None };
            let solve =
                |links: &[_]| conductivity(links, 1000, volume).map_or(f64::NAN, |k| mean(&k.network));
            let c = solve(&contact_links(s, &solid)) / (a.pressure() / solid.effective_modulus).cbrt();
            let gas = LOGS.map(|log| solve(&gas_links(&near_pairs(s), 1.0, |radius| radius * (-log).exp())));
            let row = [a.solid_fraction, c, gas[0], gas[1], gas[2], a.coordination];
            writeln!(text, "{friction},{seed},{}", row.map(|x| format!("{x:.5}")).join(","))?;
        }
    }
    Ok(std::fs::write(file, text)?)
}

fn packings(seeds: Option<u64>, folder: &Path) -> Any<Packings> {
    let file = folder.join("packings.csv");
    if seeds.is_some() || !file.exists() {
        packed(seeds.unwrap_or(3), &file)?;
    }
    let numbers = |row: Vec<String>| -> Any<Vec<f64>> {
        Ok(row.iter().map(|cell| cell.parse()).collect::<Result<_, _>>()?)
    };
    let rows = table(&file)?.into_iter().map(numbers).collect::<Any<Vec<_>>>()?;
    Ok(Packings(std::array::from_fn(|k| {
        let points: Vec<(f64, f64)> = rows.iter().map(|row| (row[2] - 0.6, row[k + 3])).collect();
        let (value, slope) = line(&points);
        let off = points.iter().map(|(x, y)| (y / (value + slope * x) - 1.0).powi(2)).sum::<f64>();
        [value, slope, (off / points.len() as f64).sqrt()]
    })))
}

/// The straight line through points: value at x = 0 and slope.
fn line(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let (x, y) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let xx: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / xx;
    (y - slope * x, slope)
}

/// Of the value of [`line`] at x = 0.
fn standard_error(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (value, slope) = line(points);
    let x = points.iter().map(|p| p.0).sum::<f64>() / n;
    let xx: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let off: f64 = points.iter().map(|p| (p.1 - value - slope * p.0).powi(2)).sum();
    if points.len() > 2 { (off / (n - 2.0) * (1.0 / n + x * x / xx)).sqrt() } else { f64::NAN }
}

/// Whether the least-squares parabola through four points or more bends down: what is left of y less a line goes against what is
/// left of x².
fn concave(points: &[(f64, f64)]) -> Option<bool> {
    let left = |points: &[(f64, f64)]| {
        let (value, slope) = line(points);
        points.iter().map(|p| p.1 - value - slope * p.0).collect::<Vec<f64>>()
    };
    let squares: Vec<(f64, f64)> = points.iter().map(|p| (p.0, p.0 * p.0)).collect();
    let product: f64 = left(points).iter().zip(left(&squares)).map(|(y, x)| y * x).sum();
    (points.len() > 3).then_some(product < 0.0)
}

impl Packings {
    fn at(&self, quantity: usize, solid_fraction: f64) -> f64 {
        self.0[quantity][0] + self.0[quantity][1] * (solid_fraction - 0.6)
    }

    /// κ_g at ln(R/h) by Lagrange's polynomial through the three columns.
    fn gas(&self, log: f64, solid_fraction: f64) -> f64 {
        (0..3)
            .map(|k| {
                let others = (0..3).filter(|m| *m != k);
                let weight: f64 = others.map(|m| (log - LOGS[m]) / (LOGS[k] - LOGS[m])).product();
                weight * self.at(k + 1, solid_fraction)
            })
            .sum()
    }
}

/// One bed at one temperature.
struct Series {
    name: String,
    material: String,
    temperature: f64,
    measured: f64,
    /// The intercept of all runs of the series instead.
    measured_all: f64,
    /// Standard error of `measured`, of `measured_all`; NaN for fewer than three runs.
    errors: [f64; 2],
    /// Whether a parabola through all runs bends down.
    concave: Option<bool>,
    porosity: f64,
    diameter: f64,
    emissivity: f64,
    conductivity: f64,
    modulus: f64,
    /// Mean pressure in the bed by Janssen's formula \[Pa\].
    pressure: f64,
}

/// What is taken for uncertain.
#[derive(Clone, Copy)]
struct Inputs {
    roughness: Option<f64>,
    pressure: f64,
    accommodation: f64,
    emissivity: fn(&Series) -> f64,
    /// Over that of the material.
    conductivity: f64,
    radiation: Radiation,
}

/// ε over T \[K\] of handbooks, of steel and of ceramics: heat-resistant steel after repeated heating (J. R. Thome, Radiative heat transfer, EPFL,
/// 2008) and clay (tables for pyrometers: 0.80 at 811 K, 0.75 at 1644 K; at 300 K as Zehner has it);
const DULL: [&[[f64; 2]]; 2] =
    [&[[503.0, 0.5], [1173.0, 0.7]], &[[300.0, 0.93], [811.0, 0.8], [1644.0, 0.75]]];
/// steel that was polished, and alumina: as in the materials of `msdd case new`.
const BRIGHT: [&[[f64; 2]]; 2] = [
    &[[310.0, 0.07], [530.0, 0.1], [670.0, 0.14], [1270.0, 0.38]],
    &[[400.0, 0.78], [600.0, 0.69], [800.0, 0.61], [1000.0, 0.54]],
];

/// The values of a table at its ends hold beyond them. Other materials keep theirs.
fn handbook(series: &Series, [steel, ceramic]: [&[[f64; 2]]; 2]) -> f64 {
    let rows = match series.material.as_str() {
        "steel" => steel,
        _ if is_ceramic(series) => ceramic,
        _ => return series.emissivity,
    };
    Property::Table(rows.to_vec()).at(series.temperature.clamp(rows[0][0], rows[rows.len() - 1][0]))
}

fn is_ceramic(series: &Series) -> bool {
    ["steatite", "ceramic"].contains(&series.material.as_str())
}

/// How radiation counts.
#[derive(Clone, Copy)]
enum Radiation {
    None,
    /// With the resistance of the spheres ([`msdd_beds::radiation`]).
    Resisted,
    /// 4 σ T³ d F, as of spheres of one temperature each.
    Isothermal,
    /// Beside the gas in pores of this width over d: k_g + 4 σ T³ w/(2/ε − 1) is the conductivity in the pores, which the closure for
    /// poor conductors takes; 4 σ T³ d/(2/ε − 1) is added where the law of pairs counts.
    InPores(fn(f64) -> f64),
}

/// Gas, contacts and radiation, over the conductivity of the gas: the law of pairs where the spheres conduct 60 times as well as the gas; the
/// closure for poor conductors below 20 times, and a mixture between ([`msdd_beds::effective`]).
fn prediction(series: &Series, packings: &Packings, inputs: Inputs) -> Any<[f64; 3]> {
    let phi = 1.0 - series.porosity;
    let gas = GasName::Nitrogen.at(series.temperature, 1e5, inputs.accommodation).ok_or("nitrogen")?;
    let (emissivity, solid) = ((inputs.emissivity)(series), inputs.conductivity * series.conductivity);
    let radius = 0.5 * series.diameter;
    let log = (radius / gas.least_distance(radius, solid)).ln();
    let pressure = inputs.pressure * series.pressure;
    let contact = packings.at(0, phi) * (pressure / series.modulus).cbrt();
    // The closure for roughness at the mean force: ⟨F⟩ = p π d²/(φ z).
    let force = pressure * std::f64::consts::PI * series.diameter.powi(2) / (phi * packings.at(4, phi));
    let size = |roughness: Option<f64>| {
        let roughness =
            roughness.map(|height_over_slope| Roughness { height_over_slope, hardness: HARDNESS });
        let surface = Solid { conductivity: 1.0, effective_modulus: series.modulus, roughness };
        surface.contact_size(force, 0.5 * radius)
    };
    let factor = size(inputs.roughness) / size(None);
    let ratio = solid / gas.conductivity;
    let [gap, smooth, radiating] = [
        packings.gas(log, phi),
        contact * factor * ratio,
        radiation(series.temperature, series.diameter, emissivity) / gas.conductivity,
    ];
    let touch = 0.5 * size(inputs.roughness) / radius;
    // With the conductivity of the pores over that of the gas: all conduction, and what contacts have of it.
    let conduction = |pores: f64| {
        let (share, ratio) = (share_of_pairs(ratio / pores), ratio / pores);
        let contacts = smooth * contact_factor(ratio, touch);
        (share * gap + (1.0 - share) * pores * poor_spheres(phi, ratio) + contacts, contacts, share)
    };
    let (dark, contacts, _) = conduction(1.0);
    let black = black(series.temperature, series.diameter) / gas.conductivity;
    let total = match inputs.radiation {
        Radiation::None => dark,
        Radiation::Isothermal => dark + black * exchange_factor(emissivity, phi),
        Radiation::Resisted => {
            let bed = Dark { conductivity: dark, solid: ratio, gas: 1.0, solid_fraction: phi };
            dark + bed.radiation(black, emissivity)
        }
        Radiation::InPores(width) => {
            let (bright, _, share) = conduction(1.0 + radiating * width(phi));
            bright + share * radiating
        }
    };
    Ok([dark - contacts, contacts, total - dark])
}

/// Rows of a CSV file without comments and header.
fn table(file: &Path) -> Any<Vec<Vec<String>>> {
    let text = std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    Ok(lines.map(|line| line.split(',').map(str::to_string).collect()).collect())
}

/// Temperature, Péclet number and ratio of the conductivities of a run.
type Run = (f64, f64, f64);

fn read(folder: &Path) -> Any<Vec<Series>> {
    let mut runs: BTreeMap<(String, u32), Vec<Run>> = BTreeMap::new();
    for row in table(&folder.join("measurements.csv"))? {
        let (prefix, number) = row[0].split_once('/').ok_or("run")?;
        let decade = number.parse::<u32>()? / 10 * 10;
        let numbers = (row[1].parse()?, row[2].parse()?, row[3].parse()?);
        runs.entry((prefix.to_string(), decade)).or_default().push(numbers);
    }
    let (beds, materials) = (table(&folder.join("series.csv"))?, table(&folder.join("materials.csv"))?);
    let mut all = Vec::new();
    for ((prefix, decade), points) in runs {
        let in_bed = |row: &&Vec<String>| {
            let [first, last] = [1, 2].map(|k| row[k].parse::<u32>().unwrap_or_default());
            row[0] == prefix && (first..=last).contains(&decade)
        };
        let bed = beds.iter().find(in_bed).ok_or_else(|| format!("series.csv: no {prefix}/{decade}"))?;
        let material = materials.iter().find(|row| row[0] == prefix).ok_or("materials.csv")?;
        let known = COLUMNS.iter().zip(&material[5..10]).filter_map(|(t, k)| Some([*t, k.parse().ok()?]));
        let known: Vec<[f64; 2]> = known.collect();
        let temperature = points.iter().map(|p| p.0).sum::<f64>() / points.len() as f64;
        let conductivity = match known.len() {
            1 => known[0][1],
            _ => Property::Table(known.clone()).at(temperature.clamp(known[0][0], known[known.len() - 1][0])),
        };
        let density: f64 = material[3].parse().unwrap_or(f64::NAN);
        let numbers: Vec<f64> = [3, 4, 5].iter().map(|&k| bed[k].parse()).collect::<Result<_, _>>()?;
        let (porosity, width, length) = (numbers[0], numbers[1], numbers[2]);
        let depth = width / (4.0 * WALL_FRICTION * STRESS_RATIO);
        let full = density * (1.0 - porosity) * 9.81 * depth;
        let vertical = full * (1.0 - depth / length * (1.0 - (-length / depth).exp()));
        let mut points: Vec<(f64, f64)> = points.iter().map(|p| (p.1, p.2)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let low = &points[..points.len().min(LOWEST)];
        all.push(Series {
            name: format!("{prefix}/{decade}"),
            material: material[1].clone(),
            temperature,
            measured: line(low).0,
            measured_all: line(&points).0,
            errors: [standard_error(low), standard_error(&points)],
            concave: concave(&points),
            porosity,
            diameter: material[2].parse()?,
            emissivity: material[4].parse()?,
            conductivity,
            modulus: effective_modulus(material[10].parse()?, POISSON),
            pressure: vertical * (1.0 + 2.0 * STRESS_RATIO) / 3.0,
        });
    }
    Ok(all)
}

/// A cell of a table; empty if the number is not known.
fn finite(value: f64, digits: usize) -> String {
    if value.is_finite() { format!("{value:.digits$}") } else { String::new() }
}

/// Root mean square and median of errors [%].
fn summary(mut errors: Vec<f64>) -> String {
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    errors.sort_by(f64::total_cmp);
    let middle = errors.len() / 2;
    let median =
        if errors.len() % 2 == 1 { errors[middle] } else { 0.5 * (errors[middle - 1] + errors[middle]) };
    format!("{:.1} ({:+.0})", 100.0 * rms, 100.0 * median)
}

/// How sure the intercepts are.
fn intercepts(all: &[Series]) {
    for (k, name) in ["lowest runs", "all runs"].into_iter().enumerate() {
        let value = |s: &Series| s.errors[k] / if k == 0 { s.measured } else { s.measured_all };
        let mut errors: Vec<f64> = all.iter().map(value).filter(|e| e.is_finite()).collect();
        errors.sort_by(f64::total_cmp);
        let [low, middle, high] = [1, 2, 3].map(|q| 100.0 * errors[q * errors.len() / 4]);
        println!("standard errors of intercepts, {name}: quartiles {low:.1}, {middle:.1}, {high:.1} %");
    }
    let bends: Vec<bool> = all.iter().filter_map(|s| s.concave).collect();
    println!("{} of {} series are concave", bends.iter().filter(|b| **b).count(), bends.len());
    let mut ratios: Vec<f64> = all.iter().map(|s| s.measured_all / s.measured - 1.0).collect();
    ratios.sort_by(f64::total_cmp);
    println!("all runs over the lowest: median {:+.1} %", 100.0 * ratios[ratios.len() / 2]);
}

fn main() -> Any<()> {
    let seeds = std::env::args().nth(1).map(|text| text.parse()).transpose()?;
    let folder = std::env::args().nth(2).unwrap_or_else(|| "cases/zehner".to_string());
    let folder = Path::new(&folder);
    let packings = packings(seeds, folder)?;
    let scatter = packings.0.map(|[_, _, scatter]| format!("{:.1} %", 100.0 * scatter));
    println!("scatter of packings about straight lines over the solid fraction: {}", scatter.join(", "));
    println!("(contacts; gas at ln(R/h) = 3.5, 6, 8.5; contacts per sphere)\n");
    let all = read(folder)?;
    // The roughness of the steel spheres of cases/beaulieu: Zehner gives none.
    let one = Inputs {
        roughness: Some(3.4e-7),
        pressure: 1.0,
        accommodation: 0.9,
        emissivity: |s| s.emissivity,
        conductivity: 1.0,
        radiation: Radiation::Resisted,
    };
    let smooth = Inputs { roughness: None, ..one };
    let rough = |height_over_slope| Inputs { roughness: Some(height_over_slope), ..one };
    let way = |radiation| Inputs { radiation, ..one };
    let [dull, bright]: [fn(&Series) -> f64; 2] = [|s| handbook(s, DULL), |s| handbook(s, BRIGHT)];
    let [half, double]: [fn(f64) -> f64; 2] = [pore_width, |phi| 2.0 * pore_width(phi)];
    let kinds: [(&str, Inputs); 21] = [
        ("smooth", smooth),
        ("σ/m 0.34 µm", one),
        ("σ/m 0.34 µm, pressure × 2", Inputs { pressure: 2.0, ..one }),
        ("σ/m 0.34 µm, pressure × 1/2", Inputs { pressure: 0.5, ..one }),
        ("σ/m 0.34 µm, accommodation 0.7", Inputs { accommodation: 0.7, ..one }),
        ("σ/m 0.34 µm, accommodation 1", Inputs { accommodation: 1.0, ..one }),
        ("σ/m 1 µm", rough(1e-6)),
        ("σ/m 2 µm", rough(2e-6)),
        ("σ/m 5 µm", rough(5e-6)),
        ("σ/m 20 µm", rough(20e-6)),
        ("σ/m 2 µm, emissivity × 0.8", Inputs { emissivity: |s| 0.8 * s.emissivity, ..rough(2e-6) }),
        ("σ/m 0.34 µm, emissivities of handbooks, dull", Inputs { emissivity: dull, ..one }),
        ("σ/m 2 µm, emissivities of handbooks, dull", Inputs { emissivity: dull, ..rough(2e-6) }),
        ("σ/m 0.34 µm, emissivities of handbooks, bright", Inputs { emissivity: bright, ..one }),
        ("σ/m 2 µm, conductivity of the spheres × 0.8", Inputs { conductivity: 0.8, ..rough(2e-6) }),
        ("σ/m 0.34 µm, without radiation", way(Radiation::None)),
        ("σ/m 2 µm, without radiation", Inputs { radiation: Radiation::None, ..rough(2e-6) }),
        ("σ/m 0.34 µm, radiation without resistance of the spheres", way(Radiation::Isothermal)),
        ("σ/m 0.34 µm, radiation in pores of the width 2V/S", way(Radiation::InPores(half))),
        ("σ/m 0.34 µm, radiation in pores of the width 4V/S", way(Radiation::InPores(double))),
        ("σ/m 0.34 µm, radiation in pores of the width d", way(Radiation::InPores(|_| 1.0))),
    ];
    let shown: Vec<&Series> =
        all.iter().filter(|s| !APART.iter().any(|name| s.name.starts_with(name))).collect();
    type Group = (&'static str, fn(&Series) -> bool);
    let groups: [Group; 6] = [
        ("steel < 350 K", |s| s.material == "steel" && s.temperature < 350.0),
        ("steel > 350 K", |s| s.material == "steel" && s.temperature > 350.0),
        ("steel", |s| s.material == "steel"),
        ("copper", |s| s.material == "copper"),
        ("ceramics < 350 K", |s| is_ceramic(s) && s.temperature < 350.0),
        ("ceramics > 350 K", |s| is_ceramic(s) && s.temperature > 350.0),
    ];
    let counts = groups.map(|(name, of)| format!("{name}, {}", shown.iter().filter(|s| of(s)).count()));
    println!("| error [%]: rms (median) | {} |", counts.join(" | "));
    println!("|---{}|", "|---".repeat(groups.len()));
    let correlation = |s: &Series| {
        let Some(gas) = GasName::Nitrogen.at(s.temperature, 1e5, 0.9) else { return f64::NAN };
        let radiating = radiation(s.temperature, s.diameter, s.emissivity) / gas.conductivity;
        let gaps = 1.0 / (1.0 + gas.jump_length() / s.diameter);
        zehner_bauer_schluender(s.porosity, s.conductivity / gas.conductivity, radiating, gaps)
    };
    let row = |name: &str, all: bool, value: &dyn Fn(&Series) -> f64| {
        let errors = |of: fn(&Series) -> bool| {
            let members = shown.iter().filter(|s| of(s));
            let error = |s: &Series| value(s) / if all { s.measured_all } else { s.measured } - 1.0;
            summary(members.map(|s| error(s)).collect())
        };
        println!("| {name} | {} |", groups.map(|(_, of)| errors(of)).join(" | "));
    };
    let sum = |s: &Series, inputs| prediction(s, &packings, inputs).map_or(f64::NAN, |p| p.iter().sum());
    row("Zehner, Bauer, Schlünder", false, &correlation);
    for (name, inputs) in kinds {
        row(name, false, &|s| sum(s, inputs));
    }
    row("all runs: Zehner, Bauer, Schlünder", true, &correlation);
    row("all runs: smooth", true, &|s| sum(s, smooth));
    row("all runs: σ/m 0.34 µm", true, &|s| sum(s, one));
    intercepts(&all);
    let mut text = "series,material,temperature,porosity,pressure,ratio,measured,measured_all_runs,gas,contacts_smooth,contacts_rough,radiation,prediction_smooth,prediction_rough,correlation\n".to_string();
    for s in &all {
        let (rough, [gas, contacts, radiating]) =
            (prediction(s, &packings, one)?[1], prediction(s, &packings, smooth)?);
        let conductivity = GasName::Nitrogen.at(s.temperature, 1e5, 0.9).ok_or("nitrogen")?.conductivity;
        let sums = [gas + contacts + radiating, gas + rough + radiating];
        let numbers =
            [s.measured, s.measured_all, gas, contacts, rough, radiating, sums[0], sums[1], correlation(s)];
        writeln!(
            text,
            "{},{},{:.0},{},{},{:.0},{}",
            s.name,
            s.material,
            s.temperature,
            s.porosity,
            finite(s.pressure, 0),
            s.conductivity / conductivity,
            numbers.map(|x| finite(x, 2)).join(",")
        )?;
    }
    std::fs::write(folder.join("prediction.csv"), text)?;
    Ok(())
}
