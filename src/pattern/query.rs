//! Which pieces of scratches come near a pixel's footprint.

use super::Pattern;
use super::pieces::Curves;
use super::point::Metric;
use super::raster::Touched;
use super::region::Region;
use super::seen::{Inserted, Seen};
use arrayvec::ArrayVec;
use core::ops::ControlFlow;
use glam::DVec2;

/// Pieces that a footprint may touch for each to be looked at by itself.
const MOST_CANDIDATES: usize = 2048;

/// Cells of the grid that a footprint may touch for its pieces to be looked for at all.
const MOST_CELLS: u32 = 256;

/// Pieces that are listed near a footprint for none to be asked for twice: so few are sorted sooner than remembered.
const FEW: usize = 32;

/// Places for pieces that are listed near a footprint, near it or not.
const MOST_LISTED: usize = 2 * MOST_CANDIDATES;

/// Pieces near a footprint, each once.
pub(crate) type Candidates = ArrayVec<u32, MOST_CANDIDATES>;

/// A footprint and how far around it scratches matter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach<'a> {
    pub metric: &'a Metric,
    pub footprint: &'a Region,
    /// The footprint's.
    pub area_mm2: f64,
    pub reach_mm: f64,
}

impl<'a> Reach<'a> {
    pub(crate) fn new(metric: &'a Metric, footprint: &'a Region, reach_mm: f64) -> Self {
        Self {
            metric,
            footprint,
            area_mm2: footprint.area_of_parallelogram(),
            reach_mm,
        }
    }

    /// The footprint's box in (u, v).
    pub(crate) fn footprint_uv(&self) -> [DVec2; 2] {
        let corners = self.footprint.corners().iter();
        hull(corners.map(|&corner| self.metric.place_uv(corner)))
    }

    /// The box in (u, v) of all within reach.
    pub(super) fn box_uv(&self) -> [DVec2; 2] {
        let reach = self.metric.reach_uv(self.reach_mm);
        let [low, high] = self.footprint_uv();
        [low - reach, high + reach]
    }

    /// From (u, v) to mm.
    pub(crate) fn place(&self, uv: DVec2) -> DVec2 {
        self.metric.to_mm * (uv - self.metric.uv)
    }
}

/// Whether a curve with these control points lies beside a box: for long oblique ones their own box says little.
#[inline(always)]
fn misses<const N: usize>(control: &[DVec2; N], low: DVec2, high: DVec2) -> bool {
    let (start, end) = (control[0], control[N - 1]);
    let [from, to] = hull(control.iter().copied());
    if !(from.cmple(high).all() && to.cmpge(low).all()) {
        return true;
    }
    let chord = end - start;
    let beside = |p: DVec2| chord.perp_dot(p - start);
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let reach = chord.perp().abs().dot(half);
    let bends = control[1..N - 1].iter().map(|p| beside(*p));
    let [left, right] = bends.fold([0.0_f64; 2], |[a, b], bend| [a.min(bend), b.max(bend)]);
    let at = beside(middle);
    at < left - reach || at > right + reach
}

pub(super) fn hull(points: impl Iterator<Item = DVec2>) -> [DVec2; 2] {
    let empty = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    points.fold(empty, |[low, high], p| [low.min(p), high.max(p)])
}

impl Curves<'_> {
    /// Whether a piece lies beside a box.
    #[inline(always)]
    fn misses(&self, number: u32, low: DVec2, high: DVec2) -> bool {
        let number = number as usize;
        match self.line(number) {
            Some(line) => misses(&line, low, high),
            None => misses(&self.control(number), low, high),
        }
    }
}

impl Pattern {
    /// The pieces near a footprint, in their order; false if they are too many to be looked at one by one.
    pub(crate) fn candidates(&self, reach: &Reach<'_>, found: &mut Candidates) -> bool {
        let [low, high] = reach.box_uv();
        self.pieces_near(low, high, found)
    }

    /// How many scratches these pieces, in their order, are of.
    pub(crate) fn scratches_of(&self, candidates: &Candidates) -> usize {
        let curves = self.curves();
        let is_one = |a: &u32, b: &u32| curves.scratch(*a) == curves.scratch(*b);
        candidates.chunk_by(is_one).count()
    }

    /// The pieces near a box in (u, v); false if they are too many.
    #[inline(always)]
    pub(crate) fn pieces_near(&self, low: DVec2, high: DVec2, found: &mut Candidates) -> bool {
        !self.touches(low, high) || self.pieces_listed(low, high, found)
    }

    /// Whether any piece may be near a box in (u, v).
    #[inline(always)]
    pub(crate) fn touches(&self, low: DVec2, high: DVec2) -> bool {
        self.grid.touches(low, high) && self.blank.may_cross(low, high)
    }

    /// Whether it holds any piece, of a box that touches the grid; or so much that it takes long to tell.
    #[inline(always)]
    pub(crate) fn holds_any(&self, low: DVec2, high: DVec2) -> bool {
        let cells = self.grid.touched(low, high);
        let look = |listed: &[u32]| match self.all_miss(listed, low, high) {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        };
        cells.count() > MOST_CELLS || self.grid.query(&cells, look).is_break()
    }

    #[inline(never)]
    fn all_miss(&self, pieces: &[u32], low: DVec2, high: DVec2) -> bool {
        let curves = self.curves();
        pieces
            .iter()
            .all(|&number| curves.misses(number, low, high))
    }

    /// The same as [`Self::pieces_near`], of a box that touches the grid.
    #[inline(never)]
    fn pieces_listed(&self, low: DVec2, high: DVec2, found: &mut Candidates) -> bool {
        let cells = self.grid.touched(low, high);
        if cells.count() > MOST_CELLS {
            return false;
        }
        let flow = self.grid.query(&cells, |listed| {
            let mut listed = listed.iter();
            let all = listed.all(|&number| {
                found.last() == Some(&number) || self.take_few(number, [low, high], found)
            });
            match all {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        });
        if flow.is_break() {
            found.clear();
            return self.many_near(&cells, [low, high], found);
        }
        if found.len() > 1 {
            found.sort_unstable();
            let mut last = None;
            found.retain(|number| last.replace(*number) != Some(*number));
        }
        true
    }

    /// Adds a piece if it is near a box; false if it is one more than a few.
    #[inline(never)]
    fn take_few(&self, number: u32, [low, high]: [DVec2; 2], found: &mut Candidates) -> bool {
        if self.curves().misses(number, low, high) {
            return true;
        }
        let has_room = found.len() < FEW;
        if has_room {
            found.push(number);
        }
        has_room
    }

    /// The same where pieces are listed again and again, as they are where many are near: known ones are known at once.
    #[inline(never)]
    fn many_near(&self, cells: &Touched, [low, high]: [DVec2; 2], found: &mut Candidates) -> bool {
        let curves = self.curves();
        let mut seen = Seen::<MOST_LISTED>::new();
        let flow = self.grid.query(cells, |listed| {
            curves.touch(listed);
            for &number in listed {
                match seen.insert(number) {
                    Inserted::Before => continue,
                    Inserted::Now => {}
                    Inserted::NoRoom => return ControlFlow::Break(()),
                }
                if curves.misses(number, low, high) {
                    continue;
                }
                if found.try_push(number).is_err() {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        flow.is_continue()
    }
}
