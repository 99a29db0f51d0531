//! Temporary: fits the law and prints its errors.

use crate::error::CliError;
use crate::tracks::tracks;
use clap::Args;
use msdd_rve::database::read_all;
use msdd_surrogate::increment::core::Core;
use msdd_surrogate::increment::fit::{PathFit, fit, readout};
use msdd_surrogate::increment::paths::{Track, follow, stresses};
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    #[arg(long, required = true)]
    database: Vec<PathBuf>,
    #[arg(long, default_value_t = 60)]
    epochs: u32,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let mut all: Vec<Track> = Vec::new();
    for (k, path) in arguments.database.iter().enumerate() {
        let dataset = read_all(std::slice::from_ref(path))?;
        let mut some = tracks(&dataset.records);
        some.iter_mut().for_each(|track| track.packing += 1_000_000 * k as i64);
        all.extend(some);
    }
    let steps: usize = all.iter().map(|track| track.steps.len()).sum();
    outln!("{} tracks, {steps} steps", all.len());
    let (seen, unseen): (Vec<Track>, Vec<Track>) = all.into_iter().partition(|track| track.packing % 3 != 0);
    let problem = PathFit { tracks: &seen, threads: 2 };
    let begin = std::time::Instant::now();
    let (law, minimum) = fit(&problem, arguments.epochs, |epoch, square| {
        if epoch % 5 == 0 {
            eprintln!("{epoch} {square:.6e} {:.0} s", begin.elapsed().as_secs_f64());
        }
    });
    outln!("{law:?} {:?} {} {:e}", minimum.stopping, minimum.epochs, minimum.mean_square);
    let blank = Core { law: law.clone(), readout: Default::default() };
    let core = Core { readout: readout(&law, &seen, &follow(&blank, &seen)), law };
    outln!("{:?}", core.readout);
    let states = follow(&core, &unseen);
    for (lo, hi) in [(0.06, 0.09), (0.09, 0.13), (0.13, 0.16), (0.16, 0.2)] {
        for name in ["up", "down"] {
            let mut sums: std::collections::BTreeMap<i64, [f64; 4]> = Default::default();
            for (track, states) in unseen
                .iter()
                .zip(&states)
                .filter(|(t, _)| t.name == name && (lo..hi).contains(&t.packed.porosity))
            {
                let found = stresses(&core, states);
                let mut e = 1.0;
                for (k, step) in track.steps.iter().enumerate().filter(|(_, s)| s.to.load_bearing) {
                    e *= 1.0 + step.strain[0];
                    let data = step.to.invariants();
                    let sum = sums.entry(((e - 1.0) * 1e4f64).round() as i64).or_default();
                    sum[0] += found[k + 1][0];
                    sum[1] += data[0];
                    sum[2] += (found[k + 1][0] / data[0] - 1.0).powi(2);
                    sum[3] += 1.0;
                }
            }
            for (e, s) in sums {
                if e.abs() >= 100 {
                    outln!(
                        "{lo} {name} {:.3} bias {:+.4} rms {:.4}",
                        e as f64 * 1e-4,
                        s[0] / s[1] - 1.0,
                        (s[2] / s[3]).sqrt()
                    );
                }
            }
        }
    }
    let mut names: Vec<(String, usize)> = unseen.iter().map(|t| (t.name.clone(), t.discs)).collect();
    names.sort();
    names.dedup();
    for (name, discs) in names {
        let (mut sums, mut count) = ([0.0; 5], 0.0);
        for (track, states) in unseen.iter().zip(&states).filter(|(t, _)| t.name == name && t.discs == discs)
        {
            let found = stresses(&core, states);
            let scale = 1.0 / (track.pressure() + 0.003);
            for (k, step) in track.steps.iter().enumerate().filter(|(_, s)| s.to.load_bearing && !s.probe) {
                let data = step.to.invariants();
                let e: Vec<f64> = (0..3).map(|c| (found[k + 1][c] - data[c]) * scale).collect();
                sums[0] += e[0] * e[0];
                sums[1] += e[1] * e[1] + e[2] * e[2];
                sums[2] += (states[k + 1][0] - step.to.porosity).powi(2);
                sums[3] += (states[k + 1][1] - step.to.fabric_index).powi(2);
                count += 1.0;
            }
        }
        let r = |k: usize| (sums[k] / f64::max(count, 1.0)).sqrt();
        outln!(
            "{name:12} {discs:5} p {:.2} q {:.2} % porosity {:.5} fabric {:.4} ({count})",
            100.0 * r(0),
            100.0 * r(1),
            r(2),
            r(3)
        );
    }
    Ok(())
}
