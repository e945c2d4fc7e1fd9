//! Generators in pattern files.

use super::super::error::Result;
use super::json::is_default;
use super::scratch::material;
use super::{Made, named};
use crate::formation::{DepthLaw, Material, Tool};
use crate::pattern::{Amount, Distribution, Generated, Generator, Held, PatternBuilder, Style};
use serde::{Deserialize, Serialize};

/// Makes an entry in which every field of a generator may be stated.
macro_rules! generator_entry {
    (
        { $($field:ident: $type:ty,)+ }
        orientation { $($angle:ident,)+ }
    ) => {
        /// Scratches by the many: a style, with whatever is stated here instead of its own.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct GeneratorEntry {
            /// The tool, a name in `tools`.
            pub tool: String,
            /// What is scratched, a name in `materials`; without, the surface.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub material: Option<String>,
            /// Another seed, other scratches.
            pub seed: u64,
            /// Where what is not stated comes from.
            #[serde(default, skip_serializing_if = "is_default")]
            pub style: Style,
            $(
                #[doc = concat!("[`Generator::", stringify!($field), "`].")]
                #[serde(default, skip_serializing_if = "Option::is_none")]
                pub $field: Option<$type>,
            )+
            $(
                #[doc = concat!(
                    "[`Orientation::", stringify!($angle), "`](crate::formation::Orientation::", stringify!($angle), ")."
                )]
                #[serde(default, skip_serializing_if = "Option::is_none")]
                pub $angle: Option<f64>,
            )+
        }

        impl GeneratorEntry {
            /// Nothing but a style.
            pub fn new(tool: &str, style: Style, seed: u64) -> Self {
                Self {
                    tool: tool.to_owned(),
                    material: None,
                    seed,
                    style,
                    $($field: None,)+
                    $($angle: None,)+
                }
            }

            /// The generator that it describes.
            pub fn generator(&self) -> Generator {
                let mut generator = Generator::style(self.style);
                $(generator.$field = self.$field.unwrap_or(generator.$field);)+
                let held = &mut generator.orientation;
                $(held.$angle = self.$angle.unwrap_or(held.$angle);)+
                generator
            }
        }
    };
}

generator_entry! {
    {
        amount: Amount,
        area_uv: [[f64; 2]; 2],
        length_mm: Distribution,
        force_kgf: Distribution,
        depth_mm: Distribution,
        direction_deg: f64,
        spread_deg: f64,
        turn_deg: f64,
        turn_spread_deg: f64,
        wander_deg: f64,
        curves: u32,
        taper: [f64; 2],
        spin_spread_deg: f64,
        held: Held,
        depth_law: DepthLaw,
    }
    orientation { spin_deg, tilt_deg, azimuth_deg, }
}

impl GeneratorEntry {
    pub(super) fn add_to(
        &self,
        builder: &mut PatternBuilder,
        tools: &Made<'_, Tool>,
        materials: &Made<'_, Material>,
    ) -> Result<()> {
        let generated = Generated {
            generator: &self.generator(),
            tool: named("tool", &self.tool, tools, "tools")?,
            material: material(self.material.as_deref(), materials)?,
            seed: self.seed,
        };
        builder.generate(&generated)?;
        Ok(())
    }
}
