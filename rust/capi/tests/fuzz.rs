//! Everything that is read from outside, texts under mutations of a corpus, and the columns of batches and the tables of
//! plug-ins at random: no panic, and what is accepted is sound. The same trials in every run, whatever the number of threads;
//! MSDD_FUZZ sets their number a reader (scripts/test --full takes many; a million of them takes minutes).
//!
//! A finding is written to the target folder; add it to `corpus/` (files there are tried as they are, too).
#![allow(unsafe_code)] // the C interface is what is tested

mod common;

use ::msdd_rve::database::Plan;
use common::{Cells, Model, OK, last_error, plugin};
use msdd::abi::{self, msdd_averages, msdd_rve};
use msdd::exports::*;
use std::ffi::{CString, c_void};
use std::io::Write;
use std::panic::{RefUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::ptr::{null, null_mut};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

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

/// Number of trials of a reader.
fn trials(usual: usize) -> usize {
    std::env::var("MSDD_FUZZ").ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// A file of this thread's own.
fn scratch(name: &str) -> PathBuf {
    let thread = format!("{:?}", std::thread::current().id());
    let number: String = thread.chars().filter(char::is_ascii_digit).collect();
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}-{number}"))
}

/// Writes a file over the one before. Never cut to nothing: on some file systems a file so replaced goes to the disk at once.
fn write(file: &Path, text: &str) {
    let mut open = std::fs::OpenOptions::new();
    let mut file = open.create(true).truncate(false).write(true).open(file).expect("writable");
    file.write_all(text.as_bytes()).expect("writable");
    file.set_len(text.len() as u64).expect("writable");
}

/// Runs trials on all processors; `check` says whether one was accepted, or why it is a finding. Returns how many were.
fn each(
    name: &str,
    count: usize,
    check: impl Fn(usize) -> Result<bool, String> + Sync + RefUnwindSafe,
) -> usize {
    let (next, accepted) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let finding: Mutex<Option<(usize, String)>> = Mutex::new(None);
    let work = || {
        loop {
            let trial = next.fetch_add(1, Ordering::Relaxed);
            if trial >= count {
                return;
            }
            match catch_unwind(|| check(trial)).unwrap_or_else(|_| Err("panic".to_string())) {
                Ok(good) => drop(accepted.fetch_add(usize::from(good), Ordering::Relaxed)),
                Err(why) => {
                    next.store(count, Ordering::Relaxed);
                    *finding.lock().expect("no panic") = Some((trial, why));
                    return;
                }
            }
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
    if let Some((trial, why)) = finding.into_inner().expect("no panic") {
        panic!("trial {trial} of {name}: {why}");
    }
    let accepted = accepted.into_inner();
    println!("{name}: {count} trials, {accepted} accepted");
    accepted
}

/// Tries the corpus and its mutations; `check` says why an input is a finding. Returns how many were accepted.
fn fuzz(name: &str, corpus: &[Vec<u8>], count: usize, check: fn(&str) -> Result<bool, String>) -> usize {
    each(name, corpus.len() + count, |trial| {
        let mut random = Random(7 + ((trial as u64) << 20));
        let input = match corpus.get(trial) {
            Some(text) => text.clone(),
            None => {
                let other = random.below(corpus.len());
                mutated(&corpus[random.below(corpus.len())], &corpus[other], &mut random)
            }
        };
        let Ok(text) = String::from_utf8(input) else { return Ok(false) };
        // Written first: an input that ends the process is found, too.
        let file = scratch(name);
        write(&file, &text);
        let result = catch_unwind(|| check(&text)).unwrap_or_else(|_| Err("panic".to_string()));
        result.map_err(|why| format!("{why}; the input is in {}", file.display()))
    })
}

/// A model that is accepted answers cells inside and far outside of its range with numbers that grains have.
fn model(text: &str) -> Result<bool, String> {
    let file = scratch("model-file");
    write(&file, text);
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

/// A plan that the C interface takes is begun, and ends at its first call-back.
fn plan_through_c(text: &str) -> Result<bool, String> {
    extern "C" fn stop(_user: *mut c_void, _done: u64, _total: u64, _failed: u64) -> i32 {
        1
    }
    let parsed = Plan::parse(text, "plan").map(|plan| plan.jobs().len());
    let path = scratch("database");
    let _ = std::fs::remove_file(&path);
    let (Ok(plan), Ok(name)) = (CString::new(text), CString::new(path.to_string_lossy().as_bytes())) else {
        return Ok(false);
    };
    // SAFETY: C strings, and a call-back that takes any user.
    let status = unsafe { msdd_database_generate(plan.as_ptr(), name.as_ptr(), 1, Some(stop), null_mut()) };
    match (parsed, status) {
        (_, INTERNAL) => Err(last_error()),
        // Nothing to do asks nobody.
        (Ok(0), OK) => Ok(true),
        (Ok(_), status) if status == abi::MSDD_CANCELLED as i32 => Ok(true),
        (Err(_), status) if status == abi::MSDD_RVE as i32 => Ok(false),
        (parsed, status) => Err(format!("{parsed:?}, but status {status}: {}", last_error())),
    }
}

/// Whether a specification, if it is one, is packed in milliseconds: few grains, and not many more steps than usual for the
/// way of the walls, which go with the root of E r/rho. Stiffer grains take as long as they take.
fn soon_packed(text: &str) -> bool {
    let Ok(value) = serde_json::from_str::<serde_json::Value>(text) else { return true };
    let number =
        |pointer: &str, usual: f64| value.pointer(pointer).map_or(Some(usual), |found| found.as_f64());
    let numbers = [
        number("/discs", 500.0),
        number("/material/young_modulus", 1e7),
        number("/radius_max", 7e-3),
        number("/material/density", 3e3),
    ];
    let [Some(discs), Some(young_modulus), Some(radius), Some(density)] = numbers else { return true };
    // Infinite and not-a-number are refused at once.
    let stiffness = young_modulus * radius / density;
    discs <= 24.0 && (stiffness <= 1e4 || !stiffness.is_finite())
}

/// A specification of few grains is packed, or refused with a text.
fn specification(text: &str) -> Result<bool, String> {
    let few = soon_packed(text);
    let (Ok(text), true) = (CString::new(text), few) else { return Ok(false) };
    let mut rve = null_mut();
    // SAFETY: a C string, and `rve` is writable; a live handle is freed once.
    unsafe {
        match msdd_rve_pack(text.as_ptr(), &mut rve) {
            OK => {
                let result = sound(rve);
                msdd_rve_free(rve);
                result.map(|()| true)
            }
            INTERNAL => Err(last_error()),
            _ if rve.is_null() && !last_error().is_empty() => Ok(false),
            status => Err(format!("status {status}, text \"{}\", handle {rve:?}", last_error())),
        }
    }
}

/// Edges of numbers and of ranges, and usual values between.
fn number(random: &mut Random, usual: f64) -> f64 {
    match random.below(8) {
        0 => TOKENS[random.below(TOKENS.len())].parse().unwrap_or(f64::INFINITY),
        1 => -usual,
        2 => usual * 1e3,
        3 => f64::from_bits(random.next()),
        _ => usual,
    }
}

/// A batch of random columns, some of them left out: numbers, or a refusal that writes nothing.
fn batch(model: &Model, trial: usize) -> Result<bool, String> {
    let mut random = Random(((trial as u64) << 20) + 11);
    let mut cells = Cells::new(model, 1 + random.below(20));
    for _ in 0..random.below(4) {
        let cell = random.below(cells.clamped.len());
        let column = random.below(cells.state.len() + 5);
        let [xx, yy] = &mut cells.strain;
        let others = [&mut cells.thermal_strain, &mut cells.total, &mut cells.virgin_share, xx, yy];
        let column = cells.state.iter_mut().chain(others).nth(column).expect("a column");
        column[cell] = number(&mut random, column[cell]);
    }
    let (before, drop) = (cells.clone(), random.next());
    let status = cells.advance_with(model, |batch| {
        let absent = |bit: u32| drop >> bit & 1 == 1;
        batch.total_thermal_strain = if absent(0) { null() } else { batch.total_thermal_strain };
        batch.virgin_share = if absent(1) { null() } else { batch.virgin_share };
        batch.strain_xx = if absent(2) { null() } else { batch.strain_xx };
        batch.strain_yy = if absent(3) { null() } else { batch.strain_yy };
        batch.c12 = if absent(4) { null_mut() } else { batch.c12 };
        batch.stress_yy = if absent(5) { null_mut() } else { batch.stress_yy };
        batch.next_state = if absent(6) { batch.state.cast() } else { batch.next_state };
    });
    if status == OK {
        let numbers = cells.state.iter().chain(&cells.next).chain(&cells.outputs).chain(&cells.outside);
        let finite = numbers.flatten().all(|value| value.is_finite());
        let grains = cells.outputs[0].iter().chain(&cells.outputs[1]).all(|k| *k > 0.0)
            && cells.outputs[2].iter().all(|s| *s >= 0.0);
        return match finite && grains {
            true => Ok(true),
            false => Err(format!("finite {finite}, grains {grains}: {cells:?} for {before:?}")),
        };
    }
    let refused = [abi::MSDD_INVALID_ARGUMENT, abi::MSDD_NON_FINITE, abi::MSDD_PLUGIN];
    let kept = cells.next == before.next && cells.outputs == before.outputs && cells.clamped_cells == 99;
    match refused.iter().any(|known| *known as i32 == status) && kept {
        true => Ok(false),
        false => Err(format!("status {status}, {}, kept {kept}: {before:?}", last_error())),
    }
}

/// A random table of a plug-in, and of a good one random answers: sound, or a refusal that names the plug-in.
fn foreign(source: &str) -> Result<bool, String> {
    let named = |status: i32| match status == abi::MSDD_PLUGIN as i32 && last_error().contains("fuzzed") {
        true => Ok(false),
        false => Err(format!("status {status}: {}", last_error())),
    };
    let model = match Model::load(source) {
        Ok(model) => model,
        Err((status, _)) => return named(status),
    };
    let (cells, columns) = (5, model.columns());
    let mut cells = Cells::new_with(&model, cells, vec![vec![0.1; cells]; columns]);
    let before = cells.clone();
    match cells.advance_with(&model, |_| ()) {
        OK => (),
        status => {
            let kept = cells.next == before.next && cells.outputs == before.outputs;
            return if kept { named(status) } else { Err("wrote what it refused".to_string()) };
        }
    }
    let numbers = cells.next.iter().chain(&cells.outputs).chain(&cells.outside).flatten();
    let grains = cells.outputs[..2].iter().flatten().all(|k| *k > 0.0)
        && cells.outputs[2..4].iter().flatten().all(|s| *s >= 0.0)
        && cells.next[0].iter().all(|e| (0.0..=1.0).contains(e))
        && cells.next[1].iter().all(|f| (-1.0..=1.0).contains(f))
        && cells.state == before.state;
    match numbers.into_iter().all(|value| value.is_finite()) && grains {
        true => Ok(true),
        false => Err(format!("answered {cells:?}")),
    }
}

#[test]
fn model_files() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../surrogate/models");
    let corpus = corpus("models", &[models.join("state.json"), models.join("paper.json")]);
    assert!(fuzz("models", &corpus, trials(500), model) > 50);
}

#[test]
fn states() {
    assert!(fuzz("states", &corpus("states", &[]), trials(3000), state) > 50);
}

#[test]
fn plans() {
    let plans = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/database");
    let corpus = corpus("plans", &["tiny.toml", "quick.toml"].map(|name| plans.join(name)));
    assert!(fuzz("plans", &corpus, trials(3000), plan) > 50);
}

#[test]
fn plans_through_c() {
    let plans = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/database");
    let corpus = corpus("plans", &["tiny.toml", "quick.toml"].map(|name| plans.join(name)));
    assert!(fuzz("plans-c", &corpus, trials(600), plan_through_c) > 10);
}

/// A packing takes milliseconds: a hundredth of the trials.
#[test]
fn specifications() {
    assert!(
        fuzz("specifications", &corpus("specifications", &[]), (trials(0) / 100).max(300), specification) > 5
    );
}

#[test]
fn batches() {
    let sources =
        ["builtin".to_string(), "builtin:paper".to_string(), plugin("rust/capi/examples/effective_medium.c")];
    for source in sources {
        let model = Model::load(&source).unwrap_or_else(|error| panic!("{source}: {error:?}"));
        assert!(each(&source, trials(2000), |trial| batch(&model, trial)) > 500);
    }
}

/// The plug-in counts its calls: on one thread every run is the same.
#[test]
fn plugins() {
    let source = plugin("rust/capi/tests/fuzzed_plugin.c");
    let mut accepted = 0;
    for trial in 0..trials(3000) {
        accepted += usize::from(foreign(&source).unwrap_or_else(|why| panic!("trial {trial}: {why}")));
    }
    println!("plug-ins: {accepted} accepted");
    assert!(accepted > 100);
}
