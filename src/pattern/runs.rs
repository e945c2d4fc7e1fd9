//! From pieces near a footprint to runs: stretches of scratch with one direction and one cross-section.

mod nearest;

use super::Pattern;
use super::caps::CapAt;
use super::closest::{length_share, tangent};
use super::course::Course;
use super::hit::Hit;
use super::pieces::{Curves, bounds, halves};
use super::query::{Candidates, Reach, hull};
use super::tracks::TrackRef;
use crate::formation::End;
use core::ops::ControlFlow;
use glam::DVec2;
use nearest::Near;

/// Within one run of a scratch, which has one cross-section in a footprint, its points move by no more than
/// this share of its half width or height.
const MOST_CHANGE: f64 = 0.14;

/// Parts that cover less than this share of the footprint may change more: as the root of how much less, up to so many
/// times as much.
const SMALL_PART: f64 = 0.02;
const MOST_SLACK: f64 = 4.0;

/// Where a scratch sets in, one end of a run is at least this share as wide as the other, as long as that one is wider
/// than this share of the widest.
const LEAST_WIDENING: f64 = 0.3;
const LEAST_WIDTH: f64 = 0.02;

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
        let mm = DVec2::splat(reach.reach_mm);
        let [low, high] = hull(reach.footprint.corners().iter().copied());
        let mut walk = Walk {
            pattern: self,
            curves: self.curves(),
            reach,
            near: [low - mm, high + mm],
            thin_mm,
            visit,
            thin_caps: false,
            is_over: false,
        };
        let mut pending: Option<Run<'p>> = None;
        for &number in candidates {
            if walk.is_over {
                break;
            }
            let Some(part) = walk.part(number as usize) else {
                continue;
            };
            match &mut pending {
                Some(run) if walk.joins(run, &part) => run.last = Last::of(&part),
                _ => {
                    pending.take().iter().for_each(|run| walk.emit(run));
                    // After what was scratched before this one.
                    walk.emit_cap(&part, End::Start);
                    if walk.is_one_run(&part) {
                        pending = Some(Run::of(&part));
                    } else {
                        walk.divide(&part, MOST_HALVINGS);
                    }
                }
            }
            walk.emit_cap(&part, End::Stop);
        }
        pending.iter().for_each(|run| walk.emit(run));
        walk.thin_caps
    }
}

/// A piece, or part of one, in mm.
#[derive(Clone, Copy)]
struct Part<'p> {
    number: usize,
    scratch: u32,
    track: TrackRef<'p>,
    course: Course<'p>,
    control: [DVec2; 4],
    /// Shares of the path's arc length at its ends.
    at: [f64; 2],
    /// Unit tangents across which it is parted from its neighbours: its own at a smooth joint, the mean
    /// of both at a corner.
    parting: [DVec2; 2],
    /// Whether the path begins or ends at its ends.
    is_end: [bool; 2],
}

/// Neighbouring parts that run nearly straight: one frame, one cross-section.
struct Run<'p> {
    first: Part<'p>,
    last: Last,
}

/// What matters of a run's last part.
struct Last {
    number: usize,
    /// Where it ends, and across what it is parted from the next.
    end: DVec2,
    parting: DVec2,
    /// Share of the path's arc length there.
    at: f64,
}

impl<'p> Run<'p> {
    fn of(part: &Part<'p>) -> Self {
        Self {
            first: *part,
            last: Last::of(part),
        }
    }

    /// Whether it is one straight line.
    fn is_straight(&self) -> bool {
        let [a, b, c, d] = self.first.control;
        let chord = d - a;
        let strays = |p: DVec2| (p - a).perp_dot(chord).abs() > 1e-9 * chord.length_squared();
        self.first.number == self.last.number && !strays(b) && !strays(c)
    }
}

impl Last {
    fn of(part: &Part<'_>) -> Self {
        Self {
            number: part.number,
            end: part.control[3],
            parting: part.parting[1],
            at: part.at[1],
        }
    }
}

impl Part<'_> {
    fn chord(&self) -> DVec2 {
        self.control[3] - self.control[0]
    }

    /// How far the cross-section at a share of arc length reaches, mm.
    fn half_width_mm(&self, at: f64) -> f64 {
        self.track.profile(self.course.value(at)).half_width_mm()
    }

    /// Whether the scratch becomes much wider from one end to the other, as it does where it sets in.
    fn sets_in(&self) -> bool {
        let [a, b] = self.at.map(|at| self.half_width_mm(at));
        let worth_it = a.max(b) > LEAST_WIDTH * self.track.half_width_mm;
        worth_it && a.min(b) < LEAST_WIDENING * a.max(b)
    }

    fn change(&self, from: f64) -> f64 {
        self.course.change(&self.track, from, self.at[1])
    }
}

/// Cuts pieces into runs, and gives each to `visit`.
struct Walk<'a, 'p, V> {
    pattern: &'p Pattern,
    curves: Curves<'p>,
    reach: &'a Reach<'a>,
    /// The footprint's box and what is within reach of it, mm.
    near: [DVec2; 2],
    thin_mm: f64,
    visit: &'a mut V,
    /// Whether it came by any that are not told, or in part.
    thin_caps: bool,
    /// Whether it broke.
    is_over: bool,
}

impl<'p, V: FnMut(&Hit<'p>) -> ControlFlow<()>> Walk<'_, 'p, V> {
    fn part(&self, number: usize) -> Option<Part<'p>> {
        let piece = self.curves.pieces.get(number)?;
        let (track, course) = self.pattern.strand(piece.scratch)?;
        let control = self.control(number);
        let [first, last] = self.pattern.pieces_of(piece.scratch);
        let before = if number == first {
            last
        } else {
            number.wrapping_sub(1)
        };
        let next = if number == last { first } else { number + 1 };
        let follows = |number: usize| {
            self.curves
                .pieces
                .get(number)
                .is_some_and(|p| p.is_joined())
        };
        let mut parting = [tangent(&control, 0.0), tangent(&control, 1.0)];
        if follows(number) {
            let onwards = tangent(&self.control(before), 1.0);
            parting[0] = halving(onwards, parting[0]).unwrap_or(parting[0]);
        }
        if follows(next) {
            let onwards = tangent(&self.control(next), 0.0);
            parting[1] = halving(parting[1], onwards).unwrap_or(parting[1]);
        }
        Some(Part {
            number,
            scratch: piece.scratch,
            track,
            course,
            control,
            at: self.curves.at(number),
            parting,
            is_end: [number == first, number == last].map(|outermost| outermost && !follows(first)),
        })
    }

    fn control(&self, number: usize) -> [DVec2; 4] {
        self.curves.control(number).map(|uv| self.reach.place(uv))
    }

    fn is_straight(&self, a: DVec2, b: DVec2) -> bool {
        a.dot(b) >= self.pattern.run_cos * (a.length_squared() * b.length_squared()).sqrt()
    }

    /// Whether a part turns and changes so little that it has one frame and one cross-section.
    fn is_one_run(&self, part: &Part<'p>) -> bool {
        let [a, b, c, d] = part.control;
        self.is_straight(b - a, d - a)
            && self.is_straight(d - a, d - c)
            && self.is_straight(b - a, d - c)
            && self.changes_little(part)
    }

    /// Whether one cross-section, the mean of all, will do.
    fn changes_little(&self, part: &Part<'p>) -> bool {
        if part.course.is_even(part.at) {
            return true;
        }
        let slack = self.slack(part);
        part.change(part.at[0]) <= MOST_CHANGE * slack && (slack == MOST_SLACK || !part.sets_in())
    }

    /// How much more a part may change than one that covers much of the footprint.
    fn slack(&self, part: &Part<'p>) -> f64 {
        let area = 2.0 * part.track.half_width_mm * part.chord().length();
        let small = SMALL_PART * self.reach.area_mm2 / area;
        small.sqrt().clamp(1.0, MOST_SLACK)
    }

    /// Whether a piece more goes on nearly straight where a run ends.
    fn joins(&self, run: &Run<'p>, part: &Part<'p>) -> bool {
        let (first, last) = (&run.first, &run.last);
        part.number == last.number + 1
            && part.scratch == first.scratch
            && self.curves.pieces[part.number].is_joined()
            && self.is_one_run(part)
            && self.is_straight(first.chord(), part.chord())
            && self.is_straight(first.parting[0], part.parting[1])
            && (part.course.is_even([first.at[0], part.at[1]])
                || part.change(first.at[0]) <= MOST_CHANGE)
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
        if halvings == 0 || self.is_one_run(part) {
            return self.emit(&Run::of(part));
        }
        let [first, second] = halves(part.control);
        let [from, to] = part.at;
        let middle = from + (to - from) * length_share(&part.control, 0.5);
        let parting = tangent(&first, 1.0);
        let part_of = |control, at, parting| Part {
            control,
            at,
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

    fn tell(&mut self, hit: &Hit<'p>) {
        self.is_over = self.is_over || (self.visit)(hit).is_break();
    }

    fn emit(&mut self, run: &Run<'p>) {
        let Run { first, last } = run;
        let parting = [
            [first.control[0], first.parting[0]],
            [last.end, last.parting],
        ];
        let [[start, forwards], [end, onwards]] = parting;
        let mut region = *self.reach.footprint;
        if !region.keep(&[[start, forwards], [end, -onwards]]) {
            return;
        }
        let near = self.nearest_on(run, region.centroid());
        let course = &first.course;
        let profile = first.track.profile(course.value(near.at));
        let is_even = course.is_even([first.at[0], last.at]);
        let (near, profile) = if is_even && run.is_straight() {
            (near, profile)
        } else {
            self.look(run, &region, near, profile, is_even)
        };
        let Near {
            at, origin, travel, ..
        } = near;
        self.tell(&Hit {
            track: first.track,
            place: course.value(at),
            profile,
            ends_mm: profile.ends().map(f64::from),
            scratch: first.scratch,
            at,
            origin,
            travel,
            parting,
            region,
            visible: self.pattern.visible_share(first.number),
            alone: 1.0,
        });
    }

    /// The sectors of the cap at an end of a part, if that is a hard end of its scratch within reach.
    fn emit_cap(&mut self, part: &Part<'p>, end: End) {
        if !part.is_end[usize::from(end == End::Stop)] {
            return;
        }
        let (point, travel, outward) = match end {
            End::Start => (part.control[0], part.parting[0], -part.parting[0]),
            End::Stop => (part.control[3], part.parting[1], part.parting[1]),
        };
        let [low, high] = self.near;
        if !(point.cmpge(low).all() && point.cmple(high).all()) {
            return;
        }
        let Some(cap) = self.pattern.cap_at(part.number, end) else {
            return;
        };
        let alone = cap.alone(&part.track, self.thin_mm);
        self.thin_caps |= alone < 1.0;
        if alone == 0.0 {
            return;
        }
        let Some(beyond) = self.reach.footprint.clipped(point, outward) else {
            return;
        };
        let visible = self.pattern.visible_share(part.number);
        for sector in cap.sectors() {
            let [from, to] = sector.wedge.borders(travel);
            let origin = point + sector.offset_mm * DVec2::new(travel.y, -travel.x);
            let parting = [[origin, from.perp()], [origin, to.perp()]];
            let region = beyond.within(&[[origin, from.perp()], [origin, -to.perp()]]);
            let Some(region) = region else { continue };
            self.tell(&Hit {
                track: part.track,
                place: cap.place,
                profile: sector.profile,
                ends_mm: [0.0, sector.outer_mm()],
                scratch: part.scratch,
                at: cap.at,
                origin,
                travel: sector.wedge.axis(travel).perp(),
                parting,
                region,
                visible,
                alone,
            });
        }
    }
}

/// Where two pieces meet at an angle, both end at the line that halves it. A path that turns back on itself has
/// no such line: its pieces end square.
pub(super) fn halving(a: DVec2, b: DVec2) -> Option<DVec2> {
    (a.dot(b) > -0.99).then(|| (a + b).normalize_or(a))
}
