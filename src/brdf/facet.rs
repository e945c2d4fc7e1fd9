//! One facet of a scratch by itself, to look at a base BRDF without a scratch around it.

use super::{Brdf, Finish, Pair};
use crate::error::{Result, in_range};
use crate::{single, unit};
use glam::Vec3;

/// A base BRDF on one facet of a scratch, as a shading point weighs it: nothing around it shadows or masks it.
///
/// Directions, of any length above 0, are in the scratch's frame: across it, along it, up from the unscratched
/// surface. On the flat surface along is the local frame's x. What is no direction, or below the facet, reflects nothing.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    finish: Finish,
    normal: Vec3,
}

impl Facet {
    /// A facet whose normal leans across the scratch by `tilt_deg`, -90 to 90.
    pub fn new(brdf: Brdf, tilt_deg: f64) -> Result<Self> {
        in_range("tilt_deg", tilt_deg, -90.0, 90.0)?;
        let (sin, cos) = tilt_deg.to_radians().sin_cos();
        Ok(Self {
            finish: Finish::new(&brdf.check()?),
            normal: Vec3::new(single(sin), 0.0, single(cos)),
        })
    }

    /// BRDF times the cosine between light and the facet's normal, RGB.
    pub fn eval(&self, view: [f32; 3], light: [f32; 3]) -> [f32; 3] {
        let pair = Pair::new(direction(view), direction(light));
        self.finish.brdf_cos(self.normal, &pair).to_array()
    }

    /// A light, a unit vector, by two numbers from 0 up to (not including) 1: [`Self::eval`] over [`Self::pdf`] is what it
    /// counts, 2.2 at most for white. Nothing where it would be below the facet; that counts as black.
    pub fn sample(&self, u: [f32; 2], view: [f32; 3]) -> Option<[f32; 3]> {
        let light = self.finish.sample(u, self.normal, direction(view))?;
        Some(light.to_array())
    }

    /// The density of [`Self::sample`] at a light, per steradian. It adds up to 1 less the share of samples that fail.
    pub fn pdf(&self, view: [f32; 3], light: [f32; 3]) -> f32 {
        let pair = Pair::new(direction(view), direction(light));
        self.finish.pdf(self.normal, &pair)
    }

    /// An estimate of the share of light that it reflects towards a view, RGB, within 0.04.
    pub fn reflectance(&self, view: [f32; 3]) -> [f32; 3] {
        let view = direction(view);
        self.finish.reflectance(self.normal, view).to_array()
    }

    /// How rough it is: the alpha of GGX microfacets that spread light about as far, 1 if it is diffuse.
    pub fn roughness(&self) -> f32 {
        self.finish.roughness()
    }
}

/// Unit length at any scale; no direction is 0.
fn direction(v: [f32; 3]) -> Vec3 {
    unit(v).map_or(Vec3::ZERO, |v| v.as_vec3())
}
