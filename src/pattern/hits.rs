//! What a renderer gets besides light: which scratches a footprint holds, where on each of them it is, and how
//! much of it each covers.

use super::Pattern;
use super::closest::{length_share, nearest};
use super::crossings::{Covers, Cutting, Parts, cut_away};
use super::hit::Hit;
use super::point::{Frame, Metric, SurfacePoint};
use super::query::{Candidates, Reach};
use super::region::Region;
use super::track::MOST_VERTICES;
use crate::error::Result;
use crate::single;
use arrayvec::ArrayVec;
use core::ops::ControlFlow;
use glam::DVec2;

/// Runs of scratch that are cut against one another; among more, each counts with the share that later
/// scratches leave of it on average.
const MOST_CUT: usize = 128;

/// Points per side of a run's box for what many crossings leave of it.
const SAMPLES: u32 = 32;

/// One scratch in a footprint. Coverage is that of the whole footprint; all else is told of the scratch's place that
/// is nearest to the footprint's centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct ScratchHit {
    /// Number of the scratch in order of adding, from 0.
    pub scratch: u32,
    /// The share of the footprint that the scratch covers with its rims, less what later scratches cut: above 0, to 1.
    pub coverage: f32,
    /// From the scratch's start along its path, scene units.
    pub arc_length: f64,
    /// From the centre line to the footprint's centre, mm, to the right of travel.
    pub offset_mm: f64,
    /// Unit direction of travel in the local frame; z is 0.
    pub travel: [f32; 3],
    /// How deep the cross-section lies below the unscratched surface at the footprint's centre, mm; negative on the
    /// piled-up rims, 0 beside the scratch.
    pub depth_mm: f32,
    /// The cross-section's depth where it is deepest, mm.
    pub deepest_mm: f32,
}

/// How many scratches a footprint holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// Scratches that were written.
    pub written: usize,
    /// Scratches that were told apart, however many could be written.
    pub count: usize,
    /// Whether these are all. A footprint over thousands of scratches is not searched to its end: it has others
    /// that are not counted, and perhaps none that is.
    pub complete: bool,
}

impl Pattern {
    /// The scratches in a point's footprint, the one that covers the largest share of it first, of equal ones the
    /// latest (which lies on top) first. Where `hits` is too short, the first ones are written; where it is longer,
    /// the rest stays as it was. Runs of one scratch are one hit. Allocates nothing.
    ///
    /// A point footprint, one nanometre wide, tells what lies right there.
    ///
    /// Errors: a point that cannot be, as in [`Shading::shade`](crate::scattering::Shading::shade), or a
    /// footprint of no usable size.
    pub fn hits(&self, point: &SurfacePoint, hits: &mut [ScratchHit]) -> Result<Found> {
        let frame = Frame::at(point)?;
        let scale = self.mm_per_scene_unit;
        let metric = Metric::at(point, &frame, scale)?;
        let ([a, b], footprint) = metric.edges(&point.footprint, scale);
        let region = Region::parallelogram(a, b);
        footprint?;
        let reach = Reach::new(&metric, &region, self.extent.half_width_mm.into());
        let mut candidates = Candidates::new();
        let complete = self.candidates(&reach, &mut candidates);
        let mut listing = Listing {
            pattern: self,
            reach: &reach,
            hits,
            found: Found {
                complete,
                ..Found::default()
            },
            current: None,
        };
        if !listing.add_cut(&candidates) {
            self.for_each_run(&candidates, &reach, 0.0, &mut |run| {
                listing.add_average(run);
                ControlFlow::Continue(())
            });
        }
        listing.close();
        Ok(listing.found)
    }

    /// The place nearest to the footprint's centre on the way along a scratch, from `at` (a share of its arc
    /// length) on in the direction that leads there.
    fn nearest_place(&self, scratch: u32, at: f64, reach: &Reach<'_>) -> Place {
        let curves = self.curves();
        let [first, last] = self.pieces_of(scratch);
        let on = |number: usize| {
            let control = curves.control(number).map(|uv| reach.place(uv));
            let (t, origin, travel) = nearest(&control, DVec2::ZERO);
            let [from, to] = curves.at(number);
            let at = from + (to - from) * length_share(&control, t);
            let place = Place { at, origin, travel };
            (t, place)
        };
        let is_joined = |number: usize| curves.pieces.get(number).is_some_and(|p| p.is_joined());
        // Where a closed path begins, it goes on from its last piece.
        let before = |number: usize| {
            let before = if number == first { last } else { number - 1 };
            is_joined(number).then_some(before)
        };
        let after = |number: usize| {
            let after = if number == last { first } else { number + 1 };
            is_joined(after).then_some(after)
        };
        let ends = curves.pieces.get(first..last).unwrap_or(&[]);
        let mut number = first + ends.partition_point(|piece| f64::from(piece.end_at) < at);
        let (mut t, mut best) = on(number);
        loop {
            let next = match t {
                t if t <= 0.0 => before(number),
                t if t >= 1.0 => after(number),
                _ => None,
            };
            let nearer = next.map(|next| (next, on(next))).filter(|(_, (_, place))| {
                place.origin.length_squared() < best.origin.length_squared()
            });
            let Some((next, (next_t, place))) = nearer else {
                return best;
            };
            (number, t, best) = (next, next_t, place);
        }
    }

    /// Depth at a distance across from the centre line, and where it is largest, mm.
    fn depths(&self, scratch: u32, at: f64, offset_mm: f64) -> [f32; 2] {
        let Some((track, course)) = self.strand(scratch) else {
            return [0.0; 2];
        };
        let (mut xs, mut zs) = ([0.0; MOST_VERTICES], [0.0; MOST_VERTICES]);
        let (xs, zs) = (
            &mut xs[..track.vertex_count()],
            &mut zs[..track.vertex_count()],
        );
        track.profile(course.value(at)).sample(xs, zs);
        let lowest = zs.iter().copied().fold(0.0, f32::min);
        // A difference with zero, for zero has a sign.
        [0.0 - height_at(xs, zs, single(offset_mm)), 0.0 - lowest]
    }
}

/// What later runs leave of an area, by points: where they cut it into too many parts.
fn sampled(later: &[Option<Region>], cover: &Region) -> f64 {
    let corners = cover.corners();
    let low = corners.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = corners
        .iter()
        .copied()
        .fold(DVec2::NEG_INFINITY, DVec2::max);
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(SAMPLES);
    let (mut inside, mut left) = (0, 0);
    for (i, j) in (0..SAMPLES).flat_map(|i| (0..SAMPLES).map(move |j| (i, j))) {
        let p = low + (high - low) * DVec2::new(place(i), place(j));
        if !cover.holds(p) {
            continue;
        }
        let is_cut = later
            .iter()
            .any(|cover| cover.is_some_and(|cover| cover.holds(p)));
        inside += 1;
        left += u32::from(!is_cut);
    }
    cover.area() * f64::from(left) / f64::from(inside.max(1))
}

/// A place of a scratch: share of arc length, and mm in the local frame.
struct Place {
    at: f64,
    origin: DVec2,
    travel: DVec2,
}

/// The height of a polyline with ascending `xs`; 0 beside it.
fn height_at(xs: &[f32], zs: &[f32], x: f32) -> f32 {
    let after = xs.partition_point(|&vertex| vertex <= x);
    match after.checked_sub(1) {
        Some(k) if after < xs.len() => {
            zs[k] + (zs[after] - zs[k]) * ((x - xs[k]) / (xs[after] - xs[k]))
        }
        _ => 0.0,
    }
}

/// A scratch whose runs are being added up.
#[derive(Clone, Copy)]
struct Sum {
    scratch: u32,
    area: f64,
    /// Share of arc length where it comes nearest to the footprint's centre so far, and how near that is, mm².
    at: f64,
    distance: f64,
}

/// Makes one hit of each scratch's runs, which come one after the other, and keeps the largest.
struct Listing<'a> {
    pattern: &'a Pattern,
    reach: &'a Reach<'a>,
    hits: &'a mut [ScratchHit],
    found: Found,
    current: Option<Sum>,
}

impl Listing<'_> {
    /// Adds each run less what later ones cut of it; false, with nothing added, if they are too many for that.
    fn add_cut(&mut self, candidates: &Candidates) -> bool {
        let mut runs: ArrayVec<Hit<'_>, MOST_CUT> = ArrayVec::new();
        let mut all = true;
        let (pattern, reach) = (self.pattern, self.reach);
        pattern.for_each_run(candidates, reach, 0.0, &mut |run| {
            all = run.is_beside(reach.footprint) || runs.try_push(*run).is_ok();
            if all {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        if !all {
            return false;
        }
        let mut covers = Covers::<MOST_CUT>::new();
        covers.add(&runs, reach.footprint);
        let (crossing, mut cutting) = (covers.crossing(&runs, reach.footprint), Cutting::new());
        for (i, run) in runs.iter().enumerate() {
            let Some(cover) = &crossing.covers[i] else {
                continue;
            };
            let mut parts = Parts::new();
            parts.push(*cover);
            crossing.find_cutting(i, &mut cutting);
            let area = if cut_away(&mut parts, &cutting, self.reach.area_mm2) {
                parts.iter().map(Region::area).sum()
            } else {
                sampled(&crossing.covers[i + 1..], cover)
            };
            self.add(run, area);
        }
        true
    }

    fn add_average(&mut self, run: &Hit<'_>) {
        let area = run
            .cover(self.reach.footprint)
            .as_ref()
            .map_or(0.0, Region::area);
        let visible = self.pattern.visible_share(run.piece);
        self.add(run, area * f64::from(visible));
    }

    fn add(&mut self, run: &Hit<'_>, area: f64) {
        if area <= 0.0 {
            return;
        }
        if self.current.is_some_and(|sum| sum.scratch != run.scratch) {
            self.close();
        }
        let sum = self.current.get_or_insert(Sum {
            scratch: run.scratch,
            area: 0.0,
            at: run.at,
            distance: f64::INFINITY,
        });
        sum.area += area;
        let distance = run.line.origin.length_squared();
        if distance < sum.distance {
            (sum.at, sum.distance) = (run.at, distance);
        }
    }

    /// Enters the scratch that was being added up.
    fn close(&mut self) {
        let Some(sum) = self.current.take() else {
            return;
        };
        let hit = self.hit(&sum);
        self.found.count += 1;
        let written = self.found.written;
        // Scratches come in their order: the later of two equal ones goes before the earlier.
        let place = self.hits[..written].partition_point(|other| other.coverage > hit.coverage);
        if place == self.hits.len() {
            return;
        }
        let last = written.min(self.hits.len() - 1);
        self.hits.copy_within(place..last, place + 1);
        self.hits[place] = hit;
        self.found.written = last + 1;
    }

    fn hit(&self, sum: &Sum) -> ScratchHit {
        let place = self.pattern.nearest_place(sum.scratch, sum.at, self.reach);
        let Place { at, origin, travel } = place;
        let offset_mm = travel.perp().dot(origin);
        let [depth_mm, deepest_mm] = self.pattern.depths(sum.scratch, at, offset_mm);
        ScratchHit {
            scratch: sum.scratch,
            coverage: single((sum.area / self.reach.area_mm2).min(1.0)),
            arc_length: at * self.pattern.length_of(sum.scratch),
            offset_mm,
            travel: travel.extend(0.0).as_vec3().to_array(),
            depth_mm,
            deepest_mm,
        }
    }
}
