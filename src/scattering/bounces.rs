//! Light that meets more than one zone of a scratch on its way, switched on for a prepared point.

use super::eval::{finite, rest};
use super::exchange::{Exchange, FEW_CORNERS, FLATS, MOST_CORNERS};
use super::sample::{Chosen, Held, Sample, turned_back, upwards};
use super::shading::Shading;
use super::visibility::{Across, Parts};
use super::visit::Zone;
use super::walk::{Ground, Left, Numbers, Place};
use crate::brdf::{ACROSS_SURFACE, Pair};
use crate::lanes::One;
use core::f32::consts::FRAC_1_PI;
use core::ops::Range;
use glam::Vec3;

/// How far light is followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bounces {
    /// From one zone to the viewer.
    #[default]
    One,
    /// From zone to zone within a scratch, and to the flat surface beside it, until it leaves.
    All,
}

impl Shading {
    /// How far this point's light is followed; [`Self::shade`] sets it back to one bounce.
    ///
    /// With all bounces [`Self::sample`] walks through the cross-section, without bias, and [`Self::eval`] adds what
    /// zones reflect to one another: by its direction the first time (lobes of less than alpha 0.06 as if they were so wide),
    /// as if scattered evenly from then on. Exact for Lambertian zones; metals of alpha 0.05 to 0.4 measured within 1 %.
    /// [`Self::pdf`] stays that of one bounce.
    pub fn set_bounces(&mut self, bounces: Bounces) {
        self.all_bounces = (bounces == Bounces::All).into();
        if bounces == Bounces::All {
            self.zones.measure_albedos();
        }
    }

    pub(super) fn has_all_bounces(&self) -> bool {
        self.all_bounces == 1
    }

    /// What reaches the viewer after more than one bounce: BRDF times cosine, RGB.
    #[inline(never)]
    pub(super) fn indirect(&self, pair: Pair) -> Vec3 {
        let mut sum = Vec3::ZERO;
        let mut parts = [const { Parts::new() }; 2];
        let still = Pair::new(pair.view, pair.view);
        for relief in self.reliefs() {
            let across = relief.across;
            let sent = self.sent(relief.slots(), &pair.turned(across));
            let mut add = |zone: &Zone| sum += zone.seen * sent.by_zone(zone);
            self.zones
                .each_of_relief(One, relief, &still.turned(across), &mut add);
            for (ends, flat) in sent.by_flats() {
                sum += self.zones.flat_weight(relief, ends) * flat;
            }
        }
        for flock in self.flocks.iter() {
            let across = flock.across;
            let sent = self.sent(flock.range(), &pair.turned(across));
            // All that is seen, as lit from where it is looked at.
            let mut add = |zone: &Zone| sum += zone.lit * sent.by_zone(zone);
            self.zones
                .each_of_flock(&mut parts, &flock, &still.turned(across), &mut add);
            for (ends, flat) in sent.by_flats() {
                sum += flock.share * (ends[1] - ends[0]) * flat;
            }
        }
        sum
    }

    /// What each facet of a cross-section sends to the viewer of the light that it gets from others.
    fn sent(&self, slots: Range<usize>, pair: &Pair) -> Sent {
        let ground = self.zones.ground(slots, ACROSS_SURFACE);
        match ground.xs.len() + 2 * FLATS {
            ..=FEW_CORNERS => self.exchanged::<FEW_CORNERS>(&ground, pair),
            _ => self.exchanged::<MOST_CORNERS>(&ground, pair),
        }
    }

    #[inline(never)]
    fn exchanged<const CORNERS: usize>(&self, ground: &Ground<'_>, pair: &Pair) -> Sent {
        let exchange = Exchange::<CORNERS>::new(ground.xs, ground.zs);
        let facets = ground.xs.len() - 1;
        // The flat surface, unless it is found to be a facet.
        let mut direct = [pair.light.z; CORNERS];
        let mut parts = Parts::new();
        parts.sweep(One, ground.xs, ground.zs, facets, Across::of(pair.light));
        for k in 0..facets {
            let ([from, to], x) = (parts.of(k), ground.normal_x[k]);
            let up = (1.0 - x * x).max(0.0).sqrt();
            let cos = x * pair.light.x + up * pair.light.z;
            direct[FLATS + k] = (to - from).max(0.0) * cos.max(0.0);
        }
        let mut finish = [0; CORNERS];
        finish[FLATS..FLATS + facets].copy_from_slice(&ground.finish[..facets]);
        let albedo = |i: usize| self.zones.albedo_of(finish[i]);
        let indirect = exchange.indirect(|i| direct[i], albedo);
        let mut sent = Sent {
            radiance: [Vec3::ZERO; MOST_CORNERS],
            flats: [[0.0; 2]; 2 * FLATS],
            facets,
        };
        let more = self.gloss(&exchange, &finish, &direct, pair);
        for i in 0..exchange.facets {
            sent.radiance[i] = albedo(i) * indirect[i] * FRAC_1_PI + more[i];
        }
        for (ends, flat) in sent.flats.iter_mut().zip(flats(facets)) {
            *ends = exchange.ends(flat);
        }
        sent
    }

    /// Follows light back from a zone.
    pub(super) fn walked(&self, zone: &Chosen<'_>, u: [f32; 3]) -> Option<Sample> {
        let mut random = Numbers::from(u);
        let (light, weight) = match zone.scratch {
            Some(scratch) => self.walk_from(zone, &scratch, &mut random),
            None => self.walk_from_flat(&mut random),
        }?;
        let light = upwards(light).to_array();
        let pdf = self.pdf(light);
        (pdf > 0.0).then(|| Sample {
            light,
            weight: finite(weight).to_array(),
            pdf,
            scratch: zone.scratch.is_some(),
            lobe: self.zones.finish_of(zone.finish).kind(),
        })
    }

    fn walk_from(
        &self,
        zone: &Chosen<'_>,
        scratch: &Held<'_>,
        random: &mut Numbers,
    ) -> Option<(Vec3, Vec3)> {
        let view = Pair::new(self.view, self.view).turned(zone.across).view;
        let (slots, share) = match scratch {
            Held::Relief(relief) => {
                let slope = view.x / view.z;
                let share = self
                    .zones
                    .seen_place(relief, zone.facet, slope, random.next());
                (relief.slots(), share)
            }
            Held::Flock(flock) => {
                let ground = self.zones.ground(flock.range(), zone.across);
                let mut parts = Parts::new();
                let facets = ground.xs.len() - 1;
                parts.sweep(One, ground.xs, ground.zs, facets, Across::of(view));
                let seen = parts.of(zone.facet);
                let share = seen[0] + random.next() * (seen[1] - seen[0]);
                (flock.range(), share)
            }
        };
        let ground = self.zones.ground(slots, zone.across);
        let Left { light, weight } = ground.walk(ground.place(zone.facet, share), view, random)?;
        Some((zone.turned_back(light), weight))
    }

    /// From the flat surface; where scratches shade it from the light, that is followed on.
    fn walk_from_flat(&self, random: &mut Numbers) -> Option<(Vec3, Vec3)> {
        let view = Pair::new(self.view, self.view).turned(ACROSS_SURFACE).view;
        let ground = self.zones.ground(0..0, ACROSS_SURFACE);
        let flat = Place {
            facet: None,
            x: 0.0,
            z: 0.0,
        };
        let (light, weight) = ground.reflected(flat, view, [random.next(), random.next()])?;
        let light = turned_back(ACROSS_SURFACE, light);
        let mut left = random.next() * rest(self.coverage());
        let Some(pair) = self.pair(light.to_array()) else {
            return Some((light, weight));
        };
        for relief in self.reliefs() {
            let turned = pair.turned(relief.across);
            let (shadow, share) = self.zones.shadow_of_relief(relief, &turned);
            left -= share;
            if left < 0.0 {
                let x = self
                    .zones
                    .densities
                    .place(&relief.weight, shadow, random.next());
                let ground = self.zones.ground(relief.slots(), relief.across);
                return walk_on(&ground, x, turned.light, weight, random);
            }
        }
        for flock in self.flocks.iter() {
            let turned = pair.turned(flock.across);
            let ([from, to], share) = self.zones.shadow_of_flock(&flock, &turned);
            left -= share;
            if left < 0.0 {
                let x = from + random.next() * (to - from);
                let ground = self.zones.ground(flock.range(), flock.across);
                return walk_on(&ground, x, turned.light, weight, random);
            }
        }
        Some((light, weight))
    }
}

/// Radiance of the facets of a cross-section and of the flat surface beside it, its first part leftmost.
struct Sent {
    radiance: [Vec3; MOST_CORNERS],
    /// From where to where each part of the flat surface reaches.
    flats: [[f32; 2]; 2 * FLATS],
    facets: usize,
}

impl Sent {
    fn by_zone(&self, zone: &Zone) -> Vec3 {
        zone.facet.map_or(Vec3::ZERO, |k| self.radiance[FLATS + k])
    }

    /// From where to where each part of the flat surface reaches, and its radiance.
    fn by_flats(&self) -> impl Iterator<Item = ([f32; 2], Vec3)> {
        let radiance = flats(self.facets).map(|i| self.radiance[i]);
        self.flats.into_iter().zip(radiance)
    }
}

/// Which facets of an exchange are the flat surface's, where a cross-section has so many.
fn flats(facets: usize) -> impl Iterator<Item = usize> {
    let right = FLATS + facets;
    (0..FLATS).chain(right..right + FLATS)
}

/// From a place of the flat surface that a scratch shades.
fn walk_on(
    ground: &Ground<'_>,
    x: f32,
    light: Vec3,
    weight: Vec3,
    random: &mut Numbers,
) -> Option<(Vec3, Vec3)> {
    let place = Place {
        facet: None,
        x,
        z: 0.0,
    };
    let left = match ground.next(place, light) {
        Some(met) => ground.walk(met, -light, random)?,
        None => Left {
            light,
            weight: Vec3::ONE,
        },
    };
    Some((turned_back(ground.across, left.light), weight * left.weight))
}
