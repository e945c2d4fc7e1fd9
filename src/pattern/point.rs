//! A shading point as a renderer knows it, and the millimetres it means.

use super::region::Region;
use crate::error::{Error, Result, all_finite, in_range};
use glam::{DMat2, DVec2, DVec3, Vec3};

/// Longer footprints are taken for mistakes.
const LONGEST_MM: f64 = 1e12;

/// What a pixel covers of the surface around a shading point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Footprint {
    /// Nothing but the point itself.
    #[default]
    Point,
    /// A square along x and y that reaches so far from the point on each side, in scene units.
    Radius(f32),
    /// The parallelogram centred on the point with these edges in (u, v): one pixel's step in x and in y.
    Differentials {
        /// (du/dx, dv/dx)
        duv_dx: [f32; 2],
        /// (du/dy, dv/dy)
        duv_dy: [f32; 2],
    },
}

/// A point of the surface, in any frame of the renderer's (`normal`, `dp_du` and `dp_dv` in the same one).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Texture coordinates.
    pub uv: [f64; 2],
    /// Derivative of position by u, scene units.
    pub dp_du: [f32; 3],
    /// Derivative of position by v, scene units.
    pub dp_dv: [f32; 3],
    /// Surface normal, of any length above 0.
    pub normal: [f32; 3],
    /// What the pixel covers.
    pub footprint: Footprint,
}

/// A surface's local frame: x along dP/du, z the normal, y = z × x; all of unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// dP/du made orthogonal to z.
    pub x: Vec3,
    /// z × x
    pub y: Vec3,
    /// The surface normal.
    pub z: Vec3,
}

impl Frame {
    /// The frame at a point. Without a usable `dp_du` (zero, or along the normal) x is any tangent.
    ///
    /// Errors: `normal` is zero or not finite.
    pub fn at(point: &SurfacePoint) -> Result<Self> {
        all_finite("normal", &point.normal)?;
        let accepted = "a vector of any length above 0";
        let z = direction(point.normal).ok_or(Error::number("normal", 0.0, accepted))?;
        let du = Vec3::from(point.dp_du).as_dvec3();
        let tangent = du - z * z.dot(du);
        let square = tangent.length_squared();
        // Not a number where dP/du is none.
        let x = if square > 1e-16 * du.length_squared() && square.is_finite() {
            tangent / square.sqrt()
        } else {
            z.any_orthonormal_vector()
        };
        Ok(Self {
            x: x.as_vec3(),
            y: z.cross(x).as_vec3(),
            z: z.as_vec3(),
        })
    }

    /// A vector of the surface's own coordinates in this frame.
    pub fn to_local(&self, world: Vec3) -> Vec3 {
        Vec3::new(self.x.dot(world), self.y.dot(world), self.z.dot(world))
    }

    /// The other way round.
    pub fn to_world(&self, local: Vec3) -> Vec3 {
        self.x * local.x + self.y * local.y + self.z * local.z
    }
}

/// Unit length in double precision: single precision would lose small and large vectors, and
/// denormal ones under flush-to-zero.
fn direction(v: [f32; 3]) -> Option<DVec3> {
    Vec3::from(v).as_dvec3().try_normalize()
}

/// Texture space and the tangent plane around one point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Metric {
    pub uv: DVec2,
    /// From a step in (u, v) to mm in the local frame.
    pub to_mm: DMat2,
    from_mm: DMat2,
}

impl Metric {
    /// Errors: texture coordinates or derivatives that are not finite, or derivatives that span no plane.
    pub(crate) fn at(point: &SurfacePoint, frame: &Frame, mm_per_unit: f64) -> Result<Self> {
        let uv = DVec2::from(point.uv);
        if let Some(&value) = point.uv.iter().find(|value| !value.is_finite()) {
            return Err(Error::number("uv", value, "finite numbers only"));
        }
        all_finite("dp_du", &point.dp_du)?;
        all_finite("dp_dv", &point.dp_dv)?;
        let (x, y) = (frame.x.as_dvec3(), frame.y.as_dvec3());
        let step = |dp: [f32; 3]| {
            let dp = Vec3::from(dp).as_dvec3();
            DVec2::new(dp.dot(x), dp.dot(y)) * mm_per_unit
        };
        let to_mm = DMat2::from_cols(step(point.dp_du), step(point.dp_dv));
        let area = to_mm.determinant();
        let from_mm = to_mm.inverse();
        if !to_mm.is_finite() || area == 0.0 || !from_mm.is_finite() {
            let accepted = "derivatives that span the tangent plane: an area above 0";
            return Err(Error::number("dp_du x dp_dv", area, accepted));
        }
        Ok(Self { uv, to_mm, from_mm })
    }

    /// The footprint on the tangent plane, mm around the point. A footprint that is none (zero, infinite,
    /// NaN) is a point, and an error besides.
    pub(crate) fn region(&self, footprint: &Footprint, mm_per_unit: f64) -> (Region, Result<()>) {
        match self.edges(footprint, mm_per_unit) {
            Ok([a, b]) => (Region::parallelogram(a, b), Ok(())),
            Err(error) => (Region::parallelogram(DVec2::ZERO, DVec2::ZERO), Err(error)),
        }
    }

    fn edges(&self, footprint: &Footprint, mm_per_unit: f64) -> Result<[DVec2; 2]> {
        let (name, edges) = match *footprint {
            Footprint::Point => return Ok([DVec2::ZERO; 2]),
            Footprint::Radius(radius) => {
                in_range(
                    "radius",
                    f64::from(radius),
                    f64::MIN_POSITIVE,
                    f64::from(f32::MAX),
                )?;
                let side = 2.0 * f64::from(radius) * mm_per_unit;
                ("radius", [DVec2::new(side, 0.0), DVec2::new(0.0, side)])
            }
            Footprint::Differentials { duv_dx, duv_dy } => {
                all_finite("duv_dx", &duv_dx)?;
                all_finite("duv_dy", &duv_dy)?;
                let edge =
                    |[du, dv]: [f32; 2]| self.to_mm * DVec2::new(f64::from(du), f64::from(dv));
                ("duv_dx and duv_dy", [edge(duv_dx), edge(duv_dy)])
            }
        };
        let longest = edges[0].length().max(edges[1].length());
        if longest > 0.0 && longest < LONGEST_MM {
            return Ok(edges);
        }
        let accepted = "a footprint above 0 and below 1e12 mm, or a point footprint";
        Err(Error::number(name, longest, accepted))
    }

    /// How far in (u, v) a distance in mm reaches at most.
    pub(crate) fn reach_uv(&self, mm: f64) -> DVec2 {
        let rows = self.from_mm.transpose();
        DVec2::new(rows.x_axis.length(), rows.y_axis.length()) * mm
    }

    /// A step in mm as one in (u, v).
    pub(crate) fn step_uv(&self, mm: DVec2) -> DVec2 {
        self.from_mm * mm
    }

    /// From mm around the point to (u, v).
    pub(crate) fn place_uv(&self, mm: DVec2) -> DVec2 {
        self.uv + self.from_mm * mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames hold at any scale of the vectors they are made from.
    #[test]
    fn frame_of_tiny_and_huge_vectors() {
        for scale in [1e-38_f32, 1e-20, 1.0, 1e20, 1e38] {
            let point = SurfacePoint {
                uv: [0.0; 2],
                dp_du: [scale, 0.0, scale],
                dp_dv: [0.0, scale, 0.0],
                normal: [0.0, 0.0, scale],
                footprint: Footprint::Point,
            };
            let frame = Frame::at(&point).unwrap();
            assert!(frame.x.abs_diff_eq(Vec3::X, 1e-6), "{scale}: {frame:?}");
            assert!(
                frame.to_local(Vec3::Y).abs_diff_eq(Vec3::Y, 1e-6),
                "{scale}: {frame:?}"
            );
        }
    }
}
