//! The model of spheres through the exported functions.

use super::*;
use crate::abi::{msdd_grains, msdd_input, msdd_sphere_wall, msdd_start, msdd_step};
use crate::grains::Grains;
use crate::sphere_material::Material;
use ::msdd_surrogate::spheres::model::{Increment, NAMES, SphereModel};
use ::msdd_surrogate::spheres::state::PackingData;
use msdd_beds::named_gases::GasName;
use msdd_beds::radiation::{Dark, black};
use std::ffi::c_char;

fn builtin() -> Model {
    load("builtin:spheres")
}

/// E*.
const MODULUS: f64 = 1e11;

/// Smooth spheres of steel in air.
const STEEL: msdd_grains = msdd_grains {
    struct_size: size_of::<msdd_grains>(),
    radius: 3.2e-3,
    young_modulus: 2e11,
    poisson_ratio: 0.0,
    conductivity: 42.0,
    roughness: 0.0,
    hardness: 3e9,
    gas: c"air".as_ptr(),
    gas_pressure: 1.013e5,
    accommodation: 0.7,
    emissivity: 0.0,
    size_spread: 0.0,
};

/// States of packings under a growing pressure, with one that carries nothing.
fn start(law: &Model, cells: usize) -> Vec<Vec<f64>> {
    let solid: Vec<f64> = (0..cells).map(|cell| 0.6 + 1e-3 * cell as f64).collect();
    start_of(law, &STEEL, &solid, None)
}

/// The same with these solid fractions and so many contacts per sphere, if they were counted.
fn start_of(law: &Model, material: &msdd_grains, solid: &[f64], counted: Option<f64>) -> Vec<Vec<f64>> {
    let cells = solid.len();
    let column = |share: f64| (0..cells).map(|cell| share * 1e5 * cell as f64).collect::<Vec<f64>>();
    let stress = [1.0, 0.9, 1.2, 0.05, 0.0, -0.04].map(column);
    let mut state = vec![vec![-7.0; cells]; law.columns()];
    let (stress, columns) = (inputs(&stress), outputs(&mut state));
    let contacts = counted.map(|counted| vec![counted; cells]);
    let start = msdd_start {
        cells,
        solid_fraction: input(solid),
        stress: stress.as_ptr(),
        coordination: contacts.as_deref().map_or(NOT_GIVEN, input),
        ..SPHERES_AT_START
    };
    // SAFETY: live, columns of `cells` values.
    let status = unsafe { msdd_model_initial_state(law.0, material, &start, columns.as_ptr()) };
    assert_eq!(status, MSDD_OK, "{}", last_error());
    state
}

const NOTHING: msdd_step = msdd_step { components: 6, ..STEP };
const SPHERES_AT_START: msdd_start = msdd_start { components: 6, ..START };

#[test]
fn conductivity_of_the_spheres_can_differ_between_cells() {
    let law = builtin();
    let state = start(&law, 2);
    let before = inputs(&state);
    let conducting = |material: &msdd_grains, cells: msdd_input| {
        let mut tensor = vec![vec![-7.0; 2]; 6];
        let columns = outputs(&mut tensor);
        let mut batch = msdd_step {
            cells: 2,
            state: before.as_ptr(),
            solid_conductivity: cells,
            conductivity: columns.as_ptr(),
            ..NOTHING
        };
        // SAFETY: live, full struct, columns of two values.
        assert_eq!(unsafe { msdd_model_advance(law.0, material, &mut batch) }, MSDD_OK, "{}", last_error());
        tensor[0].clone()
    };
    let mixed = conducting(&STEEL, input(&[42.0, 21.0]));
    let poorer = msdd_grains { conductivity: 21.0, ..STEEL };
    let usual = conducting(&STEEL, NOT_GIVEN);
    assert_eq!(mixed, [usual[0], conducting(&poorer, NOT_GIVEN)[1]]);
    assert!(mixed[1] < usual[1]);
}

/// Unequal spheres of φ are equal ones of φ (1 − 0.62 s²), and their own φ is answered; it changes with the volume alone. To contacts that
/// were counted 5.4 s² are added.
#[test]
fn unequal_spheres_are_equal_ones_of_a_lower_solid_fraction() {
    let law = builtin();
    let (spread, solid) = (0.25, [0.62, 0.61]);
    let unequal = msdd_grains { size_spread: spread, ..STEEL };
    let equal = solid.map(|solid| (1.0 - 0.62 * spread * spread) * solid);
    let state = start_of(&law, &unequal, &solid, None);
    assert_eq!(state, start_of(&law, &STEEL, &equal, None));
    let added = 5.4 * spread * spread;
    assert_eq!(
        start_of(&law, &unequal, &solid, Some(4.5)),
        start_of(&law, &STEEL, &equal, Some(4.5 + added))
    );
    let (columns, small) = (inputs(&state), [-1e-3; 2]);
    let zeros = [0.0; 2];
    let strain = [input(&small), input(&zeros), input(&zeros), input(&zeros), input(&zeros), input(&zeros)];
    for (given, volume) in [(null(), 1.0), (strain.as_ptr(), 1.0 - 1e-3)] {
        let mut found = [0.0; 2];
        let mut batch = msdd_step {
            cells: 2,
            state: columns.as_ptr(),
            strain: given,
            solid_fraction: output(&mut found),
            ..NOTHING
        };
        // SAFETY: live, full struct, columns of two values.
        assert_eq!(unsafe { msdd_model_advance(law.0, &unequal, &mut batch) }, MSDD_OK, "{}", last_error());
        // The law takes the change of volume to the second order of the strain, 1e-6.
        let near = |(found, solid): (&f64, &f64)| (found * volume / solid - 1.0).abs() < 2e-6;
        assert!(found.iter().zip(&solid).all(near), "{found:?} {volume}");
    }
}

/// Radiation adds the same along all axes, what [`Dark`] says of the conductivity without it, and nothing at emissivity 0.
#[test]
fn radiation_adds_to_the_conductivity() {
    let law = builtin();
    let state = start(&law, 2);
    let before = inputs(&state);
    let hot = [900.0, 1200.0];
    let conducting = |emissivity: f64, of_cells: Option<[f64; 2]>| {
        let (mut tensor, mut added, mut solid) = (vec![vec![-7.0; 2]; 6], [-7.0; 2], [-7.0; 2]);
        let columns = outputs(&mut tensor);
        let mut batch = msdd_step {
            cells: 2,
            state: before.as_ptr(),
            temperature: input(&hot),
            conductivity: columns.as_ptr(),
            emissivity: of_cells.as_ref().map_or(NOT_GIVEN, |cells| input(cells)),
            radiation_conductivity: output(&mut added),
            solid_fraction: output(&mut solid),
            ..NOTHING
        };
        let material = msdd_grains { conductivity: 2.0, emissivity, ..STEEL };
        // SAFETY: live, full struct, columns of two values.
        let status = unsafe { msdd_model_advance(law.0, &material, &mut batch) };
        assert_eq!(status, MSDD_OK, "{}", last_error());
        (tensor, added, solid)
    };
    let ((dark, none, solid), (bright, added, _)) = (conducting(0.0, None), conducting(0.8, None));
    assert_eq!(none, [0.0; 2]);
    assert_eq!(conducting(0.0, Some([0.0, 0.8])).1, [0.0, added[1]]);
    for cell in 0..2 {
        let bed = Dark {
            conductivity: (dark[0][cell] + dark[1][cell] + dark[2][cell]) / 3.0,
            solid: 2.0,
            gas: GasName::Air.at(hot[cell], 1.013e5, 0.7).expect("air").conductivity,
            solid_fraction: solid[cell],
        };
        let expected = bed.radiation(black(hot[cell], 2.0 * STEEL.radius), 0.8);
        assert!((added[cell] / expected - 1.0).abs() < 1e-12 && added[cell] > 0.2, "{added:?} {expected}");
        for k in 0..6 {
            let more = if k < 3 { added[cell] } else { 0.0 };
            assert_eq!(bright[k][cell], dark[k][cell] + more);
        }
    }
}

#[test]
fn answers_are_those_of_the_model_in_si_units() {
    let law = builtin();
    let cells = 7;
    let mut state = start(&law, cells);
    let (before, given) = (state.clone(), outputs(&mut state));
    let thermal = vec![2e-4; cells];
    let strain: Vec<Vec<f64>> = (0..6).map(|k| vec![-1e-4 * f64::from(k); cells]).collect();
    let rotation = vec![vec![1e-3; cells]; 3];
    let temperature = vec![350.0; cells];
    let mut stress = vec![vec![-7.0; cells]; 6];
    let mut tangent = vec![vec![-7.0; cells]; 36];
    let mut contact = vec![vec![-7.0; cells]; 6];
    let (mut gas, mut solid, mut outside) = (vec![-7.0; cells], vec![-7.0; cells], vec![9u8; cells]);
    let old: Vec<msdd_input> =
        given.iter().map(|column| msdd_input { values: column.values, stride: column.stride }).collect();
    let (strains, turns) = (inputs(&strain), inputs(&rotation));
    let (stresses, derivatives) = (outputs(&mut stress), outputs(&mut tangent));
    let contacts = outputs(&mut contact);
    let mut batch = msdd_step {
        cells,
        state: old.as_ptr(),
        thermal_strain: input(&thermal),
        strain: strains.as_ptr(),
        rotation: turns.as_ptr(),
        temperature: input(&temperature),
        // The same columns as the input.
        next_state: given.as_ptr(),
        stress: stresses.as_ptr(),
        tangent: derivatives.as_ptr(),
        conductivity: contacts.as_ptr(),
        gas_conductivity: output(&mut gas),
        solid_fraction: output(&mut solid),
        outside: outside.as_mut_ptr(),
        ..NOTHING
    };
    // SAFETY: live, full struct, columns of `cells` values.
    assert_eq!(unsafe { msdd_model_advance(law.0, &STEEL, &mut batch) }, MSDD_OK, "{}", last_error());
    let model = SphereModel::builtin().expect("a good file");
    // SAFETY: its gas is a C string.
    let material = Material::new(&unsafe { Grains::new(STEEL) }.expect("UTF-8")).expect("good");
    let air = material.gas(350.0).expect("good");
    for cell in 0..cells {
        let increment =
            Increment { thermal: 2e-4, cell: std::array::from_fn(|k| strain[k][cell]), rotation: [1e-3; 3] };
        let from = std::array::from_fn(|k| before[k][cell]);
        let expected = model.advance(&from, &increment, air.number, true);
        // Air at 350 K conducts 0.030 W/(m K).
        assert!((gas[cell] / (0.030 * expected.gas) - 1.0).abs() < 0.02);
        for k in 0..6 {
            // All of it goes from sphere to sphere, since steel conducts so much better.
            let by_gas = if k < 3 { gas[cell] } else { 0.0 } + gas[cell] * expected.gas_deviator[k];
            assert_eq!(contact[k][cell], 42.0 * expected.contact[k] + by_gas);
            assert_eq!(stress[k][cell], expected.stress[k] * MODULUS);
            assert_eq!(tangent[6 * k + 1][cell], expected.tangent[k][1] * MODULUS);
        }
        assert!((0..state.len()).all(|k| state[k][cell] == expected.state[k]));
        assert_eq!(solid[cell], expected.solid);
        assert_eq!(outside[cell], expected.outside);
    }
    assert_eq!(batch.outside_cells, outside.iter().filter(|&&one| one > 0).count());
}

#[test]
fn contacts_friction_and_fabric_are_those_that_are_known() {
    let law = builtin();
    let (solid, contacts, friction) = ([0.6, 0.6], [4.0, 5.5], [0.7, 0.2]);
    let stress = [1e5, 1e5, 1.3e5, 0.0, 0.0, 0.0].map(|part| vec![part; 2]);
    let fabric = [0.32, 0.32, 0.36, 0.0, 0.0, 0.0].map(|part| vec![part; 2]);
    let size = law.columns();
    let (stress, normals) = (inputs(&stress), inputs(&fabric));
    let found = |coordination: msdd_input, mobilised: msdd_input, fabric: *const msdd_input| {
        let mut state = vec![vec![-7.0; 2]; size];
        let columns = outputs(&mut state);
        let start = msdd_start {
            cells: 2,
            solid_fraction: input(&solid),
            stress: stress.as_ptr(),
            fabric,
            coordination,
            mobilised,
            ..SPHERES_AT_START
        };
        // SAFETY: live, columns of two values.
        let status = unsafe { msdd_model_initial_state(law.0, &STEEL, &start, columns.as_ptr()) };
        (status, state)
    };
    let (status, state) = found(input(&contacts), input(&friction), normals.as_ptr());
    assert_eq!(status, MSDD_OK, "{}", last_error());
    let model = SphereModel::builtin().expect("a good file");
    let load = [1e5, 1e5, 1.3e5, 0.0, 0.0, 0.0].map(|part| part / MODULUS);
    let tensor = Some([0.32, 0.32, 0.36, 0.0, 0.0, 0.0]);
    for cell in 0..2 {
        let [coordination, mobilised] = [contacts[cell], friction[cell]].map(Some);
        let known = PackingData { coordination, fabric: tensor, mobilised };
        let expected = model.initial_state(0.6, load, &known);
        assert!((0..size).all(|k| state[k][cell] == expected[k]), "{expected:?}");
    }
    let (many, wrong) = ([5.0, 13.0], [[f64::NAN; 2]; 6].map(|column| column.to_vec()));
    let (status, untouched) = found(input(&many), NOT_GIVEN, null());
    assert!(
        status == MSDD_INVALID_ARGUMENT && last_error().contains("coordination[1] = 13"),
        "{}",
        last_error()
    );
    assert_eq!(untouched, vec![vec![-7.0; 2]; size]);
    let wrong = inputs(&wrong);
    let (status, _) = found(NOT_GIVEN, NOT_GIVEN, wrong.as_ptr());
    assert!(status == MSDD_NON_FINITE && last_error().contains("fabric[xx]"), "{}", last_error());
    let (status, _) = found(NOT_GIVEN, input(&[1.0, 1.5]), null());
    assert!(
        status == MSDD_INVALID_ARGUMENT && last_error().contains("mobilised[1] = 1.5"),
        "{}",
        last_error()
    );
}

#[test]
fn the_model_describes_itself() {
    let law = builtin();
    // SAFETY: live.
    unsafe {
        assert_eq!(text(msdd_model_hash(law.0)).len(), 64);
        assert!(text(msdd_model_describe(law.0)).contains("\"jamming_fraction\""));
        assert_eq!((msdd_model_components(law.0), msdd_model_components(null())), (6, 0));
        let count = msdd_model_state_size(law.0);
        assert_eq!(text(msdd_model_state_name(law.0, 0)), "jamming_fraction");
        assert!(msdd_model_state_name(law.0, count).is_null());
        assert!(msdd_model_hash(null()).is_null() && msdd_model_describe(null()).is_null());
        assert_eq!(msdd_model_state_size(null()), 0);
        msdd_model_free(null_mut());
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let law = builtin();
    let state = start(&law, 2);
    let columns = inputs(&state);
    let refused = |material: msdd_grains, batch: msdd_step, expected: i32, said: &str| {
        let mut batch = batch;
        // SAFETY: live, and columns of two values.
        let status = unsafe { msdd_model_advance(law.0, &material, &mut batch) };
        assert!(status == expected && last_error().contains(said), "{status}: {}", last_error());
    };
    let good = msdd_step { cells: 2, state: columns.as_ptr(), ..NOTHING };
    let (large, none) = ([0.0, 0.3], [0.0, f64::NAN]);
    let mut scratch = [0.0; 2];
    let distance = [output(&mut scratch); 1];
    let batch = |batch, said| refused(STEEL, batch, MSDD_INVALID_ARGUMENT, said);
    batch(msdd_step { thermal_strain: input(&large), ..good }, "thermal_strain[1] = 0.3");
    batch(msdd_step { state: null(), ..good }, "state is NULL");
    batch(msdd_step { struct_size: 8, ..good }, "step.struct_size = 8");
    let zeros = [0.0; 2];
    let mut strains = [input(&zeros); 6];
    strains[3] = input(&large);
    batch(msdd_step { strain: strains.as_ptr(), ..good }, "strain[xy][1] = 0.3");
    batch(msdd_step { components: 3, ..good }, "components = 3, allowed: 6");
    let cold = [40.0, 0.0];
    batch(msdd_step { solid_conductivity: input(&cold), ..good }, "solid_conductivity[1] = 0");
    batch(msdd_step { emissivity: input(&cold), ..good }, "emissivity[0] = 40");
    let poor = [40.0, 0.01];
    batch(msdd_step { solid_conductivity: input(&poor), ..good }, "material.conductivity = 0.01");
    for (name, value, range) in [
        ("jamming_fraction", 0.2, "0.3 to 0.8"),
        ("elastic_compression", -5.0, "-0.9 to 0.5"),
        ("strength", -1.0, "0.01 to 8"),
        ("strength", 1e300, "0.01 to 8"),
        ("mobilised", 7.0, "0 to 1"),
        ("mobilised", -3.0, "0 to 1"),
        ("coordination", 1e9, "0 to 12"),
        ("coordination", -4.0, "0 to 12"),
        ("stress_ratio_3_xz", 1e200, "-2 to 2"),
    ] {
        let mut state = state.clone();
        state[NAMES.iter().position(|known| *known == name).unwrap()][1] = value;
        let columns = inputs(&state);
        let said = format!("{name}[1] = {}, allowed: {range}", ::msdd_rve::message::number(value));
        let with = msdd_step { state: columns.as_ptr(), ..good };
        refused(STEEL, with, MSDD_INVALID_ARGUMENT, &said);
    }
    let none = msdd_step { thermal_strain: input(&none), ..good };
    refused(STEEL, none, MSDD_NON_FINITE, "thermal_strain[1]");
    let material = |material, said| refused(material, good, MSDD_INVALID_ARGUMENT, said);
    material(msdd_grains { radius: 0.0, ..STEEL }, "material.radius = 0, allowed: 5e-10 to 500 m");
    material(msdd_grains { size_spread: 0.5, ..STEEL }, "material.size_spread = 0.5, allowed: 0 to 0.25");
    material(msdd_grains { gas: c"steam".as_ptr(), ..STEEL }, "material.gas = steam, allowed: air");
    material(msdd_grains { gas_pressure: 0.0, ..STEEL }, "material.gas_pressure = 0");
    material(msdd_grains { emissivity: 1.5, ..STEEL }, "material.emissivity = 1.5, allowed: 0 to 1");
    material(msdd_grains { roughness: 1e-6, hardness: 0.0, ..STEEL }, "material.hardness = 0");
    material(msdd_grains { conductivity: 0.01, ..STEEL }, "at least that of the gas, which is 0.02");
    let wanted = distance_of(&law, &distance);
    refused(
        STEEL,
        msdd_step { distance: wanted.as_ptr(), ..good },
        MSDD_INVALID_ARGUMENT,
        "distance = not NULL",
    );
}

/// A table for `distance` in which one column is wanted.
fn distance_of(law: &Model, wanted: &[crate::abi::msdd_output; 1]) -> Vec<crate::abi::msdd_output> {
    let mut table = vec![UNWANTED; law.columns() + 1];
    table[0] = wanted[0];
    table
}

/// Files say which kind of model they hold; a solid fraction of spheres is what the pores leave.
#[test]
fn one_function_loads_discs_and_spheres() {
    let file = |name: &str| load(&format!("{}/../surrogate/models/{name}.json", env!("CARGO_MANIFEST_DIR")));
    let (discs, spheres) = (file("increment"), file("spheres"));
    // SAFETY: live.
    let components = |model: &Model| unsafe { msdd_model_components(model.0) };
    assert_eq!([components(&discs), components(&spheres)], [3, 6]);
    let hash = |model: &Model| model.text(msdd_model_hash as unsafe extern "C" fn(_) -> *const c_char);
    assert_eq!([hash(&discs), hash(&spheres)], [hash(&load("builtin")), hash(&builtin())]);
    let (porosity, mut solid) = ([0.4, 0.375], [0.0; 2]);
    // SAFETY: live handle, columns of two.
    let status = unsafe { msdd_model_solid_fraction(spheres.0, 2, porosity.as_ptr(), solid.as_mut_ptr()) };
    assert_eq!((status, solid), (MSDD_OK, [0.6, 0.625]));
}

/// A smooth steel wall.
const WALL: msdd_sphere_wall = msdd_sphere_wall {
    struct_size: size_of::<msdd_sphere_wall>(),
    conductivity: 42.0,
    young_modulus: 2e11,
    poisson_ratio: 0.0,
    roughness: 0.0,
    hardness: 0.0,
    spheres: 0.9,
    emissivity: 0.8,
};

/// Contacts of Hertz in a vacuum: 0.8 of 2 a k with a^3 = 3 F R/(4 E*), less 0.88 R/K. Gas takes from the resistance, and no load leaves none but gas.
#[test]
fn walls_have_the_resistance_of_their_spheres() {
    let vacuum = msdd_grains { gas: null(), ..STEEL };
    let ask = |material: &msdd_grains, wall: &msdd_sphere_wall, stress: [f64; 2]| {
        let (temperature, conductivity, mut found) = ([300.0; 2], [0.5; 2], [0.0; 2]);
        let [s, t, k] = [stress, temperature, conductivity];
        // SAFETY: columns of two values.
        let status = unsafe {
            msdd_wall_resistance(material, wall, 2, s.as_ptr(), t.as_ptr(), k.as_ptr(), found.as_mut_ptr())
        };
        (status, found)
    };
    let (status, found) = ask(&vacuum, &WALL, [1e4, 0.0]);
    let square = 6.4e-3 * 6.4e-3 / 0.9;
    let a = (0.75 * 1e4 * square * 3.2e-3 / MODULUS).cbrt();
    let expected = square / (0.8 * 2.0 * a * 42.0) - 0.88 * 3.2e-3 / 0.5;
    assert!(status == MSDD_OK && (found[0] / expected - 1.0).abs() < 1e-12, "{found:?} {expected}");
    assert_eq!(found[1], 1e9);
    let (_, gas) = ask(&STEEL, &WALL, [1e4, 0.0]);
    assert!(gas[0] < found[0] && gas[0] < gas[1] && gas[1] < 0.1, "{gas:?}");
    // Both have to radiate.
    let (bright, cold) =
        (msdd_grains { emissivity: 0.8, ..vacuum }, msdd_sphere_wall { emissivity: 0.0, ..WALL });
    assert_eq!(ask(&bright, &cold, [1e4, 0.0]).1, found);
    let radiating = ask(&bright, &WALL, [1e4, 0.0]).1;
    // 4 σ T³ = 6.12 W/(m² K) of black bodies at 300 K.
    assert!(radiating[0] < found[0] && 1.0 / (radiating[1] + 3.2e-3 / 0.5) < 6.12, "{radiating:?}");
    for (wall, said) in [
        (msdd_sphere_wall { emissivity: 2.0, ..WALL }, "wall.emissivity = 2, allowed: 0 to 1"),
        (msdd_sphere_wall { spheres: 2.0, ..WALL }, "wall.spheres = 2, allowed: 0.01 to 1.16"),
        (msdd_sphere_wall { roughness: 1e-6, ..WALL }, "wall.hardness = 0"),
        (msdd_sphere_wall { conductivity: 0.0, ..WALL }, "wall.conductivity = 0"),
        (msdd_sphere_wall { struct_size: 8, ..WALL }, "wall.struct_size = 8"),
    ] {
        let (status, _) = ask(&STEEL, &wall, [1e4; 2]);
        assert!(status == MSDD_INVALID_ARGUMENT && last_error().contains(said), "{status}: {}", last_error());
    }
    assert_eq!(ask(&STEEL, &WALL, [f64::NAN, 0.0]).0, MSDD_NON_FINITE);
}
