//! One shading point seen from one direction: everything that does not depend on the light.

use super::footprint::Weight;
use super::layers::Layered;
use super::relief::{LONGEST_SHADOW, MOST_RELIEFS, Relief, Zones};
use crate::brdf::{Brdf, Finish, Pair};
use crate::error::{Error, Result, all_finite, in_range};
use crate::formation::MOST_LAYERS;
use crate::pattern::{Finishes, Frame, Hit, MOST_VERTICES, Metric, Pattern, Region, SurfacePoint};
use glam::{DVec2, Vec2, Vec3};

/// The shift of relief against the plane at a grazing view is followed to this many times its height.
const LONGEST_PARALLAX: f64 = 20.0;

/// Weights that should add up to 1 do so within this; less flat surface than that is none, or it would shine
/// through a pixel that lies within a scratch.
const ROUNDING: f32 = 1e-6;

/// Points of a cross-section that is shaded by itself.
const MOST_POINTS: usize = 100;

/// Directions are above the surface from this cosine on: below it, single precision cannot say where relief
/// is seen against the plane.
const LEAST_COS: f32 = 1e-6;

/// What [`Shading::eval`] gives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Output {
    /// BRDF times the cosine between light and normal.
    #[default]
    BrdfCos,
    /// The BRDF alone.
    Brdf,
}

/// Which part of the surface a pixel covers when a cross-section is shaded by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CrossFootprint {
    /// The whole cross-section and so many mm of flat surface on each side, as in the paper's section 4.1.
    Whole {
        /// Flat surface on each side, mm, 0 to 1e6. As in the paper, relief that hides or shadows more than
        /// that is not accounted for: at grazing angles the margin must be wide.
        margin_mm: f32,
    },
    /// A pixel's box filter.
    Box {
        /// The pixel's centre, mm to the right of the centre line, -1e6 to 1e6.
        center_mm: f64,
        /// How long the footprint's two edges are across the scratch, mm, 0 to 1e6.
        extents_mm: [f64; 2],
    },
}

/// A shading point: plain data of fixed size. Make one per thread and shade into it again and again.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Shading {
    coverage: f32,
    scratch_count: u32,
    relief_count: u32,
    /// Zero for a point that reflects nothing.
    view: Vec3,
    surface: Finish,
    reliefs: [Relief; MOST_RELIEFS],
    zones: Zones,
}

impl Default for Shading {
    /// A point that reflects nothing.
    fn default() -> Self {
        Self {
            coverage: 0.0,
            scratch_count: 0,
            relief_count: 0,
            view: Vec3::ZERO,
            surface: Finish::BLACK,
            reliefs: [Relief::NONE; MOST_RELIEFS],
            zones: Zones::empty(),
        }
    }
}

impl Shading {
    /// Prepares a point of the pattern's surface for a view (of any length above 0, in the local frame).
    ///
    /// The result can always be evaluated, also after an error: a view that is no direction, or below the
    /// surface, reflects nothing; a point that is not usable (normal, uv or derivatives) is an unscratched one;
    /// a footprint of no usable size (0, infinite, NaN) is a point. Allocates nothing.
    pub fn shade(&mut self, pattern: &Pattern, point: &SurfacePoint, view: [f32; 3]) -> Result<()> {
        self.begin(pattern.surface, view)?;
        let frame = Frame::at(point)?;
        let scale = pattern.mm_per_scene_unit;
        let metric = Metric::at(point, &frame, scale)?;
        let (region, footprint) = metric.region(&point.footprint, scale);
        if self.view.z >= LEAST_COS {
            let pixel_area = region.area();
            let reach = self.reach_mm(pattern);
            pattern.query(&metric, &region, reach, &mut |hit| {
                self.add(&hit, pixel_area);
            });
            self.share_out();
        }
        footprint
    }

    /// Prepares one cross-section for a view, without a pattern: 2 to 100 points (x, z) in mm, x not descending,
    /// the first and last at z = 0; the scratch runs along y.
    pub fn shade_cross_section(
        &mut self,
        vertices: &[[f32; 2]],
        scratched: &Brdf,
        surface: &Brdf,
        pixel: CrossFootprint,
        view: [f32; 3],
    ) -> Result<()> {
        self.begin(Finish::new(&surface.check()?), view)?;
        check_cross_section(vertices)?;
        let finish = Finish::new(&scratched.check()?);
        let weight = match pixel {
            CrossFootprint::Whole { margin_mm } => {
                in_range("margin_mm", f64::from(margin_mm), 0.0, 1e6)?;
                let (first, last) = (vertices[0][0], vertices[vertices.len() - 1][0]);
                Weight::uniform([first - margin_mm, last + margin_mm])
            }
            CrossFootprint::Box {
                center_mm,
                extents_mm: [a, b],
            } => {
                in_range("center_mm", center_mm, -1e6, 1e6)?;
                in_range("extents_mm", a, 0.0, 1e6)?;
                in_range("extents_mm", b, 0.0, 1e6)?;
                let region = Region::parallelogram(DVec2::new(a, 1.0), DVec2::new(b, -1.0));
                let center_line = DVec2::new(-center_mm, 0.0);
                Weight::of_region(&region, center_line, DVec2::X, region.area())
            }
        };
        let (mut xs, mut zs) = ([0.0; MOST_POINTS], [0.0; MOST_POINTS]);
        for ((x, z), vertex) in xs.iter_mut().zip(&mut zs).zip(vertices) {
            [*x, *z] = *vertex;
        }
        if self.view.z >= LEAST_COS {
            let points = (&xs[..vertices.len()], &zs[..vertices.len()]);
            let number = self.zones.finish(&finish);
            let numbers = core::iter::repeat(number);
            let prepared = self
                .zones
                .prepare(0, points, numbers, Vec2::X, weight, self.view);
            self.keep(0, prepared);
            self.share_out();
        }
        Ok(())
    }

    /// How much of what the pixel shows belongs to scratches, 0 to 1.
    pub fn coverage(&self) -> f32 {
        self.coverage
    }

    /// How many runs of scratch the footprint holds.
    pub fn scratch_count(&self) -> u32 {
        self.scratch_count
    }

    /// RGB reflected towards the view from a light in direction `light` (of any length above 0, in the local
    /// frame). Black for a light that is no direction, or below the surface.
    pub fn eval(&self, light: [f32; 3], output: Output) -> [f32; 3] {
        let light = direction(light).unwrap_or(Vec3::ZERO);
        // Also black where the point itself reflects nothing (view zero).
        if light.z < LEAST_COS || self.view.z < LEAST_COS {
            return [0.0; 3];
        }
        let pair = Pair::new(self.view, light);
        let reliefs = &self.reliefs[..self.relief_count as usize];
        let (mut sum, taken) = self.zones.reflect_all(reliefs, &pair);
        let flat = if taken < 1.0 - ROUNDING {
            1.0 - taken
        } else {
            0.0
        };
        sum += self.surface.shared(&pair) * (flat * self.surface.lobe_cos(Vec3::Z, &pair));
        match output {
            Output::BrdfCos => sum.to_array(),
            Output::Brdf => (sum / light.z).to_array(),
        }
    }

    fn begin(&mut self, surface: Finish, view: [f32; 3]) -> Result<()> {
        self.coverage = 0.0;
        self.scratch_count = 0;
        self.relief_count = 0;
        self.surface = surface;
        self.zones.clear();
        self.view = direction(view).unwrap_or(Vec3::ZERO);
        if self.view == Vec3::ZERO {
            all_finite("view", &view)?;
            return Err(Error::number("view", 0.0, "a vector of any length above 0"));
        }
        Ok(())
    }

    /// How far from the footprint a scratch can matter: by its width, by parallax, by its shadow.
    fn reach_mm(&self, pattern: &Pattern) -> f64 {
        let view = self.view.as_dvec3();
        let parallax = (view.truncate().length() / view.z).min(LONGEST_PARALLAX);
        let extent = pattern.extent;
        f64::from(extent.half_width_mm)
            + f64::from(extent.height_mm) * (f64::from(LONGEST_SHADOW) + parallax)
    }

    fn add(&mut self, hit: &Hit<'_>, pixel_area: f64) {
        let across = DVec2::new(hit.travel.y, -hit.travel.x);
        let weight = Weight::of_region(&hit.region, hit.origin, across, pixel_area);
        let (mut xs, mut zs) = ([0.0; MOST_VERTICES], [0.0; MOST_VERTICES]);
        let vertices = hit.track.vertex_count();
        let (xs, zs) = (&mut xs[..vertices], &mut zs[..vertices]);
        hit.track.sample(hit.at, xs, zs);
        let Finishes { layers, bulk } = &hit.track.finishes;
        let layered = Layered::cut(xs, zs, layers.iter().map(|(interface, _)| *interface));
        let (xs, zs, layer) = layered.parts();
        let mut numbers = [0; MOST_LAYERS + 1];
        let finishes = layers.iter().map(|(_, finish)| finish).chain([bulk]);
        for (number, finish) in numbers.iter_mut().zip(finishes) {
            *number = self.zones.finish(finish);
        }
        let number = layer.iter().map(|&layer| numbers[layer as usize]);
        let across = across.as_vec2();
        let more = weight.taken([xs[0], xs[xs.len() - 1]]);
        self.scratch_count += u32::from(more > 0.0);
        match self.place(xs.len(), more) {
            Some((index, first)) => {
                let (points, view) = ((xs, zs), self.view);
                let prepared = self
                    .zones
                    .prepare(first, points, number, across, weight, view);
                self.keep(index, prepared);
            }
            None => self.widen(more, across, number.max().unwrap_or(0)),
        }
    }

    /// Where a cross-section that takes `more` of the pixel may go: its relief's number and its first slot. When
    /// the point is full it takes the place of one that shows much less, which then counts with its like.
    fn place(&mut self, vertices: usize, more: f32) -> Option<(usize, u32)> {
        let count = self.relief_count as usize;
        if let Some(first) = self.zones.free(vertices).filter(|_| count < MOST_RELIEFS) {
            return Some((count, first));
        }
        let fits = |relief: &&mut Relief| relief.vertices as usize >= vertices;
        let smallest = self.reliefs[..count]
            .iter_mut()
            .enumerate()
            .filter(|(_, relief)| fits(relief))
            .min_by(|(_, a), (_, b)| a.coverage().total_cmp(&b.coverage()));
        let (index, relief) = smallest.filter(|(_, relief)| 4.0 * relief.coverage() < more)?;
        let Relief {
            first,
            across,
            finish,
            ..
        } = *relief;
        let shown = relief.coverage();
        relief.gain = 0.0;
        self.widen(shown, across, finish);
        Some((index, first))
    }

    fn keep(&mut self, index: usize, relief: Option<Relief>) {
        if let Some(relief) = relief {
            self.reliefs[index] = relief;
            self.relief_count = self.relief_count.max(u32::try_from(index + 1).unwrap_or(0));
        }
    }

    /// Shares a scratch that takes `more` of the pixel, and for which there is no room, out between those that
    /// resemble it, in proportion to what they show: nothing is lost.
    fn widen(&mut self, more: f32, across: Vec2, finish: u8) {
        let reliefs = &mut self.reliefs[..self.relief_count as usize];
        let weighed = |relief: &Relief| relief.likeness(across, finish) * relief.coverage();
        let all: f32 = reliefs.iter().map(weighed).sum();
        if all > 0.0 {
            for relief in reliefs {
                relief.gain *= 1.0 + more * relief.likeness(across, finish) / all;
            }
        }
    }

    /// Where scratches crowd, their shares are scaled to fill the pixel and no more.
    fn share_out(&mut self) {
        let reliefs = &mut self.reliefs[..self.relief_count as usize];
        let all: f32 = reliefs.iter().map(Relief::coverage).sum();
        if all > 1.0 {
            reliefs.iter_mut().for_each(|relief| relief.gain /= all);
        }
        // An empty sum is -0.
        self.coverage = (0.0 + all).clamp(0.0, 1.0);
    }
}

fn check_cross_section(vertices: &[[f32; 2]]) -> Result<()> {
    if !(2..=MOST_POINTS).contains(&vertices.len()) {
        return Err(Error::count("vertex_count", vertices.len(), "2 to 100"));
    }
    let last = vertices.len() - 1;
    for (i, &[x, z]) in vertices.iter().enumerate() {
        let before = if i == 0 { f32::MIN } else { vertices[i - 1][0] };
        in_range("x", f64::from(x), f64::from(before), f64::from(f32::MAX))
            .and_then(|_| all_finite("z", &[z]))
            .map_err(|error| error.within("vertices", i))?;
    }
    for i in [0, last] {
        in_range("z", f64::from(vertices[i][1]), 0.0, 0.0)
            .map_err(|error| error.within("vertices", i))?;
    }
    Ok(())
}

/// Unit length at any scale; double precision holds where single would overflow, or flush to zero.
fn direction(v: [f32; 3]) -> Option<Vec3> {
    Vec3::from(v)
        .as_dvec3()
        .try_normalize()
        .map(|v| v.as_vec3())
}
