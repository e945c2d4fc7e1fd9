//! A cross-section as a footprint sees it: the mean of those at some stations, vertex by vertex.

use super::course::Course;
use super::tracks::TrackRef;
use crate::lanes::Lanes;
use crate::single;
use glam::Vec2;

/// Shapes that a mean is taken over: of more stations every other one is kept, or every third, and so on.
const MOST_SHAPES: usize = 24;

/// Weighted shapes at equal distances in an array, the last one perhaps nearer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Profile<'p> {
    /// From the first shape's first vertex on.
    vertices: &'p [Vec2],
    stride: usize,
    /// Where the last shape begins.
    farthest: usize,
    pub vertex_count: usize,
    weights: [f32; MOST_SHAPES],
    shapes: usize,
}

impl<'p> Profile<'p> {
    /// The mean of two shapes, `stride` vertices apart; of one, if there is only one. No vertices if the array is
    /// too short, as a damaged file's may be.
    #[inline(always)]
    pub(crate) fn between(
        vertices: &'p [Vec2],
        stride: usize,
        vertex_count: usize,
        mix: f32,
    ) -> Self {
        let mut weights = [0.0; MOST_SHAPES];
        [weights[0], weights[1]] = [1.0 - mix, mix];
        let shapes = if mix > 0.0 { 2 } else { 1 };
        Self {
            vertices,
            stride,
            farthest: (shapes - 1) * stride,
            vertex_count: sound(vertices, [(shapes - 1) * stride, vertex_count]),
            weights,
            shapes,
        }
    }

    /// The mean of a scratch's cross-sections between two shares of its arc length.
    pub(crate) fn mean(track: &TrackRef<'p>, course: &Course<'_>, [from, to]: [f64; 2]) -> Self {
        if to <= from || course.is_even([from, to]) {
            return track.profile(course.value(from));
        }
        let last = track.station_count() - 1;
        let values = course.turns(from, to);
        let [low, high] = course.extremes(from, to);
        let kept = Kept::between(track.locate(low).0, (track.locate(high).0 + 1).min(last));
        let mut weights = [0.0; MOST_SHAPES];
        let mut add = |station: usize, weight: f64| {
            let (shape, mix) = kept.mix(track, station);
            weights[shape] += single(weight * (1.0 - mix));
            if mix > 0.0 {
                weights[shape + 1] += single(weight * mix);
            }
        };
        for [[at_a, a], [at_b, b]] in values {
            // Between two turns the value runs evenly, and each station's share of the way is known.
            let share = (at_b - at_a) / (to - from);
            let [low, high] = [a.min(b), a.max(b)];
            let mut station = track.locate(low).0;
            let mut at = low;
            loop {
                let next = (station + 1).min(last);
                let (p, q) = (track.station_at(station), track.station_at(next));
                let stop = if next > station { high.min(q) } else { high };
                let part = if high > low {
                    (stop - at) / (high - low)
                } else {
                    1.0
                };
                let middle = 0.5 * (at + stop);
                let mix = if q > p {
                    ((middle - p) / (q - p)).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                add(station, share * part * (1.0 - mix));
                add(next, share * part * mix);
                if stop >= high || next == station {
                    break;
                }
                (station, at) = (next, stop);
            }
        }
        let (vertices, vertex_count) = (track.shapes_from(kept.first), track.vertex_count());
        let farthest = kept.stations * vertex_count;
        Self {
            vertices,
            stride: kept.step * vertex_count,
            farthest,
            vertex_count: sound(vertices, [farthest, vertex_count]),
            weights,
            shapes: kept.shapes(),
        }
    }

    /// Where a shape begins.
    #[inline(always)]
    fn begin(&self, shape: usize) -> usize {
        (shape * self.stride).min(self.farthest)
    }

    #[inline(always)]
    fn vertex(&self, number: usize) -> Vec2 {
        let mut sum = self.vertices[number] * self.weights[0];
        for shape in 1..self.shapes {
            sum += self.vertices[self.begin(shape) + number] * self.weights[shape];
        }
        sum
    }

    /// Its vertices, as x and z written to the two slices.
    pub(crate) fn sample(&self, xs: &mut [f32], zs: &mut [f32]) {
        let vertices = self.vertices.get(..self.vertex_count).unwrap_or(&[]);
        for ((x, z), vertex) in xs.iter_mut().zip(&mut *zs).zip(vertices) {
            (*x, *z) = (vertex.x * self.weights[0], vertex.y * self.weights[0]);
        }
        // Mostly there is one shape, or two.
        for (shape, weight) in self.weights[..self.shapes].iter().enumerate().skip(1) {
            let first = self.begin(shape);
            let vertices = self.vertices.get(first..first + self.vertex_count);
            for ((x, z), vertex) in xs.iter_mut().zip(&mut *zs).zip(vertices.unwrap_or(&[])) {
                *x += vertex.x * weight;
                *z += vertex.y * weight;
            }
        }
    }

    /// The same with as many at a time as there are lanes.
    #[inline(always)]
    pub(crate) fn sample_in<L: Lanes>(&self, lanes: L, xs: &mut [f32], zs: &mut [f32]) {
        let count = self.vertex_count;
        if count < L::WIDTH {
            return self.sample(xs, zs);
        }
        let mut k = 0;
        while k < count {
            // The last ones once more, so that none beyond them are touched.
            let number = k.min(count - L::WIDTH);
            let [mut x, mut z] = lanes.load_pairs(&self.vertices[number..]);
            (x, z) = (x * self.weights[0], z * self.weights[0]);
            for shape in 1..self.shapes {
                let own = &self.vertices[self.begin(shape) + number..];
                let ([own_x, own_z], weight) = (lanes.load_pairs(own), self.weights[shape]);
                (x, z) = (x + own_x * weight, z + own_z * weight);
            }
            lanes.store(x, &mut xs[number..]);
            lanes.store(z, &mut zs[number..]);
            k += L::WIDTH;
        }
    }

    /// Where it begins and ends, mm.
    #[inline(always)]
    pub(crate) fn ends(&self) -> [f32; 2] {
        match self.vertex_count {
            0 => [0.0; 2],
            count => [self.vertex(0).x, self.vertex(count - 1).x],
        }
    }

    /// How far it reaches from the centre line, mm.
    pub(crate) fn half_width_mm(&self) -> f64 {
        let [left, right] = self.ends();
        f64::from(right.max(-left))
    }
}

/// The stations of a track that a mean is taken over: every so many-th of a stretch, and its last.
struct Kept {
    first: usize,
    step: usize,
    /// From the first to the last.
    stations: usize,
}

impl Kept {
    /// Those of a stretch from one station to another.
    fn between(first: usize, end: usize) -> Self {
        let stations = end.saturating_sub(first);
        Self {
            first,
            step: stations.div_ceil(MOST_SHAPES - 1).max(1),
            stations,
        }
    }

    fn shapes(&self) -> usize {
        self.stations.div_ceil(self.step) + 1
    }

    /// What stands for a station: a kept one's number, and how far from there to the next one, as shapes change between.
    fn mix(&self, track: &TrackRef<'_>, station: usize) -> (usize, f64) {
        let off = station.saturating_sub(self.first).min(self.stations);
        let shape = off / self.step;
        let before = shape * self.step;
        if off == before {
            return (shape, 0.0);
        }
        let next = (before + self.step).min(self.stations);
        let change = |off: usize| track.change_to((self.first + off, 0.0));
        let [a, at, b] = [before, off, next].map(change);
        let mix = if b > a { (at - a) / (b - a) } else { 0.0 };
        (shape, mix.clamp(0.0, 1.0))
    }
}

/// How many vertices shapes have of which the last begins there: none if the array is too short for it.
fn sound(vertices: &[Vec2], [farthest, vertex_count]: [usize; 2]) -> usize {
    if vertices.len() >= farthest + vertex_count {
        vertex_count
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::track::Track;
    use crate::pattern::tracks::Tracks;

    /// Stations as lie where scratches set in, where every depth is stated, and where few are far from the others.
    fn tracks() -> [Tracks; 3] {
        let set_in = (0..200).map(|i| f64::from(i) / 199.0).map(|at| at * at);
        let stated = (0..250).map(|i| {
            if i == 0 {
                0.0
            } else {
                0.2 + 0.8 * f64::from(i) / 249.0
            }
        });
        let apart = (0..32).map(|i| match i {
            0 => 0.0,
            31 => 1.0,
            _ => 0.02 + 1e-4 * f64::from(i),
        });
        [
            (set_in.collect(), f64::sqrt as fn(f64) -> f64),
            (stated.collect(), |at| at),
            (apart.collect(), |at| at),
        ]
        .map(|(at, width): (Vec<f64>, _)| {
            let sides = [-1.0, -0.6, -0.2, 0.2, 0.6, 1.0];
            let station = |at: &f64| sides.map(|side| Vec2::new(side * single(width(*at)), 0.0));
            let mut tracks = Tracks::default();
            tracks.push(&Track {
                vertices: at.iter().flat_map(station).collect(),
                at,
                vertex_count: sides.len(),
                caps: Default::default(),
                finishes: Default::default(),
            });
            tracks
        })
    }

    const COURSE: Course<'_> = Course {
        knots: &[[0.0, 0.0], [1.0, 1.0]],
        scale: 1.0,
    };

    /// The mean of a stretch is as wide as its cross-sections are on average, over however many stations, and however
    /// unevenly these lie.
    #[test]
    fn mean_of_many_stations() {
        for (i, tracks) in tracks().iter().enumerate() {
            let track = tracks.get(0).unwrap();
            for to in (1..=100).map(|i| 0.01 * f64::from(i)) {
                for from in [0.0, 0.5 * to, to - 0.01] {
                    let found = Profile::mean(&track, &COURSE, [from, to]).half_width_mm();
                    let steps = 4000;
                    let place =
                        |i: i32| from + (to - from) * (f64::from(i) + 0.5) / f64::from(steps);
                    let widths = (0..steps).map(|i| track.half_width_of(track.locate(place(i))));
                    let wanted = widths.sum::<f64>() / f64::from(steps);
                    let off = (found / wanted - 1.0).abs();
                    assert!(off < 4e-3, "{i}, {from} to {to}: {found}, not {wanted}");
                }
            }
        }
    }

    /// It changes evenly as the stretch grows, also where fewer of its stations are kept.
    #[test]
    fn mean_of_a_growing_stretch() {
        for (i, tracks) in tracks().iter().enumerate() {
            let track = tracks.get(0).unwrap();
            let mut last = 0.0;
            for to in (1..=10_000).map(|i| 1e-4 * f64::from(i)) {
                let found = Profile::mean(&track, &COURSE, [0.0, to]).half_width_mm();
                let most = if to > 0.01 { 0.02 * last } else { found };
                assert!((found - last).abs() <= most, "{i}, {to}: {last} to {found}");
                last = found;
            }
        }
    }
}
