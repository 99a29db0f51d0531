//! Closed circles of strain and other paths, by discs and by the law of the increments from the same states.
//!
//!     cargo run --release -p msdd-report --example circles -- discs FILE   # some minutes
//!     cargo run --release -p msdd-report --example circles -- law FILE [MODEL.json]   # a second; prints the tables
//!
//! `discs` packs periodic boxes of 500 discs, strains them, and writes what they are after each strain as JSON. `law` starts
//! from porosity, fabric, stress and conductivity of the same packings and follows the same strains, each in ten parts.

use msdd_rve::database::paths::{Steps, planned};
use msdd_rve::database::plan::RampName;
use msdd_rve::{Averages, Boundary, Compression, Material, PackingSpec, Preparation, Protocol};
use msdd_rve::{Strains, follow, homogenise, pack_as, region::RegionKind};
use msdd_surrogate::surrogate::{Answer, Increment, InitialData, Surrogate};
use msdd_surrogate::{kernel::LANES, models};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Porosity and compression of the packings, of which there are two each.
const PACKINGS: [(f64, Compression); 5] = [
    (0.12, Compression::Isotropic),
    (0.16, Compression::Isotropic),
    (0.12, Compression::Horizontal),
    (0.16, Compression::Horizontal),
    (0.18, Compression::Horizontal),
];
/// Friction angle of the grains while they are packed [rad]: that of the beds of this project.
const PACKING_FRICTION: f64 = 0.398;
/// Circles, their radius [-] and the chords of each.
const CIRCLES: usize = 40;
const RADIUS: f64 = 0.005;
const CHORDS: usize = 20;
/// Parts in which the law applies a strain.
const PARTS: usize = 10;
const PATHS: [RampName; 4] = [RampName::Biaxial, RampName::Shear, RampName::Turning, RampName::Mixed];

#[derive(Serialize, Deserialize)]
struct Run {
    packing: String,
    seed: u64,
    path: String,
    /// The packing, then the state after each strain.
    states: Vec<State>,
}

/// Strains since the packing (radii, xx, yy, xy), porosity, F_xx − F_yy, F_xy, reduced stress and K/k: xx, yy, xy.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct State {
    strain: [f64; 4],
    porosity: f64,
    fabric: [f64; 2],
    stress: [f64; 3],
    conductivity: [f64; 3],
}

impl State {
    fn of(strains: Strains, a: &Averages, young_modulus: f64) -> Self {
        let stress = [a.stress_xx, a.stress_yy, 0.5 * (a.stress_xy + a.stress_yx)];
        Self {
            strain: [strains.thermal, strains.xx, strains.yy, strains.xy],
            porosity: a.porosity,
            fabric: [a.fabric_index, a.fabric_xy],
            stress: stress.map(|stress| stress / (young_modulus * a.mean_radius)),
            conductivity: [a.conductivity_network_xx, a.conductivity_network_yy, a.conductivity_network_xy],
        }
    }

    fn pressure(&self) -> f64 {
        0.5 * (self.stress[0] + self.stress[1])
    }

    fn anisotropy(&self) -> f64 {
        self.conductivity[0] / self.conductivity[1]
    }
}

/// Circles through the packing in the plane of xx and yy, which begin along yy with this sign.
fn circles(sense: f64) -> Vec<Strains> {
    let at = |k: usize| {
        let (sin, cos) = (2.0 * PI * (k % CHORDS) as f64 / CHORDS as f64).sin_cos();
        Strains { xx: RADIUS * (1.0 - cos), yy: sense * RADIUS * sin, ..Strains::default() }
    };
    (1..=CIRCLES * CHORDS).map(at).collect()
}

/// Paths by name: circles of both senses, radii less by 4 %, larger by 6 % and back, and paths of the databases.
fn paths() -> Vec<(String, Vec<Strains>)> {
    let swing = |from: i32, to: i32| (1..=20).map(move |k| 5e-4 * f64::from(20 * from + k * (to - from)));
    let swing = swing(0, -4).chain(swing(-4, 6)).chain(swing(6, 0));
    let steps = Steps { size: 1e-3, probes: Vec::new(), probe_every: 1 };
    let mut all: Vec<(String, Vec<Strains>)> = PATHS
        .map(|path| {
            let rows = planned(path, 1, &steps, false);
            (path.to_string(), rows.iter().map(|row| row.strains).collect())
        })
        .into();
    all.push(("swing".to_string(), swing.map(Strains::thermal).collect()));
    all.push(("circle +".to_string(), circles(1.0)));
    all.push(("circle -".to_string(), circles(-1.0)));
    all
}

fn discs(which: (f64, Compression), seed: u64) -> Vec<Run> {
    let (porosity, compression) = which;
    let (boundary, material) = (Boundary::Periodic, Material::default());
    let spec = PackingSpec { seed, porosity, compression, boundary, ..PackingSpec::default() };
    let preparation = Preparation { friction_angle: Some(PACKING_FRICTION), ..Preparation::default() };
    let packed = pack_as(&spec, &preparation, &material).expect("packs").simulation;
    // The grains' own motion: FIRE lets a few contacts slide at every stop, which adds up in hundreds of them.
    let protocol = Protocol::usual(&packed);
    let mut runs = Vec::new();
    for (path, strains) in paths() {
        let start = homogenise(&packed, RegionKind::default());
        let mut states = vec![State::of(Strains::default(), &start, material.young_modulus)];
        let ramp = follow(&mut packed.clone(), &strains, protocol, |stop, _| {
            states.push(State::of(stop.strains, &stop.averages, material.young_modulus));
        });
        assert!(ramp.expect("allowed strains").failure.is_none(), "{porosity} {compression:?} {path}");
        eprintln!("{porosity} {compression:?} {path}: p {:.0}", start.pressure);
        runs.push(Run { packing: format!("{porosity} {compression:?}"), seed, path, states });
    }
    runs
}

/// The states of the law along a run.
fn law(model: &dyn Surrogate, run: &Run) -> Vec<State> {
    let start = &run.states[0];
    let mut block = model
        .initial_state(&InitialData {
            porosity: start.porosity,
            fabric_index: start.fabric[0],
            fabric_xy: start.fabric[1],
            reduced_stress: Some(start.stress),
            conductivity: Some(start.conductivity),
        })
        .map(|value| [value; LANES]);
    let (mut states, mut answer) = (vec![*start], Answer::default());
    for pair in run.states.windows(2) {
        let (from, to) = (pair[0].strain, pair[1].strain);
        let at = |k: usize, part: usize| from[k] + (to[k] - from[k]) * part as f64 / PARTS as f64;
        for part in 0..PARTS {
            let relative = |k: usize| (at(k, part + 1) - at(k, part)) / (1.0 + at(k, part));
            // See `Strains::then`.
            let xy = (at(3, part + 1) - at(3, part) * (1.0 + relative(1))) / (1.0 + at(2, part));
            let [thermal, xx, yy, xy, rotation] =
                [relative(0), relative(1), relative(2), xy, -0.5 * xy].map(|value| [value; LANES]);
            let strain = Increment { thermal, xx, yy, xy, rotation };
            model.advance(&block, &strain, &mut answer, None);
            block = answer.state;
        }
        let (stress, conductivity) = (answer.stress.map(|s| s[0]), answer.conductivity.map(|k| k[0]));
        states.push(State { strain: to, stress, conductivity, ..*start });
    }
    states
}

/// Root mean square difference of the changes of stress over the first pressure, and of conductivity over its first mean [%].
fn difference(a: &[State], b: &[State]) -> [f64; 2] {
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for (x, y) in a.iter().zip(b).skip(1) {
        let change = |now: &State, first: &State, k: usize| {
            let mean = 0.5 * (first.conductivity[0] + first.conductivity[1]);
            let stress = (now.stress[k] - first.stress[k]) / first.pressure();
            [stress, (now.conductivity[k] - first.conductivity[k]) / mean]
        };
        for k in 0..3 {
            let (x, y) = (change(x, &a[0], k), change(y, &b[0], k));
            (0..2).for_each(|q| sums[q] += (x[q] - y[q]).powi(2));
        }
        count += 3.0;
    }
    sums.map(|sum| 100.0 * (sum / count).sqrt())
}

fn tables(model: &dyn Surrogate, runs: &[Run]) {
    let percent = |law: f64, discs: f64| 100.0 * (law / discs - 1.0);
    println!("circles: p as packed, after 10 and 40: law/discs, error [%]; K_xx/K_yy after 40: the same");
    let mut worst = [0.0f64; 3];
    for run in runs.iter().filter(|run| run.path.contains("circle")) {
        let law = law(model, run);
        let [ten, all] = [10, CIRCLES].map(|turns| turns * CHORDS);
        let scale = 1e7 * 5e-3; // p of grains of 10 MPa and 5 mm [Pa]
        let p = |k: usize| (scale * law[k].pressure(), scale * run.states[k].pressure());
        let k = (law[all].anisotropy(), run.states[all].anisotropy());
        let errors = [percent(p(ten).0, p(ten).1), percent(p(all).0, p(all).1), percent(k.0, k.1)];
        worst = std::array::from_fn(|n| worst[n].max(errors[n].abs()));
        println!(
            "{:16} {} {}: {:6.0} | {:6.0}/{:6.0} {:+6.1} | {:6.0}/{:6.0} {:+6.1} | {:.3} {:.3}/{:.3} {:+6.1}",
            run.packing,
            run.seed,
            run.path,
            p(0).1,
            p(ten).0,
            p(ten).1,
            errors[0],
            p(all).0,
            p(all).1,
            errors[1],
            run.states[0].anisotropy(),
            k.0,
            k.1,
            errors[2]
        );
    }
    println!("largest: {:.1} {:.1} {:.1}", worst[0], worst[1], worst[2]);
    println!("swing: error of p at -4 %, +6 % and back [%]");
    for run in runs.iter().filter(|run| run.path == "swing") {
        let law = law(model, run);
        let errors = [20, 40, 60].map(|k| percent(law[k].pressure(), run.states[k].pressure()));
        println!("{:16} {}: {:+.1} {:+.1} {:+.1}", run.packing, run.seed, errors[0], errors[1], errors[2]);
    }
    println!(
        "paths: rms of stress and K [%], of the law from the discs; of the two packings from each other"
    );
    for run in runs.iter().filter(|run| PATHS.iter().any(|path| path.to_string() == run.path)) {
        let twin = runs.iter().find(|r| r.seed != run.seed && r.packing == run.packing && r.path == run.path);
        let (own, twins) =
            (difference(&law(model, run), &run.states), twin.map(|r| difference(&run.states, &r.states)));
        println!(
            "{:16} {} {:8}: {:.1?} {:.1?}",
            run.packing,
            run.seed,
            run.path,
            own,
            twins.unwrap_or_default()
        );
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [what, file, rest @ ..] = arguments.as_slice() else { panic!("discs FILE or law FILE [MODEL.json]") };
    let read = |file: &String| std::fs::read_to_string(file).expect("readable");
    if what == "discs" {
        let runs: Vec<Run> = [1, 2]
            .into_iter()
            .flat_map(|seed| PACKINGS.into_iter().flat_map(move |which| discs(which, seed)))
            .collect();
        std::fs::write(file, serde_json::to_string(&runs).expect("finite")).expect("writable");
    } else {
        let model = match rest {
            [] => models::builtin(models::BUILTIN),
            [model, ..] => models::read(&read(model)),
        };
        tables(&*model.expect("a model"), &serde_json::from_str::<Vec<Run>>(&read(file)).expect("runs"));
    }
}
