//! A path cut into the short pieces that a pattern holds.

use super::path::{Curve, arc_length, scaled};
use glam::DVec2;
use kurbo::{CubicBez, ParamCurve, ParamCurveDeriv, Point};

/// A piece of a path that turns by no more than [`MOST_TURN_RAD`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Control points of a cubic Bézier curve, (u, v).
    pub control: [DVec2; 4],
    /// Share of the path's arc length at its start and end.
    pub at: [f64; 2],
    /// Tangents, (u, v), across which it is parted from its neighbours: its own at a smooth joint, the
    /// mean of both at a corner.
    pub parting: [DVec2; 2],
    pub scratch: u32,
    /// Its cross-section differs from the piece's before it.
    pub changed: bool,
}

/// The most that one piece of a curve turns.
const MOST_TURN_RAD: f64 = 0.06;

/// The pieces of a path's curves, and its length in scene units. `units_per_uv` scales texture space for arc
/// length and for parting tangents.
pub(crate) fn pieces(curves: &[Curve], units_per_uv: DVec2, scratch: u32) -> (Vec<Piece>, f64) {
    let whole: f64 = curves.iter().map(|curve| curve.length).sum();
    let mut pieces: Vec<Piece> = Vec::with_capacity(curves.len());
    let mut before = 0.0;
    for curve in curves {
        let bezier = scaled(&curve.control, units_per_uv);
        let count = pieces_needed(&bezier);
        let mut start = before;
        for i in 0..count {
            let part = |i: usize| i as f64 / count as f64;
            let sub = bezier.subsegment(part(i)..part(i + 1));
            let end = if i + 1 == count {
                before + curve.length
            } else {
                start + arc_length(&sub)
            };
            let at = [start / whole, end / whole];
            pieces.push(piece(&sub, at, units_per_uv, scratch));
            start = end;
        }
        before += curve.length;
    }
    part_corners(&mut pieces, units_per_uv);
    (pieces, whole)
}

impl Piece {
    pub(crate) fn chord(&self) -> DVec2 {
        self.control[3] - self.control[0]
    }

    /// How far its control points stray from its chord, in (u, v).
    pub(crate) fn sagitta(&self) -> f64 {
        let chord = self.chord().normalize_or_zero();
        let stray = |p: DVec2| {
            let offset = p - self.control[0];
            (offset - chord * offset.dot(chord)).length()
        };
        stray(self.control[1]).max(stray(self.control[2]))
    }

    /// Lowest and highest (u, v) of its control points, which hold the curve.
    pub(crate) fn bounds(&self) -> [DVec2; 2] {
        let [a, b, c, d] = self.control;
        [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
    }
}

/// Enough equal steps of the parameter for none to turn too much.
fn pieces_needed(curve: &CubicBez) -> usize {
    let enough = |&count: &usize| {
        (0..count).all(|i| {
            let part = |i: usize| i as f64 / count as f64;
            turn_rad(&curve.subsegment(part(i)..part(i + 1))) <= MOST_TURN_RAD
        })
    };
    (0..9)
        .map(|power| 1 << power)
        .find(enough)
        .unwrap_or(1 << 9)
}

/// How much the legs of the control polygon turn in all: no less than the curve does.
fn turn_rad(curve: &CubicBez) -> f64 {
    let legs = [
        curve.p1 - curve.p0,
        curve.p2 - curve.p1,
        curve.p3 - curve.p2,
    ];
    let scale = legs.iter().map(|leg| leg.hypot()).fold(0.0, f64::max);
    let mut legs = legs.into_iter().filter(|leg| leg.hypot() > 1e-9 * scale);
    let Some(mut last) = legs.next() else {
        return 0.0;
    };
    let mut sum = 0.0;
    for leg in legs {
        sum += last.cross(leg).atan2(last.dot(leg)).abs();
        last = leg;
    }
    sum
}

fn piece(curve: &CubicBez, at: [f64; 2], scale: DVec2, scratch: u32) -> Piece {
    let unscaled = |p: Point| DVec2::new(p.x, p.y) / scale;
    let derivative = curve.deriv();
    let tangent = |t: f64, inward: f64| {
        // A control point on the curve's end leaves no derivative there; a little inside there is one.
        let exact = derivative.eval(t).to_vec2();
        let direction = if exact.hypot() > 1e-9 {
            exact
        } else {
            derivative.eval(t + inward).to_vec2()
        };
        DVec2::new(direction.x, direction.y).normalize_or(DVec2::X)
    };
    Piece {
        control: [curve.p0, curve.p1, curve.p2, curve.p3].map(unscaled),
        at,
        parting: [tangent(0.0, 1e-4), tangent(1.0, -1e-4)].map(|t| t / scale),
        scratch,
        changed: false,
    }
}

/// Where two pieces meet at an angle, both end at the line that halves it.
fn part_corners(pieces: &mut [Piece], scale: DVec2) {
    for i in 1..pieces.len() {
        let (a, b) = (
            pieces[i - 1].parting[1] * scale,
            pieces[i].parting[0] * scale,
        );
        // A path that turns back on itself has no such line: its pieces end square.
        if a.dot(b) > -0.99 {
            let halving = (a + b).normalize() / scale;
            pieces[i - 1].parting[1] = halving;
            pieces[i].parting[0] = halving;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Path;

    /// A Bézier quarter circle: its arc length, its turn shared out, and shares that grow to 1.
    #[test]
    fn quarter_circle() {
        let k = 0.5522847498;
        let points = [[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]];
        let curves = Path::CubicBezier(&points).curves(DVec2::ONE).unwrap();
        let (pieces, _) = pieces(&curves, DVec2::ONE, 0);
        assert!(pieces.len() >= 11, "{} pieces", pieces.len());
        for pair in pieces.windows(2) {
            assert_eq!(pair[0].at[1], pair[1].at[0]);
            assert!(
                pair[0].parting[1].abs_diff_eq(pair[1].parting[0], 1e-9),
                "kink"
            );
        }
        assert_eq!(pieces[pieces.len() - 1].at[1], 1.0);
    }
}
