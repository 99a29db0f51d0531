//! The part of a state model that answers queries, a block of cells at a time.

use super::rates::{RateInputs, Rates};
use super::readout::Readout;
use super::variables::{FeatureRanges, Features, Variables, stress_ratios};
use crate::kernel::vector::Vector;
use crate::kernel::{self, LANES, Lanes, Task, dispatch};
use crate::surrogate::{Answer, StateLanes, VIRGIN};

/// The part of a state model that answers queries: variables, rates and readouts.
#[derive(Clone, Debug, PartialEq)]
pub struct Core {
    pub variables: Variables,
    pub ranges: FeatureRanges,
    pub rates: Rates,
    /// One readout for each kind of conductivity in the database; the first is the default.
    pub readouts: Vec<Readout>,
    /// Index of the readout that answers.
    pub active: usize,
}

struct Query<'a> {
    core: &'a Core,
    state: &'a StateLanes,
    strain: &'a Lanes,
    virgin: &'a Lanes,
    answer: &'a mut Answer,
}

impl Task for Query<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self { core, state, strain, virgin, answer } = self;
        core.block_into::<V>(state, strain, virgin, answer);
    }
}

impl Core {
    /// As [`Surrogate::block`](crate::Surrogate::block).
    pub fn block(&self, state: &StateLanes, strain: &Lanes) -> Answer {
        let mut answer = Answer::default();
        self.answer(state, strain, &VIRGIN, &mut answer);
        answer
    }

    /// As [`Surrogate::block_into`](crate::Surrogate::block_into).
    pub fn answer(&self, state: &StateLanes, strain: &Lanes, virgin: &Lanes, answer: &mut Answer) {
        dispatch(Query { core: self, state, strain, virgin, answer });
    }

    /// The work of [`Core::answer`], compiled per instruction set.
    #[inline(always)]
    pub(crate) fn block_into<V: Vector>(
        &self,
        state: &StateLanes,
        strain: &Lanes,
        virgin: &Lanes,
        answer: &mut Answer,
    ) {
        let mut buffers = kernel::buffers();
        let (variables, ranges, network) = (self.variables, &self.ranges, &self.rates.network);
        let ratio = stress_ratios::<V>(variables, state);
        ranges.outside::<V>(variables, state, &ratio, strain, &mut answer.outside);
        let limits = [ranges.thermal_strain.min, ranges.thermal_strain.max].map(V::all);
        let mut allowed = [0.0; LANES];
        V::read(strain).within(limits[0], limits[1]).write(&mut allowed);
        let mut features = Features::default();
        ranges.fill_features::<V>(variables, state, &ratio, &allowed, &mut features);
        let outputs = kernel::outputs::<V>(&network.sizes, &network.weights, &features.even, &mut buffers);
        let from = RateInputs { variables, state, strain: &allowed, virgin, features: &features };
        self.rates.advanced::<V>(&from, outputs, &mut answer.state);
        let ratio = stress_ratios::<V>(variables, &answer.state);
        ranges.fill_features::<V>(variables, &answer.state, &ratio, &allowed, &mut features);
        self.readouts[self.active].answer::<V>(variables, &features, &mut buffers, answer);
    }
}
