//! What a footprint holds, put into a shading point: scratches one by one, or as a crowd.

use super::Shading;
use super::crossing::room;
use crate::formation::MOST_LAYERS;
use crate::pattern::{Candidates, Crossing, Crowd, Hit, Left, MOST_BOXES, Pattern, Reach, Region};
use crate::scattering::eval::rest;
use crate::scattering::flocks::{Flock, MOST_FLOCKS};
use crate::scattering::footprint::Weight;
use crate::scattering::relief::{MOST_RELIEFS, Relief};
use crate::single;
use arrayvec::ArrayVec;
use core::ops::ControlFlow;
use core::slice;
use glam::DVec2;

/// Scratches that a footprint may hold for each to be looked at by itself.
const MOST_ALONE: usize = 48;

/// Runs of scratch that are looked at one by one: more than are held, for later ones cut earlier ones away.
const MOST_HITS: usize = MOST_BOXES;

/// Most pixels have no more than so many. Room for all would be 160 KB of stack, which takes longer to be touched
/// than a scratch to be shaded.
const FEW_HITS: usize = 12;

/// Beside many others the caps of scratches up to this share of it count as a crowd: all of it from twice so many pieces on,
/// none up to so many.
const THIN_CAPS: f64 = 0.0625;
const FEW_PIECES: f64 = 4.0;

/// What of the pixel a run is added for, thinned by `gain`: these parts of the footprint, or what is `left` of them.
pub(super) struct Share<'a> {
    pub hit: &'a Hit<'a>,
    pub parts: &'a [Region],
    pub left: Option<&'a Left>,
    pub gain: f32,
}

impl<'a> Share<'a> {
    /// Of all that lies in the footprint.
    #[inline(always)]
    pub(super) fn whole(hit: &'a Hit<'a>, footprint: &'a Region, gain: f32) -> Self {
        Self {
            hit,
            parts: slice::from_ref(hit.region(footprint)),
            left: None,
            gain,
        }
    }
}

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
        let share = Share::whole(&hit, reach.footprint, 1.0);
        let added = self.add(pattern, &share, reach.area_mm2);
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
            let share = Share::whole(hit, reach.footprint, single(hit.alone));
            self.add_apart(pattern, &share, reach.area_mm2)
        });
        if !all {
            self.clear();
            self.scratch_count = count;
        }
        all
    }

    /// The same as [`Self::add`], apart; whether there is room.
    #[inline(never)]
    pub(super) fn add_apart(
        &mut self,
        pattern: &Pattern,
        share: &Share<'_>,
        area_mm2: f64,
    ) -> bool {
        self.add(pattern, share, area_mm2).is_some()
    }

    /// Adds a share of a footprint of so many mm²; nothing if there is no room.
    #[inline(always)]
    fn add(&mut self, pattern: &Pattern, share: &Share<'_>, area_mm2: f64) -> Option<()> {
        if !self.has_room(share.hit) {
            return None;
        }
        let densities = &mut self.zones.densities;
        let weight = densities.add_left(share.parts, share.left, &share.hit.line, area_mm2)?;
        self.hold(pattern, share, weight);
        Some(())
    }

    /// Whether a run finds room, but for its density.
    #[inline(always)]
    pub(super) fn has_room(&self, hit: &Hit<'_>) -> bool {
        (self.relief_count as usize) < MOST_RELIEFS && self.zones.has_room(hit.most_vertices())
    }

    /// Holds a run of this density for which there is room, if any of it is to be seen; whether there is.
    #[inline(always)]
    pub(super) fn hold(&mut self, pattern: &Pattern, share: &Share<'_>, weight: Weight) -> bool {
        let hit = share.hit;
        let mut number = |finish| self.zones.finish(&pattern.hosts.found(finish));
        let (mut numbers, layers) = ([0; MOST_LAYERS + 1], hit.track.layers());
        for (own, layer) in numbers.iter_mut().zip(layers) {
            *own = number(&layer.finish);
        }
        numbers[layers.len().min(MOST_LAYERS)] = number(hit.track.bulk());
        let (profile, across) = (&hit.profile, hit.line.across().as_vec2());
        let zones = &mut self.zones;
        let prepared = zones.prepare_run(profile, layers, &numbers, across, weight, self.view);
        let Some(mut relief) = prepared else {
            return false;
        };
        relief.gain = share.gain;
        self.reliefs[self.relief_count as usize] = relief;
        self.relief_count += 1;
        true
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
