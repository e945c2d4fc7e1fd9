//! Light that meets more than one zone of a scratch on its way, switched on for a prepared point.

use super::eval::{finite, rest};
use super::exchange::Exchange;
use super::relief::Zone;
use super::sample::{Chosen, Held, Sample, turned_back, upwards};
use super::shading::Shading;
use super::visibility::{Across, Part, sweep};
use super::walk::{Ground, Left, Numbers, Place};
use crate::brdf::{ACROSS_SURFACE, Pair};
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
    /// zones reflect to one another as if they scattered it evenly: exact for Lambertian zones, about for glossy ones.
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
    pub(super) fn indirect(&self, pair: &Pair) -> Vec3 {
        let mut sum = Vec3::ZERO;
        let still = Pair::new(pair.view, pair.view);
        for relief in self.reliefs() {
            let across = relief.across;
            let gathered = self.gathered(relief.slots(), pair.turned(across));
            let mut add = |zone: &Zone| sum += zone.seen * gathered(zone);
            self.zones
                .each_of_relief(relief, &still.turned(across), &mut add);
        }
        for flock in self.flocks.iter() {
            let across = flock.across;
            let gathered = self.gathered(flock.range(), pair.turned(across));
            // All that is seen, as lit from where it is looked at.
            let mut add = |zone: &Zone| sum += zone.lit * gathered(zone);
            self.zones
                .each_of_flock(&flock, &still.turned(across), &mut add);
        }
        sum
    }

    /// What each zone of a cross-section sends to the viewer of the light that it gets from the others.
    fn gathered(&self, slots: Range<usize>, pair: Pair) -> impl Fn(&Zone) -> Vec3 {
        let ground = self.zones.ground(slots, pair.view.truncate());
        let exchange = Exchange::new(ground.xs, ground.zs);
        let facets = ground.xs.len() - 1;
        let mut direct = [0.0; Exchange::MOST_FACETS];
        sweep(
            ground.xs,
            ground.zs,
            Across::of(pair.light),
            |k, [from, to]| {
                let x = ground.normal_x[k];
                let up = (1.0 - x * x).max(0.0).sqrt();
                let cos = x * pair.light.x + up * pair.light.z;
                direct[k + 1] = (to - from).max(0.0) * cos.max(0.0);
            },
        );
        direct[0] = pair.light.z;
        direct[facets + 1] = pair.light.z;
        let albedo = |i: usize| match i.checked_sub(1) {
            Some(k) if k < facets => self.zones.albedo_of(ground.finish[k]),
            _ => self.zones.albedo_of(0),
        };
        let indirect = exchange.indirect(|i| direct[i], albedo);
        let sent: [Vec3; Exchange::MOST_FACETS] =
            core::array::from_fn(|i| albedo(i) * indirect[i] * FRAC_1_PI);
        move |zone: &Zone| sent[zone.facet + 1]
    }

    /// Follows light back from a zone.
    pub(super) fn walked(&self, zone: &Chosen, u: [f32; 3]) -> Option<Sample> {
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
        })
    }

    fn walk_from(
        &self,
        zone: &Chosen,
        scratch: &Held,
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
                let mut seen: Part = [0.0; 2];
                sweep(ground.xs, ground.zs, Across::of(view), |k, part| {
                    if k == zone.facet {
                        seen = part;
                    }
                });
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
