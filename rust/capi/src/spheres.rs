//! The model of spheres: in space, with the gas between them.

use crate::columns::{Input, Output};
use crate::grains::Grains;
use crate::model::BatchModel;
use crate::sphere_material::{GasThere, Material};
use crate::start::Start;
use crate::status::Failure;
use crate::step::Step;
use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::spheres::model::{Answers, Block, NAMES, SphereModel, Wanted, allowed};
use msdd_surrogate::spheres::state::PackingData;
use msdd_surrogate::spheres::tensor::Tensor;
use serde_json::Value;

/// \[K\]
const REFERENCE_TEMPERATURE: f64 = 293.15;
/// Besides [`OUTSIDE`](msdd_surrogate::spheres::model::OUTSIDE), in the column `outside`.
const OUTSIDE_BY_GAS: u8 = 8;

/// The model of spheres.
pub(crate) struct Spheres(pub SphereModel);

impl BatchModel for Spheres {
    fn name(&self) -> &str {
        "spheres"
    }

    fn hash(&self) -> &str {
        self.0.hash()
    }

    /// The model file.
    fn description(&self) -> Value {
        serde_json::from_str(&self.0.to_json()).unwrap_or_default()
    }

    fn state_names(&self) -> Vec<String> {
        NAMES.map(str::to_string).to_vec()
    }

    fn components(&self) -> usize {
        6
    }

    fn conductivity(&self) -> &'static str {
        "network"
    }

    fn has_tangent(&self) -> bool {
        true
    }

    fn initial_state(&self, start: &Start, grains: &Grains, state: &[Output<f64>]) -> Result<(), Failure> {
        let material = Material::new(grains)?;
        let solid = Start::needed(&start.solid_fraction, "solid_fraction", start.cells)?;
        if start.stress.is_empty() {
            return Err(Failure::null("stress"));
        }
        if let Some(column) = start.conductivity.iter().flatten().next() {
            let allowed = "NULL: that of spheres follows from their state";
            return Err(Failure::argument(column.name, "not NULL", allowed));
        }
        for cell in 0..start.cells {
            let stress: Tensor = std::array::from_fn(|k| {
                start.stress[k].map_or(0.0, |column| column.at(cell)) / material.modulus()
            });
            let known = PackingData {
                coordination: start.coordination.map(|column| column.at(cell) + material.more_contacts()),
                mobilised: start.mobilised.map(|column| column.at(cell)),
                fabric: (!start.fabric.is_empty()).then(|| std::array::from_fn(|k| start.fabric[k].at(cell))),
            };
            let found = self.0.initial_state(material.density() * solid.at(cell), stress, &known);
            state.iter().zip(found).for_each(|(column, value)| column.write_one(cell, value));
        }
        Ok(())
    }

    fn advance(&self, step: &Step, grains: &Grains) -> Result<usize, Failure> {
        let material = Material::new(grains)?;
        check(step)?;
        let one = |column: &Option<Input>, usual, cell| column.map_or(usual, |column: Input| column.at(cell));
        let there = |cell| {
            material.with(
                one(&step.solid_conductivity, material.solid_conductivity(), cell),
                one(&step.emissivity, material.emissivity(), cell),
            )
        };
        let wanted = wanted(step);
        // Everything that can be refused, before anything is written.
        let gas_at = |cell| there(cell).gas(one(&step.temperature, REFERENCE_TEMPERATURE, cell));
        let conducting = if wanted.conduction { step.cells } else { 0 };
        let gases: Vec<GasThere> = (0..conducting).map(gas_at).collect::<Result<_, _>>()?;
        let mut count = 0;
        let (mut block, mut answers) = (Block::default(), Answers::default());
        for first in (0..step.cells).step_by(LANES) {
            let here = (step.cells - first).min(LANES);
            block.state.iter_mut().zip(&step.state).for_each(|(lanes, column)| *lanes = column.lanes(first));
            // What is not given is 0.
            let read = |lanes: &mut [Lanes], columns: &[Option<Input>]| {
                for (lanes, column) in lanes.iter_mut().zip(columns) {
                    if let Some(column) = column {
                        *lanes = column.lanes(first);
                    }
                }
            };
            read(&mut block.cell, &step.strain);
            read(&mut block.rotation, &step.rotation);
            read(std::slice::from_mut(&mut block.thermal), &[step.thermal_strain]);
            let gases = gases.get(first..first + here).unwrap_or_default();
            block.gas_number.iter_mut().zip(gases).for_each(|(number, gas)| *number = gas.number);
            self.0.advance_block(&block, here, wanted, &mut answers);
            let write = |columns: &[Output<f64>], lanes: &[Lanes]| {
                columns.iter().zip(lanes).for_each(|(column, lanes)| column.write(first, lanes));
            };
            let in_pascal = |lanes: &Lanes| lanes.map(|value| value * material.modulus());
            write(&step.next_state, &answers.state);
            write(&step.stress, &answers.stress.each_ref().map(in_pascal));
            for (column, lanes) in step.tangent.iter().zip(answers.tangent.as_flattened()) {
                column.write(first, &in_pascal(lanes));
            }
            step.solid_fraction.write(first, &answers.solid.map(|solid| solid / material.density()));
            step.spread.write(first, &[f64::NAN; LANES]);
            for k in 0..here {
                let (cell, gas) = (first + k, gases.get(k));
                let of_gas = gas.is_some_and(|gas| gas.outside);
                let outside = answers.outside_at(k) | if of_gas { OUTSIDE_BY_GAS } else { 0 };
                step.outside.write_one(cell, outside);
                count += usize::from(outside > 0);
                let Some(gas) = gas else { continue };
                let found = there(cell).conductivity(&answers, k, gas);
                for (column, value) in step.conductivity.iter().zip(found.tensor) {
                    column.write_one(cell, value);
                }
                step.gas_conductivity.write_one(cell, found.gas);
                step.radiation_conductivity.write_one(cell, found.radiation);
            }
        }
        Ok(count)
    }

    /// Spheres overlap too little for the difference to count.
    fn solid_fraction(&self, porosity: &Input, result: &Output<f64>) -> Result<(), Failure> {
        (0..porosity.length()).for_each(|cell| result.write_one(cell, 1.0 - porosity.at(cell)));
        Ok(())
    }
}

fn check(step: &Step) -> Result<(), Failure> {
    for (k, column) in step.state.iter().enumerate() {
        let ([least, most], range) = allowed(k);
        column.check_range(least, most, range)?;
    }
    step.check_thermal_step()?;
    for (column, low, high, range) in [
        (&step.temperature, 0.0, 1e5, "0 to 1e5 K"),
        (&step.solid_conductivity, 1e-12, 1e12, "1e-12 to 1e12 W/(m K)"),
        (&step.emissivity, 0.0, 1.0, "0 to 1"),
    ] {
        if let Some(column) = column {
            column.check_range(low, high, range)?;
        }
    }
    step.refuse(&step.distance, "the model of spheres computes `outside` alone")
}

fn wanted(step: &Step) -> Wanted {
    // Columns of a row of the tangent, up to the last that is wanted in any of them.
    let strains = step.tangent.iter().enumerate().filter(|(_, column)| column.is_wanted());
    let strains = strains.map(|(k, _)| k % 6 + 1).max().unwrap_or(0);
    let conducts = step.conductivity.iter().chain([&step.gas_conductivity, &step.radiation_conductivity]);
    let mechanics_alone = strains > 0 || step.stress.iter().any(Output::is_wanted);
    let conduction = step.outside.is_wanted() || { conducts }.any(Output::is_wanted) || !mechanics_alone;
    Wanted { strains, conduction }
}
