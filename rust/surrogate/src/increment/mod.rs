//! The law of the increments: one law for thermal and mechanical strain.
//!
//! dstate = g(state; dε − dε_T I): grains that grow by ε in a fixed box are the same packing as grains of the old size in a
//! box that is smaller by 1/(1 + ε), with all lengths larger by 1 + ε. So a thermal strain is an isotropic compression, and
//! stresses over E times the present mean radius are equal.
//!
//! **Elastic energy.** A packing with the solid fraction φ_s (sum of the grains' areas over the area) carries no load at the
//! fraction φ_J. Its elastic compression is v = φ_s/φ_J − 1. Its deviator is borne by parallel elements i with elastic
//! shear strains γ_i = (e_yy − e_xx, −2 e_xy), which are vectors that turn by 2θ when the cell turns by θ. With z, the
//! porosity 1 − φ_J less 0.17, the energy over the area that the packing has without load is
//!
//! ψ = ∫ A(v, z) dv/(1 + v)² + G(A)/(2 (1 + v)) Σ w_i |γ_i|²,
//!
//! and the stress times the area, 1/(1 + v), is its derivative by the strains:
//! p = A + ½ ((1 + v) dG/dv − G) Σ w_i |γ_i|², q = (½(σ_xx − σ_yy), σ_xy) = G Σ w_i γ_i. So closed elastic paths do no work, and
//! the elastic tangent of stress times area is symmetric.
//!
//! **Sliding.** An element slides when its part of the deviator exceeds its strength: G w_i |γ_i| ≤ m_i A. Sliding by s
//! changes the elastic compression by −(b_i + b_z z) s: φ_J changes, which is dilatancy. The elements' shear strains are the
//! memory of where the packing has been. Sliding in the direction of the stress dissipates m_i A s, which is never negative.
//!
//! **Settling.** While v falls below 0, down to −0.02, φ_J grows by `settling` times that: grains that have come apart touch
//! again later.
//!
//! **Readouts.** Overlaps (and so the porosity), conductivity and fabric are functions of this state; the fabric has, besides,
//! a part that stays as it was packed.
//!
//! Parallel elements with friction: Iwan (1967). A packing fraction at jamming that depends on history: Kumar and Luding
//! (2016), Granular Matter 18:58.

pub mod core;
pub mod errors;
pub mod fit;
pub mod law;
pub mod mean;
pub mod model;
pub mod paths;
pub mod readout;
pub mod start;
#[cfg(test)]
pub(crate) mod synthetic;
pub mod training;
