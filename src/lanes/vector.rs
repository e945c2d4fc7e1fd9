//! Three numbers, or eight times three.

use super::{Lanes, Number};

/// Three numbers, or eight times three.
#[derive(Clone, Copy)]
pub(crate) struct Vector<F> {
    pub x: F,
    pub y: F,
    pub z: F,
}

impl Vector<f32> {
    /// The same in each place.
    #[inline(always)]
    pub(crate) fn all<L: Lanes>(self, lanes: L) -> Vector<L::F> {
        Vector {
            x: lanes.all(self.x),
            y: lanes.all(self.y),
            z: lanes.all(self.z),
        }
    }

    pub(crate) fn to_array(self) -> [f32; 3] {
        [self.x, self.y, self.z]
    }
}

impl<F: Number> Vector<F> {
    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> F {
        self.x * other.x + self.y * other.y + self.z * other.z
    }
}
