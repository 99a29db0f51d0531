//! What the exported functions need of a model. The functions here work on whole batches and may fail, because the model
//! may be a plug-in. Our own models are called through [`Surrogate`], which does not fail.

use crate::batch::Columns;
use crate::columns::{Input, Output};
use crate::si::Si;
use crate::status::Failure;
use msdd_plugin::Plugin;
use msdd_surrogate::Surrogate;
use msdd_surrogate::dataset::ConductivityKind;
use msdd_surrogate::kernel::LANES;
use msdd_surrogate::surrogate::InitialData;
use serde_json::{Value, json};
use std::sync::Arc;

/// A model behind a handle.
pub(crate) trait BatchModel: Send + Sync {
    fn name(&self) -> &str;
    /// SHA-256 of its file.
    fn hash(&self) -> &str;
    /// Description of the model for users, as a JSON object.
    fn description(&self) -> Value;
    fn state_names(&self) -> Vec<String>;
    /// Kind of conductivity that it computes: "affine" or "network".
    fn conductivity(&self) -> &'static str;
    /// The kinds that it was trained for.
    fn conductivities(&self) -> Vec<&'static str>;
    /// A copy of the model that computes another kind; `None` if it was not trained for this kind.
    fn with_conductivity(&self, kind: &str) -> Option<Arc<dyn BatchModel>>;
    fn has_tangent(&self) -> bool;
    /// Limit [-] and slip [mean radii].
    fn wall_friction(&self) -> Option<[f64; 2]>;
    /// Writes the initial state of cells; inputs are finite.
    fn initial_state(&self, start: &InitialColumns, si: &Si, state: &[Output<f64>]) -> Result<(), Failure>;
    /// Takes all cells through a step; returns the number with an input outside the trained range.
    fn advance(&self, columns: &Columns, si: &Si) -> Result<usize, Failure>;
    /// Writes solid fractions of initial states; inputs are finite.
    fn solid_fraction(&self, porosity: &Input, result: &Output<f64>) -> Result<(), Failure>;
}

/// What is known of cells at the start.
pub(crate) struct InitialColumns<'a> {
    pub cells: usize,
    pub porosity: Input<'a>,
    pub fabric_index: Input<'a>,
    pub fabric_xy: Option<Input<'a>>,
    /// σ_xx, σ_yy [Pa].
    pub stress: Option<[Input<'a>; 2]>,
    /// σ_xy [Pa].
    pub stress_xy: Option<Input<'a>>,
    /// K_xx, K_yy [W/(m K)].
    pub conductivity: Option<[Input<'a>; 2]>,
    /// K_xy [W/(m K)].
    pub conductivity_xy: Option<Input<'a>>,
}

/// A model of the crate [`msdd_surrogate`].
pub(crate) struct Own(pub Box<dyn Surrogate>);

impl BatchModel for Own {
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

    fn conductivity(&self) -> &'static str {
        self.0.conductivity_kind().as_str()
    }

    fn conductivities(&self) -> Vec<&'static str> {
        self.0.conductivity_kinds().into_iter().map(ConductivityKind::as_str).collect()
    }

    fn with_conductivity(&self, kind: &str) -> Option<Arc<dyn BatchModel>> {
        let kind = self.0.conductivity_kinds().into_iter().find(|known| known.as_str() == kind)?;
        Some(Arc::new(Own(self.0.answering_with(kind)?)))
    }

    fn has_tangent(&self) -> bool {
        self.0.has_tangent()
    }

    fn wall_friction(&self) -> Option<[f64; 2]> {
        self.0.wall_friction().map(|friction| [friction.limit, friction.slip])
    }

    fn initial_state(&self, start: &InitialColumns, si: &Si, state: &[Output<f64>]) -> Result<(), Failure> {
        // Cells often start alike: an answer is found once for a run of equal ones.
        let mut last = None;
        for cell in 0..start.cells {
            let known = InitialData {
                porosity: start.porosity.at(cell),
                fabric_index: start.fabric_index.at(cell),
                fabric_xy: start.fabric_xy.map_or(0.0, |column| column.at(cell)),
                reduced_stress: start.stress.map(|[xx, yy]| {
                    let xy = start.stress_xy.map_or(0.0, |column| column.at(cell));
                    [xx.at(cell), yy.at(cell), xy].map(|stress| si.reduced(stress))
                }),
                conductivity: start.conductivity.map(|[xx, yy]| {
                    let xy = start.conductivity_xy.map_or(0.0, |column| column.at(cell));
                    [xx.at(cell), yy.at(cell), xy].map(|k| si.of_grains(k))
                }),
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

    fn advance(&self, columns: &Columns, si: &Si) -> Result<usize, Failure> {
        columns.advance(&*self.0, si)
    }

    fn solid_fraction(&self, porosity: &Input, result: &Output<f64>) -> Result<(), Failure> {
        for first in (0..porosity.length()).step_by(LANES) {
            result.write(first, &porosity.lanes(first).map(|porosity| self.0.solid_fraction(porosity)));
        }
        Ok(())
    }
}

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
            "conductivity": self.conductivity(),
            "conductivities": self.conductivities(),
            "has_tangent": Plugin::has_tangent(self),
            "wall_friction": friction.map(|f| json!({"limit": f.limit, "slip": f.slip})),
        })
    }

    fn state_names(&self) -> Vec<String> {
        Plugin::state_names(self).to_vec()
    }

    fn conductivity(&self) -> &'static str {
        let kind =
            if self.network_conductivity() { ConductivityKind::Network } else { ConductivityKind::Affine };
        kind.as_str()
    }

    fn conductivities(&self) -> Vec<&'static str> {
        vec![self.conductivity()]
    }

    fn with_conductivity(&self, _kind: &str) -> Option<Arc<dyn BatchModel>> {
        None
    }

    fn has_tangent(&self) -> bool {
        Plugin::has_tangent(self)
    }

    fn wall_friction(&self) -> Option<[f64; 2]> {
        Plugin::wall_friction(self).map(|friction| [friction.limit, friction.slip])
    }

    fn initial_state(&self, start: &InitialColumns, si: &Si, state: &[Output<f64>]) -> Result<(), Failure> {
        let column = |input: &Input| (0..start.cells).map(|cell| input.at(cell)).collect::<Vec<f64>>();
        let reduced =
            |input: &Input| column(input).iter().map(|stress| si.reduced(*stress)).collect::<Vec<f64>>();
        let stress = start.stress.map(|[xx, yy]| {
            let xy = start.stress_xy.as_ref().map_or_else(|| vec![0.0; start.cells], reduced);
            [reduced(&xx), reduced(&yy), xy]
        });
        let of_grains = |input: &Input| column(input).iter().map(|k| si.of_grains(*k)).collect::<Vec<f64>>();
        let conductivity = start.conductivity.map(|[xx, yy]| {
            let xy = start.conductivity_xy.as_ref().map_or_else(|| vec![0.0; start.cells], of_grains);
            [of_grains(&xx), of_grains(&yy), xy]
        });
        let fabric_xy = start.fabric_xy.as_ref().map(column);
        let known = msdd_plugin::InitialColumns {
            porosity: &column(&start.porosity),
            fabric_index: &column(&start.fabric_index),
            fabric_xy: fabric_xy.as_deref(),
            stress: stress.as_ref().map(|stress| stress.each_ref().map(Vec::as_slice)),
            conductivity: conductivity.as_ref().map(|k| k.each_ref().map(Vec::as_slice)),
        };
        for (output, values) in state.iter().zip(Plugin::initial_state(self, &known)?) {
            output.write_all(&values);
        }
        Ok(())
    }

    fn advance(&self, columns: &Columns, si: &Si) -> Result<usize, Failure> {
        columns.advance_plugin(self, si)
    }

    fn solid_fraction(&self, porosity: &Input, result: &Output<f64>) -> Result<(), Failure> {
        let values: Vec<f64> = (0..porosity.length()).map(|cell| porosity.at(cell)).collect();
        let answer = Plugin::solid_fraction(self, &values)?.ok_or_else(|| {
            Failure::argument("surrogate", self.name(), "a plug-in that has solid fractions")
        })?;
        result.write_all(&answer);
        Ok(())
    }
}
