//! Where a path is, and which way it heads, at a share of its arc length. Build time only.

use super::closest::{bezier, length_share, tangent};
use super::pieces::Piece;
use glam::DVec2;

/// Over this length on either side of a corner the heading turns from one leg's to the next.
const CORNER_MM: f64 = 0.2;

/// One path, in order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Along<'a> {
    pieces: &'a [Piece],
    units_per_uv: DVec2,
    /// Share of arc length over which a corner is turned.
    corner: f64,
}

impl<'a> Along<'a> {
    pub(crate) fn new(pieces: &'a [Piece], units_per_uv: DVec2, length_mm: f64) -> Self {
        Self {
            pieces,
            units_per_uv,
            corner: CORNER_MM / length_mm,
        }
    }

    /// (u, v) at a share of arc length.
    pub(crate) fn uv(&self, at: f64) -> DVec2 {
        let (i, t) = self.locate(at);
        bezier(&self.pieces[i].control, t)
    }

    /// The direction of travel, degrees counter-clockwise from u. Continuous: corners are turned over a short
    /// length.
    pub(crate) fn heading_deg(&self, at: f64) -> f64 {
        let (i, t) = self.locate(at);
        let [from, to] = self.pieces[i].at;
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
            let ([from, to], reach) = (self.pieces[i].at, self.reach(i));
            [from, from + reach, to - reach, to]
        };
        (0..self.pieces.len()).flat_map(of_piece).collect()
    }

    /// How far into piece i its corners reach.
    fn reach(&self, i: usize) -> f64 {
        let [from, to] = self.pieces[i].at;
        self.corner.min(0.5 * (to - from))
    }

    /// Unit direction at parameter t of piece i.
    fn direction(&self, i: usize, t: f64) -> DVec2 {
        tangent(&self.pieces[i].control.map(|p| p * self.units_per_uv), t)
    }

    /// The angle by which the path turns at the start of piece i, radians; 0 at both ends of the path.
    fn turn_into(&self, i: usize) -> f64 {
        if i == 0 || i >= self.pieces.len() {
            return 0.0;
        }
        self.direction(i - 1, 1.0).angle_to(self.direction(i, 0.0))
    }

    /// The path's pieces, cut at these ascending shares of arc length too.
    pub(crate) fn cut_at(&self, cuts: &[f64]) -> Vec<Piece> {
        let mut pieces = Vec::with_capacity(self.pieces.len() + cuts.len());
        let mut cuts = cuts.iter().copied().peekable();
        for (i, &piece) in self.pieces.iter().enumerate() {
            let mut rest = piece;
            let mut done = 0.0;
            while let Some(cut) = cuts.next_if(|&cut| cut < piece.at[1]) {
                let t = self.parameter(i, cut);
                let (first, second) = self.split(&rest, (t - done) / (1.0 - done), cut);
                pieces.push(first);
                (rest, done) = (second, t);
            }
            pieces.push(rest);
        }
        pieces
    }

    /// Both sides of a piece cut at parameter t (de Casteljau), which is at this share of arc length.
    fn split(&self, piece: &Piece, t: f64, at: f64) -> (Piece, Piece) {
        let [a, b, c, d] = piece.control;
        let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
        let (abc, bcd) = (ab.lerp(bc, t), bc.lerp(cd, t));
        let middle = abc.lerp(bcd, t);
        let scaled = piece.control.map(|p| p * self.units_per_uv);
        let parting = tangent(&scaled, t) / self.units_per_uv;
        let first = Piece {
            control: [a, ab, abc, middle],
            at: [piece.at[0], at],
            parting: [piece.parting[0], parting],
            ..*piece
        };
        let second = Piece {
            control: [middle, bcd, cd, d],
            at: [at, piece.at[1]],
            parting: [parting, piece.parting[1]],
            changed: true,
            ..*piece
        };
        (first, second)
    }

    /// The piece and its parameter at a share of arc length.
    fn locate(&self, at: f64) -> (usize, f64) {
        let i = self
            .pieces
            .partition_point(|piece| piece.at[1] < at)
            .min(self.pieces.len() - 1);
        (i, self.parameter(i, at))
    }

    /// The parameter of piece i at a share of the path's arc length.
    fn parameter(&self, i: usize, at: f64) -> f64 {
        let piece = &self.pieces[i];
        let [from, to] = piece.at;
        let wanted = ((at - from) / (to - from)).clamp(0.0, 1.0);
        let control = piece.control.map(|p| p * self.units_per_uv);
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
    use crate::pattern::pieces::pieces;

    /// Half way along an L is its corner; the heading passes through the mean of both legs there.
    #[test]
    fn corner_is_turned_evenly() {
        let path = Path::Polyline(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        let curves = path.curves(DVec2::ONE).unwrap();
        let (pieces, length) = pieces(&curves, DVec2::ONE, 0);
        let along = Along::new(&pieces, DVec2::ONE, 10.0 * length);
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
