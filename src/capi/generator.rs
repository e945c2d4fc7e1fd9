//! Generators for C.

use super::cross_section::depth_law;
use super::handle::{borrowed, exclusive};
use super::material::StriaeMaterial;
use super::pattern::{StriaePatternBuilder, held};
use super::status::{StriaeStatus, check_struct_size, guard};
use super::tool::StriaeTool;
use crate::error::{Error, Result};
use crate::formation::{DepthLaw, Orientation};
use crate::pattern::{Amount, Distribution, Generated, Generator, Held, Style};

/// Generators by name. All numbers are of our choosing: somewhere to begin. Forces suit metals and a sharp tool, such
/// as STRIAE_TOOL_PRESET_ABRASIVE_GRAIN.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeStyle {
    /// Straight scratches in every direction: 20 on a cm², 2 to 20 mm long.
    Straight = 0,
    /// A brushed finish: fine, dense, nearly parallel to u.
    Brushed = 1,
    /// What a buffing wheel or a cloth moved in circles leaves: fine arcs, all bent to the left.
    Swirls = 2,
    /// Years of handling: fine scratches of every size and direction, mostly short and light, few long and deep.
    Handling = 3,
}

/// Kinds of distribution.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeDistributionKind {
    /// Every value from `from` to `to` alike; the same for all where both are the same.
    Uniform = 0,
    /// Normal, mean `middle` and standard deviation `deviation` (0 to 1e9), cut at both ends.
    Normal = 1,
    /// Normal in the logarithm, median `middle`, standard deviation of the natural logarithm `deviation` (0 to 10), cut
    /// at both ends.
    LogNormal = 2,
    /// A density that falls like the value to the power of -`exponent` (-10 to 10); `from` is above 0.
    PowerLaw = 3,
    /// A density that falls by a factor e with every `decay` (1e-9 to 1e9).
    Exponential = 4,
}

/// How a quantity varies from scratch to scratch: always between `from` and `to`. Fields that the kind does not name
/// are ignored.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeDistribution {
    /// A StriaeDistributionKind.
    pub kind: u32,
    /// Least: the quantity's field says what there may be.
    pub from: f64,
    /// Most, not below `from`.
    pub to: f64,
    /// Normal: the mean; log-normal: the median, above 0; both before the cut, and between `from` and `to`.
    pub middle: f64,
    /// Normal and log-normal: the standard deviation.
    pub deviation: f64,
    /// Power law: the density falls like the value to the power of minus this.
    pub exponent: f64,
    /// Exponential: the density falls by a factor e with each.
    pub decay: f64,
}

/// Scratches by the many. Set struct_size to sizeof(StriaeGenerator), fill it with striae_generator_preset() and change what
/// you like.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeGenerator {
    /// sizeof(StriaeGenerator)
    pub struct_size: usize,
    /// How many in all, 1e8 at most; 0 to go by `per_cm2`.
    pub count: u32,
    /// How many on each cm² of the area, 0 to 1e8, where `count` is 0; in all rounded to a whole number, 1e8 at most.
    pub per_cm2: f64,
    /// Two opposite corners of a rectangle, (u, v), -1e6 to 1e6, the first one lower in both. The scratches' middles
    /// are spread over it evenly; their ends may reach beyond.
    pub area_uv: [[f64; 2]; 2],
    /// Length along the path, mm, 1e-6 to 1e6.
    pub length_mm: StriaeDistribution,
    /// Normal force in full, kgf, 0 to 100000.
    pub force_kgf: StriaeDistribution,
    /// Depth under load in full, mm, 0 to 1000: counts under STRIAE_DEPTH_LAW_STATED only.
    pub depth_mm: StriaeDistribution,
    /// Main direction, counter-clockwise from u on the surface, degrees, -3600 to 3600. A bent scratch has it on
    /// average between its two ends.
    pub direction_deg: f64,
    /// Standard deviation from the main direction, degrees: 0 (parallel) to 360 (every direction alike).
    pub spread_deg: f64,
    /// How much a path turns from start to end on average, to the left, degrees, -3600 to 3600. No single curve turns
    /// by more than 90 degrees.
    pub turn_deg: f64,
    /// Standard deviation of that from scratch to scratch, degrees, 0 to 3600.
    pub turn_spread_deg: f64,
    /// Standard deviation of a single curve's turn from its share of the whole, degrees, 0 to 90.
    pub wander_deg: f64,
    /// Curves in a path, of equal length, 1 to 64.
    pub curves: u32,
    /// Shares of the length over which force or depth rise from 0 and fall back to it, each 0 to 1, together 1 at most.
    pub taper: [f64; 2],
    /// Spin about the tool's own axis, counter-clockwise from above, degrees, -3600 to 3600.
    pub spin_deg: f64,
    /// Standard deviation of the spin from scratch to scratch, degrees, 0 to 360.
    pub spin_spread_deg: f64,
    /// Angle between the tool's axis and the surface normal, degrees, 0 to 85; less than lays its flank on the surface.
    pub tilt_deg: f64,
    /// Where the axis leans to, degrees, -3600 to 3600: StriaeHeld says from where.
    pub azimuth_deg: f64,
    /// A StriaeHeld; STRIAE_HELD_TO_SURFACE gives each scratch cross-sections of its own, which takes memory.
    pub held: u32,
    /// A StriaeDepthLaw.
    pub depth_law: u32,
}

impl From<Distribution> for StriaeDistribution {
    fn from(distribution: Distribution) -> Self {
        let c = Self {
            kind: 0,
            from: 0.0,
            to: 0.0,
            middle: 0.0,
            deviation: 0.0,
            exponent: 0.0,
            decay: 1.0,
        };
        match distribution {
            Distribution::Uniform { from, to } => Self { from, to, ..c },
            Distribution::Normal {
                from,
                to,
                middle,
                deviation,
            } => Self {
                kind: 1,
                from,
                to,
                middle,
                deviation,
                ..c
            },
            Distribution::LogNormal {
                from,
                to,
                middle,
                deviation,
            } => Self {
                kind: 2,
                from,
                to,
                middle,
                deviation,
                ..c
            },
            Distribution::PowerLaw { from, to, exponent } => Self {
                kind: 3,
                from,
                to,
                exponent,
                ..c
            },
            Distribution::Exponential { from, to, decay } => Self {
                kind: 4,
                from,
                to,
                decay,
                ..c
            },
        }
    }
}

impl StriaeDistribution {
    fn checked(&self, kind_name: &'static str) -> Result<Distribution> {
        let &Self {
            kind,
            from,
            to,
            middle,
            deviation,
            exponent,
            decay,
        } = self;
        match kind {
            0 => Ok(Distribution::Uniform { from, to }),
            1 => Ok(Distribution::Normal {
                from,
                to,
                middle,
                deviation,
            }),
            2 => Ok(Distribution::LogNormal {
                from,
                to,
                middle,
                deviation,
            }),
            3 => Ok(Distribution::PowerLaw { from, to, exponent }),
            4 => Ok(Distribution::Exponential { from, to, decay }),
            other => {
                let accepted = "a StriaeDistributionKind, 0 to 4";
                Err(Error::number(kind_name, f64::from(other), accepted))
            }
        }
    }
}

impl From<Generator> for StriaeGenerator {
    fn from(made: Generator) -> Self {
        let (count, per_cm2) = match made.amount {
            Amount::Count(count) => (count, 0.0),
            Amount::PerCm2(per_cm2) => (0, per_cm2),
        };
        let Orientation {
            spin_deg,
            tilt_deg,
            azimuth_deg,
        } = made.orientation;
        Self {
            struct_size: size_of::<Self>(),
            count,
            per_cm2,
            area_uv: made.area_uv,
            length_mm: made.length_mm.into(),
            force_kgf: made.force_kgf.into(),
            depth_mm: made.depth_mm.into(),
            direction_deg: made.direction_deg,
            spread_deg: made.spread_deg,
            turn_deg: made.turn_deg,
            turn_spread_deg: made.turn_spread_deg,
            wander_deg: made.wander_deg,
            curves: made.curves,
            taper: made.taper,
            spin_deg,
            spin_spread_deg: made.spin_spread_deg,
            tilt_deg,
            azimuth_deg,
            held: match made.held {
                Held::ToPath => 0,
                Held::ToSurface => 1,
            },
            depth_law: match made.depth_law {
                DepthLaw::Bosch2004 => 0,
                DepthLaw::ScratchHardness => 1,
                DepthLaw::Stated => 2,
            },
        }
    }
}

impl StriaeGenerator {
    fn checked(&self) -> Result<Generator> {
        let size = size_of::<Self>();
        check_struct_size(self.struct_size, size, "sizeof(StriaeGenerator)")?;
        Ok(Generator {
            amount: match self.count {
                0 => Amount::PerCm2(self.per_cm2),
                count => Amount::Count(count),
            },
            area_uv: self.area_uv,
            length_mm: self.length_mm.checked("length_mm.kind")?,
            force_kgf: self.force_kgf.checked("force_kgf.kind")?,
            depth_mm: self.depth_mm.checked("depth_mm.kind")?,
            direction_deg: self.direction_deg,
            spread_deg: self.spread_deg,
            turn_deg: self.turn_deg,
            turn_spread_deg: self.turn_spread_deg,
            wander_deg: self.wander_deg,
            curves: self.curves,
            taper: self.taper,
            orientation: Orientation {
                spin_deg: self.spin_deg,
                tilt_deg: self.tilt_deg,
                azimuth_deg: self.azimuth_deg,
            },
            spin_spread_deg: self.spin_spread_deg,
            held: held(self.held)?,
            depth_law: depth_law(self.depth_law)?,
        })
    }
}

/// Fills in a generator by name, for the unit square.
///
/// @param style a StriaeStyle
/// @param generator with struct_size set; the rest is written on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_generator_preset(
    style: u32,
    generator: *mut StriaeGenerator,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or writable with struct_size set, as the header asks.
        let generator = unsafe { exclusive("generator", generator)? };
        let size = size_of::<StriaeGenerator>();
        check_struct_size(generator.struct_size, size, "sizeof(StriaeGenerator)")?;
        let accepted = "a StriaeStyle, 0 to 3";
        let style = Style::ALL
            .get(style as usize)
            .copied()
            .ok_or(Error::number("style", f64::from(style), accepted))?;
        *generator = Generator::style(style).into();
        Ok(())
    })
}

/// Adds generated scratches, on all cores; if one of them is refused, the builder is as it was. The same seed gives the same
/// scratches on every machine and with any number of threads. For layers over each other call again, with other seeds.
///
/// @param builder the builder
/// @param generator how many, how long, how deep, which way and how bent
/// @param tool the tool
/// @param material another hardness and finish than the surface's for these scratches; NULL for the surface's own
/// @param seed another seed, other scratches
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_generate(
    builder: *mut StriaePatternBuilder,
    generator: *const StriaeGenerator,
    tool: *const StriaeTool,
    material: *const StriaeMaterial,
    seed: u64,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (builder, generator, tool) = unsafe {
            (
                exclusive("builder", builder)?,
                borrowed("generator", generator)?,
                borrowed("tool", tool)?,
            )
        };
        // SAFETY: NULL or valid with its layers, as the header asks.
        let material = unsafe { material.as_ref().map(|m| m.checked()).transpose()? };
        let generated = Generated {
            generator: &generator.checked()?,
            tool: &tool.0,
            material: material.as_ref(),
            seed,
        };
        builder.0.generate(&generated).map(drop)
    })
}
