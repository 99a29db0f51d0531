//! Direct solutions of the heat equation and a published correlation, which the laws of heat are compared with.
//!
//! | module | what |
//! |---|---|
//! | [`correlation`] | published correlation for packed beds |
//! | [`ray_links`] | the exchange of traced rays as links of a network |
//! | [`voxels`] | direct solutions in a periodic box of spheres |
//! | [`walk_on_spheres`] | direct solutions between isothermal spheres |
// Each example uses a part.
#![allow(dead_code)]

pub mod correlation;
pub mod ray_links;
pub mod voxels;
pub mod walk_on_spheres;
