//! Shadowing and masking of a cross-section, exact, in one pass per direction.
//!
//! The geometry is constant along the scratch, so only a direction's components across it (x) and upwards
//! (z) matter. key(v) = v.x w.z - v.z w.x is constant along a ray of direction w; sweeping from the side
//! that w comes from, a facet is seen up to where its key passes the horizon so far. Agrees with the
//! paper's GS (GL + GR - 1) of section 4.2 for all facets at once.

use crate::lanes::{Lanes, Number, first_below_any};

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

    /// The same of vertices side by side.
    #[inline(always)]
    fn keys<L: Lanes>(self, lanes: L, xs: &[f32], zs: &[f32]) -> L::F {
        lanes.load(xs) * self.z - lanes.load(zs) * self.x
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
    /// Whether the direction comes from the right: then each part begins at its facet's left end, else it ends at the right
    /// one.
    leftwards: bool,
    /// Its other end.
    ends: [f32; ROOM],
}

impl Parts {
    #[inline(always)]
    pub(crate) const fn new() -> Self {
        Self {
            leftwards: false,
            ends: [0.0; ROOM],
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
        self.leftwards = w.x >= 0.0;
        if self.leftwards {
            self.sweep_from::<L, true>(lanes, xs, zs, facets, w)
        } else {
            self.sweep_from::<L, false>(lanes, xs, zs, facets, w)
        }
    }

    /// From the right end or the left one. Each facet is seen against the horizon of all vertices between it and the side
    /// which the direction comes from, its own end there among them.
    #[inline(always)]
    fn sweep_from<L: Lanes, const LEFTWARDS: bool>(
        &mut self,
        lanes: L,
        xs: &[f32],
        zs: &[f32],
        facets: usize,
        w: Across,
    ) -> f32 {
        let (left, right) = (lanes.all(0.0), lanes.all(1.0));
        let (open, hidden, far) = match LEFTWARDS {
            true => (f32::INFINITY, left, 0),
            false => (f32::NEG_INFINITY, right, facets),
        };
        let mut horizon = open;
        let groups = facets.div_ceil(L::WIDTH);
        for group in 0..groups {
            let group = if LEFTWARDS { groups - 1 - group } else { group };
            let k = group * L::WIDTH;
            let (xs, zs) = (&xs[k..=k + L::WIDTH], &zs[k..=k + L::WIDTH]);
            let key = w.keys(lanes, xs, zs);
            let next = w.keys(lanes, &xs[1..], &zs[1..]);
            let near = if LEFTWARDS { next } else { key };
            let near = match LEFTWARDS {
                true => -first_below_any(lanes, facets - k, -near),
                false => first_below_any(lanes, facets - k, near),
            };
            let horizons = match LEFTWARDS {
                true => lanes.least_from(near).min(lanes.all(horizon)),
                false => lanes.most_up_to(near).max(lanes.all(horizon)),
            };
            horizon = horizons.lane(if LEFTWARDS { 0 } else { L::WIDTH - 1 });
            let rise = next - key;
            let share = (horizons - key) / rise;
            let end = rise.if_above(left, share.max(left).min(right), hidden);
            lanes.store(end, &mut self.ends[k..]);
        }
        let last = w.key(xs[far], zs[far]);
        match LEFTWARDS {
            true => Number::min(horizon, last),
            false => Number::max(horizon, last),
        }
    }

    /// From where to where facets are unblocked, from number `k` on.
    #[inline(always)]
    pub(crate) fn load<L: Lanes>(&self, lanes: L, k: usize) -> [L::F; 2] {
        part(self.ends_from(lanes, k), self.leftwards)
    }

    pub(crate) fn of(&self, facet: usize) -> Part {
        part(self.end(facet), self.leftwards)
    }

    /// The one end of each facet's part that is not its facet's, from number `k` on.
    #[inline(always)]
    pub(super) fn ends_from<L: Lanes>(&self, lanes: L, k: usize) -> L::F {
        lanes.load(&self.ends[k..])
    }

    fn end(&self, facet: usize) -> f32 {
        self.ends[facet]
    }
}

/// Parts of which one end is known; a direction from the right sees the left end of all that it sees anything of.
#[inline(always)]
pub(super) fn part<F: Number>(end: F, leftwards: bool) -> [F; 2] {
    if leftwards {
        [end.like(0.0), end]
    } else {
        [end, end.like(1.0)]
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
