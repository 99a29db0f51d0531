//! Good and faulty plug-ins, compiled from `plain.c`: every fault has a message of its own.

use msdd_plugin::{InitialColumns, Plugin, PluginError, Step};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Compiles `plain.c` with macros into a shared library of this name.
fn compiled(name: &str, macros: &[&str]) -> PathBuf {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.so"));
    let status = Command::new(std::env::var("CC").unwrap_or_else(|_| "cc".to_string()))
        .args(["-std=c99", "-shared", "-fPIC", "-Wall", "-Wextra", "-Werror"])
        .arg(format!("-I{}", crate_folder.join("../capi/include").display()))
        .args(macros.iter().map(|part| format!("-D{part}")))
        .arg(crate_folder.join("tests/plain.c"))
        .arg("-o")
        .arg(&out)
        .status();
    assert!(status.expect("a C compiler").success(), "{name} does not compile");
    out
}

fn refused(path: &Path) -> String {
    Plugin::load(path).expect_err("unfit").to_string()
}

const STEP: Step = Step {
    state: &[&[0.12, 0.13, 0.14], &[0.0, 0.01, 0.02]],
    thermal_strain: &[0.0, 0.01, -0.01],
    strain: None,
    wants_tangent: false,
};

const START: InitialColumns = InitialColumns {
    porosity: &[0.1],
    fabric_index: &[0.2],
    fabric_xy: None,
    stress: None,
    conductivity: None,
};

#[test]
fn a_plain_plugin_answers() {
    let plugin = Plugin::load(&compiled("plain", &[])).expect("fit");
    assert_eq!((plugin.name(), plugin.hash().len()), ("plain", 64));
    assert_eq!(plugin.state_names(), ["porosity", "fabric_index"]);
    assert!(!plugin.has_tangent() && !plugin.has_solid_fraction() && plugin.wall_friction().is_none());
    let answer = plugin.advance(&STEP).expect("good");
    assert_eq!(answer.state, [vec![0.12, 0.13 - 0.01, 0.14 + 0.01], vec![0.0, 0.01, 0.02]]);
    assert_eq!((answer.conductivity[1][2], answer.stress[0][1]), (0.3, 0.05));
    assert_eq!(answer.outside, vec![vec![0.0; 3]; 3]);
    assert_eq!(plugin.spread(STEP.state).expect("none"), None);
    // Without a tangent it is neither asked for one nor told of strains.
    let strained = Step { wants_tangent: true, ..DEFORMED };
    assert_eq!(plugin.advance(&strained).expect("good"), answer);
    assert_eq!(answer.tangent, None);
    assert_eq!((&answer.conductivity[2], &answer.stress[2]), (&vec![0.0; 3], &vec![0.0; 3]));
    assert_eq!(plugin.initial_state(&START).expect("good"), [[0.1], [0.2]]);
    let nothing = Step { state: &[&[], &[]], thermal_strain: &[], ..STEP };
    assert_eq!(plugin.advance(&nothing).expect("nothing to do").state, vec![vec![0.0; 0]; 2]);
}

#[test]
fn each_bad_table_has_its_own_text() {
    let size = size_of::<msdd_abi::msdd_plugin_v2>();
    for (name, macros, expected) in [
        (
            "symbol",
            &["msdd_plugin_v2_table=other_table"][..],
            "has no function msdd_plugin_v2_table".to_string(),
        ),
        (
            "old",
            &["msdd_plugin_v2_table=other_table", "OLD"],
            "has version 1 of the plug-in interface, which has no shear; this library has version 2"
                .to_string(),
        ),
        ("null", &["RETURNS=NULL"], "msdd_plugin_v2_table returned NULL".to_string()),
        (
            "version",
            &["CHANGE=table.version=3"],
            "has version 3 of the plug-in table, this library has 2".to_string(),
        ),
        (
            "size",
            &["CHANGE=table.struct_size=40"],
            format!("struct_size of its table is 40, allowed: {size}"),
        ),
        ("advance", &["CHANGE=table.advance=NULL"], "advance is NULL".to_string()),
        ("initial", &["CHANGE=table.initial_state=NULL"], "initial_state is NULL".to_string()),
        ("tangent", &["CHANGE=table.has_tangent=2"], "has_tangent = 2, allowed: 0, 1".to_string()),
        ("name", &["CHANGE=table.name=NULL"], "name is NULL".to_string()),
        ("empty", &["CHANGE=table.name=\"\""], "name is empty".to_string()),
        ("utf8", &["CHANGE=table.name=\"\\xff\""], "is not UTF-8".to_string()),
        ("names", &["CHANGE=table.state_names=NULL"], "state_names is NULL".to_string()),
        ("one", &["NAMES=\"porosity\""], "state_size = 1, allowed: 2 to 64".to_string()),
        ("hole", &["NAMES=\"porosity\",NULL"], "state_names[1] is NULL".to_string()),
        ("order", &["NAMES=\"fabric_index\",\"porosity\""], "state_names[0] = \"fabric_index\"".to_string()),
        (
            "twice",
            &["NAMES=\"porosity\",\"fabric_index\",\"porosity\""],
            "\"porosity\" is there twice".to_string(),
        ),
        (
            "underscore",
            &["NAMES=\"porosity\",\"fabric_index\",\"porosity_\""],
            "state_names[2] = \"porosity_\" differs from \"porosity\" in underscores or capitals alone"
                .to_string(),
        ),
        (
            "capital",
            &["NAMES=\"porosity\",\"fabric_index\",\"fabricIndex\""],
            "\"fabricIndex\" differs from \"fabric_index\" in underscores or capitals alone".to_string(),
        ),
        (
            "path",
            &["NAMES=\"porosity\",\"fabric_index\",\"../../escaped\""],
            "state_names[2] = \"../../escaped\", allowed: a letter, and then letters".to_string(),
        ),
        ("digit", &["NAMES=\"porosity\",\"fabric_index\",\"2nd\""], "state_names[2] = \"2nd\"".to_string()),
        ("blank", &["NAMES=\"porosity\",\"fabric_index\",\"a b\""], "state_names[2] = \"a b\"".to_string()),
        (
            "control",
            &["NAMES=\"porosity\",\"fabric_index\",\"a\\nb\""],
            "state_names[2] = \"a\\nb\"".to_string(),
        ),
        (
            "long",
            &[concat!(
                "NAMES=\"porosity\",\"fabric_index\",\"",
                "a123456789b123456789c123456789d123456789e123456789f123456789g1234\""
            )],
            "f123456789g123\" and more, allowed: a letter".to_string(),
        ),
        (
            "kind",
            &["CHANGE=table.network_conductivity=2"],
            "network_conductivity = 2, allowed: 0, 1".to_string(),
        ),
        ("friction", &["CHANGE=table.wall_friction_limit=0.3"], "limit 0.3 and slip 0".to_string()),
    ] {
        let path = compiled(&format!("bad-{name}"), macros);
        let message = refused(&path);
        assert!(
            message.contains(&expected) && message.contains(&*path.to_string_lossy()),
            "{name}: {message}"
        );
    }
}

#[test]
fn files_that_are_no_library_for_this_machine_are_refused_before_they_are_loaded() {
    let good = std::fs::read(compiled("patched", &[])).expect("readable");
    let patched = |name: &str, change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = good.clone();
        change(&mut bytes);
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        std::fs::write(&path, bytes).expect("writable");
        path
    };
    let other = if cfg!(target_arch = "x86_64") { 183 } else { 62 };
    let message = refused(&patched("machine.so", &|bytes| bytes[18] = other));
    assert!(
        message.contains(&format!("built for another machine (ELF machine {other}, 64 bits)")),
        "{message}"
    );
    let message = refused(&patched("bits.so", &|bytes| bytes[4] = 1));
    assert!(message.contains("built for another machine") && message.contains("32 bits"), "{message}");
    let message = refused(&patched("text.so", &|bytes| *bytes = b"no machine code here".to_vec()));
    assert!(message.contains("is no shared library"), "{message}");
    let message = refused(&patched("cut.so", &|bytes| bytes.truncate(100)));
    assert!(message.contains("the system's loader refuses it"), "{message}");
    let missing = Path::new("/no/such/plugin.so");
    assert!(matches!(Plugin::load(missing), Err(PluginError::Read { .. })));
    assert!(refused(missing).contains("/no/such/plugin.so"));
}

#[test]
fn failures_come_with_the_text_of_the_plugin() {
    let message = |name: &str, macros: &[&str]| {
        let plugin = Plugin::load(&compiled(name, macros)).expect("fit");
        plugin.advance(&STEP).expect_err("fails").to_string()
    };
    let told = message("fails", &["FAILS=-3"]);
    assert!(told.contains("plug-in \"plain\""), "{told}");
    assert!(told.contains("advance failed with status -3: the table of isotherms is empty"), "{told}");
    let told = message("mute", &["FAILS=1", "CHANGE=table.last_error=NULL"]);
    assert!(told.contains("status 1: it gives no message"), "{told}");
}

#[test]
fn answers_that_no_grains_have_are_named_by_column_and_cell() {
    for (name, macros, expected) in [
        ("nan", "ANSWERS=step->next_state[1][2]=0.0/0.0", "state fabric_index[2] = "),
        ("infinite", "ANSWERS=step->stress_xx[1]=1e300*1e300", "stress_xx[1] = inf"),
        (
            "negative",
            "ANSWERS=step->conductivity_yy[1]=-0.1",
            "conductivity_yy[1] = -0.1, allowed: finite, above 0",
        ),
        ("zero", "ANSWERS=step->conductivity_xx[0]=0", "conductivity_xx[0] = 0,"),
        ("left", "LEAVES_STRESS", "stress_yy[0] = NaN"),
        ("outside", "ANSWERS=step->outside[2][0]=0.0/0.0", "outside thermal_strain[0] = "),
        (
            "huge",
            "ANSWERS=step->conductivity_xx[0]=1e300",
            "conductivity_xx[0] = 1e300, allowed: finite, above 0",
        ),
        ("tiny", "ANSWERS=step->conductivity_xx[0]=1e-300", "conductivity_xx[0] = 1e-300,"),
        (
            "tension",
            "ANSWERS=step->stress_yy[2]=-5e7",
            "stress_yy[2] = -50000000, allowed: 0 to 1e30: compression",
        ),
        (
            "crosswise",
            "ANSWERS=step->conductivity_xy[1]=-0.4",
            "conductivity_xy[1] = -0.4, allowed: conductivity_xy^2 below that of xx times yy",
        ),
        (
            "oblique",
            "ANSWERS=step->stress_xy[2]=0.06",
            "stress_xy[2] = 0.06, allowed: stress_xy^2 up to that of xx times yy: loose grains do not pull",
        ),
        ("unlike", "ANSWERS=step->stress_xy[0]=0.0/0.0", "stress_xy[0] = "),
        ("dense", "ANSWERS=step->next_state[0][1]=-3", "state porosity[1] = -3, allowed: 0 to 1"),
        ("loose", "ANSWERS=step->next_state[0][1]=5", "state porosity[1] = 5, allowed: 0 to 1"),
        ("fabric", "ANSWERS=step->next_state[1][2]=7", "state fabric_index[2] = 7, allowed: -1 to 1"),
        (
            "rest",
            "ANSWERS=step->next_state[1][0]=0.1",
            "state fabric_index[0] = 0.1, allowed: that before the step",
        ),
        (
            "calls",
            "ANSWERS=step->stress_xx[2]=calls",
            "stress_xx[2] = 2, allowed: the result of the call before",
        ),
    ] {
        let plugin = Plugin::load(&compiled(&format!("answer-{name}"), &[macros])).expect("fit");
        let message = plugin.advance(&STEP).expect_err(name).to_string();
        assert!(message.contains(expected) && message.contains("\"plain\""), "{name}: {message}");
    }
    let plugin = Plugin::load(&compiled("start", &["CHANGES_THE_START"])).expect("fit");
    let known = [0.1, 0.2];
    let start = InitialColumns { porosity: &known, fabric_index: &known, ..START };
    let message = plugin.initial_state(&start).expect_err("changed").to_string();
    assert!(
        message.contains("initial_state answered fabric_index[1] = 0.5, allowed: that given"),
        "{message}"
    );
}

/// Strains xx, yy, xy and rotation.
const DEFORMED: Step = Step {
    strain: Some([&[0.0, 0.01, 0.0], &[0.0, 0.0, -0.01], &[0.0, 0.02, 0.0], &[0.0, 0.0, 0.03]]),
    ..STEP
};

/// Compiles `plain.c` with a tangent and all other optional functions of a plug-in.
fn whole(name: &str, more: &str) -> Plugin {
    Plugin::load(&compiled(&format!("whole-{name}"), &["HAS_ALL", more])).expect("fit")
}

#[test]
fn strains_of_the_cell_and_the_tangent_reach_the_plugin_and_come_back() {
    let plugin = whole("good", "GOOD");
    assert!(plugin.has_tangent());
    let answer = plugin.advance(&DEFORMED).expect("good");
    assert_eq!(answer.state[0], [0.12, 0.13 - 0.01 + 0.005, 0.14 + 0.01 - 0.005]);
    assert_eq!(answer.state[1], [0.0, 0.01, 0.02 + 0.03]);
    assert_eq!(
        answer.stress,
        [vec![0.05, 0.04, 0.05 + 0.01], vec![0.05, 0.04, 0.05 + 0.01], vec![0.0, -0.01, 0.0]]
    );
    assert_eq!(answer.tangent, None, "not wanted");
    let wanted = plugin.advance(&Step { wants_tangent: true, ..DEFORMED }).expect("good");
    let tangent = wanted.tangent.clone().expect("wanted");
    let rows = [[1.0; 3], [1.0; 3], [0.0; 3], [1.0; 3], [1.0; 3], [0.0; 3], [0.0; 3], [0.0; 3], [0.5; 3]];
    assert_eq!(tangent, rows.map(|row| row.to_vec()));
    assert_eq!((wanted.state, wanted.stress), (answer.state, answer.stress));
    // Strains that are not given are none.
    assert_eq!(plugin.advance(&STEP).expect("good").state[0], [0.12, 0.13 - 0.01, 0.14 + 0.01]);
    for (name, macros, expected) in [
        ("soft", "ANSWERS=step->tangent[4][1]=-1e31", "tangent[4][1] = -1e31, allowed: -1e30 to 1e30"),
        ("undefined", "ANSWERS=step->tangent[8][2]=0.0/0.0", "tangent[8][2] = "),
        ("creeps", "ANSWERS=step->next_state[1][0]=0.1", "state fabric_index[0] = 0.1, allowed: that before"),
        ("tears", "ANSWERS=step->next_state[0][1]=2", "state porosity[1] = 2, allowed: 0 to 1"),
    ] {
        let step = Step { wants_tangent: true, ..DEFORMED };
        let message = whole(name, macros).advance(&step).expect_err(name).to_string();
        assert!(message.contains(&format!("advance answered {expected}")), "{name}: {message}");
    }
    // A cell that turns is not at rest.
    let turning = Step { strain: Some([&[0.0; 3], &[0.0; 3], &[0.0; 3], &[0.1, 0.0, 0.0]]), ..STEP };
    assert_eq!(plugin.advance(&turning).expect("good").state[1][0], 0.1);
}

#[test]
fn spreads_and_solid_fractions_are_those_of_grains() {
    for (name, macros, expected) in [
        ("spread", "SPREAD=-0.1", "spread answered spread[2] = -0.1, allowed: finite, not negative"),
        ("solid", "SOLID=2.5", "solid_fraction answered solid_fraction[2] = 2.5, allowed: above 0, to 2"),
        ("void", "SOLID=0", "solid_fraction answered solid_fraction[2] = 0, allowed: above 0, to 2"),
    ] {
        let plugin = whole(name, macros);
        let spread = plugin.spread(STEP.state).map(|_| ());
        let message =
            spread.and(plugin.solid_fraction(STEP.state[0]).map(|_| ())).expect_err(name).to_string();
        assert!(message.contains(expected), "{name}: {message}");
    }
}

/// The first call is made twice, so that a result that depends on the number of calls is found at the start.
#[test]
fn a_start_that_depends_on_the_number_of_calls_is_refused() {
    let names = "NAMES=\"porosity\",\"fabric_index\",\"age\"";
    let plugin = Plugin::load(&compiled("ages", &[names, "STARTS=start->state[2][0]=calls"])).expect("fit");
    let message = plugin.initial_state(&START).expect_err("ages").to_string();
    assert!(
        message.contains("initial_state answered state age[0] = 2, allowed: the result of the call before"),
        "{message}"
    );
}

/// If a plug-in says that a cell is outside of its range, the cell's next state is not checked: zero strain may change it,
/// and it need not be one that a packing can have.
#[test]
fn states_outside_are_the_callers() {
    let plugin = Plugin::load(&compiled("outside", &["ANSWERS=step->outside[0][0]=5"])).expect("fit");
    let step = Step { state: &[&[7.0, 8.0, 0.1], &[3.0, 0.0, 0.0]], thermal_strain: &[0.0; 3], ..STEP };
    assert_eq!(plugin.advance(&step).expect("the caller's").state[0], [7.0, 8.0, 0.1]);
}

/// A plug-in that writes to its inputs changes only copies.
#[test]
fn inputs_are_copies() {
    let write = |what: &str| format!("((double *){what})[1]=0.5");
    let inputs = ["step->state[0]", "step->thermal_strain", "step->strain_xx", "step->rotation"].map(write);
    let advances = format!("ANSWERS={}", inputs.join(","));
    let known =
        ["start->porosity", "start->fabric_xy", "start->stress_xy", "start->conductivity_yy"].map(write);
    let starts = format!("STARTS={}", known.join(","));
    let plugin = Plugin::load(&compiled("writes", &["HAS_ALL", &advances, &starts])).expect("fit");
    let [porosity, fabric, strain, xx, yy, xy, turn] =
        [[0.12, 0.13], [0.0, 0.01], [0.0, 0.01], [0.0, 0.02], [0.0, 0.0], [0.0, 0.01], [0.0, 0.0]]
            .map(|c: [f64; 2]| c.to_vec());
    let given = [&porosity, &fabric, &strain, &xx, &yy, &xy, &turn].map(|column| column.clone());
    let state: [&[f64]; 2] = [&porosity, &fabric];
    let strains: Option<[&[f64]; 4]> = Some([&xx, &yy, &xy, &turn]);
    let step = Step { state: &state, thermal_strain: &strain, strain: strains, wants_tangent: true };
    let answer = plugin.advance(&step).expect("good");
    assert_eq!(answer.state[0], [0.12, 0.13 - 0.01 + 0.01]);
    let start = InitialColumns {
        porosity: &porosity,
        fabric_index: &fabric,
        fabric_xy: Some(&xy),
        stress: Some([&xx, &yy, &xy]),
        conductivity: Some([&strain, &turn, &xy]),
    };
    assert_eq!(plugin.initial_state(&start).expect("good"), [[0.12, 0.13], [0.0, 0.01]]);
    assert_eq!([porosity, fabric, strain, xx, yy, xy, turn], given);
}

/// All that is known at the start reaches the plug-in in its place; what is not known is NULL.
#[test]
fn a_start_passes_on_what_is_known() {
    let names = "NAMES=\"porosity\",\"fabric_index\",\"known\"";
    let sum = "STARTS=start->state[2][0]=(start->fabric_xy?start->fabric_xy[0]:0)\
        +(start->stress_xx?10*start->stress_xx[0]+100*start->stress_yy[0]+1e3*start->stress_xy[0]:0)\
        +(start->conductivity_xx?1e4*start->conductivity_xx[0]+1e5*start->conductivity_yy[0]+1e6*start->conductivity_xy[0]:0)";
    let plugin = Plugin::load(&compiled("knows", &[names, sum])).expect("fit");
    let known = |start: &InitialColumns| plugin.initial_state(start).expect("good")[2][0];
    let stress: Option<[&[f64]; 3]> = Some([&[2.0], &[3.0], &[4.0]]);
    let conductivity: Option<[&[f64]; 3]> = Some([&[5.0], &[6.0], &[7.0]]);
    assert_eq!(known(&START), 0.0);
    assert_eq!(known(&InitialColumns { fabric_xy: Some(&[1.0]), ..START }), 1.0);
    assert_eq!(known(&InitialColumns { stress, ..START }), 4320.0);
    assert_eq!(known(&InitialColumns { conductivity, ..START }), 7_650_000.0);
    assert_eq!(
        known(&InitialColumns { fabric_xy: Some(&[1.0]), stress, conductivity, ..START }),
        7_654_321.0
    );
}
