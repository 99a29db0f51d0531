//! Mutated checkpoints: none is accepted unless it is the one that was written.

#[path = "../../rve/tests/common/mutations.rs"]
mod mutations;

use msdd_dem::{Disc, Material, Simulation, Thermal, WallHeat, Walls};
use msdd_dem_reference::checkpoint::{Checkpoint, Records};
use msdd_dem_reference::results::Table;
use std::path::Path;

const ASKED: &str = "a run";

/// Four warm discs in a box.
fn text() -> String {
    let disc = |k: u32| Disc::at_rest(0.01 * f64::from(2 * k + 1), 0.01, 0.0101, 1.0);
    let walls = Walls::around(0.08, 0.02);
    let mut simulation = Simulation::new(Material::default(), (0..4).map(disc).collect(), walls);
    simulation.enable_heat(Thermal::default(), [WallHeat::Temperature(50.0); 4]);
    simulation.run(20).unwrap();
    let mut series = Table::new(vec!["time".to_string(), "T".to_string()]);
    series.push(vec![0.1, 1.0 / 3.0]);
    let table = || Table::new(vec!["x".to_string()]);
    let records = Records { series, sub_regions_start: table(), profiles: table(), network: table() };
    Checkpoint::text(ASKED, &simulation, &records).unwrap().unwrap()
}

#[test]
fn checkpoints() {
    let text = text();
    let whole = Checkpoint::parse(&text, ASKED).unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let corpus = [text.clone().into_bytes()];
    mutations::fuzz(("checkpoints", folder), &corpus, 2000, |input| {
        let Ok(Ok(found)) = std::str::from_utf8(input).map(|text| Checkpoint::parse(text, ASKED)) else {
            return Ok(false);
        };
        let same = found.records == whole.records && found.state.get() == whole.state.get();
        if same { Ok(true) } else { Err("its checksum agrees, but it is another one".to_string()) }
    });
}

#[test]
fn a_damaged_checkpoint_is_refused_with_what_helps() {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("damaged.checkpoint.json");
    let text = text();
    let half = text[..text.len() / 2].to_string();
    let other = text.replacen("0.3333333", "0.3333334", 1);
    assert_ne!(text, other);
    for (damaged, problem) in [(half, "is damaged: "), (other, "is damaged: its checksum does not agree")] {
        std::fs::write(&file, damaged).unwrap();
        let error = Checkpoint::read(&file, ASKED).err().unwrap().to_string();
        assert!(error.contains("damaged.checkpoint.json") && error.contains(problem), "{error}");
        assert!(error.ends_with("when the file is deleted, the run starts from its beginning"), "{error}");
    }
    std::fs::write(&file, &text).unwrap();
    assert!(Checkpoint::read(&file, ASKED).unwrap().is_some());
    assert!(Checkpoint::read(&file, "another run").is_err());
    std::fs::remove_file(&file).unwrap();
    assert!(Checkpoint::read(&file, ASKED).unwrap().is_none());
}
