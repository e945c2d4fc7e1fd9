//! Shadowing and masking of a cross-section, exact, in one pass per direction.
//!
//! The geometry is constant along the scratch, so only a direction's components across it (x) and upwards
//! (z) matter. key(v) = v.x w.z - v.z w.x is constant along a ray of direction w; sweeping from the side
//! that w comes from, a facet is seen up to where its key passes the horizon so far. Agrees with the
//! paper's GS (GL + GR - 1) of section 4.2 for all facets at once.

use crate::lanes::{First, Lanes, Number};

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

    #[inline(always)]
    pub(super) fn key<F: Number>(self, x: F, z: F) -> F {
        x * self.z - z * self.x
    }

    /// The same of vertices side by side.
    #[inline(always)]
    fn keys<L: Lanes>(self, lanes: L, xs: &[f32], zs: &[f32]) -> L::F {
        self.key(lanes.load(xs), lanes.load(zs))
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

    #[inline(always)]
    fn sweep_from<L: Lanes, const LEFTWARDS: bool>(
        &mut self,
        lanes: L,
        xs: &[f32],
        zs: &[f32],
        facets: usize,
        w: Across,
    ) -> f32 {
        let mut sweep = Sweep::<LEFTWARDS>::new();
        let groups = facets.div_ceil(L::WIDTH);
        for group in 0..groups {
            let k = Sweep::<LEFTWARDS>::turn(group, groups) * L::WIDTH;
            let (xs, zs) = (&xs[k..=k + L::WIDTH], &zs[k..=k + L::WIDTH]);
            let keys = [w.keys(lanes, xs, zs), w.keys(lanes, &xs[1..], &zs[1..])];
            let end = sweep.ends(lanes, keys, First::of(lanes, facets - k));
            lanes.store(end, &mut self.ends[k..]);
        }
        let far = if LEFTWARDS { 0 } else { facets };
        sweep.horizon_with(w.key(xs[far], zs[far]))
    }

    /// From where to where facets are unblocked, from number `k` on.
    #[inline(always)]
    pub(crate) fn load<L: Lanes>(&self, lanes: L, k: usize) -> [L::F; 2] {
        part(lanes.load(&self.ends[k..]), self.leftwards)
    }

    pub(crate) fn of(&self, facet: usize) -> Part {
        part(self.end(facet), self.leftwards)
    }

    fn end(&self, facet: usize) -> f32 {
        self.ends[facet]
    }
}

/// A pass over the facets of a cross-section from the right end or the left one, as many at a time as there are lanes. Each is
/// seen against the horizon of all vertices between it and the side which the direction comes from, its own end there among
/// them.
pub(super) struct Sweep<const LEFTWARDS: bool> {
    horizon: f32,
}

impl<const LEFTWARDS: bool> Sweep<LEFTWARDS> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self {
            horizon: match LEFTWARDS {
                true => f32::INFINITY,
                false => f32::NEG_INFINITY,
            },
        }
    }

    /// Which of so many comes next.
    #[inline(always)]
    pub(super) fn turn(number: usize, count: usize) -> usize {
        match LEFTWARDS {
            true => count - 1 - number,
            false => number,
        }
    }

    /// The one end of the next facets' parts that is not the facets', by the keys of their left and right ends.
    #[inline(always)]
    pub(super) fn ends<L: Lanes>(
        &mut self,
        lanes: L,
        [key, next]: [L::F; 2],
        own: First<L::F>,
    ) -> L::F {
        let (left, right) = (lanes.all(0.0), lanes.all(1.0));
        let before = lanes.all(self.horizon);
        let horizons = match LEFTWARDS {
            true => lanes.least_from(own.above_any(next)).min(before),
            false => lanes.most_up_to(own.below_any(key)).max(before),
        };
        self.horizon = horizons.lane(if LEFTWARDS { 0 } else { L::WIDTH - 1 });
        let rise = next - key;
        let share = (horizons - key) / rise;
        let hidden = if LEFTWARDS { left } else { right };
        rise.if_above(left, share.max(left).min(right), hidden)
    }

    /// The last horizon, that of a vertex beyond all facets too.
    #[inline(always)]
    pub(super) fn horizon_with(&self, last: f32) -> f32 {
        match LEFTWARDS {
            true => Number::min(self.horizon, last),
            false => Number::max(self.horizon, last),
        }
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
