//! Answers for blocks of cells.

use super::model::{Answer, Answers, Block, Increment, Wanted, columns};
use super::tests::{model, packing, random, tensor};
use crate::kernel::{LANES, with_every_set};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Packings of all kinds in one block: with and without strain, few and many parts, opening until they do not touch.
#[test]
fn answers_do_not_depend_on_the_instruction_set_nor_on_the_other_cells() {
    let (model, mut generator) = (model(), ChaCha8Rng::seed_from_u64(12));
    for round in 0..20 {
        let mut block = Block::default();
        let mut cells = Vec::new();
        for lane in 0..LANES {
            let state = columns(&packing(&model.file.law, &mut generator));
            let size = [0.0, 1e-6, 1e-4, 3e-2][(lane + round) % 4];
            let strain = Increment {
                thermal: 0.1 * size * random(&mut generator),
                cell: tensor(&mut generator, size),
                rotation: [0.0, 0.0, size * random(&mut generator)],
            };
            block.state.iter_mut().zip(state).for_each(|(column, value)| column[lane] = value);
            block.cell.iter_mut().zip(strain.cell).for_each(|(column, value)| column[lane] = value);
            block.rotation.iter_mut().zip(strain.rotation).for_each(|(column, value)| column[lane] = value);
            block.thermal[lane] = strain.thermal;
            block.gas_number[lane] = 5.0 + 0.1 * lane as f64;
            cells.push((state, strain));
        }
        let bits = |answer: &Answer| {
            let mut numbers = answer.state.to_vec();
            numbers.extend(
                answer
                    .stress
                    .iter()
                    .chain(&answer.contact)
                    .chain(&answer.gas_deviator)
                    .chain(answer.tangent.as_flattened()),
            );
            numbers.extend([answer.gas, answer.solid, answer.coordination, f64::from(answer.outside)]);
            numbers.into_iter().map(f64::to_bits).collect::<Vec<u64>>()
        };
        for tangent in [false, true] {
            let mut first: Option<Vec<Vec<u64>>> = None;
            with_every_set(|set| {
                let mut answers = Answers::default();
                let wanted = Wanted { strains: if tangent { 6 } else { 0 }, conduction: true };
                model.advance_block(&block, LANES, wanted, &mut answers);
                let all: Vec<Vec<u64>> = (0..LANES).map(|lane| bits(&answers.at(lane))).collect();
                for (lane, (state, strain)) in cells.iter().enumerate() {
                    let alone = model.advance(state, strain, block.gas_number[lane], tangent);
                    assert_eq!(bits(&alone), all[lane], "{set}, cell {lane} of block {round}");
                    // The stress does not depend on whether the tangent is asked for.
                    let without = model.advance(state, strain, block.gas_number[lane], false);
                    assert_eq!(without.stress.map(f64::to_bits), alone.stress.map(f64::to_bits));
                }
                // Nor does the tangent on how many of its columns are, and nothing on whether the conduction is.
                let wanted = Wanted { strains: if tangent { 4 } else { 0 }, conduction: false };
                let mut fewer = answers.clone();
                model.advance_block(&block, LANES, wanted, &mut fewer);
                for row in &mut answers.tangent {
                    row[4..].fill([0.0; LANES]);
                }
                for lane in 0..LANES {
                    assert_eq!(bits(&answers.at(lane)).len(), bits(&fewer.at(lane)).len());
                    assert!(bits(&answers.at(lane)) == bits(&fewer.at(lane)), "{set}, cell {lane}");
                }
                assert!(first.get_or_insert_with(|| all.clone()) == &all, "{set}");
            });
        }
    }
}
