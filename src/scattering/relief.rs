//! The zones of the scratches in one footprint, prepared for one view.

use super::flocks::Flock;
use super::footprint::{Densities, Weight};
use super::visibility::{Across, Part, overlap, sweep};
use super::walk::Ground;
use crate::brdf::{Finish, Pair};
use crate::pattern::{MOST_CLASS_VERTICES, Pattern};
use core::f32::consts::FRAC_1_SQRT_2;
use core::ops::Range;
use glam::{Vec2, Vec3};

/// Scratches that a shading point holds one by one: a short one whose both ends are hard takes seventeen.
pub(crate) const MOST_RELIEFS: usize = 17;

/// Vertices that a shading point holds for all its scratches together.
pub(crate) const MOST_SLOTS: usize = 200;

/// Different finishes that a shading point holds, the surface's among them. Zones of further ones reflect like the last.
pub(crate) const MOST_FINISHES: usize = 8;

/// A shadow at grazing light is followed to this many times the height it falls from (down to 2.9 degrees).
pub(crate) const LONGEST_SHADOW: f32 = 20.0;

/// All zones of one shading point, in flat arrays: facet k of a relief runs from vertex k to k + 1 and
/// has its own values in slot k (the last vertex's slot has none).
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Zones {
    x: [f32; MOST_SLOTS],
    z: [f32; MOST_SLOTS],
    /// Across component of the facet's normal; the upward one follows.
    normal_x: [f32; MOST_SLOTS],
    /// The part that the viewer sees, from and to, in 65535ths.
    seen: [[u16; 2]; MOST_SLOTS],
    /// How much that part weighs in the pixel.
    weight: [f32; MOST_SLOTS],
    /// Which of `finishes` the facet has.
    finish: [u8; MOST_SLOTS],
    finishes: [Finish; MOST_FINISHES],
    /// How much of all light each finish reflects; known once it is asked for.
    albedos: [Vec3; MOST_FINISHES],
    finish_count: u32,
    used: u32,
    pub densities: Densities,
}

/// A facet of a scratch, or the flat surface: what of the pixel it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Zone {
    /// Number of the facet in its scratch; none for the flat surface.
    pub facet: Option<usize>,
    /// In the frame (across, along, up) of its scratch.
    pub normal: Vec3,
    /// Number of its finish.
    pub finish: u8,
    /// The share of the pixel that the viewer sees it in.
    pub seen: f32,
    /// The share in which it is seen and lit.
    pub lit: f32,
}

impl Zone {
    /// The flat surface, seen and lit in this share of the pixel.
    pub(crate) fn flat(share: f32) -> Self {
        Self {
            facet: None,
            normal: Vec3::Z,
            finish: 0,
            seen: share,
            lit: share,
        }
    }
}

/// One scratch in the footprint. Lengths in mm across the scratch, from its centre line.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Relief {
    /// Cross-section axis, to the right of travel, in the local frame.
    pub across: Vec2,
    pub first: u32,
    pub vertices: u32,
    /// How far crowding thins it.
    pub gain: f32,
    /// The share of the pixel that the viewer sees it in (its zones' weights added up), before thinning.
    shown: f32,
    /// What of the pixel's plane the viewer sees through this scratch, from and to.
    pub seen_flat: [f32; 2],
    pub weight: Weight,
}

impl Zones {
    pub(crate) const fn empty() -> Self {
        Self {
            x: [0.0; MOST_SLOTS],
            z: [0.0; MOST_SLOTS],
            normal_x: [0.0; MOST_SLOTS],
            seen: [[0; 2]; MOST_SLOTS],
            weight: [0.0; MOST_SLOTS],
            finish: [0; MOST_SLOTS],
            finishes: [Finish::BLACK; MOST_FINISHES],
            albedos: [Vec3::ZERO; MOST_FINISHES],
            finish_count: 1,
            used: 0,
            densities: Densities::EMPTY,
        }
    }

    /// Forgets all but the surface's finish.
    pub(crate) fn clear(&mut self) {
        self.used = 0;
        self.finish_count = 1;
        self.densities.clear();
    }

    /// The finish of the flat surface, which has number 0.
    pub(crate) fn set_surface(&mut self, finish: Finish) {
        self.finishes[0] = finish;
    }

    /// The number of a finish among those that this point holds.
    pub(crate) fn finish(&mut self, finish: &Finish) -> u8 {
        let held = &self.finishes[..self.finish_count as usize];
        let known = held.iter().position(|other| other == finish);
        let number = known.unwrap_or(held.len().min(MOST_FINISHES - 1));
        if known.is_none() && number == held.len() {
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
        let horizon = sweep(xs, zs, v, |k, part| seen[k] = packed(part));
        let ends = [xs[0], xs[vertices - 1]];
        let seen_flat = v.flat_ends(horizon, ends);
        // A shadow may fall into the pixel from a scratch beside it.
        let shadow = LONGEST_SHADOW * zs.iter().copied().fold(0.0, f32::max);
        let shaded = [seen_flat[0] - shadow, seen_flat[1] + shadow];
        if !self.densities.touches(&weight, shaded) {
            return None;
        }
        let mut relief = Relief {
            across,
            first: first_slot,
            vertices: u32::try_from(vertices).unwrap_or(0),
            gain: 1.0,
            shown: 0.0,
            seen_flat,
            weight,
        };
        for k in first..first + vertices - 1 {
            let run = Vec2::new(self.x[k + 1] - self.x[k], self.z[k + 1] - self.z[k]);
            // Scaled up first: facets of nanometres would underflow when squared.
            self.normal_x[k] = -(run * 1e6).normalize_or(Vec2::X).y;
            self.weight[k] = self.part_weight(&relief, k, unpacked(self.seen[k]), v.x / v.z);
            relief.shown += self.weight[k];
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
        self.densities.between(&relief.weight, from, to).max(0.0)
    }

    /// Visits each zone of a relief that is seen, and returns the share of the pixel's flat surface that it takes from
    /// this light; `pair` is in the relief's frame.
    pub(crate) fn each_of_relief(
        &self,
        relief: &Relief,
        pair: &Pair,
        mut visit: impl FnMut(&Zone),
    ) -> f32 {
        let slots = relief.slots();
        let (xs, zs) = (&self.x[slots.clone()], &self.z[slots]);
        let light = Across::of(pair.light);
        let view_slope = pair.view.x / pair.view.z;
        let horizon = sweep(xs, zs, light, |k, lit| {
            let slot = relief.first as usize + k;
            if self.weight[slot] == 0.0 {
                return;
            }
            let seen = unpacked(self.seen[slot]);
            let both = overlap(seen, lit);
            let weight = if both == seen {
                self.weight[slot]
            } else {
                self.part_weight(relief, slot, both, view_slope)
            };
            visit(&Zone {
                facet: Some(k),
                normal: self.normal(slot),
                finish: self.finish[slot],
                seen: relief.gain * self.weight[slot],
                lit: relief.gain * weight,
            });
        });
        let lit_flat = light.flat_ends(horizon, relief.seen_flat);
        relief.gain * self.densities.taken(&relief.weight, lit_flat)
    }

    /// Visits each zone of a relief that is seen from a direction in the relief's frame, whoever the viewer is.
    pub(crate) fn each_seen_from(&self, relief: &Relief, from: Vec3, mut visit: impl FnMut(&Zone)) {
        let slots = relief.slots();
        let (xs, zs) = (&self.x[slots.clone()], &self.z[slots]);
        sweep(xs, zs, Across::of(from), |k, part| {
            let slot = relief.first as usize + k;
            // Rounded as what the viewer sees is.
            let weight = self.part_weight(relief, slot, unpacked(packed(part)), from.x / from.z);
            if weight > 0.0 {
                let share = relief.gain * weight;
                visit(&Zone {
                    facet: Some(k),
                    normal: self.normal(slot),
                    finish: self.finish[slot],
                    seen: share,
                    lit: share,
                });
            }
        });
    }

    /// As [`Self::each_of_relief`], for a flock: its scratches lie anywhere in the pixel, so that all parts weigh alike.
    pub(crate) fn each_of_flock(
        &self,
        flock: &Flock,
        pair: &Pair,
        mut visit: impl FnMut(&Zone),
    ) -> f32 {
        let (xs, zs) = self.class(flock.slots);
        let [view, light] = [pair.view, pair.light].map(Across::of);
        let view_slope = pair.view.x / pair.view.z;
        let width = |k: usize| (xs[k + 1] - xs[k] - (zs[k + 1] - zs[k]) * view_slope).max(0.0);
        let mut seen = [[0.0; 2]; MOST_CLASS_VERTICES];
        let mut shown = 0.0;
        let horizon = sweep(xs, zs, view, |k, part| {
            seen[k] = part;
            shown += (part[1] - part[0]) * width(k);
        });
        let seen_flat = view.flat_ends(horizon, [-0.5, 0.5]);
        let horizon = sweep(xs, zs, light, |k, lit| {
            let [from, to] = seen[k];
            if from >= to {
                return;
            }
            let both = overlap(seen[k], lit);
            let slot = flock.slots[0] as usize + k;
            visit(&Zone {
                facet: Some(k),
                normal: self.normal(slot),
                finish: self.finish[slot],
                seen: flock.shown * (to - from) * width(k) / shown.max(f32::MIN_POSITIVE),
                lit: flock.share * (both[1] - both[0]).max(0.0) * width(k),
            });
        });
        let [from, to] = light.flat_ends(horizon, seen_flat);
        flock.share * (to - from)
    }

    /// What all zones reflect together, RGB, if this is what each finish's lobes add up to.
    pub(crate) fn colour(&self, lobes: &[f32; MOST_FINISHES], pair: &Pair) -> Vec3 {
        let finishes = &self.finishes[..self.finish_count as usize];
        let colour = |(finish, lobe): (&Finish, &f32)| finish.shared(pair) * *lobe;
        let lit = finishes.iter().zip(lobes).filter(|(_, lobe)| **lobe > 0.0);
        lit.map(colour).sum()
    }

    /// Finds out how much of all light each finish reflects: of what comes at 45 degrees.
    pub(crate) fn measure_albedos(&mut self) {
        let view = Vec3::new(FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
        let finishes = self.finishes.iter().take(self.finish_count as usize);
        for (albedo, finish) in self.albedos.iter_mut().zip(finishes) {
            *albedo = finish.reflectance(Vec3::Z, view);
        }
    }

    /// The albedo of the finish of this number.
    pub(crate) fn albedo_of(&self, number: u8) -> Vec3 {
        self.albedos[number as usize]
    }

    /// A cross-section to walk in; `across` is its first axis.
    pub(crate) fn ground(&self, slots: Range<usize>, across: Vec2) -> Ground<'_> {
        Ground {
            xs: &self.x[slots.clone()],
            zs: &self.z[slots.clone()],
            normal_x: &self.normal_x[slots.clone()],
            finish: &self.finish[slots],
            finishes: &self.finishes,
            across,
        }
    }

    /// Where on a facet of a relief the viewer looks, as a share of the facet; `u` is how far through all that is seen.
    pub(crate) fn seen_place(&self, relief: &Relief, facet: usize, view_slope: f32, u: f32) -> f32 {
        let k = relief.first as usize + facet;
        let shown = |share: f32| {
            let x = self.x[k] + share * (self.x[k + 1] - self.x[k]);
            let z = self.z[k] + share * (self.z[k + 1] - self.z[k]);
            x - z * view_slope
        };
        let [from, to] = unpacked(self.seen[k]);
        let at = self
            .densities
            .place(&relief.weight, [shown(from), shown(to)], u);
        let width = shown(1.0) - shown(0.0);
        if width > 0.0 {
            ((at - shown(0.0)) / width).clamp(from, to)
        } else {
            from
        }
    }

    /// The share of the pixel in which the viewer sees the flat surface between two places beside a relief.
    pub(crate) fn flat_weight(&self, relief: &Relief, [from, to]: [f32; 2]) -> f32 {
        let [left, right] = relief.seen_flat;
        let weight = |part| self.densities.taken(&relief.weight, part);
        relief.gain * (weight([from, to.min(left)]) + weight([from.max(right), to]))
    }

    /// The flat surface that a relief shades from a light but not from the viewer: from and to, and its share of the
    /// pixel.
    pub(crate) fn shadow_of_relief(&self, relief: &Relief, pair: &Pair) -> ([f32; 2], f32) {
        let slots = relief.slots();
        let light = Across::of(pair.light);
        let horizon = sweep(&self.x[slots.clone()], &self.z[slots], light, |_, _| {});
        let shadow = beside(relief.seen_flat, light.flat_ends(horizon, relief.seen_flat));
        (
            shadow,
            relief.gain * self.densities.taken(&relief.weight, shadow),
        )
    }

    /// The same for a flock, whose cross-section is one unit wide.
    pub(crate) fn shadow_of_flock(&self, flock: &Flock, pair: &Pair) -> ([f32; 2], f32) {
        let (xs, zs) = self.class(flock.slots);
        let [view, light] = [pair.view, pair.light].map(Across::of);
        let ends = |w: Across, ends| w.flat_ends(sweep(xs, zs, w, |_, _| {}), ends);
        let seen = ends(view, [-0.5, 0.5]);
        let shadow = beside(seen, ends(light, seen));
        (shadow, flock.share * (shadow[1] - shadow[0]))
    }

    /// All finishes, by number; the first is the flat surface's.
    pub(crate) fn finishes(&self) -> &[Finish] {
        &self.finishes[..self.finish_count as usize]
    }

    /// The finish of this number.
    pub(crate) fn finish_of(&self, number: u8) -> &Finish {
        &self.finishes[number as usize]
    }

    /// Keeps a class's cross-section for flocks: its first slot and how many it takes, if there is room.
    pub(crate) fn keep_class(&mut self, pattern: &Pattern, class: usize) -> Option<[u32; 2]> {
        let palette = &pattern.palette;
        let points = palette.points(class);
        if points.is_empty() {
            return None;
        }
        let first = self.free(points.len())?;
        for (slot, point) in (first as usize..).zip(points) {
            let finish = pattern
                .hosts
                .found(palette.finishes.get(point.finish as usize)?);
            (self.x[slot], self.z[slot]) = (point.x, point.z);
            self.finish[slot] = self.finish(&finish);
        }
        for (slot, pair) in (first as usize..).zip(points.windows(2)) {
            let run = Vec2::new(pair[1].x - pair[0].x, pair[1].z - pair[0].z);
            self.normal_x[slot] = -run.normalize_or(Vec2::X).y;
        }
        let count = u32::try_from(points.len()).unwrap_or(0);
        self.used = first + count;
        Some([first, count])
    }

    /// How wide a flock's cross-section, one unit wide itself, looks to a viewer.
    pub(crate) fn seen_width(&self, slots: [u32; 2], across: Vec2, view: Vec3) -> f32 {
        let (xs, zs) = self.class(slots);
        let view = Across {
            x: view.truncate().dot(across),
            z: view.z,
        };
        let horizon = sweep(xs, zs, view, |_, _| {});
        let [from, to] = view.flat_ends(horizon, [-0.5, 0.5]);
        to - from
    }

    /// A facet's normal, in the frame of its scratch.
    fn normal(&self, slot: usize) -> Vec3 {
        let x = self.normal_x[slot];
        Vec3::new(x, 0.0, (1.0 - x * x).max(0.0).sqrt())
    }

    /// x and z of a class.
    fn class(&self, [first, count]: [u32; 2]) -> (&[f32], &[f32]) {
        let slots = first as usize..(first + count) as usize;
        (&self.x[slots.clone()], &self.z[slots])
    }
}

/// What of `wider` lies to the left of `inner`, or else to the right.
fn beside(inner: [f32; 2], wider: [f32; 2]) -> [f32; 2] {
    if wider[0] < inner[0] {
        [wider[0], inner[0]]
    } else {
        [inner[1], wider[1]]
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn packed(part: Part) -> [u16; 2] {
    part.map(|share| (share * 65535.0 + 0.5) as u16)
}

fn unpacked(part: [u16; 2]) -> Part {
    part.map(|share| f32::from(share) / 65535.0)
}

impl Relief {
    pub(crate) const NONE: Self = Self {
        across: Vec2::X,
        first: 0,
        vertices: 0,
        gain: 0.0,
        shown: 0.0,
        seen_flat: [0.0; 2],
        weight: Weight::NONE,
    };

    /// Where its values are kept.
    pub(crate) fn slots(&self) -> Range<usize> {
        self.first as usize..(self.first + self.vertices) as usize
    }

    /// The share of the pixel that the viewer sees this relief in.
    pub(crate) fn coverage(&self) -> f32 {
        self.gain * self.shown
    }
}
