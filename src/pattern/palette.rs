//! The few cross-sections that stand for all of a pattern's where many scratches share a pixel.

mod choice;

use super::layers::{Layered, MOST_CUT};
use super::store::Store;
use super::track::MOST_VERTICES;
use super::tracks::{TrackRef, Tracks};
use crate::brdf::Finish;
use bytemuck::{Pod, Zeroable};
use core::f32::consts::FRAC_PI_2;
use rayon::prelude::*;

/// Cross-sections in a palette.
pub(crate) const MOST_CLASSES: usize = 8;

/// Vertices of all: finer ones are thinned out. As many of an arc's are kept as it has.
const MOST_POINTS: usize = 104;

/// Vertices of the finest one.
pub(crate) const MOST_CLASS_VERTICES: usize = 36;

/// There are enough classes if every cross-section's slopes are this close to one, RMS, as a share of the width of the
/// smoothest finish's lobe.
const CLOSE_ENOUGH: f32 = 0.15;

/// Cross-sections that take less than this share of all scratched area ask for no class.
const LEAST_SHARE: f64 = 1e-3;

/// Stations that classes are chosen from.
const MOST_CHOICES: usize = 4096;

/// Places across a cross-section at which it is compared with others.
const SAMPLES: usize = 24;

/// Distance between two finishes, in radians of slope.
const FINISH_RAD: f32 = 0.35;

/// Cross-sections one unit wide, from -1/2 to 1/2.
#[derive(Clone, Debug, Default)]
pub(crate) struct Palette {
    pub(super) classes: Store<Class>,
    pub(super) points: Store<Point>,
    pub finishes: Store<Finish>,
}

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Class {
    first: u32,
    count: u32,
    /// 1 if its mirror image is itself: travel to and fro are one.
    is_symmetric: u32,
}

/// A vertex, and the number of the finish of the facet that it begins.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Point {
    pub x: f32,
    pub z: f32,
    pub finish: u32,
}

/// How a cross-section is shared between two classes.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Blend {
    pub classes: [u16; 2],
    /// The second one's share.
    pub second: f32,
}

/// A cross-section's slopes and finishes, as a vector: what is near looks alike.
type Signature = [f32; 3 * SAMPLES];

impl Palette {
    /// A palette for tracks whose stations stand for `areas` (any unit, track after track, station after station).
    pub(crate) fn new(tracks: &Tracks, areas: &[f64]) -> Self {
        let mut palette = Self {
            finishes: tracks.finishes().into(),
            ..Self::default()
        };
        let all: f64 = areas.iter().sum();
        let mut choices: Vec<(usize, TrackRef<'_>, usize)> = Vec::new();
        let mut number = 0;
        for track in tracks.iter() {
            for station in 0..track.station_count() {
                if areas[number] > LEAST_SHARE * all && choices.len() < MOST_CHOICES {
                    choices.push((number, track, station));
                }
                number += 1;
            }
        }
        // Where all differ, none has a share to speak of: every so manyth is asked.
        if choices.is_empty() && all > 0.0 {
            let stride = areas.len().div_ceil(MOST_CHOICES);
            let stations = tracks
                .iter()
                .flat_map(|track| (0..track.station_count()).map(move |i| (track, i)));
            let numbered = stations.enumerate().step_by(stride);
            choices.extend(numbered.map(|(number, (track, station))| (number, track, station)));
            choices.retain(|choice| areas[choice.0] > 0.0);
        }
        let shapes: Vec<Shape> = choices
            .iter()
            .map(|&(_, track, station)| palette.shape(&track, station))
            .collect();
        let signatures: Vec<Signature> = shapes.iter().map(Shape::signature).collect();
        let smoothest = palette
            .finishes
            .iter()
            .map(Finish::alpha)
            .fold(0.3, f32::min);
        let weights: Vec<f64> = choices.iter().map(|choice| areas[choice.0]).collect();
        let chosen = choice::chosen(&signatures, &weights, CLOSE_ENOUGH * smoothest);
        let most = (MOST_POINTS / chosen.len().max(1)).min(MOST_CLASS_VERTICES);
        for shape in chosen.into_iter().map(|choice| &shapes[choice]) {
            palette.push(shape, most);
        }
        palette
    }

    /// How each station of all tracks is shared between the classes.
    pub(crate) fn blends(&self, tracks: &Tracks) -> Vec<Blend> {
        let classes: Vec<Signature> = (0..self.classes.len())
            .map(|class| Shape::of(self.points(class)).signature())
            .collect();
        let tracks: Vec<TrackRef<'_>> = tracks.iter().collect();
        let of_track = |track: &TrackRef<'_>| {
            let blend = |station| blend(&self.shape(track, station).signature(), &classes);
            (0..track.station_count()).map(blend).collect::<Vec<_>>()
        };
        tracks.par_iter().flat_map_iter(of_track).collect()
    }

    /// Whether it fits where classes are kept while shading, which a damaged file's may not.
    #[cfg(feature = "files")]
    pub(super) fn is_sound(&self) -> bool {
        let fits = |class| (2..=MOST_CLASS_VERTICES).contains(&self.points(class).len());
        self.points.len() <= MOST_POINTS
            && self.classes.len() <= MOST_CLASSES
            && (0..self.classes.len()).all(fits)
    }

    fn push(&mut self, shape: &Shape, most_vertices: usize) {
        let first = self.points.len();
        let is_symmetric = shape.is_symmetric();
        self.points.extend(&shape.thinned(most_vertices).points);
        self.classes.push(Class {
            first: u32::try_from(first).unwrap_or(0),
            count: u32::try_from(self.points.len() - first).unwrap_or(0),
            is_symmetric: is_symmetric.into(),
        });
    }

    /// A class's vertices.
    pub(crate) fn points(&self, class: usize) -> &[Point] {
        let of_class = |class: &Class| {
            let first = class.first as usize;
            self.points.get(first..first + class.count as usize)
        };
        self.classes.get(class).and_then(of_class).unwrap_or(&[])
    }

    /// Vertices of all classes.
    pub(crate) fn vertex_count(&self) -> usize {
        self.points.len()
    }

    pub(crate) fn is_symmetric(&self, class: usize) -> bool {
        self.classes
            .get(class)
            .is_some_and(|class| class.is_symmetric != 0)
    }

    /// A station's cross-section.
    fn shape(&self, track: &TrackRef<'_>, station: usize) -> Shape {
        let (mut xs, mut zs) = ([0.0; MOST_VERTICES], [0.0; MOST_VERTICES]);
        let count = track.vertex_count().min(MOST_VERTICES);
        let (xs, zs) = (&mut xs[..count], &mut zs[..count]);
        track.profile(track.station_at(station)).sample(xs, zs);
        let bottoms = track.layers().iter().map(|layer| layer.bottom_mm);
        let (mut x, mut z, mut layer) = ([0.0; MOST_CUT], [0.0; MOST_CUT], [0; MOST_CUT]);
        let slots = Layered {
            x: &mut x,
            z: &mut z,
            layer: &mut layer,
        };
        let cut = slots.cut(xs, zs, bottoms);
        let finishes: Vec<Finish> = track.finishes().collect();
        let number = |layer: u8| self.finish_number(&finishes[layer as usize]);
        let corner = |((&x, &z), &layer): ((&f32, &f32), &u8)| Point {
            x,
            z,
            finish: number(layer),
        };
        let points: Vec<Point> = x.iter().zip(&z).zip(&layer).take(cut).map(corner).collect();
        Shape::of(&points)
    }

    fn finish_number(&self, finish: &Finish) -> u32 {
        let place = self.finishes.iter().position(|known| known == finish);
        u32::try_from(place.unwrap_or(0)).unwrap_or(0)
    }
}

/// A cross-section one unit wide.
#[derive(Clone, Debug)]
struct Shape {
    points: Vec<Point>,
}

impl Shape {
    fn of(points: &[Point]) -> Self {
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Self { points: Vec::new() };
        };
        let width = last.x - first.x;
        let scale = if width > 0.0 { 1.0 / width } else { 0.0 };
        let place = |point: &Point| Point {
            x: (point.x - first.x) * scale - 0.5,
            z: point.z * scale,
            ..*point
        };
        Self {
            points: points.iter().map(place).collect(),
        }
    }

    fn mirrored(&self) -> Self {
        let count = self.points.len();
        let mirror = |i: usize| Point {
            x: -self.points[count - 1 - i].x,
            z: self.points[count - 1 - i].z,
            // A facet's finish stands with its left vertex.
            finish: self.points[count.saturating_sub(2 + i)].finish,
        };
        Self {
            points: (0..count).map(mirror).collect(),
        }
    }

    fn signature(&self) -> Signature {
        let mut signature = [0.0; 3 * SAMPLES];
        let mut facets = self.points.windows(2).peekable();
        for i in 0..SAMPLES {
            let x = (i as f32 + 0.5) / SAMPLES as f32 - 0.5;
            while facets.peek().is_some_and(|facet| facet[1].x < x) {
                facets.next();
            }
            let Some([a, b]) = facets.peek() else { break };
            signature[i] = (b.z - a.z).atan2(b.x - a.x).clamp(-FRAC_PI_2, FRAC_PI_2);
            // Any angles that few finishes share.
            let (sin, cos) = (2.4 * a.finish as f32).sin_cos();
            signature[SAMPLES + 2 * i] = FINISH_RAD * sin;
            signature[SAMPLES + 2 * i + 1] = FINISH_RAD * cos;
        }
        signature
    }

    fn is_symmetric(&self) -> bool {
        distance(&self.signature(), &self.mirrored().signature()) < 0.01
    }

    /// Without the corners that turn least, until few enough are left; what is symmetric stays so.
    fn thinned(&self, most_vertices: usize) -> Self {
        let mut points = self.points.clone();
        let is_symmetric = self.is_symmetric();
        while points.len() > most_vertices {
            let turn = |i: usize| {
                let ([a, b, c], same) = (
                    [points[i - 1], points[i], points[i + 1]],
                    points[i - 1].finish == points[i].finish,
                );
                let slope = |a: Point, b: Point| (b.z - a.z).atan2(b.x - a.x);
                let turn = (slope(b, c) - slope(a, b)).abs();
                if same { turn } else { turn + 1.0 }
            };
            let least = (1..points.len() - 1).min_by(|&a, &b| turn(a).total_cmp(&turn(b)));
            let least = least.unwrap_or(1);
            let mirrored = points.len() - 1 - least;
            if is_symmetric && least != mirrored {
                points.remove(least.max(mirrored));
                points.remove(least.min(mirrored));
            } else {
                points.remove(least);
            }
        }
        Self { points }
    }
}

fn distance(a: &Signature, b: &Signature) -> f32 {
    (squared(a, b) / SAMPLES as f32).sqrt()
}

fn squared(a: &Signature, b: &Signature) -> f32 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// The nearest class, and the one towards which the signature lies from there.
fn blend(signature: &Signature, classes: &[Signature]) -> Blend {
    let number = |class: usize| u16::try_from(class).unwrap_or(0);
    let near = |class: &usize| distance(signature, &classes[*class]);
    let nearest = (0..classes.len()).min_by(|a, b| near(a).total_cmp(&near(b)));
    let Some(nearest) = nearest else {
        return Blend::default();
    };
    let towards = |class: usize| {
        let from = &classes[nearest];
        let (mut dot, mut square) = (0.0, 0.0);
        for ((value, from), to) in signature.iter().zip(from).zip(&classes[class]) {
            dot += (value - from) * (to - from);
            square += (to - from) * (to - from);
        }
        let share = if square > 0.0 {
            (dot / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        // What is left of the distance once this share of the way is gone.
        let left =
            near(&nearest).powi(2) * SAMPLES as f32 - 2.0 * share * dot + share * share * square;
        (share, left)
    };
    let ways = (0..classes.len()).map(|class| (class, towards(class)));
    let best = ways.min_by(|a, b| a.1.1.total_cmp(&b.1.1));
    let (second, (share, _)) = best.unwrap_or((nearest, (0.0, 0.0)));
    Blend {
        classes: [number(nearest), number(second)],
        second: share,
    }
}

/// One cross-section that is its own mirror image.
#[cfg(test)]
pub(super) fn symmetric() -> Palette {
    let mut palette = Palette::default();
    let point = |[x, z]: [f32; 2]| Point { x, z, finish: 0 };
    let points = [[-0.5, 0.0], [0.0, -0.2], [0.5, 0.0]].map(point);
    palette.push(&Shape::of(&points), MOST_CLASS_VERTICES);
    palette
}
