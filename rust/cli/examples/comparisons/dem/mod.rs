//! Reference scenes: boxes that differ in shape, walls, heating, packing, expansion and grains, each simulated by discrete
//! elements for several packings. Error bands of the solver are calibrated on some of them and judged by the others.
//!
//! | module | what |
//! |---|---|
//! | [`plan`] | the plan: a TOML file |
//! | [`beds`] | the plan of beds of spheres |
//! | [`discs`] | one packing by DEM |
//! | [`data`] | the tables of all packings |
//! | [`table`] | errors of the solver compared with the scatter of the packings |

pub mod beds;
pub mod data;
pub mod discs;
pub mod plan;
pub mod table;

pub use beds::{BedPlan, PlannedBed};
pub use discs::SceneResults;
pub use plan::{Plan, PlannedScene, Use};
