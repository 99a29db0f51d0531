//! Everything that is read from outside, model file, state and plan, under mutations of a corpus: no panic, and what is
//! accepted is sound. The same mutations in every run; MSDD_FUZZ sets their number a reader (scripts/test --full takes many).
//!
//! A finding is written to the target folder; add it to `corpus/` (files there are tried as they are, too).
#![allow(unsafe_code)] // the C interface is what is tested

mod common;

use ::msdd_rve::database::Plan;
use common::{Cells, Model, OK, last_error};
use msdd::abi::{self, msdd_averages, msdd_rve};
use msdd::exports::*;
use std::ffi::CString;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::ptr::null_mut;

const INTERNAL: i32 = abi::MSDD_INTERNAL as i32;

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// What a number or a value may be replaced by: edges of types, of ranges, and of belief.
const TOKENS: [&str; 34] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "0.5",
    "0.12",
    "-0.5",
    "1e-3",
    "1e3",
    "1e6",
    "1e-300",
    "5e-324",
    "1e300",
    "-1e300",
    "1.7976931348623157e308",
    "1e999",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "-9223372036854775808",
    "NaN",
    "nan",
    "inf",
    "null",
    "true",
    "\"\"",
    "\"walls\"",
    "[]",
    "{}",
    "[0,0]",
    "1000000",
];

/// Start and end of the numbers of a text.
fn numbers(text: &[u8]) -> Vec<(usize, usize)> {
    let part = |byte: u8| byte.is_ascii_digit() || b"+-.eE".contains(&byte);
    let mut found = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let end = at + text[at..].iter().take_while(|byte| part(**byte)).count();
        if text[at..end].iter().any(u8::is_ascii_digit) {
            found.push((at, end));
        }
        at = end.max(at + 1);
    }
    found
}

/// One to four changes of a text: mostly numbers, since other damage does not get far.
fn mutated(text: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut text = text.to_vec();
    for _ in 0..=random.below(4) {
        let places = numbers(&text);
        let (at, length) = (random.below(text.len()), random.below(40));
        let end = (at + length).min(text.len());
        match random.below(12) {
            0 => text.truncate(at),
            1 => drop(text.drain(at..end)),
            2 => {
                let copy = text[at..end].to_vec();
                text.splice(at..at, copy);
            }
            3 if !text.is_empty() => text[at] ^= 1 << random.below(8),
            4 => {
                let from = random.below(other.len());
                let part = other[from..(from + length).min(other.len())].to_vec();
                text.splice(at..end, part);
            }
            _ if !places.is_empty() => {
                let (start, end) = places[random.below(places.len())];
                text.splice(start..end, TOKENS[random.below(TOKENS.len())].bytes());
            }
            _ => (),
        }
    }
    text
}

/// The corpus of a reader: its folder, and texts from elsewhere.
fn corpus(folder: &str, more: &[PathBuf]) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(folder);
    let listed = std::fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("readable").path());
    let mut files: Vec<PathBuf> = listed.chain(more.iter().cloned()).collect();
    files.sort();
    files.iter().map(|file| std::fs::read(file).expect("readable")).collect()
}

/// Tries the corpus and its mutations; `check` says why an input is a finding. Returns how many were accepted.
fn fuzz(name: &str, corpus: &[Vec<u8>], usual: usize, check: fn(&str) -> Result<bool, String>) -> usize {
    let wanted = std::env::var("MSDD_FUZZ").ok().and_then(|text| text.parse().ok());
    let mut random = Random(7);
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}"));
    let mut accepted = 0;
    let count = wanted.unwrap_or(usual);
    for trial in 0..corpus.len() + count {
        let input = match corpus.get(trial) {
            Some(text) => text.clone(),
            None => {
                let other = random.below(corpus.len());
                mutated(&corpus[random.below(corpus.len())], &corpus[other], &mut random)
            }
        };
        let Ok(text) = String::from_utf8(input) else { continue };
        // Written first: an input that ends the process is found, too.
        std::fs::write(&file, &text).expect("writable");
        let result = catch_unwind(|| check(&text)).unwrap_or_else(|_| Err("panic".to_string()));
        match result {
            Ok(good) => accepted += usize::from(good),
            Err(why) => panic!("trial {trial} of {name}: {why}; the input is in {}", file.display()),
        }
    }
    println!("{name}: {count} mutations, {accepted} accepted");
    accepted
}

/// A model that is accepted answers cells inside and far outside of its range with numbers that grains have.
fn model(text: &str) -> Result<bool, String> {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz-model-file");
    std::fs::write(&file, text).expect("writable");
    let model = match Model::load(&file.to_string_lossy()) {
        Ok(model) => model,
        Err((INTERNAL, message)) => return Err(message),
        Err(_) => return Ok(false),
    };
    let mut cells = Cells::new(&model, 24);
    for (cell, value) in [1e-3, 0.9, -1.0, 1e6, -1e200, f64::MAX].into_iter().enumerate() {
        cells.state[cell % 2][cell] = value;
        cells.thermal_strain[6 + cell] = value.clamp(-0.9, 1e6);
        cells.state.last_mut().expect("columns")[12 + cell] = value;
    }
    for _ in 0..3 {
        match cells.advance_with(&model, |_| ()) {
            OK => (),
            _ => return Err(last_error()),
        }
        let finite = cells.next.iter().chain(&cells.outputs[..4]).flatten().all(|value| value.is_finite());
        let grains = cells.outputs[..2].iter().flatten().all(|k| *k > 0.0)
            && cells.outputs[2..4].iter().flatten().all(|s| *s >= 0.0);
        let tangent =
            !model.has_tangent() || cells.outputs[4..].iter().flatten().all(|value| value.is_finite());
        let spread = cells.spread.iter().all(|s| s.is_nan() || *s >= 0.0);
        if !(finite && grains && tangent && spread) {
            let found = (finite, grains, tangent, spread);
            return Err(format!(
                "accepted, but (finite, grains, tangent, spread) = {found:?}: {:?}",
                cells.outputs
            ));
        }
        cells.state.clone_from(&cells.next);
    }
    let (porosity, mut solid) = ([0.0, 0.1, 0.9], [f64::NAN; 3]);
    // SAFETY: live handle, columns of three.
    let status = unsafe { msdd_surrogate_solid_fraction(model.0, 3, porosity.as_ptr(), solid.as_mut_ptr()) };
    match status == OK && solid.iter().all(|s| s.is_finite()) {
        true => Ok(true),
        false => Err(format!("accepted, but its solid fractions are {solid:?}")),
    }
}

/// A state that is accepted has finite averages, and its own text is the same state.
fn state(text: &str) -> Result<bool, String> {
    let Ok(text) = CString::new(text) else { return Ok(false) };
    let mut rve = null_mut();
    // SAFETY: a C string, and `rve` is writable.
    match unsafe { msdd_rve_from_json(text.as_ptr(), &mut rve) } {
        OK => (),
        INTERNAL => return Err(last_error()),
        _ => return Ok(false),
    }
    // SAFETY: live, and freed once.
    let result = unsafe {
        let result = sound(rve);
        msdd_rve_free(rve);
        result
    };
    result.map(|()| true)
}

/// # Safety
/// A live handle.
unsafe fn sound(rve: *mut msdd_rve) -> Result<(), String> {
    // SAFETY: live handles by this function's contract, a struct of numbers, and writable outputs.
    unsafe {
        let mut averages: msdd_averages = std::mem::zeroed();
        averages.struct_size = size_of::<msdd_averages>();
        let status = msdd_rve_homogenise(rve, &mut averages);
        if status == INTERNAL {
            return Err(last_error());
        }
        let numbers = [averages.porosity, averages.fabric_index, averages.conductivity_xx, averages.pressure];
        if status == OK && !numbers.iter().all(|value| value.is_finite()) {
            return Err(format!("accepted, but its averages are {averages:?}"));
        }
        let (mut first, mut again, mut second) = (null_mut(), null_mut(), null_mut());
        if msdd_rve_to_json(rve, &mut first) != OK || msdd_rve_from_json(first, &mut again) != OK {
            return Err(format!("accepted, but its own text is not: {}", last_error()));
        }
        assert_eq!(msdd_rve_to_json(again, &mut second), OK);
        let same = common::text(first) == common::text(second);
        msdd_rve_free(again);
        msdd_text_free(first);
        msdd_text_free(second);
        if same { Ok(()) } else { Err("accepted, but its text changes when read".to_string()) }
    }
}

/// A plan that is accepted has packings that may be made, of stops that are numbers.
fn plan(text: &str) -> Result<bool, String> {
    let Ok(plan) = Plan::parse(text, "plan") else { return Ok(false) };
    let jobs = plan.jobs();
    let sound = jobs.iter().all(|job| {
        job.spec.discs > 0
            && job.spec.porosity > 0.0
            && job.spec.porosity < 1.0
            && job.stops.iter().all(|s| s.is_finite())
    });
    match !jobs.is_empty() && jobs.len() <= 1_000_000 && sound && plan.mean_radius() > 0.0 {
        true => Ok(true),
        false => Err(format!("accepted, but {} packings, sound: {sound}", jobs.len())),
    }
}

#[test]
fn model_files() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../surrogate/models");
    let corpus = corpus("models", &[models.join("state.json"), models.join("paper.json")]);
    assert!(fuzz("models", &corpus, 500, model) > 50);
}

#[test]
fn states() {
    assert!(fuzz("states", &corpus("states", &[]), 3000, state) > 50);
}

#[test]
fn plans() {
    let plans = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/database");
    let corpus = corpus("plans", &["tiny.toml", "quick.toml"].map(|name| plans.join(name)));
    assert!(fuzz("plans", &corpus, 3000, plan) > 50);
}
