//! Shadowing and masking of a cross-section, exact, in one pass per direction.
//!
//! The geometry is constant along the scratch, so only a direction's components across it (x) and upwards
//! (z) matter. key(v) = v.x w.z - v.z w.x is constant along a ray of direction w; sweeping from the side
//! that w comes from, a facet is seen up to where its key passes the horizon so far. Agrees with the
//! paper's GS (GL + GR - 1) of section 4.2 for all facets at once.

use crate::lanes::{Lanes, Number};

/// A direction as a cross-section sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Across {
    pub x: f32,
    pub z: f32,
}

/// The part [from, to] of a facet, as shares of its length from left to right.
pub(crate) type Part = [f32; 2];

impl Across {
    /// Of a direction in the frame (across, along, up) of a scratch.
    pub(crate) fn of(w: glam::Vec3) -> Self {
        Self { x: w.x, z: w.z }
    }

    fn key(self, x: f32, z: f32) -> f32 {
        x * self.z - z * self.x
    }

    /// What of the flat surface at z = 0 lies in front of every vertex: (left of this, right of that).
    /// `horizon` is what [`sweep`] returned; `ends` are the cross-section's own ends.
    pub(crate) fn flat_ends(self, horizon: f32, ends: [f32; 2]) -> [f32; 2] {
        let at = horizon / self.z;
        if self.x >= 0.0 {
            [at.min(ends[0]), ends[1]]
        } else {
            [ends[0], at.max(ends[1])]
        }
    }
}

/// How far the vertices of a cross-section reach in direction `w`: what [`Parts::sweep`] returns.
pub(crate) fn horizon(xs: &[f32], zs: &[f32], w: Across) -> f32 {
    let keys = xs.iter().zip(zs).map(|(&x, &z)| w.key(x, z));
    if w.x >= 0.0 {
        keys.fold(f32::INFINITY, f32::min)
    } else {
        keys.fold(f32::NEG_INFINITY, f32::max)
    }
}

/// Vertices of a cross-section, and as many more as are read with the last ones.
const ROOM: usize = 120;

/// The parts of facets that a direction leaves unblocked.
pub(crate) struct Parts {
    keys: [f32; ROOM],
    from: [f32; ROOM],
    to: [f32; ROOM],
}

impl Parts {
    pub(crate) const fn new() -> Self {
        Self {
            keys: [0.0; ROOM],
            from: [0.0; ROOM],
            to: [0.0; ROOM],
        }
    }

    /// Finds the part of each of the first `facets` facets that a ray leaves unblocked in direction `w` (w.z above 0), and
    /// returns the last horizon. Beyond the last facet's end as many places as there are lanes are read, and mean nothing.
    #[inline(always)]
    pub(crate) fn sweep<L: Lanes>(
        &mut self,
        lanes: L,
        xs: &[f32],
        zs: &[f32],
        facets: usize,
        w: Across,
    ) -> f32 {
        for k in (0..=facets).step_by(L::WIDTH) {
            let keys = lanes.load(&xs[k..]) * w.z - lanes.load(&zs[k..]) * w.x;
            lanes.store(keys, &mut self.keys[k..]);
        }
        let leftwards = w.x >= 0.0;
        let horizon = self.find_horizons(facets, leftwards);
        let (left, right) = (lanes.all(0.0), lanes.all(1.0));
        let hidden = if leftwards { left } else { right };
        for k in (0..facets).step_by(L::WIDTH) {
            let key = lanes.load(&self.keys[k..]);
            let rise = lanes.load(&self.keys[k + 1..]) - key;
            let share = (lanes.load(&self.from[k..]) - key) / rise;
            let end = rise.if_above(left, share.max(left).min(right), hidden);
            let (from, to) = if leftwards { (left, end) } else { (end, right) };
            lanes.store(from, &mut self.from[k..]);
            lanes.store(to, &mut self.to[k..]);
        }
        horizon
    }

    /// Leaves in `from` the horizon that each facet is seen against: that of all vertices between it and the side which the
    /// direction comes from.
    #[inline(always)]
    fn find_horizons(&mut self, facets: usize, leftwards: bool) -> f32 {
        let (keys, horizons) = (&self.keys[..=facets], &mut self.from[..facets]);
        if leftwards {
            let mut horizon = f32::INFINITY;
            for (at, key) in horizons.iter_mut().zip(&keys[1..]).rev() {
                horizon = Number::min(horizon, *key);
                *at = horizon;
            }
            Number::min(horizon, keys[0])
        } else {
            let mut horizon = f32::NEG_INFINITY;
            for (at, key) in horizons.iter_mut().zip(keys) {
                horizon = Number::max(horizon, *key);
                *at = horizon;
            }
            Number::max(horizon, keys[facets])
        }
    }

    /// From where to where facets are unblocked, from number `k` on.
    #[inline(always)]
    pub(crate) fn load<L: Lanes>(&self, lanes: L, k: usize) -> [L::F; 2] {
        [lanes.load(&self.from[k..]), lanes.load(&self.to[k..])]
    }

    pub(crate) fn of(&self, facet: usize) -> Part {
        [self.from[facet], self.to[facet]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::One;

    fn parts(points: &[[f32; 2]], w: Across) -> Vec<Part> {
        let xs: Vec<f32> = points.iter().map(|p| p[0]).collect();
        let zs: Vec<f32> = points.iter().map(|p| p[1]).collect();
        let mut parts = Parts::new();
        parts.sweep(One, &xs, &zs, points.len() - 1, w);
        (0..points.len() - 1).map(|k| parts.of(k)).collect()
    }

    /// A 45° V lit at 45° from the right: its left wall is lit whole, its right wall not at all.
    #[test]
    fn v_groove_lit_from_the_side() {
        let w = Across { x: 0.6, z: 0.8 };
        let v = [[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]];
        assert_eq!(parts(&v, w)[0], [0.0, 1.0]);
        let steep = Across { x: 0.8, z: 0.6 };
        let [from, to] = parts(&v, steep)[1];
        assert_eq!(from, to, "hidden");
        assert!(
            parts(&v, steep)[0][1] < 1.0,
            "grazing light must not reach the bottom"
        );
    }
}
