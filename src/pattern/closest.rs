//! The point of a short curve piece that is nearest to a point.

use glam::DVec2;

/// A smaller step of the parameter is none.
const SETTLED: f64 = 1e-12;

/// A cubic Bézier curve at parameter t.
pub(crate) fn bezier(control: &[DVec2; 4], t: f64) -> DVec2 {
    let [a, b, c, d] = *control;
    let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
    ab.lerp(bc, t).lerp(bc.lerp(cd, t), t)
}

/// Whether a curve is a straight line that is run through evenly, as far as rounding lets one tell.
#[inline(always)]
pub(crate) fn is_even_line([a, b, c, d]: &[DVec2; 4]) -> bool {
    let bends = [*a - 2.0 * *b + *c, *b - 2.0 * *c + *d].map(DVec2::length_squared);
    bends[0].max(bends[1]) <= 1e-18 * (*d - *a).length_squared()
}

/// A curve by powers of its parameter: what is asked for at many places is told soonest from these.
struct Powers {
    start: DVec2,
    once: DVec2,
    twice: DVec2,
    thrice: DVec2,
}

impl Powers {
    #[inline(always)]
    fn of([a, b, c, d]: &[DVec2; 4]) -> Self {
        let (ab, bc, cd) = (*b - *a, *c - *b, *d - *c);
        let (bend, other) = (bc - ab, cd - bc);
        Self {
            start: *a,
            once: 3.0 * ab,
            twice: 3.0 * bend,
            thrice: other - bend,
        }
    }

    #[inline(always)]
    fn point(&self, t: f64) -> DVec2 {
        self.start + t * (self.once + t * (self.twice + t * self.thrice))
    }

    /// Its first and second derivatives.
    #[inline(always)]
    fn derivatives(&self, t: f64) -> (DVec2, DVec2) {
        let (twice, thrice) = (2.0 * self.twice, 3.0 * t * self.thrice);
        (self.once + t * (twice + thrice), twice + 2.0 * thrice)
    }
}

/// Parameter and point nearest to `target` on the line from the one point to the other, and its unit tangent.
#[inline(always)]
pub(crate) fn nearest_on_line(from: DVec2, to: DVec2, target: DVec2) -> (f64, DVec2, DVec2) {
    let (t, point) = foot_on_line(from, to, target);
    (t, point, unit_or_x(to - from))
}

/// The same without the tangent.
#[inline(always)]
pub(crate) fn foot_on_line(from: DVec2, to: DVec2, target: DVec2) -> (f64, DVec2) {
    let chord = to - from;
    let t = foot(from, chord, target);
    (t, from + chord * t)
}

/// The share of a chord at which it comes nearest to `target`.
#[inline(always)]
fn foot(from: DVec2, chord: DVec2, target: DVec2) -> f64 {
    let along = (target - from).dot(chord) / chord.length_squared();
    if along.is_nan() {
        return 0.5;
    }
    along.clamp(0.0, 1.0)
}

/// Unit length; x of what has no direction.
#[inline(always)]
pub(crate) fn unit_or_x(v: DVec2) -> DVec2 {
    let by = 1.0 / v.length();
    // Compared with sooner than 0 and infinity.
    if by > 1e-300 && by < 1e300 {
        v * by
    } else {
        DVec2::X
    }
}

/// Parameter, point and unit tangent nearest to `target`.
///
/// Pieces turn little, so Newton's method from the foot on the chord settles within three steps (on a straight line
/// it is there before the first); the parameter stays in 0 to 1.
pub(crate) fn nearest(control: &[DVec2; 4], target: DVec2) -> (f64, DVec2, DVec2) {
    if is_even_line(control) {
        return nearest_on_line(control[0], control[3], target);
    }
    let curve = Powers::of(control);
    let mut t = foot(control[0], control[3] - control[0], target);
    for _ in 0..3 {
        let away = curve.point(t) - target;
        let (first, second) = curve.derivatives(t);
        let slope = first.length_squared() + away.dot(second);
        let step = if slope > 0.0 {
            away.dot(first) / slope
        } else {
            0.0
        };
        t = (t - step).clamp(0.0, 1.0);
        if step.abs() < SETTLED {
            break;
        }
    }
    (t, curve.point(t), direction(control, &curve, t))
}

/// The unit tangent at parameter t.
pub(crate) fn tangent(control: &[DVec2; 4], t: f64) -> DVec2 {
    match is_even_line(control) {
        true => unit_or_x(control[3] - control[0]),
        false => direction(control, &Powers::of(control), t),
    }
}

/// The same of a curve that is no even line.
#[inline(always)]
fn direction(control: &[DVec2; 4], curve: &Powers, t: f64) -> DVec2 {
    let (first, second) = curve.derivatives(t);
    let inward = if t > 0.5 { -second } else { second };
    unit_or_x(leading(first, inward, control[3] - control[0]))
}

/// At a control point that lies on the curve's end the derivative vanishes: the curve leaves along the next.
#[inline(always)]
fn leading(first: DVec2, inward: DVec2, chord: DVec2) -> DVec2 {
    let least = 1e-12 * chord.length_squared();
    let leads = |v: &DVec2| v.length_squared() > least;
    [first, inward].into_iter().find(leads).unwrap_or(chord)
}

/// The unit tangents at both ends.
pub(crate) fn end_tangents(control: &[DVec2; 4]) -> [DVec2; 2] {
    [start_tangent(control), end_tangent(control)]
}

/// The unit tangent where a curve starts.
#[inline(always)]
pub(crate) fn start_tangent([a, b, c, d]: &[DVec2; 4]) -> DVec2 {
    unit_or_x(leading(
        3.0 * (*b - *a),
        6.0 * (*c - 2.0 * *b + *a),
        *d - *a,
    ))
}

/// The unit tangent where it ends.
#[inline(always)]
pub(crate) fn end_tangent([a, b, c, d]: &[DVec2; 4]) -> DVec2 {
    unit_or_x(leading(
        3.0 * (*d - *c),
        6.0 * (2.0 * *c - *b - *d),
        *d - *a,
    ))
}

/// How fast a curve runs at parameter t, per unit of it.
pub(crate) fn speed(control: &[DVec2; 4], t: f64) -> f64 {
    Powers::of(control).derivatives(t).0.length()
}

/// How arc length runs along a piece: cubic Hermite through the speeds at both ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LengthShares {
    /// Speeds at both ends, as shares of the mean.
    speeds: [f64; 2],
}

impl LengthShares {
    pub(crate) fn of(control: &[DVec2; 4]) -> Self {
        let [a, b, c, d] = *control;
        let [from, middle, to] = [
            3.0 * (b - a).length(),
            0.75 * (c - b + d - a).length(),
            3.0 * (d - c).length(),
        ];
        let length = (from + 4.0 * middle + to) / 6.0;
        let speeds = match length > 0.0 {
            true => [from / length, to / length],
            false => [1.0; 2],
        };
        Self { speeds }
    }

    /// Share of the piece's arc length at parameter t.
    pub(crate) fn at(self, t: f64) -> f64 {
        let [from, to] = self.speeds;
        let (t2, t3) = (t * t, t * t * t);
        let share = (t3 - 2.0 * t2 + t) * from + (3.0 * t2 - 2.0 * t3) + (t3 - t2) * to;
        share.clamp(0.0, 1.0)
    }

    /// The parameter where this share of the arc length is reached: by Newton's method, halving where that leads away.
    pub(crate) fn parameter(self, share: f64) -> f64 {
        let [from, to] = self.speeds;
        let (mut low, mut high, mut t) = (0.0, 1.0, share.max(0.0));
        for _ in 0..40 {
            let off = self.at(t) - share;
            if off.abs() < SETTLED {
                break;
            }
            if off < 0.0 {
                low = t;
            } else {
                high = t;
            }
            let slope =
                (1.0 - t) * (1.0 - 3.0 * t) * from + 6.0 * t * (1.0 - t) - t * (2.0 - 3.0 * t) * to;
            let next = t - off / slope;
            t = match next > low && next < high {
                true => next,
                false => 0.5 * (low + high),
            };
        }
        t
    }
}

/// Share of the piece's arc length at parameter t.
pub(crate) fn length_share(control: &[DVec2; 4], t: f64) -> f64 {
    match is_even_line(control) {
        true => t,
        false => LengthShares::of(control).at(t),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The parameter of a share of the arc length is where that share is reached, on even curves and uneven ones.
    #[test]
    fn parameters_of_shares() {
        for speeds in [[1.0, 1.0], [0.0, 0.0], [0.2, 2.5], [2.9, 0.05], [0.0, 3.0]] {
            let lengths = LengthShares { speeds };
            for i in 0..=1000 {
                let share = f64::from(i) / 1000.0;
                let t = lengths.parameter(share);
                assert!((0.0..=1.0).contains(&t), "{speeds:?}, {share}: {t}");
                let off = lengths.at(t) - share;
                assert!(off.abs() < 1e-9, "{speeds:?}, {share}: off by {off}");
            }
        }
        assert!(
            LengthShares { speeds: [1.0; 2] }
                .parameter(f64::NAN)
                .is_finite()
        );
    }
}
