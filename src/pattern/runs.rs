//! From pieces near a footprint to runs: stretches of scratch with one direction and one cross-section.

mod nearest;
mod only;
mod part;
mod sectors;

use super::Pattern;
use super::caps::CapAt;
use super::closest::{
    end_tangent, end_tangents, is_even_line, length_share, start_tangent, unit_or_x,
};
use super::hit::Hit;
use super::pieces::{Curves, bounds, halves, line_control};
use super::query::{Candidates, Reach};
use crate::formation::End;
use core::ops::ControlFlow;
use glam::DVec2;
use nearest::Near;
use part::{Last, Mark, Part, Run};

/// Within one run of a scratch, which has one cross-section in a footprint, its points move by no more than
/// this share of its half width or height.
const MOST_CHANGE: f64 = 0.14;

/// Where a scratch sets in, one end of a run is at least this share as wide as the other.
const LEAST_WIDENING: f64 = 0.5;

/// Parts that cover less than this share of the footprint may change more: as the root of how much less, up to so many
/// times as much.
const SMALL_PART: f64 = 0.02;
const MOST_SLACK: f64 = 4.0;

/// Beside more pieces than so many each counts for less, and a larger share of the footprint is small: up to so many times
/// as large.
const UNCROWDED: f64 = 6.0;
const MOST_CROWDED: f64 = 8.0;

/// A piece is cut into at most 2 to the power of this many runs.
const MOST_HALVINGS: u32 = 16;

impl Pattern {
    /// The cap at one end of a piece, if the path begins or ends there, and hard.
    pub(super) fn cap_at(&self, number: usize, end: End) -> Option<CapAt<'_>> {
        let pieces = self.curves().pieces;
        let scratch = pieces.get(number)?.scratch;
        let (neighbour, share) = match end {
            End::Start => (number.checked_sub(1), 0.0),
            End::Stop => (number.checked_add(1), 1.0),
        };
        let is_own = |i: usize| pieces.get(i).is_some_and(|piece| piece.scratch == scratch);
        if neighbour.is_some_and(is_own) {
            return None;
        }
        let [first, _] = self.pieces_of(scratch);
        if pieces.get(first)?.is_joined() {
            return None;
        }
        let track = self.strands.get(scratch as usize)?.track;
        let caps = self.tracks.caps(track, usize::from(end == End::Stop))?;
        let (_, course) = self.strand(scratch)?;
        Some(CapAt {
            caps,
            at: share,
            place: course.value(share),
        })
    }

    /// Calls `visit` with each run of scratch, and each sector of its caps, that comes within reach of the footprint, until
    /// it breaks. Of caps on scratches thinner than `thin_mm`, no sectors; tells whether it came by any that is not wholly
    /// told.
    pub(crate) fn for_each_run<'p>(
        &'p self,
        candidates: &Candidates,
        reach: &Reach<'_>,
        thin_mm: f64,
        visit: &mut impl FnMut(&Hit<'p>) -> ControlFlow<()>,
    ) -> bool {
        let near = reach.footprint.half_size() + reach.reach_mm;
        let crowded = (candidates.len() as f64 / UNCROWDED).clamp(1.0, MOST_CROWDED);
        let mut walk = Walk {
            pattern: self,
            curves: self.curves(),
            reach,
            near: [-near, near],
            small_mm2: SMALL_PART * crowded * reach.area_mm2,
            thin_mm,
            visit,
            thin_caps: false,
            is_over: false,
        };
        let mut numbers = candidates.iter().map(|&number| number as usize).peekable();
        while let Some(number) = numbers.next() {
            if walk.is_over {
                break;
            }
            // By its address: it is large.
            let part = walk.part(number);
            let Some(part) = &part else {
                continue;
            };
            walk.emit_cap(part, End::Start);
            if !walk.is_one_run(part) {
                walk.divide(part, MOST_HALVINGS);
                walk.emit_cap(part, End::Stop);
                continue;
            }
            let mut run = Run::of(part);
            walk.emit_cap(part, End::Stop);
            while let Some(next) = walk.joined(&run, numbers.peek()) {
                run.last = Last::of(&next);
                walk.emit_cap(&next, End::Stop);
                numbers.next();
            }
            walk.emit(&run);
        }
        walk.thin_caps
    }
}

/// Cuts pieces into runs, and gives each to `visit`.
struct Walk<'a, 'p, V> {
    pattern: &'p Pattern,
    curves: Curves<'p>,
    reach: &'a Reach<'a>,
    /// The footprint's box and what is within reach of it, mm.
    near: [DVec2; 2],
    /// Parts of less area may change more.
    small_mm2: f64,
    thin_mm: f64,
    visit: &'a mut V,
    /// Whether it came by any that are not told, or in part.
    thin_caps: bool,
    /// Whether it broke.
    is_over: bool,
}

impl<'p, V: FnMut(&Hit<'p>) -> ControlFlow<()>> Walk<'_, 'p, V> {
    #[inline(always)]
    fn part(&self, number: usize) -> Option<Part<'p>> {
        let pieces = self.curves.pieces;
        let piece = pieces.get(number)?;
        let (track, course) = self.pattern.strand(piece.scratch)?;
        let line = self.curves.line(number);
        let control = self.placed(number, line);
        let is_line = line.is_some() || is_even_line(&control);
        let travel = unit_or_x(control[3] - control[0]);
        let parting = match is_line {
            true => [travel; 2],
            false => end_tangents(&control),
        };
        let own = |number: usize| pieces.get(number).filter(|p| p.scratch == piece.scratch);
        let (before, after) = (own(number.wrapping_sub(1)), own(number + 1));
        // A closed path's last piece is followed by its first.
        let goes_on = match (before, after) {
            (_, Some(next)) => next.is_joined(),
            (None, None) => piece.is_joined(),
            (Some(_), None) => self.is_closed(piece.scratch),
        };
        let joins = [piece.is_joined(), goes_on];
        let ends = [before.map_or(0.0, |before| before.end_at), piece.end_at];
        let mut part = Part {
            number,
            scratch: piece.scratch,
            track,
            course,
            control,
            is_line,
            travel,
            ends: [
                Mark::new(&course, ends[0].into()),
                Mark::new(&course, ends[1].into()),
            ],
            parting,
            is_end: [before.is_none() && !joins[0], after.is_none() && !joins[1]],
        };
        if joins[0] || joins[1] {
            part.parting = self.halved(&part, joins);
        }
        Some(part)
    }

    fn is_closed(&self, scratch: u32) -> bool {
        let [first, _] = self.pattern.pieces_of(scratch);
        self.curves.pieces.get(first).is_some_and(|p| p.is_joined())
    }

    /// Across what a part is parted from its neighbours where it joins them.
    #[inline(never)]
    fn halved(&self, part: &Part<'p>, joins: [bool; 2]) -> [DVec2; 2] {
        let (number, [first, last]) = (part.number, self.pattern.pieces_of(part.scratch));
        let [mut start, mut end] = part.parting;
        if joins[0] {
            let before = if number == first {
                last
            } else {
                number.wrapping_sub(1)
            };
            start = halving(end_tangent(&self.control(before)), start).unwrap_or(start);
        }
        if joins[1] {
            let next = if number == last { first } else { number + 1 };
            end = halving(end, start_tangent(&self.control(next))).unwrap_or(end);
        }
        [start, end]
    }

    fn control(&self, number: usize) -> [DVec2; 4] {
        self.placed(number, self.curves.line(number))
    }

    /// A piece's control points in mm; a straight line's by its ends.
    #[inline(always)]
    fn placed(&self, number: usize, line: Option<[DVec2; 2]>) -> [DVec2; 4] {
        match line {
            Some(ends) => line_control(ends.map(|uv| self.reach.place(uv))),
            None => self.curves.control(number).map(|uv| self.reach.place(uv)),
        }
    }

    #[inline(always)]
    fn is_straight(&self, a: DVec2, b: DVec2) -> bool {
        a.dot(b) >= self.pattern.run_cos * (a.length_squared() * b.length_squared()).sqrt()
    }

    /// Whether a part turns and changes so little that it has one frame and one cross-section.
    #[inline(always)]
    fn is_one_run(&self, part: &Part<'p>) -> bool {
        let [a, b, c, d] = part.control;
        let is_straight = part.is_line
            || self.is_straight(b - a, d - a)
                && self.is_straight(d - a, d - c)
                && self.is_straight(b - a, d - c);
        is_straight && self.changes_little(part)
    }

    /// Whether one cross-section, the mean of all, will do.
    fn changes_little(&self, part: &Part<'p>) -> bool {
        let [from, to] = &part.ends;
        if part.is_even(from, to) {
            return true;
        }
        let change = part.change(from, to);
        let slack = self.slack(2.0 * change.wide_mm * part.chord().length());
        change.amount <= MOST_CHANGE * slack
            && (slack == MOST_SLACK || change.narrow_mm >= LEAST_WIDENING * change.wide_mm)
    }

    /// How much more a part of this area may change than one that covers much of the footprint.
    fn slack(&self, area_mm2: f64) -> f64 {
        let small = self.small_mm2 / area_mm2;
        small.sqrt().clamp(1.0, MOST_SLACK)
    }

    /// A piece more, if it goes on nearly straight where a run ends.
    fn joined(&self, run: &Run<'_, 'p>, number: Option<&usize>) -> Option<Part<'p>> {
        let next = number.filter(|number| **number == run.last.number + 1)?;
        let piece = self.curves.pieces.get(*next)?;
        let goes_on = piece.is_joined() && piece.scratch == run.first.scratch;
        let part = goes_on.then(|| self.part(*next))??;
        self.joins(run, &part).then_some(part)
    }

    fn joins(&self, run: &Run<'_, 'p>, part: &Part<'p>) -> bool {
        let first = run.first;
        self.is_one_run(part)
            && self.is_straight(first.chord(), part.chord())
            && self.is_straight(first.parting[0], part.parting[1])
            && (part.is_even(&first.ends[0], &part.ends[1])
                || part.change(&first.ends[0], &part.ends[1]).amount <= MOST_CHANGE)
    }

    /// Halves a part until its parts are runs; those out of reach are left out.
    fn divide(&mut self, part: &Part<'p>, halvings: u32) {
        if self.is_over {
            return;
        }
        let [from, to] = bounds(&part.control);
        if !(from.cmple(self.near[1]).all() && to.cmpge(self.near[0]).all()) {
            return;
        }
        if self.is_beyond(part) {
            return;
        }
        if halvings == 0 || self.is_one_run(part) {
            return self.emit(&Run::of(part));
        }
        let [first, second] = halves(part.control);
        let [from, to] = part.ends;
        let middle = from.at + (to.at - from.at) * length_share(&part.control, 0.5);
        let middle = Mark::new(&part.course, middle);
        let parting = end_tangent(&first);
        let part_of = |control, ends, parting| Part {
            control,
            // Half a line is one too.
            is_line: part.is_line,
            ends,
            parting,
            ..*part
        };
        self.divide(
            &part_of(first, [from, middle], [part.parting[0], parting]),
            halvings - 1,
        );
        self.divide(
            &part_of(second, [middle, to], [parting, part.parting[1]]),
            halvings - 1,
        );
    }

    /// Whether nothing of the footprint lies between the lines across which a part begins and ends.
    fn is_beyond(&self, part: &Part<'p>) -> bool {
        let [start, end] = [part.control[0], part.control[3]];
        let [forwards, onwards] = part.parting;
        let [_, most] = self.reach.footprint.extent(start, forwards);
        let [least, _] = self.reach.footprint.extent(end, onwards);
        most <= 0.0 || least >= 0.0
    }

    fn tell(&mut self, hit: &Hit<'p>) {
        self.is_over = self.is_over || (self.visit)(hit).is_break();
    }

    fn emit(&mut self, run: &Run<'_, 'p>) {
        let Run { first, last } = run;
        let parting = [
            [first.control[0], first.parting[0]],
            [last.end, last.parting],
        ];
        let [[start, forwards], [end, onwards]] = parting;
        let lines = [[start, forwards], [end, -onwards]];
        let (footprint, mut part, mut middle) = (self.reach.footprint, None, DVec2::ZERO);
        // Most runs go on beyond the footprint, whose middle is the origin.
        if !footprint.is_parallelogram_within(&lines) {
            part = footprint.within(&lines);
            let Some(cut) = &part else {
                return;
            };
            middle = cut.centroid();
        }
        let near = self.nearest_on(run, middle);
        let place = first.course.value(near.at);
        let mut hit = Hit {
            track: first.track,
            place,
            profile: first.track.profile(place),
            ends_mm: [0.0; 2],
            scratch: first.scratch,
            at: near.at,
            line: near.line(),
            parting,
            part,
            piece: first.number,
            alone: 1.0,
        };
        let is_even = run.is_even();
        if !(is_even && run.is_straight()) {
            self.look_at(run, near, is_even, &mut hit);
        }
        hit.ends_mm = hit.profile.ends().map(f64::from);
        self.tell(&hit);
    }

    /// The same of a run that bends or changes, in the middle of what the footprint holds of it.
    #[inline(never)]
    fn look_at(&self, run: &Run<'_, 'p>, near: Near, is_even: bool, hit: &mut Hit<'p>) {
        let region = *hit.region(self.reach.footprint);
        (hit.at, hit.line, hit.profile) = self.look(run, &region, near, hit.profile, is_even);
        hit.place = run.first.course.value(hit.at);
    }
}

/// Where two pieces meet at an angle, both end at the line that halves it. A path that turns back on itself has
/// no such line: its pieces end square.
pub(super) fn halving(a: DVec2, b: DVec2) -> Option<DVec2> {
    (a.dot(b) > -0.99).then(|| (a + b).normalize_or(a))
}
