//! The box: four flat, rigid walls with prescribed velocities.

/// A wall of the box. The order is that of every array over walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Left,
    Right,
    Bottom,
    Top,
}

impl Side {
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Bottom, Self::Top];

    /// Unit normal pointing into the box.
    pub fn normal(self) -> [f64; 2] {
        match self {
            Self::Left => [1.0, 0.0],
            Self::Right => [-1.0, 0.0],
            Self::Bottom => [0.0, 1.0],
            Self::Top => [0.0, -1.0],
        }
    }
}

/// Positions \[m\] and velocities [m/s] of the four walls, indexed by [`Side`].
#[derive(Clone, Debug, PartialEq)]
pub struct Walls {
    /// x of left and right, y of bottom and top.
    pub position: [f64; 4],
    /// Velocity along the coordinate axis normal to the wall.
    pub normal_velocity: [f64; 4],
    /// Velocity along the wall, in the direction of the coordinate axis; counted in contact slip.
    pub tangential_velocity: [f64; 4],
}

/// The affine motion u(x) that carries the grains along with walls that close or open: linear between the walls, so
/// that a large box is compressed everywhere at once instead of from its rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow {
    /// ∂u_x/∂x, ∂u_y/∂y, ∂u_x/∂y [1/s].
    pub gradient: [f64; 3],
    /// u at the origin of the coordinates [m/s].
    pub at_origin: [f64; 2],
}

impl Flow {
    /// No affine motion.
    pub const NONE: Self = Self { gradient: [0.0; 3], at_origin: [0.0; 2] };

    /// The part normal to a wall. A wall that itself shrinks and stretches with the flow causes no slip along it, so
    /// only this part remains.
    pub fn normal_to(self, side: Side) -> Self {
        let normal = side.normal().map(f64::abs);
        let [xx, yy, xy] = self.gradient;
        Self {
            gradient: [normal[0] * xx, normal[1] * yy, normal[0] * xy],
            at_origin: [normal[0] * self.at_origin[0], normal[1] * self.at_origin[1]],
        }
    }

    /// u [m/s] at (x, y).
    #[inline(always)]
    pub fn at(&self, x: f64, y: f64) -> [f64; 2] {
        let [xx, yy, xy] = self.gradient;
        [self.at_origin[0] + xx * x + xy * y, self.at_origin[1] + yy * y]
    }
}

impl Walls {
    /// The flow that moves with all four walls.
    pub fn flow(&self) -> Flow {
        let axis = |low: usize, high: usize| {
            let velocity = self.normal_velocity;
            let gradient = (velocity[high] - velocity[low]) / (self.position[high] - self.position[low]);
            (gradient, velocity[low] - gradient * self.position[low])
        };
        let ((xx, x0), (yy, y0)) = (axis(0, 1), axis(2, 3));
        Flow { gradient: [xx, yy, 0.0], at_origin: [x0, y0] }
    }

    /// The flow of a periodic box: it also shears at `shear_rate` [1/s], and the lower border keeps its x.
    pub fn sheared_flow(&self, shear_rate: f64) -> Flow {
        let Flow { gradient: [xx, yy, _], at_origin: [x0, y0] } = self.flow();
        let bottom = self.position[Side::Bottom as usize];
        Flow { gradient: [xx, yy, shear_rate], at_origin: [x0 - shear_rate * bottom, y0] }
    }

    /// Resting walls around [0, width] × [0, height] \[m\].
    pub fn around(width: f64, height: f64) -> Self {
        Self { position: [0.0, width, 0.0, height], normal_velocity: [0.0; 4], tangential_velocity: [0.0; 4] }
    }

    pub fn width(&self) -> f64 {
        self.position[Side::Right as usize] - self.position[Side::Left as usize]
    }

    pub fn height(&self) -> f64 {
        self.position[Side::Top as usize] - self.position[Side::Bottom as usize]
    }

    /// Area of the box \[m²\].
    pub fn area(&self) -> f64 {
        self.width() * self.height()
    }

    /// Distance of (x, y) from the wall, positive inside the box \[m\].
    #[inline(always)]
    pub fn distance(&self, side: Side, x: f64, y: f64) -> f64 {
        let at = self.position[side as usize];
        match side {
            Side::Left => x - at,
            Side::Right => at - x,
            Side::Bottom => y - at,
            Side::Top => at - y,
        }
    }

    /// Velocity of the wall as a vector [m/s].
    #[inline(always)]
    pub fn velocity(&self, side: Side) -> [f64; 2] {
        let (normal, tangential) =
            (self.normal_velocity[side as usize], self.tangential_velocity[side as usize]);
        match side {
            Side::Left | Side::Right => [normal, tangential],
            Side::Bottom | Side::Top => [tangential, normal],
        }
    }

    pub fn stop(&mut self) {
        self.normal_velocity = [0.0; 4];
        self.tangential_velocity = [0.0; 4];
    }

    /// Moves the walls for the time `dt` [s].
    pub(crate) fn advance(&mut self, dt: f64) {
        for (position, velocity) in self.position.iter_mut().zip(&self.normal_velocity) {
            *position += dt * velocity;
        }
    }

    /// Largest normal speed of a wall [m/s].
    pub(crate) fn largest_speed(&self) -> f64 {
        self.normal_velocity.iter().fold(0.0, |largest, v| largest.max(v.abs()))
    }
}
