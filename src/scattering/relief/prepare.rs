//! A cross-section placed among the zones and prepared for one view: which parts of its facets are seen, and how much of the
//! pixel they are.

use super::{LONGEST_SHADOW, MOST_SLOTS, Relief, WHOLE, Zones, scaled_up};
use crate::lanes::{First, Lanes, Number, first_below_any, in_lanes};
use crate::pattern::{LayerFinish, Layered, MOST_VERTICES, Profile};
use crate::scattering::footprint::Weight;
use crate::scattering::visibility::{Across, Sweep, part};
use glam::{Vec2, Vec3};

impl Zones {
    /// Puts a run's cross-section into the free slots, its facets with the finishes of these numbers, by layer, and prepares
    /// it as [`Self::prepare`] does.
    #[inline(always)]
    pub(crate) fn prepare_run(
        &mut self,
        profile: &Profile<'_>,
        layers: &[LayerFinish],
        numbers: &[u8],
        across: Vec2,
        weight: Weight,
        view: Vec3,
    ) -> Option<Relief> {
        in_lanes!(lanes => {
            let vertices = self.place(lanes, profile, layers, numbers);
            self.prepare_in(lanes, vertices, layers.is_empty(), across, weight, view)
        })
    }

    /// Prepares the cross-section of so many vertices that was placed last for a view. It is kept if any of it lies in
    /// the pixel.
    pub(crate) fn prepare(
        &mut self,
        vertices: usize,
        across: Vec2,
        weight: Weight,
        view: Vec3,
    ) -> Option<Relief> {
        in_lanes!(lanes => self.prepare_in(lanes, vertices, false, across, weight, view))
    }

    /// Prepares what was prepared before for another weight. All that was prepared after it must follow.
    pub(crate) fn prepare_again(&mut self, relief: &mut Relief, weight: Weight, view: Vec3) {
        let own = relief.slots();
        self.used = relief.first;
        relief.weight = weight;
        if let Some(again) = self.prepare(own.len(), relief.across, weight, view) {
            let gain = relief.gain;
            *relief = Relief { gain, ..again };
        }
        self.used = u32::try_from(own.end).unwrap_or(0);
    }

    /// Puts a run's cross-section into the free slots; how many vertices it has.
    #[inline(always)]
    fn place<L: Lanes>(
        &mut self,
        lanes: L,
        profile: &Profile<'_>,
        layers: &[LayerFinish],
        numbers: &[u8],
    ) -> usize {
        let vertices = profile.vertex_count;
        let own = self.used as usize..self.used as usize + vertices;
        let (xs, zs) = (&mut self.x[own.clone()], &mut self.z[own.clone()]);
        profile.sample_in(lanes, xs, zs);
        // Mostly that is all.
        if layers.is_empty() && !has_doubles(lanes, xs, zs) {
            self.finish[own].fill(numbers[0]);
            return vertices;
        }
        self.cut(vertices, layers, numbers)
    }

    /// Cuts a cross-section of so many vertices that was placed by its layers; how many vertices that gives.
    #[inline(never)]
    fn cut(&mut self, vertices: usize, layers: &[LayerFinish], numbers: &[u8]) -> usize {
        let first = self.used as usize;
        let (mut whole_x, mut whole_z) = ([0.0; MOST_VERTICES], [0.0; MOST_VERTICES]);
        let (whole_x, whole_z) = (&mut whole_x[..vertices], &mut whole_z[..vertices]);
        whole_x.copy_from_slice(&self.x[first..first + vertices]);
        whole_z.copy_from_slice(&self.z[first..first + vertices]);
        let free = first..MOST_SLOTS;
        let slots = Layered {
            x: &mut self.x[free.clone()],
            z: &mut self.z[free.clone()],
            layer: &mut self.finish[free.clone()],
        };
        let count = slots.cut(whole_x, whole_z, layers.iter().map(|layer| layer.bottom_mm));
        for finish in &mut self.finish[free][..count] {
            *finish = numbers[*finish as usize];
        }
        count
    }

    /// The same, if all its facets have one finish (`alike`) or perhaps not.
    #[inline(always)]
    fn prepare_in<L: Lanes>(
        &mut self,
        lanes: L,
        vertices: usize,
        alike: bool,
        across: Vec2,
        weight: Weight,
        view: Vec3,
    ) -> Option<Relief> {
        let view = Across {
            x: view.truncate().dot(across),
            z: view.z,
        };
        let first = self.used as usize;
        let mut relief = Relief {
            across,
            first: self.used,
            vertices: u32::try_from(vertices).unwrap_or(0),
            gain: 1.0,
            weight,
            ..Relief::NONE
        };
        let horizon = match view.x >= 0.0 {
            true => self.weigh::<L, true>(lanes, &mut relief, view),
            false => self.weigh::<L, false>(lanes, &mut relief, view),
        };
        let last = first + vertices - 1;
        let [ends, ends_z] = [&self.x, &self.z].map(|of| [of[first], of[last]]);
        let seen_flat = view.flat_ends(horizon, ends);
        if !self.touches(lanes, &relief, seen_flat) {
            return None;
        }
        let [least, most] = clearing(ends, ends_z, seen_flat);
        relief.open = [relief.open[0].max(least), relief.open[1].min(most)];
        relief.seen_flat = seen_flat;
        relief.seen_taken = self.densities.taken(&relief.weight, seen_flat);
        relief.is_uniform = (alike || self.has_one_finish(&relief)).into();
        self.used += relief.vertices;
        Some(relief)
    }

    /// Whether a relief, or its shadow, may touch the pixel.
    #[inline(always)]
    fn touches<L: Lanes>(&self, lanes: L, relief: &Relief, [from, to]: [f32; 2]) -> bool {
        let weight = &relief.weight;
        if self.densities.touches(weight, [from, to]) {
            return true;
        }
        // A shadow may fall into the pixel from a scratch beside it.
        let zs = &self.z[relief.first as usize..];
        let shadow = LONGEST_SHADOW * highest(lanes, zs, relief.vertices as usize);
        self.densities.touches(weight, [from - shadow, to + shadow])
    }

    /// Finds which parts of a relief's facets the viewer sees, their normals, and how much of the pixel they are; how far he
    /// sees past all of them. What is written beyond the last facet means nothing: there is room for it, and who comes next
    /// has its own.
    #[inline(always)]
    fn weigh<L: Lanes, const LEFTWARDS: bool>(
        &mut self,
        lanes: L,
        relief: &mut Relief,
        view: Across,
    ) -> f32 {
        let (first, facets) = (relief.first as usize, relief.facets());
        let (zero, slope) = (lanes.all(0.0), view.x / view.z);
        let mut sweep = Sweep::<LEFTWARDS>::new();
        let (mut least, mut most) = (lanes.all(f32::NEG_INFINITY), lanes.all(f32::INFINITY));
        let (mut shown, mut seen_facets) = (zero, [u32::MAX, 0]);
        let groups = facets.div_ceil(L::WIDTH);
        for group in 0..groups {
            let k = Sweep::<LEFTWARDS>::turn(group, groups) * L::WIDTH;
            // Never more: so that nobody looks whether the arrays have room.
            let slot = (first + k).min(MOST_SLOTS - 1);
            let own = First::of(lanes, facets - k);
            let [x, z] = self.vertices(lanes, slot);
            let [next_x, next_z] = self.vertices(lanes, slot + 1);
            let run = [next_x - x, next_z - z];
            let keys = [view.key(x, z), view.key(next_x, next_z)];
            let end = scaled_up(sweep.ends(lanes, keys, own));
            lanes.store_whole(end, &mut self.seen_end[slot..]);
            let [from, to] = part(end.cut_off() / WHOLE, LEFTWARDS);
            // A part has one end of its facet's.
            let [a, b] = match LEFTWARDS {
                true => [x - z * slope, shown_at([x, z], run, to, slope)],
                false => {
                    let b = (x + run[0]) - (z + run[1]) * slope;
                    [shown_at([x, z], run, from, slope), b]
                }
            };
            let weight = own.below_any(self.densities.between(&relief.weight, a, b));
            let weight = to.if_above(from, weight.max(zero), zero);
            shown = shown + weight;
            widen(&mut seen_facets, k, lanes.above(weight, zero));
            let [falls, rises] = facing(lanes, run);
            least = least.max(own.below_any(falls));
            most = most.min(own.above_any(rises));
            lanes.store(normal_x(lanes, run), &mut self.normal_x[slot..]);
            lanes.store(weight, &mut self.weight[slot..]);
        }
        relief.shown = shown.sum();
        relief.open = [-(-least).least(), most.least()];
        if seen_facets[0] < seen_facets[1] {
            relief.seen_facets = seen_facets.map(|facet| u8::try_from(facet).unwrap_or(0));
        }
        let far = if LEFTWARDS { first } else { first + facets };
        sweep.horizon_with(view.key(self.x[far], self.z[far]))
    }

    /// x and z of as many vertices as there are lanes, from a slot on.
    #[inline(always)]
    fn vertices<L: Lanes>(&self, lanes: L, slot: usize) -> [L::F; 2] {
        [lanes.load(&self.x[slot..]), lanes.load(&self.z[slot..])]
    }

    /// Whether those of its facets that weigh anything do, if any does.
    #[inline(always)]
    fn has_one_finish(&self, relief: &Relief) -> bool {
        let [from, to] = relief.seen_facets();
        let first = relief.first as usize;
        let finishes = &self.finish[first + from..first + to];
        finishes.windows(2).all(|pair| pair[0] == pair[1])
    }
}

/// Where on the plane a viewer at this slope sees a place of facets, told as a share of their runs.
#[inline(always)]
fn shown_at<F: Number>([x, z]: [F; 2], [run_x, run_z]: [F; 2], share: F, slope: f32) -> F {
    x + share * run_x - (z + share * run_z) * slope
}

/// Makes a range of facets hold those that bits from number `k` on stand for.
#[inline(always)]
fn widen([from, to]: &mut [u32; 2], k: usize, bits: u32) {
    if bits != 0 {
        let k = u32::try_from(k).unwrap_or(0);
        *from = (*from).min(k + bits.trailing_zeros());
        *to = (*to).max(k + u32::BITS - bits.leading_zeros());
    }
}

/// The across components of the normals of facets with these runs, from their left to their right ends.
#[inline(always)]
fn normal_x<L: Lanes>(lanes: L, run: [L::F; 2]) -> L::F {
    // Scaled up first: facets of nanometres would underflow when squared.
    let [x, z] = [run[0] * 1e6, run[1] * 1e6];
    let length = (x * x + z * z).sqrt();
    let zero = lanes.all(0.0);
    let normal_x = length.if_above(zero, -z / length, zero);
    // Absurdly large ones have no direction.
    lanes.all(f32::MAX).if_above(length, normal_x, zero)
}

/// Whether any vertex lies where the one before it does.
#[inline(always)]
fn has_doubles<L: Lanes>(lanes: L, xs: &[f32], zs: &[f32]) -> bool {
    let Some(facets) = xs.len().checked_sub(1).filter(|facets| *facets >= L::WIDTH) else {
        return Layered::has_doubles(xs, zs);
    };
    let mut k = 0;
    while k < facets {
        // The last ones once more, so that none beyond them are looked at.
        let first = k.min(facets - L::WIDTH);
        let x = lanes.load(&xs[first + 1..]) - lanes.load(&xs[first..]);
        let z = lanes.load(&zs[first + 1..]) - lanes.load(&zs[first..]);
        let all = (1 << L::WIDTH) - 1;
        if lanes.above(x.max(-x) + z.max(-z), lanes.all(0.0)) != all {
            return true;
        }
        k += L::WIDTH;
    }
    false
}

/// The highest of the first `count` heights, or 0 if all are below. As many are read as there are lanes.
#[inline(always)]
fn highest<L: Lanes>(lanes: L, heights: &[f32], count: usize) -> f32 {
    let mut most = lanes.all(0.0);
    for k in (0..count).step_by(L::WIDTH) {
        let own = first_below_any(lanes, count - k, lanes.load(&heights[k..]));
        most = own.max(most);
    }
    -(-most).least()
}

/// Between which slopes of a light facets with these runs, from their left to their right ends, face it.
#[inline(always)]
fn facing<L: Lanes>(lanes: L, [x, z]: [L::F; 2]) -> [L::F; 2] {
    let (none, any) = (lanes.all(0.0), lanes.all(f32::INFINITY));
    let slope = x / z;
    [none.if_above(z, slope, -any), z.if_above(none, slope, any)]
}

/// Between which slopes of a light the ends of a cross-section, if they stand up, shade none of the plane that is seen.
fn clearing(xs: [f32; 2], zs: [f32; 2], seen_flat: [f32; 2]) -> [f32; 2] {
    let slope = |end: usize, any: f32| match zs[end] {
        z if z > 0.0 => (xs[end] - seen_flat[end]) / z,
        _ => any,
    };
    [slope(1, f32::NEG_INFINITY), slope(0, f32::INFINITY)]
}
