//! The zones of the scratches in one footprint, prepared for one view.

use super::footprint::Weight;
use super::visibility::{Across, overlap, sweep};
use crate::brdf::{Finish, Pair};
use glam::{DVec2, Vec2, Vec3};

/// Scratches that a shading point holds one by one; what comes on top widens those it resembles.
pub(crate) const MOST_RELIEFS: usize = 16;

/// Vertices that a shading point holds for all its scratches together.
pub(crate) const MOST_SLOTS: usize = 152;

/// A shadow at grazing light is followed to this many times the height it falls from (down to 2.9 degrees).
pub(crate) const LONGEST_SHADOW: f32 = 20.0;

/// All zones of one shading point, in flat arrays: facet k of a relief runs from vertex k to k + 1 and
/// has its own values in slot k (the last vertex's slot has none).
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Zones {
    x: [f32; MOST_SLOTS],
    z: [f32; MOST_SLOTS],
    normal_x: [f32; MOST_SLOTS],
    normal_z: [f32; MOST_SLOTS],
    /// The part that the viewer sees, from and to.
    seen: [[f32; 2]; MOST_SLOTS],
    /// How much that part weighs in the pixel.
    weight: [f32; MOST_SLOTS],
    used: u32,
}

/// One scratch in the footprint. Lengths in mm across the scratch, from its centre line.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Relief {
    /// Cross-section axis, to the right of travel, in the local frame.
    across: Vec2,
    first: u32,
    vertices: u32,
    /// How many scratches like this one it stands for, and how far crowding thins them.
    pub gain: f32,
    /// What of the pixel's plane the viewer sees through this scratch, from and to.
    seen_flat: [f32; 2],
    weight: Weight,
    finish: Finish,
}

impl Zones {
    pub(crate) const fn empty() -> Self {
        Self {
            x: [0.0; MOST_SLOTS],
            z: [0.0; MOST_SLOTS],
            normal_x: [0.0; MOST_SLOTS],
            normal_z: [0.0; MOST_SLOTS],
            seen: [[0.0; 2]; MOST_SLOTS],
            weight: [0.0; MOST_SLOTS],
            used: 0,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.used = 0;
    }

    /// Free slots for a cross-section of `vertices` points: its x and z, to be filled in. Nothing is taken
    /// until [`Self::prepare`] keeps them.
    pub(crate) fn free(&mut self, vertices: usize) -> Option<(&mut [f32], &mut [f32])> {
        let first = self.used as usize;
        let slots = first..first + vertices;
        (slots.end <= MOST_SLOTS).then(|| (&mut self.x[slots.clone()], &mut self.z[slots]))
    }

    /// Prepares the cross-section in the next `vertices` free slots for a view. Nothing is kept if none of
    /// it lies in the pixel.
    pub(crate) fn prepare(
        &mut self,
        vertices: usize,
        across: Vec2,
        weight: Weight,
        finish: Finish,
        view: Vec3,
    ) -> Option<Relief> {
        let first = self.used as usize;
        let slots = first..first + vertices;
        let (xs, zs) = (&self.x[slots.clone()], &self.z[slots.clone()]);
        let v = Across {
            x: view.truncate().dot(across),
            z: view.z,
        };
        let seen = &mut self.seen[slots];
        let horizon = sweep(xs, zs, v, |k, part| seen[k] = part);
        let ends = [xs[0], xs[vertices - 1]];
        let seen_flat = v.flat_ends(horizon, ends);
        // A shadow may fall into the pixel from a scratch beside it.
        let shadow = LONGEST_SHADOW * zs.iter().copied().fold(0.0, f32::max);
        if !weight.touches([seen_flat[0] - shadow, seen_flat[1] + shadow]) {
            return None;
        }
        let relief = Relief {
            across,
            first: self.used,
            vertices: u32::try_from(vertices).unwrap_or(0),
            gain: 1.0,
            seen_flat,
            weight,
            finish,
        };
        for k in first..first + vertices - 1 {
            let run = Vec2::new(self.x[k + 1] - self.x[k], self.z[k + 1] - self.z[k]);
            // Scaled up first: facets of nanometres would underflow when squared.
            let unit = (run * 1e6).normalize_or(Vec2::X);
            (self.normal_x[k], self.normal_z[k]) = (-unit.y, unit.x);
            self.weight[k] = self.part_weight(&relief, k, self.seen[k], v.x / v.z);
        }
        self.used += relief.vertices;
        Some(relief)
    }

    /// How much a part of a facet weighs in the pixel: its projection along the view, under the filter.
    fn part_weight(&self, relief: &Relief, k: usize, part: [f32; 2], view_slope: f32) -> f32 {
        if part[0] >= part[1] {
            return 0.0;
        }
        let [from, to] = part.map(|share| {
            let x = self.x[k] + share * (self.x[k + 1] - self.x[k]);
            let z = self.z[k] + share * (self.z[k + 1] - self.z[k]);
            x - z * view_slope
        });
        relief.weight.between(from, to).max(0.0)
    }

    /// What one relief reflects (RGB, base BRDF times cosine, weighed), and the share of the pixel's flat
    /// surface that it takes from this light.
    pub(crate) fn reflect(&self, relief: &Relief, pair: &Pair) -> (Vec3, f32) {
        let across = relief.across;
        let turned = |w: Vec3| {
            let along = Vec2::new(-across.y, across.x);
            Vec3::new(w.truncate().dot(across), w.truncate().dot(along), w.z)
        };
        let pair = Pair {
            view: turned(pair.view),
            light: turned(pair.light),
            half: turned(pair.half),
            view_half: pair.view_half,
        };
        let slots = relief.first as usize..(relief.first + relief.vertices) as usize;
        let (xs, zs) = (&self.x[slots.clone()], &self.z[slots.clone()]);
        let light = Across {
            x: pair.light.x,
            z: pair.light.z,
        };
        let view_slope = pair.view.x / pair.view.z;
        let mut lobes = 0.0;
        let horizon = sweep(xs, zs, light, |k, lit| {
            let slot = relief.first as usize + k;
            if self.weight[slot] == 0.0 {
                return;
            }
            let seen = self.seen[slot];
            let both = overlap(seen, lit);
            let weight = if both == seen {
                self.weight[slot]
            } else {
                self.part_weight(relief, slot, both, view_slope)
            };
            if weight > 0.0 {
                let normal = Vec3::new(self.normal_x[slot], 0.0, self.normal_z[slot]);
                lobes += weight * relief.finish.lobe_cos(normal, &pair);
            }
        });
        let lit_flat = light.flat_ends(horizon, relief.seen_flat);
        let taken = relief.gain * relief.weight.taken(lit_flat);
        (relief.finish.shared(&pair) * (lobes * relief.gain), taken)
    }
}

impl Relief {
    pub(crate) const NONE: Self = Self {
        across: Vec2::X,
        first: 0,
        vertices: 0,
        gain: 0.0,
        seen_flat: [0.0; 2],
        weight: Weight::NONE,
        finish: Finish::BLACK,
    };

    /// The share of the pixel that the viewer sees this relief in.
    pub(crate) fn coverage(&self) -> f32 {
        self.gain * self.weight.taken(self.seen_flat)
    }

    /// How alike the direction is, 0 to 1.
    pub(crate) fn alignment(&self, across: DVec2) -> f32 {
        self.across.dot(across.as_vec2()).abs()
    }
}
