//! One shading point seen from one direction: everything that does not depend on the light.

mod crossing;
mod fill;

use super::flocks::Flocks;
use super::near::reach_mm;
use super::relief::{MOST_RELIEFS, Relief, Zones};
use crate::brdf::Finish;
use crate::error::{Error, Result, all_finite};
use crate::pattern::{Candidates, Frame, Metric, Pattern, Reach, Region, SurfacePoint};
use crate::unit;
use glam::{DVec2, Vec3};

/// Directions are above the surface from this cosine on: below it, single precision cannot say where relief
/// is seen against the plane.
pub(super) const LEAST_COS: f32 = 1e-6;

/// A shading point: plain data of fixed size. Make one per thread and shade into it again and again.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Shading {
    pub(super) coverage: f32,
    pub(super) scratch_count: u32,
    pub(super) relief_count: u32,
    /// 1 if light is followed from zone to zone.
    pub(super) all_bounces: u32,
    /// The share of the pixel that samples are chosen from: all that the viewer sees, zone by zone.
    pub(super) seen: f32,
    /// What all scratches would cover were they not thinned to fill the pixel and no more, at least 1.
    pub(super) crowding: f32,
    /// Zero for a point that reflects nothing.
    pub(super) view: Vec3,
    pub(super) reliefs: [Relief; MOST_RELIEFS],
    pub(super) flocks: Flocks,
    pub(super) zones: Zones,
}

impl Default for Shading {
    /// A point that reflects nothing.
    fn default() -> Self {
        Self {
            coverage: 0.0,
            scratch_count: 0,
            relief_count: 0,
            all_bounces: 0,
            seen: 1.0,
            crowding: 1.0,
            view: Vec3::ZERO,
            reliefs: [Relief::NONE; MOST_RELIEFS],
            flocks: Flocks::NONE,
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
    #[inline(always)]
    pub fn shade(&mut self, pattern: &Pattern, point: &SurfacePoint, view: [f32; 3]) -> Result<()> {
        match pattern.surface.hosted() {
            None => self.begin(&pattern.surface, view)?,
            Some(_) => self.begin_hosted(pattern, view)?,
        }
        let reach_mm = reach_mm(pattern, self.view.truncate().length() / self.view.z);
        // By value: most points end here, and a point is only written down to be looked at by its address.
        match point.box_at_a_glance(pattern.mm_per_scene_unit, reach_mm) {
            None => self.look_closely(pattern, *point, reach_mm, None),
            Some([low, high]) if !pattern.touches(low, high) => Ok(()),
            Some(near) => self.look_closely(pattern, *point, reach_mm, Some(near)),
        }
    }

    /// Adds what lies within reach, which is all in this box, if that could be told.
    #[inline(never)]
    fn look_closely(
        &mut self,
        pattern: &Pattern,
        point: SurfacePoint,
        reach_mm: f64,
        glance: Option<[DVec2; 2]>,
    ) -> Result<()> {
        let mut candidates = Candidates::new();
        let found = glance.map(|[low, high]| pattern.pieces_near(low, high, &mut candidates));
        if found == Some(true) && candidates.is_empty() {
            return Ok(());
        }
        let scale = pattern.mm_per_scene_unit;
        let frame = Frame::of(point.normal, point.dp_du)?;
        let metric = Metric::at(&point, &frame, scale)?;
        let ([a, b], footprint) = metric.edges(&point.footprint, scale);
        let region = Region::parallelogram(a, b);
        if self.view.z >= LEAST_COS {
            let reach = Reach::new(&metric, &region, reach_mm);
            let complete = found.unwrap_or_else(|| pattern.candidates(&reach, &mut candidates));
            self.fill(pattern, &reach, complete.then_some(&mut candidates));
        }
        footprint
    }

    /// How much of what the pixel shows belongs to scratches, 0 to 1.
    pub fn coverage(&self) -> f32 {
        self.coverage
    }

    /// How many scratches the footprint holds. Where they are too many to be looked at one by one, how many
    /// cross-sections and directions they were summed up by.
    pub fn scratch_count(&self) -> u32 {
        self.scratch_count
    }

    /// The scratches that it holds one by one.
    pub(super) fn reliefs(&self) -> &[Relief] {
        &self.reliefs[..self.relief_count as usize]
    }

    #[inline(always)]
    pub(super) fn begin(&mut self, surface: &Finish, view: [f32; 3]) -> Result<()> {
        self.zones.begin(surface);
        self.forget();
        let Some(unit) = direction(view) else {
            self.view = Vec3::ZERO;
            return Err(no_view(view));
        };
        self.view = unit;
        Ok(())
    }

    #[inline(never)]
    fn begin_hosted(&mut self, pattern: &Pattern, view: [f32; 3]) -> Result<()> {
        self.begin(&pattern.hosts.found(&pattern.surface), view)
    }

    fn clear(&mut self) {
        self.zones.clear();
        self.forget();
    }

    /// Forgets all but its zones.
    #[inline(always)]
    fn forget(&mut self) {
        self.coverage = 0.0;
        self.scratch_count = 0;
        self.relief_count = 0;
        self.all_bounces = 0;
        self.seen = 1.0;
        self.crowding = 1.0;
        self.flocks.clear();
    }
}

/// Why it is no direction.
#[cold]
fn no_view(view: [f32; 3]) -> Error {
    let none = Error::number("view", 0.0, "a vector of any length above 0");
    all_finite("view", &view).err().unwrap_or(none)
}

/// Unit length at any scale.
#[inline(always)]
pub(super) fn direction(v: [f32; 3]) -> Option<Vec3> {
    unit(v).map(|v| v.as_vec3())
}
