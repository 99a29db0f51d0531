//! Random columns of batches and random tables of plug-ins.

use crate::common::{Cells, Model, NOT_GIVEN, OK, UNWANTED, last_error};
use crate::mutations::{Random, TOKENS};
use msdd::abi;
use std::ptr::null;

/// A random number: extreme floating-point numbers, ends of ranges, and often a usual value.
fn number(random: &mut Random, usual: f64) -> f64 {
    match random.below(8) {
        0 => TOKENS[random.below(TOKENS.len())].parse().unwrap_or(f64::INFINITY),
        1 => -usual,
        2 => usual * 1e3,
        3 => f64::from_bits(random.next()),
        _ => usual,
    }
}

/// A batch of random columns, some of them left out, must give finite results, or be refused and write nothing.
pub fn batch(model: &Model, trial: usize) -> Result<bool, String> {
    let mut random = Random(((trial as u64) << 20) + 11);
    let mut cells = Cells::new(model, 1 + random.below(20));
    for _ in 0..random.below(4) {
        let cell = random.below(cells.outside.len());
        let column = random.below(cells.state.len() + 6);
        let others = [&mut cells.thermal_strain, &mut cells.total].into_iter().chain(&mut cells.strain);
        let column = cells.state.iter_mut().chain(others).nth(column).expect("a column");
        column[cell] = number(&mut random, column[cell]);
    }
    let (before, drop) = (cells.clone(), random.next());
    let status = cells.advance_with(model, |tables| {
        let absent = |bit: u32| drop >> bit & 1 == 1;
        let step = &mut tables.step;
        step.total_thermal_strain = if absent(0) { NOT_GIVEN } else { step.total_thermal_strain };
        for (column, bit) in tables.strain.iter_mut().zip([2, 3, 1]) {
            *column = if absent(bit) { NOT_GIVEN } else { *column };
        }
        step.tangent = if absent(4) { null() } else { step.tangent };
        step.rotation = if absent(7) { null() } else { step.rotation };
        tables.stress[2] = if absent(8) { UNWANTED } else { tables.stress[2] };
        tables.stress[1] = if absent(5) { UNWANTED } else { tables.stress[1] };
        if absent(6) {
            tables.in_place();
        }
    });
    if status == OK {
        let numbers = cells.state.iter().chain(&cells.next).chain(&cells.outputs).chain(&cells.distance);
        let finite = numbers.flatten().all(|value| value.is_finite());
        let grains = cells.outputs[0].iter().chain(&cells.outputs[1]).all(|k| *k > 0.0)
            && cells.outputs[2].iter().all(|s| *s >= 0.0);
        return match finite && grains {
            true => Ok(true),
            false => Err(format!("finite {finite}, grains {grains}: {cells:?} for {before:?}")),
        };
    }
    let refused = [abi::MSDD_INVALID_ARGUMENT, abi::MSDD_NON_FINITE, abi::MSDD_PLUGIN];
    let kept = cells.next == before.next && cells.outputs == before.outputs && cells.outside_cells == 99;
    match refused.iter().any(|known| *known as i32 == status) && kept {
        true => Ok(false),
        false => Err(format!("status {status}, {}, kept {kept}: {before:?}", last_error())),
    }
}

/// A plug-in with a random table, or with a good table and random results, must give valid results, or be refused with a
/// message that names it.
pub fn foreign(source: &str) -> Result<bool, String> {
    let named = |status: i32| match status == abi::MSDD_PLUGIN as i32 && last_error().contains("fuzzed") {
        true => Ok(false),
        false => Err(format!("status {status}: {}", last_error())),
    };
    let model = match Model::load(source) {
        Ok(model) => model,
        Err((status, _)) => return named(status),
    };
    let (cells, columns) = (5, model.columns());
    let mut cells = Cells::new_with(&model, cells, vec![vec![0.1; cells]; columns]);
    let before = cells.clone();
    match cells.advance_with(&model, |_| ()) {
        OK => (),
        status => {
            let kept = cells.next == before.next && cells.outputs == before.outputs;
            return if kept { named(status) } else { Err("wrote what it refused".to_string()) };
        }
    }
    let numbers = cells.next.iter().chain(&cells.outputs).chain(&cells.distance).flatten();
    let grains = cells.outputs[..2].iter().flatten().all(|k| *k > 0.0)
        && cells.outputs[2..4].iter().flatten().all(|s| *s >= 0.0)
        && cells.next[0].iter().all(|e| (0.0..=1.0).contains(e))
        && cells.next[1].iter().all(|f| (-1.0..=1.0).contains(f))
        && cells.state == before.state;
    match numbers.into_iter().all(|value| value.is_finite()) && grains {
        true => Ok(true),
        false => Err(format!("answered {cells:?}")),
    }
}
