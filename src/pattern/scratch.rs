//! One scratch as its author states it.

use super::path::Path;
use crate::formation::{DepthLaw, Material, Orientation, Tool};

/// One scratch: a tool drawn along a path.
#[derive(Clone, Copy, Debug)]
pub struct Scratch<'a> {
    /// The tool.
    pub tool: &'a Tool,
    /// What it scratches and how the scratch reflects; `None` for the pattern's own material.
    pub material: Option<&'a Material>,
    /// Which law gives the depth.
    pub depth_law: DepthLaw,
    /// What spin and azimuth are relative to.
    pub held: Held,
    /// Where it runs.
    pub path: Path<'a>,
    /// Force and orientation along it: one key or more, ascending in `at`.
    pub keys: &'a [Key],
}

/// What a scratch's spin and azimuth are relative to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum Held {
    /// The direction of travel: the hand turns with the path.
    #[default]
    ToPath,
    /// The surface: the hand does not turn while the path does. Azimuth 0 leans towards +x (dP/du), 90 towards
    /// +y; spin turns with it.
    ToSurface,
}

/// Force and orientation at one place along a scratch; linear in arc length between keys, constant
/// before the first and after the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Share of the path's arc length, 0 to 1.
    pub at: f64,
    /// Normal force, kgf, 0 to 100000.
    pub force_kgf: f64,
    /// Depth under load, mm, 0 to 1000: counts under [`DepthLaw::Stated`] only.
    pub depth_mm: f64,
    /// How the tool is held.
    pub orientation: Orientation,
}

impl<'a> Scratch<'a> {
    /// A scratch with this tool and nothing else stated: its path and keys must be given.
    pub fn new(tool: &'a Tool) -> Self {
        Self {
            tool,
            material: None,
            depth_law: DepthLaw::default(),
            held: Held::default(),
            path: Path::Polyline(&[]),
            keys: &[],
        }
    }
}

impl Key {
    /// A key with a force and an upright tool.
    pub const fn force(at: f64, force_kgf: f64) -> Self {
        let orientation = Orientation {
            spin_deg: 0.0,
            tilt_deg: 0.0,
            azimuth_deg: 0.0,
        };
        Self {
            at,
            force_kgf,
            depth_mm: 0.0,
            orientation,
        }
    }

    /// A key with a stated depth and an upright tool, for [`DepthLaw::Stated`].
    pub const fn depth(at: f64, depth_mm: f64) -> Self {
        Self {
            depth_mm,
            ..Self::force(at, 0.0)
        }
    }

    pub(crate) fn mix(&self, next: &Self, share: f64) -> Self {
        let lerp = |a: f64, b: f64| a + (b - a) * share;
        let (a, b) = (self.orientation, next.orientation);
        Self {
            at: lerp(self.at, next.at),
            force_kgf: lerp(self.force_kgf, next.force_kgf),
            depth_mm: lerp(self.depth_mm, next.depth_mm),
            orientation: Orientation {
                spin_deg: lerp(a.spin_deg, b.spin_deg),
                tilt_deg: lerp(a.tilt_deg, b.tilt_deg),
                azimuth_deg: lerp(a.azimuth_deg, b.azimuth_deg),
            },
        }
    }
}
