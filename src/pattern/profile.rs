//! A cross-section as a footprint sees it: the mean of those at some stations, vertex by vertex.

use super::course::Course;
use super::tracks::TrackRef;
use crate::single;
use glam::Vec2;

/// Stations that a mean is taken over; the farther ones of a longer stretch count with the last of these.
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
        let end = (track.locate(high).0 + 1)
            .min(last)
            .min(first + MOST_SHAPES - 1);
        let mut weights = [0.0; MOST_SHAPES];
        let mut add = |station: usize, weight: f64| {
            weights[station.clamp(first, end) - first] += single(weight);
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
        let (vertices, stride) = (track.shapes_from(first), track.vertex_count());
        let shapes = end - first + 1;
        Self {
            vertices,
            stride,
            vertex_count: sound(vertices, shapes, [stride; 2]),
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
