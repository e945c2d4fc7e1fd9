//! The C face: handles, argument checks, the panic guard, error texts. No maths.
//!
//! `include/striae.h` is generated from this folder; what its functions say is written here.

#![allow(
    unsafe_code,
    reason = "C callers pass raw pointers; every block says what makes it sound"
)]
#![allow(
    clippy::doc_markdown,
    reason = "the documentation here is Doxygen's, in the C header"
)]
#![allow(
    clippy::missing_safety_doc,
    reason = "each function's documentation is the C header's: what pointers must be is said there"
)]

#[cfg(feature = "files")]
mod baseline;
mod brdf;
mod cross_section;
#[cfg(feature = "files")]
mod files;
mod generator;
mod handle;
mod hardness;
mod hits;
mod host_brdf;
mod many;
mod material;
mod near;
mod pattern;
#[cfg(feature = "files")]
mod plot;
mod relief_mesh;
mod sampling;
mod shading;
mod status;
mod surface;
#[cfg(feature = "svg")]
mod svg;
mod tool;
mod zones;

#[cfg(feature = "files")]
pub use baseline::*;
pub use brdf::*;
pub use cross_section::*;
#[cfg(feature = "files")]
pub use files::*;
pub use generator::*;
pub use hardness::*;
pub use hits::*;
pub use host_brdf::*;
pub use many::*;
pub use material::*;
pub use near::*;
pub use pattern::*;
#[cfg(feature = "files")]
pub use plot::*;
pub use relief_mesh::*;
pub use sampling::*;
pub use shading::*;
pub use status::*;
pub use surface::*;
#[cfg(feature = "svg")]
pub use svg::*;
pub use tool::*;
pub use zones::*;
