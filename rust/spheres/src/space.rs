//! Vectors with three components, of one or several grains at a time.

use msdd_engine::vector::Vector;

/// a · b.
#[inline(always)]
pub fn dot<V: Vector>([ax, ay, az]: [V; 3], [bx, by, bz]: [V; 3]) -> V {
    ax * bx + ay * by + az * bz
}

/// a × b.
#[inline(always)]
pub fn cross<V: Vector>([ax, ay, az]: [V; 3], [bx, by, bz]: [V; 3]) -> [V; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// a + s b.
#[inline(always)]
pub fn plus<V: Vector>([ax, ay, az]: [V; 3], s: V, [bx, by, bz]: [V; 3]) -> [V; 3] {
    [ax + s * bx, ay + s * by, az + s * bz]
}

/// a − b.
#[inline(always)]
pub fn minus<V: Vector>([ax, ay, az]: [V; 3], [bx, by, bz]: [V; 3]) -> [V; 3] {
    [ax - bx, ay - by, az - bz]
}

/// s a.
#[inline(always)]
pub fn scaled<V: Vector>(s: V, [x, y, z]: [V; 3]) -> [V; 3] {
    [s * x, s * y, s * z]
}

/// |a|.
pub fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// A 3 × 3 matrix by rows.
pub type Matrix = [[f64; 3]; 3];

/// M a.
#[inline(always)]
pub fn times(matrix: &Matrix, a: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| dot(row, a))
}
