//! Where scratches run: paths and processes in; for a pixel's footprint, the scratches it sees out.
//!
//! Paths are curves in texture space (Bosch et al. 2004, section 5); a scratch carries its cross-section as
//! a continuous function of arc length; a grid finds the pieces near a footprint. All that is asked
//! while rendering neither allocates nor locks.

mod along;
mod builder;
mod closest;
mod generator;
mod grid;
mod path;
mod pieces;
mod point;
mod query;
mod region;
mod scratch;
mod track;

pub use builder::{Pattern, PatternBuilder};
#[cfg(feature = "svg")]
pub(crate) use generator::tapered;
pub use generator::{Amount, Distribution, Generated, Generator, Stroke, Strokes, Style};
pub use path::Path;
pub(crate) use point::Metric;
pub use point::{Footprint, Frame, SurfacePoint};
pub(crate) use query::Hit;
pub(crate) use region::Region;
pub use scratch::{Held, Key, Scratch};
pub(crate) use track::{Finishes, MOST_VERTICES, Track};
