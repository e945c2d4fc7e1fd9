//! The scratched surface as triangles: a region of a pattern in, its relief out, with nothing filtered or summed up.
//!
//! It is what the shading of pixels is measured against, and what renderers and modellers without this library can
//! use. Rails run along each scratch at each vertex of its cross-section (`strips`), fans of facets close its hard
//! ends (`fans`). Both give flat patches, each with a place in time (`patches`). What later ones cover is cut off,
//! and what is left is split where it crosses (`arrangement`). A constrained Delaunay triangulation of that in the
//! plane (`faces`) is lifted to the patches' heights (`lift`). Build time only, in double precision.

mod arrangement;
mod faces;
mod fans;
mod lift;
mod patches;
mod strips;

use super::Pattern;
use crate::brdf::Brdf;
use crate::error::{Error, Result, in_range};
use glam::DVec2;
use patches::Patches;

/// What part of a pattern becomes triangles, and how closely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshRegion {
    /// The rectangle's lowest (u, v), -1e9 to 1e9.
    pub low_uv: [f64; 2],
    /// Its highest (u, v), above the lowest.
    pub high_uv: [f64; 2],
    /// How far the triangles may stray from the relief, mm, 1e-9 to 1000: along straight scratches of steady force they
    /// do not.
    pub tolerance_mm: f64,
    /// Thickness of the plate, mm: 0 for an open surface that ends at the rectangle's border; otherwise (1e-9 to 1e6, and
    /// more than the deepest scratch) the triangles close around a solid.
    pub base_mm: f64,
}

/// The relief of a region, watertight: each edge belongs to two triangles that pass it in opposite directions, but
/// for those on the border of an open surface.
///
/// Where a later scratch cuts an earlier one, and between the facets that close a hard end, heights jump: there walls stand
/// upright, so that all else stays where it is. They count as a part of the later scratch. Textures' u and v run along x
/// and y, to the scale of the pattern's `units_per_uv`.
#[derive(Clone, Debug, Default)]
pub struct ReliefMesh {
    /// (x, y, z) in mm: x and y are u and v to scale, z is up from the unscratched surface.
    pub positions: Vec<[f64; 3]>,
    /// Counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// What each triangle is a part of.
    pub zones: Vec<MeshZone>,
    /// Base BRDFs of the zones: the first is the unscratched surface's.
    pub brdfs: Vec<Brdf>,
}

/// What a triangle is a part of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct MeshZone {
    /// Number of its scratch in order of adding; [`MeshZone::NO_SCRATCH`] for the unscratched surface.
    pub scratch: u32,
    /// Number of its base BRDF.
    pub brdf: u32,
    /// Unit direction of the scratch's travel in x and y, along which polishing lines run; along x on the unscratched
    /// surface.
    pub travel: [f32; 2],
}

impl MeshZone {
    /// Where there is none.
    pub const NO_SCRATCH: u32 = u32::MAX;

    const SURFACE: Self = Self {
        scratch: Self::NO_SCRATCH,
        brdf: 0,
        travel: [1.0, 0.0],
    };
}

/// A rectangle of the plane, mm.
#[derive(Clone, Copy, Debug)]
struct Window {
    low: DVec2,
    high: DVec2,
}

impl Window {
    fn misses(&self, low: DVec2, high: DVec2) -> bool {
        !(low.cmple(self.high).all() && high.cmpge(self.low).all())
    }

    /// Counter-clockwise.
    fn corners(&self) -> [DVec2; 4] {
        let (low, high) = (self.low, self.high);
        [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ]
    }
}

impl Pattern {
    /// The relief of a region as triangles. It takes time and memory: some microseconds and a kilobyte for each of them.
    ///
    /// Errors: a region that is none, a value out of range, a base that the deepest scratch goes through, a region that takes
    /// more than some 10 million triangles.
    pub fn relief_mesh(&self, region: &MeshRegion) -> Result<ReliefMesh> {
        let window = self.window(region)?;
        in_range("tolerance_mm", region.tolerance_mm, 1e-9, 1000.0)?;
        let base_mm = in_range("base_mm", region.base_mm, 0.0, 1e6)?;
        let mut patches = Patches::new(self.surface, window);
        for scratch in 0..self.scratch_count() {
            let number = u32::try_from(scratch).unwrap_or(u32::MAX);
            self.add_patches(number, region.tolerance_mm, &mut patches)?;
        }
        if base_mm > 0.0 {
            let least = patches.deepest_mm().max(1e-9);
            let accepted = "0, or more than the deepest scratch and 1e-9 or more";
            if base_mm <= least {
                return Err(Error::number("base_mm", base_mm, accepted));
            }
        }
        let plan = arrangement::arrange(&patches);
        let faces = faces::triangulate(plan, &patches)?;
        Ok(lift::lift(&faces, &patches, base_mm))
    }

    fn window(&self, region: &MeshRegion) -> Result<Window> {
        for i in 0..2 {
            in_range("low_uv", region.low_uv[i], -1e9, 1e9)?;
            in_range("high_uv", region.high_uv[i], -1e9, 1e9)?;
        }
        let scale = self.mm_per_scene_unit * self.units_per_uv;
        let [low, high] = [region.low_uv, region.high_uv].map(|uv| DVec2::from(uv) * scale);
        if !(low.cmplt(high).all() && (high - low).is_finite()) {
            let accepted = "more than low_uv, u and v both";
            return Err(Error::text("high_uv", "not above low_uv", accepted));
        }
        Ok(Window { low, high })
    }
}
