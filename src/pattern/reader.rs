//! Scratches read piece by piece: what neighbours have in common is looked up once.

use super::Pattern;
use super::chords::ClassAreas;
use super::course::Course;
use super::tracks::TrackRef;

/// What the last pieces asked for. Answers are the same whatever was asked before.
pub(super) struct Reader<'p> {
    pub pattern: &'p Pattern,
    scratch: Option<u32>,
    pub strand: Option<(TrackRef<'p>, Course<'p>)>,
    /// Of places on tracks: areas by class of a mm.
    pub per_mm: Recent<ClassAreas>,
    /// Of ways along tracks: the mean width, mm.
    pub widths: Recent<f64>,
    /// Of places on tracks: the station before, how far it is to the next, and the width, mm.
    pub places: Recent<(usize, f32, f64)>,
}

/// The last two answers about a track. Most scratches ask for what they set in to and what they run at, as the ones before
/// them do.
pub(super) struct Recent<A> {
    asked: [(usize, [f64; 2]); 2],
    answers: [A; 2],
    oldest: usize,
}

impl<'p> Reader<'p> {
    pub(super) fn new(pattern: &'p Pattern) -> Self {
        Self {
            pattern,
            scratch: None,
            strand: None,
            per_mm: Recent::new(),
            widths: Recent::new(),
            places: Recent::new(),
        }
    }

    /// Turns to the scratch of a piece, if there is one.
    #[inline]
    pub(super) fn turn_to(&mut self, number: usize) {
        let piece = self.pattern.curves().pieces.get(number);
        let scratch = piece.map(|piece| piece.scratch);
        if self.scratch != scratch {
            self.scratch = scratch;
            self.strand = scratch.and_then(|scratch| self.pattern.strand(scratch));
        }
    }

    /// The mean width of a piece, mm.
    pub(super) fn mean_width(&mut self, number: usize) -> f64 {
        self.turn_to(number);
        let Some((track, course)) = &self.strand else {
            return 0.0;
        };
        let widths = &mut self.widths;
        course.mean(self.pattern.curves().at(number), |from, to| {
            let way = [from.min(to), from.max(to)];
            widths.get(track, way, || track.mean_width(way[0], way[1]))
        })
    }
}

impl<A: Copy + Default> Recent<A> {
    fn new() -> Self {
        Self {
            // Nothing is equal to it.
            asked: [(0, [f64::NAN; 2]); 2],
            answers: [A::default(); 2],
            oldest: 0,
        }
    }

    /// The answer to a question about a track.
    #[inline]
    pub(super) fn get(
        &mut self,
        track: &TrackRef<'_>,
        way: [f64; 2],
        answer: impl FnOnce() -> A,
    ) -> A {
        let asked = (track.first_station(), way);
        if self.asked[0] == asked {
            return self.answers[0];
        }
        if self.asked[1] == asked {
            return self.answers[1];
        }
        let place = self.oldest;
        (self.asked[place], self.answers[place]) = (asked, answer());
        self.oldest = 1 - place;
        self.answers[place]
    }
}
