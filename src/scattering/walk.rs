//! Light's way from zone to zone inside a scratch: a random walk in its cross-section, until it leaves upwards.
//!
//! The geometry is constant along the scratch, so that only a direction's components across it (x) and upwards (z)
//! say what it meets next.

use crate::brdf::{ACROSS_SURFACE, Finish, Pair};
use glam::{Vec2, Vec3};

/// Meetings after which the rest of the light, if any, counts as absorbed.
const MOST_BOUNCES: u32 = 256;

/// Meetings after which dim light is followed only as often as it is bright.
const SURE_BOUNCES: u32 = 4;

/// A cross-section to walk in, with the flat surface on both sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ground<'a> {
    pub xs: &'a [f32],
    pub zs: &'a [f32],
    /// Of each facet: across component of its normal, and number of its finish.
    pub normal_x: &'a [f32],
    pub finish: &'a [u8],
    pub finishes: &'a [Finish],
    /// First axis of the scratch's frame.
    pub across: Vec2,
}

/// Where light is: on a facet, or on the flat surface beside the scratch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Number of the facet; none on the flat surface.
    pub facet: Option<usize>,
    pub x: f32,
    pub z: f32,
}

/// Light that has left, followed backwards from the viewer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Left {
    /// In the scratch's frame, above the surface.
    pub light: Vec3,
    /// What it counts, RGB.
    pub weight: Vec3,
}

impl Ground<'_> {
    /// Follows light backwards that reaches the viewer from a place; nothing if all of it is absorbed.
    pub(crate) fn walk(
        &self,
        mut place: Place,
        mut view: Vec3,
        random: &mut Numbers,
    ) -> Option<Left> {
        let mut weight = Vec3::ONE;
        for bounce in 0..MOST_BOUNCES {
            let (light, share) = self.reflected(place, view, [random.next(), random.next()])?;
            weight *= share;
            let Some(next) = self.next(place, light) else {
                return Some(Left { light, weight });
            };
            if bounce >= SURE_BOUNCES {
                let kept = weight.max_element().min(1.0);
                if random.next() >= kept {
                    return None;
                }
                weight /= kept;
            }
            (place, view) = (next, -light);
        }
        None
    }

    /// A direction that the place reflects light from, and what that counts.
    pub(crate) fn reflected(&self, place: Place, view: Vec3, u: [f32; 2]) -> Option<(Vec3, Vec3)> {
        let Some(facet) = place.facet else {
            // The flat surface has a frame of its own.
            let to_surface = Vec2::new(ACROSS_SURFACE.x, -ACROSS_SURFACE.y).rotate(self.across);
            let back = Vec2::new(to_surface.x, -to_surface.y);
            let turned = |w: Vec3, by: Vec2| by.rotate(w.truncate()).extend(w.z);
            let (light, share) =
                reflected(&self.finishes[0], Vec3::Z, turned(view, to_surface), u)?;
            return Some((turned(light, back), share));
        };
        let x = self.normal_x[facet];
        let normal = Vec3::new(x, 0.0, (1.0 - x * x).max(0.0).sqrt());
        reflected(&self.finishes[self.finish[facet] as usize], normal, view, u)
    }

    /// The place at a share of a facet.
    pub(crate) fn place(&self, facet: usize, share: f32) -> Place {
        let at = |values: &[f32]| values[facet] + share * (values[facet + 1] - values[facet]);
        Place {
            facet: Some(facet),
            x: at(self.xs),
            z: at(self.zs),
        }
    }

    /// What light meets that leaves a place in this direction; nothing if it leaves upwards.
    pub(crate) fn next(&self, place: Place, light: Vec3) -> Option<Place> {
        let last = self.xs.len() - 1;
        if light.x == 0.0 {
            return None;
        }
        let slope = light.z / light.x;
        let height = |x: f32| place.z + (x - place.x) * slope;
        let meets = |k: usize, from: usize, to: usize| {
            // Above the near end or it would have been met before, not above the far end.
            let (above, below) = (
                height(self.xs[from]) - self.zs[from],
                height(self.xs[to]) - self.zs[to],
            );
            (below < 0.0).then(|| {
                let share = (above.max(0.0) / (above.max(0.0) - below)).clamp(0.0, 1.0);
                let at = |values: &[f32]| values[from] + share * (values[to] - values[from]);
                Place {
                    facet: Some(k),
                    x: at(self.xs),
                    z: at(self.zs),
                }
            })
        };
        let on_left = place.x <= self.xs[0];
        let met = if light.x > 0.0 {
            let first = place
                .facet
                .map_or(if on_left { 0 } else { last }, |k| k + 1);
            (first..last).find_map(|k| meets(k, k, k + 1))
        } else {
            let end = place.facet.unwrap_or(if on_left { 0 } else { last });
            (0..end).rev().find_map(|k| meets(k, k + 1, k))
        };
        met.or_else(|| {
            // From the flat surface light goes up; from above it may come down beside the scratch.
            (place.facet.is_some() && light.z < 0.0).then(|| Place {
                facet: None,
                x: place.x - place.z / slope,
                z: 0.0,
            })
        })
    }
}

/// A light that a base BRDF reflects, and BRDF times cosine over its density.
fn reflected(finish: &Finish, normal: Vec3, view: Vec3, u: [f32; 2]) -> Option<(Vec3, Vec3)> {
    let light = finish.sample(u, normal, view)?;
    let pair = Pair::new(view, light);
    let weight = finish.weight(normal, &pair);
    (weight.is_finite() && weight.max_element() > 0.0).then_some((light, weight))
}

/// Random numbers from 0 up to (not including) 1 that follow from three given ones (PCG, O'Neill 2014).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers(u64);

impl Numbers {
    pub(crate) fn from(u: [f32; 3]) -> Self {
        let mut numbers = Self(0x853c_49e6_748f_ea9b);
        for u in u {
            numbers.0 ^= u64::from(u.to_bits());
            numbers.next();
        }
        numbers
    }

    pub(crate) fn next(&mut self) -> f32 {
        let state = self.0;
        self.0 = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let word =
            ((state >> ((state >> 59) + 5)) ^ state).wrapping_mul(12_605_985_483_714_917_081);
        let bits = (word >> 43) ^ word;
        crate::single((bits >> 40) as f64) / 16_777_216.0
    }
}
