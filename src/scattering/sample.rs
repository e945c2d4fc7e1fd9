//! Lights chosen as often as they are reflected, and how often that is (section 4 of the model).

use super::eval::{finite, rest};
use super::relief::{MOST_FINISHES, Relief, Zone};
use super::shading::{LEAST_COS, Shading};
use crate::brdf::{ACROSS_SURFACE, Pair};
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
struct Chosen {
    finish: u8,
    normal: Vec3,
    /// Its scratch's first axis.
    across: Vec2,
    scratch: bool,
}

impl Shading {
    /// A light by three numbers from 0 up to (not including) 1: the first chooses a zone, as often as the viewer sees
    /// it; the others a direction, as often as the zone's base BRDF reflects it. Nothing where the point reflects
    /// nothing.
    pub fn sample(&self, u: [f32; 3]) -> Option<Sample> {
        if self.view.z < LEAST_COS {
            return None;
        }
        let u = u.map(|u| if u >= 0.0 { u.min(BELOW_ONE) } else { 0.0 });
        let zone = self.chosen(u[0]);
        let along = Vec2::new(-zone.across.y, zone.across.x);
        let v = self.view;
        let view = Vec3::new(v.truncate().dot(zone.across), v.truncate().dot(along), v.z);
        let light = self
            .zones
            .finish_of(zone.finish)
            .sample([u[1], u[2]], zone.normal, view)?;
        let flat = zone.across * light.x + along * light.y;
        // What goes down into the surface goes up instead.
        let light = flat.extend(light.z.abs().max(LEAST_COS)).normalize();
        let Evaluated { brdf_cos, pdf } = self.eval_pdf(light.to_array());
        let weight = finite(Vec3::from(brdf_cos) / pdf);
        (pdf > 0.0).then(|| Sample {
            light: light.to_array(),
            weight: weight.to_array(),
            pdf,
            scratch: zone.scratch,
        })
    }

    /// The density with which [`Self::sample`] chooses a light (of any length above 0, in the local frame), per
    /// steradian. 0 below the surface; elsewhere it adds up to 1.
    pub fn pdf(&self, light: [f32; 3]) -> f32 {
        self.eval_pdf(light).pdf
    }

    /// [`Self::eval`] and [`Self::pdf`] for the price of little more than one.
    pub fn eval_pdf(&self, light: [f32; 3]) -> Evaluated {
        let Some(pair) = self.pair(light) else {
            return Evaluated::default();
        };
        let mirrored = Pair::new(pair.view, pair.light * Vec3::new(1.0, 1.0, -1.0));
        let mut lobes = [0.0; MOST_FINISHES];
        let (mut density, mut seen) = (0.0, 0.0);
        self.each_zone(&pair, |zone, turned, across| {
            let finish = self.zones.finish_of(zone.finish);
            if zone.lit > 0.0 {
                lobes[zone.finish as usize] += zone.lit * finish.lobe_cos(zone.normal, turned);
            }
            let pdf = finish.pdf(zone.normal, turned);
            let below = finish.pdf(zone.normal, &mirrored.turned(across));
            density += zone.seen * (pdf + below);
            seen += zone.seen;
        });
        let brdf_cos = finite(self.zones.colour(&lobes, &pair)).to_array();
        let pdf = if seen > 0.0 { density / seen } else { 0.0 };
        let pdf = if pdf.is_finite() { pdf } else { 0.0 };
        Evaluated { brdf_cos, pdf }
    }

    /// The zone in which the share `u` of all that is seen falls.
    fn chosen(&self, u: f32) -> Chosen {
        let reliefs = self.reliefs().iter();
        let scratched: f32 = reliefs.clone().map(Relief::coverage).sum();
        let flat = rest(self.coverage());
        let mut left = u * (scratched + self.flocks.seen() + flat);
        // No light matters here.
        let pair = Pair::new(self.view, self.view);
        for relief in reliefs {
            if left < relief.coverage() {
                let mut picked = Picked::new(left, relief.across);
                let turned = pair.turned(relief.across);
                self.zones
                    .each_of_relief(relief, &turned, |zone| picked.pass(zone));
                return picked.chosen;
            }
            left -= relief.coverage();
        }
        for flock in self.flocks.iter() {
            if left < flock.shown {
                let mut picked = Picked::new(left, flock.across);
                let turned = pair.turned(flock.across);
                self.zones
                    .each_of_flock(&flock, &turned, |zone| picked.pass(zone));
                return picked.chosen;
            }
            left -= flock.shown;
        }
        Chosen::FLAT
    }
}

/// Goes through the zones of a scratch up to the one in which a share falls.
struct Picked {
    left: f32,
    chosen: Chosen,
}

impl Picked {
    fn new(left: f32, across: Vec2) -> Self {
        let chosen = Chosen {
            across,
            scratch: true,
            ..Chosen::FLAT
        };
        Self { left, chosen }
    }

    fn pass(&mut self, zone: &Zone) {
        if self.left >= 0.0 && zone.seen > 0.0 {
            self.chosen.finish = zone.finish;
            self.chosen.normal = zone.normal;
        }
        self.left -= zone.seen;
    }
}

impl Chosen {
    const FLAT: Self = Self {
        finish: 0,
        normal: Vec3::Z,
        across: ACROSS_SURFACE,
        scratch: false,
    };
}

/// The largest number below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
