//! Several lights of one point side by side, zone after zone; flocks are themselves side by side (`abreast.rs`).
//!
//! The same equations as in `visit.rs`, `eval.rs` and `reverse.rs`, with numbers for zones and registers for lights.

use super::abreast::{Light, Reflected};
use super::eval::{ROUNDING, finite, rest};
use super::many::MOST;
use super::relief::{MOST_FINISHES, Relief, Zones};
use super::shading::Shading;
use crate::brdf::{ACROSS_SURFACE, Pair, Pairs};
use crate::lanes::{Lanes, Number, One, Vector};
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
        let surface = Facet {
            normal: [0.0, 1.0],
            finish: 0,
            seen: rest(self.coverage()),
        };
        let turned = pairs.turned(ACROSS_SURFACE);
        self.add_facet(lanes, &surface, left, &turned, &mut sums);
        let below = all_turned(directions, ACROSS_SURFACE);
        self.add_density(lanes, &surface, &turned, below.as_ref(), &mut sums);
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
        let zones = &self.zones;
        let pairs = pairs.turned(relief.across);
        let below = all_turned(below, relief.across);
        let (first, facets) = (relief.first as usize, relief.facets());
        for slot in first..first + facets {
            let facet = zones.facet(slot, relief.gain * zones.weight[slot]);
            self.add_density(lanes, &facet, &pairs, below.as_ref(), sums);
        }
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
                    let lit = self.lit_weight(lanes, relief, slot, part, &pairs);
                    let facet = zones.facet(slot, 0.0);
                    self.add_facet(lanes, &facet, lit * sweep.own * relief.gain, &pairs, sums);
                }
            }
            let taken = zones
                .densities
                .taken(&relief.weight, sweep.flat_ends(relief.seen_flat));
            sums.taken = sums.taken + taken * sweep.own * relief.gain;
        }
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
        let shown = |share: L::F| share * run_x + x - (share * run_z + z) * view_slope;
        let (a, b) = (shown(from), shown(to));
        let part = zones.densities.between(&relief.weight, a, b).max(none);
        some.if_above(none, to.if_above(from, part, none), hidden)
    }

    /// Adds what a facet reflects, lit in these shares of the pixel.
    #[inline(always)]
    fn add_facet<L: Lanes>(
        &self,
        lanes: L,
        facet: &Facet,
        lit: L::F,
        pairs: &Pairs<L::F>,
        sums: &mut Sums<L::F>,
    ) {
        if lit.any() {
            let finish = self.zones.finish_of(facet.finish);
            let lobe = finish.lobes_cos(lanes, &pairs.tilted(facet.normal));
            let none = lanes.all(0.0);
            let sum = &mut sums.lobes[facet.finish as usize];
            *sum = *sum + lit.if_above(none, lit * lobe, none);
        }
    }

    /// Adds how often a facet's samples go to the lights, where that is asked for.
    #[inline(always)]
    fn add_density<L: Lanes>(
        &self,
        lanes: L,
        facet: &Facet,
        pairs: &Pairs<L::F>,
        below: Option<&Pairs<L::F>>,
        sums: &mut Sums<L::F>,
    ) {
        let Some(below) = below.filter(|_| facet.seen > 0.0) else {
            return;
        };
        let finish = self.zones.finish_of(facet.finish);
        let above = finish.pdfs(lanes, &pairs.tilted(facet.normal));
        let below = finish.pdfs(lanes, &below.tilted(facet.normal));
        sums.density = sums.density + (above + below) * facet.seen;
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

/// A facet of one finish, and how much of it is seen.
struct Facet {
    normal: [f32; 2],
    finish: u8,
    seen: f32,
}

impl Zones {
    fn facet(&self, slot: usize, seen: f32) -> Facet {
        let x = self.normal_x[slot];
        Facet {
            normal: [x, (1.0 - x * x).max(0.0).sqrt()],
            finish: self.finish[slot],
            seen,
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
