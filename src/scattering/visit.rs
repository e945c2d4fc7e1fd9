//! The zones of a prepared point, one by one or eight at a time, as one light falls on them.

use super::flocks::{Flock, Over};
use super::relief::{Relief, Zones, packed, unpacked};
use super::visibility::{Across, Part, Parts};
use crate::brdf::Pair;
use crate::lanes::{Lanes, Number, One, first_of};
use glam::Vec3;

/// A facet of a scratch, or the flat surface: what of the pixel it is. Or several facets of one finish side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Zone<F = f32> {
    /// Number of the (first) facet in its scratch; none for the flat surface.
    pub facet: Option<usize>,
    /// Across and upward components of the normal, in the frame (across, along, up) of its scratch.
    pub normal: [F; 2],
    /// Number of its finish.
    pub finish: u8,
    /// The share of the pixel that the viewer sees it in.
    pub seen: F,
    /// The share in which it is seen and lit.
    pub lit: F,
}

impl Zone {
    /// The flat surface, seen and lit in these shares of the pixel.
    pub(crate) fn flat(seen: f32, lit: f32) -> Self {
        Self {
            facet: None,
            normal: [0.0, 1.0],
            finish: 0,
            seen,
            lit,
        }
    }

    pub(crate) fn normal(&self) -> Vec3 {
        Vec3::new(self.normal[0], 0.0, self.normal[1])
    }
}

impl Zones {
    /// Visits each zone of a relief that is seen, and returns the share of the pixel's flat surface that it takes from
    /// this light; `pair` is in the relief's frame.
    #[inline(always)]
    pub(crate) fn each_of_relief<L: Lanes>(
        &self,
        lanes: L,
        relief: &Relief,
        pair: &Pair,
        mut visit: impl FnMut(&Zone<L::F>),
    ) -> f32 {
        let taken = if relief.is_open_to(Across::of(pair.light)) {
            self.each_lit(lanes, relief, &mut visit);
            relief.seen_taken
        } else {
            lanes.call(
                #[inline(always)]
                || self.each_in_shadow(lanes, relief, pair, &mut visit),
            )
        };
        relief.gain * taken
    }

    /// Most lights come from above all slopes, so that all that is seen is lit.
    #[inline(always)]
    fn each_lit<L: Lanes>(&self, lanes: L, relief: &Relief, visit: &mut impl FnMut(&Zone<L::F>)) {
        let first = relief.first as usize;
        self.each_weight(
            lanes,
            relief,
            #[inline(always)]
            |k, left, weight| {
                let seen = weight * relief.gain;
                let places = [first + k, k, left];
                self.by_finish(lanes, relief.is_uniform(), places, [seen, seen], visit);
            },
        );
    }

    /// Finds what shadows leave; returns how much of the flat surface is hidden or dark, before thinning.
    #[inline(always)]
    fn each_in_shadow<L: Lanes>(
        &self,
        lanes: L,
        relief: &Relief,
        pair: &Pair,
        visit: &mut impl FnMut(&Zone<L::F>),
    ) -> f32 {
        let first = relief.first as usize;
        let light = Across::of(pair.light);
        let view_slope = pair.view.x / pair.view.z;
        let mut parts = Parts::new();
        let (xs, zs) = (&self.x[first..], &self.z[first..]);
        let horizon = parts.sweep(lanes, xs, zs, relief.facets(), light);
        self.each_weight(
            lanes,
            relief,
            #[inline(always)]
            |k, left, weight| {
                let part = parts.load(lanes, k);
                let lit = self.lit_weight(lanes, relief, first + k, part, weight, view_slope);
                let shares = [weight * relief.gain, lit * relief.gain];
                let places = [first + k, k, left];
                self.by_finish(lanes, relief.is_uniform(), places, shares, visit);
            },
        );
        let lit_flat = light.flat_ends(horizon, relief.seen_flat);
        self.densities.taken(&relief.weight, lit_flat)
    }

    /// Goes through what facets of a relief weigh, as many at a time as there are lanes: the first one's number, how many are
    /// left from there on, and their weights.
    #[inline(always)]
    fn each_weight<L: Lanes>(
        &self,
        lanes: L,
        relief: &Relief,
        mut visit: impl FnMut(usize, usize, L::F),
    ) {
        let first = relief.first as usize;
        let [mut k, end] = relief.seen_facets();
        while k < end {
            let weight = lanes.load(&self.weight[first + k..]);
            visit(k, end - k, first_of(lanes, end - k, weight));
            k += L::WIDTH;
        }
    }

    /// How much facets weigh where they are both lit and seen: these parts of them are lit, and what is seen weighs so much.
    #[inline(always)]
    fn lit_weight<L: Lanes>(
        &self,
        lanes: L,
        relief: &Relief,
        slot: usize,
        [from, to]: [L::F; 2],
        weight: L::F,
        view_slope: f32,
    ) -> L::F {
        let (none, width) = (lanes.all(0.0), to - from);
        let lit = (width - 1.0).if_above(lanes.all(-f32::MIN_POSITIVE), weight, none);
        let some = weight.if_above(none, width.if_above(none, -width + 1.0, none), none);
        if !some.any() {
            return lit;
        }
        let [seen_from, seen_to] = self.seen(lanes, slot, view_slope >= 0.0);
        let both = [from.max(seen_from), to.min(seen_to)];
        let part = self.part_weight(lanes, relief, slot, both, view_slope);
        some.if_above(none, part, lit)
    }

    /// Visits facets of which `shares` are seen and lit, those of one finish at a time, unless all have the same: of `left` at
    /// most, from number `facet` on, which has this slot.
    #[inline(always)]
    fn by_finish<L: Lanes>(
        &self,
        lanes: L,
        is_uniform: bool,
        [slot, facet, left]: [usize; 3],
        [seen, lit]: [L::F; 2],
        visit: &mut impl FnMut(&Zone<L::F>),
    ) {
        let numbers = &self.finish[slot..slot + L::WIDTH.min(left)];
        let alike = L::WIDTH == 1 || is_uniform;
        let x = lanes.load(&self.normal_x[slot..]);
        let normal = [x, (-(x * x) + 1.0).max(lanes.all(0.0)).sqrt()];
        let mut next = Some(0);
        while let Some(first) = next {
            let finish = numbers[first];
            let mut zone = Zone {
                facet: Some(facet),
                normal,
                finish,
                seen,
                lit,
            };
            next = None;
            if !alike {
                let own = lanes.made(|i| f32::from(u8::from(numbers.get(i) == Some(&finish))));
                let none = lanes.all(0.0);
                zone.seen = own.if_above(none, seen, none);
                zone.lit = own.if_above(none, lit, none);
                let is_new = |i: &usize| !numbers[..*i].contains(&numbers[*i]);
                next = (first + 1..numbers.len()).find(is_new);
            }
            visit(&zone);
        }
    }

    /// The zone of a relief in which this share of all that the viewer sees of it falls.
    #[inline(always)]
    pub(crate) fn seen_at(&self, relief: &Relief, mut share: f32) -> Zone {
        let [from, to] = relief.seen_facets();
        let (mut facet, mut seen) = (from, 0.0);
        let first = relief.first as usize;
        for (k, &weight) in (from..to).zip(&self.weight[first + from..first + to]) {
            let own = relief.gain * weight;
            if own > 0.0 {
                (facet, seen) = (k, own);
                if share < own {
                    break;
                }
                share -= own;
            }
        }
        let slot = first + facet;
        let x = self.normal_x[slot];
        Zone {
            facet: Some(facet),
            normal: [x, (1.0 - x * x).max(0.0).sqrt()],
            finish: self.finish[slot],
            seen,
            lit: seen,
        }
    }

    /// Visits each zone of a relief that is seen from a direction in the relief's frame, whoever the viewer is.
    pub(crate) fn each_seen_from(&self, relief: &Relief, from: Vec3, mut visit: impl FnMut(&Zone)) {
        let (first, facets) = (relief.first as usize, relief.facets());
        let mut parts = Parts::new();
        let (xs, zs) = (&self.x[first..], &self.z[first..]);
        parts.sweep(One, xs, zs, facets, Across::of(from));
        for k in 0..facets {
            // Rounded as what the viewer sees is.
            let part = parts.of(k).map(|end| unpacked(packed(end)));
            let weight = self.part_weight(One, relief, first + k, part, from.x / from.z);
            if weight > 0.0 {
                let share = relief.gain * weight;
                self.by_finish(One, true, [first + k, k, 1], [share; 2], &mut visit);
            }
        }
    }

    /// As [`Self::each_of_relief`], for a flock: its scratches lie anywhere in the pixel, so that all parts of a strip weigh
    /// alike.
    pub(crate) fn each_of_flock(
        &self,
        [seen, lit]: &mut [Parts; 2],
        flock: &Flock,
        pair: &Pair,
        mut visit: impl FnMut(&Zone),
    ) -> f32 {
        let [first, count] = flock.slots.map(|slot| slot as usize);
        let facets = count.saturating_sub(1);
        let (xs, zs) = (&self.x[first..], &self.z[first..]);
        let [view, light] = [pair.view, pair.light].map(Across::of);
        let view_slope = pair.view.x / pair.view.z;
        let width = |k: usize, [from, to]: Part| {
            let [run_x, run_z] = self.runs(One, first + k);
            (to - from).max(0.0) * (run_x - run_z * view_slope).max(0.0)
        };
        let horizon = seen.sweep(One, xs, zs, facets, view);
        let seen_flat = view.flat_ends(horizon, [-0.5, 0.5]);
        let share = |k: usize| flock.share_over(&Over::of([xs[k], xs[k + 1]]));
        let (mut all, mut covered) = (0.0, 0.0);
        for k in 0..facets {
            let seen = width(k, seen.of(k));
            all += seen;
            covered += seen * share(k);
        }
        let shown = flock.shown / covered.max(f32::MIN_POSITIVE);
        let horizon = lit.sweep(One, xs, zs, facets, light);
        for k in 0..facets {
            let [seen, lit] = [seen.of(k), lit.of(k)];
            let both = [seen[0].max(lit[0]), seen[1].min(lit[1])];
            let seen = width(k, seen);
            if seen > 0.0 {
                let share = share(k);
                let shares = [seen * share * shown, width(k, both) * share];
                self.by_finish(One, true, [first + k, k, 1], shares, &mut visit);
            }
        }
        let [from, to] = light.flat_ends(horizon, seen_flat);
        // Where its ends stand up, facets look wider or narrower together than what they hide.
        let width = seen_flat[1] - seen_flat[0];
        let hidden = width / all.max(f32::MIN_POSITIVE) * covered;
        hidden + flock.share * (to - from - width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{CenterLine, Region};
    use glam::{DVec2, Vec2};
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// A scratch with walls on either side, whose ends may stand up, in a pixel that holds all of it or a part.
    fn scratch(random: &mut StdRng, view: Vec3) -> Option<(Zones, Relief)> {
        let mut zones = Zones::empty();
        let steepness = random.random_range(0.0..1.0);
        let mut points: Vec<[f32; 2]> = (0..random.random_range(2..=30))
            .map(|k| [k as f32 * 0.1, random.random_range(-0.1..0.05) * steepness])
            .collect();
        if random.random() {
            (points[0][1], points.last_mut()?[1]) = (0.0, 0.0);
        }
        let pixel = Region::parallelogram(
            DVec2::new(random.random_range(0.1..3.0), 0.0),
            DVec2::new(0.1, 1.0),
        );
        let origin = DVec2::new(random.random_range(-3.0..1.0), 0.0);
        let densities = &mut zones.densities;
        let line = CenterLine::even(origin, DVec2::Y);
        let weight = densities.add_regions(&[pixel], &line, pixel.area())?;
        let vertices = zones.place_points(&points, &vec![0; points.len()]);
        let relief = zones.prepare(vertices, Vec2::X, weight, view)?;
        Some((zones, relief))
    }

    fn across(slope: f32) -> Vec3 {
        Vec3::new(slope, 0.0, 1.0).normalize()
    }

    /// To a light from above all slopes nothing lies in shadow: looking for shadows finds none, on facets or beside the
    /// scratch, right up to the slope from which on there are some.
    #[test]
    fn open_scratches_have_no_shadow() {
        let mut random = StdRng::seed_from_u64(3);
        let (mut open, mut shut) = (0, 0);
        for _ in 0..4000 {
            let view = across(random.random_range(-3.0..3.0));
            let Some((zones, relief)) = scratch(&mut random, view) else {
                continue;
            };
            let pair = Pair::new(view, across(random.random_range(-4.0..4.0)));
            let (mut lit, mut found) = (Vec::new(), Vec::new());
            zones.each_lit(One, &relief, &mut |zone| lit.push((zone.facet, zone.lit)));
            let taken = zones.each_in_shadow(One, &relief, &pair, &mut |zone| {
                found.push((zone.facet, zone.lit));
            });
            let differs = |(a, b): (&(_, f32), &(_, f32))| (a.1 - b.1).abs() > 1e-5;
            let in_shadow = (taken - relief.seen_taken).abs() > 1e-5
                || lit.len() != found.len()
                || lit.iter().zip(&found).any(differs);
            if relief.is_open_to(Across::of(pair.light)) {
                assert!(
                    !in_shadow,
                    "{relief:?}, {pair:?}: {lit:?} against {found:?}"
                );
                open += 1;
            } else {
                shut += u32::from(in_shadow);
            }
        }
        assert!(open > 300 && shut > 300, "{open} open, {shut} in shadow");
    }
}
