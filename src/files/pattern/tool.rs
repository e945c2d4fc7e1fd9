//! Tools in pattern files.

use super::super::error::Result;
use super::super::mesh::read_tool;
use crate::formation::Tool;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ToolEntry {
    /// By name.
    Preset(ToolName),
    /// [`Tool::sphero_cone`].
    SpheroCone {
        /// Angle between flank and axis, degrees, 5 to 85.
        half_angle_deg: f64,
        /// 0 (sharp) to 100.
        tip_radius_mm: f64,
        /// 1e-6 to 1000.
        height_mm: f64,
    },
    /// [`Tool::pyramid`].
    Pyramid {
        /// 3 to 64.
        sides: u32,
        /// Between opposite faces, degrees, 10 to 170.
        angle_deg: f64,
        /// 1e-6 to 1000.
        height_mm: f64,
    },
    /// [`Tool::wedge`].
    Wedge {
        /// Length of the edge, 1e-6 to 1000.
        width_mm: f64,
        /// Between the faces, degrees, 1 to 170.
        angle_deg: f64,
        /// 1e-6 to 1000.
        height_mm: f64,
    },
    /// [`Tool::profile`].
    Profile {
        /// Corners of the lower edge, (x, z), two or more.
        points_mm: Vec<[f64; 2]>,
    },
    /// [`read_tool`].
    Mesh {
        /// An OBJ, STL or PLY file, relative to the pattern file's folder, with `/` between folders.
        file: String,
        /// The file's unit, 1e-9 to 1e9.
        mm_per_unit: f64,
    },
}

/// Makes the enumeration of names from the functions that make the tools.
macro_rules! tool_names {
    ($($name:ident $make:ident,)+) => {
        /// Tools by name: each is the function of [`Tool`] of that name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum ToolName {
            $(
                #[doc = concat!("[`Tool::", stringify!($make), "`].")]
                $name,
            )+
        }

        impl ToolName {
            /// All names.
            pub const ALL: &[Self] = &[$(Self::$name),+];

            fn tool(self) -> Tool {
                match self {
                    $(Self::$name => Tool::$make(),)+
                }
            }
        }
    };
}

tool_names! {
    RockwellC rockwell_c,
    Vickers vickers,
    Berkovich berkovich,
    Nail nail,
    Screwdriver screwdriver,
    Scriber scriber,
    SquareGraver square_graver,
    RoundGraver round_graver,
    FlatGraver flat_graver,
    Needle needle,
    Key key,
    AbrasiveGrain abrasive_grain,
}

impl ToolEntry {
    pub(super) fn tool(&self, folder: &Path) -> Result<Tool> {
        Ok(match *self {
            Self::Preset(name) => name.tool(),
            Self::SpheroCone {
                half_angle_deg,
                tip_radius_mm,
                height_mm,
            } => Tool::sphero_cone(half_angle_deg, tip_radius_mm, height_mm)?,
            Self::Pyramid {
                sides,
                angle_deg,
                height_mm,
            } => Tool::pyramid(sides, angle_deg, height_mm)?,
            Self::Wedge {
                width_mm,
                angle_deg,
                height_mm,
            } => Tool::wedge(width_mm, angle_deg, height_mm)?,
            Self::Profile { ref points_mm } => Tool::profile(points_mm)?,
            Self::Mesh {
                ref file,
                mm_per_unit,
            } => read_tool(&folder.join(file), mm_per_unit)?,
        })
    }
}
