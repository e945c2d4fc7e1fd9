//! Curves as they are drawn, in the plane or in space, and the cubic Bézier curves they come to.

use crate::error::{Error, Result};
use core::array::from_fn;

/// A curve through or along points, open or closed, in the plane (`D` = 2) or in space (`D` = 3).
#[derive(Clone, Copy, Debug)]
pub struct Spline<'a, const D: usize> {
    /// What its points mean.
    pub kind: SplineKind<'a>,
    /// Its points, each coordinate from -1e9 to 1e9.
    pub points: &'a [[f64; D]],
    /// It ends where it begins.
    pub closed: bool,
}

/// What a curve's points mean, and how many there must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SplineKind<'a> {
    /// Straight lines from point to point: two points or more. Closed (three or more), the last joins the first.
    Polyline,
    /// Cubic Bézier curves, each starting where the last one ends: 3 n + 1 points, n at least 1. Closed, the
    /// last one ends at the first point: 3 n points.
    CubicBezier,
    /// A smooth curve through all points: two or more, closed three or more. It is the centripetal
    /// Catmull-Rom spline (parameter steps grow with the square root of distance), the one that
    /// neither loops nor overshoots between unevenly spaced points (Yuksel, Schaefer and Keyser 2011). An open one
    /// sets out straight towards its second point, and arrives likewise. Points that repeat the one before count once.
    CatmullRom,
    /// A uniform cubic B-spline, smooth to its curvature, led by its points and passing through none: four or more;
    /// open, n points give n - 3 curves and both ends lie inside. Closed it is periodic: three or more.
    BSpline,
    /// A cubic B-spline with its knots: four points or more. Open, n points take n + 4 knots, never descending, and
    /// the curve runs from `knots[3]` to `knots[n]`: clamped to its first and last point where these knots are there
    /// four times, unclamped otherwise. (Programs that state n + 2 knots leave out the first and the last, which
    /// move nothing: repeat their neighbours.) Between the ends a knot may be there three times at
    /// most: three times is a corner.
    ///
    /// Closed it is periodic: n points, three or more, take n + 1 knots, from the first to its repetition one round
    /// later. Of a periodic curve told as an open one, its first three points repeated at its end, leave out those
    /// three and the last six knots.
    NonUniformBSpline {
        /// Parameters where one cubic passes into the next, -1e9 to 1e9.
        knots: &'a [f64],
    },
}

/// Control points of one cubic Bézier curve.
pub(super) type Cubic<const D: usize> = [[f64; D]; 4];

impl<'a, const D: usize> Spline<'a, D> {
    /// A curve with two ends.
    pub const fn open(kind: SplineKind<'a>, points: &'a [[f64; D]]) -> Self {
        Self {
            kind,
            points,
            closed: false,
        }
    }

    /// A curve that ends where it begins.
    pub const fn closed(kind: SplineKind<'a>, points: &'a [[f64; D]]) -> Self {
        Self {
            kind,
            points,
            closed: true,
        }
    }

    /// Its cubic curves in order, each beginning where the last one ends to the bit, checked; some may have no length.
    /// `array` names its points in errors; `scale` makes its coordinates comparable, for distances.
    pub(super) fn cubics(&self, array: &'static str, scale: [f64; D]) -> Result<Vec<Cubic<D>>> {
        self.check(array)?;
        let points = self.points;
        let sides = points.len() - usize::from(!self.closed);
        let next = |i: usize| points[(i + 1) % points.len()];
        Ok(match self.kind {
            SplineKind::Polyline => (0..sides).map(|i| line(points[i], next(i))).collect(),
            SplineKind::CubicBezier => {
                let corner = |i: usize| points[i % points.len()];
                let curve = |i: usize| from_fn(|k| corner(3 * i + k));
                (0..points.len() / 3).map(curve).collect()
            }
            SplineKind::CatmullRom => catmull_rom(points, self.closed, scale),
            SplineKind::BSpline => self.b_spline(|i| i as f64),
            SplineKind::NonUniformBSpline { knots } => {
                self.b_spline(|i| knot(knots, points.len(), self.closed, i))
            }
        })
    }

    fn check(&self, array: &'static str) -> Result<()> {
        let count = self.points.len();
        let (fits, accepted) = match (self.kind, self.closed) {
            (SplineKind::CubicBezier, false) => (
                count >= 4 && count % 3 == 1,
                "3 n + 1, n curves with n at least 1",
            ),
            (SplineKind::CubicBezier, true) => (
                count >= 3 && count.is_multiple_of(3),
                "3 n for a closed curve, n at least 1",
            ),
            (SplineKind::Polyline | SplineKind::CatmullRom, false) => (count >= 2, "two or more"),
            (_, true) => (count >= 3, "three or more for a closed curve"),
            (_, false) => (count >= 4, "four or more"),
        };
        if !fits {
            return Err(Error::count("point_count", count, accepted));
        }
        for (i, point) in self.points.iter().enumerate() {
            if let Some(&value) = point.iter().find(|value| !plausible(**value)) {
                return Err(Error::number("", value, PLAUSIBLE).within(array, i));
            }
        }
        match self.kind {
            SplineKind::NonUniformBSpline { knots } => check_knots(knots, count, self.closed),
            _ => Ok(()),
        }
    }

    /// The cubics of a B-spline with these knots; those between coinciding knots are left out.
    fn b_spline(&self, knot: impl Fn(usize) -> f64) -> Vec<Cubic<D>> {
        let count = self.points.len();
        let spans = if self.closed { count } else { count - 3 };
        let mut curves: Vec<Cubic<D>> = Vec::with_capacity(spans);
        for i in 0..spans {
            let knots = from_fn(|k| knot(i + 1 + k));
            if knots[2] < knots[3] {
                let mut curve = b_spline_span(from_fn(|k| self.points[(i + k) % count]), knots);
                if let Some(before) = curves.last() {
                    curve[0] = before[3];
                }
                curves.push(curve);
            }
        }
        if self.closed
            && let Some(&[start, ..]) = curves.first()
            && let Some(last) = curves.last_mut()
        {
            last[3] = start;
        }
        curves
    }
}

const PLAUSIBLE: &str = "a finite number from -1e9 to 1e9";

fn plausible(value: f64) -> bool {
    value.abs() <= 1e9
}

/// Refuses knots that are not finite, descend, leave the curve no room or tear it.
fn check_knots(knots: &[f64], points: usize, closed: bool) -> Result<()> {
    let (wanted, accepted) = if closed {
        (points + 1, "point_count + 1 for a closed curve")
    } else {
        (points + 4, "point_count + 4")
    };
    if knots.len() != wanted {
        return Err(Error::count("knot_count", knots.len(), accepted));
    }
    let refused = |i: usize, accepted: &'static str| {
        Err(Error::number("", knots[i], accepted).within("knots", i))
    };
    for i in 0..knots.len() {
        if !plausible(knots[i]) {
            return refused(i, PLAUSIBLE);
        }
        if i > 0 && knots[i] < knots[i - 1] {
            return refused(i, "a number not below the knot before");
        }
    }
    let start = if closed { 0 } else { 3 };
    if knots[start] >= knots[points] {
        return refused(points, "a number above the knot that the curve begins at");
    }
    let inside = |knot: f64| closed || (knots[3] < knot && knot < knots[points]);
    let at = |i: usize| knot(knots, points, closed, i);
    match (0..points).find(|&i| inside(knots[i]) && at(i) == at(i + 3)) {
        Some(i) => refused(i, "a knot inside the curve three times at most"),
        None => Ok(()),
    }
}

/// Knot i, of a closed curve relative to its first and going on round after round.
fn knot(knots: &[f64], points: usize, closed: bool, i: usize) -> f64 {
    if !closed {
        return knots[i];
    }
    let period = knots[points] - knots[0];
    (knots[i % points] - knots[0]) + period * (i / points) as f64
}

/// A straight line.
fn line<const D: usize>(a: [f64; D], b: [f64; D]) -> Cubic<D> {
    [a, lerp(a, b, 1.0 / 3.0), lerp(a, b, 2.0 / 3.0), b]
}

/// Both ends exact.
fn lerp<const D: usize>(a: [f64; D], b: [f64; D], t: f64) -> [f64; D] {
    from_fn(|i| a[i] * (1.0 - t) + b[i] * t)
}

/// One span of a cubic B-spline: four points and the six knots around it, between the middle two of which it
/// runs. Its control points are its blossom's values there (Ramshaw 1989), found by knot insertion.
fn b_spline_span<const D: usize>(points: [[f64; D]; 4], knots: [f64; 6]) -> Cubic<D> {
    let [a, b, c, d] = points;
    let [t1, t2, t3, t4, t5, t6] = knots;
    let second = lerp(b, c, (t3 - t2) / (t5 - t2));
    let third = lerp(b, c, (t4 - t2) / (t5 - t2));
    let before = lerp(a, b, (t3 - t1) / (t4 - t1));
    let after = lerp(c, d, (t4 - t3) / (t6 - t3));
    [
        lerp(before, second, (t3 - t2) / (t4 - t2)),
        second,
        third,
        lerp(third, after, (t4 - t3) / (t5 - t3)),
    ]
}

/// The centripetal Catmull-Rom spline through these points.
fn catmull_rom<const D: usize>(
    points: &[[f64; D]],
    closed: bool,
    scale: [f64; D],
) -> Vec<Cubic<D>> {
    // The square root of distance: the parameter's step.
    let step = |a: &[f64; D], b: &[f64; D]| {
        let squares = (0..D).map(|k| ((b[k] - a[k]) * scale[k]).powi(2));
        squares.sum::<f64>().sqrt().sqrt()
    };
    let mut points = points.to_vec();
    points.dedup_by(|b, a| step(a, b) == 0.0);
    if closed && points.len() > 1 && step(&points[0], &points[points.len() - 1]) == 0.0 {
        points.pop();
    }
    let count = points.len();
    if count < 2 {
        return Vec::new();
    }
    let to_next = |i: usize| step(&points[i], &points[(i + 1) % count]);
    let steps: Vec<f64> = (0..count).map(to_next).collect();
    // Derivative by the parameter at point i, a third of it, from the parabola through it and its neighbours.
    let third = |i: usize| -> [f64; D] {
        let (before, after) = ((i + count - 1) % count, (i + 1) % count);
        let (d, e) = (steps[before], steps[i]);
        from_fn(|k| {
            let (into, out) = (
                (points[i][k] - points[before][k]) / d,
                (points[after][k] - points[i][k]) / e,
            );
            (into * e + out * d) / (3.0 * (d + e))
        })
    };
    let sides = if closed { count } else { count - 1 };
    let curve = |i: usize| {
        let j = (i + 1) % count;
        let (a, b) = (points[i], points[j]);
        let mut cubic = line(a, b);
        if closed || i > 0 {
            let third = third(i);
            cubic[1] = from_fn(|k| a[k] + steps[i] * third[k]);
        }
        if closed || j + 1 < count {
            let third = third(j);
            cubic[2] = from_fn(|k| b[k] - steps[i] * third[k]);
        }
        cubic
    };
    (0..sides).map(curve).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// De Boor's recursion, at parameter t between knots k and k + 1.
    fn de_boor(points: &[[f64; 2]], knots: &[f64], k: usize, t: f64) -> [f64; 2] {
        let mut d: [[f64; 2]; 4] = from_fn(|j| points[j + k - 3]);
        for r in 1..4 {
            for j in (r..4).rev() {
                let (low, high) = (knots[j + k - 3], knots[j + 1 + k - r]);
                let alpha = (t - low) / (high - low);
                d[j] = from_fn(|i| (1.0 - alpha) * d[j - 1][i] + alpha * d[j][i]);
            }
        }
        d[3]
    }

    fn bezier(cubic: &Cubic<2>, t: f64) -> [f64; 2] {
        let [a, b, c, d] = *cubic;
        let (ab, bc, cd) = (lerp(a, b, t), lerp(b, c, t), lerp(c, d, t));
        lerp(lerp(ab, bc, t), lerp(bc, cd, t), t)
    }

    const POINTS: [[f64; 2]; 7] = [
        [0.0, 0.0],
        [0.2, 0.9],
        [0.5, 0.3],
        [0.9, 0.7],
        [1.0, 0.1],
        [0.6, -0.4],
        [0.3, -0.1],
    ];

    fn assert_is_b_spline(cubics: &[Cubic<2>], points: &[[f64; 2]], knots: &[f64]) {
        let mut cubics = cubics.iter();
        for k in 3..points.len() {
            if knots[k] == knots[k + 1] {
                continue;
            }
            let cubic = cubics.next().unwrap();
            for share in [0.0, 0.1, 0.5, 0.8, 1.0] {
                let t = knots[k] + share * (knots[k + 1] - knots[k]);
                let (ours, truth) = (bezier(cubic, share), de_boor(points, knots, k, t));
                for i in 0..2 {
                    assert!(
                        (ours[i] - truth[i]).abs() < 1e-14,
                        "{t}: {ours:?} against {truth:?}"
                    );
                }
            }
        }
        assert!(cubics.next().is_none(), "more curves than spans");
    }

    /// Uniform, unclamped, clamped and with knots two and three times over: B-splines are de Boor's.
    #[test]
    fn b_splines_are_de_boors() {
        let uniform: Vec<f64> = (0..11).map(f64::from).collect();
        let cubics = Spline::open(SplineKind::BSpline, &POINTS).cubics("", [1.0; 2]);
        assert_is_b_spline(&cubics.unwrap(), &POINTS, &uniform);
        for knots in [
            [0.0, 0.3, 1.0, 1.1, 1.9, 2.0, 3.5, 4.0, 4.2, 5.0, 5.5],
            [0.0, 0.0, 0.0, 0.0, 0.2, 0.25, 0.7, 1.0, 1.0, 1.0, 1.0],
            [-2.0, -2.0, -2.0, -2.0, 1.0, 1.0, 1.5, 4.0, 4.0, 4.0, 4.0],
            [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 4.0, 4.0, 4.0, 4.0],
        ] {
            let kind = SplineKind::NonUniformBSpline { knots: &knots };
            let cubics = Spline::open(kind, &POINTS).cubics("", [1.0; 2]);
            assert_is_b_spline(&cubics.unwrap(), &POINTS, &knots);
        }
    }

    /// Periodic B-splines are de Boor's over points and knots that go round once more.
    #[test]
    fn closed_b_splines_are_de_boors() {
        let round: Vec<[f64; 2]> = POINTS.iter().chain(&POINTS[..3]).copied().collect();
        let uniform: Vec<f64> = (0..14).map(f64::from).collect();
        let cubics = Spline::closed(SplineKind::BSpline, &POINTS).cubics("", [1.0; 2]);
        assert_is_b_spline(&cubics.unwrap(), &round, &uniform);
        let mut knots = vec![0.5, 0.75, 1.5, 1.5, 1.75, 2.5, 3.5, 4.0];
        let kind = SplineKind::NonUniformBSpline { knots: &knots };
        let cubics = Spline::closed(kind, &POINTS).cubics("", [1.0; 2]).unwrap();
        for i in 1..7 {
            knots.push(knots[i] + 3.5);
        }
        assert_is_b_spline(&cubics, &round, &knots);
    }

    /// Where a curve ends the next begins, to the bit, and the last one where the first does.
    #[test]
    fn curves_hang_together() {
        let knots = [0.1, 0.2, 0.30001, 0.7, 0.9, 1.3, 1.7, 2.3];
        for kind in [
            SplineKind::Polyline,
            SplineKind::CatmullRom,
            SplineKind::BSpline,
            SplineKind::NonUniformBSpline { knots: &knots },
        ] {
            let cubics = Spline::closed(kind, &POINTS).cubics("", [1.0; 2]).unwrap();
            assert_eq!(cubics.len(), 7, "{kind:?}");
            for i in 0..7 {
                assert_eq!(cubics[i][3], cubics[(i + 1) % 7][0], "{kind:?}, {i}");
            }
        }
    }

    /// Bad knots are refused with what is accepted instead.
    #[test]
    fn bad_knots() {
        let points = &POINTS[..4];
        let refused = |closed: bool, knots: &[f64]| {
            let kind = SplineKind::NonUniformBSpline { knots };
            let spline = Spline {
                kind,
                points,
                closed,
            };
            spline.cubics("", [1.0; 2]).unwrap_err().to_string()
        };
        let inf = f64::INFINITY;
        for (closed, knots, text) in [
            (false, &[][..], "knot_count is 0; accepted: point_count + 4"),
            (
                true,
                &[0.0; 8],
                "knot_count is 8; accepted: point_count + 1",
            ),
            (
                false,
                &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, inf],
                "knots[7] is inf",
            ),
            (
                false,
                &[0.0, 1.0, 2.0, 3.0, 2.5, 5.0, 6.0, 7.0],
                "knots[4] is 2.5",
            ),
            (
                false,
                &[0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0],
                "knots[4] is 1",
            ),
            (
                true,
                &[0.0, 1.0, 1.0, 1.0, 1.0],
                "knots[1] is 1; accepted: a knot inside",
            ),
            (
                true,
                &[0.0, 0.0, 0.0, 1.0, 1.0],
                "knots[3] is 1; accepted: a knot inside",
            ),
            (true, &[1.0; 5], "knots[4] is 1; accepted: a number above"),
        ] {
            let said = refused(closed, knots);
            assert!(said.starts_with(text), "{said}, not {text}");
        }
    }
}
