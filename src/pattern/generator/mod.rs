//! Many scratches at once: how many, how long, how deep, which way and how bent in; single scratches out, one
//! stream of random numbers each.
//!
//! The same seed gives the same scratches, bit by bit, on every machine and in any order of asking: the numbers
//! come from `ChaCha` with 8 rounds, keyed by the seed, its stream numbered like the scratch, and no function of the
//! platform's own mathematics is called. Every quantity is one number between 0 and 1 sent through the inverse of its
//! distribution, so that turning one knob moves the scratches and does not deal them anew.

mod distribution;
mod normal;
mod strokes;
mod styles;

pub use distribution::Distribution;
#[cfg(feature = "svg")]
pub(crate) use strokes::tapered;
pub use strokes::{Stroke, Strokes};
pub use styles::Style;

use super::scratch::Held;
use super::{PatternBuilder, Scratch};
use crate::error::{Error, Result, in_range};
use crate::formation::{DepthLaw, Material, Orientation, Tool};
use distribution::fields;
use rayon::prelude::*;

/// Most scratches of one generator.
const MOST: f64 = 1e8;

/// Scratches that are drawn before they are added.
const PORTION: usize = 16_384;

/// Most curves of one scratch.
const MOST_CURVES: u32 = 64;

/// Scratches by the many, as their author describes them.
#[derive(Clone, Debug, PartialEq)]
pub struct Generator {
    /// How many.
    pub amount: Amount,
    /// Two opposite corners of a rectangle, (u, v), -1e6 to 1e6, the first one lower in both. The scratches'
    /// middles are spread over it evenly; their ends may reach beyond.
    pub area_uv: [[f64; 2]; 2],
    /// Length along the path, mm, 1e-6 to 1e6.
    pub length_mm: Distribution,
    /// Normal force in full, kgf, 0 to 100000.
    pub force_kgf: Distribution,
    /// Depth under load in full, mm, 0 to 1000: counts under [`DepthLaw::Stated`] only.
    pub depth_mm: Distribution,
    /// Main direction, counter-clockwise from u on the surface, degrees, -3600 to 3600. A bent scratch has it on
    /// average between its two ends.
    pub direction_deg: f64,
    /// Standard deviation from the main direction, degrees: 0 (parallel) to 360 (to a billionth, every direction alike).
    pub spread_deg: f64,
    /// How much a path turns from start to end on average, to the left, degrees, -3600 to 3600. No single curve
    /// turns by more than 90 degrees.
    pub turn_deg: f64,
    /// Standard deviation of that from scratch to scratch, degrees, 0 to 3600.
    pub turn_spread_deg: f64,
    /// Standard deviation of a single curve's turn from its share of the whole, degrees, 0 to 90: an unsteady hand.
    pub wander_deg: f64,
    /// Curves in a path, of equal length, 1 to 64. Each is very nearly an arc of a circle.
    pub curves: u32,
    /// Shares of the length over which force or depth rise from 0 and fall back to it, each 0 to 1, together 1
    /// at most.
    pub taper: [f64; 2],
    /// How the tool is held.
    pub orientation: Orientation,
    /// Standard deviation of the spin from scratch to scratch, degrees, 0 to 360: any grain of a handful.
    pub spin_spread_deg: f64,
    /// What spin and azimuth are relative to.
    pub held: Held,
    /// Which law gives the depth.
    pub depth_law: DepthLaw,
}

/// How many scratches a generator makes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "files", serde(rename_all = "snake_case"))]
pub enum Amount {
    /// Scratches on each cm² of the area, 0 to 1e8, rounded to a whole number in all, 1e8 at most.
    PerCm2(f64),
    /// So many in all, 1e8 at most.
    Count(u32),
}

/// Generated scratches of one kind: what [`PatternBuilder::generate`] adds. Several lie over each other as they are
/// added; give each a seed of its own, or alike generators give alike scratches.
#[derive(Clone, Copy, Debug)]
pub struct Generated<'a> {
    /// Where they run and how they are pressed.
    pub generator: &'a Generator,
    /// The tool.
    pub tool: &'a Tool,
    /// What is scratched and how the scratches reflect; `None` for the pattern's own material.
    pub material: Option<&'a Material>,
    /// Another seed, other scratches.
    pub seed: u64,
}

impl Default for Generator {
    /// Straight scratches in every direction.
    fn default() -> Self {
        Self::style(Style::Straight)
    }
}

impl Generator {
    /// Its scratches on a surface of which one unit of u and of v spans `mm_per_uv`.
    ///
    /// Errors: a value out of its range; an area that asks for more than 1e8 scratches.
    pub fn strokes(&self, mm_per_uv: [f64; 2], seed: u64) -> Result<Strokes> {
        self.check()?;
        for mm in mm_per_uv {
            in_range("mm_per_uv", mm, 1e-18, 1e18)?;
        }
        Ok(Strokes::new(self, self.count(mm_per_uv)?, mm_per_uv, seed))
    }

    fn count(&self, mm_per_uv: [f64; 2]) -> Result<u32> {
        let per_cm2 = match self.amount {
            Amount::Count(count) => {
                in_range("count", f64::from(count), 0.0, MOST)?;
                return Ok(count);
            }
            Amount::PerCm2(per_cm2) => in_range("per_cm2", per_cm2, 0.0, MOST)?,
        };
        let [from, to] = self.area_uv;
        let side_mm = |i: usize| (to[i] - from[i]) * mm_per_uv[i];
        let count = (per_cm2 * side_mm(0) * side_mm(1) / 100.0).round();
        if count <= MOST {
            return Ok(whole(count));
        }
        let accepted = "a density that comes to 1e8 scratches or fewer in the area";
        Err(Error::number("per_cm2", per_cm2, accepted))
    }

    fn check(&self) -> Result<()> {
        let [from, to] = self.area_uv;
        for value in [from, to].concat() {
            in_range("area_uv", value, -1e6, 1e6)?;
        }
        for i in 0..2 {
            if from[i] > to[i] {
                let accepted = "a corner that is lower in u and v, then one that is higher";
                return Err(Error::number("area_uv", from[i], accepted));
            }
        }
        self.length_mm.check(&fields!("length_mm"), 1e-6, 1e6)?;
        self.force_kgf
            .check(&fields!("force_kgf"), 0.0, 100_000.0)?;
        self.depth_mm.check(&fields!("depth_mm"), 0.0, 1000.0)?;
        in_range("direction_deg", self.direction_deg, -3600.0, 3600.0)?;
        in_range("spread_deg", self.spread_deg, 0.0, 360.0)?;
        in_range("turn_deg", self.turn_deg, -3600.0, 3600.0)?;
        in_range("turn_spread_deg", self.turn_spread_deg, 0.0, 3600.0)?;
        in_range("wander_deg", self.wander_deg, 0.0, 90.0)?;
        in_range(
            "curves",
            f64::from(self.curves),
            1.0,
            f64::from(MOST_CURVES),
        )?;
        for share in self.taper {
            in_range("taper", share, 0.0, 1.0)?;
        }
        in_range(
            "taper[0] + taper[1]",
            self.taper[0] + self.taper[1],
            0.0,
            1.0,
        )?;
        self.orientation.check()?;
        in_range("spin_spread_deg", self.spin_spread_deg, 0.0, 360.0)?;
        Ok(())
    }
}

impl PatternBuilder {
    /// Adds generated scratches and tells how many. If one of them is refused, the builder is as it was.
    ///
    /// Errors: a value of the generator's out of its range; a force or depth, by the number of the scratch, that
    /// the tool is too short for.
    pub fn generate(&mut self, generated: &Generated<'_>) -> Result<u32> {
        let strokes = generated
            .generator
            .strokes(self.mm_per_uv(), generated.seed)?;
        let count = strokes.count() as usize;
        self.all_or_none(|builder| {
            let mut portion = vec![Stroke::default(); PORTION.min(count)];
            for first in (0..count).step_by(PORTION) {
                portion.truncate(count - first);
                let numbered = portion.par_iter_mut().enumerate();
                numbered.for_each(|(i, stroke)| strokes.stroke(whole((first + i) as f64), stroke));
                let scratch = |stroke| Scratch {
                    material: generated.material,
                    ..Stroke::scratch(stroke, generated.tool)
                };
                let scratches: Vec<Scratch<'_>> = portion.iter().map(scratch).collect();
                builder.add_portion(&scratches, first)?;
            }
            Ok(())
        })?;
        Ok(strokes.count())
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number from 0 to 1e8"
)]
fn whole(count: f64) -> u32 {
    count as u32
}
