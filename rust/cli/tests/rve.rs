//! The program `msdd rve`: instruction sets, and the files that a failed run leaves.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder for one test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("msdd-cli-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn msdd(arguments: &str, state: Option<&Path>, out: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_msdd"));
    command.arg("rve").args(arguments.split_whitespace());
    if let Some(state) = state {
        command.arg("--state").arg(state);
    }
    command.arg("--out").arg(out).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn packed(folder: &Folder, arguments: &str) -> PathBuf {
    let state = folder.file("packed.json");
    let output = msdd(&format!("pack {arguments}"), None, &state);
    assert!(output.status.success(), "{}", stderr(&output));
    state
}

#[test]
fn every_instruction_set_writes_the_same_bytes() {
    let folder = Folder::new("simd");
    let arguments = "--discs 60 --porosity 0.13";
    let reference = std::fs::read(packed(&folder, arguments)).unwrap();
    for simd in msdd_dem::Simd::ALL.into_iter().filter(|simd| simd.available()) {
        let out = folder.file("simd.json");
        let name = format!("{simd:?}").to_lowercase();
        let output = msdd(&format!("pack {arguments} --simd {name}"), None, &out);
        assert!(output.status.success(), "{}", stderr(&output));
        assert!(std::fs::read(&out).unwrap() == reference, "{name}");
    }
    let output = msdd("pack --porosity 0.13 --simd sse9", None, &folder.file("no.json"));
    assert!(stderr(&output).contains("[possible values: scalar, avx2, avx512]"), "{}", stderr(&output));
}

/// Checks that the message on standard error names the file with the last good state, that `homogenise` can read this file,
/// and that the output file itself is not written.
fn assert_last_good(output: &Output, out: &Path) {
    let file = PathBuf::from(format!("{}.last-good.json", out.display()));
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains(&format!("is in {}", file.display())), "{message}");
    assert!(!out.exists());
    let averaged = Command::new(env!("CARGO_BIN_EXE_msdd"))
        .args(["rve", "homogenise", "--state"])
        .arg(&file)
        .output()
        .unwrap();
    assert!(averaged.status.success(), "{}", stderr(&averaged));
}

#[test]
fn an_expansion_that_fails_leaves_its_last_good_state() {
    let folder = Folder::new("expand");
    let (state, out) = (packed(&folder, "--discs 100 --porosity 0.06"), folder.file("out.json"));
    let absurd = "expand --stops 0.01,0.2 --xx=0,-0.2 --yy=0,-0.2 --rate 5";
    let output = msdd(absurd, Some(&state), &out);
    assert_last_good(&output, &out);
    assert!(String::from_utf8(output.stdout).unwrap().starts_with("strain +0.01: settled"));
}

#[test]
fn a_packing_that_fails_leaves_its_last_good_state() {
    let folder = Folder::new("pack");
    let out = folder.file("out.json");
    assert_last_good(
        &msdd("pack --discs 200 --porosity 0.01 --radius-min 1e-3 --radius-max 1e-2", None, &out),
        &out,
    );
}

/// The state file says that it has spheres, and all that is done with states follows it.
#[test]
fn boxes_of_spheres_are_packed_strained_and_averaged() {
    let folder = Folder::new("spheres");
    let pack = "--spheres 60 --pressure 1e-4 --friction 0.3 --packing-friction 0.1";
    let state = packed(&folder, pack);
    let text = std::fs::read_to_string(&state).unwrap();
    assert!(text.starts_with("{\"schema\":\"msdd-state-1\",\"dimension\":3,"), "{}", &text[..80]);
    let strained = |name: &str, arguments: &str, from: &Path| {
        let out = folder.file(name);
        let output = msdd(&format!("expand {arguments}"), Some(from), &out);
        assert!(output.status.success(), "{}", stderr(&output));
        out
    };
    let whole = strained("whole.json", "--strain 5e-4 --zz=-1e-3 --simd scalar", &state);
    assert_eq!(
        std::fs::read(&whole).unwrap(),
        std::fs::read(strained("again.json", "--strain 5e-4 --zz=-1e-3", &state)).unwrap()
    );
    let output = Command::new(env!("CARGO_BIN_EXE_msdd"))
        .args(["rve", "homogenise", "--state"])
        .arg(&whole)
        .output()
        .unwrap();
    let averages: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let number = |pointer: &str| averages.pointer(pointer).and_then(serde_json::Value::as_f64).unwrap();
    // It was closed along z, from a tenth of a thousandth of E*.
    assert!(number("/stress/zz") > number("/stress/xx") && number("/pressure") > 1e-4, "{averages}");
    assert!(number("/coordination") > 4.0 && number("/gas_conductivity/8.5") > 10.0, "{averages}");
    for (arguments, from, reason) in [
        ("pack --spheres 60 --pressure 1", None, "pressure = 1, allowed: 1e-8 to 0.001"),
        (
            "pack --spheres 60 --packing-friction 0.4",
            None,
            "packing_friction = 0.4, allowed: 0 to the friction, 0.3",
        ),
        ("pack --spheres 60 --shaking 1e-3", None, "shaking = 0.001, allowed: 0, or 0.002 to 0.1"),
        (
            "pack --spheres 60 --compression horizontal",
            None,
            "--compression: allowed: isotropic, uniaxial, sheared",
        ),
        ("pack --porosity 0.13 --compression uniaxial", None, "--compression: uniaxial, allowed: isotropic"),
        ("pack --spheres 60 --porosity 0.4", None, "cannot be used with"),
        ("expand --strain 0.01 --rate 1", Some(&state), "--rate: is for discs"),
        ("expand --zz=-0.5", Some(&state), "allowed: -0.2 to 0.2"),
        ("expand --zz=-0.1,0 --xx=0.1", Some(&state), "--xx: 1 values, expected 2, one a stop"),
    ] {
        let out = folder.file("refused.json");
        let output = msdd(arguments, from.map(PathBuf::as_path), &out);
        assert!(
            !output.status.success() && stderr(&output).contains(reason),
            "{arguments}: {}",
            stderr(&output)
        );
        assert!(!out.exists());
    }
}
