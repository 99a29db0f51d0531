//! Boxes of grains and databases.

use super::*;
use crate::abi::{msdd_averages, msdd_rve};
use std::ffi::{CStr, CString};

fn pack(specification: &CStr) -> Result<*mut msdd_rve, (i32, String)> {
    let mut rve = null_mut();
    // SAFETY: a C string and a writable pointer.
    match unsafe { msdd_rve_pack(specification.as_ptr(), &mut rve) } {
        MSDD_OK => Ok(rve),
        status => Err((status, last_error())),
    }
}

fn averages(rve: *const msdd_rve) -> msdd_averages {
    // SAFETY: a struct of numbers.
    let mut result: msdd_averages = unsafe { std::mem::zeroed() };
    result.struct_size = size_of::<msdd_averages>();
    // SAFETY: live handle, full struct.
    assert_eq!(unsafe { msdd_rve_homogenise(rve, &mut result) }, MSDD_OK, "{}", last_error());
    result
}

/// An RVE is packed and strained; read back from its text it behaves exactly like the original.
#[test]
fn an_rve_from_packing_to_text_and_back() {
    let rve = pack(c"{\"discs\": 60, \"seed\": 3, \"porosity\": 0.13}").expect("packs");
    let (mut twin, mut back, mut json, mut outcome) = (null_mut(), null_mut(), null_mut(), -1);
    // SAFETY: live handles, writable pointers, and each handle freed once at the end.
    unsafe {
        assert_eq!(msdd_rve_clone(rve, &mut twin), MSDD_OK);
        assert_eq!(msdd_rve_to_json(rve, &mut json), MSDD_OK);
        assert_eq!(msdd_rve_from_json(json, &mut back), MSDD_OK, "{}", last_error());
        let start = averages(rve);
        for handle in [rve, twin, back] {
            assert_eq!(msdd_rve_strain(handle, 0.01, 0.0, 0.0, 0.0, &mut outcome), MSDD_OK);
            assert_eq!(outcome, abi::MSDD_SETTLED as i32);
        }
        let end = averages(rve);
        assert!(end.pressure > start.pressure && end.porosity < start.porosity);
        assert_eq!(end.pressure.to_bits(), averages(twin).pressure.to_bits());
        assert_eq!(end.pressure.to_bits(), averages(back).pressure.to_bits());
        // Shear needs a periodic box; the RVE stays as it is.
        assert_eq!(msdd_rve_strain(rve, 0.0, 0.0, 0.0, 0.01, null_mut()), MSDD_INVALID_ARGUMENT);
        assert_eq!(averages(rve).pressure.to_bits(), end.pressure.to_bits());
        msdd_text_free(json);
        [rve, twin, back].into_iter().for_each(|handle| msdd_rve_free(handle));
    }
}

/// Every key of a specification has a default, also every key of the material.
#[test]
fn what_a_specification_leaves_out_is_as_usual() {
    let made = |specification: &CStr| {
        let (rve, mut json) = (pack(specification).expect("packs"), null_mut());
        // SAFETY: a live handle and a writable pointer; both are freed once.
        unsafe {
            assert_eq!(msdd_rve_to_json(rve, &mut json), MSDD_OK);
            let text = text(json);
            msdd_text_free(json);
            msdd_rve_free(rve);
            text
        }
    };
    let whole = made(
        c"{\"discs\": 30, \"porosity\": 0.15, \"material\": {\"density\": 3000, \"young_modulus\": 1e7, \
          \"stiffness_ratio\": 0.8, \"friction_angle\": 0.4, \"wall_stiffness_factor\": 1, \"damping\": 0.1}}",
    );
    let part = made(c"{\"discs\": 30, \"porosity\": 0.15, \"material\": {\"friction_angle\": 0.4}}");
    let usual = made(c"{\"discs\": 30, \"porosity\": 0.15, \"material\": {}}");
    assert!(whole == part && part != usual && usual == made(c"{\"discs\": 30, \"porosity\": 0.15}"));
}

#[test]
fn bad_specifications_and_states_are_refused() {
    let long = CString::new(format!("{{\"discs\": 60, \"x{}\": 1}}", "x".repeat(1 << 20))).expect("no NUL");
    let (status, message) = pack(&long).expect_err("refused");
    assert!(
        status == MSDD_INVALID_ARGUMENT && message.len() < 1000 && message.contains(" and more, allowed: "),
        "{message}"
    );
    for (specification, part) in [
        (c"[]", "specification = [], allowed: a JSON object"),
        (c"[40, 1, 0.12]", "allowed: a JSON object"),
        (c"7", "allowed: a JSON object"),
        (c"{\"material\": []}", "with \"material\" a JSON object"),
        (c"{\"material\": {\"friction\": 0.4}}", "unknown field `friction`"),
        (c"{\"disks\": 60}", "disks"),
        (c"{\"porosity\": 0.9}", "porosity"),
        (c"{\"compression\": \"vertical\"}", "vertical"),
        (c"{", "EOF"),
    ] {
        let (status, message) = pack(specification).expect_err("refused");
        assert!(status == MSDD_INVALID_ARGUMENT && message.contains(part), "{status} {message}");
    }
    let mut out = null_mut();
    // SAFETY: a C string and a writable pointer.
    assert_eq!(unsafe { msdd_rve_from_json(c"{}".as_ptr(), &mut out) }, MSDD_RVE);
    assert!(out.is_null());
}

/// A generation that is stopped after its first packing goes on where it stopped.
#[test]
fn a_database_is_made_in_two_goes() {
    const PLAN: &CStr = c"radius_min = 3e-3\nradius_max = 7e-3\nseed = 5\n[[thermal]]\ndiscs = 40\n\
        porosities = [0.13]\ncompressions = [\"isotropic\"]\nrepeats = 3\nstops = [0.001]\n";
    extern "C" fn stop_after_one(user: *mut std::ffi::c_void, done: u64, total: u64, _failed: u64) -> i32 {
        // SAFETY: `user` is the counter below.
        unsafe { *user.cast::<u64>() += 1 };
        assert_eq!(total, 3);
        i32::from(done == 1)
    }
    let folder = std::env::temp_dir().join(format!("msdd-capi-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("writable");
    let path = CString::new(folder.join("a.msdd").to_string_lossy().as_bytes()).expect("no NUL");
    let csv = CString::new(folder.join("a.csv").to_string_lossy().as_bytes()).expect("no NUL");
    let (mut calls, mut rows) = (0u64, 0u64);
    let user = (&raw mut calls).cast();
    // SAFETY: C strings, a call-back that takes the counter, and writable pointers.
    unsafe {
        let first = msdd_database_generate(PLAN.as_ptr(), path.as_ptr(), 1, Some(stop_after_one), user);
        assert_eq!((first, last_error().as_str()), (MSDD_CANCELLED, "stopped by the progress call-back"));
        assert_eq!(calls, 2);
        assert_eq!(msdd_database_generate(PLAN.as_ptr(), path.as_ptr(), 2, None, null_mut()), MSDD_OK);
        assert_eq!(msdd_database_export_csv(path.as_ptr(), csv.as_ptr(), &mut rows), MSDD_OK);
        assert_eq!(rows, 9);
        assert_eq!(
            msdd_database_generate(c"seed = 1".as_ptr(), path.as_ptr(), 1, None, null_mut()),
            MSDD_RVE
        );
    }
    std::fs::remove_dir_all(&folder).expect("removable");
}
