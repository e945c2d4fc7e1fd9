//! Several lights of one point side by side, zone after zone; flocks are themselves side by side (`abreast.rs`).
//!
//! The same equations as in `visit.rs`, `eval.rs` and `reverse.rs`, with numbers for zones and registers for lights.

use super::abreast::{Light, Reflected};
use super::eval::{ROUNDING, finite, rest};
use super::many::MOST;
use super::relief::{MOST_FINISHES, MOST_SLOTS, Relief, Zones};
use super::shading::Shading;
use crate::brdf::{ACROSS_SURFACE, Facets, Pair, Pairs};
use crate::lanes::{Lanes, Number, One, Vector};
use arrayvec::ArrayVec;
use core::ops::Range;
use glam::{Vec2, Vec3};

/// What is added up over all zones, for each light.
struct Sums<F> {
    lobes: [F; MOST_FINISHES],
    /// What of the flat surface scratches take from the light.
    taken: F,
    /// How often zones' samples go to the light, where that is asked for.
    density: F,
}

impl<F: Number> Sums<F> {
    /// What flocks add, for as many lights as there are lanes.
    #[inline(always)]
    fn of_flocks<L: Lanes<F = F>>(lanes: L, flocks: &[Reflected<f32>]) -> Self {
        let mut lobes = [lanes.all(0.0); MOST_FINISHES];
        for (finish, lobes) in lobes.iter_mut().enumerate() {
            *lobes = lanes.made(|i| flocks[i].lobes[finish]);
        }
        Self {
            lobes,
            taken: lanes.made(|i| flocks[i].taken),
            density: lanes.made(|i| flocks[i].density),
        }
    }
}

impl Shading {
    /// The same by as many as there are lanes.
    #[inline(always)]
    pub(super) fn reflected_groups<L: Lanes>(
        &self,
        lanes: L,
        lights: &[Vec3; MOST],
        with_pdf: bool,
        found: &mut [Vec3; MOST],
        densities: &mut [f32; MOST],
    ) {
        let mut by_flocks = [Reflected::NONE; MOST];
        if !self.flocks.is_empty() {
            let pairs = lights.map(|light| Pair::new(self.view, light));
            by_flocks = match with_pdf {
                true => self.by_flocks(lanes, &pairs.map(Light::with_density)),
                false => self.by_flocks(lanes, &pairs.map(Light::new)),
            };
        }
        for first in (0..MOST).step_by(L::WIDTH) {
            let (rgb, pdf) = (&mut found[first..], &mut densities[first..]);
            let sums = Sums::of_flocks(lanes, &by_flocks[first..]);
            self.reflected_group(lanes, &lights[first..], with_pdf, sums, rgb, pdf);
        }
    }

    #[inline(always)]
    fn reflected_group<L: Lanes>(
        &self,
        lanes: L,
        lights: &[Vec3],
        with_pdf: bool,
        mut sums: Sums<L::F>,
        found: &mut [Vec3],
        densities: &mut [f32],
    ) {
        let light = Vector {
            x: lanes.made(|i| lights[i].x),
            y: lanes.made(|i| lights[i].y),
            z: lanes.made(|i| lights[i].z),
        };
        let pairs = Pairs::new(self.view, light);
        let below = Pairs::new(
            self.view,
            Vector {
                z: -light.z,
                ..light
            },
        );
        let directions = if with_pdf { Some(&below) } else { None };
        let none = lanes.all(0.0);
        for relief in self.reliefs() {
            self.add_relief(lanes, relief, &pairs, directions, &mut sums);
        }
        let left = lanes
            .all(1.0 - ROUNDING)
            .if_above(sums.taken, -sums.taken + 1.0, none);
        self.add_flat(lanes, left, &pairs, directions, &mut sums);
        let mut rgb = [none; 3];
        for (finish, lobe) in self.zones.finishes().iter().zip(sums.lobes) {
            if lobe.any() {
                let colour = finish.colour(pairs.view_half);
                for (sum, colour) in rgb.iter_mut().zip(colour) {
                    *sum = *sum + colour * lobe;
                }
            }
        }
        for (i, channel) in rgb.into_iter().enumerate() {
            channel.each(|lane, value| {
                found[lane][i] = value;
                value
            });
        }
        for rgb in &mut found[..L::WIDTH] {
            *rgb = finite(*rgb);
        }
        sums.density.each(|lane, density| {
            densities[lane] = self.mean(density);
            density
        });
    }

    #[inline(always)]
    fn add_relief<L: Lanes>(
        &self,
        lanes: L,
        relief: &Relief,
        pairs: &Pairs<L::F>,
        below: Option<&Pairs<L::F>>,
        sums: &mut Sums<L::F>,
    ) {
        let pairs = pairs.turned(relief.across);
        let facets = relief.seen_facets();
        let mut shares = Shares::new();
        self.zones.add_seen(lanes, relief, &mut shares);
        if let Some(below) = all_turned(below, relief.across) {
            for pairs in [&pairs, &below] {
                let local = pairs.local();
                self.zones.each_finish(
                    relief,
                    facets,
                    #[inline(always)]
                    |number, normals, own| {
                        let finish = self.zones.finish_of(number);
                        let facets = Facets {
                            normals,
                            shares: &shares[own],
                        };
                        sums.density = sums.density + finish.seen_pdfs(lanes, &local, facets);
                    },
                );
            }
        }
        // Most lights come from above all slopes: then all that is seen is lit.
        let taken = if relief.is_open_to_all(lanes, &pairs.light) {
            lanes.all(relief.seen_taken)
        } else {
            self.leave_lit(lanes, relief, &pairs, &mut shares)
        };
        sums.taken = sums.taken + taken * relief.gain;
        let local = pairs.local();
        self.zones.each_finish(
            relief,
            facets,
            #[inline(always)]
            |number, normals, own| {
                let finish = self.zones.finish_of(number);
                let facets = Facets {
                    normals,
                    shares: &shares[own],
                };
                let sum = &mut sums.lobes[number as usize];
                *sum = *sum + finish.lit_lobes(lanes, &local, facets);
            },
        );
    }

    /// Makes of the shares of a relief's facets that are seen those that are lit, too; returns how much of the flat surface is
    /// hidden or dark, before thinning.
    #[inline(always)]
    fn leave_lit<L: Lanes>(
        &self,
        lanes: L,
        relief: &Relief,
        pairs: &Pairs<L::F>,
        shares: &mut Shares<L::F>,
    ) -> L::F {
        let zones = &self.zones;
        let (first, facets) = (relief.first as usize, relief.facets());
        let [from, _] = relief.seen_facets();
        let none = lanes.all(0.0);
        let mut taken = none;
        shares.iter_mut().for_each(|share| *share = none);
        for leftwards in [true, false] {
            let mut sweep = Sweep::new(lanes, &pairs.light, leftwards);
            if !sweep.own.any() {
                continue;
            }
            for step in 0..facets {
                let k = sweep.facet(step, facets);
                let slot = first + k;
                let part = sweep.pass(zones.corners(slot));
                if zones.weight[slot] > 0.0 {
                    let lit = self.lit_weight(lanes, relief, slot, part, pairs);
                    let share = &mut shares[k - from];
                    *share = *share + lit * sweep.own * relief.gain;
                }
            }
            let ends = sweep.flat_ends(relief.seen_flat);
            taken = taken + zones.densities.taken(&relief.weight, ends) * sweep.own;
        }
        taken
    }

    /// How much of the pixel the part of a facet is that is seen and lit.
    #[inline(always)]
    fn lit_weight<L: Lanes>(
        &self,
        lanes: L,
        relief: &Relief,
        slot: usize,
        [from, to]: [L::F; 2],
        pairs: &Pairs<L::F>,
    ) -> L::F {
        let (zones, none) = (&self.zones, lanes.all(0.0));
        let width = to - from;
        let hidden = (-width + 1.0).if_above(none, none, lanes.all(zones.weight[slot]));
        let some = width.if_above(none, -width + 1.0, none);
        if !some.any() {
            return hidden;
        }
        let [[x, z], [next_x, next_z]] = zones.corners(slot);
        let (run_x, run_z) = (next_x - x, next_z - z);
        let view_slope = pairs.view.x / pairs.view.z;
        let [seen_from, seen_to] = zones.seen(One, slot, view_slope >= 0.0);
        let (from, to) = (from.max(lanes.all(seen_from)), to.min(lanes.all(seen_to)));
        let a = from * run_x + x - (from * run_z + z) * view_slope;
        let b = to * run_x + x - (to * run_z + z) * view_slope;
        let part = zones.densities.between(&relief.weight, a, b).max(none);
        some.if_above(none, to.if_above(from, part, none), hidden)
    }

    /// Adds the flat surface, lit in these shares of the pixel.
    #[inline(always)]
    fn add_flat<L: Lanes>(
        &self,
        lanes: L,
        lit: L::F,
        pairs: &Pairs<L::F>,
        below: Option<&Pairs<L::F>>,
        sums: &mut Sums<L::F>,
    ) {
        let finish = self.zones.finish_of(0);
        let normals: [&[f32]; 2] = [&[0.0], &[1.0]];
        let turned = pairs.turned(ACROSS_SURFACE).local();
        let shares = &[lit];
        let flat = Facets { normals, shares };
        sums.lobes[0] = sums.lobes[0] + finish.lit_lobes(lanes, &turned, flat);
        let Some(below) = all_turned(below, ACROSS_SURFACE) else {
            return;
        };
        let shares = &[lanes.all(rest(self.coverage()))];
        let flat = Facets { normals, shares };
        for pairs in [&turned, &below.local()] {
            sums.density = sums.density + finish.seen_pdfs(lanes, pairs, flat);
        }
    }
}

#[expect(
    clippy::manual_map,
    reason = "a closure given away is not compiled for its caller's registers"
)]
#[inline(always)]
fn all_turned<F: Number>(pairs: Option<&Pairs<F>>, across: Vec2) -> Option<Pairs<F>> {
    match pairs {
        Some(pairs) => Some(pairs.turned(across)),
        None => None,
    }
}

/// A share of the pixel for each facet of a relief that weighs anything.
type Shares<F> = ArrayVec<F, MOST_SLOTS>;

impl Zones {
    /// The shares that are seen.
    #[inline(always)]
    fn add_seen<L: Lanes>(&self, lanes: L, relief: &Relief, shares: &mut Shares<L::F>) {
        let [from, to] = relief.seen_facets().map(|k| relief.first as usize + k);
        for weight in &self.weight[from..to] {
            shares.push(lanes.all(relief.gain * weight));
        }
    }

    /// Visits facets of a relief, those side by side that have one finish together: its number, their normals' components, and
    /// which of all these facets they are.
    #[inline(always)]
    fn each_finish(
        &self,
        relief: &Relief,
        [from, to]: [usize; 2],
        mut visit: impl FnMut(u8, [&[f32]; 2], Range<usize>),
    ) {
        let first = relief.first as usize;
        let slots = first + from..first + to;
        let xs = &self.normal_x[slots.clone()];
        let mut zs: ArrayVec<f32, MOST_SLOTS> = ArrayVec::new();
        zs.extend(xs.iter().map(|x| (1.0 - x * x).max(0.0).sqrt()));
        let mut next = 0;
        for alike in self.finish[slots].chunk_by(PartialEq::eq) {
            let own = next..next + alike.len();
            next = own.end;
            visit(alike[0], [&xs[own.clone()], &zs[own.clone()]], own);
        }
    }

    /// x and z of a facet's two ends.
    fn corners(&self, slot: usize) -> [[f32; 2]; 2] {
        [slot, slot + 1].map(|slot| [self.x[slot], self.z[slot]])
    }
}

/// A pass over a cross-section for lights that come from one side, as [`Parts::sweep`] does for one light.
struct Sweep<F> {
    leftwards: bool,
    /// 1 for lights that come from this side.
    own: F,
    light: [F; 2],
    horizon: F,
}

impl<F: Number> Sweep<F> {
    /// Seldom do lights that are looked at together come from both sides: then each side is passed for its own.
    #[inline(always)]
    fn new<L: Lanes<F = F>>(lanes: L, light: &Vector<F>, leftwards: bool) -> Self {
        let (none, one) = (lanes.all(0.0), lanes.all(1.0));
        let from_left = none.if_above(light.x, one, none);
        let (own, horizon) = match leftwards {
            true => (-from_left + 1.0, f32::INFINITY),
            false => (from_left, f32::NEG_INFINITY),
        };
        Self {
            leftwards,
            own,
            light: [light.x, light.z],
            horizon: lanes.all(horizon),
        }
    }

    /// The facets in order, from the side that the lights come from.
    #[inline(always)]
    fn facet(&self, step: usize, facets: usize) -> usize {
        if self.leftwards {
            facets - 1 - step
        } else {
            step
        }
    }

    /// Goes on by a facet, and returns its part that is lit.
    #[inline(always)]
    fn pass(&mut self, corners: [[f32; 2]; 2]) -> [F; 2] {
        let [x, z] = self.light;
        let [[x_a, z_a], [x_b, z_b]] = corners;
        let (a, b) = (z * x_a - x * z_a, z * x_b - x * z_b);
        let (left, right) = (x.like(0.0), x.like(1.0));
        let rise = b - a;
        if self.leftwards {
            self.horizon = self.horizon.min(b);
            let share = ((self.horizon - a) / rise).max(left).min(right);
            self.horizon = self.horizon.min(a);
            [left, rise.if_above(left, share, left)]
        } else {
            self.horizon = self.horizon.max(a);
            let share = ((self.horizon - a) / rise).max(left).min(right);
            self.horizon = self.horizon.max(b);
            [rise.if_above(left, share, right), right]
        }
    }

    /// What of the flat surface lies in front of every vertex, once all are passed.
    #[inline(always)]
    fn flat_ends(&self, ends: [f32; 2]) -> [F; 2] {
        let at = self.horizon / self.light[1];
        let (left, right) = (at.like(ends[0]), at.like(ends[1]));
        if self.leftwards {
            [at.min(left), right]
        } else {
            [left, at.max(right)]
        }
    }
}
