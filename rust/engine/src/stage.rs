//! The stages of a step, for measuring where its time goes.

/// Stages of a step, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Radii and walls.
    Boundaries,
    /// Neighbour search, when due.
    Neighbours,
    /// Contact forces between discs.
    Pairs,
    /// Contact forces on walls.
    Walls,
    /// Damping and motion.
    Motion,
    /// Heat pipes, when on.
    Heat,
}

impl Stage {
    pub const ALL: [Self; 6] =
        [Self::Boundaries, Self::Neighbours, Self::Pairs, Self::Walls, Self::Motion, Self::Heat];
}
