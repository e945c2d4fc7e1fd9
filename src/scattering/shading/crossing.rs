//! Runs of scratch that cross one another, put into a shading point each less what later ones cut away.

use super::Shading;
use super::fill::Share;
use crate::pattern::{
    Covers, Cutting, Hit, Left, NearCrowd, Parts, Pattern, Reach, Region, cut_away,
};
use crate::scattering::footprint::{MOST_PARTS, Steps, Surplus};
use crate::scattering::relief::{MOST_RELIEFS, MOST_SLOTS};
use crate::single;
use arrayvec::ArrayVec;
use core::slice;

/// Scratches up to this share of the footprint's thickness are thin: what later ones take of one is measured on lines along
/// it. So is what they take of any that they cut into more parts.
const THIN: f64 = 0.125;

/// A run that is larger by this share than the first one of the crowd stands alone; in between it does in part.
const FADE: f64 = 0.3;

impl Shading {
    /// Adds runs, each less what later ones cut away; the smallest ones to the crowd where there is no room.
    #[inline(never)]
    pub(super) fn add_crossing<const MOST: usize>(
        &mut self,
        pattern: &Pattern,
        hits: &[Hit<'_>],
        reach: &Reach<'_>,
        crowd: &mut Option<NearCrowd>,
    ) {
        let footprint = reach.footprint;
        let mut covers = Covers::<MOST>::new();
        covers.add(hits, footprint);
        let (crossing, mut cutting) = (covers.crossing(hits, footprint), Cutting::new());
        let thin_mm = THIN * footprint.thickness();
        let mut runs: ArrayVec<(usize, f64), MOST> = ArrayVec::new();
        runs.extend(covers.areas.iter().copied().enumerate());
        runs.sort_by(|a, b| b.1.total_cmp(&a.1));
        let (room, mut taken) = (room(pattern), 0);
        let mut surplus = Surplus::new();
        let full = |&(k, &(i, _)): &(usize, &(usize, f64))| {
            taken += hits[i].most_vertices();
            k == MOST_RELIEFS || taken > room
        };
        let first_of_crowd = runs.iter().enumerate().find(full);
        let first_of_crowd = first_of_crowd.map_or(0.0, |(_, run)| run.1);
        for &(i, area) in &runs {
            let hit = &hits[i];
            let [left, right] = hit.ends_mm;
            // The smallest run that stands alone has no weight there yet: nothing jumps where another takes its place.
            let alone = ((area / first_of_crowd - 1.0) / FADE).clamp(0.0, 1.0);
            let alone = if first_of_crowd > 0.0 { alone } else { 1.0 };
            let gain = single(alone * hit.alone);
            let whole = reach.area_mm2;
            let mut add = |parts: &[Region], left: Option<&Left>| {
                let share = Share {
                    hit,
                    parts,
                    left,
                    gain,
                };
                surplus.is_empty() && self.add_apart(pattern, &share, whole)
                    || self.add_surplus(pattern, &share, whole, &mut surplus)
            };
            crossing.find_cutting(i, &mut cutting);
            let all = slice::from_ref(hit.region(footprint));
            // Most are not cut, and there is nothing to be measured of them.
            let is_whole = alone == 1.0 && cutting.is_empty() && crossing.covers[i].is_some();
            let mut cut = || {
                let mut parts = Parts::new();
                parts.push(all[0]);
                let are_few = cut_away(&mut parts, &cutting, whole) && parts.len() <= MOST_PARTS;
                are_few && add(&parts, None)
            };
            let is_cut = match is_whole {
                true => add(all, None),
                false => alone > 0.0 && right - left > thin_mm && cut(),
            };
            if is_cut && alone == 1.0 {
                continue;
            }
            let left = crossing.left(i, &cutting, whole);
            let may_fit = alone > 0.0 && !is_whole;
            let added = is_cut || (may_fit && add(all, Some(&left)));
            let rest = if added { 1.0 - alone } else { 1.0 };
            if rest > 0.0 && area > 0.0 {
                let crowd = crowd.get_or_insert_with(NearCrowd::new);
                let area_mm2 = rest * area * left.mean * hit.alone;
                pattern.add_run(crowd, hit, reach, area_mm2, &left.across(hit.ends_mm));
            }
        }
        if !surplus.is_empty() {
            self.take_back(&mut surplus);
        }
    }

    /// Adds a share for whose density there is no room: it is kept apart, as are those of all that is held by then.
    #[inline(never)]
    fn add_surplus(
        &mut self,
        pattern: &Pattern,
        share: &Share<'_>,
        area_mm2: f64,
        surplus: &mut Surplus,
    ) -> bool {
        if !self.has_room(share.hit) {
            return false;
        }
        if surplus.is_empty() {
            for relief in self.reliefs() {
                let steps = self.zones.densities.steps(&relief.weight, relief.seen_flat);
                surplus.keep(steps, relief);
            }
        }
        let ends_mm = share.hit.ends_mm.map(single);
        let steps = Steps::of(share.parts, share.left, &share.hit.line, area_mm2, ends_mm);
        self.zones.densities.clear();
        let weight = self.zones.densities.put(&steps);
        if self.hold(pattern, share, weight)
            && let Some(relief) = self.reliefs().last()
        {
            surplus.keep(steps, relief);
        }
        true
    }

    /// Merges densities that were kept apart until there is room for them, and prepares for them all that is held.
    #[inline(never)]
    fn take_back(&mut self, surplus: &mut Surplus) {
        surplus.merge();
        self.zones.densities.clear();
        let reliefs = self.reliefs.iter_mut().take(self.relief_count as usize);
        for (relief, steps) in reliefs.zip(surplus.steps()) {
            let weight = self.zones.densities.put(steps);
            self.zones.prepare_again(relief, weight, self.view);
        }
    }
}

/// Vertices of scratches that may be held one by one: the others are for a crowd.
pub(super) fn room(pattern: &Pattern) -> usize {
    MOST_SLOTS - pattern.palette.vertex_count()
}
