//! A shading point as a renderer knows it, and the millimetres it means.

use super::region::THINNEST_MM;
use crate::error::{Error, Result, all_finite, in_range};
use crate::unit;
use core::f64::consts::FRAC_1_SQRT_2;
use glam::{DMat2, DVec2, Vec3};

/// Longer footprints are taken for mistakes.
const LONGEST_MM: f64 = 1e12;

/// Derivatives and normals whose box has less than one in so many of the volume that their lengths could span are
/// looked at closely.
const MOST_SKEW: f32 = 1e3;

/// So are shorter ones, squared: single precision loses their digits.
const SHORTEST: f32 = 1e-20;

/// What single precision may add to the box's volume, as a share of what their lengths could span.
const ROUNDING: f32 = 2e-6;

/// Points farther out in texture space are looked at closely.
const FARTHEST_UV: f64 = 1e300;

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
        Self::of(point.normal, point.dp_du)
    }

    /// No frame: nothing has a direction in it.
    pub(crate) const NONE: Self = Self {
        x: Vec3::ZERO,
        y: Vec3::ZERO,
        z: Vec3::ZERO,
    };

    /// The same by all of the point that counts.
    #[inline(always)]
    pub(crate) fn of(normal: [f32; 3], dp_du: [f32; 3]) -> Result<Self> {
        let Some(z) = unit(normal) else {
            return Err(no_normal(normal));
        };
        let du = Vec3::from(dp_du).as_dvec3();
        let tangent = du - z * z.dot(du);
        let square = tangent.length_squared();
        // Not a number where dP/du is none.
        let x = if square > 1e-16 * du.length_squared() && square < f64::MAX {
            tangent * (1.0 / square.sqrt())
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

impl SurfacePoint {
    /// A box in (u, v) that holds all within reach of the footprint, told at a glance: most points have no scratch
    /// near, and need no frame. None for points that ask for a closer look, and for those that are not usable.
    #[inline(always)]
    pub(crate) fn box_at_a_glance(&self, mm_per_unit: f64, reach_mm: f64) -> Option<[DVec2; 2]> {
        let [du, dv, normal] = [self.dp_du, self.dp_dv, self.normal].map(Vec3::from);
        let squares = [du, dv, normal].map(Vec3::length_squared);
        let [du_length, dv_length, length] = squares.map(f32::sqrt);
        let span = du_length * dv_length * length;
        let volume = du.cross(dv).dot(normal).abs() - ROUNDING * span;
        let is_long = squares.iter().all(|square| *square > SHORTEST);
        if !(is_long && span < MOST_SKEW * volume) {
            return None;
        }
        let [du_length, dv_length, length] = [du_length, dv_length, length].map(f64::from);
        // A step of 1 mm is the less far in u the longer dP/du, the farther the more it leans towards dP/dv.
        let uv_per_mm =
            DVec2::new(dv_length, du_length) * (length / (f64::from(volume) * mm_per_unit));
        let (half, reach_mm, longest_mm) = match self.footprint {
            Footprint::Point => (DVec2::ZERO, reach_mm, THINNEST_MM),
            Footprint::Radius(radius) => {
                let side = 2.0 * f64::from(radius) * mm_per_unit;
                (DVec2::ZERO, reach_mm + side * FRAC_1_SQRT_2, side)
            }
            Footprint::Differentials { duv_dx, duv_dy } => {
                let [x, y] = [duv_dx, duv_dy].map(|[u, v]| DVec2::new(u.into(), v.into()).abs());
                let half = 0.5 * (x + y);
                let longest = (half.x * du_length + half.y * dv_length) * 2.0 * mm_per_unit;
                (half, reach_mm, longest)
            }
        };
        // What makes a sliver a region may widen it by so much.
        let reach_mm = reach_mm + THINNEST_MM + 1e-7 * longest_mm;
        if !(longest_mm > 0.0 && longest_mm < LONGEST_MM) {
            return None;
        }
        let uv = DVec2::from(self.uv);
        let reach = half + uv_per_mm * reach_mm;
        // Sooner told than which numbers are finite.
        let is_near = uv.abs().cmplt(DVec2::splat(FARTHEST_UV)).all();
        is_near.then_some([uv - reach, uv + reach])
    }
}

/// Why it is no normal.
#[cold]
fn no_normal(normal: [f32; 3]) -> Error {
    let accepted = "a vector of any length above 0";
    let none = Error::number("normal", 0.0, accepted);
    all_finite("normal", &normal).err().unwrap_or(none)
}

/// Why its texture coordinates and derivatives, which span this area, are none.
#[cold]
fn no_metric(point: &SurfacePoint, area: f64) -> Error {
    if let Some(&value) = point.uv.iter().find(|value| !value.is_finite()) {
        return Error::number("uv", value, "finite numbers only");
    }
    let finite = all_finite("dp_du", &point.dp_du).and(all_finite("dp_dv", &point.dp_dv));
    let accepted = "derivatives that span the tangent plane: an area above 0";
    let flat = Error::number("dp_du x dp_dv", area, accepted);
    finite.err().unwrap_or(flat)
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
    #[inline(always)]
    pub(crate) fn at(point: &SurfacePoint, frame: &Frame, mm_per_unit: f64) -> Result<Self> {
        let uv = DVec2::from(point.uv);
        let (x, y) = (frame.x.as_dvec3(), frame.y.as_dvec3());
        let step = |dp: [f32; 3]| {
            let dp = Vec3::from(dp).as_dvec3();
            DVec2::new(dp.dot(x), dp.dot(y)) * mm_per_unit
        };
        let to_mm = DMat2::from_cols(step(point.dp_du), step(point.dp_dv));
        let area = to_mm.determinant();
        let from_mm = to_mm.inverse();
        // Sooner told than by looking at each: 0 unless any is endless or no number.
        let all = to_mm.x_axis + to_mm.y_axis + from_mm.x_axis + from_mm.y_axis;
        let none = (uv * 0.0 + all * 0.0).element_sum();
        if none == 0.0 && area != 0.0 {
            return Ok(Self { uv, to_mm, from_mm });
        }
        Err(no_metric(point, area))
    }

    /// The edges of the footprint on the tangent plane, mm, which is a parallelogram around the point. A footprint that is
    /// none (zero, infinite, NaN) is a point, and an error besides.
    #[inline(always)]
    pub(crate) fn edges(
        &self,
        footprint: &Footprint,
        mm_per_unit: f64,
    ) -> ([DVec2; 2], Result<()>) {
        match self.checked_edges(footprint, mm_per_unit) {
            Ok(edges) => (edges, Ok(())),
            Err(error) => ([DVec2::ZERO; 2], Err(error)),
        }
    }

    #[inline(always)]
    fn checked_edges(&self, footprint: &Footprint, mm_per_unit: f64) -> Result<[DVec2; 2]> {
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
        let square = edges[0].length_squared().max(edges[1].length_squared());
        if square > 0.0 && square < LONGEST_MM * LONGEST_MM {
            return Ok(edges);
        }
        let longest = square.sqrt();
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
    use crate::pattern::{Reach, Region};
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

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

    /// What is told at a glance holds all that a close look finds within reach, however skewed the derivatives and
    /// whatever the footprint; where it does not tell, nothing is lost.
    #[test]
    fn glance_holds_the_exact_box() {
        let mut rng = StdRng::seed_from_u64(3);
        let mut told = 0;
        for i in 0..2000 {
            let mut vector = || [0; 3].map(|_| rng.random::<f32>() - 0.5);
            let (dp_du, dp_dv, normal) = (vector(), vector(), vector());
            let [a, b] = [vector(), vector()].map(|[u, v, _]| [u * 1e-3, v * 1e-3]);
            let point = SurfacePoint {
                uv: [0.3, 0.7],
                dp_du,
                // Every fifth is a sliver of a chart.
                dp_dv: if i % 5 == 0 {
                    [0, 1, 2].map(|k| dp_du[k] + 1e-7 * dp_dv[k])
                } else {
                    dp_dv
                },
                normal,
                footprint: match i % 3 {
                    0 => Footprint::Point,
                    1 => Footprint::Radius(a[0].abs()),
                    _ => Footprint::Differentials {
                        duv_dx: a,
                        duv_dy: b,
                    },
                },
            };
            let Some([low, high]) = point.box_at_a_glance(10.0, 0.02) else {
                continue;
            };
            told += 1;
            let frame = Frame::at(&point).unwrap();
            let metric = Metric::at(&point, &frame, 10.0).unwrap();
            let ([a, b], status) = metric.edges(&point.footprint, 10.0);
            let footprint = Region::parallelogram(a, b);
            status.unwrap();
            let reach = Reach::new(&metric, &footprint, 0.02);
            let [exact_low, exact_high] = reach.box_uv();
            let slack = DVec2::splat(1e-6) * (high - low);
            let held =
                (low - slack).cmple(exact_low).all() && (high + slack).cmpge(exact_high).all();
            assert!(
                held,
                "{point:?}: {low}..{high} does not hold {exact_low}..{exact_high}"
            );
        }
        assert!(told > 1500, "only {told} of 2000 points were told");
    }

    /// A point that is none is left to the close look, which says why.
    #[test]
    fn glance_leaves_unusable_points() {
        let good = SurfacePoint {
            uv: [0.0; 2],
            dp_du: [1.0, 0.0, 0.0],
            dp_dv: [0.0, 1.0, 0.0],
            normal: [0.0, 0.0, 1.0],
            footprint: Footprint::Radius(1.0),
        };
        assert!(good.box_at_a_glance(1.0, 0.1).is_some(), "a good point");
        let nan = f32::NAN;
        let bad = [
            SurfacePoint {
                uv: [f64::NAN, 0.0],
                ..good
            },
            SurfacePoint {
                dp_du: [0.0; 3],
                ..good
            },
            SurfacePoint {
                dp_du: [nan, 0.0, 0.0],
                ..good
            },
            SurfacePoint {
                dp_dv: good.dp_du,
                ..good
            },
            SurfacePoint {
                normal: [0.0; 3],
                ..good
            },
            SurfacePoint {
                normal: [f32::INFINITY, 0.0, 0.0],
                ..good
            },
            SurfacePoint {
                footprint: Footprint::Radius(0.0),
                ..good
            },
            SurfacePoint {
                footprint: Footprint::Radius(nan),
                ..good
            },
            SurfacePoint {
                footprint: Footprint::Radius(f32::MAX),
                ..good
            },
            SurfacePoint {
                footprint: Footprint::Differentials {
                    duv_dx: [0.0; 2],
                    duv_dy: [0.0; 2],
                },
                ..good
            },
        ];
        for point in bad {
            assert!(point.box_at_a_glance(1.0, 0.1).is_none(), "{point:?}");
        }
    }
}
