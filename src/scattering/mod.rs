//! How scratches reflect: a pattern, a shading point and a view in; a BRDF out.
//!
//! What depends on the view is done once per shading point ([`Shading::shade`]): the footprint query, what
//! each zone shows of itself, and how much that weighs in the pixel. Each light then costs a pass over the
//! zones ([`Shading::eval`]). Nothing here allocates, locks or fails.

mod abreast;
mod alone;
mod bounces;
mod eval;
mod exchange;
mod flocks;
mod footprint;
mod gloss;
mod hosted;
mod lights;
mod look;
mod many;
mod near;
mod relief;
mod reverse;
mod sample;
mod shading;
mod slopes;
mod visibility;
mod visit;
mod walk;
mod zones;

pub use crate::lanes::set_simd;
#[cfg(feature = "files")]
pub(crate) use alone::Centred;
pub use alone::CrossFootprint;
pub use bounces::Bounces;
pub use eval::Output;
pub use look::Parameters;
pub use many::Vectors;
pub use sample::{Evaluated, Sample};
pub use shading::Shading;
pub use zones::SeenZone;
