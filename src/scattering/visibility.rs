//! Shadowing and masking of a cross-section, exact, in one pass per direction.
//!
//! The geometry is constant along the scratch, so only a direction's components across it (x) and upwards
//! (z) matter. key(v) = v.x w.z - v.z w.x is constant along a ray of direction w; sweeping from the side
//! that w comes from, a facet is seen up to where its key passes the horizon so far. Agrees with the
//! paper's GS (GL + GR - 1) of section 4.2 for all facets at once.

/// A direction as a cross-section sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Across {
    pub x: f32,
    pub z: f32,
}

/// The part [from, to] of a facet, as shares of its length from left to right.
pub(crate) type Part = [f32; 2];

const HIDDEN: Part = [0.0, 0.0];

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

/// Gives `seen` the part of each facet that a ray leaves unblocked in direction `w` (w.z above 0), and
/// returns the last horizon.
pub(crate) fn sweep(xs: &[f32], zs: &[f32], w: Across, mut seen: impl FnMut(usize, Part)) -> f32 {
    let facets = xs.len().saturating_sub(1);
    if w.x >= 0.0 {
        let mut horizon = f32::INFINITY;
        for k in (0..facets).rev() {
            let (a, b) = (w.key(xs[k], zs[k]), w.key(xs[k + 1], zs[k + 1]));
            let to = ((horizon - a) / (b - a)).min(1.0);
            seen(k, if b > a && to > 0.0 { [0.0, to] } else { HIDDEN });
            horizon = horizon.min(a).min(b);
        }
        horizon
    } else {
        let mut horizon = f32::NEG_INFINITY;
        for k in 0..facets {
            let (a, b) = (w.key(xs[k], zs[k]), w.key(xs[k + 1], zs[k + 1]));
            let from = ((horizon - a) / (b - a)).max(0.0);
            seen(
                k,
                if b > a && from < 1.0 {
                    [from, 1.0]
                } else {
                    HIDDEN
                },
            );
            horizon = horizon.max(a).max(b);
        }
        horizon
    }
}

/// What two parts share.
pub(crate) fn overlap(a: Part, b: Part) -> Part {
    [a[0].max(b[0]), a[1].min(b[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(points: &[[f32; 2]], w: Across) -> Vec<Part> {
        let xs: Vec<f32> = points.iter().map(|p| p[0]).collect();
        let zs: Vec<f32> = points.iter().map(|p| p[1]).collect();
        let mut parts = vec![HIDDEN; points.len() - 1];
        sweep(&xs, &zs, w, |k, part| parts[k] = part);
        parts
    }

    /// A 45° V lit at 45° from the right: its left wall is lit whole, its right wall not at all.
    #[test]
    fn v_groove_lit_from_the_side() {
        let w = Across { x: 0.6, z: 0.8 };
        let v = [[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]];
        assert_eq!(parts(&v, w)[0], [0.0, 1.0]);
        let steep = Across { x: 0.8, z: 0.6 };
        assert_eq!(parts(&v, steep)[1], HIDDEN);
        assert!(
            parts(&v, steep)[0][1] < 1.0,
            "grazing light must not reach the bottom"
        );
    }
}
