//! The pieces that paths are cut into, and how a pattern holds them: control points and 12 bytes a piece.

use super::closest::{LengthShares, speed};
use super::path::{Curve, scaled};
use bytemuck::{Pod, Zeroable};
use glam::DVec2;
use kurbo::{CubicBez, ParamCurve, Point};
use std::sync::Arc;

/// A piece turns by no more than this, so that it has one nearest point and a tight box.
const MOST_TURN_RAD: f64 = 0.5;

/// Arc length within a piece is interpolated; it strays from the true one by at most this share of the piece.
const LENGTH_ACCURACY: f64 = 5e-5;

/// Corners of a plain curve's control polygon turn by no more than this (its tangent), and no leg is longer than so many
/// times another.
const PLAIN_TURN: f64 = 0.05;
const PLAIN_LEGS: f64 = 3.0;

/// A path's curve is cut into at most 2 to the power of this.
const MOST_HALVINGS: u32 = 9;

/// A straight line: two control points, not four.
const LINE: u32 = 1 << 31;
/// Starts where the piece before it ends (the first piece of a closed path: where the last one ends).
const JOINED: u32 = 1 << 30;

/// A piece of a path: a cubic Bézier curve in texture space.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Piece {
    /// Number of its first control point, and the two flags.
    place: u32,
    pub scratch: u32,
    /// Share of the path's arc length at its end.
    pub end_at: f32,
}

/// Pieces and their control points, (u, v); a joined piece shares its first point with the piece before it. A pattern
/// shares them with its builder.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chains {
    pub points: Arc<Vec<DVec2>>,
    pub pieces: Arc<Vec<Piece>>,
}

/// Pieces to read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curves<'p> {
    pub points: &'p [DVec2],
    pub pieces: &'p [Piece],
}

impl Chains {
    /// One path's pieces. `units_per_uv` scales texture space for turning and arc length.
    #[cfg(test)]
    pub(crate) fn of_path(curves: &[Curve], units_per_uv: DVec2) -> Self {
        let mut chains = Self::default();
        chains.push_path(curves, units_per_uv, 0);
        chains
    }

    /// Appends a path as scratch number `scratch`; its pieces. `units_per_uv` scales texture space for turning and
    /// arc length.
    pub(crate) fn push_path(
        &mut self,
        curves: &[Curve],
        units_per_uv: DVec2,
        scratch: u32,
    ) -> Curves<'_> {
        let whole: f64 = curves.iter().map(|curve| curve.length).sum();
        let first = self.pieces.len();
        let mut path = Growing {
            first_point: self.points.len(),
            points: Arc::make_mut(&mut self.points),
            pieces: Arc::make_mut(&mut self.pieces),
            scratch,
        };
        let mut before = 0.0;
        for curve in curves {
            let [a, b, c, d] = curve.control;
            if b == a.lerp(d, 1.0 / 3.0) && c == a.lerp(d, 2.0 / 3.0) {
                path.push(&[a, d], LINE, curve.joins, (before + curve.length) / whole);
            } else {
                path.push_curve(curve, before, whole, units_per_uv);
            }
            before += curve.length;
        }
        if let Some(last) = path.pieces.last_mut() {
            last.end_at = 1.0;
        }
        Curves {
            points: &self.points,
            pieces: &self.pieces[first..],
        }
    }

    /// Appends other paths' pieces, the first of which becomes scratch number `scratch`.
    pub(crate) fn append(&mut self, paths: &Self, scratch: u32) {
        let shift = u32::try_from(self.points.len()).unwrap_or(0);
        Arc::make_mut(&mut self.points).extend(&*paths.points);
        let pieces = Arc::make_mut(&mut self.pieces);
        pieces.extend(paths.pieces.iter().map(|piece| Piece {
            place: piece.place + shift,
            scratch: piece.scratch + scratch,
            ..*piece
        }));
    }

    /// Takes back all but the first so many control points and pieces.
    pub(crate) fn truncate(&mut self, points: usize, pieces: usize) {
        Arc::make_mut(&mut self.points).truncate(points);
        Arc::make_mut(&mut self.pieces).truncate(pieces);
    }

    #[cfg(test)]
    pub(crate) fn curves(&self) -> Curves<'_> {
        Curves {
            points: &self.points,
            pieces: &self.pieces,
        }
    }
}

/// A path whose pieces are being appended.
struct Growing<'c> {
    points: &'c mut Vec<DVec2>,
    pieces: &'c mut Vec<Piece>,
    first_point: usize,
    scratch: u32,
}

impl Growing<'_> {
    fn push_curve(&mut self, curve: &Curve, before: f64, whole: f64, units_per_uv: DVec2) {
        let control = curve.control.map(|p| p * units_per_uv);
        // On a mesh a curve's length is its own, not its texture space's.
        let own = |length| if length > 0.0 { curve.length } else { 0.0 };
        let way = match is_plain(&control) {
            true => Some(curve.length),
            false => plain_length(&control).map(own),
        };
        if let Some(way) = way {
            return self.push(&curve.control, 0, curve.joins, (before + way) / whole);
        }
        let fits = |&halvings: &u32| {
            parts(&scaled(&curve.control, units_per_uv), halvings)
                .all(|part| plain_length(&points_of(&part)).is_some())
        };
        let halvings = (1..MOST_HALVINGS).find(fits).unwrap_or(MOST_HALVINGS);
        let one = scaled(&curve.control, DVec2::ONE);
        let controls: Vec<[DVec2; 4]> =
            parts(&one, halvings).map(|part| points_of(&part)).collect();
        let in_uv = |control: &[DVec2; 4]| length(&control.map(|p| p * units_per_uv), 0.0, 1.0);
        // Here too.
        let stretch = curve.length / controls.iter().map(in_uv).sum::<f64>();
        let mut at = before;
        for (i, control) in controls.iter().enumerate() {
            at += stretch * in_uv(control);
            self.push(control, 0, i > 0 || curve.joins, at / whole);
        }
    }

    fn push(&mut self, control: &[DVec2], flags: u32, joins: bool, end_at: f64) {
        // The first piece of a closed path is joined to points that are yet to come.
        let shares = joins && self.points.len() > self.first_point;
        let first = self.points.len() - usize::from(shares);
        self.points.extend(&control[usize::from(shares)..]);
        self.pieces.push(Piece {
            place: u32::try_from(first).unwrap_or(0) | flags | if joins { JOINED } else { 0 },
            scratch: self.scratch,
            end_at: crate::single(end_at),
        });
    }
}

impl Piece {
    /// Most control points that piece numbers can tell apart.
    pub(crate) const MOST_POINTS: usize = (JOINED - 1) as usize;

    pub(crate) fn is_joined(&self) -> bool {
        self.place & JOINED != 0
    }

    fn is_line(&self) -> bool {
        self.place & LINE != 0
    }

    fn first_point(&self) -> usize {
        (self.place & !(LINE | JOINED)) as usize
    }
}

impl Curves<'_> {
    /// Whether one path's pieces, these, go on where they end.
    pub(crate) fn is_closed(&self) -> bool {
        self.pieces.first().is_some_and(Piece::is_joined)
    }

    /// The ends of a piece, (u, v), if it is kept as a straight line.
    #[inline(always)]
    pub(crate) fn line(&self, number: usize) -> Option<[DVec2; 2]> {
        let piece = self.pieces.get(number)?;
        let first = piece.first_point();
        let ends = self.points.get(first..first + 2)?;
        piece.is_line().then(|| [ends[0], ends[1]])
    }

    /// Control points of a piece's cubic curve, (u, v).
    pub(crate) fn control(&self, number: usize) -> [DVec2; 4] {
        let place = self.pieces.get(number).map_or(0, |piece| piece.place);
        let first = (place & !(LINE | JOINED)) as usize;
        let point = |i: usize| self.points.get(first + i).copied().unwrap_or(DVec2::ZERO);
        if place & LINE != 0 {
            line_control([point(0), point(1)])
        } else {
            [0, 1, 2, 3].map(point)
        }
    }

    /// Touches what [`Self::control`] is to be asked for next. Where a million pieces lie all over memory, it gives many at
    /// once sooner than one after another.
    pub(crate) fn touch(&self, numbers: &[u32]) {
        let touched = numbers.iter().fold(0, |touched, &number| {
            let piece = self.pieces.get(number as usize);
            let first = piece.map_or(0, Piece::first_point);
            touched ^ self.points.get(first).map_or(0, |point| point.x.to_bits())
        });
        core::hint::black_box(touched);
    }

    /// Where a piece starts and ends, (u, v).
    pub(crate) fn ends(&self, number: usize) -> [DVec2; 2] {
        let place = self.pieces.get(number).map_or(0, |piece| piece.place);
        let first = (place & !(LINE | JOINED)) as usize;
        let last = first + if place & LINE != 0 { 1 } else { 3 };
        [first, last].map(|i| self.points.get(i).copied().unwrap_or(DVec2::ZERO))
    }

    /// Shares of the path's arc length at a piece's start and end.
    pub(crate) fn at(&self, number: usize) -> [f64; 2] {
        let Some(piece) = self.pieces.get(number) else {
            return [0.0; 2];
        };
        let before = number.checked_sub(1).map(|i| self.pieces[i]);
        let start = before.filter(|before| before.scratch == piece.scratch);
        [start.map_or(0.0, |before| before.end_at), piece.end_at].map(f64::from)
    }

    /// Lowest and highest (u, v) of a piece's control points, which hold the curve.
    pub(crate) fn bounds(&self, number: usize) -> [DVec2; 2] {
        bounds(&self.control(number))
    }
}

/// Control points of a straight line that is run through evenly.
#[inline(always)]
pub(crate) fn line_control([a, d]: [DVec2; 2]) -> [DVec2; 4] {
    [a, a.lerp(d, 1.0 / 3.0), a.lerp(d, 2.0 / 3.0), d]
}

/// Lowest and highest of these points.
pub(crate) fn bounds([a, b, c, d]: &[DVec2; 4]) -> [DVec2; 2] {
    [a.min(*b).min(*c).min(*d), a.max(*b).max(*c).max(*d)]
}

/// How far control points stray from the chord.
pub(crate) fn sagitta(control: &[DVec2; 4]) -> f64 {
    let chord = (control[3] - control[0]).normalize_or_zero();
    let stray = |p: DVec2| {
        let offset = p - control[0];
        (offset - chord * offset.dot(chord)).length_squared()
    };
    stray(control[1]).max(stray(control[2])).sqrt()
}

/// Both halves of a curve (de Casteljau).
pub(crate) fn halves([a, b, c, d]: [DVec2; 4]) -> [[DVec2; 4]; 2] {
    let middle = |p: DVec2, q: DVec2| 0.5 * (p + q);
    let (ab, bc, cd) = (middle(a, b), middle(b, c), middle(c, d));
    let (abc, bcd) = (middle(ab, bc), middle(bc, cd));
    let abcd = middle(abc, bcd);
    [[a, ab, abc, abcd], [abcd, bcd, cd, d]]
}

/// A curve in 2 to the power of `halvings` parts, equal in its parameter.
fn parts(curve: &CubicBez, halvings: u32) -> impl Iterator<Item = CubicBez> {
    let (curve, count) = (*curve, 1_u32 << halvings);
    let part = move |i: u32| f64::from(i) / f64::from(count);
    (0..count).map(move |i| curve.subsegment(part(i)..part(i + 1)))
}

pub(super) fn points_of(curve: &CubicBez) -> [DVec2; 4] {
    let point = |p: Point| DVec2::new(p.x, p.y);
    [curve.p0, curve.p1, curve.p2, curve.p3].map(point)
}

/// Whether a curve is so straight, and run through so evenly, that interpolation knows its parts, and [`length`] knows it
/// within 3e-7: told without a root.
pub(super) fn is_plain([a, b, c, d]: &[DVec2; 4]) -> bool {
    let legs = [*b - *a, *c - *b, *d - *c];
    let turns_little = |p: DVec2, q: DVec2| p.perp_dot(q).abs() < PLAIN_TURN * p.dot(q);
    let [first, middle, last] = legs.map(DVec2::length_squared);
    let (least, most) = (first.min(middle).min(last), first.max(middle).max(last));
    turns_little(legs[0], legs[1])
        && turns_little(legs[1], legs[2])
        && most <= PLAIN_LEGS * PLAIN_LEGS * least
}

/// A curve's arc length, if it turns little and interpolation knows its parts.
fn plain_length(control: &[DVec2; 4]) -> Option<f64> {
    let is_gentle = is_gentle(control);
    if !is_gentle && turn_rad(control) > MOST_TURN_RAD {
        return None;
    }
    let length = if is_gentle { gentle_length } else { length };
    let quarters = [0.0, 0.25].map(|from| length(control, from, from + 0.25));
    let half = quarters[0] + quarters[1];
    let whole = half + length(control, 0.5, 1.0);
    let shares = LengthShares::of(control);
    let strays =
        [(0.25, quarters[0]), (0.5, half)].map(|(t, length)| (shares.at(t) - length / whole).abs());
    let strays = strays[0].max(strays[1]);
    (whole <= 0.0 || strays <= LENGTH_ACCURACY).then_some(whole)
}

/// Arc length between two parameters by Gauss and Legendre's rule of five points: 1e-6 and better for what a piece
/// may be.
pub(super) fn length(control: &[DVec2; 4], from: f64, to: f64) -> f64 {
    const NODES: [(f64, f64); 5] = [
        (0.046910077030668, 0.118463442528095),
        (0.230765344947158, 0.239314335249683),
        (0.5, 0.284444444444444),
        (0.769234655052842, 0.239314335249683),
        (0.953089922969332, 0.118463442528095),
    ];
    integral(control, from, to, &NODES)
}

/// The same by the rule of three points, for gentle curves: their speed is nearly a parabola, of which it is exact.
fn gentle_length(control: &[DVec2; 4], from: f64, to: f64) -> f64 {
    const NODES: [(f64, f64); 3] = [
        (0.112701665379258, 0.277777777777778),
        (0.5, 0.444444444444444),
        (0.887298334620742, 0.277777777777778),
    ];
    integral(control, from, to, &NODES)
}

/// The mean of the speed between two parameters at these nodes, by their weights, times the way.
#[inline(always)]
fn integral(control: &[DVec2; 4], from: f64, to: f64, nodes: &[(f64, f64)]) -> f64 {
    let at = |t: f64| from + (to - from) * t;
    let sum: f64 = nodes.iter().map(|&(t, w)| w * speed(control, at(t))).sum();
    (to - from) * sum
}

/// Whether neither corner of the control polygon turns by more than half of what a piece may: told without a root.
fn is_gentle([a, b, c, d]: &[DVec2; 4]) -> bool {
    let gentle = |p: DVec2, q: DVec2| p.perp_dot(q).abs() < 0.5 * MOST_TURN_RAD * p.dot(q);
    gentle(*b - *a, *c - *b) && gentle(*c - *b, *d - *c)
}

/// How much the legs of the control polygon turn in all: no less than the curve does.
fn turn_rad(control: &[DVec2; 4]) -> f64 {
    let [a, b, c, d] = *control;
    let legs = [b - a, c - b, d - c];
    let scale = legs.iter().map(|leg| leg.length()).fold(0.0, f64::max);
    let mut legs = legs.into_iter().filter(|leg| leg.length() > 1e-9 * scale);
    let Some(mut last) = legs.next() else {
        return 0.0;
    };
    let mut sum = 0.0;
    for leg in legs {
        sum += last.angle_to(leg).abs();
        last = leg;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Path;
    use crate::pattern::closest::length_share;

    /// A Bézier quarter circle: shares of arc length that grow to 1, in proportion to the angle.
    #[test]
    fn quarter_circle() {
        let k = 0.5522847498;
        let points = [[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]];
        let curves = Path::CubicBezier(&points).curves(DVec2::ONE).unwrap();
        let chains = Chains::of_path(&curves, DVec2::ONE);
        let curves = chains.curves();
        assert!(chains.pieces.len() >= 4, "{} pieces", chains.pieces.len());
        for number in 0..chains.pieces.len() {
            let ([_, to], control) = (curves.at(number), curves.control(number));
            let angle = control[3].to_angle().rem_euclid(core::f64::consts::TAU);
            let share = angle / core::f64::consts::FRAC_PI_2;
            assert!((to - share).abs() < 3e-4, "{to} against {share}");
        }
        assert_eq!(chains.pieces[chains.pieces.len() - 1].end_at, 1.0);
    }

    /// However unevenly a curve's parameter runs, its pieces know their arc lengths to 1e-4 of the path.
    #[test]
    fn uneven_curves_know_their_lengths() {
        let points = [[0.0, 0.0], [0.01, 0.0], [0.02, 0.0], [1.0, 0.4]];
        let curves = Path::CubicBezier(&points).curves(DVec2::ONE).unwrap();
        let chains = Chains::of_path(&curves, DVec2::ONE);
        let curves = chains.curves();
        let whole = brute(&points.map(DVec2::from), 1.0);
        let mut before = 0.0;
        for number in 0..chains.pieces.len() {
            let ([from, to], control) = (curves.at(number), curves.control(number));
            for t in [0.2, 0.5, 0.9] {
                let ours = from + (to - from) * length_share(&control, t);
                let truth = (before + brute(&control, t)) / whole;
                assert!((ours - truth).abs() < 1e-4, "{ours} against {truth}");
            }
            before += brute(&control, 1.0);
        }
    }

    /// However a plain curve turns and runs within its bounds, interpolation knows its parts, and its length is that of
    /// kurbo.
    #[test]
    fn plain_curves_are_plain() {
        let turns = [-1.0, -0.4, 0.0, 1.0].map(|share| 0.999 * share * PLAIN_TURN);
        let legs = [0.334, 0.6, 1.0];
        for number in 0..4 * 4 * 27 {
            let leg = |i: usize| legs[number / 16 / [1, 3, 9][i] % 3];
            let turn_rad = |i: usize| turns[number / [1, 4][i] % 4].atan();
            let middle = 7.0 * DVec2::from_angle(0.3);
            let b = DVec2::new(3.0, -2.0);
            let a = b - leg(0) * DVec2::from_angle(-turn_rad(0)).rotate(middle);
            let c = b + leg(1) * middle;
            let control = [
                a,
                b,
                c,
                c + leg(2) * DVec2::from_angle(turn_rad(1)).rotate(middle),
            ];
            assert!(is_plain(&control), "curve {number} is not");
            let truth = |to: f64| {
                let curve = scaled(&control, DVec2::ONE).subsegment(0.0..to);
                kurbo::ParamCurveArclen::arclen(&curve, 1e-12)
            };
            let whole = truth(1.0);
            let off = length(&control, 0.0, 1.0) / whole - 1.0;
            assert!(off.abs() < 3e-7, "curve {number} is off by {off:e}");
            let shares = LengthShares::of(&control);
            for i in 1..20 {
                let t = f64::from(i) / 20.0;
                let off = shares.at(t) - truth(t) / whole;
                assert!(
                    off.abs() < LENGTH_ACCURACY,
                    "curve {number}: {off:e} at {t}"
                );
            }
        }
    }

    fn brute(control: &[DVec2; 4], to: f64) -> f64 {
        let at = |i: u32| super::super::closest::bezier(control, to * f64::from(i) / 1e4);
        (0..10_000).map(|i| at(i).distance(at(i + 1))).sum()
    }
}
