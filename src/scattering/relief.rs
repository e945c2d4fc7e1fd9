//! The zones of the scratches in one footprint, prepared for one view.

mod prepare;

use super::flocks::Flock;
use super::footprint::{Densities, Weight};
use super::visibility::{Across, horizon, part};
use super::walk::Ground;
use crate::brdf::{Finish, Pair};
use crate::lanes::{Lanes, Number, One, Vector};
use crate::pattern::Pattern;
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

/// Shares are kept as whole numbers up to this.
const WHOLE: f32 = 65535.0;

/// Slots, and room for the register that is read from the last one.
const ROOM: usize = MOST_SLOTS + 8;

/// All zones of one shading point, in flat arrays: facet k of a relief runs from vertex k to k + 1 and
/// has its own values in slot k (the last vertex's slot has none). Flat, so that eight facets are one load.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Zones {
    pub(super) x: [f32; ROOM],
    pub(super) z: [f32; ROOM],
    /// Across component of the facet's normal; the upward one follows.
    pub(super) normal_x: [f32; ROOM],
    /// Where the part that the viewer sees ends, or begins if he looks from the left, in 65535ths; its other end is the
    /// facet's own.
    seen_end: [u16; ROOM],
    /// How much that part weighs in the pixel.
    pub(super) weight: [f32; ROOM],
    /// Which of `finishes` the facet has.
    pub(super) finish: [u8; ROOM],
    pub(super) finishes: [Finish; MOST_FINISHES],
    /// How much of all light each finish reflects; known once it is asked for.
    albedos: [Vec3; MOST_FINISHES],
    finish_count: u16,
    /// How many of them are the host's own.
    hosted_count: u16,
    used: u32,
    pub densities: Densities,
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
    /// The share of the pixel that this is, before thinning.
    pub(super) seen_taken: f32,
    /// Between these slopes of a light nothing of it lies in shadow.
    open: [f32; 2],
    /// The first facet that weighs anything in the pixel, and the one after the last.
    seen_facets: [u8; 2],
    /// 1 if those from the one to the other have one finish.
    is_uniform: u8,
    pub weight: Weight,
}

impl Zones {
    pub(crate) const fn empty() -> Self {
        Self {
            x: [0.0; ROOM],
            z: [0.0; ROOM],
            normal_x: [0.0; ROOM],
            seen_end: [0; ROOM],
            weight: [0.0; ROOM],
            finish: [0; ROOM],
            finishes: [Finish::BLACK; MOST_FINISHES],
            albedos: [Vec3::ZERO; MOST_FINISHES],
            finish_count: 1,
            hosted_count: 0,
            used: 0,
            densities: Densities::EMPTY,
        }
    }

    /// Forgets all; the flat surface has this finish, of number 0.
    #[inline(always)]
    pub(crate) fn begin(&mut self, surface: &Finish) {
        self.finishes[0] = *surface;
        self.used = 0;
        self.finish_count = 1;
        self.hosted_count = surface.hosted().is_some().into();
        self.densities.clear();
    }

    /// Forgets all but the surface's finish.
    pub(crate) fn clear(&mut self) {
        let surface = self.finishes[0];
        self.begin(&surface);
    }

    /// The number of a finish among those that this point holds.
    pub(crate) fn finish(&mut self, finish: &Finish) -> u8 {
        let held = &self.finishes[..self.finish_count as usize];
        let known = held.iter().position(|other| other == finish);
        let number = known.unwrap_or(held.len().min(MOST_FINISHES - 1));
        if known.is_none() && number == held.len() {
            self.finishes[number] = *finish;
            self.finish_count += 1;
            self.hosted_count += u16::from(finish.hosted().is_some());
        }
        u8::try_from(number).unwrap_or(0)
    }

    /// Whether so many vertices more find a place.
    pub(crate) fn has_room(&self, vertices: usize) -> bool {
        self.used as usize + vertices <= MOST_SLOTS
    }

    /// Puts a cross-section of its own into the free slots, with the number of each facet's finish; how many vertices it has.
    pub(crate) fn place_points(&mut self, points: &[[f32; 2]], numbers: &[u8]) -> usize {
        for (slot, (&[x, z], &number)) in (self.used as usize..).zip(points.iter().zip(numbers)) {
            (self.x[slot], self.z[slot], self.finish[slot]) = (x, z, number);
        }
        points.len()
    }

    /// From the left end of facets to their right ends, in x and z.
    #[inline(always)]
    pub(super) fn runs<L: Lanes>(&self, lanes: L, slot: usize) -> [L::F; 2] {
        [
            lanes.load(&self.x[slot + 1..]) - lanes.load(&self.x[slot..]),
            lanes.load(&self.z[slot + 1..]) - lanes.load(&self.z[slot..]),
        ]
    }

    /// The parts of facets that a viewer who looks from the right sees, or one who looks from the left.
    #[inline(always)]
    pub(super) fn seen<L: Lanes>(&self, lanes: L, slot: usize, leftwards: bool) -> [L::F; 2] {
        part(lanes.load_whole(&self.seen_end[slot..]) / WHOLE, leftwards)
    }

    /// How much parts of facets weigh in the pixel: their projection along the view, under the filter.
    #[inline(always)]
    pub(super) fn part_weight<L: Lanes>(
        &self,
        lanes: L,
        relief: &Relief,
        slot: usize,
        [from, to]: [L::F; 2],
        view_slope: f32,
    ) -> L::F {
        let (x, z) = (lanes.load(&self.x[slot..]), lanes.load(&self.z[slot..]));
        let [run_x, run_z] = self.runs(lanes, slot);
        let shown = |share: L::F| x + share * run_x - (z + share * run_z) * view_slope;
        let none = lanes.all(0.0);
        let weight = self
            .densities
            .between(&relief.weight, shown(from), shown(to));
        let weight = weight.max(none);
        to.if_above(from, weight, none)
    }

    /// What all zones reflect together, RGB, if this is what each finish's lobes add up to, for light and view of this cosine
    /// to their half vector.
    #[inline(always)]
    pub(crate) fn colour<L: Lanes>(
        &self,
        lanes: L,
        lobes: &[f32; MOST_FINISHES],
        view_half: f32,
    ) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for (finish, &lobe) in self.finishes().iter().zip(lobes) {
            if lobe > 0.0 {
                sum += Vec3::from(finish.colour_in(lanes, view_half)) * lobe;
            }
        }
        sum
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
        let [from, to] = self.seen(One, k, view_slope >= 0.0);
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
        let horizon = horizon(&self.x[slots.clone()], &self.z[slots], light);
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
        let ends = |w: Across, ends| w.flat_ends(horizon(xs, zs, w), ends);
        let seen = ends(view, [-0.5, 0.5]);
        let shadow = beside(seen, ends(light, seen));
        (shadow, flock.share * (shadow[1] - shadow[0]))
    }

    /// Whether zones have finishes that are the host's own.
    pub(crate) fn has_hosted(&self) -> bool {
        self.hosted_count > 0
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
        let first = self.used;
        if !self.has_room(points.len()) {
            return None;
        }
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
pub(super) fn packed(share: f32) -> u16 {
    scaled_up(share) as u16
}

/// The whole number below this is the share's.
#[inline(always)]
fn scaled_up<F: Number>(share: F) -> F {
    share * WHOLE + 0.5
}

pub(super) fn unpacked(share: u16) -> f32 {
    f32::from(share) / WHOLE
}

impl Relief {
    pub(crate) const NONE: Self = Self {
        across: Vec2::X,
        first: 0,
        vertices: 0,
        gain: 0.0,
        shown: 0.0,
        seen_flat: [0.0; 2],
        seen_taken: 0.0,
        open: [0.0; 2],
        seen_facets: [0; 2],
        is_uniform: 0,
        weight: Weight::NONE,
    };

    /// Whether nothing of it lies in shadow: each facet faces the light.
    #[inline(always)]
    pub(super) fn is_open_to(&self, light: Across) -> bool {
        let [least, most] = self.open.map(|slope| slope * light.z);
        least < light.x && light.x < most
    }

    /// The same for lights side by side: whether it is open to all of them.
    #[inline(always)]
    pub(super) fn is_open_to_all<L: Lanes>(&self, lanes: L, light: &Vector<L::F>) -> bool {
        let (none, one) = (lanes.all(0.0), lanes.all(1.0));
        let [least, most] = self.open.map(|slope| light.z * slope);
        // Also where it is no number.
        let is_shut = light
            .x
            .if_above(least, most.if_above(light.x, none, one), one);
        !is_shut.any()
    }

    /// How many facets it has.
    pub(crate) fn facets(&self) -> usize {
        (self.vertices as usize).saturating_sub(1)
    }

    /// The first facet that weighs anything in the pixel, and the one after the last.
    #[inline(always)]
    pub(super) fn seen_facets(&self) -> [usize; 2] {
        self.seen_facets.map(usize::from)
    }

    /// Whether those from the one to the other have one finish.
    #[inline(always)]
    pub(super) fn is_uniform(&self) -> bool {
        self.is_uniform == 1
    }

    /// Where its values are kept.
    pub(crate) fn slots(&self) -> Range<usize> {
        self.first as usize..(self.first + self.vertices) as usize
    }

    /// The share of the pixel that the viewer sees this relief in.
    pub(crate) fn coverage(&self) -> f32 {
        self.gain * self.shown
    }
}
