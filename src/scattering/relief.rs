//! The zones of the scratches in one footprint, prepared for one view.

use super::footprint::Weight;
use super::visibility::{Across, overlap, sweep};
use crate::brdf::{Finish, Pair};
use glam::{Vec2, Vec3};

/// Scratches that a shading point holds one by one; what comes on top widens those it resembles.
pub(crate) const MOST_RELIEFS: usize = 16;

/// Vertices that a shading point holds for all its scratches together.
pub(crate) const MOST_SLOTS: usize = 144;

/// Different finishes that a shading point holds. Zones of further ones reflect like the last.
pub(crate) const MOST_FINISHES: usize = 12;

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
    /// Which of `finishes` the facet has.
    finish: [u8; MOST_SLOTS],
    finishes: [Finish; MOST_FINISHES],
    finish_count: u32,
    used: u32,
}

/// One scratch in the footprint. Lengths in mm across the scratch, from its centre line.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Relief {
    /// Cross-section axis, to the right of travel, in the local frame.
    pub across: Vec2,
    pub first: u32,
    pub vertices: u32,
    /// The finish of its deepest zones.
    pub finish: u8,
    /// How many scratches like this one it stands for, and how far crowding thins them.
    pub gain: f32,
    /// What of the pixel's plane the viewer sees through this scratch, from and to.
    seen_flat: [f32; 2],
    weight: Weight,
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
            finish: [0; MOST_SLOTS],
            finishes: [Finish::BLACK; MOST_FINISHES],
            finish_count: 0,
            used: 0,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.used = 0;
        self.finish_count = 0;
    }

    /// The number of a finish among those that this point holds.
    pub(crate) fn finish(&mut self, finish: &Finish) -> u8 {
        let held = &self.finishes[..self.finish_count as usize];
        let known = held.iter().position(|other| other == finish);
        let number = known.unwrap_or(held.len().min(MOST_FINISHES - 1));
        if number == held.len() {
            self.finishes[number] = *finish;
            self.finish_count += 1;
        }
        u8::try_from(number).unwrap_or(0)
    }

    /// Where a cross-section of so many vertices may go, if there are free slots.
    pub(crate) fn free(&self, vertices: usize) -> Option<u32> {
        (self.used as usize + vertices <= MOST_SLOTS).then_some(self.used)
    }

    /// Prepares a cross-section for a view, in the slots from `first` on; `finish` gives the number of each
    /// facet's finish. Nothing is kept if none of it lies in the pixel.
    pub(crate) fn prepare(
        &mut self,
        first_slot: u32,
        (xs, zs): (&[f32], &[f32]),
        finish: impl Iterator<Item = u8>,
        across: Vec2,
        weight: Weight,
        view: Vec3,
    ) -> Option<Relief> {
        let vertices = xs.len();
        let first = first_slot as usize;
        let slots = first..first + vertices;
        self.x[slots.clone()].copy_from_slice(xs);
        self.z[slots.clone()].copy_from_slice(zs);
        for (own, number) in self.finish[slots.clone()].iter_mut().zip(finish) {
            *own = number;
        }
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
            first: first_slot,
            vertices: u32::try_from(vertices).unwrap_or(0),
            finish: self.finish[first + vertices / 2],
            gain: 1.0,
            seen_flat,
            weight,
        };
        for k in first..first + vertices - 1 {
            let run = Vec2::new(self.x[k + 1] - self.x[k], self.z[k + 1] - self.z[k]);
            // Scaled up first: facets of nanometres would underflow when squared.
            let unit = (run * 1e6).normalize_or(Vec2::X);
            (self.normal_x[k], self.normal_z[k]) = (-unit.y, unit.x);
            self.weight[k] = self.part_weight(&relief, k, self.seen[k], v.x / v.z);
        }
        self.used = self.used.max(first_slot + relief.vertices);
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

    /// Adds what one relief reflects to each finish's lobe (base BRDF's lobe times cosine, weighed), and
    /// returns the share of the pixel's flat surface that it takes from this light.
    fn reflect(&self, relief: &Relief, pair: &Pair, lobes: &mut [f32; MOST_FINISHES]) -> f32 {
        let pair = pair.turned(relief.across);
        let slots = relief.first as usize..(relief.first + relief.vertices) as usize;
        let (xs, zs) = (&self.x[slots.clone()], &self.z[slots.clone()]);
        let light = Across {
            x: pair.light.x,
            z: pair.light.z,
        };
        let view_slope = pair.view.x / pair.view.z;
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
                let finish = self.finish[slot] as usize;
                let lobe = self.finishes[finish].lobe_cos(normal, &pair);
                lobes[finish] += relief.gain * weight * lobe;
            }
        });
        let lit_flat = light.flat_ends(horizon, relief.seen_flat);
        relief.gain * relief.weight.taken(lit_flat)
    }

    /// What all reliefs reflect (RGB, BRDF times cosine, weighed), and the share of the pixel's flat surface
    /// that they take from this light.
    pub(crate) fn reflect_all(&self, reliefs: &[Relief], pair: &Pair) -> (Vec3, f32) {
        let mut lobes = [0.0; MOST_FINISHES];
        let taken = reliefs
            .iter()
            .map(|relief| self.reflect(relief, pair, &mut lobes))
            .sum();
        let finishes = &self.finishes[..self.finish_count as usize];
        let colour = |(finish, lobe): (&Finish, &f32)| finish.shared(pair) * *lobe;
        (finishes.iter().zip(&lobes).map(colour).sum(), taken)
    }
}

impl Relief {
    pub(crate) const NONE: Self = Self {
        across: Vec2::X,
        first: 0,
        vertices: 0,
        finish: 0,
        gain: 0.0,
        seen_flat: [0.0; 2],
        weight: Weight::NONE,
    };

    /// The share of the pixel that the viewer sees this relief in.
    pub(crate) fn coverage(&self) -> f32 {
        self.gain * self.weight.taken(self.seen_flat)
    }

    /// How well this relief can stand for a scratch across `across` with finish number `finish`: 0 to 1, never 0.
    pub(crate) fn likeness(&self, across: Vec2, finish: u8) -> f32 {
        let alignment = self.across.dot(across).abs().powi(8).max(1e-3);
        if self.finish == finish {
            alignment
        } else {
            1e-3 * alignment
        }
    }
}
