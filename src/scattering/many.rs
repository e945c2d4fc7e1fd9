//! Many lights of one point, and many samples: eight at a time.

use super::eval::{Output, finite};
use super::sample::Evaluated;
use super::shading::Shading;
use crate::brdf::Pair;
use crate::error::{Error, Result};
use crate::lanes::in_lanes;
use glam::Vec3;

/// Lights that are looked at together.
pub(super) const MOST: usize = 8;

/// Vectors as a structure of arrays: x, y and z of one after another, `stride` numbers apart.
#[derive(Clone, Copy, Debug)]
pub struct Vectors<'a> {
    /// First components.
    pub x: &'a [f32],
    /// Second ones.
    pub y: &'a [f32],
    /// Third ones.
    pub z: &'a [f32],
    /// From one vector to the next: 1 where nothing lies between them.
    pub stride: usize,
}

impl Vectors<'_> {
    /// All but the first ones.
    pub(crate) fn from(&self, first: usize) -> Self {
        let at = first * self.stride;
        Self {
            x: &self.x[at..],
            y: &self.y[at..],
            z: &self.z[at..],
            stride: self.stride,
        }
    }

    pub(crate) fn get(&self, i: usize) -> [f32; 3] {
        let at = i * self.stride;
        [self.x[at], self.y[at], self.z[at]]
    }

    /// Fails unless it holds `count` vectors.
    pub(super) fn check(&self, argument: &'static str, count: usize) -> Result<()> {
        if self.stride == 0 {
            return Err(Error::count("stride", 0, "1 or more"));
        }
        let shortest = self.x.len().min(self.y.len()).min(self.z.len());
        let held = shortest.div_ceil(self.stride);
        if held < count {
            return Err(Error::count(argument, held, "as many as are asked for"));
        }
        Ok(())
    }
}

impl Shading {
    /// [`Self::eval`] for the first `count` of `lights`: `tell` gets each one's number and RGB, at a fraction of the price, the
    /// same within 1e-5. Fails, with nothing told, where an array is shorter than `count` asks for.
    pub fn eval_many(
        &self,
        lights: &Vectors<'_>,
        count: usize,
        output: Output,
        mut tell: impl FnMut(usize, [f32; 3]),
    ) -> Result<()> {
        self.each_light(lights, count, false, |i, light, evaluated| {
            let rgb = Vec3::from(evaluated.brdf_cos);
            let rgb = match output {
                Output::BrdfCos => rgb,
                Output::Brdf => rgb / light.z,
            };
            tell(i, rgb.to_array());
        })
    }

    /// [`Self::eval_pdf`] for many lights, as [`Self::eval_many`].
    pub fn eval_pdf_many(
        &self,
        lights: &Vectors<'_>,
        count: usize,
        mut tell: impl FnMut(usize, Evaluated),
    ) -> Result<()> {
        self.each_light(lights, count, true, |i, _, evaluated| tell(i, evaluated))
    }

    fn each_light(
        &self,
        lights: &Vectors<'_>,
        count: usize,
        with_pdf: bool,
        mut tell: impl FnMut(usize, Vec3, Evaluated),
    ) -> Result<()> {
        lights.check("lights", count)?;
        for first in (0..count).step_by(MOST) {
            let own = MOST.min(count - first);
            // What is no light is looked at like one from straight above, and not told of.
            let mut group = [Vec3::Z; MOST];
            let mut usable = [false; MOST];
            for i in 0..own {
                if let Some(pair) = self.pair(lights.get(first + i)) {
                    (group[i], usable[i]) = (pair.light, true);
                }
            }
            let (found, densities) = self.reflected_many(&group, with_pdf);
            for i in 0..own {
                let evaluated = Evaluated {
                    brdf_cos: found[i].to_array(),
                    pdf: densities[i],
                };
                let evaluated = if usable[i] {
                    evaluated
                } else {
                    Evaluated::default()
                };
                tell(first + i, group[i], evaluated);
            }
        }
        Ok(())
    }

    /// BRDF times cosine and density for lights above the surface.
    pub(super) fn reflected_many(
        &self,
        lights: &[Vec3; MOST],
        with_pdf: bool,
    ) -> ([Vec3; MOST], [f32; MOST]) {
        let (mut found, mut densities) = ([Vec3::ZERO; MOST], [0.0; MOST]);
        if self.is_seen() {
            in_lanes!(lanes => {
                self.reflected_groups(lanes, lights, with_pdf, &mut found, &mut densities);
            });
        }
        if self.has_all_bounces() || self.zones.has_hosted() {
            for (rgb, light) in found.iter_mut().zip(lights) {
                let pair = Pair::new(self.view, *light);
                if self.zones.has_hosted() {
                    *rgb += self.hosted(pair);
                }
                if self.has_all_bounces() {
                    *rgb += self.indirect(pair);
                }
                *rgb = finite(*rgb);
            }
        }
        (found, densities)
    }
}
