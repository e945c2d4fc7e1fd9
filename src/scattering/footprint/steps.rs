//! A run's density in steps that lie side by side, and what it is to make one of neighbours.

use super::{Densities, MOST_PARTS, Piece, Weight};
use crate::pattern::{CenterLine, Left, MOST_CORNERS, Region};
use crate::single;
use arrayvec::ArrayVec;

/// Pieces that a run's density may have before it is merged: between neighbouring corners of each part and beside the run's
/// edges, each in two where it bends.
pub(super) const MOST_OF_RUN: usize = MOST_PARTS * 2 * (MOST_CORNERS + 1);

/// Steps that a run's density has at most beside those of others: so many leave it as it is, but for what nobody sees.
pub(super) const MOST_STEPS: usize = 20;

/// What lies beside that part of a run which is seen counts for half at this share of the part's width, and for less farther
/// off: only shadows reach there. Larger and smaller ones let bright sheets and dark ones change more.
const BESIDE: f64 = 1.0 / 16.0;

/// A run's density in steps side by side.
#[derive(Clone, Debug)]
pub(crate) struct Steps {
    all: ArrayVec<Step, MOST_STEPS>,
    seen: Seen,
}

/// Like a piece, but that no other lies over it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub from: f32,
    pub to: f32,
    pub weight: f64,
    /// Its skew times its weight.
    pub lean: f64,
    /// What changes if it becomes one with the next; NaN before it is looked at.
    change: f32,
}

impl Steps {
    /// Of these regions together, less what is not left of them, across a run that is seen between two places.
    #[inline(never)]
    pub(crate) fn of(
        regions: &[Region],
        left: Option<&Left>,
        line: &CenterLine,
        pixel_area: f64,
        seen_mm: [f32; 2],
    ) -> Self {
        let mut densities = Densities::<MOST_OF_RUN>::EMPTY;
        let weight = densities.add_left(regions, left, line, pixel_area);
        debug_assert!(weight.is_some(), "{} regions are too many", regions.len());
        densities.steps(&weight.unwrap_or(Weight::NONE), seen_mm)
    }

    /// Of pieces that may lie over one another.
    pub(super) fn of_pieces(pieces: &[Piece], seen_mm: [f32; 2]) -> Self {
        let mut ends: ArrayVec<f32, { 2 * MOST_OF_RUN }> = ArrayVec::new();
        ends.extend(pieces.iter().flat_map(|piece| [piece.from, piece.to]));
        ends.sort_unstable_by(f32::total_cmp);
        let mut steps = Self {
            all: ArrayVec::new(),
            seen: Seen::between(seen_mm),
        };
        let any_thin = pieces.iter().any(|piece| piece.from == piece.to);
        let mut last = f32::NAN;
        for end in ends {
            if end != last {
                steps.push(Step::between(pieces, [last, end]));
                if any_thin {
                    steps.push(Step::at(pieces, end));
                }
            }
            last = end;
        }
        steps
    }

    /// The run is seen between these places.
    pub(super) fn look_through(&mut self, seen_mm: [f32; 2]) {
        self.seen = Seen::between(seen_mm);
        self.look_at_all();
    }

    fn look_at_all(&mut self) {
        for place in 0..self.count() {
            self.look_at(place);
        }
    }

    pub(super) fn all(&self) -> &[Step] {
        &self.all
    }

    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    /// Which step becomes one with the next at the least change, and how large that is; nothing if there is but one.
    pub(super) fn cheapest(&self) -> Option<(usize, f32)> {
        let (_, all) = self.all.split_last()?;
        let changes = all.iter().map(|step| step.change).enumerate();
        changes.min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Makes one of a step and the next.
    pub(super) fn merge_at(&mut self, place: usize) {
        let Some(next) = self.all.pop_at(place + 1) else {
            return;
        };
        if let Some(step) = self.all.get_mut(place) {
            *step = step.with(&next);
        }
        self.look_at(place);
        self.look_at(place.wrapping_sub(1));
    }

    /// Adds a step behind all others, if it weighs anything; if there is no room, others become one.
    fn push(&mut self, step: Step) {
        if step.weight > 0.0 {
            if self.all.is_full() {
                self.make_room();
            }
            // There is room now.
            let _ = self.all.try_push(step);
        }
    }

    /// Makes one of those two that it changes least.
    #[inline(never)]
    fn make_room(&mut self) {
        self.look_at_all();
        if let Some((place, _)) = self.cheapest() {
            self.merge_at(place);
        }
    }

    /// Finds out what changes if a step becomes one with the next.
    fn look_at(&mut self, place: usize) {
        let pair = self.all.get_mut(place..);
        if let Some([step, next]) = pair.and_then(<[Step]>::first_chunk_mut) {
            step.change = step.change_with(next, &self.seen);
        }
    }
}

impl Step {
    /// What pieces weigh from one of their ends to the next one.
    fn between(pieces: &[Piece], [from, to]: [f32; 2]) -> Self {
        let (mut weight, mut lean) = (0.0, 0.0);
        let over = |piece: &&Piece| piece.from <= from && piece.to >= to;
        for piece in pieces.iter().filter(over) {
            let start = f64::from(piece.from);
            let [a, b] = [from, to].map(|at| (f64::from(at) - start) / piece.width());
            let (whole, skew) = (f64::from(piece.weight), f64::from(piece.skew));
            weight += whole * (b - a) * (1.0 + skew * (a + b - 1.0));
            lean += whole * skew * (b - a) * (b - a);
        }
        Self {
            from,
            to,
            weight,
            lean,
            change: f32::NAN,
        }
    }

    /// What pieces thinner than single precision can tell weigh at one place.
    fn at(pieces: &[Piece], place: f32) -> Self {
        let there = pieces
            .iter()
            .filter(|piece| [piece.from, piece.to] == [place; 2]);
        Self {
            from: place,
            to: place,
            weight: there.map(|piece| f64::from(piece.weight)).sum(),
            lean: 0.0,
            change: f32::NAN,
        }
    }

    /// This and the next as one, of the same weight and centre of mass.
    fn with(&self, next: &Self) -> Self {
        let weight = self.weight + next.weight;
        let half = 0.5 * self.distance_to(next.to);
        let moment = self.moment(0.0) + next.moment(self.distance_to(next.from));
        let lean = (3.0 * (moment / half - weight)).clamp(-weight, weight);
        Self {
            to: next.to,
            weight,
            lean: if half > 0.0 { lean } else { 0.0 },
            ..*self
        }
    }

    /// By how much what lies left of any place changes, in the mean over the places between which the run is seen, if this and
    /// the next become one. There facets begin and end; up to the other steps as much lies as before.
    fn change_with(&self, next: &Self, seen: &Seen) -> f32 {
        let merged = self.with(next);
        let far = self.distance_to(next.to);
        let per_half = 2.0 / far;
        let square = |off: f64, wanted: f64| {
            let now = merged.weight_up_to(off * per_half - 1.0);
            let change = (now - wanted) * seen.relevance(f64::from(self.from) + off);
            change * change
        };
        let (to, from) = (self.distance_to(self.to), self.distance_to(next.from));
        let within = square(0.5 * to, self.weight_up_to(0.0));
        let ends = [to, from].map(|off| square(off, self.weight));
        let within_next = square(0.5 * (from + far), self.weight + next.weight_up_to(0.0));
        // By Simpson's rule: it is nothing at the outer ends.
        let sum = to * (4.0 * within + ends[0]) / 6.0
            + (from - to) * (ends[0] + ends[1]) / 2.0
            + (far - from) * (ends[1] + 4.0 * within_next) / 6.0;
        if far > 0.0 {
            single((sum * seen.per_mm).sqrt())
        } else {
            0.0
        }
    }

    /// How far a place is from its left end.
    fn distance_to(&self, place: f32) -> f64 {
        f64::from(place) - f64::from(self.from)
    }

    /// Its moment about a place that lies so far left of it.
    fn moment(&self, off: f64) -> f64 {
        let half = 0.5 * self.distance_to(self.to);
        (off + half) * self.weight + half * self.lean / 3.0
    }

    /// What lies left of a place, which counts from -1 at its left end to 1 at its right one.
    fn weight_up_to(&self, off_middle: f64) -> f64 {
        0.5 * (off_middle + 1.0) * (self.weight + 0.5 * (off_middle - 1.0) * self.lean)
    }
}

impl Piece {
    fn width(&self) -> f64 {
        f64::from(self.to) - f64::from(self.from)
    }
}

/// That part of a run which is seen, mm across.
#[derive(Clone, Copy, Debug)]
struct Seen {
    from: f64,
    to: f64,
    /// 1 over its width.
    per_mm: f64,
}

impl Seen {
    fn between([from, to]: [f32; 2]) -> Self {
        let [from, to] = [from, to].map(f64::from);
        let per_mm = 1.0 / (to - from).max(f64::MIN_POSITIVE);
        Self { from, to, per_mm }
    }

    /// How much a place counts.
    fn relevance(&self, place: f64) -> f64 {
        let beside = (self.from - place).max(place - self.to).max(0.0);
        1.0 / (1.0 + beside * self.per_mm / BESIDE)
    }
}
