//! Physically based scratches for renderers.
//!
//! Data flows one way: [`formation`] makes cross-sections from tools, forces and materials; [`pattern`] runs
//! them along curves in texture space and finds those a pixel sees; [`scattering`] turns what it sees into a
//! BRDF. [`brdf`] holds the base BRDFs of single zones. `files` (a cargo feature, on by default) reads tools from
//! 3D models and whole patterns from JSON, and paths from drawings (the feature `svg`).
//! `baseline` (the feature `files`) has the systems that these ideas replaced, for comparison. `capi` is the C face of the same.
//!
//! After Bosch, Pueyo, Mérillou and Ghazanfarpour, "A Physically-Based Model for Rendering Realistic
//! Scratches", Computer Graphics Forum 23(3), 2004.
//!
//! # Conventions
//! Lengths in mm, forces in kgf (9.80665 N), Vickers hardness in kgf/mm², angles in degrees. At a shading
//! point z is the unit normal, x is dP/du made orthogonal to it, y = z × x. `view` and `light` are unit
//! vectors that point away from the surface. A scratch's cross-section axis points to the right of its
//! travel. Double precision while building, single while shading.
//!
//! # Example
//! ```
//! use striae::brdf::Metal;
//! use striae::formation::{Material, Tool};
//! use striae::pattern::{Footprint, Key, Path, PatternBuilder, Scratch, SurfacePoint};
//! use striae::scattering::{Output, Shading};
//!
//! let titanium = Material::metal(Metal::Titanium);
//! let mut builder = PatternBuilder::new(titanium, 1.0, [100.0, 100.0])?;
//! builder.add(&Scratch {
//!     path: Path::Polyline(&[[0.1, 0.5], [0.9, 0.5]]),
//!     keys: &[Key::force(0.0, 0.5), Key::force(1.0, 4.0)],
//!     ..Scratch::new(&Tool::rockwell_c())
//! })?;
//! let pattern = builder.build();
//!
//! let point = SurfacePoint {
//!     uv: [0.7, 0.5],
//!     dp_du: [100.0, 0.0, 0.0],
//!     dp_dv: [0.0, 100.0, 0.0],
//!     normal: [0.0, 0.0, 1.0],
//!     footprint: Footprint::Radius(0.3),
//! };
//! let mut shading = Shading::default();
//! shading.shade(&pattern, &point, [0.0, 0.0, 1.0])?;
//! let f_cos = shading.eval([0.0, 0.6, 0.8], Output::BrdfCos);
//! assert!(shading.coverage() > 0.3 && f_cos[0] > 0.0);
//! # Ok::<(), striae::Error>(())
//! ```

#[cfg(feature = "files")]
pub mod baseline;
pub mod brdf;
pub mod capi;
mod error;
#[cfg(feature = "files")]
pub mod files;
pub mod formation;
mod lanes;
pub mod pattern;
pub mod scattering;

pub use error::{Error, Result};

/// Unit length at any scale, in double precision: single would lose small and large vectors, and denormal ones under
/// flush-to-zero. Nothing if it has no direction.
#[inline(always)]
pub(crate) fn unit(v: [f32; 3]) -> Option<glam::DVec3> {
    let v = glam::Vec3::from(v).as_dvec3();
    let excess = v.length_squared() - 1.0;
    // Most vectors are of unit length but for rounding: a step of Newton's iteration, without root and division, leaves
    // an error of 4e-11.
    if excess.abs() < 1e-5 {
        return Some(v * (1.0 - 0.5 * excess));
    }
    let by = 1.0 / v.length();
    // False of NaN too. No single is as short or as long as these bounds, which are compared with sooner than 0 and infinity.
    (by > 1e-300 && by < 1e300).then(|| v * by)
}

/// The one place where building precision becomes shading precision.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to single is what it is for"
)]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}
