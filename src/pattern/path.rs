//! A scratch's path in texture space, and the short pieces it is cut into.

use crate::error::{Error, Result};
use glam::DVec2;
use kurbo::{CubicBez, ParamCurve, ParamCurveArclen, ParamCurveDeriv, Point};

/// Where a scratch runs, in texture space (u, v).
#[derive(Clone, Copy, Debug)]
pub enum Path<'a> {
    /// Straight lines from point to point, two points or more.
    Polyline(&'a [[f64; 2]]),
    /// Cubic Bézier curves, each starting where the last one ends: 3 n + 1 points, n at least 1.
    CubicBezier(&'a [[f64; 2]]),
}

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

/// Relative accuracy of arc lengths.
const ARC_LENGTH_ACCURACY: f64 = 1e-7;

impl<'a> Path<'a> {
    fn points(self) -> (&'a [[f64; 2]], &'static str) {
        match self {
            Self::Polyline(points) => (points, "two or more"),
            Self::CubicBezier(points) => (points, "3 n + 1, n curves with n at least 1"),
        }
    }

    /// The path's pieces, and its length in scene units. `units_per_uv` scales texture space for arc length and
    /// for parting tangents.
    pub(crate) fn pieces(self, units_per_uv: DVec2, scratch: u32) -> Result<(Vec<Piece>, f64)> {
        let curves = self.curves(units_per_uv)?;
        let lengths: Vec<f64> = curves.iter().map(arc_length).collect();
        let whole: f64 = lengths.iter().sum();
        if whole.is_nan() || whole <= 0.0 || whole.is_infinite() {
            return Err(Error::number(
                "points_uv",
                whole,
                "a path of finite length above 0",
            ));
        }
        let mut pieces: Vec<Piece> = Vec::with_capacity(curves.len());
        let mut before = 0.0;
        for (curve, length) in curves
            .iter()
            .zip(&lengths)
            .filter(|(_, length)| **length > 0.0)
        {
            let count = pieces_needed(curve);
            let mut start = before;
            for i in 0..count {
                let part = |i: usize| i as f64 / count as f64;
                let sub = curve.subsegment(part(i)..part(i + 1));
                let end = if i + 1 == count {
                    before + length
                } else {
                    start + arc_length(&sub)
                };
                pieces.push(piece(
                    &sub,
                    [start / whole, end / whole],
                    units_per_uv,
                    scratch,
                ));
                start = end;
            }
            before += length;
        }
        part_corners(&mut pieces, units_per_uv);
        Ok((pieces, whole))
    }

    /// Scaled curves, checked.
    fn curves(self, scale: DVec2) -> Result<Vec<CubicBez>> {
        let (points, accepted) = self.points();
        let count_fits = match self {
            Self::Polyline(_) => points.len() >= 2,
            Self::CubicBezier(_) => points.len() >= 4 && points.len() % 3 == 1,
        };
        if !count_fits {
            return Err(Error::count("point_count", points.len(), accepted));
        }
        for (i, point) in points.iter().enumerate() {
            for &value in point {
                if !value.is_finite() || value.abs() > 1e9 {
                    let accepted = "a finite u or v between -1e9 and 1e9";
                    return Err(Error::number("", value, accepted).within("points_uv", i));
                }
            }
        }
        let place = |p: [f64; 2]| Point::new(p[0] * scale.x, p[1] * scale.y);
        let line = |pair: &[[f64; 2]]| {
            let (a, b) = (place(pair[0]), place(pair[1]));
            CubicBez::new(a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b)
        };
        let bezier = |i: usize| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| place(points[3 * i + k]));
            CubicBez::new(a, b, c, d)
        };
        Ok(match self {
            Self::Polyline(_) => points.windows(2).map(line).collect(),
            Self::CubicBezier(_) => (0..points.len() / 3).map(bezier).collect(),
        })
    }
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

fn arc_length(curve: &CubicBez) -> f64 {
    let hull = (curve.p1 - curve.p0).hypot()
        + (curve.p2 - curve.p1).hypot()
        + (curve.p3 - curve.p2).hypot();
    if hull > 0.0 {
        curve.arclen(ARC_LENGTH_ACCURACY * hull)
    } else {
        0.0
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

    /// A Bézier quarter circle: its arc length, its turn shared out, and shares that grow to 1.
    #[test]
    fn quarter_circle() {
        let k = 0.5522847498;
        let points = [[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]];
        let pieces = Path::CubicBezier(&points).pieces(DVec2::ONE, 0).unwrap().0;
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

    /// Points that coincide, are too few or not finite are refused by name.
    #[test]
    fn bad_paths_are_refused() {
        let refused = |path: Path<'_>| path.pieces(DVec2::ONE, 0).unwrap_err().to_string();
        assert!(
            refused(Path::Polyline(&[])).starts_with("point_count is 0"),
            "empty"
        );
        assert!(
            refused(Path::Polyline(&[[0.5; 2]; 3])).contains("length above 0"),
            "no length"
        );
        let bad = [[0.0, 0.0], [1.0, f64::NAN]];
        assert!(
            refused(Path::Polyline(&bad)).starts_with("points_uv[1] is NaN"),
            "NaN"
        );
        assert!(
            refused(Path::CubicBezier(&[[0.0; 2]; 5])).contains("3 n + 1"),
            "count"
        );
    }
}
