//! Fuzz tests of everything that is read from outside: mutated texts of a corpus, random columns of batches and random
//! tables of plug-ins. Nothing may panic, and what is accepted must give valid results. Every run makes the same trials,
//! whatever the number of threads. MSDD_FUZZ sets the number of trials of each reader (scripts/test --full makes many; a
//! million takes minutes).
//!
//! An input that fails is written to the target folder. Add it to `corpus/`, whose files are also tried unchanged.
#![allow(unsafe_code)] // the C interface is what is tested

mod columns;
#[path = "../common/mod.rs"]
mod common;
#[path = "../../../rve/tests/common/mutations.rs"]
mod mutations;
mod readers;

use columns::{batch, foreign};
use common::{Model, plugin};
use mutations::{Random, mutated, trials};
use readers::{model, plan, plan_through_c, scratch, specification, state, write};
use std::panic::{RefUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The corpus of a reader: its folder, and texts from elsewhere.
fn corpus(folder: &str, more: &[PathBuf]) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(folder);
    let listed = std::fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("readable").path());
    let mut files: Vec<PathBuf> = listed.chain(more.iter().cloned()).collect();
    files.sort();
    files.iter().map(|file| std::fs::read(file).expect("readable")).collect()
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
                mutated(&corpus[random.below(corpus.len())], &corpus[other], true, &mut random)
            }
        };
        let Ok(text) = String::from_utf8(input) else { return Ok(false) };
        // Written before it is tried, so that an input that kills the process can be found, too.
        let file = scratch(name);
        write(&file, &text);
        let result = catch_unwind(|| check(&text)).unwrap_or_else(|_| Err("panic".to_string()));
        result.map_err(|why| format!("{why}; the input is in {}", file.display()))
    })
}

#[test]
fn model_files() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../surrogate/models");
    let corpus = corpus("models", &[models.join("increment.json"), models.join("paper.json")]);
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
    assert!(fuzz("plans-c", &corpus, trials(1500), plan_through_c) > 10);
}

/// A hundredth of the trials, because every packing takes milliseconds.
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

/// On one thread, because the results of the plug-in depend on the number of its calls and every run has to be the same.
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
