//! What a plug-in is asked and what it answers, as columns with a value a cell.

/// A column each, of equal length.
pub(crate) type Columns<'a> = &'a [&'a [f64]];

/// Mobilised wall friction limit s/(s + slip) after the slip s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallFriction {
    /// \[-\]
    pub limit: f64,
    /// In mean radii.
    pub slip: f64,
}

/// What is known of cells at the start: columns of equal length. Stress reduced, σ ℓ/(E r̄), compression positive.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a> {
    pub porosity: &'a [f64],
    pub fabric_index: &'a [f64],
    pub fabric_conductivity: Option<&'a [f64]>,
    /// σ_xx, σ_yy.
    pub stress: Option<[&'a [f64]; 2]>,
}

/// One step of cells: columns of equal length, finite. Strains extension positive.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// One column a state name.
    pub state: Columns<'a>,
    /// Above −1.
    pub thermal_strain: &'a [f64],
    /// Share of it, 0 to 1, that leads beyond all that the cell has been strained to before; `None`: all of it.
    pub virgin_share: Option<&'a [f64]>,
    /// Mechanical strains along x and y, after the thermal one; for plug-ins that have a tangent.
    pub strain: Option<[&'a [f64]; 2]>,
}

/// Columns after a step, all finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// One column a state name.
    pub state: Vec<Vec<f64>>,
    /// K_xx/k, K_yy/k; above zero.
    pub conductivity: [Vec<f64>; 2],
    /// σ_xx, σ_yy, reduced, compression positive.
    pub stress: [Vec<f64>; 2],
    /// Per state column, then for the thermal strain: how far outside the model's range, 0 inside.
    pub outside: Vec<Vec<f64>>,
}
