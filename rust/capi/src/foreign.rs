//! Plug-ins: a plug-in writes the whole batch into columns of ours, which are checked, then converted to SI and copied into the
//! caller's columns.

use crate::columns::{Input, Output};
use crate::discs::{check, lanes_or_zero, porosity_and_fabric};
use crate::grains::Grains;
use crate::model::BatchModel;
use crate::si::Si;
use crate::start::{InPlane, Start, in_plane};
use crate::status::Failure;
use crate::step::Step;
use msdd_plugin::{Answer, Plugin};
use msdd_surrogate::dataset::ConductivityKind;
use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::network::padded;
use serde_json::{Value, json};

impl BatchModel for Plugin {
    fn name(&self) -> &str {
        Plugin::name(self)
    }

    fn hash(&self) -> &str {
        Plugin::hash(self)
    }

    fn description(&self) -> Value {
        let friction = Plugin::wall_friction(self);
        json!({
            "kind": "plugin",
            "name": self.name(),
            "hash": self.hash(),
            "state": Plugin::state_names(self),
            "components": self.components(),
            "conductivity": self.conductivity(),
            "conductivities": self.conductivities(),
            "has_tangent": Plugin::has_tangent(self),
            "wall_friction": friction.map(|f| json!({"limit": f.limit, "slip": f.slip})),
        })
    }

    fn state_names(&self) -> Vec<String> {
        Plugin::state_names(self).to_vec()
    }

    fn components(&self) -> usize {
        3
    }

    fn conductivity(&self) -> &'static str {
        let kind =
            if self.network_conductivity() { ConductivityKind::Network } else { ConductivityKind::Affine };
        kind.as_str()
    }

    fn has_tangent(&self) -> bool {
        Plugin::has_tangent(self)
    }

    fn wall_friction(&self) -> Option<[f64; 2]> {
        Plugin::wall_friction(self).map(|friction| [friction.limit, friction.slip])
    }

    fn initial_state(&self, start: &Start, grains: &Grains, state: &[Output<f64>]) -> Result<(), Failure> {
        let si = Si::new(grains)?;
        let tensor = |columns: Option<InPlane>, convert: &dyn Fn(f64) -> f64| {
            let of = |input: Input| input.to_vec().into_iter().map(convert).collect::<Vec<f64>>();
            columns.map(|([xx, yy], xy)| [of(xx), of(yy), xy.map_or_else(|| vec![0.0; start.cells], of)])
        };
        let stress = tensor(in_plane("stress", &start.stress)?, &|stress| si.reduced(stress));
        let conductivity = tensor(in_plane("conductivity", &start.conductivity)?, &|k| si.of_grains(k));
        let fabric_xy = start.fabric_xy.map(Input::to_vec);
        let (porosity, fabric_index) = porosity_and_fabric(start)?;
        let known = msdd_plugin::InitialColumns {
            porosity: &porosity.to_vec(),
            fabric_index: &fabric_index.to_vec(),
            fabric_xy: fabric_xy.as_deref(),
            stress: stress.as_ref().map(|stress| stress.each_ref().map(Vec::as_slice)),
            conductivity: conductivity.as_ref().map(|k| k.each_ref().map(Vec::as_slice)),
        };
        for (output, values) in state.iter().zip(Plugin::initial_state(self, &known)?) {
            output.write_all(&values);
        }
        Ok(())
    }

    /// Nothing is written before all answers have been checked.
    fn advance(&self, step: &Step, grains: &Grains) -> Result<usize, Failure> {
        let si = Si::new(grains)?;
        check(step, self.name(), Plugin::has_tangent(self))?;
        let answer = evaluate(self, step)?;
        let state: Vec<&[f64]> = answer.state.iter().map(Vec::as_slice).collect();
        let spread = if step.spread.is_wanted() { self.spread(&state)? } else { None };
        write(step, &answer, &si);
        step.spread.write_all(&spread.unwrap_or_else(|| vec![f64::NAN; step.cells]));
        Ok((0..step.cells).filter(|&cell| is_outside(&answer, cell)).count())
    }

    fn solid_fraction(&self, porosity: &Input, result: &Output<f64>) -> Result<(), Failure> {
        let answer = Plugin::solid_fraction(self, &porosity.to_vec())?
            .ok_or_else(|| Failure::argument("model", self.name(), "a plug-in that has solid fractions"))?;
        result.write_all(&answer);
        Ok(())
    }
}

fn evaluate(plugin: &Plugin, step: &Step) -> Result<Answer, Failure> {
    let or_zero = |column: Option<&Option<Input>>| {
        column.copied().flatten().map_or_else(|| vec![0.0; step.cells], Input::to_vec)
    };
    let state: Vec<Vec<f64>> = step.state.iter().map(|column| column.to_vec()).collect();
    let thermal = or_zero(Some(&step.thermal_strain));
    let strain = [step.strain.first(), step.strain.get(1), step.strain.get(2), step.rotation.first()];
    let strain = strain.map(or_zero);
    Ok(plugin.advance(&msdd_plugin::Step {
        state: &state.iter().map(Vec::as_slice).collect::<Vec<&[f64]>>(),
        thermal_strain: &thermal,
        strain: Plugin::has_tangent(plugin).then_some(strain.each_ref().map(Vec::as_slice)),
        wants_tangent: step.wants_tangent(),
    })?)
}

fn write(step: &Step, answer: &Answer, si: &Si) {
    // All that needs the total strain is computed first, because that may be in a column that is written below.
    let in_pascal = |column: &Vec<f64>| converted(step, column, |lanes, total| si.stress(lanes, total));
    let stress = answer.stress.each_ref().map(in_pascal);
    let tangent: Vec<Vec<f64>> = answer.tangent.iter().flatten().map(in_pascal).collect();
    let conductivity = answer.conductivity.each_ref();
    let conductivity = conductivity.map(|column| converted(step, column, |lanes, _| si.conductivity(lanes)));
    let write = |columns: &[Output<f64>], values: &[Vec<f64>]| {
        columns.iter().zip(values).for_each(|(output, values)| output.write_all(values));
    };
    write(&step.next_state, &answer.state);
    write(&step.tangent, &tangent);
    write(&step.conductivity, &conductivity);
    write(&step.stress, &stress);
    write(&step.distance, &answer.outside);
    let outside: Vec<u8> = (0..step.cells).map(|cell| u8::from(is_outside(answer, cell))).collect();
    step.outside.write_all(&outside);
}

/// Converts a column to SI with the function that converts the blocks of our own models, too.
fn converted(step: &Step, column: &[f64], convert: impl Fn(Lanes, &Lanes) -> Lanes) -> Vec<f64> {
    let mut result = Vec::with_capacity(step.cells);
    for first in (0..step.cells).step_by(LANES) {
        let here = LANES.min(step.cells - first);
        let total = lanes_or_zero(Some(&step.total_thermal_strain), first);
        let lanes = convert(padded(here, |lane| column[first + lane]), &total);
        result.extend_from_slice(&lanes[..here]);
    }
    result
}

fn is_outside(answer: &Answer, cell: usize) -> bool {
    answer.outside.iter().any(|column| column[cell] != 0.0)
}
