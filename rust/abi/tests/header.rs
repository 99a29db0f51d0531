//! `msdd.h` is the truth: `src/bindings.rs` is bindgen's view of it.

use std::path::Path;

fn bindings() -> String {
    let header = Path::new(env!("CARGO_MANIFEST_DIR")).join("../capi/include/msdd.h");
    let made = bindgen::Builder::default()
        .header(header.to_string_lossy())
        .clang_arg("-DMSDD_WITHOUT_V4")
        .allowlist_item("(msdd|MSDD)_.*")
        .use_core()
        .default_enum_style(bindgen::EnumVariation::Consts)
        .prepend_enum_name(false)
        .generate_comments(false)
        .layout_tests(true)
        .size_t_is_usize(true)
        .merge_extern_blocks(true)
        .disable_header_comment()
        .raw_line("//! What bindgen makes of `msdd.h`; `cargo test -p msdd-abi --test header` holds it against the header.")
        .rustfmt_configuration_file(Some(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rustfmt.toml")))
        .generate();
    made.expect("bindings from msdd.h").to_string()
}

/// Regenerate with `MSDD_WRITE_BINDINGS=1 cargo test -p msdd-abi --test header`.
#[test]
fn checked_in_bindings_are_those_of_the_header() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/bindings.rs");
    let found = std::panic::catch_unwind(bindings)
        .expect("bindgen needs libclang: install Debian's package libclang-dev (scripts/setup does)");
    if std::env::var_os("MSDD_WRITE_BINDINGS").is_some() {
        std::fs::write(&file, &found).expect("writable");
    }
    let expected = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(
        found == expected,
        "src/bindings.rs is not what bindgen makes of msdd.h: regenerate it, see the test"
    );
}
