//! The law of packings of spheres: stress and conductivity after any strain of the grains and the cell, in three dimensions.
//!
//! As for discs (see [`crate::increment`]), grains that grow by ε are the same packing in a cell that is smaller by 1/(1 + ε), so
//! thermal strain is isotropic compression. Stresses are over E* = E/(2 (1 − ν²)), compression positive.
//!
//! **State.** A packing with the solid fraction φ carries no load at the fraction φ_J; its elastic compression is v = φ/φ_J − 1.
//! The contacts of Hertz give the pressure A, about ∝ v^(3/2). The deviator of the stress over A is the sum of the stress ratios η_k of
//! four elements, tensors that turn with the cell. In an increment with the deviator de of the cell's strain (extension
//! positive),
//!
//! dη_k = −c_k de/v + m_k η_k dv/v,    |η_k| ≤ M_k,
//!
//! with stiffnesses c_k, powers m_k and strengths M_k: where |η_k| would exceed M_k, the element slides. Strengths, and stiffnesses of friction,
//! depend on φ_J, since dense packings carry a larger deviator, on v, and on the friction that is mobilised. The stress is
//! σ = A (1 + η + Λ dev(η η)) with η = Σ η_k, so that packings carry more along one axis that is compressed than along two, see
//! [`law::Law::deviator`]. One that starts with more than all strengths has larger ones for good ([`state::State::strength`]).
//!
//! **Fabric.** The last element is that of the fabric, the directions of the contacts: where more contacts point along one axis,
//! isotropic compression loads that axis more. It does not slide but turns with the strain, dη_f = c_f |de|/v_f (t − (α + (1 − α) f²)
//! η_f/M_f) + m_f η_f dv/v with t = −de/|de| and f = (η_f·t)₊/M_f, the slower the nearer it is to its strength (with α = 1: Armstrong
//! and Frederick, 1966, CEGB report RD/B/N731). The
//! fit holds η_f to a fitted number times the deviator of the fabric. Its stiffness c_f is proportional to the contacts per sphere
//! that carry load beyond some, z_b − z₀, and depends on nothing else. v_f² = v² + ((1 − F) 1.5e-4)² with F of [`contacts`], which is 0
//! where nearly all friction is mobilised: there the fabric of a packing that hardly carries load turns no faster. The other elements
//! stand for the friction of contacts: three of unequal strength, so that a packing that is strained the other way is stiff at first
//! and then yields little by little.
//!
//! **Contacts.** The number of contacts per sphere z is state, too, see [`contacts`]: the fabric turns by those that carry load, and
//! conductivities depend on all.
//!
//! **Mobilised friction.** g is the part of the friction that is not mobilised: 0 in boxes that were packed with
//! their own friction, where many contacts are about to slide; 1 − μ_p/μ in boxes that were packed with less friction μ_p. Solid
//! fraction and number of contacts do not tell one from the other. Sliding by s mobilises:
//! dg = −m g ds/(v + v_s), with a small v_s.
//!
//! **Dilatancy.** What the stress of the fabric does by a shear strain is stored in the compression: dv = −η_f:de, without a fitted
//! number. So a packing whose contacts point along the axis that is compressed is loaded by shear, and one that is sheared back loses
//! its load until its contacts have turned. Beside it, sliding of the second element, by s, changes v by
//! −(d₀ + d₁ x + d₂ g − (d₃ + d₄ x) η_f·n) s with x = φ_J − 0.6 and the direction n of sliding (Rowe, 1962, Proc. R. Soc. A 269:500; with the fabric, Li and Dafalias, 2012, J. Eng.
//! Mech. 138:263), and mobilised packings that hardly carry load collapse next to it ([`law::Law::collapse`]). Together these make φ_J grow
//! where a loose packing is sheared, and fall in dense ones that are sheared far. Where grains climb, they take at most nine tenths
//! of the work of friction.
//! Where a packing opens, it settles ([`law::Law::opening_densification`]), most where it is about to lose its load: φ_J grows, too.
//!
//! **Readouts.** Conductivities by contacts and by gas are functions of this state, see [`readout`].
//!
//! Fitted to periodic boxes of spheres with the friction 0.3 along paths of strain (`spheres.toml`, `cycles.toml` and `cycling.toml` in
//! `cases/database`), and to beds that were poured (`cases/database/poured`).

#[cfg(test)]
mod block_tests;
mod check;
mod components;
pub mod contacts;
pub mod errors;
pub mod fit;
pub mod fit_state;
pub mod law;
pub mod model;
pub mod noise;
pub mod number;
pub mod parameters;
pub mod readout;
pub mod score;
mod start;
pub mod state;
pub mod tensor;
#[cfg(test)]
mod tests;
pub mod tracks;
pub mod training;
