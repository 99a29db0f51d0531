//! Results of a loaded model through the C functions.

use super::{Cells, Handle, MATERIAL, MSDD_INVALID_ARGUMENT, MSDD_OK, last_error, text};
use crate::abi;
use crate::exports::*;
use std::ffi::CStr;
use std::ptr::{null, null_mut};

const MODELS: [&CStr; 2] = [c"builtin", c"builtin:paper"];

#[test]
fn answers_are_the_models_in_si() {
    for name in MODELS {
        let handle = Handle::load(name);
        let mut cells = Cells::new(&handle, 11);
        cells.state[0][9] = 1e300;
        assert_eq!(cells.advance(&handle), MSDD_OK, "{}", last_error());
        let model = ::msdd_surrogate::models::builtin(name.to_str().expect("ASCII")).expect("shipped");
        for cell in 0..11 {
            let mut state = [0.0; 6];
            state.iter_mut().zip(&cells.state).for_each(|(value, column)| *value = column[cell]);
            let expected = model.evaluate(&state, cells.strain[cell]);
            let scale = 1e7 * 5e-3 * (1.0 + cells.total[cell]);
            let close = |o: usize, value: f64| {
                let found: f64 = cells.outputs[o][cell];
                assert!((found - value).abs() <= 1e-14 * value.abs(), "{name:?} {o}: {found} {value}");
            };
            for (column, lanes) in cells.next.iter().zip(&expected.state) {
                assert_eq!(column[cell].to_bits(), lanes[0].to_bits());
            }
            for k in [0, 1] {
                close(k, 100.0 * expected.conductivity[k][0]);
                close(2 + k, scale * expected.stress[k][0]);
            }
            assert_eq!(cells.clamped[cell], u8::from(cell == 9), "{name:?} {cell} {expected:?}");
            assert_eq!(cells.outside[0][cell] > 1.0, cell == 9);
        }
        assert_eq!(cells.clamped_cells, 1);
    }
}

#[test]
fn an_answer_does_not_depend_on_its_batch() {
    let handle = Handle::builtin();
    let mut all = Cells::new(&handle, 21);
    assert_eq!(all.advance(&handle), MSDD_OK);
    for cell in 0..21 {
        let mut one = Cells::new(&handle, 1);
        one.state = all.state.iter().map(|column| vec![column[cell]]).collect();
        (one.strain, one.total) = (vec![all.strain[cell]], vec![all.total[cell]]);
        assert_eq!(one.advance(&handle), MSDD_OK);
        for (single, batch) in one.outputs.iter().chain(&one.next).zip(all.outputs.iter().chain(&all.next)) {
            assert_eq!(single[0].to_bits(), batch[cell].to_bits());
        }
    }
}

#[test]
fn a_state_may_advance_in_place() {
    let handle = Handle::builtin();
    let (mut apart, mut shared) = (Cells::new(&handle, 19), Cells::new(&handle, 19));
    assert_eq!(apart.advance(&handle), MSDD_OK);
    let status = shared.with_batch(|batch| {
        batch.next_state = batch.state.cast();
        // SAFETY: live handle, full structs, columns of `cells` values.
        unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
    });
    assert_eq!(status, MSDD_OK);
    assert_eq!(shared.state, apart.next);
    assert_eq!(shared.outputs, apart.outputs);
}

#[test]
fn virgin_strains_slide_and_others_hardly() {
    let handle = Handle::builtin();
    let with = |share: Option<f64>| {
        let mut cells = Cells::new(&handle, 19);
        let column = share.map(|share| vec![share; 19]);
        let status = cells.with_batch(|batch| {
            batch.virgin_share = column.as_ref().map_or(null(), |column| column.as_ptr());
            // SAFETY: live handle, full structs, columns of `cells` values.
            unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
        });
        assert_eq!(status, MSDD_OK, "{}", last_error());
        cells.next
    };
    let [all, half, none] = [1.0, 0.5, 0.0].map(|share| with(Some(share)));
    assert_eq!(with(None), all);
    // The virgin share does not change porosity and pressure; it changes fabric index, f_K and deviator.
    assert!(none[0] == all[0] && none[2] == all[2]);
    for column in [1, 3, 4] {
        let cell = 3;
        let [all, half, none] = [&all, &half, &none].map(|next| next[column][cell]);
        assert!((none - all).abs() > 1e-8 && (half - 0.5 * (all + none)).abs() < 1e-12, "{column}");
    }
}

#[test]
fn zero_strain_and_unwanted_columns() {
    let handle = Handle::builtin();
    let mut cells = Cells::new(&handle, 3);
    cells.strain = vec![0.0; 3];
    let status = cells.with_batch(|batch| {
        (batch.total_thermal_strain, batch.stress_xx) = (null(), null_mut());
        (batch.clamped, batch.outside) = (null_mut(), null());
        // SAFETY: live handle, full structs, columns null or of `cells` values.
        unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
    });
    assert_eq!(status, MSDD_OK, "{}", last_error());
    assert!(cells.outputs[2] == [-7.0; 3] && cells.clamped == [9; 3] && cells.outputs[3][2] > 0.0);
    assert_eq!(cells.next, cells.state);
    let none = cells.with_batch(|batch| {
        (batch.cells, batch.thermal_strain) = (0, null());
        // SAFETY: no cells, so no column is touched.
        unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
    });
    assert_eq!(none, MSDD_OK);
}

/// Compression along x raises stress and stiffness and lowers the porosity by what the tangent says. The paper's model has
/// no tangent, and the message says so.
#[test]
fn mechanical_strain_follows_the_tangent() {
    let handle = Handle::builtin();
    // SAFETY: live.
    assert_eq!(unsafe { msdd_surrogate_has_tangent(handle.0) }, 1);
    let mut cells = Cells::new(&handle, 5);
    (cells.strain, cells.total) = (vec![0.0; 5], vec![0.0; 5]);
    let mut start = cells.clone();
    assert_eq!(start.advance(&handle), MSDD_OK);
    let (closing, mut tangent) = ([-1e-4; 5], [[0.0; 5]; 5]);
    let mut spread = [-7.0; 5];
    let status = cells.with_batch(|batch| {
        batch.strain_xx = closing.as_ptr();
        let [c11, c22, c12, porosity_rate, fabric_index_rate] = tangent.each_mut().map(|c| c.as_mut_ptr());
        (batch.c11, batch.c22, batch.c12) = (c11, c22, c12);
        (batch.porosity_rate, batch.fabric_index_rate) = (porosity_rate, fabric_index_rate);
        batch.spread = spread.as_mut_ptr();
        // SAFETY: live handle, full structs, columns of `cells` values.
        unsafe { msdd_surrogate_advance(handle.0, &MATERIAL, batch) }
    });
    assert_eq!(status, MSDD_OK, "{}", last_error());
    for cell in 0..5 {
        let rise = cells.outputs[2][cell] - start.outputs[2][cell];
        let expected = 1e-4 * tangent[0][cell];
        assert!((rise / expected - 1.0).abs() < 0.02, "{rise} {expected}");
        let lateral = cells.outputs[3][cell] - start.outputs[3][cell];
        assert!((lateral / (1e-4 * tangent[2][cell]) - 1.0).abs() < 0.02, "{lateral}");
        assert!(cells.next[0][cell] < start.next[0][cell] && tangent[1][cell] > 0.0);
        assert!(spread[cell] > 0.0 && spread[cell] < 1.0);
    }
    let paper = Handle::load(c"builtin:paper");
    let mut cells = Cells::new(&paper, 5);
    let status = cells.with_batch(|batch| {
        batch.strain_yy = closing.as_ptr();
        // SAFETY: live handle, full structs, columns of `cells` values.
        unsafe { msdd_surrogate_advance(paper.0, &MATERIAL, batch) }
    });
    assert_eq!(status, MSDD_INVALID_ARGUMENT);
    assert!(last_error().contains("no mechanical tangent"), "{}", last_error());
}

#[test]
fn strings_and_solid_fraction() {
    let handle = Handle::builtin();
    // SAFETY: live or null handle.
    let (hash, description, none) = unsafe {
        (msdd_surrogate_hash(handle.0), msdd_surrogate_describe(handle.0), msdd_surrogate_hash(null()))
    };
    assert!(none.is_null());
    assert_eq!(text(hash).len(), 64);
    assert!(text(description).contains(&text(hash)) && text(description).contains("provenance"));
    // SAFETY: no conditions.
    let (version, abi_version) = unsafe { (msdd_version(), msdd_abi_version()) };
    assert_eq!((text(version).as_str(), abi_version), (env!("CARGO_PKG_VERSION"), abi::MSDD_ABI_VERSION));
    // SAFETY: live handle.
    let name = |column| unsafe { msdd_surrogate_state_name(handle.0, column) };
    assert_eq!([text(name(0)), text(name(1))], ["porosity", "fabric_index"]);
    assert!(name(99).is_null());
    let (porosity, mut solid) = ([0.125; 9], [0.0; 9]);
    // SAFETY: live handle, columns of nine.
    let status = unsafe { msdd_surrogate_solid_fraction(handle.0, 9, porosity.as_ptr(), solid.as_mut_ptr()) };
    assert!(status == MSDD_OK && solid.iter().all(|s| *s > 0.875 && *s < 0.95), "{solid:?}");
}
