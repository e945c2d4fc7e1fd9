//! A cross-section prepared for one view: which parts of its facets are seen, and how much of the pixel they are.

use super::{LONGEST_SHADOW, MOST_SLOTS, Relief, Zones, scaled_up};
use crate::lanes::{Lanes, Number, first_below_any, first_of, in_lanes};
use crate::scattering::footprint::Weight;
use crate::scattering::visibility::{Across, Parts};
use glam::{Vec2, Vec3};

/// Those of a register's places.
const NUMBERS: [f32; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

impl Zones {
    /// Prepares the cross-section of so many vertices that was placed last for a view. It is kept if any of it lies in
    /// the pixel.
    pub(crate) fn prepare(
        &mut self,
        vertices: usize,
        across: Vec2,
        weight: Weight,
        view: Vec3,
    ) -> Option<Relief> {
        let view = Across {
            x: view.truncate().dot(across),
            z: view.z,
        };
        in_lanes!(lanes => self.prepare_in(lanes, vertices, across, weight, view))
    }

    #[inline(always)]
    fn prepare_in<L: Lanes>(
        &mut self,
        lanes: L,
        vertices: usize,
        across: Vec2,
        weight: Weight,
        view: Across,
    ) -> Option<Relief> {
        let first = self.used as usize;
        let last = first + vertices - 1;
        let mut parts = Parts::new();
        let (xs, zs) = (&self.x[first..], &self.z[first..]);
        let horizon = parts.sweep(lanes, xs, zs, vertices - 1, view);
        let [ends, ends_z] = [&self.x, &self.z].map(|of| [of[first], of[last]]);
        let seen_flat = view.flat_ends(horizon, ends);
        // A shadow may fall into the pixel from a scratch beside it.
        let shadow = LONGEST_SHADOW * highest(lanes, zs, vertices);
        let shaded = [seen_flat[0] - shadow, seen_flat[1] + shadow];
        if !self.densities.touches(&weight, shaded) {
            return None;
        }
        let mut relief = Relief {
            across,
            first: self.used,
            vertices: u32::try_from(vertices).unwrap_or(0),
            gain: 1.0,
            seen_flat,
            seen_taken: self.densities.taken(&weight, seen_flat),
            open: clearing(ends, ends_z, seen_flat),
            weight,
            ..Relief::NONE
        };
        self.weigh(lanes, &mut relief, &parts, view);
        self.used += relief.vertices;
        Some(relief)
    }

    /// Finds the normals of a relief's facets, and how much of the pixel they are. What is written beyond the last facet
    /// means nothing: there is room for it, and who comes next has its own.
    #[inline(always)]
    fn weigh<L: Lanes>(&mut self, lanes: L, relief: &mut Relief, parts: &Parts, view: Across) {
        let (first, facets) = (relief.first as usize, relief.facets());
        let [mut least, mut most] = relief.open.map(|slope| lanes.all(slope));
        let (mut shown, mut from, mut to) = (
            lanes.all(0.0),
            lanes.all(f32::INFINITY),
            lanes.all(f32::NEG_INFINITY),
        );
        for k in (0..facets).step_by(L::WIDTH) {
            // Never more: so that nobody looks whether the arrays have room.
            let slot = (first + k).min(MOST_SLOTS - 1);
            let seen_end = scaled_up(parts.ends_from(lanes, k));
            lanes.store_whole(seen_end, &mut self.seen_end[slot..]);
            // Scaled up first: facets of nanometres would underflow when squared.
            let [x, z] = self.runs(lanes, slot);
            let (x, z) = (x * 1e6, z * 1e6);
            let length = (x * x + z * z).sqrt();
            let zero = lanes.all(0.0);
            let normal_x = length.if_above(zero, -z / length, zero);
            // Absurdly large ones have no direction.
            let normal_x = lanes.all(f32::MAX).if_above(length, normal_x, zero);
            let [falls, rises] = facing(lanes, facets - k, [x, z]);
            (least, most) = (least.max(falls), most.min(rises));
            let seen = self.seen(lanes, slot, view.x >= 0.0);
            let weight = self.part_weight(lanes, relief, slot, seen, view.x / view.z);
            let weight = first_of(lanes, facets - k, weight);
            shown = shown + weight;
            let number = lanes.load(&NUMBERS) + k as f32;
            from = from.min(weight.if_above(zero, number, from));
            to = weight.if_above(zero, number, to);
            lanes.store(normal_x, &mut self.normal_x[slot..]);
            lanes.store(weight, &mut self.weight[slot..]);
        }
        relief.shown = shown.sum();
        relief.open = [greatest_of(lanes, least), least_of(lanes, most)];
        self.note_seen_facets(relief, [least_of(lanes, from), greatest_of(lanes, to)]);
    }

    /// The first and the last facet that weigh anything, if any does.
    #[inline(always)]
    fn note_seen_facets(&self, relief: &mut Relief, [from, last]: [f32; 2]) {
        if from > last {
            return;
        }
        let seen = [from, last + 1.0].map(byte);
        let [from, to] = seen.map(|facet| relief.first as usize + usize::from(facet));
        let finishes = &self.finish[from..to];
        relief.seen_facets = seen;
        relief.is_uniform = finishes.iter().all(|finish| *finish == finishes[0]).into();
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn byte(number: f32) -> u8 {
    number as u8
}

#[inline(always)]
fn least_of<L: Lanes>(lanes: L, numbers: L::F) -> f32 {
    lanes.least_from(numbers).lane(0)
}

#[inline(always)]
fn greatest_of<L: Lanes>(lanes: L, numbers: L::F) -> f32 {
    lanes.most_up_to(numbers).lane(L::WIDTH - 1)
}

/// The highest of the first `count` heights, or 0 if all are below. As many are read as there are lanes.
#[inline(always)]
fn highest<L: Lanes>(lanes: L, heights: &[f32], count: usize) -> f32 {
    let mut most = lanes.all(0.0);
    for k in (0..count).step_by(L::WIDTH) {
        let own = first_below_any(lanes, count - k, lanes.load(&heights[k..]));
        most = own.max(most);
    }
    greatest_of(lanes, most)
}

/// Between which slopes of a light the first `count` facets with these runs, from their left to their right ends, face it.
#[inline(always)]
fn facing<L: Lanes>(lanes: L, count: usize, [x, z]: [L::F; 2]) -> [L::F; 2] {
    let (none, any) = (lanes.all(0.0), lanes.all(f32::INFINITY));
    let slope = x / z;
    let (falls, rises) = (none.if_above(z, slope, -any), z.if_above(none, slope, any));
    [
        first_below_any(lanes, count, falls),
        -first_below_any(lanes, count, -rises),
    ]
}

/// Between which slopes of a light the ends of a cross-section, if they stand up, shade none of the plane that is seen.
fn clearing(xs: [f32; 2], zs: [f32; 2], seen_flat: [f32; 2]) -> [f32; 2] {
    let slope = |end: usize, any: f32| match zs[end] {
        z if z > 0.0 => (xs[end] - seen_flat[end]) / z,
        _ => any,
    };
    [slope(1, f32::NEG_INFINITY), slope(0, f32::INFINITY)]
}
