//! Whether scratches may matter at a point at all: far less than to shade it, for renderers that shade what is unscratched
//! themselves.

use super::relief::LONGEST_SHADOW;
use crate::pattern::{Pattern, SurfacePoint};
use glam::Vec3;

/// The shift of relief against the plane at a grazing view is followed to this many times its height.
const LONGEST_PARALLAX: f32 = 20.0;

/// Single precision may find a view's square that much smaller.
const ROUNDING: f32 = 1e-6;

impl Pattern {
    /// Whether scratches may matter at a point that is seen from `view` (in the frame of the point's normal, away from the
    /// surface, of any length above 0), or from anywhere. Where it says no,
    /// [`Shading::shade`](crate::scattering::Shading::shade) finds none, and the point reflects what the unscratched surface
    /// does; where it says yes there may be none all the same. A point or view that is refused there may have any. Allocates
    /// nothing.
    #[inline(always)]
    pub fn is_near(&self, point: &SurfacePoint, view: Option<[f32; 3]>) -> bool {
        let slope = view.map_or(LONGEST_PARALLAX, |view| slope(view, point.normal));
        match point.box_at_a_glance(self.mm_per_scene_unit, reach_mm(self, slope)) {
            None => true,
            Some([low, high]) => self.touches(low, high) && self.holds_any(low, high),
        }
    }
}

/// How far from the footprint a scratch can matter: by its width, by parallax, by its shadow. The view moves so far along
/// the surface while it rises by 1; if that is no number, as far as any.
#[inline(always)]
pub(super) fn reach_mm(pattern: &Pattern, slope: f32) -> f64 {
    let extent = pattern.extent;
    let parallax = slope.min(LONGEST_PARALLAX);
    let reach =
        extent.half_width_mm + extent.rise_mm * LONGEST_SHADOW + extent.height_mm * parallax;
    f64::from(reach)
}

/// How far a view moves along the surface while it rises by 1, and no less. Of one from below: as far as any; of one that
/// is none, or too long or short for its square, no number.
#[inline(always)]
fn slope(view: [f32; 3], normal: [f32; 3]) -> f32 {
    let (view, normal) = (Vec3::from(view), Vec3::from(normal));
    let up = view.dot(normal);
    let square = view.length_squared() * normal.length_squared() * (1.0 + ROUNDING) / (up * up);
    if up > 0.0 {
        (square - 1.0).sqrt()
    } else {
        f32::INFINITY
    }
}
