use super::*;

const H: f64 = 1e-3;

fn usual() -> Steps {
    Steps { size: H, probes: Vec::new(), probe_every: 20 }
}

/// The strains relative to the packed state, the packed state first.
fn states(path: RampName, seed: u64) -> Vec<Strains> {
    let rows = planned(path, seed, &usual(), true);
    std::iter::once(Strains::default()).chain(rows.iter().map(|row| row.strains)).collect()
}

fn parts(s: Strains) -> [f64; 4] {
    [s.thermal, s.xx, s.yy, s.xy]
}

/// Numbers of equal increments in a row.
fn legs(path: RampName, seed: u64) -> Vec<usize> {
    let steps = steps(path, seed, H);
    steps.chunk_by(|a, b| a == b).map(<[Strains]>::len).collect()
}

#[test]
fn there_and_back_paths_turn_where_they_should() {
    for (path, counts, shape) in [
        (RampName::Biaxial, [15, 25, 15], [0.0, H, -H, 0.0]),
        (RampName::Shear, [15, 25, 15], [0.0, 0.0, 0.0, 2.0 * H]),
        (RampName::Isotropic, [12, 18, 10], [0.0, H, H, 0.0]),
        (RampName::Thermal, [20, 35, 15], [H, 0.0, 0.0, 0.0]),
    ] {
        for seed in 0..20 {
            assert_eq!(legs(path, seed), counts, "{path:?}");
            let first = parts(steps(path, seed, H)[0]);
            assert!(first == shape || first == shape.map(|part| 0.0 - part), "{path:?}: {first:?}");
        }
    }
    for seed in 0..20 {
        assert_eq!(legs(RampName::Uniaxial, seed), [25, 25, 15]);
        // After there and back the box is what it was, but for h² an increment.
        let states = states(RampName::Uniaxial, seed);
        assert!(parts(states[50]).iter().all(|part| part.abs() < 25.1 * H * H), "{:?}", states[50]);
    }
}

#[test]
fn both_senses_and_both_axes_occur() {
    let first = |path| {
        let mut found: Vec<_> = (0..40).map(|seed| format!("{:?}", steps(path, seed, H)[0])).collect();
        found.sort();
        found.dedup();
        found.len()
    };
    assert_eq!(first(RampName::Uniaxial), 4);
    for path in [RampName::Biaxial, RampName::Shear, RampName::Isotropic, RampName::Thermal] {
        assert_eq!(first(path), 2, "{path:?}");
    }
    assert_eq!((first(RampName::Circle), first(RampName::Turning)), (40, 1));
}

#[test]
fn a_circle_closes_after_each_turn() {
    let states = states(RampName::Circle, 7);
    assert_eq!(states.len(), 61);
    for turn in [20, 40, 60] {
        assert!(parts(states[turn]).iter().all(|part| part.abs() < 1e-15), "{:?}", states[turn]);
    }
    // Opposite states are a diameter apart; all are at the radius from the centre.
    let centre = [0.5 * (states[0].xx + states[10].xx), 0.5 * (states[0].yy + states[10].yy)];
    for state in &states {
        let radius = (state.xx - centre[0]).hypot(state.yy - centre[1]);
        assert!((radius / (5.0 * H) - 1.0).abs() < 1e-9, "{radius}");
        assert_eq!((state.thermal, state.xy), (0.0, 0.0));
    }
}

#[test]
fn turning_strain_has_one_size_and_no_change_of_area() {
    let steps = steps(RampName::Turning, 3, H);
    assert_eq!(steps.len(), 60);
    assert_eq!(parts(steps[0]), [0.0, H, -H, 0.0]);
    for step in &steps {
        assert!((step.xx.hypot(0.5 * step.xy) / H - 1.0).abs() < 1e-12);
        assert_eq!(step.xx + step.yy, 0.0);
    }
    let last = steps[59];
    assert!((last.xx + H).abs() < 1e-15 && last.xy.abs() < 1e-15, "t ends at 3 pi: {last:?}");
}

#[test]
fn random_pieces_have_their_number_length_and_largest_part() {
    let mut largest = [0.0f64; 4];
    for seed in 0..50 {
        for path in [RampName::Mixed, RampName::Mechanical] {
            let legs = legs(path, seed);
            assert!(legs.len() == 8 && legs.iter().all(|count| (4..=12).contains(count)), "{legs:?}");
            for step in steps(path, seed, H) {
                let sizes = parts(step).map(f64::abs);
                assert!((sizes.into_iter().fold(0.0, f64::max) / H - 1.0).abs() < 1e-12, "{step:?}");
                assert!(path == RampName::Mixed || step.thermal == 0.0);
                largest.iter_mut().zip(sizes).for_each(|(most, size)| *most = most.max(size));
            }
        }
    }
    assert!(largest.iter().all(|size| *size > 0.5 * H), "{largest:?}");
}

#[test]
fn a_front_holds_one_axis_and_follows_along_the_other() {
    let mut shares = Vec::new();
    for seed in 0..50 {
        assert_eq!(legs(RampName::Front, seed), [24, 16, 8]);
        for leg in steps(RampName::Front, seed, H).chunk_by(|a, b| a == b) {
            let Strains { thermal, xx, yy, xy } = leg[0];
            assert!(thermal.abs() == H && xy == 0.0 && (xx == 0.0) != (yy == 0.0), "{:?}", leg[0]);
            shares.push((xx + yy) / thermal);
        }
    }
    assert!(shares.iter().all(|share| (0.0..=2.0).contains(share)), "{shares:?}");
    let [least, most] = [f64::min, f64::max].map(|of| shares.iter().copied().reduce(of).expect("shares"));
    assert!(least < 0.1 && most > 1.9, "{least} {most}");
}

#[test]
fn growing_grains_and_a_shrinking_box_are_twins() {
    let rows = planned(RampName::Equivalence, 1, &usual(), true);
    assert_eq!(rows.len(), 12);
    for pair in rows.chunks(2) {
        let (thermal, twin) = (pair[0].strains, pair[1].strains);
        assert!([0.005, 0.01, 0.02].contains(&thermal.thermal.abs()));
        assert_eq!(twin.xx, twin.yy);
        assert!(((1.0 + thermal.thermal) * (1.0 + twin.xx) - 1.0).abs() < 1e-15);
        assert!(pair.iter().all(|row| row.increment.from_stop == 0 && !row.increment.probe));
    }
}

#[test]
fn probes_stand_between_the_increments_and_the_path_goes_on_without_them() {
    let steps = Steps { size: H, probes: vec![1e-4, 1e-3], probe_every: 20 };
    let rows = planned(RampName::Circle, 7, &steps, true);
    // The packed state and three others, each with six strains of two sizes.
    assert_eq!(rows.len(), 60 + 4 * 12);
    assert!(rows.iter().zip(1..).all(|(row, stop)| row.stop == stop));
    assert!(rows[..12].iter().all(|row| row.increment.probe && row.increment.from_stop == 0));
    assert_eq!((rows[12].increment.from_stop, rows[13].increment.from_stop), (0, 13));
    assert!(rows[32..44].iter().all(|row| row.increment.probe && row.increment.from_stop == 32));
    assert_eq!(rows[44].increment.from_stop, 32);
    let way: Vec<Strains> = rows.iter().filter(|row| !row.increment.probe).map(|row| row.strains).collect();
    assert_eq!(way, states(RampName::Circle, 7)[1..]);
    let tried: Vec<[f64; 4]> = rows[..6].iter().map(|row| parts(row.increment.step)).collect();
    let p = 1e-4;
    let shear = [0.0, 0.0, 0.0, p];
    assert_eq!(tried[..3], [[0.0, p, 0.0, 0.0], [0.0, 0.0, p, 0.0], shear]);
    assert_eq!(tried[3..], [[0.0, -p, 0.0, 0.0], [0.0, 0.0, -p, 0.0], shear.map(|part| 0.0 - part)]);
    assert_eq!(planned(RampName::Circle, 7, &steps, false).len(), 60 + 3 * 12);
}

#[test]
fn paths_depend_on_seed_and_name() {
    assert_eq!(steps(RampName::Mixed, 5, H), steps(RampName::Mixed, 5, H));
    assert_ne!(steps(RampName::Mixed, 5, H), steps(RampName::Mixed, 6, H));
    assert_ne!(seed_of(5, b"mixed"), seed_of(5, b"mechanical"));
}

/// As the box itself: width, height and shear offset follow from strain to strain.
#[test]
fn strains_add_up_as_the_box_does() {
    let [mut width, mut height, mut offset] = [2.0, 3.0, 0.0];
    let mut total = Strains::default();
    for step in steps(RampName::Mixed, 9, 1e-2) {
        offset = offset * (1.0 + step.xx) + step.xy * height;
        (width, height) = (width * (1.0 + step.xx), height * (1.0 + step.yy));
        total = total.then(step);
    }
    for (found, expected) in
        [(total.xx, width / 2.0 - 1.0), (total.yy, height / 3.0 - 1.0), (total.xy, offset / 3.0)]
    {
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    }
    assert!(total.thermal != 0.0);
}
