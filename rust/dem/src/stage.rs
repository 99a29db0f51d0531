//! The parts of a step, by which its time is measured.

/// Parts of a step, in order.
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
