//! Models of discs, from the crate [`msdd_surrogate`]: cells are evaluated block by block and written into the caller's columns.

use crate::columns::{Input, Output};
use crate::grains::Grains;
use crate::model::BatchModel;
use crate::si::Si;
use crate::start::{InPlane, Start, in_plane};
use crate::status::Failure;
use crate::step::Step;
use msdd_surrogate::Surrogate;
use msdd_surrogate::dataset::ConductivityKind;
use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::surrogate::{Answer, Increment, InitialData, MAX_STATE, StateLanes, Tangent};
use serde_json::{Value, json};
use std::sync::Arc;

/// A model of the crate [`msdd_surrogate`].
pub(crate) struct Discs(pub Box<dyn Surrogate>);

/// Largest thermal strain: grains of eleven times their size, which no model describes, and still far from overflow.
const LARGEST_STRAIN: f64 = 10.0;

/// Refuses what no model of discs answers, and the mechanics of models without them.
pub(crate) fn check(step: &Step, name: &str, has_tangent: bool) -> Result<(), Failure> {
    step.state.iter().chain(&step.thermal_strain).try_for_each(Input::check_finite)?;
    if let Some(column) = &step.total_thermal_strain {
        column.check_above(-1.0, LARGEST_STRAIN, "above -1, to 10")?;
    }
    let of_spheres = [&step.gas_conductivity, &step.radiation_conductivity, &step.solid_fraction];
    step.refuse(of_spheres, "models of discs do not compute it")?;
    if !has_tangent && (step.deforms() || step.wants_tangent()) {
        let allowed = format!("NULL: model \"{name}\" has no mechanical tangent");
        return Err(Failure::argument("strain, rotation, tangent", "not NULL", allowed));
    }
    Ok(())
}

impl BatchModel for Discs {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn hash(&self) -> &str {
        self.0.hash()
    }

    /// The content of the model file without the weights.
    fn description(&self) -> Value {
        let model = &*self.0;
        let file: Value = serde_json::from_str(&model.to_json()).unwrap_or_default();
        json!({
            "kind": model.kind(),
            "name": model.name(),
            "hash": model.hash(),
            "state": model.state_names(),
            "components": self.components(),
            "conductivity": self.conductivity(),
            "conductivities": self.conductivities(),
            "has_tangent": model.has_tangent(),
            "wall_friction": model.wall_friction(),
            "trained_range": file.get("ranges").or(file.get("trained_range")),
            "schema": file["schema"],
            "provenance": file["provenance"],
        })
    }

    fn state_names(&self) -> Vec<String> {
        self.0.state_names().iter().map(|name| name.to_string()).collect()
    }

    fn components(&self) -> usize {
        3
    }

    fn conductivity(&self) -> &'static str {
        self.0.conductivity_kind().as_str()
    }

    fn conductivities(&self) -> Vec<&'static str> {
        self.0.conductivity_kinds().into_iter().map(ConductivityKind::as_str).collect()
    }

    fn with_conductivity(&self, kind: &str) -> Option<Arc<dyn BatchModel>> {
        let kind = self.0.conductivity_kinds().into_iter().find(|known| known.as_str() == kind)?;
        Some(Arc::new(Discs(self.0.answering_with(kind)?)))
    }

    fn has_tangent(&self) -> bool {
        self.0.has_tangent()
    }

    fn wall_friction(&self) -> Option<[f64; 2]> {
        self.0.wall_friction().map(|friction| [friction.limit, friction.slip])
    }

    fn initial_state(&self, start: &Start, grains: &Grains, state: &[Output<f64>]) -> Result<(), Failure> {
        let si = Si::new(grains)?;
        let (porosity, fabric_index) = porosity_and_fabric(start)?;
        let stress = in_plane("stress", &start.stress)?;
        let conductivity = in_plane("conductivity", &start.conductivity)?;
        let tensor = |columns: Option<InPlane>, cell| {
            columns.map(|([xx, yy], xy)| [xx.at(cell), yy.at(cell), xy.map_or(0.0, |column| column.at(cell))])
        };
        // Cells often start equal: an answer is found once for a run of equal ones.
        let mut last = None;
        for cell in 0..start.cells {
            let known = InitialData {
                porosity: porosity.at(cell),
                fabric_index: fabric_index.at(cell),
                fabric_xy: start.fabric_xy.map_or(0.0, |column| column.at(cell)),
                reduced_stress: tensor(stress, cell).map(|stress| stress.map(|stress| si.reduced(stress))),
                conductivity: tensor(conductivity, cell).map(|k| k.map(|k| si.of_grains(k))),
            };
            let found = match last {
                Some((before, found)) if before == known => found,
                _ => self.0.initial_state(&known),
            };
            last = Some((known, found));
            for (column, value) in state.iter().zip(found) {
                column.write_one(cell, value);
            }
        }
        Ok(())
    }

    fn advance(&self, step: &Step, grains: &Grains) -> Result<usize, Failure> {
        let si = Si::new(grains)?;
        check(step, self.0.name(), self.0.has_tangent())?;
        let (mut answer, mut tangent) = (Answer::default(), Tangent::default());
        let blocks = (0..step.cells).step_by(LANES);
        Ok(blocks.map(|first| self.fill(step, &si, first, (&mut answer, &mut tangent))).sum())
    }

    fn solid_fraction(&self, porosity: &Input, result: &Output<f64>) -> Result<(), Failure> {
        for first in (0..porosity.length()).step_by(LANES) {
            result.write(first, &porosity.lanes(first).map(|porosity| self.0.solid_fraction(porosity)));
        }
        Ok(())
    }
}

/// What every model of discs needs of a start.
pub(crate) fn porosity_and_fabric<'a>(start: &Start<'a>) -> Result<(Input<'a>, Input<'a>), Failure> {
    Ok((
        Start::needed(&start.porosity, "porosity", start.cells)?,
        Start::needed(&start.fabric_index, "fabric_index", start.cells)?,
    ))
}

/// The cells of a block; 0 for a column that is not given.
pub(crate) fn lanes_or_zero(column: Option<&Option<Input>>, first: usize) -> Lanes {
    column.copied().flatten().map_or([0.0; LANES], |column| column.lanes(first))
}

impl Discs {
    /// Evaluates the block of cells from `first` on; returns how many of them had an input outside the trained range.
    /// `answer` and `tangent` are scratch space for the results of a block.
    fn fill(
        &self,
        step: &Step,
        si: &Si,
        first: usize,
        (answer, tangent): (&mut Answer, &mut Tangent),
    ) -> usize {
        // All inputs of a block are read before any output is written, because the same column may be both.
        let mut state: StateLanes = [[0.0; LANES]; MAX_STATE];
        for (lanes, column) in state.iter_mut().zip(&step.state) {
            *lanes = column.lanes(first);
        }
        let total = lanes_or_zero(Some(&step.total_thermal_strain), first);
        let [xx, yy, xy] = [0, 1, 2].map(|k| lanes_or_zero(step.strain.get(k), first));
        let thermal = lanes_or_zero(Some(&step.thermal_strain), first);
        let rotation = lanes_or_zero(step.rotation.first(), first);
        let strain = Increment { thermal, xx, yy, xy, rotation };
        self.0.advance(&state, &strain, answer, step.wants_tangent().then_some(&mut *tangent));
        for (column, lanes) in step.tangent.iter().zip(tangent.as_flattened()) {
            column.write(first, &si.stress(*lanes, &total));
        }
        let outside = answer.lanes_outside();
        self.write(step, si, first, answer, &outside, &total);
        outside[..LANES.min(step.cells - first)].iter().filter(|outside| **outside).count()
    }

    fn write(
        &self,
        step: &Step,
        si: &Si,
        first: usize,
        answer: &Answer,
        outside: &[bool; LANES],
        total: &Lanes,
    ) {
        // For a state near the largest floating-point number, far outside of every trained range, the next state and its
        // distance from the range would overflow to infinity; they are limited to the largest number instead.
        let largest = |lanes: &Lanes| lanes.map(|value| value.clamp(f64::MIN, f64::MAX));
        for (column, lanes) in step.next_state.iter().zip(&answer.state) {
            column.write(first, &largest(lanes));
        }
        for (column, lanes) in step.conductivity.iter().zip(&answer.conductivity) {
            column.write(first, &si.conductivity(*lanes));
        }
        for (column, lanes) in step.stress.iter().zip(&answer.stress) {
            column.write(first, &si.stress(*lanes, total));
        }
        step.outside.write(first, &outside.map(u8::from));
        let strain = [&answer.outside[MAX_STATE]];
        for (column, lanes) in
            step.distance.iter().zip(answer.outside[..step.state.len()].iter().chain(strain))
        {
            column.write(first, &largest(lanes));
        }
        let lane_state = |lane: usize| answer.state.map(|column| column[lane]);
        if step.spread.is_wanted() {
            let spread =
                |lane| self.0.uncertainty(&lane_state(lane)).map_or(f64::NAN, |d| d.conductivity_spread);
            step.spread.write(first, &std::array::from_fn(spread));
        }
    }
}
