//! A piece of scratch as straight chords, and how much of each class any stretch of them holds.

use super::Pattern;
use super::caps::ENDS;
use super::closest::{LengthShares, bezier, tangent};
use super::crowd::{Heading, angle};
use super::palette::MOST_CLASSES;
use super::query::Reach;
use super::raster::cell_number;
use super::reader::{Reader, Recent};
use super::strips::{EVEN, STRIPS, Strips, shares};
use super::tracks::TrackRef;
use crate::single;
use core::f32::consts::{FRAC_PI_2, TAU};
use glam::DVec2;

/// A chord turns no more than this: about what two directions of a crowd lie apart.
const CHORD_RAD: f64 = 0.1;

/// A piece counts as a chain of at most this many chords.
const MOST_CHORDS: f64 = 512.0;

/// Corners turn by less than three times this if their legs' cross product is this share of the dot product: the angle
/// is about that share.
const NEARLY_STRAIGHT: f64 = 0.3;

/// Scratched area of each class, mm² in the pattern's own scale.
pub(super) type ClassAreas = [f32; MOST_CLASSES];

/// A straight way of scratch.
pub(super) struct Chord<'s> {
    /// In texture space.
    pub ends: [DVec2; 2],
    /// Along the scratch, in texture space times units per (u, v).
    pub heading: Heading,
    held: Held<'s>,
}

/// What a chord holds.
enum Held<'s> {
    /// A way of so many mm from one parameter of the piece to another, which later scratches leave so much of.
    Way(f64, [f64; 2], &'s Span<'s>, Visible),
    /// A cap's sector, all at one place.
    Sector(ClassAreas),
}

/// A piece from one turn of its scratch's course to the next: areas by class of a mm of scratch.
enum Span<'s> {
    /// One cross-section all along.
    Even(ClassAreas),
    Changing {
        track: &'s TrackRef<'s>,
        /// How arc length runs along the piece.
        lengths: LengthShares,
        /// Shares of the piece's arc length at the turns.
        at: [f64; 2],
        /// Places on the track at the turns.
        places: [f64; 2],
    },
}

/// What later scratches leave of a piece, along its parameter.
#[derive(Clone, Copy)]
struct Visible {
    quarters: [f64; 4],
    is_even: bool,
}

impl Reader<'_> {
    /// Calls `visit` with the chords of a piece and of its caps; with none, or few, of those that are not `within`.
    pub(super) fn for_each_chord(
        &mut self,
        number: usize,
        within: Option<&Reach<'_>>,
        mut visit: impl FnMut(&Chord<'_>),
    ) {
        let pattern = self.pattern;
        let curves = pattern.curves();
        let widest_mm = f64::from(pattern.extent.half_width_mm);
        let control = curves.control(number);
        let is_beside = |reach: &Reach<'_>| {
            let control = control.map(|uv| reach.place(uv));
            reach.footprint.is_beside(&control, widest_mm)
        };
        if within.is_some_and(is_beside) {
            return;
        }
        self.turn_to(number);
        let Self {
            strand,
            per_mm: known,
            ..
        } = self;
        let Some((track, course)) = strand else {
            return;
        };
        let [from, to] = curves.at(number);
        let scaled = control.map(|p| p * pattern.units_per_uv);
        let visible = Visible::of(pattern.visible(number));
        let turn_rad = turn_rad(&scaled);
        let (mut start, mut first_t) = (control[0], 0.0);
        // Between two turns of its course the cross-section changes one way.
        for [[before, first], [after, last]] in course.turns(from, to) {
            let at = [before, after].map(|at| (at - from) / (to - from));
            let lengths = LengthShares::of(&scaled);
            let last_t = if after < to {
                lengths.parameter(at[1])
            } else {
                1.0
            };
            let span = if first == last {
                Span::even(track, first, known)
            } else {
                Span::Changing {
                    track,
                    lengths,
                    at,
                    places: [first, last],
                }
            };
            let part = last_t - first_t;
            let count = number_of(part * turn_rad / CHORD_RAD, MOST_CHORDS);
            for i in 0..count {
                let t = [i, i + 1].map(|i| first_t + part * f64::from(i) / f64::from(count));
                let end = if t[1] < 1.0 {
                    bezier(&control, t[1])
                } else {
                    control[3]
                };
                let ends = [start, end];
                start = end;
                let travel = (ends[1] - ends[0]) * pattern.units_per_uv;
                let length_mm = travel.length() * pattern.mm_per_scene_unit;
                visit(&Chord {
                    ends,
                    heading: Heading::of(travel),
                    held: Held::Way(length_mm, t, &span, visible),
                });
            }
            first_t = last_t;
        }
        pattern.for_each_cap_chord(number, within, f64::INFINITY, &mut visit);
    }
}

impl Pattern {
    /// Caps count in a crowd as so much of their scratch's own cross-section, across each sector's axis, as far as they do
    /// not stand by themselves beside what is so thin.
    pub(super) fn for_each_cap_chord(
        &self,
        number: usize,
        within: Option<&Reach<'_>>,
        thin_mm: f64,
        visit: &mut impl FnMut(&Chord<'_>),
    ) {
        if self.tracks.has_no_caps() {
            return;
        }
        let curves = self.curves();
        let control = curves.control(number);
        for (end, quarter) in ENDS.into_iter().zip([0, 3]) {
            let place = control[quarter];
            if within.is_some_and(|reach| !reach.footprint.holds(reach.place(place))) {
                continue;
            }
            let Some(cap) = self.cap_at(number, end) else {
                continue;
            };
            let Some((track, _)) = self.strand(curves.pieces[number].scratch) else {
                continue;
            };
            let rest = 1.0 - cap.alone(&track, thin_mm);
            if rest == 0.0 {
                continue;
            }
            let left = rest * Visible::of(self.visible(number)).quarters[quarter];
            let scaled = control.map(|p| p * self.units_per_uv);
            let classes = track.classes(cap.place);
            let angle_rad = angle(tangent(&scaled, cap.at));
            for sector in cap.sectors() {
                // Across its axis, less than half a turn away.
                let turned = within_one_turn(angle_rad + sector.wedge.axis_rad + FRAC_PI_2);
                let area_mm2 = sector.area_mm2() * left;
                let mut areas = ClassAreas::default();
                add_shares(&mut areas, &classes, single(area_mm2));
                visit(&Chord {
                    ends: [place; 2],
                    heading: Heading::at(turned),
                    held: Held::Sector(areas),
                });
            }
        }
    }
}

/// An angle that is at most one turn below 0, or above the first turn.
fn within_one_turn(angle_rad: f32) -> f32 {
    if angle_rad < 0.0 {
        angle_rad + TAU
    } else if angle_rad >= TAU {
        angle_rad - TAU
    } else {
        angle_rad
    }
}

impl Chord<'_> {
    /// Scratched area between two shares of the chord, less what later scratches take of it on average.
    pub(super) fn areas(&self, stretch: [f64; 2]) -> ClassAreas {
        let part = single(stretch[1] - stretch[0]);
        match &self.held {
            Held::Way(..) => self.areas_left(stretch, |mean| [mean * part; STRIPS]).0,
            Held::Sector(areas) => areas.map(|area| area * part),
        }
    }

    /// Scratched area of the cross-sections between two shares of the chord, less what later scratches take, and what share of
    /// it the strips across have: `left` is told the share that is left of the average, and says what of the chord is left of each
    /// strip. What is left of caps is the average.
    pub(super) fn areas_left(
        &self,
        stretch: [f64; 2],
        left: impl FnOnce(f32) -> Strips,
    ) -> (ClassAreas, Strips) {
        match &self.held {
            &Held::Way(length_mm, [first, last], span, visible) => {
                let t = stretch.map(|share| first + share * (last - first));
                let left = left(single(visible.mean(t)));
                let all = left.iter().sum::<f32>() / STRIPS as f32;
                let length_mm = single(length_mm) * all;
                (span.per_mm(t).map(|area| area * length_mm), shares(left))
            }
            Held::Sector(areas) => (*areas, EVEN),
        }
    }

    /// How wide it is on average; a cap's sector, which lies at one place, has no width.
    pub(super) fn width_mm(&self) -> Option<f64> {
        match &self.held {
            &Held::Way(_, t, span, _) => Some(span.per_mm(t).iter().sum::<f32>().into()),
            Held::Sector(_) => None,
        }
    }
}

impl Span<'_> {
    fn even(track: &TrackRef<'_>, value: f64, known: &mut Recent<ClassAreas>) -> Self {
        Self::Even(known.get(track, [value; 2], || track.areas_at(value)))
    }

    /// The mean between two parameters.
    fn per_mm(&self, t: [f64; 2]) -> ClassAreas {
        let (track, lengths, at, places) = match self {
            Self::Even(areas) => return *areas,
            Self::Changing {
                track,
                lengths,
                at,
                places,
            } => (track, lengths, at, places),
        };
        let [from, to] = t.map(|t| {
            let share = (lengths.at(t) - at[0]) / (at[1] - at[0]);
            places[0] + (places[1] - places[0]) * share.clamp(0.0, 1.0)
        });
        track.mean_areas(from, to)
    }
}

/// How a stretch between two places from 0 to 1 is shared between as many equal parts of the whole.
fn shares_of<const PARTS: usize>(stretch: [f64; 2]) -> [f64; PARTS] {
    let [from, to] = stretch.map(|place| place * PARTS as f64);
    let length = to - from;
    let per_length = 1.0 / length;
    core::array::from_fn(|part| {
        if length > 0.0 {
            let start = part as f64;
            (to.min(start + 1.0) - from.max(start)).max(0.0) * per_length
        } else {
            // Nowhere: where it lies counts wholly.
            f64::from(u8::from(
                part == (cell_number(from) as usize).min(PARTS - 1),
            ))
        }
    })
}

impl Visible {
    /// Of a piece's quarters in 255ths.
    fn of(quarters: [u8; 4]) -> Self {
        Self {
            quarters: quarters.map(|quarter| f64::from(quarter) / 255.0),
            is_even: quarters.iter().all(|quarter| *quarter == quarters[0]),
        }
    }

    /// The mean between two parameters.
    fn mean(&self, stretch: [f64; 2]) -> f64 {
        if self.is_even {
            return self.quarters[0];
        }
        let shares = shares_of::<4>(stretch);
        let quarters = self.quarters.iter().zip(shares);
        quarters.map(|(quarter, share)| quarter * share).sum()
    }
}

/// Shares an area out between classes.
pub(super) fn add_shares(areas: &mut ClassAreas, classes: &[(usize, f32)], area_mm2: f32) {
    for &(class, share) in classes {
        // A damaged file may claim any class.
        if let Some(area) = areas.get_mut(class) {
            *area += share * area_mm2;
        }
    }
}

/// How many parts are at least this, from one to `most`.
fn number_of(parts: f64, most: f64) -> u32 {
    cell_number(parts.clamp(1.0, most) + (1.0 - 1e-9))
}

/// How much a piece turns, and no less.
fn turn_rad([a, b, c, d]: &[DVec2; 4]) -> f64 {
    let angle = |p: DVec2, q: DVec2| {
        let (cross, dot) = (p.perp_dot(q).abs(), p.dot(q));
        if cross < NEARLY_STRAIGHT * dot {
            cross / dot
        } else {
            p.angle_to(q).abs()
        }
    };
    let (first, middle, last) = (b - a, c - b, d - c);
    angle(first, middle) + angle(middle, last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::Metal;
    use crate::formation::{Material, Tool};
    use crate::pattern::{Key, Path, PatternBuilder, Scratch};

    /// A curved scratch that sets in, steadies and runs out, cut once: all stretches together hold what the integral of
    /// its width says, less what the later scratch takes, within half a percent, however they are cut.
    #[test]
    fn stretches_add_up() {
        let builder = PatternBuilder::new(Material::metal(Metal::Steel), 1.0, [100.0; 2]);
        let mut builder = builder.unwrap();
        let tool = Tool::rockwell_c();
        let points = [[0.1, 0.1], [0.3, 0.1], [0.4, 0.2], [0.4, 0.4]];
        let keys = [(0.0, 0.0), (0.3, 2.0), (0.6, 2.0), (1.0, 0.2)];
        let scratch = Scratch {
            keys: &keys.map(|(at, force)| Key::force(at, force)),
            path: Path::CubicBezier(&points),
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).unwrap();
        let line = [[0.325, 0.1], [0.325, 0.25]];
        let path = Path::Polyline(&line);
        builder.add(&Scratch { path, ..scratch }).unwrap();
        let pattern = builder.build();
        let (track, course) = pattern.strand(0).unwrap();
        let [first, last] = pattern.pieces_of(0);
        let is_cut = (first..=last).any(|piece| pattern.visible_share(piece) < 1.0);
        assert!(is_cut, "the later scratch leaves all");
        for piece in first..=last {
            let (mut whole, mut parts, mut longest) = (0.0, 0.0, 0.0_f64);
            let sum = |areas: ClassAreas| f64::from(areas.iter().sum::<f32>());
            Reader::new(&pattern).for_each_chord(piece, None, |chord| {
                if chord.ends[0] == chord.ends[1] {
                    return;
                }
                whole += sum(chord.areas([0.0, 1.0]));
                let cuts = [0.0, 0.01, 0.37, 0.371, 0.9, 1.0];
                parts += cuts
                    .windows(2)
                    .map(|w| sum(chord.areas([w[0], w[1]])))
                    .sum::<f64>();
                longest = longest.max(chord.ends[0].distance(chord.ends[1]));
            });
            assert!((parts / whole - 1.0).abs() < 5e-3, "{parts} and {whole}");
            let [from, to] = pattern.curves().at(piece);
            let lengths = LengthShares::of(&pattern.curves().control(piece));
            let steps = 10_000;
            let left_mm = |i: i32| {
                let share = (f64::from(i) + 0.5) / f64::from(steps);
                let quarter = cell_number(4.0 * lengths.parameter(share)) as usize;
                let width_mm = track.width(course.value(from + (to - from) * share));
                width_mm * f64::from(pattern.visible(piece)[quarter]) / 255.0
            };
            let mean_mm = (0..steps).map(left_mm).sum::<f64>() / f64::from(steps);
            let truth = mean_mm * (to - from) * pattern.length_of(0);
            let off = whole / truth - 1.0;
            assert!(off.abs() < 5e-3, "piece {piece}: {whole} and {truth}");
            assert!(longest > 0.0, "piece {piece} has no chords");
        }
    }
}
