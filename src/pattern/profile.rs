//! A cross-section as a footprint sees it: the mean of those at some stations, vertex by vertex.

use super::course::Course;
use super::tracks::TrackRef;
use crate::single;
use glam::Vec2;

/// Shapes that a mean is taken over: of more stations only every other counts, or every third, and so on.
const MOST_SHAPES: usize = 24;

/// Weighted shapes at equal distances in an array.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Profile<'p> {
    /// From the first shape's first vertex on.
    vertices: &'p [Vec2],
    stride: usize,
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
            vertex_count: sound(vertices, shapes, [stride, vertex_count]),
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
        let first = track.locate(low).0;
        let stations = (track.locate(high).0 + 1).min(last) - first;
        let step = stations.div_ceil(MOST_SHAPES - 1).max(1);
        let shapes = stations.div_ceil(step).min((last - first) / step) + 1;
        let mut weights = [0.0; MOST_SHAPES];
        // Stations lie as close as shapes change: one that does not count is a mix of its neighbours that do.
        let mut add = |station: usize, weight: f64| {
            let off = station.clamp(first, first + (shapes - 1) * step) - first;
            let (shape, beyond) = (off / step, off % step);
            let mix = beyond as f64 / step as f64;
            weights[shape] += single(weight * (1.0 - mix));
            if beyond > 0 {
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
        let (vertices, vertex_count) = (track.shapes_from(first), track.vertex_count());
        let stride = step * vertex_count;
        Self {
            vertices,
            stride,
            vertex_count: sound(vertices, shapes, [stride, vertex_count]),
            weights,
            shapes,
        }
    }

    #[inline(always)]
    fn vertex(&self, number: usize) -> Vec2 {
        let weighed =
            |shape: usize| self.vertices[shape * self.stride + number] * self.weights[shape];
        (0..self.shapes).map(weighed).sum()
    }

    /// Its vertices, as x and z written to the two slices.
    pub(crate) fn sample(&self, xs: &mut [f32], zs: &mut [f32]) {
        let vertices = self.vertices.get(..self.vertex_count).unwrap_or(&[]);
        for ((x, z), vertex) in xs.iter_mut().zip(&mut *zs).zip(vertices) {
            (*x, *z) = (vertex.x * self.weights[0], vertex.y * self.weights[0]);
        }
        // Mostly there is one shape, or two.
        for (shape, weight) in self.weights[..self.shapes].iter().enumerate().skip(1) {
            let first = shape * self.stride;
            let vertices = self.vertices.get(first..first + self.vertex_count);
            for ((x, z), vertex) in xs.iter_mut().zip(&mut *zs).zip(vertices.unwrap_or(&[])) {
                *x += vertex.x * weight;
                *z += vertex.y * weight;
            }
        }
    }

    /// Where it begins and ends, mm.
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

/// How many vertices so many shapes have: none if the array is too short for them.
fn sound(vertices: &[Vec2], shapes: usize, [stride, vertex_count]: [usize; 2]) -> usize {
    let needed = (shapes - 1) * stride + vertex_count;
    if vertices.len() >= needed {
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

    /// Where a scratch sets in it widens fast, over many stations: the mean of a stretch is as wide as its cross-sections are
    /// on average, however many those are.
    #[test]
    fn mean_of_many_stations() {
        let count = 200_u16;
        let at: Vec<f64> = (0..count).map(|i| (f64::from(i) / 199.0).powi(2)).collect();
        let width = |at: f64| single(at.sqrt());
        let sides = [-1.0, -0.6, -0.2, 0.2, 0.6, 1.0];
        let station = |at: &f64| sides.map(|side| Vec2::new(side * width(*at), 0.0));
        let mut tracks = Tracks::default();
        tracks.push(&Track {
            vertices: at.iter().flat_map(station).collect(),
            at,
            vertex_count: sides.len(),
            caps: Default::default(),
            finishes: Default::default(),
        });
        let track = tracks.get(0).unwrap();
        let knots = [[0.0, 0.0], [1.0, 1.0]];
        let course = Course {
            knots: &knots,
            scale: 1.0,
        };
        for [from, to] in [
            [0.0, 0.01],
            [0.0, 0.1],
            [0.0, 0.5],
            [0.0, 1.0],
            [0.2, 0.9],
            [0.7, 1.0],
        ] {
            let found = Profile::mean(&track, &course, [from, to]).half_width_mm();
            let steps = 10_000;
            let place = |i: i32| from + (to - from) * (f64::from(i) + 0.5) / f64::from(steps);
            let widths = (0..steps).map(|i| track.half_width_of(track.locate(place(i))));
            let wanted = widths.sum::<f64>() / f64::from(steps);
            assert!(
                (found / wanted - 1.0).abs() < 2e-3,
                "{from} to {to}: {found}, not {wanted}"
            );
        }
    }
}
