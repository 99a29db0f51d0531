//! Inputs and outputs of the functions of a plug-in, as columns: arrays with one value per cell.

/// Several columns of equal length.
pub(crate) type Columns<'a> = &'a [&'a [f64]];

/// Parameters of the friction coefficient limit s/(s + slip) that a wall mobilises after the slip s of the grains along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallFriction {
    /// \[-\]
    pub limit: f64,
    /// In mean radii.
    pub slip: f64,
}

/// What is known of cells at the start: columns of equal length. Stress reduced, σ ℓ/(E r̄), compression positive.
#[derive(Clone, Copy, Debug)]
pub struct InitialColumns<'a> {
    pub porosity: &'a [f64],
    pub fabric_index: &'a [f64],
    pub fabric_xy: Option<&'a [f64]>,
    /// σ_xx, σ_yy, σ_xy.
    pub stress: Option<[&'a [f64]; 3]>,
    /// K_xx/k, K_yy/k, K_xy/k.
    pub conductivity: Option<[&'a [f64]; 3]>,
}

/// One step of cells: columns of equal length, finite. Strains extension positive.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// One column per state name.
    pub state: Columns<'a>,
    /// Above −1.
    pub thermal_strain: &'a [f64],
    /// Strains xx, yy, 2 xy and rotation of the cells; for plug-ins that have a tangent.
    pub strain: Option<[&'a [f64]; 4]>,
    /// Whether the tangent is computed, too.
    pub wants_tangent: bool,
}

/// Columns after a step, all finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// One column per state name.
    pub state: Vec<Vec<f64>>,
    /// K_xx/k, K_yy/k, K_xy/k; positive in every direction.
    pub conductivity: [Vec<f64>; 3],
    /// σ_xx, σ_yy, σ_xy, reduced, compression positive.
    pub stress: [Vec<f64>; 3],
    /// −dσ_i/de_j, row by row, if it was wanted.
    pub tangent: Option<[Vec<f64>; 9]>,
    /// One column per state column, and one for the thermal strain: signed distance from the model's range, 0 inside.
    pub outside: Vec<Vec<f64>>,
}
