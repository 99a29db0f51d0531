//! `msdd bed run` of a folder with `bed.toml`: a bed whose walls move while heat flows.

use super::arguments::RunArguments;
use crate::confirm;
use crate::error::CliError;
use crate::progress::Progress;
use msdd_beds::case::{BedCase, file_in};
use msdd_beds::cost::estimate;
use msdd_beds::coupled::{MAX_OVERLAP, Prepared, Row, Run, prepare, run, side_friction};
use msdd_beds::exchange::Exchange;
use msdd_beds::mobilised::mobilised;
use msdd_beds::packings::{at_start, join};
use msdd_beds::rows::elements;
use msdd_files::{check_writable, read_text, write};
use msdd_surrogate::document::hash;
use std::path::Path;
use std::time::Instant;

/// Names of the files of results: of one packing or the mean of several, and the scatter of several.
const RESULTS: &str = "dem.csv";
const SCATTER: &str = "dem-scatter.csv";
/// Shares of the stages and of the run in the progress, in hundredths.
const STAGES: [(&str, u64, u64); 3] = [("pour", 0, 20), ("lid", 20, 5), ("harden", 25, 15)];
const RUN: u64 = 40;

/// Asks before packings of a bed that take long.
fn ask(arguments: &RunArguments, scene: &BedCase, packings: f64) -> Result<(), CliError> {
    let advice = "Fewer spheres (grains.number, with a smaller base or radius), a softer simulated_young_modulus, or fewer intervals and \
                  steps take less";
    let seconds = packings * estimate(scene, arguments.threads as usize).seconds;
    confirm::long_run(seconds, advice, arguments.yes)
}

/// Computes a bed, writes [`RESULTS`] into `out`, and prints a summary.
pub fn compute(arguments: &RunArguments, out: &Path) -> Result<(), CliError> {
    let scene = scene(arguments)?;
    ask(arguments, &scene, 1.0)?;
    let target = out.join(RESULTS);
    check_writable(&target)?;
    let text = simulate(arguments, &scene)?;
    write(&target, text.as_bytes())?;
    outln!("results: {}", target.display());
    Ok(())
}

/// The same for packings with this number of seeds, from that of the case on: writes the mean and the standard deviation, and keeps
/// each packing's results, which are not computed again if they are of the same case and program.
pub fn compute_packings(arguments: &RunArguments, count: u32, out: &Path) -> Result<(), CliError> {
    let first = scene(arguments)?;
    ask(arguments, &first, f64::from(count))?;
    let last = first.seed.checked_add(u64::from(count) - 1).filter(|&last| i64::try_from(last).is_ok());
    let last = last.ok_or_else(|| {
        CliError::Message(format!("--packings {count}: seeds from {} on would be too large", first.seed))
    })?;
    let seeds: Vec<u64> = (first.seed..=last).collect();
    let file = |seed: u64| out.join(format!("dem-{seed}.csv"));
    let targets = [out.join(RESULTS), out.join(SCATTER)];
    for target in targets.iter().cloned().chain(seeds.iter().map(|&seed| file(seed))) {
        check_writable(&target)?;
    }
    let input = read_text(&file_in(&arguments.case))?;
    let mut tables = Vec::new();
    for (number, &seed) in seeds.iter().enumerate() {
        let (begin, target) = (origin(&input, seed), file(seed));
        if let Some(known) = read_text(&target).ok().filter(|text| text.starts_with(&begin)) {
            outln!("packing {} of {count}, seed {seed}: taken from {}", number + 1, target.display());
            tables.push(known);
            continue;
        }
        outln!("packing {} of {count}, seed {seed}", number + 1);
        let text = begin + &simulate(arguments, &BedCase { seed, ..first.clone() })?;
        write(&target, text.as_bytes())?;
        tables.push(text);
    }
    let joined = join(&seeds, &tables)
        .ok_or_else(|| CliError::Message(format!("{}: packings with other rows", out.display())))?;
    write(&targets[0], joined.mean.as_bytes())?;
    write(&targets[1], joined.scatter.as_bytes())?;
    let known = |name: &str| at_start(&joined.mean, name).unwrap_or(f64::NAN);
    out!("{}", start(&first, known("mobilisation"), ["fabric_1", "fabric_2", "fabric_3"].map(known)));
    outln!("results: {}, {}", targets[0].display(), targets[1].display());
    Ok(())
}

/// The first line of the results of a packing that is one of several: what they were computed from.
fn origin(input: &str, seed: u64) -> String {
    format!("# of {}, seed {seed}, engine {}\n", hash(input), msdd_beds::ENGINE_VERSION)
}

fn scene(arguments: &RunArguments) -> Result<BedCase, CliError> {
    let scene = BedCase::read(&arguments.case)?;
    Ok(BedCase { seed: arguments.seed.unwrap_or(scene.seed), ..scene })
}

/// The table of a packing; prints a summary.
fn simulate(arguments: &RunArguments, scene: &BedCase) -> Result<String, CliError> {
    let failed = |source| CliError::Bed { file: file_in(&arguments.case), source };
    let mut progress = Progress::new("bed", 1000);
    let mut show = |percent: f64, note: &str| progress.set((10.0 * percent) as u64, 1000, note);
    let begin = Instant::now();
    let prepared = prepare(scene, arguments.threads as usize, |stage, share| {
        let (_, from, width) = STAGES.into_iter().find(|known| known.0 == stage).unwrap_or(STAGES[0]);
        show(from as f64 + width as f64 * share.min(0.999), stage);
    });
    let prepared = prepared.map_err(failed)?;
    let ready = begin.elapsed().as_secs_f64();
    let found =
        run(scene, &prepared, |share| show(RUN as f64 + (100 - RUN) as f64 * share.min(0.999), "heat"));
    let found = found.map_err(failed)?;
    progress.finish();
    print(scene, &prepared, &found);
    outln!("{ready:.0} s to prepare the bed, {:.0} s to heat it", begin.elapsed().as_secs_f64() - ready);
    Ok(elements(scene, &prepared, &found))
}

/// What the law of spheres needs to know of the start, in words.
fn start(scene: &BedCase, mobilisation: f64, [first, second, third]: [f64; 3]) -> String {
    let axes = if scene.record.radius.is_some() { "radius, around the axis, axis" } else { "x, y, z" };
    format!(
        "friction at the start: {mobilisation:.3} of the force at which the contacts slide, for the law of spheres 'mobilised {:.2};'\n\
         fabric at the start (key 'fabric'): {first:.4}, {second:.4}, {third:.4} along {axes}\n",
        mobilised(mobilisation)
    )
}

fn print(scene: &BedCase, prepared: &Prepared, found: &Run) {
    outln!("{} grains, seed {}", prepared.simulation.spheres.len(), scene.seed);
    for (stage, rest) in &prepared.stages {
        outln!("{stage:<8}{:>9} steps", rest.steps);
    }
    outln!("    t [s]   T mean [K]   p [kPa]   lid [kPa]   porosity   contacts   K [W/(m K)]");
    let shown = (found.rows.len() / 10).max(1);
    let lid = scene.wall("lid").unwrap_or_default();
    let line = |row: &Row| {
        let p = row.stress.iter().sum::<f64>() / 3.0;
        outln!(
            "{:>9.0}   {:>10.2}   {:>7.2}   {:>9.2}   {:>8.4}   {:>8.3}   {:>11.4}",
            row.time,
            row.mean_temperature,
            1e-3 * p,
            1e-3 * row.walls[lid],
            row.porosity,
            row.coordination,
            row.conductivity()
        );
    };
    found.rows.iter().step_by(shown).for_each(line);
    let worst = found.rows.iter().map(|row| row.unbalanced).fold(0.0, f64::max);
    outln!("largest force out of balance: {:.2} % of that on the lid", 100.0 * worst);
    if found.overlap > MAX_OVERLAP {
        outln!(
            "Warning: spheres overlap by up to {:.1} % of their radius; Hertz's law is an extrapolation above {:.0} %, and forces and \
             stresses are too low",
            100.0 * found.overlap,
            100.0 * MAX_OVERLAP
        );
    }
    if found.hurried + found.restless > 0 {
        outln!(
            "Warning: in {} intervals the motion was cut short {} times and ended {} times before the bed was near rest: contacts slid that would not slide \
             at rest, and stresses may be off by tens of percent. Take shorter intervals, or more 'steps' in each.",
            found.intervals,
            found.hurried,
            found.restless
        );
    }
    if let Some(row) = found.rows.first() {
        out!("{}", start(scene, row.mobilisation, row.fabric));
    }
    if scene.grains.wall_friction > 0.0 {
        let known = || found.rows.iter().filter_map(|row| side_friction(scene, row));
        let (most, least) = (known().fold(f64::NAN, f64::max), known().fold(f64::NAN, f64::min));
        if most.is_finite() {
            outln!(
                "friction of the side over its normal force: {least:.3} to {most:.3} (above 0: it holds the bed down)"
            );
        }
    }
    let peak = found.rows.iter().map(|row| row.peak).fold(f64::NAN, f64::max);
    let yielding = found.rows.iter().map(|row| row.yielding).fold(0.0, f64::max);
    if peak > 1.0 {
        outln!(
            "Note: up to {:.2} % of the contacts yield; Hertz's peak stress is up to {peak:.2} times that at which yielding begins",
            100.0 * yielding
        );
    } else if peak.is_finite() {
        outln!("Hertz's peak stress is at most {peak:.2} of that at which yielding begins");
    }
    let noise = prepared.exchange.as_ref().and_then(Exchange::warning);
    for said in scene.closure().into_iter().chain(scene.varying_emissivity()).chain(noise) {
        outln!("Note: {said}");
    }
}
