//! Grains of any size give the same porosity, fabric, K/k and σ/(E r).

use msdd_rve::{
    Averages, Boundary, Compression, Material, PackingSpec, Protocol, RegionKind, Relaxation, Strains,
    follow, homogenise, pack, slide,
};

/// Averages after packing and after strains up and down, with the protocol scaled for these grains; stresses as σ/(E
/// r).
fn states(mean_radius: f64, boundary: Boundary, relaxation: Relaxation, seed: u64) -> Vec<Averages> {
    let material = Material::default();
    let spec = PackingSpec {
        discs: 80,
        seed,
        porosity: 0.13,
        compression: Compression::Horizontal,
        radius_min: 0.6 * mean_radius,
        radius_max: 1.4 * mean_radius,
        boundary,
        relaxation,
    };
    let packed = pack(&spec, &material).unwrap();
    let mut averages = vec![homogenise(&packed.simulation, RegionKind::default())];
    for strain in [0.01, -0.005] {
        let mut simulation = packed.simulation.clone();
        let protocol = Protocol { relaxation, ..Protocol::usual(&simulation) };
        let ramp = follow(&mut simulation, &[Strains::thermal(strain)], protocol, |_, _| ()).unwrap();
        assert!(ramp.failure.is_none(), "{:?}", ramp.failure);
        averages.push(ramp.stops[0].averages);
    }
    let scale = material.young_modulus * mean_radius;
    for each in &mut averages {
        each.mean_radius /= mean_radius;
        for stress in [
            &mut each.stress_xx,
            &mut each.stress_yy,
            &mut each.stress_xy,
            &mut each.stress_yx,
            &mut each.pressure,
        ] {
            *stress /= scale;
        }
    }
    averages
}

/// A power of four times the size multiplies every number by a power of two, so not one bit may differ. Any quantity
/// that is not scaled with the grains shows at once.
#[test]
fn packings_of_20_micrometres_and_of_80_millimetres_are_those_of_5_millimetres() {
    for (boundary, relaxation) in
        [(Boundary::Periodic, Relaxation::Fire), (Boundary::Walls, Relaxation::Damped)]
    {
        let expected = states(5e-3, boundary, relaxation, 3);
        for size in [1.0 / 256.0, 16.0] {
            assert_eq!(states(5e-3 * size, boundary, relaxation, 3), expected, "{size} {boundary:?}");
        }
    }
}

/// With other ratios of size, numbers are rounded differently and the speed of packing differs by up to √2: single
/// packings differ by chance, but their means agree. Measured over six packings: 0.5 % in porosity, 5 % in K, 6 % in p,
/// which is the statistical error. With the same wall speed for all grains, those of 10 µm are packed denser by 16 %.
#[test]
fn packings_of_10_micrometres_and_of_a_decimetre_are_as_dense_and_as_strong() {
    let mean = |radius: f64| {
        let all: Vec<_> =
            (1..=6).map(|seed| states(radius, Boundary::Periodic, Relaxation::Fire, seed)[1]).collect();
        let of = |value: fn(&Averages) -> f64| all.iter().map(value).sum::<f64>() / all.len() as f64;
        [of(|a| a.porosity), of(|a| a.pressure), of(|a| a.conductivity_xx), of(|a| a.conductivity_yy)]
    };
    let expected = mean(5e-3);
    for radius in [1e-5, 1e-3, 0.1] {
        let found = mean(radius);
        for (found, expected) in found.iter().zip(expected) {
            let off = found / expected - 1.0;
            assert!(off.abs() < 0.1, "{radius} m: {found} against {expected}");
        }
    }
}

#[test]
fn walls_slip_along_grains_of_any_size_alike() {
    let friction = |radius: f64| {
        let spec = PackingSpec {
            discs: 60,
            radius_min: 0.6 * radius,
            radius_max: 1.4 * radius,
            porosity: 0.13,
            ..PackingSpec::default()
        };
        let mut simulation = pack(&spec, &Material::default()).unwrap().simulation;
        let mut met = Vec::new();
        let ways = [0.02 * radius, 0.2 * radius];
        let ramp = slide(&mut simulation, &ways, Relaxation::Damped, |_, sliding| {
            met.push((sliding.friction, sliding.slip / radius))
        });
        assert!(ramp.unwrap().failure.is_none());
        met
    };
    let expected = friction(5e-3);
    assert!(expected[1].0 > expected[0].0);
    for size in [1.0 / 256.0, 16.0] {
        assert_eq!(friction(5e-3 * size), expected, "{size}");
    }
}
