//! A shading point as a renderer knows it, and the millimetres it means.

use super::region::Region;
use crate::error::{Error, Result};
use glam::{DMat2, DVec2, DVec3, Vec3};

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
        let z = direction(point.normal).ok_or(Error::number(
            "normal",
            f64::from(point.normal[0] + point.normal[1] + point.normal[2]),
            "a finite vector other than zero",
        ))?;
        let du = direction(point.dp_du).unwrap_or(DVec3::ZERO);
        let tangent = du - z * z.dot(du);
        let x = if tangent.length_squared() > 1e-16 {
            tangent.normalize()
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
        if !uv.is_finite() {
            let accepted = "finite texture coordinates";
            return Err(Error::number("uv", uv.x + uv.y, accepted));
        }
        let (x, y) = (frame.x.as_dvec3(), frame.y.as_dvec3());
        let step = |dp: [f32; 3]| {
            let dp = Vec3::from(dp).as_dvec3();
            DVec2::new(dp.dot(x), dp.dot(y)) * mm_per_unit
        };
        let to_mm = DMat2::from_cols(step(point.dp_du), step(point.dp_dv));
        let area = to_mm.determinant();
        let from_mm = to_mm.inverse();
        if !to_mm.is_finite() || area == 0.0 || !from_mm.is_finite() {
            let accepted =
                "finite derivatives that span the tangent plane (area dp_du x dp_dv not 0)";
            return Err(Error::number("dp_du, dp_dv", area, accepted));
        }
        Ok(Self { uv, to_mm, from_mm })
    }

    /// The footprint on the tangent plane, mm around the point. A footprint that is none (zero, infinite,
    /// NaN) is a point, and an error besides.
    pub(crate) fn region(&self, footprint: &Footprint, mm_per_unit: f64) -> (Region, Result<()>) {
        let edge = |duv: [f32; 2]| self.to_mm * DVec2::new(f64::from(duv[0]), f64::from(duv[1]));
        let (name, given, a, b) = match *footprint {
            Footprint::Point => return (point_region(), Ok(())),
            Footprint::Radius(radius) => {
                // A negative radius is no radius.
                let side = 2.0 * f64::from(radius).max(0.0) * mm_per_unit;
                let (a, b) = (DVec2::new(side, 0.0), DVec2::new(0.0, side));
                ("footprint radius", f64::from(radius), a, b)
            }
            Footprint::Differentials { duv_dx, duv_dy } => {
                let (a, b) = (edge(duv_dx), edge(duv_dy));
                let given = DVec2::new(a.length(), b.length()).max_element();
                ("footprint duv_dx, duv_dy", given, a, b)
            }
        };
        let longest = a.length().max(b.length());
        if longest > 0.0 && longest < 1e12 && a.is_finite() && b.is_finite() {
            return (Region::parallelogram(a, b), Ok(()));
        }
        let accepted = "a size above 0 and below 1e12 mm, or a point footprint";
        (point_region(), Err(Error::number(name, given, accepted)))
    }

    /// How far in (u, v) a distance in mm reaches at most.
    pub(crate) fn reach_uv(&self, mm: f64) -> DVec2 {
        let rows = self.from_mm.transpose();
        DVec2::new(rows.x_axis.length(), rows.y_axis.length()) * mm
    }

    /// From mm around the point to (u, v).
    pub(crate) fn place_uv(&self, mm: DVec2) -> DVec2 {
        self.uv + self.from_mm * mm
    }
}

fn point_region() -> Region {
    Region::parallelogram(DVec2::ZERO, DVec2::ZERO)
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
