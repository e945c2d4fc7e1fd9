//! What a footprint holds, put into a shading point: scratches one by one, or as a crowd.

use super::Shading;
use crate::formation::MOST_LAYERS;
use crate::pattern::{
    Candidates, Covers, Crossing, Crowd, Cutting, Hit, Left, MOST_BOXES, NearCrowd, Parts, Pattern,
    Reach, Region, cut_away,
};
use crate::scattering::eval::rest;
use crate::scattering::flocks::{Flock, MOST_FLOCKS};
use crate::scattering::relief::{MOST_RELIEFS, MOST_SLOTS, Relief};
use crate::single;
use arrayvec::ArrayVec;
use core::ops::ControlFlow;
use core::slice;
use glam::DVec2;

/// Parts that crossings may cut a run's share of the pixel into.
const MOST_PARTS: usize = 8;

/// Scratches that a footprint may hold for each to be looked at by itself.
const MOST_ALONE: usize = 48;

/// Runs of scratch that are looked at one by one: more than are held, for later ones cut earlier ones away.
const MOST_HITS: usize = MOST_BOXES;

/// Most pixels have no more than so many. Room for all would be 160 KB of stack, which takes longer to be touched
/// than a scratch to be shaded.
const FEW_HITS: usize = 12;

/// Scratches up to this share of the footprint's thickness are thin: what later ones take of one is measured on lines along
/// it. So is what they take of any that they cut into more parts.
const THIN: f64 = 0.125;

/// Beside many others the caps of scratches up to this share of it count as a crowd: all of it from twice so many pieces on,
/// none up to so many.
const THIN_CAPS: f64 = 0.0625;
const FEW_PIECES: f64 = 4.0;

/// A run that is larger by this share than the first one of the crowd stands alone; in between it does in part.
const FADE: f64 = 0.3;

impl Shading {
    /// Adds all that the footprint holds; of too many to be looked at one by one there are no candidates.
    pub(super) fn fill(
        &mut self,
        pattern: &Pattern,
        reach: &Reach<'_>,
        candidates: Option<&mut Candidates>,
    ) {
        match candidates {
            Some(few) if few.len() == 1 && self.add_only(pattern, few[0], reach) => {}
            Some(few)
                if few.len() <= FEW_HITS
                    && self.add_each::<FEW_HITS>(pattern, few, reach, FEW_HITS) => {}
            Some(many) => self.add_many(pattern, many, reach),
            None => self.add_wide_crowd(pattern, reach),
        }
        self.share_out();
    }

    /// Adds a single piece, if it is one run and no more, as most are: then nothing cuts it, and it need not be kept.
    #[inline(never)]
    fn add_only(&mut self, pattern: &Pattern, piece: u32, reach: &Reach<'_>) -> bool {
        let Some(hit) = pattern.only_run(piece as usize, reach) else {
            return false;
        };
        let parts = slice::from_ref(hit.region(reach.footprint));
        let added = self.add(pattern, &hit, parts, None, 1.0, reach.area_mm2);
        self.scratch_count = u32::from(added.is_some() && !hit.is_beside(reach.footprint));
        added.is_some()
    }

    /// Adds more pieces than a few: as a crowd, unless they turn out to be of few scratches. Those that only shade the
    /// pixel are no part of a crowd.
    fn add_many(&mut self, pattern: &Pattern, candidates: &mut Candidates, reach: &Reach<'_>) {
        self.clear();
        let may_crowd = pattern.scratches_of(candidates) > MOST_ALONE;
        if may_crowd && self.add_as_near_crowd(pattern, candidates, reach, MOST_ALONE + 1) {
            return;
        }
        if !self.add_each::<MOST_HITS>(pattern, candidates, reach, MOST_HITS / 4) {
            self.add_as_near_crowd(pattern, candidates, reach, 0);
        }
    }

    /// Adds pieces as a crowd, if they are of so many scratches at least; apart, for crowds take much of the stack.
    #[inline(never)]
    fn add_as_near_crowd(
        &mut self,
        pattern: &Pattern,
        candidates: &Candidates,
        reach: &Reach<'_>,
        least: usize,
    ) -> bool {
        let crowd = pattern.crowd_of(reach, candidates, least);
        // By its address: it is large.
        if let Some(crowd) = &crowd {
            self.add_as_crowd(pattern, crowd, reach);
        }
        crowd.is_some()
    }

    #[inline(never)]
    fn add_wide_crowd(&mut self, pattern: &Pattern, reach: &Reach<'_>) {
        self.add_as_crowd(pattern, &pattern.crowd(reach), reach);
    }

    fn add_as_crowd<const BY: usize>(
        &mut self,
        pattern: &Pattern,
        crowd: &Crowd<BY>,
        reach: &Reach<'_>,
    ) {
        self.clear();
        self.add_crowd(pattern, crowd, reach);
        self.scratch_count = crowd.count;
    }

    /// Adds each run by itself, less what later ones cut away; the smallest ones as a crowd where there is no room.
    /// False if there are more than `MOST` to be looked at, or a crowd finds no room: then some may have been added.
    /// Of what only shades the pixel no more than `most_beside` count, not to crowd out what it holds.
    #[inline(never)]
    fn add_each<const MOST: usize>(
        &mut self,
        pattern: &Pattern,
        candidates: &Candidates,
        reach: &Reach<'_>,
        most_beside: usize,
    ) -> bool {
        let mut hits: ArrayVec<Hit<'_>, MOST> = ArrayVec::new();
        let (mut all, mut beside) = (true, 0);
        let many = (candidates.len() as f64 / FEW_PIECES - 1.0).clamp(0.0, 1.0);
        let thin_caps_mm = match many > 0.0 {
            true => THIN_CAPS * many * reach.footprint.thickness(),
            false => 0.0,
        };
        let mut last = None;
        let thin_caps = pattern.for_each_run(candidates, reach, thin_caps_mm, &mut |hit| {
            let is_beside = hit.is_beside(reach.footprint);
            beside += usize::from(is_beside);
            if !is_beside {
                self.scratch_count += u32::from(last != Some(hit.scratch));
                last = Some(hit.scratch);
            }
            if !is_beside || beside <= most_beside {
                // Copied once: it is large.
                let added = hits.try_extend_from_slice(slice::from_ref(hit));
                all = added.is_ok();
            }
            if all {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        if !all {
            return false;
        }
        let mut crowd = None;
        if thin_caps {
            pattern.add_thin_caps(&mut crowd, candidates, reach, thin_caps_mm);
        }
        // There is nothing to be cut, and room.
        let is_plain = || beside == 0 && crowd.is_none() && fit(pattern, &hits);
        let apart = hits.len() < 2 || is_plain() && Crossing::are_apart(&hits, reach.footprint);
        if !(apart && self.add_whole(pattern, &hits, reach)) {
            self.add_crossing::<MOST>(pattern, &hits, reach, &mut crowd);
        }
        // By its address: it is large.
        let crowd = crowd.as_ref();
        crowd.is_none_or(|crowd| self.add_crowd(pattern, crowd, reach))
    }

    /// Adds runs of which none cuts another; false, with none added, if there is no room.
    fn add_whole(&mut self, pattern: &Pattern, hits: &[Hit<'_>], reach: &Reach<'_>) -> bool {
        let count = self.scratch_count;
        let mut hits = hits.iter();
        let all = hits.all(|hit| {
            let parts = slice::from_ref(hit.region(reach.footprint));
            self.add_parts(pattern, hit, parts, None, single(hit.alone), reach)
        });
        if !all {
            self.clear();
            self.scratch_count = count;
        }
        all
    }

    /// Adds runs, each less what later ones cut away; the smallest ones to the crowd where there is no room.
    #[inline(never)]
    fn add_crossing<const MOST: usize>(
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
                self.add_parts(pattern, hit, parts, left, gain, reach)
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
    }

    /// The same as [`Self::add`], apart; whether there is room.
    #[inline(never)]
    fn add_parts(
        &mut self,
        pattern: &Pattern,
        hit: &Hit<'_>,
        parts: &[Region],
        left: Option<&Left>,
        gain: f32,
        reach: &Reach<'_>,
    ) -> bool {
        let added = self.add(pattern, hit, parts, left, gain, reach.area_mm2);
        added.is_some()
    }

    /// Adds what is `left` of a run (or all), of these `parts` of a footprint of so many mm², thinned by `gain`; nothing if
    /// there is no room.
    #[inline(always)]
    fn add(
        &mut self,
        pattern: &Pattern,
        hit: &Hit<'_>,
        parts: &[Region],
        left: Option<&Left>,
        gain: f32,
        area_mm2: f64,
    ) -> Option<()> {
        if self.relief_count as usize == MOST_RELIEFS || !self.zones.has_room(hit.most_vertices()) {
            return None;
        }
        let densities = &mut self.zones.densities;
        let weight = densities.add_left(parts, left, &hit.line, area_mm2)?;
        let mut number = |finish| self.zones.finish(&pattern.hosts.found(finish));
        let (mut numbers, layers) = ([0; MOST_LAYERS + 1], hit.track.layers());
        for (own, layer) in numbers.iter_mut().zip(layers) {
            *own = number(&layer.finish);
        }
        numbers[layers.len().min(MOST_LAYERS)] = number(hit.track.bulk());
        let (profile, across) = (&hit.profile, hit.line.across().as_vec2());
        let zones = &mut self.zones;
        let prepared = zones.prepare_run(profile, layers, &numbers, across, weight, self.view);
        if let Some(mut relief) = prepared {
            relief.gain = gain;
            self.reliefs[self.relief_count as usize] = relief;
            self.relief_count += 1;
        }
        Some(())
    }

    /// Adds scratches by cross-section and direction; false if there is no room for one of the cross-sections.
    #[inline(never)]
    fn add_crowd<const BY: usize>(
        &mut self,
        pattern: &Pattern,
        crowd: &Crowd<BY>,
        reach: &Reach<'_>,
    ) -> bool {
        let fits = |coarser: &usize| crowd.flock_count(*coarser) <= MOST_FLOCKS;
        let coarser = [1, 2, 4, 8, 16].into_iter().find(fits).unwrap_or(32);
        let mut class = None;
        for flock in crowd.flocks(coarser) {
            let known = class.filter(|(class, _)| *class == flock.class);
            let keep = || Some((flock.class, self.zones.keep_class(pattern, flock.class)?));
            class = known.or_else(keep);
            let Some((_, slots)) = class else {
                return false;
            };
            let travel = reach.metric.to_mm * (flock.travel / pattern.units_per_uv);
            let length = travel.length();
            let across = DVec2::new(travel.y, -travel.x) / length;
            let area_mm2 = flock.area_mm2 * length / pattern.mm_per_scene_unit;
            let share = single(area_mm2 / reach.area_mm2);
            self.flocks.push(&Flock {
                across: across.as_vec2(),
                slots,
                share,
                strips: flock.strips.map(|strip| strip * share),
                shown: 0.0,
            });
        }
        true
    }

    /// Where scratches crowd, their shares are scaled to fill the pixel and no more.
    pub(in crate::scattering) fn share_out(&mut self) {
        let [crowd, shares] = self.seen_of_flocks(self.view);
        let reliefs = &mut self.reliefs[..self.relief_count as usize];
        let all = crowd + reliefs.iter().map(Relief::coverage).sum::<f32>();
        // What a damaged file holds may overflow: such a point is an unscratched one.
        if !all.is_finite() {
            return self.clear();
        }
        // One scratch crowds none: in a whole pixel its relief may stand beyond the pixel's edges, and counts.
        let alone = reliefs.len() == 1 && crowd == 0.0;
        self.crowding = if alone { 1.0 } else { all.max(1.0) };
        if self.crowding > 1.0 {
            reliefs.iter_mut().for_each(|relief| relief.gain /= all);
            self.flocks.scale(1.0 / all);
        }
        self.flocks.set_seen(crowd, shares);
        // An empty sum is -0.
        self.coverage = (0.0 + all).clamp(0.0, 1.0);
        self.seen = all / self.crowding + rest(self.coverage);
    }
}

/// Whether all of these runs may be held one by one.
fn fit(pattern: &Pattern, hits: &[Hit<'_>]) -> bool {
    let vertices: usize = hits.iter().map(Hit::most_vertices).sum();
    hits.len() <= MOST_RELIEFS && vertices <= room(pattern)
}

/// Vertices of scratches that may be held one by one: the others are for a crowd.
fn room(pattern: &Pattern) -> usize {
    MOST_SLOTS - pattern.palette.vertex_count()
}
