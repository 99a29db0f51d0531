//! Good and bad plug-ins, compiled from `plain.c`: each fault has its own text.

use msdd_plugin::{Plugin, PluginError, Start, Step};
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
    virgin_share: None,
    strain: None,
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
    assert_eq!(plugin.tangent(STEP.state).expect("none"), None);
    let start = Start { porosity: &[0.1], fabric_index: &[0.2], fabric_conductivity: None, stress: None };
    assert_eq!(plugin.initial_state(&start).expect("good"), [[0.1], [0.2]]);
    let nothing = Step { state: &[&[], &[]], thermal_strain: &[], virgin_share: None, strain: None };
    assert_eq!(plugin.advance(&nothing).expect("nothing to do").state, vec![vec![0.0; 0]; 2]);
}

#[test]
fn each_bad_table_has_its_own_text() {
    let size = size_of::<msdd_abi::msdd_plugin_v1>();
    for (name, macros, expected) in [
        (
            "symbol",
            &["msdd_plugin_v1_table=other_table"][..],
            "has no function msdd_plugin_v1_table".to_string(),
        ),
        ("null", &["RETURNS=NULL"], "msdd_plugin_v1_table returned NULL".to_string()),
        (
            "version",
            &["CHANGE=table.version=2"],
            "has version 2 of the plug-in table, this library has 1".to_string(),
        ),
        (
            "size",
            &["CHANGE=table.struct_size=40"],
            format!("struct_size of its table is 40, allowed: {size}"),
        ),
        ("advance", &["CHANGE=table.advance=NULL"], "advance is NULL".to_string()),
        ("initial", &["CHANGE=table.initial_state=NULL"], "initial_state is NULL".to_string()),
        ("deform", &["TANGENT=tangent"], "deform is NULL, but tangent is not".to_string()),
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
    assert!(told.contains("status 1: it has no text for that"), "{told}");
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
    ] {
        let plugin = Plugin::load(&compiled(&format!("answer-{name}"), &[macros])).expect("fit");
        let message = plugin.advance(&STEP).expect_err(name).to_string();
        assert!(message.contains(expected) && message.contains("\"plain\""), "{name}: {message}");
    }
    let plugin = Plugin::load(&compiled("start", &["CHANGES_THE_START"])).expect("fit");
    let known = [0.1, 0.2];
    let start = Start { porosity: &known, fabric_index: &known, fabric_conductivity: None, stress: None };
    let message = plugin.initial_state(&start).expect_err("changed").to_string();
    assert!(
        message.contains("initial_state answered fabric_index[1] = 0.5, allowed: that given"),
        "{message}"
    );
}
