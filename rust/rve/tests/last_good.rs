//! A run that fails leaves its last good state, which can be read and continued.

use msdd_dem::{Excess, StepChoice};
use msdd_rve::state::{from_json, to_file, to_json};
use msdd_rve::{
    Compression, Material, PackingSpec, Preparation, Protocol, RveError, Simulation, Strains, follow,
    last_good, pack, pack_watched,
};

fn spec(porosity: f64) -> PackingSpec {
    let compression = Compression::Isotropic;
    PackingSpec { discs: 100, seed: 1, porosity, compression, ..PackingSpec::default() }
}

fn packed(porosity: f64) -> Simulation {
    pack(&spec(porosity), &Material::default()).unwrap().simulation
}

/// Walls close on the grains until one disc is swallowed by another (or pushed out of the box, after which no copy is
/// made). Continued from the copy of the last good state, the run fails in the same way, to the last bit.
#[test]
fn the_last_good_state_fails_again_in_the_same_way() {
    let mut simulation = packed(0.13);
    let start = simulation.steps;
    simulation.walls.normal_velocity = [0.02, -0.02, 0.02, -0.02];
    simulation.keep_last_good(50);
    let failure = simulation.run(1_000_000).unwrap_err();
    let kept = simulation.take_last_good().unwrap();
    kept.check().unwrap();
    assert!(kept.steps >= start + 50 && kept.steps < simulation.steps, "{} {}", kept.steps, simulation.steps);
    let mut read_back = from_json(&to_json(&kept).unwrap()).unwrap();
    assert_eq!(read_back.run(1_000_000).unwrap_err(), failure);
}

#[test]
fn a_path_that_fails_keeps_what_came_before() {
    let mut simulation = packed(0.06);
    let closed = Strains { thermal: 0.2, xx: -0.2, yy: -0.2, xy: 0.0 };
    let path = [Strains::thermal(0.01), closed];
    let ramp = follow(
        &mut simulation,
        &path,
        Protocol { expansion_rate: 1.0, contraction_rate: 1.0, ..Protocol::default() },
        |_, _| (),
    )
    .unwrap();
    assert!(matches!(ramp.failure, Some(RveError::Failure(_))), "{:?}", ramp.failure);
    assert_eq!(ramp.stops.len(), 1);
    let kept = simulation.take_last_good().unwrap();
    assert!(kept.check().is_ok() && kept.steps < simulation.steps);
}

#[test]
fn a_path_that_ends_well_keeps_nothing() {
    let mut simulation = packed(0.13);
    follow(&mut simulation, &[Strains::thermal(0.01)], Protocol::default(), |_, _| ()).unwrap();
    assert!(simulation.take_last_good().is_none());
}

#[test]
fn a_packing_that_fails_comes_with_its_last_good_state() {
    // Small discs are swallowed by large ones long before the target porosity is reached.
    let uneven = PackingSpec { discs: 200, radius_min: 1e-3, radius_max: 1e-2, ..spec(0.01) };
    let stopped = pack_watched(&uneven, &Preparation::default(), &Material::default()).unwrap_err();
    let kept = stopped.last_good.unwrap();
    kept.check().unwrap();
    assert_eq!(kept.discs.len(), 200);
    assert!(kept.steps > 0, "{}", stopped.error);
    let refused = pack_watched(&spec(0.9), &Preparation::default(), &Material::default()).unwrap_err();
    assert!(refused.last_good.is_none());
}

#[test]
fn it_is_written_beside_the_file_that_was_to_be_written() {
    let folder = std::env::temp_dir().join(format!("msdd-last-good-{}", std::process::id()));
    let state = packed(0.13);
    let file = last_good::write(&folder.join("new").join("out.json"), &state).unwrap();
    assert_eq!(file, folder.join("new").join("out.json.last-good.json"));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), to_file(&state).unwrap());
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A state with a disc beyond a wall could not be read back: such a state is not kept, and the copy before it remains.
#[test]
fn a_state_with_a_disc_beyond_a_wall_is_not_kept() {
    let mut simulation = packed(0.13);
    let start = simulation.steps;
    simulation.keep_last_good(50);
    simulation.run(50).unwrap();
    let left = simulation.walls.position[0];
    let disc = simulation.discs.iter().position(|d| d.x < left + d.radius).unwrap();
    simulation.walls.position[0] = simulation.discs[disc].x + 1e-5;
    // The discs are so heavy that the disc beyond the wall stays there.
    simulation.discs.iter_mut().for_each(|d| d.mass *= 1e6);
    let step = StepChoice::Fixed { step: simulation.time_step, on_excess: Excess::Refuse };
    simulation.choose_time_step(step).unwrap();
    simulation.run(50).unwrap();
    assert!(simulation.discs[disc].x < simulation.walls.position[0]);
    assert_eq!(simulation.take_last_good().unwrap().steps, start + 50);
}
