//! A cross-section prepared for one view: which parts of its facets are seen, and how much of the pixel they are.

use super::{LONGEST_SHADOW, Relief, Zones, packed};
use crate::lanes::{Lanes, Number, in_lanes};
use crate::scattering::footprint::Weight;
use crate::scattering::visibility::{Across, Parts, first_below_any, first_of};
use glam::{Vec2, Vec3};

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
        let first = self.used as usize;
        let slots = first..first + vertices;
        let v = Across {
            x: view.truncate().dot(across),
            z: view.z,
        };
        let mut parts = Parts::new();
        let horizon = in_lanes!(lanes => parts.sweep(lanes, &self.x[first..], &self.z[first..], vertices - 1, v));
        let (xs, zs) = (&self.x[slots.clone()], &self.z[slots]);
        let [ends, ends_z] = [xs, zs].map(|of| [of[0], of[vertices - 1]]);
        let seen_flat = v.flat_ends(horizon, ends);
        // A shadow may fall into the pixel from a scratch beside it.
        let shadow = LONGEST_SHADOW * zs.iter().copied().fold(0.0, f32::max);
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
        in_lanes!(lanes => self.weigh(lanes, &mut relief, &parts, v));
        self.used += relief.vertices;
        Some(relief)
    }

    /// Finds the normals of a relief's facets, and how much of the pixel they are.
    #[inline(always)]
    fn weigh<L: Lanes>(&mut self, lanes: L, relief: &mut Relief, parts: &Parts, view: Across) {
        let (first, facets) = (relief.first as usize, relief.facets());
        for k in 0..facets {
            self.seen_end[first + k] = packed(parts.end(k));
        }
        let [mut least, mut most] = relief.open.map(|slope| lanes.all(slope));
        for k in (0..facets).step_by(L::WIDTH) {
            let slot = first + k;
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
            relief.shown += weight.sum();
            let own = L::WIDTH.min(facets - k);
            let (mut normals, mut weights) = ([0.0; 8], [0.0; 8]);
            lanes.store(normal_x, &mut normals);
            lanes.store(weight, &mut weights);
            self.normal_x[slot..slot + own].copy_from_slice(&normals[..own]);
            self.weight[slot..slot + own].copy_from_slice(&weights[..own]);
        }
        relief.open = [
            lanes.most_up_to(least).lane(L::WIDTH - 1),
            lanes.least_from(most).lane(0),
        ];
        self.note_seen_facets(relief);
    }

    fn note_seen_facets(&self, relief: &mut Relief) {
        let first = relief.first as usize;
        let weights = &self.weight[first..first + relief.facets()];
        let Some(from) = weights.iter().position(|&weight| weight > 0.0) else {
            return;
        };
        let last = weights.iter().rposition(|&weight| weight > 0.0);
        let to = last.map_or(from, |last| last + 1);
        let finishes = &self.finish[first + from..first + to];
        relief.seen_facets = [from, to].map(|facet| u8::try_from(facet).unwrap_or(u8::MAX));
        relief.is_uniform = finishes.iter().all(|finish| *finish == finishes[0]).into();
    }
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
