//! The pieces that paths are cut into, and how a pattern holds them: control points and 12 bytes a piece.

use super::arc_length::{is_plain, length, plain_length};
use super::path::{Curve, scaled};
use bytemuck::{Pod, Zeroable};
use glam::DVec2;
use kurbo::{CubicBez, ParamCurve, Point};
use std::sync::Arc;

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

    /// The number of a piece's scratch.
    pub(crate) fn scratch(&self, number: u32) -> Option<u32> {
        let piece = self.pieces.get(number as usize);
        piece.map(|piece| piece.scratch)
    }

    /// The ends of a piece, (u, v), if it is kept as a straight line.
    #[inline(always)]
    pub(crate) fn line(&self, number: usize) -> Option<[DVec2; 2]> {
        let piece = self.pieces.get(number)?;
        let first = piece.first_point();
        let ends = self.points.get(first..first + 2)?;
        piece.is_line().then(|| [ends[0], ends[1]])
    }

    /// Whether a piece is a path by itself.
    #[inline(always)]
    pub(crate) fn is_alone(&self, number: usize) -> bool {
        let scratch = |i: usize| self.pieces.get(i).map(|piece| piece.scratch);
        let own = scratch(number);
        let is_joined = self.pieces.get(number).is_some_and(Piece::is_joined);
        !is_joined && scratch(number.wrapping_sub(1)) != own && scratch(number + 1) != own
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

    fn brute(control: &[DVec2; 4], to: f64) -> f64 {
        let at = |i: u32| super::super::closest::bezier(control, to * f64::from(i) / 1e4);
        (0..10_000).map(|i| at(i).distance(at(i + 1))).sum()
    }
}
