//! Packing and expansion of small RVEs, held against exact laws.

use msdd_rve::{
    Boundary, Compression, Material, Outcome, PackingSpec, Rates, RegionKind, Strains, expand, follow,
    homogenise, pack,
};

fn spec(compression: Compression) -> PackingSpec {
    PackingSpec {
        discs: 120,
        seed: 7,
        porosity: 0.12,
        compression,
        radius_min: 3e-3,
        radius_max: 7e-3,
        boundary: Boundary::Walls,
    }
}

#[test]
fn packing_meets_the_target_and_the_compression_shows() {
    let material = Material::default();
    let horizontal = pack(&spec(Compression::Horizontal), &material).unwrap();
    assert_eq!(horizontal.settled.outcome, Outcome::Settled);
    let porosity = msdd_rve::area::porosity_of_box(&horizontal.simulation);
    assert!((porosity - 0.12).abs() < 2e-3, "{porosity}");
    let averages = homogenise(&horizontal.simulation, RegionKind::Hull);
    assert!(averages.stress_xx > 1.1 * averages.stress_yy, "{averages:?}");
    assert!(averages.conductivity_xx > averages.conductivity_yy && averages.fabric_index > 0.0);
}

#[test]
fn expansion_obeys_the_mass_law_and_stiffens() {
    let packed = pack(&spec(Compression::Isotropic), &Material::default()).unwrap();
    let start = homogenise(&packed.simulation, RegionKind::Hull);
    let up = expand(&packed, &[0.005, 0.01, 0.03]).unwrap().stops;
    let down = expand(&packed, &[-0.005, -0.01]).unwrap().stops;
    for stop in up.iter().chain(&down) {
        let law = (1.0 - start.porosity_sum_of_areas) * (1.0 + stop.strains.thermal).powi(2);
        assert!((1.0 - stop.averages.porosity_sum_of_areas - law).abs() < 1e-12);
        assert_eq!(stop.settled.outcome, Outcome::Settled);
    }
    let pressures: Vec<f64> =
        [&down[1], &down[0], &up[0], &up[1], &up[2]].iter().map(|stop| stop.averages.pressure).collect();
    assert!(pressures.windows(2).all(|p| p[0] < p[1]), "{pressures:?}");
}

#[test]
fn same_seed_same_bytes() {
    let run = || {
        let packed = pack(&spec(Compression::Isotropic), &Material::default()).unwrap();
        format!("{:?}", expand(&packed, &[0.01]).unwrap())
    };
    assert_eq!(run(), run());
}

#[test]
fn a_packing_contracted_far_enough_unjams() {
    let packed = pack(&spec(Compression::Isotropic), &Material::default()).unwrap();
    let stops = expand(&packed, &[-0.12]).unwrap().stops;
    assert_eq!(stops[0].settled.outcome, Outcome::Unjammed);
}

#[test]
fn bad_input_names_key_value_and_range() {
    let message = |spec: &PackingSpec| pack(spec, &Material::default()).unwrap_err().to_string();
    let good = spec(Compression::Isotropic);
    assert_eq!(
        message(&PackingSpec { porosity: 0.9, ..good.clone() }),
        "porosity = 0.9, allowed: 0.01 to 0.3"
    );
    assert!(message(&PackingSpec { discs: 3, ..good.clone() }).starts_with("discs = 3"));
    let packed = pack(&good, &Material::default()).unwrap();
    assert!(expand(&packed, &[0.02, 0.01]).unwrap_err().to_string().starts_with("strains = [0.02, 0.01]"));
}

/// Walls that close along x by 1 % raise σ_xx more than σ_yy; the box follows the path exactly; and a uniform thermal
/// strain raises p about as much as closing all walls by the same strain (up to friction on walls that do not shrink).
#[test]
fn wall_strain_follows_its_path() {
    let packed = pack(&spec(Compression::Isotropic), &Material::default()).unwrap();
    let start = homogenise(&packed.simulation, RegionKind::Hull);
    let after = |strains: Strains| {
        let mut simulation = packed.simulation.clone();
        let ramp = follow(&mut simulation, &[strains], Rates::default(), |_, _| ()).unwrap();
        let width = packed.simulation.walls.width() * (1.0 + strains.xx);
        assert!((simulation.walls.width() / width - 1.0).abs() < 1e-12);
        ramp.stops[0].averages
    };
    let x = after(Strains { xx: -0.01, ..Strains::default() });
    assert!(x.stress_xx - start.stress_xx > 1.3 * (x.stress_yy - start.stress_yy), "{x:?}");
    let closed = after(Strains { xx: -0.01, yy: -0.01, ..Strains::default() }).pressure - start.pressure;
    let heated = after(Strains::thermal(0.01)).pressure - start.pressure;
    assert!((heated / closed - 1.0).abs() < 0.15, "{heated} {closed}");
}
