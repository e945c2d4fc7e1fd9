//! A piece of scratch near a footprint or part of one, and what of them is one run.

use crate::pattern::course::Course;
use crate::pattern::tracks::TrackRef;
use glam::DVec2;

/// A place along a scratch, and what its course says there.
#[derive(Clone, Copy)]
pub(super) struct Mark {
    /// Share of the path's arc length.
    pub at: f64,
    value: f64,
    /// The number of the course's knot that comes next.
    next_knot: usize,
}

impl Mark {
    #[inline(always)]
    pub(super) fn new(course: &Course<'_>, at: f64) -> Self {
        let (value, next_knot) = course.value_and_next(at);
        Self {
            at,
            value,
            next_knot,
        }
    }
}

/// A piece, or part of one, in mm.
#[derive(Clone, Copy)]
pub(super) struct Part<'p> {
    pub number: usize,
    pub scratch: u32,
    pub track: TrackRef<'p>,
    pub course: Course<'p>,
    pub control: [DVec2; 4],
    /// Whether that is a straight line, run through evenly.
    pub is_line: bool,
    /// Of such a line, the unit tangent.
    pub travel: DVec2,
    pub ends: [Mark; 2],
    /// Unit tangents across which it is parted from its neighbours: its own at a smooth joint, the mean
    /// of both at a corner.
    pub parting: [DVec2; 2],
    /// Whether the path begins or ends at its ends.
    pub is_end: [bool; 2],
}

impl Part<'_> {
    pub(super) fn chord(&self) -> DVec2 {
        self.control[3] - self.control[0]
    }

    /// How far its cross-section reaches at a place, mm.
    pub(super) fn half_width_mm(&self, mark: &Mark) -> f64 {
        self.track.half_width_of(self.track.locate(mark.value))
    }

    /// Whether its scratch has one cross-section from one place to another.
    pub(super) fn is_even(&self, from: &Mark, to: &Mark) -> bool {
        let is_between_knots = from.next_knot == to.next_knot;
        self.course.is_constant()
            || from.value == to.value && (is_between_knots || self.course.is_even([from.at, to.at]))
    }

    /// How the cross-section changes from one place to another.
    pub(super) fn change(&self, from: &Mark, to: &Mark) -> Change {
        let places = [from, to].map(|mark| self.track.locate(mark.value));
        let [a, b] = places.map(|place| self.track.half_width_of(place));
        let [upto_a, upto_b] = places.map(|place| self.track.change_to(place));
        let amount = match from.next_knot == to.next_knot {
            true => (upto_b - upto_a).abs(),
            false => self.course.change(&self.track, from.at, to.at),
        };
        let way_mm = amount * self.track.half_width_mm();
        Change {
            amount,
            narrow_mm: a.min(b),
            wide_mm: 0.5 * (a + b + way_mm),
        }
    }
}

/// What happens to a cross-section on the way from one place to another.
pub(super) struct Change {
    /// All to and fro counted.
    pub amount: f64,
    /// How far it reaches at the narrower end, and at most on the way.
    pub narrow_mm: f64,
    pub wide_mm: f64,
}

/// Neighbouring parts that run nearly straight: one frame, one cross-section.
pub(super) struct Run<'a, 'p> {
    pub first: &'a Part<'p>,
    pub last: Last,
}

/// What matters of a run's last part.
pub(super) struct Last {
    pub number: usize,
    /// Where it ends, and across what it is parted from the next.
    pub end: DVec2,
    pub parting: DVec2,
    pub mark: Mark,
}

impl<'a, 'p> Run<'a, 'p> {
    pub(super) fn of(part: &'a Part<'p>) -> Self {
        Self {
            first: part,
            last: Last::of(part),
        }
    }

    /// Whether it is one straight line.
    pub(super) fn is_straight(&self) -> bool {
        let [a, b, c, d] = self.first.control;
        let chord = d - a;
        let strays = |p: DVec2| (p - a).perp_dot(chord).abs() > 1e-9 * chord.length_squared();
        self.first.number == self.last.number && (self.first.is_line || !strays(b) && !strays(c))
    }

    /// Whether it has one cross-section.
    pub(super) fn is_even(&self) -> bool {
        self.first.is_even(&self.first.ends[0], &self.last.mark)
    }

    /// From its first point to its last, mm.
    pub(super) fn length(&self) -> f64 {
        (self.last.end - self.first.control[0]).length()
    }

    /// Shares of the path's arc length at its ends.
    pub(super) fn at(&self) -> [f64; 2] {
        [self.first.ends[0].at, self.last.mark.at]
    }
}

impl Last {
    pub(super) fn of(part: &Part<'_>) -> Self {
        Self {
            number: part.number,
            end: part.control[3],
            parting: part.parting[1],
            mark: part.ends[1],
        }
    }
}
