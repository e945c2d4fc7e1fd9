//! Where scratches run: paths and processes in; for a pixel's footprint, the scratches it sees out.
//!
//! Paths are curves in texture space (Bosch et al. 2004, section 5); a scratch carries its cross-section as
//! a continuous function of arc length; a grid finds the pieces near a footprint. All that is asked
//! while rendering neither allocates nor locks.

mod along;
mod arc_length;
mod blank;
mod boxes;
mod builder;
mod caps;
mod center_line;
mod chords;
mod closest;
mod course;
mod crossings;
mod crowd;
mod generator;
mod grid;
mod hit;
mod hits;
mod hosts;
mod kinds;
mod laid;
mod layers;
mod left;
mod lines;
mod lists;
mod mesh;
mod overlap;
mod palette;
mod path;
#[expect(clippy::module_inception, reason = "what the room is for")]
mod pattern;
mod pieces;
mod point;
mod prefilter;
mod profile;
mod query;
mod raster;
mod reader;
mod region;
mod runs;
mod scratch;
#[cfg(feature = "files")]
mod sections;
mod seen;
mod spline;
mod store;
mod stretches;
mod strip;
mod strips;
mod sums;
mod surface;
mod track;
mod tracks;

pub(crate) use boxes::MOST_BOXES;
pub use builder::PatternBuilder;
pub(crate) use center_line::CenterLine;
pub(crate) use crossings::{Covers, Crossing, Cutting, Parts, cut_away};
pub(crate) use crowd::{Crowd, NearCrowd};
#[cfg(feature = "svg")]
pub(crate) use generator::tapered;
pub use generator::{Amount, Distribution, Generated, Generator, Stroke, Strokes, Style};
pub(crate) use hit::Hit;
pub use hits::{Found, ScratchHit};
pub(crate) use layers::Layered;
pub(crate) use left::Left;
pub use mesh::{MeshRegion, MeshZone, ReliefMesh};
pub(crate) use palette::{MOST_CLASS_VERTICES, MOST_CLASSES};
pub use path::{Curve, Path};
pub use pattern::{Pattern, PatternMemory};
pub(crate) use point::Metric;
pub use point::{Footprint, Frame, SurfacePoint};
pub(crate) use profile::Profile;
pub(crate) use query::{Candidates, Reach};
pub(crate) use region::{MOST_CORNERS, Region};
pub use scratch::{Held, Key, Scratch};
#[cfg(feature = "files")]
pub(crate) use sections::{FACTS, SECTIONS, Section, Sections};
pub use spline::{Spline, SplineKind};
pub(crate) use strips::{STRIPS, Strips};
pub use surface::Surface;
pub(crate) use track::MOST_VERTICES;
pub(crate) use tracks::LayerFinish;
