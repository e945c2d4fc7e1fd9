//! How a scratch is made: tool, orientation, force and hardness in; a cross-section in millimetres out.
//!
//! The tool's lower envelope along its travel is the groove's shape, a depth law says how deep it goes, and
//! the material pushed out stands beside it in two peaks (Bosch et al. 2004, section 3).

mod cross_section;
mod end_cap;
mod envelope;
mod facets;
mod hardness;
mod imprint;
mod material;
mod mesh;
mod orientation;
mod outline;
mod penetration;
mod pileup;
mod plasticity;
mod tool;

pub use cross_section::{CrossSection, Process};
pub(crate) use end_cap::{End, EndCap, SECTORS};
pub(crate) use facets::MOST_FACETS;
pub use hardness::{HardnessMap, Reading};
pub use material::{Layer, MOST_LAYERS, Material};
#[cfg(feature = "files")]
pub(crate) use mesh::MOST_IN_MESH;
pub(crate) use mesh::welded;
pub use orientation::Orientation;
pub use penetration::{DepthLaw, Wanted};
pub use pileup::{Peak, PileUpLaw};
pub use plasticity::Plasticity;
pub use tool::Tool;
#[cfg(feature = "files")]
pub(crate) use tool::check_unit;
