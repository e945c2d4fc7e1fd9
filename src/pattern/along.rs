//! Where a path is, and which way it heads, at a share of its arc length. Build time only.

use super::closest::{bezier, length_share, tangent};
use super::pieces::Curves;
use glam::DVec2;

/// Over this length on either side of a corner the heading turns from one leg's to the next.
const CORNER_MM: f64 = 0.2;

/// One path, in order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Along<'a> {
    curves: Curves<'a>,
    units_per_uv: DVec2,
    /// Share of arc length over which a corner is turned.
    corner: f64,
}

impl<'a> Along<'a> {
    pub(crate) fn new(curves: Curves<'a>, units_per_uv: DVec2, length_mm: f64) -> Self {
        Self {
            curves,
            units_per_uv,
            corner: CORNER_MM / length_mm,
        }
    }

    /// (u, v) at a share of arc length.
    pub(crate) fn uv(&self, at: f64) -> DVec2 {
        let (i, t) = self.locate(at);
        bezier(&self.curves.control(i), t)
    }

    /// The direction of travel, degrees counter-clockwise from u. Continuous: corners are turned over a short
    /// length.
    pub(crate) fn heading_deg(&self, at: f64) -> f64 {
        let (i, t) = self.locate(at);
        let [from, to] = self.curves.at(i);
        let heading = self.direction(i, t).to_angle();
        let reach = self.reach(i);
        let nearness = |distance: f64| (1.0 - distance / reach).max(0.0);
        let before = 0.5 * self.turn_into(i) * nearness(at - from);
        let after = 0.5 * self.turn_into(i + 1) * nearness(to - at);
        (heading - before + after).to_degrees()
    }

    /// Shares of arc length between which the path bends smoothly.
    pub(crate) fn knots(&self) -> Vec<f64> {
        let of_piece = |i: usize| {
            let ([from, to], reach) = (self.curves.at(i), self.reach(i));
            [from, from + reach, to - reach, to]
        };
        (0..self.curves.pieces.len()).flat_map(of_piece).collect()
    }

    /// How far into piece i its corners reach.
    fn reach(&self, i: usize) -> f64 {
        let [from, to] = self.curves.at(i);
        self.corner.min(0.5 * (to - from))
    }

    /// Unit direction at parameter t of piece i.
    fn direction(&self, i: usize, t: f64) -> DVec2 {
        tangent(&self.curves.control(i).map(|p| p * self.units_per_uv), t)
    }

    /// The angle by which the path turns at the start of piece i, radians; 0 at its ends and at seams.
    fn turn_into(&self, i: usize) -> f64 {
        let next = self.curves.pieces.get(i);
        if i == 0 || !next.is_some_and(|piece| piece.is_joined()) {
            return 0.0;
        }
        self.direction(i - 1, 1.0).angle_to(self.direction(i, 0.0))
    }

    /// The piece and its parameter at a share of arc length.
    fn locate(&self, at: f64) -> (usize, f64) {
        let i = self
            .curves
            .pieces
            .partition_point(|piece| f64::from(piece.end_at) < at)
            .min(self.curves.pieces.len() - 1);
        (i, self.parameter(i, at))
    }

    /// The parameter of piece i at a share of the path's arc length.
    fn parameter(&self, i: usize, at: f64) -> f64 {
        let [from, to] = self.curves.at(i);
        let wanted = ((at - from) / (to - from)).clamp(0.0, 1.0);
        let control = self.curves.control(i).map(|p| p * self.units_per_uv);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if length_share(&control, middle) < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Path;
    use crate::pattern::pieces::Chains;

    /// Half way along an L is its corner; the heading passes through the mean of both legs there.
    #[test]
    fn corner_is_turned_evenly() {
        let path = Path::Polyline(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        let curves = path.curves(DVec2::ONE).unwrap();
        let chains = Chains::of_path(&curves, DVec2::ONE);
        let along = Along::new(chains.curves(), DVec2::ONE, 20.0);
        assert!(
            along.uv(0.5).abs_diff_eq(DVec2::new(1.0, 0.0), 1e-9),
            "not the corner"
        );
        for (at, heading) in [
            (0.3, 0.0),
            (0.495, 22.5),
            (0.5, 45.0),
            (0.505, 67.5),
            (0.7, 90.0),
        ] {
            let ours = along.heading_deg(at);
            assert!(
                (ours - heading).abs() < 1e-6,
                "{at}: {ours} against {heading}"
            );
        }
    }
}
