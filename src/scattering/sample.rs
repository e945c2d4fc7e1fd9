//! Lights chosen as often as they are reflected, and how often that is (section 4 of the model).

use super::eval::finite;
use super::flocks::Flock;
use super::many::{MOST, Vectors};
use super::relief::Relief;
use super::shading::{LEAST_COS, Shading, direction};
use super::visibility::Parts;
use super::visit::Zone;
use crate::brdf::{ACROSS_SURFACE, Lobe, Pair};
use crate::error::Result;
use crate::lanes::{Lanes, in_lanes};
use glam::{Vec2, Vec3};

/// A light chosen for a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Unit direction in the local frame.
    pub light: [f32; 3],
    /// BRDF times cosine over `pdf`, RGB.
    pub weight: [f32; 3],
    /// Density of the choice, per steradian.
    pub pdf: f32,
    /// Whether a scratch was chosen, not the flat surface.
    pub scratch: bool,
    /// How the zone that was chosen reflects.
    pub lobe: Lobe,
}

/// What a point reflects of one light, and how often that light is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Evaluated {
    /// BRDF times cosine, RGB.
    pub brdf_cos: [f32; 3],
    /// Density with which [`Shading::sample`] chooses the light, per steradian.
    pub pdf: f32,
}

/// A zone that was chosen.
#[derive(Clone, Copy)]
pub(super) struct Chosen<'a> {
    pub finish: u8,
    pub normal: Vec3,
    /// Its scratch's first axis.
    pub across: Vec2,
    pub scratch: Option<Held<'a>>,
    /// Number of the facet in its scratch.
    pub facet: usize,
}

/// A scratch that a shading point holds: by itself, or among others like it.
#[derive(Clone, Copy)]
pub(super) enum Held<'a> {
    Relief(&'a Relief),
    Flock(Flock),
}

impl Shading {
    /// A light by three numbers from 0 up to (not including) 1: the first chooses a zone, as often as the viewer sees
    /// it; the others a direction, as often as the zone's base BRDF reflects it. Nothing where the point reflects
    /// nothing.
    pub fn sample(&self, u: [f32; 3]) -> Option<Sample> {
        if !self.is_seen() {
            return None;
        }
        if self.has_all_bounces() {
            let u = within_unit(u);
            return self.walked(&self.chosen(u[0]), u);
        }
        in_lanes!(lanes => self.sample_in(lanes, u))
    }

    #[inline(always)]
    fn sample_in<L: Lanes>(&self, lanes: L, u: [f32; 3]) -> Option<Sample> {
        let u = within_unit(u);
        let zone = self.chosen(u[0]);
        let light = self.proposed(&zone, u)?;
        let (brdf_cos, pdf) = self.first_bounce_in(lanes, light);
        self.weighed(&zone, light, brdf_cos, pdf)
    }

    /// [`Self::sample`] for the first `count` of `u`: `tell` gets each one's number and sample, at a fraction of the price,
    /// the same within 1e-5. Fails, with nothing told, where an array is shorter than `count` asks for.
    pub fn sample_many(
        &self,
        u: &Vectors<'_>,
        count: usize,
        mut tell: impl FnMut(usize, Option<Sample>),
    ) -> Result<()> {
        u.check("u", count)?;
        for first in (0..count).step_by(MOST) {
            let own = MOST.min(count - first);
            if self.has_all_bounces() || !self.is_seen() {
                (first..first + own).for_each(|i| tell(i, self.sample(u.get(i))));
                continue;
            }
            let mut lights = [Vec3::Z; MOST];
            let mut zones = [None; MOST];
            for i in 0..own {
                let u = within_unit(u.get(first + i));
                let zone = self.chosen(u[0]);
                if let Some(light) = self.proposed(&zone, u) {
                    (lights[i], zones[i]) = (light, Some(zone));
                }
            }
            let (found, densities) = self.reflected_many(&lights, true);
            for i in 0..own {
                let sample = zones[i]
                    .and_then(|zone| self.weighed(&zone, lights[i], found[i], densities[i]));
                tell(first + i, sample);
            }
        }
        Ok(())
    }

    /// A light that a zone reflects to the view.
    #[inline(always)]
    fn proposed(&self, zone: &Chosen<'_>, u: [f32; 3]) -> Option<Vec3> {
        let view = zone.turned(self.view);
        let finish = self.zones.finish_of(zone.finish);
        let light = zone.turned_back(finish.sample_all([u[1], u[2]], zone.normal, view)?);
        // What goes down into the surface goes up instead.
        let light = direction([light.x, light.y, light.z.abs().max(LEAST_COS)]);
        light.filter(|light| light.z >= LEAST_COS)
    }

    #[inline(always)]
    fn weighed(&self, zone: &Chosen<'_>, light: Vec3, brdf_cos: Vec3, pdf: f32) -> Option<Sample> {
        (pdf > 0.0).then(|| Sample {
            light: light.to_array(),
            weight: finite(brdf_cos / pdf).to_array(),
            pdf,
            scratch: zone.scratch.is_some(),
            lobe: self.zones.finish_of(zone.finish).kind(),
        })
    }

    /// The density with which [`Self::sample`] chooses a light (of any length above 0, in the local frame), per
    /// steradian. 0 below the surface; elsewhere it adds up to 1.
    pub fn pdf(&self, light: [f32; 3]) -> f32 {
        self.light(light)
            .map_or(0.0, |light| self.first_bounce(light).1)
    }

    /// [`Self::eval`] and [`Self::pdf`] for the price of little more than one.
    pub fn eval_pdf(&self, light: [f32; 3]) -> Evaluated {
        let Some(light) = self.light(light) else {
            return Evaluated::default();
        };
        let (mut brdf_cos, pdf) = self.first_bounce(light);
        if self.has_all_bounces() {
            brdf_cos += self.indirect(Pair::new(self.view, light));
        }
        let brdf_cos = finite(brdf_cos).to_array();
        Evaluated { brdf_cos, pdf }
    }

    /// BRDF times cosine of light that meets one zone, and the density with which it is chosen, whatever it meets.
    #[inline(never)]
    fn first_bounce(&self, light: Vec3) -> (Vec3, f32) {
        in_lanes!(lanes => self.first_bounce_in(lanes, light))
    }

    #[inline(always)]
    fn first_bounce_in<L: Lanes>(&self, lanes: L, light: Vec3) -> (Vec3, f32) {
        let pair = Pair::new(self.view, light);
        let below = pair.below();
        let mut sums = self.scratch_sums(lanes, &pair, Some(&below));
        let (mut brdf_cos, pdf) = self.all_of(lanes, &mut sums, &pair, Some(&below));
        if self.zones.has_hosted() {
            brdf_cos += self.hosted(pair);
        }
        (brdf_cos, pdf)
    }

    /// The zone in which the share `u` of all that is seen falls.
    #[inline(always)]
    fn chosen(&self, u: f32) -> Chosen<'_> {
        let reliefs = self.reliefs().iter();
        let mut left = u * self.seen;
        for relief in reliefs {
            if left < relief.coverage() {
                let zone = self.zones.seen_at(relief, left);
                return Chosen {
                    finish: zone.finish,
                    normal: zone.normal(),
                    across: relief.across,
                    scratch: Some(Held::Relief(relief)),
                    facet: zone.facet.unwrap_or(0),
                };
            }
            left -= relief.coverage();
        }
        if self.flocks.is_empty() {
            return Chosen::FLAT;
        }
        self.chosen_of_flocks(left)
    }

    #[inline(never)]
    fn chosen_of_flocks(&self, mut left: f32) -> Chosen<'_> {
        // No light matters here.
        let pair = Pair::new(self.view, self.view);
        for flock in self.flocks.iter() {
            if left < flock.shown {
                let mut picked = Picked::new(left, flock.across, Held::Flock(flock));
                let (turned, mut parts) = (pair.turned(flock.across), [const { Parts::new() }; 2]);
                self.zones
                    .each_of_flock(&mut parts, &flock, &turned, |zone| picked.pass(zone));
                return picked.chosen;
            }
            left -= flock.shown;
        }
        Chosen::FLAT
    }
}

/// Goes through the zones of a scratch up to the one in which a share falls.
struct Picked<'a> {
    left: f32,
    chosen: Chosen<'a>,
}

impl<'a> Picked<'a> {
    fn new(left: f32, across: Vec2, scratch: Held<'a>) -> Self {
        let chosen = Chosen {
            across,
            scratch: Some(scratch),
            ..Chosen::FLAT
        };
        Self { left, chosen }
    }

    fn pass(&mut self, zone: &Zone) {
        if self.left >= 0.0 && zone.seen > 0.0 {
            self.chosen.finish = zone.finish;
            self.chosen.normal = zone.normal();
            self.chosen.facet = zone.facet.unwrap_or(0);
        }
        self.left -= zone.seen;
    }
}

impl Chosen<'_> {
    const FLAT: Self = Self {
        finish: 0,
        normal: Vec3::Z,
        across: ACROSS_SURFACE,
        scratch: None,
        facet: 0,
    };

    /// A local direction in the scratch's frame.
    fn turned(&self, w: Vec3) -> Vec3 {
        let along = Vec2::new(-self.across.y, self.across.x);
        let flat = w.truncate();
        Vec3::new(flat.dot(self.across), flat.dot(along), w.z)
    }

    /// A direction of the scratch's frame in the local one.
    pub(super) fn turned_back(&self, w: Vec3) -> Vec3 {
        turned_back(self.across, w)
    }
}

/// A direction of the frame of a scratch with this first axis in the local one.
pub(super) fn turned_back(across: Vec2, w: Vec3) -> Vec3 {
    let along = Vec2::new(-across.y, across.x);
    (across * w.x + along * w.y).extend(w.z)
}

/// A direction above the surface, be it just.
pub(super) fn upwards(w: Vec3) -> Vec3 {
    w.truncate().extend(w.z.max(LEAST_COS)).normalize()
}

/// Numbers from 0 up to (not including) 1.
fn within_unit(u: [f32; 3]) -> [f32; 3] {
    u.map(|u| if u >= 0.0 { u.min(BELOW_ONE) } else { 0.0 })
}

/// The largest number below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
